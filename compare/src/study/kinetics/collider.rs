//! What a collision does: from an incoming pair to the outgoing one.

use scene::nalgebra::Vector3;
use scene::{
    Configuration, Gap, Orientation, Outcome, Plan, Pose, Repulsion, Run, RunOptions, Sample,
    Scene, SceneError, Squirmer, far_drift, from_infinity, turned_to_infinity,
};

use super::incoming::{CONTACT, Incoming};
use crate::{CompareError, Model};

/// Smallest distance of the centres at which a run from infinity begins, in radii, and in impact parameters.
const FAR: f64 = 32.0;
const FAR_IMPACTS: f64 = 8.0;

/// A slow pair is turned on its way, by some `beta/(|V| r^2)`: runs begin where that is less than about this share of `|V|`, squared.
const FAR_TURNS: f64 = 12.0;

/// Time that a pair is given besides that of its way on straight paths, in `a/V_s`.
const PATIENCE: f64 = 200.0;

/// Time between the samples from which the way by swimming is summed, in `a/V_s`.
const SAMPLE: f64 = 0.1;

/// A pair after its encounter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outgoing {
    /// The outcome.
    pub outcome: Outcome,
    /// Unit headings at infinity, if the pair parts.
    pub headings: [Vector3<f64>; 2],
    /// How far each squirmer was carried besides its own swimming, `integral of (dx/dt - V_s p) dt`, in radii. Zero if it was not
    /// asked for.
    pub carried: [Vector3<f64>; 2],
    /// Time at gaps up to 1, in `a/V_s`.
    pub tau: f64,
    /// Smallest gap, in radii.
    pub min_gap: f64,
}

impl Outgoing {
    /// A pair that did nothing to each other.
    #[must_use]
    pub fn untouched(incoming: &Incoming) -> Self {
        let chord = 2.0
            * (CONTACT * CONTACT - incoming.impact.norm_squared())
                .max(0.0)
                .sqrt();
        Self {
            outcome: Outcome::Scattered,
            headings: incoming.headings,
            carried: [Vector3::zeros(); 2],
            tau: chord / incoming.velocity().norm(),
            min_gap: incoming.impact.norm() - 2.0,
        }
    }

    /// Whether the pair parts.
    #[must_use]
    pub fn parts(&self) -> bool {
        self.outcome == Outcome::Scattered
    }

    /// Whether the run ended without an answer.
    #[must_use]
    pub fn is_lost(&self) -> bool {
        matches!(self.outcome, Outcome::Contact | Outcome::Unresolved)
    }
}

/// Collisions of two equal squirmers by one model.
#[derive(Clone, Copy)]
pub struct Collider<'a> {
    model: &'a Model,
    squirmers: [Squirmer; 2],
    beta: f64,
    tolerance: f64,
    /// Distance of the centres at which headings are read; infinity for their limit.
    angles_at: f64,
    repulsion: Option<Repulsion>,
    /// Factor of the distance at which runs begin.
    reach: f64,
}

/// Where an encounter begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Begins {
    /// At infinity: the far field has turned and shifted the pair before the run.
    Infinity,
    /// At the gap 1, with the headings that the pair has there.
    Contact,
}

impl<'a> Collider<'a> {
    /// Collisions of squirmers with `beta = B_2/B_1`, with the paper's repulsion at short range. Of the options tolerance and distance at which headings are read count.
    ///
    /// # Errors
    /// [`SceneError::NotFinite`].
    pub fn new(model: &'a Model, beta: f64, options: &RunOptions) -> Result<Self, SceneError> {
        Ok(Self {
            model,
            squirmers: [Squirmer::with_beta(1.0, beta)?; 2],
            beta,
            tolerance: options.tolerance,
            angles_at: options.angles_at,
            repulsion: Some(Repulsion::PAPER),
            reach: 1.0,
        })
    }

    /// The same without repulsion: pairs that swim at each other touch.
    #[must_use]
    pub fn without_repulsion(self) -> Self {
        Self {
            repulsion: None,
            ..self
        }
    }

    /// The same, with runs that begin farther away by a factor.
    #[must_use]
    pub fn from_farther(self, by: f64) -> Self {
        Self {
            reach: self.reach * by,
            ..self
        }
    }

    /// The squirmers.
    #[must_use]
    pub fn squirmers(&self) -> &[Squirmer; 2] {
        &self.squirmers
    }

    /// Distance of the centres at which a run begins that comes from infinity: 32 or 8 impact parameters, or more for slow pairs.
    #[must_use]
    pub fn far(&self, incoming: &Incoming) -> f64 {
        if self.model.cutoff().is_some() {
            // Nothing acts beyond the cut.
            return (CONTACT + 1.0).max(incoming.impact.norm() + 1.0);
        }
        let slow = FAR_TURNS * self.beta.abs().sqrt() / incoming.velocity().norm();
        let wide = FAR_IMPACTS * incoming.impact.norm();
        FAR.max(wide).max(slow) * self.reach
    }

