"""Pictures, by matplotlib."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    import matplotlib.axes

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
