//! `squirmers flow`: what it refuses, which instants it finds, and that its files depend on nothing but the command.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

mod program;
mod start;

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::time::{Duration, Instant};

use program::squirmers;
use start::start;

fn scene(name: &str) -> String {
    let path =
        PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("../fixtures/scenes/{name}.toml"));
    path.to_str().unwrap().to_owned()
}

fn flow(out: &Path, name: &str, more: &[&str]) -> Output {
    squirmers(out, &[&["flow", &scene(name)], more].concat())
}

/// Names of the files in a folder.
fn files(folder: &Path) -> Vec<String> {
    let Ok(entries) = std::fs::read_dir(folder) else {
        return Vec::new();
    };
    let mut names: Vec<_> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

/// The one line of a refusal, which leaves no files.
fn refusal(more: &[&str]) -> String {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let output = flow(&out, "fig6-head-on-dx1", more);
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{more:?}: {message}");
    assert_eq!(message.lines().count(), 1, "{message}");
    assert!(files(&out).is_empty());
    message
}

#[test]
fn models_of_loads_alone_are_refused() {
    // That of the scene is lubrication theory.
    for more in [&[][..], &["--method", "lt"], &["--method", "lt-corrected"]] {
        let message = refusal(more);
        assert!(
            message.contains("loads, no flow: give exact or bem"),
            "{message}"
        );
    }
    assert!(refusal(&["--method", "exact,bem"]).contains("one method"));
    let theirs = concat!(
        "theirs=",
        env!("CARGO_MANIFEST_DIR"),
        "/../fixtures/peers/multiblobs-642.csv"
    );
    assert!(refusal(&["--method", theirs]).contains("'theirs'"));
}

#[test]
fn bad_views_are_refused_before_anything_is_computed() {
    for (option, value, said) in [
        ("--frame", "3", "use one of lab, 1, 2"),
        ("--grid", "1", "from 2 to 2000"),
        ("--window", "0", "greater than 0"),
        ("--window", "nan", "NaN"),
        ("--time", "x", "'x'"),
    ] {
        let message = refusal(&["--method", "exact", option, value]);
        assert!(message.contains(said), "{option} {value}: {message}");
    }
    let both = refusal(&["--method", "exact", "--time", "1", "--gap", "1"]);
    assert!(both.contains("cannot be used with"), "{both}");
}

#[test]
fn help_has_an_example() {
    let output = Command::new(env!("CARGO_BIN_EXE_squirmers"))
        .args(["flow", "--help"])
        .output()
        .unwrap();
    let help = String::from_utf8(output.stdout).unwrap();
    assert!(
        help.contains("Example:\n  squirmers flow fixtures/scenes/"),
        "{help}"
    );
}

const EXACT: [&str; 4] = ["--method", "exact", "--grid", "24"];

#[test]
fn instants_that_the_run_does_not_reach_are_refused() {
    let late = refusal(&[&EXACT[..], &["--time", "100"]].concat());
    assert!(
        late.contains("--time '100'") && late.contains("scattered"),
        "{late}"
    );
    let close = refusal(&[&EXACT[..], &["--gap", "1e-9"]].concat());
    assert!(
        close.contains("--gap '1e-9'") && close.contains("smallest gap of the run is"),
        "{close}"
    );
    let many = refusal(&[&EXACT[..], &["--every", "1e-6"]].concat());
    assert!(many.contains("--every"), "{many}");
}

/// A number in the printed table.
fn printed(output: &Output, name: &str) -> f64 {
    assert!(output.status.success(), "{output:?}");
    let table = String::from_utf8(output.stdout.clone()).unwrap();
    assert!(
        table.lines().all(|line| line.chars().count() <= 80),
        "{table}"
    );
    let line = table.lines().find(|line| line.contains(name)).unwrap();
    line.split_whitespace().last().unwrap().parse().unwrap()
}

#[test]
fn instants_are_found_and_files_are_the_same_for_any_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    let out = |name: &str| folder.path().join(name);
    let closest = flow(&out("closest"), "fig6-head-on-dx1", &EXACT);
    let t = printed(&closest, "time").to_string();
    let at = flow(
        &out("at"),
        "fig6-head-on-dx1",
        &[&EXACT[..], &["--time", &t]].concat(),
    );
    assert!((printed(&at, "gap") - printed(&closest, "gap")).abs() < 1e-4);
    let gap = flow(
        &out("gap"),
        "fig6-head-on-dx1",
        &[&EXACT[..], &["--gap", "0.5"]].concat(),
    );
    assert!((printed(&gap, "gap") - 0.5).abs() < 1e-6);
    assert!(printed(&gap, "time") < printed(&closest, "time"));
    let mut kept = Vec::new();
    for threads in ["1", "2"] {
        let more = [&EXACT[..], &["--vtk", "--threads", threads]].concat();
        assert!(
            flow(&out(threads), "fig6-head-on-dx1", &more)
                .status
                .success()
        );
        let names = files(&out(threads));
        let bytes = names
            .iter()
            .map(|name| std::fs::read(out(threads).join(name)).unwrap());
        kept.push((names.clone(), bytes.collect::<Vec<_>>()));
    }
    assert!(kept[0] == kept[1]);
    let expected = [
        "flow-surface1.vtu",
        "flow-surface2.vtu",
        "flow.csv",
        "flow.pvd",
        "flow.svg",
        "flow.vts",
    ];
    assert_eq!(kept[0].0, expected);
}

