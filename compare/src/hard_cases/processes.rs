//! What only processes can meet: a full disk, being killed, each other. The program runs itself; where it is
//! not the program that runs (in tests of the library) there are no such rows.

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use super::Rows;
use super::files::temporary;
use super::machine::ALL;
use crate::CompareError;

/// Name of the program.
const PROGRAM: &str = "squirmers";

/// A command that writes one file and keeps one table.
const LOADS: &[&str] = &[
    "loads", "--gap", "0.1", "--method", "lt,exact", "--modes", "1",
];

/// A command that writes one file and needs no table.
#[cfg(target_os = "linux")]
const CLOSED: &[&str] = &["loads", "--gap", "0.1", "--method", "lt"];

/// A map that takes long enough to be killed.
const MAP: &[&str] = &[
    "scatter",
    "--beta",
    "5",
    "--grid",
    "60",
    "--method",
    "lt",
    "--tol",
    "1e-11",
    "--threads",
    "2",
];

/// Lines of the map that are done when it is killed.
const DONE: usize = 3;

/// Processes at once.
const AT_ONCE: usize = 2;

pub(super) fn processes(rows: &mut Rows) -> Result<(), CompareError> {
    let program = std::env::current_exe().ok();
    let Some(program) = program.filter(|path| path.file_stem().is_some_and(|s| s == PROGRAM))
    else {
        return Ok(());
    };
    #[cfg(target_os = "linux")]
    full_disk(&program, rows)?;
    killed(&program, rows)?;
    at_once(&program, rows)?;
    one_folder(&program, rows)
}

fn failed(path: &Path) -> impl Fn(std::io::Error) -> CompareError + '_ {
    |source| CompareError::Write {
        path: path.to_owned(),
        source,
    }
}

fn command(program: &Path, arguments: &[&str], out: &Path) -> Command {
    let mut command = Command::new(program);
    command.args(arguments).arg("--out").arg(out);
    command.arg("--cache").arg(out.join("cache"));
    command.stdout(Stdio::null()).stderr(Stdio::null());
    command
}

/// Bytes of all files in a folder and its cache, in the order of their names.
fn contents(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let mut all = Vec::new();
    for at in [folder.to_owned(), folder.join("cache")] {
        let entries = std::fs::read_dir(at).into_iter().flatten().flatten();
        for path in entries.map(|entry| entry.path()).filter(|p| p.is_file()) {
            let bytes = std::fs::read(&path).unwrap_or_default();
            let name = path.strip_prefix(folder).unwrap_or(&path).to_owned();
            all.push((name, bytes));
        }
    }
    all.sort();
    all
}

/// A limit of no bytes a file stands for a full disk: the system refuses every write.
#[cfg(target_os = "linux")]
fn full_disk(program: &Path, rows: &mut Rows) -> Result<(), CompareError> {
    let folder = temporary()?;
    let inner = command(program, CLOSED, folder.path());
    let output = Command::new("sh")
        // Without the trap the system would end the program by a signal.
        .args(["-c", "trap '' XFSZ; ulimit -f 0; exec \"$0\" \"$@\""])
        .arg(inner.get_program())
        .args(inner.get_args())
        .stdout(Stdio::null())
        .output()
        .map_err(failed(program))?;
    let message = String::from_utf8_lossy(&output.stderr);
    let clear = message.trim().lines().count() == 1 && message.contains("loads.csv");
    let wrong = !clear || output.status.code() != Some(2);
    rows.add(
        ALL,
        "full disks that are not told in one line with exit status 2",
        (0.0, "every write is checked"),
        f64::from(u8::from(wrong)),
    );
    // What is printed may go to a full disk too.
    let full = std::fs::OpenOptions::new().write(true).open("/dev/full");
    let full = full.map_err(failed(Path::new("/dev/full")))?;
    let elsewhere = temporary()?;
    let output = command(program, CLOSED, elsewhere.path())
        .stdout(full)
        .stderr(Stdio::piped())
        .output()
        .map_err(failed(program))?;
    let lines = String::from_utf8_lossy(&output.stderr)
        .trim()
        .lines()
        .count();
    rows.add(
        ALL,
        "the same of what is printed",
        (0.0, "standard output may refuse as any file"),
        f64::from(u8::from(lines != 1 || output.status.code() != Some(2))),
    );
    rows.add(
        ALL,
        "files left on a full disk",
        (0.0, "files are written aside and renamed"),
        contents(folder.path()).len() as f64,
    );
    Ok(())
}

