"""Benchmark of every model that gives depths against the axisymmetric reference."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from . import report_plots
from .command_line import Path, execute
from .errors import UsageError
from .progress import Progress
from .record import Record, Records, Result, table_html

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# What ``--by`` of the command takes, and what the groups are called in its JSON.
_GROUPINGS = {"speed": "speed", "length": "length", "regime": "regime", "materials": "pair", "uncertainty": "reference"}


class Benchmark(Result):
    """Models against the axisymmetric reference: the values of ``percuss benchmark --json``. One row per model and case.

    Relative error = depth / reference depth - 1.

    Attributes
    ----------
    reference : str
        Source of the reference.
    failures : list of str
        Cases whose reference could not be computed, with the reason.
    refused : list of Record
        Cases left out of all numbers because their reference fails its convergence check: materials, ``length_to_diameter``,
        ``impact_velocity_m_s`` and ``reason``.
    findings : list of str
        Findings as sentences.
    statistics : list of Record
        Errors by group: ``candidate`` (a model, with its closure where it has several), ``grouping``, ``value``, ``count``, ``median``,
        ``low`` and ``high`` (10th and 90th percentile), ``median_absolute`` and ``within_25_percent``.
    variants : list of Record
        Case of the seed paper with one change at a time: ``variant``, ``change``, ``depth_of_penetration_mm``, ``error``.
    verdicts : list of Record
        Every depth with its reference: ``depth_of_penetration_mm``, ``reference_depth_mm`` and ``reference_uncertainty_mm``.
    """

    percuss_version: str
    reference: str
    failures: list[str]
    refused: list[Record]
    findings: list[str]
    statistics: list[Record]
    variants: list[Record]
    verdicts: list[Record]

    def _rows(self) -> list[dict[str, Any]]:
        return list(self._data["verdicts"])

    def errors(self, by: str | None = None) -> Records[Record]:
        """Errors of every model, of all runs or by ``speed``, ``length``, ``regime``, ``materials`` or ``uncertainty`` of the reference."""
        if by is not None and by not in _GROUPINGS:
            raise UsageError(f"`{by}` groups no errors; groups: {', '.join(_GROUPINGS)}")
        grouping = "all" if by is None else _GROUPINGS[by]
        names = ["candidate", "value", "count", "median", "low", "high", "median_absolute", "within_25_percent"]
        return Records((group for group in self.statistics if group.grouping == grouping), *names)

    def plot(self, by: str | None = None, ax: Axes | None = None) -> Axes:
        """Draws the errors of every model: median and 10th-90th percentile, or median absolute errors by a property of ``errors``."""
        return report_plots.errors(self, by, ax)

    def _headline(self) -> list[str]:
        return self.findings[:1] or [f"reference: {self.reference}"]

    def _details_html(self) -> str:
        def percent(part: float) -> str:
            return f"{round(100 * part):+d} %"

        rows = [
            [e.candidate, str(e.count), percent(e.median), f"{percent(e.low)} to {percent(e.high)}", f"{100 * e.within_25_percent:.0f} %"]
            for e in self.errors()
        ]
        head = ["model", "cases", "median error", "10th-90th percentile", "within 25 %"]
        return table_html(head, rows, f"reference: {self.reference}") + table_html([""], [[words] for words in self.findings])


def benchmark(
    *,
    reference: Path | None = None,
    paper_case: Path | None = None,
    compute: bool = False,
    cells: int | None = None,
    budget: float | None = None,
    design: str | None = None,
    out: Path | None = None,
    progress: Progress | bool | None = None,
) -> Benchmark:
    """Compares every model that gives depths with the axisymmetric reference, model ``axi``.

    Flat rods on thick targets, at speeds from 150 to 1500 m/s and L/D 1 to 10, of seven pairs of materials. The reference is stored in the
    program; the models are run again, which takes seconds.

    Parameters
    ----------
    reference : path, optional
        CSV file of reference depths, instead of those of the program.
    paper_case : path, optional
        CSV file of reference results for the case of the seed paper, instead of those of the program.
    compute : bool
        Whether to compute the cases that these two files lack, which takes hours. Ctrl-C keeps completed cases, and the same call continues.
    cells : int, optional
        Cells along the projectile's radius, for ``compute`` with ``reference``; 8 when not given.
    budget : float, optional
        Longest time of a case on one core [s], for ``compute`` with ``reference``.
    design : str, optional
        ``"grid"`` when not given, or ``"spread"``: other pairs of materials, L/D 1 to 20, 100 to 2500 m/s.
    out : path, optional
        Folder for the report with its figures, and the numbers, as ``percuss benchmark --out`` writes them; made if it does not exist.
    progress : callable or bool, optional
        As in :func:`percuss.run`.

    Returns
    -------
    Benchmark
        The same numbers, to the last bit, as ``percuss benchmark --json`` prints. :meth:`Benchmark.errors` replaces its option ``--by``.

    Raises
    ------
    ReadError
        When a file cannot be read.
    UsageError
        When there is no reference that passes its convergence check, or ``compute`` has no file to write to.

    Examples
    --------
    >>> percuss.benchmark().findings[0]  # doctest: +SKIP
    '92 cases have a reference that passes its convergence check on three meshes; the uncertainty of 81 is at most 10 %.'
    """
    found = execute(
        "benchmark",
        reference=reference,
        paper_case=paper_case,
        compute=compute,
        cells=cells,
        budget=budget,
        design=design,
        out=out,
        progress=progress,
    )
    return Benchmark(found)
