//! Torn files and shared folders.

use std::path::Path;

use bem::Bem;
use scene::{Gap, Hydrodynamics, LoadSet, TableOptions, Tabulated};

use super::Rows;
use super::machine::ALL;
use crate::output::OutputFolder;
use crate::{CompareError, Method};

/// A table that is quick to build.
const QUICK: TableOptions = TableOptions {
    set: LoadSet::axial(1),
    tolerance: 1e-2,
    smallest_gap: 0.3,
};

fn table(folder: &Path) -> Result<Tabulated<Bem>, CompareError> {
    Ok(Tabulated::load_or_build(
        Bem::new(1)?,
        QUICK,
        folder,
        &|_| {},
    )?)
}

/// Loads at some gaps, bit by bit.
pub(super) fn bits(model: &dyn Hydrodynamics, set: LoadSet) -> Result<Vec<u64>, CompareError> {
    let mut bits = Vec::new();
    for k in 0..20 {
        let gap = Gap::from_ln(0.35_f64.ln() + 0.4 * f64::from(k));
        bits.extend(model.loads(gap, set)?.columns().map(f64::to_bits));
    }
    Ok(bits)
}

pub(super) fn temporary() -> Result<tempfile::TempDir, CompareError> {
    tempfile::tempdir().map_err(|source| CompareError::Write {
        path: std::env::temp_dir(),
        source,
    })
}

/// The only file in a folder, if there is only one.
fn only_file(folder: &Path) -> Option<std::path::PathBuf> {
    let mut entries = std::fs::read_dir(folder).ok()?;
    let first = entries.next()?.ok()?.path();
    entries.next().is_none().then_some(first)
}

/// A kept table cut short, emptied, or with a bit turned over is built again, with the same bits.
pub(super) fn damaged_tables(rows: &mut Rows) -> Result<(), CompareError> {
    let folder = temporary()?;
    let truth = bits(&table(folder.path())?, QUICK.set)?;
    let path = only_file(folder.path()).unwrap_or_default();
    let whole = std::fs::read(&path).unwrap_or_default();
    let turned = |at: usize| {
        let mut bytes = whole.clone();
        if let Some(byte) = bytes.get_mut(at) {
            *byte ^= 1;
        }
        bytes
    };
    let length = whole.len();
    let damages = [
        Vec::new(),
        whole[..length.min(3)].to_vec(),
        whole[..length / 2].to_vec(),
        whole[..length.saturating_sub(1)].to_vec(),
        turned(0),
        turned(length / 2),
        turned(length.saturating_sub(1)),
        vec![0xff; length],
    ];
    let (mut other, mut left) = (0, 0);
    for damaged in &damages {
        let failed = |source| CompareError::Write {
            path: path.clone(),
            source,
        };
        std::fs::write(&path, damaged).map_err(failed)?;
        other += usize::from(bits(&table(folder.path())?, QUICK.set)? != truth);
        left += usize::from(std::fs::read(&path).ok().as_ref() != Some(&whole));
    }
    let name = Method::Bem.name();
    let count = damages.len();
    let empty = f64::from(u8::from(whole.is_empty()));
    rows.add(
        name,
        format!("of {count} damages to a kept table: those that change a load"),
        (0.0, "a checksum over the whole file"),
        other as f64 + empty,
    );
    rows.add(
        name,
        format!("of {count} damages to a kept table: those not mended on disk"),
        (0.0, "what is built again is kept again"),
        left as f64 + empty,
    );
    Ok(())
}

/// Four at once on one cache folder and one output folder; then folders that cannot be written.
pub(super) fn shared_folders(rows: &mut Rows) -> Result<(), CompareError> {
    let name = Method::Bem.name();
    let (cache, alone) = (temporary()?, temporary()?);
    let truth = bits(&table(alone.path())?, QUICK.set)?;
    let out = OutputFolder::open(cache.path().join("out").as_path())?;
    let tables = cache.path().join("tables");
    let text = "a,b\n1,2\n".repeat(10_000);
    let results: Vec<_> = std::thread::scope(|scope| {
        let work = || -> Result<bool, CompareError> {
            out.write("shared.csv", &text)?;
            // On a pool of its own: the caller may be the only thread of the common one, and waits.
            Ok(super::pool(1)?.install(|| bits(&table(&tables)?, QUICK.set))? == truth)
        };
        let threads: Vec<_> = (0..4).map(|_| scope.spawn(work)).collect();
        threads
            .into_iter()
            .map(std::thread::ScopedJoinHandle::join)
            .collect()
    });
    let failed = results
        .iter()
        .filter(|result| !matches!(result, Ok(Ok(true))))
        .count();
    rows.add(
        name,
        "of 4 at once on one cache and one output folder: those that fail or differ",
        (0.0, "files are written aside and renamed"),
        failed as f64,
    );
    let kept = only_file(&tables).and_then(|path| std::fs::read(path).ok());
    let expected = only_file(alone.path()).and_then(|path| std::fs::read(path).ok());
    let whole =
        kept.is_some() && kept == expected && out.read("shared.csv").as_ref() == Some(&text);
    rows.add(
        name,
        "files left other than one whole table and one whole CSV",
        (0.0, "files are written aside and renamed"),
        f64::from(u8::from(!whole)),
    );
    // Not even the superuser can make a folder below a file.
    let below = alone.path().join("file");
    std::fs::write(&below, "").map_err(|source| CompareError::Write {
        path: below.clone(),
        source,
    })?;
    let refused = matches!(
        OutputFolder::open(&below.join("out")),
        Err(CompareError::Write { .. })
    );
    rows.add(
        ALL,
        "output folders that cannot be written and are not refused",
        (0.0, "tried before anything is computed"),
        f64::from(u8::from(!refused)),
    );
    let built = bits(&table(&below.join("tables"))?, QUICK.set)? == truth;
    rows.add(
        name,
        "tables lost to a cache folder that cannot be written",
        (0.0, "the cache only saves time"),
        f64::from(u8::from(!built)),
    );
    Ok(())
}
