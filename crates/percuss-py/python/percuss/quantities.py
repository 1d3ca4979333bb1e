"""Quantities of pint and astropy as texts with a unit."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from typing import Any

#: Exponents of kilogram, metre, second and kelvin of each unit of a case.
_SYMBOLS: dict[tuple[Fraction, ...], str] = {
    tuple(map(Fraction, powers)): symbol
    for powers, symbol in {
        (0, 1, 0, 0): "m",
        (1, 0, 0, 0): "kg",
        (0, 0, 1, 0): "s",
        (0, 1, -1, 0): "m/s",
        (1, -1, -2, 0): "Pa",
        (1, -3, 0, 0): "kg/m3",
        (0, 0, 0, 1): "K",
        (0, 0, -1, 0): "1/s",
        (0, 2, -2, -1): "J/(kg K)",
        (1, 0, -2, 0): "J/m2",
        (-1, 1, 2, 0): "1/Pa",
        (0, 0, 0, -1): "1/K",
    }.items()
}
_BASES = {"kilogram": 0, "kg": 0, "meter": 1, "metre": 1, "m": 1, "second": 2, "s": 2, "kelvin": 3, "K": 3}
_ANGLES = {"radian", "rad"}


def text(value: Any) -> str | float | list[Any] | None:
    """A quantity of pint or astropy as a text in SI units, an array of them as a list; a ratio as a number, any other value as ``None``.

    Raises
    ------
    ValueError
        When no number of a case has its dimension.

    Examples
    --------
    >>> text("4.8 mm") is None
    True
    """
    if hasattr(value, "magnitude") and hasattr(value, "to_base_units"):
        base = value.to_base_units()
        units: Mapping[str, Any] = dict(base.unit_items())
        return _written(base.magnitude, units, value, base.units != value.units)
    if hasattr(value, "unit") and hasattr(value, "value"):
        # The temperatures of astropy in degrees Celsius have no way to SI units of their own.
        absolute = {"deg_C": 273.15}.get(str(value.unit))
        if absolute is not None:
            return _written(value.value + absolute, {"kelvin": 1}, value, True)
        base = value.si
        units = {base_unit.to_string(): power for base_unit, power in zip(base.unit.bases, base.unit.powers)}
        return _written(base.value * base.unit.scale, units, value, base.unit != value.unit)
    return None


def _written(number: Any, units: Mapping[str, Any], value: Any, converted: bool) -> str | float | list[Any]:
    own = number.tolist() if hasattr(number, "tolist") else number
    if isinstance(own, list):
        return [_written(item, units, value, converted) for item in own]
    symbol = _symbol(units, value)
    si = _without_rounding(float(own)) if converted else float(own)
    return f"{si!r} {symbol}" if symbol else si


def _without_rounding(converted: float) -> float:
    """A converted number to the 15 digits that the conversion keeps: 750 ft/s are 228.6 m/s, not 228.59999999999997."""
    return float(f"{converted:.15g}")


def _symbol(units: Mapping[str, Any], value: Any) -> str:
    """Symbol of the SI unit; empty of a ratio."""
    powers = [Fraction(0)] * 4
    angle = False
    for name, power in units.items():
        if name in _ANGLES:
            angle = power == 1
        elif name in _BASES:
            powers[_BASES[name]] += Fraction(power).limit_denominator(12)
        else:
            powers = [Fraction(99)] * 4
    if not any(powers):
        return "rad" if angle else ""
    symbol = _SYMBOLS.get(tuple(powers))
    if symbol is None or angle:
        raise ValueError(f"no number of a case has the unit of {value}; give a text such as \"4.8 mm\"")
    return symbol
