//! Entrainment: how far a swimmer that passes a passive sphere moves it.
//!
//! The family `cargo` has the scenes. A displacement is a limit, that on a path from infinity to infinity: the run begins and ends at the same
//! distance of the centres, and what the swimmer's far field moves the cargo before and after, on straight paths, is a closed form
//! ([`scene::far_drift`]). Lubrication theory has no far field, and nothing is added.

use rayon::prelude::*;
use scene::nalgebra::Vector3;
use scene::{Outcome, Run, RunOptions, Scene, far_drift};
use serde::{Deserialize, Serialize};

use crate::columns::{self, columns};
use crate::no_run::{NoRun, RunNumbers};
use crate::output::{OutputFolder, csv_lines};
use crate::scene_file::{FamilyScene, paper_point};
use crate::sweep::{self, Computed, Row, Sweep, SweepOptions};
use crate::{CompareError, Method, Model};

/// A swimmer and its cargo.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cargo {
    /// Squirmer parameter `B_2/B_1` of the swimmer.
    pub beta: f64,
    /// Radius of the cargo over that of the swimmer.
    pub ratio: f64,
    /// Offset of the swimmer's path from the centre of the cargo, in radii of the swimmer.
    pub b: f64,
    /// Distance of the centres at start and end, in radii of the larger one.
    pub far: f64,
}

columns! {
    /// A row for each method, swimmer, cargo and offset. A pair that does not part has no displacement, and a run without
    /// a result has none: NaN.
    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
    pub struct CargoRow {
        /// Name of the method.
        #[unit = "-"]
        pub method: Method,
        /// Squirming parameter B2/B1 of the swimmer; positive for pullers, negative for pushers.
        #[unit = "-"]
        pub beta: f64,
        /// Radius of the cargo over that of the swimmer.
        #[unit = "-"]
        pub ratio: f64,
        /// Offset of the swimmer's path from the centre of the cargo.
        #[unit = "a"]
        pub b: f64,
        /// Displacement of the cargo along the swimmer's first direction, on a path from infinity to infinity.
        #[unit = "a"]
        pub along: f64,
        /// Displacement of the cargo across it, towards the swimmer's path positive.
        #[unit = "a"]
        pub across: f64,
        /// Deflection of the swimmer: outgoing minus incoming angle, at the end of the run.
        #[unit = "deg"]
        pub deflection_deg: f64,
        /// Smallest gap during the run.
        #[unit = "a"]
        pub min_gap: f64,
        /// Interaction time: the time that the pair spends at gaps up to one radius, of the smaller sphere.
        #[unit = "a/V_s"]
        pub tau: f64,
        /// Outcome of the run.
        #[unit = "-"]
        pub outcome: String,
        /// Distance of the centres at start and end of the run.
        #[unit = "a"]
        pub reach: f64,
        /// Displacement before and after the run, which is added in closed form, as a distance. What is left out falls as the square of
        /// `1/reach`.
        #[unit = "a"]
        pub beyond: f64,
    }
}

impl Row for CargoRow {
    fn outcomes(&self) -> impl Iterator<Item = &str> {
        std::iter::once(self.outcome.as_str())
    }
}

impl Cargo {
    fn point(&self) -> Result<FamilyScene, CompareError> {
        let Self {
            beta,
            ratio,
            b,
            far,
        } = *self;
        let values = [("beta", beta), ("lambda", ratio), ("b", b), ("far", far)];
        paper_point("cargo", &values)
    }

    /// The scene.
    ///
    /// # Errors
    /// [`CompareError::FamilyPoint`] for numbers that are not finite, a ratio that is not allowed, and a path that begins within the cargo.
    pub fn scene(&self) -> Result<Scene, CompareError> {
        self.point().map(|point| point.scene)
    }

    fn run(&self, model: &Model, options: &RunOptions) -> Result<Run, NoRun> {
        let point = self.point();
        let options = (point.as_ref()).map_or(*options, |point| RunOptions {
            tolerance: options.tolerance,
            sample_interval: None,
            // Where the run ends.
            angles_at: point.run.departure_distance,
            ..point.run
        });
        model.attempt(point.map(|point| point.scene), &options)
    }

    /// The displacement of the cargo during a run that parts, and that before and after.
    fn moved(run: &Run, scene: &Scene, has_far_field: bool) -> Option<[Vector3<f64>; 2]> {
        let [from, to] = [&run.start, &run.end].map(|at| at.positions()[1]);
        let beyond = if has_far_field {
            let [before, after] = [(&run.start, true), (&run.end, false)]
                .map(|(at, backward)| far_drift(&scene.squirmers, at, backward));
            before?[1] + after?[1]
        } else {
            Vector3::zeros()
        };
        (run.outcome == Outcome::Scattered).then_some([to - from, beyond])
    }

