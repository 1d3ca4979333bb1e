"""Rows of results, in the columns of results.csv that a code can fill."""

from __future__ import annotations

from dataclasses import asdict, dataclass, fields


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
