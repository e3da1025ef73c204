//! Whatever a process does, an answer or one clear line comes back in time.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use approx::assert_relative_eq;
use tempfile::TempDir;

use scene::{Gap, Hydrodynamics, LoadSet};

use super::*;
use crate::submission::Quantity;

/// Enough for a shell on a busy machine.
const LONG: Duration = Duration::from_secs(20);

const SHORT: Duration = Duration::from_millis(200);

/// Longest time for a refusal: the short limit, twice the patience, and a busy machine.
const SOON: Duration = Duration::from_secs(10);

/// Reads the question for the header and answers it.
const HEADER: &str =
    "read -r line; echo '{\"header\":{\"model\":\"mine\",\"range\":[0.01,100]}}'\n";

/// A script in a folder of its own.
struct Script {
    folder: TempDir,
}

impl Script {
    fn new(text: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("model.sh"), text).unwrap();
        Self { folder }
    }

    /// The header, and one line of the script for each question, with the gap as `$gap`.
    fn answering(header: &str, each: &str) -> Self {
        let read = "gap=${line##*:}; gap=${gap%\\}}";
        Self::new(&format!(
            "{header}while read -r line; do {read}; {each}\ndone\n"
        ))
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn command(&self) -> String {
        let path = self.path("model.sh");
        format!("sh '{}' '{}'", path.display(), self.folder.path().display())
    }

    fn start(&self, limit: Duration) -> Result<Asked, SubmissionError> {
        Process::start(&self.command(), limit)
    }

    fn begin(&self) -> (Process, Header) {
        Process::begin(&self.command(), LONG).unwrap()
    }

    /// The number that the script wrote to a file.
    fn number(&self, name: &str) -> String {
        let path = self.path(name);
        wait(|| fs::read_to_string(&path).is_ok_and(|text| text.ends_with('\n')));
        fs::read_to_string(path).unwrap().trim().to_owned()
    }
}

