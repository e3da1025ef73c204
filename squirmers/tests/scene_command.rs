//! `squirmers run` and `squirmers explain`: what they print and write, and what they refuse.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn scene(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("../fixtures/scenes/{name}.toml"))
}

fn squirmers(command: &str, file: &Path, out: &Path, more: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_squirmers"))
        .arg(command)
        .arg(file)
        .args(more)
        .arg("--out")
        .arg(out)
        .output()
        .unwrap()
}

fn text(bytes: Vec<u8>) -> String {
    String::from_utf8(bytes).unwrap()
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

#[test]
fn a_run_writes_trajectory_picture_and_summary() {
    let folder = tempfile::tempdir().unwrap();
    let output = squirmers("run", &scene("fig6-head-on-dx1"), folder.path(), &[]);
    assert!(output.status.success());
    assert!(text(output.stdout).contains("scattered"));
    assert_eq!(files(folder.path()), ["run.csv", "run.json", "run.svg"]);
    let mut reader = csv::Reader::from_path(folder.path().join("run.csv")).unwrap();
    let header: Vec<_> = reader
        .headers()
        .unwrap()
        .iter()
        .map(str::to_owned)
        .collect();
    let expected = "t,x1,y1,z1,x2,y2,z2,px1,py1,pz1,px2,py2,pz2,angle1_deg,angle2_deg,gap";
    assert_eq!(header.join(","), expected);
    let rows: Vec<_> = reader.records().map(Result::unwrap).collect();
    let number = |row: &csv::StringRecord, column: usize| row[column].parse::<f64>().unwrap();
    assert!(
        rows.windows(2)
            .all(|pair| number(&pair[0], 0) < number(&pair[1], 0))
    );
    for row in &rows {
        let [x, y, z] = [0, 1, 2].map(|i| number(row, 4 + i) - number(row, 1 + i));
        let gap = (x * x + y * y + z * z).sqrt() - 2.0;
        assert!((gap - number(row, 15)).abs() < 1e-12);
        let azimuth = number(row, 8).atan2(number(row, 7)).to_degrees();
        assert!(((azimuth - number(row, 13)) / 360.0).fract().abs() < 1e-12);
    }
}

#[test]
fn json_is_one_object_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let output = squirmers(
        "run",
        &scene("fig6-head-on-dx2"),
        folder.path(),
        &["--json"],
    );
    assert!(output.status.success() && output.stderr.is_empty());
    let printed = text(output.stdout);
    assert_eq!(printed.lines().count(), 1);
    let summary: serde_json::Value = serde_json::from_str(&printed).unwrap();
    assert_eq!(summary["outcome"], "scattered");
    assert_eq!(summary["state"], "point-symmetric");
    assert_eq!(summary["numbers"], 3);
    let one = summary["deflection1_deg"].as_f64().unwrap();
    assert!((one + 8.483).abs() < 1e-3, "{one}");
    let written = std::fs::read_to_string(folder.path().join("run.json")).unwrap();
    assert_eq!(written.trim(), printed.trim());
}

