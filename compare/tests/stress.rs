//! Stresslets, power and efficiency: laws that no model may break, limits in closed form, and what is refused.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use compare::study::stress::{
    Growth, StressEncounterRow, contact_laws, stress_encounters, stress_rows, stress_run,
};
use compare::{Approach, Case, CompareError, Defaults, Method, ModelOptions, SceneFile};
use scene::{Gap, RunOptions};

fn options() -> ModelOptions {
    let folder = std::env::temp_dir().join("squirmers-stress-tests");
    ModelOptions {
        cache: Some(folder),
        ..ModelOptions::default()
    }
}

fn encounters(cases: &[Case], departure_distance: f64) -> Vec<StressEncounterRow> {
    let run = RunOptions {
        departure_distance,
        ..RunOptions::default()
    };
    let (rows, failures) = stress_encounters(&[Method::Exact], cases, &run, &options()).unwrap();
    assert!(failures.is_empty(), "{failures:?}");
    rows
}

#[test]
fn val_what_the_surfaces_do_is_dissipated_along_every_encounter_of_the_paper() {
    let rows = encounters(&Defaults::paper_encounters().unwrap(), 12.0);
    assert_eq!(rows.len(), 17);
    for row in &rows {
        println!("{row:?}");
        assert!(row.budget < 1e-8, "{row:?}");
        assert!(row.integration < 1e-4 * row.excess().max(1.0), "{row:?}");
        let lone = 1.0 / (2.0 + row.beta * row.beta);
        assert!((row.lone_efficiency - lone).abs() < 1e-14, "{row:?}");
        // In the plane of motion.
        assert!(
            row.excess_xz.abs().max(row.excess_yz.abs()) < 1e-9,
            "{row:?}"
        );
    }
}

#[test]
fn val_the_integral_of_the_excess_converges_as_the_run_ends_further_out() {
    let case = Case {
        approach: Approach::Orthogonal,
        beta: 1.0,
        dx: 1.0,
        dz: 0.0,
    };
    let rows = [12.0, 24.0, 48.0].map(|departure| encounters(&[case], departure).remove(0));
    let apart = |a: &StressEncounterRow, b: &StressEncounterRow| {
        let differences = [
            a.excess_xx - b.excess_xx,
            a.excess_xy - b.excess_xy,
            a.excess_yy - b.excess_yy,
        ];
        differences.into_iter().map(f64::abs).fold(0.0, f64::max)
    };
    let (first, second) = (apart(&rows[0], &rows[1]), apart(&rows[1], &rows[2]));
    println!("{first} {second}, beyond {}", rows[0].beyond);
    assert!(first < rows[0].beyond, "{first} {}", rows[0].beyond);
    // The rest falls as the square of the distance.
    assert!(second < 0.4 * first, "{first} {second}");
}

#[test]
fn val_far_apart_squirmers_have_the_power_of_lone_ones() {
    let text = "
        hydrodynamics = \"exact\"
        [[squirmer]]
        beta = 5.0
        position = [0.0, 0.0]
        orientation = 30.0
        [[squirmer]]
        beta = -1.0
        position = [500.0, 20.0]
        orientation = 200.0
        [run]
        end_time = 0.2
    ";
    let file = SceneFile::parse(text).unwrap();
    let run = stress_run(&file, Method::Exact, &options()).unwrap();
    for row in &run.rows {
        // The other one's flow, which falls as r^-2, carries a squirmer along.
        assert!((row.efficiency1 - 1.0 / 27.0).abs() < 3e-5, "{row:?}");
        assert!((row.efficiency2 - 1.0 / 3.0).abs() < 3e-5, "{row:?}");
        assert!(row.excess_xx.abs() < 1e-5 && row.budget < 1e-8, "{row:?}");
    }
    assert!((run.summary.growth - 1.0).abs() < 1e-5, "{:?}", run.summary);
}

#[test]
fn val_stresslets_grow_near_contact_as_published() {
    let gaps = [1e-3, 1e-4, 1e-5].map(|eps| Gap::new(eps).unwrap());
    let rows = stress_rows(&[Method::Exact], &gaps, (2, 0), &options()).unwrap();
    for row in &rows {
        assert!(row.error_estimate.parse::<f64>().unwrap() < 1e-9, "{row:?}");
    }
    let laws = contact_laws(&rows, Method::Exact, 1.0);
    let of = |name: &str| laws.iter().find(|law| law.name == name).unwrap();
    for line in fixtures::STRESSLETS_NEAR_CONTACT.lines().skip(2) {
        let row: Vec<_> = line.split(',').collect();
        let number = |k: usize| row[k].parse::<f64>().unwrap();
        if row[0] != "1" {
            continue;
        }
        let law = of(row[1]);
        let (growth, factor) = if row[2] == "0.0" {
            (Growth::Logarithm, number(3))
        } else {
            (Growth::Inverse, number(2))
        };
        assert_eq!(law.growth, growth, "{law:?}");
        assert!((law.factor - factor).abs() < 2e-3, "{law:?} {factor}");
    }
    assert_eq!(of("ZS1_2").growth, Growth::Bounded);
}

#[test]
fn val_work_between_two_modes_is_bounded_where_that_of_each_is() {
    // The rates of work are positive: W_12^2 <= W_11 W_22.
    let gaps = [1e-2, 1e-3, 1e-4].map(|eps| Gap::new(eps).unwrap());
    let rows = stress_rows(&[Method::Exact], &gaps, (2, 0), &options()).unwrap();
    let laws = contact_laws(&rows, Method::Exact, 1.0);
    let of = |name: &str| laws.iter().find(|law| law.name == name).unwrap().growth;
    for order in ["X", "Z"] {
        for name in ["P1_1_1", "P1_1_2", "P1_2_2", "P2_1_1", "P2_1_2", "P2_2_2"] {
            // Order 2 has no slip of the first mode.
            if order == "X" || name.ends_with("2_2") {
                let name = format!("{order}{name}");
                assert_eq!(of(&name), Growth::Bounded, "{name}");
            }
        }
    }
    for name in ["YP1_1_1", "YP1_1_2", "YP1_2_2"] {
        assert_eq!(of(name), Growth::Logarithm, "{name}");
    }
}

#[test]
fn methods_without_stresslets_are_refused_in_one_line() {
    for (method, told) in [
        (Method::Lt, "no stresslet beyond its singular parts"),
        (
            Method::LtCorrected,
            "no stresslet beyond its singular parts",
        ),
    ] {
        let gap = Gap::new(0.1).unwrap();
        let refused = stress_rows(&[method], &[gap], (2, 0), &options()).unwrap_err();
        let line = refused.to_string();
        assert!(matches!(refused, CompareError::Input { .. }), "{refused:?}");
        assert!(line.contains(told) && !line.contains('\n'), "{line}");
    }
}
