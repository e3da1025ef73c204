"""What several tests need."""

import os
import shutil
from pathlib import Path

import pytest

PROJECT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def project():
    """The project's folder."""
    return PROJECT


@pytest.fixture(scope="session")
def program():
    """The command line `squirmers`: that of the variable SQUIRMERS, or the one that cargo has built."""
    target = Path(os.environ.get("CARGO_TARGET_DIR", PROJECT / "target"))
    found = os.environ.get("SQUIRMERS") or shutil.which("squirmers", path=target / "release")
    if found is None:
        pytest.skip("the command line is not built: cargo build --release")
    return found
