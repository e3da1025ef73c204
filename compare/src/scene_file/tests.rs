#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use super::functions::FUNCTIONS;
use super::*;

const START: &str = "hydrodynamics = \"lubrication\"
[[squirmer]]
position = [-1.5, 0]
orientation = 0
beta = 1
[[squirmer]]
position = [1.5, 0]
orientation = 180.0
beta = 1
";

/// The mistakes of a text, one a line.
fn mistakes(text: &str) -> Vec<String> {
    let mistakes = SceneFile::parse(text).unwrap_err();
    mistakes.0.iter().map(ToString::to_string).collect()
}

#[test]
fn every_mistake_is_listed_with_its_place_and_what_is_allowed() {
    let text = "hydrodinamics = \"lt\"
repulsion = { kappa1 = -1, kapa2 = 3 }
[[squirmer]]
position = [0, \"a\", 1]
orientation = [0, 0]
beta = nan
[[squirmer]]
position = [1]
orientation = true
modes = [1, 2, 3, 4, 5, 6, 7, 8, 9]
[run]
end_time = 0
max_steps = 1.5
tolerance =
[gravity]
";
    let found = mistakes(text);
    let expected = [
        ("1:1: hydrodynamics:", "give \"none\""),
        ("1:1: hydrodinamics:", "did you mean 'hydrodynamics'?"),
        (
            "2:24: repulsion.kappa1:",
            "found -1; give a number greater than 0",
        ),
        ("2:28: repulsion.kapa2:", "did you mean 'kappa2'?"),
        (
            "4:17: squirmer[0].position[1]:",
            "found a; no such parameter: give a number, or name it in a table [parameters]",
        ),
        ("5:15: squirmer[0].orientation:", "not zero"),
        ("6:8: squirmer[0].beta:", "found nan; give a finite number"),
        (
            "8:12: squirmer[1].position:",
            "found [1]; give a list of 2 to 3",
        ),
        (
            "9:15: squirmer[1].orientation:",
            "found true; give an angle",
        ),
        ("10:9: squirmer[1].modes:", "give a list of 0 to 8"),
        (
            "12:12: run.end_time:",
            "found 0; give a time greater than 0",
        ),
        (
            "13:13: run.max_steps:",
            "found 1.5; give a whole number from 1",
        ),
        ("14:12: ", "not TOML"),
        ("15:1: gravity.direction:", "found nothing; give the vector"),
    ];
    assert_eq!(found.len(), expected.len(), "{found:#?}");
    for (found, (start, contained)) in found.iter().zip(expected) {
        assert!(found.starts_with(start), "{found}: {start}");
        assert!(found.contains(contained), "{found}: {contained}");
    }
}

#[test]
fn overlapping_spheres_and_doubled_squirming_point_to_their_keys() {
    let overlap = START.replace("[1.5, 0]", "[0.4, 0]");
    let found = mistakes(&overlap);
    assert_eq!(found.len(), 1);
    assert!(
        found[0].starts_with("7:12: squirmer[1].position: found [0.4, 0]"),
        "{found:?}"
    );
    let both = START.replacen("beta = 1", "beta = 1\nmodes = [1.5]", 1);
    assert!(mistakes(&both)[0].starts_with("5:8: squirmer[0].beta"));
    let three = format!("{START}[[squirmer]]\n");
    assert!(
        mistakes(&three)
            .iter()
            .any(|m| m.contains("found 3 of them"))
    );
}

#[test]
fn a_decimal_comma_is_told_from_other_mistakes() {
    let first = |from: &str, to: &str| {
        let found = mistakes(&START.replacen(from, to, 1));
        assert_eq!(found.len(), 1, "{found:?}");
        found[0].clone()
    };
    assert_eq!(
        first("beta = 1", "beta = 5,0"),
        "5:8: found 5,0; not TOML: decimals take a point, 5.0"
    );
    assert_eq!(
        first(
            "beta = 1\n",
            "beta = 1\nrun = { end_time = 2,5e1, tolerance = 1e-6 }\n"
        ),
        "6:20: found 2,5e1; not TOML: decimals take a point, 2.5e1"
    );
    assert_eq!(
        first("beta = 1", "beta = \"5,0\""),
        "5:10: squirmer[0].beta: found ,; a comma only stands between the two numbers that a function takes: decimals \
         take a point, 5.0"
    );
    let not_one = first("beta = 1", "beta = 1,2,3");
    assert!(
        not_one.starts_with("5:9: found ,2,3; not TOML: "),
        "{not_one}"
    );
    let list = first("[-1.5, 0]", "[-1,5, 0,0]");
    assert!(list.ends_with("give a list of 2 to 3 finite numbers: decimals take a point, -1.5"));
    let list = first("[-1.5, 0]", "[-1,5,0,0]");
    assert!(
        list.ends_with("give a list of 2 to 3 finite numbers"),
        "{list}"
    );
}

#[test]
fn a_start_that_is_too_near_for_boundary_elements_points_to_its_position() {
    let near = |model: &str| {
        START
            .replace("\"lubrication\"", model)
            .replace("[1.5, 0]", "[0.5001, 0]")
    };
    for model in ["\"bem\"", "{ model = \"bem\", level = 2, direct = true }"] {
        let found = mistakes(&near(model));
        assert_eq!(found.len(), 1, "{found:?}");
        let place = "7:12: squirmer[1].position: found [0.5001, 0]; the start is too near: ";
        assert!(found[0].starts_with(place), "{}", found[0]);
        assert!(found[0].contains("level"), "{}", found[0]);
    }
    assert!(SceneFile::parse(&near("\"exact\"")).is_ok());
}

#[test]
fn keys_of_another_model_are_refused() {
    let level = START.replace("\"lubrication\"", "{ model = \"exact\", level = 2 }");
    assert!(mistakes(&level)[0].contains("hydrodynamics.level"));
    let level = START.replace("\"lubrication\"", "{ model = \"bem\", level = 9 }");
    assert!(mistakes(&level)[0].contains("found 9; give a whole number from 1 to 5"));
}

#[test]
fn repulsion_that_reaches_beyond_the_cut_of_lubrication_is_refused() {
    let with = |model: &str| {
        START.replace(
            "\"lubrication\"",
            &format!("\"{model}\"\nrepulsion = {{ kappa2 = 2 }}"),
        )
    };
    assert!(mistakes(&with("lubrication"))[0].contains("choose kappa2 so large"));
    assert!(SceneFile::parse(&with("exact")).is_ok());
    assert!(SceneFile::parse(&with("none")).is_ok());
}

#[test]
fn what_is_left_out_has_its_default() {
    let file = SceneFile::parse(START).unwrap();
    let run = RunOptions {
        sample_interval: Some(SAMPLE_INTERVAL),
        ..RunOptions::default()
    };
    assert_eq!(file.run, run);
    assert_eq!((file.method, file.scene.repulsion), (Method::Lt, None));
    assert_eq!(file.scene.squirmers[0].modes(), [1.5, 1.5]);
}

/// The blocks of a page that begin with a line of backquotes and `kind`.
fn blocks<'a>(page: &'a str, kind: &str) -> Vec<&'a str> {
    let opening = format!("```{kind}\n");
    (page.split(opening.as_str()).skip(1))
        .filter_map(|rest| rest.split("```").next())
        .collect()
}

