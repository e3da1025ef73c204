//! A package of reference numbers for two squirming spheres, by exact loads: data files with their errors, and what is needed to read, check
//! and cite them.
//!
//! Other programs can compare with it without running this one. It is the same each time; `fixtures/reference` has it, and
//! docs/REFERENCE.md says how it was checked.

mod bound_states;
mod deflections;
mod digits;
mod far_field;
mod gaps;
mod loads;
mod mobilities;
mod near_contact;
mod package;
mod pages;
mod shares;
mod tables;

use std::path::Path;

use serde::Serialize;

use crate::columns::{Column, Columns};
use crate::output::{OutputFolder, csv_text};
use crate::watch::{Pieces, Progress};
use crate::{CompareError, ModelOptions};

pub use bound_states::{ReferenceBoundState, reference_bound_states};
pub use deflections::{DeflectionRow, deflections};
pub use far_field::{FarFieldRow, far_field};
pub use gaps::{ExactOf, RATIOS, gaps, gaps_of_ratio};
pub use loads::{LOADS, ReferenceLoad, reference_loads};
pub use mobilities::{COEFFICIENTS_READ, MobilityRow, mobilities};
pub use near_contact::{NearContactRow, near_contact};
pub use package::{DESCRIPTOR, PACKAGE};
pub use shares::{SHARES_GRID, shares};
pub use tables::Tables;

/// Number of data files.
const PARTS: usize = 7;

/// A data file of the package.
#[derive(Clone, Debug)]
pub struct Resource {
    /// Name without the ending `.csv`.
    pub name: &'static str,
    /// What it holds.
    pub title: &'static str,
    /// What a row is.
    pub about: &'static str,
    /// Its columns in their order.
    pub columns: &'static [Column],
    /// Its text.
    pub text: String,
}

impl Resource {
    fn new<R: Serialize + Columns>(
        name: &'static str,
        title: &'static str,
        rows: &[R],
    ) -> Result<Self, CompareError> {
        Ok(Self {
            name,
            title,
            about: R::ABOUT,
            columns: R::COLUMNS,
            text: csv_text(rows)?,
        })
    }

    /// Name of its file.
    #[must_use]
    pub fn path(&self) -> String {
        format!("{}.csv", self.name)
    }
}

/// The package: its data files and the pages about them.
#[derive(Clone, Debug)]
pub struct Package {
    resources: Vec<Resource>,
}

impl Package {
    /// Computes the package, bound states and shares for squirmers with each of `betas`. The table of exact loads is kept where `options` say.
    ///
    /// # Errors
    /// Those of the exact model, its tables and its runs.
    pub fn compute(betas: &[f64], options: &ModelOptions) -> Result<Self, CompareError> {
        let progress = Progress::begin("files of the package", PARTS, Pieces::Unlike);
        let done = |resource: Result<Resource, CompareError>| {
            progress.advance();
            resource
        };
        let models = ExactOf::all()?;
        let equal = models.iter().find(|of| !scene::are_unlike(of.ratio));
        let equal = equal.ok_or_else(|| {
            CompareError::input("radii", "none", "the package needs equal spheres")
        })?;
        let loads = done(Resource::new(
            "loads",
            "Exact loads over the gap, for several ratios of the radii",
            &reference_loads(&models)?,
        ))?;
        let mobilities = done(Resource::new(
            "mobilities",
            "Exact coefficients of motion of equal spheres over the gap",
            &mobilities(equal)?,
        ))?;
        let near_contact = done(Resource::new(
            "near-contact",
            "Loads near contact: what diverges, and the next constant",
            &near_contact(&models)?,
        ))?;
        let far_field = done(Resource::new(
            "far-field",
            "Coefficients of motion far apart, in closed form",
            &far_field(),
        ))?;
        let tables = Tables::build(&equal.exact, options)?;
        let deflections = done(Resource::new(
            "deflections",
            "Exact deflections in the encounters of the paper's Figs 6 and 7",
            &deflections(&tables)?,
        ))?;
        let bound_states = done(Resource::new(
            "bound-states",
            "Bound states by exact loads",
            &reference_bound_states(&tables, betas)?,
        ))?;
        let shares = done(Resource::new(
            "shares",
            "Shares of outcomes over the incoming angles by exact loads",
            &shares(&tables.usual, betas)?,
        ))?;
        Ok(Self {
            resources: vec![
                loads,
                mobilities,
                near_contact,
                far_field,
                deflections,
                bound_states,
                shares,
            ],
        })
    }

    /// The data files.
    #[must_use]
    pub fn resources(&self) -> &[Resource] {
        &self.resources
    }

    /// Every file with its text; the descriptor, which has the checksums of the others, comes last.
    ///
    /// # Errors
    /// [`CompareError::Json`] if the descriptor cannot be turned into text.
    pub fn files(&self) -> Result<Vec<(String, String)>, CompareError> {
        let data = self.resources.iter();
        let mut files: Vec<_> = data.map(|of| (of.path(), of.text.clone())).collect();
        files.extend(pages::pages(&self.resources));
        files.push((DESCRIPTOR.to_owned(), package::descriptor(&self.resources)?));
        Ok(files)
    }

    /// Writes every file into `out`.
    ///
    /// # Errors
    /// [`CompareError::Write`], and as [`Self::files`].
    pub fn write(&self, out: &OutputFolder) -> Result<(), CompareError> {
        for (name, text) in self.files()? {
            out.write(&name, &text)?;
        }
        Ok(())
    }
}

/// Refuses a folder with files of another kind, which the package would replace: names such as `README.md` and `loads.csv` are not its own.
///
/// # Errors
/// [`CompareError::Input`] unless the folder is missing, empty, or has an earlier package.
pub fn check_folder(path: &Path) -> Result<(), CompareError> {
    let entries = std::fs::read_dir(path);
    if !entries.is_ok_and(|mut entries| entries.next().is_some()) {
        return Ok(());
    }
    let earlier = std::fs::read_to_string(path.join(DESCRIPTOR)).ok();
    if earlier.is_some_and(|text| package::is_of_this_kind(&text)) {
        return Ok(());
    }
    let allowed =
        "the folder holds other files, which the package could replace: give a new or an empty one";
    Err(CompareError::input("--out", path.display(), allowed))
}
