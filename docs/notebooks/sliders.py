"""Two squirmers that are moved by sliders: what the notebook `3_two_squirmers_by_sliders` shows."""

from __future__ import annotations

from io import BytesIO
from time import perf_counter
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import squirmers
from matplotlib.figure import Figure
from matplotlib.patches import Circle

if TYPE_CHECKING:
    import ipywidgets

MODELS = {
    "exact": {"color": "#bbbbbb", "lw": 5.0, "ls": "-"},
    "bem": {"color": "#000000", "lw": 1.4, "ls": "--"},
    "lt": {"color": "#009e73", "lw": 1.6, "ls": "-"},
    "lt-corrected": {"color": "#cc79a7", "lw": 1.6, "ls": "-."},
}
"""The models, each with its line, the first below the others. Colours are told apart by everybody (Okabe & Ito)."""

GRID = 64
"""Points of the flow along either side of its window."""

START = {"distance": 10.0, "offset": 1.0, "angle1": 0.0, "angle2": 180.0, "beta1": 5.0, "beta2": 5.0}
"""Positions of the sliders at first: the opposed pullers of the paper's Fig. 6, turned by 90 degrees."""


class Shown(NamedTuple):
    """What is shown for one position of the sliders.

    `message` says why there is nothing else, and is empty otherwise. `seconds` are those of the runs and of the flow, in seconds.
    """

    message: str
    runs: dict[str, squirmers.Trajectory]
    flow: squirmers.Flow | None
    seconds: tuple[float, float]


def compute(
    distance: float, offset: float, angle1: float, angle2: float, beta1: float, beta2: float, flow_at: str = "start"
) -> Shown:
    """Runs two squirmers under every model, and computes the flow about them by exact hydrodynamics.

    Parameters
    ----------
    distance, offset : float
        From the first centre to the second, along x and along y, in radii.
    angle1, angle2 : float
        Swimming directions, in degrees, anticlockwise from the x axis.
    beta1, beta2 : float
        ``B_2/B_1`` of either squirmer.
    flow_at : str, default "start"
        The instant of the flow: ``"start"``, or ``"closest"`` for the sample of the exact run at which the squirmers are closest.
    """
    if np.hypot(distance, offset) <= 2.0:
        return Shown("the squirmers touch or overlap; move them apart", {}, None, (0.0, 0.0))
    pair = squirmers.Squirmer(beta=beta1), squirmers.Squirmer(beta=beta2)
    centres = [(-distance / 2, -offset / 2), (distance / 2, offset / 2)]
    began = perf_counter()
    try:
        scene = squirmers.Scene(pair, centres, angles_deg=(angle1, angle2), repulsion=(10, 100))
        runs = {model: squirmers.run(scene, model, end_time=60.0, sample_interval=0.05) for model in MODELS}
        ran = perf_counter()
        exact = runs["exact"]
        at = int(np.argmin(exact.gap)) if flow_at == "closest" else 0
        found = squirmers.flow(scene, _window(exact.positions[at, :, :2]), time=exact.time[at], progress=False)
    except squirmers.SquirmersError as error:
        return Shown(str(error), {}, None, (0.0, 0.0))
    return Shown("", runs, found, (ran - began, perf_counter() - ran))


def _window(centres: np.ndarray) -> np.ndarray:
    """A square grid about both squirmers."""
    middle = centres.mean(axis=0)
    half = np.abs(centres - middle).max() + 2.5
    x, y = (np.linspace(m - half, m + half, GRID) for m in middle)
    return np.stack(np.meshgrid(x, y), axis=-1)


def numbers(shown: Shown) -> str:
    """The numbers of all runs, as an HTML table, or why there are none."""
    if shown.message:
        return f"<p><b>Nothing to run:</b> {shown.message}</p>"
    head = ("model", "outcome", "deflection 1 [deg]", "deflection 2 [deg]", "smallest gap [a]", "interaction time [a/V_s]")
    rows = [
        (run.model, run.outcome, *(f"{angle:.3f}" for angle in run.deflections_deg), f"{run.min_gap:.4g}", f"{run.tau:.3f}")
        for run in shown.runs.values()
    ]
    cells = "".join("<tr>" + "".join(f"<td>{cell}</td>" for cell in row) + "</tr>" for row in rows)
    runs, flow = (1e3 * seconds for seconds in shown.seconds)
    return (
        f"<table><tr>{''.join(f'<th>{name}</th>' for name in head)}</tr>{cells}</table>"
        f"<p>Computed in {runs + flow:.1f} ms: four runs {runs:.1f} ms, flow at {GRID} x {GRID} points {flow:.1f} ms.</p>"
    )


def picture(shown: Shown) -> bytes:
    """The paths by all models and the flow, as a PNG picture."""
    figure = Figure(figsize=(10.5, 4.8), layout="constrained")
    _draw(shown, figure)
    png = BytesIO()
    figure.savefig(png, format="png", dpi=90)
    return png.getvalue()


def _draw(shown: Shown, figure: Figure) -> None:
    left, right = figure.subplots(1, 2)
    if shown.flow is None:
        for ax in (left, right):
            ax.set_axis_off()
        left.text(0, 0.5, "no picture: see below", transform=left.transAxes)
        return
    for model, run in shown.runs.items():
        line = MODELS[model]
        for k in (0, 1):
            path = run.positions[:, k]
            left.plot(path[:, 0], path[:, 1], **line, label=model if k == 0 else None)
            left.plot(*path[-1, :2], "o", color=line["color"], ms=3 + line["lw"])
    for k, colour in enumerate(("#0072b2", "#d55e00")):
        x, y, _ = shown.flow.scene.positions[k]
        left.add_patch(Circle((x, y), 1.0, fill=False, color=colour))
        left.text(x, y, str(k + 1), ha="center", va="center", color=colour)
    left.set_aspect("equal", adjustable="datalim")
    left.margins(0.1)
    left.set_xlabel("x [a]")
    left.set_ylabel("y [a]")
    left.set_title("paths from the start to the end of each run (dots)", fontsize="medium")
    left.legend(fontsize="small", loc="upper left", bbox_to_anchor=(0, -0.12), ncols=4, frameon=False)
    shown.flow.plot(right)


def panel() -> ipywidgets.Widget:
    """The sliders, with the picture and the numbers below."""
    import ipywidgets

    def slider(name: str, low: float, high: float, step: float, meaning: str) -> ipywidgets.FloatSlider:
        return ipywidgets.FloatSlider(
            START[name], min=low, max=high, step=step, description=meaning, continuous_update=False, style={"description_width": "7em"}
        )

    sliders = {
        "distance": slider("distance", 0, 14, 0.1, "distance [a]"),
        "offset": slider("offset", -6, 6, 0.1, "offset [a]"),
        "angle1": slider("angle1", -180, 180, 1, "angle 1 [deg]"),
        "angle2": slider("angle2", -180, 180, 1, "angle 2 [deg]"),
        "beta1": slider("beta1", -10, 10, 0.1, "beta 1"),
        "beta2": slider("beta2", -10, 10, 0.1, "beta 2"),
        "flow_at": ipywidgets.ToggleButtons(options=["start", "closest"], description="flow at the"),
    }

    image, table = ipywidgets.Image(format="png"), ipywidgets.HTML()

    def show(_: object = None) -> None:
        shown = compute(**{name: each.value for name, each in sliders.items()})
        image.value, table.value = picture(shown), numbers(shown)

    for each in sliders.values():
        each.observe(show, names="value")
    show()
    controls = ipywidgets.GridBox(list(sliders.values()), layout={"grid_template_columns": "24em 24em"})
    return ipywidgets.VBox([controls, image, table])
