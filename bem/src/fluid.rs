//! The flow about a moving pair, and what it does to the fluid, by boundary elements.

use std::sync::OnceLock;

use nalgebra::{Matrix3, Vector3};
use scene::stress::Stresses;
use scene::{Configuration, Flow, Fluid, FluidState, Gap, Hydrodynamics, MovingPair, SceneError};

use crate::layers::in_own_frames;
use crate::model::Bem;
use crate::pair::Motion;
use crate::{Layers, interior, lone, stresses};

/// The largest error of the velocity, relative to the largest mismatch that was found on the surfaces.
const CAUTION: f64 = 3.0;

impl Bem {
    /// Single layers on both spheres whose flow has the velocities `(sphere, unit normal)` on the surfaces, in the laboratory's frame. No
    /// fluid may flow through a sphere as a whole.
    ///
    /// # Errors
    /// As [`Fluid::flow`].
    pub fn layers(
        &self,
        configuration: &Configuration,
        velocity: impl Fn(usize, &Vector3<f64>) -> Vector3<f64> + Send + Sync,
    ) -> Result<Layers, SceneError> {
        let [one, two] = configuration.radii;
        let (asked, model) = (two / one, self.description().ratio);
        #[expect(clippy::float_cmp, reason = "a model is for one ratio, exactly")]
        if asked != model || one != 1.0 {
            return Err(SceneError::OtherRatio { model, asked });
        }
        self.solved(configuration.gap, &Motion::COMPLETE, |systems| {
            let velocities = [in_own_frames(configuration, &velocity)];
            let densities = systems.densities(&velocities)?;
            Ok(Layers::new(configuration, systems, &densities[0]))
        })
    }
}

impl Fluid for Bem {
    /// The sum of those of the lone squirmers, in closed form, and of single layers that undo each of them on the other one's surface.
    fn flow(&self, pair: &MovingPair) -> Result<Box<dyn Flow>, SceneError> {
        let layers = self.layers(&pair.configuration, |sphere, normal| {
            undone(pair, sphere, normal)
        })?;
        Ok(Box::new(BemFlow {
            pair: *pair,
            layers,
            estimate: OnceLock::new(),
        }))
    }

    /// Of equal spheres the causes of sphere 1 alone are solved for. Those of lone spheres are in closed form, so that nothing is to be shifted
    /// far apart, as loads are.
    fn stresses(&self, gap: Gap, modes: usize, swirl: usize) -> Result<Stresses, SceneError> {
        let set = scene::LoadSet::all(modes).with_swirl(swirl);
        set.check()?;
        let radii = [1.0, self.description().ratio];
        self.solved(gap, &Motion::ALL, |systems| {
            stresses::solve(systems, radii, gap, [modes, swirl])
        })
    }
}

/// The flow about a pair.
struct BemFlow {
    pair: MovingPair,
    layers: Layers,
    /// Found when it is first asked for.
    estimate: OnceLock<f64>,
}

impl Flow for BemFlow {
    fn pair(&self) -> &MovingPair {
        &self.pair
    }

    fn at(&self, point: &Vector3<f64>) -> FluidState {
        let mut state = self.layers.at(point);
        for sphere in [0, 1] {
            let lone = lone::flow(&self.pair, sphere, point);
            state.velocity += lone.velocity;
            state.pressure += lone.pressure;
        }
        state
    }

    fn gradient(&self, point: &Vector3<f64>) -> Matrix3<f64> {
        let lone = [0, 1].map(|sphere| lone::flow(&self.pair, sphere, point).gradient);
        self.layers.gradient(point) + lone[0] + lone[1]
    }

    /// The traction of the flow within, which has a closed form, less the density.
    ///
    /// Within a sphere the flow of the layers is minus that of the other lone one, so that both together have no traction but for a
    /// pressure, that at the centre; what is left is the flow within that meets the sphere's own slip.
    fn traction(&self, sphere: usize, normal: &Vector3<f64>) -> Vector3<f64> {
        let configuration = &self.pair.configuration;
        let (p, radius) = (
            configuration.orientations[sphere],
            configuration.radii[sphere],
        );
        let centre = configuration.positions()[sphere];
        let pressure = self.layers.inner_pressure(sphere)
            + lone::flow(&self.pair, 1 - sphere, &centre).pressure;
        let slip = interior::traction(&self.pair.squirmers[sphere], &p, normal) / radius;
        slip - normal * pressure - self.full_density(sphere, normal)
    }

    fn density(&self, sphere: usize, normal: &Vector3<f64>) -> Option<Vector3<f64>> {
        Some(self.full_density(sphere, normal))
    }

    /// Three times the largest mismatch of the velocity on the surfaces, over a point of each panel that is no node.
    ///
    /// The flow is a Stokes flow to the accuracy of the quadrature, and its error is the Stokes flow of the mismatch, which is largest on the
    /// surfaces; away from them by more than a panel it is hundreds of times smaller.
    fn error_estimate(&self) -> f64 {
        *self.estimate.get_or_init(|| {
            let velocity = |sphere, normal: &Vector3<f64>| undone(&self.pair, sphere, normal);
            CAUTION * self.layers.mismatch(velocity)
        })
    }
}

impl BemFlow {
    fn full_density(&self, sphere: usize, normal: &Vector3<f64>) -> Vector3<f64> {
        self.layers.density(sphere, normal) + lone::density(&self.pair, sphere, normal)
    }
}

/// What the layers must do on a sphere: undo the flow of the other one alone.
fn undone(pair: &MovingPair, sphere: usize, normal: &Vector3<f64>) -> Vector3<f64> {
    let configuration = &pair.configuration;
    let point = configuration.positions()[sphere] + normal * configuration.radii[sphere];
    -lone::flow(pair, 1 - sphere, &point).velocity
}