#[test]
fn the_examples_of_the_reference_page_are_read_and_name_every_key() {
    let page = include_str!("../../../docs/SCENES.md");
    let examples = blocks(page, "toml");
    assert_eq!(examples.len(), 4);
    let all = SceneFile::parse(examples[1]).unwrap();
    assert_eq!(all.method, Method::LtCorrected);
    assert_eq!(all.scene.squirmers[0].modes(), [1.5, 7.5, 0.3]);
    assert_eq!(all.scene.squirmers[0].swirl(), [0.0, 0.4]);
    assert!(all.scene.gravity.is_some());
    for example in examples {
        SceneFile::parse(example).unwrap();
    }
    for (name, _) in FUNCTIONS {
        assert!(page.contains(&format!("`{name}")), "{name}");
    }
    // What the page says are defaults are the defaults.
    let defaults = SceneFile::parse(START).unwrap().run;
    assert_eq!(all.run, defaults);
}

#[test]
fn the_mistakes_of_the_reference_page_are_those_that_are_printed() {
    let page = include_str!("../../../docs/SCENES.md");
    let shown = blocks(page, "console")[0];
    let text = START
        .replace(
            "hydrodynamics = \"lubrication\"",
            "hydrodynamics = \"none\"\nrepulsion = \"off\"\n",
        )
        .replacen("beta = 1", "beta = \"five\"", 1);
    let found = mistakes(&text);
    assert_eq!(found.len(), 1, "{found:?}");
    assert!(shown.contains(&found[0]), "{}", found[0]);
    let family = Family::parse(blocks(page, "toml")[3]).unwrap();
    let mistakes = family.scene(&[("dx", 0.0), ("turn", 180.0)]).unwrap_err();
    let shown = blocks(page, "text")[0].trim_end();
    assert_eq!(shown, mistakes.to_string());
}

#[test]
fn a_second_squirmer_has_a_radius_and_the_first_is_the_unit_of_length() {
    let with = |first: &str, second: &str| {
        START
            .replacen("beta = 1\n", &format!("beta = 1\n{first}\n"), 1)
            .replace("[1.5, 0]", "[4.5, 0]")
            + second
    };
    let file = SceneFile::parse(&with("radius = 1.0", "radius = 2.5")).unwrap();
    let radii = file.scene.squirmers.map(|s| s.radius().to_bits());
    assert_eq!(radii, [1.0, 2.5].map(f64::to_bits));
    let gap = file.scene.gap().unwrap().eps();
    assert!((gap - 2.5).abs() < 1e-14, "{gap}");
    let first = mistakes(&with("radius = 2", ""));
    assert!(
        first[0].starts_with("6:10: squirmer[0].radius:") && first[0].contains("unit of length"),
        "{first:?}"
    );
    let second = mistakes(&with("", "radius = 200"));
    assert!(
        second[0].starts_with("11:10: squirmer[1].radius:") && second[0].contains("0.01 to 100"),
        "{second:?}"
    );
}

#[test]
fn repulsion_must_have_died_out_at_the_cut_of_the_smaller_squirmer() {
    let scene = format!("repulsion = \"paper\"\n{START}radius = 0.1\n");
    let found = mistakes(&scene);
    assert!(found[0].contains("ends at a gap of 0.1"), "{found:?}");
    let weaker = "repulsion = { kappa1 = 0.1, kappa2 = 1000.0 }";
    assert!(SceneFile::parse(&scene.replace("repulsion = \"paper\"", weaker)).is_ok());
}

#[test]
fn control_characters_are_written_out_in_mistakes() {
    // In what is not TOML, in keys, in values, in names of expressions.
    for text in [
        "a = 1\n# \0\u{1b}[31m\n",
        "\"a\\nb\u{9b}\" = 1",
        "hydrodynamics = \"\u{7f}\u{85}\"",
        "[parameters]\n\"a\\u001b\" = 1\nb = \"\u{90}\"",
    ] {
        for line in mistakes(text) {
            assert!(!line.contains(char::is_control), "{line:?}");
        }
    }
}
