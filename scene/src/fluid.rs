//! The fluid about a pair: how the two surfaces move at one instant, the flow that this drives, and what a model of it must give.
//!
//! Forces on a pair need six numbers a sphere; the flow needs the velocity of every point of both surfaces. [`MovingPair`] has it. A model
//! that knows the flow itself is a [`Fluid`]; lubrication theory is none.

use nalgebra::{Matrix3, Vector3};

use crate::mobility::{
    External, Heading, MobilitySet, PairVelocity, add_swirl, add_swirl_of_each, pair_velocity,
    velocity_of_each,
};
use crate::stress::Stresses;
use crate::{Configuration, Gap, Hydrodynamics, LoadSet, Plan, SceneError, Squirmer, legendre};

/// Depth below a surface that may be rounding, relative to the distance from the origin.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// A pair at one instant: where the squirmers are and how each surface moves. Lengths are in radii of the first squirmer, viscosity is 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MovingPair {
    /// The squirmers, whose slip moves their surfaces.
    pub squirmers: [Squirmer; 2],
    /// Where they are.
    pub configuration: Configuration,
    /// Velocities of the centres, in the laboratory frame.
    pub velocities: [Vector3<f64>; 2],
    /// Angular velocities, of all three components: the spin about a squirmer's own axis drives flow too.
    pub angular_velocities: [Vector3<f64>; 2],
    /// Forces on the squirmers by other than the fluid: repulsion.
    pub forces: [Vector3<f64>; 2],
    /// Torques on the squirmers by other than the fluid, about their centres: gravity.
    pub torques: [Vector3<f64>; 2],
}

impl MovingPair {
    /// The loads that [`Self::free`] asks of a model for a plan. They may be more than those of the motion, because spins about the squirmers' own
    /// axes and about the line of centres drive flow too.
    #[must_use]
    pub fn load_set(plan: &Plan) -> LoadSet {
        let scene = plan.scene();
        let swirl = (scene.squirmers.iter().map(|s| s.swirl().len())).fold(0, usize::max);
        LoadSet {
            twist: swirl > 0 || plan.gravity().is_some(),
            ..LoadSet::planar(scene.modes())
        }
        .with_swirl(swirl)
    }

    /// The pair as it moves in a configuration of a scene: free of force and torque but for the effects of the `plan`, by the mobilities
    /// of a model.
    ///
    /// ```
    /// use scene::{Isolated, MovingPair, Plan, Pose, Scene, Squirmer};
    /// let squirmer = Squirmer::with_beta(1.0, 5.0)?;
    /// let start = [Pose::planar(-2.0, 0.0, 90.0), Pose::planar(2.0, 0.0, 0.0)];
    /// let plan = Plan::new(&Scene::new([squirmer; 2], start, None, None)?)?;
    /// let pair = MovingPair::free(&plan, &Isolated::EQUAL, plan.start())?;
    /// assert!((pair.velocities[0].y - 1.0).abs() < 1e-14 && (pair.velocities[1].x - 1.0).abs() < 1e-14);
    /// # Ok::<(), scene::SceneError>(())
    /// ```
    ///
    /// # Errors
    /// [`SceneError`] if the model cannot give the loads at the configuration's gap, or is one for other radii.
    pub fn free(
        plan: &Plan,
        model: &dyn Hydrodynamics,
        configuration: &Configuration,
    ) -> Result<Self, SceneError> {
        plan.check_ratio(model)?;
        let scene = plan.scene();
        let squirmers = scene.squirmers;
        let line = configuration.line;
        let torques = gravity_torques(plan, configuration);
        let loads = Self::load_set(plan);
        let swirl = loads.swirl;
        let set = MobilitySet {
            loads,
            torque: torques.is_some(),
        };
        let headings = Heading::of_both(&line, configuration.orientations);
        let turned = headings.each_ref().map(|heading| heading.turned(&line));
        let repulsion = (plan.repulsion()).map_or(0.0, |r| r.force(configuration.gap));
        let external = External {
            repulsion,
            torque: torques.map(|torques| torques.map(|torque| torque.cross(&line))),
        };
        let about = torques.map(|torques| torques.map(|torque| torque.dot(&line)));
        let (velocity, spins) = if plan.has_unlike_radii() {
            let mobility = model.interacting_mobility_of_each(configuration.gap, set)?;
            let modes = scene.modes();
            let mut velocity = velocity_of_each(&mobility, modes, &squirmers, &headings, &external);
            let by = (&headings, &turned);
            let mut spins = add_swirl_of_each(&mut velocity, &mobility, &squirmers, by);
            for (by, torque) in mobility.by.iter().zip(about.unwrap_or_default()) {
                let [one, two] = by.pair.twist.spins(torque, torque);
                spins = [spins[0] + one, spins[1] + two];
            }
            (velocity, spins)
        } else {
            let mobility = model.mobility(configuration.gap, set)?;
            let by = (&mobility.pair, &mobility.modes[..scene.modes()]);
            let mut velocity = pair_velocity(by, &squirmers, &headings, &external);
            let by_swirl = &mobility.swirl[..swirl];
            let by = (&headings, &turned);
            let mut spins = add_swirl(&mut velocity, by_swirl, &squirmers, by);
            if let Some([t1, t2]) = about {
                let [one, two] = mobility.pair.twist.spins(t1 + t2, t1 - t2);
                spins = [spins[0] + one, spins[1] + two];
            }
            (velocity, spins)
        };
        let push = line * (std::f64::consts::PI * repulsion);
        Ok(Self {
            squirmers,
            configuration: *configuration,
            velocities: velocities(configuration, &velocity),
            angular_velocities: [0, 1].map(|k| line.cross(&velocity.spin[k]) + line * spins[k]),
            forces: [-push, push],
            torques: torques.map_or_else(Default::default, |torques| {
                torques.map(|torque| torque * std::f64::consts::PI)
            }),
        })
    }

