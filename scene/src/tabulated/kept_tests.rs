//! Tables kept on disk: a kept table serves again only if it is whole and fits.

use std::sync::Arc;

use std::path::{Path, PathBuf};

use super::*;
use crate::made::Made;

/// A table of one group of columns, and whether it was built.
fn cached(model: Made, folder: &Path) -> (Tabulated, bool) {
    cached_of(LoadSet::axial(2).mirror_symmetric(), model, folder)
}

fn cached_of(set: LoadSet, model: Made, folder: &Path) -> (Tabulated, bool) {
    let options = TableOptions {
        set,
        tolerance: 1e-8,
        smallest_gap: 1e-3,
    };
    let solved = std::sync::atomic::AtomicBool::new(false);
    let progress = |_| solved.store(true, std::sync::atomic::Ordering::Relaxed);
    let table = Tabulated::load_or_build(Arc::new(model), options, folder, &progress).unwrap();
    (table, solved.into_inner())
}

/// The only file in a folder.
fn only_file(folder: &Path) -> PathBuf {
    let mut entries = std::fs::read_dir(folder).unwrap();
    let only = entries.next().unwrap().unwrap().path();
    assert!(entries.next().is_none(), "there are other files");
    only
}

const QUIET: Made = Made {
    seam: Some(0.3),
    noise: 1e-14,
};

#[test]
fn a_kept_table_serves_again_bit_for_bit() {
    let folder = tempfile::tempdir().unwrap();
    let (built, solved) = cached(QUIET, folder.path());
    assert!(solved);
    let (loaded, solved) = cached(QUIET, folder.path());
    assert!(!solved);
    assert_eq!(built.columns, loaded.columns);
}

#[test]
fn a_kept_table_of_another_model_does_not_serve() {
    let folder = tempfile::tempdir().unwrap();
    cached(QUIET, folder.path());
    let other = Made {
        seam: Some(0.2),
        ..QUIET
    };
    assert!(cached(other, folder.path()).1);
    assert!(!cached(QUIET, folder.path()).1, "both are kept");
}

#[test]
fn a_damaged_table_is_built_again_and_kept_again() {
    let folder = tempfile::tempdir().unwrap();
    let (built, _) = cached(QUIET, folder.path());
    let path = only_file(folder.path());
    let whole = std::fs::read(&path).unwrap();
    let length = whole.len();
    let flipped = |at: usize| {
        let mut bytes = whole.clone();
        bytes[at] ^= 1;
        bytes
    };
    for damaged in [
        Vec::new(),
        whole[..3].to_vec(),
        whole[..length / 2].to_vec(),
        whole[..length - 1].to_vec(),
        flipped(0),
        flipped(length / 2),
        flipped(length - 1),
        vec![0xff; length],
    ] {
        std::fs::write(&path, damaged).unwrap();
        let (again, solved) = cached(QUIET, folder.path());
        assert!(solved);
        assert_eq!(again.columns, built.columns);
        assert_eq!(std::fs::read(&path).unwrap(), whole);
    }
}

#[test]
fn tables_kept_in_one_folder_at_once_are_equal_and_leave_one_whole_file() {
    let (alone, shared) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let (built, _) = cached(QUIET, alone.path());
    let folder = shared.path().join("made by the first");
    std::thread::scope(|scope| {
        let threads = [(); 4].map(|()| scope.spawn(|| cached(QUIET, &folder).0));
        for thread in threads {
            assert_eq!(thread.join().unwrap().columns, built.columns);
        }
    });
    let [kept, expected] = [&folder, alone.path()].map(|at| std::fs::read(only_file(at)).unwrap());
    assert_eq!(kept, expected);
}

#[test]
fn a_folder_that_cannot_be_written_costs_only_the_keeping() {
    let (file, folder) = (
        tempfile::NamedTempFile::new().unwrap(),
        tempfile::tempdir().unwrap(),
    );
    // Not even the superuser can make a folder below a file.
    let (built, solved) = cached(QUIET, &file.path().join("below"));
    assert!(solved);
    assert_eq!(built.columns, cached(QUIET, folder.path()).0.columns);
}

#[test]
fn no_scene_builds_what_another_has_built_nor_is_its_answer_another_one_for_it() {
    let (one, other) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let sets = [
        LoadSet::axial(1).mirror_symmetric(),
        LoadSet::planar(2).point_symmetric(),
        LoadSet::planar(1),
        LoadSet::all(3),
        LoadSet::all(2).with_swirl(1),
    ];
    let tables = |sets: &mut dyn Iterator<Item = LoadSet>, folder: &Path| -> Vec<_> {
        sets.map(|set| (set, cached_of(set, QUIET, folder).0))
            .collect()
    };
    let upwards = tables(&mut sets.into_iter(), one.path());
    let mut downwards = tables(&mut sets.into_iter().rev(), other.path());
    downwards.reverse();
    for ((set, table), (_, same)) in upwards.iter().zip(&downwards) {
        assert_eq!(table.columns, same.columns, "{set}");
        assert_eq!(table.columns, cached_of(*set, QUIET, one.path()).0.columns);
    }
    for set in [
        LoadSet::planar(2),
        LoadSet::axial(2),
        LoadSet::planar(3).mirror_symmetric(),
    ] {
        assert!(!cached_of(set, QUIET, one.path()).1, "{set} is built again");
    }
    assert!(cached_of(LoadSet::axial(4), QUIET, one.path()).1);
}
