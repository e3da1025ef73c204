//! Every CSV file has the columns that docs/COLUMNS.md describes.

use super::*;
use compare::columns::{FILES, names};

/// Names of the CSV files that the list of columns ascribes to a command.
pub fn listed(command: &str) -> Vec<&'static str> {
    let files = FILES.iter().filter(|file| file.commands.contains(&command));
    let mut names: Vec<_> = files.map(|file| file.name).collect();
    names.sort_unstable();
    names
}

/// Compares the header of each CSV file in `out` with the list of columns, and returns the names of the files.
pub fn described(out: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(out).unwrap();
    let mut files: Vec<_> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.ends_with(".csv"))
        .collect();
    files.sort();
    for name in &files {
        let file = FILES.iter().find(|file| file.name == *name);
        let file = file.unwrap_or_else(|| panic!("'{name}' is not in the list of columns"));
        let mut expected = names(file.columns);
        // Rows of families begin with the parameters that are varied.
        match name.as_str() {
            "sweep.csv" => expected.insert(0, "dx"),
            "sensitivity.csv" | "sensitivity-derivatives.csv" => {
                expected.splice(0..0, ["case", "beta", "dx"]);
            }
            _ => {}
        }
        let mut reader = csv::Reader::from_path(out.join(name)).unwrap();
        assert_eq!(*reader.headers().unwrap(), expected, "{name}");
    }
    files
}

#[test]
fn every_csv_file_of_a_command_is_listed_with_its_columns() {
    let fixtures = concat!(env!("CARGO_MANIFEST_DIR"), "/../fixtures");
    let scene = format!("{fixtures}/scenes/fig6-head-on-dx1.toml");
    let peer = format!("a={fixtures}/peers/pystokes.csv");
    for arguments in [
        "loads --gap 1 --method lt",
        "head-on --dx 1 --method lt",
        "orthogonal --dx 1 --method lt",
        "offset --dz 0.5 --method lt",
        "scatter --beta 5 --grid 4 --method lt",
        "fates --beta 5 --grid 4 --method lt",
        "trust --beta 5 --grid 4 --method lt-corrected,exact",
        "bottom-heavy --method lt",
        "run SCENE",
        "sweep opposed --vary dx=1 --method lt",
        "sensitivity opposed --vary beta=5 --vary dx=1 --method lt",
        "collisions --count 16 --method lt",
        "kinetics --beta 5 --count 16 --replications 2 --method lt",
        "growth --beta 5 --grid 4 --method lt",
        "hard-cases --only no-repulsion",
        "judge a=PEER --grid 0",
    ] {
        let folder = tempfile::tempdir().unwrap();
        let arguments: Vec<_> = (arguments.split(' '))
            .map(|word| match word {
                "SCENE" => &*scene,
                "a=PEER" => &*peer,
                word => word,
            })
            .collect();
        let output = squirmers(folder.path(), &arguments);
        assert!(output.status.success(), "{output:?}");
        assert_eq!(described(folder.path()), listed(arguments[0]));
    }
}

#[test]
fn each_form_of_stress_writes_a_listed_file() {
    let scene = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../fixtures/scenes/fig6-head-on-dx1.toml"
    );
    let forms: [(&[&str], &str); 3] = [
        (&["--gap", "1"], "stress.csv"),
        (&[scene], "stress-run.csv"),
        (&["--paper"], "stress-encounters.csv"),
    ];
    for (form, file) in forms {
        let folder = tempfile::tempdir().unwrap();
        let arguments = [&["stress", "--method", "exact"], form].concat();
        let output = squirmers(folder.path(), &arguments);
        assert!(output.status.success(), "{output:?}");
        assert_eq!(described(folder.path()), [file]);
        assert!(listed("stress").contains(&file));
    }
}

#[test]
fn the_list_of_columns_names_commands_that_exist() {
    for command in FILES.iter().flat_map(|file| file.commands) {
        let output = Command::new(env!("CARGO_BIN_EXE_squirmers"))
            .args([command, "--help"])
            .output()
            .unwrap();
        assert!(output.status.success(), "{command}");
    }
}
