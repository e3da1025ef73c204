//! The solved series of one block of causes.

use scene::stress::Block;

use super::harmonic::Factors;
use crate::ExactError;
use crate::system::Field;
use crate::unlike::{NOMINAL, Pair, PairSeries, PairSystem};
use crate::{axial, transverse};

/// Fields about both spheres, for each of the boundary velocities that were asked for.
pub enum Solution {
    /// `u_phi`, of order 1.
    Twist(Vec<Vec<Factors>>),
    /// Without what turns about the line of centres.
    Axial(PairSeries),
    /// Of an azimuthal order from 1 on.
    Across(PairSeries, transverse::Fields),
}

impl Solution {
    /// Solves for cases that are the rows of each sphere.
    pub fn new(pair: &Pair, block: Block, cases: &[[Vec<f64>; 2]]) -> Result<Self, ExactError> {
        match block {
            Block::Twist => Ok(Self::Twist(
                cases.iter().map(|case| twisted(pair, case)).collect(),
            )),
            Block::Order(0) => {
                let mut system = PairSystem::new(*pair, axial::FIELDS, None);
                axial::assemble(&mut system, NOMINAL, &axial::Fields::new(NOMINAL));
                Ok(Self::Axial(system.solve(cases)?))
            }
            Block::Order(order) => {
                let fields = transverse::Fields::new(order, NOMINAL);
                let mut system = PairSystem::new(*pair, transverse::FIELDS, None);
                transverse::assemble(&mut system, NOMINAL, &fields);
                Ok(Self::Across(system.solve(cases)?, fields))
            }
        }
    }
}

/// The factors of a field by degree, in the frame of both spheres.
pub fn factors(series: &PairSeries, field: Field, case: usize) -> Vec<Factors> {
    // The lower sphere looks into the mirror, which turns fields of the other envelope round.
    let sign = if field.envelope == NOMINAL { 1.0 } else { -1.0 };
    let [upper, lower] = [0, 1].map(|sphere| series.singular(sphere, field, case));
    upper
        .zip(lower)
        .map(|(up, down)| [up, sign * down])
        .collect()
}

/// Factors that have the values `upper` and `lower` on the spheres, degree by degree.
fn twisted(pair: &Pair, [upper, lower]: &[Vec<f64>; 2]) -> Vec<Factors> {
    let width = 2.0 * pair.half_width();
    let values = upper.iter().zip(lower).enumerate();
    values
        .map(|(n, (upper, lower))| {
            let across = (-(n as f64 + 0.5) * width).exp();
            let determinant = -(-(2.0 * n as f64 + 1.0) * width).exp_m1();
            [
                (upper - across * lower) / determinant,
                (lower - across * upper) / determinant,
            ]
        })
        .collect()
}
