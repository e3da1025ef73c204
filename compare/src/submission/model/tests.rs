use std::fmt::Write;

use approx::assert_relative_eq;
use exact::Exact;
use scene::{Outcome, RunOptions, run};

use super::*;
use crate::Family;

fn parsed(text: &str) -> Result<SubmittedModel, SubmissionError> {
    SubmittedModel::new(&Submission::parse(text)?)
}

mod mistakes;

const HEADER: &str = "method,gap,name,value,error_estimate\n";

/// Rows of `loads.csv` at some gaps.
fn text_of(gaps: &[f64], loads: impl Fn(Gap) -> Vec<(String, f64)>) -> String {
    let mut text = HEADER.to_owned();
    for &gap in gaps {
        for (name, value) in loads(Gap::new(gap).unwrap()) {
            writeln!(text, "mine,{gap:?},{name},{value:?},none").unwrap();
        }
    }
    text
}

/// The exact loads of `set` at some gaps.
fn exact_file(gaps: &[f64], set: LoadSet) -> SubmittedModel {
    let exact = Exact::new();
    let text = text_of(gaps, |gap| {
        let (loads, swirl) = exact.loads_with_swirl(gap, set).unwrap();
        (loads.named().into_iter().chain(swirl.named())).collect()
    });
    parsed(&text).unwrap()
}

/// Gaps from `from` to 20, about `each` a decade.
fn log_spaced(from: f64, each: f64) -> Vec<f64> {
    let count = (each * (20.0 / from).log10()).ceil();
    (0..=count as u32)
        .map(|k| from * (20.0 / from).powf(f64::from(k) / count))
        .collect()
}

/// Errors of all loads of `set` at `gap`, relative to the larger of the load and 1.
fn errors(file: &SubmittedModel, exact: &Exact, gap: Gap, set: LoadSet) -> Vec<f64> {
    let named = |model: &dyn Hydrodynamics| {
        let (loads, swirl) = model.loads_with_swirl(gap, set).unwrap();
        loads.named().into_iter().chain(swirl.named())
    };
    let both = named(file).zip(named(exact));
    both.map(|((_, value), (_, truth))| (value - truth).abs() / truth.abs().max(1.0))
        .collect()
}

fn worst(errors: &[f64]) -> f64 {
    errors.iter().copied().fold(0.0, f64::max)
}

/// Loads of spheres that feel no lubrication: X11A, X12A and the thrust of the first mode, as far fields.
fn without_lubrication(gap: Gap) -> Vec<(String, f64)> {
    let near = 1.0 / gap.distance();
    [
        ("X11A", 1.0 + 2.25 * near * near),
        ("X12A", -1.5 * near),
        ("XF1_1", 4.0 + 3.0 * near.powi(3)),
        ("XF2_1", -6.0 * near),
    ]
    .map(|(name, value)| (name.to_owned(), value))
    .to_vec()
}

#[test]
fn the_values_in_the_file_come_back_at_its_gaps_to_rounding() {
    let exact = Exact::new();
    let set = LoadSet::all(2).with_swirl(2);
    let gaps = log_spaced(1e-4, 3.0);
    let file = exact_file(&gaps, set);
    for &gap in &gaps {
        let gap = Gap::new(gap).unwrap();
        let error = worst(&errors(&file, &exact, gap, set));
        assert!(error < 1e-15, "{:e}: {error:e}", gap.eps());
        let all = file.loads(gap, set).unwrap();
        let columns: Vec<f64> = all.columns().collect();
        assert_eq!(all.set(), set);
        for part in [
            LoadSet::planar(1),
            LoadSet::axial(2),
            LoadSet::axial_and_twist(0),
            LoadSet::planar(2).point_symmetric(),
        ] {
            let expected = PairLoads::from_columns(part, set, &columns);
            assert_eq!(file.loads(gap, part).unwrap(), expected);
        }
    }
}

