//! Hydrodynamic models as the commands use them: closed forms, tables, or a solve for every load.

use std::ops::Deref;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Instant;

use bem::Bem;
use exact::Exact;
use lt::{Form, Lubrication};
use scene::{
    Configuration, Gap, Hydrodynamics, Isolated, LoadSet, Plan, PlanRow, Rates, Run, RunOptions,
    Sample, Scene, SceneError, TableOptions, TableSummary, Tabulated, rates, run_observed,
};

use crate::scene_file::Hydrodynamics as InFiles;
use crate::watch::{Pieces, Progress};
use crate::{CompareError, Method, NoRun};

/// Interpolation error of the tables of boundary elements, an error of velocity by unit slip. It is far
/// below the error of the boundary elements, and more than small enough for deflections within 0.01 degrees.
pub const BEM_TABLE_TOLERANCE: f64 = 1e-6;

/// Interpolation error of the exact tables, an error of velocity by unit slip.
pub const EXACT_TABLE_TOLERANCE: f64 = 1e-9;

/// Right-hand sides in one timing, and number of timings. The shortest timing counts, because other work of the
/// machine can only add time.
const RATES: (usize, usize) = (2000, 15);

/// Right-hand sides in one timing, and number of timings, for a model that solves for every load.
const SOLVED_RATES: (usize, usize) = (1, 2);

/// Options for setting up the models.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelOptions {
    /// Level of the mesh of boundary elements.
    pub mesh: usize,
    /// Whether the model solves at every gap instead of reading from a table.
    pub direct: bool,
    /// Loads whose balance the tables hold; by default all loads of the modes 1 and 2. What else a table holds changes no
    /// number.
    pub tabulated: LoadSet,
    /// Folder in which tables are kept from one run to the next; `None` keeps no tables.
    pub cache: Option<PathBuf>,
}

impl Default for ModelOptions {
    fn default() -> Self {
        Self {
            mesh: Bem::DEFAULT_LEVEL,
            direct: false,
            tabulated: LoadSet::all(2),
            cache: dirs::cache_dir().map(|folder| folder.join("squirmers")),
        }
    }
}

impl ModelOptions {
    /// These options, with tables of only what the motion of the given scenes reads.
    ///
    /// # Errors
    /// The error of the first scene that is not valid.
    pub fn for_scenes(
        self,
        scenes: impl IntoIterator<Item = Result<Scene, CompareError>>,
    ) -> Result<Self, CompareError> {
        let mut read: Option<LoadSet> = None;
        for scene in scenes {
            let set = Plan::new(&scene?)?.load_set();
            read = Some(read.map_or(set, |read| read.union(set)));
        }
        let tabulated = read.unwrap_or(LoadSet::axial(0));
        Ok(Self { tabulated, ..self })
    }
}

/// A model chosen at run time.
pub(crate) type AnyModel = Arc<dyn Hydrodynamics>;

/// The closed form has so quick a right-hand side that it has a compiled loop of its own. Tables and models that solve for
/// every load share one: a virtual call costs them nothing noticeable.
enum Kind {
    Lubrication(Lubrication),
    Table(Box<Tabulated>),
    Direct(AnyModel),
    /// A model from outside this workspace.
    Other(&'static dyn Hydrodynamics),
}

/// A method ready to run.
pub struct Model {
    method: Method,
    mesh: usize,
    kind: Kind,
    set_up_seconds: f64,
}

impl Model {
    /// Sets up `method`. Loads or builds its table, and shows the progress, unless `options` ask for direct solves.
    ///
    /// # Errors
    /// [`CompareError`] if the mesh level is not allowed or a solve fails; [`CompareError::Input`] for a model from outside
    /// that lacks one of the loads to be tabulated.
    pub fn set_up(method: Method, options: &ModelOptions) -> Result<Self, CompareError> {
        let started = Instant::now();
        let kind = match method {
            Method::Isolated => Kind::Direct(Arc::new(Isolated)),
            Method::Other(other) => {
                let model = other.hydrodynamics();
                check_loads(model, options.tabulated).map_err(|reason| {
                    CompareError::input("--method", method, reason.to_string())
                })?;
                Kind::Other(model)
            }
            Method::Lt => Kind::Lubrication(Lubrication::new(Form::Published)),
            Method::LtCorrected => Kind::Lubrication(Lubrication::new(Form::Corrected)),
            Method::Exact if options.direct => Kind::Direct(Arc::new(Exact::new())),
            Method::Exact => {
                let table = tabulate(
                    Arc::new(Exact::new()),
                    method,
                    EXACT_TABLE_TOLERANCE,
                    options,
                )?;
                Kind::Table(Box::new(table))
            }
            Method::Bem => {
                let bem = Bem::new(options.mesh)?;
                if options.direct {
                    Kind::Direct(Arc::new(bem))
                } else {
                    let table = tabulate(Arc::new(bem), method, BEM_TABLE_TOLERANCE, options)?;
                    Kind::Table(Box::new(table))
                }
            }
        };
        Ok(Self {
            method,
            mesh: options.mesh,
            kind,
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
        matches!(self.kind, Kind::Direct(_)) && self.method != Method::Isolated
    }

    /// How the table was built; `None` for a model without a table.
    #[must_use]
    pub fn table(&self) -> Option<TableSummary> {
        match &self.kind {
            Kind::Table(table) => Some(table.summary()),
            Kind::Lubrication(_) | Kind::Direct(_) | Kind::Other(_) => None,
        }
    }

    /// The loads whose balance the model's table holds; `None` for a model without a table.
    #[must_use]
    pub fn tabulated(&self) -> Option<LoadSet> {
        match &self.kind {
            Kind::Table(table) => Some(table.set()),
            Kind::Lubrication(_) | Kind::Direct(_) | Kind::Other(_) => None,
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
    /// As [`scene::run_observed`].
    pub fn run_observed(
        &self,
        plan: &Plan,
        options: &RunOptions,
        observe: &mut dyn FnMut(&Sample),
    ) -> Result<Run, SceneError> {
        match &self.kind {
            Kind::Lubrication(model) => model.run(plan, options, observe),
            _ => run_observed(plan, self.hydrodynamics(), options, observe),
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
        match &self.kind {
            Kind::Lubrication(model) => model.rates(plan, configuration, times),
            _ => rates(plan, self.hydrodynamics(), configuration, times),
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
        plan.rows(self.hydrodynamics())
    }

    fn hydrodynamics(&self) -> &(dyn Hydrodynamics + 'static) {
        match &self.kind {
            Kind::Lubrication(model) => model,
            Kind::Table(model) => model.as_ref(),
            Kind::Direct(model) => model.as_ref(),
            Kind::Other(model) => *model,
        }
    }
}

/// A model answers as what is behind it: with nothing to be handed on method by method, nothing can be forgotten.
impl Deref for Model {
    type Target = dyn Hydrodynamics + 'static;

    fn deref(&self) -> &Self::Target {
        self.hydrodynamics()
    }
}

/// Whether a model has all loads of `set`, asked at a gap in its range.
fn check_loads(model: &dyn Hydrodynamics, set: LoadSet) -> Result<(), SceneError> {
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
        _ => "exact loads",
    };
    let progress = Progress::begin(what, 0, Pieces::Gaps);
    let follow = |table| progress.follow(table);
    Ok(match &options.cache {
        Some(folder) => Tabulated::load_or_build(model, table, folder, &follow)?,
        None => Tabulated::build(model, table, &follow)?,
    })
}
