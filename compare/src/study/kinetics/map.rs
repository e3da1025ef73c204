//! Maps of collisions in three dimensions: many incoming pairs, and what comes out of each.

use std::time::{Duration, Instant};

use scene::nalgebra::Vector3;
use scene::{LoadSet, RunOptions};
use serde::{Deserialize, Serialize};

use super::collider::{Begins, Collider, Outgoing};
use super::incoming::{Contact, Impact, Incoming};
use super::points::{MOST, point};
use crate::columns::{self, columns};
use crate::no_run::{FAILED, SKIPPED};
use crate::numbers::written;
use crate::output::{OutputFolder, csv_lines};
use crate::sweep::{
    Axis, Computed, Done, Manifest, ManifestModel, Row, Share, Sweep, SweepIdentity,
};
use crate::{CompareError, Method, Model};

/// Name of the file of the rows, without its ending.
const NAME: &str = "collisions";

/// Largest number of collisions of a model and beta.
const MOST_COLLISIONS: usize = 1 << 40;

/// The first seed of the points: others than those of the integrals.
const SEED: u32 = 1 << 24;

/// Which pairs a map begins with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Starts {
    /// From infinity, with impact parameters up to this one, in radii.
    Impact(f64),
    /// At the gap 1, closing in.
    Contact,
}

columns! {
    /// A row for each method, beta and incoming pair. Pairs come as often as in a dilute suspension with isotropic headings. Incoming means at
    /// infinity, or at the gap 1 with `--by contact`. Vectors have `x` along the incoming velocity of squirmer 1 relative to
    /// squirmer 2, `y` along the sum of the incoming headings. A pair that does not part has no outgoing headings: NaN.
    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    pub struct CollisionRow {
        /// Name of the method.
        #[unit = "-"]
        pub method: Method,
        /// Squirming parameter B2/B1 of both squirmers; positive for pullers, negative for pushers.
        #[unit = "-"]
        pub beta: f64,
        /// Angle between the incoming headings.
        #[unit = "deg"]
        pub between_deg: f64,
        /// Impact parameter of the straight incoming paths.
        #[unit = "a"]
        pub impact: f64,
        /// Angle of the way from path 2 to path 1, where they are nearest, about `x` from `y`.
        #[unit = "deg"]
        pub roll_deg: f64,
        /// Angle between incoming heading 1 and the direction to squirmer 2, where straight paths reach the gap 1; NaN if they do not.
        #[unit = "deg"]
        pub polar1_deg: f64,
        /// Angle between incoming heading 2 and the direction to squirmer 1 there.
        #[unit = "deg"]
        pub polar2_deg: f64,
        /// Angle from heading 1 to heading 2 about the line from squirmer 1 to squirmer 2 there.
        #[unit = "deg"]
        pub azimuth_deg: f64,
        /// Angle in space between the incoming and the outgoing heading of squirmer 1.
        #[unit = "deg"]
        pub turn1_deg: f64,
        /// Angle in space between the incoming and the outgoing heading of squirmer 2.
        #[unit = "deg"]
        pub turn2_deg: f64,
        /// Outgoing heading of squirmer 1, along `x`.
        #[unit = "-"]
        pub out1_x: f64,
        /// Outgoing heading of squirmer 1, along `y`.
        #[unit = "-"]
        pub out1_y: f64,
        /// Outgoing heading of squirmer 1, along `z`.
        #[unit = "-"]
        pub out1_z: f64,
        /// Outgoing heading of squirmer 2, along `x`.
        #[unit = "-"]
        pub out2_x: f64,
        /// Outgoing heading of squirmer 2, along `y`.
        #[unit = "-"]
        pub out2_y: f64,
        /// Outgoing heading of squirmer 2, along `z`.
        #[unit = "-"]
        pub out2_z: f64,
        /// Interaction time: the time that the pair spends at gaps up to one radius.
        #[unit = "a/V_s"]
        pub tau: f64,
        /// Outcome of the run.
        #[unit = "-"]
        pub outcome: String,
        /// Smallest gap during the run.
        #[unit = "a"]
        pub min_gap: f64,
    }
}