    fn row(&self, model: &Model, run: &Result<Run, NoRun>) -> CargoRow {
        let numbers = RunNumbers::of(run);
        let reach = self.far * self.ratio.max(1.0);
        // Under a cut there is no far field.
        let has_far_field = model.cutoff().is_none();
        let moved = match (run, self.scene()) {
            (Ok(run), Ok(scene)) => Self::moved(run, &scene, has_far_field),
            _ => None,
        };
        let (along, across, beyond) = moved.map_or((f64::NAN, f64::NAN, f64::NAN), |moved| {
            let [during, beyond] = moved;
            let whole = during + beyond;
            let side = if self.b < 0.0 { -1.0 } else { 1.0 };
            // Positions are rounded as the distance is.
            let rounding = 4.0 * f64::EPSILON * reach;
            let true_of = |by: f64| if by.abs() <= rounding { 0.0 } else { by };
            (true_of(whole.x), true_of(side * whole.y), beyond.norm())
        });
        CargoRow {
            method: model.method(),
            beta: self.beta,
            ratio: self.ratio,
            b: self.b,
            along,
            across,
            deflection_deg: numbers.deflections_deg[0],
            min_gap: numbers.min_gap,
            tau: numbers.tau,
            outcome: numbers.outcome,
            reach,
            beyond,
        }
    }
}

/// The rows of some cargoes by some models, not kept.
#[must_use]
pub fn cargo_rows(models: &[Model], cargoes: &[Cargo], options: &RunOptions) -> Vec<CargoRow> {
    let of = |model: &Model, cargo: &Cargo| cargo.row(model, &cargo.run(model, options));
    (models.iter())
        .flat_map(|model| -> Vec<CargoRow> {
            cargoes.par_iter().map(|cargo| of(model, cargo)).collect()
        })
        .collect()
}

/// A sweep of cargoes. Models are the outer loop.
pub struct CargoSweep<'a> {
    /// The models.
    pub models: &'a [Model],
    /// Swimmers and cargoes.
    pub cargoes: &'a [Cargo],
    /// Options of each run, of which the tolerance counts, and the time limit.
    pub options: SweepOptions,
    /// The folder for the rows.
    pub out: &'a OutputFolder,
}

/// Name of the file of the rows, without its ending.
const NAME: &str = "cargo";

impl CargoSweep<'_> {
    fn sweep(&self) -> Sweep<'_> {
        let mut cargoes = crc32fast::Hasher::new();
        for Cargo {
            beta,
            ratio,
            b,
            far,
        } in self.cargoes
        {
            for number in [beta, ratio, b, far] {
                cargoes.update(&number.to_le_bytes());
            }
        }
        let units = self.models.len() * self.cargoes.len();
        let size = Sweep::size_of(units);
        let (count, checksum) = (self.cargoes.len(), cargoes.finalize());
        let rest = format!("{count} cargoes ({checksum:08x}), {size} at a time");
        Sweep {
            name: NAME,
            units: 0..units,
            size,
            what: "parts of the sweep",
            key: sweep::key(NAME, self.models, &self.options.run, &rest),
            time_limit: self.options.time_limit,
            out: self.out,
        }
    }

    /// Checks that no finished rows of another sweep would be deleted.
    ///
    /// # Errors
    /// As [`Sweep::check`].
    pub fn check(&self) -> Result<(), CompareError> {
        self.sweep().check()
    }

    /// Runs all, writes `cargo.csv` and passes each row to `each`, in order. Returns whether all are done.
    ///
    /// # Errors
    /// As [`Sweep::run`] and [`Kept::write`](crate::sweep::Kept::write).
    pub fn run(&self, each: &mut dyn FnMut(CargoRow)) -> Result<bool, CompareError> {
        let of = |unit: usize| {
            let (model, cargo) = (unit / self.cargoes.len(), unit % self.cargoes.len());
            (&self.models[model], &self.cargoes[cargo])
        };
        let computed = |unit: usize, run: Result<Run, NoRun>| -> Result<Computed, CompareError> {
            let (model, cargo) = of(unit);
            let failure = match &run {
                Err(NoRun::Failed(reason)) => {
                    Some(format!("{} {cargo:?}: {reason}", model.method()))
                }
                _ => None,
            };
            Ok(Computed {
                lines: csv_lines(&[cargo.row(model, &run)])?,
                failure,
            })
        };
        let sweep = self.sweep();
        let kept = sweep.run(|unit| {
            let (model, cargo) = of(unit);
            computed(unit, cargo.run(model, &self.options.run))
        })?;
        let done = kept.write(
            &columns::header::<CargoRow>(),
            &|unit| computed(unit, Err(NoRun::Skipped)),
            &mut |row| {
                each(row);
                Ok::<_, CompareError>(())
            },
        )?;
        Ok(done.is_complete())
    }
}

#[cfg(test)]
mod tests;
