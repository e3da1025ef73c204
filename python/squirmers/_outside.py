"""What functions return and tables hold, as arrays for the library."""

from __future__ import annotations

from ._errors import InputError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable
    from typing import Any

    import numpy as np
    import numpy.typing as npt

    Floats = npt.NDArray[np.float64]
    Read = tuple[list[str], Floats, Floats | None, list[str], Floats]

QUANTITIES = "give a mapping from the names of docs/JUDGE.md to arrays"
MATRICES = "give matrices of the shape (n, 12, 12), or a mapping with them under 'matrix'"


def _columns(table: object) -> tuple[list[Any], Callable[[Any], Any]] | None:
    """Names of the columns and what gives one of them; None of what has no columns."""
    names: Iterable[Any] | None = getattr(getattr(table, "dtype", None), "names", None)
    if names is None and callable(getattr(table, "keys", None)):
        names = table.keys()  # type: ignore[attr-defined]
    if names is None:
        names = getattr(table, "names", None)
    get = getattr(table, "__getitem__", None)
    if names is None or callable(names) or get is None:
        return None
    return list(names), get


def _shown(value: object) -> str:
    text = " ".join(repr(value).split())
    return text if len(text) <= 60 else text[:57] + "..."


def _refused(who: str, what: str, allowed: str) -> InputError:
    return InputError(f"model '{who}': {what} is not allowed: {allowed}")


def _numbers(who: str, what: str, value: object) -> Floats:
    import numpy as np

    try:
        array = np.asarray(value)
        if array.dtype.kind not in "biuf":
            # Columns of objects, as data frames have them, may hold numbers.
            if array.dtype.kind != "O" or not array.size or any(isinstance(cell, (str, bytes, type(None))) for cell in array.flat):
                raise TypeError
        return np.asarray(array, dtype=float)
    except (TypeError, ValueError):
        raise _refused(who, f"{what} {_shown(value)}", "give numbers") from None


def _shaped(who: str, what: str, value: object, shape: tuple[int, ...]) -> Floats:
    """Numbers of a shape; one number stands for all gaps."""
    import numpy as np

    array = _numbers(who, what, value)
    if array.shape == () and len(shape) == 1:
        array = np.full(shape, float(array))
    if array.shape != shape:
        raise _refused(who, f"{what} of the shape {array.shape}", f"give the shape {shape}, the first number that of the gaps")
    return array


def _checked_names(who: str, names: list[Any]) -> list[str]:
    for name in names:
        if not isinstance(name, str):
            raise _refused(who, f"name {_shown(name)}", QUANTITIES)
        if names.count(name) > 1:
            raise _refused(who, f"name '{name}', which is there twice,", "give each once")
    return names


def answered(said: object, gaps: Floats, who: str, matrix: bool) -> Read:
    """The numbers of an answer at gaps, each checked for its shape."""
    import numpy as np

    n = len(gaps)
    columns = _columns(said)
    if columns is None:
        if not matrix or said is None or isinstance(said, (str, bytes)):
            raise _refused(who, f"what its function returns, {_shown(said)},", MATRICES if matrix else QUANTITIES)
        return [], np.empty((n, 0)), _shaped(who, "an array", said, (n, 12, 12)), [], np.empty((n, 0, 12))
    names, get = columns
    names = _checked_names(who, names)
    if "gap" in names:
        own = _shaped(who, "column gap", get("gap"), (n,))
        if not np.allclose(own, gaps, rtol=1e-9, atol=0.0):
            raise _refused(who, f"column gap {_shown(own)}", "give the gaps of the question, or leave it out")
        names = [name for name in names if name != "gap"]
    if not matrix:
        if "matrix" in names:
            raise _refused(who, "a matrix", "say what it is by matrix='mobility' or 'resistance'")
        values = [_shaped(who, f"'{name}'", get(name), (n,)) for name in names]
        return names, np.stack(values, axis=1) if values else np.empty((n, 0)), None, [], np.empty((n, 0, 12))
    if "matrix" not in names:
        raise _refused(who, f"a mapping with {', '.join(names) or 'nothing'}", MATRICES)
    slip = [name for name in names if name != "matrix"]
    of_slip = [_shaped(who, f"slip column '{name}'", get(name), (n, 12)) for name in slip]
    return (
        [],
        np.empty((n, 0)),
        _shaped(who, "'matrix'", get("matrix"), (n, 12, 12)),
        slip,
        np.stack(of_slip, axis=1) if of_slip else np.empty((n, 0, 12)),
    )


def tabled(table: object, who: str, matrix: bool) -> tuple[Floats, Read]:
    """The gaps of a table, and its numbers."""
    columns = _columns(table)
    if columns is None:
        raise _refused(who, f"table {_shown(table)}", "give a mapping, data frame or structured array with a column 'gap'")
    names, get = columns
    if "gap" not in names:
        raise _refused(who, f"a table with the columns {_shown(names)}", "one of them must be 'gap'")
    gaps = _numbers(who, "column gap", get("gap"))
    if gaps.ndim != 1:
        raise _refused(who, f"column gap of the shape {gaps.shape}", "give the shape (n,)")
    return gaps, answered(table, gaps, who, matrix)
