"""Names, units and descriptions of results and histories, from the library."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cached_property
from typing import Any

from . import _percuss


def described(fields: Iterable[_percuss.Field]) -> str:
    """The part of a docstring that lists values."""
    lines = []
    for field in fields:
        unit = f" [{field.unit}]" if field.unit else ""
        lines.append(f"    {field.name} : {field.kind}\n        {field.description.removesuffix('.')}{unit}.")
    return "\n".join(lines)


def document(kind: type, fields: Iterable[_percuss.Field]) -> None:
    """Puts the description of values into the docstring of a class, at ``{fields}``."""
    kind.__doc__ = (kind.__doc__ or "").replace("    {fields}", described(fields))


def add_values(kind: type, fields: Iterable[_percuss.Field]) -> None:
    """Gives a class of records an attribute per value, with its description."""
    fields = list(fields)
    document(kind, fields)
    for field in fields:
        attribute = cached_property(_value(field.name))
        attribute.__doc__ = f"{field.description} {field.kind}" + (f" [{field.unit}]" if field.unit else "")
        attribute.__set_name__(kind, field.name)
        setattr(kind, field.name, attribute)


def _value(name: str) -> Any:
    return lambda record: record[name]
