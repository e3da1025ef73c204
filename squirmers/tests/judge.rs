//! `squirmers judge`: what it says, what it writes, and that bad input costs one line.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

mod program;

use std::path::{Path, PathBuf};

use program::squirmers;

fn peer(name: &str) -> String {
    concat!(env!("CARGO_MANIFEST_DIR"), "/../fixtures/peers/").to_owned() + name
}

/// A file of exact loads as `squirmers loads` writes it.
fn exact_loads(folder: &Path, gaps: &str) -> PathBuf {
    let output = squirmers(folder, &["loads", "--gap", gaps, "--method", "exact"]);
    assert!(output.status.success(), "{output:?}");
    folder.join("loads.csv")
}

#[test]
fn exact_loads_are_judged_faultless_and_broken_ones_are_told_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let file = exact_loads(folder.path(), "1e-3:38:log:50");
    let text = std::fs::read_to_string(&file).unwrap();
    let broken: String = (text.lines())
        .map(|line| line.replace(",Y11B,-", ",Y11B,") + "\n")
        .collect();
    let torn = folder.path().join("broken.csv");
    std::fs::write(&torn, broken).unwrap();
    let arguments = [
        "judge",
        &format!("copy={}", file.display()),
        &format!("broken={}", torn.display()),
        "--grid",
        "4",
    ];
    let output = squirmers(folder.path(), &arguments);
    assert!(output.status.success(), "{output:?}");
    let said = String::from_utf8(output.stdout)
        .unwrap()
        .replace("\n  ", " ");
    assert!(
        said.lines()
            .all(|line| !line.is_empty() || !line.contains("NaN")),
        "{said}"
    );
    let (copy, broken) = said.split_once("\nbroken is").unwrap();
    assert!(
        copy.starts_with("copy is within 1 % at all its gaps, down to 0.001."),
        "{copy}"
    );
    assert!(copy.contains("No fault found in what it gives"), "{copy}");
    // Read by cubics, its collisions are the exact ones.
    assert!(copy.contains("deflections are off by up to 0.00"), "{copy}");
    assert!(copy.contains("all outcomes are right"), "{copy}");
    assert!(copy.contains("missing: none; of its own: none"), "{copy}");
    assert!(
        broken.contains("Fault (wrong sign): Y11B would fit with the other sign."),
        "{broken}"
    );
    let csv = std::fs::read_to_string(folder.path().join("judge.csv")).unwrap();
    assert!(csv.starts_with("model,measure,case,value,unit\n"), "{csv}");
    assert!(csv.contains("broken,fault,wrong sign: Y11B,-1.0,-\n"));
    assert!(csv.contains("\ncopy,deflection_error_deg,\"opposed, beta 5, dx 1\","));
    assert!(!csv.contains("copy,fault,"));
    let page = std::fs::read_to_string(folder.path().join("judge.html")).unwrap();
    assert!(page.contains("Y11B would fit with the other sign"));
    // Self-contained.
    for outside in ["src=\"http", "href=\"http", "rel=\"stylesheet\""] {
        assert!(!page.contains(outside), "{outside}");
    }
    assert!(folder.path().join("judge.svg").exists());
}

#[test]
fn the_page_shows_a_verdict_as_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let model = format!("pystokes={}", peer("pystokes.csv"));
    let output = squirmers(folder.path(), &["judge", &model, "--grid", "0"]);
    let said = String::from_utf8(output.stdout).unwrap();
    let page = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/JUDGE.md");
    let page = std::fs::read_to_string(page).unwrap();
    let shown = page.split_once("```text\npystokes").unwrap().1;
    let shown = format!("pystokes{}", shown.split("```").next().unwrap());
    assert!(
        shown.lines().count() > 5 && said.starts_with(&shown),
        "{said}\n{shown}"
    );
}

#[test]
fn the_same_is_said_as_json() {
    let folder = tempfile::tempdir().unwrap();
    let models = format!("jfsd={}", peer("jfsd-matrix.csv"));
    let output = squirmers(folder.path(), &["judge", &models, "--json"]);
    assert!(output.status.success(), "{output:?}");
    let all: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let card = &all[0];
    assert_eq!(card["model"], "jfsd");
    assert_eq!(card["header"]["version"], "0.2.2");
    assert_eq!(card["faultless"], false);
    let verdict: Vec<&str> = card["verdict"]
        .as_array()
        .unwrap()
        .iter()
        .map(|line| line.as_str().unwrap())
        .collect();
    // Its two spheres are not alike, which ten scalars do not show.
    assert!(
        verdict
            .iter()
            .any(|line| line.starts_with("Law broken (equal spheres)")),
        "{verdict:?}"
    );
    assert!(
        !verdict.iter().any(|line| line.contains("reciprocity")),
        "{verdict:?}"
    );
    let rows = card["rows"].as_array().unwrap();
    assert!(rows.iter().any(|row| {
        row["measure"] == "law"
            && row["case"]
                .as_str()
                .unwrap()
                .starts_with("equal spheres of the matrix")
    }));
    assert!(
        card["faults"]
            .as_array()
            .unwrap()
            .iter()
            .any(|fault| fault["kind"] == "wrong sign at some gaps" && fault["items"][0] == "y11b")
    );
}