#[test]
fn frames_differ_by_one_velocity_in_the_whole_fluid() {
    let folder = tempfile::tempdir().unwrap();
    let rows = |frame: &str| {
        let out = folder.path().join(frame);
        let more = [&EXACT[..], &["--frame", frame]].concat();
        assert!(flow(&out, "fig6-head-on-dx1", &more).status.success());
        let mut reader = csv::Reader::from_path(out.join("flow.csv")).unwrap();
        let rows = reader.records().map(|row| {
            let row = row.unwrap();
            [7, 8, 9].map(|column| row[column].parse::<f64>().unwrap())
        });
        rows.collect::<Vec<_>>()
    };
    let lab = rows("lab");
    for frame in ["1", "2"] {
        let moving = rows(frame);
        let differences = lab
            .iter()
            .zip(&moving)
            .map(|(a, b)| [0, 1, 2].map(|k| a[k] - b[k]));
        let known: Vec<_> = differences.filter(|d| d[0].is_finite()).collect();
        assert!(known.len() > 400 && known[0][0].hypot(known[0][1]) > 0.01);
        assert!(
            known
                .iter()
                .all(|d| (0..3).all(|k| (d[k] - known[0][k]).abs() < 1e-12))
        );
    }
}

#[cfg(unix)]
#[test]
fn an_interrupted_film_keeps_its_frames_and_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let (cut, whole) = (folder.path().join("cut"), folder.path().join("whole"));
    let scene = scene("fig6-head-on-dx1");
    let film = [
        "flow", &scene, "--method", "exact", "--every", "0.1", "--grid", "200",
    ];
    let mut child = start(&cut, &film);
    let began = Instant::now();
    while !cut.join("flow-0003.svg").exists() {
        assert!(child.try_wait().unwrap().is_none() && began.elapsed() < Duration::from_secs(300));
        std::thread::sleep(Duration::from_millis(1));
    }
    let id = child.id().to_string();
    assert!(
        Command::new("kill")
            .args(["-INT", &id])
            .status()
            .unwrap()
            .success()
    );
    let ended = child.wait_with_output().unwrap();
    let message = String::from_utf8(ended.stderr).unwrap();
    assert_eq!(ended.status.code(), Some(130), "{message}");
    assert!(
        message.contains("frames are left; the same command continues"),
        "{message}"
    );
    let other = squirmers(&cut, &[&film[..], &["--frame", "1"]].concat());
    assert_eq!(other.status.code(), Some(2));
    for out in [&cut, &whole] {
        assert!(squirmers(out, &film).status.success());
    }
    assert_eq!(files(&cut), files(&whole));
    for name in files(&cut) {
        assert!(
            std::fs::read(cut.join(&name)).unwrap() == std::fs::read(whole.join(&name)).unwrap(),
            "{name}"
        );
    }
}

#[test]
fn runs_write_no_flow() {
    let folder = tempfile::tempdir().unwrap();
    let output = squirmers(folder.path(), &["run", &scene("fig6-head-on-dx1")]);
    assert!(output.status.success());
    assert_eq!(files(folder.path()), ["run.csv", "run.json", "run.svg"]);
}
