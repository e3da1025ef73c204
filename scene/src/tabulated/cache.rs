//! Tables kept on disk, a file for each group of columns.
//!
//! A file holds the CRC-32 of what follows, then a key (format, the model's fingerprint, tolerance and smallest gap, the
//! group) and the columns. A file that does not match in any of these is built again. It is
//! written aside and renamed, so that two processes at once leave one whole file.

use std::io::Write;
use std::path::Path;
use std::sync::Arc;

use serde::{Deserialize, Serialize};
use tempfile::NamedTempFile;

use super::build::{Layout, Tabulation, tabulate};
use super::columns::Group;
use super::parts::DEGREE;
use super::tally::Tally;
use super::{BuildProgress, TableOptions, Tabulated};
use crate::{Hydrodynamics, SceneError};

/// Changes with the meaning of what is stored.
const FORMAT: &str = "mobilities 3";

#[derive(Serialize, Deserialize)]
struct Kept {
    key: String,
    tabulation: Tabulation,
}

impl Tabulated {
    /// The table of `model` from the groups of columns kept in `folder`; those that are not there are built as [`Self::build`] does
    /// and kept there.
    ///
    /// A folder that cannot be read or written only costs the keeping.
    ///
    /// # Errors
    /// As [`Self::build`].
    pub fn load_or_build(
        model: Arc<dyn Hydrodynamics>,
        options: TableOptions,
        folder: &Path,
        progress: &(dyn Fn(BuildProgress) + Sync),
    ) -> Result<Self, SceneError> {
        let layout = Layout::of(model.as_ref(), &options)?;
        let TableOptions {
            tolerance,
            smallest_gap,
            ..
        } = options;
        let fingerprint = model.fingerprint();
        let place = |group: Group| {
            let key = format!(
                "{FORMAT}, degree {DEGREE}; {fingerprint}; {tolerance:e}; {smallest_gap:e}; {group:?}"
            );
            let path = folder.join(format!("{:08x}.table", crc32fast::hash(key.as_bytes())));
            (path, key)
        };
        let (mut all, mut missing) = (Vec::new(), Vec::new());
        for group in Group::of(options.set, model.has_unlike_radii()) {
            let (path, key) = place(group);
            let kept = load(&path, &key);
            match kept.filter(|kept| kept.stretches.len() == layout.stretches.len()) {
                Some(tabulation) => all.push((group, tabulation)),
                None => missing.push(group),
            }
        }
        if !missing.is_empty() {
            let tally = Tally::new(progress);
            for (group, tabulation) in
                tabulate(model.as_ref(), &missing, &options, &layout, &tally)?
            {
                let (path, key) = place(group);
                let kept = Kept { key, tabulation };
                // Without the file the next run builds the columns again: nothing is lost but time.
                let _ = keep(&path, folder, &kept);
                all.push((group, kept.tabulation));
            }
        }
        Self::new(model, &options, &layout, all)
    }
}

fn load(path: &Path, key: &str) -> Option<Tabulation> {
    let bytes = std::fs::read(path).ok()?;
    let (checksum, rest) = bytes.split_first_chunk::<4>()?;
    if u32::from_le_bytes(*checksum) != crc32fast::hash(rest) {
        return None;
    }
    let kept: Kept = postcard::from_bytes(rest).ok()?;
    (kept.key == key).then_some(kept.tabulation)
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
