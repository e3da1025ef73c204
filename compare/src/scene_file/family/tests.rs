//! Families: what they give, and where their mistakes are.

#![allow(clippy::float_cmp, reason = "exactly equal is what is claimed")]
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::f64::consts::PI;

use nalgebra::Vector3;
use scene::{Orientation, Repulsion, Squirmer};

use super::*;
use crate::{Method, SceneFile};

const FAMILY: &str = "[parameters]
dx = 1.0 # δx
half = \"dx/2\"
tilt = 0
[[squirmer]]
position = [\"-half\", 5]
orientation = \"-90 + tilt\"
beta = \"2 + half\"
[[squirmer]]
position = [\"half\", -5]
orientation = { radians = \"pi/2\" }
beta = 1
";

/// Two squirmers that face each other.
const FACING: &str = "[parameters]
dx = 3.0
kappa = 100
[[squirmer]]
position = [0, 0]
orientation = 0
beta = 1
[[squirmer]]
position = [\"dx\", 0]
orientation = 180
beta = 1
[repulsion]
kappa2 = \"kappa\"
";

fn told(mistakes: Mistakes) -> Vec<String> {
    mistakes.0.iter().map(ToString::to_string).collect()
}

/// The mistakes of a family, one a line.
fn mistakes(text: &str) -> Vec<String> {
    told(Family::parse(text).unwrap_err())
}

/// The one mistake of the family in which `from` is replaced.
fn mistake(from: &str, to: &str) -> String {
    assert!(FAMILY.contains(from), "{from}");
    let found = mistakes(&FAMILY.replacen(from, to, 1));
    assert_eq!(found.len(), 1, "{from} -> {to}: {found:#?}");
    found[0].clone()
}

#[test]
fn a_family_has_a_scene_for_each_value_and_defaults_follow() {
    let family = Family::parse(FAMILY).unwrap();
    let known: Vec<_> = family.parameters().collect();
    assert_eq!(known, [("dx", 1.0), ("half", 0.5), ("tilt", 0.0)]);
    assert_eq!(family.text(), FAMILY);
    let at = |values: &[(&str, f64)]| family.scene(values).unwrap().scene;
    let [one, two] = at(&[]).start;
    assert_eq!(one.position, Vector3::new(-0.5, 5.0, 0.0));
    assert_eq!(one.orientation, Orientation::Radians(-PI / 2.0));
    assert_eq!(two.orientation, Orientation::Radians(PI / 2.0));
    let scene = at(&[("dx", 3.0)]);
    assert_eq!(scene.start[1].position.x, 1.5);
    assert_eq!(scene.squirmers[0], Squirmer::with_beta(1.0, 3.5).unwrap());
    // A value that is given holds, whatever the default would be, and the later one of two.
    assert_eq!(at(&[("dx", 3.0), ("half", 0.25)]).start[1].position.x, 0.25);
    assert_eq!(at(&[("dx", 3.0), ("dx", 2.0)]).start[1].position.x, 1.0);
}

#[test]
fn every_number_may_be_an_expression() {
    let text = "[parameters]
n = 2
[[squirmer]]
position = [\"-n\", \"0*n\", \"n/2\"]
orientation = [\"n\", \"n - 2\", 1]
modes = [\"n\", 1, \"-n\"]
swirl = [0, \"n/4\"]
bottom_heaviness = \"5*n\"
[[squirmer]]
position = [\"n\", 0]
orientation = 0
swimming_speed = \"1/n\"
beta = \"n^2\"
[repulsion]
kappa1 = \"10*n\"
kappa2 = \"100*n\"
[gravity]
direction = [0, 0, \"-n\"]
[run]
end_time = \"100*n\"
departure_distance = \"6*n\"
tolerance = \"10^(-3*n)\"
[output]
sample_interval = \"0.05*n\"
";
    let found = Family::parse(text).unwrap().scene(&[("n", 3.0)]).unwrap();
    let [one, two] = found.scene.squirmers;
    assert_eq!(
        (one.modes(), one.swirl()),
        (&[3.0, 1.0, -3.0][..], &[0.0, 0.75][..])
    );
    assert_eq!(one.bottom_heaviness(), 15.0);
    assert_eq!(two, Squirmer::with_beta(1.0 / 3.0, 9.0).unwrap());
    let orientation = Orientation::Vector([3.0, 1.0, 1.0].into());
    assert_eq!(found.scene.start[0].orientation, orientation);
    assert_eq!(
        found.scene.repulsion,
        Some(Repulsion::new(30.0, 300.0).unwrap())
    );
    let down = Gravity::new([0.0, 0.0, -1.0].into()).unwrap();
    assert_eq!(found.scene.gravity, Some(down));
    let run = found.run;
    assert_eq!((run.end_time, run.departure_distance), (300.0, 18.0));
    assert_eq!(
        (run.tolerance, run.sample_interval),
        (1e-9, Some(0.05 * 3.0))
    );
}

#[test]
fn mistakes_within_expressions_have_their_own_places() {
    for (from, to, expected) in [
        (
            "\"-half\"",
            "\"-halb\"",
            "6:15: squirmer[0].position[0]: found halb; no such parameter: did you mean 'half'?",
        ),
        (
            "\"2 + half\"",
            "\"2 + \"",
            "8:13: squirmer[0].beta: found nothing; a number, a name or ( is missing here",
        ),
        (
            "\"2 + half\"",
            "\"\"",
            "8:8: squirmer[0].beta: found nothing; the expression is empty: give a number or an expression",
        ),
        (
            "\"2 + half\"",
            "\"2*(1 + half\"",
            "8:11: squirmer[0].beta: found (; no ) closes this",
        ),
        (
            "\"2 + half\"",
            "\"sine(half)\"",
            "8:9: squirmer[0].beta: found sine; no such function: did you mean 'sin'?",
        ),
        (
            "{ radians = \"pi/2\" }",
            "{ radians = 'pi/2 δ' }",
            "11:33: squirmer[1].orientation.radians: found δ; an operator is missing before this: + - * / or ^",
        ),
        (
            "\"2 + half\"",
            "\"\"\"\n2 + half +\n  %\"\"\"",
            "10:3: squirmer[0].beta: found %; a number, a name or ( is missing here",
        ),
        // With escapes only the string has a place.
        (
            "\"2 + half\"",
            "\"2 + \\\"half\"",
            "8:8: squirmer[0].beta: found \"2 + \\\"half\"; a number, a name or ( is missing here",
        ),
    ] {
        assert_eq!(mistake(from, to), expected);
    }
    // All names that are wrong are told. Characters of more than one byte before the place are one column each.
    let found = mistakes(&FAMILY.replace("\"2 + half\"", "\"βγ*half + two\""));
    assert_eq!(found.len(), 2, "{found:#?}");
    assert!(
        found[0].starts_with("8:9: squirmer[0].beta: found βγ; no such parameter: allowed are dx,")
    );
    assert!(
        found[1].starts_with("8:19: squirmer[0].beta: found two; no such"),
        "{found:#?}"
    );
}

#[test]
fn mistakes_in_parameters_are_told() {
    for (from, to, expected) in [
        (
            "\"dx/2\"",
            "\"dx/tilt\"",
            "3:12: parameters.half: found tilt; it stands below",
        ),
        (
            "\"dx/2\"",
            "\"dx/half\"",
            "3:12: parameters.half: found half; a parameter cannot be read in its own value",
        ),
        (
            "tilt = 0",
            "tilt = true",
            "4:8: parameters.tilt: found true; give a finite number",
        ),
        (
            "tilt = 0",
            "tilt = 0\npi = 3",
            "5:1: parameters.pi: found pi; pi has a meaning in expressions",
        ),
        (
            "tilt = 0",
            "tilt = 0\nsin = 3",
            "5:1: parameters.sin: found sin; sin has a meaning",
        ),
        (
            "tilt = 0",
            "tilt = 0\n\"d-x\" = 3",
            "5:1: parameters.d-x: found \"d-x\"; give a name of letters",
        ),
        (
            "tilt = 0",
            "tilt = 0\n2x = 3",
            "5:1: parameters.2x: found 2x; give a name of letters",
        ),
        (
            "tilt = 0",
            "tilt = 0\ndz = 3",
            "5:1: parameters.dz: found dz; no expression reads this parameter",
        ),
        (
            "[parameters]\n",
            "parameters = 1\n[other]\n",
            "1:14: parameters: found 1; give a table [parameters]",
        ),
    ] {
        let found = mistakes(&FAMILY.replacen(from, to, 1));
        assert!(found[0].starts_with(expected), "{found:#?}: {expected}");
    }
    // The order is that of the file, not of the alphabet or of reading.
    let swapped = FAMILY
        .replacen("dx = 1.0 # δx\n", "", 1)
        .replacen("tilt = 0", "dx = 1.0", 1)
        .replacen("-90 + tilt", "-90 + dx", 1);
    let found = mistakes(&swapped);
    assert!(
        found[0].starts_with("2:9: parameters.half: found dx; it stands below"),
        "{found:#?}"
    );
}

#[test]
fn ranges_are_held_at_each_point_with_the_values_that_led_there() {
    let text = format!("{FAMILY}[run]\ntolerance = \"10^tilt*1e-8\"\nend_time = \"1e6 - tilt\"\n");
    let family = Family::parse(&text).unwrap();
    let at = |values: &[(&str, f64)]| told(family.scene(values).unwrap_err());
    let found = at(&[("tilt", 9.0)]);
    assert_eq!(
        found,
        [
            "14:13: run.tolerance: found \"10^tilt*1e-8\" = 10; give a number from 1e-14 to 1e-2; with dx = 1, half = 0.5, tilt = 9"
        ]
    );
    let found = at(&[("tilt", -1.0), ("half", 1.0), ("dx", f64::NAN), ("dy", 2.0)]);
    assert_eq!(found.len(), 3, "{found:#?}");
    assert_eq!(
        found[0],
        "1:1: parameters: found dy = 2; no such parameter: did you mean 'dx'?"
    );
    assert_eq!(
        found[1],
        "2:6: parameters.dx: found dx = NaN; give a finite number"
    );
    assert!(
        found[2].starts_with("15:12: run.end_time: found \"1e6 - tilt\" = 1.000001e6; give a time")
    );
    // Sphere on sphere: the second one's position is what is told.
    let family = Family::parse(FACING).unwrap();
    let found = told(family.scene(&[("dx", 1.5)]).unwrap_err());
    assert_eq!(
        found,
        [
            "9:12: squirmer[1].position: found [\"dx\", 0]; gap -0.5 is not allowed: the gap between the spheres must be \
          positive and finite; with dx = 1.5, kappa = 100"
        ]
    );
    // A family whose defaults give no scene is none.
    assert_eq!(mistakes(&FACING.replace("dx = 3.0", "dx = 1.5")), found);
}

#[test]
fn what_is_not_finite_is_a_mistake_that_names_the_value() {
    let family = Family::parse(&FAMILY.replace("2 + half", "1/dx")).unwrap();
    let found = told(family.scene(&[("dx", 0.0)]).unwrap_err());
    assert_eq!(
        found,
        [
            "8:8: squirmer[0].beta: found \"1/dx\" = inf; give a finite number; with dx = 0, half = 0, tilt = 0"
        ]
    );
    // What follows from a parameter without a value is no mistake of its own.
    assert!(
        mistake("\"dx/2\"", "\"ln(-dx)\"")
            .starts_with("3:8: parameters.half: found \"ln(-dx)\" = NaN; give")
    );
    assert!(mistake("tilt = 0", "tilt = \"1e999\"").contains("found \"1e999\" = inf"));
}

#[test]
fn a_family_need_not_name_its_model_but_a_scene_that_is_run_must() {
    assert_eq!(Family::parse(FAMILY).unwrap().hydrodynamics(), None);
    let found = told(SceneFile::parse(FAMILY).unwrap_err());
    assert_eq!(found.len(), 1);
    assert!(
        found[0].starts_with("1:1: hydrodynamics: found nothing; give \"none\", \"lubrication\"")
    );
    let named = format!("hydrodynamics = \"exact\"\n{FAMILY}");
    let exact = Hydrodynamics::from(Method::Exact);
    assert_eq!(Family::parse(&named).unwrap().hydrodynamics(), Some(exact));
    assert_eq!(SceneFile::parse(&named).unwrap().method, Method::Exact);
}

#[test]
fn a_model_that_is_chosen_later_has_its_say_about_starts_and_repulsion() {
    let family = Family::parse(FACING).unwrap();
    let under = |method: Method, values: &[(&str, f64)]| {
        let family = family.clone().under(method.into());
        family.scene(values).map(|_| ()).map_err(told)
    };
    assert_eq!(under(Method::Exact, &[("kappa", 2.0)]), Ok(()));
    let found = under(Method::Lt, &[("kappa", 2.0)]).unwrap_err();
    assert!(
        found[0].starts_with("12:1: repulsion: found "),
        "{found:#?}"
    );
    assert!(
        found[0].ends_with("or other hydrodynamics; with dx = 3, kappa = 2"),
        "{found:#?}"
    );
    assert_eq!(under(Method::Bem, &[]), Ok(()));
    let found = under(Method::Bem, &[("dx", 2.0001)]).unwrap_err();
    assert!(found[0].contains("the start is too near"), "{found:#?}");
    assert_eq!(under(Method::Exact, &[("dx", 2.0001)]), Ok(()));
}

/// Processor time of this thread, in nanoseconds.
fn processor_time() -> u64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap();
    text.split(' ').next().unwrap().parse().unwrap()
}

#[test]
#[ignore = "a measurement: cargo test --release -p squirmers-compare --lib what_a_scene_costs -- --ignored --nocapture"]
fn what_a_scene_costs() {
    for (name, text) in Family::PAPER {
        let family = Family::parse(text).unwrap();
        let names: Vec<_> = family.parameters().map(|(name, _)| name).collect();
        let calls = 100_000;
        let begun = processor_time();
        for call in 0..calls {
            let value = 1.0 + 1e-6 * f64::from(call);
            let values = [(names[0], value), (names[1], value), (names[2], value)];
            std::hint::black_box(family.scene(std::hint::black_box(&values)).unwrap());
        }
        let each = (processor_time() - begun) as f64 / f64::from(calls);
        println!("{name}: {each:.0} ns of processor time a scene");
    }
}
