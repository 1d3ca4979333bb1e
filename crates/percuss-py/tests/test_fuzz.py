"""Python entries with mutated arguments: each gives a result or a short error of a documented kind.

``PERCUSS_FUZZ`` sets how many calls, ``PERCUSS_SEED`` which.
"""

from __future__ import annotations

import copy
import math
import os
import random
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

import percuss
import pytest

CALLS = int(os.environ.get("PERCUSS_FUZZ", "2000"))
SEED = int(os.environ.get("PERCUSS_SEED", "1"))
# OverflowError is that of an integer that no C number holds.
ALLOWED = (percuss.PercussError, TypeError, ValueError, OSError, OverflowError)
LONGEST_MESSAGE = 4000

TABLES: dict[str, Any] = {
    "title": "a shot",
    "projectile": {"material": "copper", "length": "12.74 mm", "diameter": 4.8e-3, "impact_velocity": 230.0, "nose": "flat"},
    "target": {"material": "aluminium-2024-t351", "thickness": 0.025, "back_face": "free"},
    "chain": {"projectile_elements": 4, "target_elements": 8, "max_steps": 200},
    "fdm": {"max_steps": 200},
    "gauges": [{"position": "-1 mm"}],
    "materials": {"own": {"name": "Own", "density": 2500.0, "youngs_modulus": "70 GPa", "poissons_ratio": 0.2, "strength": {"elastic": {}}}},
}


class Odd:
    """An object whose conversions fail or lie."""

    def __str__(self) -> str:
        raise KeyError("no text")

    def __float__(self) -> float:
        return math.nan

    def __len__(self) -> int:
        return 1 << 40

    def __index__(self) -> int:
        return 1 << 70

    def __fspath__(self) -> str:
        return "\0"


def values(draw: random.Random) -> Any:
    nested: list[Any] = []
    for _ in range(draw.randrange(300)):
        nested = [nested]
    return draw.choice([
        None, True, False, 0, -1, 1, 3, 1 << 70, -(1 << 70), math.nan, math.inf, -math.inf, 1e308, 5e-324, 0.5, "", " ", "\0", "\ud800", "é",
        "1 mm", "1e400 m", "x" * 100_000, b"bytes", bytearray(3), [], {}, (), set(), [1, 2, 3], {"a": {"b": 1}}, {1: 2}, nested, Odd(), Odd,
        print, Ellipsis, 1j, range(3), Path("nowhere"), "copper", "free", "semi-infinite", [[1.0, 2.0]], {"values": [1, 2]}, object(),
    ])


def mutated(draw: random.Random, tables: dict[str, Any]) -> dict[str, Any]:
    """Tables with one to three values replaced, removed or added."""
    changed = copy.deepcopy(tables)
    for _ in range(draw.randint(1, 3)):
        at: Any = changed
        while True:
            keys = list(at) if isinstance(at, dict) else list(range(len(at)))
            if not keys:
                break
            key = draw.choice(keys)
            if isinstance(at[key], (dict, list)) and at[key] and draw.random() < 0.8:
                at = at[key]
                continue
            match draw.randrange(5):
                case 0 if isinstance(at, dict):
                    del at[key]
                case 1 if isinstance(at, dict):
                    at[draw.choice(["", "new", "a.b", "x" * 2000, "é\n", "length", "model"])] = values(draw)
                case _:
                    at[key] = values(draw)
            break
    return changed


def calls(folder: Path) -> list[tuple[Callable[..., Any], dict[str, Any]]]:
    """Entries with valid keyword arguments."""
    case = percuss.Case(**TABLES)
    return [
        (percuss.run, {"case": case, "model": "crater_energy"}),
        (percuss.run, {"case": case, "model": "chain", "history": True, "frames": None}),
        (percuss.compare, {"case": case, "velocity": [100.0, 200.0], "fast": True, "model": ["crater_energy", "poncelet"]}),
        (percuss.limit, {"case": case, "velocity": "100..300 m/s", "model": "plugging", "points": 5}),
        (percuss.converge, {"case": case, "model": "fdm", "levels": 2}),
        (percuss.uncertainty, {"case": case, "model": "crater_energy", "samples": 16}),
        (percuss.material, {"name": "copper"}),
        (percuss.materials, {}),
        (percuss.model, {"name": "chain"}),
        (percuss.load, {"path": folder / "case.toml"}),
        (percuss.sweep, {"sweep": folder / "nowhere.toml", "out": folder / "nowhere"}),
        (percuss.schema, {}),
        (case.replace, {"projectile": {"length": "3 mm"}}),
    ]


def attempt(call: Callable[..., Any], arguments: dict[str, Any], ends: Counter[str]) -> None:
    try:
        call(**arguments)
    except ALLOWED as error:
        ends[type(error).__name__] += 1
        # What an odd object raises is passed on.
        if not isinstance(error, KeyError):
            assert len(str(error)) < LONGEST_MESSAGE, f"{call}: {len(str(error))} characters: {str(error)[:300]}"
    except KeyError as error:
        assert error.args == ("no text",), error
        ends["KeyError of the argument"] += 1
    else:
        ends["result"] += 1


def test_cases_of_mutated_tables_are_built_or_refused() -> None:
    draw = random.Random(SEED)
    ends: Counter[str] = Counter()
    for _ in range(CALLS):
        tables = mutated(draw, TABLES)
        attempt(percuss.Case, {key: value for key, value in tables.items() if key.isprintable()}, ends)
    print(dict(ends))
    assert ends["CaseError"] > CALLS / 10


def test_mutated_arguments_get_a_result_or_an_error(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    draw = random.Random(SEED)
    ends: Counter[str] = Counter()
    entries = calls(tmp_path)
    for _ in range(CALLS // 4):
        call, arguments = draw.choice(entries)
        changed = dict(arguments)
        for _ in range(draw.randint(1, 2)):
            key = draw.choice([*arguments, "progress", "out", "nothing"]) if arguments else "nothing"
            changed[key] = values(draw)
        # Files are written below the folder of the test alone.
        if isinstance(changed.get("out"), (str, Path)):
            changed["out"] = tmp_path / str(draw.randrange(10))
        if callable(changed.get("progress")):
            del changed["progress"]
        attempt(call, changed, ends)
    print(dict(ends))
    assert ends["TypeError"] > CALLS / 100
