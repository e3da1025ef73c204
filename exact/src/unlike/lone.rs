//! What the flow of a lone sphere leaves on the other one.
//!
//! The flow of a pair is that of the active sphere alone and an answer to it. The former is known in closed form
//! (Lamb's solution): `u = x q/2 + h` about the sphere's centre, for slip `∇_s Y_k` with
//!
//! ```text
//! q = k (2k-1) φ_k,  h = k/2 ∇φ_k + (2-k)/2 r^-(2k-1) ∇(r^k Y_k),  φ_k = r^-(k+1) Y_k,
//! ```
//!
//! `Y_k = -2/(k(k+1)) P_k(x)` for squirming along the line of centres, `-2/(k(k+1)) P_k'(x) n.t` across it. The components of `h` are
//! multipoles of degrees `k - 1` and `k + 1`. Swirl and rotation are multipoles of degree `k` themselves. The answer is at rest on the active
//! sphere and opposite to this on the other one; that falls off as fast as loads do, for large spheres as for small ones.

use scene::LoadSet;

use super::geometry::Pair;
use super::multipole::Multipoles;
use super::system::NOMINAL;
use crate::geometry::{Geometry, Parity};
use crate::stencil::Stencil;
use crate::system::{Equations, Field};
use crate::{axial, transverse};

/// A multipole and its weight.
pub type Term = (f64, usize);

/// Pressure, velocity along `d` and the other components of `h`, each with its order.
pub struct Lone {
    /// `q`.
    pub pressure: Vec<Term>,
    /// `h_d`.
    pub along: Vec<Term>,
    /// `h_rho` of order 1; or `h_rho - h_phi` of order 0 and `h_rho + h_phi` of order 2.
    pub others: [Vec<Term>; 2],
}

/// The axisymmetric flows: translation along `d`, then the squirming modes.
pub fn axial_flows(modes: usize) -> impl Iterator<Item = Lone> {
    std::iter::once(axial_translation()).chain((1..=modes).map(axial_slip))
}

/// The flows of azimuthal order 1: translation, rotation, squirming modes, swirl modes.
pub fn transverse_flows(set: LoadSet) -> impl Iterator<Item = Lone> {
    [translation(), rotation()]
        .into_iter()
        .chain((1..=set.modes).map(slip))
        .chain((1..=set.swirl).map(swirl))
}

/// Rows of the axisymmetric equations on the other sphere, as that sphere sees itself above, for [`axial_flows`].
pub fn axial_rows(pair: &Pair, active: usize, modes: usize) -> Vec<Vec<f64>> {
    let multipoles = Multipoles::new(pair, active, modes.max(1) + 1);
    let fields = axial::Fields::new(NOMINAL);
    let rows = axial_flows(modes).map(|lone| {
        let pressure = multipoles.combine(0, &lone.pressure);
        let along = multipoles.combine(0, &lone.along);
        let mut values = vec![Vec::new(); axial::FIELDS];
        values[fields.radial.index] = multipoles.combine(1, &lone.others[0]);
        from_the_plane(pair, active, pressure, along, |q, w| {
            values[fields.pressure.index] = q;
            values[fields.axial.index] = w;
        });
        put_into_axial_equations(pair, 1 - active, values)
    });
    rows.collect()
}

/// The same of the equations of azimuthal order 1, for [`transverse_flows`].
pub fn transverse_rows(pair: &Pair, active: usize, set: LoadSet) -> Vec<Vec<f64>> {
    let multipoles = Multipoles::new(pair, active, set.modes.max(set.swirl).max(1) + 1);
    let rows = transverse_flows(set).map(|lone| {
        let values = transverse_values(pair, active, &multipoles, &lone);
        put_into_equations(
            pair,
            1 - active,
            values,
            &transverse::Fields::new(1, NOMINAL),
        )
    });
    rows.collect()
}

/// The fields of translation and of rotation on the other sphere.
pub fn rigid_values(pair: &Pair, active: usize) -> [Vec<Vec<f64>>; 2] {
    let multipoles = Multipoles::new(pair, active, 2);
    [translation(), rotation()].map(|lone| transverse_values(pair, active, &multipoles, &lone))
}

fn transverse_values(
    pair: &Pair,
    active: usize,
    multipoles: &Multipoles,
    lone: &Lone,
) -> Vec<Vec<f64>> {
    let fields = transverse::Fields::new(1, NOMINAL);
    let pressure = multipoles.combine(1, &lone.pressure);
    let along = multipoles.combine(1, &lone.along);
    let mut values = vec![Vec::new(); transverse::FIELDS];
    values[fields.mean.index] = multipoles.combine(0, &lone.others[0]);
    values[fields.second.index] = multipoles.combine(2, &lone.others[1]);
    from_the_plane(pair, active, pressure, along, |q, w| {
        values[fields.pressure.index] = q;
        values[fields.axial.index] = w;
    });
    values
}

