//! Merges the shares of a sweep. The merged file has the same bytes as the file of a sweep that was not shared.

use std::fs::File;
use std::io::{BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};

use super::manifest::{Manifest, SweepIdentity, measured, written};
use super::{Arithmetic, Share};
use crate::CompareError;
use crate::output::OutputFolder;

/// Most missing shares that a message lists.
const LISTED: usize = 20;

/// Summary of a merge.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Merged {
    /// Name of the file of the rows.
    pub file: String,
    /// Number of shares.
    pub shares: usize,
    /// Number of rows.
    pub rows: usize,
    /// The arithmetics of the shares. If there are several, the last digits of the rows may depend on the machine.
    pub arithmetic: Vec<Arithmetic>,
}

/// Merges the shares in `folders`, in any order, into one file in `out`, and writes a manifest.
///
/// # Errors
/// [`CompareError::Share`], with the name of a share that is missing, given twice, unfinished, damaged or from
/// another sweep; [`CompareError::Write`].
pub fn merge(folders: &[PathBuf], out: &OutputFolder) -> Result<Merged, CompareError> {
    let own = out.path().canonicalize().ok();
    if let Some(folder) = folders
        .iter()
        .find(|folder| folder.canonicalize().ok() == own)
    {
        let allowed = "this folder holds a share, which would be overwritten: give another folder";
        return Err(CompareError::input("--out", folder.display(), allowed));
    }
    let shares = in_order(folders)?;
    let Some((_, first)) = shares.first() else {
        return Err(CompareError::input(
            "merge",
            "",
            "name the folders of the shares",
        ));
    };
    let mut header = String::new();
    out.write_by(&first.file, |to| -> Result<(), CompareError> {
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
    let path = out.path().join(&first.file);
    let (bytes, checksum) =
        measured(&path).map_err(|source| CompareError::Write { path, source })?;
    let whole = Manifest {
        share: Share::ALL,
        rows: 0..first.all_rows,
        failed: shares.iter().map(|(_, manifest)| manifest.failed).sum(),
        bytes,
        checksum,
        arithmetic: arithmetic.clone(),
        // Of sums that are no longer numbers there would be no manifest to read again.
        threads: (shares.iter()).fold(0, |sum: usize, (_, of)| sum.saturating_add(of.threads)),
        seconds: (shares.iter())
            .fold(0.0, |sum: f64, (_, of)| sum + of.seconds)
            .min(f64::MAX),
        ..first.clone()
    };
    out.write(Manifest::FILE, &whole.json()?)?;
    Ok(Merged {
        file: first.file.clone(),
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

/// The shares in their order. Checks that all belong to one sweep, that none is missing and none is given twice.
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
                "it is not a share of the same sweep as '{}': {what} differs",
                first.display()
            );
            return Err(refused(folder, reason));
        }
        if manifest.file != of_first.file {
            let reason = format!(
                "its rows are in {}, but those of '{}' are in {}",
                manifest.file,
                first.display(),
                of_first.file
            );
            return Err(refused(folder, reason));
        }
        if manifest.share.of != of_first.share.of || manifest.all_rows != of_first.all_rows {
            let reason = format!(
                "it is share {} of {} rows, but '{}' is share {} of {} rows",
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
            let reason = format!("share {} is also in '{}'", one.share, before.display());
            return Err(refused(folder, reason));
        }
    }
    let there: Vec<usize> = shares.iter().map(|(_, m)| m.share.number).collect();
    let of = of_first.share.of;
    let missing = of - there.len();
    if missing > 0 {
        // They are in order.
        let listed: Vec<String> = (1..=of)
            .filter(|number| there.binary_search(number).is_err())
            .take(LISTED)
            .map(|number| format!("{number}/{of}"))
            .collect();
        let more = match missing.saturating_sub(LISTED) {
            0 => String::new(),
            more => format!(" and {more} more"),
        };
        let listed = listed.join(", ");
        let reason = format!("shares of its sweep are missing: {listed}{more}");
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

/// The first difference of two sweeps, in words.
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

/// Copies the rows of a share. Only the first share is copied with its header.
fn copy(
    folder: &Path,
    manifest: &Manifest,
    header: &mut String,
    to: &mut dyn Write,
    out: &OutputFolder,
) -> Result<(), CompareError> {
    let path = folder.join(&manifest.file);
    let torn = |reason: String| refused(&path, reason);
    let unread = |error: std::io::Error| refused(&path, error.to_string());
    let write = |to: &mut dyn Write, bytes: &[u8]| {
        (to.write_all(bytes)).map_err(|source| out.failed(&manifest.file, source))
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
    let mut ended = line.ends_with('\n');
    let mut buffer = vec![0; 1 << 20];
    loop {
        let read = file.read(&mut buffer).map_err(unread)?;
        if read == 0 {
            break;
        }
        let part = &buffer[..read];
        checksum.update(part);
        bytes += read as u64;
        ended = part.ends_with(b"\n");
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
    if !ended {
        // The next share's first row would be its end.
        return Err(torn("its last line has no end".to_owned()));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sweep::{Axis, ManifestModel};

    /// Name of the file of the rows.
    const ROWS: &str = Manifest::ROWS[0];

    /// Rows of the sweep in these tests.
    const ALL: usize = 10;

    fn arithmetic(functions: &str) -> Arithmetic {
        Arithmetic {
            machine: "test".to_owned(),
            functions: functions.to_owned(),
            mobilities: Vec::new(),
        }
    }

    /// A folder with one share, made different by `change`.
    fn share(number: usize, of: usize, change: impl FnOnce(&mut Manifest)) -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        let share = Share { number, of };
        let rows = share.units(ALL);
        let mut text = "x,outcome\n".to_owned();
        for row in rows.clone() {
            text.push_str(&format!("{row}.5,scattered\n"));
        }
        let path = folder.path().join(ROWS);
        std::fs::write(&path, text).unwrap();
        let (bytes, checksum) = measured(&path).unwrap();
        let mut manifest = Manifest {
            file: ROWS.to_owned(),
            sweep: SweepIdentity {
                version: "squirmers".to_owned(),
                family: "text".to_owned(),
                axes: vec![Axis {
                    name: "x".to_owned(),
                    values: vec![0.5],
                }],
                models: vec![ManifestModel {
                    name: "lt".to_owned(),
                    fingerprint: "1".to_owned(),
                }],
                run: "tolerance 1e-8".to_owned(),
            },
            share,
            rows,
            all_rows: ALL,
            failed: 0,
            bytes,
            checksum,
            arithmetic: vec![arithmetic("one")],
            threads: 1,
            seconds: 1.0,
        };
        change(&mut manifest);
        std::fs::write(folder.path().join(Manifest::FILE), manifest.json().unwrap()).unwrap();
        folder
    }

    fn merged(shares: &[tempfile::TempDir]) -> (Result<Merged, CompareError>, Option<String>) {
        let folder = tempfile::tempdir().unwrap();
        let out = OutputFolder::open(folder.path()).unwrap();
        let paths: Vec<_> = shares.iter().map(|s| s.path().to_owned()).collect();
        let merged = merge(&paths, &out);
        (merged, out.read(ROWS))
    }

    /// The error message for shares that are refused. Checks that nothing is written.
    fn refusal(shares: &[tempfile::TempDir]) -> String {
        let (merged, written) = merged(shares);
        assert_eq!(written, None);
        merged.unwrap_err().to_string()
    }

    #[test]
    fn shares_in_any_order_give_the_file_of_the_whole() {
        let whole = share(1, 1, |_| {});
        let text = std::fs::read_to_string(whole.path().join(ROWS)).unwrap();
        let shares = [3, 1, 2].map(|number| share(number, 3, |_| {}));
        let (merged, found) = merged(&shares);
        let merged = merged.unwrap();
        assert_eq!(found, Some(text));
        assert_eq!((merged.shares, merged.rows), (3, ALL));
        assert_eq!(merged.arithmetic.len(), 1);
    }

    #[test]
    fn shares_of_other_machines_are_merged_and_counted() {
        let shares = [
            share(1, 2, |_| {}),
            share(2, 2, |manifest| {
                manifest.arithmetic = vec![arithmetic("two")]
            }),
        ];
        let (merged, _) = merged(&shares);
        assert_eq!(merged.unwrap().arithmetic.len(), 2);
    }

    #[test]
    fn a_missing_or_doubled_share_is_named() {
        let shares = [share(1, 4, |_| {}), share(3, 4, |_| {})];
        let reason = refusal(&shares);
        assert!(reason.contains("missing: 2/4, 4/4"), "{reason}");
        let shares = [1, 2, 2].map(|number| share(number, 2, |_| {}));
        let reason = refusal(&shares);
        assert!(reason.contains("share 2/2 is also in"), "{reason}");
        let name = shares[2].path().display().to_string();
        assert!(reason.contains(&name), "{reason}");
    }

    #[test]
    fn of_very_many_missing_shares_some_are_listed() {
        let reason = refusal(&[share(1, 1, |m| m.share.of = 100_000)]);
        assert!(
            reason.contains("2/100000, ") && reason.ends_with(" and 99979 more"),
            "{reason}"
        );
        assert!(reason.len() < 500, "{reason}");
    }

    #[test]
    fn numbers_that_no_sweep_writes_are_refused_in_one_line() {
        type Change = fn(&mut Manifest);
        let changes: [(&str, Change); 8] = [
            ("no share 0/1", |m| m.share.number = 0),
            ("no share 1/0", |m| m.share.of = 0),
            // Each of them would be looked for.
            ("no share 1/18446744073709551615", |m| {
                m.share.of = usize::MAX
            }),
            ("18446744073709551615 runs of 10 rows failed", |m| {
                m.failed = usize::MAX
            }),
            ("it took -1 seconds", |m| m.seconds = -1.0),
            ("'\\n' is no checksum", |m| m.checksum = "\n".to_owned()),
            ("in '\\n', not in", |m| m.file = "\n".to_owned()),
            // JSON has no infinity.
            ("no manifest: invalid type: null", |m| {
                m.seconds = f64::INFINITY
            }),
        ];
        for (expected, change) in changes {
            let reason = refusal(&[share(1, 1, change)]);
            assert!(reason.contains(expected), "{reason}");
            assert_eq!(reason.lines().count(), 1, "{reason:?}");
        }
        // A key of several lines, as the parser quotes it.
        let whole = share(1, 1, |_| {});
        let path = whole.path().join(Manifest::FILE);
        let text = std::fs::read_to_string(&path).unwrap();
        std::fs::write(&path, text.replacen("threads", "a\\nb", 1)).unwrap();
        let reason = refusal(&[whole]);
        assert_eq!(reason.lines().count(), 1, "{reason:?}");
        assert!(reason.contains("unknown field"), "{reason}");
    }

    #[test]
    fn counts_whose_sum_is_no_number_leave_a_manifest_that_can_be_read() {
        let shares = [1, 2].map(|number| {
            share(number, 2, |m| {
                (m.threads, m.seconds) = (usize::MAX, f64::MAX);
            })
        });
        let folder = tempfile::tempdir().unwrap();
        let out = OutputFolder::open(folder.path()).unwrap();
        merge(&shares.each_ref().map(|s| s.path().to_owned()), &out).unwrap();
        let whole = Manifest::read(folder.path()).unwrap();
        assert_eq!(whole.threads, usize::MAX);
        assert!(whole.seconds.is_finite());
    }

    #[test]
    fn rows_of_two_shares_are_never_joined_into_one() {
        let shares = [1, 2].map(|number| {
            share(number, 2, |manifest| {
                manifest.rows = 0..0;
                manifest.all_rows = 0;
            })
        });
        for share in &shares {
            let rows = share.path().join(ROWS);
            std::fs::write(&rows, "x,outcome\n1.5,scattered").unwrap();
            let mut manifest = Manifest::read(share.path()).unwrap();
            (manifest.bytes, manifest.checksum) = measured(&rows).unwrap();
            let text = manifest.json().unwrap();
            std::fs::write(share.path().join(Manifest::FILE), text).unwrap();
        }
        let reason = refusal(&shares);
        assert!(reason.contains("has no end"), "{reason}");
    }

    #[test]
    fn a_foreign_share_is_told_with_what_differs() {
        type Change = fn(&mut Manifest);
        let changes: [(&str, Change); 9] = [
            ("'rows.csv'", |m| m.file = "rows.csv".to_owned()),
            ("in collisions.csv", |m| {
                m.file = Manifest::ROWS[1].to_owned()
            }),
            ("version", |m| m.sweep.version.push('x')),
            ("family", |m| m.sweep.family.push('x')),
            ("varied", |m| m.sweep.axes.clear()),
            ("models", |m| m.sweep.models.clear()),
            ("run", |m| m.sweep.run.push('x')),
            ("2/3", |m| m.share.of = 3),
            ("of 11 rows", |m| m.all_rows = 11),
        ];
        for (told, change) in changes {
            let reason = refusal(&[share(1, 2, |_| {}), share(2, 2, change)]);
            assert!(reason.contains(told), "{told}: {reason}");
        }
        let reason = refusal(&[share(1, 2, |_| {}), share(2, 2, |m| m.rows = 6..10)]);
        assert!(reason.contains("row 5 is the next"), "{reason}");
    }

    #[test]
    fn a_torn_share_is_told() {
        type Tear = fn(&Path);
        let torn: [Tear; 4] = [
            |rows| std::fs::write(rows, "x,outcome\n5.5,scattered\n").unwrap(),
            |rows| {
                let text = std::fs::read_to_string(rows).unwrap();
                std::fs::write(rows, text.replace("7.5", "7.6")).unwrap();
            },
            |rows| std::fs::write(rows, "").unwrap(),
            |rows| std::fs::remove_file(rows).unwrap(),
        ];
        for (number, tear) in torn.into_iter().enumerate() {
            let shares = [share(1, 2, |_| {}), share(2, 2, |_| {})];
            tear(&shares[1].path().join(ROWS));
            let reason = refusal(&shares);
            let name = shares[1].path().display().to_string();
            assert!(reason.contains(&name), "{number}: {reason}");
        }
        let shares = [share(1, 2, |_| {}), share(2, 2, |_| {})];
        std::fs::remove_file(shares[1].path().join(Manifest::FILE)).unwrap();
        assert!(refusal(&shares).contains("not finished"));
    }

    #[test]
    fn a_share_is_not_merged_into_its_own_folder() {
        let only = share(1, 1, |_| {});
        let out = OutputFolder::open(only.path()).unwrap();
        let error = merge(&[only.path().to_owned()], &out).unwrap_err();
        assert!(error.to_string().contains("--out"), "{error}");
        assert!(only.path().join(ROWS).exists());
    }
}
