//! Stresslets and rates of work by unit causes.
//!
//! The stresslet of a sphere is the quadrupole of the pressure that is singular within it: with `p = -3 x.S.x/(4 pi r^5)` far from
//! a stresslet (Kim & Karrila, *Microhydrodynamics* (2005), section 2.5) it is `S = -(2 pi/3) ∫ (3 y y - y^2 I) dQ`, `Q` the charge of the
//! pressure. A bispherical series has `∫ g dQ` as a sum over degrees for any regular harmonic `g`; with `u = e^(-alpha)/sinh(alpha)` and `c` the focal length the
//! weights of `z^2 - rho^2/2`, `rho z` and `rho^2`, all about the sphere's centre, are
//!
//! ```text
//! c^2 [2 n (n-1) - 4 n u + u^2],   c^2 n (n+1) [2 (n-1)/3 - u],   c^2 (2/3) (n-1) n (n+1) (n+2).
//! ```
//!
//! Rigid motions do work against forces and torques, which the charges of the velocity give; slip against tractions ([`super::tractions`]).
//! That the matrix of the rates of work is symmetric is the reciprocal theorem between these two.

use std::f64::consts::{PI, SQRT_2};

use nalgebra::{DMatrix, DVector};
use scene::Gap;
use scene::stress::{Block, BlockStresses, Cause, Stresses};

use super::causes::rows;
use super::solution::Solution;
use crate::ExactError;
use crate::axial;
use crate::geometry::Geometry;
use crate::system::Field;
use crate::unlike::{NOMINAL, Pair, PairSeries};

/// At the gap `eps` between spheres of radii 1 and `ratio`, with `factor` times the terms that reach rounding.
pub fn stresses(
    gap: Gap,
    ratio: f64,
    (modes, swirl): (usize, usize),
    factor: f64,
) -> Result<Stresses, ExactError> {
    let highest = modes.max(swirl).max(1);
    let pair = Pair::resolving_velocities(gap.eps(), ratio, highest, factor)?;
    let blocks = Block::all(modes, swirl)
        .map(|block| of_block(&pair, [1.0, ratio], block, block.causes(modes, swirl)))
        .collect::<Result<_, _>>()?;
    Ok(Stresses {
        gap,
        modes,
        swirl,
        blocks,
    })
}

fn of_block(
    pair: &Pair,
    radii: [f64; 2],
    block: Block,
    causes: Vec<Cause>,
) -> Result<BlockStresses, ExactError> {
    let units = [0, 1].map(|k| rows(pair.spheres[k], (k, radii[k]), block, &causes));
    let cases: Vec<[Vec<f64>; 2]> = (0..2)
        .flat_map(|active| units[active].iter().map(move |rows| (active, rows)))
        .map(|(active, rows)| {
            let rest = vec![0.0; rows.len()];
            if active == 0 {
                [rows.clone(), rest]
            } else {
                [rest, rows.clone()]
            }
        })
        .collect();
    let solution = Solution::new(pair, block, &cases)?;
    let count = cases.len();
    let mut work = DMatrix::zeros(count, count);
    let mut stresslets = [0, 1].map(|_| DVector::zeros(0));
    for sphere in [0, 1] {
        let on = On {
            pair,
            sphere,
            radius: radii[sphere],
            solution: &solution,
        };
        for column in 0..count {
            // What the sphere does itself in this case.
            let own = (column.checked_sub(sphere * causes.len()))
                .and_then(|k| Some((*causes.get(k)?, units[sphere].get(k)?.as_slice())));
            let tractions = on.tractions(column, own);
            for (row, cause) in causes.iter().enumerate() {
                work[(sphere * causes.len() + row, column)] = match cause {
                    Cause::Translation => -on.force(column),
                    Cause::Rotation => -on.torque(column),
                    _ => on.work(&units[sphere][row], &tractions),
                };
            }
        }
        if let Block::Order(order @ 0..=2) = block {
            let by = (0..count).map(|column| on.stresslet(order, column));
            stresslets[sphere] = DVector::from_iterator(count, by);
        }
    }
    Ok(BlockStresses {
        block,
        causes,
        work,
        stresslets,
    })
}

