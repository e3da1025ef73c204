"""Collisions of two swimming microorganisms, by several models of the fluid between them.

Lengths are in radii of the first squirmer, times in radii over the swimming speed, angles in degrees, viscosity is 1.

>>> import squirmers
>>> scene = squirmers.Scene.of("opposed", beta=5.0, dx=1.0)
>>> squirmers.run(scene, "exact").deflections_deg.round(3)
array([-11.698, -11.698])
"""

from ._errors import ComputationError, FileError, InputError, SquirmersError
from ._fluid import Flow, Stresses, Stresslet, flow, stresses, stresslet
from ._judge import Scorecard, judge, leaderboard
from ._loads import loads, mobility
from ._native import Model, Scene, Squirmer, __version__, set_threads
from ._reference import Reference, reference
from ._studies import Kinetics, Sensitivity, bound_states, fates, kinetics, merge, scatter, sensitivity, sweep
from ._table import Column, Table
from ._trajectory import Trajectory, run

__all__ = [
    "Column",
    "ComputationError",
    "FileError",
    "Flow",
    "InputError",
    "Kinetics",
    "Model",
    "Reference",
    "Scene",
    "Scorecard",
    "Sensitivity",
    "Squirmer",
    "SquirmersError",
    "Stresses",
    "Stresslet",
    "Table",
    "Trajectory",
    "__version__",
    "bound_states",
    "fates",
    "flow",
    "judge",
    "kinetics",
    "leaderboard",
    "loads",
    "merge",
    "mobility",
    "reference",
    "run",
    "scatter",
    "sensitivity",
    "set_threads",
    "stresses",
    "stresslet",
    "sweep",
]
