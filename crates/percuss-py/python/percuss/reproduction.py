"""Published works, worked through."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from . import report_plots
from .ask import Path, native_answer
from .progress import Progress
from .record import Record, Result, table_html

if TYPE_CHECKING:
    from matplotlib.axes import Axes


class Reproduction(Result):
    """A published work and what holds of it: the values of ``percuss reproduce --json``.

    A row a statement of the paper, or a shot of the study of damping.

    Attributes
    ----------
    work : str
        ``paper`` or ``damping``.
    items : list of Record
        Of the paper, its statements: ``place``, ``statement``, ``verdict`` (``reproduced``, ``reading_dependent``, ``contradicted`` or
        ``cannot_be_known``) and the ``finding`` with its numbers.
    tables : list of Record
        Of the paper, the numbers behind them: ``title``, ``columns``, ``rows``.
    findings : list of str
        Of damping, what it does, in words.
    shots : list of Record
        Of damping, every shot: way of ``damping``, ``impact_velocity_m_s``, ``projectile_elements``, ``depth_of_penetration_mm``, its relative
        ``change``, and the parts of the energy that were damped and eroded.
    reference : list of Record
        Of damping, the depths by the axisymmetric reference.
    """

    percuss_version: str
    work: str

    def _rows(self) -> list[dict[str, Any]]:
        return list(self._data["items" if self.work == "paper" else "shots"])

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws how many statements of the paper came to which verdict; of damping, depth against impact speed by way of damping."""
        return report_plots.verdicts(self, ax) if self.work == "paper" else report_plots.damping(self, ax)

    def _repr_html_(self) -> str:
        if self.work == "damping":
            return table_html([""], [[words] for words in self.findings], "damping in the seed paper's case")
        names = ["place", "statement", "verdict", "finding"]
        rows = [[item[name].replace("_", " ") if name == "verdict" else item[name] for name in names] for item in self.items]
        return table_html(names, rows, "the seed paper, item by item")


def reproduce(work: str, *, out: Path | None = None, progress: Progress | bool | None = None) -> Reproduction:
    """Works through a publication item by item and says what holds.

    Parameters
    ----------
    work : str
        ``paper``, the seed paper: copper rods on thick 2024-T351 by a 1-D discrete element model; or ``damping``, what damping does to the
        depth in its case, which it suspected of its mismatch at high speed.
    out : path, optional
        Folder for the page, its figures and tables, as ``percuss reproduce --out`` writes them; made if it does not exist.
    progress : callable or bool, optional
        As of :func:`percuss.run`.

    Returns
    -------
    Reproduction
        What became of every statement, with numbers.

    Raises
    ------
    UsageError
        When no work has the name.
    NumericalError
        When a run fails.

    Examples
    --------
    >>> found = percuss.reproduce("paper")
    >>> [item.verdict for item in found.items].count("reproduced") > 0
    True
    """
    return Reproduction(native_answer("reproduce", work, out=out, progress=progress))
