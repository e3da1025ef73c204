//! Encounters by lubrication theory: rows, what is drawn, what is skipped, what goes on.

use std::time::Duration;

use super::*;
use crate::Approach;
use crate::made::lubrication;

fn case(beta: f64, dx: f64) -> Case {
    Case {
        approach: Approach::HeadOn,
        beta,
        dx,
        dz: 0.0,
    }
}

fn options(time_limit: Option<Duration>) -> SweepOptions {
    SweepOptions {
        run: RunOptions {
            sample_interval: Some(1.0),
            ..RunOptions::default()
        },
        time_limit,
    }
}

#[test]
fn what_is_drawn_depends_on_the_number_of_runs_and_on_the_longest_panel() {
    assert_eq!(Drawn::without_paths(2000), Drawn::Points);
    assert_eq!(Drawn::without_paths(2001), Drawn::Nothing);
    assert_eq!(Drawn::of(120, 30), Drawn::Paths);
    assert_eq!(Drawn::of(121, 30), Drawn::Points);
    assert_eq!(Drawn::of(120, 31), Drawn::Points);
    assert_eq!(Drawn::of(2000, 500), Drawn::Points);
    assert_eq!(Drawn::of(2001, 1), Drawn::Nothing);
    // A panel is one beta.
    let (models, options, out) = (
        lubrication(),
        options(None),
        OutputFolder::temporary().unwrap(),
    );
    let drawn = |cases: &[Case]| {
        let sweep = EncounterSweep {
            name: "made",
            models: &models,
            cases,
            options: &options,
            out: &out,
        };
        sweep.drawn()
    };
    let row = |beta: f64, count: usize| (0..count).map(move |k| case(beta, 0.1 * k as f64));
    let two: Vec<Case> = row(1.0, 30).chain(row(5.0, 30)).collect();
    assert_eq!(drawn(&two), Drawn::Paths);
    assert_eq!(drawn(&row(1.0, 31).collect::<Vec<_>>()), Drawn::Points);
    assert_eq!(drawn(&row(1.0, 1001).collect::<Vec<_>>()), Drawn::Nothing);
    assert_eq!(drawn(&[]), Drawn::Paths);
}

#[test]
fn methods_are_the_outer_loop_and_each_row_has_the_numbers_of_its_run() {
    let (models, cases) = (
        lubrication(),
        [case(1.0, 1.0), case(5.0, 2.0), case(-5.0, 0.3)],
    );
    let found = encounters(&models, &cases, &options(None));
    assert_eq!(found.len(), 6);
    for (k, encounter) in found.iter().enumerate() {
        let (model, case) = (&models[k / 3], cases[k % 3]);
        assert_eq!((encounter.method, encounter.case), (model.method(), case));
        let run = model
            .run(&case.scene().unwrap(), &options(None).run)
            .unwrap();
        assert!(encounter.seconds > 0.0);
        let row = encounter.row();
        let [one, two] = run.deflections_rad().map(f64::to_degrees);
        let numbers = [
            (row.beta, case.beta),
            (row.dx, case.dx),
            (row.dz, 0.0),
            (row.deflection1_deg, one),
            (row.deflection2_deg, two),
            (row.min_gap, run.min_gap),
            (row.tau, run.contact_time),
            (row.truncation_deg, run.truncation_rad.to_degrees()),
            (row.seconds, encounter.seconds),
        ];
        for (found, expected) in numbers {
            assert_eq!(found.to_bits(), expected.to_bits(), "{row:?}");
        }
        assert_eq!(
            (row.steps, row.loads),
            (run.counters.steps, run.counters.loads)
        );
        assert_eq!(
            (row.outcome, encounter.outcome()),
            (run.outcome.to_string(), run.outcome.to_string())
        );
        assert_eq!(encounter.scattered(), run.outcome == Outcome::Scattered);
        assert_eq!(encounter.failure(), None);
    }
    // Swimmers on opposed paths are each other's image: they turn alike.
    for encounter in &found {
        let row = encounter.row();
        assert!(
            (row.deflection1_deg - row.deflection2_deg).abs() < 1e-6,
            "{row:?}"
        );
    }
    assert!(found.iter().any(Encounter::scattered));
}

