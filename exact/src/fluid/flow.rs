//! The flow about a moving pair.

use std::f64::consts::PI;
use std::sync::OnceLock;

use nalgebra::{Matrix3, Vector3};
use rayon::prelude::*;
use scene::stress::{Axes, Block, amplitudes};
use scene::{Flow, FluidState, MovingPair};

use super::causes::rows;
use super::harmonic::{Harmonic, Harmonics, Phase, Place};
use super::solution::{Solution, factors};
use crate::ExactError;
use crate::axial;
use crate::unlike::{NOMINAL, Pair};

/// Points of each surface at which the error of the velocity is measured.
const RESIDUAL_POINTS: usize = 200;

/// Pressure and the harmonic part of the velocity: `q, h_x, h_y, h_z`.
type Functions = [Harmonic; 4];

/// The flow about a pair by bispherical series: `u = x q/2 + h`, pressure `q`, `q` and `h` harmonic, lengths in units of the focal length.
pub struct SeriesFlow {
    pair: MovingPair,
    geometry: Pair,
    /// Columns `e1, e2, -d` of the pair.
    axes: Matrix3<f64>,
    /// Middle between the poles, in the laboratory frame.
    origin: Vector3<f64>,
    focal_length: f64,
    functions: Functions,
    summed: Harmonics<4>,
    gradients: OnceLock<Harmonics<12>>,
    /// Found when it is first asked for.
    error: OnceLock<f64>,
}

impl SeriesFlow {
    /// Solves for the velocities of both surfaces, with `factor` times the terms that reach rounding.
    pub fn new(pair: &MovingPair, factor: f64) -> Result<Self, ExactError> {
        let configuration = &pair.configuration;
        let [one, two] = configuration.radii;
        let modes = highest(pair.squirmers.iter().map(|s| s.modes().len()));
        let swirl = highest(pair.squirmers.iter().map(|s| s.swirl().len()));
        let eps = configuration.gap.eps();
        let geometry = Pair::resolving_velocities(eps, two / one, modes.max(swirl).max(1), factor)?;
        let axes = Axes::of(pair);
        let mut functions = Functions::default();
        for block in Block::all(modes, swirl) {
            add_block(&mut functions, pair, &geometry, block, (modes, swirl))?;
        }
        let sphere = &geometry.spheres[0];
        let summed = Harmonics::new(functions.each_ref());
        Ok(Self {
            pair: *pair,
            geometry,
            axes: Matrix3::from_columns(&[axes.e1, axes.e2, -axes.d]),
            origin: configuration.positions()[0] + axes.d * (sphere.cosh * one),
            focal_length: sphere.sinh * one,
            functions,
            summed,
            gradients: OnceLock::new(),
            error: OnceLock::new(),
        })
    }

    /// Position in the frame of the series, and the point there.
    fn place(&self, point: &Vector3<f64>) -> (Vector3<f64>, Place) {
        let position = self.axes.tr_mul(&(point - self.origin)) / self.focal_length;
        (position, Place::new(&self.geometry, &position))
    }

    /// Largest difference between the flow and the velocity of the surfaces, at `count` points of each sphere that the solution does not know
    /// of.
    fn residual(&self, count: usize) -> f64 {
        let centres = self.pair.configuration.positions();
        let error = |sphere: usize, normal: Vector3<f64>| {
            let point = centres[sphere] + normal * self.pair.configuration.radii[sphere];
            let expected = self.pair.surface_velocity(sphere, &normal);
            (self.at(&point).velocity - expected).norm()
        };
        let errors = (0..count).into_par_iter().map(|k| {
            let normal = spiral(k, count);
            error(0, normal).max(error(1, normal))
        });
        errors.reduce(|| 0.0, f64::max)
    }
}

/// Points of a sphere, spread evenly on a spiral (E. A. Rakhmanov, E. B. Saff & Y. M. Zhou, *Math. Res. Lett.* 1 (1994) 647).
fn spiral(k: usize, count: usize) -> Vector3<f64> {
    let z = 1.0 - (2.0 * k as f64 + 1.0) / count as f64;
    let (sin, cos) = (k as f64 * PI * (3.0 - 5.0_f64.sqrt())).sin_cos();
    let radius = (1.0 - z * z).sqrt();
    Vector3::new(radius * cos, radius * sin, z)
}

fn highest(modes: impl Iterator<Item = usize>) -> usize {
    modes.fold(0, usize::max)
}

