"""Command lines that are answered as data: what the functions of the package pass their options on to."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from typing import Any, TypeAlias

from . import _percuss
from .case import Case
from .progress import Progress, watching

#: A path of a file or folder.
Path: TypeAlias = str | os.PathLike[str]
#: A case, or the path of a case file.
CaseLike: TypeAlias = Case | Path
#: A speed in m/s, or a text with its unit.
Speed: TypeAlias = float | str


def native_answer(
    command: str,
    *names: Path,
    of: CaseLike | Sequence[CaseLike] | None = None,
    texts: Mapping[str, str] | None = None,
    progress: Progress | bool | None = None,
    **options: Any,
) -> _percuss.Answer:
    """What a command finds out. Options have the names that they have there; ``None`` stands for the default.

    ``of`` are cases that follow ``names`` on the command line; ``texts`` stand in the place of files that options name.
    """
    cases: dict[str, _percuss.Case] = {}

    def word(value: Any) -> str:
        if isinstance(value, Case):
            # No file has this name: what is at hand stands in its place.
            name = f"\0case-{len(cases) + 1}"
            cases[name] = value._native
            return name
        return os.fspath(value) if isinstance(value, os.PathLike) else str(value)

    line = ["percuss", *command.split()]
    for name, value in options.items():
        flag = "--" + name.replace("_", "-")
        for item in value if isinstance(value, (list, tuple)) else [value]:
            if item is True:
                line.append(flag)
            elif item is not None and item is not False:
                line.append(f"{flag}={word(item)}")
    line += ["--", *map(word, [*names, *several(of)])]
    with watching(progress) as hear:
        return _percuss.answer(line, cases, dict(texts or {}), hear)


def answer(command: str, *names: Path, **options: Any) -> Any:
    """What a command prints with --json; the arguments are those of :func:`native_answer`."""
    return json.loads(native_answer(command, *names, **options).json())


def several(names: Any) -> list[Any]:
    """One or more paths, names or cases as a list."""
    if names is None:
        return []
    return [names] if isinstance(names, (str, os.PathLike, Case)) else list(names)


def speeds(speeds: Speed | Sequence[float] | None) -> str | None:
    """Speeds as the command line has them: with as many digits as it takes to read them back unchanged."""
    if speeds is None or isinstance(speeds, str):
        return speeds
    if isinstance(speeds, (int, float)):
        return repr(float(speeds))
    return ",".join(repr(float(speed)) for speed in speeds)


def with_unit(speed: Speed | None) -> str | None:
    """A speed as the command line has it."""
    return speed if speed is None or isinstance(speed, str) else f"{float(speed)!r} m/s"
