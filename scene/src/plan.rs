//! The plan of a scene: what is computed, on which state, and why.
//!
//! [`run`](crate::run) makes this plan and goes by it, and `squirmers explain` prints it: there is
//! no other place where it is decided what runs.

mod describe;
mod symmetry;

pub use describe::{NeededLoads, PlanRow, SymmetryClass};

use crate::frame::{Configuration, Plane, start};
use crate::mobility::{MobilityOfEach, MobilitySet};
use crate::{Gravity, Hydrodynamics, LoadSet, Repulsion, Scene, SceneError, Squirmer, are_unlike};

/// The variables in which the motion is integrated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum State {
    /// Both orientations lie along the line of centres, which stays where it is: position along it
    /// and `ln eps`.
    Axisymmetric,
    /// The pair is its own image under the rotation by pi about its midpoint, which stays where it
    /// is: angle of the line of centres, `ln eps`, one orientation.
    PointSymmetric,
    /// The pair is its own image in a mirror between the squirmers, which stays where it is:
    /// position along the mirror, `ln eps`, one orientation.
    MirrorSymmetric,
    /// Midpoint in the plane, angle of the line of centres, `ln eps`, two orientations.
    Planar,
    /// Midpoint, line of centres, `ln eps`, two orientations as vectors.
    Spatial,
}

impl State {
    /// All states, that with the fewest numbers first.
    pub const ALL: [Self; 5] = [
        Self::Axisymmetric,
        Self::PointSymmetric,
        Self::MirrorSymmetric,
        Self::Planar,
        Self::Spatial,
    ];

    /// Numbers in it.
    #[must_use]
    pub fn numbers(self) -> usize {
        match self {
            Self::Axisymmetric => 2,
            Self::PointSymmetric | Self::MirrorSymmetric => 3,
            Self::Planar => 6,
            Self::Spatial => 13,
        }
    }

    /// The numbers in words.
    #[must_use]
    pub fn variables(self) -> &'static str {
        match self {
            Self::Axisymmetric => "position along the line of centres, ln eps",
            Self::PointSymmetric => "angle of the line of centres, ln eps, one orientation",
            Self::MirrorSymmetric => "position along the mirror, ln eps, one orientation",
            Self::Planar => "midpoint, angle of the line of centres, ln eps, two orientations",
            Self::Spatial => "midpoint, line of centres, ln eps, two orientations as vectors",
        }
    }

    /// Name in tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Axisymmetric => "axisymmetric",
            Self::PointSymmetric => "point-symmetric",
            Self::MirrorSymmetric => "mirror-symmetric",
            Self::Planar => "planar",
            Self::Spatial => "spatial",
        }
    }
}

impl std::fmt::Display for State {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.pad(self.name())
    }
}

/// What is computed for a scene. The motion is dispatched from it and from nothing else.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    pub(crate) scene: Scene,
    pub(crate) start: Configuration,
    state: State,
    /// The plane that the motion is run in, where that is not one of constant z.
    plane: Option<Plane>,
    repulsion: Option<Repulsion>,
    gravity: Option<Gravity>,
    /// Highest swirl mode, 0 without swirl.
    swirl: usize,
    /// Whether the squirmers are identical and face each other or turn their backs, along the line of
    /// centres.
    opposed: bool,
}

