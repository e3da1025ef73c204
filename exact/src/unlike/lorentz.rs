//! Loads on the larger sphere from velocities on the smaller one, by the reciprocal theorem with the larger one's rigid motions.
//!
//! In a rigid motion `U` of the larger sphere, the smaller one being at rest, the traction on the smaller one is
//! `-p n + du/dn`. So a velocity `u` on it drives the force on the larger one (H. A. Lorentz; Stone & Samuel, *Phys. Rev. Lett.* 77
//! (1996) 4102), at rest,
//!
//! ```text
//! F.U = -c ∫ [u.(du/dxi)/S + p u.n/S^2] dmu dphi,   S = cosh(alpha) - mu.
//! ```
//!
//! Slip of the smaller sphere has no part along `n`. Slip or motion of the larger one drives the answer to its lone flow, which is
//! opposite to that on the smaller sphere and zero on the larger one itself.
//!
//! On a sphere at rest `S (z q/2 + w)` and its like for the other components are the rows of the equations there; their derivatives by
//! `xi` are the rows of the derivatives of the fields and what the factors bring. With series over `S` the integral is a sum over degrees.
//!
//! The charges of the larger sphere say the same, but they lose digits: slowly decaying series make the small force on a pair that
//! moves past a wall out of large ones, with an error of about 1e-15 `lambda^2`/(gap in smaller radii). These sums have their
//! weight on the smaller sphere and lose none of them.

use scene::LoadSet;

use super::geometry::Pair;
use super::lone::{put_into_equations, rigid_values, transverse_rows};
use super::system::{NOMINAL, PairSeries};
use crate::geometry::Geometry;
use crate::stencil::{Stencil, in_next_derivative, sine_squared_lowered, times_mu};
use crate::surface::{Surface, apply, product};
use crate::system::Field;
use crate::transverse::{AXIAL, Boundary, DIFFERENCE, FIELDS, Fields, SUM, boundary_velocities};

/// Components of a flow of order `m` along `z`, across, and across again, of azimuthal orders `m`, `m - 1` and `m + 1`.
pub type Components = [Vec<f64>; 3];

const ORDERS: [usize; 3] = [1, 0, 2];

/// Tractions on the smaller sphere in the rigid motions of the larger one, and velocities there.
pub struct Lorentz {
    force_scale: f64,
    torque_scale: f64,
    tractions: [Components; 2],
    velocities: Vec<Boundary>,
}

impl Lorentz {
    /// For velocities of the `smaller` sphere of a pair; `case` finds the solved rigid motions of the larger one.
    pub fn by_smaller(
        pair: &Pair,
        smaller: usize,
        (series, case): (&PairSeries, impl Fn(usize) -> usize),
        set: LoadSet,
    ) -> Self {
        let (own, larger) = (pair.spheres[smaller], pair.spheres[1 - smaller]);
        Self {
            force_scale: -own.sinh,
            // Along the smaller one's `d x t`.
            torque_scale: own.sinh * (own.sinh / larger.sinh),
            tractions: tractions(pair, smaller, (series, case), Pressure::Without),
            velocities: boundary_velocities(own, set),
        }
    }

    /// For the answers to the flows of the larger one, the `smaller` sphere being at rest.
    pub fn by_larger(
        pair: &Pair,
        smaller: usize,
        (series, case): (&PairSeries, impl Fn(usize) -> usize),
        set: LoadSet,
    ) -> Self {
        let scale = -pair.spheres[1 - smaller].sinh;
        let velocities = transverse_rows(pair, 1 - smaller, set).into_iter();
        Self {
            force_scale: scale,
            torque_scale: scale,
            tractions: tractions(pair, smaller, (series, case), Pressure::With),
            velocities: velocities.map(|rows| from_rows(&rows)).collect(),
        }
    }

    /// Force on the larger sphere along `t` by the velocity of one case, over `pi`, in units of the active sphere's radius.
    pub fn force(&self, case: usize) -> f64 {
        self.force_scale * self.integral(0, case)
    }

    /// Torque on it about its centre along `d x t`, with `d` that of the active sphere.
    pub fn torque(&self, case: usize) -> f64 {
        self.torque_scale * self.integral(1, case)
    }

    fn integral(&self, motion: usize, case: usize) -> f64 {
        let Boundary {
            axial,
            difference,
            sum,
        } = &self.velocities[case];
        let products = [(axial, 1.0), (difference, 0.5), (sum, 0.5)];
        let parts = ORDERS.iter().zip(products).zip(&self.tractions[motion]);
        parts
            .map(|((order, (velocity, weight)), traction)| {
                weight * product(*order, velocity, traction)
            })
            .sum()
    }
}

/// One equation of all degrees.
fn equation(rows: &[f64], equation: usize) -> Vec<f64> {
    rows.iter()
        .skip(equation)
        .step_by(FIELDS)
        .copied()
        .collect()
}

