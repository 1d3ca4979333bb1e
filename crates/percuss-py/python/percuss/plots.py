"""Figures on matplotlib axes; matplotlib is imported on first use."""

from __future__ import annotations

import math

from typing import TYPE_CHECKING, Any

from . import _percuss
from .optional import library

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .results import Comparison, Convergence, Limits, RunResult, Validation
    from .sweeps import SweepResult

def label(name: str) -> str:
    """Label of a column: its name with the unit in parentheses.

    Examples
    --------
    >>> label("depth_mm"), label("residual_velocity_m_s"), label("strain")
    ('Depth (mm)', 'Residual velocity (m/s)', 'Strain')
    """
    for end, unit in _percuss.units():
        if name.endswith(end):
            return f"{_title(name.removesuffix(end))} ({unit})"
    return _title(name)


def _title(name: str) -> str:
    """Words of a name with a capital first letter."""
    words = name.replace("_", " ")
    return words[:1].upper() + words[1:]


def new_axes(ax: Axes | None, size: tuple[float, float] | None = None) -> Axes:
    """Given axes, or new axes of a size [in]."""
    if ax is not None:
        return ax
    figure = library("matplotlib.pyplot").subplots(layout="constrained", figsize=size)
    axes: Axes = figure[1]
    return axes


def plain_logarithmic(ax: Axes) -> None:
    """Makes the horizontal axis logarithmic with plain numbers."""
    ax.set_xscale("log")
    ax.xaxis.set_major_formatter("{x:g}")
    ax.xaxis.set_minor_formatter("{x:g}")


def history(result: RunResult, what: str, ax: Axes | None, **style: Any) -> Axes:
    history = result.history
    ax = new_axes(ax)
    style.setdefault("label", result.model)
    ax.plot(history.time_us, history[what], **style)
    ax.set(xlabel="Time (us)", ylabel=label(what), title=result.case)
    return ax


def stress(result: RunResult, ax: Axes | None) -> Axes:
    import numpy

    ax = new_axes(ax)
    profiles = result.history.profiles
    every = numpy.concatenate([p.stress_mpa for p in profiles])
    # The largest stresses are in a few elements at the contact; the scale is that of the waves.
    top = float(numpy.percentile(numpy.abs(every), 99.5)) or 1.0
    drawn: Any = None
    # One plot per body: nothing is drawn across a gap.
    for part in numpy.unique(numpy.concatenate([p.part for p in profiles])):
        rows = [(p, p.part == part) for p in profiles]
        counts = {int(chosen.sum()) for _, chosen in rows}
        position = [p.position_mm[chosen] for p, chosen in rows]
        value = [p.stress_mpa[chosen] for p, chosen in rows]
        time = [numpy.full(len(at), p.time_us) for at, (p, _) in zip(position, rows, strict=True)]
        style: dict[str, Any] = {"cmap": "RdBu_r", "vmin": -top, "vmax": top}
        if len(counts) == 1 and min(counts) > 1:
            drawn = ax.pcolormesh(numpy.array(position), numpy.array(time), numpy.array(value), shading="nearest", rasterized=True, **style)
        else:
            # A changing number of elements gives no grid.
            x, y, c = (numpy.concatenate(values) for values in (position, time, value))
            drawn = ax.scatter(x, y, c=c, s=4, marker="s", linewidths=0, **style)
    ax.figure.colorbar(drawn, ax=ax, label="Axial stress, compression positive (MPa)", extend="both")
    ax.set(xlabel="Position, impact face at 0 (mm)", ylabel="Time (us)", title=result.case)
    return ax


def comparison(comparison: Comparison, ax: Axes | None) -> Axes:
    ax = new_axes(ax)
    quantity = comparison.quantities[0]
    words = label(quantity)
    chosen = {choice.model for at in comparison.recommended for choice in at.models}
    given = [r for r in comparison.results if r[quantity] is not None]
    names = list(dict.fromkeys(r.model for r in given))
    measured = [e for e in comparison.experiments if e.quantity == quantity]
    title = f"{comparison.case} (★ recommended)"
    if len(comparison.regime) == 1:
        values = [r[quantity] for r in given]
        colours = ["C0" if r.model in chosen else "0.7" for r in given]
        ax.barh([f"{r.model} ★" if r.model in chosen else r.model for r in given], values, color=colours)
        ax.invert_yaxis()
        speed = comparison.regime[0].impact_velocity_m_s
        for experiment in measured:
            if experiment.impact_velocity_m_s in (None, speed):
                ax.axvline(experiment.value, color="C3", label="experiment")
        ax.set(xlabel=words, title=title)
        return ax
    for name in names:
        points = [(r.impact_velocity_m_s, r[quantity]) for r in given if r.model == name]
        star = " ★" if name in chosen else ""
        ax.plot(*zip(*points, strict=True), label=name + star, linewidth=2 if star else 1)
    tests = [(e.impact_velocity_m_s, e.value) for e in measured if e.impact_velocity_m_s is not None]
    if tests:
        ax.plot(*zip(*tests, strict=True), "k+", label="experiment")
    ax.set(xlabel="Impact velocity (m/s)", ylabel=words, title=title)
    ax.legend()
    return ax


