"""Loads and coefficients of motion by gap."""

from __future__ import annotations

from . import _native
from ._models import as_model
from ._progress import shower
from ._table import Table

TYPE_CHECKING = False
if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from ._native import Model


def _parts(
    gaps: npt.ArrayLike, names: list[str], values: npt.NDArray[np.float64], meaning: str
) -> tuple[list[tuple[str, str, str]], list[npt.NDArray[np.generic] | list[str]], str, tuple[str]]:
    """What a table of numbers by gap is made of."""
    import numpy as np

    columns = [("gap", "a", "Gap between the surfaces of the squirmers.")]
    columns += [(name, "-", meaning) for name in names]
    of_columns = [np.atleast_1d(np.asarray(gaps, dtype=float)), *values.T]
    lines = [",".join(_quoted(column[0]) for column in columns)]
    lines += [",".join(repr(float(cell)) for cell in row) for row in zip(*of_columns, strict=True)]
    return columns, [*of_columns], "\n".join(lines) + "\n", ("gap",)


def _quoted(name: str) -> str:
    return f'"{name}"' if "," in name else name


class Loads(Table):
    """Loads at some gaps: a column for the gap, and one for each load.

    Attributes
    ----------
    errors : Table
        The model's own estimates of the errors, each divided by the larger of the load and 1; NaN for a closed form, which has none.
    """

    __slots__ = ("errors",)

    errors: Table


def loads(
    model: str | Model,
    gaps: npt.ArrayLike,
    *,
    modes: int = 2,
    swirl_modes: int = 0,
    ratio: float = 1.0,
    progress: bool | None = None,
) -> Loads:
    """Forces and torques on two spheres, by motion and by slip, at some gaps.

    Each is solved for. Names, signs and units are those of docs/REFERENCE.md: resistance scalars after Kim & Karrila (1991), and
    loads by slip per ``pi mu a B_n``. Spheres of unlike radii have a load for each sphere that is loaded and each one that moves or squirms.

    Parameters
    ----------
    model : str or Model
        The model.
    gaps : array_like, shape (n,)
        Gaps between the surfaces, in radii of sphere 1, each greater than 0.
    modes : int, default 2
        Highest slip mode, 0 to 8.
    swirl_modes : int, default 0
        Highest swirl mode, 0 to 8.
    ratio : float, default 1
        Radius of sphere 2 over that of sphere 1, 0.01 to 100.
    progress : bool, optional
        Whether to show progress by tqdm; by default in a terminal or a notebook.

    Returns
    -------
    Loads
        A table with a row for each gap: the column ``gap`` and one for each load, such as ``X11A``.

    Raises
    ------
    InputError
        If a gap, a mode or the ratio is not allowed, or the model has no loads there.

    Examples
    --------
    >>> import squirmers
    >>> squirmers.loads("exact", [0.01, 1.0])["X11A"].round(6)
    array([27.034008,  1.36848 ])
    """
    names, values, errors = _native.loads(
        as_model(model), gaps, modes, swirl_modes, ratio, shower(progress)
    )
    table = Loads(*_parts(gaps, names, values, "Load, a pure number."))
    table.errors = Table(*_parts(gaps, names, errors, "Estimate of the error of the load."))
    return table


def mobility(
    model: str | Model,
    gaps: npt.ArrayLike,
    *,
    modes: int = 2,
    swirl_modes: int = 0,
    ratio: float = 1.0,
) -> Table:
    """How each cause moves a pair of free spheres, at some gaps: what trajectories are made of.

    Parameters
    ----------
    model : str or Model
        The model.
    gaps : array_like, shape (n,)
        Gaps between the surfaces, in radii of sphere 1, each greater than 0.
    modes : int, default 2
        Highest slip mode, 0 to 8.
    swirl_modes : int, default 0
        Highest swirl mode, 0 to 8.
    ratio : float, default 1
        Radius of sphere 2 over that of sphere 1, 0.01 to 100.

    Returns
    -------
    Table
        A row for each gap: the column ``gap`` and one for each coefficient, named by its effect and its cause, such as
        ``mean velocity along d by q1 - q2, mode 1``. docs/MODELS.md has the list with units.

    Raises
    ------
    InputError
        If a gap, a mode or the ratio is not allowed, or the model has no loads there.
    """
    names, values = _native.coefficients(as_model(model), gaps, modes, swirl_modes, ratio)
    return Table(*_parts(gaps, names, values, "Coefficient of motion."))
