//! Trajectories by tabulated loads: against direct solves, against the exact series, against
//! themselves in three dimensions, and against their own past.

#![allow(clippy::float_cmp, reason = "exactly equal is what is claimed")]
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::sync::OnceLock;

use compare::sweep::SweepOptions;
use compare::{
    Approach, Case, Defaults, EXACT_TABLE_TOLERANCE, Encounter, Method, Model, ModelOptions,
    OffsetRow,
};
use compare::{encounters, offsets};
use scene::mobility::MobilitySet;
use scene::{Gap, LoadSet, Outcome, RunOptions};
use tests::CloseCsv;

fn options(tolerance: f64) -> SweepOptions {
    SweepOptions {
        run: RunOptions {
            tolerance,
            ..RunOptions::default()
        },
        time_limit: None,
    }
}

/// Tighter than the command's default, so that snapshots do not hang on where steps fell.
const TIGHT: f64 = 1e-11;

fn set_up(method: Method, mesh: usize, direct: bool) -> Model {
    let options = ModelOptions {
        mesh,
        direct,
        cache: None,
        ..ModelOptions::default()
    };
    Model::set_up(method, &options).unwrap()
}

/// The three methods, boundary elements at a coarse level to keep the tests short.
fn models() -> &'static [Model] {
    static MODELS: OnceLock<Vec<Model>> = OnceLock::new();
    MODELS.get_or_init(|| {
        Method::DEFAULT
            .map(|method| set_up(method, 2, false))
            .into()
    })
}

fn paper_cases(approach: Approach) -> Vec<Case> {
    let defaults = Defaults::paper().unwrap();
    let lists = defaults.encounters(approach);
    (lists.beta.iter())
        .flat_map(|&beta| {
            lists.dx.iter().map(move |&dx| Case {
                approach,
                beta,
                dx,
                dz: 0.0,
            })
        })
        .collect()
}

fn snapshot(name: &str, text: &str) {
    let mut settings = insta::Settings::clone_current();
    settings.set_comparator(Box::new(CloseCsv));
    settings.set_omit_expression(true);
    settings.set_prepend_module_to_snapshot(false);
    settings.bind(|| insta::assert_snapshot!(name, text));
}

fn encounter_text(encounters: &[Encounter]) -> String {
    let mut text =
        "method,beta,dx,deflection1_deg,deflection2_deg,min_gap,tau,outcome\n".to_owned();
    for row in encounters.iter().map(Encounter::row) {
        text += &format!(
            "{},{},{},{:.8e},{:.8e},{:.8e},{:.8e},{}\n",
            row.method,
            row.beta,
            row.dx,
            row.deflection1_deg,
            row.deflection2_deg,
            row.min_gap,
            row.tau,
            row.outcome
        );
    }
    text
}

#[test]
fn regress_head_on_deflections() {
    let encounters = encounters(models(), &paper_cases(Approach::HeadOn), &options(TIGHT));
    snapshot("head-on", &encounter_text(&encounters));
}

#[test]
fn regress_orthogonal_deflections() {
    let encounters = encounters(
        models(),
        &paper_cases(Approach::Orthogonal),
        &options(TIGHT),
    );
    snapshot("orthogonal", &encounter_text(&encounters));
}

#[test]
fn regress_offset_sensitivity() {
    let defaults = Defaults::paper().unwrap().offset;
    let (rows, _) = offsets(models(), &defaults.cases(), &defaults.dz, &options(TIGHT));
    let mut text = "case,method,beta,dx,dz,change1_deg,change2_deg,min_gap,outcome\n".to_owned();
    for row in rows {
        let OffsetRow {
            case,
            method,
            beta,
            dx,
            dz,
            change1_deg,
            change2_deg,
            min_gap,
            outcome,
            ..
        } = row;
        text += &format!(
            "{case},{method},{beta},{dx},{dz},{change1_deg:.8e},{change2_deg:.8e},{min_gap:.8e},{outcome}\n"
        );
    }
    snapshot("offset", &text);
}

#[test]
fn val_tabulated_and_direct_boundary_elements_give_the_same_deflections() {
    const MESH: usize = 1;
    let cases: Vec<_> = (paper_cases(Approach::HeadOn).into_iter())
        .filter(|case| [1.0, 3.0].contains(&case.dx))
        .collect();
    // Loose enough that the direct runs stay short; both take the same steps.
    let options = options(1e-6);
    let tabulated = encounters(&[set_up(Method::Bem, MESH, false)], &cases, &options);
    let direct = encounters(&[set_up(Method::Bem, MESH, true)], &cases, &options);
    for (table, solve) in tabulated.iter().zip(&direct) {
        let (a, b) = (table.row(), solve.row());
        println!(
            "dx {}: {:.6} and {:.6} deg, {:.2e} s and {:.2e} s, ratio {:.0}",
            a.dx,
            a.deflection1_deg,
            b.deflection1_deg,
            a.seconds,
            b.seconds,
            b.seconds / a.seconds
        );
        assert!((a.deflection1_deg - b.deflection1_deg).abs() < 0.01);
        assert!((a.deflection2_deg - b.deflection2_deg).abs() < 0.01);
        assert!((a.min_gap - b.min_gap).abs() < 1e-4);
    }
}

