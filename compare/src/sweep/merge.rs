//! Shares of a sweep put together: byte for byte the file of the sweep that was not shared.

use std::fs::File;
use std::io::{BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};

use super::manifest::{Manifest, SweepIdentity, measured, written};
use super::{Arithmetic, Share};
use crate::CompareError;
use crate::output::OutputFolder;

/// File of the rows.
pub(super) const ROWS: &str = "sweep.csv";

/// What has been merged.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Merged {
    /// Shares.
    pub shares: usize,
    /// Rows.
    pub rows: usize,
    /// The arithmetics of the shares; more than one if machines differ, and then the last digits may.
    pub arithmetic: Vec<Arithmetic>,
}

/// Merges the shares in `folders`, whatever their order, into `sweep.csv` of `out`, with a manifest.
///
/// # Errors
/// [`CompareError::Share`], naming the share that is missing, there twice, of another sweep, or torn;
/// [`CompareError::Write`].
pub fn merge(folders: &[PathBuf], out: &OutputFolder) -> Result<Merged, CompareError> {
    let shares = in_order(folders)?;
    let Some((_, first)) = shares.first() else {
        return Err(CompareError::input(
            "merge",
            "",
            "name the folders of the shares",
        ));
    };
    let mut header = String::new();
    out.write_by(ROWS, |to| -> Result<(), CompareError> {
        for (folder, manifest) in &shares {
            copy(folder, manifest, &mut header, to, out)?;
        }
        Ok(())
    })?;
    let mut arithmetic: Vec<Arithmetic> = Vec::new();
    for of_share in shares.iter().flat_map(|(_, manifest)| &manifest.arithmetic) {
        if !arithmetic.contains(of_share) {
            arithmetic.push(of_share.clone());
        }
    }
    let path = out.path().join(ROWS);
    let (bytes, checksum) =
        measured(&path).map_err(|source| CompareError::Write { path, source })?;
    let whole = Manifest {
        share: Share::ALL,
        rows: 0..first.all_rows,
        failed: shares.iter().map(|(_, manifest)| manifest.failed).sum(),
        bytes,
        checksum,
        arithmetic: arithmetic.clone(),
        threads: shares.iter().map(|(_, manifest)| manifest.threads).sum(),
        seconds: shares.iter().map(|(_, manifest)| manifest.seconds).sum(),
        ..first.clone()
    };
    out.write(Manifest::FILE, &whole.json()?)?;
    Ok(Merged {
        shares: shares.len(),
        rows: first.all_rows,
        arithmetic,
    })
}

fn refused(path: &Path, reason: impl Into<String>) -> CompareError {
    CompareError::Share {
        path: path.to_owned(),
        reason: reason.into(),
    }
}

/// The shares in their order, all of one sweep, none missing and none twice.
fn in_order(folders: &[PathBuf]) -> Result<Vec<(&PathBuf, Manifest)>, CompareError> {
    let mut shares = (folders.iter())
        .map(|folder| Ok((folder, Manifest::read(folder)?)))
        .collect::<Result<Vec<_>, CompareError>>()?;
    shares.sort_by_key(|(_, manifest)| manifest.share.number);
    let Some((first, of_first)) = shares.first() else {
        return Ok(shares);
    };
    for (folder, manifest) in &shares {
        if let Some(what) = difference(&manifest.sweep, &of_first.sweep) {
            let reason = format!(
                "it is a share of another sweep than '{}': {what} differs",
                first.display()
            );
            return Err(refused(folder, reason));
        }
        if manifest.share.of != of_first.share.of || manifest.all_rows != of_first.all_rows {
            let reason = format!(
                "it is share {} of {} rows, '{}' is share {} of {}",
                manifest.share,
                manifest.all_rows,
                first.display(),
                of_first.share,
                of_first.all_rows
            );
            return Err(refused(folder, reason));
        }
    }
    for pair in shares.windows(2) {
        let [(before, one), (folder, other)] = pair else {
            continue;
        };
        if one.share == other.share {
            let reason = format!("share {} is in '{}' too", one.share, before.display());
            return Err(refused(folder, reason));
        }
    }
    let there: Vec<usize> = shares.iter().map(|(_, m)| m.share.number).collect();
    let of = of_first.share.of;
    let missing: Vec<String> = (1..=of)
        .filter(|number| !there.contains(number))
        .map(|number| format!("{number}/{of}"))
        .collect();
    if !missing.is_empty() {
        let reason = format!(
            "of its sweep these shares are missing: {}",
            missing.join(", ")
        );
        return Err(refused(first, reason));
    }
    let mut next = 0;
    for (folder, manifest) in &shares {
        if manifest.rows.start != next || manifest.rows.end < next {
            let reason = format!(
                "its rows are {} to {}, but row {next} is the next one",
                manifest.rows.start, manifest.rows.end
            );
            return Err(refused(folder, reason));
        }
        next = manifest.rows.end;
    }
    if next != of_first.all_rows {
        let reason = format!("the shares end at row {next} of {}", of_first.all_rows);
        return Err(refused(first, reason));
    }
    Ok(shares)
}

/// The first thing in which two sweeps differ.
fn difference(one: &SweepIdentity, other: &SweepIdentity) -> Option<&'static str> {
    [
        ("the version of the program", one.version == other.version),
        ("the family", one.family == other.family),
        ("what is varied", one.axes == other.axes),
        ("the models", one.models == other.models),
        ("how each run is made", one.run == other.run),
    ]
    .into_iter()
    .find_map(|(what, same)| (!same).then_some(what))
}

/// Copies the rows of a share, without its header but for the first one.
fn copy(
    folder: &Path,
    manifest: &Manifest,
    header: &mut String,
    to: &mut dyn Write,
    out: &OutputFolder,
) -> Result<(), CompareError> {
    let path = folder.join(ROWS);
    let torn = |reason: String| refused(&path, reason);
    let unread = |error: std::io::Error| refused(&path, error.to_string());
    let write = |to: &mut dyn Write, bytes: &[u8]| {
        (to.write_all(bytes)).map_err(|source| out.failed(ROWS, source))
    };
    let mut file = BufReader::with_capacity(1 << 20, File::open(&path).map_err(unread)?);
    let mut line = String::new();
    file.read_line(&mut line).map_err(unread)?;
    let mut checksum = crc32fast::Hasher::new();
    checksum.update(line.as_bytes());
    if header.is_empty() {
        write(to, line.as_bytes())?;
        *header = line.clone();
    } else if *header != line {
        return Err(torn(
            "its columns are not those of the first share".to_owned(),
        ));
    }
    let (mut bytes, mut rows) = (line.len() as u64, 0);
    let mut buffer = vec![0; 1 << 20];
    loop {
        let read = file.read(&mut buffer).map_err(unread)?;
        if read == 0 {
            break;
        }
        let part = &buffer[..read];
        checksum.update(part);
        bytes += read as u64;
        rows += part.iter().filter(|byte| **byte == b'\n').count();
        write(to, part)?;
    }
    let found = written(checksum);
    if (bytes, rows, &found) != (manifest.bytes, manifest.rows.len(), &manifest.checksum) {
        return Err(torn(format!(
            "it is torn or was edited: {rows} rows in {bytes} bytes with the checksum {found}, but its manifest says \
             {} rows in {} bytes with {}",
            manifest.rows.len(),
            manifest.bytes,
            manifest.checksum
        )));
    }
    Ok(())
}