#[test]
fn a_run_that_fails_leaves_its_finished_rows_under_a_name_that_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("short.toml");
    let start = std::fs::read_to_string(scene("fig6-head-on-dx1")).unwrap();
    std::fs::write(&file, start + "\n[run]\nmax_steps = 10\n").unwrap();
    let out = folder.path().join("out");
    let output = squirmers("run", &file, &out, &["--json"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(output.stdout.is_empty());
    assert!(text(output.stderr).contains("10 steps"));
    assert_eq!(files(&out), ["run.csv.partial"]);
    let mut reader = csv::Reader::from_path(out.join("run.csv.partial")).unwrap();
    let rows: Vec<_> = reader.records().map(Result::unwrap).collect();
    assert!(rows.len() > 10 && rows.iter().all(|row| row.len() == 16));
}

#[test]
fn a_run_that_fails_does_not_pass_files_of_another_scene_off_as_its_own() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    assert!(
        squirmers("run", &scene("fig6-head-on-dx2"), &out, &[])
            .status
            .success()
    );
    let earlier = std::fs::read_to_string(out.join("run.csv")).unwrap();
    let file = folder.path().join("short.toml");
    let start = std::fs::read_to_string(scene("fig6-head-on-dx1")).unwrap();
    std::fs::write(&file, start + "\n[run]\nmax_steps = 10\n").unwrap();
    let output = squirmers("run", &file, &out, &[]);
    assert_eq!(output.status.code(), Some(1));
    assert!(text(output.stderr).contains("run.csv.earlier"));
    let left = [
        "run.csv.earlier",
        "run.csv.partial",
        "run.json.earlier",
        "run.svg.earlier",
    ];
    assert_eq!(files(&out), left);
    let kept = std::fs::read_to_string(out.join("run.csv.earlier")).unwrap();
    assert_eq!(kept, earlier);
    assert!(
        squirmers("run", &scene("fig6-head-on-dx1"), &out, &[])
            .status
            .success()
    );
    assert_eq!(files(&out), ["run.csv", "run.json", "run.svg"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_file_without_end_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let output = squirmers("run", Path::new("/dev/zero"), folder.path(), &[]);
    let message = text(output.stderr);
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert!(
        message.contains("/dev/zero") && message.contains("1048576"),
        "{message}"
    );
}

#[test]
fn many_mistakes_are_counted_and_the_first_are_listed_within_seconds() {
    let folder = tempfile::tempdir().unwrap();
    let keys: String = (0..100_000).map(|k| format!("k{k}=1\n")).collect();
    let inline: Vec<_> = (0..80_000).map(|k| format!("k{k}=1")).collect();
    for (name, content) in [
        ("keys", keys),
        ("inline", format!("run = {{{}}}\n", inline.join(","))),
        ("equals", "=\n".repeat(500_000)),
    ] {
        let file = folder.path().join(format!("{name}.toml"));
        std::fs::write(&file, content).unwrap();
        let began = std::time::Instant::now();
        let output = squirmers("explain", &file, folder.path(), &[]);
        let seconds = began.elapsed().as_secs_f64();
        assert_eq!(output.status.code(), Some(2));
        let message = text(output.stderr);
        assert_eq!(message.trim().lines().count(), 1 + 20 + 1, "{name}");
        assert!(message.trim().ends_with("more"), "{name}");
        assert!(seconds < 10.0, "{name}: {seconds} s");
    }
}

#[test]
fn a_start_below_the_smallest_gap_of_the_model_is_a_mistake_with_its_place() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("near.toml");
    let squirmer =
        |x: f64| format!("[[squirmer]]\nposition = [{x:?}, 0.0]\norientation = 0.0\nbeta = 1.0\n");
    let near = squirmer(0.0) + &squirmer(2.0001);
    std::fs::write(&file, format!("hydrodynamics = \"bem\"\n{near}")).unwrap();
    let out = folder.path().join("out");
    for command in ["run", "explain"] {
        let output = squirmers(command, &file, &out, &[]);
        let message = text(output.stderr);
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(
            message
                .contains("7:12: squirmer[1].position: found [2.0001, 0.0]; the start is too near"),
            "{message}"
        );
        assert!(files(&out).is_empty());
    }
}

/// The most digits that a number has in some text, without its exponent.
fn most_digits(text: &str) -> usize {
    (text.split(|c: char| !(c.is_ascii_digit() || c == '.')))
        .map(|number| number.chars().filter(char::is_ascii_digit).count())
        .max()
        .unwrap_or(0)
}

#[test]
fn what_is_printed_fits_a_terminal_and_has_no_more_digits_than_a_person_reads() {
    let folder = tempfile::tempdir().unwrap();
    // One and a half times this is not what rounding makes of it.
    let rounds = folder.path().join("rounds.toml");
    let start = std::fs::read_to_string(scene("fig6-head-on-dx1")).unwrap();
    std::fs::write(&rounds, start.replace("beta = 5.0", "beta = 0.1")).unwrap();
    for file in [scene("fig6-head-on-dx1"), scene("fig8e-downward"), rounds] {
        for command in ["run", "explain"] {
            let output = squirmers(command, &file, folder.path(), &[]);
            assert!(output.status.success());
            let printed = text(output.stdout);
            let file = file.display();
            assert!(most_digits(&printed) <= 9, "{command} {file}:\n{printed}");
            let is_narrow = |line: &str| line.chars().count() <= 80;
            assert!(
                printed.lines().all(is_narrow),
                "{command} {file}:\n{printed}"
            );
        }
    }
}

#[test]
fn mistakes_are_listed_with_their_places_and_nothing_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("typo.toml");
    let right = std::fs::read_to_string(scene("fig6-head-on-dx1")).unwrap();
    let wrong = right
        .replace("beta = 5.0", "betta = 5.0")
        .replace("-0.5,", "nan,");
    std::fs::write(&file, wrong).unwrap();
    let out = folder.path().join("out");
    for command in ["run", "explain"] {
        let output = squirmers(command, &file, &out, &[]);
        assert_eq!(output.status.code(), Some(2));
        let message = text(output.stderr);
        assert_eq!(
            message.matches("did you mean 'beta'?").count(),
            2,
            "{message}"
        );
        assert!(
            message.contains("7:13: squirmer[0].position[0]: found nan"),
            "{message}"
        );
        assert!(files(&out).is_empty());
    }
    let absent = squirmers("run", Path::new("no-such.toml"), &out, &[]);
    assert_eq!(absent.status.code(), Some(2));
    assert!(text(absent.stderr).contains("cannot read 'no-such.toml'"));
}