#[cfg(unix)]
#[test]
fn a_process_that_reads_the_exact_loads_is_judged_as_they_are() {
    let folder = tempfile::tempdir().unwrap();
    let gaps =
        "0.001,0.002,0.005,0.01,0.02,0.03,0.05,0.07,0.1,0.15,0.2,0.3,0.5,0.7,1,1.5,2,4,10,38";
    let file = exact_loads(folder.path(), gaps);
    // For each question the line that was prepared for its gap.
    let csv = std::fs::read_to_string(&file).unwrap();
    let mut answers: Vec<(f64, String)> = Vec::new();
    for line in csv.lines().skip(1) {
        let fields: Vec<&str> = line.split(',').collect();
        let (gap, pair) = (
            fields[1].parse().unwrap(),
            format!("\"{}\":{}", fields[2], fields[3]),
        );
        match answers
            .iter_mut()
            .find(|(other, _)| f64::total_cmp(other, &gap).is_eq())
        {
            Some((_, values)) => *values += &format!(",{pair}"),
            None => answers.push((gap, pair)),
        }
    }
    let mut script = "read line\nprintf '{\"header\":{\"model\":\"sh\",\"range\":[0.001,38]}}\\n'\nwhile read line; do\ncase $line in\n".to_owned();
    for (gap, values) in answers {
        script +=
            &format!("*:{gap:?}}}*) printf '{{\"gap\":{gap:?},\"values\":{{{values}}}}}\\n';;\n");
    }
    script += "esac\ndone\n";
    let path = folder.path().join("model.sh");
    std::fs::write(&path, script).unwrap();
    let model = format!("sh=exec:sh {}", path.display());
    let output = squirmers(
        folder.path(),
        &["judge", &model, "--grid", "0", "--answer-limit", "20"],
    );
    assert!(output.status.success(), "{output:?}");
    let said = String::from_utf8(output.stdout).unwrap();
    assert!(
        said.starts_with("sh is within 1 % at all its gaps, down to 0.001."),
        "{said}"
    );
    assert!(said.contains("No fault found"), "{said}");
    let csv = std::fs::read_to_string(folder.path().join("judge.csv")).unwrap();
    assert!(csv.contains("sh,seconds_per_gap,"));
}

#[cfg(unix)]
#[test]
fn gaps_without_an_answer_are_left_out_and_said() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("model.sh");
    let script = "read line\nprintf '{\"header\":{\"range\":[0.05,998]}}\\n'\nwhile read line; do\ncase $line in\n\
                  *:38.0}*) printf '{\"gap\":38.0,\"values\":{\"x12a\":0.0375}}\\n';;\n\
                  *) gap=${line##*:}; printf '{\"gap\":%s,\"error\":\"too close\"}\\n' ${gap%\\}};;\nesac\ndone\n";
    std::fs::write(&path, script).unwrap();
    let model = format!("sh=exec:sh {}", path.display());
    let output = squirmers(folder.path(), &["judge", &model, "--grid", "0"]);
    assert!(output.status.success(), "{output:?}");
    let said = String::from_utf8(output.stdout)
        .unwrap()
        .replace("\n  ", " ");
    assert!(
        said.contains(
            "It has no answer at 15 of the gaps that it was asked for, first at 0.05: too close."
        ),
        "{said}"
    );
    assert!(
        said.contains("sh is within 1 % at all its gaps, down to 38."),
        "{said}"
    );
}

#[test]
fn bad_input_costs_one_line_and_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let pystokes = peer("pystokes.csv");
    let good = format!("a={pystokes}");
    let taken = format!("exact={pystokes}");
    for (arguments, named) in [
        (vec!["judge", "a"], "NAME=FILE"),
        (vec!["judge", "a=nowhere.csv"], "nowhere.csv"),
        (vec!["judge", &good, &good], "twice"),
        (vec!["judge", &taken], "exact"),
        (vec!["judge", &good, "--grid", "1"], "--grid"),
        (
            vec!["judge", &good, "--answer-limit", "0"],
            "--answer-limit",
        ),
        (vec!["judge", &format!("={pystokes}")], "letters"),
        (
            vec!["judge", &format!("lt={pystokes}"), "--grid", "0"],
            "already",
        ),
        (vec!["judge", "a=exec:"], "give a program"),
        (
            vec!["judge", "a=exec:no-such-program-anywhere"],
            "no-such-program-anywhere",
        ),
    ] {
        let out = folder.path().join("out");
        let output = squirmers(&out, &arguments);
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
        assert_eq!(message.trim().lines().count(), 1, "{message}");
        assert!(message.contains(named), "{message}");
        assert!(!out.join("judge.csv").exists());
    }
}