impl Plan {
    /// The plan of a scene: every effect that can change its motion, on the smallest state that
    /// can hold it.
    ///
    /// # Errors
    /// [`SceneError`] if the spheres overlap at the start or an orientation has no direction.
    ///
    /// ```
    /// use scene::{Plan, Pose, Scene, Squirmer, State};
    /// let squirmer = Squirmer::with_beta(1.0, 5.0)?;
    /// let start = [Pose::planar(-1.5, 0.0, 0.0), Pose::planar(1.5, 0.0, 180.0)];
    /// let plan = Plan::new(&Scene::new([squirmer; 2], start, None, None)?)?;
    /// assert_eq!(plan.state(), State::Axisymmetric);
    /// assert!(plan.repulsion().is_none());
    /// # Ok::<(), scene::SceneError>(())
    /// ```
    pub fn new(scene: &Scene) -> Result<Self, SceneError> {
        let gravity = acting_gravity(scene);
        let start = start(scene)?;
        let swirl = acting_swirl(scene);
        let (state, plane) = symmetry::smallest_state(scene, &start, gravity, swirl > 0);
        let [one, two] = &scene.squirmers;
        // Of orientations along the line of centres.
        let facing = start.orientations[0].dot(&start.orientations[1]) < 0.0;
        Ok(Self {
            state,
            plane,
            opposed: one == two && facing,
            // What turns a squirmer about the line of centres along which it points changes nothing.
            swirl: if state == State::Axisymmetric {
                0
            } else {
                swirl
            },
            start,
            repulsion: scene.repulsion,
            gravity,
            scene: scene.clone(),
        })
    }

    /// Whether the squirmers have unlike radii, so that each has coefficients of its own.
    #[must_use]
    pub fn has_unlike_radii(&self) -> bool {
        are_unlike(self.scene.ratio())
    }

    /// Refuses a model of other radii.
    pub(crate) fn check_ratio<H: Hydrodynamics + ?Sized>(
        &self,
        model: &H,
    ) -> Result<(), SceneError> {
        let (asked, model) = (self.scene.ratio(), model.description().ratio);
        #[expect(clippy::float_cmp, reason = "a model is for one ratio, exactly")]
        if asked == model {
            Ok(())
        } else {
            Err(SceneError::OtherRatio { model, asked })
        }
    }

    /// The same without the use of symmetries: on the planar or the spatial state.
    #[must_use]
    pub fn without_symmetry(self) -> Self {
        let swirl = acting_swirl(&self.scene);
        let (state, plane) =
            symmetry::full_state(&self.scene, &self.start, self.gravity, swirl > 0);
        Self {
            state,
            plane,
            swirl,
            ..self
        }
    }

    /// The same in three dimensions, whether the scene calls for them or not.
    #[must_use]
    pub fn in_three_dimensions(self) -> Self {
        Self {
            state: State::Spatial,
            plane: None,
            ..self
        }
    }

    /// The same without repulsion.
    #[must_use]
    pub fn without_repulsion(self) -> Self {
        Self {
            repulsion: None,
            ..self
        }
    }

    /// The same without gravity; the state is kept.
    #[must_use]
    pub fn without_gravity(self) -> Self {
        Self {
            gravity: None,
            ..self
        }
    }

    /// The same with one squirmer passive; the state is kept, whose symmetry that may break.
    #[must_use]
    pub fn without_squirming(mut self, k: usize) -> Self {
        if let Some(squirmer) = self.scene.squirmers.get_mut(k)
            && let Ok(passive) = Squirmer::new(&[]).and_then(|s| s.with_radius(squirmer.radius()))
        {
            *squirmer = passive;
        }
        self
    }

    /// The same with the gravity of the scene, if it has one, although nothing is turned by it; without
    /// the use of symmetries.
    #[must_use]
    pub fn with_idle_gravity(self) -> Self {
        let (swirl, gravity) = (acting_swirl(&self.scene), self.scene.gravity);
        let (state, plane) = symmetry::full_state(&self.scene, &self.start, gravity, swirl > 0);
        Self {
            state,
            plane,
            gravity,
            swirl,
            ..self
        }
    }

    /// The scene.
    #[must_use]
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The configuration in which the scene starts.
    #[must_use]
    pub fn start(&self) -> &Configuration {
        &self.start
    }

    /// The variables of the motion.
    #[must_use]
    pub fn state(&self) -> State {
        self.state
    }

    /// Whether the motion stays in a plane of constant z.
    #[must_use]
    pub fn is_level(&self) -> bool {
        match self.state {
            State::Axisymmetric => self.start.line.z == 0.0,
            State::Spatial => false,
            _ => self.plane.is_none(),
        }
    }

