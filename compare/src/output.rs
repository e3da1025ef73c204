//! Writes files: first under a temporary name, then renamed, so that no file is ever half-written.

use std::collections::HashSet;
use std::fs::{File, TryLockError};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use serde::Serialize;
use serde::de::DeserializeOwned;
use tempfile::{NamedTempFile, TempDir};

use crate::CompareError;
use crate::account::Account;
use crate::columns::{self, Columns};
use crate::watch::notice;

/// The folder that a command writes into. No other command writes into it meanwhile.
#[derive(Clone, Debug)]
pub struct OutputFolder {
    path: PathBuf,
    /// The locked folder. The system unlocks it when the process ends, even after a crash.
    _lock: Option<Arc<File>>,
    fresh: bool,
    /// The folder, if it is deleted with the last of these values.
    temporary: Option<Arc<TempDir>>,
    account: Arc<Account>,
    /// Part files that this command continues.
    parts: Arc<Mutex<HashSet<String>>>,
}

/// Which other commands may write into a folder at the same time.
#[derive(Clone, Copy, PartialEq)]
enum Others {
    /// No other command.
    None,
    /// Commands that only write whole files and read none.
    Alike,
}

impl OutputFolder {
    /// Creates the folder if it does not exist, checks that it can be written to, and locks it.
    ///
    /// # Errors
    /// [`CompareError::Write`] if the folder cannot be written to; [`CompareError::Busy`] if another process writes
    /// there.
    pub fn open(path: &Path) -> Result<Self, CompareError> {
        Self::claim(path, Others::None)
    }

    /// As [`Self::open`], for a command that only writes whole files. Several such commands may run at once.
    pub fn open_beside_others(path: &Path) -> Result<Self, CompareError> {
        Self::claim(path, Others::Alike)
    }

    /// A folder of its own, which is deleted at the end: an interrupted sweep keeps nothing in it.
    ///
    /// # Errors
    /// [`CompareError::Write`] if no folder can be made.
    pub fn temporary() -> Result<Self, CompareError> {
        let folder = TempDir::with_prefix("squirmers-").map_err(|source| CompareError::Write {
            path: std::env::temp_dir(),
            source,
        })?;
        let open = Self::open(folder.path())?;
        Ok(Self {
            temporary: Some(Arc::new(folder)),
            ..open
        })
    }

    /// Whether what is written remains.
    pub fn is_kept(&self) -> bool {
        self.temporary.is_none()
    }

    fn claim(path: &Path, others: Others) -> Result<Self, CompareError> {
        let failed = |source| CompareError::Write {
            path: path.to_owned(),
            source,
        };
        std::fs::create_dir_all(path).map_err(failed)?;
        let lock = lock(path, others)?;
        NamedTempFile::new_in(path).map_err(failed)?;
        Ok(Self {
            path: path.to_owned(),
            _lock: lock.map(Arc::new),
            fresh: false,
            temporary: None,
            account: Arc::default(),
            parts: Arc::default(),
        })
    }

    /// Sets whether this command may delete the results of an interrupted command.
    pub fn fresh(self, fresh: bool) -> Self {
        Self { fresh, ..self }
    }

    /// Whether this command may delete the results of an interrupted command.
    pub fn is_fresh(&self) -> bool {
        self.fresh
    }

    /// Counts of the runs so far, and of those without a result.
    pub fn account(&self) -> &Account {
        &self.account
    }

    /// Declares that this command continues the part file `name`.
    pub fn takes(&self, part: String) {
        let mut parts = self.parts.lock().unwrap_or_else(PoisonError::into_inner);
        parts.insert(part);
    }

    /// Text of the file `name`, if an earlier command wrote it.
    #[must_use]
    pub fn read(&self, name: &str) -> Option<String> {
        std::fs::read_to_string(self.path.join(name)).ok()
    }

    /// Path of the folder.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Whether the file `name` exists.
    pub fn holds(&self, name: &str) -> bool {
        self.path.join(name).exists()
    }

    /// Deletes the file `name` of an earlier command, if there is one, and reports it.
    pub fn remove(&self, name: &str) -> Result<(), CompareError> {
        if self.holds(name) {
            let removed = std::fs::remove_file(self.path.join(name));
            removed.map_err(|source| self.failed(name, source))?;
            notice!(
                "'{name}' of an earlier command is deleted: it would not agree with the new results"
            );
        }
        Ok(())
    }