    /// Slip velocity of a squirmer's surface at the unit normal `normal`.
    #[must_use]
    pub fn slip(&self, squirmer: usize, normal: &Vector3<f64>) -> Vector3<f64> {
        let p = self.configuration.orientations[squirmer];
        let of = &self.squirmers[squirmer];
        let c = p.dot(normal);
        let (mut along, mut around) = (0.0, 0.0);
        for (n, order) in (0..of.modes().len().max(of.swirl().len())).zip(legendre(c)) {
            along += of.mode(n) * order.w;
            around += of.swirl().get(n).map_or(0.0, |strength| strength * order.w);
        }
        (normal * c - p) * along + p.cross(normal) * around
    }

    /// Velocity of a squirmer's surface at the unit normal `normal`, in the laboratory frame.
    #[must_use]
    pub fn surface_velocity(&self, squirmer: usize, normal: &Vector3<f64>) -> Vector3<f64> {
        self.rigid_velocity(squirmer, normal) + self.slip(squirmer, normal)
    }

    /// The same without the slip.
    #[must_use]
    pub fn rigid_velocity(&self, squirmer: usize, normal: &Vector3<f64>) -> Vector3<f64> {
        let arm = normal * self.configuration.radii[squirmer];
        self.velocities[squirmer] + self.angular_velocities[squirmer].cross(&arm)
    }

    /// Rate of work of repulsion and gravity on the pair.
    #[must_use]
    pub fn external_power(&self) -> f64 {
        let of = |k: usize| {
            self.forces[k].dot(&self.velocities[k])
                + self.torques[k].dot(&self.angular_velocities[k])
        };
        of(0) + of(1)
    }

    /// The squirmer that a point lies within, if it lies within one. A point that rounding puts below a surface lies on it.
    #[must_use]
    pub fn within(&self, point: &Vector3<f64>) -> Option<usize> {
        let centres = self.configuration.positions();
        let radii = self.configuration.radii;
        let rounding = ROUNDING * (1.0 + point.norm());
        (0..2).find(|&k| (point - centres[k]).norm() < radii[k] - rounding)
    }
}

/// Velocities of the two centres.
fn velocities(
    configuration: &Configuration,
    velocity: &PairVelocity<Vector3<f64>>,
) -> [Vector3<f64>; 2] {
    let line = configuration.line;
    let mean = line * velocity.mean_axial + velocity.mean_transverse;
    let relative = line * (velocity.opening * configuration.gap.eps())
        + velocity.turning * configuration.distance();
    [mean - relative * 0.5, mean + relative * 0.5]
}

/// Torques of gravity per `pi mu a^2`, if it acts.
fn gravity_torques(plan: &Plan, configuration: &Configuration) -> Option<[Vector3<f64>; 2]> {
    plan.gravity().map(|gravity| {
        [0, 1].map(|k| gravity.torque(&plan.scene().squirmers[k], &configuration.orientations[k]))
    })
}

/// The fluid at a point: velocity in the laboratory frame, and pressure, which is zero far away.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FluidState {
    /// Velocity.
    pub velocity: Vector3<f64>,
    /// Pressure, in units of viscosity times velocity over radius.
    pub pressure: f64,
}

/// The flow about a pair at one instant, in the laboratory frame.
pub trait Flow: Send + Sync {
    /// The pair that drives it.
    fn pair(&self) -> &MovingPair;

    /// Velocity and pressure at a point of the fluid, its surfaces included. Within a sphere there is no fluid: nothing that is
    /// said there means anything.
    fn at(&self, point: &Vector3<f64>) -> FluidState;

    /// Velocity gradient at a point of the fluid, `G_ij = d u_i / d x_j`.
    fn gradient(&self, point: &Vector3<f64>) -> Matrix3<f64>;

    /// The fluid's traction on a sphere at the outward unit normal `normal`: force per area, `-p n + (G + G^T) n`.
    fn traction(&self, sphere: usize, normal: &Vector3<f64>) -> Vector3<f64>;

    /// Density of the single layer on a sphere at the outward unit normal `normal`, if the flow is made of one: force on the fluid per area.
    fn density(&self, sphere: usize, normal: &Vector3<f64>) -> Option<Vector3<f64>>;

    /// Estimate of the largest error of the velocity at points of the fluid.
    fn error_estimate(&self) -> f64;
}