#[test]
fn val_exact_loads_come_out_between_gaps_and_their_error_is_estimated() {
    let exact = Exact::new();
    let set = LoadSet::all(2).with_swirl(2);
    for (each, bound) in [(4.0, 6e-4), (12.0, 4e-6), (24.0, 3e-7)] {
        // Evenly, and by up to 0.3 of a step unevenly.
        for uneven in [0.0, 0.3] {
            let mut gaps = log_spaced(1e-3, each);
            let last = gaps.len() - 1;
            for (k, gap) in gaps.iter_mut().enumerate().take(last).skip(1) {
                let shift = (7919 * k % 13) as f64 / 6.0 - 1.0;
                *gap *= 10_f64.powf(uneven * shift / each);
            }
            let file = exact_file(&gaps, set);
            let (mut most, mut estimated) = (0.0_f64, 0.0_f64);
            for ends in gaps.windows(2) {
                let gap = Gap::new((ends[0] * ends[1]).sqrt()).unwrap();
                let error = worst(&errors(&file, &exact, gap, set));
                let estimate = file.error_estimate(gap, set).unwrap().unwrap();
                assert!(error < estimate, "{:e}: {error:e} {estimate:e}", gap.eps());
                most = most.max(error);
                estimated = estimated.max(estimate);
            }
            println!("{each} a decade, uneven {uneven}: {most:.1e}, estimate {estimated:.1e}");
            assert!(most < bound, "{most:e}");
            assert!(estimated < 20.0 * most, "{estimated:e} {most:e}");
        }
    }
}

#[test]
fn the_diverging_part_is_subtracted_from_a_file_that_has_it_and_from_no_other() {
    let gaps = log_spaced(1e-4, 6.0);
    assert!(exact_file(&gaps, LoadSet::axial(1)).subtracted);
    let text = text_of(&gaps, without_lubrication);
    let file = parsed(&text).unwrap();
    assert!(!file.subtracted);
    for ends in gaps.windows(2) {
        let gap = Gap::new((ends[0] * ends[1]).sqrt()).unwrap();
        let loads = file.loads(gap, LoadSet::axial(1)).unwrap();
        for ((_, value), (_, truth)) in loads.named().iter().zip(without_lubrication(gap)) {
            assert_relative_eq!(*value, truth, epsilon = 1e-4);
        }
    }
    // Nearly all of X11A at the smallest gap is its diverging part, which is no cubic in the logarithm of the gap.
    let exact = Exact::new();
    let gap = Gap::new((gaps[0] * gaps[1]).sqrt()).unwrap();
    let file = exact_file(&gaps, LoadSet::axial(0));
    assert!(worst(&errors(&file, &exact, gap, LoadSet::axial(0))) < 1e-7);
}

#[test]
fn a_stated_error_holds_next_to_its_gap_and_the_largest_is_the_noise() {
    let text = text_of(&log_spaced(1e-3, 12.0), without_lubrication);
    let file = parsed(&text).unwrap();
    assert_relative_eq!(file.description().noise, 1e-13);
    let gaps = log_spaced(1e-3, 12.0);
    let row = format!("mine,{:?},X12A,", gaps[10]);
    let stated: String = (text.lines())
        .map(|line| match line.strip_prefix(&row) {
            Some(rest) => format!("{row}{}\n", rest.replace("none", "0.03")),
            None => format!("{line}\n"),
        })
        .collect();
    let file = parsed(&stated).unwrap();
    assert_relative_eq!(file.description().noise, 0.03);
    for (k, ends) in gaps.windows(2).enumerate() {
        let gap = Gap::new((ends[0] * ends[1]).sqrt()).unwrap();
        let estimate = file.error_estimate(gap, LoadSet::axial(1)).unwrap();
        if k == 9 || k == 10 {
            assert_eq!(estimate, Some(0.03));
        } else {
            assert!(estimate.unwrap() < 1e-4);
        }
    }
}

#[test]
fn a_load_that_the_file_lacks_is_named() {
    let file = parsed(&text_of(&log_spaced(1e-2, 4.0), without_lubrication)).unwrap();
    let gap = Gap::new(1.0).unwrap();
    for (set, name) in [
        (LoadSet::axial(2), "XF1_2"),
        (LoadSet::all(1), "Y11A"),
        (LoadSet::axial_and_twist(1), "X11C"),
        (LoadSet::axial(1).with_swirl(1), "XTC1_1"),
    ] {
        let text = format!("loads from a file: the file has no {name}, which the motion needs");
        let error = file.loads_with_swirl(gap, set).unwrap_err();
        assert_eq!(error.to_string(), text);
        assert_eq!(file.error_estimate(gap, set), Err(error));
    }
    let error = file.loads(gap, LoadSet::axial(9)).unwrap_err();
    assert!(matches!(error, SceneError::TooManyModes { modes: 9, .. }));
}

