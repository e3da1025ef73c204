//! Keeps the finished pieces of a long sweep on disk, so that a sweep that was stopped can continue.
//!
//! The first line of `NAME.csv.part` describes the sweep. Each piece is appended as its lines and a line
//! `done K CHECKSUM`. Text after the last such line is an unfinished piece and is dropped. A piece with a wrong
//! checksum was edited or damaged: it is computed again, and a message reports it. A part file of another sweep is not
//! read, and is deleted only if the user asks for it.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufRead, BufReader, BufWriter, ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use rayon::prelude::*;

use crate::CompareError;
use crate::output::{OutputFolder, part_of};
use crate::stoppable;
use crate::watch::{self, Keeping, Pieces, Progress, notice};

const DONE: &str = "done ";

/// The pieces of one sweep, on disk.
pub(crate) struct Journal {
    path: PathBuf,
    key: String,
    /// Whether the folder is kept.
    keeps: bool,
    kept: Mutex<Kept>,
}

/// The part file, and the position of the lines of each piece in it.
struct Kept {
    file: File,
    end: u64,
    pieces: BTreeMap<usize, Place>,
}

#[derive(Clone, Copy)]
struct Place {
    at: u64,
    length: usize,
}

/// The part file of an earlier command.
#[derive(Debug, PartialEq)]
enum Found {
    /// Pieces of this sweep; some may be damaged.
    Same { damaged: usize },
    /// Pieces of another sweep.
    Other { pieces: usize },
}

impl Journal {
    /// Opens the journal of a sweep, with the pieces that are already finished. The line `key` describes the sweep.
    ///
    /// # Errors
    /// [`CompareError::OtherSweep`] if this would delete pieces of another sweep and the user did not ask for it;
    /// [`CompareError::Write`].
    pub(crate) fn open(out: &OutputFolder, name: &str, key: &str) -> Result<Self, CompareError> {
        let file_name = part_of(&format!("{name}.csv"));
        let path = out.path().join(&file_name);
        let failed = |source| out.failed(&file_name, source);
        // The file is written again without the unfinished piece.
        let mut anew = BufWriter::new(out.aside(&file_name)?);
        let (mut pieces, mut end) = (BTreeMap::new(), key.len() as u64 + 1);
        writeln!(anew, "{key}").map_err(failed)?;
        let earlier = match File::open(&path) {
            Ok(file) => Some(BufReader::new(file)),
            Err(error) if error.kind() == ErrorKind::NotFound => None,
            Err(error) => return Err(failed(error)),
        };
        if let Some(earlier) = earlier {
            let found = scan(earlier, key, |piece, lines| {
                if out.is_fresh() {
                    return Ok(());
                }
                let entry = entry(key, piece, lines);
                let length = lines.len();
                pieces.insert(piece, Place { at: end, length });
                end += (length + entry.len()) as u64;
                anew.write_all(lines)?;
                anew.write_all(entry.as_bytes())
            });
            found.map_err(failed)?.judge(&path, out.is_fresh())?;
        }
        let anew = anew
            .into_inner()
            .map_err(|error| failed(error.into_error()))?;
        let file = anew.persist(&path).map_err(|error| failed(error.error))?;
        let kept = Kept { file, end, pieces };
        out.takes(file_name);
        Ok(Self {
            path,
            key: key.to_owned(),
            keeps: out.is_kept(),
            kept: Mutex::new(kept),
        })
    }

    /// Checks that [`Self::open`] would not delete pieces of another sweep. Changes nothing and reports nothing.
    ///
    /// # Errors
    /// As [`Self::open`].
    pub(crate) fn check(out: &OutputFolder, name: &str, key: &str) -> Result<(), CompareError> {
        let file_name = part_of(&format!("{name}.csv"));
        let path = out.path().join(&file_name);
        let failed = |source| out.failed(&file_name, source);
        match File::open(&path) {
            Ok(file) => {
                let found = scan(BufReader::new(file), key, |_, _| Ok(())).map_err(failed)?;
                found.refuse_other(&path, out.is_fresh())
            }
            Err(error) if error.kind() == ErrorKind::NotFound => Ok(()),
            Err(error) => Err(failed(error)),
        }
    }

    /// The part file.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    fn kept(&self) -> MutexGuard<'_, Kept> {
        self.kept.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn failed(&self, source: std::io::Error) -> CompareError {
        let path = self.path.clone();
        CompareError::Write { path, source }
    }

