//! Models from outside: `--method NAME=FILE` and `--method NAME=exec:COMMAND`.

use super::*;

/// A file of exact loads at so many gaps from 1e-3 to 20 that cubics between them are good to 1e-4.
fn exact_loads(folder: &Path) -> String {
    let gaps = ["loads", "--gap", "1e-3:20:log:50", "--method", "exact"];
    let output = squirmers(folder, &gaps);
    assert!(output.status.success(), "{output:?}");
    folder.join("loads.csv").to_str().unwrap().to_owned()
}

#[test]
fn val_a_model_from_a_file_of_exact_loads_collides_as_the_exact_one() {
    let folder = tempfile::tempdir().unwrap();
    let methods = format!("exact,theirs={}", exact_loads(folder.path()));
    for (command, columns) in [
        ("head-on --dx 1,2 --departure 12", [4, 5]),
        ("offset --dz 0.3 --departure 12", [5, 6]),
        (
            "sweep right-angles --vary dx=1,3 --vary dz=0,0.2 --departure 12 --tol 1e-9",
            [3, 4],
        ),
    ] {
        let out = folder.path().join("out");
        let mut arguments: Vec<_> = command.split(' ').collect();
        arguments.extend(["--method", &methods]);
        let output = squirmers(&out, &arguments);
        assert!(output.status.success(), "{command}: {output:?}");
        let file = format!("{}.csv", arguments[0]);
        let text = std::fs::read_to_string(out.join(&file)).unwrap();
        let rows = rows(&out.join(&file));
        let of = |name: &str| -> Vec<[f64; 2]> {
            let mine = rows
                .iter()
                .filter(|row| row.iter().any(|field| field == name));
            mine.map(|row| columns.map(|column| row[column].parse().unwrap()))
                .collect()
        };
        let (theirs, exact) = (of("theirs"), of("exact"));
        assert!(!theirs.is_empty() && theirs.len() == exact.len(), "{text}");
        for (theirs, exact) in theirs.iter().zip(&exact) {
            for k in [0, 1] {
                // Offsets of strong pullers at right angles are chaotic enough to multiply errors of loads.
                let apart = (theirs[k] - exact[k]).abs();
                assert!(apart < 1e-2, "{command}: {theirs:?} and {exact:?}");
            }
        }
    }
}

#[test]
fn models_that_are_no_files_of_loads_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let file = exact_loads(folder.path());
    let head_on = |method: &str, named: &str| refused(&["head-on", "--method", method], named);
    head_on("theirs=nowhere.csv", "'nowhere.csv'");
    head_on(&format!("exact={file}"), "'exact'");
    head_on(&format!("a model={file}"), "'a model'");
    head_on(&format!("theirs={file},theirs={file}"), "'theirs'");
    // Angles are read at infinity, where a file has no loads.
    head_on(&format!("theirs={file}"), "up to 22");
    let torn = folder.path().join("torn.csv");
    std::fs::write(&torn, "gap,name,value\n0.1,X11A,much\n").unwrap();
    head_on(&format!("theirs={}", torn.to_str().unwrap()), "much");
}

#[test]
fn a_load_that_a_scene_reads_and_a_file_lacks_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string(exact_loads(folder.path())).unwrap();
    let kept: String = (text.lines())
        .filter(|line| !line.contains(",YT"))
        .map(|line| format!("{line}\n"))
        .collect();
    let part = folder.path().join("part.csv");
    std::fs::write(&part, kept).unwrap();
    let method = format!("theirs={}", part.to_str().unwrap());
    let run = |dx: &str| {
        let arguments = [
            "head-on",
            "--dx",
            dx,
            "--departure",
            "12",
            "--method",
            &method,
        ];
        squirmers(&folder.path().join("out"), &arguments)
    };
    // Squirmers that face each other exactly read axial loads alone.
    assert!(run("0").status.success());
    // All others are refused before anything runs.
    let output = run("0,1");
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert_eq!(message.trim().lines().count(), 1, "{message}");
    assert!(
        message.contains("YT1_1") && message.contains("'theirs'"),
        "{message}"
    );
}