fn wait(is_so: impl Fn() -> bool) {
    let until = Instant::now() + LONG;
    while !is_so() {
        assert!(Instant::now() < until, "waited in vain");
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// Whether the process of this number runs. One that has ended and that nobody has waited for is a zombie, which does not.
fn runs(id: &str) -> bool {
    if id.is_empty() {
        return false;
    }
    let stat = fs::read_to_string(Path::new("/proc").join(id).join("stat"));
    match stat {
        Ok(stat) => !stat.contains(") Z "),
        Err(_) => {
            let kill = format!("kill -0 {id} 2>/dev/null");
            !Path::new("/proc/self/stat").exists()
                && Command::new("sh")
                    .args(["-c", &kill])
                    .status()
                    .unwrap()
                    .success()
        }
    }
}

fn gap(eps: f64) -> Gap {
    Gap::new(eps).unwrap()
}

fn one_line(error: &SubmissionError, message: &str) {
    let text = error.to_string();
    assert!(text.contains(message), "{text}\n{message}");
    assert!(text.starts_with("process '"), "{text}");
    assert!(
        text.len() < 400 && !text.contains(char::is_control),
        "{text}"
    );
}

/// The script, once it has read the question for its header, is refused.
fn refused_at_once(text: &str, limit: Duration, message: &str) {
    let started = Instant::now();
    let script = Script::new(&format!("read -r line; {text}"));
    one_line(&script.start(limit).unwrap_err(), message);
    assert!(started.elapsed() < SOON, "{:?}", started.elapsed());
}

/// The script, whose header is good, is refused at the first question for a pair, and at the second one for the same reason at once.
fn refused_at_a_gap(first: &str, each: &str, limit: Duration, message: &str) {
    let script = Script::answering(first, each);
    let (process, header) = script.begin();
    let process = Asked::new(Arc::new(Process { limit, ..process }), header).unwrap();
    let started = Instant::now();
    let error = process.answer(gap(1.0)).unwrap_err();
    one_line(&error, message);
    assert!(started.elapsed() < SOON, "{:?}", started.elapsed());
    let started = Instant::now();
    let again = process.answer(gap(2.0)).unwrap_err();
    assert_eq!(again.to_string(), error.to_string());
    assert!(started.elapsed() < SHORT, "{:?}", started.elapsed());
}

#[test]
fn commands_that_are_none_are_refused() {
    let refused = |command: &str, message: &str| {
        one_line(&Process::start(command, LONG).unwrap_err(), message);
    };
    refused(
        "/nowhere/at-all --fast",
        "it cannot be started: No such file",
    );
    // It may end before it is asked.
    refused("sh -c 'exit 3'", "(exit status: 3)");
    refused("", "give a program and its arguments");
    refused("sh -c 'exit", "with closed quotes");
    refused(&"x\u{1b}\n".repeat(1000), "it cannot be started");
}

#[test]
fn whoever_does_not_give_a_header_is_refused_in_one_line() {
    refused_at_once(
        "exit 3",
        LONG,
        "it ended without an answer (exit status: 3)",
    );
    refused_at_once(
        "echo one >&2; printf 'ValueError: no \\033 such table\\n\\n' >&2; exit 1",
        LONG,
        "(exit status: 1); it said: ValueError: no \\u{1b} such table",
    );
    refused_at_once("kill -9 $$", LONG, "(signal: 9");
    refused_at_once("sleep 60", SHORT, "it did not answer within 0.2 s");
    refused_at_once(
        "exec 0<&-; sleep 60",
        SHORT,
        "it did not answer within 0.2 s",
    );
    refused_at_once("exec >&-; sleep 60", SHORT, "it ended without an answer");
    refused_at_once("yes", LONG, "its answer 'y' is not as it should be");
    refused_at_once(
        "yes | tr -d '\\n'",
        LONG,
        "its answer has no end: a line has at most 1048576 bytes",
    );
    refused_at_once(
        "printf '{\"header\":'; exit 0",
        LONG,
        "its answer breaks off in the middle of a line (exit status: 0)",
    );
    refused_at_once(
        "printf '\\377\\000\\033\\n'; sleep 60",
        LONG,
        "is not as it should be",
    );
    refused_at_once("echo Hello; sleep 60", LONG, "its answer 'Hello' is not as");
}

#[test]
fn headers_that_are_not_allowed_are_refused_in_one_line() {
    for (header, message) in [
        ("{\"header\":{}}", "its header has no range"),
        (
            "{\"header\":{\"modle\":\"mine\",\"range\":[1,2]}}",
            "unknown field `modle`, expected one of",
        ),
        ("{\"head\":{}}", "unknown field `head`"),
        (
            "{\"header\":{\"range\":[2,1]}}",
            "header: range [2.0, 1.0] is not allowed",
        ),
        (
            "{\"header\":{\"range\":[1,2],\"radius\":1e-310}}",
            "its range in radii is not of two different finite gaps",
        ),
        (
            "{\"header\":{\"range\":[1,2],\"matrix\":\"grand\"}}",
            "unknown variant `grand`",
        ),
    ] {
        refused_at_once(&format!("echo '{header}'; sleep 60"), LONG, message);
    }
    let long = "x".repeat(100_000);
    refused_at_once(
        &format!("echo '{{\"header\":{{\"{long}\":1}}}}'; sleep 60"),
        LONG,
        "unknown field `xxx",
    );
}

#[test]
fn answers_that_are_none_are_refused_in_one_line_and_end_the_conversation() {
    for (each, message) in [
        (
            "echo \"{\\\"gap\\\":$gap,\\\"values\\\":{\\\"x11a\\\":NaN}}\"",
            "is not as it should be: expected value",
        ),
        (
            "echo \"{\\\"gap\\\":$gap,\\\"values\\\":{\\\"x11a\\\":1e999}}\"",
            "number out of range",
        ),
        (
            "echo $gap 1.0 0.5",
            "its answer '1.0 1.0 0.5' is not as it should be",
        ),
        (
            "echo '{\"gap\":2.0,\"values\":{}}'",
            "it answers for the gap 2.0, and was asked for 1.0",
        ),
        ("echo '{\"gap\":null}'", "is not as it should be"),
        (
            "echo \"{\\\"gap\\\":$gap,\\\"values\\\":{\\\"X13A\\\":1}}\"",
            "there is no quantity 'X13A': names are",
        ),
        (
            "echo \"{\\\"gap\\\":$gap,\\\"value\\\":{\\\"X11A\\\":1}}\"",
            "unknown field `value`",
        ),
        (
            "echo \"{\\\"gap\\\":$gap,\\\"matrix\\\":[[1]]}\"",
            "its header does not say what 'matrix' is",
        ),
        (
            "echo \"{\\\"gap\\\":$gap,\\\"slip\\\":{\\\"B1_1z\\\":[]}}\"",
            "and there is no matrix",
        ),
        ("exit 7", "it ended without an answer (exit status: 7)"),
        (
            "echo 'out of memory' >&2; exit 7",
            "(exit status: 7); it said: out of memory",
        ),
        (
            "printf '{\"gap\":'; exit 0",
            "its answer breaks off in the middle of a line",
        ),
        (
            "yes | tr -d '\\n'",
            "its answer has no end: a line has at most 1048576 bytes",
        ),
    ] {
        refused_at_a_gap(HEADER, each, LONG, message);
    }
    for each in [
        "sleep 60",
        "printf '{\"gap\":1'; sleep 60",
        // Ended by nobody but us.
        "trap '' TERM INT HUP; sleep 60",
    ] {
        refused_at_a_gap(HEADER, each, SHORT, "it did not answer within 0.2 s");
    }
}

#[test]
fn matrices_that_are_none_are_refused_in_one_line() {
    let header = HEADER.replace("\"range\"", "\"matrix\":\"mobility\",\"range\"");
    let row = format!("[{}1]", "1,".repeat(11));
    let rows = |count: usize| format!("[{}]", vec![row.as_str(); count].join(","));
    let with = |parts: &str| {
        let parts = parts.replace('"', "\\\"");
        format!("echo \"{{\\\"gap\\\":$gap,{parts}}}\"")
    };
    for (parts, message) in [
        (
            format!("\"matrix\":{}", rows(11)),
            "a matrix has 12 rows of 12 numbers, and this one has not",
        ),
        (
            format!("\"matrix\":{}", rows(12).replacen("1,", "", 1)),
            "a matrix has 12 rows of 12 numbers, and this one has not",
        ),
        (
            format!("\"matrix\":{},\"values\":{{\"x11a\":1}}", rows(12)),
            "named values and a matrix: give one of them",
        ),
        (
            format!("\"matrix\":{},\"slip\":{{\"B9_1z\":{row}}}", rows(12)),
            "slip column 'B9_1z' is not allowed",
        ),
        (
            format!("\"matrix\":{},\"slip\":{{\"B1_1z\":[1]}}", rows(12)),
            "slip column 'B1_1z' is not allowed: give 12 numbers",
        ),
        (
            "\"values\":{\"x11a\":1}".to_owned(),
            "a header has 'matrix', and there is no matrix",
        ),
    ] {
        refused_at_a_gap(&header, &with(&parts), LONG, message);
    }
}

#[test]
fn lines_that_nobody_asked_for_are_told() {
    let each = "echo \"{\\\"gap\\\":$gap}\"; echo one; echo two; echo three > \"$1/said\"";
    let script = Script::answering(HEADER, each);
    let process = script.start(LONG).unwrap();
    assert!(process.answer(gap(1.0)).is_ok());
    assert_eq!(script.number("said"), "three");
    // The line may still be on its way from the pipe to us.
    let error = process.answer(gap(2.0)).unwrap_err().to_string();
    assert!(
        error.contains("it says 'one' without being asked")
            || error.contains("its answer 'one' is not as it should be"),
        "{error}"
    );
}

#[test]
fn a_process_that_ends_between_two_questions_is_told() {
    let script = Script::answering(HEADER, "echo \"{\\\"gap\\\":$gap}\"; exit 5");
    let (source, header) = script.begin();
    let source = Arc::new(source);
    let process = Asked::new(source.clone(), header).unwrap();
    assert!(process.answer(gap(1.0)).is_ok());
    wait(|| {
        locked(&locked(&source.talk).running)
            .status_within(Duration::ZERO)
            .is_some()
    });
    let error = process.answer(gap(2.0)).unwrap_err();
    one_line(&error, "(exit status: 5)");
    let again = process.answer(gap(2.0)).unwrap_err();
    assert_eq!(again.to_string(), error.to_string());
    // What it said stands.
    assert!(process.answer(gap(1.0)).is_ok());
}

#[test]
fn a_process_that_answers_without_reading_is_told() {
    // Nobody guesses the questions but this one, who is asked for 1, 2, 3, ...
    let answers = "k=1; while [ $k -le 9000 ]; do echo \"{\\\"gap\\\":$k}\"; k=$((k + 1)); done";
    let script = Script::new(&format!(
        "read -r line; echo '{{\"header\":{{\"range\":[0.5,10000]}}}}'; sleep 0.3; {answers}; sleep 60"
    ));
    let process = script.start(LONG).unwrap();
    let started = Instant::now();
    let error = (1..9000).find_map(|k| process.answer(gap(f64::from(k))).err());
    let error = error.unwrap().to_string();
    assert!(
        error.contains("does not read its questions") || error.contains("without being asked"),
        "{error}"
    );
    assert!(started.elapsed() < LONG, "{:?}", started.elapsed());
}

#[test]
fn a_gap_without_an_answer_is_refused_with_the_reason_and_the_rest_goes_on() {
    let each = "case $gap in 1.0) printf '%s\\n' '{\"gap\":1.0,\"error\":\"does not\\nconverge\"}';; \
                *) echo \"{\\\"gap\\\":$gap,\\\"values\\\":{\\\"x11a\\\":0.5}}\";; esac";
    let script = Script::answering(HEADER, each);
    let process = script.start(LONG).unwrap();
    let error = process.answer(gap(1.0)).unwrap_err();
    one_line(
        &error,
        "it has no answer at the gap 1.0: does not\\nconverge",
    );
    assert!(process.answer(gap(2.0)).is_ok());
}

/// A process whose answer is a far field at r = 2 + gap = 4, whatever the gap.
fn far_field(header: &str) -> Script {
    let values = "\\\"X11A\\\":2.0,\\\"X12A\\\":-0.5,\\\"XF1_1\\\":4.0,\\\"XF2_1\\\":-1.0";
    let each = format!(
        "echo \"$line\" >> \"$1/questions\"; echo \"{{\\\"gap\\\":$gap,\\\"values\\\":{{{values}}}}}\""
    );
    Script::answering(
        &format!("read -r line; echo '{{\"header\":{header}}}'\n"),
        &each,
    )
}

#[test]
fn values_come_back_each_asked_for_once_and_loads_calibrated() {
    let script = far_field(
        "{\"range\":[0.01,100],\"mode_units\":[2],\"slip_calibration\":[3],\"noise\":1e-3}",
    );
    let process = script.start(LONG).unwrap();
    assert_eq!(process.header().slip_calibration, [3.0]);
    let value = |gap: Gap, name: &str| {
        let answer = process.answer(gap).unwrap();
        answer.values.get(Quantity::named(name).unwrap()).unwrap()
    };
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                for eps in [0.5, 2.0, 0.1 + 0.2] {
                    assert_relative_eq!(value(gap(eps), "X11A"), 2.0);
                    // As measured, per B_1.
                    assert_relative_eq!(value(gap(eps), "XF1_1"), 2.0);
                }
            });
        }
    });
    let set = LoadSet::axial(1);
    let loads = process.loads(gap(2.0), set).unwrap();
    assert_relative_eq!(loads.xa.other(), -0.5);
    let [(_, first), ..] = &loads.named()[2..] else {
        unreachable!()
    };
    assert_relative_eq!(*first, 6.0);
    assert_relative_eq!(
        process.error_estimate(gap(2.0), set).unwrap().unwrap(),
        1e-3
    );
    assert_relative_eq!(process.description().noise, 1e-3);
    let error = process.loads(gap(2.0), LoadSet::planar(1)).unwrap_err();
    assert!(
        error.to_string().contains("its answer has no Y11A"),
        "{error}"
    );
    assert!(process.loads(gap(200.0), set).is_err());
    let asked = fs::read_to_string(script.path("questions")).unwrap();
    let mut asked: Vec<_> = asked.lines().collect();
    asked.sort_unstable();
    assert_eq!(
        asked,
        [
            "{\"ask\":\"pair\",\"gap\":0.30000000000000004}",
            "{\"ask\":\"pair\",\"gap\":0.5}",
            "{\"ask\":\"pair\",\"gap\":2.0}",
        ]
    );
}

