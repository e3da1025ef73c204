//! Hydrodynamic models as the commands use them: closed forms, tables, or a solve for every load.

use std::ops::Deref;
use std::sync::Arc;
use std::time::Instant;

use bem::Bem;
use exact::Exact;
use lt::{Form, Lubrication, UnlikeLubrication};
use rayon::ThreadPoolBuilder;
use scene::{
    Configuration, Gap, Hydrodynamics, Isolated, LoadSet, Plan, PlanRow, Rates, Run, RunOptions,
    Sample, Scene, SceneError, TableOptions, TableSummary, Tabulated, are_unlike, rates,
    run_observed,
};

use crate::scene_file::Hydrodynamics as InFiles;
use crate::stoppable::{self, Stoppable};
use crate::submission::is_raised;
use crate::watch::{Pieces, Progress};
use crate::{CompareError, Method, ModelOptions, NoRun};

/// Interpolation error of the tables of boundary elements, an error of velocity by unit slip. It is far
/// below the error of the boundary elements, and more than small enough for deflections within 0.01 degrees.
pub const BEM_TABLE_TOLERANCE: f64 = 1e-6;

/// Interpolation error of the exact tables, an error of velocity by unit slip.
pub const EXACT_TABLE_TOLERANCE: f64 = 1e-9;

/// Interpolation error of the tables of models from outside that are dear.
const OTHER_TABLE_TOLERANCE: f64 = 1e-6;

/// Right-hand sides in one timing, and number of timings. The shortest timing counts, because other work of the
/// machine can only add time.
const RATES: (usize, usize) = (2000, 15);

/// Right-hand sides in one timing, and number of timings, for a model that solves for every load.
const SOLVED_RATES: (usize, usize) = (1, 2);

/// A model chosen at run time.
pub(crate) type AnyModel = Arc<dyn Hydrodynamics>;

/// The closed form has so quick a right-hand side that it has a compiled loop of its own. Tables and models that solve for
/// every load share one: a virtual call costs them nothing noticeable.
#[derive(Clone)]
enum Kind {
    Lubrication(Lubrication),
    Table(Arc<Tabulated>),
    Direct(AnyModel),
    /// A closed form of unlike radii.
    Closed(AnyModel),
    /// A model from outside this workspace.
    Other(&'static dyn Hydrodynamics),
}

/// A method ready to run. Clones share its tables.
#[derive(Clone)]
pub struct Model {
    method: Method,
    mesh: usize,
    /// The ratio of the radii that is named first, and the model of it, which answers where none is named.
    first: (f64, Kind),
    others: Vec<(f64, Kind)>,
    set_up_seconds: f64,
}

impl Model {
    /// Sets up `method` for each ratio of radii that `options` name. Loads or builds its tables, and shows the progress, unless they ask for
    /// direct solves. A model from outside is of its own ratio alone: runs of other ones fail.
    ///
    /// # Errors
    /// [`CompareError`] if the mesh level is not allowed or a solve fails; [`CompareError::Input`] for a model from outside
    /// that lacks one of the loads to be tabulated.
    pub fn set_up(method: Method, options: &ModelOptions) -> Result<Self, CompareError> {
        let started = Instant::now();
        let of =
            |&ratio: &f64| Ok::<_, CompareError>((ratio, Kind::set_up(method, ratio, options)?));
        let (first, others) = match (method, options.ratios.split_first()) {
            (Method::Other(other), _) => (other.hydrodynamics().description().ratio, &[][..]),
            (_, Some((first, others))) => (*first, others),
            (_, None) => (1.0, &[][..]),
        };
        Ok(Self {
            method,
            mesh: options.mesh,
            first: of(&first)?,
            others: others.iter().map(of).collect::<Result<_, _>>()?,
            set_up_seconds: started.elapsed().as_secs_f64(),
        })
    }

    /// The method.
    #[must_use]
    pub fn method(&self) -> Method {
        self.method
    }

    /// The model's name in scene files.
    #[must_use]
    pub fn as_in_files(&self) -> InFiles {
        InFiles {
            method: self.method,
            mesh: self.mesh,
            direct: self.is_direct(),
        }
    }

    /// Wall-clock time of [`Self::set_up`], in seconds.
    #[must_use]
    pub fn set_up_seconds(&self) -> f64 {
        self.set_up_seconds
    }

    /// Whether the model solves for every load.
    #[must_use]
    pub fn is_direct(&self) -> bool {
        matches!(self.first(), Kind::Direct(_))
    }

