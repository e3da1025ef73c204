//! Where a pair is now that came from infinity on given straight paths.
//!
//! Far away the other's stresslet turns a squirmer at the rate `w(t) = -(3/2) B_2 a_j^2 (p_j.s) (p_j x s)/|s|^5` (`far_turn`). On straight
//! paths up to now (`t = 0`) it has turned by the integral of `w`, and since it pointed elsewhere on the way it is off its straight path by
//! `V (J x p)` with the first moment `J = - integral of t w(t) dt`, which falls only as `1/(|V|^2 s0)`. The other's flow has carried it
//! besides (`far_drift`). All three are closed forms; what is left out is of second order in the far field, or falls one order faster.

use nalgebra::Rotation3;

use super::far_turn::{far_drift, turn_by, turn_moment_by};
use crate::frame::Configuration;
use crate::{Gap, SceneError, Squirmer};

/// The configuration now of a pair whose straight paths and headings at minus infinity are those of `free`, to leading order of the far
/// field. `free` is where lone squirmers would be now. None if the two of `free` do not approach each other.
///
/// # Errors
/// [`SceneError::InvalidGap`] if the spheres overlap or touch.
pub fn from_infinity(
    squirmers: &[Squirmer; 2],
    free: &Configuration,
) -> Result<Option<Configuration>, SceneError> {
    let Some(drift) = far_drift(squirmers, free, true) else {
        return Ok(None);
    };
    let velocities = [0, 1].map(|k| free.orientations[k] * squirmers[k].swimming_speed());
    let separation = free.line * free.distance();
    let mut positions = free.positions();
    let mut now = *free;
    for k in [0, 1] {
        let j = 1 - k;
        let (p, of) = (free.orientations[k], free.orientations[j]);
        // The way to this squirmer from the other one, and how that changed, backward in time.
        let s0 = if k == 0 { -separation } else { separation };
        let backward = velocities[j] - velocities[k];
        let strength = squirmers[j].mode(1) * squirmers[j].radius().powi(2);
        let turn = turn_by(strength, of, s0, backward);
        let moment = turn_moment_by(strength, of, s0, backward);
        now.orientations[k] = Rotation3::new(turn) * p;
        positions[k] += drift[k] + moment.cross(&velocities[k]);
    }
    let apart = positions[1] - positions[0];
    let distance = apart.norm();
    now.gap = Gap::new(distance - (free.radii[0] + free.radii[1]))?;
    now.line = apart / distance;
    now.midpoint = (positions[0] + positions[1]) * 0.5;
    now.line_angle_rad = now.line.y.atan2(now.line.x);
    now.angles_rad = now.orientations.map(|p| p.y.atan2(p.x));
    Ok(Some(now))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

    use super::*;
    use nalgebra::Vector3;

    #[test]
    fn a_pair_that_recedes_did_not_come_from_infinity() {
        let pair = [Squirmer::with_beta(1.0, 1.0).unwrap(); 2];
        let free = Configuration {
            radii: [1.0; 2],
            gap: Gap::new(10.0).unwrap(),
            midpoint: Vector3::zeros(),
            line: Vector3::x(),
            orientations: [-Vector3::x(), Vector3::x()],
            line_angle_rad: 0.0,
            angles_rad: [0.0; 2],
        };
        assert_eq!(from_infinity(&pair, &free).unwrap(), None);
    }
}
