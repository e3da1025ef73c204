//! The linearised motion out of the plane of a pair that keeps its shape in it.

use nalgebra::{Matrix3, Vector3};

use super::linearised::Linearised;
use super::perturbation::{NUMBERS, Perturbation};
use crate::mobility::MobilitySet;
use crate::{Gap, Hydrodynamics, LoadSet, Repulsion, SceneError, Squirmer};

/// Where the z components of the line of centres and of both orientations stand in a state.
const Z: [usize; 3] = [5, 9, 12];

/// The matrix `M` of `dz/dt = M z`, in `V_s/a`, with `z` the components out of the plane of the line of centres and of both orientations.
///
/// The pair lies in the x-y plane with its line of centres along x, and its orientations at these `angles`, in radians, anticlockwise from the direction to
/// the other squirmer. By the mirror in the plane nothing of the first order in `z` moves it within the plane, and nothing within the plane moves it out. A
/// rotation about the z axis leaves `z` alone, so that `M` is the same all along the way of a pair that turns or moves without changing its shape.
///
/// # Errors
/// The model's.
pub(in crate::motion) fn off_plane(
    model: &dyn Hydrodynamics,
    squirmers: [Squirmer; 2],
    repulsion: Option<Repulsion>,
    (gap, angles): (Gap, [f64; 2]),
) -> Result<Matrix3<f64>, SceneError> {
    const SIZE: usize = 4 * NUMBERS;
    let modes = squirmers.iter().map(|squirmer| squirmer.modes().len());
    let mut system = Linearised {
        model,
        set: MobilitySet {
            loads: LoadSet::planar(modes.max().unwrap_or(0)),
            torque: false,
        },
        squirmers,
        repulsion,
        gravity: None,
        directions: &[Perturbation::NONE; 3],
        changes_slip: vec![false; 3],
        by_ratio: &[],
        read: Box::default(),
        failure: None,
    };
    let heading = |angle: f64| Vector3::new(angle.cos(), angle.sin(), 0.0);
    let orientations = [heading(angles[0]), -heading(angles[1])];
    let mut y = [0.0; SIZE];
    y[3] = 1.0;
    y[6] = gap.ln();
    y[7..10].copy_from_slice(orientations[0].as_slice());
    y[10..13].copy_from_slice(orientations[1].as_slice());
    for (direction, at) in Z.into_iter().enumerate() {
        y[NUMBERS * (direction + 1) + at] = 1.0;
    }
    let mut dy = [0.0; SIZE];
    system.rates(&y, &mut dy)?;
    Ok(Matrix3::from_fn(|row, column| {
        dy[NUMBERS * (column + 1) + Z[row]]
    }))
}
