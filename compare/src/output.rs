//! Files: written aside and renamed, so that nothing is ever half-written.

use std::io::Write;
use std::path::{Path, PathBuf};

use serde::Serialize;
use tempfile::NamedTempFile;

use crate::CompareError;

/// The folder that a command writes into.
#[derive(Clone, Debug)]
pub struct OutputFolder(PathBuf);

impl OutputFolder {
    /// Creates the folder if need be and makes sure that it can be written to.
    ///
    /// # Errors
    /// [`CompareError::Write`] if it cannot.
    pub fn open(path: &Path) -> Result<Self, CompareError> {
        let failed = |source| CompareError::Write {
            path: path.to_owned(),
            source,
        };
        std::fs::create_dir_all(path).map_err(failed)?;
        NamedTempFile::new_in(path).map_err(failed)?;
        Ok(Self(path.to_owned()))
    }

    /// Text of the file `name`, if an earlier command left it here.
    #[must_use]
    pub fn read(&self, name: &str) -> Option<String> {
        std::fs::read_to_string(self.0.join(name)).ok()
    }

    /// Where it is.
    pub(crate) fn path(&self) -> &Path {
        &self.0
    }

    /// Writes `text` to the file `name`.
    ///
    /// # Errors
    /// [`CompareError::Write`].
    pub fn write(&self, name: &str, text: &str) -> Result<PathBuf, CompareError> {
        let path = self.0.join(name);
        let failed = |source| CompareError::Write {
            path: path.clone(),
            source,
        };
        let mut file = NamedTempFile::new_in(&self.0).map_err(failed)?;
        file.write_all(text.as_bytes()).map_err(failed)?;
        // Temporary files are private; results are for everybody whom the folder lets in.
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            let open = std::fs::Permissions::from_mode(0o644);
            file.as_file().set_permissions(open).map_err(failed)?;
        }
        file.persist(&path).map_err(|error| failed(error.error))?;
        Ok(path)
    }
}

/// Rows as CSV text with a header.
///
/// # Errors
/// [`CompareError::Rows`] if a row cannot be a line.
pub fn csv_text<T: Serialize>(rows: &[T]) -> Result<String, CompareError> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer.serialize(row)?;
    }
    let bytes = writer
        .into_inner()
        .map_err(|error| csv::Error::from(error.into_error()))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}
