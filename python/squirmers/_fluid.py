"""The fluid about a pair at one instant: its flow, and what the pair does to it."""

from __future__ import annotations

from . import _native
from ._errors import InputError
from ._loads import _parts
from ._models import as_model
from ._progress import shower
from ._table import Table

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Literal

    import matplotlib.axes
    import numpy as np
    import numpy.typing as npt

    from ._native import Model, Scene


class _Instant:
    """A pair at one instant, as it moves.

    Attributes
    ----------
    scene : Scene
        The scene.
    model : str
        Name of the model.
    time : float
        Time from the start, in ``a/V_s``.
    gap : float
        Gap between the surfaces, in radii of the first squirmer.
    positions : ndarray, shape (2, 3)
        Centres, in radii of the first squirmer.
    orientations : ndarray, shape (2, 3)
        Unit vectors of the swimming directions.
    velocities : ndarray, shape (2, 3)
        Velocities of the centres, in ``V_s``.
    angular_velocities : ndarray, shape (2, 3)
        Angular velocities, in ``V_s/a``, with the spin of each squirmer about its own axis.
    """

    __slots__ = ("angular_velocities", "gap", "model", "orientations", "positions", "scene", "time", "velocities")

    def __init__(self, scene: Scene, model: str, pair: _native.Pair) -> None:
        self.scene = scene
        self.model = model
        self.time = pair.time
        self.gap = pair.gap
        self.positions = pair.positions
        self.orientations = pair.orientations
        self.velocities = pair.velocities
        self.angular_velocities = pair.angular_velocities


class Flow(_Instant):
    """The flow about a pair at some points, at one instant. The fluid is at rest far away.

    Attributes
    ----------
    points : ndarray, shape (..., 3)
        The points, in radii of the first squirmer.
    velocity : ndarray, shape (..., 3)
        Velocity of the fluid in the laboratory, in ``V_s``. NaN inside the squirmers, where there is no fluid; on their surfaces it is that of
        the surface.
    pressure : ndarray, shape (...)
        Pressure, zero far away, in ``mu V_s/a``. NaN inside the squirmers.
    error_estimate : float
        Estimate of the largest error of the velocity anywhere in the fluid, in ``V_s``.
    scene : Scene
        The scene.
    model : str
        Name of the model.
    time : float
        Time from the start, in ``a/V_s``.
    gap : float
        Gap between the surfaces, in radii of the first squirmer.
    positions, orientations : ndarray, shape (2, 3)
        Centres, in radii of the first squirmer, and unit vectors of the swimming directions.
    velocities, angular_velocities : ndarray, shape (2, 3)
        Of the squirmers, in ``V_s`` and ``V_s/a``.
    """

    __slots__ = ("error_estimate", "points", "pressure", "velocity")

    points: npt.NDArray[np.float64]
    velocity: npt.NDArray[np.float64]
    pressure: npt.NDArray[np.float64]
    error_estimate: float

    def __repr__(self) -> str:
        shape = self.points.shape[:-1]
        return f"<Flow by {self.model} at time {self.time:.6g}, gap {self.gap:.4g}: points of the shape {shape}>"

    def plot(self, ax: matplotlib.axes.Axes | None = None) -> matplotlib.axes.Axes:
        """Draws the speed as colours, with streamlines and the squirmers. Needs matplotlib.

        The points must be a regular grid in a plane of constant z, of the shape (ny, nx, 3), as ``numpy.meshgrid`` makes them of two ranges. Streamlines
        follow the velocity within the plane; colours are the whole speed.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; by default a new figure.

        Returns
        -------
        matplotlib.axes.Axes
            The axes.

        Raises
        ------
        InputError
            If the points are no such grid.

        Examples
        --------
        >>> import numpy as np
        >>> import squirmers
        >>> grid = np.stack(np.meshgrid(np.linspace(-4, 4, 60), np.linspace(-8, 8, 120)), axis=-1)
        >>> scene = squirmers.Scene.of("opposed", beta=5.0, dx=1.0)
        >>> ax = squirmers.flow(scene, grid, time="closest").plot()
        """
        from ._plots import streamlines

        return streamlines(self, ax)


