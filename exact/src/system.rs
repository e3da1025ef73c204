//! The banded system of a boundary-value problem: unknown series, one block of them a degree.
//!
//! A field is a series `s^(1/2) sin^m(eta) Σ f_n P_n^(m)(mu) e_n(xi)/e_n(alpha)`, where `e_n` is
//! `cosh` or `sinh` of `(n + 1/2) xi`, so that its coefficients are those on the sphere and stay of
//! order one times `exp(-n alpha)`. Equations on the sphere use stencils as they are; equations
//! between harmonics in space (continuity) hold for the factors of `e_n(xi)`, so each neighbour
//! brings a ratio `e_n(alpha)/e_(n+-1)(alpha)`, formed without overflow.

use crate::ExactError;
use crate::banded::Banded;
use crate::geometry::{Geometry, Parity};
use crate::stencil::Stencil;

/// A field's place among the unknowns and its kind.
#[derive(Clone, Copy, Debug)]
pub struct Field {
    /// Position within a block.
    pub index: usize,
    /// Azimuthal order `m` of its harmonics: `P_n^(m)` grows as `n^m`, which scaling takes out.
    pub order: usize,
    /// `Even`: `cosh`; `Odd`: `sinh`.
    pub envelope: Parity,
}

impl Field {
    fn scale(self, n: usize) -> f64 {
        (n.max(1) as f64).powi(-(self.order as i32))
    }
}

/// A system in assembly.
pub struct System {
    geometry: Geometry,
    fields: usize,
    matrix: Banded,
    /// `e_n(alpha)` over `exp(lambda alpha)/2`, for `cosh` and for `sinh`.
    envelopes: [Vec<f64>; 2],
}

impl System {
    /// An empty system of `fields` fields.
    pub fn new(geometry: Geometry, fields: usize) -> Self {
        let envelope = |parity: Parity| {
            (0..=geometry.degree)
                .map(|n| parity.envelope(n as f64 + 0.5, geometry.alpha))
                .collect()
        };
        Self {
            geometry,
            fields,
            matrix: Banded::zero(fields * (geometry.degree + 1), 2 * fields - 1),
            envelopes: [envelope(Parity::Even), envelope(Parity::Odd)],
        }
    }

    fn envelope(&self, parity: Parity, n: usize) -> f64 {
        self.envelopes[usize::from(parity == Parity::Odd)][n]
    }

    /// Adds a field to an equation of degree `n` on the sphere.
    pub fn on_sphere(&mut self, n: usize, equation: usize, field: Field, weights: Stencil) {
        let row = self.fields * n + equation;
        let mut add = |degree: usize, weight: f64| {
            let column = self.fields * degree + field.index;
            self.matrix.add(row, column, weight * field.scale(degree));
        };
        if n > field.order {
            add(n - 1, weights.below);
        }
        if n >= field.order {
            add(n, weights.at);
        }
        if n < self.geometry.degree {
            add(n + 1, weights.above);
        }
    }

    /// Adds a field to an equation in space that holds for the factors of `e_n(xi)` of `parity`.
    pub fn in_space(
        &mut self,
        n: usize,
        equation: usize,
        parity: Parity,
        field: Field,
        weights: Stencil,
    ) {
        let own = self.envelope(parity, n);
        let grow = self.geometry.alpha.exp();
        let ratio = |degree: usize| own / self.envelope(field.envelope, degree);
        let above = (n + 1).min(self.geometry.degree);
        let weights = Stencil {
            below: weights.below * ratio(n.saturating_sub(1)) * grow,
            at: weights.at * ratio(n),
            above: weights.above * ratio(above) / grow,
        };
        self.on_sphere(n, equation, field, weights);
    }

    /// Sets a coefficient that has no harmonic (`n` below the field's order) to zero.
    pub fn absent(&mut self, n: usize, equation: usize, field: Field) {
        let row = self.fields * n + equation;
        self.matrix.add(row, self.fields * n + field.index, 1.0);
    }

    /// Solves for `count` right-hand sides, given in the order of equations.
    pub fn solve(self, mut rhs: Vec<f64>, count: usize) -> Result<Series, ExactError> {
        self.matrix.factor()?.solve(&mut rhs, count);
        Ok(Series {
            fields: self.fields,
            count,
            values: rhs,
        })
    }
}

/// Solved series of all fields, for all right-hand sides.
pub struct Series {
    fields: usize,
    count: usize,
    values: Vec<f64>,
}

impl Series {
    /// Number of right-hand sides.
    pub fn count(&self) -> usize {
        self.count
    }

    /// The coefficients `f_0, f_1, ...` on the sphere of one field for one right-hand side.
    pub fn coefficients(&self, field: Field, case: usize) -> impl Iterator<Item = f64> + '_ {
        self.values
            .chunks_exact(self.fields * self.count)
            .enumerate()
            .map(move |(n, block)| block[field.index * self.count + case] * field.scale(n))
    }

    /// `Σ_n weight(n) f_n^+`, where `f_n^+` is the factor of `exp(+(n + 1/2) xi)`: the part of the
    /// field that is singular within the sphere, which alone carries force and torque.
    pub fn singular_sum(
        &self,
        geometry: &Geometry,
        field: Field,
        case: usize,
        weight: impl Fn(f64) -> f64,
    ) -> f64 {
        self.coefficients(field, case)
            .enumerate()
            .skip(field.order)
            .map(|(n, value)| {
                let n = n as f64;
                let lambda = n + 0.5;
                let envelope = field.envelope.envelope(lambda, geometry.alpha);
                weight(n) * value * (-lambda * geometry.alpha).exp() / envelope
            })
            .sum()
    }
}