    /// How the table was built; `None` for a model without a table.
    #[must_use]
    pub fn table(&self) -> Option<TableSummary> {
        match self.first() {
            Kind::Table(table) => Some(table.summary()),
            _ => None,
        }
    }

    /// The loads whose balance the model's table holds; `None` for a model without a table.
    #[must_use]
    pub fn tabulated(&self) -> Option<LoadSet> {
        match self.first() {
            Kind::Table(table) => Some(table.set()),
            _ => None,
        }
    }

    /// Runs a scene.
    ///
    /// # Errors
    /// As [`scene::run`].
    pub fn run(&self, scene: &Scene, options: &RunOptions) -> Result<Run, SceneError> {
        let plan = Plan::new(scene)?;
        let mut samples = Vec::new();
        let run = self.run_observed(&plan, options, &mut |sample| samples.push(*sample))?;
        Ok(Run { samples, ..run })
    }

    /// Runs a scene for a row: an error becomes the reason, in one line, why there is no run.
    pub(crate) fn attempt(
        &self,
        scene: Result<Scene, CompareError>,
        options: &RunOptions,
    ) -> Result<Run, NoRun> {
        let run = scene.and_then(|scene| Ok(self.run(&scene, options)?));
        run.map_err(|error| NoRun::Failed(error.in_one_line()))
    }

    /// Runs a plan and passes on each sample as soon as it is computed.
    ///
    /// # Errors
    /// As [`scene::run_observed`]; [`SceneError::Model`] if work was given up ([`crate::watch::give_up`]).
    pub fn run_observed(
        &self,
        plan: &Plan,
        options: &RunOptions,
        observe: &mut dyn FnMut(&Sample),
    ) -> Result<Run, SceneError> {
        stoppable::check()?;
        match self.of(plan) {
            Kind::Lubrication(model) => model.run(plan, options, observe),
            other => run_observed(plan, other.hydrodynamics(), options, observe),
        }
    }

    /// Evaluates the right-hand side of a plan `times` times.
    ///
    /// # Errors
    /// As [`scene::rates`].
    pub fn rates(
        &self,
        plan: &Plan,
        configuration: &Configuration,
        times: usize,
    ) -> Result<Rates, SceneError> {
        match self.of(plan) {
            Kind::Lubrication(model) => model.rates(plan, configuration, times),
            other => rates(plan, other.hydrodynamics(), configuration, times),
        }
    }

    /// Seconds of one right-hand side of a plan at `configuration`: the smallest of a few batches, or of a few single
    /// evaluations for a model that solves for every load.
    ///
    /// # Errors
    /// As [`Self::rates`].
    pub fn seconds_of_rates(
        &self,
        plan: &Plan,
        configuration: &Configuration,
    ) -> Result<f64, SceneError> {
        let (times, batches) = if self.is_direct() {
            SOLVED_RATES
        } else {
            RATES
        };
        let mut best = f64::INFINITY;
        for _ in 0..batches {
            let started = Instant::now();
            self.rates(plan, configuration, times)?;
            best = best.min(started.elapsed().as_secs_f64() / times as f64);
        }
        Ok(best)
    }

    /// Every effect of a plan, in words.
    #[must_use]
    pub fn explain(&self, plan: &Plan) -> Vec<PlanRow> {
        plan.rows(self.of(plan).hydrodynamics())
    }

    /// Fingerprint of the models of all ratios of radii, in one line.
    #[must_use]
    pub fn fingerprint(&self) -> String {
        let each = self.of_each_ratio().map(Hydrodynamics::fingerprint);
        each.collect::<Vec<_>>().join("; ")
    }

    /// The models of all ratios of radii.
    pub(crate) fn of_each_ratio(&self) -> impl Iterator<Item = &dyn Hydrodynamics> {
        let all = std::iter::once(&self.first).chain(&self.others);
        all.map(|(_, kind)| kind.hydrodynamics() as &dyn Hydrodynamics)
    }

    /// The model of a ratio of the radii, if there is one.
    pub(crate) fn of_ratio(&self, asked: f64) -> Option<&dyn Hydrodynamics> {
        Some(self.kind_of(asked)?.hydrodynamics())
    }

    /// The same; another one, which refuses these radii, where there is none.
    pub(crate) fn of_ratio_or_first(&self, asked: f64) -> &dyn Hydrodynamics {
        self.kind_of(asked).unwrap_or(self.first()).hydrodynamics()
    }

    fn kind_of(&self, asked: f64) -> Option<&Kind> {
        #[expect(clippy::float_cmp, reason = "a model is for one ratio, exactly")]
        let found = std::iter::once(&self.first)
            .chain(&self.others)
            .find(|(ratio, _)| *ratio == asked);
        found.map(|(_, kind)| kind)
    }

