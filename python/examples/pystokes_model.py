"""PyStokes as a model: the mobility of two spheres, and their velocities by slip.

    pip install pystokes==2.3.2

Radius and viscosity are 1. Each column of the matrix is one call of each of unbounded.Rbm's mobilityTT, TR, RT, RR with one unit force or torque on a sphere. Slip,
mode 1: the sphere's own speed 2/3 along p, which PyStokes leaves to the caller, and 5/3 p as its 3t; mode 2: 3/7 irreducibleTensors(2, p) as
its 2s. 5/3 and 3/7 make the axial velocity of the other sphere tend to (2/3)/r^3 and -1/r^2 (times P_2), as Blake's modes do. The 2s of the passive
sphere is put to 0, for irreducibleTensors(2, 0) is not.
"""

from __future__ import annotations

import importlib
import math
from typing import Any

import numpy as np
import numpy.typing as npt
import squirmers

Floats = npt.NDArray[np.float64]

# Rows by PyStokes' order: x of both spheres, then y, then z.
ORDER = [0, 2, 4, 1, 3, 5]
ORIENTATIONS = {"z": (0.0, 0.0, 1.0), "x": (1.0, 0.0, 0.0), "xz": (math.sqrt(0.5), 0.0, math.sqrt(0.5))}


def _pystokes() -> Any:
    """The library, which has no types."""
    return importlib.import_module("pystokes")


def _by_load(rbm: Any, place: Floats, load: int) -> Floats:
    """Velocities and spins by a unit force (0 to 5) or torque (6 to 11)."""
    unit, velocity, spin = np.zeros(6), np.zeros(6), np.zeros(6)
    unit[ORDER[load % 6]] = 1.0
    if load < 6:
        rbm.mobilityTT(velocity, place, unit)
        rbm.mobilityRT(spin, place, unit)
    else:
        rbm.mobilityTR(velocity, place, unit)
        rbm.mobilityRR(spin, place, unit)
    return np.concatenate([velocity[ORDER], spin[ORDER]])


def _by_slip(rbm: Any, place: Floats, mode: int, sphere: int, p: tuple[float, float, float]) -> Floats:
    """Velocities and spins by the unit slip mode of a sphere (1 or 2) with the orientation p, both spheres free."""
    velocity, spin, both = np.zeros(6), np.zeros(6), np.zeros(6)
    both[sphere - 1 :: 2] = p
    if mode == 1:
        velocity += 2.0 / 3.0 * both
        rbm.propulsionT3t(velocity, place, 5.0 / 3.0 * both)
    else:
        slip = 3.0 / 7.0 * _pystokes().utils.irreducibleTensors(2, both)
        slip[2 - sphere :: 2] = 0.0
        rbm.propulsionT2s(velocity, place, slip)
        rbm.propulsionR2s(spin, place, slip)
    return np.concatenate([velocity[ORDER], spin[ORDER]])


def mobility(gaps: Floats) -> dict[str, Floats]:
    """The mobility of two spheres at some gaps, and the velocities and spins by slip.

    Parameters
    ----------
    gaps : ndarray, shape (n,)
        Gaps between the surfaces, in radii.

    Returns
    -------
    dict of ndarray
        ``"matrix"``, shape (n, 12, 12), and slip columns such as ``"B1_1z"``, shape (n, 12).
    """
    rbm = _pystokes().unbounded.Rbm(radius=1, particles=2, viscosity=1.0)
    slips = [(mode, sphere, axis) for mode in (1, 2) for sphere in (1, 2) for axis in ORIENTATIONS]
    said = {"matrix": np.empty((len(gaps), 12, 12))}
    said |= {f"B{mode}_{sphere}{axis}": np.empty((len(gaps), 12)) for mode, sphere, axis in slips}
    for k, gap in enumerate(gaps):
        place = np.array([0.0, 0.0, 0.0, 0.0, 0.0, 2.0 + gap])
        for load in range(12):
            said["matrix"][k, :, load] = _by_load(rbm, place, load)
        for mode, sphere, axis in slips:
            said[f"B{mode}_{sphere}{axis}"][k] = _by_slip(rbm, place, mode, sphere, ORIENTATIONS[axis])
    return said


def model(name: str = "pystokes") -> squirmers.Model:
    """PyStokes as a model that can be judged and that moves pairs.

    Parameters
    ----------
    name : str, default "pystokes"
        Name of the model in tables.

    Returns
    -------
    squirmers.Model
        The model.
    """
    # PyStokes has its own pi with 12 digits, hence values 7e-14 off.
    return squirmers.Model.from_callable(
        mobility,
        name=name,
        range=(1e-3, 1e4),
        matrix="mobility",
        noise=1e-8,
        model="PyStokes",
        version="2.3.2",
        citation="R. Singh & R. Adhikari, J. Open Source Softw. 5 (2020) 2318, doi 10.21105/joss.02318",
    )
