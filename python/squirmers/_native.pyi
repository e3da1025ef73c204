"""
`squirmers._native`.
"""

from _typeshed import SupportsGetItem, SupportsLenAndGetItem
from collections.abc import Callable
from numpy import float64
from numpy.typing import ArrayLike, NDArray
from os import PathLike
from typing import Any, Final, SupportsFloat, SupportsIndex, final
from typing_extensions import disjoint_base

__all__ = ["__version__", "Model", "Pair", "Run", "Scene", "Squirmer", "Stresslet", "bound_states", "coefficients", "family_model", "fates", "flow", "judge", "kinetics", "leaderboard", "loads", "merge", "reference_files", "run", "scatter", "sensitivity", "set_threads", "stresses", "stresslet", "sweep"]

__version__: Final[str]
"""
Version of the library.
"""

@disjoint_base
class Model:
    """
    A hydrodynamic model: what answers for the fluid.

    A model sets up its tables when they are first needed, keeps them, and reads them from the disk the next time.

    Parameters
    ----------
    name : str
        ``"lt"`` (lubrication theory as published), ``"lt-corrected"``, ``"exact"``, ``"bem"`` (boundary elements) or ``"none"`` (no interaction).
    level : int, optional
        Level of the mesh of boundary elements. Only of ``"bem"``.
    direct : bool, default False
        Whether every load is solved for, in place of being read from a table: much slower, and without interpolation error.
    cache : path, optional
        Folder that keeps tables; by default the user's cache folder.

    Raises
    ------
    InputError
        If there is no such model or level.

    Examples
    --------
    >>> import squirmers
    >>> squirmers.Model("exact").name
    'exact'
    """
    def __new__(cls, /, name: str, *, level: SupportsIndex | None = None, direct: bool = False, cache: str | PathLike[str] | None = None) -> Model: ...
    def __repr__(self, /) -> str: ...
    @staticmethod
    def from_callable(f: Callable[[NDArray[float64]], object], *, name: str = "model", range: tuple[SupportsFloat | SupportsIndex, SupportsFloat | SupportsIndex], matrix: str | None = None, noise: SupportsFloat | SupportsIndex | None = None, model: str | None = None, version: str | None = None, citation: str | None = None, call: str | None = None, radius: SupportsFloat | SupportsIndex = 1.0, viscosity: SupportsFloat | SupportsIndex = 1.0, mode_units: ArrayLike | None = None, slip_calibration: ArrayLike | None = None) -> Model:
        """
        A model that asks a function for its numbers.

        The function gets an array of gaps, shape (n,), and returns named quantities of docs/JUDGE.md at these gaps: a mapping, table or structured array
        of arrays of the shape (n,). With `matrix` it returns mobility or resistance matrices, shape (n, 12, 12), or a mapping with them under
        ``"matrix"`` and slip columns such as ``"B1_1z"`` beside them, shape (n, 12). NaN says that there is no answer at a gap: judging leaves that gap out, a
        table for the motion needs all. It is called few times, each time for many gaps, and once for a gap; always by one thread at a time for a table,
        not by the main one. What it raises comes out as it is. It may call this package, but not for its own model.

        Before the model moves pairs its answers are put into a table, down to `noise`.

        Parameters
        ----------
        f : callable
            The function.
        name : str, default "model"
            Name of the model in tables. One of the same name that was made before keeps its own function, where it is still in use.
        range : tuple of float
            Smallest and largest gap for which it answers, in the unit of `radius`. Pairs that part are followed to a gap of 10.
        matrix : {"mobility", "resistance"}, optional
            What the matrices are. Without it the function returns named quantities.
        noise : float, default 1e-9
            Size of the noise of its numbers, relative to the larger of the number and 1.
        model, version, citation, call : str, optional
            Name of the code, its version, where it is published, how it is called.
        radius, viscosity : float, default 1
            Units of the gaps and matrices.
        mode_units : array_like, shape (m,), optional
            How many ``B_n`` one unit of each slip mode is.
        slip_calibration : array_like, shape (m,), optional
            Factors for what each slip mode causes.

        Returns
        -------
        Model
            The model.

        Raises
        ------
        InputError
            If an argument is not allowed. What the function returns is looked at when it is first asked.

        Examples
        --------
        Two spheres that feel each other's far field along the line of centres:

        >>> import squirmers
        >>> def far_field(gaps):
        ...     return {"x11a": 1.0, "x12a": 1.5 / (gaps + 2)}
        >>> model = squirmers.Model.from_callable(far_field, name="far", range=(1e-3, 1e4))
        >>> squirmers.judge(model).trusted_down_to
        {1: 4.0, 5: 1.0, 20: 0.5}
        """
    @staticmethod
    def from_file(path: str | PathLike[str], *, name: str | None = None) -> Model:
        """
        A model of a file of named values or matrices, as docs/JUDGE.md has it.

        Parameters
        ----------
        path : path
            The CSV file, with its header.
        name : str, optional
            Name of the model in tables; by default that of the file, without its ending.

        Returns
        -------
        Model
            The model.

        Raises
        ------
        FileError
            If the file cannot be read.
        InputError
            The first mistake in it, or a name that is not allowed.
        """
    @staticmethod
    def from_table(table: Any, *, name: str = "model", matrix: str | None = None, interpolation: str | None = None, model: str | None = None, version: str | None = None, citation: str | None = None, call: str | None = None, machine: str | None = None, radius: SupportsFloat | SupportsIndex = 1.0, viscosity: SupportsFloat | SupportsIndex = 1.0, mode_units: ArrayLike | None = None, slip_calibration: ArrayLike | None = None, seconds_per_gap: SupportsFloat | SupportsIndex | None = None) -> Model:
        """
        A model of numbers at some gaps, as a file holds them.

        Parameters
        ----------
        table : mapping, pandas.DataFrame, structured array or Table
            A column ``gap``, shape (n,), and a column for each named quantity of docs/JUDGE.md, shape (n,); NaN where it is not known. With `matrix` the
            column ``matrix``, shape (n, 12, 12), and perhaps slip columns such as ``B1_1z``, shape (n, 12).
        name : str, default "model"
            Name of the model in tables.
        matrix : {"mobility", "resistance"}, optional
            What the matrices are.
        interpolation : {"linear", "log-linear", "log-cubic", "none"}, optional
            How the model's own code reads values between the gaps. If it is left out, judging scores nothing between them, and motion reads cubics
            in the logarithm of the gap.
        model, version, citation, call, machine : str, optional
            Name of the code, its version, where it is published, how it was called, on what machine.
        radius, viscosity : float, default 1
            Units of the gaps and matrices.
        mode_units : array_like, shape (m,), optional
            How many ``B_n`` one unit of each slip mode is.
        slip_calibration : array_like, shape (m,), optional
            Factors for what each slip mode causes.
        seconds_per_gap : float, optional
            Time of one gap, in seconds.

        Returns
        -------
        Model
            The model. One of too few gaps can be judged, and moves no pair.

        Raises
        ------
        InputError
            If an argument or a number in the table is not allowed.

        Examples
        --------
        >>> import squirmers
        >>> far = {"gap": [0.1, 1.0, 38.0], "x11a": [1.0, 1.0, 1.0], "x12a": [0.7143, 0.5, 0.0375]}
        >>> squirmers.Model.from_table(far, name="far")
        <Model far>
        """
    @property
    def name(self, /) -> str:
        """
        Its name, which stands in tables.
        """

