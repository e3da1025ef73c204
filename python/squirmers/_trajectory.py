"""Runs of a scene."""

from __future__ import annotations

from . import _native
from ._models import model_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from types import SimpleNamespace
    from typing import Any

    import matplotlib.axes
    import numpy as np
    import numpy.typing as npt
    import pandas

    from ._native import Model, Scene


class Trajectory:
    """What became of a scene under a model.

    Samples are at multiples of the sample interval, with the start, the end and changes of phase (contact, free flight).

    Attributes
    ----------
    scene : Scene
        The scene.
    model : str
        Name of the model.
    """

    __slots__ = ("_run", "model", "scene")

    def __init__(self, run: _native.Run | SimpleNamespace, scene: Scene, model: str) -> None:
        self._run = run
        self.scene = scene
        self.model = model

    @property
    def time(self) -> npt.NDArray[np.float64]:
        """Times of the samples, shape (n,), in ``a/V_s``."""
        return self._run.time

    @property
    def positions(self) -> npt.NDArray[np.float64]:
        """Centres, shape (n, 2, 3): sample, squirmer, coordinate. In radii of the first squirmer."""
        return self._run.positions

    @property
    def orientations(self) -> npt.NDArray[np.float64]:
        """Unit vectors of the swimming directions, shape (n, 2, 3)."""
        return self._run.orientations

    @property
    def angles_deg(self) -> npt.NDArray[np.float64]:
        """Angles of the swimming directions' projections on the x-y plane, shape (n, 2), in degrees; they wind."""
        return self._run.angles_deg

    @property
    def gap(self) -> npt.NDArray[np.float64]:
        """Gaps between the surfaces, shape (n,), in radii of the first squirmer."""
        return self._run.gap

    @property
    def outcome(self) -> str:
        """What became of the pair: ``scattered``, ``pairwise``, ``standoff`` and so on."""
        return self._run.outcome

    @property
    def deflections_deg(self) -> npt.NDArray[np.float64]:
        """Outgoing minus incoming angle of each squirmer, shape (2,), in degrees, anticlockwise positive; it winds.

        Of a pair that parts without gravity outgoing means at infinite distance, otherwise at the end of the run. NaN of a run that ends in
        contact or where the model ceases to resolve the gap.
        """
        return self._run.deflections_deg

    @property
    def truncation_deg(self) -> float:
        """Estimate of how far the deflections are from their limit at infinite distance, in degrees."""
        return self._run.truncation_deg

    @property
    def min_gap(self) -> float:
        """Smallest gap on the way, in radii of the first squirmer."""
        return self._run.min_gap

    @property
    def tau(self) -> float:
        """Interaction time: the time at gaps up to the smaller radius, in ``a/V_s``."""
        return self._run.tau

    @property
    def end_time(self) -> float:
        """Time at the end, in ``a/V_s``."""
        return self._run.end_time

    @property
    def settled(self) -> float | None:
        """Time from which on the pair was in a steady bound state; None if it never was."""
        return self._run.settled

    @property
    def steps(self) -> int:
        """Accepted steps of the integrator."""
        return self._run.steps

    @property
    def seconds(self) -> float:
        """Wall-clock time of the run, in seconds."""
        return self._run.seconds

    def __len__(self) -> int:
        return len(self.time)

    def __reduce__(self) -> tuple[Any, ...]:
        return _kept, (self.scene, self.model, {name: getattr(self._run, name) for name in _KEPT})

    def __repr__(self) -> str:
        one, two = self.deflections_deg
        return (
            f"<Trajectory by {self.model}: {self.outcome}, deflections {one:.3f} and {two:.3f} deg, "
            f"smallest gap {self.min_gap:.4g}>"
        )

    def to_pandas(self) -> pandas.DataFrame:
        """A row for each sample, with the columns of ``run.csv`` of the command line. Needs pandas."""
        import pandas

        columns: dict[str, Any] = {"t": self.time}
        for name, vectors in (("", self.positions), ("p", self.orientations)):
            for k in (0, 1):
                for i, axis in enumerate("xyz"):
                    columns[f"{name}{axis}{k + 1}"] = vectors[:, k, i]
        for k in (0, 1):
            columns[f"angle{k + 1}_deg"] = self.angles_deg[:, k]
        columns["gap"] = self.gap
        return pandas.DataFrame(columns)

    def plot(self, ax: matplotlib.axes.Axes | None = None) -> matplotlib.axes.Axes:
        """Draws both paths in the x-y plane, with the squirmers at the start, where they are closest, and at the end. Needs matplotlib.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; by default a new figure.

        Returns
        -------
        matplotlib.axes.Axes
            The axes.
        """
        from ._plots import paths

        return paths(self, ax)


#: Numbers of a run that a pickle keeps.
_KEPT = (
    "time",
    "positions",
    "orientations",
    "angles_deg",
    "gap",
    "outcome",
    "deflections_deg",
    "truncation_deg",
    "min_gap",
    "tau",
    "end_time",
    "settled",
    "steps",
    "seconds",
)


def _kept(scene: Scene, model: str, numbers: dict[str, Any]) -> Trajectory:
    """The trajectory of a pickle."""
    from types import SimpleNamespace

    return Trajectory(SimpleNamespace(**numbers), scene, model)


def run(
    scene: Scene,
    model: str | Model | None = None,
    *,
    end_time: float | None = None,
    tolerance: float | None = None,
    sample_interval: float | None = None,
    samples: bool = True,
    departure_distance: float | None = None,
    angles_at: float | None = None,
    max_steps: int | None = None,
) -> Trajectory:
    """Runs a scene under a model.

    Settings that are not given are those of the scene's file, or else the defaults that are named here.

    Parameters
    ----------
    scene : Scene
        The scene.
    model : str or Model, optional
        The model; by default that of the scene's file, or else ``"exact"``.
    end_time : float, optional
        Time at which the run ends at the latest, in ``a/V_s``; 200.
    tolerance : float, optional
        Tolerance of the integrator for each step; 1e-8.
    sample_interval : float, optional
        Time between samples, in ``a/V_s``; 0.05.
    samples : bool, default True
        Whether to keep samples. Without them a run takes less time, and the trajectory has its numbers alone.
    departure_distance : float, optional
        Distance of the centres at which a receding pair has parted, in radii of the larger squirmer; 12.
    angles_at : float, optional
        Distance of the centres at which outgoing angles are read, in radii of the larger squirmer; infinity.
    max_steps : int, optional
        Steps after which a run is given up; 1,000,000.

    Returns
    -------
    Trajectory
        The run.

    Raises
    ------
    InputError
        If a setting is not allowed, or the model is not one for the radii of the scene.
    ComputationError
        If the run fails.

    Examples
    --------
    >>> import squirmers
    >>> scene = squirmers.Scene.of("opposed", beta=5.0, dx=1.0)
    >>> squirmers.run(scene, "exact")
    <Trajectory by exact: scattered, deflections -11.698 and -11.698 deg, smallest gap 0.01737>
    """
    of = model_of(scene, model)
    native = _native.run(
        scene,
        of,
        end_time=end_time,
        tolerance=tolerance,
        departure_distance=departure_distance,
        angles_at=angles_at,
        sample_interval=sample_interval,
        samples=samples,
        max_steps=max_steps,
    )
    return Trajectory(native, scene, of.name)
