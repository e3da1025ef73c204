//! Hydrodynamic models as the commands use them: lubrication, tables, or direct solves.

use std::path::{Path, PathBuf};
use std::time::Instant;

use bem::Bem;
use lt::{Form, Lubrication};
use scene::{
    Gap, GapRange, Hydrodynamics, PairLoads, Run, RunOptions, Scene, SceneError, TableLimit,
    TableOptions, Tabulated, run,
};

use crate::progress::Progress;
use crate::{CompareError, Method};

/// Interpolation error of the tables of boundary elements, relative to the larger of the load and
/// 1: far below their own error, and what a deflection of 0.01 degrees needs with room to spare.
pub const BEM_TABLE_TOLERANCE: f64 = 1e-6;

/// Squirming modes in the tables: all that `beta` calls for.
const TABLE_MODES: usize = 2;

/// How the models are set up.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelOptions {
    /// Refinement level of the boundary elements.
    pub mesh: usize,
    /// Whether every load is solved for, instead of read from a table.
    pub direct: bool,
    /// Folder in which tables are kept from one run to the next, if they are.
    pub cache: Option<PathBuf>,
}

impl Default for ModelOptions {
    fn default() -> Self {
        Self {
            mesh: Bem::DEFAULT_LEVEL,
            direct: false,
            cache: dirs::cache_dir().map(|folder| folder.join("squirmers")),
        }
    }
}

enum Kind {
    Lubrication(Lubrication),
    Table(Box<Tabulated<Bem>>),
    Direct(Box<Bem>),
}

/// A method ready to run.
pub struct Model {
    method: Method,
    kind: Kind,
    set_up_seconds: f64,
}

impl Model {
    /// Sets up `method`: builds the table of boundary elements unless they are to be solved
    /// directly, showing progress on a terminal.
    ///
    /// # Errors
    /// [`CompareError`] if the mesh level is not allowed or a solve fails.
    pub fn set_up(method: Method, options: &ModelOptions) -> Result<Self, CompareError> {
        let started = Instant::now();
        let kind = match method {
            Method::Lt => Kind::Lubrication(Lubrication::new(Form::Published)),
            Method::LtCorrected => Kind::Lubrication(Lubrication::new(Form::Corrected)),
            Method::Bem => {
                let bem = Bem::new(options.mesh)?;
                if options.direct {
                    Kind::Direct(Box::new(bem))
                } else {
                    Kind::Table(Box::new(tabulate(bem, options.cache.as_deref())?))
                }
            }
        };
        Ok(Self {
            method,
            kind,
            set_up_seconds: started.elapsed().as_secs_f64(),
        })
    }

    /// The method.
    #[must_use]
    pub fn method(&self) -> Method {
        self.method
    }

    /// Wall-clock time of [`Self::set_up`], in seconds.
    #[must_use]
    pub fn set_up_seconds(&self) -> f64 {
        self.set_up_seconds
    }

    /// Whether every load is a boundary-element solve.
    #[must_use]
    pub fn is_direct(&self) -> bool {
        matches!(self.kind, Kind::Direct(_))
    }

    /// Number of gaps solved for a table, its interpolation error, and what bounded that error.
    #[must_use]
    pub fn table(&self) -> Option<(usize, f64, TableLimit)> {
        match &self.kind {
            Kind::Table(table) => Some((
                table.evaluations(),
                table.interpolation_error(),
                table.limit(),
            )),
            _ => None,
        }
    }

    /// Runs a scene; each kind of model has its own compiled loop.
    ///
    /// # Errors
    /// As [`scene::run`].
    pub fn run(&self, scene: &Scene, options: &RunOptions) -> Result<Run, SceneError> {
        match &self.kind {
            Kind::Lubrication(model) => run(scene, model, options),
            Kind::Table(model) => run(scene, model.as_ref(), options),
            Kind::Direct(model) => run(scene, model.as_ref(), options),
        }
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
    fn range(&self) -> GapRange {
        self.hydrodynamics().range()
    }

    fn loads(&self, gap: Gap, modes: usize) -> Result<PairLoads, SceneError> {
        self.hydrodynamics().loads(gap, modes)
    }

    fn error_estimate(&self, gap: Gap, modes: usize) -> Result<f64, SceneError> {
        self.hydrodynamics().error_estimate(gap, modes)
    }

    fn fingerprint(&self) -> String {
        self.hydrodynamics().fingerprint()
    }
}

fn tabulate(bem: Bem, cache: Option<&Path>) -> Result<Tabulated<Bem>, CompareError> {
    let options = TableOptions {
        modes: TABLE_MODES,
        tolerance: BEM_TABLE_TOLERANCE,
        smallest_gap: bem.range().smallest,
    };
    let progress = Progress::counting("boundary elements: gaps solved");
    let set = |done| progress.set(done);
    let table = match cache {
        Some(folder) => Tabulated::load_or_build(bem, options, folder, &set)?,
        None => Tabulated::build(bem, options, &set)?,
    };
    progress.finish();
    Ok(table)
}