@final
class Pair:
    """
    A pair at one instant.
    """
    @property
    def angular_velocities(self, /) -> NDArray[float64]: ...
    @property
    def gap(self, /) -> float: ...
    @property
    def orientations(self, /) -> NDArray[float64]: ...
    @property
    def positions(self, /) -> NDArray[float64]: ...
    @property
    def time(self, /) -> float: ...
    @property
    def velocities(self, /) -> NDArray[float64]: ...

@final
class Run:
    """
    A run from start to end; `squirmers.Trajectory` shows it.
    """
    @property
    def angles_deg(self, /) -> NDArray[float64]: ...
    @property
    def deflections_deg(self, /) -> NDArray[float64]: ...
    @property
    def end_time(self, /) -> float: ...
    @property
    def gap(self, /) -> NDArray[float64]: ...
    @property
    def min_gap(self, /) -> float: ...
    @property
    def orientations(self, /) -> NDArray[float64]: ...
    @property
    def outcome(self, /) -> str: ...
    @property
    def positions(self, /) -> NDArray[float64]: ...
    @property
    def seconds(self, /) -> float: ...
    @property
    def settled(self, /) -> float | None: ...
    @property
    def steps(self, /) -> int: ...
    @property
    def tau(self, /) -> float: ...
    @property
    def time(self, /) -> NDArray[float64]: ...
    @property
    def truncation_deg(self, /) -> float: ...

