//! Every kind of picture without data, with one point, or with NaN.

use scene::{Orientation, Pose, Run, RunOptions, Scene, Squirmer};

use super::tests::encounter;
use super::*;
use compare::cost::{CostRow, Part};
use compare::scene_run::SampleRow;
use compare::study::cargo::CargoRow;
use compare::study::maps::{FateRow, TrustShares};
use compare::study::panels::{PanelCase, PanelRun};
use compare::study::ratios::RatioRow;
use compare::study::sensitivity::{SensitivityCase, SensitivityRow};
use compare::{Encounter, LoadErrorRow, NoRun, OffsetRow};

/// Number of panels that show "no data".
fn empty_panels(svg: &str) -> usize {
    svg.matches(">no data<").count()
}

/// Checks that no coordinate or label is NaN, and that no line leads to the corner of the sheet, where NaN would lie.
fn has_no_stray_number(svg: &str) {
    for wrong in ["NaN", "inf", ">0.000001<"] {
        assert!(!svg.contains(wrong), "{wrong}");
    }
    let corner = |line: &&str| line.contains("points=\"0,0 ") || line.contains(" 0,0 ");
    let stray = svg.lines().find(corner);
    assert!(stray.is_none(), "{stray:?}");
}

fn failed(mut encounter: Encounter) -> Encounter {
    encounter.run = Err(NoRun::Failed("no table".to_owned()));
    encounter
}

fn opposed(method: Method) -> Encounter {
    encounter(Approach::HeadOn, 5.0, 1.0, method)
}

#[test]
fn a_method_that_failed_leaves_a_panel_that_says_so() {
    let all = [opposed(Method::Lt), failed(opposed(Method::LtCorrected))];
    let svg = trajectories(&all).unwrap();
    assert_eq!(empty_panels(&svg), 1);
    has_no_stray_number(&svg);
    // There is a picture even if all runs failed; otherwise the picture of an earlier command would remain.
    let all = all.map(failed);
    for (svg, panels) in [(trajectories(&all), 2), (deflection(&all), 1)] {
        let svg = svg.unwrap();
        assert_eq!(empty_panels(&svg), panels);
        has_no_stray_number(&svg);
    }
    let no_path = Encounter {
        run: opposed(Method::Lt).run.map(|run| Run {
            samples: Vec::new(),
            ..run
        }),
        ..opposed(Method::Lt)
    };
    let nothing = trajectories(&[no_path]);
    assert!(matches!(nothing, Err(FigureError::Empty { .. })));
}

#[test]
fn deflections_of_none_but_bound_pairs_are_within_the_panel() {
    let mut bound = opposed(Method::Lt);
    if let Ok(run) = &mut bound.run {
        run.outcome = scene::Outcome::Undecided;
    }
    let svg = deflection(&[bound]).unwrap();
    // The marker of the pair, and those of the curve and of hollow marks in the legend.
    assert_eq!(svg.matches("<circle").count(), 3);
}

fn panel_run(method: Method, run: Result<Run, NoRun>) -> PanelRun {
    let case = PanelCase {
        panel: "a".to_owned(),
        beta: 5.0,
        g: 0.0,
        delta: 0.3,
        sigma: 0.5,
        until: 10.0,
    };
    PanelRun { case, method, run }
}

#[test]
fn a_panel_of_paths_without_a_run_says_so() {
    let run = opposed(Method::Lt).run;
    let none = Err(NoRun::Skipped);
    let runs = [panel_run(Method::Lt, run), panel_run(Method::Exact, none)];
    for (runs, empty) in [(&runs[..], 1), (&runs[1..], 1)] {
        let svg = panels(runs, "Pairs").unwrap();
        assert_eq!(empty_panels(&svg), empty);
        has_no_stray_number(&svg);
    }
}

fn change(dz: f64, degrees: f64) -> OffsetRow {
    OffsetRow {
        case: "head-on".to_owned(),
        method: Method::Lt,
        beta: 5.0,
        dx: 1.0,
        dz,
        change1_deg: degrees,
        change2_deg: degrees,
        min_gap: 0.1,
        outcome: "scattered".to_owned(),
        outcome_in_plane: "scattered".to_owned(),
    }
}

