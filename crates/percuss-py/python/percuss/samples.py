"""Samples of a study as arrays."""

from __future__ import annotations

from typing import TYPE_CHECKING

from . import _percuss
from .history import _Columns
from .record import units_of

if TYPE_CHECKING:
    import pandas
    import pyarrow


class Sample(_Columns):
    """One row per run, or per state of the posterior. Columns are read-only views of the memory of the result.

    ``sample["projectile.impact_velocity_m_s"]`` gives a column by its name; :meth:`names` lists all. Missing values
    are NaN.

    Attributes
    ----------
    outcome : list of str
        Outcome of each run; empty for a posterior.
    """

    def __init__(self, native: _percuss.Response) -> None:
        self._native = native

    @property
    def outcome(self) -> list[str]:
        """Outcome of each run."""
        return self._native.outcomes()

    def names(self) -> list[str]:
        return self._native.names()

    def _column(self, name: str) -> _percuss.Column | None:
        return self._native.column(name)

    def to_pandas(self, units: str | None = None) -> pandas.DataFrame:
        table = super().to_pandas(units)
        if self.outcome:
            table["outcome"] = self.outcome
        return table

    def to_arrow(self, units: str | None = None) -> pyarrow.Table:
        table = super().to_arrow(units)
        return table.append_column("outcome", [self.outcome]) if self.outcome else table

    def __len__(self) -> int:
        return self._native.rows()

    def __repr__(self) -> str:
        return f"<Sample of {len(self)} rows, {len(self.names())} columns; {units_of(self.names())}>"
