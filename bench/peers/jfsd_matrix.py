"""Writes fixtures/peers/jfsd-matrix.csv: the mobility of two spheres by JFSD, all twelve columns.

    pip install jax==0.4.18 jaxlib==0.4.18 numpy==1.26.4 scipy==1.10.1 tqdm==4.70.1
    pip download --no-deps --no-binary jfsd jfsd==0.2.2
    tar xzf jfsd-0.2.2.tar.gz
    python jfsd_matrix.py jfsd-0.2.2

JFSD asks for jax 0.4.17, whose jaxlib is not on PyPI: 0.4.18 was used. The wheel lacks the tables
files/ResTable*.npy, hence the unpacked source. Particle 1 is at z = 0, particle 2 at z = 2 + gap, radius 1. JFSD's
unit of force makes 6 pi mu a = 1, so that mu = 1/(6 pi), which the header says. Each column is one step of 1e-6 with
a unit force or torque on one particle, full hydrodynamics in an open domain, no shear, no temperature.
"""

import contextlib
import io
import math
import os
import pathlib
import sys

os.environ.setdefault("JAX_PLATFORMS", "cpu")

import numpy

from convert import PEERS, write

GAPS = ("0.005", "0.01", "0.1", "0.5", "2", "38")
OPEN, STOKESIAN_DYNAMICS = 1, 2


def velocities(main, gap, column):
    """Velocities, in the order of the rows, U1x to O2z, by a unit load on one particle."""
    loads = numpy.zeros(12)
    loads[column] = 1.0
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        _, _, history, _ = main(
            num_steps=1,
            writing_period=1,
            time_step=1e-6,
            lx=50,
            ly=50,
            lz=50,
            num_particles=2,
            max_strain=0.5,
            temperature=0.0,
            particle_radius=1,
            ewald_xi=0.5,
            error_tolerance=1e-6,
            interaction_strength=0.0,
            buoyancy_flag=0,
            interaction_cutoff=0.0,
            positions=numpy.array([[0.0, 0.0, 0.0], [0.0, 0.0, 2.0 + gap]]),
            seed_rfd=0,
            seed_ffwave=0,
            seed_ffreal=0,
            seed_nf=0,
            shear_rate_0=0.0,
            shear_frequency=0.0,
            output=None,
            store_stresslet=False,
            store_velocity=True,
            store_orientation=False,
            constant_applied_forces=loads[:6].reshape(2, 3),
            constant_applied_torques=loads[6:].reshape(2, 3),
            hydrodynamic_interaction_flag=STOKESIAN_DYNAMICS,
            boundary_flag=OPEN,
            thermal_test_flag=0,
            friction_coefficient=0.0,
            friction_range=0.0,
        )
    one, two = history[0]
    return [*one[:3], *two[:3], *one[3:], *two[3:]]


def run():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    source = pathlib.Path(sys.argv[1]).resolve()
    # It reads its tables relative to the folder that it runs in.
    os.chdir(source)
    sys.path.insert(0, str(source))
    from jfsd.main import main

    lines = []
    for gap in GAPS:
        for column in range(12):
            found = velocities(main, float(gap), column)
            lines += [(gap, row, column + 1, repr(float(value) + 0.0)) for row, value in enumerate(found, 1)]
    header = {"matrix": "mobility", **PEERS["jfsd"][1], "viscosity": 1.0 / (6.0 * math.pi)}
    del header["seconds_per_gap"]
    header["call"] = "main.main, hydrodynamic_interaction_flag 2, boundary_flag 1, 1 step of 1e-6, error_tolerance 1e-6"
    write("jfsd-matrix", header, lines, "gap,row,col,value")


if __name__ == "__main__":
    run()