@final
class Scene:
    """
    Two squirmers, where they start, and the effects that act on them.

    Lengths are in radii ``a`` of the first squirmer, times in ``a/V_s``, angles in degrees, anticlockwise from the x axis.

    Parameters
    ----------
    squirmers : Squirmer or pair of Squirmer
        The two; one alone stands for both. The first has radius 1.
    positions : array_like, shape (2, 2) or (2, 3)
        Centres. Without a third coordinate it is 0.
    angles_deg : array_like, shape (2,), optional
        Swimming directions in the x-y plane, in degrees; they may wind. Not together with `orientations`.
    orientations : array_like, shape (2, 3), optional
        Swimming directions in space, of any length.
    repulsion : pair of float or "paper", optional
        ``(kappa1, kappa2)`` of the repulsion at short range, both greater than 0: the force is ``kappa1 kappa2 e/(1 - e)`` with
        ``e = exp(-kappa2 gap)``, per ``mu a V_s``; ``"paper"`` stands for the paper's (10, 100). Without it there is none, and squirmers may touch.
    gravity : array_like, shape (3,), optional
        Direction of gravity, of any length. It turns squirmers with bottom-heaviness.

    Raises
    ------
    InputError
        If a number is not finite, a direction has no length, the spheres overlap or touch, or a shape is wrong.

    Examples
    --------
    >>> import squirmers
    >>> puller = squirmers.Squirmer(beta=5.0)
    >>> scene = squirmers.Scene(puller, [(-0.5, 5.0), (0.5, -5.0)], angles_deg=(-90, 90), repulsion="paper")
    >>> round(scene.gap, 3)
    8.05
    """
    def __eq__(self, value: object, /) -> bool: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __new__(cls, /, squirmers: Any, positions: ArrayLike, *, angles_deg: ArrayLike | None = None, orientations: ArrayLike | None = None, repulsion: tuple[float, float] | str | None = None, gravity: ArrayLike | None = None) -> Scene: ...
    def __reduce__(self, /) -> "tuple[object, ...]":
        """
        What pickles keep: a call that makes the same scene.
        """
    def __repr__(self, /) -> str: ...
    def _model(self, /) -> tuple[str, int | None, bool]:
        """
        Name, level and directness of the model that the scene's file names, or else of the exact one.
        """
    @staticmethod
    def _of_parts(squirmers: Any, positions: SupportsLenAndGetItem[SupportsLenAndGetItem[SupportsFloat | SupportsIndex]], *, orientation0: Any, orientation1: Any, repulsion: tuple[SupportsFloat | SupportsIndex, SupportsFloat | SupportsIndex] | None, gravity: SupportsLenAndGetItem[SupportsFloat | SupportsIndex] | None) -> Scene:
        """
        The scene of a pickle.
        """
    @property
    def angles_deg(self, /) -> NDArray[float64]:
        """
        Angles of the swimming directions' projections on the x-y plane, shape (2,), in degrees.
        """
    @staticmethod
    def from_toml(text: str, /, **parameters: "float") -> Scene:
        """
        A scene from the text of a scene file, with values for its parameters.

        Parameters
        ----------
        text : str
            Text in TOML; docs/SCENES.md lists its keys.
        **parameters : float
            Values of parameters of the file; the others have their defaults.

        Returns
        -------
        Scene
            The scene, with the run settings and the model of the file.

        Raises
        ------
        InputError
            Every mistake in the text, each with line and column.
        """
    @property
    def gap(self, /) -> float:
        """
        Gap between the surfaces at the start, in radii of the first squirmer.
        """
    @property
    def gravity(self, /) -> NDArray[float64] | None:
        """
        Unit vector along which gravity pulls, shape (3,); None if there is none.
        """
    @property
    def model(self, /) -> str | None:
        """
        Name of the model that the scene's file names; None if it names none.
        """
    @staticmethod
    def of(name: str | PathLike[str], /, **parameters: "float") -> Scene:
        """
        A scene from a scene file, or from one of the families that ship, with values for its parameters.

        Parameters
        ----------
        name : str
            ``"opposed"``, ``"right-angles"``, ``"incoming-angles"`` or another family that ships, or the path of a scene file.
        **parameters : float
            Values of parameters; the others have their defaults.

        Returns
        -------
        Scene
            The scene, with the run settings and the model of the file.

        Raises
        ------
        FileError
            If the file cannot be read.
        InputError
            Every mistake in it, each with line and column.

        Examples
        --------
        >>> import squirmers
        >>> squirmers.Scene.of("opposed", beta=5.0, dx=1.0).angles_deg
        array([-90.,  90.])
        """
    @property
    def orientations(self, /) -> NDArray[float64]:
        """
        Unit vectors of the swimming directions at the start, shape (2, 3).
        """
    @property
    def positions(self, /) -> NDArray[float64]:
        """
        Centres at the start, shape (2, 3), in radii of the first squirmer.
        """
    @property
    def repulsion(self, /) -> tuple[float, float] | None:
        """
        ``(kappa1, kappa2)`` of the repulsion; None if there is none.
        """
    @property
    def squirmers(self, /) -> tuple[Squirmer, Squirmer]:
        """
        The two squirmers.
        """

