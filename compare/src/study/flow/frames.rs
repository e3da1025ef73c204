//! The numbered frames of a film, which an interrupted command keeps.
//!
//! While frames are left, [`PART`] holds what the film is of. The same command goes on with the frames that have no picture yet.

use crate::CompareError;
use crate::output::OutputFolder;
use crate::watch::{Keeping, Leaving, Pieces, Progress, stop_requested};

/// The file that says what unfinished frames are of.
pub const PART: &str = "flow.part";

/// Name of the frame number `index`, counted from 0, without the ending.
#[must_use]
pub fn frame_name(index: usize) -> String {
    format!("flow-{:04}", index + 1)
}

/// Name of the picture of a frame, its last file.
fn picture(index: usize) -> String {
    format!("{}.svg", frame_name(index))
}

/// Calls `draw` for each of `total` frames that an interrupted command has not finished. It must write the picture of the frame last. The
/// `key` says what the film is of. Returns the number of frames that were kept from an interrupted command.
///
/// # Errors
/// [`CompareError::OtherSweep`] if the folder keeps frames of another film; [`CompareError::Interrupted`]; those of `draw`.
pub fn each_frame<E: From<CompareError>>(
    out: &OutputFolder,
    key: &str,
    total: usize,
    mut draw: impl FnMut(usize) -> Result<(), E>,
) -> Result<usize, E> {
    let goes_on = match out.read(PART) {
        Some(held) if held == key => true,
        Some(_) if !out.is_fresh() => {
            let pieces = numbered(out)?
                .iter()
                .filter(|name| name.ends_with(".svg"))
                .count();
            let path = out.path().join(PART);
            return Err(CompareError::OtherSweep { path, pieces }.into());
        }
        _ => false,
    };
    if !goes_on {
        for name in numbered(out)? {
            remove(out, &name)?;
        }
        out.write(PART, key)?;
    }
    let left: Vec<usize> = (0..total).filter(|k| !out.holds(&picture(*k))).collect();
    let _keeping = Keeping::begin();
    let _leaving = Leaving::of(format!("finished frames are in '{}'", out.path().display()));
    let progress = Progress::begin("frames", total, Pieces::Alike);
    progress.reach(total - left.len());
    for (done, index) in left.iter().enumerate() {
        if stop_requested() {
            return Err(CompareError::Interrupted {
                left: left.len() - done,
                pieces: total,
                what: "frames",
                path: out.path().join(PART),
            }
            .into());
        }
        draw(*index)?;
        progress.advance();
    }
    remove(out, PART)?;
    Ok(total - left.len())
}

fn remove(out: &OutputFolder, name: &str) -> Result<(), CompareError> {
    std::fs::remove_file(out.path().join(name)).map_err(|source| out.failed(name, source))
}

/// Names of the files of numbered frames in the folder.
fn numbered(out: &OutputFolder) -> Result<Vec<String>, CompareError> {
    let failed = |source| CompareError::Read {
        path: out.path().to_owned(),
        source,
    };
    let mut names = Vec::new();
    for entry in std::fs::read_dir(out.path()).map_err(failed)? {
        let name = entry.map_err(failed)?.file_name();
        let name = name.to_string_lossy();
        let number = name.strip_prefix("flow-").and_then(|rest| rest.get(..4));
        if number.is_some_and(|digits| digits.bytes().all(|digit| digit.is_ascii_digit())) {
            names.push(name.into_owned());
        }
    }
    Ok(names)
}