#[test]
fn a_tiny_offset_turns_headings_in_proportion_and_by_no_more_than_a_hundred_times_itself() {
    // Angles in radians, offsets in radii: up to about 40 radians a radius for pairs that nearly stay bound.
    const TINY: f64 = 1e-6;
    // Degrees. Without interaction only rounding turns.
    const ROUNDING: f64 = 1e-12;
    // At the first, which is too small for the digits of a proportion, the response is bounded alone.
    const OFFSETS: [f64; 3] = [1e-3 * TINY, TINY, 2.0 * TINY];
    let defaults = Defaults::paper().unwrap().offset;
    let (rows, _) = offsets(models(), &defaults.cases(), &OFFSETS, &options(TIGHT));
    for row in &rows {
        for change in [row.change1_deg, row.change2_deg] {
            assert!(change.to_radians() <= 100.0 * row.dz, "{row:?}");
        }
    }
    let mut turned = 0;
    for of_pair in rows.chunks(OFFSETS.len()) {
        let [_, once, twice] = of_pair else {
            panic!("{} offsets", of_pair.len())
        };
        for (change, of_twice) in [
            (once.change1_deg, twice.change1_deg),
            (once.change2_deg, twice.change2_deg),
        ] {
            if change < ROUNDING {
                assert!(once.min_gap > 0.99 && of_twice < ROUNDING, "{once:?}");
                continue;
            }
            assert!(
                (of_twice / change - 2.0).abs() < 0.02,
                "{once:?}, {twice:?}"
            );
            turned += 1;
        }
    }
    // Of eighteen pairs all but one that lubrication theory lets pass.
    assert_eq!(turned, 2 * 17);
}

#[test]
fn val_boundary_elements_and_the_exact_series_give_the_same_deflections() {
    // Degrees; the coarse mesh's loads are off by about 1e-3 of themselves, and the strong pullers
    // that nearly stay bound multiply that.
    const WITHIN: f64 = 0.5;
    const NEARLY_BOUND: f64 = 2.0;
    for approach in [Approach::HeadOn, Approach::Orthogonal] {
        let all = encounters(models(), &paper_cases(approach), &options(1e-8));
        for bem in all.iter().filter(|e| e.method == Method::Bem) {
            let exact = (all.iter())
                .find(|e| e.method == Method::Exact && e.case == bem.case)
                .unwrap();
            let (a, b) = (bem.row(), exact.row());
            let nearly_bound = approach == Approach::Orthogonal && a.beta > 1.0;
            let within = if nearly_bound { NEARLY_BOUND } else { WITHIN };
            assert!(
                (a.deflection1_deg - b.deflection1_deg).abs() < within,
                "{a:?}"
            );
            assert!(
                (a.deflection2_deg - b.deflection2_deg).abs() < within,
                "{a:?}"
            );
            assert_eq!(a.outcome, b.outcome);
        }
    }
}

#[test]
fn val_tabulated_exact_mobilities_are_within_their_tolerance_of_direct_ones() {
    let table = &models()[1];
    assert_eq!(table.method(), Method::Exact);
    let direct = set_up(Method::Exact, 2, true);
    for i in 0..200 {
        // Off the table's nodes, from contact to far apart.
        let gap = Gap::from_ln(-14.0 + 0.1037 * f64::from(i));
        let read = MobilitySet {
            loads: LoadSet::planar(2),
            torque: true,
        };
        let of = |model: &Model| {
            let mobility = model.mobility(gap, read).unwrap();
            mobility.named(read)
        };
        for ((name, a), (_, b)) in of(table).into_iter().zip(of(&direct)) {
            let error = (a - b).abs() / b.abs().max(1.0);
            assert!(
                error < 3.0 * EXACT_TABLE_TOLERANCE,
                "{name} at {gap:?}: {error:.1e}"
            );
        }
    }
}

#[test]
fn every_encounter_of_the_paper_ends_in_scattering_or_a_named_bound_state() {
    for approach in [Approach::HeadOn, Approach::Orthogonal] {
        for encounter in encounters(models(), &paper_cases(approach), &options(1e-8)) {
            let run = encounter.run.unwrap();
            assert_ne!(run.outcome, Outcome::Undecided, "{:?}", encounter.case);
            assert!(run.min_gap > 0.0);
        }
    }
}