@final
class Squirmer:
    """
    A squirmer: a sphere that swims by a steady slip of its surface.

    The slip at the surface point with unit normal ``n`` is, for the unit orientation ``p`` and ``c = p.n``,
    ``u = sum_n B_n W_n(c) (c n - p) + C_n W_n(c) p x n`` with ``W_n = 2 P_n'(c)/(n (n + 1))``
    (Blake 1971; Pak & Lauga 2014).

    Parameters
    ----------
    beta : float, optional
        ``B_2/B_1``: pullers have ``beta > 0``, pushers ``beta < 0``. Not together with `modes`.
    speed : float, default 1
        Swimming speed of the lone squirmer, ``V_s = 2 B_1/3``. Only with `beta`.
    modes : array_like, shape (n,), optional
        Slip modes ``B_1, B_2, ...``, at most eight, in units of ``V_s``. None at all (an empty list) make a passive sphere.
    swirl_modes : array_like, shape (n,), optional
        Swirl modes ``C_1, C_2, ...``, at most eight, in units of ``V_s``.
    radius : float, default 1
        Radius, in radii of the first squirmer of a scene, from 0.01 to 100.
    bottom_heaviness : float, default 0
        ``G_bh = 4 pi rho g a h/(3 mu V_s)`` with the squirmer's own radius ``a``.

    Raises
    ------
    InputError
        If a number is not finite or not allowed, or if both or neither of `beta` and `modes` are given.

    Examples
    --------
    >>> import squirmers
    >>> squirmers.Squirmer(beta=5.0).modes
    [1.5, 7.5]
    """
    def __eq__(self, value: object, /) -> bool: ...
    def __getnewargs_ex__(self, /) -> "tuple[tuple[()], dict[str, object]]":
        """
        What pickles keep.
        """
    def __ne__(self, value: object, /) -> bool: ...
    def __new__(cls, /, beta: SupportsFloat | SupportsIndex | None = None, *, speed: SupportsFloat | SupportsIndex | None = None, modes: ArrayLike | None = None, swirl_modes: ArrayLike | None = None, radius: SupportsFloat | SupportsIndex = 1.0, bottom_heaviness: SupportsFloat | SupportsIndex = 0.0) -> Squirmer: ...
    def __repr__(self, /) -> str: ...
    @property
    def beta(self, /) -> float:
        """
        ``B_2/B_1``; NaN of a squirmer that does not swim.
        """
    @property
    def bottom_heaviness(self, /) -> float:
        """
        Bottom-heaviness ``G_bh``.
        """
    @property
    def modes(self, /) -> list[float]:
        """
        Slip modes ``B_1, B_2, ...`` up to the highest that is not zero, in units of ``V_s``.
        """
    @property
    def radius(self, /) -> float:
        """
        Radius, in radii of the first squirmer of a scene.
        """
    @property
    def speed(self, /) -> float:
        """
        Swimming speed of the lone squirmer, ``2 B_1/3``, in units of ``V_s``.
        """
    @property
    def swirl_modes(self, /) -> list[float]:
        """
        Swirl modes ``C_1, C_2, ...`` up to the highest that is not zero, in units of ``V_s``.
        """

