"""Writes measured answers of public codes as submissions, fixtures/peers/NAME.csv.

    python convert.py FOLDER

FOLDER holds the measured numbers, one file a code with columns gap,name,value, made by calling each code as its
header below says. Names, gaps and digits go over as they are; what is added is the header. Of the rigid multiblobs
FOLDER also holds the loads by slip after calibration: their ratios to the raw ones become `slip_calibration`, and
the script stops if a ratio is not the same for all loads and gaps. Python's standard library is enough.
"""

import csv
import json
import pathlib
import statistics
import sys

OUT = pathlib.Path(__file__).resolve().parents[2] / "fixtures" / "peers"
MACHINE = "one core, other work beside it"
# Of the ratio of two numbers that were each rounded once.
ROUNDING = 4e-16

DURLOFSKY = (
    "L. Durlofsky, J. F. Brady & G. Bossis, J. Fluid Mech. 180 (1987) 21, doi 10.1017/S002211208700171X"
)
JEFFREY = "D. J. Jeffrey & Y. Onishi, J. Fluid Mech. 139 (1984) 261, doi 10.1017/S0022112084000355"
TOWNSEND = (
    "A. K. Townsend, Phys. Fluids 35 (2023) 127126, doi 10.1063/5.0175697; repository Pecnut/stokesian-dynamics"
)
BLAKE = "J. R. Blake, J. Fluid Mech. 46 (1971) 199, doi 10.1017/S002211207100048X"
ICHIKI = "K. Ichiki, repository kichiki/libstokes"

PYSTOKES = {
    "model": "PyStokes",
    "version": "2.3.2",
    "citation": "R. Singh & R. Adhikari, J. Open Source Softw. 5 (2020) 2318, doi 10.21105/joss.02318",
    "call": (
        "unbounded.Rbm: mobilityTT, TR, RT, RR. Mode 1: its own speed 2/3, and 5/3 p as 3t in propulsionT3t; mode 2: "
        "3/7 irreducibleTensors(2, p) as 2s in propulsionT2s and R2s, 0 for the passive sphere. 5/3 and 3/7 make "
        "UX2_1 tend to (2/3)/r^3 and UX2_2 to -1/r^2"
    ),
    "seconds_per_gap": 9e-5,
}
BLOBS = {
    "version": "ed1b8994",
    "citation": (
        "F. Balboa Usabiaga, B. Kallemov, B. Delmotte, A. P. S. Bhalla, B. E. Griffith & A. Donev, Commun. Appl. Math. "
        "Comput. Sci. 11 (2016) 217, doi 10.2140/camcos.2016.11.217; repository stochasticHydroTools/RigidMultiblobsWall"
    ),
    "call": (
        "two rigid multiblobs without a wall, slip imposed at the blobs as is. Calibration: mode 1 so that a lone sphere "
        "swims with 2/3, mode 2 so that UX2_2 tends to -1/r^2, taken at r = 1000"
    ),
}
LIBSTOKES = {"version": "7604f51f"}
SD = {"version": "6b9117d1"}