#[test]
fn explain_prints_the_plan() {
    let folder = tempfile::tempdir().unwrap();
    let output = squirmers("explain", &scene("fig8e-downward"), folder.path(), &[]);
    assert!(output.status.success());
    let printed = text(output.stdout);
    let words = printed.split_whitespace().collect::<Vec<_>>().join(" ");
    for expected in [
        "mirror-symmetric: 3 numbers",
        "Y11A + Y12A",
        "axial mirrored, transverse mirrored",
        "a bottom-heavy squirmer swims",
        "takes 12 right-hand sides",
        "a closed form",
    ] {
        assert!(words.contains(expected), "{expected}: {printed}");
    }
    let row = |effect: &str| {
        let line = printed
            .lines()
            .find(|line| line.trim().starts_with(effect))
            .unwrap();
        line[effect.len() + 1..]
            .split_whitespace()
            .next()
            .unwrap()
            .to_owned()
    };
    assert_eq!([row("gravity"), row("third dimension")], ["yes", "no"]);
    // Nothing in it is a time: the plan of a scene prints alike whenever and wherever.
    let again = squirmers("explain", &scene("fig8e-downward"), folder.path(), &[]);
    assert_eq!(text(again.stdout), printed);
    assert!(files(folder.path()).is_empty());
}

#[test]
fn help_has_an_example() {
    for command in ["run", "explain"] {
        let output = Command::new(env!("CARGO_BIN_EXE_squirmers"))
            .args([command, "--help"])
            .output()
            .unwrap();
        let help = text(output.stdout);
        assert!(help.contains(&format!("Example:\n  squirmers {command} fixtures/scenes/")));
    }
}

#[test]
fn unlike_radii_are_explained_and_drawn_to_scale() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("unlike.toml");
    let text = "hydrodynamics = \"exact\"\nrepulsion = \"paper\"\n[[squirmer]]\nposition = [-2.0, 0.3]\norientation = 0.0\nbeta = 1.0\n\
                [[squirmer]]\nposition = [2.0, 0.0]\norientation = 170.0\nbeta = 1.0\nradius = 2.0\n[run]\nend_time = 2.0\n";
    std::fs::write(&scene, text).unwrap();
    let run = |command: &str| {
        let output = Command::new(env!("CARGO_BIN_EXE_squirmers"))
            .args([command, scene.to_str().unwrap(), "--out"])
            .arg(folder.path().join("out"))
            .output()
            .unwrap();
        assert!(output.status.success(), "{output:?}");
        let words = String::from_utf8(output.stdout).unwrap();
        words.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let explained = run("explain");
    for said in [
        "X11A; X21A;",
        "Y12B; Y12B_force",
        "read 26 mobilities",
        "radii are unlike",
    ] {
        assert!(explained.contains(said), "{said}: {explained}");
    }
    run("run");
    let svg = std::fs::read_to_string(folder.path().join("out/run.svg")).unwrap();
    assert!(svg.contains("radius 2"));
    let radii: Vec<f64> = (svg.split("<circle").skip(1))
        .filter_map(|mark| mark.split("r=\"").nth(1)?.split('"').next()?.parse().ok())
        .collect();
    // That of the legend, then start and end of the first and of the second.
    let [_, one, _, two, _] = radii[..] else {
        panic!("{radii:?}")
    };
    assert!((two / one - 2.0).abs() < 0.01, "{radii:?}");
}
