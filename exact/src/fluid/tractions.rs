//! Rates of work of slip against the tractions of solved flows.
//!
//! Slip does work against the tangential traction `du/dn`, less `u/a` of the sphere's own spin and slip. With `dn = -c dxi/S` and
//! `dS = c^2/S^2 dmu dphi` it is, for velocities `U_i = S^(1/2) u_i` and `D` the derivative by `xi` of `s^(1/2) u`,
//!
//! ```text
//! -∫ u_i.f dS = c ∫ U_i.(D + b sinh(alpha) U/S)/S^2 dmu dphi,   b = 1/2 for its own spin and slip, -1/2 for its own translation,
//! ```
//!
//! a sum over degrees, as in the reciprocal theorem of unlike spheres ([`crate::unlike`]).

use std::f64::consts::PI;

use scene::stress::Cause;

use super::harmonic::Factors;
use super::solution::Solution;
use super::stresses::On;
use crate::axial;
use crate::geometry::Geometry;
use crate::stencil::times_denominator;
use crate::surface::{Surface, apply, product};
use crate::system::Field;
use crate::transverse::{self, DIFFERENCE, SUM};
use crate::unlike::{NOMINAL, PairSeries, put_into_axial_equations, row_slopes};

impl On<'_> {
    /// Tangential tractions of a case, with their signs turned, as the products with velocities have them: each with its azimuthal order. `own` is what
    /// the sphere does itself in that case, with the rows of its velocity.
    pub fn tractions(&self, case: usize, own: Option<(Cause, &[f64])>) -> Vec<(usize, Vec<f64>)> {
        let geometry = self.geometry();
        let mut components = match self.solution {
            Solution::Twist(cases) => vec![self.twisting(&cases[case])],
            Solution::Axial(series) => {
                let fields = axial::Fields::new(NOMINAL);
                let (values, slopes) = self.jets(series, &fields.all(), case);
                self.axial_slopes(&values, &slopes)
            }
            Solution::Across(series, fields) => {
                let (values, slopes) = self.jets(series, &fields.all(), case);
                let [axial, lower, upper] =
                    row_slopes((self.pair, self.sphere), &values, &slopes, fields);
                let m = fields.order();
                vec![(m, axial), (m - 1, lower), (m + 1, upper)]
            }
        };
        if let Some((cause, rows)) = own {
            let share = if cause == Cause::Translation {
                -0.5
            } else {
                0.5
            };
            for ((order, slope), velocity) in components.iter_mut().zip(self.components(rows)) {
                let own = Surface::new(geometry, *order).over_denominator(velocity);
                for (s, u) in slope.iter_mut().zip(own) {
                    *s += share * geometry.sinh * u;
                }
            }
        }
        let over_square = |(order, slope): (usize, Vec<f64>)| {
            let surface = Surface::new(geometry, order);
            (
                order,
                surface.over_denominator(surface.over_denominator(slope)),
            )
        };
        components.into_iter().map(over_square).collect()
    }

    /// The components of a velocity, `S^(1/2)` times each, from the rows of the equations that set it.
    fn components(&self, rows: &[f64]) -> Vec<Vec<f64>> {
        let (fields, equations): (_, &[usize]) = match self.solution {
            Solution::Twist(_) => {
                let cosh = self.geometry().cosh;
                return vec![apply(rows, 1, |n| times_denominator(n, 1, cosh))];
            }
            Solution::Axial(_) => (axial::FIELDS, &[axial::AXIAL, axial::RADIAL]),
            Solution::Across(..) => (transverse::FIELDS, &[transverse::AXIAL, DIFFERENCE, SUM]),
        };
        let of = |equation: &usize| {
            rows.iter()
                .skip(*equation)
                .step_by(fields)
                .copied()
                .collect()
        };
        equations.iter().map(of).collect()
    }

    /// Values of the fields on the sphere and their derivatives by `xi`, by the fields' indices.
    fn jets(
        &self,
        series: &PairSeries,
        fields: &[Field],
        case: usize,
    ) -> (Vec<Vec<f64>>, Vec<Vec<f64>>) {
        let mut values = vec![Vec::new(); fields.len()];
        let mut slopes = values.clone();
        for field in fields {
            let (value, slope) = series.jet(self.sphere, *field, case).unzip();
            values[field.index] = value;
            slopes[field.index] = slope;
        }
        (values, slopes)
    }

    /// Derivatives by `xi` of `s^(1/2)` times the axial and the radial velocity of order 0.
    fn axial_slopes(&self, values: &[Vec<f64>], slopes: &[Vec<f64>]) -> Vec<(usize, Vec<f64>)> {
        let fields = axial::Fields::new(NOMINAL);
        let Geometry { sinh, cosh, .. } = self.geometry();
        let rows = put_into_axial_equations(self.pair, self.sphere, slopes.to_vec());
        let value = |of: Field, n: usize| values[of.index][n];
        let along = negated(&rows, axial::FIELDS, axial::AXIAL)
            .into_iter()
            .enumerate();
        let across = negated(&rows, axial::FIELDS, axial::RADIAL)
            .into_iter()
            .enumerate();
        let along = along.map(|(n, slope)| {
            slope + 0.5 * cosh * value(fields.pressure, n) + sinh * value(fields.axial, n)
        });
        let across = across.map(|(n, slope)| slope + sinh * value(fields.radial, n));
        vec![(0, along.collect()), (1, across.collect())]
    }

    /// The derivative by `xi` of `s^(1/2)` times the velocity about the line.
    fn twisting(&self, factors: &[Factors]) -> (usize, Vec<f64>) {
        let Geometry { sinh, cosh, .. } = self.geometry();
        let (values, slopes) = self.twist_jets(factors);
        let rows = apply(&slopes, 1, |n| times_denominator(n, 1, cosh));
        let slope = rows
            .iter()
            .zip(&values)
            .map(|(row, value)| row + sinh * value);
        (1, slope.collect())
    }

    fn twist_jets(&self, factors: &[Factors]) -> (Vec<f64>, Vec<f64>) {
        let width = 2.0 * self.pair.half_width();
        let jets = factors.iter().enumerate().map(|(n, factors)| {
            let nu = n as f64 + 0.5;
            let own = factors[self.sphere];
            let other = factors[1 - self.sphere] * (-nu * width).exp();
            (own + other, nu * (own - other))
        });
        jets.unzip()
    }

    /// Rate of work of a velocity, the rows of a cause, against tractions.
    pub fn work(&self, velocity: &[f64], tractions: &[(usize, Vec<f64>)]) -> f64 {
        let scale = PI * self.radius * self.geometry().sinh;
        let weights: &[f64] = match self.solution {
            Solution::Twist(_) | Solution::Axial(_) => &[2.0, 2.0],
            Solution::Across(..) => &[1.0, 0.5, 0.5],
        };
        let parts = self
            .components(velocity)
            .into_iter()
            .zip(weights)
            .zip(tractions);
        parts
            .map(|((of, weight), (order, traction))| {
                scale * weight * product(*order, &of, traction)
            })
            .sum()
    }
}

/// One equation of all degrees, of rows that have the opposite sign.
fn negated(rows: &[f64], fields: usize, equation: usize) -> Vec<f64> {
    rows.iter()
        .skip(equation)
        .step_by(fields)
        .map(|row| -row)
        .collect()
}