# Name of the submission: (file of the measured numbers, header).
PEERS = {
    "pystokes": ("pystokes", PYSTOKES),
    "farfield-point": (
        "farfield_point",
        {
            "model": "far field, points",
            "citation": BLAKE,
            "call": "velocity and half the vorticity at the other sphere's centre, by a point force, a point torque, "
            "or a lone squirmer's far flow",
            "seconds_per_gap": 3e-6,
        },
    ),
    "farfield-faxen": (
        "farfield_faxen",
        {
            "model": "far field, Faxén",
            "citation": f"J. Rotne & S. Prager, J. Chem. Phys. 50 (1969) 4831, doi 10.1063/1.1670977; {BLAKE}",
            "call": "a lone sphere's flow, and Faxén's laws for the other sphere",
            "seconds_per_gap": 3e-6,
        },
    ),
    "multiblobs-42": ("rmb_42", {"model": "RigidMultiblobsWall, 42 blobs", **BLOBS}),
    "multiblobs-162": ("rmb_162", {"model": "RigidMultiblobsWall, 162 blobs", **BLOBS, "seconds_per_gap": 0.019}),
    "multiblobs-642": ("rmb_642", {"model": "RigidMultiblobsWall, 642 blobs", **BLOBS, "seconds_per_gap": 0.98}),
    "libstokes-ft": (
        "libstokes_ft",
        {
            "model": "libstokes, FT",
            **LIBSTOKES,
            "citation": ICHIKI,
            "call": "forces and torques, without lubrication",
            "seconds_per_gap": 1.6e-8,
        },
    ),
    "libstokes-fts": (
        "libstokes_fts",
        {
            "model": "libstokes, FTS",
            **LIBSTOKES,
            "citation": f"{ICHIKI}; {DURLOFSKY}",
            "call": "forces, torques and stresslets, without lubrication",
            "seconds_per_gap": 7.5e-8,
        },
    ),
    "libstokes-n100": (
        "libstokes_lub_n100",
        {
            "model": "libstokes, two bodies, n = 100",
            **LIBSTOKES,
            "citation": f"{ICHIKI}; {JEFFREY}",
            "call": "two-body resistance by the series of Jeffrey & Onishi, 100 terms",
            "seconds_per_gap": 4e-6,
        },
    ),
    "libstokes-mono": (
        "libstokes_lub_mono",
        {
            "model": "libstokes, two bodies, equal spheres",
            **LIBSTOKES,
            "citation": f"{ICHIKI}; {JEFFREY}",
            "call": "two-body resistance by its functions for equal spheres (mono)",
        },
    ),
    "townsend-sd": (
        "pecnut_sd",
        {
            "model": "Townsend's Stokesian dynamics",
            **SD,
            "citation": f"{TOWNSEND}; {DURLOFSKY}",
            "call": "inverse of M_infinity, and for r < 4 the table's correction; 0.03 and 0.07 lie between nodes of the table",
            "seconds_per_gap": 7e-3,
        },
    ),
    "townsend-minf": (
        "pecnut_minf",
        {
            "model": "Townsend's Stokesian dynamics, far field",
            **SD,
            "citation": f"{TOWNSEND}; {DURLOFSKY}",
            "call": "inverse of M_infinity alone",
        },
    ),
    "townsend-table": (
        "pecnut_table",
        {
            "model": "Townsend's table",
            **SD,
            "citation": TOWNSEND,
            "call": "scalars_general_resistance.npy, read by numpy.interp; 0.03 and 0.07 lie between nodes of the table",
            "interpolation": "linear",
        },
    ),
    "jfsd": (
        "jfsd",
        {
            "model": "JFSD",
            "version": "0.2.2",
            "citation": (
                "W. Torre, repository torrewk/Python-Jax-Fast-Stokesian-Dynamics; A. M. Fiore & J. W. Swan, J. Fluid Mech. "
                "878 (2019) 544, doi 10.1017/jfm.2019.640"
            ),
            "call": (
                "main.main, hydrodynamic_interaction_flag 2, boundary_flag 1, 1 step of 1e-6, error_tolerance 1e-6; load "
                "on its first particle alone"
            ),
            "seconds_per_gap": 0.4,
        },
    ),
}


def rows(path):
    with path.open(newline="", encoding="utf-8") as file:
        return [(row["gap"], row["name"], row["value"]) for row in csv.DictReader(file)]


def calibration(raw, calibrated):
    """[c1, c2]: by what the loads by each slip mode were multiplied. The other loads must be unchanged."""
    values = {(float(gap), name): float(value) for gap, name, value in calibrated}
    assert len(raw) == len(values)
    ratios = {1: [], 2: []}
    for gap, name, value in raw:
        other = values[float(gap), name]
        if "_" in name:
            ratios[int(name[-1])].append(other / float(value))
        else:
            assert other == float(value), (gap, name)
    factors = []
    for mode in (1, 2):
        factor = statistics.median(ratios[mode])
        worst = max(abs(ratio / factor - 1.0) for ratio in ratios[mode])
        assert worst < ROUNDING, (mode, worst)
        factors.append(factor)
    return factors


def write(name, header, lines, columns="gap,name,value"):
    """A submission: header, one key a line (a JSON string or list is one of TOML too), then rows."""
    text = [f"#! {key} = {json.dumps(value, ensure_ascii=False)}" for key, value in header.items()]
    text += [columns, *(",".join(map(str, line)) for line in lines)]
    (OUT / f"{name}.csv").write_text("\n".join(text) + "\n", encoding="utf-8", newline="\n")


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    OUT.mkdir(exist_ok=True)
    for name, (source, header) in PEERS.items():
        measured = rows(folder / f"{source}.csv")
        header = dict(header)
        calibrated = folder / f"{source}_calibrated.csv"
        if calibrated.exists():
            header["slip_calibration"] = calibration(measured, rows(calibrated))
        if "seconds_per_gap" in header:
            header["machine"] = MACHINE
        write(name, header, measured)


if __name__ == "__main__":
    main()
