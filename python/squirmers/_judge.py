"""Models judged against exact hydrodynamics."""

from __future__ import annotations

import json

from . import _native
from ._models import as_model
from ._progress import shower
from ._table import Table

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    import matplotlib.axes
    import numpy.typing as npt

    from ._native import Model

_ERRORS = [
    ("group", "-", "What the errors are of."),
    ("gap", "a", "Gap between the surfaces of the spheres."),
    ("error", "-", "Largest error of the group, divided by the larger of the exact number and its value of a lone sphere."),
    ("between", "-", "Whether the gap lies between those of the model."),
]


class Scorecard:
    """What there is to say of a model.

    Attributes
    ----------
    model : str
        Name of the model.
    header : dict
        What the model says of itself.
    faultless : bool
        Whether nothing was found to be wrong.
    verdict : list of str
        The verdict in words, a sentence each: those of the command line.
    trusted_down_to : dict
        For the bounds 1, 5 and 20 % the gap down to which all errors are within it; None where not even those at the largest gap are.
    faults : list of dict
        What is wrong: ``kind``, ``items`` (the quantities), ``number`` (such as a factor, None if there is none), ``worst_error``, ``at_gap``,
        ``sentence``.
    rows : Table
        All numbers, with the columns of ``judge.csv``; docs/JUDGE.md says what each measure is.
    errors : Table
        The largest errors by group of quantities and gap: what `plot` shows.
    """

    __slots__ = ("_json", "errors", "faultless", "faults", "header", "model", "rows", "trusted_down_to", "verdict")

    def __init__(self, text: str, rows: Table, errors: Table) -> None:
        said: dict[str, Any] = json.loads(text)
        self._json = text
        self.model: str = said["model"]
        self.header: dict[str, Any] = said["header"]
        self.faultless: bool = said["faultless"]
        self.verdict: list[str] = said["verdict"]
        self.trusted_down_to: dict[int, float | None] = dict(zip((1, 5, 20), said["trusted_down_to"], strict=True))
        self.faults: list[dict[str, Any]] = said["faults"]
        self.rows = rows
        self.errors = errors

    @property
    def score(self) -> float:
        """The largest error of the ten resistance scalars at gaps from 0.01 to 2; NaN unless all are there."""
        return float(self.rows["value"][self.rows["measure"] == "score"][0])

    def __reduce__(self) -> tuple[Any, ...]:
        return (Scorecard, (self._json, self.rows, self.errors))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Scorecard):
            return NotImplemented
        return self.rows == other.rows and self.verdict == other.verdict

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        return f"<Scorecard of {self.model}: {self._found()}>\n" + "\n".join(self.verdict)

    def _found(self) -> str:
        if self.faultless:
            return "no fault found"
        if not self.faults:
            return "a law is broken"
        return "1 fault" if len(self.faults) == 1 else f"{len(self.faults)} faults"

    def _repr_html_(self) -> str:
        from html import escape

        colour = "#2b8a3e" if self.faultless else "#c92a2a"
        trusted = "".join(
            f"<tr><th style='text-align:left'>within {bound} %</th><td style='text-align:left'>"
            + ("nowhere" if gap is None else f"down to a gap of {gap:.4g}")
            + "</td></tr>"
            for bound, gap in self.trusted_down_to.items()
        )
        sentences = "".join(f"<li>{escape(sentence)}</li>" for sentence in self.verdict)
        # Colours of text and ground are the notebook's own; the bar is readable on both.
        return (
            f"<div style='border-left:4px solid {colour};padding:0 0 0 1em;max-width:60em'>"
            f"<p><b>{escape(self.model)}</b>: {self._found()}</p><table>{trusted}</table><ul>{sentences}</ul></div>"
        )

    def plot(self, ax: matplotlib.axes.Axes | None = None) -> matplotlib.axes.Axes:
        """Draws the errors against the gap, a line for each group of quantities. Needs matplotlib.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; by default a new figure.

        Returns
        -------
        matplotlib.axes.Axes
            The axes.
        """
        from ._plots import errors

        return errors(self, ax)


def judge(
    model: str | Model,
    *,
    grid: int = 20,
    gaps: npt.ArrayLike | None = None,
    progress: bool | None = None,
) -> Scorecard:
    """Judges a model against exact hydrodynamics: its numbers, the laws that they must obey, and the collisions that follow from it.

    Parameters
    ----------
    model : str or Model
        A model from outside, as `Model.from_callable`, `Model.from_table` and `Model.from_file` make it, or one of the library's own.
    grid : int, default 20
        Points a side of the grid of incoming angles, for the shares of outcomes; 0 leaves all collisions out.
    gaps : array_like, shape (n,), optional
        Gaps at which a function, or a model of the library, is asked, in radii; by default 22 from 0.001 to 998, as far as they are in its range (of the
        library's own models the 18 of the leaderboard). Tables and files are judged at their own gaps.
    progress : bool, optional
        Whether to show progress by tqdm; by default in a terminal or a notebook.

    Returns
    -------
    Scorecard
        The verdict, and all numbers that it rests on.

    Raises
    ------
    InputError
        If an argument is not allowed, or an answer of the model is none.
    Exception
        What a function of the model raises.

    Examples
    --------
    >>> import squirmers
    >>> squirmers.judge("exact", grid=0).faultless
    True
    """
    text, rows, errors = _native.judge(as_model(model), as_model("exact"), grid, gaps, shower(progress))
    groups, at, sizes, between = (list(column) for column in zip(*errors, strict=True))
    lines = ["group,gap,error,between"]
    lines += [f'"{group}",{gap!r},{size!r},{str(is_between).lower()}' for group, gap, size, is_between in errors]
    import numpy as np

    of_groups = Table(_ERRORS, [groups, np.array(at), np.array(sizes), np.array(between)], "\n".join(lines) + "\n")
    return Scorecard(text, Table(*rows), of_groups)


def leaderboard(*, progress: bool | None = None) -> Table:
    """Public codes and the library's own models, judged alike, by rising score.

    Parameters
    ----------
    progress : bool, optional
        Whether to show progress by tqdm; by default in a terminal or a notebook.

    Returns
    -------
    Table
        A row for each, with its score, its errors at four gaps, the gaps down to which it is trusted, its number of faults, and the time of one gap.
    """
    return Table(*_native.leaderboard(shower(progress)), ("model",))