class Stresslet(_Instant):
    """Stresslets, power and efficiency of a pair at one instant; docs/FLUID.md defines them.

    Attributes
    ----------
    stresslets : ndarray, shape (2, 3, 3)
        Stresslet of each squirmer after Batchelor (1970), symmetric and without trace, in ``mu a^2 V_s``: positive along the axis of a puller.
    lone : ndarray, shape (2, 3, 3)
        Those of lone squirmers with the same orientations, ``4 pi mu a^2 B_2 (p p - I/3)``.
    slip_power : ndarray, shape (2,)
        Rate of work of each squirmer's slip on the fluid, in ``mu a V_s^2``.
    external_power : float
        Rate of work of repulsion and gravity on the pair, in ``mu a V_s^2``.
    dissipation : float
        What the fluid dissipates, in ``mu a V_s^2``.
    efficiencies : ndarray, shape (2,)
        Lighthill's efficiency of each squirmer, ``6 pi mu a U^2`` over its slip power; NaN where its slip does no work.
    budget : float
        Difference of the dissipation from the work of slip, repulsion and gravity, over the dissipation: a measure of the errors of the model.
    scene : Scene
        The scene.
    model : str
        Name of the model.
    time : float
        Time from the start, in ``a/V_s``.
    gap : float
        Gap between the surfaces, in radii of the first squirmer.
    positions, orientations : ndarray, shape (2, 3)
        Centres, in radii of the first squirmer, and unit vectors of the swimming directions.
    velocities, angular_velocities : ndarray, shape (2, 3)
        Of the squirmers, in ``V_s`` and ``V_s/a``.
    """

    __slots__ = ("budget", "dissipation", "efficiencies", "external_power", "lone", "slip_power", "stresslets")

    def __init__(self, scene: Scene, model: str, found: _native.Stresslet) -> None:
        super().__init__(scene, model, found.pair)
        self.stresslets = found.stresslets
        self.lone = found.lone
        self.slip_power = found.slip_power
        self.external_power = found.external_power
        self.dissipation = found.dissipation
        self.efficiencies = found.efficiencies
        self.budget = found.budget

    def __repr__(self) -> str:
        one, two = self.slip_power
        return f"<Stresslet by {self.model} at time {self.time:.6g}, gap {self.gap:.4g}: slip power {one:.4g} and {two:.4g}>"


def _instant(time: float | Literal["closest"] | None, gap: float | None) -> tuple[float | None, float | None, bool]:
    """The time, the gap, and whether the closest approach is asked for."""
    if time is not None and gap is not None:
        raise InputError(f"gap {gap!r} is not allowed with a time: give one of the two")
    if isinstance(time, str):
        if time != "closest":
            raise InputError(f"time {time!r} is not allowed: give a number, or 'closest' for the closest approach")
        return None, None, True
    return time, gap, False


def flow(
    scene: Scene,
    points: npt.ArrayLike,
    model: str | Model = "exact",
    *,
    time: float | Literal["closest"] | None = None,
    gap: float | None = None,
    progress: bool | None = None,
) -> Flow:
    """The flow about the pair of a scene at some points, at one instant.

    The squirmers swim freely, as they do in the run of the scene. Points are computed in parallel.

    Parameters
    ----------
    scene : Scene
        The scene.
    points : array_like, shape (..., 3) or (..., 2)
        The points, in radii of the first squirmer. Without a third coordinate it is 0.
    model : str or Model, default "exact"
        A model that knows the flow: ``"exact"`` or ``"bem"``.
    time : float or "closest", optional
        Time from the start, in ``a/V_s``, or ``"closest"`` for the instant of the smallest gap of the run; by default the start.
    gap : float, optional
        The first instant at which the pair has this gap, in radii of the first squirmer, in place of a time.
    progress : bool, optional
        Whether to show progress by tqdm; by default in a terminal or a notebook.

    Returns
    -------
    Flow
        Velocity and pressure at the points, NaN inside the squirmers, and the pair at that instant.

    Raises
    ------
    InputError
        If the points have another shape or are not finite, the run has no such instant, or the model knows no flow.
    ComputationError
        If a solve or the run fails.

    Examples
    --------
    >>> import squirmers
    >>> scene = squirmers.Scene(squirmers.Squirmer(beta=5.0), [(0, 0), (3, 0)], angles_deg=(90, 90))
    >>> squirmers.flow(scene, [(1.5, 0.0), (0.0, 0.5)]).velocity.round(3)
    array([[-0.   , -0.294,  0.   ],
           [   nan,    nan,    nan]])
    """
    import numpy as np

    of = as_model(model)
    pair, velocity, pressure, error = _native.flow(scene, points, of, *_instant(time, gap), shower(progress))
    given = np.asarray(points, dtype=float)
    shape = given.shape[:-1]
    found = Flow(scene, of.name, pair)
    found.points = np.zeros((*shape, 3))
    found.points[..., : given.shape[-1]] = given
    found.velocity = velocity.reshape(*shape, 3)
    found.pressure = pressure.reshape(shape)
    found.error_estimate = error
    return found


