//! Flow of an azimuthal order `m` from 1 on: spheres that move, turn or squirm across their line of centres.
//!
//! With lengths in units of `c` and `t = x`,
//!
//! ```text
//! p = q cos(m phi),  u_z = (z q/2 + w) cos(m phi),
//! u_rho = (rho q + b + a)/2 cos(m phi),  u_phi = (b - a)/2 sin(m phi),
//! L_m q = L_m w = L_(m-1) a = L_(m+1) b = 0,
//! 3 q + r dq/dr + (d/drho - (m-1)/rho) a + (d/drho + (m+1)/rho) b + 2 dw/dz = 0
//! ```
//!
//! Forces and torques are of order 1 alone; the higher orders, which have none, belong to the flow and to its rate of work.
//!
//! (Dean & O'Neill, *Mathematika* 10 (1963) 13; O'Neill, ibid. 11 (1964) 67; Goldman, Cox & Brenner,
//! *Chem. Eng. Sci.* 21 (1966) 1151). Force on the fluid `4 pi sqrt(2) c Σ a_n^+` along `t`, torque
//! about the sphere's centre `4 pi sqrt(2) c Σ a_n^+ [(2n+1) c - cosh(alpha)]` along `y`.

use std::f64::consts::SQRT_2;

use scene::LoadSet;

use crate::ExactError;
use crate::geometry::{Geometry, Parity};
use crate::stencil::{
    Stencil, axial_derivative, divergence_of_position_times, in_next_derivative,
    lowering_derivative, raising_derivative, sine_squared_lowered, times_denominator,
};
use crate::surface::{LegendreSeries, Surface, combine};
use crate::system::{Equations, Field, Series, System};

const CONTINUITY: usize = 0;
/// The equation of the axial velocity on the sphere.
pub const AXIAL: usize = 1;
/// That of `u_rho - u_phi`.
pub const DIFFERENCE: usize = 2;
/// That of `u_rho + u_phi`.
pub const SUM: usize = 3;
/// Number of fields, and of equations of each degree.
pub const FIELDS: usize = 4;

/// The case of rigid translation.
pub const TRANSLATION: usize = 0;
/// The case of rigid rotation.
pub const ROTATION: usize = 1;

/// The fields of a solution.
#[derive(Clone, Copy, Debug)]
pub struct Fields {
    /// `q`.
    pub pressure: Field,
    /// `w`.
    pub axial: Field,
    /// `a`, which carries the mean of the velocity along `t`.
    pub mean: Field,
    /// `b`.
    pub second: Field,
}

impl Fields {
    /// In the order of their indices.
    pub fn all(&self) -> [Field; FIELDS] {
        [self.axial, self.pressure, self.mean, self.second]
    }

    /// Of a flow of one azimuthal order, from 1 on, and of one parity.
    pub fn new(order: usize, parity: Parity) -> Self {
        let field = |index, order, envelope| Field {
            index,
            order,
            envelope,
        };
        Self {
            axial: field(0, order, parity.flipped()),
            pressure: field(1, order, parity),
            mean: field(2, order - 1, parity),
            second: field(3, order + 1, parity),
        }
    }

    /// The azimuthal order of the flow.
    pub fn order(&self) -> usize {
        self.pressure.order
    }
}

/// The flows of one parity: translation along `t`, rotation along `d x t`, the squirming modes 1, 2, …,
/// and the swirl modes 1, 2, … with `d x p_t = t`.
pub struct Transverse {
    geometry: Geometry,
    modes: usize,
    /// The fields.
    pub fields: Fields,
    /// Their coefficients.
    pub series: Series,
}

/// Boundary velocity times `S^(1/2)`: `u_z` in `sin(eta) P_n'`, `u_rho - u_phi` in `P_n`,
/// `u_rho + u_phi` in `sin^2(eta) P_n''`.
pub struct Boundary {
    /// `u_z`.
    pub axial: Vec<f64>,
    /// `u_rho - u_phi`.
    pub difference: Vec<f64>,
    /// `u_rho + u_phi`.
    pub sum: Vec<f64>,
}

impl Transverse {
    /// Solves for translation, rotation and the slip modes of `set`.
    pub fn solve(geometry: Geometry, parity: Parity, set: LoadSet) -> Result<Self, ExactError> {
        let fields = Fields::new(1, parity);
        let cases = boundary_velocities(geometry, set);
        let mut system = System::new(geometry, FIELDS);
        assemble(&mut system, parity, &fields);
        let series = system.solve(right_hand_sides(geometry, &cases), cases.len())?;
        Ok(Self {
            geometry,
            modes: set.modes,
            fields,
            series,
        })
    }

    /// The case of the squirming mode `n`.
    pub fn squirming(&self, n: usize) -> usize {
        ROTATION + n
    }

    /// The case of the swirl mode `n`.
    pub fn swirl(&self, n: usize) -> usize {
        ROTATION + self.modes + n
    }

