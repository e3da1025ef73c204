"""Rows as columns."""

from __future__ import annotations

from collections import namedtuple

TYPE_CHECKING = False
if TYPE_CHECKING:
    import os
    from collections.abc import Iterator, Sequence
    from typing import Any, NamedTuple

    import numpy as np
    import numpy.typing as npt
    import pandas
    import xarray

    class Column(NamedTuple):
        """Name, unit and meaning of a column."""

        name: str
        unit: str
        meaning: str

else:
    # The module typing takes longer to import than all of this package.
    Column = namedtuple("Column", ("name", "unit", "meaning"))
    Column.__doc__ = "Name, unit and meaning of a column."


class Table:
    """Rows of one kind, column by column.

    ``table["tau"]`` is the column of that name: an array of numbers, or of words. A table is not changed once it is made.

    Attributes
    ----------
    columns : tuple of Column
        Names, units and meanings.
    dims : tuple of str
        The columns that tell rows apart, outermost first; `to_xarray` makes dimensions of them. Empty where there are none.
    csv : str
        The text of the CSV file that the command line writes for the same rows, with the same digits.
    """

    __slots__ = ("_values", "columns", "csv", "dims")

    def __init__(
        self,
        columns: Sequence[tuple[str, str, str]],
        values: Sequence[npt.NDArray[np.generic] | list[str]],
        csv: str,
        dims: Sequence[str] = (),
    ) -> None:
        import numpy as np

        self.columns = tuple(Column(*column) for column in columns)
        self.csv = csv
        self.dims = tuple(dims)
        self._values: dict[str, npt.NDArray[Any]] = {}
        for column, of_column in zip(self.columns, values, strict=True):
            array = np.asarray(of_column)
            array.setflags(write=False)
            self._values[column.name] = array

    @property
    def names(self) -> list[str]:
        """Names of the columns."""
        return [column.name for column in self.columns]

    def __len__(self) -> int:
        return len(next(iter(self._values.values()), ()))

    def __getitem__(self, name: str) -> npt.NDArray[Any]:
        try:
            return self._values[name]
        except KeyError:
            raise KeyError(f"{name!r} is no column: there are {', '.join(self.names)}") from None

    def __contains__(self, name: object) -> bool:
        return name in self._values

    def __iter__(self) -> Iterator[dict[str, Any]]:
        """Each row, as a dictionary of its cells."""
        lists = {name: values.tolist() for name, values in self._values.items()}
        for row in range(len(self)):
            yield {name: values[row] for name, values in lists.items()}

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Table):
            return NotImplemented
        return (self.columns, self.csv, self.dims) == (other.columns, other.csv, other.dims)

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> tuple[Any, ...]:
        parts = (self.columns, list(self._values.values()), self.csv, self.dims)
        # Tables that come with others, such as loads with errors, keep them in slots of their own.
        others = {} if type(self) is Table else {name: getattr(self, name) for name in self.__slots__}
        return (type(self), parts, (None, others)) if others else (type(self), parts)

    def __repr__(self) -> str:
        return f"<Table of {len(self)} rows: {', '.join(self.names)}>"

    def _repr_html_(self) -> str:
        try:
            return self.to_pandas()._repr_html_()  # type: ignore[operator, no-any-return]
        except ImportError:
            from html import escape

            return f"<pre>{escape(repr(self))}</pre>"

    def to_structured(self) -> npt.NDArray[np.void]:
        """The rows as a structured array."""
        import numpy as np

        dtype = [(name, values.dtype) for name, values in self._values.items()]
        rows = np.empty(len(self), dtype=dtype)
        for name, values in self._values.items():
            rows[name] = values
        return rows

    def to_pandas(self) -> pandas.DataFrame:
        """The rows as a data frame; it has the units in ``attrs["units"]``. Needs pandas."""
        import pandas

        frame = pandas.DataFrame({name: values.copy() for name, values in self._values.items()})
        frame.attrs["units"] = {column.name: column.unit for column in self.columns}
        return frame

    def to_xarray(self) -> xarray.Dataset:
        """The rows as a dataset with a dimension for each of `dims`; it has units and meanings in the attributes of its variables. Needs xarray and pandas.

        Raises
        ------
        InputError
            If nothing tells rows apart.
        """
        from ._errors import InputError

        if not self.dims:
            raise InputError("a table without dims has no dimensions: use to_pandas or to_structured")
        dataset: xarray.Dataset = self.to_pandas().set_index(list(self.dims)).to_xarray()
        dataset.attrs.clear()
        for column in self.columns:
            if column.name in dataset.variables:
                of_column = dataset[column.name]
                of_column.attrs["units"] = column.unit
                of_column.attrs["long_name"] = column.meaning
        return dataset

    def to_csv(self, path: str | os.PathLike[str]) -> None:
        """Writes the CSV text to a file."""
        from pathlib import Path

        Path(path).write_text(self.csv, encoding="utf-8", newline="")