#[test]
fn gaps_are_in_the_unit_of_the_radius_and_never_outside_the_range() {
    let (radius, smallest, largest) = (3.7e-6, 1.1e-8, 2.3e-4);
    let script = far_field(&format!(
        "{{\"radius\":{radius},\"range\":[{smallest},{largest}]}}"
    ));
    let process = script.start(LONG).unwrap();
    let range = process.range();
    for eps in [range.smallest, range.largest, 1.0] {
        process.loads(gap(eps), LoadSet::axial(1)).unwrap();
    }
    let asked = fs::read_to_string(script.path("questions")).unwrap();
    let gaps = (asked.lines()).map(|line| {
        let question: Question = serde_json::from_str(line).unwrap();
        match question {
            Question::Pair { gap } => gap,
            Question::Header => panic!("{line}"),
        }
    });
    assert_eq!(gaps.collect::<Vec<_>>(), [smallest, largest, radius]);
}

#[test]
fn a_matrix_and_its_slip_column_come_back() {
    let header = HEADER.replace("\"range\"", "\"matrix\":\"resistance\",\"range\"");
    let rows: Vec<String> = (0..12)
        .map(|row| {
            let row = (0..12).map(|column| if row == column { "1.0" } else { "0.0" });
            format!("[{}]", row.collect::<Vec<_>>().join(","))
        })
        .collect();
    let slip = "\\\"B1_1z\\\":[0,0,12.5,0,0,0,0,0,0,0,0,0]";
    let each = format!(
        "echo \"{{\\\"gap\\\":$gap,\\\"matrix\\\":[{}],\\\"slip\\\":{{{slip}}}}}\"",
        rows.join(",")
    );
    let script = Script::answering(&header, &each);
    let answer = script.start(LONG).unwrap().answer(gap(1.0)).unwrap();
    let value = |name: &str| answer.values.get(Quantity::named(name).unwrap()).unwrap();
    assert_relative_eq!(value("X11A"), 1.0 / (6.0 * std::f64::consts::PI));
    assert_relative_eq!(value("XF1_1"), 12.5 / std::f64::consts::PI);
    assert!(answer.laws.is_some());
}

