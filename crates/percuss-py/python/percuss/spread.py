"""Propagation of uncertain input parameters to the results of a case."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

from . import _percuss, laws, study_plots
from .command_line import CaseLike, Path, Speed, execute, formats, several, speeds
from .errors import UsageError
from .laws import StrengthLaw
from .progress import Progress
from .record import Record, Result, in_words, shown, table_html
from .samples import Sample

if TYPE_CHECKING:
    from matplotlib.axes import Axes


class Uncertainty(Result):
    """Statistics and sensitivities of the results: the values of ``percuss uncertainty --json``, and the sample.

    One row per quantity; ``draws.to_pandas()`` has one row per run.

    The spread is due to the inputs. It does not include the model error; ``nominal.expected_error`` is an estimate of it where one exists.

    Attributes
    ----------
    case, model : str
        Names of the case and the model.
    samples, runs : int
        Number of samples, and number of all runs.
    inputs : list of Record
        Uncertain parameters: ``key``, ``unit``, ``distribution``, and the percentiles 5, 50 and 95 as ``low``, ``median`` and ``high``.
    correlated : bool
        Whether they are correlated.
    nominal : Record
        Run with every parameter at its median: ``outcome``, ``expected_error``, ``warnings``.
    failures : Record
        Number of ``runs`` without a result, which are left out, and the first few ``reasons``.
    perforation : Record or None
        ``probability`` of perforation with ``low`` and ``high``, the ends of its 95 % interval.
    axisymmetric : Record or None
        Mean and spread corrected by axisymmetric runs: ``mean`` with ``standard_error``, ``standard_deviation``, percentiles, ``points``.
    quantities : list of Record
        Analysis of each result: ``statistics`` with ``percentiles``, ``tornado``, and the Sobol' ``indices``.
    no_indices : str or None
        Reason of missing Sobol' indices.
    bands : list of Record
        The same statistics at each requested impact velocity ``impact_velocity_m_s`` [m/s].
    warnings : list of str
        Warnings.
    """

    case: str
    percuss_version: str
    model: str
    samples: int
    seed: int
    runs: int
    inputs: list[Record]
    correlated: bool
    nominal: Record
    failures: Record
    perforation: Record | None
    axisymmetric: Record | None
    quantities: list[Record]
    no_indices: str | None
    bands: list[Record]
    warnings: list[str]

    _native: _percuss.Response

    @property
    def draws(self) -> Sample:
        """Runs of the sample: inputs in the units of the case, and results."""
        return Sample(self._native)

    def quantity(self, name: str | None = None) -> Record:
        """Returns the analysis of a result by its name, such as ``depth_of_penetration_mm``; of the first when not given."""
        for quantity in self.quantities:
            if name in (None, quantity.quantity):
                return quantity
        raise KeyError(f"there is no quantity `{name}`; quantities: {', '.join(q.quantity for q in self.quantities)}")

    def percentile(self, percent: float, name: str | None = None) -> float:
        """Returns a percentile: 1, 5, 25, 50, 75, 95 or 99."""
        return study_plots.percentile(self.quantity(name).statistics, percent)


    def _rows(self) -> list[dict[str, Any]]:
        rows = []
        for quantity in self._data["quantities"]:
            statistics = dict(quantity["statistics"])
            percentiles = {f"p{at['percent']:02.0f}": at["value"] for at in statistics.pop("percentiles")}
            rows.append({"quantity": quantity["quantity"], "nominal": quantity["nominal"], **statistics, **percentiles})
        return rows

    def plot(self, quantity: str | None = None, ax: Axes | None = None) -> Axes:
        """Draws the histogram of a quantity; of the first when not named."""
        return study_plots.histogram(self, quantity, ax)

    def plot_tornado(self, quantity: str | None = None, ax: Axes | None = None) -> Axes:
        """Draws the tornado chart of a quantity: each parameter at its 5th and 95th percentile, all others at their medians."""
        return study_plots.tornado(self, quantity, ax)

    def plot_indices(self, quantity: str | None = None, ax: Axes | None = None) -> Axes:
        """Draws the first-order and total-effect Sobol' indices of a quantity."""
        return study_plots.indices(self, quantity, ax)

    def plot_bands(self, quantity: str | None = None, ax: Axes | None = None) -> Axes:
        """Draws median and percentile bands of a quantity versus impact velocity [m/s]; the study needs a ``velocity``."""
        return study_plots.bands(self, quantity, ax)

    def plot_perforation(self, ax: Axes | None = None) -> Axes:
        """Draws the probability of perforation [%] versus impact velocity [m/s]; the study needs a ``velocity``."""
        return study_plots.perforation(self, ax)

    def _headline(self) -> list[str]:
        words = []
        for row in self._rows()[:2]:
            low, middle, high = (in_words(row["quantity"], row[name]) for name in ("p05", "p50", "p95"))
            words.append(f"{middle} (5 to 95 %: {low.split()[-2]} to {' '.join(high.split()[-2:])})")
        if self.perforation is not None:
            words.append(f"probability of perforation {100 * self.perforation.probability:.3g} %")
        return [*words, f"case {self.case}, model {self.model}, {self.samples} samples"]

    def _details_html(self) -> str:
        rows = [[name, *(shown(row[name]) for row in self._rows())] for name in (self._rows() or [{}])[0] if name != "quantity"]
        if self.perforation is not None:
            rows.append(["probability of perforation [%]", shown(100 * self.perforation.probability)])
        rows += [["warning", warning] for warning in self.warnings]
        return table_html(
            ["", *(quantity.quantity for quantity in self.quantities)], rows, f"{self.case}, model {self.model}, {self.samples} runs"
        )


