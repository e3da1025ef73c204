//! A table whose files are damaged is built again: it has the same bits as a whole one. A file with wrong content and a right checksum, which no damage
//! makes, does not bring the program down.

#![no_main]

use std::path::PathBuf;
use std::sync::{Arc, LazyLock};

use arbitrary::Arbitrary;
use fuzz::one_line;
use libfuzzer_sys::fuzz_target;
use lt::{Form, Lubrication, UnlikeLubrication};
use scene::mobility::{Mobility, MobilitySet};
use scene::{Gap, Hydrodynamics, LoadSet, TableOptions, Tabulated};
use tempfile::TempDir;

/// Gaps at which tables are asked.
const GAPS: [f64; 5] = [0.011, 0.1, 0.5, 1.5, 30.0];

#[derive(Arbitrary, Debug)]
struct Input<'a> {
    unlike: bool,
    file: u8,
    /// Where bytes are replaced, and by what.
    edits: Vec<(u16, u8)>,
    /// What is left of the file.
    length: Option<u16>,
    /// What is behind it.
    more: &'a [u8],
    checksum: bool,
}

/// A whole table, and the files that it was kept in.
struct Whole {
    model: Arc<dyn Hydrodynamics>,
    answers: Vec<String>,
    files: Vec<(PathBuf, Vec<u8>)>,
}

/// Coarse, so that a case costs little.
const OPTIONS: TableOptions = TableOptions {
    set: LoadSet::all(2),
    tolerance: 1e-2,
    smallest_gap: 1e-2,
};

fn table(model: &Arc<dyn Hydrodynamics>, folder: &TempDir) -> Result<Tabulated, scene::SceneError> {
    Tabulated::load_or_build(model.clone(), OPTIONS, folder.path(), &|_| {})
}

/// All bits of a table's answers.
fn answers(table: &Tabulated) -> Vec<String> {
    let set = MobilitySet {
        loads: OPTIONS.set,
        torque: true,
    };
    (GAPS.iter())
        .map(|eps| {
            let gap = Gap::new(*eps).expect("a gap");
            if table.has_unlike_radii() {
                format!("{:?}", table.interacting_mobility_of_each(gap, set))
            } else {
                let mobility: Result<Mobility, _> = table.mobility(gap, set);
                format!("{mobility:?}")
            }
        })
        .collect()
}

fn whole(model: Arc<dyn Hydrodynamics>) -> Whole {
    let folder = tempfile::tempdir().expect("a folder");
    let built = table(&model, &folder).expect("a table");
    let mut files: Vec<_> = (std::fs::read_dir(folder.path()).expect("files"))
        .map(|entry| {
            let path = entry.expect("a file").path();
            let bytes = std::fs::read(&path).expect("a file");
            (PathBuf::from(path.file_name().expect("a name")), bytes)
        })
        .collect();
    files.sort();
    Whole {
        answers: answers(&built),
        model,
        files,
    }
}

static WHOLE: LazyLock<[Whole; 2]> = LazyLock::new(|| {
    let unlike = UnlikeLubrication::new(Form::Corrected, 2.0).expect("a ratio");
    [
        whole(Arc::new(Lubrication::new(Form::Corrected))),
        whole(Arc::new(unlike)),
    ]
});

fuzz_target!(|input: Input<'_>| {
    let whole = &WHOLE[usize::from(input.unlike)];
    let folder = tempfile::tempdir().expect("a folder");
    let damaged = usize::from(input.file) % whole.files.len();
    for (index, (name, bytes)) in whole.files.iter().enumerate() {
        let mut bytes = bytes.clone();
        if index == damaged {
            for (at, byte) in &input.edits {
                if let Some(place) = bytes.get_mut(usize::from(*at)) {
                    *place = *byte;
                }
            }
            bytes.truncate(input.length.map_or(usize::MAX, usize::from));
            bytes.extend(input.more);
            if input.checksum
                && let Some((first, rest)) = bytes.split_first_chunk_mut::<4>()
            {
                *first = crc32fast::hash(rest).to_le_bytes();
            }
        }
        std::fs::write(folder.path().join(name), bytes).expect("a file");
    }
    match table(&whole.model, &folder) {
        Ok(table) => {
            let found = answers(&table);
            if !input.checksum {
                assert_eq!(found, whole.answers);
            }
        }
        Err(error) => one_line(&error),
    }
});
