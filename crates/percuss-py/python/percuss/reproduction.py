"""Reproduction of published works."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from . import report_plots
from .command_line import Path, execute
from .progress import Progress
from .record import Record, Result, table_html

if TYPE_CHECKING:
    from matplotlib.axes import Axes


class Reproduction(Result):
    """Reproduction of a published work: the values of ``percuss reproduce --json``.

    One row per statement of the paper, per run of the damping study, or per number of another code.

    Attributes
    ----------
    work : str
        ``paper``, ``damping`` or ``codes``.
    items : list of Record
        Of the paper, its statements: ``place``, ``statement``, ``assessment`` (``reproduced``, ``reading_dependent``, ``contradicted`` or
        ``cannot_be_known``) and the ``finding`` with its numbers.
    tables : list of Record
        Of the paper, the numbers behind them: ``title``, ``columns``, ``rows``.
    findings : list of str
        Of the damping study and of the comparison with other codes, the findings.
    runs : list of Record
        Of the damping study, every run: way of ``damping``, ``impact_velocity_m_s``, ``projectile_elements``, ``depth_of_penetration_mm``, its relative
        ``change``, and the fractions of damped and eroded energy. Of the comparison with other codes, every stored number of a ``code``: its ``case``,
        ``quantity``, ``value`` and ``unit``, the value of ``percuss`` by ``model`` and ``mesh``, and the difference ``found_percent``.
    reference : list of Record
        Of the damping study, the depths by the axisymmetric reference.
    dimension : Record
        Of the comparison with other codes, Taylor ``rods`` of several diameters in two dimensions and ``lines`` in one.
    """

    percuss_version: str
    work: str

    def _rows(self) -> list[dict[str, Any]]:
        return list(self._data["items" if self.work == "paper" else "runs"])

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws the number of statements per assessment; of the damping study, depth versus impact velocity by way of damping; of the comparison
        with other codes, the differences."""
        draw = {"paper": report_plots.assessments, "damping": report_plots.damping, "codes": report_plots.codes}
        return draw[self.work](self, ax)

    def _headline(self) -> list[str]:
        if self.work != "paper":
            return self.findings[:1] or [self.work]
        assessed = [item.assessment.replace("_", " ") for item in self.items]
        counted = (f"{assessed.count(word)} {word}" for word in dict.fromkeys(assessed))
        return [f"the seed paper, {len(assessed)} statements: {', '.join(counted)}"]

    def _details_html(self) -> str:
        titles = {"damping": "damping in the case of the seed paper", "codes": "comparison with other codes"}
        if self.work in titles:
            return table_html([""], [[words] for words in self.findings], titles[self.work])
        names = ["place", "statement", "assessment", "finding"]
        rows = [[item[name].replace("_", " ") if name == "assessment" else item[name] for name in names] for item in self.items]
        return table_html(names, rows, "the seed paper, item by item")


def reproduce(work: str, *, out: Path | None = None, progress: Progress | bool | None = None) -> Reproduction:
    """Reproduces a publication item by item.

    Parameters
    ----------
    work : str
        ``paper``, the seed paper: copper rods on thick 2024-T351 by a 1-D discrete element model; or ``damping``, the effect of
        damping on the depth of penetration in its case; or ``codes``, the comparison with stored results of other codes.
    out : path, optional
        Folder for the page, its figures and tables, as ``percuss reproduce --out`` writes them; made if it does not exist.
    progress : callable or bool, optional
        As in :func:`percuss.run`.

    Returns
    -------
    Reproduction
        Assessment of every statement, with numbers.

    Raises
    ------
    UsageError
        When the work is unknown.
    NumericalError
        When a run fails.

    Examples
    --------
    >>> found = percuss.reproduce("paper")
    >>> [item.assessment for item in found.items].count("reproduced") > 0
    True
    """
    return Reproduction(execute("reproduce", work, out=out, progress=progress))
