//! The equation of motion with swirl, which only motion in three dimensions has: it pushes and turns
//! squirmers out of any plane.

use nalgebra::Vector3;

use super::coordinates::{Spatial, along_line, spin_about};
use super::equations::{Dynamics as _, Effect, Instant};
use crate::mobility::{Heading, Mobility, add_swirl, pair_velocity};
use crate::{Gravity, Hydrodynamics, SceneError};

/// The effect of swirl. Its modes are the squirmers' own.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Swirl;

/// Time derivative of the state `y`.
///
/// # Errors
/// The model's.
#[inline]
pub(super) fn derivative<H, G, W>(
    coordinates: &Spatial<W>,
    y: &[f64; 13],
    headings: &[Heading<Vector3<f64>>; 2],
    at: &Instant<'_, H, G>,
) -> Result<[f64; 13], SceneError>
where
    H: Hydrodynamics + ?Sized,
    G: Effect<Gravity>,
    W: Effect<Swirl>,
{
    let mut mobility = Mobility::default();
    let Mobility { pair, modes, swirl } = &mut mobility;
    let set = at.mobility_set();
    (at.model).interacting_mobility_with_swirl(at.gap, set, (pair, modes), swirl)?;
    let d = along_line(y);
    let turned = headings.each_ref().map(|heading| heading.turned(&d));
    let external = at.external(coordinates, y);
    let read = &modes[..at.set.modes];
    let mut velocity = pair_velocity((pair, read), at.squirmers, headings, &external);
    let spins = add_swirl(&mut velocity, swirl, at.squirmers, (headings, &turned));
    let mut dy = coordinates.derivative(y, &velocity);
    spin_about(&d, y, &mut dy, spins);
    if let Some([t1, t2]) = at.axial_torques(coordinates, y) {
        coordinates.add_axial_spin(y, &mut dy, pair.twist.spins(t1 + t2, t1 - t2));
    }
    Ok(dy)
}
