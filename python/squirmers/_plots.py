"""Pictures, by matplotlib."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    import matplotlib.axes
    import numpy as np
    import numpy.typing as npt

    from ._fluid import Flow
    from ._judge import Scorecard
    from ._trajectory import Trajectory

COLOURS = ("#0072b2", "#d55e00")
"""Of the two squirmers: told apart by everybody (Okabe & Ito)."""

FLAT = 1e-9
"""Differences of z that count as none, in radii."""


def _axes(ax: matplotlib.axes.Axes | None, size: tuple[float, float]) -> matplotlib.axes.Axes:
    """The axes that are given, or new ones."""
    if ax is None:
        from matplotlib import pyplot

        _, ax = pyplot.subplots(figsize=size, layout="constrained")
    ax.set_xlabel("x [a]")
    ax.set_ylabel("y [a]")
    return ax


def _squirmer(
    ax: matplotlib.axes.Axes,
    centre: npt.NDArray[np.float64],
    way: npt.NDArray[np.float64],
    radius: float,
    colour: str,
    **how: Any,
) -> None:
    """A squirmer seen along z, with an arrow from its centre along its swimming direction."""
    from matplotlib.patches import Circle

    x, y = centre[:2]
    ax.add_patch(Circle((x, y), radius, **how))
    ax.annotate(
        "",
        xy=(x + radius * way[0], y + radius * way[1]),
        xytext=(x, y),
        arrowprops={"arrowstyle": "->", "color": colour, "lw": 1.2, "shrinkA": 0, "shrinkB": 0},
        zorder=4,
    )


def paths(trajectory: Trajectory, ax: matplotlib.axes.Axes | None = None) -> matplotlib.axes.Axes:
    """The paths of a trajectory; see `Trajectory.plot`."""
    import numpy as np
    from matplotlib.patches import Patch

    ax = _axes(ax, (5.6, 5.6))
    # Axes that share both of their ranges with others cannot be given more room in one of them.
    is_shared = all(len(shared.get_siblings(ax)) > 1 for shared in (ax.get_shared_x_axes(), ax.get_shared_y_axes()))
    ax.set_aspect("equal", adjustable="box" if is_shared else "datalim")
    title = f"{trajectory.model}: {trajectory.outcome}"
    positions, orientations = trajectory.positions, trajectory.orientations
    if len(positions) == 0:
        ax.set_title(title, fontsize="medium")
        ax.set_xticks([])
        ax.set_yticks([])
        ax.text(0.5, 0.5, "no samples were kept", ha="center", va="center", transform=ax.transAxes)
        return ax
    names = ["squirmer 1", "squirmer 2"]
    z = positions[:, :, 2]
    if np.ptp(z) > FLAT:
        title += "\nseen along z"
        names = [f"{name},\nz from {z[0, k]:.3g} to {z[-1, k]:.3g} a" for k, name in enumerate(names)]
    ax.set_title(title, fontsize="medium")
    last, closest = len(positions) - 1, int(np.argmin(trajectory.gap))
    # What coincides is drawn once, under the first of its names.
    shown: dict[int, tuple[str, dict[str, Any]]] = {0: ("start", {"ls": ":", "fill": False})}
    shown.setdefault(closest, (f"closest,\ngap {trajectory.min_gap:.3g} a", {"alpha": 0.35}))
    shown.setdefault(last, ("end", {"fill": False}))
    keys: list[Any] = []
    for k, (colour, style) in enumerate(zip(COLOURS, ("-", "--"), strict=True)):
        path = positions[:, k]
        keys += ax.plot(path[:, 0], path[:, 1], style, color=colour, lw=1.2, label=names[k])
        radius = trajectory.scene.squirmers[k].radius
        for at, (_, how) in shown.items():
            _squirmer(ax, path[at], orientations[at, k], radius, colour, lw=1.2, color=colour, **how)
    keys += [Patch(label=name, color="#666666", **how) for name, how in shown.values()]
    ax.margins(0.08)
    ax.autoscale_view()
    # Beside the picture, where no path is.
    ax.legend(handles=keys, loc="upper left", bbox_to_anchor=(1.0, 1.0), fontsize="small", frameon=False)
    return ax


def _grid(flow: Flow) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64], npt.NDArray[np.float64]]:
    """x, y, and the velocity with the shape (y, x, 3), of points on a regular grid in a plane of constant z."""
    import numpy as np

    from ._errors import InputError

    refused = InputError(
        f"points of the shape {flow.points.shape} are no picture: give a regular grid in a plane of constant z, of the shape (ny, nx, 3) "
        "or (ny, nx, 2), such as numpy.stack(numpy.meshgrid(x, y), axis=-1)"
    )
    points, velocity = flow.points, flow.velocity
    if points.ndim != 3 or min(points.shape[:2]) < 2:
        raise refused
    if np.ptp(points[:, 0, 0]) > FLAT:
        # As meshgrid makes it with indexing="ij".
        points, velocity = points.swapaxes(0, 1), velocity.swapaxes(0, 1)
    x, y = points[0, :, 0], points[:, 0, 1]
    if x[0] > x[-1]:
        points, velocity, x = points[:, ::-1], velocity[:, ::-1], x[::-1]
    if y[0] > y[-1]:
        points, velocity, y = points[::-1], velocity[::-1], y[::-1]
    regular = [np.linspace(line[0], line[-1], len(line)) for line in (x, y)]
    whole = np.stack([*np.meshgrid(*regular), np.full(points.shape[:2], points[0, 0, 2])], axis=-1)
    steps = min(x[1] - x[0], y[1] - y[0])
    if not (steps > 0 and np.abs(points - whole).max() < 1e-6 * steps):
        raise refused
    return regular[0], regular[1], velocity


def streamlines(flow: Flow, ax: matplotlib.axes.Axes | None = None) -> matplotlib.axes.Axes:
    """The flow in a plane; see `Flow.plot`."""
    import numpy as np

    x, y, velocity = _grid(flow)
    z = flow.points.flat[2]
    width, height = np.ptp(x), np.ptp(y)
    size = 6.0 / max(width, height)
    ax = _axes(ax, (max(size * width, 2.4) + 1.4, max(size * height, 2.4) + 0.6))
    ax.set_aspect("equal")
    title = f"{flow.model}: t = {flow.time:.4g} a/V_s, gap {flow.gap:.3g} a"
    ax.set_title(title if abs(z) <= FLAT else f"{title}, z = {z:.3g} a", fontsize="medium")
    speed = np.ma.masked_invalid(np.linalg.norm(velocity, axis=-1))
    image = ax.pcolormesh(x, y, speed, shading="nearest", cmap="viridis", vmin=0, rasterized=True)
    ax.figure.colorbar(image, ax=ax, label="speed [V_s]")
    if speed.count() and speed.max() > 0:
        along = np.ma.masked_invalid(velocity)
        ax.streamplot(x, y, along[..., 0], along[..., 1], color="white", linewidth=0.7, arrowsize=0.7, density=1.0)
    for k, colour in enumerate(COLOURS):
        centre = flow.positions[k]
        cut = flow.scene.squirmers[k].radius ** 2 - (centre[2] - z) ** 2
        # A sphere that the plane misses is not in the picture.
        if cut > 0:
            how = {"fc": "#f2f2f2", "ec": colour, "lw": 1.5, "zorder": 3}
            _squirmer(ax, centre, flow.orientations[k], cut**0.5, colour, **how)
    dx, dy = (x[1] - x[0]) / 2, (y[1] - y[0]) / 2
    ax.set_xlim(x[0] - dx, x[-1] + dx)
    ax.set_ylim(y[0] - dy, y[-1] + dy)
    return ax


GROUPS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00")
MARKS = "osD^v"


def errors(card: Scorecard, ax: matplotlib.axes.Axes | None = None) -> matplotlib.axes.Axes:
    """The errors of a scorecard against the gap; see `Scorecard.plot`."""
    import numpy as np

    if ax is None:
        from matplotlib import pyplot

        _, ax = pyplot.subplots()
    table = card.errors
    groups = list(dict.fromkeys(table["group"].tolist()))
    # An error that is exactly 0 has no place on the axis.
    least = 1e-16
    for k, group in enumerate(groups):
        mine = table["group"] == group
        gap, size, between = (table[name][mine] for name in ("gap", "error", "between"))
        size = np.maximum(size, least)
        colour = GROUPS[k % len(GROUPS)]
        ax.plot(gap, size, "-", color=colour, lw=1)
        ax.plot(gap[~between], size[~between], MARKS[k % len(MARKS)], color=colour, ms=4, label=group)
    for bound in (0.01, 0.05, 0.2):
        ax.axhline(bound, color="0.6", lw=0.8, ls=":")
        ax.annotate(f"{100 * bound:g} %", (1, bound), xycoords=("axes fraction", "data"), ha="right", va="bottom", color="0.4", fontsize="small")
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_xlabel("gap [a]")
    ax.set_ylabel("largest error")
    ax.set_title(card.model)
    ax.legend(fontsize="small", frameon=False)
    return ax
