"""Studies: many runs, and what follows from them."""

from __future__ import annotations

from . import _native
from ._models import as_models, models_of_family
from ._progress import shower
from ._table import Table

TYPE_CHECKING = False
if TYPE_CHECKING:
    import os
    from collections.abc import Iterable, Mapping

    import numpy.typing as npt

    from ._native import Model

    Models = str | Model | Iterable[str | Model]
    PathLike = str | os.PathLike[str]

_INFINITY = float("inf")


def _of_axes(axes: Mapping[str, npt.ArrayLike]) -> list[tuple[str, npt.ArrayLike]]:
    from collections.abc import Mapping

    if not isinstance(axes, Mapping):
        raise TypeError(f"axes are a mapping of names to values, not {type(axes).__name__}")
    return list(axes.items())


def _share(partition: str | tuple[int, int] | None) -> str | None:
    if partition is None or isinstance(partition, str):
        return partition
    return "/".join(str(number) for number in partition)


def sweep(
    family: PathLike,
    axes: Mapping[str, npt.ArrayLike],
    models: Models | None = None,
    *,
    out: PathLike | None = None,
    partition: str | tuple[int, int] | None = None,
    tolerance: float | None = None,
    angles_at: float = _INFINITY,
    time_limit: float | None = None,
    fresh: bool = False,
    progress: bool | None = None,
) -> Table:
    """Runs a family of scenes along some of its parameters, by several models, on all threads.

    With a folder `out` the rows are kept there as they finish, in the files of ``squirmers sweep``: after Ctrl-C or a time limit the same call goes on
    with the rest, and so does the command line. A run that fails is a row with the outcome ``failed``; the logger ``squirmers`` has the reason.

    Parameters
    ----------
    family : str or path
        ``"opposed"``, ``"right-angles"``, ``"incoming-angles"`` or another family that ships, or the path of a scene file with parameters.
    axes : mapping of str to array_like, shape (n,)
        Parameters of the family and their values; the last one varies fastest. Parameters that are not named have their defaults.
    models : str, Model or iterable of them, optional
        The models, each with a name of its own; by default the one that the family's file names, or else ``"lt"`` and ``"exact"``.
    out : path, optional
        Folder for ``sweep.csv`` and its manifest ``sweep.json``. Without it nothing is kept.
    partition : str or pair of int, optional
        Run only share m of n: ``"m/n"`` or ``(m, n)``, m from 1. `merge` merges the folders of all shares.
    tolerance : float, optional
        Tolerance of the integrator for each step, 1e-14 to 1e-2; by default that of the family's file.
    angles_at : float, default infinity
        Distance of the centres at which outgoing angles are read, in radii of the larger squirmer: 12 as in the paper, or infinity for the limit.
    time_limit : float, optional
        Begin no further part of the sweep after so many seconds; needs `out`. Rows that are left out have the outcome ``skipped``.
    fresh : bool, default False
        Whether what another interrupted sweep kept in `out` is deleted.
    progress : bool, optional
        Whether to show progress by tqdm; by default in a terminal or a notebook.

    Returns
    -------
    Table
        A row for each model and point, with the columns of ``sweep.csv`` (docs/COLUMNS.md). Its dimensions are ``method`` and the axes.

    Raises
    ------
    InputError
        If an axis, a value, a model or a setting is not allowed, or a point is not a valid scene.
    FileError
        If a file or folder cannot be read or written, or keeps what another sweep has finished.
    KeyboardInterrupt
        After Ctrl-C; it says what is kept.

    Examples
    --------
    >>> import squirmers
    >>> table = squirmers.sweep("opposed", {"beta": [5.0], "dx": [1.0, 2.0]}, "exact")
    >>> table["deflection1_deg"].round(3)
    array([-11.698,  -3.991])
    """
    parts = _native.sweep(
        family,
        _of_axes(axes),
        models_of_family(family, models),
        out=out,
        fresh=fresh,
        partition=_share(partition),
        tolerance=tolerance,
        angles_at=angles_at,
        time_limit=time_limit,
        show=shower(progress),
    )
    return Table(*parts, ("method", *axes))


