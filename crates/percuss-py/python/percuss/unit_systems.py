"""Tables in other unit systems, and as variables of xarray."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from . import _percuss
from .errors import UsageError
from .optional import library

if TYPE_CHECKING:
    import xarray


def in_units(columns: Mapping[str, Any], system: str | None) -> dict[str, Any]:
    """Columns in a unit system: numbers whose names end with a unit get that of the system, and a name that says so.

    Examples
    --------
    >>> in_units({"depth_mm": [2.0, None], "outcome": ["at rest", "failed"]}, "SI")
    {'depth_m': [0.002, None], 'outcome': ['at rest', 'failed']}
    """
    return {new: values for new, _, values in _converted(columns, system)}


def _converted(columns: Mapping[str, Any], system: str | None) -> Iterator[tuple[str, str, Any]]:
    """Name, unit and values of each column in a unit system."""
    for name, values in columns.items():
        try:
            change = None if system is None else _percuss.in_units(name, system)
        except ValueError as error:
            raise UsageError(str(error)) from None
        if change is None:
            yield name, unit_of(name), values
        else:
            new, factor, unit = change
            yield new, unit, _scaled(values, factor)


def _scaled(values: Any, factor: float) -> Any:
    if isinstance(values, list):
        return [value * factor if isinstance(value, (int, float)) else value for value in values]
    return values * factor


def unit_of(name: str) -> str:
    """Unit that a name ends with; empty where it ends with none."""
    return next((unit for end, unit in _percuss.units() if name.endswith(end)), "")


def dataset(columns: Mapping[str, Any], dimension: str, system: str | None = None, coordinate: str | None = None) -> xarray.Dataset:
    """Columns of numbers and texts as variables along a dimension, with ``units``; columns of tables are left out."""
    import numpy

    make = library("xarray").Dataset
    flat = {name: values for name, values in columns.items() if not any(isinstance(value, (dict, list)) for value in values)}
    variables: dict[str, Any] = {}
    for name, unit, values in _converted(flat, system):
        if isinstance(values, list):
            numbers = all(value is None or isinstance(value, (int, float)) for value in values)
            values = numpy.array(values, dtype=float) if numbers else numpy.array([str(value) for value in values])
        variables[name] = (dimension, numpy.asarray(values), {"units": unit} if unit else {})
    made: xarray.Dataset = make(variables)
    place = next(iter(in_units({coordinate: []}, system))) if coordinate is not None else None
    return made if place is None else made.set_coords(place)
