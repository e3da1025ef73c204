//! The system of both spheres of an unlike pair: two unknowns for each field and degree.
//!
//! A field is a series in `f^c cosh(nu xi')/cosh(nu h) + f^s sinh(nu xi')/sinh(nu h)`, `nu = n + 1/2`: on sphere 1 it is
//! `f^c + f^s`, on sphere 2 `f^c - f^s`. Sphere 2 is seen in the mirror, as the upper one: the equations are
//! those of sphere 1 with its own `alpha`, and fields that the mirror turns round, those of the other envelope,
//! change sign. For like radii the system falls apart into the two parities.
//!
//! In space each equation holds for the factors of `exp(nu xi)` and of `exp(-nu xi)`, here for their sum and
//! difference. A neighbour of degree `n -+ 1` then brings its factors of `exp(+-nu xi')`, `(C +- S)/2`, times
//! `exp(+-delta)` or its inverse, `delta = (alpha_1 - alpha_2)/2`.

use super::geometry::Pair;
use super::tail::Tail;
use crate::ExactError;
use crate::geometry::{Geometry, Parity};
use crate::stencil::Stencil;
use crate::system::{Blocks, Envelopes, Equations, Field, Series};

/// The parity after which the fields of a pair are named: that of its `f^c`.
pub const NOMINAL: Parity = Parity::Even;

/// The two kinds of unknowns of a field, and the two rows of an equation.
const PARTS: [Parity; 2] = [Parity::Even, Parity::Odd];

fn place(index: usize, part: Parity) -> usize {
    2 * index + usize::from(part == Parity::Odd)
}

/// Whether the mirror turns a field round, and `d/dz` with it.
fn turned(field: Field) -> bool {
    field.envelope != NOMINAL
}

/// A system in assembly.
pub struct PairSystem {
    pair: Pair,
    blocks: Blocks,
    envelopes: Envelopes,
    tail: Option<Tail>,
}

impl PairSystem {
    /// An empty system of `fields` fields, with what follows beyond the highest degree.
    pub fn new(pair: Pair, fields: usize, tail: Option<Tail>) -> Self {
        Self {
            pair,
            blocks: Blocks::new(2 * fields, pair.degree()),
            envelopes: Envelopes::new(pair.half_width(), pair.degree()),
            tail,
        }
    }

    fn add(&mut self, n: usize, row: usize, (field, part): (Field, Parity), weights: Stencil) {
        let column = (field, place(field.index, part));
        self.blocks.add(n, row, column, weights);
        let Some(tail) = self.tail.as_ref().filter(|_| n == self.pair.degree()) else {
            return;
        };
        // The next degree is singular within one sphere alone: half of what that sphere sees is `f^c`, half `f^s`.
        let above = 0.5 * weights.above * seen(tail.sphere, field, part);
        for (index, other) in tail.fields.into_iter().enumerate() {
            for part in PARTS {
                let weight =
                    above * tail.next[(field.index, index)] * seen(tail.sphere, other, part);
                let column = (other, place(other.index, part));
                self.blocks.add(n, row, column, Stencil::diagonal(weight));
            }
        }
    }

    /// Solves for right-hand sides that are the rows of each sphere, by degree and equation, sphere 2 as seen in the mirror.
    pub fn solve(self, cases: &[[Vec<f64>; 2]]) -> Result<PairSeries, ExactError> {
        let count = cases.len();
        let rows = cases.first().map_or(0, |spheres| spheres[0].len());
        let mut rhs = vec![0.0; 2 * rows * count];
        for (case, spheres) in cases.iter().enumerate() {
            for (part, values) in PARTS.into_iter().zip(spheres) {
                for (index, value) in values.iter().enumerate() {
                    rhs[place(index, part) * count + case] = *value;
                }
            }
        }
        Ok(PairSeries {
            pair: self.pair,
            envelopes: self.envelopes,
            tail: self.tail,
            series: self.blocks.solve(rhs, count)?,
        })
    }
}

impl Equations for PairSystem {
    fn degree(&self) -> usize {
        self.pair.degree()
    }

    fn on_sphere(
        &mut self,
        n: usize,
        equation: usize,
        field: Field,
        weights: impl Fn(&Geometry) -> Stencil,
    ) {
        for (sphere, row) in [0, 1].into_iter().zip(PARTS) {
            let weights = weights(&self.pair.sphere_at(sphere, n));
            for part in PARTS {
                let weights = weights.scaled(seen(sphere, field, part));
                self.add(n, place(equation, row), (field, part), weights);
            }
        }
    }

    fn in_space(
        &mut self,
        n: usize,
        equation: usize,
        _parity: Parity,
        field: Field,
        weights: Stencil,
    ) {
        let (sinh, cosh) = self.pair.shift_at(n);
        let grow = self.pair.half_width().exp();
        let last = self.pair.degree();
        for row in PARTS {
            for part in PARTS {
                // The sum takes cosh(delta) C + sinh(delta) S of a neighbour below, the difference the other
                // way round; of what the mirror turns round it is the difference that is the sum.
                let same = (row == part) != turned(field);
                let (across, at) = if same { (cosh, 1.0) } else { (sinh, 0.0) };
                let sign = if same { 1.0 } else { -1.0 };
                let ratio = |degree: usize| {
                    self.envelopes.at(row, n) / self.envelopes.at(part, degree.min(last))
                };
                let weights = Stencil {
                    below: weights.below * across * ratio(n.saturating_sub(1)) * grow,
                    at: weights.at * at * ratio(n),
                    above: weights.above * sign * across * ratio(n + 1) / grow,
                };
                self.add(n, place(equation, row), (field, part), weights);
            }
        }
    }