#[test]
fn offsets_without_a_change_that_is_known_say_so() {
    let svg = offset(&[change(0.1, f64::NAN), change(0.2, f64::NAN)]).unwrap();
    assert_eq!(empty_panels(&svg), 1);
    for rows in [
        [change(0.0, 0.0), change(0.0, 0.0)],
        [change(1e-9, 1e-14), change(2e-9, -1e-14)],
        [change(0.0, f64::INFINITY), change(1e300, -1e300)],
    ] {
        let svg = offset(&rows).unwrap();
        assert_eq!(empty_panels(&svg), 0);
        has_no_stray_number(&svg);
    }
}

#[test]
fn shares_that_are_no_numbers_leave_a_panel_that_says_so() {
    let row = |g: f64, share: f64| FateRow {
        method: Method::Lt,
        beta: 1.0,
        g,
        scattered: share,
        standoff: share,
        pairwise: share,
        anticlockwise: share,
        clockwise: share,
        undecided: share,
        upward: share,
        oscillating: share,
        downward: share,
        failed: share,
        sampling_error: 0.0,
        points: 16,
    };
    let svg = fates(&[row(0.0, f64::NAN)]).unwrap();
    assert_eq!(empty_panels(&svg), 1);
    has_no_stray_number(&svg);
    assert_eq!(empty_panels(&fates(&[row(0.0, 0.0)]).unwrap()), 0);
    // Orbits of more than half of the pairs, against bottom-heaviness.
    let svg = fates(&[row(0.0, 0.4), row(10.0, 0.45)]).unwrap();
    assert_eq!(svg.matches("<circle").count(), 2 + 1);
}

#[test]
fn shares_of_trust_that_are_no_numbers_leave_a_panel_that_says_so() {
    let row = |beta: f64, dz: f64, share: f64| TrustShares {
        method: Method::Lt,
        beta,
        g: 0.0,
        dz,
        within_5_deg: share,
        within_15_deg: 0.0,
        within_45_deg: 0.0,
        beyond_45_deg: 0.0,
        same_outcome: 0.0,
        other_outcome: 0.0,
        failed: 0.0,
    };
    let of = |beta: f64, share: f64| [row(beta, 0.0, share), row(beta, 0.5, share)];
    let svg = trust_against_offset(&[of(1.0, 1.0), of(5.0, f64::NAN)].concat()).unwrap();
    assert_eq!(empty_panels(&svg), 1);
    has_no_stray_number(&svg);
}

fn load_error(gap: f64, error: f64) -> LoadErrorRow {
    LoadErrorRow {
        method: Method::Lt,
        gap,
        name: "X11A".to_owned(),
        value: 1.0,
        exact: 1.0,
        error,
    }
}

#[test]
fn an_error_that_is_not_known_is_not_drawn_as_a_small_one() {
    let svg = load_errors(&[load_error(0.01, f64::NAN), load_error(0.1, f64::NAN)]).unwrap();
    assert_eq!(empty_panels(&svg), 1);
    // The line is interrupted there.
    let gaps = [1e-3, 1e-2, 0.1, 1.0, 10.0];
    let errors = [1e-3, 1e-3, f64::NAN, 1e-3, 1e-3];
    let rows: Vec<_> = (gaps.into_iter().zip(errors))
        .map(|(gap, error)| load_error(gap, error))
        .collect();
    let svg = load_errors(&rows).unwrap();
    let lines = |svg: &str| {
        let line = "stroke=\"#0072B2\" stroke-width=\"2\"";
        svg.matches(line).count()
    };
    assert_eq!(lines(&svg), 3, "two pieces and the legend's");
    has_no_stray_number(&svg);
    // One gap is a dot on an axis with a scale.
    let svg = load_errors(&[load_error(0.5, 1e-3)]).unwrap();
    assert_eq!(empty_panels(&svg), 0);
    assert_eq!(svg.matches("<circle").count(), 1);
    assert!(svg.contains(">10⁻¹<") && svg.contains(">10⁰<"));
}

#[test]
fn an_approach_without_a_measurement_says_so() {
    let mut row = CostRow::new(Part::Deflection, "lt", ("tolerance", 1e-8), "head-on-1");
    (row.error, row.seconds) = (1e-6, 1e-4);
    let svg = deflections_work_precision(&[row]).unwrap();
    assert_eq!(empty_panels(&svg), 1);
    has_no_stray_number(&svg);
}