    /// Force of the fluid on sphere 1 along `t`, over `pi`.
    pub fn force(&self, case: usize) -> f64 {
        -4.0 * SQRT_2 * self.geometry.sinh * self.mean_sum(case, |_| 1.0)
    }

    /// Torque of the fluid on sphere 1 about its centre along `d x t = -y`, over `pi`.
    pub fn torque(&self, case: usize) -> f64 {
        let Geometry { alpha, sinh, .. } = self.geometry;
        // (2n+1) sinh(alpha) - cosh(alpha), without its cancellation far apart.
        let arm = |n: f64| 2.0 * n * sinh - (-alpha).exp();
        4.0 * SQRT_2 * sinh * self.mean_sum(case, arm)
    }

    /// The same torque from the axial field: equal up to rounding and truncation.
    pub fn torque_by_axial_field(&self, case: usize) -> f64 {
        let Geometry { sinh, cosh, .. } = self.geometry;
        let dipole = self
            .series
            .singular_sum(&self.geometry, self.fields.axial, case, |n| n * (n + 1.0));
        -8.0 * SQRT_2 * sinh * sinh * dipole + cosh * self.force(case)
    }

    fn mean_sum(&self, case: usize, weight: impl Fn(f64) -> f64) -> f64 {
        self.series
            .singular_sum(&self.geometry, self.fields.mean, case, weight)
    }
}

/// Writes down the equations of one parity.
pub fn assemble(system: &mut impl Equations, parity: Parity, fields: &Fields) {
    for n in 0..=system.degree() {
        assemble_degree(system, n, parity, fields);
    }
}

/// Those of one degree.
pub fn assemble_degree(system: &mut impl Equations, n: usize, parity: Parity, fields: &Fields) {
    let m = fields.order();
    if n < m {
        system.absent(n, CONTINUITY, fields.pressure);
        system.absent(n, AXIAL, fields.axial);
    } else {
        continuity(system, n, parity, fields);
        axial_velocity(system, n, fields);
    }
    if n + 1 < m {
        system.absent(n, DIFFERENCE, fields.mean);
    } else {
        velocity_difference(system, n, fields);
    }
    if n < m + 1 {
        system.absent(n, SUM, fields.second);
    } else {
        velocity_sum(system, n, fields);
    }
}

fn continuity(system: &mut impl Equations, n: usize, parity: Parity, fields: &Fields) {
    let m = fields.order();
    for (field, weights) in [
        (fields.pressure, divergence_of_position_times(n, m)),
        (fields.mean, raising_derivative()),
        (fields.second, lowering_derivative(n, m)),
        (fields.axial, axial_derivative(n, m).scaled(2.0)),
    ] {
        system.in_space(n, CONTINUITY, parity, field, weights);
    }
}

fn axial_velocity(system: &mut impl Equations, n: usize, fields: &Fields) {
    let m = fields.order();
    system.on_sphere(n, AXIAL, fields.pressure, |sphere| {
        Stencil::diagonal(0.5 * sphere.sinh)
    });
    system.on_sphere(n, AXIAL, fields.axial, |sphere| {
        times_denominator(n, m, sphere.cosh)
    });
}

/// `u_rho - u_phi = rho q/2 + a`.
fn velocity_difference(system: &mut impl Equations, n: usize, fields: &Fields) {
    let m = fields.order();
    system.on_sphere(n, DIFFERENCE, fields.mean, |sphere| {
        times_denominator(n, m - 1, sphere.cosh)
    });
    system.on_sphere(n, DIFFERENCE, fields.pressure, |_| {
        sine_squared_lowered(n, m).scaled(0.5)
    });
}

/// `u_rho + u_phi = rho q/2 + b`.
fn velocity_sum(system: &mut impl Equations, n: usize, fields: &Fields) {
    let m = fields.order();
    system.on_sphere(n, SUM, fields.second, |sphere| {
        times_denominator(n, m + 1, sphere.cosh)
    });
    system.on_sphere(n, SUM, fields.pressure, |_| {
        in_next_derivative(n).scaled(0.5)
    });
}

/// Legendre series of the three orders that a boundary velocity of order `m` needs.
pub struct Basis {
    order: usize,
    lower: Surface,
    same: Surface,
    upper: Surface,
    lower_series: LegendreSeries,
    same_series: LegendreSeries,
    upper_series: LegendreSeries,
}

impl Basis {
    /// For the slip modes 1 to `modes` in the azimuthal order `order`, from 1 on.
    pub fn new(geometry: Geometry, order: usize, modes: usize) -> Self {
        let [lower, same, upper] = [order - 1, order, order + 1].map(|m| Surface::new(geometry, m));
        Self {
            order,
            lower_series: lower.legendre(modes, order + 1),
            same_series: same.legendre(modes, order + 1),
            upper_series: upper.legendre(modes, order + 1),
            lower,
            same,
            upper,
        }
    }

