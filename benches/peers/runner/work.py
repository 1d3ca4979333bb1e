"""The work: chains of masses and springs, or runs of percuss's default model, written to a file that every program reads."""

import math
from dataclasses import dataclass
from pathlib import Path

# Table 1 of the seed paper (docs/reference/paper/paper.md): copper rod of 40 masses, column of 2024-T351 aluminium of 80 masses.
ROD = 40
COLUMN = 80
AREA_M2 = math.pi / 4 * 4.8e-3**2
TIME_STEP_S = 4.85e-9
CONSTRAINT_FACTOR = 2.7
SLOWEST_M_S, FASTEST_M_S = 150.0, 400.0


@dataclass(frozen=True)
class Spring:
    """A spring and the mass at its front end. Force is area times stress."""

    mass_kg: float
    length_m: float
    stiffness_n: float  # elastic force at strain 1 [N]
    coefficient_n: float  # force of the power law at strain 1 [N]
    exponent: float


def springs() -> list[Spring]:
    """The 120 springs: spring i joins mass i to mass i + 1, the last one joins the last mass to a wall."""
    rod = Spring(1.96e-3 / ROD, 12.74e-3 / ROD, 114e9 * AREA_M2, 443e6 * AREA_M2, 0.1)
    column = Spring(
        1.22e-3 / COLUMN, 25e-3 / COLUMN, 70e9 * AREA_M2, CONSTRAINT_FACTOR * 776e6 * AREA_M2, 0.096
    )
    # Between rod and column: half an element of each in series, and the strength of the weaker one.
    length = (rod.length_m + column.length_m) / 2
    compliance = rod.length_m / (2 * rod.stiffness_n) + column.length_m / (2 * column.stiffness_n)
    joint = Spring(rod.mass_kg, length, length / compliance, rod.coefficient_n, rod.exponent)
    return [rod] * (ROD - 1) + [joint] + [column] * COLUMN


def write(path: Path, chains: int, steps: int) -> None:
    """Writes the masses, the length of the rod in masses, the number of chains, of steps, and the time step; then a line a spring;
    then the impact velocity of every chain [m/s]."""
    rows = springs()
    lines = [f"{len(rows)} {ROD} {chains} {steps} {TIME_STEP_S!r}"]
    lines += [
        f"{s.mass_kg!r} {s.length_m!r} {s.stiffness_n!r} {s.coefficient_n!r} {s.exponent!r}" for s in rows
    ]
    lines += map(repr, speeds(chains))
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def speeds(count: int) -> list[float]:
    """Impact velocities, evenly spaced [m/s]."""
    spacing = (FASTEST_M_S - SLOWEST_M_S) / count
    return [SLOWEST_M_S + (i + 0.5) * spacing for i in range(count)]


# The same bodies without a constraint factor, a line each: density, Young's modulus, Poisson's ratio, coefficient and exponent of the power law, in SI.
COPPER = (8500.0, 114e9, 0.34, 443e6, 0.1)
ALUMINIUM = (2780.0, 70e9, 0.33, 776e6, 0.096)
ROD_M, DIAMETER_M, PLATE_M = 12.74e-3, 4.8e-3, 25e-3


def write_runs(path: Path, runs: int) -> None:
    """Writes the elements of rod and plate and the number of runs; length and diameter of the rod and thickness of the plate [m]; their
    materials; then the impact velocity of every run [m/s]."""
    rows = [(ROD, COLUMN, runs), (ROD_M, DIAMETER_M, PLATE_M), COPPER, ALUMINIUM, *((speed,) for speed in speeds(runs))]
    path.write_text("".join(" ".join(map(repr, row)) + "\n" for row in rows), encoding="utf-8")
