"""Writes fixtures/peers/pystokes-matrix.csv: the mobility of two spheres by PyStokes, and the velocities by slip.

    pip install pystokes==2.3.2 numpy==2.4.6
    python pystokes_matrix.py

Sphere 1 is at z = 0, sphere 2 at z = 2 + gap, radius 1, viscosity 1. Each column is one call of each of
unbounded.Rbm's mobilityTT, TR, RT, RR with one unit force or torque on a sphere. Slip, mode 1: the sphere's own
speed 2/3 along p, which PyStokes leaves to the caller, and 5/3 p as its 3t; mode 2: 3/7 irreducibleTensors(2, p) as
its 2s. 5/3 and 3/7 make the axial velocity of the other sphere tend to (2/3)/r^3 and -1/r^2 (times P_2), as
Blake's modes do. The 2s of the passive sphere is put to 0, for irreducibleTensors(2, 0) is not.
PyStokes has its own pi with 12 digits, hence values 7e-14 off.
"""

import math
import os

os.environ.setdefault("OMP_NUM_THREADS", "1")

import numpy
import pystokes

from convert import PYSTOKES, write

GAPS = ("0.005", "0.01", "0.1", "0.5", "2", "38")
# Names of rows by PyStokes' order: x of both spheres, then y, then z.
VELOCITIES = [f"U{sphere}{axis}" for axis in "xyz" for sphere in (1, 2)]
SPINS = [name.replace("U", "O") for name in VELOCITIES]
ROWS = [f"{kind}{sphere}{axis}" for kind in "UO" for sphere in (1, 2) for axis in "xyz"]
LOADS = [f"{kind}{sphere}{axis}" for kind in "FT" for sphere in (1, 2) for axis in "xyz"]
ORIENTATIONS = {"z": (0.0, 0.0, 1.0), "x": (1.0, 0.0, 0.0), "xz": (math.sqrt(0.5), 0.0, math.sqrt(0.5))}


def by_load(rbm, place, load):
    """Velocities by a unit force or torque, such as F1x or T2z."""
    kind, sphere, axis = load[0], int(load[1]), "xyz".index(load[2])
    unit, velocity, spin = numpy.zeros(6), numpy.zeros(6), numpy.zeros(6)
    unit[2 * axis + sphere - 1] = 1.0
    if kind == "F":
        rbm.mobilityTT(velocity, place, unit)
        rbm.mobilityRT(spin, place, unit)
    else:
        rbm.mobilityTR(velocity, place, unit)
        rbm.mobilityRR(spin, place, unit)
    return velocity, spin


def by_slip(rbm, place, mode, sphere, p):
    """Velocities by the unit slip mode of a sphere with orientation p, both spheres free."""
    velocity, spin = numpy.zeros(6), numpy.zeros(6)
    both = numpy.zeros(6)
    both[sphere - 1 :: 2] = p
    if mode == 1:
        velocity += 2.0 / 3.0 * both
        rbm.propulsionT3t(velocity, place, 5.0 / 3.0 * both)
    else:
        slip = 3.0 / 7.0 * pystokes.utils.irreducibleTensors(2, both)
        slip[2 - sphere :: 2] = 0.0
        rbm.propulsionT2s(velocity, place, slip)
        rbm.propulsionR2s(spin, place, slip)
    return velocity, spin


def main():
    rbm = pystokes.unbounded.Rbm(radius=1, particles=2, viscosity=1.0)
    lines = []
    for gap in GAPS:
        place = numpy.array([0.0, 0.0, 0.0, 0.0, 0.0, 2.0 + float(gap)])
        columns = {load: by_load(rbm, place, load) for load in LOADS}
        for mode in (1, 2):
            for sphere in (1, 2):
                for name, p in ORIENTATIONS.items():
                    columns[f"B{mode}_{sphere}{name}"] = by_slip(rbm, place, mode, sphere, p)
        for column, (velocity, spin) in columns.items():
            values = dict(zip(VELOCITIES + SPINS, [*velocity, *spin]))
            # + 0.0 turns -0.0 to 0.0.
            column = LOADS.index(column) + 1 if column in LOADS else column
            lines += [(gap, k, column, repr(float(values[row]) + 0.0)) for k, row in enumerate(ROWS, 1)]
    header = {"matrix": "mobility", **PYSTOKES}
    del header["seconds_per_gap"]
    write("pystokes-matrix", header, lines, "gap,row,col,value")


if __name__ == "__main__":
    main()
