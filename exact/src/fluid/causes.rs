//! Boundary velocities by unit causes, as the rows of the equations on each sphere.

use scene::stress::{Block, Cause};

use crate::axial;
use crate::geometry::Geometry;
use crate::surface::{Surface, combine};
use crate::transverse::{AXIAL, Basis, Boundary, DIFFERENCE, FIELDS, SUM};

/// Rows of the equations on one sphere, by degree and equation, for each of `causes`: what a unit amplitude of each sets its surface to, as
/// the sphere sees itself above. It is the upper one (`sphere` 0) or the lower one, of the given `radius`.
pub fn rows(
    geometry: Geometry,
    (sphere, radius): (usize, f64),
    block: Block,
    causes: &[Cause],
) -> Vec<Vec<f64>> {
    let highest = causes
        .iter()
        .map(|cause| mode(*cause))
        .max()
        .unwrap_or(1)
        .max(1);
    match block {
        // Each sphere turns about its own `d`.
        Block::Twist => {
            let sign = if sphere == 0 { 1.0 } else { -1.0 };
            about_the_line(geometry, sign, radius, causes)
        }
        Block::Order(0) => {
            let velocities = axial::boundary_velocities(geometry, highest);
            let of = |cause: &Cause| velocities[mode(*cause)].rows();
            causes.iter().map(of).collect()
        }
        Block::Order(order) => {
            let basis = Basis::new(geometry, order, highest);
            let of = |cause: &Cause| match *cause {
                Cause::Translation => interleaved(&basis.translation(), 1.0),
                Cause::Rotation => interleaved(&basis.rotation(), radius),
                Cause::Squirming(k) => interleaved(&basis.slip(k), 1.0),
                Cause::Swirl(k) => interleaved(&basis.swirl(k), 1.0),
            };
            causes.iter().map(of).collect()
        }
    }
}

/// The number of a slip mode, 0 for rigid motion.
fn mode(cause: Cause) -> usize {
    match cause {
        Cause::Translation | Cause::Rotation => 0,
        Cause::Squirming(k) | Cause::Swirl(k) => k,
    }
}

fn about_the_line(geometry: Geometry, sign: f64, radius: f64, causes: &[Cause]) -> Vec<Vec<f64>> {
    let surface = Surface::new(geometry, 1);
    let highest = causes.iter().map(|cause| mode(*cause)).max().unwrap_or(1);
    let series = surface.legendre(highest.max(1), 1);
    let of = |cause: &Cause| {
        let (factor, k) = match *cause {
            Cause::Swirl(k) => (2.0 / (k * (k + 1)) as f64, k),
            _ => (radius, 1),
        };
        let velocity = &series.derivative(1)[k];
        surface.over_denominator(combine(sign * factor, velocity, 0.0, velocity))
    };
    causes.iter().map(of).collect()
}

fn interleaved(of: &Boundary, factor: f64) -> Vec<f64> {
    let mut rows = vec![0.0; FIELDS * of.axial.len()];
    for (equation, series) in [
        (AXIAL, &of.axial),
        (DIFFERENCE, &of.difference),
        (SUM, &of.sum),
    ] {
        for (n, value) in series.iter().enumerate() {
            rows[FIELDS * n + equation] = factor * value;
        }
    }
    rows
}