fn scene() -> Scene {
    let squirmer = || Squirmer::with_beta(1.0, 5.0).unwrap();
    let pose = |x: f64| Pose {
        position: [x, 0.0, 0.0].into(),
        orientation: Orientation::Radians(0.0),
    };
    Scene::new(
        [squirmer(), squirmer()],
        [pose(-2.0), pose(2.0)],
        None,
        None,
    )
    .unwrap()
}

#[test]
fn a_scene_of_one_sample_of_rest_or_of_numbers_that_are_none_has_sensible_axes() {
    let options = RunOptions {
        sample_interval: Some(1.0),
        ..RunOptions::default()
    };
    let run = scene::run(
        &scene(),
        &lt::Lubrication::new(lt::Form::Published),
        &options,
    );
    let first = SampleRow::from(&run.unwrap().samples[0]);
    let svg = scene_run(&scene(), &[first], false).unwrap();
    assert_eq!(empty_panels(&svg), 0);
    has_no_stray_number(&svg);
    let unknown = SampleRow {
        gap: f64::NAN,
        angle1_deg: f64::NAN,
        angle2_deg: f64::NAN,
        ..first
    };
    let svg = scene_run(&scene(), &[unknown, unknown], false).unwrap();
    assert_eq!(empty_panels(&svg), 2, "gap and angles");
    has_no_stray_number(&svg);
    for size in [1e9, 1e155, 1e300] {
        let far = SampleRow {
            t: size,
            x2: size,
            gap: size,
            angle1_deg: size,
            ..first
        };
        for rows in [vec![first, far], vec![far]] {
            let svg = scene_run(&scene(), &rows, true).unwrap();
            has_no_stray_number(&svg);
        }
    }
}

#[test]
fn paths_far_apart_are_not_drawn_in_a_strip() {
    let far = trajectories(&[encounter(Approach::HeadOn, 5.0, 1e7, Method::Lt)]).unwrap();
    has_no_stray_number(&far);
    assert!(far.contains("(10⁶ radii a)"));
    let height = far.split_once(" height=\"").unwrap().1;
    let height: f64 = height.split_once('"').unwrap().0.parse().unwrap();
    assert!(height > 250.0, "{height}");
}

fn ratio_row(ratio: f64, scattered: f64) -> RatioRow {
    RatioRow {
        method: Method::Lt,
        beta1: 5.0,
        beta2: -5.0,
        ratio,
        scattered,
        standoff: 0.0,
        pairwise: 1.0 - scattered,
        orbiting: 0.0,
        undecided: 0.0,
        scattered_exact: 1.0,
        standoff_exact: 0.0,
        pairwise_exact: 0.0,
        orbiting_exact: 0.0,
        undecided_exact: 0.0,
        within_5_deg: scattered,
        within_15_deg: 0.0,
        within_45_deg: 0.0,
        beyond_45_deg: 0.0,
        same_outcome: 0.0,
        other_outcome: 1.0 - scattered,
        failed: 0.0,
        points: 100,
    }
}

#[test]
fn shares_of_no_one_or_a_thousand_ratios_are_drawn() {
    assert!(matches!(ratios(&[]), Err(FigureError::Empty { .. })));
    let one = ratios(&[ratio_row(2.0, 0.25)]).unwrap();
    has_no_stray_number(&one);
    assert_eq!(empty_panels(&one), 0);
    assert!(one.contains("β = 5 and −5"), "{one}");
    let failed = RatioRow {
        failed: 1.0,
        other_outcome: f64::NAN,
        ..ratio_row(2.0, f64::NAN)
    };
    has_no_stray_number(&ratios(&[failed]).unwrap());
    let many: Vec<_> = (1..=1000)
        .map(|k| ratio_row(0.05 * f64::from(k), 0.5))
        .collect();
    let many = ratios(&many).unwrap();
    has_no_stray_number(&many);
    // Names of places that have no room are left out.
    assert!(many.matches(">0.05<").count() == 3 && !many.contains(">0.1<"));
}

fn cargo_row(ratio: f64, b: f64, along: f64) -> CargoRow {
    CargoRow {
        method: Method::Lt,
        beta: 1.0,
        ratio,
        b,
        along,
        across: -along,
        deflection_deg: 3.0,
        min_gap: 0.1,
        tau: 2.0,
        outcome: "scattered".to_owned(),
        reach: 30.0,
        beyond: 0.0,
    }
}

