//! `Scene`.

use std::path::PathBuf;

use ::scene::nalgebra::Vector3;
use ::scene::{Gravity, Orientation, Pose, Repulsion, RunOptions, Scene as Native};
use compare::scene_file::Hydrodynamics;
use compare::{CompareError, Family, FamilyScene, Method};
use pyo3::inspect::PyStaticExpr;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString, PyTuple};
use pyo3::{type_hint_identifier, type_hint_subscript, type_hint_union};

use crate::array::{Array, Numbers};
use crate::error::{input, of_mistakes, of_scene, raised};
use crate::squirmer::Squirmer;

/// Where a scene comes from: what a pickle keeps.
#[derive(Clone, PartialEq)]
enum Origin {
    /// From its parts, of which gravity is kept as it was given.
    Parts { gravity: Option<[f64; 3]> },
    /// From a text and values of its parameters.
    Text {
        text: String,
        parameters: Vec<(String, f64)>,
    },
}

/// Two squirmers, where they start, and the effects that act on them.
///
/// Lengths are in radii ``a`` of the first squirmer, times in ``a/V_s``, angles in degrees, anticlockwise from the x axis.
///
/// Parameters
/// ----------
/// squirmers : Squirmer or pair of Squirmer
///     The two; one alone stands for both. The first has radius 1.
/// positions : array_like, shape (2, 2) or (2, 3)
///     Centres. Without a third coordinate it is 0.
/// angles_deg : array_like, shape (2,), optional
///     Swimming directions in the x-y plane, in degrees; they may wind. Not together with `orientations`.
/// orientations : array_like, shape (2, 3), optional
///     Swimming directions in space, of any length.
/// repulsion : pair of float or "paper", optional
///     ``(kappa1, kappa2)`` of the repulsion at short range, both greater than 0: the force is ``kappa1 kappa2 e/(1 - e)`` with
///     ``e = exp(-kappa2 gap)``, per ``mu a V_s``; ``"paper"`` stands for the paper's (10, 100). Without it there is none, and squirmers may touch.
/// gravity : array_like, shape (3,), optional
///     Direction of gravity, of any length. It turns squirmers with bottom-heaviness.
///
/// Raises
/// ------
/// InputError
///     If a number is not finite, a direction has no length, the spheres overlap or touch, or a shape is wrong.
///
/// Examples
/// --------
/// >>> import squirmers
/// >>> puller = squirmers.Squirmer(beta=5.0)
/// >>> scene = squirmers.Scene(puller, [(-0.5, 5.0), (0.5, -5.0)], angles_deg=(-90, 90), repulsion="paper")
/// >>> round(scene.gap, 3)
/// 8.05
#[pyclass(frozen, eq, module = "squirmers")]
#[derive(Clone, PartialEq)]
pub(crate) struct Scene {
    pub scene: Native,
    pub run: RunOptions,
    pub hydrodynamics: Option<Hydrodynamics>,
    origin: Origin,
}

/// Rows of two squirmers, each with one of the `allowed` numbers of entries.
fn rows(what: &'static str, given: &Numbers<'_>, allowed: &[usize]) -> PyResult<[Vector3<f64>; 2]> {
    let rows = given.vectors(what, allowed)?;
    rows.try_into().map_err(|_| {
        let allowed = "give a row for each of the two squirmers";
        input(what, given.shape_in_words(), allowed)
    })
}

/// Repulsion in words or in numbers.
struct Strength(Repulsion);

impl<'a, 'py> FromPyObject<'a, 'py> for Strength {
    type Error = PyErr;

    const INPUT_TYPE: PyStaticExpr = type_hint_union!(
        type_hint_subscript!(
            type_hint_identifier!("builtins", "tuple"),
            type_hint_identifier!("builtins", "float"),
            type_hint_identifier!("builtins", "float")
        ),
        type_hint_identifier!("builtins", "str")
    );

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        let allowed = "give (kappa1, kappa2), or 'paper'";
        if let Ok((kappa1, kappa2)) = object.extract::<(f64, f64)>() {
            return Ok(Self(Repulsion::new(kappa1, kappa2).map_err(of_scene)?));
        }
        match object.extract::<String>() {
            Ok(name) if name == "paper" => Ok(Self(Repulsion::PAPER)),
            Ok(name) => Err(input("repulsion", name, allowed)),
            Err(_) => Err(input("repulsion", object.get_type().name()?, allowed)),
        }
    }
}

