//! Sweeps of a small family by lubrication theory.

use super::*;
use crate::made::lubrication;
use crate::no_run;
use crate::numbers::Numbers;
use crate::sweep::RunChoices;

const FAMILY: &str = "
    [parameters]
    x = 3.0
    beta = 1.0
    [[squirmer]]
    position = [0, 0]
    orientation = 0
    beta = \"beta\"
    [[squirmer]]
    position = [\"x\", 1]
    orientation = 180
    beta = \"beta\"
    [repulsion]
    kappa1 = 10
    kappa2 = 100
    [run]
    end_time = 20";

fn points(family: &str) -> Points {
    let vary = [("beta", vec![-1.0, 1.0]), ("x", vec![3.5, 4.0, 5.0])];
    let vary = vary.map(|(name, values)| (name.to_owned(), Numbers(values)));
    let choices = RunChoices {
        tolerance: None,
        angles_at: f64::INFINITY,
    };
    Points::new(Family::parse(family).unwrap(), &vary, choices).unwrap()
}

fn share<'a>(
    points: &'a Points,
    models: &'a [Model],
    share: Share,
    out: &'a OutputFolder,
) -> FamilySweep<'a> {
    FamilySweep {
        points,
        models,
        loads: points.reads().unwrap().loads,
        share,
        time_limit: None,
        out,
    }
}

const WHOLE: Share = Share { number: 1, of: 1 };

#[test]
fn rows_are_model_by_model_with_the_last_axis_fastest_and_what_each_run_gives() {
    let (points, models, out) = (
        points(FAMILY),
        lubrication(),
        OutputFolder::temporary().unwrap(),
    );
    let sweep = share(&points, &models, WHOLE, &out);
    assert_eq!(
        sweep.header()[..4],
        ["beta", "x", "method", "deflection1_deg"]
    );
    let mut rows = Vec::new();
    let done = sweep.run(&mut |row| rows.push(row.0)).unwrap();
    assert_eq!(
        done,
        Done {
            rows: 12,
            failed: 0,
            skipped: 0
        }
    );
    let starts: Vec<[&str; 3]> = rows
        .iter()
        .map(|row| [0, 1, 2].map(|k| row[k].as_str()))
        .collect();
    assert_eq!(starts[0], ["-1.0", "3.5", "lt"]);
    assert_eq!(starts[1], ["-1.0", "4.0", "lt"]);
    assert_eq!(starts[5], ["1.0", "5.0", "lt"]);
    assert_eq!(starts[6], ["-1.0", "3.5", "lt-corrected"]);
    for row in &rows {
        let [beta, x] = [0, 1].map(|k| row[k].parse::<f64>().unwrap());
        let point = points.family().scene(&[("beta", beta), ("x", x)]).unwrap();
        let model = &models[usize::from(row[2] != "lt")];
        let run = model.run(&point.scene, &point.run).unwrap();
        let deflections = run.deflections_rad().map(f64::to_degrees);
        for (field, value) in [
            (3, deflections[0]),
            (4, deflections[1]),
            (5, run.min_gap),
            (6, run.contact_time),
        ] {
            assert!(
                (row[field].parse::<f64>().unwrap() - value).abs() < 1e-12,
                "{row:?}: {value}"
            );
        }
        assert_eq!(row[7], run.outcome.to_string());
        assert_eq!(row[8], run.counters.steps.to_string());
    }
    let manifest = Manifest::read(out.path()).unwrap();
    assert_eq!(
        (manifest.rows, manifest.all_rows, manifest.failed),
        (0..12, 12, 0)
    );
}

#[test]
fn shares_have_the_rows_of_the_whole_and_a_share_without_a_row_is_refused() {
    let (points, models) = (points(FAMILY), lubrication());
    let rows = |number: usize, of: usize| {
        let out = OutputFolder::temporary().unwrap();
        let mut rows = Vec::new();
        share(&points, &models, Share { number, of }, &out)
            .run(&mut |row| rows.push(row))
            .unwrap();
        rows
    };
    let parts: Vec<SweepRow> = (1..=5).flat_map(|number| rows(number, 5)).collect();
    assert_eq!(parts, rows(1, 1));
    let out = OutputFolder::temporary().unwrap();
    let error = share(&points, &models, Share { number: 1, of: 13 }, &out)
        .run(&mut |_| {})
        .unwrap_err();
    assert!(
        error
            .to_string()
            .contains("there are 12 rows: give at most 12 shares"),
        "{error}"
    );
}

#[test]
fn a_time_limit_skips_rows_and_writes_no_manifest() {
    let (points, models, out) = (
        points(FAMILY),
        lubrication(),
        OutputFolder::temporary().unwrap(),
    );
    let sweep = FamilySweep {
        time_limit: Some(Duration::ZERO),
        ..share(&points, &models, WHOLE, &out)
    };
    let mut rows = Vec::new();
    let done = sweep.run(&mut |row| rows.push(row.0)).unwrap();
    assert_eq!(
        done,
        Done {
            rows: 12,
            failed: 0,
            skipped: 12
        }
    );
    for (k, row) in rows.iter().enumerate() {
        assert_eq!(row[2], ["lt", "lt-corrected"][k / 6]);
        assert_eq!((row[3].as_str(), row[7].as_str()), ("NaN", no_run::SKIPPED));
    }
    assert_eq!([rows[1][0].as_str(), &rows[1][1]], ["-1.0", "4.0"]);
    assert!(!out.holds(Manifest::FILE));
}

#[test]
fn a_run_that_fails_is_a_row_without_numbers_and_a_reason() {
    let family = format!("{FAMILY}\n    max_steps = 1");
    let (points, models, out) = (
        points(&family),
        lubrication(),
        OutputFolder::temporary().unwrap(),
    );
    let sweep = share(&points, &models, WHOLE, &out);
    let mut rows = Vec::new();
    let done = sweep.run(&mut |row| rows.push(row.0)).unwrap();
    assert_eq!((done.rows, done.failed), (12, 12));
    for row in rows {
        assert_eq!([&row[3], &row[5], &row[7]], ["NaN", "NaN", no_run::FAILED]);
    }
    let failed = sweep.lines(
        Method::Lt,
        &[("beta", 1.0), ("x", 4.0)],
        &Err(NoRun::Failed("it stopped".to_owned())),
    );
    assert_eq!(
        failed.unwrap().failure.unwrap(),
        "lt, beta = 1.0, x = 4.0: it stopped"
    );
    assert_eq!(Manifest::read(out.path()).unwrap().failed, 12);
}