#[test]
fn val_a_collision_by_exact_loads_from_a_file_is_the_exact_one() {
    let exact = Exact::new();
    let file = exact_file(&log_spaced(1e-4, 12.0), LoadSet::all(2));
    let family = Family::parse(Family::PAPER[0].1).unwrap();
    for dx in [1.0, 3.0] {
        let point = family.scene(&[("dx", dx)]).unwrap();
        let options = RunOptions {
            angles_at: 12.0,
            ..point.run
        };
        let found = run(&point.scene, &file, &options).unwrap();
        let truth = run(&point.scene, &exact, &options).unwrap();
        assert_eq!(found.outcome, Outcome::Scattered);
        let [angle, true_angle] = [&found, &truth].map(|run| run.deflections_rad()[0]);
        println!("{dx}: {:e} rad", angle - true_angle);
        // 1e-5 degrees.
        assert_relative_eq!(angle, true_angle, epsilon = 1.7e-7);
        assert_relative_eq!(found.min_gap, truth.min_gap, max_relative = 2e-6);
        assert_relative_eq!(found.truncation_rad, truth.truncation_rad, epsilon = 1e-8);
    }
}

#[test]
fn a_run_fails_where_the_file_ends_far_out_and_is_unresolved_where_it_ends_at_contact() {
    let family = Family::parse(Family::PAPER[0].1).unwrap();
    let outside = |file: &SubmittedModel, dx: f64, angles_at: f64| {
        let point = family.scene(&[("dx", dx)]).unwrap();
        let options = RunOptions {
            angles_at,
            ..point.run
        };
        let error = run(&point.scene, file, &options).unwrap_err();
        assert!(
            error
                .to_string()
                .ends_with(" is outside the model's range 1e-2 to 2e1"),
            "{error}"
        );
        let SceneError::GapOutsideRange { eps, .. } = error else {
            panic!("{error:?}")
        };
        eps
    };
    let file = exact_file(&log_spaced(1e-2, 6.0), LoadSet::all(2));
    for angles_at in [f64::INFINITY, 22.1] {
        assert_relative_eq!(outside(&file, 3.0, angles_at), 20.0, max_relative = 1e-9);
    }
    // A start beyond the range.
    assert!(outside(&file, 30.0, 12.0) > 20.0);
    for eps in [0.01 * (1.0 - 1e-9), 20.0 * (1.0 + 1e-9)] {
        let error = file.loads(Gap::new(eps).unwrap(), LoadSet::axial(0));
        assert!(matches!(error, Err(SceneError::GapOutsideRange { .. })));
    }
    let close = exact_file(&log_spaced(0.05, 6.0), LoadSet::all(2));
    let point = family.scene(&[]).unwrap();
    let run = run(&point.scene, &close, &point.run).unwrap();
    assert_eq!(run.outcome, Outcome::Unresolved);
    assert_relative_eq!(run.min_gap, 0.05, max_relative = 1e-12);
}

#[test]
fn the_fingerprint_follows_the_numbers_and_nothing_else() {
    let text = text_of(&log_spaced(1e-2, 4.0), without_lubrication);
    let fingerprint = |text: &str| parsed(text).unwrap().fingerprint();
    let first = fingerprint(&text);
    let mut rows: Vec<&str> = text.lines().skip(1).collect();
    rows.reverse();
    rows.rotate_left(17);
    let shuffled = format!("# mine\n{HEADER}{}\n", rows.join("\n"));
    assert_eq!(fingerprint(&shuffled), first);
    // Columns in another order, fewer, a comment between rows, and numbers written in another way.
    let mut turned = "value, name ,gap\n# X12A,1\n".to_owned();
    for row in &rows {
        let fields: Vec<&str> = row.split(',').collect();
        writeln!(turned, "{0}, {1},{2}e0", fields[3], fields[2], fields[1]).unwrap();
    }
    assert_eq!(fingerprint(&turned), first);
    for (from, to) in [("XF2_1,-2", "XF2_1,-3"), ("none\n", "0.5\n")] {
        assert!(text.contains(from));
        assert_ne!(fingerprint(&text.replacen(from, to, 1)), first);
    }
}
