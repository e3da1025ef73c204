"""Pictures, by matplotlib."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    import matplotlib.axes

    from ._judge import Scorecard
    from ._trajectory import Trajectory

COLOURS = ("#0072b2", "#d55e00")
"""Of the two squirmers: told apart by everybody (Okabe & Ito)."""


def paths(trajectory: Trajectory, ax: matplotlib.axes.Axes | None = None) -> matplotlib.axes.Axes:
    """The paths of a trajectory; see `Trajectory.plot`."""
    import numpy as np
    from matplotlib.patches import Circle

    if ax is None:
        from matplotlib import pyplot

        _, ax = pyplot.subplots()
    positions, orientations = trajectory.positions, trajectory.orientations
    ax.set_aspect("equal")
    ax.set_xlabel("x [a]")
    ax.set_ylabel("y [a]")
    ax.set_title(f"{trajectory.model}: {trajectory.outcome}")
    if len(positions) == 0:
        ax.text(0.5, 0.5, "no samples were kept", ha="center", va="center", transform=ax.transAxes)
        return ax
    closest = int(np.argmin(trajectory.gap))
    for k, (colour, style) in enumerate(zip(COLOURS, ("-", "--"), strict=True)):
        path = positions[:, k]
        ax.plot(path[:, 0], path[:, 1], style, color=colour, lw=1.2, label=f"squirmer {k + 1}")
        radius = trajectory.scene.squirmers[k].radius
        for at, alpha in ((0, 0.25), (closest, 0.9), (len(path) - 1, 0.25)):
            centre, way = path[at], orientations[at, k]
            ax.add_patch(Circle((centre[0], centre[1]), radius, fill=False, color=colour, alpha=alpha))
            ax.annotate(
                "",
                xy=(centre[0] + radius * way[0], centre[1] + radius * way[1]),
                xytext=(centre[0], centre[1]),
                arrowprops={"arrowstyle": "->", "color": colour, "alpha": alpha},
            )
    ax.autoscale_view()
    ax.legend(fontsize="small", frameon=False)
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
