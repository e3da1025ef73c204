"""A sweep on processes of joblib, merged to the bytes of a sweep in one process.

Example: ``python joblib_sweep.py opposed --vary beta=-5,0,5 --vary dx=0.5,1,2,3 --jobs 2 --out swept``

One process uses all cores of a machine by threads. Several pay where joblib has another backend, or where a queue of a cluster starts them.
"""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence
from pathlib import Path

import joblib
import squirmers


def run_share(
    family: str,
    axes: Mapping[str, Sequence[float]],
    models: Sequence[str],
    share: tuple[int, int],
    folder: Path,
    threads: int,
) -> None:
    """Runs one share of a sweep into a folder."""
    squirmers.set_threads(threads)
    squirmers.sweep(family, axes, models, out=folder, partition=share, progress=False)


def joblib_sweep(
    family: str,
    axes: Mapping[str, Sequence[float]],
    models: Sequence[str] = ("lt", "exact"),
    *,
    out: Path,
    jobs: int,
    threads: int = 1,
) -> squirmers.Table:
    """Runs a sweep in as many shares as there are processes.

    Parameters
    ----------
    family, axes, models
        As of `squirmers.sweep`; models by their names.
    out : Path
        Folder for the merged rows; a folder in it for each share.
    jobs : int
        Number of processes.
    threads : int, default 1
        Threads of each process.

    Returns
    -------
    squirmers.Table
        All rows, as `squirmers.sweep` gives them.
    """
    folders = [out / f"share-{number}-of-{jobs}" for number in range(1, jobs + 1)]
    joblib.Parallel(n_jobs=jobs)(
        joblib.delayed(run_share)(family, axes, models, (number, jobs), folder, threads)
        for number, folder in enumerate(folders, start=1)
    )
    return squirmers.merge(folders, out)


def axis(text: str) -> tuple[str, list[float]]:
    """A parameter and its values from ``NAME=1,2,3``."""
    name, _, values = text.partition("=")
    return name, [float(value) for value in values.split(",")]


def main() -> None:
    """Runs the sweep that the arguments name."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("family", help="name of a family that ships, or path of a scene file")
    parser.add_argument("--vary", metavar="NAME=LIST", type=axis, action="append", default=[])
    parser.add_argument("--method", metavar="LIST", default="lt,exact", help="models; %(default)s")
    parser.add_argument("--jobs", type=int, default=2, help="number of processes; %(default)s")
    parser.add_argument("--out", type=Path, default=Path("swept"), help="folder; %(default)s")
    given = parser.parse_args()
    table = joblib_sweep(
        given.family,
        dict(given.vary),
        given.method.split(","),
        out=given.out,
        jobs=given.jobs,
    )
    print(f"{len(table)} rows in {given.out / 'sweep.csv'}")


if __name__ == "__main__":
    main()
