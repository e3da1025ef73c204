//! Long sweeps in chunks that are kept as they come, so that a sweep that was stopped goes on where it
//! was.
//!
//! Chunks are appended to `NAME.csv.part` under a first line that describes the sweep, each as its
//! lines followed by `done K`. What follows the last such line was torn when the sweep stopped, and is
//! dropped. A part file of another sweep is not read.

use std::collections::BTreeMap;
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::PathBuf;
use std::sync::Mutex;
use std::time::{Duration, Instant};

use rayon::prelude::*;

use crate::CompareError;
use crate::output::OutputFolder;
use crate::progress::Progress;

const DONE: &str = "done ";

/// The chunks of one sweep, on disk.
pub(crate) struct Journal {
    path: PathBuf,
    file: Mutex<File>,
    finished: BTreeMap<usize, String>,
}

impl Journal {
    /// Opens the journal of the sweep that `key` describes in one line, with the chunks that are
    /// finished already.
    pub(crate) fn open(out: &OutputFolder, name: &str, key: &str) -> Result<Self, CompareError> {
        let file_name = format!("{name}.csv.part");
        let path = out.path().join(&file_name);
        let kept = std::fs::read(&path).unwrap_or_default();
        let finished = finished_chunks(&String::from_utf8_lossy(&kept), key);
        // Written anew without what was torn.
        let mut text = format!("{key}\n");
        for (&chunk, lines) in &finished {
            text += &entry(chunk, lines);
        }
        out.write(&file_name, &text)?;
        let file = (OpenOptions::new().append(true).open(&path)).map_err(|source| {
            CompareError::Write {
                path: path.clone(),
                source,
            }
        })?;
        Ok(Self {
            path,
            file: Mutex::new(file),
            finished,
        })
    }

    fn append(&self, chunk: usize, lines: &str) -> Result<(), CompareError> {
        let mut file = (self.file.lock()).unwrap_or_else(std::sync::PoisonError::into_inner);
        (file.write_all(entry(chunk, lines).as_bytes()))
            .and_then(|()| file.flush())
            .map_err(|source| CompareError::Write {
                path: self.path.clone(),
                source,
            })
    }

    /// Takes the part file away: its chunks are in the finished file.
    pub(crate) fn close(self) -> Result<(), CompareError> {
        let path = self.path;
        std::fs::remove_file(&path).map_err(|source| CompareError::Write { path, source })
    }

    /// The lines of all chunks `0..chunks` in their order, computed in parallel where they are not
    /// finished already; `None` for those that the time limit left out.
    pub(crate) fn run(
        &self,
        chunks: usize,
        what: &'static str,
        time_limit: Option<Duration>,
        compute: impl Fn(usize) -> Result<String, CompareError> + Sync,
    ) -> Result<Vec<Option<String>>, CompareError> {
        let started = Instant::now();
        let pending = (0..chunks).filter(|k| !self.finished.contains_key(k));
        let progress = Progress::of(pending.clone().count(), what);
        let lines = (0..chunks)
            .into_par_iter()
            // Chunks differ in price: each thread takes the next one.
            .with_max_len(1)
            .map(|chunk| {
                if let Some(lines) = self.finished.get(&chunk) {
                    return Ok(Some(lines.clone()));
                }
                if time_limit.is_some_and(|limit| started.elapsed() >= limit) {
                    return Ok(None);
                }
                let lines = compute(chunk)?;
                self.append(chunk, &lines)?;
                progress.advance();
                Ok(Some(lines))
            })
            .collect();
        progress.finish();
        lines
    }
}

fn entry(chunk: usize, lines: &str) -> String {
    format!("{lines}{DONE}{chunk}\n")
}

fn finished_chunks(text: &str, key: &str) -> BTreeMap<usize, String> {
    let mut finished = BTreeMap::new();
    let Some(mut rest) = text.strip_prefix(key).and_then(|t| t.strip_prefix('\n')) else {
        return finished;
    };
    let mut lines = String::new();
    while let Some((line, after)) = rest.split_once('\n') {
        rest = after;
        match line.strip_prefix(DONE).map(str::parse) {
            Some(Ok(chunk)) => {
                finished.insert(chunk, std::mem::take(&mut lines));
            }
            Some(Err(_)) => break,
            None => {
                lines.push_str(line);
                lines.push('\n');
            }
        }
    }
    finished
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_torn_chunk_is_dropped_and_another_sweep_is_not_read() {
        let text = "key\na,1\nb,2\ndone 4\nc,3\ndone 0\nd,4\ndon";
        let chunks = finished_chunks(text, "key");
        assert_eq!(chunks.len(), 2);
        assert_eq!(chunks[&4], "a,1\nb,2\n");
        assert_eq!(chunks[&0], "c,3\n");
        assert!(finished_chunks(text, "other").is_empty());
        assert!(finished_chunks("key\na,1\ndone 1", "key").is_empty());
    }

    #[test]
    fn a_sweep_that_was_stopped_goes_on_where_it_was() {
        let folder = tempfile::tempdir().unwrap();
        let out = OutputFolder::open(folder.path()).unwrap();
        let line = |k: usize| Ok(format!("row {k}\n"));
        let journal = Journal::open(&out, "sweep", "key").unwrap();
        let none = journal.run(3, "chunks", Some(Duration::ZERO), line);
        assert_eq!(none.unwrap(), [None, None, None]);
        let two = Journal::open(&out, "sweep", "key").unwrap();
        two.run(2, "chunks", None, line).unwrap();
        let rest = Journal::open(&out, "sweep", "key").unwrap();
        let all = rest.run(3, "chunks", None, |k| {
            assert_eq!(k, 2, "finished chunks are not computed again");
            line(k)
        });
        let all: Vec<_> = all.unwrap().into_iter().flatten().collect();
        assert_eq!(all, ["row 0\n", "row 1\n", "row 2\n"]);
        rest.close().unwrap();
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
