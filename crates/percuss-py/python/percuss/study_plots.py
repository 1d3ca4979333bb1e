"""Figures of uncertainties and calibrations on axes of matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .plots import label, new_axes

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .calibration import Calibration
    from .record import Record
    from .spread import Uncertainty

#: Largest number of named values in a figure.
_NAMED = 45


def percentile(statistics: Record, percent: float) -> float:
    """Returns a percentile of statistics."""
    for at in statistics.percentiles:
        if at.percent == percent:
            return float(at.value)
    given = ", ".join(f"{at.percent:g}" for at in statistics.percentiles)
    raise ValueError(f"there is no percentile {percent:g}; percentiles: {given}")


def short(key: str) -> str:
    """Key without its middle parts.

    Examples
    --------
    >>> short("materials.rod.strength.power_law.coefficient"), short("projectile.impact_velocity")
    ('materials.rod … coefficient', 'projectile.impact_velocity')
    """
    parts = key.split(".")
    return key if len(parts) < 4 else f"{parts[0]}.{parts[1]} … {parts[-1]}"


def histogram(found: Uncertainty, quantity: str | None, ax: Axes | None) -> Axes:
    import numpy

    ax = new_axes(ax)
    of = found.quantity(quantity)
    words = label(of.quantity)
    values = found.draws[of.quantity]
    ax.hist(values[~numpy.isnan(values)], bins="auto", color="0.8", edgecolor="white")
    statistics = of.statistics
    marks = [
        ("5th percentile", percentile(statistics, 5), "C0", ":"),
        ("mean", statistics.mean, "C0", "-"),
        ("95th percentile", percentile(statistics, 95), "C0", ":"),
    ]
    if of.nominal is not None:
        marks.append(("at median inputs", of.nominal, "C3", "--"))
    for name, value, colour, style in marks:
        ax.axvline(value, color=colour, linestyle=style, label=f"{name}: {value:.4g}")
    # Room for the legend above the bars.
    ax.set(xlabel=words, ylabel="Runs", title=f"{found.case}, model {found.model}", ylim=(0, 1.5 * ax.get_ylim()[1]))
    ax.legend(fontsize="small")
    return ax


def tornado(found: Uncertainty, quantity: str | None, ax: Axes | None) -> Axes:
    ax = new_axes(ax)
    of = found.quantity(quantity)
    words = label(of.quantity)
    middle = percentile(of.statistics, 50) if of.nominal is None else of.nominal
    names = [short(bar.key) for bar in of.tornado]
    for end, colour in (("at_low", "C0"), ("at_high", "C1")):
        ends = [middle if bar[end] is None else bar[end] for bar in of.tornado]
        part = "5th" if end == "at_low" else "95th"
        ax.barh(names, [value - middle for value in ends], left=middle, color=colour, label=f"parameter at its {part} percentile")
    ax.axvline(middle, color="k", linewidth=1)
    # The longest bar at the top, room for the legend below.
    ax.set(xlabel=words, title=found.case, ylim=(len(names) + 0.3, -0.6))
    ax.legend(fontsize="small", loc="lower right")
    return ax


def indices(found: Uncertainty, quantity: str | None, ax: Axes | None) -> Axes:
    of = found.quantity(quantity)
    if of.indices is None:
        raise ValueError(f"there are no Sobol' indices of `{of.quantity}`: {of.no_indices or found.no_indices}")
    ax = new_axes(ax)
    rows = sorted(of.indices.parameters, key=lambda index: float(index.total.value))
    for lane, name in ((0.2, "first_order"), (-0.2, "total")):
        estimates = [row[name] for row in rows]
        values = [estimate.value for estimate in estimates]
        beyond = [[e.value - e.low for e in estimates], [e.high - e.value for e in estimates]]
        places = [place + lane for place in range(len(rows))]
        words = "first-order index" if name == "first_order" else "total-effect index"
        ax.barh(places, values, height=0.38, xerr=beyond, label=words, error_kw={"linewidth": 1})
    ax.set_yticks(range(len(rows)), [short(row.key) for row in rows])
    words = label(of.quantity)
    ax.set(xlabel="Fraction of variance", title=f"{found.case}: {words}")
    ax.legend()
    return ax


def bands(found: Uncertainty, quantity: str | None, ax: Axes | None) -> Axes:
    name = found.quantity(quantity).quantity
    words = label(name)
    at = [(band.impact_velocity_m_s, q.statistics) for band in found.bands for q in band.quantities if q.quantity == name]
    given = [(speed, statistics) for speed, statistics in at if statistics is not None]
    if not given:
        raise ValueError("the study has no bands: give it a `velocity`")
    ax = new_axes(ax)
    speed = [speed for speed, _ in given]
    line = {percent: [percentile(s, percent) for _, s in given] for percent in (5, 25, 50, 75, 95)}
    ax.fill_between(speed, line[5], line[95], color="C0", alpha=0.2, linewidth=0, label="5th-95th percentile")
    ax.fill_between(speed, line[25], line[75], color="C0", alpha=0.35, linewidth=0, label="25th-75th percentile")
    ax.plot(speed, line[50], color="C0", label="median")
    ax.set(xlabel="Impact velocity (m/s)", ylabel=words, title=found.case)
    ax.legend()
    return ax


def perforation(found: Uncertainty, ax: Axes | None) -> Axes:
    decided = [(band.impact_velocity_m_s, band.perforation) for band in found.bands if band.perforation is not None]
    if not decided:
        raise ValueError("the study has no probabilities versus velocity: give it a `velocity`")
    ax = new_axes(ax)
    speed = [speed for speed, _ in decided]
    low, high = [100 * p.low for _, p in decided], [100 * p.high for _, p in decided]
    ax.fill_between(speed, low, high, alpha=0.25, linewidth=0, label="95 % interval of the finite sample")
    ax.plot(speed, [100 * p.probability for _, p in decided], label=f"model {found.model}")
    ax.set(xlabel="Impact velocity (m/s)", ylabel="Probability of perforation (%)", title=found.case)
    ax.legend()
    return ax


def predictions(found: Calibration, ax: Axes | None) -> Axes:
    ax = new_axes(ax)
    given = [p for p in found.predictions if p.best is not None]

    def error(prediction: Record, value: float) -> float:
        # A residual velocity may be 0: its error is relative to the impact velocity.
        scale = prediction.impact_velocity_m_s if prediction.unit == "m/s" else prediction.measured
        return float(100 * (value - prediction.measured) / scale)

    for held_out, colour, words in ((False, "C0", "fitted"), (True, "C1", "held out")):
        rows = [(place, p) for place, p in enumerate(given) if p.held_out is held_out]
        if not rows:
            continue
        places = [place for place, _ in rows]
        banded = [(place, p) for place, p in rows if p.predictive_band is not None]
        low, high = ([error(p, p.predictive_band[end]) for _, p in banded] for end in (0, 1))
        ax.hlines([place for place, _ in banded], low, high, color=colour, alpha=0.3, linewidth=5)
        before = [(place, error(p, p.before)) for place, p in rows if p.before is not None]
        if before:
            ax.plot([e for _, e in before], [place for place, _ in before], "o", color="0.6", mfc="none", ms=4)
        ax.plot([error(p, p.best) for _, p in rows], places, "o", color=colour, ms=4, label=f"{words}: best fit")
    ax.plot([], [], "o", color="0.6", mfc="none", ms=4, label="before calibration")
    if any(p.predictive_band is not None for p in given):
        ax.plot([], [], color="0.7", linewidth=5, label="95 % predictive interval")
    ax.axvline(0, color="k", linewidth=1)
    if len(given) <= _NAMED:
        ax.set_yticks(range(len(given)), [p.id for p in given], fontsize="small")
    else:
        ax.set_yticks([])
    # From the top, with room for the legend below.
    ax.set(xlabel="Predicted / measured − 1 (%)", title=f"model {found.model}", ylim=(1.2 * len(given), -0.6))
    ax.legend(fontsize="small", loc="lower right", ncols=2)
    return ax


def calibrated_curve(found: Calibration, curve: int, ax: Axes | None) -> Axes:
    ax = new_axes(ax)
    of = found.curves[curve]
    points = of.points
    if points.before is not None:
        ax.plot(points.time_us, points.before, color="0.55", label="before calibration")
    if points.predictive_band is not None:
        low, high = points.predictive_band
        ax.fill_between(points.time_us, low, high, color="C0", alpha=0.2, linewidth=0, label="95 % predictive interval")
    if points.best is not None:
        ax.plot(points.time_us, points.best, color="C0", label="calibrated")
    ax.plot(points.time_us, points.measured, "k--", label=f"measured ({of.name})")
    words = of.quantity.replace("_", " ").capitalize()
    ax.set(xlabel="Time (µs)", ylabel=f"{words} ({of.unit})" if of.unit else words, title=f"model {found.model}")
    ax.legend(fontsize="small")
    return ax


def _column(found: Calibration, key: str) -> str:
    """Column of the sample with the values of a key: after those of the ensemble, the step and the walker, in the order of the parameters."""
    if key == "scatter":
        return key
    return found.sample.names()[3 + [parameter.key for parameter in found.parameters].index(key)]


def _axis(found: Calibration, name: str | None) -> tuple[str, str, float]:
    """Key of a parameter, words for an axis, and the best value."""
    if name == "scatter":
        return "scatter", "Relative scatter", float(found.scatter.best)
    parameter = found.parameter(name)
    words = parameter.key.rsplit(".", 1)[-1].replace("_", " ")
    return parameter.key, f"{words} ({parameter.unit})" if parameter.unit else words, float(parameter.best)


def posterior(found: Calibration, name: str | None, ax: Axes | None) -> Axes:
    key, words, best = _axis(found, name)
    values = found.sample[_column(found, key)]
    ax = new_axes(ax)
    ax.hist(values, bins="auto", density=True, color="0.8", edgecolor="white", label="posterior")
    if key != "scatter":
        shown = ax.get_xlim()
        low, _, high = found.parameter(key).prior
        ax.axvspan(low, high, color="C2", alpha=0.12, zorder=0, label=f"prior, 95 %: {low:.4g} to {high:.4g}")
        # A much wider prior does not widen the axis.
        ax.set_xlim(shown)
    ax.axvline(best, color="C0", label=f"best: {best:.4g}")
    ax.set(xlabel=words, ylabel="Probability density", title=f"model {found.model}")
    ax.legend()
    return ax


def pair(found: Calibration, x: str, y: str, ax: Axes | None) -> Axes:
    (x_key, x_words, x_best), (y_key, y_words, y_best) = _axis(found, x), _axis(found, y)
    sample = found.sample
    ax = new_axes(ax)
    ax.hist2d(sample[_column(found, x_key)], sample[_column(found, y_key)], bins=60, cmap="Blues", cmin=1)
    ax.plot([x_best], [y_best], "+", color="C3", ms=12, mew=2, label="best")
    ax.set(xlabel=x_words, ylabel=y_words, title=f"model {found.model}")
    ax.legend()
    return ax