/// The rows of the transverse equations on a sphere, with the opposite sign, for fields with these values on it.
pub fn put_into_equations(
    pair: &Pair,
    sphere: usize,
    values: Vec<Vec<f64>>,
    fields: &transverse::Fields,
) -> Vec<f64> {
    let mut flow = Known::new(pair, sphere, values);
    transverse::assemble(&mut flow, NOMINAL, fields);
    flow.rows
}

/// The same of the axisymmetric equations.
pub fn put_into_axial_equations(pair: &Pair, sphere: usize, values: Vec<Vec<f64>>) -> Vec<f64> {
    let mut flow = Known::new(pair, sphere, values);
    axial::assemble(&mut flow, NOMINAL, &axial::Fields::new(NOMINAL));
    flow.rows
}

/// From pressure and `h_d`, lengths in units of the active sphere's radius from its centre, to `q` and `w` with lengths in units of `c`
/// from the plane `xi = 0`. The active sphere is below there, so that `d = z`.
fn from_the_plane(
    pair: &Pair,
    active: usize,
    mut pressure: Vec<f64>,
    mut along: Vec<f64>,
    give: impl FnOnce(Vec<f64>, Vec<f64>),
) {
    let Geometry { sinh, cosh, .. } = pair.spheres[active];
    for (w, q) in along.iter_mut().zip(&mut pressure) {
        *w += 0.5 * cosh * *q;
        *q *= sinh;
    }
    give(pressure, along);
}

fn axial_translation() -> Lone {
    Lone {
        pressure: vec![(1.5, 1)],
        along: vec![(0.75, 0), (-0.5, 2)],
        others: [vec![(-0.25, 2)], Vec::new()],
    }
}

fn axial_slip(mode: usize) -> Lone {
    let k = mode as f64;
    let inner = (2.0 - k) / (k + 1.0);
    Lone {
        pressure: vec![(-2.0 * (2.0 * k - 1.0) / (k + 1.0), mode)],
        along: vec![(1.0, mode + 1), (-inner, mode - 1)],
        others: [
            vec![(1.0 / (k + 1.0), mode + 1), (inner / k, mode - 1)],
            Vec::new(),
        ],
    }
}

fn translation() -> Lone {
    Lone {
        pressure: vec![(1.5, 1)],
        along: vec![(-0.25, 2)],
        others: [vec![(1.5, 0), (0.5, 2)], vec![(-0.25, 2)]],
    }
}

/// About `d x t`.
fn rotation() -> Lone {
    Lone {
        pressure: Vec::new(),
        along: vec![(-1.0, 1)],
        others: [vec![(2.0, 1)], Vec::new()],
    }
}

fn slip(mode: usize) -> Lone {
    let k = mode as f64;
    let weight = -2.0 / (k * (k + 1.0));
    let [outer, inner] = [0.5 * k, 0.5 * (2.0 - k)];
    Lone {
        pressure: vec![(weight * k * (2.0 * k - 1.0), mode)],
        along: vec![
            (-weight * outer * k, mode + 1),
            (weight * inner * (k + 1.0), mode - 1),
        ],
        others: [
            vec![(-2.0 * outer, mode + 1), (-2.0 * inner, mode - 1)],
            vec![(-weight * outer, mode + 1), (-weight * inner, mode - 1)],
        ],
    }
}

/// With `d x p_t = t`.
fn swirl(mode: usize) -> Lone {
    let k = mode as f64;
    let weight = -2.0 / (k * (k + 1.0));
    Lone {
        pressure: Vec::new(),
        along: vec![(-weight, mode)],
        others: [vec![(-2.0, mode)], vec![(weight, mode)]],
    }
}

/// The values of a known flow on a sphere, put into the equations there: what takes these down.
struct Known {
    pair: Pair,
    sphere: usize,
    values: Vec<Vec<f64>>,
    /// By degree, then equation.
    rows: Vec<f64>,
}

impl Known {
    fn new(pair: &Pair, sphere: usize, values: Vec<Vec<f64>>) -> Self {
        Self {
            pair: *pair,
            sphere,
            rows: vec![0.0; values.len() * (pair.degree() + 1)],
            values,
        }
    }
}

impl Equations for Known {
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
        let Stencil { below, at, above } = weights(&self.pair.sphere_at(self.sphere, n));
        let value = |degree: usize| self.values[field.index].get(degree).copied().unwrap_or(0.0);
        let mut sum = at * value(n) + above * value(n + 1);
        if n > 0 {
            sum += below * value(n - 1);
        }
        // The answer is opposite to it.
        self.rows[self.values.len() * n + equation] -= sum;
    }

    fn in_space(&mut self, _: usize, _: usize, _: Parity, _: Field, _: Stencil) {}

    fn absent(&mut self, _: usize, _: usize, _: Field) {}
}