/// A model that knows the flow about the spheres, and not only the loads on them.
pub trait Fluid: Hydrodynamics {
    /// The flow about a pair whose radii are those of the model.
    ///
    /// # Errors
    /// As [`Hydrodynamics::interacting_loads`]; [`SceneError::OtherRatio`] for a pair of other radii.
    fn flow(&self, pair: &MovingPair) -> Result<Box<dyn Flow>, SceneError>;

    /// Stresslets and rates of work at a gap, by rigid motions, by the squirming modes 1 to `modes` and the swirl modes 1 to `swirl` of either
    /// sphere.
    ///
    /// # Errors
    /// As [`Hydrodynamics::interacting_loads`].
    fn stresses(&self, gap: Gap, modes: usize, swirl: usize) -> Result<Stresses, SceneError>;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Gravity, Isolated, Orientation, Pose, Repulsion, Scene, rates};

    /// Loads that depend on nothing, with every coupling there is.
    fn scene(swirl: &[f64], g_bh: f64) -> Scene {
        let squirmer = |beta: f64| {
            let of = Squirmer::with_beta(1.0, beta).unwrap();
            of.with_swirl(swirl).unwrap().bottom_heavy(g_bh).unwrap()
        };
        let pose = |position: [f64; 3], towards: [f64; 3]| Pose {
            position: position.into(),
            orientation: Orientation::Vector(towards.into()),
        };
        let start = [
            pose([0.1, -0.2, 0.3], [0.3, 0.8, -0.4]),
            pose([1.4, 1.3, 0.9], [-0.5, 0.2, 0.7]),
        ];
        let gravity = (g_bh != 0.0).then_some(Gravity::DOWN);
        Scene::new(
            [squirmer(2.0), squirmer(-1.0)],
            start,
            Some(Repulsion::PAPER),
            gravity,
        )
        .unwrap()
    }

    #[test]
    fn a_pair_moves_as_its_equation_of_motion_says() {
        for (swirl, g_bh) in [
            (&[][..], 0.0),
            (&[0.4, -1.2], 0.0),
            (&[], 3.0),
            (&[0.0, 0.7], 2.0),
        ] {
            let plan = Plan::new(&scene(swirl, g_bh)).unwrap();
            let start = *plan.start();
            let pair = MovingPair::free(&plan, &Isolated::EQUAL, &start).unwrap();
            let rates = rates(&plan, &Isolated::EQUAL, &start, 1).unwrap();
            let [u1, u2] = pair.velocities;
            assert!(((u1 + u2) * 0.5 - rates.midpoint).norm() < 1e-14);
            let relative = u2 - u1;
            let along = relative.dot(&start.line);
            assert!((along / start.gap.eps() - rates.ln_gap).abs() < 1e-12);
            let across = relative - start.line * along;
            assert!((across / start.distance() - rates.line).norm() < 1e-14);
            for k in [0, 1] {
                let turning = pair.angular_velocities[k].cross(&start.orientations[k]);
                assert!((turning - rates.orientations[k]).norm() < 1e-13, "{k}");
            }
        }
    }

    #[test]
    fn a_lone_swirler_of_the_first_mode_leaves_its_surface_at_rest() {
        let plan = Plan::new(&scene(&[0.9], 0.0)).unwrap();
        let mut pair = MovingPair::free(&plan, &Isolated::EQUAL, plan.start()).unwrap();
        pair.squirmers = pair.squirmers.map(|s| {
            let swirl = s.swirl().to_vec();
            Squirmer::new(&[]).unwrap().with_swirl(&swirl).unwrap()
        });
        pair.velocities = [Vector3::zeros(); 2];
        let normal = Vector3::new(0.48, 0.6, 0.64);
        for k in [0, 1] {
            assert!(pair.surface_velocity(k, &normal).norm() < 1e-14);
        }
    }

    #[test]
    fn forces_push_apart_and_gravity_turns_upward() {
        let plan = Plan::new(&scene(&[], 3.0)).unwrap();
        let pair = MovingPair::free(&plan, &Isolated::EQUAL, plan.start()).unwrap();
        assert!(pair.forces[1].dot(&pair.configuration.line) > 0.0);
        assert!((pair.forces[0] + pair.forces[1]).norm() < 1e-15);
        for k in [0, 1] {
            let p = pair.configuration.orientations[k];
            assert!(pair.torques[k].cross(&p).y > 0.0);
        }
    }

    #[test]
    fn a_point_lies_within_the_sphere_that_it_is_nearer_to_than_its_radius() {
        let plan = Plan::new(&scene(&[], 0.0)).unwrap();
        let pair = MovingPair::free(&plan, &Isolated::EQUAL, plan.start()).unwrap();
        let direction = Vector3::new(0.48, 0.6, 0.64);
        for (k, centre) in pair.configuration.positions().into_iter().enumerate() {
            for (away, within) in [(0.0, true), (0.99, true), (1.0, false), (1.01, false)] {
                // To the side on which the other one is not.
                let side = if k == 0 { -1.0 } else { 1.0 };
                let found = pair.within(&(centre + direction * (side * away)));
                assert_eq!(found, within.then_some(k), "{away} from {k}");
            }
        }
    }
}
