"""Executes the notebooks of this folder and fails if one of them does, or writes to its error stream, as warnings do.

Usage: python run.py [NOTEBOOK.ipynb ...]; by default all of them. Needs nbclient and ipykernel, and what the notebooks need.
"""

from __future__ import annotations

import sys
from pathlib import Path
from time import perf_counter

import nbformat
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError

SECONDS = 600
"""Most time of a cell."""


def complaints(path: Path) -> list[str]:
    """What goes wrong when a notebook is executed."""
    notebook = nbformat.read(path, as_version=4)
    stored = [cell for cell in notebook.cells if cell.get("outputs")]
    client = NotebookClient(notebook, timeout=SECONDS, kernel_name="python3", resources={"metadata": {"path": path.parent}})
    try:
        client.execute()
    except CellExecutionError as error:
        return [str(error)]
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    told = [output["text"] for output in outputs if output.get("name") == "stderr"]
    return told + [f"{len(stored)} cells are stored with outputs: clear them"] * bool(stored)


def main() -> int:
    """The exit status: 1 if a notebook fails, 0 otherwise."""
    folder = Path(__file__).parent
    failed = 0
    for path in [Path(name) for name in sys.argv[1:]] or sorted(folder.glob("*.ipynb")):
        began = perf_counter()
        found = complaints(path)
        failed += bool(found)
        print(f"{'FAILED' if found else 'ok'} {path.name} in {perf_counter() - began:.1f} s", *found, sep="\n", flush=True)
    return int(failed > 0)


if __name__ == "__main__":
    sys.exit(main())
