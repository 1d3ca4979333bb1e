"""A case of percuss in SI units: the one source of lengths, velocities and constants for every deck.

Lengths and velocities come from the case file, constants from its own materials or from `percuss materials ID --json`."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import tomllib
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
CASES = ROOT / "crates/percuss-research/data/codes"

# Units of the compared cases.
UNITS = {
    "mm": 1e-3,
    "m": 1.0,
    "m/s": 1.0,
    "kg/m3": 1.0,
    "g": 1e-3,
    "GPa": 1e9,
    "MPa": 1e6,
    "us": 1e-6,
    "K": 1.0,
    "1/s": 1.0,
    "J/(kg K)": 1.0,
}


class ToolMissing(Exception):
    """A program that a run needs is not installed."""


@dataclass
class Job:
    """One run of a code."""

    case: str
    velocity: float
    mesh: float
    options: dict[str, Any] = field(default_factory=dict)

    def label(self) -> str:
        words = [self.case, f"{self.velocity:g}", f"{self.mesh:g}", *(f"{key}-{value}" for key, value in self.options.items())]
        return "_".join(words)


@dataclass
class Material:
    density: float
    youngs_modulus: float
    poissons_ratio: float
    strength: dict[str, dict[str, Any]]
    equation_of_state: dict[str, Any] | None
    specific_heat: float | None

    @property
    def shear_modulus(self) -> float:
        return self.youngs_modulus / (2 * (1 + self.poissons_ratio))

    @property
    def bulk_modulus(self) -> float:
        return self.youngs_modulus / (3 * (1 - 2 * self.poissons_ratio))

    def law(self, name: str) -> dict[str, float]:
        """Constants of a strength law in SI units."""
        if name not in self.strength:
            raise RuntimeError(f"the deck has no form of the strength law {', '.join(self.strength)}; it takes {name}")
        return {key: number(value) for key, value in self.strength[name].items() if key != "rate_form"}


@dataclass
class Case:
    name: str
    text: dict[str, Any]
    velocity: float

    @staticmethod
    def load(name: str, velocity: float) -> Case:
        return Case(name, tomllib.loads((CASES / f"{name}.toml").read_text()), velocity)

    def length(self, *keys: str) -> float:
        value: Any = self.text
        for key in keys:
            value = value[key]
        return number(value)

    def options(self, model: str) -> dict[str, Any]:
        return self.text.get(model, {})

    def material(self, role: str) -> Material:
        name = self.text[role]["material"]
        own = self.text.get("materials", {})
        record = own[name] if name in own else library(name)
        strength = {key: value for key, value in record["strength"].items() if isinstance(value, dict)}
        heat = record.get("specific_heat")
        return Material(
            number(record["density"]),
            number(record["youngs_modulus"]),
            number(record["poissons_ratio"]),
            strength,
            record.get("equation_of_state"),
            None if heat is None else number(heat),
        )


def number(value: Any) -> float:
    """A number with or without a unit, in SI units."""
    if isinstance(value, (int, float)):
        return float(value)
    match = re.fullmatch(r"\s*([-+0-9.eE]+)\s+(.+?)\s*", value)
    if not match or match[2] not in UNITS:
        raise RuntimeError(f"cannot read `{value}`: known units are {', '.join(UNITS)}")
    return float(match[1]) * UNITS[match[2]]


def library(name: str) -> dict[str, Any]:
    """The recommended record of a material."""
    program = os.environ.get("PERCUSS") or shutil.which("percuss") or str(ROOT / "target/release/percuss")
    if not Path(program).is_file():
        raise ToolMissing("percuss itself: set PERCUSS to the program, which has the constants")
    found = json.loads(subprocess.run([program, "materials", name, "--json"], check=True, capture_output=True, text=True).stdout)
    exact = [record for record in found if record["id"] == name]
    recommended = [record for record in found if record.get("family") == name and record.get("recommended")]
    if not exact + recommended:
        raise RuntimeError(f"no material `{name}`")
    return (exact + recommended)[0]


def program(variable: str, what: str) -> Path:
    """A file that an environment variable names."""
    value = os.environ.get(variable)
    if not value:
        raise ToolMissing(f"{what} is not installed here: set {variable}")
    path = Path(value).expanduser()
    if not path.exists():
        raise ToolMissing(f"{variable} names {path}, which does not exist")
    return path.resolve()