    fn first(&self) -> &Kind {
        &self.first.1
    }

    /// The model of the radii of a plan; another one, which refuses them, where there is none.
    fn of(&self, plan: &Plan) -> &Kind {
        self.kind_of(plan.scene().ratio()).unwrap_or(self.first())
    }
}

impl Kind {
    fn set_up(method: Method, ratio: f64, options: &ModelOptions) -> Result<Self, CompareError> {
        let lubrication = |form| {
            Ok(if are_unlike(ratio) {
                Self::Closed(Arc::new(UnlikeLubrication::new(form, ratio)?))
            } else {
                Self::Lubrication(Lubrication::new(form))
            })
        };
        let solved = |model: AnyModel, tolerance| {
            let model: AnyModel = Arc::new(Stoppable(model));
            Ok(if options.direct {
                Self::Direct(model)
            } else {
                Self::Table(Arc::new(tabulate(model, method, tolerance, options)?))
            })
        };
        match method {
            Method::Isolated => Ok(Self::Closed(Arc::new(Isolated::of_ratio(ratio)))),
            Method::Other(other) => {
                let model = other.hydrodynamics();
                check_loads(model, options.tabulated).map_err(|reason| {
                    if is_raised(&reason) {
                        return reason.into();
                    }
                    let allowed = match reason {
                        SceneError::Model { source, .. } => source.to_string(),
                        other => other.to_string(),
                    };
                    CompareError::input("--method", method, allowed)
                })?;
                match other.dear() {
                    Some(model) if !options.direct => {
                        let model = Arc::new(Stoppable(model));
                        // Nobody knows whether it answers the same the next time.
                        let options = ModelOptions {
                            cache: None,
                            ..options.clone()
                        };
                        // Whoever is asked may compute with this library, and answers one question after the other: no thread of the common pool
                        // waits for it.
                        let pool = ThreadPoolBuilder::new().num_threads(1).build();
                        let table = || tabulate(model, method, OTHER_TABLE_TOLERANCE, &options);
                        let table = match pool {
                            Ok(pool) => pool.install(table),
                            Err(_) => table(),
                        };
                        Ok(Self::Table(Arc::new(table?)))
                    }
                    _ => Ok(Self::Other(model)),
                }
            }
            Method::Lt => lubrication(Form::Published),
            Method::LtCorrected => lubrication(Form::Corrected),
            Method::Exact => {
                let exact = Exact::of_ratio(ratio).map_err(SceneError::from)?;
                solved(Arc::new(exact), EXACT_TABLE_TOLERANCE)
            }
            Method::Bem => {
                let bem = Bem::of_ratio(options.mesh, ratio)?;
                solved(Arc::new(bem), BEM_TABLE_TOLERANCE)
            }
        }
    }

    fn hydrodynamics(&self) -> &(dyn Hydrodynamics + 'static) {
        match self {
            Self::Lubrication(model) => model,
            Self::Table(model) => model.as_ref(),
            Self::Direct(model) | Self::Closed(model) => model.as_ref(),
            Self::Other(model) => *model,
        }
    }
}

/// A model answers as what is behind it: with nothing to be handed on method by method, nothing can be forgotten.
impl Deref for Model {
    type Target = dyn Hydrodynamics + 'static;

    fn deref(&self) -> &Self::Target {
        self.first().hydrodynamics()
    }
}

/// Whether a model has all loads of `set`, asked at a gap in its range.
pub(crate) fn check_loads(model: &dyn Hydrodynamics, set: LoadSet) -> Result<(), SceneError> {
    let range = model.range();
    let gap = Gap::new(range.largest.min(1.0).max(range.smallest))?;
    model.interacting_loads_with_swirl(gap, set).map(drop)
}

fn tabulate(
    model: AnyModel,
    method: Method,
    tolerance: f64,
    options: &ModelOptions,
) -> Result<Tabulated, CompareError> {
    let table = TableOptions {
        set: options.tabulated,
        tolerance,
        smallest_gap: model.range().smallest,
    };
    let what = match method {
        Method::Bem => "boundary elements",
        Method::Other(_) => method.name(),
        _ => "exact loads",
    };
    let progress = Progress::begin(what, 0, Pieces::Gaps);
    let follow = |table| progress.follow(table);
    Ok(match &options.cache {
        Some(folder) => Tabulated::load_or_build(model, table, folder, &follow)?,
        None => Tabulated::build(model, table, &follow)?,
    })
}
