"""Collisions of two swimming microorganisms, by several models of the fluid between them.

Lengths are in radii of the first squirmer, times in radii over the swimming speed, angles in degrees, viscosity is 1.

>>> import squirmers
>>> scene = squirmers.Scene.of("opposed", beta=5.0, dx=1.0)
>>> squirmers.run(scene, "exact").deflections_deg.round(3)
array([-11.698, -11.698])
"""

from ._errors import ComputationError, FileError, InputError, SquirmersError
from ._judge import Scorecard, judge, leaderboard
from ._loads import loads, mobility
from ._native import Model, Scene, Squirmer, __version__, set_threads
from ._reference import Reference, reference
from ._table import Column, Table
from ._trajectory import Trajectory, run

__all__ = [
    "Column",
    "ComputationError",
    "FileError",
    "InputError",
    "Model",
    "Reference",
    "Scene",
    "Scorecard",
    "Squirmer",
    "SquirmersError",
    "Table",
    "Trajectory",
    "__version__",
    "judge",
    "leaderboard",
    "loads",
    "mobility",
    "reference",
    "run",
    "set_threads",
]
