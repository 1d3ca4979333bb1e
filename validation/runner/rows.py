"""Rows of results, in the columns of results.csv that a code can fill."""

from __future__ import annotations

import csv
from dataclasses import asdict, dataclass, fields

from case import CASES

# Largest relative distance from a stored value; in per cent for a quantity in per cent.
SAME = 0.01


@dataclass
class Row:
    case: str
    impact_velocity_m_s: float
    code: str
    commit: str
    resolution: str
    quantity: str
    value: float
    unit: str
    energy_error_percent: float | None = None

    def fields(self) -> dict[str, object]:
        row = asdict(self)
        row["energy_error_percent"] = "" if self.energy_error_percent is None else f"{self.energy_error_percent:.2f}"
        row["value"] = f"{self.value:.5g}"
        return row

    def text(self) -> str:
        return ",".join(f'"{value}"' if "," in str(value) else str(value) for value in self.fields().values())


FIELDS = [field.name for field in fields(Row)]


def stored_difference(row: Row) -> str | None:
    """How a row differs from the stored one of the same run; None where it does not, and where none is stored."""
    key = [row.case, f"{row.impact_velocity_m_s:g}", row.code, row.resolution, row.quantity]
    with (CASES / "results.csv").open(newline="") as file:
        for stored in csv.DictReader(file):
            of = [stored["case"], f"{float(stored['impact_velocity_m_s']):g}", stored["code"], stored["resolution"], stored["quantity"]]
            if of != key:
                continue
            value = float(stored["value"])
            distance = abs(row.value - value) / (10 if row.unit == "%" else abs(value))
            return f"{row.value:.5g} {row.unit}, stored {value:.5g}" if distance > SAME else None
    return None
