//! The pages of the package: `README.md`, `CITATION.cff` and `LICENSE`.

use std::fmt::Write as _;

use super::package::{AUTHORS, LICENSES, PACKAGE, SOURCES, TITLE, VERSION};
use super::{DESCRIPTOR, Resource, SHARES_GRID};

/// The pages with their names.
pub(super) fn pages(resources: &[Resource]) -> [(String, String); 3] {
    [
        ("README.md".to_owned(), readme(resources)),
        ("CITATION.cff".to_owned(), citation()),
        ("LICENSE".to_owned(), license()),
    ]
}

const DEFINITIONS: &str = include_str!("definitions.md");

const RUST: &str = include_str!("../../examples/read_reference.rs");

const PYTHON: &str = include_str!("../../examples/read_reference.py");

fn readme(resources: &[Resource]) -> String {
    let mut page = format!(
        "# {TITLE}\n\n\
         Version {VERSION}, written by `squirmers reference`; every file is made by the program and is the same each time. Numbers are by an \
         exact series, and are printed down to the last digit that their error leaves: a column `error...` says how far the printed number \
         may be off. `{DESCRIPTOR}` describes every column in a form that programs read, with checksums. `CITATION.cff` says how to cite the package.\n\n\
         | file | what | rows |\n|---|---|---:|\n"
    );
    for of in resources {
        let rows = of.text.lines().count() - 1;
        let _ = writeln!(page, "| `{}` | {} | {rows} |", of.path(), of.title);
    }
    let definitions = DEFINITIONS.replace("{SHARES_GRID}", &SHARES_GRID.to_string());
    let _ = write!(page, "\n{definitions}");
    let _ = write!(
        page,
        "\n## To read it\n\nIn Python, with its standard library alone (`pandas.read_csv(\"loads.csv\")` reads a file as well):\n\n\
         ```python\n{PYTHON}```\n\nIn Rust, with its standard library alone:\n\n```rust\n{RUST}```\n"
    );
    for of in resources {
        let _ = writeln!(
            page,
            "\n## {}\n\n{}\n\n| column | unit | meaning |\n|---|---|---|",
            of.path(),
            of.about
        );
        for column in of.columns {
            let _ = writeln!(
                page,
                "| `{}` | `{}` | {} |",
                column.name, column.unit, column.doc
            );
        }
    }
    let _ = writeln!(page, "\n## Sources\n");
    for (title, address) in SOURCES {
        let address = address.map_or(String::new(), |address| format!(", <{address}>"));
        let _ = writeln!(page, "- {title}{address}");
    }
    page
}

fn citation() -> String {
    let licenses: Vec<_> = (LICENSES.iter())
        .map(|[name, ..]| format!("  - {name}\n"))
        .collect();
    format!(
        "cff-version: 1.2.0\n\
         message: If you use these numbers, please cite the package with its version.\n\
         title: {TITLE}\n\
         abstract: >-\n  \
           Exact loads, coefficients of motion, deflections, bound states and shares of outcomes of two squirming spheres, each\n  \
           with its error.\n\
         type: dataset\n\
         version: {VERSION}\n\
         license:\n{}\
         authors:\n  - name: {AUTHORS}\n\
         keywords:\n  - squirmer\n  - microswimmer\n  - Stokes flow\n\
         references:\n  \
           - type: software\n    title: squirmers\n    version: {VERSION}\n    authors:\n      - name: {AUTHORS}\n",
        licenses.concat()
    )
}

fn license() -> String {
    let mut page = format!(
        "{PACKAGE}, Copyright {AUTHORS}\n\nSPDX-License-Identifier: MIT OR Apache-2.0\n\nLicensed, at your choice, under one of:\n\n"
    );
    for [name, title, address] in LICENSES {
        let _ = writeln!(page, "- {title} ({name}): {address}");
    }
    page.push_str(
        "\nThe texts are also in the files LICENSE-MIT and LICENSE-APACHE of the program squirmers.\n",
    );
    page
}