fn from_rows(rows: &[f64]) -> Boundary {
    Boundary {
        axial: equation(rows, AXIAL),
        difference: equation(rows, DIFFERENCE),
        sum: equation(rows, SUM),
    }
}

/// Whether the part of the traction along `n` is counted in.
#[derive(Clone, Copy, PartialEq)]
enum Pressure {
    With,
    Without,
}

/// Tractions on a sphere in translation and rotation of the other one, over `S^2` as the integral has them.
fn tractions(
    pair: &Pair,
    sphere: usize,
    (series, case): (&PairSeries, impl Fn(usize) -> usize),
    pressure: Pressure,
) -> [Components; 2] {
    let surfaces = ORDERS.map(|order| Surface::new(pair.spheres[sphere], order));
    let over = |components: Components| {
        let mut surfaces = surfaces.iter();
        components.map(|series| match surfaces.next() {
            Some(surface) => surface.over_denominator(series),
            None => series,
        })
    };
    let mut lone = rigid_values(pair, 1 - sphere).into_iter();
    [0, 1].map(|motion| {
        let lone = lone.next().unwrap_or_default();
        let flow = Flow::new(pair, sphere, &lone, (series, case(motion)));
        let mut tractions = flow.slopes();
        if pressure == Pressure::With {
            for (traction, more) in tractions.iter_mut().zip(over(flow.along_the_normal())) {
                traction.iter_mut().zip(more).for_each(|(t, m)| *t += m);
            }
        }
        over(over(tractions))
    })
}

/// Derivatives by `xi` of what the equations on a sphere are rows of, that is of `s^(1/2)` times the velocity, by the values of the fields on
/// it and their derivatives.
pub fn row_slopes(
    (pair, sphere): (&Pair, usize),
    values: &[Vec<f64>],
    slopes: &[Vec<f64>],
    fields: &Fields,
) -> Components {
    let rows = put_into_equations(pair, sphere, slopes.to_vec(), fields);
    let Geometry { sinh, cosh, .. } = pair.spheres[sphere];
    let value = |of: Field, n: usize| values[of.index][n];
    let of = |row: usize, of_factors: &dyn Fn(usize) -> f64| {
        let rows = equation(&rows, row).into_iter().enumerate();
        rows.map(|(n, row)| of_factors(n) - row).collect()
    };
    [
        of(AXIAL, &|n| {
            0.5 * cosh * value(fields.pressure, n) + sinh * value(fields.axial, n)
        }),
        of(DIFFERENCE, &|n| sinh * value(fields.mean, n)),
        of(SUM, &|n| sinh * value(fields.second, n)),
    ]
}

/// The fields on a sphere at rest, and their derivatives by `xi`.
struct Flow<'a> {
    pair: &'a Pair,
    sphere: usize,
    values: Vec<Vec<f64>>,
    slopes: Vec<Vec<f64>>,
}

impl<'a> Flow<'a> {
    /// Of the lone flow of the other sphere and the answer to it.
    fn new(
        pair: &'a Pair,
        sphere: usize,
        lone: &[Vec<f64>],
        (series, case): (&PairSeries, usize),
    ) -> Self {
        let (mut values, mut slopes) = (vec![Vec::new(); FIELDS], vec![Vec::new(); FIELDS]);
        for field in Fields::new(1, NOMINAL).all() {
            let jets = series.jet(sphere, field, case).zip(&lone[field.index]);
            let (value, slope) = jets
                .enumerate()
                .map(|(n, ((value, slope), lone))| {
                    // The lone flow falls off towards this sphere.
                    (value + lone, slope - (n as f64 + 0.5) * lone)
                })
                .unzip();
            values[field.index] = value;
            slopes[field.index] = slope;
        }
        Self {
            pair,
            sphere,
            values,
            slopes,
        }
    }

    fn slopes(&self) -> Components {
        let fields = Fields::new(1, NOMINAL);
        row_slopes(
            (self.pair, self.sphere),
            &self.values,
            &self.slopes,
            &fields,
        )
    }

    /// `S p n`, with `S n = (mu cosh(alpha) - 1, sinh(alpha) sin(eta))` along `z` and across.
    fn along_the_normal(&self) -> Components {
        let sphere = &self.pair.spheres[self.sphere];
        let pressure = &self.values[Fields::new(1, NOMINAL).pressure.index];
        let along = |n: usize| Stencil {
            at: -1.0,
            ..times_mu(n, 1).scaled(sphere.cosh)
        };
        // From order 1, that of the pressure, to others.
        let of = |stencil: &dyn Fn(usize) -> Stencil| apply(pressure, 0, stencil);
        [
            of(&along),
            of(&|n| sine_squared_lowered(n, 1).scaled(sphere.sinh)),
            of(&|n| in_next_derivative(n).scaled(sphere.sinh)),
        ]
    }
}
