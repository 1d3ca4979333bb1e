"""Tables of a case as objects whose values can be read and set."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cache
from typing import Any

Way = tuple[str | int, ...]


class Part:
    """A table of a :class:`Case`: its values as attributes, which can be set.

    A value that the case does not give is ``None``. What is set is checked at once, with its unit; what is refused leaves the case as it was.
    ``None`` takes a value out.

    Examples
    --------
    >>> case = percuss.load("cases/paper-table1/scenario.toml")
    >>> case.projectile.impact_velocity
    '230 m/s'
    >>> case.projectile.impact_velocity = "250 m/s"
    >>> case.impact_velocity_m_s, case.chain.courant
    (250.0, None)
    """

    _tables: Callable[[], dict[str, Any]]
    _put: Callable[[Way, Any], None]
    _way: Way

    def __init__(self, tables: Callable[[], dict[str, Any]], put: Callable[[Way, Any], None], way: Way) -> None:
        vars(self).update(_tables=tables, _put=put, _way=way)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        table = self.to_dict()
        if name not in table and name not in keys(self._way):
            raise AttributeError(f"`{_dotted(self._way)}` has no `{name}`; it has: {', '.join(keys(self._way))}")
        return value(table.get(name), self._tables, self._put, (*self._way, name))

    def __setattr__(self, name: str, value: Any) -> None:
        self._put((*self._way, name), value)

    def __delattr__(self, name: str) -> None:
        self._put((*self._way, name), None)

    def __dir__(self) -> list[str]:
        return keys(self._way)

    def to_dict(self) -> dict[str, Any]:
        """Values as in the case file."""
        table: Any = self._tables()
        for step in self._way:
            table = table[step] if isinstance(step, int) else table.get(step, {})
        return dict(table)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Part) and self.to_dict() == other.to_dict()

    __hash__ = None  # type: ignore[assignment]

    def __repr__(self) -> str:
        values = ", ".join(f"{name}={given!r}" for name, given in self.to_dict().items())
        return f"<{_dotted(self._way)}: {values}>"


def value(given: Any, tables: Callable[[], dict[str, Any]], put: Callable[[Way, Any], None], way: Way) -> Any:
    """A value of a case: a table as a part, a list of tables as a list of parts."""
    if isinstance(given, dict) or (given is None and _is_table(way)):
        return Part(tables, put, way)
    if isinstance(given, list) and given and all(isinstance(item, dict) for item in given):
        return [Part(tables, put, (*way, i)) for i in range(len(given))]
    return given


def keys(way: Way) -> list[str]:
    """Names of the keys of a table of a case, by the keys that lead to it; none where it is no table."""
    return list(dict.fromkeys(name for form in _at(way) for name in form.get("properties", {})))


def _is_table(way: Way) -> bool:
    """Whether nothing but a table can stand there."""
    forms = _at(way)
    return any("properties" in form for form in forms) and not any("const" in form or form.get("type") == "string" for form in forms)


def _at(way: Way) -> list[dict[str, Any]]:
    """The forms of what the keys lead to."""
    forms = [_schema()]
    for step in way:
        forms = [inner for form in forms for inner in _below(form, step)]
    return forms


@cache
def _schema() -> dict[str, Any]:
    from .library import schema

    return schema()


def _forms(schema: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """The forms that a schema allows, references and choices resolved."""
    if "$ref" in schema:
        yield from _forms(_schema()["$defs"][schema["$ref"].removeprefix("#/$defs/")])
        return
    yield schema
    for choices in ("anyOf", "oneOf", "allOf"):
        for choice in schema.get(choices, []):
            yield from _forms(choice)


def _below(form: dict[str, Any], step: str | int) -> Iterator[dict[str, Any]]:
    inner = form.get("items") if isinstance(step, int) else form.get("properties", {}).get(step, form.get("additionalProperties"))
    if isinstance(inner, dict):
        yield from _forms(inner)


def _dotted(way: Way) -> str:
    return ".".join(map(str, way))