    /// The plane that the motion is run in, where that is not one of constant z.
    pub(crate) fn plane(&self) -> Option<&Plane> {
        self.plane.as_ref()
    }

    /// The start as the equation of motion has it.
    pub(crate) fn start_in_frame(&self) -> Configuration {
        (self.plane()).map_or(self.start, |plane| plane.within(&self.start))
    }

    /// Gravity as the equation of motion has it.
    pub(crate) fn gravity_in_frame(&self) -> Option<Gravity> {
        let seen = |gravity| (self.plane()).map_or(gravity, |plane| plane.gravity_within(gravity));
        self.gravity.map(seen)
    }

    /// Repulsion, if it runs.
    #[must_use]
    pub fn repulsion(&self) -> Option<Repulsion> {
        self.repulsion
    }

    /// Gravity, if it runs.
    #[must_use]
    pub fn gravity(&self) -> Option<Gravity> {
        self.gravity
    }

    /// Highest swirl mode that acts, 0 if none does.
    #[must_use]
    pub fn swirl(&self) -> usize {
        self.swirl
    }

    /// The same without swirl; the state is kept.
    #[must_use]
    pub fn without_swirl(self) -> Self {
        Self { swirl: 0, ..self }
    }

    /// Gap from which on the squirmers fly freely, in closed form, if there is one: where neither
    /// hydrodynamics nor repulsion acts.
    #[must_use]
    pub fn free_flight_beyond<H: Hydrodynamics + ?Sized>(&self, model: &H) -> Option<f64> {
        // Under a model with a cut the paper's repulsion has died out at it; without hydrodynamics it
        // acts alone.
        model
            .cutoff()
            .filter(|cut| *cut > 0.0 || self.repulsion.is_none())
    }

    /// The loads that are asked of the model.
    #[must_use]
    pub fn load_set(&self) -> LoadSet {
        let modes = self.scene.modes();
        let set = match self.state {
            // Neither drifts along its line.
            State::Axisymmetric if self.opposed => LoadSet::axial(modes).mirror_symmetric(),
            State::Axisymmetric => LoadSet::axial(modes),
            State::PointSymmetric => LoadSet::planar(modes).point_symmetric(),
            State::MirrorSymmetric => LoadSet::planar(modes).mirror_symmetric(),
            State::Planar | State::Spatial => LoadSet::planar(modes),
        };
        LoadSet {
            // Without a torque about the line of centres nothing but slip across it turns a squirmer.
            twist: self.state == State::Spatial && (self.gravity.is_some() || self.swirl > 0),
            swirl: self.swirl,
            ..set
        }
    }

    /// The number of coefficients that the motion reads: of unlike radii each squirmer has its own.
    #[must_use]
    pub fn mobility_count(&self) -> usize {
        let set = self.mobility_set();
        if self.has_unlike_radii() {
            MobilityOfEach::default().named(set).len()
        } else {
            set.count()
        }
    }

    /// The coefficients that the motion reads.
    #[must_use]
    pub fn mobility_set(&self) -> MobilitySet {
        MobilitySet {
            loads: self.load_set(),
            torque: self.gravity.is_some(),
        }
    }
}

/// Gravity, if there is any and a squirmer that it turns.
fn acting_gravity(scene: &Scene) -> Option<Gravity> {
    let turns = scene.squirmers.iter().any(|s| s.gravity_torque() != 0.0);
    scene.gravity.filter(|_| turns)
}

/// Highest swirl mode, 0 if swirl has no effect: `C_1` alone turns a squirmer about its own axis, which
/// changes nothing, whatever is around it.
fn acting_swirl(scene: &Scene) -> usize {
    let [one, two] = &scene.squirmers;
    let highest = one.swirl().len().max(two.swirl().len());
    if highest > 1 { highest } else { 0 }
}
