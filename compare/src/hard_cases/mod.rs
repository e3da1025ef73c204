//! Cases in which numbers go wrong first: spheres in contact, stiff forces, unstable states, long runs, broken
//! symmetry. Each row compares a measured value with a bound, the largest value allowed. The bound follows from
//! rounding, from the tolerance or from a closed form; it was derived before anything was measured.

mod boundary_elements;
mod contact;
mod far;
mod long_runs;
mod machine;
mod oscillation;
mod out_of_plane;
mod panels;
mod rows;
mod separatrix;
mod standoff;
mod starts;
mod stiff;
mod submissions;
mod suction;
mod tangents;
mod unlike;

use std::sync::{Mutex, PoisonError};

use scene::mobility::MobilitySet;
use scene::{LoadSet, RunOptions};

use crate::watch::{Pieces, Progress};
use crate::{CompareError, Method, Model, ModelOptions};
pub use rows::{HardCaseRow, Rows};

/// Refinement level of the boundary elements' mesh. A coarse one is enough: these cases do not test the accuracy of
/// the mesh.
pub const MESH: usize = 1;

/// The models that the cases are about.
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
#[derive(Debug)]
pub struct Group {
    /// Name, the column `case`.
    pub name: &'static str,
    /// What could go wrong.
    pub hazard: &'static str,
    run: fn(&Bench, &mut Rows),
}

impl Group {
    /// Runs the cases. A case that fails is a row that breaks its bound.
    #[must_use]
    pub fn rows(&self, bench: &Bench) -> Vec<HardCaseRow> {
        let mut rows = Rows::new(self.name, self.hazard);
        (self.run)(bench, &mut rows);
        rows.finish()
    }
}

/// The cases of long runs: orbits and rest, then oscillations.
fn orbits_and_oscillations(bench: &Bench, rows: &mut Rows) {
    long_runs::cases(bench, rows);
    oscillation::cases(bench, rows);
}

/// All groups.
pub static GROUPS: [Group; 14] = [
    Group {
        name: "contact",
        hazard: "loads diverge: numbers overflow, digits cancel, a mobility is not positive",
        run: contact::cases,
    },
    Group {
        name: "no repulsion",
        hazard: "the gap closes as exp(-exp(t)): steps get ever shorter, or spheres overlap",
        run: suction::cases,
    },
    Group {
        name: "stiff forces",
        hazard: "rates of 1e5 beside rates of 1: far too many steps, or a wrong equilibrium",
        run: stiff::cases,
    },
    Group {
        name: "standoff",
        hazard: "rounding drives a pair out of an unstable equilibrium",
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
        run: orbits_and_oscillations,
    },
    Group {
        name: "out of plane",
        hazard: "motion in three dimensions differs from motion in the plane, or rounding leaves the plane",
        run: out_of_plane::cases,
    },
    Group {
        name: "far",
        hazard: "tables jump where their pieces meet or end",
        run: far::cases,
    },
    Group {
        name: "boundary elements",
        hazard: "an answer is wrong and does not say so",
        run: boundary_elements::cases,
    },
    Group {
        name: "starts",
        hazard: "a run that starts where another one changes or ends does something else than its neighbours",
        run: starts::cases,
    },
    Group {
        name: "tangents",
        hazard: "at contact derivatives lose digits in what diverges",
        run: tangents::cases,
    },
    Group {
        name: "unlike radii",
        hazard: "one sphere is a hundred times as large: digits cancel, or the answer depends on which is named first",
        run: unlike::cases,
    },
    Group {
        name: "submissions",
        hazard: "numbers that nobody means come out as a motion that is none",
        run: submissions::cases,
    },
    Group {
        name: "machine",
        hazard: "inputs at the ends of the number range, sums whose order depends on the threads",
        run: machine::cases,
    },
];

/// Runs groups, as many at once as the pool has threads. `each` gets a group and its rows as soon as they are there,
/// in the order of `groups`: rows that are ready early wait for the groups before them.
///
/// Call it from anywhere, also from a thread of the pool: nothing in it waits for another task. `each` must not wait
/// for one either.
pub fn run(
    bench: &Bench,
    groups: &[&Group],
    each: &mut (dyn FnMut(&Group, Vec<HardCaseRow>) + Send),
) {
    let progress = Progress::begin("groups of hard cases", groups.len(), Pieces::Unlike);
    let ready = Mutex::new(Ready {
        early: groups.iter().map(|_| None).collect(),
        next: 0,
        each,
    });
    let (progress, ready) = (&progress, &ready);
    rayon::scope_fifo(|scope| {
        for (place, group) in groups.iter().enumerate() {
            scope.spawn_fifo(move |_| {
                let rows = group.rows(bench);
                progress.advance();
                let mut ready = ready.lock().unwrap_or_else(PoisonError::into_inner);
                ready.add(groups, place, rows);
            });
        }
    });
}

