//! Single layers on both spheres of a pair, in the laboratory's frame, and their flow.

use nalgebra::{Matrix3, Vector3};
use rayon::prelude::*;
use scene::{Configuration, FluidState};

use crate::lab::turned;
use crate::pair::{Densities, Systems, Velocities};
use crate::surface::Layer;

/// Points beyond this many radii are those at it: squares stay finite, and the flow is zero to rounding.
const FARTHEST: f64 = 1e100;

/// Single layers on both spheres of a pair, which move as their surfaces were told to. Lengths are in radii of sphere 1, viscosity is 1.
///
/// They give the flow of the fluid, and within the spheres the one with the same velocity on the surface.
#[derive(Clone, Debug)]
pub struct Layers {
    spheres: [Sphere; 2],
    /// Pressure at either centre.
    inner_pressures: [f64; 2],
}

/// A sphere in the laboratory.
#[derive(Clone, Debug)]
struct Sphere {
    centre: Vector3<f64>,
    radius: f64,
    frame: Frame,
    layer: Layer,
}

/// A sphere's own frame: the rows are its axes in the laboratory, the last one towards the other sphere; that of sphere 2 is mirrored.
#[derive(Clone, Copy, Debug)]
struct Frame(Matrix3<f64>);

impl Frame {
    fn both(configuration: &Configuration) -> [Self; 2] {
        let turn = turned(&configuration.line).inverse();
        let own = turn.to_rotation_matrix().into_inner();
        let mirror = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, -1.0));
        [Self(own), Self(mirror * own)]
    }

    fn own(&self, of: &Vector3<f64>) -> Vector3<f64> {
        self.0 * of
    }

    fn lab(&self, of: &Vector3<f64>) -> Vector3<f64> {
        self.0.tr_mul(of)
    }
}

/// Velocities of both surfaces in their own frames, from those in the laboratory's by sphere and unit normal.
pub(crate) fn in_own_frames<'a>(
    configuration: &Configuration,
    velocity: &'a (impl Fn(usize, &Vector3<f64>) -> Vector3<f64> + Send + Sync),
) -> Velocities<'a> {
    let [one, two] = Frame::both(configuration);
    let of = |sphere: usize, frame: Frame| {
        move |normal: &Vector3<f64>| frame.own(&velocity(sphere, &frame.lab(normal)))
    };
    [Box::new(of(0, one)), Box::new(of(1, two))]
}

impl Layers {
    /// The densities that were found in the spheres' own frames.
    pub(crate) fn new(
        configuration: &Configuration,
        systems: &Systems<'_, 6>,
        densities: &Densities,
    ) -> Self {
        let (centres, frames) = (configuration.positions(), Frame::both(configuration));
        let spheres = [0, 1].map(|k| Sphere {
            centre: centres[k],
            radius: configuration.radii[k],
            frame: frames[k],
            layer: systems.surface(k).layer(&densities[k]),
        });
        let inner_pressures = [0, 1].map(|k| {
            let of = |sphere: &Sphere| sphere.at(&centres[k]).pressure;
            spheres.iter().map(of).sum()
        });
        Self {
            spheres,
            inner_pressures,
        }
    }

    /// Velocity and pressure at a point, zero far away. On a surface the pressure is the one outside.
    #[must_use]
    pub fn at(&self, point: &Vector3<f64>) -> FluidState {
        let [one, two] = self.spheres.each_ref().map(|sphere| sphere.at(point));
        FluidState {
            velocity: one.velocity + two.velocity,
            pressure: one.pressure + two.pressure,
        }
    }

    /// Velocity gradient at a point, `G_ij = d u_i / d x_j`; on a surface the one outside.
    #[must_use]
    pub fn gradient(&self, point: &Vector3<f64>) -> Matrix3<f64> {
        let of = |sphere: &Sphere| {
            let gradient = sphere.layer.gradient(&sphere.place(point)) / sphere.radius;
            sphere.frame.0.tr_mul(&(gradient * sphere.frame.0))
        };
        of(&self.spheres[0]) + of(&self.spheres[1])
    }

    /// Force on the fluid per area of a sphere, 0 or 1, at the outward unit normal, by its outer and its inner side together. It holds an arbitrary
    /// multiple of the normal, the same all over the sphere, which drives no flow.
    #[must_use]
    pub fn density(&self, sphere: usize, normal: &Vector3<f64>) -> Vector3<f64> {
        let of = &self.spheres[sphere];
        let own = of.layer.density(&of.frame.own(normal));
        of.frame.lab(&own) / of.radius
    }

    /// Mean pressure of the inner flow of a sphere, that at its centre: with it the arbitrary part of the density drops out of tractions.
    #[must_use]
    pub fn inner_pressure(&self, sphere: usize) -> f64 {
        self.inner_pressures[sphere]
    }

    /// Largest difference of the flow from the velocities `(sphere, unit normal)` of the surfaces, over a point of each panel that is no
    /// node.
    pub fn mismatch(
        &self,
        velocity: impl Fn(usize, &Vector3<f64>) -> Vector3<f64> + Send + Sync,
    ) -> f64 {
        let of = |k: usize| {
            let sphere = &self.spheres[k];
            let normals: Vec<Vector3<f64>> = sphere.layer.between_nodes().collect();
            let at = |own: Vector3<f64>| {
                let normal = sphere.frame.lab(&own);
                let point = sphere.centre + normal * sphere.radius;
                let own = sphere.at_own(&own).velocity;
                let other = self.spheres[1 - k].at(&point).velocity;
                (own + other - velocity(k, &normal)).norm()
            };
            // `max` would lose a NaN.
            let worst = |a: f64, b: f64| if a > b || a.is_nan() { a } else { b };
            normals.into_par_iter().map(at).reduce(|| 0.0, worst)
        };
        of(0).max(of(1))
    }
}

impl Sphere {
    /// A point in its own frame.
    fn place(&self, point: &Vector3<f64>) -> Vector3<f64> {
        let apart = (point - self.centre) / self.radius;
        let far = apart.amax();
        if far > FARTHEST {
            self.frame.own(&(apart * (FARTHEST / far)))
        } else {
            self.frame.own(&apart)
        }
    }

    fn at(&self, point: &Vector3<f64>) -> FluidState {
        self.at_own(&self.place(point))
    }

    fn at_own(&self, place: &Vector3<f64>) -> FluidState {
        let found = self.layer.at(place);
        FluidState {
            velocity: self.frame.lab(&found.velocity),
            pressure: found.pressure / self.radius,
        }
    }
}
