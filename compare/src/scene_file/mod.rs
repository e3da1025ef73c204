//! Scene files: two squirmers, the effects that act on them, and how to run them, as TOML.
//!
//! `docs/SCENES.md` lists every key. Files are read here and not in `scene` because they name the
//! hydrodynamic models, which `scene` does not know.

mod effects;
mod expression;
mod family;
mod functions;
mod mistakes;
mod number;
mod paper;
mod parameters;
mod point;
mod run;
mod scope;
mod squirmers;
mod table;

use scene::{Plan, RunOptions, Scene};

pub use effects::Hydrodynamics;
pub use family::{Family, FamilyScene};
pub use mistakes::{Mistake, Mistakes};
pub(crate) use paper::{paper_point, paper_scene};
pub use run::SAMPLE_INTERVAL;

use crate::{Method, ModelOptions};

/// What a scene file says.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneFile {
    /// Squirmers, start, repulsion and gravity.
    pub scene: Scene,
    /// The hydrodynamic method.
    pub method: Method,
    /// Refinement level of boundary elements, if they run.
    pub mesh: usize,
    /// Whether every load is solved for, instead of read from a table.
    pub direct: bool,
    /// End, stop rules, tolerance and samples.
    pub run: RunOptions,
}

impl SceneFile {
    /// Reads the text of a scene file. Parameters have their defaults.
    ///
    /// # Errors
    /// Every mistake in it.
    ///
    /// ```
    /// let mistakes = compare::SceneFile::parse("hydrodinamics = 1").unwrap_err();
    /// let told: Vec<String> = mistakes.0.iter().map(ToString::to_string).collect();
    /// let of_key = told.iter().find(|line| line.starts_with("1:1: hydrodinamics:")).unwrap();
    /// assert!(of_key.ends_with("did you mean 'hydrodynamics'?"));
    /// // What is missing is told too.
    /// assert!(told.len() > 1);
    /// ```
    pub fn parse(text: &str) -> Result<Self, Mistakes> {
        let (family, FamilyScene { scene, run }) = Family::read(text, true)?;
        // Without a model there is a mistake.
        let hydrodynamics = family.hydrodynamics().unwrap_or(Method::Isolated.into());
        let Hydrodynamics {
            method,
            mesh,
            direct,
        } = hydrodynamics;
        Ok(Self {
            scene,
            method,
            mesh,
            direct,
            run,
        })
    }

    /// How to set up its model for the radii of `plan`, with a table of the loads that it reads, kept as in `options`.
    #[must_use]
    pub fn model_options(&self, plan: &Plan, options: ModelOptions) -> ModelOptions {
        ModelOptions {
            mesh: self.mesh,
            direct: self.direct,
            tabulated: plan.load_set(),
            ratios: vec![plan.scene().ratio()],
            ..options
        }
    }
}

#[cfg(test)]
mod tests;
