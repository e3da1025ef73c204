//! Processes at once: they share a cache, and one at a time writes into a folder that it goes on from.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

mod start;

use start::start;
use std::path::{Path, PathBuf};
use std::process::Output;
use std::time::Duration;

/// Names and bytes of the files in a folder and in the folders within it, in the order of their names.
fn contents(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let mut all = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(at) = folders.pop() {
        for path in (std::fs::read_dir(at).unwrap()).map(|entry| entry.unwrap().path()) {
            if path.is_dir() {
                folders.push(path);
            } else {
                let name = path.strip_prefix(folder).unwrap().to_owned();
                all.push((name, std::fs::read(path).unwrap()));
            }
        }
    }
    all.sort();
    all
}

/// The command was refused, because another one writes into its folder, in one line.
fn was_refused(output: &Output) -> bool {
    let message = String::from_utf8_lossy(&output.stderr);
    output.status.code() == Some(2)
        && message.trim().lines().count() == 1
        && message.contains("another run writes")
}

#[test]
fn commands_that_write_whole_files_share_cache_and_output_folder() {
    let start = |folder: &Path| {
        let cache = folder.join("cache");
        let loads = [
            "loads", "--gap", "0.1", "--method", "lt,exact", "--modes", "1", "--cache",
        ];
        start(folder, &[&loads[..], &[cache.to_str().unwrap()]].concat())
    };
    let (alone, shared) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    assert!(start(alone.path()).wait().unwrap().success());
    let started = [(); 3].map(|()| start(shared.path()));
    for child in started {
        let output = child.wait_with_output().unwrap();
        assert!(output.status.success(), "{output:?}");
    }
    let expected = contents(alone.path());
    assert!(!expected.is_empty());
    assert!(contents(shared.path()) == expected, "{shared:?}");
}

/// A map of 60 lines that takes long enough for another command to come meanwhile.
fn map(beta: &str) -> [&str; 11] {
    [
        "scatter",
        "--beta",
        beta,
        "--grid",
        "60",
        "--method",
        "lt",
        "--tol",
        "1e-11",
        "--threads",
        "2",
    ]
}

fn lines(out: &Path) -> usize {
    let text = std::fs::read_to_string(out.join("scatter.csv")).unwrap();
    text.lines().count()
}

#[test]
fn of_maps_that_start_at_once_in_one_folder_one_is_done_and_the_other_refused_or_done() {
    for second in ["5", "-5"] {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path();
        let both = ["5", second]
            .map(|beta| start(out, &map(beta)))
            .map(|child| child.wait_with_output().unwrap());
        assert!(both.iter().any(|output| output.status.success()));
        for output in both {
            assert!(
                output.status.success() || was_refused(&output),
                "{output:?}"
            );
        }
        assert_eq!(lines(out), 1 + 60 * 60);
    }
}

#[test]
fn a_map_in_a_folder_that_another_one_writes_into_is_refused_and_the_other_one_loses_nothing() {
    for second in ["5", "-5"] {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path();
        let mut first = start(out, &map("5"));
        let part = || std::fs::read_to_string(out.join("scatter.csv.part")).unwrap_or_default();
        while !part().contains("\ndone ") {
            assert!(first.try_wait().unwrap().is_none(), "it ended too early");
            std::thread::sleep(Duration::from_millis(1));
        }
        let refused = start(out, &map(second)).wait_with_output().unwrap();
        assert!(was_refused(&refused), "{refused:?}");
        let first = first.wait_with_output().unwrap();
        assert!(first.status.success(), "{first:?}");
        assert_eq!(lines(out), 1 + 60 * 60);
    }
}

#[test]
fn of_runs_that_start_at_once_in_one_folder_each_is_done_or_refused_before_it_begins() {
    let folder = tempfile::tempdir().unwrap();
    let scene = |name: &str| {
        let fixtures = Path::new(env!("CARGO_MANIFEST_DIR")).join("../fixtures/scenes");
        fixtures.join(name).to_str().unwrap().to_owned()
    };
    let [one, two] = ["fig6-head-on-dx1.toml", "fig6-head-on-dx2.toml"].map(scene);
    let outputs = [&one, &two, &one]
        .map(|scene| start(folder.path(), &["run", scene]))
        .map(|child| child.wait_with_output().unwrap());
    assert!(outputs.iter().any(|output| output.status.success()));
    for output in outputs {
        assert!(
            output.status.success() || was_refused(&output),
            "{output:?}"
        );
    }
    let names: Vec<_> = (contents(folder.path()).into_iter())
        .map(|(name, _)| name)
        .collect();
    assert_eq!(names, ["run.csv", "run.json", "run.svg"].map(PathBuf::from));
}