fn pair_of(squirmers: &Bound<'_, PyAny>) -> PyResult<[::scene::Squirmer; 2]> {
    if let Ok(one) = squirmers.cast::<Squirmer>() {
        return Ok([one.get().0; 2]);
    }
    let both: Vec<Bound<'_, PyAny>> = squirmers.try_iter()?.collect::<PyResult<_>>()?;
    match &both[..] {
        [one, two] => {
            let of =
                |squirmer: &Bound<'_, PyAny>| Ok::<_, PyErr>(squirmer.cast::<Squirmer>()?.get().0);
            Ok([of(one)?, of(two)?])
        }
        _ => Err(input("squirmers", both.len(), "give one, or a pair")),
    }
}

impl Scene {
    fn of_parts(
        squirmers: &Bound<'_, PyAny>,
        (positions, orientations): ([Vector3<f64>; 2], [Orientation; 2]),
        repulsion: Option<Repulsion>,
        gravity: Option<[f64; 3]>,
    ) -> PyResult<Self> {
        let start = [0, 1].map(|k| Pose {
            position: positions[k],
            orientation: orientations[k],
        });
        let pulls = gravity.map(|direction| Gravity::new(Vector3::from(direction)));
        let pulls = pulls.transpose().map_err(of_scene)?;
        let scene = Native::new(pair_of(squirmers)?, start, repulsion, pulls);
        Ok(Self {
            scene: scene.map_err(of_scene)?,
            run: RunOptions::default(),
            hydrodynamics: None,
            origin: Origin::Parts { gravity },
        })
    }

    fn of_family(family: &Family, parameters: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let parameters: Vec<(String, f64)> = match parameters {
            Some(given) => (given.iter())
                .map(|(name, value)| Ok((name.extract()?, value.extract()?)))
                .collect::<PyResult<_>>()?,
            None => Vec::new(),
        };
        let values: Vec<(&str, f64)> = (parameters.iter())
            .map(|(name, value)| (name.as_str(), *value))
            .collect();
        let point = family.scene(&values);
        let FamilyScene { scene, run } = point.map_err(|mistakes| of_mistakes(&mistakes))?;
        Ok(Self {
            scene,
            run,
            hydrodynamics: family.hydrodynamics(),
            origin: Origin::Text {
                text: family.text().to_owned(),
                parameters,
            },
        })
    }
}

/// The text of a file.
pub(crate) fn text_of(path: PathBuf) -> PyResult<String> {
    std::fs::read_to_string(&path).map_err(|source| raised(CompareError::Read { path, source }))
}

/// A family: one of those that ship by its name, or a scene file by its path.
pub(crate) fn family(named: &str) -> PyResult<Family> {
    if let Some(family) = Family::named(named) {
        return Ok(family.clone());
    }
    Family::parse(&text_of(PathBuf::from(named))?).map_err(|mistakes| of_mistakes(&mistakes))
}