impl Row for CollisionRow {
    fn outcomes(&self) -> impl Iterator<Item = &str> {
        std::iter::once(self.outcome.as_str())
    }
}

/// Without digits that are smaller than the error of any run.
fn told(value: f64) -> f64 {
    (value * 1e10).round() / 1e10 + 0.0
}

impl CollisionRow {
    /// The row of an incoming pair in its own frame, without a result.
    fn without_run(method: Method, beta: f64, incoming: &Incoming, outcome: &str) -> Self {
        let Impact { between, b, roll } = incoming.impact_coordinates();
        let contact = incoming.contact_coordinates();
        let [polar1, polar2, azimuth] =
            contact.map_or([f64::NAN; 3], |at| [at.polar[0], at.polar[1], at.azimuth]);
        let deg = |angle: f64| told(angle.to_degrees());
        let none = f64::NAN;
        Self {
            method,
            beta,
            between_deg: deg(between),
            impact: told(b),
            roll_deg: deg(roll),
            polar1_deg: deg(polar1),
            polar2_deg: deg(polar2),
            azimuth_deg: deg(azimuth),
            turn1_deg: none,
            turn2_deg: none,
            out1_x: none,
            out1_y: none,
            out1_z: none,
            out2_x: none,
            out2_y: none,
            out2_z: none,
            tau: none,
            outcome: outcome.to_owned(),
            min_gap: none,
        }
    }

    fn of(method: Method, beta: f64, incoming: &Incoming, outgoing: &Outgoing) -> Self {
        let outcome = outgoing.outcome.to_string();
        let row = Self {
            tau: told(outgoing.tau),
            min_gap: outgoing.min_gap,
            ..Self::without_run(method, beta, incoming, &outcome)
        };
        if !outgoing.parts() {
            return row;
        }
        let turn = |k: usize| {
            let (p, q) = (incoming.headings[k], outgoing.headings[k]);
            told(p.cross(&q).norm().atan2(p.dot(&q)).to_degrees())
        };
        let [one, two]: [Vector3<f64>; 2] = outgoing.headings.map(|p| p.map(told));
        Self {
            turn1_deg: turn(0),
            turn2_deg: turn(1),
            out1_x: one.x,
            out1_y: one.y,
            out1_z: one.z,
            out2_x: two.x,
            out2_y: two.y,
            out2_z: two.z,
            ..row
        }
    }
}

/// A map of collisions. Models are the outer loop, then betas, then incoming pairs.
pub struct CollisionSweep<'a> {
    /// The models.
    pub models: &'a [Model],
    /// Squirmer parameters.
    pub betas: &'a [f64],
    /// Where pairs begin.
    pub starts: Starts,
    /// Number of incoming pairs, the same ones for every model and beta.
    pub count: usize,
    /// The share of the rows that this process runs.
    pub share: Share,
    /// Options of each run, of which tolerance and distance at which headings are read count.
    pub run: RunOptions,
    /// Time after which no further piece begins.
    pub time_limit: Option<Duration>,
    /// The folder for the rows.
    pub out: &'a OutputFolder,
}

