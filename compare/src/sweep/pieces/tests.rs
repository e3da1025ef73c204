//! Sweeps of made-up rows: what is computed, kept, written, counted and continued.

use serde::Deserialize;

use super::*;
use crate::made::lubrication;
use crate::output::part_of;

#[derive(Debug, Deserialize, PartialEq)]
struct Made {
    number: usize,
    outcome: String,
}

impl Row for Made {
    fn outcomes(&self) -> impl Iterator<Item = &str> {
        std::iter::once(self.outcome.as_str())
    }
}

const HEADER: &str = "number,outcome";

fn sweep(
    out: &OutputFolder,
    units: Range<usize>,
    size: usize,
    limit: Option<Duration>,
) -> Sweep<'_> {
    Sweep {
        name: "made",
        units,
        size,
        what: "pieces",
        key: "made by hand".to_owned(),
        time_limit: limit,
        out,
    }
}

fn line(unit: usize, outcome: &str) -> Computed {
    Computed {
        lines: format!("{unit},{outcome}\n"),
        failure: (outcome != "scattered").then(|| format!("unit {unit} {outcome}")),
    }
}

fn scattered(unit: usize) -> Result<Computed, CompareError> {
    Ok(line(unit, "scattered"))
}

fn skipped(unit: usize) -> Result<Computed, CompareError> {
    Ok(line(unit, SKIPPED))
}

/// The counts, and the numbers of the rows that were passed on.
fn written(kept: Kept<'_>) -> (Done, Vec<usize>) {
    let mut numbers = Vec::new();
    let done = kept.write(HEADER, &skipped, &mut |row: Made| {
        numbers.push(row.number);
        Ok::<_, CompareError>(())
    });
    (done.unwrap(), numbers)
}

#[test]
fn pieces_hold_every_unit_once_and_in_order() {
    let out = OutputFolder::temporary().unwrap();
    for (units, size, pieces) in [
        (0..10, 1, 10),
        (3..10, 2, 4),
        (3..11, 2, 4),
        (5..6, 4, 1),
        (0..0, 3, 0),
    ] {
        let sweep = sweep(&out, units.clone(), size, None);
        assert_eq!(sweep.pieces(), pieces, "{units:?} by {size}");
        let all: Vec<usize> = (0..pieces).flat_map(|piece| sweep.piece(piece)).collect();
        assert_eq!(all, units.collect::<Vec<_>>());
    }
    // A thousand pieces at most a thousandth larger, and one unit each of short sweeps.
    assert_eq!(
        [1, 999, 1999, 2000, 123_456].map(Sweep::size_of),
        [1, 1, 1, 2, 123]
    );
}

#[test]
fn all_rows_are_written_in_order_below_the_header_and_counted() {
    let out = OutputFolder::temporary().unwrap();
    let sweep = sweep(&out, 3..10, 2, None);
    let outcome = |unit: usize| if unit == 5 { FAILED } else { "scattered" };
    let kept = sweep.run(|unit| Ok(line(unit, outcome(unit)))).unwrap();
    assert_eq!(kept.reasons, ["unit 5 failed"]);
    assert_eq!(
        kept.rows::<Made>(1..3)
            .unwrap()
            .iter()
            .map(|row| row.number)
            .collect::<Vec<_>>(),
        [5, 6, 7, 8]
    );
    let (done, numbers) = written(kept);
    assert_eq!(
        done,
        Done {
            rows: 7,
            failed: 1,
            skipped: 0
        }
    );
    assert!(done.is_complete());
    assert_eq!(numbers, [3, 4, 5, 6, 7, 8, 9]);
    let rows: Vec<String> = (3..10)
        .map(|unit| format!("{unit},{}\n", outcome(unit)))
        .collect();
    assert_eq!(
        out.read("made.csv").unwrap(),
        format!("{HEADER}\n{}", rows.concat())
    );
    // The part file is gone, and the account knows of the failure.
    assert_eq!(out.read(&part_of("made.csv")), None);
    assert!(matches!(
        out.account().verdict(),
        Err(CompareError::RunsFailed { failed: 1 })
    ));
}

#[test]
fn of_many_failures_the_first_twenty_reasons_are_kept() {
    let out = OutputFolder::temporary().unwrap();
    let sweep = sweep(&out, 0..50, 7, None);
    let kept = sweep.run(|unit| Ok(line(unit, FAILED))).unwrap();
    let expected: Vec<String> = (0..20).map(|unit| format!("unit {unit} failed")).collect();
    assert_eq!(kept.reasons, expected);
    assert_eq!(
        written(kept).0,
        Done {
            rows: 50,
            failed: 50,
            skipped: 0
        }
    );
}