def merge(folders: Iterable[PathLike], out: PathLike | None = None) -> Table:
    """Merges the shares of a sweep, in any order, into what the whole sweep gives, byte by byte.

    Parameters
    ----------
    folders : iterable of path
        Folders of all shares, as `sweep` with `partition`, ``squirmers sweep --partition`` or ``squirmers collisions --partition`` writes them.
    out : path, optional
        Folder for the merged rows and their manifest; none of `folders`. Without it nothing is kept.

    Returns
    -------
    Table
        All rows.

    Raises
    ------
    FileError
        If a share is missing, given twice, unfinished, damaged or of another sweep; the text names it.
    """
    parts, file, arithmetics = _native.merge(list(folders), out)
    if arithmetics > 1:
        import logging

        logging.getLogger("squirmers").warning(
            "the shares come from %d kinds of arithmetic: last digits may differ from those of one machine (sweep.json names them)",
            arithmetics,
        )
    names = [column[0] for column in parts[0]]
    of_sweep = file == "sweep.csv"
    return Table(*parts, ("method", *names[: names.index("method")]) if of_sweep else ())


def scatter(
    beta: npt.ArrayLike = (0, 1, 5, -1, -5),
    models: Models = ("lt", "exact"),
    *,
    g: npt.ArrayLike = 0.0,
    grid: int = 100,
    out: PathLike | None = None,
    tolerance: float = 1e-7,
    angles_at: float = _INFINITY,
    time_limit: float | None = None,
    fresh: bool = False,
    progress: bool | None = None,
) -> Table:
    """Maps collisions over all incoming angles in the plane: the paper's Figs 2 to 4.

    Two equal squirmers with the paper's repulsion start at a gap of 1, with the angles ``phi1 = pi (sigma - delta)/2`` and
    ``phi2 = pi (sigma + delta)/2`` from the line of centres.

    Parameters
    ----------
    beta : array_like, shape (n,), default (0, 1, 5, -1, -5)
        Squirmer parameters.
    models : str, Model or iterable of them, default ("lt", "exact")
        The models, each with a name of its own.
    g : array_like, shape (n,), default 0
        Bottom-heavinesses, with gravity along -y.
    grid : int, default 100
        Points a side, evenly spaced from 0.01 to 1.99 in delta and sigma, 2 to 2000. An even number avoids the singular lines delta = 1 and sigma = 1.
    out : path, optional
        Folder for ``scatter.csv``, which keeps finished lines as `sweep` does.
    tolerance : float, default 1e-7
        Tolerance of the integrator for each step, 1e-14 to 1e-2.
    angles_at : float, default infinity
        Distance of the centres at which outgoing angles are read, in radii.
    time_limit : float, optional
        Begin no further line of a map after so many seconds; needs `out`.
    fresh : bool, default False
        Whether what another interrupted study kept in `out` is deleted.
    progress : bool, optional
        Whether to show progress by tqdm; by default in a terminal or a notebook.

    Returns
    -------
    Table
        A row for each run, with the columns of ``scatter.csv`` (docs/COLUMNS.md). Its dimensions are ``method``, ``beta``, ``g``, ``sigma`` and ``delta``.

    Raises
    ------
    InputError
        If an argument is not allowed.
    FileError
        If the folder cannot be written, or keeps what another study has finished.
    ComputationError
        If the time limit left lines out; the same call goes on.
    KeyboardInterrupt
        After Ctrl-C; it says what is kept.

    Examples
    --------
    >>> import squirmers
    >>> squirmers.scatter(5.0, "exact", grid=10).to_xarray()["outcome"].shape
    (1, 1, 1, 10, 10)
    """
    parts = _native.scatter(
        beta,
        as_models(models),
        g=g,
        grid=grid,
        out=out,
        fresh=fresh,
        tolerance=tolerance,
        angles_at=angles_at,
        time_limit=time_limit,
        show=shower(progress),
    )
    return Table(*parts, ("method", "beta", "g", "sigma", "delta"))


