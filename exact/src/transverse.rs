//! Flow of azimuthal order 1: spheres that move, turn or squirm across their line of centres.
//!
//! With lengths in units of `c` and `t = x`,
//!
//! ```text
//! p = q cos(phi),  u_z = (z q/2 + w) cos(phi),
//! u_rho = (rho q + b + a)/2 cos(phi),  u_phi = (b - a)/2 sin(phi),
//! L_1 q = L_1 w = L_0 a = L_2 b = 0,
//! 3 q + r dq/dr + da/drho + (d/drho + 2/rho) b + 2 dw/dz = 0
//! ```
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

    /// Of a flow of one parity.
    pub fn new(parity: Parity) -> Self {
        let field = |index, order, envelope| Field {
            index,
            order,
            envelope,
        };
        Self {
            axial: field(0, 1, parity.flipped()),
            pressure: field(1, 1, parity),
            mean: field(2, 0, parity),
            second: field(3, 2, parity),
        }
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
        let fields = Fields::new(parity);
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
    if n == 0 {
        system.absent(n, CONTINUITY, fields.pressure);
        system.absent(n, AXIAL, fields.axial);
    } else {
        continuity(system, n, parity, fields);
        axial_velocity(system, n, fields);
    }
    velocity_difference(system, n, fields);
    if n < 2 {
        system.absent(n, SUM, fields.second);
    } else {
        velocity_sum(system, n, fields);
    }
}

fn continuity(system: &mut impl Equations, n: usize, parity: Parity, fields: &Fields) {
    for (field, weights) in [
        (fields.pressure, divergence_of_position_times(n, 1)),
        (fields.mean, raising_derivative()),
        (fields.second, lowering_derivative(n, 1)),
        (fields.axial, axial_derivative(n, 1).scaled(2.0)),
    ] {
        system.in_space(n, CONTINUITY, parity, field, weights);
    }
}

fn axial_velocity(system: &mut impl Equations, n: usize, fields: &Fields) {
    system.on_sphere(n, AXIAL, fields.pressure, |sphere| {
        Stencil::diagonal(0.5 * sphere.sinh)
    });
    system.on_sphere(n, AXIAL, fields.axial, |sphere| {
        times_denominator(n, 1, sphere.cosh)
    });
}

/// `u_rho - u_phi = rho q/2 + a`.
fn velocity_difference(system: &mut impl Equations, n: usize, fields: &Fields) {
    system.on_sphere(n, DIFFERENCE, fields.mean, |sphere| {
        times_denominator(n, 0, sphere.cosh)
    });
    system.on_sphere(n, DIFFERENCE, fields.pressure, |_| {
        sine_squared_lowered(n).scaled(0.5)
    });
}

/// `u_rho + u_phi = rho q/2 + b`.
fn velocity_sum(system: &mut impl Equations, n: usize, fields: &Fields) {
    system.on_sphere(n, SUM, fields.second, |sphere| {
        times_denominator(n, 2, sphere.cosh)
    });
    system.on_sphere(n, SUM, fields.pressure, |_| {
        in_next_derivative(n).scaled(0.5)
    });
}

/// Legendre series of the three orders that a transverse boundary velocity needs.
struct Basis {
    plain: Surface,
    once: Surface,
    twice: Surface,
    on_axis: LegendreSeries,
    off_axis: LegendreSeries,
    doubly: LegendreSeries,
}

impl Basis {
    fn new(geometry: Geometry, modes: usize) -> Self {
        let [plain, once, twice] = [0, 1, 2].map(|order| Surface::new(geometry, order));
        Self {
            on_axis: plain.legendre(modes),
            off_axis: once.legendre(modes),
            doubly: twice.legendre(modes),
            plain,
            once,
            twice,
        }
    }
}

/// Those of translation, rotation, squirming modes and swirl modes.
pub fn boundary_velocities(geometry: Geometry, set: LoadSet) -> Vec<Boundary> {
    let basis = Basis::new(geometry, set.modes.max(set.swirl));
    let zero = vec![0.0; geometry.degree + 1];
    let double = |series: &[f64]| series.iter().map(|v| 2.0 * v).collect();
    let translation = Boundary {
        axial: zero.clone(),
        difference: double(&basis.on_axis.value[0]),
        sum: zero.clone(),
    };
    // (d x t) x n, with d = -z and t = x.
    let rotation = Boundary {
        axial: basis.off_axis.value[0].clone(),
        difference: double(&basis.on_axis.value[1]),
        sum: zero,
    };
    let slip = (1..=set.modes).map(|k| slip(&basis, k));
    let swirl = (1..=set.swirl).map(|k| swirl(&basis, k));
    [translation, rotation]
        .into_iter()
        .chain(slip)
        .chain(swirl)
        .collect()
}

/// `-2/(k(k+1)) grad_s [P_k'(x) n.t]`, with Legendre's equation used to shorten it. With
/// `f = -2 P_k'/(k(k+1))` and `f'` its derivative,
/// `u_z = -rho (x f + 2 P_k)`, `u_rho - u_phi = f (1 - x^2) - 2 x P_k`,
/// `u_rho + u_phi = -rho^2 (x f' + f)`.
fn slip(basis: &Basis, k: usize) -> Boundary {
    let weight = -2.0 / (k * (k + 1)) as f64;
    let axial = combine(
        -weight,
        &basis.once.times_cosine(&basis.off_axis.first[k]),
        -2.0,
        &basis.off_axis.value[k],
    );
    let slope = &basis.on_axis.first[k];
    // x f + 2 P_k, of which x times is taken.
    let inner = combine(
        weight,
        &basis.plain.times_cosine(slope),
        2.0,
        &basis.on_axis.value[k],
    );
    let difference = combine(weight, slope, -1.0, &basis.plain.times_cosine(&inner));
    let sum = combine(
        -weight,
        &basis.twice.times_cosine(&basis.doubly.second[k]),
        -weight,
        &basis.doubly.first[k],
    );
    Boundary {
        axial,
        difference,
        sum,
    }
}

/// `-2/(k(k+1)) n x grad_s [P_k'(x) n.y]`: the slip of a squirming mode whose transverse heading is
/// along `y`, turned by a quarter about the normal. With `f` as in [`slip`],
/// `u_z = rho f`, `u_rho - u_phi = -2 P_k`, `u_rho + u_phi = rho^2 f'`.
fn swirl(basis: &Basis, k: usize) -> Boundary {
    let weight = -2.0 / (k * (k + 1)) as f64;
    let times = |factor: f64, series: &[f64]| series.iter().map(|v| factor * v).collect();
    Boundary {
        axial: times(weight, &basis.off_axis.first[k]),
        difference: times(-2.0, &basis.on_axis.value[k]),
        sum: times(weight, &basis.doubly.second[k]),
    }
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
