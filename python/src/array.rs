//! Arguments and results whose Python types the stubs name: arrays, and what shows progress.

use ::scene::nalgebra::Vector3;
use numpy::{AllowTypeChange, PyArray1, PyArrayLikeDyn, PyArrayMethods};
use pyo3::inspect::{PyStaticConstant, PyStaticExpr};
use pyo3::prelude::*;
use pyo3::{type_hint_identifier, type_hint_subscript, type_hint_union};

use crate::error::{input, refused};

/// Largest coordinate of a point: its square is finite.
const FARTHEST: f64 = 1e100;

/// An array of numbers that Python gets.
pub(crate) struct Array<'py>(Bound<'py, PyAny>);

impl<'py> Array<'py> {
    /// Of one dimension.
    pub(crate) fn line(py: Python<'py>, values: impl IntoIterator<Item = f64>) -> Self {
        Self(PyArray1::from_vec(py, values.into_iter().collect()).into_any())
    }

    /// Of any shape, from its numbers in the order of rows.
    pub(crate) fn shaped<const N: usize>(
        py: Python<'py>,
        values: Vec<f64>,
        shape: [usize; N],
    ) -> PyResult<Self> {
        let array = PyArray1::from_vec(py, values).reshape(shape.to_vec())?;
        Ok(Self(array.into_any()))
    }

    /// Of vectors, a row each.
    pub(crate) fn vectors(
        py: Python<'py>,
        vectors: impl IntoIterator<Item = Vector3<f64>>,
    ) -> PyResult<Self> {
        let flat: Vec<f64> = (vectors.into_iter()).flat_map(<[f64; 3]>::from).collect();
        let rows = flat.len() / 3;
        Self::shaped(py, flat, [rows, 3])
    }
}

impl<'py> IntoPyObject<'py> for Array<'py> {
    type Target = PyAny;
    type Output = Bound<'py, PyAny>;
    type Error = std::convert::Infallible;

    const OUTPUT_TYPE: PyStaticExpr = type_hint_subscript!(
        type_hint_identifier!("numpy.typing", "NDArray"),
        type_hint_identifier!("numpy", "float64")
    );

    fn into_pyobject(self, _py: Python<'py>) -> Result<Self::Output, Self::Error> {
        Ok(self.0)
    }
}

/// Numbers in any form that numpy makes an array of.
pub(crate) struct Numbers<'py>(PyArrayLikeDyn<'py, f64, AllowTypeChange>);

impl<'a, 'py> FromPyObject<'a, 'py> for Numbers<'py> {
    type Error = PyErr;

    const INPUT_TYPE: PyStaticExpr = type_hint_identifier!("numpy.typing", "ArrayLike");

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        // An array of complex numbers would lose their imaginary parts, dates would be days, and what is masked would be there again.
        if let Ok(dtype) = object.getattr("dtype") {
            let kind: String = dtype.getattr("kind")?.extract()?;
            if !REAL.contains(&kind.as_str()) {
                return Err(refused(format!(
                    "an array of {dtype} is not allowed: give real numbers"
                )));
            }
        }
        if object.hasattr("mask")? {
            return Err(refused(
                "a masked array is not allowed: give one that is filled".to_owned(),
            ));
        }
        Ok(Self(object.extract()?))
    }
}

/// Kinds of numpy's types that are real numbers, or objects that may be.
const REAL: [&str; 5] = ["b", "i", "u", "f", "O"];

impl Numbers<'_> {
    pub(crate) fn shape(&self) -> Vec<usize> {
        self.0.as_array().shape().to_vec()
    }

    /// All numbers in the order of rows.
    pub(crate) fn flat(&self) -> Vec<f64> {
        self.0.as_array().iter().copied().collect()
    }

    /// The shape in words, for messages.
    pub(crate) fn shape_in_words(&self) -> String {
        format!("of the shape {:?}", self.shape())
    }

    /// Vectors from rows of up to three numbers; what is left out is 0.
    fn rows(&self, length: usize) -> Vec<Vector3<f64>> {
        let row = |row: &[f64]| Vector3::from_fn(|i, _| row.get(i).copied().unwrap_or(0.0));
        self.flat().chunks(length).map(row).collect()
    }

    /// One number, or as many as an array of one dimension has.
    pub(crate) fn list(&self, what: &'static str) -> PyResult<Vec<f64>> {
        if self.shape().len() > 1 {
            let allowed = "give one number, or an array of one dimension";
            return Err(input(what, self.shape_in_words(), allowed));
        }
        Ok(self.flat())
    }

    /// As many numbers as `N`.
    pub(crate) fn exactly<const N: usize>(&self, what: &'static str) -> PyResult<[f64; N]> {
        let refused = || {
            let allowed = format!("give an array of the shape ({N},)");
            input(what, self.shape_in_words(), allowed)
        };
        if self.shape().len() != 1 {
            return Err(refused());
        }
        self.flat().try_into().map_err(|_| refused())
    }

    /// Points in space: the last dimension has two coordinates, of which the third is 0, or three.
    pub(crate) fn points(&self, what: &'static str) -> PyResult<Vec<Vector3<f64>>> {
        let length = match self.shape().last() {
            Some(&length @ (2 | 3)) => length,
            _ => {
                let allowed = "give an array of the shape (..., 3), or (..., 2) for z = 0";
                return Err(input(what, self.shape_in_words(), allowed));
            }
        };
        let points = self.rows(length);
        match (points.iter()).position(|point| !point.iter().all(|x| x.abs() <= FARTHEST)) {
            Some(index) => {
                let [x, y, z] = points[index].into();
                let value = format!("[{x:?}, {y:?}, {z:?}] (point {index})");
                let allowed = format!("give coordinates from -{FARTHEST:e} to {FARTHEST:e}");
                Err(input(what, value, allowed))
            }
            None => Ok(points),
        }
    }

    /// Rows with one of the `allowed` numbers of entries each; what is left out is 0.
    pub(crate) fn vectors(
        &self,
        what: &'static str,
        allowed: &[usize],
    ) -> PyResult<Vec<Vector3<f64>>> {
        match self.shape()[..] {
            [_, length] if allowed.contains(&length) => Ok(self.rows(length)),
            _ => {
                let shapes: Vec<String> = allowed.iter().map(|n| format!("(n, {n})")).collect();
                let allowed = format!("give an array of the shape {}", shapes.join(" or "));
                Err(input(what, self.shape_in_words(), allowed))
            }
        }
    }
}

/// What is called with the work that is running: number, name, pieces done, all pieces if they are known.
pub(crate) struct Show<'py>(pub Bound<'py, PyAny>);

impl<'a, 'py> FromPyObject<'a, 'py> for Show<'py> {
    type Error = PyErr;

    const INPUT_TYPE: PyStaticExpr = type_hint_subscript!(
        type_hint_identifier!("collections.abc", "Callable"),
        PyStaticExpr::List {
            elts: &[type_hint_subscript!(
                type_hint_identifier!("builtins", "list"),
                type_hint_subscript!(
                    type_hint_identifier!("builtins", "tuple"),
                    type_hint_identifier!("builtins", "int"),
                    type_hint_identifier!("builtins", "str"),
                    type_hint_identifier!("builtins", "int"),
                    type_hint_union!(
                        type_hint_identifier!("builtins", "int"),
                        PyStaticExpr::Constant {
                            value: PyStaticConstant::None
                        }
                    )
                )
            )]
        },
        PyStaticExpr::Constant {
            value: PyStaticConstant::None
        }
    );

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        Ok(Self(object.to_owned()))
    }
}