#[test]
fn what_is_skipped_or_fails_has_no_numbers_and_says_which_case_it_is() {
    let (models, cases) = (lubrication(), [case(1.5, 1.0)]);
    let late = encounters(&models, &cases, &options(Some(Duration::ZERO)));
    for encounter in &late {
        let row = encounter.row();
        assert!(row.deflection1_deg.is_nan() && row.min_gap.is_nan() && row.tau.is_nan());
        assert_eq!(
            (row.outcome.as_str(), row.steps, row.loads),
            ("skipped", 0, 0)
        );
        assert!(!encounter.scattered());
        assert_eq!(
            encounter.failure().unwrap(),
            format!(
                "head-on, {}, beta 1.5, dx 1, dz 0: skipped: the time limit was reached",
                encounter.method
            )
        );
    }
    let few = RunOptions {
        max_steps: 1,
        ..RunOptions::default()
    };
    let failed = encounter(&models[0], &cases[0], &few);
    assert_eq!(failed.outcome(), "failed");
    assert!(
        failed
            .failure()
            .unwrap()
            .starts_with("head-on, lt, beta 1.5, dx 1, dz 0: ")
    );
}

#[test]
fn a_sweep_passes_rows_in_order_returns_what_is_drawn_and_continues() {
    let (models, cases) = (lubrication(), [case(1.0, 1.0), case(5.0, 2.0)]);
    let (usual, late) = (options(None), options(Some(Duration::ZERO)));
    let folder = tempfile::tempdir().unwrap();
    let out = OutputFolder::open(folder.path()).unwrap();
    let sweep = |options| EncounterSweep {
        name: "made",
        models: &models,
        cases: &cases,
        options,
        out: &out,
    };
    let of = |sweep: &EncounterSweep<'_>, drawn: Drawn| {
        let mut rows = Vec::new();
        let encounters = sweep.encounters(drawn, &mut |row| rows.push(row)).unwrap();
        (rows, encounters)
    };
    // Too late for all: rows, but nothing to draw.
    let (rows, drawn) = of(&sweep(&late), Drawn::Paths);
    assert_eq!((rows.len(), drawn.len()), (4, 0));
    assert!(rows.iter().all(|row| row.outcome == "skipped"));
    assert!(sweep(&usual).check_encounters().is_ok());
    let (rows, drawn) = of(&sweep(&usual), Drawn::Paths);
    assert_eq!((rows.len(), drawn.len()), (4, 4));
    for (row, encounter) in rows.iter().zip(&drawn) {
        assert_eq!(row.method, encounter.method);
        assert!((row.dx - encounter.case.dx).abs() < 1e-15);
        assert!(
            encounter.run.as_ref().unwrap().samples.len() > 2,
            "paths are drawn"
        );
    }
    let (_, points) = of(&sweep(&usual), Drawn::Points);
    assert_eq!(points.len(), 4);
    assert!(
        points
            .iter()
            .all(|encounter| encounter.run.as_ref().unwrap().samples.is_empty())
    );
    let (rows, nothing) = of(&sweep(&usual), Drawn::Nothing);
    assert_eq!((rows.len(), nothing.len()), (4, 0));
    // Rows of other cases are not deleted.
    let mine = sweep(&usual);
    let other = crate::sweep::Sweep {
        key: "another".to_owned(),
        ..mine.sweep(4)
    };
    drop(
        other
            .run(|unit| {
                Ok(Computed {
                    lines: format!("{unit}\n"),
                    failure: None,
                })
            })
            .unwrap(),
    );
    assert!(matches!(
        sweep(&usual).check_encounters(),
        Err(CompareError::OtherSweep { pieces: 4, .. })
    ));
}

#[test]
fn the_key_changes_with_every_number_of_the_cases_and_not_with_the_samples() {
    let (models, out) = (lubrication(), OutputFolder::temporary().unwrap());
    let key = |cases: &[Case], options: &SweepOptions| {
        let sweep = EncounterSweep {
            name: "made",
            models: &models,
            cases,
            options,
            out: &out,
        };
        sweep.key(1)
    };
    let (usual, one) = (options(None), [case(1.0, 2.0)]);
    let same = SweepOptions {
        run: RunOptions {
            sample_interval: None,
            ..usual.run
        },
        ..usual
    };
    assert_eq!(key(&one, &usual), key(&one, &same));
    for other in [
        vec![case(1.1, 2.0)],
        vec![case(1.0, 2.1)],
        vec![Case {
            dz: 0.1,
            ..case(1.0, 2.0)
        }],
        vec![case(1.0, 2.0), case(1.0, 2.0)],
    ] {
        assert_ne!(key(&other, &usual), key(&one, &usual), "{other:?}");
    }
}