    /// Writes `text` to the file `name`, then deletes its part file if this command continued one.
    ///
    /// # Errors
    /// [`CompareError::Write`].
    pub fn write(&self, name: &str, text: &str) -> Result<PathBuf, CompareError> {
        let path = self.write_by(name, |file| {
            let written = file.write_all(text.as_bytes());
            written.map_err(|source| self.failed(name, source))
        })?;
        let part = part_of(name);
        let mut parts = self.parts.lock().unwrap_or_else(PoisonError::into_inner);
        if parts.remove(&part) && self.holds(&part) {
            let removed = std::fs::remove_file(self.path.join(&part));
            removed.map_err(|source| self.failed(&part, source))?;
        }
        Ok(path)
    }

    /// As [`Self::write`], but keeps the file of an earlier command if the time limit left out something of this one.
    ///
    /// # Errors
    /// [`CompareError::Write`].
    pub fn write_unless_less(&self, name: &str, text: &str) -> Result<(), CompareError> {
        if self.account.stopped() && self.holds(name) {
            notice!("'{name}' of an earlier command is not changed: it may hold more");
        } else {
            self.write(name, text)?;
        }
        Ok(())
    }

    /// Writes the file `name`. The function `fill` writes its text piece by piece.
    pub fn write_by<E: From<CompareError>>(
        &self,
        name: &str,
        fill: impl FnOnce(&mut dyn Write) -> Result<(), E>,
    ) -> Result<PathBuf, E> {
        let failed = |source| self.failed(name, source);
        let mut file = BufWriter::new(self.aside(name)?);
        fill(&mut file)?;
        let file = file
            .into_inner()
            .map_err(|error| failed(error.into_error()))?;
        let path = self.path.join(name);
        file.persist(&path).map_err(|error| failed(error.error))?;
        Ok(path)
    }

    /// A temporary file that can be renamed to `name`; otherwise it is deleted.
    pub fn aside(&self, name: &str) -> Result<NamedTempFile, CompareError> {
        let failed = |source| self.failed(name, source);
        let file = NamedTempFile::new_in(&self.path).map_err(failed)?;
        // Temporary files are private; everybody who can open the folder may read results.
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            let open = std::fs::Permissions::from_mode(0o644);
            file.as_file().set_permissions(open).map_err(failed)?;
        }
        Ok(file)
    }

    /// The error that the file `name` cannot be written.
    pub fn failed(&self, name: &str, source: std::io::Error) -> CompareError {
        let path = self.path.join(name);
        CompareError::Write { path, source }
    }
}

/// Name of the part file, which keeps the rows of the file `name` until all are computed.
pub fn part_of(name: &str) -> String {
    format!("{name}.part")
}

/// Locks a folder. Returns `None` if the system can't open folders or the file system has no locks.
fn lock(path: &Path, others: Others) -> Result<Option<File>, CompareError> {
    let Ok(folder) = File::open(path) else {
        return Ok(None);
    };
    let locked = match others {
        Others::None => folder.try_lock(),
        Others::Alike => folder.try_lock_shared(),
    };
    match locked {
        Ok(()) => Ok(Some(folder)),
        Err(TryLockError::WouldBlock) => Err(CompareError::Busy {
            path: path.to_owned(),
        }),
        Err(TryLockError::Error(_)) => Ok(None),
    }
}

/// Rows as CSV text with a header.
///
/// # Errors
/// [`CompareError::Rows`] if a row cannot be written as a line.
pub fn csv_text<R: Serialize + Columns>(rows: &[R]) -> Result<String, CompareError> {
    Ok(format!("{}\n{}", columns::header::<R>(), csv_lines(rows)?))
}

/// Rows as CSV lines without a header.
pub fn csv_lines<T: Serialize>(rows: &[T]) -> Result<String, CompareError> {
    let mut writer = csv::WriterBuilder::new()
        .has_headers(false)
        .from_writer(Vec::new());
    for row in rows {
        writer.serialize(row)?;
    }
    let bytes = (writer.into_inner()).map_err(|error| csv::Error::from(error.into_error()))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// Rows from CSV lines without a header.
pub fn rows_of<T: DeserializeOwned>(lines: &str) -> Result<Vec<T>, CompareError> {
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .from_reader(lines.as_bytes());
    reader
        .deserialize()
        .map(|row| row.map_err(CompareError::from))
        .collect()
}
