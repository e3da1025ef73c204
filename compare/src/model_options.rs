//! How models are set up: for which radii and loads, solved or tabulated, and where tables are kept.

use std::path::PathBuf;

use bem::Bem;
use scene::{LoadSet, Plan, Scene, SceneError};

use crate::CompareError;

/// Options for setting up the models.
#[derive(Clone, Debug, PartialEq)]
pub struct ModelOptions {
    /// Level of the mesh of boundary elements.
    pub mesh: usize,
    /// Whether the model solves at every gap instead of reading from a table.
    pub direct: bool,
    /// Loads whose balance the tables hold; by default all loads of the modes 1 and 2. What else a table holds changes no
    /// number.
    pub tabulated: LoadSet,
    /// Radii of the second squirmer over that of the first, for each of which the model is set up; by default 1.
    pub ratios: Vec<f64>,
    /// Folder in which tables are kept from one run to the next; `None` keeps no tables.
    pub cache: Option<PathBuf>,
}

impl Default for ModelOptions {
    fn default() -> Self {
        Self {
            mesh: Bem::DEFAULT_LEVEL,
            direct: false,
            tabulated: LoadSet::all(2),
            ratios: vec![1.0],
            cache: dirs::cache_dir().map(|folder| folder.join("squirmers")),
        }
    }
}

impl ModelOptions {
    /// These options, for the radii of the given scenes, with tables of only what their motion reads.
    ///
    /// # Errors
    /// The error of the first scene that is not valid.
    pub fn for_scenes(
        self,
        scenes: impl IntoIterator<Item = Result<Scene, CompareError>>,
    ) -> Result<Self, CompareError> {
        let mut read = Reads::default();
        for scene in scenes {
            read.add(&scene?)?;
        }
        Ok(self.for_reads(read))
    }

    /// These options, with tables of what is read.
    #[must_use]
    pub fn for_reads(self, read: Reads) -> Self {
        Self {
            tabulated: read.loads.unwrap_or(LoadSet::axial(0)),
            ratios: if read.ratios.is_empty() {
                self.ratios
            } else {
                read.ratios
            },
            ..self
        }
    }
}

/// What the motion of some scenes reads of a model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reads {
    /// The loads, of any of them.
    pub loads: Option<LoadSet>,
    /// Radii of the second squirmer over that of the first, each once.
    pub ratios: Vec<f64>,
}

impl Reads {
    /// Adds what a scene reads.
    ///
    /// # Errors
    /// As [`Plan::new`].
    pub fn add(&mut self, scene: &Scene) -> Result<(), SceneError> {
        let set = Plan::new(scene)?.load_set();
        self.loads = Some(self.loads.map_or(set, |read| read.union(set)));
        self.add_ratio(scene.ratio());
        Ok(())
    }

    /// The same and what motion in three dimensions reads besides, and its linearisation, which asks for no symmetry.
    #[must_use]
    pub fn in_space(self) -> Self {
        let loads = self.loads.map(|read| LoadSet {
            twist: true,
            swirl: read.swirl,
            ..LoadSet::planar(read.modes.max(2))
        });
        Self { loads, ..self }
    }

    /// Adds a ratio of the radii.
    pub fn add_ratio(&mut self, ratio: f64) {
        if !self.ratios.contains(&ratio) {
            self.ratios.push(ratio);
        }
    }
}