def uncertainty(
    case: CaseLike,
    *,
    model: str | None = None,
    samples: int | None = None,
    seed: int | None = None,
    quantity: str | Sequence[str] | None = None,
    velocity: Speed | Iterable[float] | None = None,
    no_indices: bool = False,
    axisymmetric: int | None = None,
    threads: int | None = None,
    out: Path | None = None,
    figures: str | Sequence[str] | None = None,
    figure_width: str | None = None,
    progress: Progress | bool | None = None,
    projectile_law: StrengthLaw | None = None,
    target_law: StrengthLaw | None = None,
) -> Uncertainty:
    """Says what the uncertainty of a case's numbers does to its results.

    Parameters
    ----------
    case : Case or path
        A case with a table ``uncertainty``, or its file.
    model : str, optional
        Name of the model; ``chain`` when not given.
    samples : int, optional
        Runs that the statistics rest on, a power of two at best; 1024 when not given. The indices of d parameters take
        ``samples * (d + 1) / 2`` more, at least ``16 * (d + 1)``.
    seed : int, optional
        Seed of the random numbers; 0 when not given.
    quantity : str or sequence of str, optional
        Results to look at, such as ``peak_force_kn``; the main ones that vary when not given.
    velocity : float, sequence of float or str, optional
        Impact speeds of bands [m/s], or what ``--velocity`` takes, such as ``"150..400:6"``; no bands when not given.
    no_indices : bool
        Whether to leave out the Sobol' indices, which take most of the runs.
    axisymmetric : int, optional
        Number of samples that the axisymmetric model runs on to correct mean and spread, 4 to 256.
    threads : int, optional
        Threads; as many as there are cores when not given. The numbers do not depend on it.
    out : path, optional
        Folder for a copy of the case, the numbers and the figures, as ``percuss uncertainty --out`` writes them; made if it does not exist.
    figures : str or sequence of str, optional
        Formats of the figures in ``out``: ``svg``, ``png`` and ``pdf``, or ``"none"``; SVG and PNG when not given.
    figure_width : str, optional
        Width of the figures in print, 60 mm to 182 mm; ``"88 mm"`` fits a column of a journal. 182 mm when not given.
    progress : callable or bool, optional
        As in :func:`percuss.run`.
    projectile_law, target_law : callable, optional
        Strength laws in Python, as in :func:`percuss.run`, for every run. An exception in a law ends the study. Not with ``out`` and
        ``axisymmetric``.

    Returns
    -------
    Uncertainty
        The same numbers, to the last bit, as ``percuss uncertainty --json`` prints.

    Raises
    ------
    CaseError
        When the case has no uncertain parameters, or one that cannot vary.
    NotApplicableError
        When the model does not apply with every number at its median.
    UsageError
        When a quantity is asked for that no run has, or no run has a result.

    Examples
    --------
    >>> spread = percuss.uncertainty("cases/paper-table1-uncertainty/scenario.toml", samples=16, no_indices=True)
    >>> [quantity.quantity for quantity in spread.quantities]
    ['depth_of_penetration_mm', 'projectile_final_length_mm']
    >>> len(spread.draws)
    16
    """
    own = laws.name(projectile_law, target_law)
    if own and (out is not None or axisymmetric is not None):
        raise UsageError("`out` and `axisymmetric` need laws of the library: leave them out, or add the law to the library")
    found = execute(
        "uncertainty",
        of=case,
        model=model,
        samples=samples,
        seed=seed,
        quantity=several(quantity),
        velocity=speeds(velocity),
        no_indices=no_indices,
        axisymmetric=axisymmetric,
        threads=threads,
        out=out,
        figures=formats(figures),
        figure_width=figure_width,
        progress=progress,
        laws=(projectile_law, target_law, own),
    )
    return Uncertainty(found)
