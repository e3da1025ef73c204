//! The ends of the number range, torn and shared files, processes, and threads.

use bem::Bem;
use scene::{LoadSet, TableOptions, Tabulated};

use super::files::{bits, damaged_tables, shared_folders};
use super::inputs::{extremes, refused};
use super::processes::processes;
use super::{Bench, Rows, until};
use crate::{Approach, Case, CompareError, Method};

/// For rows that no method has to do with.
pub(super) const ALL: &str = "all";

pub(super) fn cases(bench: &Bench, rows: &mut Rows) {
    rows.attempt(ALL, "inputs", refused);
    for model in bench.models() {
        rows.attempt(model.method().name(), "extremes", |rows| {
            extremes(model, rows)
        });
    }
    rows.attempt(Method::Bem.name(), "damaged tables", damaged_tables);
    rows.attempt(Method::Bem.name(), "shared folders", shared_folders);
    rows.attempt(ALL, "processes", processes);
    rows.attempt(ALL, "threads", |rows| threads(bench, rows));
}

/// The same bits by one thread and two, and twice in a row.
fn threads(bench: &Bench, rows: &mut Rows) -> Result<(), CompareError> {
    let options = TableOptions {
        set: LoadSet::planar(1),
        tolerance: 1e-4,
        smallest_gap: 0.3,
    };
    let build = |threads: usize| -> Result<Vec<u64>, CompareError> {
        super::pool(threads)?.install(|| {
            let set = options.set;
            let mut all = bits(&Tabulated::build(Bem::new(1)?, options, &|_| {})?, set)?;
            all.extend(bits(&exact::Exact::new(), set)?);
            let case = Case {
                approach: Approach::HeadOn,
                beta: 5.0,
                dx: 1.0,
                dz: 0.1,
            };
            for model in bench.models() {
                let run = model.run(&case.scene()?, &until(200.0, 1e-8))?;
                all.extend(
                    run.end
                        .orientations
                        .iter()
                        .flat_map(|p| p.iter().map(|v| v.to_bits())),
                );
            }
            Ok(all)
        })
    };
    let (one, two, again) = (build(1)?, build(2)?, build(2)?);
    let differ = |other: &[u64]| one.iter().zip(other).filter(|(a, b)| a != b).count() as f64;
    let why = (0.0, "every sum has one order");
    rows.add(
        ALL,
        format!(
            "of {} numbers: those whose bits differ between 1 and 2 threads",
            one.len()
        ),
        why,
        differ(&two),
    );
    rows.add(
        ALL,
        "those that differ from one run to the next",
        why,
        differ(&again),
    );
    Ok(())
}