#[test]
fn displacements_of_no_one_or_a_thousand_cargoes_are_drawn() {
    assert!(matches!(cargo(&[]), Err(FigureError::Empty { .. })));
    for row in [cargo_row(2.0, 0.5, 0.3), cargo_row(2.0, 0.5, f64::NAN)] {
        let bound = row.along.is_nan();
        let one = cargo(&[row]).unwrap();
        has_no_stray_number(&one);
        assert_eq!(one.contains("the pair stays bound"), bound);
    }
    let many: Vec<_> = (0..1000)
        .map(|k| cargo_row(f64::from(k % 20), f64::from(k / 20), 1.0 / f64::from(k + 1)))
        .collect();
    has_no_stray_number(&cargo(&many).unwrap());
}

#[test]
fn judged_models_are_drawn_whatever_they_lack() {
    use compare::judge::{ErrorAt, Group, LeaderRow};

    assert!(matches!(judged_errors(&[]), Err(FigureError::Empty { .. })));
    let at = |model: usize, gap: f64, error: f64| ErrorAt {
        model: format!("model-{model}"),
        group: Group::Slip,
        gap,
        error,
        between: false,
    };
    // One point; no error at all; a thousand models.
    has_no_stray_number(&judged_errors(&[at(0, 0.1, 0.01)]).unwrap());
    has_no_stray_number(&judged_errors(&[at(0, 0.1, 0.0), at(0, 1.0, 1e9)]).unwrap());
    let many: Vec<_> = (0..1000)
        .flat_map(|model| [at(model, 0.01, 0.1), at(model, 1.0, 1e-3)])
        .collect();
    let svg = judged_errors(&many).unwrap();
    has_no_stray_number(&svg);
    assert!(svg.contains(">model-0<") && svg.len() < 2_000_000);
    let row = |model: &str| LeaderRow {
        model: model.to_owned(),
        title: String::new(),
        score: f64::NAN,
        error_2: f64::NAN,
        error_05: f64::NAN,
        error_01: f64::NAN,
        error_001: f64::NAN,
        slip_score: f64::NAN,
        trusted_1: f64::NAN,
        trusted_5: f64::NAN,
        trusted_20: f64::NAN,
        faults: 0,
        seconds: f64::NAN,
    };
    let svg = trusted_gaps(&[row("none")]).unwrap();
    has_no_stray_number(&svg);
    assert!(svg.contains(">none<"));
    assert!(matches!(
        score_against_time(&[row("none")]),
        Err(FigureError::Empty { .. })
    ));
    let timed = LeaderRow {
        score: 0.1,
        seconds: 1e-3,
        ..row("timed")
    };
    has_no_stray_number(&score_against_time(&[timed]).unwrap());
}

#[test]
fn sensitivity_without_finite_offsets_or_with_one_case() {
    assert!(matches!(sensitivity(&[]), Err(FigureError::Empty { .. })));
    let mut case = SensitivityCase {
        case: "mine".to_owned(),
        values: Vec::new(),
        row: SensitivityRow {
            method: Method::Lt,
            min_gap: 0.1,
            tau: 1.0,
            outcome: "scattered".to_owned(),
            condition: f64::NAN,
            tilt1_per_a: 0.0,
            tilt2_per_a: 0.0,
            turn1_per_a2: f64::NAN,
            turn2_per_a2: f64::NAN,
            linear_1deg: f64::INFINITY,
            offset_1deg: f64::INFINITY,
            linear_6deg: f64::INFINITY,
            offset_6deg: f64::INFINITY,
            linear_15deg: f64::INFINITY,
            offset_15deg: f64::INFINITY,
            truncation: 0.0,
        },
    };
    let svg = sensitivity(std::slice::from_ref(&case)).unwrap();
    has_no_stray_number(&svg);
    assert!(svg.contains("0 of 1 offsets"), "{svg}");
    (case.row.linear_6deg, case.row.offset_6deg) = (0.3, 0.4);
    let svg = sensitivity(&[case]).unwrap();
    has_no_stray_number(&svg);
    assert!(svg.contains("1 of 1 offsets"), "{svg}");
}