    /// `P_k^(m-1)`, `P_k^(m)` and `P_k^(m+1)`, of which the slip is made, in the order of the series that needs them.
    fn lower(&self, derivative: usize, k: usize) -> &[f64] {
        &self.lower_series.derivative(derivative)[k]
    }

    fn same(&self, derivative: usize, k: usize) -> &[f64] {
        &self.same_series.derivative(derivative)[k]
    }

    fn upper(&self, derivative: usize, k: usize) -> &[f64] {
        &self.upper_series.derivative(derivative)[k]
    }

    /// Translation along `t`, of order 1.
    pub fn translation(&self) -> Boundary {
        let zero = vec![0.0; self.same(0, 0).len()];
        Boundary {
            axial: zero.clone(),
            difference: times(2.0, self.lower(0, 0)),
            sum: zero,
        }
    }

    /// Rotation `(d x t) x n`, of order 1, with `d = -z` and `t = x`.
    pub fn rotation(&self) -> Boundary {
        Boundary {
            axial: self.same(0, 0).to_vec(),
            difference: times(2.0, self.lower(0, 1)),
            sum: vec![0.0; self.same(0, 0).len()],
        }
    }

    /// `-2/(k(k+1)) grad_s [P_k^(m)(x) rho^m cos(m phi)]`, with Legendre's equation used to shorten it. With
    /// `f = -2 P_k^(m)/(k(k+1))`, `f'` its derivative and `g = 2 (k-m+1)(k+m)/(k(k+1)) P_k^(m-1)`,
    /// `u_z = -rho^m (m x f + g)`, `u_rho - u_phi = rho^(m-1) [m f (1 - x^2) - x g]`,
    /// `u_rho + u_phi = -rho^(m+1) (x f' + m f)`.
    pub fn slip(&self, k: usize) -> Boundary {
        let m = self.order;
        let (weight, inner) = self.weights(k);
        let axial = combine(
            -weight,
            &self.same.times_cosine(self.same(m, k)),
            -inner,
            self.same(m - 1, k),
        );
        let slope = self.lower(m, k);
        // m x f + g, of which x times is taken.
        let lower = combine(
            weight,
            &self.lower.times_cosine(slope),
            inner,
            self.lower(m - 1, k),
        );
        let difference = combine(weight, slope, -1.0, &self.lower.times_cosine(&lower));
        let sum = combine(
            -weight / m as f64,
            &self.upper.times_cosine(self.upper(m + 1, k)),
            -weight,
            self.upper(m, k),
        );
        Boundary {
            axial,
            difference,
            sum,
        }
    }

    /// The slip of a squirming mode whose phase is a quarter period further, turned by a quarter about the normal: of order 1
    /// `-2/(k(k+1)) n x grad_s [P_k'(x) n.y]`. With `f` and `g` as in [`Self::slip`],
    /// `u_z = m rho^m f`, `u_rho - u_phi = -rho^(m-1) g`, `u_rho + u_phi = rho^(m+1) f'`.
    pub fn swirl(&self, k: usize) -> Boundary {
        let m = self.order;
        let (weight, inner) = self.weights(k);
        Boundary {
            axial: times(weight, self.same(m, k)),
            difference: times(-inner, self.lower(m - 1, k)),
            sum: times(weight / m as f64, self.upper(m + 1, k)),
        }
    }

    /// `-2 m/(k(k+1))` and `2 (k-m+1)(k+m)/(k(k+1))`.
    fn weights(&self, k: usize) -> (f64, f64) {
        let among = (k * (k + 1)) as f64;
        let inner = ((k + 1 - self.order) * (k + self.order)) as f64;
        (-2.0 / among * self.order as f64, 2.0 * (inner / among))
    }
}

fn times(factor: f64, series: &[f64]) -> Vec<f64> {
    series.iter().map(|v| factor * v).collect()
}

/// Those of translation, rotation, squirming modes and swirl modes.
pub fn boundary_velocities(geometry: Geometry, set: LoadSet) -> Vec<Boundary> {
    let basis = Basis::new(geometry, 1, set.modes.max(set.swirl));
    [basis.translation(), basis.rotation()]
        .into_iter()
        .chain((1..=set.modes).map(|k| basis.slip(k)))
        .chain((1..=set.swirl).map(|k| basis.swirl(k)))
        .collect()
}

fn right_hand_sides(geometry: Geometry, cases: &[Boundary]) -> Vec<f64> {
    let mut rhs = Vec::with_capacity(FIELDS * (geometry.degree + 1) * cases.len());
    for n in 0..=geometry.degree {
        rhs.extend(cases.iter().map(|_| 0.0));
        rhs.extend(cases.iter().map(|c| c.axial[n]));
        rhs.extend(cases.iter().map(|c| c.difference[n]));
        rhs.extend(cases.iter().map(|c| c.sum[n]));
    }
    rhs
}
