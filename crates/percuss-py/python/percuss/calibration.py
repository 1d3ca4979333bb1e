"""Calibration of material constants and model options against experiments."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from numbers import Real
from pathlib import Path as FilePath
from typing import TYPE_CHECKING, Any, TypeAlias

from . import _percuss, study_plots
from .command_line import CaseLike, Path, execute, formats, several
from .errors import UsageError
from .progress import Progress
from .record import Record, Result, digits, shown, symbol, table_html
from .samples import Sample

if TYPE_CHECKING:
    from matplotlib.axes import Axes

#: Prior of a parameter: a range such as ``"20..300 MPa"``, its ends, or a distribution as in a file.
Prior: TypeAlias = str | tuple[float, float] | Mapping[str, Any]

# Name of the virtual file of priors on the command line.
_PRIORS = "fit.toml"


class Calibration(Result):
    """Calibrated parameters with their uncertainty: the values of ``percuss calibrate --json``, and the sample.

    One row per parameter; ``sample.to_pandas()`` has one row per state of the posterior.

    Attributes
    ----------
    model : str
        Name of the model.
    runs : int
        Number of runs.
    correction : Record or None
        Correction to axisymmetric answers: ``reference``, ``rounds``, ``answers``, the last relative ``difference``, ``converged``.
    parameters : list of Record
        Calibrated parameters: ``key``, ``unit``, ``prior`` (2.5, 50 and 97.5 %), ``best`` with its ``standard_error``, and the ``posterior`` with
        ``mean``, ``standard_deviation``, ``quantiles`` (2.5, 50 and 97.5 %), ``r_hat``, ``bulk_effective_size`` and ``tail_effective_size``. Values are in
        the unit.
    scatter : Record
        Relative scatter of measured values about the model: ``best``, ``estimated``, ``posterior``.
    correlations : list of list of float
        Correlations of the parameters, in their order.
    findings : list of Record
        Parameters that the data do not identify, in ``words``.
    training, hold_out : Record or None
        Errors on the fitted and the held-out values, None without any: ``count``, ``rms_before``, ``rms``, ``bias``
        (relative errors) and the number ``inside`` their 95 % intervals.
    predictions : list of Record
        Measured and predicted values, in ``unit``; ``axisymmetric`` is the answer of a correction with its uncertainty.
    curves : list of Record
        Measured curves: number of ``values``, ``effective_values`` and ``correlation_time_us``; ``before`` and ``best`` with
        ``rms_difference``, ``relative_rms_difference`` and ``largest_difference``; the fraction ``inside`` the 95 % intervals; ``points`` with lists
        ``time_us``, ``measured``, ``before``, ``best`` and the ends of ``model_band`` and ``predictive_band``, in ``unit``.
    left_out : list of Record
        Values and curves that were not used, with the reason.
    materials : Record
        Calibrated materials by id, in the form of ``materials`` of a case.
    warnings : list of str
        Warnings.
    """

    percuss_version: str
    model: str
    seed: int
    runs: int
    correction: Record | None
    parameters: list[Record]
    scatter: Record
    correlations: list[list[float]]
    findings: list[Record]
    training: Record | None
    hold_out: Record | None
    sampling: Record | None
    warnings: list[str]
    predictions: list[Record]
    curves: list[Record]
    left_out: list[Record]
    materials: Record

    _native: _percuss.Response

    @property
    def sample(self) -> Sample:
        """States of the posterior: ``ensemble``, ``step``, ``walker``, one column per parameter in its unit, and the ``scatter``.

        Raises
        ------
        ValueError
            When the posterior was not sampled (``least_squares=True``).
        """
        if self.sampling is None:
            raise ValueError("the posterior was not sampled: leave out least_squares")
        return Sample(self._native)

    def parameter(self, name: str | None = None) -> Record:
        """A parameter by its key or the end of it, such as ``power_law.coefficient``; the first when not given."""
        found = [p for p in self.parameters if name in (None, p.key) or p.key.endswith(f".{name}")]
        if not found or (name is not None and len(found) > 1):
            raise KeyError(f"`{name}` names no single parameter; parameters: {', '.join(p.key for p in self.parameters)}")
        return found[0]

    def save_materials(self, path: str | os.PathLike[str]) -> None:
        """Writes the calibrated materials to a file, which ``material_files`` of a case takes."""
        text = _percuss.toml_text(self._data["materials"])
        FilePath(path).write_text(text, encoding="utf-8")


    def _rows(self) -> list[dict[str, Any]]:
        rows = []
        for parameter in self._data["parameters"]:
            row = {name: parameter[name] for name in ("key", "unit", "best", "standard_error")}
            row |= _ends("prior", parameter["prior"])
            posterior = dict(parameter["posterior"] or {})
            row |= _ends("posterior", posterior.pop("quantiles", None))
            rows.append(row | {name: posterior.get(name) for name in ("r_hat", "bulk_effective_size", "tail_effective_size")})
        return rows

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws the relative error of every measured value before and after calibration, with 95 % predictive intervals [%]."""
        return study_plots.predictions(self, ax)

    def plot_curve(self, curve: int = 0, ax: Axes | None = None) -> Axes:
        """Draws a measured curve, by its place in ``curves``, with the model before and after calibration and its 95 % predictive interval."""
        return study_plots.calibrated_curve(self, curve, ax)

    def plot_posterior(self, parameter: str | None = None, ax: Axes | None = None) -> Axes:
        """Draws the posterior and the prior of a parameter; of the first when not named."""
        return study_plots.posterior(self, parameter, ax)

    def plot_pair(self, x: str, y: str, ax: Axes | None = None) -> Axes:
        """Draws the joint posterior of two parameters."""
        return study_plots.pair(self, x, y, ax)

    def _headline(self) -> list[str]:
        fitted = [f"{p.key} = {digits(p.best)} {symbol(p.unit)}".strip() for p in self.parameters]
        return [*fitted, f"model {self.model}, {self._quality()}"]

    def _quality(self) -> str:
        parts = []
        if self.training is not None:
            parts.append(f"RMS error {100 * self.training.rms:.2g} % of {self.training.count} values")
        for curve in self.curves:
            if curve.best is not None and curve.best.relative_rms_difference is not None:
                parts.append(f"relative RMS difference {100 * curve.best.relative_rms_difference:.2g} % of curve {curve.name}")
        return ", ".join(parts)

    def _details_html(self) -> str:
        rows = [[shown(value) for value in row.values()] for row in self._rows()]
        notes = [finding.words for finding in self.findings] + self.warnings
        rows += [["note", note] for note in notes]
        return table_html(list(self._rows()[0]), rows, f"calibration, model {self.model}, {self._quality()}")


