//! Pictures of real lubrication runs and of invented rows.

use scene::RunOptions;

use super::{FigureError, deflection, offset, trajectories};
use compare::{Approach, Case, Encounter, Method, OffsetRow};

pub(super) fn encounter(approach: Approach, beta: f64, dx: f64, method: Method) -> Encounter {
    let case = Case {
        approach,
        beta,
        dx,
        dz: 0.0,
    };
    let form = match method {
        Method::LtCorrected => lt::Form::Corrected,
        _ => lt::Form::Published,
    };
    let options = RunOptions {
        sample_interval: Some(0.05),
        ..RunOptions::default()
    };
    let scene = case.scene().expect("a scene of the paper");
    let run = scene::run(&scene, &lt::Lubrication::new(form), &options);
    Encounter {
        case,
        method,
        run: run.map_err(|error| compare::NoRun::Failed(error.to_string())),
        seconds: 0.0,
    }
}

fn encounters(approach: Approach, betas: &[f64]) -> Vec<Encounter> {
    let mut all = Vec::new();
    for method in [Method::Lt, Method::LtCorrected] {
        for &beta in betas {
            for dx in [1.0, 3.0] {
                all.push(encounter(approach, beta, dx, method));
            }
        }
    }
    all
}

fn count(svg: &str, what: &str) -> usize {
    svg.matches(what).count()
}

#[test]
fn methods_stand_side_by_side_for_one_beta() {
    let svg = trajectories(&encounters(Approach::HeadOn, &[5.0])).expect("a picture");
    assert_eq!(count(&svg, ">(a) Lubrication theory<"), 1);
    assert_eq!(count(&svg, ">(b) Lubrication theory, corrected<"), 1);
    assert_eq!(count(&svg, "x (radii a)"), 2);
    assert_eq!(count(&svg, "δx = "), 2);
    // The first squirmer's solid line: one polyline a run, and one in the legend.
    let solid = |colour: &str| {
        let of_colour = format!("stroke=\"{colour}\" stroke-width=\"1.8\"");
        let lines = svg.lines().filter(|l| l.starts_with("<polyline"));
        lines
            .filter(|l| l.contains(&of_colour) && !l.contains("dasharray"))
            .count()
    };
    assert_eq!(solid("#0072B2"), 2);
}

#[test]
fn lengths_have_two_decimals_at_most() {
    let svg = trajectories(&encounters(Approach::HeadOn, &[5.0])).expect("a picture");
    for number in svg.split(|c: char| !c.is_ascii_digit() && c != '.') {
        let decimals = number
            .split_once('.')
            .map_or(0, |(_, decimals)| decimals.len());
        assert!(decimals <= 2, "{number}");
    }
}

#[test]
fn several_betas_are_columns() {
    let all = encounters(Approach::Orthogonal, &[-1.0, 1.0, 5.0]);
    let svg = trajectories(&all).expect("a picture");
    assert_eq!(count(&svg, "x (radii a)"), 6);
    assert!(svg.contains("(d) Lubrication theory, corrected, β = −1"));
}

#[test]
fn symmetric_deflections_share_one_panel() {
    let head_on = deflection(&encounters(Approach::HeadOn, &[5.0])).expect("a picture");
    assert_eq!(count(&head_on, "Both squirmers"), 1);
    let orthogonal = deflection(&encounters(Approach::Orthogonal, &[1.0])).expect("a picture");
    assert_eq!(count(&orthogonal, "Squirmer 1"), 1);
    assert_eq!(count(&orthogonal, "Squirmer 2"), 1);
}

#[test]
fn offsets_have_a_panel_for_each_method_and_gaps_for_nan() {
    let row = |method: Method, dz: f64, change: f64| OffsetRow {
        case: "head-on".to_owned(),
        method,
        beta: 5.0,
        dx: 1.0,
        dz,
        change1_deg: change,
        change2_deg: change,
        min_gap: 0.1,
        outcome: "scattered".to_owned(),
        outcome_in_plane: "scattered".to_owned(),
    };
    let rows = [
        row(Method::Lt, 0.0, 0.0),
        row(Method::Lt, 0.1, 1.0),
        row(Method::Bem, 0.0, 0.0),
        row(Method::Bem, 0.1, f64::NAN),
    ];
    let svg = offset(&rows).expect("a picture");
    assert_eq!(count(&svg, "change of angle (degrees)"), 2);
    // Three points, and the legend's.
    assert_eq!(count(&svg, "<circle"), 4);
}

#[test]
fn nothing_to_draw_and_two_approaches_are_errors() {
    let empty = |error| matches!(error, Err(FigureError::Empty { .. }));
    assert!(empty(trajectories(&[])));
    assert!(empty(deflection(&[])));
    assert!(empty(offset(&[])));
    let both = [
        encounter(Approach::HeadOn, 5.0, 1.0, Method::Lt),
        encounter(Approach::Orthogonal, 5.0, 1.0, Method::Lt),
    ];
    let mixed = trajectories(&both);
    assert!(matches!(mixed, Err(FigureError::MixedApproaches { .. })));
}

#[test]
fn failed_runs_are_left_out() {
    let mut all = encounters(Approach::HeadOn, &[5.0]);
    all[0].run = Err(compare::NoRun::Failed("no table".to_owned()));
    assert!(trajectories(&all).is_ok());
    assert!(deflection(&all).is_ok());
}

#[test]
fn shares_of_pairs_that_all_swim_upward_are_drawn() {
    let row = |upward: f64| compare::study::maps::FateRow {
        method: Method::Lt,
        beta: 1.0,
        g: 10.0,
        scattered: 1.0 - upward,
        standoff: 0.0,
        pairwise: 0.0,
        anticlockwise: 0.0,
        clockwise: 0.0,
        undecided: 0.0,
        upward,
        oscillating: 0.0,
        downward: 0.0,
        failed: 0.0,
        sampling_error: 0.0,
        points: 16,
    };
    let svg = super::fates(&[row(1.0)]).unwrap();
    assert!(svg.contains("upward") && !svg.contains("downward"));
    assert!(!super::fates(&[row(0.0)]).unwrap().contains("upward"));
}
