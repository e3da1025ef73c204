//! `Model`.

use std::path::PathBuf;
use std::sync::{Arc, Mutex, PoisonError};

use ::scene::LoadSet;
use compare::submission::{Header, Submission, Submitted};
use compare::{CompareError, Method, Model as Ready, ModelOptions, Reads};
use pyo3::prelude::*;

use crate::array::Numbers;
use crate::background::in_background;
use crate::error::{input, of_submission, raised};
use crate::outside::{self, Function};

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
    /// What a model from outside says.
    submitted: Option<Submitted>,
}

impl Model {
    /// A model from outside, in place of an earlier one of this name.
    fn of_submitted(name: &str, submitted: Submitted) -> PyResult<Self> {
        let method = submitted.replace(name).map_err(|error| match error {
            CompareError::Input { value, allowed, .. } => input("name", value, allowed),
            other => raised(other),
        })?;
        Ok(Self {
            submitted: Some(submitted),
            ..Self::of_method(method)
        })
    }

    /// What it says, if it is one from outside.
    pub(crate) fn submitted(&self) -> Option<&Submitted> {
        self.submitted.as_ref()
    }

    pub(crate) fn of_method(method: Method) -> Self {
        Self {
            method,
            options: ModelOptions::default(),
            ready: Arc::default(),
            submitted: None,
        }
    }