    /// The scene of a pair that comes from infinity, or that is at the gap 1 now.
    ///
    /// # Errors
    /// [`SceneError`] for headings that are parallel, so that the two never meet.
    pub fn scene(&self, incoming: &Incoming, begins: Begins) -> Result<Scene, SceneError> {
        let free = match begins {
            Begins::Infinity => free(incoming, self.far(incoming))?,
            Begins::Contact => free(incoming, CONTACT)?,
        };
        let far_field = begins == Begins::Infinity && self.model.cutoff().is_none();
        let start = if far_field {
            from_infinity(&self.squirmers, &free)?.unwrap_or(free)
        } else {
            free
        };
        let positions = start.positions();
        let poses = [0, 1].map(|k| Pose {
            position: positions[k],
            orientation: Orientation::Vector(start.orientations[k]),
        });
        Scene::new(self.squirmers, poses, self.repulsion, None)
    }

    /// Runs an encounter. `carried` asks for the displacements too, which takes more time.
    ///
    /// # Errors
    /// As [`scene::run`].
    pub fn collide(
        &self,
        incoming: &Incoming,
        begins: Begins,
        carried: bool,
    ) -> Result<Outgoing, CompareError> {
        let plan = Plan::new(&self.scene(incoming, begins)?)?;
        let options = self.options(incoming, carried);
        let mut swum = Swum::default();
        let run = (self.model).run_observed(&plan, &options, &mut |sample| swum.add(sample))?;
        let carried = if carried {
            self.carried(&run, &swum)
        } else {
            [Vector3::zeros(); 2]
        };
        Ok(Outgoing {
            outcome: run.outcome,
            headings: self.headings(&run),
            carried,
            tau: run.contact_time,
            min_gap: run.min_gap,
        })
    }

    fn options(&self, incoming: &Incoming, sampled: bool) -> RunOptions {
        let far = self.far(incoming);
        RunOptions {
            tolerance: self.tolerance,
            end_time: 3.0 * far / incoming.velocity().norm() + PATIENCE,
            departure_distance: 0.5 * FAR.max(FAR_IMPACTS * incoming.impact.norm()) * self.reach,
            angles_at: self.angles_at.min(FAR * self.reach),
            sample_interval: sampled.then_some(SAMPLE),
            ..RunOptions::default()
        }
    }

    /// The headings at infinity: where they are read, and turned by the rest in closed form.
    fn headings(&self, run: &Run) -> [Vector3<f64>; 2] {
        let read = run.outgoing;
        let is_limit = self.angles_at.is_infinite() && self.model.cutoff().is_none();
        if !is_limit || run.outcome != Outcome::Scattered {
            return read.orientations;
        }
        turned_to_infinity(&self.squirmers, &read).map_or(read.orientations, |end| end.orientations)
    }

    /// How far both were carried, from minus to plus infinity.
    fn carried(&self, run: &Run, swum: &Swum) -> [Vector3<f64>; 2] {
        let [from, to] = [&run.start, &run.end].map(Configuration::positions);
        let beyond = if self.model.cutoff().is_none() {
            let before = far_drift(&self.squirmers, &run.start, true);
            let after = far_drift(&self.squirmers, &run.end, false);
            [before, after].map(|drift| drift.unwrap_or_default())
        } else {
            Default::default()
        };
        [0, 1].map(|k| {
            let swum = swum.way[k] * self.squirmers[k].swimming_speed();
            to[k] - from[k] - swum + beyond[0][k] + beyond[1][k]
        })
    }
}

/// Lone squirmers on straight paths, at a distance of the centres before they are nearest.
fn free(incoming: &Incoming, distance: f64) -> Result<Configuration, SceneError> {
    let way = incoming.way(distance);
    let line = -way / way.norm();
    Ok(Configuration {
        radii: [1.0; 2],
        gap: Gap::new(way.norm() - 2.0)?,
        midpoint: Vector3::zeros(),
        line,
        orientations: incoming.headings,
        line_angle_rad: line.y.atan2(line.x),
        angles_rad: incoming.headings.map(|p| p.y.atan2(p.x)),
    })
}

/// The integrals of both headings over the time of a run, by the trapezoidal rule.
#[derive(Default)]
struct Swum {
    way: [Vector3<f64>; 2],
    last: Option<Sample>,
}

impl Swum {
    fn add(&mut self, sample: &Sample) {
        if let Some(last) = self.last {
            let step = 0.5 * (sample.t - last.t);
            for k in [0, 1] {
                self.way[k] += (last.configuration.orientations[k]
                    + sample.configuration.orientations[k])
                    * step;
            }
        }
        self.last = Some(*sample);
    }
}
