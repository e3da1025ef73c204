//! What a scene is changed by, to first order.

use nalgebra::Vector3;

use crate::frame::Configuration;
use crate::hydrodynamics::central_difference;
use crate::motion::coordinates::Spatial;
use crate::motion::equations::Absent;
use crate::{Gap, MAX_MODES, Scene, SceneError, Squirmer};

/// The derivative of a scene by one number: of its start and of everything in its equation of motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Perturbation {
    /// Of the centres at the start, in radii of the first squirmer.
    pub positions: [Vector3<f64>; 2],
    /// Of the unit orientations at the start, in radians: across them.
    pub orientations: [Vector3<f64>; 2],
    /// Of the squirming modes `B_1, B_2, …` of each squirmer.
    pub modes: [[f64; MAX_MODES]; 2],
    /// Of the swirl modes `C_1, C_2, …` of each squirmer.
    pub swirl: [[f64; MAX_MODES]; 2],
    /// Of `kappa1` and `kappa2`.
    pub repulsion: [f64; 2],
    /// Of the torques of gravity, `V_s G_bh/pi` times the square of the radius.
    pub gravity_torques: [f64; 2],
    /// Of the unit vector along which gravity pulls.
    pub gravity: Vector3<f64>,
    /// Of the radius of the second squirmer.
    pub ratio: f64,
}

impl Perturbation {
    /// No change.
    pub const NONE: Self = Self {
        positions: [Vector3::new(0.0, 0.0, 0.0); 2],
        orientations: [Vector3::new(0.0, 0.0, 0.0); 2],
        modes: [[0.0; MAX_MODES]; 2],
        swirl: [[0.0; MAX_MODES]; 2],
        repulsion: [0.0; 2],
        gravity_torques: [0.0; 2],
        gravity: Vector3::new(0.0, 0.0, 0.0),
        ratio: 0.0,
    };

    /// The derivative of scenes that one number tells apart, where the number is zero: by a central difference of order 8 of what `scene` makes of
    /// `-4 step` to `4 step`. Scenes are smooth in their numbers, so that for steps of a hundredth of what changes them it is good to about 1e-13.
    ///
    /// # Errors
    /// What `scene` refuses, or [`SceneError`] for an orientation without a direction.
    ///
    /// ```
    /// use scene::{Perturbation, Pose, Scene, SceneError, Squirmer};
    /// let raised = |dz: f64| {
    ///     let mut start = [Pose::planar(-1.5, 0.0, 90.0), Pose::planar(1.5, 0.0, 90.0)];
    ///     start[0].position.z = dz;
    ///     Scene::new([Squirmer::with_beta(1.0, 5.0)?; 2], start, None, None)
    /// };
    /// let by_dz = Perturbation::along::<SceneError>(raised, 0.01)?;
    /// assert!((by_dz.positions[0].z - 1.0).abs() < 1e-12);
    /// assert!(by_dz.modes[0][1].abs() < 1e-12);
    /// # Ok::<(), SceneError>(())
    /// ```
    pub fn along<E: From<SceneError>>(
        scene: impl Fn(f64) -> Result<Scene, E>,
        step: f64,
    ) -> Result<Self, E> {
        let mut sum = Self::NONE;
        for (offset, weight) in central_difference(step) {
            sum.add(weight, &Self::from_nothing(&scene(offset)?)?);
        }
        Ok(sum)
    }

    /// The numbers of a scene, as a change of a scene of zeros.
    fn from_nothing(scene: &Scene) -> Result<Self, SceneError> {
        let mut numbers = Self::NONE;
        for (k, (pose, squirmer)) in scene.start.iter().zip(&scene.squirmers).enumerate() {
            numbers.positions[k] = pose.position;
            numbers.orientations[k] = pose.orientation.vector()?;
            numbers.modes[k] = std::array::from_fn(|n| squirmer.mode(n));
            let swirl = squirmer.swirl();
            numbers.swirl[k][..swirl.len()].copy_from_slice(swirl);
            numbers.gravity_torques[k] = squirmer.gravity_torque();
        }
        if let Some(repulsion) = scene.repulsion {
            numbers.repulsion = [repulsion.kappa1(), repulsion.kappa2()];
        }
        if let Some(gravity) = scene.gravity {
            numbers.gravity = gravity.direction();
        }
        numbers.ratio = scene.ratio();
        Ok(numbers)
    }

    /// The largest difference of a number from that of another one, relative to the larger of it and 1.
    #[must_use]
    pub fn distance(&self, other: &Self) -> f64 {
        let [a, b] = [self, other].map(Self::numbers);
        let apart = |(a, b): (f64, f64)| (a - b).abs() / a.abs().max(1.0);
        // A NaN is far from everything.
        a.into_iter()
            .zip(b)
            .map(apart)
            .fold(0.0, |most, of| if of <= most { most } else { of })
    }