/// A sphere in the solved flows of a block, as it sees itself above.
pub struct On<'a> {
    /// Both spheres.
    pub pair: &'a Pair,
    /// 0 above, 1 below.
    pub sphere: usize,
    /// Its radius.
    pub radius: f64,
    /// The flows.
    pub solution: &'a Solution,
}

impl On<'_> {
    /// The sphere as the upper one, in units of its own radius.
    pub fn geometry(&self) -> Geometry {
        self.pair.spheres[self.sphere]
    }

    /// Charges of a field within the sphere, degree by degree weighted.
    fn charge(
        &self,
        (series, field): (&PairSeries, Field),
        case: usize,
        weight: impl Fn(f64) -> f64,
    ) -> f64 {
        series.charge_by(self.sphere, field, case, weight)
    }

    /// Force of the fluid along `d` of order 0, along `t` of order 1.
    fn force(&self, case: usize) -> f64 {
        let scale = PI * SQRT_2 * self.geometry().sinh * self.radius;
        match self.solution {
            Solution::Twist(_) => 0.0,
            Solution::Axial(series) => {
                let field = axial::Fields::new(NOMINAL).axial;
                8.0 * scale * self.charge((series, field), case, |_| 1.0)
            }
            Solution::Across(series, fields) => {
                -4.0 * scale * self.charge((series, fields.mean), case, |_| 1.0)
            }
        }
    }

    /// Torque of the fluid about `d` of the twist, along `d x t` of order 1, with the sphere's own `d`.
    fn torque(&self, case: usize) -> f64 {
        let Geometry { alpha, sinh, .. } = self.geometry();
        let scale = 4.0 * PI * SQRT_2 * sinh * self.radius.powi(2);
        match self.solution {
            Solution::Axial(_) => 0.0,
            Solution::Across(series, fields) => {
                let arm = |n: f64| 2.0 * n * sinh - (-alpha).exp();
                scale * self.charge((series, fields.mean), case, arm)
            }
            Solution::Twist(cases) => {
                let terms = cases[case].iter().enumerate().map(|(n, factors)| {
                    let n = n as f64;
                    n * (n + 1.0) * factors[self.sphere] * (-(n + 0.5) * alpha).exp()
                });
                -2.0 * scale * sinh * self.turned(terms.sum())
            }
        }
    }

    /// Of what turns about `d` of sphere 1, as this sphere has it about its own.
    fn turned(&self, about: f64) -> f64 {
        if self.sphere == 0 { about } else { -about }
    }

    /// Stresslet of an order by a case, along the axes of the active sphere.
    fn stresslet(&self, order: usize, case: usize) -> f64 {
        let Geometry { alpha, sinh, .. } = self.geometry();
        let tip = (-alpha).exp();
        let scale = PI * SQRT_2 * self.radius.powi(2);
        match (order, self.solution) {
            (0, Solution::Axial(series)) => {
                let field = axial::Fields::new(NOMINAL).pressure;
                let weight =
                    |n: f64| 2.0 * n * (n - 1.0) * sinh * sinh - 4.0 * n * sinh * tip + tip * tip;
                -2.0 * scale * self.charge((series, field), case, weight)
            }
            (1, Solution::Across(series, fields)) => {
                let weight = |n: f64| n * (n + 1.0) * sinh * (2.0 * (n - 1.0) / 3.0 * sinh - tip);
                // The transverse axis is common to both spheres, `d` is that of the active one.
                let cases = series.cases() / 2;
                let sign = if case / cases == self.sphere {
                    1.0
                } else {
                    -1.0
                };
                2.0 * scale * sign * self.charge((series, fields.pressure), case, weight)
            }
            (2, Solution::Across(series, fields)) => {
                let weight =
                    |n: f64| (n - 1.0) * n * (n + 1.0) * (n + 2.0) * (2.0 / 3.0) * sinh * sinh;
                -scale * self.charge((series, fields.pressure), case, weight)
            }
            _ => 0.0,
        }
    }
}
