//! Maps and shares of a coarse grid by lubrication theory.

use std::time::Duration;

use super::*;
use crate::Method;
use crate::made::{lubrication, model};

const PAIRS: [Pair; 2] = [
    Pair {
        beta: 5.0,
        g: 0.0,
        dz: 0.0,
    },
    Pair {
        beta: -5.0,
        g: 0.0,
        dz: 0.0,
    },
];

fn maps<'a>(models: &[&'a Model], out: &'a OutputFolder, limit: Option<Duration>) -> Maps<'a> {
    Maps {
        name: "made",
        models: models.to_vec(),
        exact: None,
        pairs: PAIRS.into(),
        grid: Grid::new(6).unwrap(),
        options: SweepOptions {
            run: RunOptions::default(),
            time_limit: limit,
        },
        out,
    }
}

#[test]
fn each_map_has_its_rows_with_delta_fastest_and_the_file_has_them_all() {
    let [lt, corrected] = lubrication();
    let out = OutputFolder::temporary().unwrap();
    let maps = maps(&[&lt, &corrected], &out, None);
    maps.check().unwrap();
    let mut found: Vec<(Method, f64, Vec<ScatterRow>)> = Vec::new();
    let done = maps.scatter(&mut |model: &Model, pair: Pair, rows: Vec<ScatterRow>| {
        found.push((model.method(), pair.beta, rows));
        Ok::<_, CompareError>(())
    });
    assert!(done.unwrap());
    let heads: Vec<(Method, f64)> = found
        .iter()
        .map(|(method, beta, _)| (*method, *beta))
        .collect();
    assert_eq!(
        heads,
        [
            (Method::Lt, 5.0),
            (Method::Lt, -5.0),
            (Method::LtCorrected, 5.0),
            (Method::LtCorrected, -5.0)
        ]
    );
    let values = maps.grid.values();
    let points = values.len();
    for (method, beta, rows) in &found {
        assert_eq!(rows.len(), points * points);
        for (k, row) in rows.iter().enumerate() {
            assert_eq!((row.method, row.beta.to_bits()), (*method, beta.to_bits()));
            assert_eq!(
                [row.delta, row.sigma].map(f64::to_bits),
                [values[k % points], values[k / points]].map(f64::to_bits)
            );
        }
    }
    // The same rows one by one.
    let again = scatter_row(&lt, PAIRS[1], (values[2], values[1]), &maps.options.run);
    assert_eq!(
        format!("{again:?}"),
        format!("{:?}", found[1].2[points + 2])
    );
    let lines = out.read("made.csv").unwrap().lines().count();
    assert_eq!(lines, 1 + 4 * points * points);
}

#[test]
fn shares_count_the_outcomes_of_the_map_and_add_up_to_one() {
    let lt = model(Method::Lt);
    let out = OutputFolder::temporary().unwrap();
    let maps = super::tests::maps(&[&lt], &out, None);
    let counted = Maps {
        name: "counted",
        ..super::tests::maps(&[&lt], &out, None)
    };
    let fates = counted.fates().unwrap().unwrap();
    let mut whole = Vec::new();
    maps.scatter(&mut |model: &Model, pair: Pair, rows: Vec<ScatterRow>| {
        whole.push(fates_of(model, pair, &rows));
        let row = whole.last().unwrap();
        for (name, share) in FateRow::SHARES {
            let count = rows.iter().filter(|row| row.outcome == name).count() as f64;
            assert!(
                (share(row) - count / rows.len() as f64).abs() < 1e-15,
                "{name}"
            );
        }
        Ok::<_, CompareError>(())
    })
    .unwrap();
    assert_eq!(fates, whole);
    for row in &fates {
        let sum: f64 = FateRow::SHARES.iter().map(|(_, share)| share(row)).sum();
        assert!((sum - 1.0).abs() < 1e-12, "{row:?}");
        assert_eq!(row.points, maps.grid.points().pow(2));
        let bound = row.standoff + row.pairwise + row.anticlockwise + row.clockwise;
        assert!(
            (row.bound() - bound).abs() < 1e-15
                && (row.orbits() - row.anticlockwise - row.clockwise).abs() < 1e-15
        );
        let error = (bound * (1.0 - bound) / row.points as f64).sqrt();
        assert!((row.sampling_error - error).abs() < 1e-15);
    }
    assert!(
        fates.iter().any(|row| row.bound() > 0.0) && fates.iter().all(|row| row.scattered > 0.0)
    );
}

#[test]
fn maps_that_the_time_limit_left_out_are_none_and_are_counted() {
    let lt = model(Method::Lt);
    let out = OutputFolder::temporary().unwrap();
    let late = maps(&[&lt], &out, Some(Duration::ZERO));
    assert!(late.fates().unwrap().is_none());
    let none =
        late.scatter(&mut |_: &Model, _: Pair, _: Vec<ScatterRow>| Ok::<_, CompareError>(()));
    assert!(!none.unwrap());
    assert!(matches!(
        out.account().verdict(),
        Err(CompareError::Stopped { .. })
    ));
    assert!(!out.holds("made.csv"));
}

#[test]
fn runs_without_a_result_are_failed_in_rows_and_shares() {
    let lt = model(Method::Lt);
    let few = RunOptions {
        max_steps: 1,
        ..RunOptions::default()
    };
    let row = scatter_row(&lt, PAIRS[0], (0.5, 0.5), &few);
    assert_eq!((row.outcome.as_str(), row.outcome()), ("failed", None));
    assert!(row.deflection1_deg.is_nan() && row.tau.is_nan());
    let good = scatter_row(&lt, PAIRS[0], (0.5, 0.5), &RunOptions::default());
    assert!(good.outcome().is_some());
    let shares = fates_of(&lt, PAIRS[0], &[row.clone(), row, good.clone(), good]);
    assert!((shares.failed - 0.5).abs() < 1e-15, "{shares:?}");
}