@final
class Stresslet:
    """
    Stresslets and power of a pair; `squirmers.Stresslet` shows them.
    """
    @property
    def budget(self, /) -> float: ...
    @property
    def dissipation(self, /) -> float: ...
    @property
    def efficiencies(self, /) -> NDArray[float64]: ...
    @property
    def external_power(self, /) -> float: ...
    @property
    def lone(self, /) -> NDArray[float64]: ...
    @property
    def pair(self, /) -> Pair: ...
    @property
    def slip_power(self, /) -> NDArray[float64]: ...
    @property
    def stresslets(self, /) -> NDArray[float64]: ...

def bound_states(models: SupportsGetItem[int, Model], beta: ArrayLike) -> tuple[list[tuple[str, str, str]], list[Any], str]:
    """
    The bound states of every model and squirmer parameter.
    """

def coefficients(model: Model, gaps: ArrayLike, modes: SupportsIndex, swirl_modes: SupportsIndex, ratio: SupportsFloat | SupportsIndex) -> tuple[list[str], NDArray[float64]]:
    """
    Coefficients of motion at gaps, each solved for.
    """

def family_model(name: str | PathLike[str]) -> tuple[str, int | None, bool] | None:
    """
    Name, level and directness of the model that a family's file names.
    """

def fates(beta: ArrayLike, models: SupportsGetItem[int, Model], *, g: ArrayLike, grid: SupportsIndex, out: str | PathLike[str] | None, fresh: bool, tolerance: SupportsFloat | SupportsIndex, angles_at: SupportsFloat | SupportsIndex, time_limit: SupportsFloat | SupportsIndex | None, show: Callable[[list[tuple[int, str, int, int | None]]], None] | None) -> tuple[list[tuple[str, str, str]], list[Any], str]:
    """
    Maps over the incoming angles: the shares of the outcomes.
    """

def flow(scene: Scene, points: ArrayLike, model: Model, time: SupportsFloat | SupportsIndex | None, gap: SupportsFloat | SupportsIndex | None, closest: bool, show: Callable[[list[tuple[int, str, int, int | None]]], None] | None) -> tuple[Pair, NDArray[float64], NDArray[float64], float]:
    """
    The flow about a pair at some points.
    """

def judge(model: Model, exact: Model, grid: SupportsIndex, gaps: ArrayLike | None, show: Callable[[list[tuple[int, str, int, int | None]]], None] | None) -> tuple[str, tuple[list[tuple[str, str, str]], list[Any], str], list[tuple[str, float, float, bool]]]:
    """
    Judges a model; `exact` is the model that its collisions are compared with. The scorecard as JSON, its rows, and its errors by group.
    """

def kinetics(beta: ArrayLike, models: SupportsGetItem[int, Model], *, impact: ArrayLike, count: SupportsIndex, replications: SupportsIndex, out: str | PathLike[str] | None, fresh: bool, tolerance: SupportsFloat | SupportsIndex, angles_at: SupportsFloat | SupportsIndex, time_limit: SupportsFloat | SupportsIndex | None, show: Callable[[list[tuple[int, str, int, int | None]]], None] | None) -> tuple[tuple[list[tuple[str, str, str]], list[Any], str], tuple[list[tuple[str, str, str]], list[Any], str]]:
    """
    Collision integrals, and what each model makes of those of the exact one.
    """