def fates(
    beta: npt.ArrayLike = range(-10, 11),
    models: Models = ("lt", "exact"),
    *,
    g: npt.ArrayLike = 0.0,
    grid: int = 100,
    out: PathLike | None = None,
    tolerance: float = 1e-7,
    angles_at: float = _INFINITY,
    time_limit: float | None = None,
    fresh: bool = False,
    progress: bool | None = None,
) -> Table:
    """Shares of the outcomes over all incoming angles in the plane: the paper's Fig. 5(a).

    Parameters
    ----------
    beta : array_like, shape (n,), default -10, -9, ..., 10
        Squirmer parameters.
    models : str, Model or iterable of them, default ("lt", "exact")
        The models, each with a name of its own.
    g : array_like, shape (n,), default 0
        Bottom-heavinesses, with gravity along -y.
    grid : int, default 100
        Points a side, as of `scatter`.
    out : path, optional
        Folder for ``fates.csv``, which keeps finished lines as `sweep` does.
    tolerance, angles_at, time_limit, fresh, progress
        As of `scatter`.

    Returns
    -------
    Table
        A row for each model, beta and g, with the columns of ``fates.csv`` (docs/COLUMNS.md). Its dimensions are ``method``, ``beta`` and ``g``.

    Raises
    ------
    InputError, FileError, ComputationError, KeyboardInterrupt
        As of `scatter`.

    Examples
    --------
    >>> import squirmers
    >>> squirmers.fates(5.0, "lt", grid=10)["pairwise"]
    array([0.32])
    """
    parts = _native.fates(
        beta,
        as_models(models),
        g=g,
        grid=grid,
        out=out,
        fresh=fresh,
        tolerance=tolerance,
        angles_at=angles_at,
        time_limit=time_limit,
        show=shower(progress),
    )
    return Table(*parts, ("method", "beta", "g"))


def bound_states(
    models: Models = ("lt", "exact"), beta: npt.ArrayLike = (0, 1, 5, -1, -5)
) -> Table:
    """Bound states of two equal squirmers in the plane, with the paper's repulsion: stable and unstable ones.

    Parameters
    ----------
    models : str, Model or iterable of them, default ("lt", "exact")
        The models, each with a name of its own.
    beta : array_like, shape (n,), default (0, 1, 5, -1, -5)
        Squirmer parameters.

    Returns
    -------
    Table
        A row for each state, by model, beta and rising growth rate, with the columns of ``bound-states.csv`` (docs/COLUMNS.md).

    Raises
    ------
    InputError
        If an argument is not allowed.

    Examples
    --------
    >>> import squirmers
    >>> states = squirmers.bound_states("exact", [5.0, -5.0])
    >>> stable = states["stable_in_plane"] == "yes"
    >>> states["outcome"][stable].tolist(), states["beta"][stable].tolist()
    (['anticlockwise'], [5.0])
    """
    parts = _native.bound_states(as_models(models), beta)
    return Table(*parts)


class Sensitivity(Table):
    """How sensitive collisions are: a row for each case and model.

    Attributes
    ----------
    derivatives : Table
        Every derivative of the outgoing headings: a row for each case, model, number that changes and angle that answers.
    """

    __slots__ = ("derivatives",)

    derivatives: Table


def sensitivity(
    family: PathLike | None = None,
    axes: Mapping[str, npt.ArrayLike] | None = None,
    models: Models = ("lt", "exact", "bem"),
    *,
    out: PathLike | None = None,
    tolerance: float | None = None,
    time_limit: float | None = None,
    fresh: bool = False,
    progress: bool | None = None,
) -> Sensitivity:
    """Derivatives of collisions by everything that a scene is made of, and how far a squirmer can be offset out of the plane.

    Parameters
    ----------
    family : str or path, optional
        A family as of `sweep`; by default the paper's encounters, opposed and at right angles.
    axes : mapping of str to array_like, shape (n,), optional
        Parameters of the family and their values, as of `sweep`. Only with `family`.
    models : str, Model or iterable of them, default ("lt", "exact", "bem")
        The models, each with a name of its own.
    out : path, optional
        Folder for ``sensitivity.csv`` and ``sensitivity-derivatives.csv``, which keeps finished cases as `sweep` does.
    tolerance : float, optional
        Tolerance of the integrator for each step; by default 1e-10, or that of the family's file if it is tighter.
    time_limit : float, optional
        Begin no further case after so many seconds; needs `out`.
    fresh : bool, default False
        Whether what another interrupted study kept in `out` is deleted.
    progress : bool, optional
        Whether to show progress by tqdm; by default in a terminal or a notebook.

    Returns
    -------
    Sensitivity
        A table with the columns of ``sensitivity.csv`` (docs/COLUMNS.md) and the dimensions ``method``, ``case`` and the axes. Its
        ``derivatives`` have the columns of ``sensitivity-derivatives.csv``, and the dimensions ``by`` and ``of`` besides.

    Raises
    ------
    InputError
        If an argument is not allowed, or a point is not a valid scene.
    FileError
        If a file or folder cannot be read or written, or keeps what another study has finished.
    ComputationError
        If the time limit left cases out; the same call goes on.
    KeyboardInterrupt
        After Ctrl-C; it says what is kept.

    Examples
    --------
    >>> import squirmers
    >>> table = squirmers.sensitivity("right-angles", {"beta": [1.0], "dx": [1.0]}, "exact")
    >>> table["offset_6deg"].round(3)
    array([0.031])
    >>> len(table.derivatives)
    60
    """
    if family is None and axes is not None:
        from ._errors import InputError

        raise InputError("axes without family are not allowed: give a family, or neither")
    of_axes = [] if axes is None else _of_axes(axes)
    cases, derivatives = _native.sensitivity(
        family,
        of_axes,
        as_models(models),
        out=out,
        fresh=fresh,
        tolerance=tolerance,
        time_limit=time_limit,
        show=shower(progress),
    )
    names = [column[0] for column in cases[0]]
    dims = ("method", *names[: names.index("method")])
    table = Sensitivity(*cases, dims)
    table.derivatives = Table(*derivatives, (*dims, "by", "of"))
    return table


