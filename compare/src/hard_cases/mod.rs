//! Cases in which numbers go wrong first: spheres in contact, stiff forces, unstable states, long runs,
//! broken symmetry, broken files. Each row measures something that a bound, derived beforehand, limits.

mod boundary_elements;
mod contact;
mod far;
mod files;
mod inputs;
mod long_runs;
mod machine;
mod oscillation;
mod out_of_plane;
mod panels;
mod processes;
mod rows;
mod separatrix;
mod standoff;
mod stiff;
mod suction;

use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use rayon::{ThreadPool, ThreadPoolBuilder};
use scene::RunOptions;

use crate::watch::{Pieces, Progress};
use crate::{CompareError, Method, Model, ModelOptions};
pub use rows::{HardCaseRow, Rows};

/// Refinement level of the boundary elements in these cases: what is tested is not their accuracy.
pub const MESH: usize = 1;

/// The methods, set up once for all cases.
pub struct Bench {
    models: Vec<Model>,
}

impl Bench {
    /// Sets up lubrication theory in both forms, exact loads and boundary elements.
    ///
    /// # Errors
    /// As [`Model::set_up`].
    pub fn set_up(options: &ModelOptions) -> Result<Self, CompareError> {
        const METHODS: [Method; 4] = [Method::Lt, Method::LtCorrected, Method::Exact, Method::Bem];
        let options = ModelOptions {
            mesh: MESH,
            direct: false,
            ..options.clone()
        };
        let models = (METHODS.into_iter())
            .map(|method| Model::set_up(method, &options))
            .collect::<Result<_, _>>()?;
        Ok(Self { models })
    }

    fn models(&self) -> &[Model] {
        &self.models
    }

    /// The models of some methods.
    fn only(&self, methods: &[Method]) -> impl Iterator<Item = &Model> {
        (self.models.iter()).filter(|model| methods.contains(&model.method()))
    }
}

/// Cases of one kind.
pub struct Group {
    /// Name, the column `case`.
    pub name: &'static str,
    /// What could go wrong.
    pub hazard: &'static str,
    run: fn(&Bench, &mut Rows),
}

impl Group {
    /// Runs the cases; a case that fails is a row that does not hold.
    #[must_use]
    pub fn rows(&self, bench: &Bench) -> Vec<HardCaseRow> {
        let mut rows = Rows::new(self.name, self.hazard);
        (self.run)(bench, &mut rows);
        rows.finish()
    }
}

/// All groups.
pub const GROUPS: [Group; 10] = [
    Group {
        name: "contact",
        hazard: "loads diverge: overflow, lost digits, a mobility that is not positive",
        run: contact::cases,
    },
    Group {
        name: "no repulsion",
        hazard: "the gap closes as exp(-exp(t)): the stepper stalls, or spheres overlap",
        run: suction::cases,
    },
    Group {
        name: "stiff forces",
        hazard: "rates of 1e5 beside rates of 1: steps without end, or an equilibrium that is missed",
        run: stiff::cases,
    },
    Group {
        name: "standoff",
        hazard: "rounding tips an unstable equilibrium",
        run: standoff::cases,
    },
    Group {
        name: "separatrix",
        hazard: "the tolerance decides the outcome",
        run: separatrix::cases,
    },
    Group {
        name: "long runs",
        hazard: "small errors add up: phase, symmetry and period drift",
        run: long_runs::cases,
    },
    Group {
        name: "out of plane",
        hazard: "the spatial code departs from the planar one, or noise leaves the plane",
        run: out_of_plane::cases,
    },
    Group {
        name: "far",
        hazard: "tables jump where their pieces meet or end",
        run: far::cases,
    },
    Group {
        name: "boundary elements",
        hazard: "an answer that is wrong without saying so",
        run: boundary_elements::cases,
    },
    Group {
        name: "machine",
        hazard: "numbers at the ends of their range, torn files, threads",
        run: machine::cases,
    },
];

/// All rows of all groups, as many side by side as there are threads.
///
/// Groups run on threads outside the pool, which may wait for one another and for processes: a thread of the pool
/// that waits for work which only the pool can do waits for ever.
#[must_use]
pub fn all_rows(bench: &Bench) -> Vec<HardCaseRow> {
    let next = AtomicUsize::new(0);
    let progress = Progress::begin("groups of hard cases", GROUPS.len(), Pieces::Unlike);
    let work = || {
        let mut done = Vec::new();
        while let Some(group) = GROUPS.get(next.fetch_add(1, Relaxed)) {
            done.push((group.name, group.rows(bench)));
            progress.advance();
        }
        done
    };
    let mut rows: Vec<_> = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..rayon::current_num_threads())
            .map(|_| scope.spawn(work))
            .collect();
        (threads.into_iter())
            .flat_map(|thread| match thread.join() {
                Ok(done) => done,
                Err(panic) => std::panic::resume_unwind(panic),
            })
            .collect()
    });
    rows.sort_by_key(|(name, _)| GROUPS.iter().position(|group| group.name == *name));
    rows.into_iter().flat_map(|(_, rows)| rows).collect()
}

/// A pool of threads apart from the common one.
fn pool(threads: usize) -> Result<ThreadPool, CompareError> {
    (ThreadPoolBuilder::new().num_threads(threads).build())
        .map_err(|error| CompareError::input("threads", threads, error.to_string()))
}

/// Options for a run to `end_time` at a tolerance.
fn until(end_time: f64, tolerance: f64) -> RunOptions {
    RunOptions {
        tolerance,
        end_time,
        ..RunOptions::default()
    }
}

/// `1 + |y|` for the largest variable of a collision: `ln eps` goes down to -8.
const SIZE: f64 = 10.0;

/// What the steps of a run may add up to: each is allowed `tolerance (1 + |y|)`.
fn stepping_error(run: &scene::Run, tolerance: f64) -> f64 {
    run.counters.steps as f64 * tolerance * SIZE
}