/// Lines of a map that its part file holds whole.
fn finished(out: &Path) -> usize {
    let text = std::fs::read_to_string(out.join("scatter.csv.part")).unwrap_or_default();
    (text.lines().filter(|line| line.starts_with("done "))).count()
}

/// Kills a map once some of its lines are done: lines done by then, NaN if it was faster.
fn kill(mut map: Child, out: &Path) -> Result<f64, CompareError> {
    let failed = failed(out);
    loop {
        if map.try_wait().map_err(&failed)?.is_some() {
            return Ok(f64::NAN);
        }
        let done = finished(out);
        if done >= DONE {
            map.kill().map_err(&failed)?;
            map.wait().map_err(&failed)?;
            return Ok(done as f64);
        }
        std::thread::sleep(Duration::from_millis(1));
    }
}

/// A map that is killed keeps its lines, and ends up as the same file when it is started again.
fn killed(program: &Path, rows: &mut Rows) -> Result<(), CompareError> {
    let (whole, torn) = (temporary()?, temporary()?);
    let run = |out: &Path| {
        let status = command(program, MAP, out).status();
        status.map_err(failed(program))
    };
    run(whole.path())?;
    let map = command(program, MAP, torn.path()).spawn();
    let done = kill(map.map_err(failed(program))?, torn.path())?;
    rows.add(
        ALL,
        "lines lost of those that a map had done when it was killed",
        (0.0, "lines are appended as they come"),
        (done - finished(torn.path()) as f64).max(0.0) + 0.0 * done,
    );
    run(torn.path())?;
    let csv = |folder: &Path| std::fs::read(folder.join("scatter.csv")).ok();
    let (expected, found) = (csv(whole.path()), csv(torn.path()));
    rows.add(
        ALL,
        "maps that were killed and started again and differ from one that was not",
        (0.0, "what is torn is dropped and computed again"),
        f64::from(u8::from(expected.is_none() || expected != found)),
    );
    Ok(())
}

/// Processes on one cache and one output folder.
fn at_once(program: &Path, rows: &mut Rows) -> Result<(), CompareError> {
    let (alone, shared) = (temporary()?, temporary()?);
    let single = command(program, LOADS, alone.path()).status();
    let mut wrong = usize::from(!single.map_err(failed(program))?.success());
    let children = (0..AT_ONCE)
        .map(|_| command(program, LOADS, shared.path()).spawn())
        .collect::<Result<Vec<_>, _>>()
        .map_err(failed(program))?;
    for mut child in children {
        wrong += usize::from(!child.wait().map_err(failed(program))?.success());
    }
    let (expected, found) = (contents(alone.path()), contents(shared.path()));
    wrong += usize::from(expected.is_empty() || expected != found);
    rows.add(
        ALL,
        format!(
            "of {AT_ONCE} processes at once: those that fail or leave other files than one alone"
        ),
        (0.0, "files are written aside and renamed"),
        wrong as f64,
    );
    Ok(())
}

/// Sweeps that would write one part file: one does its work, the other is told before it begins any.
fn one_folder(program: &Path, rows: &mut Rows) -> Result<(), CompareError> {
    let other: Vec<&str> = MAP
        .iter()
        .map(|&word| if word == "5" { "-5" } else { word })
        .collect();
    let mut wrong = 0;
    for second in [MAP, &other] {
        let shared = temporary()?;
        let mut first = command(program, MAP, shared.path())
            .spawn()
            .map_err(failed(program))?;
        while finished(shared.path()) == 0 && first.try_wait().map_err(failed(program))?.is_none() {
            std::thread::sleep(Duration::from_millis(1));
        }
        let refused = command(program, second, shared.path())
            .stderr(Stdio::piped())
            .output()
            .map_err(failed(program))?;
        let message = String::from_utf8_lossy(&refused.stderr);
        let told = message.trim().lines().count() == 1 && message.contains("another run writes");
        // Who comes when the first is done may do its work.
        let refused_well = refused.status.code() == Some(2) && told;
        wrong += usize::from(!refused_well && !refused.status.success());
        wrong += usize::from(!first.wait().map_err(failed(program))?.success());
        wrong += usize::from(!shared.path().join("scatter.csv").exists());
    }
    rows.add(
        ALL,
        "of 2 maps at once in one folder: those that lose their work or are not refused in one line",
        (0.0, "a folder belongs to one process at a time"),
        wrong as f64,
    );
    Ok(())
}
