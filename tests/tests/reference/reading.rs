//! The examples in the package's README.md read it.

use std::process::Command;

use super::*;

#[allow(dead_code, reason = "an example has a main function of its own")]
#[path = "../../../compare/examples/read_reference.rs"]
mod read_reference;

const PYTHON: &str = "../compare/examples/read_reference.py";

#[test]
fn the_example_in_rust_reads_a_load() {
    // Half the sum of the closed series of Stimson & Jeffery and Brenner (fixtures/contact_loads.csv).
    let (value, error) = read_reference::load(&folder(), 1.0, 0.1, "X11A")
        .unwrap()
        .unwrap();
    assert!((value - 4.032_098_875_535_8).abs() < error + 1e-12 && error < 1e-10);
    assert!(
        read_reference::load(&folder(), 1.0, 0.1, "X99Z")
            .unwrap()
            .is_none()
    );
    assert!(read_reference::load(Path::new("nowhere"), 1.0, 0.1, "X11A").is_err());
}

#[test]
fn the_example_in_python_reads_the_same_where_there_is_python() {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join(PYTHON);
    let started = Command::new("python3").arg(script).arg(folder()).output();
    let Ok(output) = started else {
        println!("no python3: not run");
        return;
    };
    assert!(output.status.success(), "{output:?}");
    let printed = String::from_utf8(output.stdout).unwrap();
    let (value, _) = read_reference::load(&folder(), 1.0, 0.1, "X11A")
        .unwrap()
        .unwrap();
    assert!(printed.contains(&value.to_string()), "{printed}");
}

#[test]
fn the_page_has_the_examples_as_they_are() {
    let page = text_of("README.md");
    for example in [
        include_str!("../../../compare/examples/read_reference.rs"),
        include_str!("../../../compare/examples/read_reference.py"),
    ] {
        assert!(page.contains(example));
    }
}