/// Adds the flow by the causes of a block.
fn add_block(
    into: &mut Functions,
    pair: &MovingPair,
    geometry: &Pair,
    block: Block,
    (modes, swirl): (usize, usize),
) -> Result<(), ExactError> {
    let causes = block.causes(modes, swirl);
    let amplitudes = amplitudes(pair, &Axes::of(pair), block, &causes);
    if amplitudes
        .iter()
        .all(|amplitude| amplitude.norm_sqr() == 0.0)
    {
        return Ok(());
    }
    let units: Vec<Vec<Vec<f64>>> = (0..2)
        .map(|k| {
            let of = (k, pair.configuration.radii[k]);
            rows(geometry.spheres[k], of, block, &causes)
        })
        .collect();
    // One case for each phase of the azimuth.
    let phases = [Phase::Cos, Phase::Sin];
    let cases = phases.map(|phase| {
        [0, 1].map(|k| {
            let mut sum = vec![0.0; units[k][0].len()];
            let of_sphere = &amplitudes[k * causes.len()..];
            for (amplitude, unit) in of_sphere.iter().zip(&units[k]) {
                let weight = match phase {
                    Phase::Cos => amplitude.re,
                    Phase::Sin => amplitude.im,
                };
                sum.iter_mut().zip(unit).for_each(|(s, u)| *s += weight * u);
            }
            sum
        })
    });
    let solution = Solution::new(geometry, block, &cases)?;
    for (case, phase) in phases.into_iter().enumerate() {
        add_case(into, &solution, case, phase);
    }
    Ok(())
}

/// Adds one case of a solution, the fields of which go with the phase of the azimuth.
fn add_case([q, x, y, z]: &mut Functions, solution: &Solution, case: usize, phase: Phase) {
    // What is the cosine's for this phase has the other one for the component a quarter of a period further.
    let (other, sign) = match phase {
        Phase::Cos => (Phase::Sin, 1.0),
        Phase::Sin => (Phase::Cos, -1.0),
    };
    match solution {
        // Order 0 has no phase: its second case is nothing.
        Solution::Twist(cases) => {
            x.add(1, other, -sign, &cases[case]);
            y.add(1, phase, 1.0, &cases[case]);
        }
        Solution::Axial(series) => {
            let fields = axial::Fields::new(NOMINAL);
            q.add(0, phase, 1.0, &factors(series, fields.pressure, case));
            z.add(0, phase, 1.0, &factors(series, fields.axial, case));
            let radial = factors(series, fields.radial, case);
            x.add(1, phase, 1.0, &radial);
            y.add(1, other, sign, &radial);
        }
        Solution::Across(series, fields) => {
            let m = fields.order();
            q.add(m, phase, 1.0, &factors(series, fields.pressure, case));
            z.add(m, phase, 1.0, &factors(series, fields.axial, case));
            let mean = factors(series, fields.mean, case);
            x.add(m - 1, phase, 0.5, &mean);
            y.add(m - 1, other, -0.5 * sign, &mean);
            let second = factors(series, fields.second, case);
            x.add(m + 1, phase, 0.5, &second);
            y.add(m + 1, other, 0.5 * sign, &second);
        }
    }
}

impl Flow for SeriesFlow {
    fn pair(&self) -> &MovingPair {
        &self.pair
    }

    fn at(&self, point: &Vector3<f64>) -> FluidState {
        let (position, place) = self.place(point);
        let [q, x, y, z] = self.summed.at(&place);
        let velocity = position * (0.5 * q) + Vector3::new(x, y, z);
        FluidState {
            velocity: self.axes * velocity,
            pressure: q / self.focal_length,
        }
    }

    fn gradient(&self, point: &Vector3<f64>) -> Matrix3<f64> {
        let gradients = self.gradients.get_or_init(|| {
            let [q, x, y, z] = self
                .functions
                .each_ref()
                .map(|f| f.gradient(&self.geometry));
            let all = [&q, &x, &y, &z];
            Harmonics::new(std::array::from_fn(|k| &all[k / 3][k % 3]))
        });
        let (position, place) = self.place(point);
        let [q, ..] = self.summed.at(&place);
        let rows = gradients.at(&place);
        let slope = |of: usize| Vector3::new(rows[3 * of], rows[3 * of + 1], rows[3 * of + 2]);
        let harmonic = Matrix3::from_rows(&[1, 2, 3].map(|of| slope(of).transpose()));
        let gradient =
            Matrix3::identity() * (0.5 * q) + position * slope(0).transpose() * 0.5 + harmonic;
        self.axes * gradient * self.axes.transpose() / self.focal_length
    }

    fn traction(&self, sphere: usize, normal: &Vector3<f64>) -> Vector3<f64> {
        let radius = self.pair.configuration.radii[sphere];
        let point = self.pair.configuration.positions()[sphere] + normal * radius;
        let gradient = self.gradient(&point);
        (gradient + gradient.transpose()) * normal - normal * self.at(&point).pressure
    }

    fn density(&self, _: usize, _: &Vector3<f64>) -> Option<Vector3<f64>> {
        None
    }

    fn error_estimate(&self) -> f64 {
        *(self.error).get_or_init(|| self.residual(RESIDUAL_POINTS))
    }
}
