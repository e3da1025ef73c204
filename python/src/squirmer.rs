//! `Squirmer`.

use ::scene::Squirmer as Native;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyTuple};

use crate::array::Numbers;
use crate::error::{input, of_scene};

/// A squirmer: a sphere that swims by a steady slip of its surface.
///
/// The slip at the surface point with unit normal ``n`` is, for the unit orientation ``p`` and ``c = p.n``,
/// ``u = sum_n B_n W_n(c) (c n - p) + C_n W_n(c) p x n`` with ``W_n = 2 P_n'(c)/(n (n + 1))``
/// (Blake 1971; Pak & Lauga 2014).
///
/// Parameters
/// ----------
/// beta : float, optional
///     ``B_2/B_1``: pullers have ``beta > 0``, pushers ``beta < 0``. Not together with `modes`.
/// speed : float, default 1
///     Swimming speed of the lone squirmer, ``V_s = 2 B_1/3``. Only with `beta`.
/// modes : array_like, shape (n,), optional
///     Slip modes ``B_1, B_2, ...``, at most eight, in units of ``V_s``. None at all (an empty list) make a passive sphere.
/// swirl_modes : array_like, shape (n,), optional
///     Swirl modes ``C_1, C_2, ...``, at most eight, in units of ``V_s``.
/// radius : float, default 1
///     Radius, in radii of the first squirmer of a scene, from 0.01 to 100.
/// bottom_heaviness : float, default 0
///     ``G_bh = 4 pi rho g a h/(3 mu V_s)`` with the squirmer's own radius ``a``.
///
/// Raises
/// ------
/// InputError
///     If a number is not finite or not allowed, or if both or neither of `beta` and `modes` are given.
///
/// Examples
/// --------
/// >>> import squirmers
/// >>> squirmers.Squirmer(beta=5.0).modes
/// [1.5, 7.5]
#[pyclass(frozen, eq, module = "squirmers")]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct Squirmer(pub Native);

#[pymethods]
impl Squirmer {
    #[new]
    #[pyo3(signature = (beta=None, *, speed=None, modes=None, swirl_modes=None, radius=1.0, bottom_heaviness=0.0))]
    fn new(
        beta: Option<f64>,
        speed: Option<f64>,
        modes: Option<Numbers<'_>>,
        swirl_modes: Option<Numbers<'_>>,
        radius: f64,
        bottom_heaviness: f64,
    ) -> PyResult<Self> {
        let lone = match (beta, modes) {
            (Some(beta), None) => Native::with_beta(speed.unwrap_or(1.0), beta),
            (None, Some(modes)) if speed.is_none() => Native::new(&modes.list("modes")?),
            (None, Some(_)) => {
                let allowed = "modes say how fast it swims: give one of the two";
                return Err(input("speed", "with modes", allowed));
            }
            (Some(_), Some(_)) => {
                return Err(input("beta", "with modes", "give one of the two"));
            }
            (None, None) => {
                return Err(input("beta", "none", "give beta or modes"));
            }
        };
        let swirl = match &swirl_modes {
            Some(modes) => modes.list("swirl_modes")?,
            None => Vec::new(),
        };
        let whole = lone
            .and_then(|squirmer| squirmer.with_swirl(&swirl))
            .and_then(|squirmer| squirmer.with_radius(radius))
            .and_then(|squirmer| squirmer.bottom_heavy(bottom_heaviness));
        Ok(Self(whole.map_err(of_scene)?))
    }

    /// Slip modes ``B_1, B_2, ...`` up to the highest that is not zero, in units of ``V_s``.
    #[getter]
    fn modes(&self) -> &[f64] {
        self.0.modes()
    }

    /// Swirl modes ``C_1, C_2, ...`` up to the highest that is not zero, in units of ``V_s``.
    #[getter]
    fn swirl_modes(&self) -> &[f64] {
        self.0.swirl()
    }

    /// ``B_2/B_1``; NaN of a squirmer that does not swim.
    #[getter]
    fn beta(&self) -> f64 {
        let (first, second) = (self.0.mode(0), self.0.mode(1));
        if first.abs() > 0.0 {
            second / first
        } else {
            f64::NAN
        }
    }

    /// Swimming speed of the lone squirmer, ``2 B_1/3``, in units of ``V_s``.
    #[getter]
    fn speed(&self) -> f64 {
        self.0.swimming_speed()
    }

    /// Radius, in radii of the first squirmer of a scene.
    #[getter]
    fn radius(&self) -> f64 {
        self.0.radius()
    }

    /// Bottom-heaviness ``G_bh``.
    #[getter]
    fn bottom_heaviness(&self) -> f64 {
        self.0.bottom_heaviness()
    }

    fn __repr__(&self) -> String {
        let of = &self.0;
        let mut text = format!("Squirmer(modes={:?}", of.modes());
        if !of.swirl().is_empty() {
            text += &format!(", swirl_modes={:?}", of.swirl());
        }
        #[expect(clippy::float_cmp, reason = "the default is exactly one")]
        if of.radius() != 1.0 {
            text += &format!(", radius={:?}", of.radius());
        }
        if of.bottom_heaviness().abs() > 0.0 {
            text += &format!(", bottom_heaviness={:?}", of.bottom_heaviness());
        }
        text + ")"
    }

    /// What pickles keep.
    #[pyo3(signature = () -> "tuple[tuple[()], dict[str, object]]")]
    fn __getnewargs_ex__<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<(Bound<'py, PyTuple>, Bound<'py, PyDict>)> {
        let named = PyDict::new(py);
        named.set_item("modes", self.0.modes())?;
        named.set_item("swirl_modes", self.0.swirl())?;
        named.set_item("radius", self.0.radius())?;
        named.set_item("bottom_heaviness", self.0.bottom_heaviness())?;
        Ok((PyTuple::empty(py), named))
    }
}
