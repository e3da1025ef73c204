//! Hydrodynamic models as the commands use them: lubrication, tables, or direct solves.

use std::path::PathBuf;
use std::time::Instant;

use bem::Bem;
use exact::Exact;
use lt::{Form, Lubrication};
use scene::{
    Configuration, Gap, Hydrodynamics, Isolated, LoadSet, ModelDescription, PairLoads, Plan,
    PlanRow, Rates, Run, RunOptions, Sample, Scene, SceneError, SwirlLoads, TableOptions,
    TableSummary, Tabulated, rates_any, run_any,
};

use crate::scene_file::Hydrodynamics as InFiles;
use crate::watch::{Pieces, Progress};
use crate::{CompareError, Method};

/// Interpolation error of the tables of boundary elements, relative to the larger of the load and
/// 1: far below their own error, and what a deflection of 0.01 degrees needs with room to spare.
pub const BEM_TABLE_TOLERANCE: f64 = 1e-6;

/// Interpolation error of the exact tables, relative to the larger of the load and 1.
pub const EXACT_TABLE_TOLERANCE: f64 = 1e-9;

/// Smallest gap of the exact tables: closer, rounding of `1/(4 eps)` would show in what a table
/// interpolates, and the exact loads have a limiting form of their own.
pub(crate) const EXACT_TABLE_FROM: f64 = 1e-7;

/// Right-hand sides over which a time is taken, and how often it is taken: the shortest counts, for everything
/// else that the machine does only adds to it.
const RATES: (usize, usize) = (2000, 15);

/// The same where every load is solved for.
const SOLVED_RATES: (usize, usize) = (1, 2);

/// How the models are set up.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelOptions {
    /// Refinement level of the boundary elements.
    pub mesh: usize,
    /// Whether every load is solved for, instead of read from a table.
    pub direct: bool,
    /// Loads in the tables: by default all of the modes 1 and 2. A table is kept for each set, for its pieces
    /// are those that the hardest of its columns needs: what is read from it never depends on which other
    /// tables there are.
    pub tabulated: LoadSet,
    /// Folder in which tables are kept from one run to the next, if they are.
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
    /// The same with tables of the loads that the motion of some scenes reads, and no others.
    ///
    /// # Errors
    /// [`CompareError::Scene`] if one of them is no scene.
    pub fn for_scenes(
        self,
        scenes: impl IntoIterator<Item = Result<Scene, SceneError>>,
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
pub(crate) type AnyModel = Box<dyn Hydrodynamics>;

/// A closed form's right-hand side is so quick that it has a compiled loop of its own; what looks loads up in a table
/// or solves for them shares one.
enum Kind {
    Lubrication(Lubrication),
    Table(Box<Tabulated<AnyModel>>),
    Direct(AnyModel),
}

/// A method ready to run.
pub struct Model {
    method: Method,
    mesh: usize,
    kind: Kind,
    set_up_seconds: f64,
}

impl Model {
    /// Sets up `method`: loads or builds its table unless it is to be solved directly, showing
    /// how far that is.
    ///
    /// # Errors
    /// [`CompareError`] if the mesh level is not allowed or a solve fails.
    pub fn set_up(method: Method, options: &ModelOptions) -> Result<Self, CompareError> {
        let started = Instant::now();
        let kind = match method {
            Method::Isolated => Kind::Direct(Box::new(Isolated)),
            Method::Lt => Kind::Lubrication(Lubrication::new(Form::Published)),
            Method::LtCorrected => Kind::Lubrication(Lubrication::new(Form::Corrected)),
            Method::Exact if options.direct => Kind::Direct(Box::new(Exact::new())),
            Method::Exact => {
                let spec = (EXACT_TABLE_FROM, EXACT_TABLE_TOLERANCE);
                let table = tabulate(Box::new(Exact::new()), method, spec, options)?;
                Kind::Table(Box::new(table))
            }
            Method::Bem => {
                let bem = Bem::new(options.mesh)?;
                if options.direct {
                    Kind::Direct(Box::new(bem))
                } else {
                    let spec = (bem.range().smallest, BEM_TABLE_TOLERANCE);
                    let table = tabulate(Box::new(bem), method, spec, options)?;
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

    /// The model as scene files say it.
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

    /// Whether every load is solved for.
    #[must_use]
    pub fn is_direct(&self) -> bool {
        matches!(self.kind, Kind::Direct(_)) && self.method != Method::Isolated
    }

    /// How the table was built, if there is one.
    #[must_use]
    pub fn table(&self) -> Option<TableSummary> {
        match &self.kind {
            Kind::Table(table) => Some(table.summary()),
            Kind::Lubrication(_) | Kind::Direct(_) => None,
        }
    }

    /// The loads in its table, if there is one.
    #[must_use]
    pub fn tabulated(&self) -> Option<LoadSet> {
        match &self.kind {
            Kind::Table(table) => Some(table.set()),
            Kind::Lubrication(_) | Kind::Direct(_) => None,
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

    /// Runs a plan and hands over its samples as they come.
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
            _ => run_any(plan, self.hydrodynamics(), options, observe),
        }
    }

    /// The right-hand side of a plan, evaluated `times` times over.
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
            _ => rates_any(plan, self.hydrodynamics(), configuration, times),
        }
    }

    /// Seconds of one right-hand side of a plan at `configuration`: the smallest of a few batches, or of few
    /// single ones where every load is solved for.
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

    /// Every effect of a plan in words.
    #[must_use]
    pub fn explain(&self, plan: &Plan) -> Vec<PlanRow> {
        plan.rows(self.hydrodynamics())
    }

    fn hydrodynamics(&self) -> &dyn Hydrodynamics {
        match &self.kind {
            Kind::Lubrication(model) => model,
            Kind::Table(model) => model.as_ref(),
            Kind::Direct(model) => model.as_ref(),
        }
    }
}

impl Hydrodynamics for Model {
    fn description(&self) -> ModelDescription<'_> {
        self.hydrodynamics().description()
    }

    fn fingerprint(&self) -> String {
        self.hydrodynamics().fingerprint()
    }

    fn interacting_loads(&self, gap: Gap, set: LoadSet) -> Result<PairLoads, SceneError> {
        self.hydrodynamics().interacting_loads(gap, set)
    }

    fn interacting_loads_with_swirl(
        &self,
        gap: Gap,
        set: LoadSet,
    ) -> Result<(PairLoads, SwirlLoads), SceneError> {
        self.hydrodynamics().interacting_loads_with_swirl(gap, set)
    }

    fn error_estimate(&self, gap: Gap, set: LoadSet) -> Result<Option<f64>, SceneError> {
        self.hydrodynamics().error_estimate(gap, set)
    }
}

fn tabulate(
    model: AnyModel,
    method: Method,
    (smallest_gap, tolerance): (f64, f64),
    options: &ModelOptions,
) -> Result<Tabulated<AnyModel>, CompareError> {
    let table = TableOptions {
        set: options.tabulated,
        tolerance,
        smallest_gap,
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
