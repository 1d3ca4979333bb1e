"""Command lines whose results are data, for all functions of the package."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping, Sequence
from numbers import Real
from typing import Any, TypeAlias

from . import _percuss, quantities
from .case import Case
from .laws import StrengthLaw
from .progress import Progress, watching

#: A path of a file or folder.
Path: TypeAlias = str | os.PathLike[str]
#: A case, or the path of a case file.
CaseLike: TypeAlias = Case | Path
#: Velocity in m/s, a text with its unit, or a quantity of pint or astropy.
Speed: TypeAlias = float | str


def execute(
    command: str,
    *names: Path,
    of: CaseLike | Sequence[CaseLike] | None = None,
    texts: Mapping[str, str] | None = None,
    progress: Progress | bool | None = None,
    laws: tuple[StrengthLaw | None, StrengthLaw | None, str] = (None, None, ""),
    **options: Any,
) -> _percuss.Response:
    """Executes a command. Options have the names of the command line; ``None`` selects the default.

    ``of`` are cases that follow ``names`` on the command line; ``texts`` replace files that options name; ``laws`` are strength laws of
    projectile and target with what tells them from others, for ``uncertainty``.
    """
    cases: dict[str, _percuss.Case] = {}

    def word(value: Any) -> str:
        if isinstance(value, Case):
            # No file has this name: the text replaces it.
            name = f"\0case-{len(cases) + 1}"
            cases[name] = value._native
            return name
        return os.fsdecode(value) if isinstance(value, (os.PathLike, bytes)) else str(value)

    line = ["percuss", *command.split()]
    for name, value in options.items():
        flag = "--" + name.replace("_", "-")
        for item in value if isinstance(value, (list, tuple)) else [value]:
            if item is True:
                line.append(flag)
            elif item is not None and item is not False:
                line.append(f"{flag}={word(item)}")
    line += ["--", *map(word, [*names, *several(of)])]
    with watching(progress) as on_progress:
        return _percuss.execute(line, cases, dict(texts or {}), on_progress, *laws)


def answer(command: str, *names: Path, **options: Any) -> Any:
    """Output of a command with --json; the arguments are those of :func:`execute`."""
    return json.loads(execute(command, *names, **options).json())


def several(names: Any) -> list[Any]:
    """One or more paths, names or cases as a list."""
    if names is None:
        return []
    return [names] if isinstance(names, (str, os.PathLike, Case)) else list(names)


def formats(figures: str | Sequence[str] | None) -> str | None:
    """Formats of figures as text of the command line."""
    return figures if figures is None or isinstance(figures, str) else ",".join(figures) or "none"


def speeds(speeds: Speed | Iterable[float] | None) -> str | None:
    """Velocities as text of the command line, with all digits."""
    if speeds is None or isinstance(speeds, str):
        return speeds
    quantity = quantities.text(speeds)
    if quantity is not None:
        return _speed_texts(quantity)
    if isinstance(speeds, bool):
        raise TypeError("a velocity is a number [m/s] or a text such as \"230 m/s\", and not True or False")
    # The whole numbers of NumPy are no `int`.
    speeds = float(speeds) if isinstance(speeds, Real) else speeds
    if isinstance(speeds, float):
        return repr(speeds)
    return ",".join(repr(float(speed)) for speed in speeds)


def _speed_texts(quantity: str | float | list[Any]) -> str:
    """Velocities of pint or astropy, in m/s, as text of the command line."""
    if isinstance(quantity, list):
        return ",".join(str(item).removesuffix(" m/s") for item in quantity)
    return str(quantity)


def with_unit(speed: Speed | None) -> str | None:
    """Velocity as text of the command line."""
    quantity = None if speed is None or isinstance(speed, str) else quantities.text(speed)
    if quantity is not None:
        return str(quantity)
    return speed if speed is None or isinstance(speed, str) else f"{float(speed)!r} m/s"
