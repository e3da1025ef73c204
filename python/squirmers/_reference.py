"""The published package of reference numbers."""

from __future__ import annotations

from collections.abc import Mapping

from . import _native
from ._errors import ComputationError, InputError
from ._table import Table

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator
    from typing import Any


def _column(kind: str, cells: list[str]) -> Any:
    import numpy as np

    if kind == "integer":
        return np.array(cells, dtype=np.int64)
    if kind == "number":
        return np.array(cells, dtype=float)
    if kind == "boolean":
        return np.array([cell == "true" for cell in cells])
    return cells


def _table(resource: dict[str, Any], text: str) -> Table:
    import csv

    fields = resource["schema"]["fields"]
    rows = list(csv.reader(text.splitlines()))[1:]
    cells = [_column(field["type"], list(column)) for field, column in zip(fields, zip(*rows, strict=True), strict=True)]
    return Table([(field["name"], field["unit"], field["description"]) for field in fields], cells, text)


class Reference(Mapping[str, Table]):
    """The package of reference numbers: tables by name, such as ``"loads"``.

    Attributes
    ----------
    version : str
        Version of the package.
    descriptor : dict
        The package's description after Frictionless Data: title, licences, sources, and for each table its columns and its SHA-256.
    """

    def __init__(self, files: dict[str, str]) -> None:
        import hashlib
        import json

        self.descriptor: dict[str, Any] = json.loads(files["datapackage.json"])
        self.version: str = self.descriptor["version"]
        self._files = files
        self._resources: dict[str, dict[str, Any]] = {}
        self._tables: dict[str, Table] = {}
        for resource in self.descriptor["resources"]:
            found = "sha256:" + hashlib.sha256(files[resource["path"]].encode()).hexdigest()
            if found != resource["hash"]:
                raise ComputationError(f"{resource['path']} of the reference numbers is damaged: its checksum is {found}, not {resource['hash']}")
            self._resources[resource["name"]] = resource

    @property
    def citation(self) -> str:
        """How to cite it."""
        title = self.descriptor["title"]
        return f"The squirmers developers, {title}, version {self.version}."

    @property
    def citation_cff(self) -> str:
        """The same as a CITATION.cff file."""
        return self._files["CITATION.cff"]

    @property
    def readme(self) -> str:
        """Units, signs, definitions and all columns, in Markdown."""
        return self._files["README.md"]

    @property
    def checksums(self) -> dict[str, str]:
        """SHA-256 of each table's CSV text; they were compared when the package was read."""
        return {name: resource["hash"] for name, resource in self._resources.items()}

    def __getitem__(self, name: str) -> Table:
        if name not in self._resources:
            raise KeyError(f"{name!r} is no table: there are {', '.join(self._resources)}")
        if name not in self._tables:
            resource = self._resources[name]
            self._tables[name] = _table(resource, self._files[resource["path"]])
        return self._tables[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._resources)

    def __len__(self) -> int:
        return len(self._resources)

    def __repr__(self) -> str:
        return f"<Reference numbers, version {self.version}: {', '.join(self)}>"


def reference(version: str | None = None) -> Reference:
    """The published reference numbers for two squirming spheres, each with its error. docs/REFERENCE.md says how they were checked.

    Parameters
    ----------
    version : str, optional
        Version of the package; by default the one that comes with this version of the library.

    Returns
    -------
    Reference
        Tables by name: ``loads``, ``mobilities``, ``near-contact``, ``far-field``, ``deflections``, ``bound-states``, ``shares``.

    Raises
    ------
    InputError
        If this version of the library does not come with that of the package.

    Examples
    --------
    >>> import squirmers
    >>> numbers = squirmers.reference()
    >>> len(numbers["mobilities"].names) > 2
    True
    """
    package = Reference(dict(_native.reference_files()))
    if version is not None and version != package.version:
        raise InputError(f"version '{str(version):.100}' is not allowed: give {package.version}")
    return package