    fn append(&self, piece: usize, lines: &str) -> Result<(), CompareError> {
        let entry = entry(&self.key, piece, lines.as_bytes());
        let mut kept = self.kept();
        let at = kept.end;
        (kept.file.seek(SeekFrom::Start(at)))
            .and_then(|_| kept.file.write_all(format!("{lines}{entry}").as_bytes()))
            .map_err(|source| self.failed(source))?;
        let length = lines.len();
        kept.end += (length + entry.len()) as u64;
        kept.pieces.insert(piece, Place { at, length });
        Ok(())
    }

    /// Whether a piece is finished.
    pub(crate) fn has(&self, piece: usize) -> bool {
        self.kept().pieces.contains_key(&piece)
    }

    /// The lines of a piece, if it is finished.
    pub(crate) fn lines(&self, piece: usize) -> Result<Option<String>, CompareError> {
        let mut kept = self.kept();
        let Some(&Place { at, length }) = kept.pieces.get(&piece) else {
            return Ok(None);
        };
        let mut bytes = vec![0; length];
        (kept.file.seek(SeekFrom::Start(at)))
            .and_then(|_| kept.file.read_exact(&mut bytes))
            .map_err(|source| self.failed(source))?;
        Ok(Some(String::from_utf8_lossy(&bytes).into_owned()))
    }

    /// Deletes the part file, because its pieces are in the finished file.
    pub(crate) fn close(self) -> Result<(), CompareError> {
        let path = self.path;
        std::fs::remove_file(&path).map_err(|source| CompareError::Write { path, source })
    }

    /// Computes in parallel the pieces out of `0..pieces` that are not finished, and keeps them. Returns how many the
    /// time limit left out.
    ///
    /// # Errors
    /// [`CompareError::Interrupted`] after an interrupt, [`CompareError::Scene`] if the folder is not kept; [`CompareError::Write`]; the errors of `compute`.
    pub(crate) fn run(
        &self,
        pieces: usize,
        what: &'static str,
        time_limit: Option<Duration>,
        compute: impl Fn(usize) -> Result<String, CompareError> + Sync,
    ) -> Result<usize, CompareError> {
        let started = Instant::now();
        let pending: Vec<usize> = (0..pieces).filter(|&piece| !self.has(piece)).collect();
        let progress = Progress::begin(what, pending.len(), Pieces::Alike);
        let _keeping = self.keeps.then(Keeping::begin);
        let left = (pending.into_par_iter())
            // Pieces take different times, so each free thread takes the next one.
            .with_max_len(1)
            .map(|piece| -> Result<usize, CompareError> {
                let late = time_limit.is_some_and(|limit| started.elapsed() >= limit);
                if late || watch::stop_requested() {
                    return Ok(1);
                }
                let lines = compute(piece)?;
                if watch::given_up() {
                    return Ok(1);
                }
                self.append(piece, &lines)?;
                progress.advance();
                Ok(0)
            })
            .try_reduce(|| 0, |a, b| Ok(a + b))?;
        if watch::stop_requested() {
            if !self.keeps {
                return Err(stoppable::given_up().into());
            }
            let path = self.path.clone();
            return Err(CompareError::Interrupted {
                left,
                pieces,
                what,
                path,
            });
        }
        Ok(left)
    }
}

impl Found {
    /// Returns an error if pieces of another sweep would be deleted.
    fn refuse_other(&self, path: &Path, fresh: bool) -> Result<(), CompareError> {
        match *self {
            Self::Other { pieces } if pieces > 0 && !fresh => Err(CompareError::OtherSweep {
                path: path.to_owned(),
                pieces,
            }),
            _ => Ok(()),
        }
    }

    /// Reports damaged or deleted pieces; returns an error if pieces of another sweep would be deleted.
    fn judge(&self, path: &Path, fresh: bool) -> Result<(), CompareError> {
        self.refuse_other(path, fresh)?;
        match *self {
            Self::Same { damaged } if damaged > 0 && !fresh => notice!(
                "'{}': {damaged} finished pieces were edited or damaged and are computed again",
                path.display()
            ),
            _ if fresh => notice!("'{}' is deleted", path.display()),
            _ => {}
        }
        Ok(())
    }
}

/// The line that ends a piece.
fn entry(key: &str, piece: usize, lines: &[u8]) -> String {
    let mut checksum = crc32fast::Hasher::new();
    checksum.update(key.as_bytes());
    checksum.update(&piece.to_le_bytes());
    checksum.update(lines);
    format!("{DONE}{piece} {:08x}\n", checksum.finalize())
}