#[test]
fn a_process_that_ignores_the_end_of_its_input_ends_with_all_that_it_started() {
    let after = "trap '' TERM INT HUP; sleep 600 & echo $! > \"$1/child\"; echo $$ > \"$1/id\"; \
                 while true; do sleep 600; done\n";
    let script = Script::new(&format!("{HEADER}{after}"));
    let process = script.start(LONG).unwrap();
    let ids = ["id", "child"].map(|name| script.number(name));
    assert!(ids.iter().all(|id| runs(id)));
    let started = Instant::now();
    drop(process);
    assert!(started.elapsed() < SOON, "{:?}", started.elapsed());
    wait(|| ids.iter().all(|id| !runs(id)));
    // And so does one that is refused.
    let script = Script::new(&format!("echo hello\n{after}"));
    assert!(script.start(LONG).is_err());
    let refused = script.path("id");
    wait(|| !fs::read_to_string(&refused).is_ok_and(|id| runs(id.trim())));
}

#[test]
fn a_process_ends_by_itself_once_its_input_is_closed() {
    let script = Script::answering(HEADER, "echo \"{\\\"gap\\\":$gap}\"");
    let text = fs::read_to_string(script.path("model.sh")).unwrap();
    fs::write(
        script.path("model.sh"),
        format!("{text}echo good-bye > \"$1/last\"\n"),
    )
    .unwrap();
    drop(script.start(LONG).unwrap());
    assert_eq!(script.number("last"), "good-bye");
}
