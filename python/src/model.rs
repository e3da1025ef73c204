//! `Model`.

use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use ::scene::LoadSet;
use compare::scene_file::Hydrodynamics;
use compare::{CompareError, Method, Model as Ready, ModelOptions, Reads};
use pyo3::prelude::*;

use crate::background::in_background;
use crate::error::{input, raised};

/// A hydrodynamic model: what answers for the fluid.
///
/// A model sets up its tables when they are first needed, keeps them, and reads them from the disk the next time.
///
/// Parameters
/// ----------
/// name : str
///     ``"lt"`` (lubrication theory as published), ``"lt-corrected"``, ``"exact"``, ``"bem"`` (boundary elements) or ``"none"`` (no interaction).
/// level : int, optional
///     Level of the mesh of boundary elements. Only of ``"bem"``.
/// direct : bool, default False
///     Whether every load is solved for, in place of being read from a table: much slower, and without interpolation error.
/// cache : path, optional
///     Folder that keeps tables; by default the user's cache folder.
///
/// Raises
/// ------
/// InputError
///     If there is no such model or level.
///
/// Examples
/// --------
/// >>> import squirmers
/// >>> squirmers.Model("exact").name
/// 'exact'
#[pyclass(frozen, module = "squirmers", subclass)]
pub(crate) struct Model {
    method: Method,
    options: ModelOptions,
    /// Models that are set up, each for some loads and radii.
    ready: Arc<Mutex<Vec<(ModelOptions, Ready)>>>,
}

impl Model {
    pub(crate) fn of_method(method: Method) -> Self {
        Self {
            method,
            options: ModelOptions::default(),
            ready: Arc::default(),
        }
    }

    pub(crate) fn method(&self) -> Method {
        self.method
    }

    /// As scene files name it.
    pub(crate) fn as_in_files(&self) -> Hydrodynamics {
        Hydrodynamics {
            method: self.method,
            mesh: self.options.mesh,
            direct: self.options.direct,
        }
    }

    pub(crate) fn options(&self) -> &ModelOptions {
        &self.options
    }

    /// What sets it up for what is read, to be called where it may take long.
    pub(crate) fn setter(&self) -> Setter {
        Setter {
            method: self.method,
            options: self.options.clone(),
            ready: Arc::clone(&self.ready),
        }
    }

    /// The model of one ratio of the radii that holds `set`, set up if it is not.
    ///
    /// # Errors
    /// As [`Ready::set_up`]; `KeyboardInterrupt`.
    pub(crate) fn for_ratio(&self, py: Python<'_>, set: LoadSet, ratio: f64) -> PyResult<Ready> {
        let setter = self.setter();
        let read = Reads {
            loads: Some(set),
            ratios: vec![ratio],
        };
        if let Some(ready) = setter.ready_for(&read) {
            return Ok(ready);
        }
        in_background(py, None, move || setter.set_up(&read))
    }
}

/// Sets a model up without the interpreter.
pub(crate) struct Setter {
    method: Method,
    options: ModelOptions,
    ready: Arc<Mutex<Vec<(ModelOptions, Ready)>>>,
}

impl Setter {
    /// A model that is set up for what is read.
    fn ready_for(&self, read: &Reads) -> Option<Ready> {
        let ready = self.ready.lock().unwrap_or_else(PoisonError::into_inner);
        let holds = |options: &ModelOptions| {
            read.loads.is_none_or(|set| options.tabulated.holds(set))
                && read
                    .ratios
                    .iter()
                    .all(|ratio| options.ratios.contains(ratio))
        };
        let found = ready.iter().find(|(options, _)| holds(options));
        found.map(|(_, model)| model.clone())
    }

    /// A model that is set up for what is read.
    ///
    /// # Errors
    /// As [`Ready::set_up`].
    pub(crate) fn set_up(&self, read: &Reads) -> Result<Ready, CompareError> {
        if let Some(ready) = self.ready_for(read) {
            return Ok(ready);
        }
        // What else a table holds changes no number. Few loads more cost little, and are there for the next call; a model from outside may lack them.
        let least = match self.method {
            Method::Other(_) => LoadSet::axial(0),
            _ => LoadSet::all(2),
        };
        let options = self.options.clone().for_reads(Reads {
            loads: Some(read.loads.map_or(least, |set| set.union(least))),
            ratios: read.ratios.clone(),
        });
        let model = Ready::set_up(self.method, &options)?;
        let mut ready = self.ready.lock().unwrap_or_else(PoisonError::into_inner);
        ready.push((options, model.clone()));
        Ok(model)
    }
}

#[pymethods]
impl Model {
    #[new]
    #[pyo3(signature = (name, *, level=None, direct=false, cache=None))]
    fn new(
        name: &str,
        level: Option<usize>,
        direct: bool,
        cache: Option<PathBuf>,
    ) -> PyResult<Self> {
        let ours = || (Method::ALL.into_iter()).chain(std::iter::once(Method::Isolated));
        let Some(method) = ours().find(|method| method.name() == name) else {
            let names: Vec<_> = ours().map(Method::name).collect();
            let allowed = format!(
                "give {}, or make a model by Model.from_callable, Model.from_table or Model.from_file",
                names.join(", ")
            );
            return Err(input("model", name, allowed));
        };
        let mut options = ModelOptions {
            direct,
            ..ModelOptions::default()
        };
        if let Some(folder) = cache {
            options.cache = Some(folder);
        }
        if let Some(level) = level {
            if method != Method::Bem {
                return Err(input("level", level, "only 'bem' has levels: leave it out"));
            }
            options.mesh = level;
            // Refuses a level that is none.
            let gap = ::scene::Gap::new(1.0).map_err(crate::error::of_scene)?;
            method.check_gap(level, 1.0, gap).map_err(raised)?;
        }
        Ok(Self {
            method,
            options,
            ready: Arc::default(),
        })
    }

    /// Its name, which stands in tables.
    #[getter]
    fn name(&self) -> &'static str {
        self.method.name()
    }

    fn __repr__(&self) -> String {
        format!("<Model {}>", self.method.name())
    }
}