def _ends(name: str, quantiles: list[float] | None) -> dict[str, float | None]:
    low, middle, high = quantiles or (None, None, None)
    return {f"{name}_2.5": low, f"{name}_50": middle, f"{name}_97.5": high}


def calibrate(
    cases: CaseLike | Sequence[CaseLike] | None = None,
    *,
    fit: str | Path | Sequence[str | Path] | Mapping[str, Prior],
    data: Path | Sequence[Path] | None = None,
    materials: Path | Sequence[Path] | None = None,
    kind: str | Sequence[str] | None = None,
    source: str | Sequence[str] | None = None,
    hold_out: str | Sequence[str] | None = None,
    model: str | None = None,
    reference: str | None = None,
    noise: str | float | None = None,
    least_squares: bool = False,
    ensembles: int | None = None,
    walkers: int | None = None,
    steps: int | None = None,
    seed: int | None = None,
    name: str | None = None,
    out: Path | None = None,
    figures: str | Sequence[str] | None = None,
    figure_width: str | None = None,
    progress: Progress | bool | None = None,
) -> Calibration:
    """Calibrates material constants and model options against experiments.

    Parameters
    ----------
    cases : Case, path or sequence of them, optional
        Cases with ``experiments`` or ``measured_curves``; optional when ``data`` is given.
    fit : mapping, str, path or sequence of them
        Parameters to fit. A mapping from keys such as ``"chain.constraint_factor"`` to their priors: the range of a uniform prior with its
        unit such as ``"20..300 MPa"``, its ends as plain numbers, or a distribution such as
        ``{"normal": {"mean": "90 MPa", "standard_deviation": "20 MPa"}}``. Otherwise values of ``--fit``.
    data : path or sequence of paths, optional
        CSV files of tests; ``"builtin"`` selects those of the program.
    materials : path or sequence of paths, optional
        Files of materials for the tests, in addition to the library.
    kind, source : str or sequence of str, optional
        Kinds of tests and sources to use; all when not given.
    hold_out : str or sequence of str, optional
        Sources that are not fitted and test the result.
    model : str, optional
        Model to calibrate; ``chain`` when not given.
    reference : {"standard", "fine"}, optional
        Corrects the model to axisymmetric answers on 3, 4 and 6 or 6, 8 and 12 cells, at the best values.
    noise : str or float, optional
        Relative scatter of measured values about the model: ``"estimated"`` (the default), ``"stated"`` for the stated uncertainties alone, or
        a fraction such as ``"2 %"`` or 0.02.
    least_squares : bool
        Least squares only, without a sample of the posterior.
    ensembles, walkers, steps : int, optional
        Sampling of the posterior; by default 4 ensembles, four walkers per parameter (at least 12) and 600 steps.
    seed : int, optional
        Seed of the random numbers; 0 when not given.
    name : str, optional
        Id of the calibrated material; the original id with ``-calibrated`` when not given.
    out : path, optional
        Folder for the numbers, the calibrated materials and the figures, as ``percuss calibrate --out`` writes them; made if it does not exist.
    figures : str or sequence of str, optional
        Formats of the figures in ``out``: ``svg``, ``png`` and ``pdf``, or ``"none"``; SVG and PNG when not given.
    figure_width : str, optional
        Width of the figures in print, 60 mm to 182 mm; ``"88 mm"`` fits a column of a journal. 182 mm when not given.
    progress : callable or bool, optional
        As in :func:`percuss.run`.

    Returns
    -------
    Calibration
        The same numbers, to the last bit, as ``percuss calibrate --json`` prints.

    Raises
    ------
    CaseError, MaterialError
        When a case, the data or a parameter is not valid; the message has the place.
    UsageError
        When no measured value is left, or the model fails everywhere.

    Examples
    --------
    >>> found = percuss.calibrate(
    ...     data="builtin",
    ...     source="wilkins1973",
    ...     model="wilkins_guinan",
    ...     fit={"materials.copper-woodward.strength.power_law.coefficient": "150..900 MPa"},
    ...     least_squares=True,
    ... )
    >>> found.parameters[0].unit, found.training.count
    ('MPa', 6)
    """
    lines, texts = _fitted(fit)
    found = execute(
        "calibrate",
        of=cases,
        texts=texts,
        fit=lines,
        data=several(data),
        materials=several(materials),
        kind=several(kind),
        source=several(source),
        hold_out=several(hold_out),
        model=model,
        reference=reference,
        noise=f"{100 * noise!r} %" if isinstance(noise, Real) else noise,
        least_squares=least_squares,
        ensembles=ensembles,
        walkers=walkers,
        steps=steps,
        seed=seed,
        name=name,
        out=out,
        figures=formats(figures),
        figure_width=figure_width,
        progress=progress,
    )
    return Calibration(found)


def _fitted(fit: Any) -> tuple[list[Any], dict[str, str]]:
    """Values of --fit, and the text of the file of priors that they name."""
    if not isinstance(fit, Mapping):
        return several(fit), {}
    lines: list[Any] = []
    tables: list[dict[str, Any]] = []
    for key, prior in fit.items():
        if isinstance(prior, str):
            lines.append(f"{key}={prior}")
        elif isinstance(prior, Mapping):
            tables.append({"key": key, **prior})
        elif isinstance(prior, Sequence) and len(prior) == 2:
            lines.append(f"{key}={'..'.join(repr(float(end)) for end in prior)}")
        else:
            raise UsageError(f"`{key}`: {prior!r} is not a prior; give a range such as \"20..300 MPa\", two numbers, or a distribution")
    if not tables:
        return lines, {}
    return [*lines, _PRIORS], {_PRIORS: _percuss.toml_text({"parameter": tables})}
