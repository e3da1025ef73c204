//! Axisymmetric flow without swirl: both spheres move or squirm along their line of centres.
//!
//! With lengths in units of `c` the flow is `u = x q/2 + h`, pressure `q` and `h` harmonic:
//!
//! ```text
//! u_z = z q/2 + w,  u_rho = rho q/2 + v,   L_0 q = L_0 w = L_1 v = 0,
//! 3 q + r dq/dr + 2 [dw/dz + (d/drho + 1/rho) v] = 0
//! ```
//!
//! the axisymmetric case of the solution of Lee & Leal, *J. Fluid Mech.* 98 (1980) 193. The drags
//! are those of Stimson & Jeffery, *Proc. R. Soc. A* 111 (1926) 110. Force on the fluid:
//! `8 pi sqrt(2) c Σ w_n^+`, the charge of the singular part of `h_z`.

use crate::ExactError;
use crate::geometry::{Geometry, Parity};
use crate::stencil::{
    Stencil, axial_derivative, divergence_of_position_times, in_next_derivative,
    lowering_derivative, times_denominator,
};
use crate::surface::{Surface, combine};
use crate::system::{Equations, Field, Series, System};

const CONTINUITY: usize = 0;
/// The equation of the axial velocity on the sphere.
pub const AXIAL: usize = 1;
/// That of the radial velocity.
pub const RADIAL: usize = 2;
/// Number of fields, and of equations of each degree.
pub const FIELDS: usize = 3;

/// The fields of a solution.
#[derive(Clone, Copy, Debug)]
pub struct Fields {
    /// `q`.
    pub pressure: Field,
    /// `w`.
    pub axial: Field,
    /// `v`.
    pub radial: Field,
}

impl Fields {
    /// In the order of their indices.
    pub fn all(&self) -> [Field; FIELDS] {
        [self.axial, self.pressure, self.radial]
    }

    /// Of a flow of one parity.
    pub fn new(parity: Parity) -> Self {
        let field = |index, order, envelope| Field {
            index,
            order,
            envelope,
        };
        Self {
            axial: field(0, 0, parity.flipped()),
            pressure: field(1, 0, parity),
            radial: field(2, 1, parity),
        }
    }
}

/// The flows of one parity: rigid translation along `d`, then the squirming modes 1, 2, ….
pub struct Axial {
    geometry: Geometry,
    /// The fields.
    pub fields: Fields,
    /// Their coefficients.
    pub series: Series,
}

/// Boundary velocity times `S^(1/2)`: `u_z` in `P_n`, `u_rho` in `sin(eta) P_n'`.
pub struct Boundary {
    axial: Vec<f64>,
    radial: Vec<f64>,
}

impl Boundary {
    /// The rows of the equations on the sphere, by degree and equation.
    pub fn rows(&self) -> Vec<f64> {
        let mut rows = vec![0.0; FIELDS * self.axial.len()];
        for (n, (axial, radial)) in self.axial.iter().zip(&self.radial).enumerate() {
            rows[FIELDS * n + AXIAL] = *axial;
            rows[FIELDS * n + RADIAL] = *radial;
        }
        rows
    }
}

impl Axial {
    /// Solves for translation and `modes` squirming modes.
    pub fn solve(geometry: Geometry, parity: Parity, modes: usize) -> Result<Self, ExactError> {
        let fields = Fields::new(parity);
        let cases = boundary_velocities(geometry, modes);
        let mut system = System::new(geometry, FIELDS);
        assemble(&mut system, parity, &fields);
        let series = system.solve(right_hand_sides(geometry, &cases), cases.len())?;
        Ok(Self {
            geometry,
            fields,
            series,
        })
    }

    /// Force of the fluid on sphere 1 along `d`, over `pi`.
    pub fn force(&self, case: usize) -> f64 {
        let charge = self
            .series
            .singular_sum(&self.geometry, self.fields.axial, case, |_| 1.0);
        8.0 * std::f64::consts::SQRT_2 * self.geometry.sinh * charge
    }
}

/// Writes down the equations of one parity.
pub fn assemble(system: &mut impl Equations, parity: Parity, fields: &Fields) {
    for n in 0..=system.degree() {
        continuity(system, n, parity, fields);
        system.on_sphere(n, AXIAL, fields.pressure, |sphere| {
            Stencil::diagonal(0.5 * sphere.sinh)
        });
        system.on_sphere(n, AXIAL, fields.axial, |sphere| {
            times_denominator(n, 0, sphere.cosh)
        });
        if n == 0 {
            system.absent(n, RADIAL, fields.radial);
            continue;
        }
        system.on_sphere(n, RADIAL, fields.radial, |sphere| {
            times_denominator(n, 1, sphere.cosh)
        });
        system.on_sphere(n, RADIAL, fields.pressure, |_| {
            in_next_derivative(n).scaled(0.5)
        });
    }
}

fn continuity(system: &mut impl Equations, n: usize, parity: Parity, fields: &Fields) {
    // Rows of equal size keep the pivoting sound.
    let scale = 1.0 / (n as f64 + 1.0);
    for (field, weights) in [
        (fields.pressure, divergence_of_position_times(n, 0)),
        (fields.radial, lowering_derivative(n, 0).scaled(2.0)),
        (fields.axial, axial_derivative(n, 0).scaled(2.0)),
    ] {
        system.in_space(n, CONTINUITY, parity, field, weights.scaled(scale));
    }
}

/// Translation with `u = d`, then the slip `W_k(x) (x n - d)`, `W_k = 2 P_k'/(k(k+1))`, of the modes 1 to `modes`, with `d = -z`.
pub fn boundary_velocities(geometry: Geometry, modes: usize) -> Vec<Boundary> {
    let on_axis = Surface::new(geometry, 0);
    let off_axis = Surface::new(geometry, 1);
    let (values, radial) = (on_axis.legendre(modes, 2), off_axis.legendre(modes, 2));
    let translation = Boundary {
        axial: values.derivative(0)[0].iter().map(|v| -v).collect(),
        radial: vec![0.0; geometry.degree + 1],
    };
    let slip = (1..=modes).map(|k| {
        let weight = 2.0 / (k * (k + 1)) as f64;
        let slope = &values.derivative(1)[k];
        let square = on_axis.times_cosine(&on_axis.times_cosine(slope));
        let tangent = off_axis.times_cosine(&radial.derivative(1)[k]);
        Boundary {
            axial: combine(weight, slope, -weight, &square),
            radial: tangent.iter().map(|v| weight * v).collect(),
        }
    });
    std::iter::once(translation).chain(slip).collect()
}

fn right_hand_sides(geometry: Geometry, cases: &[Boundary]) -> Vec<f64> {
    let mut rhs = Vec::with_capacity(FIELDS * (geometry.degree + 1) * cases.len());
    for n in 0..=geometry.degree {
        rhs.extend(cases.iter().map(|_| 0.0));
        rhs.extend(cases.iter().map(|c| c.axial[n]));
        rhs.extend(cases.iter().map(|c| c.radial[n]));
    }
    rhs
}