    /// All its numbers.
    fn numbers(&self) -> Vec<f64> {
        let vectors = [self.positions, self.orientations].concat();
        let vectors = vectors.into_iter().chain([self.gravity]);
        let modes = [self.modes, self.swirl].concat();
        (vectors.flat_map(|v| [v.x, v.y, v.z]))
            .chain(modes.into_iter().flatten())
            .chain(self.repulsion)
            .chain(self.gravity_torques)
            .chain([self.ratio])
            .collect()
    }

    fn add(&mut self, weight: f64, other: &Self) {
        let add = |to: &mut [f64], from: &[f64]| {
            for (to, from) in to.iter_mut().zip(from) {
                *to += weight * from;
            }
        };
        for k in [0, 1] {
            self.positions[k] += other.positions[k] * weight;
            self.orientations[k] += other.orientations[k] * weight;
            add(&mut self.modes[k], &other.modes[k]);
            add(&mut self.swirl[k], &other.swirl[k]);
        }
        add(&mut self.repulsion, &other.repulsion);
        add(&mut self.gravity_torques, &other.gravity_torques);
        self.gravity += other.gravity * weight;
        self.ratio += weight * other.ratio;
    }

    /// Highest squirming mode and highest swirl mode that change.
    pub(super) fn modes_changed(&self) -> [usize; 2] {
        [&self.modes, &self.swirl].map(|of| {
            let highest = |modes: &[f64; MAX_MODES]| modes.iter().rposition(|b| *b != 0.0);
            (of.iter().filter_map(highest).max()).map_or(0, |n| n + 1)
        })
    }

    /// The squirmers as a step `h` along makes them.
    pub(super) fn squirmers(
        &self,
        squirmers: &[Squirmer; 2],
        h: f64,
    ) -> Result<[Squirmer; 2], SceneError> {
        let changed = |k: usize| {
            let of = &squirmers[k];
            let modes: [f64; MAX_MODES] =
                std::array::from_fn(|n| of.mode(n) + h * self.modes[k][n]);
            let radius = of.radius() + if k == 1 { h * self.ratio } else { 0.0 };
            Squirmer::new(&modes)?.with_radius(radius)
        };
        Ok([changed(0)?, changed(1)?])
    }
}

/// The derivative of a configuration by one number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Variation {
    /// Of the centres, in radii of the first squirmer.
    pub positions: [Vector3<f64>; 2],
    /// Of the unit orientations, in radians: across them.
    pub orientations: [Vector3<f64>; 2],
}

/// Numbers of the linearised state: midpoint, line of centres, `ln eps`, both orientations.
pub(super) const NUMBERS: usize = 13;

/// The coordinates of a state.
pub(super) const CHART: Spatial<Absent> = Spatial { swirl: Absent };

impl Variation {
    /// As the linearised state has it.
    pub(super) fn encoded(&self, ratio: f64, at: &Configuration) -> [f64; NUMBERS] {
        let [x1, x2] = self.positions;
        let separation = x2 - x1;
        let opening = separation.dot(&at.line);
        let mut state = [0.0; NUMBERS];
        let mut store = |from: usize, v: Vector3<f64>| {
            state[from..from + 3].copy_from_slice(v.as_slice());
        };
        store(0, (x1 + x2) * 0.5);
        store(3, (separation - at.line * opening) / at.distance());
        store(7, self.orientations[0]);
        store(10, self.orientations[1]);
        state[6] = (opening - ratio) / at.gap.eps();
        state
    }

    /// Of the linearised state.
    pub(super) fn decoded(state: &[f64], ratio: f64, at: &Configuration) -> Self {
        let vector = |from: usize| Vector3::new(state[from], state[from + 1], state[from + 2]);
        let opening = at.gap.eps() * state[6] + ratio;
        let half = (at.line * opening + vector(3) * at.distance()) * 0.5;
        Self {
            positions: [vector(0) - half, vector(0) + half],
            orientations: [vector(7), vector(10)],
        }
    }

    /// The configuration a step `h` along from `at`, whose second radius changes by `ratio`.
    pub(super) fn step(&self, at: &Configuration, ratio: f64, h: f64) -> Configuration {
        let [x1, x2] = at.positions();
        let [x1, x2] = [x1 + self.positions[0] * h, x2 + self.positions[1] * h];
        let separation = x2 - x1;
        let distance = separation.norm();
        let radii = [at.radii[0], at.radii[1] + ratio * h];
        Configuration {
            radii,
            gap: Gap::from_ln((distance - radii[0] - radii[1]).ln()),
            midpoint: (x1 + x2) * 0.5,
            line: separation / distance,
            orientations: [0, 1]
                .map(|k| (at.orientations[k] + self.orientations[k] * h).normalize()),
            ..*at
        }
    }
}
