//! How far a squirmer can be offset out of the plane before the headings that go out turn by some degrees.

use nalgebra::Vector3;
use scene::{Scene, SceneError};

/// Turns that are asked for, in degrees; 6 is what the paper's Fig. 5(b) speaks of.
pub(super) const TURNS_DEG: [f64; 3] = [1.0, 6.0, 15.0];

/// Largest offset that is looked at, in radii.
const LARGEST: f64 = 10.0;

/// First offset that is looked at, over that of the linear prediction, and the factor from one to the next: a turn that comes and goes between two of them is missed.
const FIRST: f64 = 1.0 / 16.0;
const FACTOR: f64 = 1.3;

/// Relative width at which an offset is known.
const KNOWN: f64 = 1e-9;

/// The scene with squirmer 1 raised along z by half of `dz`, in radii, and squirmer 2 lowered by the other half.
///
/// # Errors
/// [`SceneError`] if the spheres would overlap.
pub(super) fn raised(scene: &Scene, dz: f64) -> Result<Scene, SceneError> {
    let mut start = scene.start;
    start[0].position.z += 0.5 * dz;
    start[1].position.z -= 0.5 * dz;
    Scene::new(scene.squirmers, start, scene.repulsion, scene.gravity)
}

/// The larger of the angles in space between the headings of two runs, in radians.
pub(super) fn turn_rad(a: &[Vector3<f64>; 2], b: &[Vector3<f64>; 2]) -> f64 {
    let between = |k: usize| a[k].cross(&b[k]).norm().atan2(a[k].dot(&b[k]));
    between(0).max(between(1))
}

/// The smallest offset found at which `turn` reaches the target, both in radians: bracketed from a fraction of the linear prediction on, then closed in
/// by bisection and regula falsi (Illinois). Infinite if no offset up to the largest reaches it, NaN where a run on the way has no headings.
pub(super) fn offset_to(target: f64, linear: f64, turn: impl Fn(f64) -> Option<f64>) -> f64 {
    let first = FIRST * if linear.is_finite() { linear } else { 1.0 };
    let (mut low, mut high) = ((0.0, -target), first.min(FIRST * LARGEST));
    if high.is_nan() {
        return f64::NAN;
    }
    let mut above = loop {
        let Some(excess) = turn(high).map(|turned| turned - target) else {
            return f64::NAN;
        };
        if excess >= 0.0 {
            break (high, excess);
        }
        if high >= LARGEST {
            return f64::INFINITY;
        }
        low = (high, excess);
        high = (high * FACTOR).min(LARGEST);
    };
    for i in 0..100 {
        if above.0 - low.0 <= KNOWN * above.0 {
            break;
        }
        // Every third step halves the bracket, however the turn jumps.
        let next = if i % 3 == 2 {
            0.5 * (low.0 + above.0)
        } else {
            (low.0 * above.1 - above.0 * low.1) / (above.1 - low.1)
        };
        let Some(excess) = turn(next).map(|turned| turned - target) else {
            return f64::NAN;
        };
        if excess >= 0.0 {
            above = (next, excess);
            low.1 *= 0.5;
        } else {
            low = (next, excess);
            above.1 *= 0.5;
        }
    }
    above.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn val_an_offset_is_the_root_of_a_smooth_turn() {
        let turn = |dz: f64| Some(2.0 * dz + dz * dz);
        let found = offset_to(0.3, 0.15, turn);
        assert!((found - (1.3_f64.sqrt() - 1.0)).abs() < 1e-9, "{found}");
    }

    #[test]
    fn an_offset_at_which_the_turn_jumps_is_where_it_jumps() {
        let turn = |dz: f64| Some(if dz < 0.7 { 0.1 * dz } else { 3.0 });
        assert!((offset_to(0.3, 3.0, turn) - 0.7).abs() < 1e-8);
    }

    #[test]
    fn a_turn_that_is_never_reached_is_infinitely_far_and_one_without_headings_is_none() {
        assert!(offset_to(0.3, f64::INFINITY, |_| Some(0.0)).is_infinite());
        assert!(offset_to(0.3, 0.1, |dz| (dz < 0.05).then_some(dz)).is_nan());
    }
}