/// Rows on their way to whoever wants them.
struct Ready<'a> {
    /// Rows of groups that are not handed over yet, if they are there.
    early: Vec<Option<Vec<HardCaseRow>>>,
    /// The group to hand over next.
    next: usize,
    each: &'a mut (dyn FnMut(&Group, Vec<HardCaseRow>) + Send),
}

impl Ready<'_> {
    /// Adds the rows of the group at `place`, and hands over all that are next.
    fn add(&mut self, groups: &[&Group], place: usize, rows: Vec<HardCaseRow>) {
        self.early[place] = Some(rows);
        while let Some(rows) = self.early.get_mut(self.next).and_then(Option::take) {
            (self.each)(groups[self.next], rows);
            self.next += 1;
        }
    }
}

/// Options for a run to `end_time` at a tolerance.
fn until(end_time: f64, tolerance: f64) -> RunOptions {
    RunOptions {
        tolerance,
        end_time,
        ..RunOptions::default()
    }
}

/// Largest relative error of one rounding.
const ROUNDING: f64 = 0.5 * f64::EPSILON;

/// All that any pair of squirmers with two modes reads.
const READ: MobilitySet = MobilitySet {
    loads: LoadSet::all(2),
    torque: true,
};

/// `1 + |y|` for the largest variable `y` of a collision: `ln eps` goes down to about -8.
const SIZE: f64 = 10.0;

/// Largest sum of the errors of a run's steps: each step may be wrong by `tolerance (1 + |y|)`.
fn stepping_error(run: &scene::Run, tolerance: f64) -> f64 {
    run.counters.steps as f64 * tolerance * SIZE
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc;
    use std::time::Duration;

    use rayon::prelude::*;

    use super::*;

    /// Far longer than the groups below take.
    const PATIENCE: Duration = Duration::from_secs(60);

    /// A group of one row, which is there after about so many milliseconds.
    fn row_after<const MILLISECONDS: u64>(_: &Bench, rows: &mut Rows) {
        std::thread::sleep(Duration::from_millis(MILLISECONDS));
        let sum = (0..1000).into_par_iter().sum::<u64>();
        rows.add("none", "sum", (1e6, "arithmetic"), sum as f64);
    }

    /// Names and numbers of rows, as they are handed over by a pool of some threads.
    fn handed_over(threads: usize) -> Vec<(&'static str, usize)> {
        let (send, receive) = mpsc::channel();
        std::thread::spawn(move || {
            let group = |name, run| Group {
                name,
                hazard: "",
                run,
            };
            let groups = [
                group("slow", row_after::<200>),
                group("quick", row_after::<0>),
                group("last", row_after::<0>),
            ];
            let bench = Bench { models: Vec::new() };
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            pool.build().unwrap().install(|| {
                run(&bench, &groups.each_ref(), &mut |group, rows| {
                    send.send((group.name, rows.len())).unwrap();
                });
            });
        });
        let mut all = Vec::new();
        loop {
            match receive.recv_timeout(PATIENCE) {
                Ok(one) => all.push(one),
                Err(mpsc::RecvTimeoutError::Disconnected) => return all,
                Err(mpsc::RecvTimeoutError::Timeout) => panic!("it waits for ever"),
            }
        }
    }

    #[test]
    fn groups_come_in_their_order_though_a_later_one_is_done_first() {
        assert_eq!(handed_over(3), [("slow", 1), ("quick", 1), ("last", 1)]);
    }

    #[test]
    fn groups_end_on_the_only_thread_of_a_pool() {
        assert_eq!(handed_over(1), [("slow", 1), ("quick", 1), ("last", 1)]);
    }

    #[test]
    fn a_case_that_fails_is_a_row_that_breaks_its_bound() {
        let mut rows = Rows::new("case", "hazard");
        rows.attempt("none", "a case", |_| {
            Err(CompareError::input("number", "x", "give another"))
        });
        rows.add("none", "no number", (1.0, "arithmetic"), f64::NAN);
        let rows = rows.finish();
        assert!(rows.iter().all(|row| !row.holds), "{rows:?}");
        assert!(rows[0].measure.contains("'x' is not allowed"), "{rows:?}");
    }
}
