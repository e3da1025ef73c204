//! What an offset out of the plane changes.

use std::time::Duration;

use super::*;
use crate::Approach;
use crate::made::lubrication;
use crate::output::OutputFolder;

fn case(dx: f64) -> Case {
    Case {
        approach: Approach::Orthogonal,
        beta: 1.0,
        dx,
        dz: 0.0,
    }
}

fn options(time_limit: Option<Duration>) -> SweepOptions {
    SweepOptions {
        run: RunOptions::default(),
        time_limit,
    }
}

/// What a sweep passes on, and whether all is done.
fn swept(
    models: &[Model],
    cases: &[Case],
    dz: &[f64],
    options: &SweepOptions,
) -> (Vec<OffsetRow>, bool) {
    let out = OutputFolder::temporary().unwrap();
    let sweep = EncounterSweep {
        name: "offset",
        models,
        cases: &with_offsets(cases, dz),
        options,
        out: &out,
    };
    sweep.check_offsets(dz).unwrap();
    let mut rows = Vec::new();
    let done = sweep.offsets(dz, &mut |row| rows.push(row)).unwrap();
    (rows, done)
}

#[test]
fn angles_between_directions_are_right_from_tiny_to_straight() {
    for angle in [0.0, 1e-12, 0.3, 1.5, 3.0, std::f64::consts::PI] {
        let turned = Vector3::new(angle.cos(), angle.sin(), 0.0);
        assert!(
            (angle_between(Vector3::x(), turned) - angle).abs() < 1e-15 * (1.0 + angle),
            "{angle}"
        );
    }
    assert!(
        (angle_between(Vector3::x() * 3.0, Vector3::y() * 0.1) - std::f64::consts::FRAC_PI_2).abs()
            < 1e-15
    );
}

#[test]
fn each_case_is_followed_by_its_offsets() {
    let all = with_offsets(&[case(1.0), case(2.0)], &[0.1, 0.2]);
    let found: Vec<(f64, f64)> = all.iter().map(|case| (case.dx, case.dz)).collect();
    assert_eq!(
        found,
        [
            (1.0, 0.0),
            (1.0, 0.1),
            (1.0, 0.2),
            (2.0, 0.0),
            (2.0, 0.1),
            (2.0, 0.2)
        ]
    );
}

#[test]
fn rows_compare_each_offset_with_the_planar_run_of_its_case_and_model() {
    let (models, dz) = (lubrication(), [1e-9, 0.1]);
    let (rows, encounters) = offsets(&models, &[case(1.0), case(2.0)], &dz, &options(None));
    assert_eq!((rows.len(), encounters.len()), (8, 12));
    for (k, row) in rows.iter().enumerate() {
        let (group, offset) = (&encounters[k / 2 * 3..][..3], k % 2);
        assert_eq!(row.method, models[k / 4].method());
        assert_eq!(
            (row.case.as_str(), row.dx.to_bits(), row.dz.to_bits()),
            (
                "orthogonal",
                group[0].case.dx.to_bits(),
                dz[offset].to_bits()
            )
        );
        let [plane, off] = [&group[0], &group[1 + offset]].map(|of| of.run.as_ref().unwrap());
        let change = [0, 1].map(|k| {
            let [a, b] = [plane, off].map(|run| run.outgoing.orientations[k]);
            a.dot(&b).clamp(-1.0, 1.0).acos().to_degrees()
        });
        for (found, expected) in [row.change1_deg, row.change2_deg].into_iter().zip(change) {
            assert!((found - expected).abs() < 1e-5, "{row:?}: {expected}");
        }
        assert_eq!(row.min_gap.to_bits(), off.min_gap.to_bits());
        assert_eq!(
            (&row.outcome, &row.outcome_in_plane),
            (&off.outcome.to_string(), &plane.outcome.to_string())
        );
    }
    // A tiny offset changes little, a large one much.
    assert!(
        rows[0].change1_deg < 1e-4 && rows[1].change1_deg > 1.0,
        "{rows:?}"
    );
    // A sweep has the same rows.
    let cases = [case(1.0), case(2.0)];
    assert_eq!(swept(&models, &cases, &dz, &options(None)), (rows, true));
}

#[test]
fn what_the_time_limit_leaves_out_has_no_change() {
    let late = options(Some(Duration::ZERO));
    let (rows, done) = swept(&lubrication(), &[case(1.0), case(2.0)], &[0.1], &late);
    assert!(!done);
    assert_eq!(rows.len(), 4);
    for row in rows {
        assert!(row.change1_deg.is_nan() && row.change2_deg.is_nan() && row.min_gap.is_nan());
        assert_eq!(
            (row.outcome.as_str(), row.outcome_in_plane.as_str()),
            ("skipped", "skipped")
        );
    }
}
