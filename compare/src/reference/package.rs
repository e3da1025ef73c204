//! The descriptor of the package, `datapackage.json`, after Frictionless Data's specification of tabular data packages (version 1).

use serde::Serialize;
use sha2::{Digest, Sha256};

use super::Resource;
use crate::CompareError;
use crate::columns::Column;

/// Name of the descriptor.
pub const DESCRIPTOR: &str = "datapackage.json";

/// Name of the package in its descriptor.
pub const PACKAGE: &str = "squirmers-reference";

/// Title of the package.
pub(super) const TITLE: &str = "Reference numbers for two squirming spheres in Stokes flow";

/// Who made it.
pub(super) const AUTHORS: &str = "The squirmers developers";

/// Version of the package: that of the program.
pub(super) const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Licences, at the reader's choice: name, title, address.
pub(super) const LICENSES: [[&str; 3]; 2] = [
    ["MIT", "MIT License", "https://spdx.org/licenses/MIT.html"],
    [
        "Apache-2.0",
        "Apache License 2.0",
        "https://spdx.org/licenses/Apache-2.0.html",
    ],
];

/// What the numbers are defined by and were compared with: title, and address where there is one.
pub(super) const SOURCES: [(&str, Option<&str>); 5] = [
    (
        "C. Darveniza, T. Ishikawa, T. J. Pedley & D. R. Brumley, Pairwise scattering and bound states of spherical microorganisms (2022): the encounters",
        None,
    ),
    (
        "S. Kim & S. J. Karrila, Microhydrodynamics (2005): names and signs of the resistance scalars",
        None,
    ),
    (
        "D. J. Jeffrey & Y. Onishi, J. Fluid Mech. 139 (1984) 261: the scalars of unlike spheres",
        Some("https://doi.org/10.1017/S0022112084000355"),
    ),
    (
        "A. K. Townsend, Phys. Fluids 35 (2023) 127126: the scalars of equal spheres",
        Some("https://doi.org/10.1063/5.0175697"),
    ),
    (
        "M. Stimson & G. B. Jeffery, Proc. R. Soc. A 111 (1926) 110; H. Brenner, Chem. Eng. Sci. 16 (1961) 242; G. B. Jeffery, Proc. London Math. Soc. 14 (1915) 327: axial motion",
        None,
    ),
];

#[derive(Serialize)]
struct Descriptor<'a> {
    profile: &'static str,
    name: &'static str,
    title: &'static str,
    description: &'static str,
    version: &'static str,
    licenses: Vec<License>,
    contributors: Vec<Contributor>,
    sources: Vec<Source>,
    keywords: [&'static str; 4],
    resources: Vec<TabularResource<'a>>,
}

#[derive(Serialize)]
struct License {
    name: &'static str,
    title: &'static str,
    path: &'static str,
}

#[derive(Serialize)]
struct Contributor {
    title: &'static str,
    role: &'static str,
}

#[derive(Serialize)]
struct Source {
    title: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    path: Option<&'static str>,
}

#[derive(Serialize)]
struct TabularResource<'a> {
    profile: &'static str,
    name: &'a str,
    title: &'a str,
    description: &'a str,
    path: String,
    format: &'static str,
    mediatype: &'static str,
    encoding: &'static str,
    bytes: usize,
    hash: String,
    schema: Schema,
}

#[derive(Serialize)]
struct Schema {
    fields: Vec<Field>,
}

#[derive(Serialize)]
struct Field {
    name: &'static str,
    r#type: &'static str,
    unit: &'static str,
    description: &'static str,
}

/// The text of the descriptor.
///
/// # Errors
/// [`CompareError::Json`].
pub(super) fn descriptor(resources: &[Resource]) -> Result<String, CompareError> {
    let descriptor = Descriptor {
        profile: "tabular-data-package",
        name: PACKAGE,
        title: TITLE,
        description: "Loads, coefficients of motion, their limits, deflections, bound states and shares of outcomes by an exact series, each with its error. README.md has the definitions.",
        version: VERSION,
        licenses: (LICENSES.into_iter())
            .map(|[name, title, path]| License { name, title, path })
            .collect(),
        contributors: vec![Contributor {
            title: AUTHORS,
            role: "author",
        }],
        sources: (SOURCES.into_iter())
            .map(|(title, path)| Source { title, path })
            .collect(),
        keywords: ["squirmer", "microswimmer", "Stokes flow", "two spheres"],
        resources: (resources.iter())
            .map(|of| TabularResource {
                profile: "tabular-data-resource",
                name: of.name,
                title: of.title,
                description: of.about,
                path: of.path(),
                format: "csv",
                mediatype: "text/csv",
                encoding: "utf-8",
                bytes: of.text.len(),
                hash: format!("sha256:{}", sha256(&of.text)),
                schema: schema(of),
            })
            .collect(),
    };
    Ok(serde_json::to_string_pretty(&descriptor)? + "\n")
}

/// The checksum of a text, in hexadecimal digits.
fn sha256(text: &str) -> String {
    let bytes = Sha256::digest(text.as_bytes());
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

fn schema(of: &Resource) -> Schema {
    let mut reader = csv::Reader::from_reader(of.text.as_bytes());
    let records: Vec<_> = reader.records().filter_map(Result::ok).collect();
    let field = |(place, column): (usize, &Column)| {
        let cells = records.iter().filter_map(|record| record.get(place));
        Field {
            name: column.name,
            r#type: type_of(&cells.collect::<Vec<_>>()),
            unit: column.unit,
            description: column.doc,
        }
    };
    Schema {
        fields: of.columns.iter().enumerate().map(field).collect(),
    }
}

/// The type of a column: that of all its cells.
fn type_of(cells: &[&str]) -> &'static str {
    let all = |is: fn(&str) -> bool| !cells.is_empty() && cells.iter().all(|cell| is(cell));
    if all(|cell| cell.parse::<i64>().is_ok()) {
        "integer"
    } else if all(|cell| cell.parse::<f64>().is_ok()) {
        "number"
    } else if all(|cell| cell.parse::<bool>().is_ok()) {
        "boolean"
    } else {
        "string"
    }
}

/// Whether a text is the descriptor of such a package, of any version.
pub(super) fn is_of_this_kind(text: &str) -> bool {
    let parsed: Option<serde_json::Value> = serde_json::from_str(text).ok();
    parsed.is_some_and(|package| package["name"] == PACKAGE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn val_checksums_are_those_of_the_standard() {
        // FIPS 180-2, appendix B.1.
        assert_eq!(
            sha256("abc"),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"
        );
    }

    #[test]
    fn columns_have_the_type_of_their_cells() {
        assert_eq!(type_of(&["1", "-2"]), "integer");
        assert_eq!(type_of(&["1", "2.5e-3", "NaN"]), "number");
        assert_eq!(type_of(&["true", "false"]), "boolean");
        assert_eq!(type_of(&["1", "1/2"]), "string");
        assert_eq!(type_of(&[]), "string");
    }

    #[test]
    fn only_packages_of_this_kind_are_known() {
        assert!(is_of_this_kind("{\"name\": \"squirmers-reference\"}"));
        assert!(!is_of_this_kind("{\"name\": \"another\"}"));
        assert!(!is_of_this_kind("not JSON"));
    }
}
