"""Records of the JSON output, with its names as attributes."""

from __future__ import annotations

import copy
import html
import json
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from . import _percuss
from .optional import library
from .unit_systems import dataset, in_units, unit_of

if TYPE_CHECKING:
    import pandas
    import pyarrow
    import xarray


class Record:
    """Named values; the names end with the unit.

    Attributes are those of the JSON output. A table is a record, a list of tables is a list of records. A missing number is ``None``.

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
        # Names with an underscore belong to protocols of Python and are never keys.
        if name.startswith("_"):
            raise AttributeError(f"{type(self).__name__} has no `{name}`")
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
        """Values as in the JSON output: a copy."""
        return copy.deepcopy(self._data)

    def _shown(self) -> list[tuple[str, str]]:
        """Names and values of the scalars that are not ``None``."""
        scalar = (str, bool, int, float)
        return [(name, shown(value)) for name, value in self._data.items() if isinstance(value, scalar)]

    def __repr__(self) -> str:
        values = ", ".join(f"{name}={value}" for name, value in self._shown())
        return f"{type(self).__name__}({values})"

    def _repr_html_(self) -> str:
        return table_html(["", ""], [[name, value] for name, value in self._shown()])


class CommandRecord(Record):
    """Result of a command and the files that it wrote."""

    _native: _percuss.Response | _percuss.RunResult
    _files: tuple[Path, ...] = ()

    def __init__(self, response: _percuss.Response) -> None:
        super().__init__(json.loads(response.json()))
        self._native = response
        self._files = written(response)

    @property
    def files(self) -> tuple[Path, ...]:
        """Written files in the order of writing; empty without a folder ``out``. Pictures of fields are listed by their folder, fields by
        the file that lists them."""
        return self._files


class Result(CommandRecord):
    """Result of a command: named values, and a table.

    The class of each command describes the rows of its table.
    """

    def _rows(self) -> list[dict[str, Any]]:
        raise NotImplementedError

    def _headline(self) -> list[str]:
        """What matters, in words."""
        raise NotImplementedError

    def _details_html(self) -> str:
        """Tables below the headline."""
        raise NotImplementedError

    def __repr__(self) -> str:
        return f"{type(self).__name__}({'; '.join(self._headline())})"

    def _repr_html_(self) -> str:
        return table_html([""], [], "; ".join(self._headline())) + self._details_html()

    def to_pandas(self, units: str | None = None) -> pandas.DataFrame:
        """Table of pandas; nested tables become columns with joined names such as ``band.low``.

        ``units`` is a unit system, such as ``"SI"`` or ``"mm-ms-kN"``: columns of numbers are in its units, and their names say so.
        """
        return frame(self._rows(), units)

    def to_arrow(self, units: str | None = None) -> pyarrow.Table:
        """Table of Arrow with the same columns."""
        return table(self._rows(), units)

    def to_xarray(self, units: str | None = None) -> xarray.Dataset:
        """The columns of numbers and texts as variables of xarray along ``row``, with their ``units``."""
        return dataset(columns(self._rows()), "row", units)


R = TypeVar("R", bound=Record)


class Records(list[R]):
    """List of records with a table."""

    #: Names of the displayed columns.
    _names: tuple[str, ...]

    def __init__(self, records: Iterable[R], *names: str) -> None:
        super().__init__(records)
        self._names = names

    def to_pandas(self) -> pandas.DataFrame:
        """One row per record."""
        return frame([record.to_dict() for record in self])

    def to_arrow(self) -> pyarrow.Table:
        """One row per record."""
        return table([record.to_dict() for record in self])

    def _repr_html_(self) -> str:
        return table_html(list(self._names), [[shown(record._data.get(name)) for name in self._names] for record in self])


def written(response: _percuss.Response) -> tuple[Path, ...]:
    """Files that a command wrote."""
    return tuple(Path(file) for file in response.files())


def frame(rows: list[dict[str, Any]], units: str | None = None) -> pandas.DataFrame:
    """Table of pandas, one row per record."""
    made: pandas.DataFrame = library("pandas").DataFrame(in_units(columns(rows), units))
    return made


def table(rows: list[dict[str, Any]], units: str | None = None) -> pyarrow.Table:
    """Table of Arrow, one row per record."""
    return library("pyarrow").table(in_units(columns(rows), units))


def _wrapped(value: Any) -> Any:
    if isinstance(value, dict):
        return Record(value)
    if isinstance(value, list) and value and all(isinstance(item, dict) for item in value):
        return [Record(item) for item in value]
    return value


def shown(value: Any) -> str:
    """Value as text, floats to six digits."""
    if value is None:
        return "–"
    if isinstance(value, list):
        return ", ".join(shown(item) for item in value)
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def in_words(name: str, value: float, to: float | None = None, uncertainty: float | None = None) -> str:
    """A value, or a range, with the words of its name and its unit, to three digits.

    Examples
    --------
    >>> in_words("depth_of_penetration_mm", 0.20331)
    'depth of penetration 0.203 mm'
    >>> in_words("time_to_rest_us", 12.3456, to=28.75)
    'time to rest 12.3 to 28.8 µs'
    """
    end, unit = next(((end, unit) for end, unit in _percuss.units() if name.endswith(end)), ("", ""))
    number = digits(value)
    if to is not None and digits(to) != number:
        number += f" to {digits(to)}"
    if uncertainty is not None:
        number += f" ± {uncertainty:.2g}"
    return f"{name.removesuffix(end).replace('_', ' ')} {number} {symbol(unit)}".rstrip()


def digits(value: float) -> str:
    """A number to three digits, without an exponent below a million.

    Examples
    --------
    >>> digits(1234.5), digits(0.0377319)
    ('1234', '0.0377')
    """
    return f"{value:.0f}" if 1000 <= abs(value) < 1e6 else f"{value:.3g}"


def symbol(unit: str) -> str:
    """Unit as texts have it; the names of columns have ``us``."""
    return "µs" if unit == "us" else unit


def units_of(names: Iterable[str]) -> str:
    """Units of columns in words, each once.

    Examples
    --------
    >>> units_of(["time_us", "depth_mm", "step", "tip_position_mm"])
    'units: µs, mm'
    """
    units = dict.fromkeys(symbol(unit_of(name)) for name in names)
    return f"units: {', '.join(unit for unit in units if unit)}"


def columns(rows: list[dict[str, Any]]) -> dict[str, list[Any]]:
    """Columns of records: nested tables become columns with joined names; missing values are ``None``.

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
    """Flat names, joined by points. A missing table is left out."""
    values: dict[str, Any] = {}
    for name, value in row.items():
        if isinstance(value, dict):
            values |= {f"{name}.{inner}": item for inner, item in _flat(value, set()).items()}
        elif name not in tables:
            values[name] = value
    return values


def table_html(head: list[str], rows: list[list[str]], caption: str = "") -> str:
    """Table of HTML; all cells are text."""
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
