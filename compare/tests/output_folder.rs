//! Folders for results: writes at once leave one whole file, and a folder that cannot be written is refused.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use compare::CompareError;
use compare::output::OutputFolder;

#[test]
fn writes_at_once_leave_one_whole_file() {
    let folder = tempfile::tempdir().unwrap();
    let out = OutputFolder::open(folder.path()).unwrap();
    let texts = [1, 2, 3, 4].map(|writer| format!("a,b\n{writer},{writer}\n").repeat(10_000));
    std::thread::scope(|scope| {
        for text in &texts {
            scope.spawn(|| {
                for _ in 0..10 {
                    out.write("shared.csv", text).unwrap();
                    let read = out.read("shared.csv").unwrap();
                    assert!(texts.contains(&read), "a file is torn");
                }
            });
        }
    });
    let left: Vec<_> = (std::fs::read_dir(folder.path()).unwrap())
        .map(|entry| entry.unwrap().file_name())
        .collect();
    assert_eq!(left, ["shared.csv"]);
}

#[test]
fn a_folder_that_cannot_be_written_is_refused() {
    // Not even the superuser can make a folder below a file.
    let file = tempfile::NamedTempFile::new().unwrap();
    let below = file.path().join("out");
    for refused in [
        OutputFolder::open(&below),
        OutputFolder::open_beside_others(&below),
    ] {
        assert!(
            matches!(&refused, Err(CompareError::Write { path, .. }) if *path == below),
            "{refused:?}"
        );
    }
}
