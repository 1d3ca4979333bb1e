"""Histories of a run as arrays."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from . import _percuss, fields
from .optional import library
from .record import digits, in_words, units_of
from .unit_systems import dataset, in_units
from .values import ElementColumns, SampleColumns

if TYPE_CHECKING:
    import pandas
    import pyarrow
    import xarray
    from numpy.typing import NDArray

    Array = NDArray[Any]


class _Columns:
    """Read-only arrays as attributes, created on first access."""

    def names(self) -> list[str]:
        """Names of the columns, which end with the unit."""
        raise NotImplementedError

    def _column(self, name: str) -> _percuss.Column | Array | None:
        raise NotImplementedError

    def __getattr__(self, name: str) -> Array:
        # Names with an underscore belong to protocols of Python and are never columns.
        if name.startswith("_"):
            raise AttributeError(f"{type(self).__name__} has no `{name}`")
        column = self._column(name)
        if column is None:
            raise AttributeError(f"no column is named `{name}`; columns: {', '.join(self.names())}")
        import numpy

        array: Array = numpy.asarray(column)
        self.__dict__[name] = array
        return array

    def __getitem__(self, name: str) -> Array:
        try:
            array: Array = getattr(self, name)
        except AttributeError as error:
            raise KeyError(str(error)) from None
        return array

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self.names()]

    def _table(self, units: str | None) -> dict[str, Array]:
        return in_units({name: self[name] for name in self.names()}, units)

    def to_pandas(self, units: str | None = None) -> pandas.DataFrame:
        """All columns as a table of pandas, which is a copy; ``units`` is a unit system, such as ``"SI"`` or ``"mm-ms-kN"``."""
        made: pandas.DataFrame = library("pandas").DataFrame(self._table(units))
        return made

    def to_arrow(self, units: str | None = None) -> pyarrow.Table:
        """All columns as a table of Arrow, which is a copy."""
        import numpy

        columns = self._table(units).items()
        return library("pyarrow").table({name: numpy.ascontiguousarray(column) for name, column in columns})

    def to_xarray(self, units: str | None = None) -> xarray.Dataset:
        """All columns as variables of xarray with their ``units``, along ``sample``; the time is a coordinate, where there is one."""
        names = self.names()
        return dataset({name: self[name] for name in names}, "sample", units, "time_us" if "time_us" in names else None)


class _Rows(_Columns):
    """Columns of the memory of a result, in the units of the files."""

    _fields: dict[str, _percuss.Field]

    def names(self) -> list[str]:
        return list(self._fields)

    def _memory(self, si_name: str) -> _percuss.Column | None:
        raise NotImplementedError

    def _column(self, name: str) -> _percuss.Column | Array | None:
        field = self._fields.get(name)
        if field is None:
            self._refuse_si_name(name)
            return None
        column = self._memory(field.si_name)
        if column is None or field.per_si == 1.0:
            return column
        import numpy

        array: Array = numpy.asarray(column) * field.per_si
        array.setflags(write=False)
        return array

    def _refuse_si_name(self, name: str) -> None:
        """Error for the name of an SI column, with the name of the column."""
        for field in self._fields.values():
            if field.si_name == name:
                raise AttributeError(f"no column is named `{name}`: `{field.name}` is in {field.unit}, and `si.{name}` in SI units")

    @property
    def si(self) -> SiColumns:
        """The same columns in SI units: the memory of the result, without a copy."""
        return SiColumns(self)


class SiColumns(_Columns):
    """The columns of a :class:`History` or :class:`Profile` in SI units: ``history.si.depth_m``, ``history.si.to_pandas()``.

    The arrays are views of the memory of the result: nothing is copied.
    """

    def __init__(self, rows: _Rows) -> None:
        self._rows = rows

    def names(self) -> list[str]:
        return [field.si_name for field in self._rows._fields.values()]

    def _column(self, name: str) -> _percuss.Column | None:
        return self._rows._memory(name)


class Profile(ElementColumns, _Rows):
    """State along the axis at one time: one value per element, from the projectile tail to the rear face of the target.

    Attributes
    ----------
    {fields}
    """

    _fields = {field.name: field for field in _percuss.element_columns()}

    def __init__(self, native: _percuss.RunResult, index: int) -> None:
        self._native = native
        self._index = index

    @property
    def time_us(self) -> float:
        """Time [us]."""
        return self._time_s() * _TIME.per_si

    def _time_s(self) -> float:
        time = self._native.profile_time(self._index)
        assert time is not None
        return time

    def _refuse_si_name(self, name: str) -> None:
        if name == _TIME.si_name:
            raise AttributeError(f"no value is named `{name}`: `{_TIME.name}` is in {_TIME.unit}")
        super()._refuse_si_name(name)

    def _memory(self, si_name: str) -> _percuss.Column | None:
        return self._native.element_column(self._index, si_name)

    def __repr__(self) -> str:
        return f"<Profile at {digits(self.time_us)} µs, {len(self.part)} elements; {units_of(self.names())}>"


class Gauge(ElementColumns, _Rows):
    """State of the material at a gauge versus time, one value per sample of the history.

    The gauge moves with the material; its values are NaN after erosion. The first column is ``time_us``.

    Attributes
    ----------
    {fields}
    """

    _fields = {field.name: field for field in _percuss.element_columns()}

    def __init__(self, native: _percuss.RunResult, index: int, name: str) -> None:
        self._native = native
        self._index = index
        #: Name of the gauge.
        self.name = name

    def names(self) -> list[str]:
        return [_TIME.name, *super().names()]

    def _column(self, name: str) -> _percuss.Column | Array | None:
        if name != _TIME.name:
            return super()._column(name)
        import numpy

        times: Array = numpy.asarray(self._native.gauge_times(self._index)) * _TIME.per_si
        times.setflags(write=False)
        return times

    def _memory(self, si_name: str) -> _percuss.Column | None:
        return self._native.gauge_column(self._index, si_name)

    def __repr__(self) -> str:
        return f"<Gauge {self.name!r}, {len(self.part)} samples; {units_of(self.names())}>"


class History(SampleColumns, _Rows):
    """Scalars versus time. Long runs keep fewer samples, so the time steps are not uniform.

    Names and units are those of the files ``history.csv`` and ``history.parquet``. ``history.si`` has the columns in SI units.

    Attributes
    ----------
    {fields}

    Examples
    --------
    >>> history = percuss.run("cases/paper-table1/scenario.toml").history
    >>> bool(history.depth_mm.max() > 0.2), bool((history.depth_mm == history.si.depth_m * 1e3).all())
    (True, True)
    """

    _fields = {field.name: field for field in _percuss.sample_columns()}

    def __init__(self, native: _percuss.RunResult) -> None:
        self._native = native

    def _memory(self, si_name: str) -> _percuss.Column | None:
        return self._native.sample_column(si_name)

    def __len__(self) -> int:
        return self._native.samples() or 0

    @property
    def profiles(self) -> list[Profile]:
        """The state along the axis at some moments, from the first to the last."""
        return [Profile(self._native, index) for index in range(self._native.profiles())]

    @property
    def gauges(self) -> dict[str, Gauge]:
        """The state at each gauge of the case against time, by its name."""
        names = enumerate(self._native.gauges())
        return {name: Gauge(self._native, index, name) for index, name in names}

    def __repr__(self) -> str:
        head = f"<History of {len(self)} samples, {self._native.profiles()} profiles"
        if len(self) == 0:
            return f"{head}>"
        deepest = float(self.depth_mm.max())
        # Not every run has a depth.
        depth = f", largest {in_words('depth_mm', deepest)}" if deepest == deepest else ""
        return f"{head}; to {digits(float(self.time_us[-1]))} µs{depth}; {units_of(self.names())}>"


_TIME = History._fields["time_us"]

for _kind in (Profile, Gauge, History):
    fields.document(_kind, _kind._fields.values())