impl CollisionSweep<'_> {
    /// Checks what a user may have given, before models are set up.
    ///
    /// # Errors
    /// [`CompareError::Input`].
    pub fn checked_options(&self) -> Result<(), CompareError> {
        if !(1..=MOST_COLLISIONS).contains(&self.count) {
            let allowed = "give a number of collisions, 1 or more";
            return Err(CompareError::input("--count", self.count, allowed));
        }
        if let Starts::Impact(b) = self.starts
            && !(b > 0.0 && b <= 1000.0)
        {
            let allowed = "give an impact parameter greater than 0, at most 1000 radii";
            return Err(CompareError::input("--impact", written(b), allowed));
        }
        Ok(())
    }

    fn checked_share(&self) -> Result<(), CompareError> {
        let all = self.all();
        if self.share.units(all).is_empty() {
            let allowed = format!("there are {all} rows: give at most {all} shares");
            return Err(CompareError::input("--partition", self.share, allowed));
        }
        Ok(())
    }

    fn all(&self) -> usize {
        (self.models.len() * self.betas.len()).saturating_mul(self.count)
    }

    /// The model, beta and incoming pair of a row.
    fn of(&self, row: usize) -> (&Model, f64, Incoming) {
        let (map, index) = (row / self.count, row % self.count);
        let point = point(index, SEED + (index / MOST) as u32);
        let incoming = match self.starts {
            Starts::Impact(b) => Impact::of_point(point, (0.0, b)).incoming(),
            Starts::Contact => Contact::of_point(point).incoming(),
        };
        let (model, beta) = (map / self.betas.len(), map % self.betas.len());
        (&self.models[model], self.betas[beta], incoming)
    }

    fn compute(&self, row: usize) -> Result<Computed, CompareError> {
        let (model, beta, incoming) = self.of(row);
        let begins = match self.starts {
            Starts::Impact(_) => Begins::Infinity,
            Starts::Contact => Begins::Contact,
        };
        let outgoing = Collider::new(model, beta, &self.run)
            .map_err(CompareError::from)
            .and_then(|collider| collider.collide(&incoming, begins, false));
        let method = model.method();
        let (row, failure) = match outgoing {
            Ok(outgoing) => (CollisionRow::of(method, beta, &incoming, &outgoing), None),
            Err(error) => (
                CollisionRow::without_run(method, beta, &incoming, FAILED),
                Some(format!(
                    "{method}, beta {}, collision {row}: {}",
                    written(beta),
                    error.in_one_line()
                )),
            ),
        };
        let lines = csv_lines(&[row])?;
        Ok(Computed { lines, failure })
    }

    fn skipped(&self, row: usize) -> Result<Computed, CompareError> {
        let (model, beta, incoming) = self.of(row);
        let row = CollisionRow::without_run(model.method(), beta, &incoming, SKIPPED);
        Ok(Computed {
            lines: csv_lines(&[row])?,
            failure: None,
        })
    }

    fn identity(&self) -> SweepIdentity {
        let starts = match self.starts {
            Starts::Impact(b) => format!("from infinity, impact parameters up to {b:?}"),
            Starts::Contact => "at the gap 1".to_owned(),
        };
        let RunOptions {
            tolerance,
            angles_at,
            ..
        } = self.run;
        SweepIdentity {
            version: format!("squirmers {}", env!("CARGO_PKG_VERSION")),
            family: format!(
                "collisions with the paper's repulsion: {} pairs {starts}",
                self.count
            ),
            axes: vec![Axis {
                name: "beta".to_owned(),
                values: self.betas.to_vec(),
            }],
            models: ManifestModel::of(self.models),
            run: format!("tolerance {tolerance:?}, angles at {angles_at:?}"),
        }
    }

    /// Runs the share, writes `collisions.csv` and passes each row to `each`, in order. Writes the manifest after all rows.
    ///
    /// # Errors
    /// As [`Self::checked_options`] and [`Sweep::run`]; [`CompareError::Input`] for a share without a row.
    pub fn run(&self, each: &mut dyn FnMut(CollisionRow)) -> Result<Done, CompareError> {
        let began = Instant::now();
        self.checked_options()?;
        self.checked_share()?;
        let all = self.all();
        let units = self.share.units(all);
        let identity = self.identity();
        let size = Sweep::size_of(units.len());
        let sweep = Sweep {
            name: NAME,
            units,
            size,
            what: "parts of the map",
            key: identity.key(NAME, self.share, size)?,
            time_limit: self.time_limit,
            out: self.out,
        };
        let kept = sweep.run(|row| self.compute(row))?;
        let header = columns::header::<CollisionRow>();
        let done: Done = kept.write(&header, &|row| self.skipped(row), &mut |row| {
            each(row);
            Ok::<_, CompareError>(())
        })?;
        if done.is_complete() {
            let share = (self.share, all, done.failed);
            let models = (self.models, LoadSet::all(2));
            Manifest::write((self.out, NAME), identity, share, models, began)?;
        }
        Ok(done)
    }
}
