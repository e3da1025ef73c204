//! Tables kept on disk.
//!
//! A file holds the CRC-32 of what follows, then a key (format, the model's fingerprint, the
//! table's options) and the table. A file that does not match in any of these is built again. It is
//! written aside and renamed, so that two processes at once leave one whole file.

use std::io::Write;
use std::path::Path;
use std::sync::Arc;

use serde::{Deserialize, Serialize};
use tempfile::NamedTempFile;

use super::{BuildProgress, Table, TableOptions, Tabulated};
use crate::{Hydrodynamics, SceneError};

/// Changes with the meaning of the stored table.
const FORMAT: &str = "table 7";

#[derive(Serialize, Deserialize)]
struct Kept {
    key: String,
    table: Table,
}

impl Tabulated {
    /// The table of `model` kept in `folder`, or else built as [`Self::build`] does and kept there.
    ///
    /// A folder that cannot be read or written only costs the keeping.
    ///
    /// # Errors
    /// As [`Self::build`].
    pub fn load_or_build(
        model: impl Hydrodynamics + 'static,
        options: TableOptions,
        folder: &Path,
        progress: &(dyn Fn(BuildProgress) + Sync),
    ) -> Result<Self, SceneError> {
        let key = format!("{FORMAT}; {}; {options:?}", model.fingerprint());
        let path = folder.join(format!("{:08x}.table", crc32fast::hash(key.as_bytes())));
        if let Some(table) = load(&path, &key) {
            let model = Arc::new(model);
            return Ok(Self { model, table });
        }
        let built = Self::build(model, options, progress)?;
        let kept = Kept {
            key,
            table: built.table.clone(),
        };
        // Without the file the next run builds the table again: nothing is lost but time.
        let _ = keep(&path, folder, &kept);
        Ok(built)
    }
}

fn load(path: &Path, key: &str) -> Option<Table> {
    let bytes = std::fs::read(path).ok()?;
    let (checksum, rest) = bytes.split_first_chunk::<4>()?;
    if u32::from_le_bytes(*checksum) != crc32fast::hash(rest) {
        return None;
    }
    let kept: Kept = postcard::from_bytes(rest).ok()?;
    (kept.key == key).then_some(kept.table)
}

fn keep(path: &Path, folder: &Path, kept: &Kept) -> std::io::Result<()> {
    let bytes = postcard::to_stdvec(kept).map_err(std::io::Error::other)?;
    std::fs::create_dir_all(folder)?;
    let mut file = NamedTempFile::new_in(folder)?;
    file.write_all(&crc32fast::hash(&bytes).to_le_bytes())?;
    file.write_all(&bytes)?;
    file.persist(path).map_err(|error| error.error)?;
    Ok(())
}