/// A process that answers with lone spheres and writes its number to a file first. `sh` and its parameters have no comma, as a list of methods needs it.
#[cfg(unix)]
struct OfShell {
    folder: tempfile::TempDir,
}

#[cfg(unix)]
impl OfShell {
    /// With what it does before it answers for a pair.
    fn new(before: &str) -> Self {
        let text = format!(
            "echo $$ > \"$1\"; trap '' TERM INT HUP
            read -r line; echo '{{\"header\":{{\"range\":[0.001,1000]}}}}'
            while read -r line; do
                gap=${{line##*:}}; gap=${{gap%\\}}}}; {before}
                echo \"{{\\\"gap\\\":$gap,\\\"values\\\":{{\\\"X11A\\\":1,\\\"X12A\\\":0,\\\"XF1_1\\\":4,\\\"XF2_1\\\":0,\
\\\"XF1_2\\\":0,\\\"XF2_2\\\":0}}}}\"
            done
            while true; do sleep 600; done\n"
        );
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("model.sh"), text).unwrap();
        Self { folder }
    }

    fn method(&self) -> String {
        let [script, id] = ["model.sh", "id"].map(|name| self.folder.path().join(name));
        format!("theirs=exec:sh {} {}", script.display(), id.display())
    }

    /// Whether it runs; `None` before it has begun. Of a process that has ended nothing is left once somebody has waited for it.
    fn runs(&self) -> Option<bool> {
        let id = std::fs::read_to_string(self.folder.path().join("id")).ok()?;
        let id = id.strip_suffix('\n')?;
        let test = format!("kill -0 {id} 2>/dev/null");
        Some(
            Command::new("sh")
                .args(["-c", &test])
                .status()
                .unwrap()
                .success(),
        )
    }
}

#[cfg(unix)]
#[test]
fn no_process_outlives_a_command_however_it_ends() {
    let model = OfShell::new("");
    let method = model.method();
    let out = model.folder.path().join("out");
    let head_on = ["head-on", "--dx", "0", "--departure", "12", "--method"];
    let output = squirmers(&out, &[&head_on[..], &[&method]].concat());
    assert!(output.status.success(), "{output:?}");
    assert_eq!(model.runs(), Some(false));
    let rows = rows(&out.join("head-on.csv"));
    assert!(
        rows.iter()
            .any(|row| row.iter().any(|field| field == "theirs"))
    );
    // Refused for something else, after the process has begun.
    let model = OfShell::new("");
    let methods = format!("{},other=nowhere.csv", model.method());
    refused(&["head-on", "--method", &methods], "'nowhere.csv'");
    assert_eq!(model.runs(), Some(false));
    // Refused because the process has no answer.
    let model = OfShell::new("echo Oh! >&2; exit 3");
    refused(&[&head_on[..], &[&model.method()]].concat(), "Oh!");
    assert_eq!(model.runs(), Some(false));
}

#[cfg(unix)]
#[test]
fn an_interrupt_ends_a_process_that_has_not_answered_and_is_no_failure_of_it() {
    let model = OfShell::new("sleep 600");
    let mut child = Command::new(env!("CARGO_BIN_EXE_squirmers"))
        .args(["head-on", "--dx", "0", "--departure", "12", "--method"])
        .arg(model.method())
        .arg("--out")
        .arg(model.folder.path())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    while model.runs().is_none() {
        assert!(child.try_wait().unwrap().is_none(), "it ended too early");
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    let id = child.id().to_string();
    let sent = Command::new("kill").args(["-INT", &id]).status().unwrap();
    assert!(sent.success());
    let output = child.wait_with_output().unwrap();
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(130), "{message}");
    assert_eq!(message.trim(), "interrupted");
    assert_eq!(model.runs(), Some(false));
}
