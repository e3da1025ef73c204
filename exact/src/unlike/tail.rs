//! The degrees beyond the highest that both spheres need.
//!
//! Across the line of centres the image of a small sphere in a large one is a line of singularities that reaches to the centre of the
//! large one (C. W. Oseen, *Hydrodynamik*, 1927), so that its series fall off as `exp(-2 nu alpha)` with the small `alpha` of the
//! large sphere, where all else falls off as `exp(-2 nu (alpha_1 + alpha_2))`. Beyond the degree `N` at which the small sphere and the data have
//! gone, the series are those of the large sphere alone: `v_n` its values on it, with one singular part and no data,
//!
//! ```text
//! A_n v_(n-1) + B_n v_n + C_n v_(n+1) = 0,   v_n = M_(n-1) v_(n-1),   M_(n-1) = -(B_n + C_n M_n)^-1 A_n,
//! ```
//!
//! from zero far beyond down to `M_N`, and the charges there are linear in `v_N` as well. This costs a small solve a degree, and no
//! storage.

use nalgebra::{Matrix4, RowVector4};

use super::geometry::Pair;
use super::system::{Charge, NOMINAL};
use crate::geometry::{Geometry, Parity};
use crate::stencil::Stencil;
use crate::system::{Equations, Field};
use crate::transverse::{self, FIELDS, Fields};

/// `exp(-2 nu alpha)` at this many e-folds of `exp(-nu alpha)` is rounding, with what grows in front of it.
const E_FOLDS: f64 = 24.0;

/// What follows beyond the highest degree of a pair, for the larger sphere.
pub struct Tail {
    /// The larger sphere.
    pub sphere: usize,
    /// All fields.
    pub fields: [Field; FIELDS],
    /// `M_N`: values of the next degree by those of the highest one.
    pub next: Matrix4<f64>,
    charges: [[RowVector4<f64>; 2]; Charge::ALL.len()],
}

/// The fields that carry charges: [`Fields::axial`] and [`Fields::mean`].
const CHARGED: [fn(&Fields) -> Field; 2] = [|fields| fields.axial, |fields| fields.mean];

impl Tail {
    /// Of the transverse flows of a pair, with `factor` times the usual number of terms; none if the larger sphere needs no more terms
    /// than there are.
    pub fn of(pair: &Pair, factor: f64) -> Option<Self> {
        let larger = usize::from(pair.spheres[1].alpha < pair.spheres[0].alpha);
        let sphere = pair.spheres[larger];
        let highest = (factor * E_FOLDS / sphere.alpha).ceil() as usize;
        if highest <= pair.degree() {
            return None;
        }
        let fields = Fields::new(1, NOMINAL);
        let mut tail = Self {
            sphere: larger,
            fields: fields.all(),
            next: Matrix4::zeros(),
            charges: Default::default(),
        };
        for n in (pair.degree() + 1..=highest).rev() {
            tail.take_in(&pair.sphere_at(larger, n), n, &fields)?;
        }
        Some(tail)
    }

    /// From what follows after degree `n` to what follows after `n - 1`.
    fn take_in(&mut self, sphere: &Geometry, n: usize, fields: &Fields) -> Option<()> {
        let mut rows = Rows::new(*sphere);
        transverse::assemble_degree(&mut rows, n, NOMINAL, fields);
        self.next = -(rows.at + rows.above * self.next).lu().solve(&rows.below)?;
        let decay = (-(n as f64 + 0.5) * sphere.alpha).exp();
        for (kind, charges) in Charge::ALL.into_iter().zip(&mut self.charges) {
            let weight = kind.weight(sphere, n as f64) * decay;
            for (field, sums) in CHARGED.into_iter().zip(charges) {
                sums[field(fields).index] += weight;
                *sums *= self.next;
            }
        }
        Some(())
    }

    /// The charge of a field beyond, by the values of all fields of the highest degree.
    pub fn charge(&self, field: Field, charge: Charge) -> RowVector4<f64> {
        let kind = Charge::ALL.iter().position(|of| *of == charge);
        let fields = Fields::new(1, NOMINAL);
        let place = CHARGED
            .iter()
            .position(|of| of(&fields).index == field.index);
        match (kind, place) {
            (Some(kind), Some(place)) => self.charges[kind][place],
            _ => RowVector4::zeros(),
        }
    }
}

/// The equations of one degree about a lone sphere, above, with the part of each field that is singular within it.
struct Rows {
    sphere: Geometry,
    below: Matrix4<f64>,
    at: Matrix4<f64>,
    above: Matrix4<f64>,
}

impl Rows {
    fn new(sphere: Geometry) -> Self {
        Self {
            sphere,
            below: Matrix4::zeros(),
            at: Matrix4::zeros(),
            above: Matrix4::zeros(),
        }
    }

    fn add(&mut self, equation: usize, field: Field, weights: Stencil) {
        let place = (equation, field.index);
        self.below[place] += weights.below;
        self.at[place] += weights.at;
        self.above[place] += weights.above;
    }
}

impl Equations for Rows {
    fn degree(&self) -> usize {
        self.sphere.degree
    }

    fn on_sphere(
        &mut self,
        _: usize,
        equation: usize,
        field: Field,
        weights: impl Fn(&Geometry) -> Stencil,
    ) {
        let weights = weights(&self.sphere);
        self.add(equation, field, weights);
    }

    fn in_space(&mut self, _: usize, equation: usize, _: Parity, field: Field, weights: Stencil) {
        // Values on the sphere are the factors of the exponential times what it is there.
        let grow = self.sphere.alpha.exp();
        let weights = Stencil {
            below: weights.below * grow,
            at: weights.at,
            above: weights.above / grow,
        };
        self.add(equation, field, weights);
    }

    fn absent(&mut self, _: usize, _: usize, _: Field) {}
}
