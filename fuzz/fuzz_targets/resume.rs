//! Whatever a folder has of an interrupted sweep, the sweep ends with exactly its rows, or refuses in one line and leaves the file as it was. A piece of other lines with a
//! right checksum, which no damage makes but coverage finds, does no more than be wrong.

#![no_main]

use compare::OutputFolder;
use compare::sweep::{Computed, Row, Sweep};
use fuzz::{files, one_line};
use libfuzzer_sys::fuzz_target;
use serde::Deserialize;

/// The first line of a part file of this sweep, which says all that its pieces depend on.
fn key(size: usize) -> String {
    format!("the sweep of the fuzzer by {size}")
}

const HEADER: &str = "x,outcome";

const UNITS: usize = 7;

#[derive(Deserialize)]
struct Found {
    #[expect(dead_code, reason = "a column of the rows")]
    x: f64,
    outcome: String,
}

impl Row for Found {
    fn outcomes(&self) -> impl Iterator<Item = &str> {
        std::iter::once(self.outcome.as_str())
    }
}

fn row(unit: usize) -> String {
    format!("{unit}.5,scattered\n")
}

fuzz_target!(|input: (bool, u8, &[u8])| {
    let (fresh, size, bytes) = input;
    let size = usize::from(size % 4) + 1;
    let Ok(folder) = tempfile::tempdir() else {
        return;
    };
    let mut part = None;
    for (name, text) in files(bytes) {
        if ["sweep.csv", "sweep.csv.part"].contains(&name) {
            std::fs::write(folder.path().join(name), text).expect("a file");
            if name.ends_with("part") {
                part = Some(text);
            }
        }
    }
    let out = OutputFolder::open(folder.path()).expect("a folder");
    let out = out.fresh(fresh);
    let sweep = Sweep {
        name: "sweep",
        units: 0..UNITS,
        size,
        what: "pieces",
        key: key(size),
        time_limit: None,
        out: &out,
    };
    let compute = |unit| {
        Ok(Computed {
            lines: row(unit),
            failure: None,
        })
    };
    let checked = sweep.check();
    let done = sweep.run(compute).and_then(|kept| {
        assert!(checked.is_ok(), "it was refused before");
        kept.write(HEADER, &|_| Ok(Computed::default()), &mut |_: Found| {
            Ok::<_, compare::CompareError>(())
        })
    });
    let rows: String = (0..UNITS).map(row).collect();
    match done {
        Ok(done) => {
            assert!(done.is_complete());
            assert!(!out.holds("sweep.csv.part"));
            let written = out.read("sweep.csv").expect("a file of rows");
            let (header, written) = written.split_once('\n').expect("a header");
            assert_eq!(header, HEADER);
            if written == rows {
                assert!(done.failed == 0 && done.rows == UNITS);
            } else {
                let part = String::from_utf8_lossy(part.expect("pieces of other lines"));
                for line in written.split_inclusive('\n') {
                    assert!(rows.contains(line) || part.contains(line), "{line}");
                }
            }
        }
        Err(error) => {
            one_line(&error);
            assert!(!fresh, "refused though it may delete: {error}");
            let found = std::fs::read(folder.path().join("sweep.csv.part")).ok();
            if checked.is_err() {
                assert_eq!(found.as_deref(), part);
            } else {
                // Lines with a right checksum that are no rows: what was computed is kept beside them.
                assert!(found.is_some());
            }
        }
    }
});
