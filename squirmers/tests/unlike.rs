//! Unlike radii on the command line: what is written, that it goes on after a stop, and that bad input costs one line.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

mod program;

use std::path::Path;

use program::squirmers;

fn text(out: &Path, file: &str) -> String {
    std::fs::read_to_string(out.join(file)).unwrap()
}

const CARGO: [&str; 9] = [
    "cargo", "--method", "lt", "--beta", "0,5", "--ratio", "0.5,1,3", "--b", "0.3,6",
];

#[test]
fn cargo_has_a_row_for_each_run_and_a_picture_for_each_swimmer_and_goes_on_after_a_stop() {
    let whole = tempfile::tempdir().unwrap();
    let output = squirmers(whole.path(), &CARGO);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let csv = text(whole.path(), "cargo.csv");
    assert_eq!(csv.lines().count(), 1 + 2 * 3 * 2);
    assert!(
        csv.starts_with("method,beta,ratio,b,along,across,"),
        "{csv}"
    );
    // What is not met is left where it is.
    assert!(csv.contains("lt,0.0,0.5,6.0,0.0,0.0,"), "{csv}");
    for beta in ["0", "5"] {
        let svg = text(whole.path(), &format!("cargo-beta{beta}.svg"));
        assert!(svg.contains("λ = 0.5") && svg.contains("Lubrication theory, along the path"));
    }
    let folder = tempfile::tempdir().unwrap();
    let stopped = [&CARGO[..], &["--time-limit", "0"]].concat();
    assert_eq!(squirmers(folder.path(), &stopped).status.code(), Some(75));
    assert_eq!(squirmers(folder.path(), &CARGO).status.code(), Some(0));
    assert_eq!(text(folder.path(), "cargo.csv"), csv);
}

#[test]
fn ratios_do_not_depend_on_the_number_of_threads_nor_on_a_stop() {
    let arguments = [
        "ratios", "--method", "lt,exact", "--ratio", "0.5,1,2", "--beta", "5", "--grid", "6",
    ];
    let [one, two] = ["1", "2"].map(|threads| {
        let folder = tempfile::tempdir().unwrap();
        let arguments = [&arguments[..], &["--threads", threads]].concat();
        if threads == "2" {
            let stopped = [&arguments[..], &["--time-limit", "0"]].concat();
            assert_eq!(squirmers(folder.path(), &stopped).status.code(), Some(75));
        }
        let output = squirmers(folder.path(), &arguments);
        assert_eq!(output.status.code(), Some(0), "{output:?}");
        assert!(text(folder.path(), "ratios-lt.svg").contains("β = 5"));
        text(folder.path(), "ratios.csv")
    });
    assert_eq!(one, two);
    // A pair and the same pair named the other way round.
    let shares = |line: &str| {
        line.split(',')
            .skip(4)
            .map(str::to_owned)
            .collect::<Vec<_>>()
    };
    let lines: Vec<&str> = one.lines().collect();
    assert_eq!(shares(lines[1]), shares(lines[3]));
    assert_ne!(shares(lines[1]), shares(lines[2]));
}

#[test]
fn loads_of_unlike_radii_have_names_of_both_spheres() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = [
        "loads", "--gap", "0.1", "--ratio", "1,0.5", "--method", "lt,exact",
    ];
    let output = squirmers(folder.path(), &arguments);
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let csv = text(folder.path(), "loads.csv");
    for (method, name, ratio) in [
        ("lt", "X12A", "1.0"),
        ("exact", "X21A", "0.5"),
        ("exact", "XF12_2", "0.5"),
        ("lt", "Y21B", "0.5"),
    ] {
        let row = |line: &&str| {
            line.starts_with(&format!("{method},0.1,{name},"))
                && line.ends_with(&format!(",{ratio}"))
        };
        assert_eq!(
            csv.lines().filter(row).count(),
            1,
            "{method} {name} {ratio}: {csv}"
        );
    }
}

#[test]
fn what_is_not_allowed_costs_one_line() {
    for (arguments, named) in [
        (
            &["cargo", "--ratio", "1000", "--method", "lt"][..],
            "0.01 to 100",
        ),
        (
            &["cargo", "--b", "50", "--far", "10", "--method", "lt"],
            "--b",
        ),
        (
            &["ratios", "--ratio", "-1", "--method", "lt,exact"],
            "0.01 to 100",
        ),
        (&["ratios", "--method", "lt"], "name exact"),
        (&["ratios", "--method", "exact"], "name exact"),
        (&["loads", "--gap", "1", "--ratio", "0"], "--ratio"),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let output = squirmers(folder.path(), arguments);
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
        assert_eq!(message.lines().count(), 1, "{arguments:?}: {message}");
        assert!(message.contains(named), "{arguments:?}: {message}");
    }
}
