//! The equation of motion with swirl, which only motion in three dimensions has: it pushes and turns
//! squirmers out of any plane.

use nalgebra::Vector3;

use super::coordinates::{Spatial, along_line, spin_about};
use super::equations::{Dynamics as _, Effect, Instant};
use crate::balance::{Heading, axial_spin_by_swirl, pair_velocity_with_swirl};
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
    let both = at.model.interacting_loads_with_swirl(at.gap, at.set);
    let (loads, swirl) = match &both {
        Ok(both) => both,
        Err(error) => return Err(error.clone()),
    };
    let d = along_line(y);
    let turned = [0, 1].map(|k| d.cross(&headings[k].transverse));
    let velocity = pair_velocity_with_swirl(
        at.gap,
        (loads, swirl),
        at.squirmers,
        (headings, &turned),
        &at.external(coordinates, y),
    );
    let mut dy = coordinates.derivative(y, &velocity);
    let spins = axial_spin_by_swirl((loads, swirl), at.squirmers, headings);
    spin_about(&d, y, &mut dy, spins);
    if let Some(gravity) = at.gravity.get() {
        coordinates.add_axial_spin(y, &mut dy, loads, gravity, at.squirmers);
    }
    Ok(dy)
}