/// What `Model` takes: name, level and directness.
pub(crate) type ModelArguments = (&'static str, Option<usize>, bool);

/// The model that a file names, as `Model` takes it.
pub(crate) fn as_arguments(of: Hydrodynamics) -> ModelArguments {
    let level = (of.method == Method::Bem).then_some(of.mesh);
    (of.method.name(), level, of.direct)
}

#[pymethods]
impl Scene {
    #[new]
    #[pyo3(signature = (squirmers, positions, *, angles_deg=None, orientations=None, repulsion=None, gravity=None))]
    fn new(
        squirmers: &Bound<'_, PyAny>,
        positions: Numbers<'_>,
        angles_deg: Option<Numbers<'_>>,
        orientations: Option<Numbers<'_>>,
        repulsion: Option<Strength>,
        gravity: Option<Numbers<'_>>,
    ) -> PyResult<Self> {
        let orientations = match (angles_deg, orientations) {
            (Some(angles), None) => angles
                .exactly::<2>("angles_deg")?
                .map(Orientation::from_degrees),
            (None, Some(vectors)) => rows("orientations", &vectors, &[3])?.map(Orientation::Vector),
            _ => {
                return Err(input(
                    "orientations",
                    "with angles_deg or neither",
                    "give one of the two",
                ));
            }
        };
        let positions = rows("positions", &positions, &[2, 3])?;
        let gravity = gravity
            .map(|given| given.exactly::<3>("gravity"))
            .transpose()?;
        let repulsion = repulsion.map(|Strength(repulsion)| repulsion);
        Self::of_parts(squirmers, (positions, orientations), repulsion, gravity)
    }

    /// A scene from the text of a scene file, with values for its parameters.
    ///
    /// Parameters
    /// ----------
    /// text : str
    ///     Text in TOML; docs/SCENES.md lists its keys.
    /// **parameters : float
    ///     Values of parameters of the file; the others have their defaults.
    ///
    /// Returns
    /// -------
    /// Scene
    ///     The scene, with the run settings and the model of the file.
    ///
    /// Raises
    /// ------
    /// InputError
    ///     Every mistake in the text, each with line and column.
    #[staticmethod]
    #[pyo3(signature = (text, /, **parameters: "float"))]
    fn from_toml(
        text: &Bound<'_, PyString>,
        parameters: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        let family = Family::parse(&text.to_cow()?);
        Self::of_family(
            &family.map_err(|mistakes| of_mistakes(&mistakes))?,
            parameters,
        )
    }

    /// A scene from a scene file, or from one of the families that ship, with values for its parameters.
    ///
    /// Parameters
    /// ----------
    /// name : str
    ///     ``"opposed"``, ``"right-angles"``, ``"incoming-angles"`` or another family that ships, or the path of a scene file.
    /// **parameters : float
    ///     Values of parameters; the others have their defaults.
    ///
    /// Returns
    /// -------
    /// Scene
    ///     The scene, with the run settings and the model of the file.
    ///
    /// Raises
    /// ------
    /// FileError
    ///     If the file cannot be read.
    /// InputError
    ///     Every mistake in it, each with line and column.
    ///
    /// Examples
    /// --------
    /// >>> import squirmers
    /// >>> squirmers.Scene.of("opposed", beta=5.0, dx=1.0).angles_deg
    /// array([-90.,  90.])
    #[staticmethod]
    #[pyo3(signature = (name, /, **parameters: "float"))]
    fn of(name: PathBuf, parameters: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        Self::of_family(&family(&name.to_string_lossy())?, parameters)
    }

    /// The two squirmers.
    #[getter]
    fn squirmers(&self) -> (Squirmer, Squirmer) {
        let [one, two] = self.scene.squirmers;
        (Squirmer(one), Squirmer(two))
    }

    /// Centres at the start, shape (2, 3), in radii of the first squirmer.
    #[getter]
    fn positions<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        Array::vectors(py, self.scene.start.map(|pose| pose.position))
    }

    /// Unit vectors of the swimming directions at the start, shape (2, 3).
    #[getter]
    fn orientations<'py>(&self, py: Python<'py>) -> PyResult<Array<'py>> {
        let [one, two] = self.scene.start.map(|pose| pose.orientation.vector());
        Array::vectors(py, [one.map_err(of_scene)?, two.map_err(of_scene)?])
    }

    /// Angles of the swimming directions' projections on the x-y plane, shape (2,), in degrees.
    #[getter]
    fn angles_deg<'py>(&self, py: Python<'py>) -> Array<'py> {
        let angles = (self.scene.start).map(|pose| pose.orientation.angle_rad().to_degrees());
        Array::line(py, angles)
    }

    /// ``(kappa1, kappa2)`` of the repulsion; None if there is none.
    #[getter]
    fn repulsion(&self) -> Option<(f64, f64)> {
        let of = self.scene.repulsion?;
        Some((of.kappa1(), of.kappa2()))
    }

    /// Unit vector along which gravity pulls, shape (3,); None if there is none.
    #[getter]
    fn gravity<'py>(&self, py: Python<'py>) -> Option<Array<'py>> {
        let of = self.scene.gravity?;
        Some(Array::line(py, <[f64; 3]>::from(of.direction())))
    }

    /// Gap between the surfaces at the start, in radii of the first squirmer.
    #[getter]
    fn gap(&self) -> PyResult<f64> {
        Ok(self.scene.gap().map_err(of_scene)?.eps())
    }

    /// Name of the model that the scene's file names; None if it names none.
    #[getter]
    fn model(&self) -> Option<&'static str> {
        Some(self.hydrodynamics?.method.name())
    }

    /// Name, level and directness of the model that the scene's file names, or else of the exact one.
    fn _model(&self) -> ModelArguments {
        as_arguments(self.hydrodynamics.unwrap_or(Method::Exact.into()))
    }

    fn __repr__(&self) -> PyResult<String> {
        let [one, two] = self.scene.start.map(|pose| {
            let [x, y, z] = pose.position.into();
            let angle = pose.orientation.angle_rad().to_degrees();
            format!("({x:?}, {y:?}, {z:?}) at {angle:?} deg")
        });
        let effects = [
            (self.scene.repulsion.is_some(), ", repulsion"),
            (self.scene.gravity.is_some(), ", gravity"),
        ];
        let effects: String = (effects.iter())
            .filter_map(|(is_there, name)| is_there.then_some(*name))
            .collect();
        Ok(format!(
            "<Scene: {one}, {two}{effects}, gap {:?}>",
            self.gap()?
        ))
    }

    /// What pickles keep: a call that makes the same scene.
    #[pyo3(signature = () -> "tuple[object, ...]")]
    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        let class = py.get_type::<Self>();
        let named = PyDict::new(py);
        let (call, arguments) = match &self.origin {
            Origin::Text { text, parameters } => {
                for (name, value) in parameters {
                    named.set_item(name, value)?;
                }
                let text = PyTuple::new(py, [text])?;
                (class.getattr("from_toml")?, text)
            }
            Origin::Parts { gravity } => {
                let [one, two] = self.scene.squirmers;
                let positions = self.scene.start.map(|pose| <[f64; 3]>::from(pose.position));
                let both = (Squirmer(one), Squirmer(two)).into_pyobject(py)?.into_any();
                let positions = positions.into_pyobject(py)?.into_any();
                named.set_item("repulsion", self.repulsion())?;
                named.set_item("gravity", gravity)?;
                for (k, pose) in self.scene.start.iter().enumerate() {
                    let key = format!("orientation{k}");
                    match pose.orientation {
                        Orientation::Radians(angle) => named.set_item(key, angle)?,
                        Orientation::Vector(v) => named.set_item(key, <[f64; 3]>::from(v))?,
                    }
                }
                let arguments = PyTuple::new(py, [both, positions])?;
                (class.getattr("_of_parts")?, arguments)
            }
        };
        let partial = py.import("functools")?.getattr("partial")?;
        let call = partial.call((call,), Some(&named))?;
        PyTuple::new(py, [call, arguments.into_any()])
    }

    /// The scene of a pickle.
    #[staticmethod]
    #[pyo3(signature = (squirmers, positions, *, orientation0, orientation1, repulsion, gravity))]
    fn _of_parts(
        squirmers: &Bound<'_, PyAny>,
        positions: [[f64; 3]; 2],
        orientation0: &Bound<'_, PyAny>,
        orientation1: &Bound<'_, PyAny>,
        repulsion: Option<(f64, f64)>,
        gravity: Option<[f64; 3]>,
    ) -> PyResult<Self> {
        let of = |given: &Bound<'_, PyAny>| {
            Ok::<_, PyErr>(match given.extract::<f64>() {
                Ok(angle) => Orientation::Radians(angle),
                Err(_) => Orientation::Vector(Vector3::from(given.extract::<[f64; 3]>()?)),
            })
        };
        let orientations = [of(orientation0)?, of(orientation1)?];
        let repulsion = repulsion.map(|(kappa1, kappa2)| Repulsion::new(kappa1, kappa2));
        let repulsion = repulsion.transpose().map_err(of_scene)?;
        let positions = positions.map(Vector3::from);
        Self::of_parts(squirmers, (positions, orientations), repulsion, gravity)
    }
}
