"""Records: what the program prints as JSON, with its names as attributes."""

from __future__ import annotations

import html
import json
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from . import _percuss

if TYPE_CHECKING:
    import pandas
    import pyarrow


class Record:
    """Values with names, which end with their unit.

    Attributes are those of the JSON that the program prints. A table within is a record too, a list of tables a list of
    records. A number that does not exist is ``None``.

    Examples
    --------
    >>> record = Record({"depth_of_penetration_mm": 0.25, "band": {"low": 0.2, "high": 0.3}})
    >>> record.band.high
    0.3
    >>> "residual_velocity_m_s" in record
    False
    """

    _data: dict[str, Any]

    def __init__(self, data: dict[str, Any]) -> None:
        self._data = data

    def __getattr__(self, name: str) -> Any:
        # Asked for what is no attribute yet; names of Python's own protocols are never keys.
        if not name.startswith("_"):
            data = self._data
            if name in data:
                value = _wrapped(data[name])
                self.__dict__[name] = value
                return value
        raise AttributeError(f"{type(self).__name__} has no `{name}`; it has: {', '.join(self.keys())}")

    def __getitem__(self, name: str) -> Any:
        return _wrapped(self._data[name])

    def __contains__(self, name: object) -> bool:
        return name in self._data

    def __iter__(self) -> Iterator[str]:
        return iter(self._data)

    def __len__(self) -> int:
        return len(self._data)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Record) and self._data == other._data

    __hash__ = None  # type: ignore[assignment]

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._data]

    def keys(self) -> list[str]:
        """Names of the values."""
        return list(self._data)

    def to_dict(self) -> dict[str, Any]:
        """The values as the program prints them."""
        return self._data

    def _shown(self) -> list[tuple[str, str]]:
        """Names and values for people: scalars only, and what is there."""
        scalar = (str, bool, int, float)
        return [(name, shown(value)) for name, value in self._data.items() if isinstance(value, scalar)]

    def __repr__(self) -> str:
        values = ", ".join(f"{name}={value}" for name, value in self._shown())
        return f"{type(self).__name__}({values})"

    def _repr_html_(self) -> str:
        return table_html(["", ""], [[name, value] for name, value in self._shown()])


class Answered(Record):
    """What a command found out, and the files that it wrote."""

    _native: _percuss.Answer | _percuss.RunResult
    _files: tuple[Path, ...] = ()

    def __init__(self, answer: _percuss.Answer) -> None:
        super().__init__(json.loads(answer.json()))
        self._native = answer
        self._files = written(answer)

    @property
    def files(self) -> tuple[Path, ...]:
        """The files that were written, in the order of writing; none where no folder ``out`` was given. Pictures of fields are named by
        their folder, fields by the file that lists them."""
        return self._files


class Result(Answered):
    """What a command found out: values by name, and a table of the most of them.

    What a row of the table is, the classes say that have the names of the commands.
    """

    def _rows(self) -> list[dict[str, Any]]:
        raise NotImplementedError

    def to_pandas(self) -> pandas.DataFrame:
        """The table of pandas; a table within a row becomes columns with joined names such as ``band.low``."""
        return frame(self._rows())

    def to_arrow(self) -> pyarrow.Table:
        """The table of Arrow, with the same columns."""
        return table(self._rows())


R = TypeVar("R", bound=Record)


class Records(list[R]):
    """A list of records, which is a table as well."""

    #: Names that people see.
    _names: tuple[str, ...]

    def __init__(self, records: Iterable[R], *names: str) -> None:
        super().__init__(records)
        self._names = names

    def to_pandas(self) -> pandas.DataFrame:
        """A row a record."""
        return frame([record.to_dict() for record in self])

    def to_arrow(self) -> pyarrow.Table:
        """A row a record."""
        return table([record.to_dict() for record in self])

    def _repr_html_(self) -> str:
        return table_html(list(self._names), [[shown(record._data.get(name)) for name in self._names] for record in self])


def written(answer: _percuss.Answer) -> tuple[Path, ...]:
    """The files that a command wrote."""
    return tuple(Path(file) for file in answer.files())


def frame(rows: list[dict[str, Any]]) -> pandas.DataFrame:
    """A table of pandas, a row a record."""
    import pandas

    return pandas.DataFrame(columns(rows))


def table(rows: list[dict[str, Any]]) -> pyarrow.Table:
    """A table of Arrow, a row a record."""
    import pyarrow

    return pyarrow.table(columns(rows))


def _wrapped(value: Any) -> Any:
    if isinstance(value, dict):
        return Record(value)
    if isinstance(value, list) and value and all(isinstance(item, dict) for item in value):
        return [Record(item) for item in value]
    return value


def shown(value: Any) -> str:
    """A value for people: floats to six digits."""
    if value is None:
        return "–"
    if isinstance(value, list):
        return ", ".join(shown(item) for item in value)
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def columns(rows: list[dict[str, Any]]) -> dict[str, list[Any]]:
    """Columns of records: tables within become columns with joined names; what a record lacks is ``None``.

    Examples
    --------
    >>> columns([{"model": "a", "band": None}, {"model": "b", "band": {"low": 1.0}}])
    {'model': ['a', 'b'], 'band.low': [None, 1.0]}
    """
    tables = {name for row in rows for name, value in row.items() if isinstance(value, dict)}
    flat = [_flat(row, tables) for row in rows]
    names = dict.fromkeys(name for row in flat for name in row)
    return {name: [row.get(name) for row in flat] for name in names}


def _flat(row: dict[str, Any], tables: set[str]) -> dict[str, Any]:
    """One level of names, joined by points. A table that is missing leaves nothing, not even its name."""
    values: dict[str, Any] = {}
    for name, value in row.items():
        if isinstance(value, dict):
            values |= {f"{name}.{inner}": item for inner, item in _flat(value, set()).items()}
        elif name not in tables:
            values[name] = value
    return values


def table_html(head: list[str], rows: list[list[str]], caption: str = "") -> str:
    """A table of HTML; everything in it is text."""
    text = "<table>"
    if caption:
        text += f"<caption style='text-align:left'>{html.escape(caption)}</caption>"
    if any(head):
        text += "<thead><tr>" + "".join(f"<th>{html.escape(cell)}</th>" for cell in head) + "</tr></thead>"
    text += "<tbody>"
    for row in rows:
        cells = "".join(f"<td style='text-align:left'>{html.escape(cell)}</td>" for cell in row)
        text += f"<tr>{cells}</tr>"
    return text + "</tbody></table>"