class Kinetics(Table):
    """What collisions do to a dilute suspension: a row for each model, beta and largest impact parameter.

    Attributes
    ----------
    ratios : Table
        What each other model makes of each coefficient of the exact one; no rows without the model ``"exact"``.
    """

    __slots__ = ("ratios",)

    ratios: Table


def kinetics(
    beta: npt.ArrayLike = range(-5, 6),
    models: Models = ("lt", "lt-corrected", "exact"),
    *,
    impact: npt.ArrayLike = 3.0,
    count: int = 256,
    replications: int = 8,
    out: PathLike | None = None,
    tolerance: float = 1e-6,
    angles_at: float = _INFINITY,
    time_limit: float | None = None,
    fresh: bool = False,
    progress: bool | None = None,
) -> Kinetics:
    """What collisions in three dimensions do to a dilute suspension: diffusivities, alignment, and growth of polar order.

    Collision integrals by quasi-random encounters with errors from independent replications; docs/KINETICS.md has the definitions.

    Parameters
    ----------
    beta : array_like, shape (n,), default -5, -4, ..., 5
        Squirmer parameters.
    models : str, Model or iterable of them, default ("lt", "lt-corrected", "exact")
        The models, each with a name of its own. All have the same encounters.
    impact : array_like, shape (n,), default 3
        Largest impact parameters of an encounter, in radii, up to 1000; 3 is that of the straight paths that reach the gap 1.
    count : int, default 256
        Encounters of a replication, and of each ring between two impact parameters, 1 to 65,536.
    replications : int, default 8
        Independent replications, from which errors follow, 2 to 1024.
    out : path, optional
        Folder for ``kinetics.csv`` and ``kinetics-ratios.csv``, which keeps finished parts as `sweep` does.
    tolerance : float, default 1e-6
        Tolerance of the integrator for each step, 1e-14 to 1e-2.
    angles_at : float, default infinity
        Distance of the centres at which outgoing headings are read, in radii.
    time_limit : float, optional
        Begin no further part of the integrals after so many seconds; needs `out`.
    fresh : bool, default False
        Whether what another interrupted study kept in `out` is deleted.
    progress : bool, optional
        Whether to show progress by tqdm; by default in a terminal or a notebook.

    Returns
    -------
    Kinetics
        A table with the columns of ``kinetics.csv`` (docs/COLUMNS.md) and the dimensions ``method``, ``beta`` and ``impact``. Its ``ratios`` have
        the columns of ``kinetics-ratios.csv``, and the dimension ``quantity`` besides.

    Raises
    ------
    InputError
        If an argument is not allowed.
    FileError
        If the folder cannot be written, or keeps what another study has finished.
    ComputationError
        If the time limit left parts out; the same call goes on.
    KeyboardInterrupt
        After Ctrl-C; it says what is kept.

    Examples
    --------
    >>> import squirmers
    >>> table = squirmers.kinetics(5.0, ["lt", "exact"], count=16)
    >>> len(table), len(table.ratios)
    (2, 6)
    """
    rows, ratios = _native.kinetics(
        beta,
        as_models(models),
        impact=impact,
        count=count,
        replications=replications,
        out=out,
        fresh=fresh,
        tolerance=tolerance,
        angles_at=angles_at,
        time_limit=time_limit,
        show=shower(progress),
    )
    dims = ("method", "beta", "impact")
    table = Kinetics(*rows, dims)
    table.ratios = Table(*ratios, (*dims, "quantity"))
    return table
