"""Writes the reference of the package, docs/reference/python.md, from its docstrings, and the types of results, values.py, from the library.

python crates/percuss-py/reference.py
"""

from __future__ import annotations

import inspect
from collections.abc import Iterable
from pathlib import Path

import percuss
from percuss import _percuss

PAGE = Path(__file__).resolve().parents[2] / "docs/reference/python.md"
TYPES = Path(__file__).resolve().parent / "python/percuss/values.py"
#: Kinds of values, and their types.
KINDS = {"array": "Array", "array of int": "Array", "list of str": "list[str]", "list of Record": "list[Record]"}


def signature(name: str, function: object) -> str:
    """A call as it may be written, a parameter a line when it is long."""
    assert callable(function)
    found = inspect.signature(function)
    shown = f"{name}{found}".replace("'", "")
    if len(shown) <= 100:
        return shown
    parameters = [p for p in str(found).replace("'", "").rpartition(")")[0].lstrip("(").split(", ")]
    joined: list[str] = []
    for part in parameters:
        # A comma inside of brackets belongs to a type.
        if joined and joined[-1].count("[") > joined[-1].count("]"):
            joined[-1] += f", {part}"
        else:
            joined.append(part)
    end = str(found).replace("'", "").rpartition(")")[2]
    return f"{name}(\n" + "".join(f"    {part},\n" for part in joined) + f"){end}"


def described(thing: object) -> str:
    """Its docstring, as it stands in the source."""
    return f"```text\n{inspect.getdoc(thing) or ''}\n```\n"


def members(kind: type) -> list[str]:
    """Methods and properties that a class adds and that have a docstring."""
    parts = []
    for name, member in vars(kind).items():
        shown = member.fget if isinstance(member, property) else getattr(member, "__func__", member)
        if name.startswith("_") or not inspect.isfunction(shown):
            continue
        title = f"{kind.__name__}.{name}" if isinstance(member, property) else signature(f"{kind.__name__}.{name}", shown)
        parts.append(f"```python\n{title}\n```\n\n{described(shown)}")
    return parts


def entry(name: str) -> str:
    thing = getattr(percuss, name)
    parts = [f"### `percuss.{name}`\n"]
    if inspect.isfunction(thing):
        parts += [f"```python\n{signature(name, thing)}\n```\n", described(thing)]
    elif inspect.isclass(thing):
        parts += [described(thing), *members(thing)]
    else:
        parts.append(f"```python\n{name} = {thing}\n```\n")
    return "\n".join(parts)


def page() -> str:
    names = [name for name in percuss.__all__ if not name.startswith("_")]
    things = {name: getattr(percuss, name) for name in names}
    errors = [name for name, thing in things.items() if inspect.isclass(thing) and issubclass(thing, BaseException)]
    groups = {
        "Functions": [name for name, thing in things.items() if inspect.isfunction(thing)],
        "Cases and results": [name for name, thing in things.items() if inspect.isclass(thing) and name not in errors],
        "Errors": errors,
        "Types": [name for name, thing in things.items() if not inspect.isfunction(thing) and not inspect.isclass(thing)],
    }
    text = "# The package `percuss`\n\nWhat `help(percuss)` says, sorted. [Percuss in Python](../python.md) shows how it is used. This page is written from the docstrings.\n"
    for title, group in groups.items():
        text += f"\n## {title}\n\n" + "\n".join(entry(name) for name in group)
    return text


def typed(name: str, text: str, fields: Iterable[_percuss.Field]) -> str:
    """A class whose attributes have the types of values."""
    lines = [f"    {field.name}: {KINDS.get(field.kind, field.kind.replace(' or ', ' | '))}" for field in fields]
    return f'\n\nclass {name}:\n    """{text}"""\n\n' + "\n".join(lines) + "\n"


def types() -> str:
    return (
        '"""Types of the values of results and histories, for editors and type checkers. Written by reference.py."""\n\n'
        "from __future__ import annotations\n\n"
        "from typing import TYPE_CHECKING, Any\n\n"
        "from .record import Record\n\n"
        "if TYPE_CHECKING:\n"
        "    from numpy.typing import NDArray\n\n"
        "    Array = NDArray[Any]\n"
        + typed("ResultValues", "Values of the result of a run.", _percuss.result_fields())
        + typed("SampleColumns", "Columns of a history.", _percuss.sample_columns())
        + typed("ElementColumns", "Columns of a state along the axis.", _percuss.element_columns())
    )


if __name__ == "__main__":
    for path, text in ((PAGE, page()), (TYPES, types())):
        path.write_text(text, encoding="utf-8")
        print(f"wrote {path}")
