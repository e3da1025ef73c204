"""The sign figure of docs/CONCEPTS.md."""

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.patches import Arc, Circle

COLOURS = ("#0072b2", "#d55e00")


def arrow(ax, tail, head, **style):
    """An arrow from one point to another."""
    ax.annotate("", xy=head, xytext=tail, arrowprops={"arrowstyle": "->", "shrinkA": 0, "shrinkB": 0, **style})


fig, ax = plt.subplots(figsize=(7.0, 5.2))
centres = np.array([[-1.3, 1.55], [1.3, -1.55]])
ways = np.array([[0.0, -1.0], [0.0, 1.0]])
for k, (centre, way, colour) in enumerate(zip(centres, ways, COLOURS, strict=True)):
    ax.add_patch(Circle(centre, 1.0, fill=False, lw=1.6, color=colour))
    ax.plot([centre[0]] * 2, [centre[1] - 2.6 * way[1], centre[1] + 3.9 * way[1]], ":", color=colour, lw=1.0)
    arrow(ax, centre, centre + 1.75 * way, color=colour, lw=2.0)
    ax.text(centre[0] + 0.12, centre[1] + 1.35 * way[1], rf"$p_{k + 1}$", color=colour, fontsize=13, va="center")
    side = -1 if k == 0 else 1
    ax.text(centre[0] + side * 1.15, centre[1], f"squirmer {k + 1}", color=colour, ha="right" if k == 0 else "left", va="center")

line = centres[1] - centres[0]
d = line / np.linalg.norm(line)
t = np.array([-d[1], d[0]])
# The gap, between the surfaces on the line of centres.
ends = centres[0] + d, centres[1] - d
ax.annotate("", xy=ends[1], xytext=ends[0], arrowprops={"arrowstyle": "<->", "color": "black", "shrinkA": 0, "shrinkB": 0})
middle = 0.5 * (ends[0] + ends[1])
ax.text(*(middle + 0.28 * t), "gap", ha="center", va="center")
# Unit vectors of the pair frame of squirmer 1.
for vector, name in ((d, "$d$"), (t, "$t$")):
    arrow(ax, centres[0], centres[0] + 0.8 * vector, color="0.25", lw=1.4)
    ax.text(*(centres[0] + 0.62 * vector + 0.26 * np.array([abs(vector[1]), abs(vector[0])])), name, color="0.25", fontsize=12, ha="center", va="center")
# The offset of the paths.
y = -3.35
arrow(ax, (0, y), (centres[0][0], y), color="black")
arrow(ax, (0, y), (centres[1][0], y), color="black")
ax.text(0, y + 0.2, "dx", ha="center", fontsize=13)
# Angles: that of squirmer 2 is 90 degrees.
corner = np.array([3.0, 1.4])
ax.plot([corner[0], corner[0] + 1.2], [corner[1]] * 2, color="0.25", lw=1.0)
arrow(ax, corner, corner + np.array([0.78, 0.78]), color="0.25", lw=1.6)
ax.add_patch(Arc(corner, 1.3, 1.3, theta1=0, theta2=45, color="0.25"))
arrow(ax, corner + 0.65 * np.array([0.79, 0.61]), corner + 0.65 * np.array([0.707, 0.707]), color="0.25")
ax.text(corner[0] + 0.85, corner[1] + 0.3, "angle > 0", color="0.25", va="center")
ax.text(corner[0] + 0.1, corner[1] - 0.35, "from the x axis,\nanticlockwise", color="0.25", va="top", fontsize=9)
# Axes of the laboratory.
origin = np.array([-4.4, -3.0])
for vector, name in (((1.0, 0.0), "x"), ((0.0, 1.0), "y")):
    arrow(ax, origin, origin + np.array(vector), color="black")
    ax.text(*(origin + 1.18 * np.array(vector)), name, ha="center", va="center")
ax.add_patch(Circle(origin, 0.09, fill=False, color="black"))
ax.plot(*origin, ".", color="black", ms=3)
ax.text(origin[0] - 0.28, origin[1] - 0.18, "z", ha="center", va="center")
ax.set_aspect("equal")
ax.set_xlim(-5, 5.6)
ax.set_ylim(-3.9, 3.9)
ax.axis("off")
fig.tight_layout()
