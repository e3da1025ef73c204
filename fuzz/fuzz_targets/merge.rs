//! Shares of any content merge into exactly their rows, or are refused in one line. Nothing of them is changed, and what was merged merges again.
//!
//! In a manifest `LENGTH` and `CHECKSUM` stand for those of the rows beside it: no mutation would find them.

#![no_main]

use std::collections::BTreeMap;
use std::path::PathBuf;

use compare::OutputFolder;
use compare::sweep::{Manifest, merge};
use fuzz::{files, one_line};
use libfuzzer_sys::fuzz_target;

/// Names of the folders of the shares.
const SHARES: [&str; 4] = ["1", "2", "3", "4"];

fn filled(manifest: &[u8], rows: &[u8]) -> Vec<u8> {
    let checksum = format!("{:08x}", crc32fast::hash(rows));
    let text = String::from_utf8_lossy(manifest);
    let text = text.replace("CHECKSUM", &checksum);
    text.replace("LENGTH", &rows.len().to_string()).into_bytes()
}

fuzz_target!(|bytes: &[u8]| {
    let Ok(folder) = tempfile::tempdir() else {
        return;
    };
    let mut given: BTreeMap<PathBuf, Vec<u8>> = BTreeMap::new();
    for (name, text) in files(bytes) {
        // Nothing but the files of shares.
        let known = [Manifest::FILE, Manifest::ROWS[0], Manifest::ROWS[1]];
        if let Some((share, file)) = name.split_once('/')
            && SHARES.contains(&share)
            && known.contains(&file)
        {
            given.insert(folder.path().join(name), text.to_vec());
        }
    }
    let mut folders: Vec<PathBuf> = Vec::new();
    for path in given.keys() {
        if let Some(parent) = path.parent()
            && folders.last().is_none_or(|last| last != parent)
        {
            folders.push(parent.to_owned());
        }
    }
    for folder in &folders {
        std::fs::create_dir_all(folder).expect("a folder");
        let rows = |name: &str| given.get(&folder.join(name));
        let rows = rows(Manifest::ROWS[0]).or(rows(Manifest::ROWS[1]));
        let rows = rows.cloned().unwrap_or_default();
        if let Some(manifest) = given.get_mut(&folder.join(Manifest::FILE)) {
            *manifest = filled(manifest, &rows);
        }
    }
    for (path, text) in &given {
        std::fs::write(path, text).expect("a file");
    }
    let out = OutputFolder::open(&folder.path().join("out")).expect("a folder");
    match merge(&folders, &out) {
        Err(error) => {
            one_line(&error);
            assert!(!out.holds(Manifest::FILE), "a manifest of nothing");
        }
        Ok(merged) => {
            let whole = std::fs::read(out.path().join(&merged.file)).expect("rows");
            // In the order of their numbers, each but the first without its header.
            let mut shares: Vec<_> = (folders.iter())
                .map(|folder| (Manifest::read(folder).expect("a manifest"), folder))
                .collect();
            shares.sort_by_key(|(manifest, _)| manifest.share.number);
            let mut expected: Vec<u8> = Vec::new();
            for (_, folder) in shares {
                let rows = &given[&folder.join(&merged.file)];
                let header = rows.iter().position(|byte| *byte == b'\n');
                let after = header.map_or(rows.len(), |end| end + 1);
                let from = if expected.is_empty() { 0 } else { after };
                expected.extend(&rows[from..]);
            }
            assert_eq!(whole, expected);
            let again = OutputFolder::open(&folder.path().join("again")).expect("a folder");
            merge(&[out.path().to_owned()], &again).expect("what was merged merges again");
            let of_again = std::fs::read(again.path().join(&merged.file)).expect("rows");
            assert_eq!(whole, of_again);
        }
    }
    for (path, text) in &given {
        assert_eq!(&std::fs::read(path).expect("still there"), text);
    }
});