def stresslet(
    scene: Scene,
    model: str | Model = "exact",
    *,
    time: float | Literal["closest"] | None = None,
    gap: float | None = None,
    progress: bool | None = None,
) -> Stresslet:
    """Stresslets, power and efficiency of the pair of a scene at one instant.

    Parameters
    ----------
    scene : Scene
        The scene.
    model : str or Model, default "exact"
        A model that knows the flow: ``"exact"`` or ``"bem"``.
    time : float or "closest", optional
        Time from the start, in ``a/V_s``, or ``"closest"`` for the instant of the smallest gap of the run; by default the start.
    gap : float, optional
        The first instant at which the pair has this gap, in radii of the first squirmer, in place of a time.
    progress : bool, optional
        Whether to show progress by tqdm; by default in a terminal or a notebook.

    Returns
    -------
    Stresslet
        The stresslets of both squirmers, and what they spend.

    Raises
    ------
    InputError
        If the run has no such instant, or the model knows no flow.
    ComputationError
        If a solve or the run fails.

    Examples
    --------
    >>> import squirmers
    >>> scene = squirmers.Scene(squirmers.Squirmer(beta=5.0), [(0, 0), (3, 0)], angles_deg=(90, 90))
    >>> squirmers.stresslet(scene).stresslets[0].round(2)
    array([[-36.13,  -0.44,   0.  ],
           [ -0.44,  64.69,   0.  ],
           [  0.  ,   0.  , -28.57]])
    """
    of = as_model(model)
    found = _native.stresslet(scene, of, *_instant(time, gap), shower(progress))
    return Stresslet(scene, of.name, found)


class Stresses(Table):
    """Stresslets and rates of work at some gaps: a column for the gap, and one for each number.

    Attributes
    ----------
    errors : Table
        Estimates of the errors, each divided by the larger of the number and 1: differences from a finer or coarser solution.
    """

    __slots__ = ("errors",)

    errors: Table


def stresses(
    model: str | Model,
    gaps: npt.ArrayLike,
    *,
    modes: int = 2,
    swirl_modes: int = 0,
    ratio: float = 1.0,
    progress: bool | None = None,
) -> Stresses:
    """Stresslets and rates of work by motion and by slip, at some gaps.

    Each is solved for. Names, signs and units are those of docs/FLUID.md, and of ``stress.csv`` of the command line.

    Parameters
    ----------
    model : str or Model
        A model that knows the flow: ``"exact"`` or ``"bem"``.
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
    Stresses
        A table with a row for each gap: the column ``gap`` and one for each number, such as ``XS1_2``.

    Raises
    ------
    InputError
        If a gap, a mode or the ratio is not allowed, or the model knows no flow.

    Examples
    --------
    >>> import squirmers
    >>> squirmers.stresses("exact", [1.0, 1000.0])["XS1_2"].round(6)
    array([4.309755, 4.      ])
    """
    names, values, errors = _native.stresses(as_model(model), gaps, modes, swirl_modes, ratio, shower(progress))
    table = Stresses(*_parts(gaps, names, values, "Stresslet or rate of work, a pure number."))
    table.errors = Table(*_parts(gaps, names, errors, "Estimate of the error of the number."))
    return table