#[test]
fn what_the_time_limit_leaves_out_is_skipped_counted_and_done_by_the_same_sweep_later() {
    let out = OutputFolder::temporary().unwrap();
    // Some pieces are done.
    let first = sweep(&out, 0..6, 2, None);
    let journal = Journal::open(&out, first.name, &first.key).unwrap();
    journal
        .run(2, "pieces", None, |piece| {
            Ok(format!(
                "{},scattered\n{},scattered\n",
                2 * piece,
                2 * piece + 1
            ))
        })
        .unwrap();
    drop(journal);
    let late = sweep(&out, 0..6, 2, Some(Duration::ZERO));
    let kept = late.run(scattered).unwrap();
    assert_eq!((kept.left, kept.pieces()), (1, 3));
    let (done, numbers) = written(kept);
    assert_eq!(
        done,
        Done {
            rows: 6,
            failed: 0,
            skipped: 2
        }
    );
    assert!(!done.is_complete());
    assert_eq!(numbers, [0, 1, 2, 3, 4, 5]);
    assert!(
        out.read("made.csv")
            .unwrap()
            .ends_with("3,scattered\n4,skipped\n5,skipped\n")
    );
    assert!(matches!(
        out.account().verdict(),
        Err(CompareError::Stopped { skipped: 2 })
    ));
    // Later only the last piece is computed.
    let whole = sweep(&out, 0..6, 2, None);
    let kept = whole.run(|unit| {
        assert!(unit >= 4, "{unit} was computed before");
        scattered(unit)
    });
    let (done, _) = written(kept.unwrap());
    assert_eq!(
        done,
        Done {
            rows: 6,
            failed: 0,
            skipped: 0
        }
    );
    assert_eq!(out.read(&part_of("made.csv")), None);
}

#[test]
fn a_file_with_more_finished_rows_is_not_written_over_by_fewer() {
    let out = OutputFolder::temporary().unwrap();
    let start = |done: usize| {
        let journal = Journal::open(&out, "made", "made by hand").unwrap();
        journal
            .run(done, "pieces", None, |piece| {
                Ok(format!("{piece},scattered\n"))
            })
            .unwrap();
    };
    let late = || {
        let late = sweep(&out, 0..4, 1, Some(Duration::ZERO));
        let done = written(late.run(scattered).unwrap()).0;
        (done.skipped, out.read("made.csv").unwrap())
    };
    for (kept, rows, is_written) in [
        (1, "0,scattered\n1,scattered\n2,skipped\n", false),
        (2, "0,scattered\n1,scattered\n2,skipped\n", true),
        (3, "0,scattered\n1,skipped\n2,skipped\n", true),
        // It is finished.
        (1, "0,scattered\n", false),
        // Nothing is in it.
        (1, "", true),
        (1, "0,skipped\n", true),
    ] {
        drop(std::fs::remove_file(out.path().join(part_of("made.csv"))));
        let before = format!("{HEADER}\n{rows}");
        out.write("made.csv", &before).unwrap();
        start(kept);
        let (skipped, after) = late();
        assert_eq!(skipped, 4 - kept, "{kept} {rows:?}");
        assert_eq!(
            after != before,
            is_written,
            "{kept} kept, the file had {rows:?}"
        );
    }
}

#[test]
fn a_sweep_that_is_not_complete_gives_nothing_and_is_counted() {
    let out = OutputFolder::temporary().unwrap();
    let whole = sweep(&out, 0..3, 1, None);
    assert!(whole.run(scattered).unwrap().complete().is_some());
    assert!(out.account().verdict().is_ok());
    whole.run(scattered).unwrap().close().unwrap();
    let late = sweep(&out, 0..3, 1, Some(Duration::ZERO));
    assert!(late.run(scattered).unwrap().complete().is_none());
    assert!(matches!(
        out.account().verdict(),
        Err(CompareError::Stopped { skipped: 3 })
    ));
}

#[test]
fn rows_of_another_sweep_are_kept_unless_they_may_be_deleted() {
    let folder = tempfile::tempdir().unwrap();
    let out = OutputFolder::open(folder.path()).unwrap();
    let mine = sweep(&out, 0..3, 1, None);
    drop(mine.run(scattered).unwrap());
    let other = Sweep {
        key: "another".to_owned(),
        ..sweep(&out, 0..3, 1, None)
    };
    for refused in [other.check().err(), other.run(scattered).err()] {
        assert!(
            matches!(refused, Some(CompareError::OtherSweep { pieces: 3, .. })),
            "{refused:?}"
        );
    }
    mine.check().unwrap();
    assert!(
        mine.run(|unit| panic!("{unit} was computed before"))
            .is_ok()
    );
    drop(out);
    let fresh = OutputFolder::open(folder.path()).unwrap().fresh(true);
    let other = Sweep {
        key: "another".to_owned(),
        ..sweep(&fresh, 0..3, 1, None)
    };
    other.check().unwrap();
    assert_eq!(written(other.run(scattered).unwrap()).0.rows, 3);
}

#[test]
fn the_key_is_one_line_that_changes_with_all_that_rows_depend_on() {
    let [lt, corrected] = lubrication();
    let run = RunOptions::default();
    let usual = key("made", [&lt], &run, "rest\nof it");
    assert!(
        !usual.contains('\n') && usual.contains("made: lt (") && usual.contains("rest of it"),
        "{usual}"
    );
    let looser = RunOptions {
        tolerance: 1e-7,
        ..run
    };
    for other in [
        key("other", [&lt], &run, "rest\nof it"),
        key("made", [&corrected], &run, "rest\nof it"),
        key("made", [&lt, &corrected], &run, "rest\nof it"),
        key("made", [&lt], &looser, "rest\nof it"),
        key("made", [&lt], &run, "rest"),
    ] {
        assert_ne!(other, usual);
    }
}
