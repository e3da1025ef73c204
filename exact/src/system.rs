//! The banded system of a boundary-value problem: unknown series, one block of them a degree.
//!
//! A field is a series `s^(1/2) sin^m(eta) Σ f_n P_n^(m)(mu) e_n(xi)/e_n(alpha)`, where `e_n` is
//! `cosh` or `sinh` of `(n + 1/2) xi`, so that its coefficients are those on the sphere and stay of
//! order one times `exp(-n alpha)`. Equations on the sphere use stencils as they are; equations
//! between harmonics in space (continuity) hold for the factors of `e_n(xi)`, so each neighbour
//! brings a ratio `e_n(alpha)/e_(n+-1)(alpha)`, formed without overflow.
//!
//! What the equations of a problem are is written once, for anything that takes [`Equations`]: the
//! system of one parity here, that of both spheres of an unlike pair, or the values of a known flow.

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

/// What takes the equations of a boundary-value problem, term by term.
pub trait Equations {
    /// Highest degree.
    fn degree(&self) -> usize;

    /// Adds a field to an equation of degree `n` on the sphere, or on each of them.
    fn on_sphere(
        &mut self,
        n: usize,
        equation: usize,
        field: Field,
        weights: impl Fn(&Geometry) -> Stencil,
    );

    /// Adds a field to an equation in space that holds for the factors of `e_n(xi)` of `parity`.
    fn in_space(
        &mut self,
        n: usize,
        equation: usize,
        parity: Parity,
        field: Field,
        weights: Stencil,
    );

    /// Sets a coefficient that has no harmonic (`n` below the field's order) to zero.
    fn absent(&mut self, n: usize, equation: usize, field: Field);
}

/// A banded matrix in blocks, one a degree, of as many rows as unknowns.
pub struct Blocks {
    size: usize,
    degree: usize,
    matrix: Banded,
}

impl Blocks {
    /// An empty matrix for `size` unknowns of each degree up to `degree`.
    pub fn new(size: usize, degree: usize) -> Self {
        Self {
            size,
            degree,
            matrix: Banded::zero(size * (degree + 1), 2 * size - 1),
        }
    }

    /// Adds the unknown `column` of a field to the row `row` of degree `n`.
    pub fn add(&mut self, n: usize, row: usize, (field, column): (Field, usize), weights: Stencil) {
        let row = self.size * n + row;
        let mut add = |degree: usize, weight: f64| {
            let column = self.size * degree + column;
            self.matrix.add(row, column, weight * field.scale(degree));
        };
        if n > field.order {
            add(n - 1, weights.below);
        }
        if n >= field.order {
            add(n, weights.at);
        }
        if n < self.degree {
            add(n + 1, weights.above);
        }
    }

    /// Sets the unknown `column` of degree `n` to zero by the row `row`.
    pub fn absent(&mut self, n: usize, row: usize, column: usize) {
        self.matrix
            .add(self.size * n + row, self.size * n + column, 1.0);
    }

    /// Solves for `count` right-hand sides, given in the order of rows.
    pub fn solve(self, mut rhs: Vec<f64>, count: usize) -> Result<Series, ExactError> {
        self.matrix.factor()?.solve(&mut rhs, count);
        Ok(Series {
            fields: self.size,
            count,
            values: rhs,
        })
    }
}

/// `e_n(alpha)` over `exp(lambda alpha)/2` of each degree, for `cosh` and for `sinh`.
pub struct Envelopes([Vec<f64>; 2]);

impl Envelopes {
    /// Of the degrees up to `degree` at `alpha`.
    pub fn new(alpha: f64, degree: usize) -> Self {
        Self([Parity::Even, Parity::Odd].map(|parity| {
            (0..=degree)
                .map(|n| parity.envelope(n as f64 + 0.5, alpha))
                .collect()
        }))
    }

    /// Of one degree.
    pub fn at(&self, parity: Parity, n: usize) -> f64 {
        self.0[usize::from(parity == Parity::Odd)][n]
    }
}

/// The system of one parity, in assembly.
pub struct System {
    geometry: Geometry,
    blocks: Blocks,
    envelopes: Envelopes,
}

impl System {
    /// An empty system of `fields` fields.
    pub fn new(geometry: Geometry, fields: usize) -> Self {
        Self {
            geometry,
            blocks: Blocks::new(fields, geometry.degree),
            envelopes: Envelopes::new(geometry.alpha, geometry.degree),
        }
    }

    /// Solves for `count` right-hand sides, given in the order of equations.
    pub fn solve(self, rhs: Vec<f64>, count: usize) -> Result<Series, ExactError> {
        self.blocks.solve(rhs, count)
    }
}

impl Equations for System {
    fn degree(&self) -> usize {
        self.geometry.degree
    }

    fn on_sphere(
        &mut self,
        n: usize,
        equation: usize,
        field: Field,
        weights: impl Fn(&Geometry) -> Stencil,
    ) {
        let weights = weights(&self.geometry);
        self.blocks.add(n, equation, (field, field.index), weights);
    }

    fn in_space(
        &mut self,
        n: usize,
        equation: usize,
        parity: Parity,
        field: Field,
        weights: Stencil,
    ) {
        let own = self.envelopes.at(parity, n);
        let grow = self.geometry.alpha.exp();
        let ratio = |degree: usize| own / self.envelopes.at(field.envelope, degree);
        let above = (n + 1).min(self.geometry.degree);
        let weights = Stencil {
            below: weights.below * ratio(n.saturating_sub(1)) * grow,
            at: weights.at * ratio(n),
            above: weights.above * ratio(above) / grow,
        };
        self.blocks.add(n, equation, (field, field.index), weights);
    }

    fn absent(&mut self, n: usize, equation: usize, field: Field) {
        self.blocks.absent(n, equation, field.index);
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
        self.column((field, field.index), case)
    }

    /// The same of one of the unknowns of a field.
    pub fn column(
        &self,
        (field, column): (Field, usize),
        case: usize,
    ) -> impl Iterator<Item = f64> + '_ {
        self.values
            .chunks_exact(self.fields * self.count)
            .enumerate()
            .map(move |(n, block)| block[column * self.count + case] * field.scale(n))
    }

    /// The last one of them.
    pub fn last(&self, (field, column): (Field, usize), case: usize) -> f64 {
        let size = self.fields * self.count;
        let block = self.values.chunks_exact(size).next_back();
        let degree = self.values.len() / size - 1;
        block.map_or(0.0, |block| block[column * self.count + case]) * field.scale(degree)
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