    pub(crate) fn method(&self) -> Method {
        self.method
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
            submitted: None,
        })
    }

    /// A model that asks a function for its numbers.
    ///
    /// The function gets an array of gaps, shape (n,), and returns named quantities of docs/JUDGE.md at these gaps: a mapping, table or structured array
    /// of arrays of the shape (n,). With `matrix` it returns mobility or resistance matrices, shape (n, 12, 12), or a mapping with them under
    /// ``"matrix"`` and slip columns such as ``"B1_1z"`` beside them, shape (n, 12). NaN says that there is no answer at a gap: judging leaves that gap out, a
    /// table for the motion needs all. It is called few times, each time for many gaps, and once for a gap; always by one thread at a time for a table,
    /// not by the main one. What it raises comes out as it is. It may call this package, but not for its own model.
    ///
    /// Before the model moves pairs its answers are put into a table, down to `noise`.
    ///
    /// Parameters
    /// ----------
    /// f : callable
    ///     The function.
    /// name : str, default "model"
    ///     Name of the model in tables. One of the same name that was made before keeps its own function, where it is still in use.
    /// range : tuple of float
    ///     Smallest and largest gap for which it answers, in the unit of `radius`. Pairs that part are followed to a gap of 10.
    /// matrix : {"mobility", "resistance"}, optional
    ///     What the matrices are. Without it the function returns named quantities.
    /// noise : float, default 1e-9
    ///     Size of the noise of its numbers, relative to the larger of the number and 1.
    /// model, version, citation, call : str, optional
    ///     Name of the code, its version, where it is published, how it is called.
    /// radius, viscosity : float, default 1
    ///     Units of the gaps and matrices.
    /// mode_units : array_like, shape (m,), optional
    ///     How many ``B_n`` one unit of each slip mode is.
    /// slip_calibration : array_like, shape (m,), optional
    ///     Factors for what each slip mode causes.
    ///
    /// Returns
    /// -------
    /// Model
    ///     The model.
    ///
    /// Raises
    /// ------
    /// InputError
    ///     If an argument is not allowed. What the function returns is looked at when it is first asked.
    ///
    /// Examples
    /// --------
    /// Two spheres that feel each other's far field along the line of centres:
    ///
    /// >>> import squirmers
    /// >>> def far_field(gaps):
    /// ...     return {"x11a": 1.0, "x12a": 1.5 / (gaps + 2)}
    /// >>> model = squirmers.Model.from_callable(far_field, name="far", range=(1e-3, 1e4))
    /// >>> squirmers.judge(model).trusted_down_to
    /// {1: 4.0, 5: 1.0, 20: 0.5}
    #[staticmethod]
    #[pyo3(signature = (f, *, name="model", range, matrix=None, noise=None, model=None, version=None, citation=None, call=None, radius=1.0, viscosity=1.0, mode_units=None, slip_calibration=None))]
    #[expect(clippy::too_many_arguments, reason = "they have names in Python")]
    fn from_callable(
        f: Function<'_>,
        name: &str,
        range: (f64, f64),
        matrix: Option<&str>,
        noise: Option<f64>,
        model: Option<String>,
        version: Option<String>,
        citation: Option<String>,
        call: Option<String>,
        radius: f64,
        viscosity: f64,
        mode_units: Option<Numbers<'_>>,
        slip_calibration: Option<Numbers<'_>>,
    ) -> PyResult<Self> {
        let header = Header {
            model,
            version,
            citation,
            call,
            radius,
            viscosity,
            mode_units: outside::modes("mode_units", mode_units)?,
            slip_calibration: outside::modes("slip_calibration", slip_calibration)?,
            matrix: outside::matrix_kind(matrix)?,
            range: Some([range.0, range.1]),
            noise,
            ..Header::default()
        };
        Self::of_submitted(name, outside::of_function(f, name, header)?)
    }

    /// A model of numbers at some gaps, as a file holds them.
    ///
    /// Parameters
    /// ----------
    /// table : mapping, pandas.DataFrame, structured array or Table
    ///     A column ``gap``, shape (n,), and a column for each named quantity of docs/JUDGE.md, shape (n,); NaN where it is not known. With `matrix` the
    ///     column ``matrix``, shape (n, 12, 12), and perhaps slip columns such as ``B1_1z``, shape (n, 12).
    /// name : str, default "model"
    ///     Name of the model in tables.
    /// matrix : {"mobility", "resistance"}, optional
    ///     What the matrices are.
    /// interpolation : {"linear", "log-linear", "log-cubic", "none"}, optional
    ///     How the model's own code reads values between the gaps. If it is left out, judging scores nothing between them, and motion reads cubics
    ///     in the logarithm of the gap.
    /// model, version, citation, call, machine : str, optional
    ///     Name of the code, its version, where it is published, how it was called, on what machine.
    /// radius, viscosity : float, default 1
    ///     Units of the gaps and matrices.
    /// mode_units : array_like, shape (m,), optional
    ///     How many ``B_n`` one unit of each slip mode is.
    /// slip_calibration : array_like, shape (m,), optional
    ///     Factors for what each slip mode causes.
    /// seconds_per_gap : float, optional
    ///     Time of one gap, in seconds.
    ///
    /// Returns
    /// -------
    /// Model
    ///     The model. One of too few gaps can be judged, and moves no pair.
    ///
    /// Raises
    /// ------
    /// InputError
    ///     If an argument or a number in the table is not allowed.
    ///
    /// Examples
    /// --------
    /// >>> import squirmers
    /// >>> far = {"gap": [0.1, 1.0, 38.0], "x11a": [1.0, 1.0, 1.0], "x12a": [0.7143, 0.5, 0.0375]}
    /// >>> squirmers.Model.from_table(far, name="far")
    /// <Model far>
    #[staticmethod]
    #[pyo3(signature = (table, *, name="model", matrix=None, interpolation=None, model=None, version=None, citation=None, call=None, machine=None, radius=1.0, viscosity=1.0, mode_units=None, slip_calibration=None, seconds_per_gap=None))]
    #[expect(clippy::too_many_arguments, reason = "they have names in Python")]
    fn from_table(
        table: &Bound<'_, PyAny>,
        name: &str,
        matrix: Option<&str>,
        interpolation: Option<&str>,
        model: Option<String>,
        version: Option<String>,
        citation: Option<String>,
        call: Option<String>,
        machine: Option<String>,
        radius: f64,
        viscosity: f64,
        mode_units: Option<Numbers<'_>>,
        slip_calibration: Option<Numbers<'_>>,
        seconds_per_gap: Option<f64>,
    ) -> PyResult<Self> {
        let header = Header {
            model,
            version,
            citation,
            call,
            machine,
            radius,
            viscosity,
            mode_units: outside::modes("mode_units", mode_units)?,
            slip_calibration: outside::modes("slip_calibration", slip_calibration)?,
            interpolation: outside::interpolation(interpolation)?,
            seconds_per_gap,
            matrix: outside::matrix_kind(matrix)?,
            ..Header::default()
        };
        Self::of_submitted(name, outside::of_table(table, name, header)?)
    }

    /// A model of a file of named values or matrices, as docs/JUDGE.md has it.
    ///
    /// Parameters
    /// ----------
    /// path : path
    ///     The CSV file, with its header.
    /// name : str, optional
    ///     Name of the model in tables; by default that of the file, without its ending.
    ///
    /// Returns
    /// -------
    /// Model
    ///     The model.
    ///
    /// Raises
    /// ------
    /// FileError
    ///     If the file cannot be read.
    /// InputError
    ///     The first mistake in it, or a name that is not allowed.
    #[staticmethod]
    #[pyo3(signature = (path, *, name=None))]
    fn from_file(path: PathBuf, name: Option<&str>) -> PyResult<Self> {
        let submission = Submission::read(&path).map_err(of_submission)?;
        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
        Self::of_submitted(name.unwrap_or(&stem), Submitted::File(submission))
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
