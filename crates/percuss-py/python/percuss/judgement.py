"""Judgement: every model that gives depths against the axisymmetric reference."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from . import report_plots
from .ask import Path, native_answer
from .errors import UsageError
from .progress import Progress
from .record import Record, Records, Result, table_html

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# What ``--by`` of the command takes, and what the groups are called in its JSON.
_GROUPINGS = {"speed": "speed", "length": "length", "regime": "regime", "materials": "pair", "uncertainty": "reference"}


class Judgement(Result):
    """Models against the axisymmetric reference: the values of ``percuss judge --json``. A row a model and shot.

    Errors are relative: depth over reference depth, less one.

    Attributes
    ----------
    reference : str
        What the reference comes from.
    failures : list of str
        Shots whose reference was to be computed and failed, and why.
    refused : list of Record
        Shots left out of all numbers because their reference fails its convergence check: materials, ``length_to_diameter``,
        ``impact_velocity_m_s`` and ``reason``.
    findings : list of str
        What it comes to, in words.
    statistics : list of Record
        Errors by group: ``candidate`` (a model, with its closure where it has several), ``grouping``, ``value``, ``count``, ``median``,
        ``low`` and ``high``, between which eight of ten errors lie, ``median_absolute`` and ``within_25_percent``.
    ablation : list of Record
        The seed paper's case with one thing changed at a time: ``variant``, ``change``, ``depth_of_penetration_mm``, ``error``.
    verdicts : list of Record
        Every depth beside the reference: ``depth_of_penetration_mm``, ``reference_depth_mm`` and ``reference_uncertainty_mm``.
    """

    percuss_version: str
    reference: str
    failures: list[str]
    refused: list[Record]
    findings: list[str]
    statistics: list[Record]
    ablation: list[Record]
    verdicts: list[Record]

    def _rows(self) -> list[dict[str, Any]]:
        return list(self._data["verdicts"])

    def errors(self, by: str | None = None) -> Records[Record]:
        """Errors of every model, of all shots or by ``speed``, ``length``, ``regime``, ``materials`` or ``uncertainty`` of the reference."""
        if by is not None and by not in _GROUPINGS:
            raise UsageError(f"`{by}` groups no errors; groups: {', '.join(_GROUPINGS)}")
        grouping = "all" if by is None else _GROUPINGS[by]
        names = ["candidate", "value", "count", "median", "low", "high", "median_absolute", "within_25_percent"]
        return Records((group for group in self.statistics if group.grouping == grouping), *names)

    def plot(self, by: str | None = None, ax: Axes | None = None) -> Axes:
        """Draws the errors of every model: median and the range of eight of ten, or median magnitudes by what ``errors`` takes."""
        return report_plots.errors(self, by, ax)

    def _repr_html_(self) -> str:
        def percent(part: float) -> str:
            return f"{round(100 * part):+d} %"

        rows = [
            [e.candidate, str(e.count), percent(e.median), f"{percent(e.low)} to {percent(e.high)}", f"{100 * e.within_25_percent:.0f} %"]
            for e in self.errors()
        ]
        head = ["model", "shots", "median error", "eight of ten", "within 25 %"]
        return table_html(head, rows, f"reference: {self.reference}") + table_html([""], [[words] for words in self.findings])


def judge(
    *,
    reference: Path | None = None,
    study: Path | None = None,
    compute: bool = False,
    cells: int | None = None,
    out: Path | None = None,
    progress: Progress | bool | None = None,
) -> Judgement:
    """Judges every model that gives depths by the axisymmetric reference, model ``axi``.

    Flat rods on thick targets, at speeds from 150 to 1500 m/s and L/D 1 to 10, of seven pairs of materials. The reference is stored in the
    program; the models are run anew, which takes seconds.

    Parameters
    ----------
    reference : path, optional
        CSV file of reference depths in place of the program's own.
    study : path, optional
        CSV file of the seed paper's case by the reference in place of the program's own.
    compute : bool
        Whether to compute first what these two files lack, and append it: hours. Ctrl-C keeps what is done, and the same call goes on.
    cells : int, optional
        Cells along the projectile's radius, for ``compute`` with ``reference``; 8 when not given.
    out : path, optional
        Folder for the report with its figures, and the numbers, as ``percuss judge --out`` writes them; made if it does not exist.
    progress : callable or bool, optional
        As of :func:`percuss.run`.

    Returns
    -------
    Judgement
        The same numbers, to the last bit, as ``percuss judge --json`` prints. :meth:`Judgement.errors` stands for its option ``--by``.

    Raises
    ------
    ReadError
        When a file cannot be read.
    UsageError
        When there is no reference that passes its convergence check, or ``compute`` has no file to write to.

    Examples
    --------
    >>> percuss.judge().findings[0]  # doctest: +SKIP
    '71 shots have a reference that passes its convergence check on three meshes: 65 are known within 10 %.'
    """
    return Judgement(native_answer("judge", reference=reference, study=study, compute=compute, cells=cells, out=out, progress=progress))
