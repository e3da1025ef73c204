"""A sweep on workers of dask.distributed, merged to the bytes of a sweep in one process.

Example: ``python dask_sweep.py opposed --vary beta=-5,0,5 --vary dx=0.5,1,2,3 --shares 4 --out swept``

The folder has to be on a file system that all workers see. A share that a worker did not finish goes on where it was when the script is run again.
"""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence
from contextlib import ExitStack
from pathlib import Path

import squirmers
from distributed import Client, LocalCluster


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


def dask_sweep(
    client: Client,
    family: str,
    axes: Mapping[str, Sequence[float]],
    models: Sequence[str] = ("lt", "exact"),
    *,
    out: Path,
    shares: int,
    threads: int = 1,
) -> squirmers.Table:
    """Runs a sweep in shares on the workers of a client.

    Parameters
    ----------
    client : distributed.Client
        Its workers run the shares.
    family, axes, models
        As of `squirmers.sweep`; models by their names.
    out : Path
        Folder for the merged rows; a folder in it for each share.
    shares : int
        Number of shares.
    threads : int, default 1
        Threads of each worker process.

    Returns
    -------
    squirmers.Table
        All rows, as `squirmers.sweep` gives them.
    """
    folders = [out / f"share-{number}-of-{shares}" for number in range(1, shares + 1)]
    tasks = [
        client.submit(run_share, family, axes, models, (number, shares), folder, threads, pure=False)
        for number, folder in enumerate(folders, start=1)
    ]
    client.gather(tasks)  # type: ignore[no-untyped-call]
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
    parser.add_argument("--shares", type=int, default=8, help="number of shares; %(default)s")
    parser.add_argument("--out", type=Path, default=Path("swept"), help="folder; %(default)s")
    parser.add_argument("--scheduler", help="address of a scheduler; without it workers are started here")
    parser.add_argument("--workers", type=int, default=2, help="workers to start here; %(default)s")
    given = parser.parse_args()
    with ExitStack() as opened:
        cluster = given.scheduler
        if cluster is None:
            local = LocalCluster(n_workers=given.workers, threads_per_worker=1)  # type: ignore[no-untyped-call]
            cluster = opened.enter_context(local)
        client = opened.enter_context(Client(cluster))  # type: ignore[no-untyped-call]
        table = dask_sweep(
            client,
            given.family,
            dict(given.vary),
            given.method.split(","),
            out=given.out,
            shares=given.shares,
        )
    print(f"{len(table)} rows in {given.out / 'sweep.csv'}")


if __name__ == "__main__":
    main()