    fn absent(&mut self, n: usize, equation: usize, field: Field) {
        for part in PARTS {
            self.blocks
                .absent(n, place(equation, part), place(field.index, part));
        }
    }
}

/// Sign of `f^c` or `f^s` in what a sphere sees, itself above: sphere 2 looks into the mirror.
fn seen(sphere: usize, field: Field, part: Parity) -> f64 {
    if sphere == 0 || turned(field) == (part == Parity::Odd) {
        1.0
    } else {
        -1.0
    }
}

/// A sum over the part of a field that is singular within a sphere, which carries force and torque.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Charge {
    /// `Σ f_n`.
    Force,
    /// `Σ f_n [(2n+1) sinh(alpha) - cosh(alpha)]`.
    Torque,
    /// `Σ n (n+1) f_n`.
    Dipole,
}

impl Charge {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Force, Self::Torque, Self::Dipole];

    /// The factor of `f_n`.
    pub fn weight(self, sphere: &Geometry, n: f64) -> f64 {
        match self {
            Self::Force => 1.0,
            // Without its cancellation far apart.
            Self::Torque => 2.0 * n * sphere.sinh - (-sphere.alpha).exp(),
            Self::Dipole => n * (n + 1.0),
        }
    }
}

/// Solved series of all fields, for all right-hand sides.
pub struct PairSeries {
    pair: Pair,
    envelopes: Envelopes,
    tail: Option<Tail>,
    series: Series,
}

impl PairSeries {
    /// Number of right-hand sides.
    pub fn cases(&self) -> usize {
        self.series.count()
    }

    /// The charge of a field within `sphere`, as that sees it, itself above.
    pub fn charge(&self, sphere: usize, field: Field, case: usize, charge: Charge) -> f64 {
        let geometry = &self.pair.spheres[sphere];
        let sum = self.charge_by(sphere, field, case, |n| charge.weight(geometry, n));
        match &self.tail {
            Some(tail) if tail.sphere == sphere => sum + self.beyond(tail, field, case, charge),
            _ => sum,
        }
    }

    /// `Σ_n weight(n) f_n^+` of the degrees kept, where `f_n^+` is the factor of `exp(+(n + 1/2) xi)` in what the sphere sees: the part of the
    /// field that is singular within it.
    pub fn charge_by(
        &self,
        sphere: usize,
        field: Field,
        case: usize,
        weight: impl Fn(f64) -> f64,
    ) -> f64 {
        let alpha = self.pair.spheres[sphere].alpha;
        let singular = self.singular(sphere, field, case).enumerate();
        let terms = singular.skip(field.order).map(|(n, value)| {
            let n = n as f64;
            weight(n) * value * (-(n + 0.5) * alpha).exp()
        });
        terms.sum()
    }

    /// The part of a field that is singular within a sphere, as its values on that sphere, degree by degree, as that sphere sees them.
    pub fn singular(
        &self,
        sphere: usize,
        field: Field,
        case: usize,
    ) -> impl Iterator<Item = f64> + '_ {
        let [even, odd] =
            PARTS.map(|part| self.series.column((field, place(field.index, part)), case));
        let [c, s] = PARTS.map(|part| seen(sphere, field, part));
        even.zip(odd).enumerate().map(move |(n, (even, odd))| {
            c * even / self.envelopes.at(Parity::Even, n)
                + s * odd / self.envelopes.at(Parity::Odd, n)
        })
    }

    /// A field on a sphere and its derivative by `xi`, degree by degree, as that sphere sees itself above.
    pub fn jet(
        &self,
        sphere: usize,
        field: Field,
        case: usize,
    ) -> impl Iterator<Item = (f64, f64)> + '_ {
        let [even, odd] =
            PARTS.map(|part| self.series.column((field, place(field.index, part)), case));
        let [c, s] = PARTS.map(|part| seen(sphere, field, part));
        even.zip(odd).enumerate().map(move |(n, (even, odd))| {
            let tanh = self.envelopes.at(Parity::Odd, n) / self.envelopes.at(Parity::Even, n);
            let (even, odd) = (c * even, s * odd);
            let slope = (n as f64 + 0.5) * (even * tanh + odd / tanh);
            (even + odd, slope)
        })
    }

    /// What the degrees beyond the highest bring.
    fn beyond(&self, tail: &Tail, field: Field, case: usize, charge: Charge) -> f64 {
        let values = tail.fields.map(|other| {
            let parts = PARTS.map(|part| {
                let last = (self.series).last((other, place(other.index, part)), case);
                seen(tail.sphere, other, part) * last
            });
            parts[0] + parts[1]
        });
        let weights = tail.charge(field, charge);
        weights.iter().zip(values).map(|(w, v)| w * v).sum()
    }
}