def limits(limits: Limits, ax: Axes | None) -> Axes:
    if "results" not in limits:
        raise ValueError("no case was searched: `plot_v50` draws the tests")
    ax = new_axes(ax)
    for model in limits.results:
        given = model.ballistic_limit_m_s is None
        if given and (model.outcome != "input" or not model.curve):
            continue
        limit = model.input_limit.ballistic_limit_m_s if given else model.ballistic_limit_m_s
        points = [(limit, 0.0)]
        points += [(p.impact_velocity_m_s, p.residual_velocity_m_s) for p in model.curve or []]
        label = f"{model.model}, {'input limit ' if given else ''}{limit:.4g} m/s"
        ax.plot(*zip(*points, strict=True), label=label, linestyle="--" if given else "-", marker=None if given else ".")
    if limits.axisymmetric is not None and limits.axisymmetric.ballistic_limit_m_s is not None:
        value, half = limits.axisymmetric.ballistic_limit_m_s, limits.axisymmetric.uncertainty_m_s
        ax.axvspan(value - half, value + half, color="0.85", label=f"axisymmetric, {value:.4g} ± {half:.2g} m/s")
    for experiment in limits.experiments:
        if experiment.quantity == "ballistic_limit_m_s":
            ax.axvline(experiment.value, color="k", linestyle="--", label=f"measured, {experiment.value:.4g} m/s")
    ax.set(xlabel="Impact velocity (m/s)", ylabel="Residual velocity (m/s)", title=limits.case)
    if ax.lines:
        ax.legend()
    return ax


def v50(limits: Limits, ax: Axes | None) -> Axes:
    import numpy

    if limits.v50 is None or limits.tests is None:
        raise ValueError("no test results were given: `tests` names a file of them")
    ax = new_axes(ax)
    speeds = [test.impact_velocity_m_s for test in limits.tests]
    margin = 0.15 * (max(speeds) - min(speeds))
    at = numpy.linspace(min(speeds) - margin, max(speeds) + margin, 200)
    for estimate in limits.v50.estimates:
        value, deviation = estimate.v50_m_s, estimate.standard_deviation_m_s
        if value is None or not deviation:
            continue
        probabilities = [_probability(estimate.method, (speed - value) / deviation) for speed in at]
        (line,) = ax.plot(at, probabilities, label=f"{estimate.method}: {value:.4g} m/s")
        if estimate.low_m_s is not None and estimate.high_m_s is not None:
            ax.hlines(0.5, estimate.low_m_s, estimate.high_m_s, color=line.get_color(), alpha=0.4, linewidth=5)
    for perforated, colour, words in ((True, "C3", "complete penetration"), (False, "C2", "partial penetration")):
        chosen = [test.impact_velocity_m_s for test in limits.tests if test.perforated is perforated]
        ax.plot(chosen, [float(perforated)] * len(chosen), "o", color=colour, mfc="none", label=words)
    level = f"{100 * limits.v50.confidence:g} %"
    ax.set(xlabel="Impact velocity (m/s)", ylabel="Probability of perforation", title=f"V50 of {len(speeds)} tests, {level} intervals")
    ax.legend()
    return ax


def _probability(method: str, standardised: float) -> float:
    """Probability of perforation at a number of standard deviations above V50."""
    if method == "logit":
        return 1 / (1 + math.exp(-standardised * math.pi / math.sqrt(3)))
    return 0.5 * math.erfc(-standardised / math.sqrt(2))


def convergence(study: Convergence, quantity: str | None, ax: Axes | None) -> Axes:
    ax = new_axes(ax)
    chosen = next(q for q in study.quantities if quantity in (None, q.name))
    cells = ["cells_per_radius" in mesh for mesh in study.meshes]
    elements = [mesh.cells_per_radius if all(cells) else mesh.projectile_elements + mesh.target_elements for mesh in study.meshes]
    name = chosen.name.replace("_", " ")
    ax.plot(elements, chosen.values, marker="o", label=name)
    if "richardson" in chosen.status:
        ax.axhline(chosen.status.richardson, color="0.5", linestyle="--", label="Richardson extrapolation")
    ax.set_xscale("log")
    ax.set_xticks(elements, [str(count) for count in elements])
    ax.set_xticks([], minor=True)
    ax.set(xlabel="Cells per radius" if all(cells) else "Elements", ylabel=f"{_title(name)} ({chosen.unit})")
    ax.legend()
    return ax


def validation(validation: Validation, ax: Axes | None) -> Axes:
    ax = new_axes(ax)
    counted = [p for p in validation.predictions if p.standing == "counted" and p.predicted is not None]
    units = sorted({p.unit for p in counted})
    for name in dict.fromkeys(p.model for p in counted):
        points = [(p.measured, p.predicted / p.measured) for p in counted if p.model == name and p.measured]
        ax.plot(*zip(*points, strict=True), ".", label=name)
    ax.axhline(1.0, color="k", linewidth=1)
    plain_logarithmic(ax)
    ax.set(xlabel=f"Measured ({', '.join(units)})", ylabel="Predicted / measured")
    ax.legend()
    return ax


def sweep(sweep: SweepResult, x: str, y: str, colour: str | None, ax: Axes | None) -> Axes:
    ax = new_axes(ax)
    rows = sweep.to_pandas()
    # Names of inputs are keys of the case with the unit of the user: they are not changed.
    if colour is None:
        ax.plot(rows[x], rows[y], ".")
    else:
        dots = ax.scatter(rows[x], rows[y], c=rows[colour], s=8)
        ax.figure.colorbar(dots, ax=ax, label=colour)
    ax.set(xlabel=x, ylabel=y, title=sweep.manifest.title or sweep.manifest.case)
    return ax