/// Reads the finished pieces from a part file of the sweep `key`.
fn scan(
    mut text: impl BufRead,
    key: &str,
    mut take: impl FnMut(usize, &[u8]) -> std::io::Result<()>,
) -> std::io::Result<Found> {
    let mut line = Vec::new();
    text.read_until(b'\n', &mut line)?;
    let same = line.strip_suffix(b"\n") == Some(key.as_bytes());
    let (mut lines, mut pieces, mut damaged) = (Vec::new(), 0, 0);
    loop {
        line.clear();
        text.read_until(b'\n', &mut line)?;
        if !line.ends_with(b"\n") {
            break;
        }
        let Some(end) = line.strip_prefix(DONE.as_bytes()) else {
            if same {
                lines.extend_from_slice(&line);
            }
            continue;
        };
        pieces += 1;
        if same {
            let number = String::from_utf8_lossy(end);
            let piece = number
                .split_once(' ')
                .and_then(|(piece, _)| piece.parse().ok());
            match piece.filter(|&piece| entry(key, piece, &lines).as_bytes() == line) {
                Some(piece) => take(piece, &lines)?,
                None => damaged += 1,
            }
            lines.clear();
        }
    }
    Ok(if same {
        Found::Same { damaged }
    } else {
        Found::Other { pieces }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn whole(text: &str, key: &str) -> (Found, BTreeMap<usize, String>) {
        let mut pieces = BTreeMap::new();
        let found = scan(text.as_bytes(), key, |piece, lines| {
            pieces.insert(piece, String::from_utf8_lossy(lines).into_owned());
            Ok(())
        });
        (found.unwrap(), pieces)
    }

    #[test]
    fn a_torn_piece_is_dropped_and_another_sweep_is_not_read() {
        let [four, zero] = [(4, "a,1\nb,2\n"), (0, "c,3\n")]
            .map(|(k, lines)| format!("{lines}{}", entry("key", k, lines.as_bytes())));
        let text = format!("key\n{four}{zero}d,4\ndon");
        let (found, pieces) = whole(&text, "key");
        assert_eq!(found, Found::Same { damaged: 0 });
        assert_eq!(pieces.len(), 2);
        assert_eq!(pieces[&4], "a,1\nb,2\n");
        assert_eq!(pieces[&0], "c,3\n");
        let (found, pieces) = whole(&text, "other");
        assert!(pieces.is_empty());
        assert_eq!(found, Found::Other { pieces: 2 });
        assert!(whole("key\na,1\ndone 1", "key").1.is_empty());
    }

    #[test]
    fn a_piece_that_was_edited_is_told_from_one_that_was_not() {
        let lines = "a,1\nb,2\n";
        let text = format!("key\n{lines}{}", entry("key", 4, lines.as_bytes()));
        assert_eq!(whole(&text, "key").1.len(), 1);
        for (from, to) in [("b,2", "b,3"), ("done 4", "done 5"), ("a,1\n", "")] {
            let (found, pieces) = whole(&text.replace(from, to), "key");
            assert_eq!(found, Found::Same { damaged: 1 }, "{from} for {to}");
            assert!(pieces.is_empty());
        }
    }

    #[test]
    fn a_sweep_that_was_stopped_goes_on_where_it_was() {
        let folder = tempfile::tempdir().unwrap();
        let out = OutputFolder::open(folder.path()).unwrap();
        let line = |k: usize| Ok(format!("row {k}\n"));
        let journal = Journal::open(&out, "sweep", "key").unwrap();
        let none = journal.run(3, "pieces", Some(Duration::ZERO), line);
        assert_eq!(none.unwrap(), 3);
        let two = Journal::open(&out, "sweep", "key").unwrap();
        two.run(2, "pieces", None, line).unwrap();
        assert!(matches!(
            Journal::open(&out, "sweep", "another"),
            Err(CompareError::OtherSweep { pieces: 2, .. })
        ));
        let rest = Journal::open(&out, "sweep", "key").unwrap();
        let left = rest.run(3, "pieces", None, |k| {
            assert_eq!(k, 2, "finished pieces are not computed again");
            line(k)
        });
        assert_eq!(left.unwrap(), 0);
        let all: Vec<_> = (0..3).map(|k| rest.lines(k).unwrap().unwrap()).collect();
        assert_eq!(all, ["row 0\n", "row 1\n", "row 2\n"]);
        rest.close().unwrap();
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