def leaderboard(show: Callable[[list[tuple[int, str, int, int | None]]], None] | None) -> tuple[list[tuple[str, str, str]], list[Any], str]:
    """
    The leaderboard: public codes and the models of this library, by rising score.
    """

def loads(model: Model, gaps: ArrayLike, modes: SupportsIndex, swirl_modes: SupportsIndex, ratio: SupportsFloat | SupportsIndex, show: Callable[[list[tuple[int, str, int, int | None]]], None] | None) -> tuple[list[str], NDArray[float64], NDArray[float64]]:
    """
    Loads at gaps, each solved for.
    """

def merge(folders: SupportsGetItem[int, str | PathLike[str]], out: str | PathLike[str] | None) -> tuple[tuple[list[tuple[str, str, str]], list[Any], str], str, int]:
    """
    Merges the shares of a sweep. Also names the file of the rows, and says how many kinds of arithmetic they come from.
    """

def reference_files() -> list[tuple[str, str]]:
    """
    The files of the package of reference numbers, by name.
    """

def run(scene: Scene, model: Model, *, end_time: SupportsFloat | SupportsIndex | None = None, tolerance: SupportsFloat | SupportsIndex | None = None, departure_distance: SupportsFloat | SupportsIndex | None = None, angles_at: SupportsFloat | SupportsIndex | None = None, sample_interval: SupportsFloat | SupportsIndex | None = None, samples: bool = True, max_steps: SupportsIndex | None = None) -> Run:
    """
    Runs a scene under a model.
    """

def scatter(beta: ArrayLike, models: SupportsGetItem[int, Model], *, g: ArrayLike, grid: SupportsIndex, out: str | PathLike[str] | None, fresh: bool, tolerance: SupportsFloat | SupportsIndex, angles_at: SupportsFloat | SupportsIndex, time_limit: SupportsFloat | SupportsIndex | None, show: Callable[[list[tuple[int, str, int, int | None]]], None] | None) -> tuple[list[tuple[str, str, str]], list[Any], str]:
    """
    Maps over the incoming angles: a row for each run.
    """

def sensitivity(name: str | PathLike[str] | None, axes_of: SupportsGetItem[int, tuple[str, ArrayLike]], models: SupportsGetItem[int, Model], *, out: str | PathLike[str] | None, fresh: bool, tolerance: SupportsFloat | SupportsIndex | None, time_limit: SupportsFloat | SupportsIndex | None, show: Callable[[list[tuple[int, str, int, int | None]]], None] | None) -> tuple[tuple[list[tuple[str, str, str]], list[Any], str], tuple[list[tuple[str, str, str]], list[Any], str]]:
    """
    How sensitive collisions are: of a family along some of its parameters, or else of the paper's encounters.
    """

def set_threads(threads: SupportsIndex) -> None:
    """
    Sets the number of threads for all further work of this process, once, before any.
    """

def stresses(model: Model, gaps: ArrayLike, modes: SupportsIndex, swirl_modes: SupportsIndex, ratio: SupportsFloat | SupportsIndex, show: Callable[[list[tuple[int, str, int, int | None]]], None] | None) -> tuple[list[str], NDArray[float64], NDArray[float64]]:
    """
    Stresslets and rates of work at gaps, each solved for.
    """

def stresslet(scene: Scene, model: Model, time: SupportsFloat | SupportsIndex | None, gap: SupportsFloat | SupportsIndex | None, closest: bool, show: Callable[[list[tuple[int, str, int, int | None]]], None] | None) -> Stresslet:
    """
    Stresslets and power of a pair at an instant.
    """

def sweep(name: str | PathLike[str], axes_of: SupportsGetItem[int, tuple[str, ArrayLike]], models: SupportsGetItem[int, Model], *, out: str | PathLike[str] | None, fresh: bool, partition: str | None, tolerance: SupportsFloat | SupportsIndex | None, angles_at: SupportsFloat | SupportsIndex, time_limit: SupportsFloat | SupportsIndex | None, show: Callable[[list[tuple[int, str, int, int | None]]], None] | None) -> tuple[list[tuple[str, str, str]], list[Any], str]:
    """
    Runs a family along some of its parameters.
    """
