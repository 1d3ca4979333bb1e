"""Figures of benchmarks and reproductions on matplotlib axes."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING

from .plots import new_axes

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from .benchmarks import Benchmark
    from .reproduction import Reproduction

#: Largest drawn error [%].
_EDGE = 200.0


def errors(benchmark: Benchmark, by: str | None, ax: Axes | None) -> Axes:
    best_first = [e.candidate for e in sorted(benchmark.errors(), key=lambda e: float(e.median_absolute))]
    ax = new_axes(ax, (8.0, 5.0 if by is None else 6.0))
    if by is not None:
        return _absolute_errors(benchmark, by, best_first, ax)
    of = {e.candidate: e for e in benchmark.errors()}
    for place, name in enumerate(best_first):
        error = of[name]
        ax.plot([100 * error.low, min(100 * error.high, _EDGE)], [place, place], color="C0", alpha=0.4, linewidth=5, solid_capstyle="butt")
        ax.plot(min(100 * error.median, _EDGE), place, "o", color="C0")
    ax.axvline(0, color="k", linewidth=1)
    ax.set_yticks(range(len(best_first)), [f"{name} ({of[name].count})" for name in best_first], fontsize="small")
    ax.invert_yaxis()
    ax.set(
        xlabel="Relative error of the depth (%)",
        xlim=(-105, _EDGE + 5),
        title="Median and 10th-90th percentile of the error",
    )
    return ax


def _absolute_errors(benchmark: Benchmark, by: str, candidates: list[str], ax: Axes) -> Axes:
    import numpy

    groups = benchmark.errors(by)
    values = list(dict.fromkeys(group.value for group in groups))
    grid = numpy.full((len(candidates), len(values)), numpy.nan)
    for group in groups:
        grid[candidates.index(group.candidate), values.index(group.value)] = 100 * group.median_absolute
    drawn = ax.imshow(grid, cmap="viridis_r", vmin=0, vmax=100, aspect="auto")
    for (row, column), value in numpy.ndenumerate(grid):
        if not numpy.isnan(value):
            ax.text(column, row, f"{value:.0f}", ha="center", va="center", color="w" if value > 50 else "k", fontsize="small")
    ax.figure.colorbar(drawn, ax=ax, label="Median absolute error (%)", extend="max")
    lines = [value.replace(" on ", "\non ") for value in values]
    ax.set_xticks(range(len(values)), lines, rotation=40, ha="right", rotation_mode="anchor", fontsize="small")
    ax.set_yticks(range(len(candidates)), candidates, fontsize="small")
    ax.set_title(f"Median absolute error by {by}")
    return ax


def assessments(found: Reproduction, ax: Axes | None) -> Axes:
    ax = new_axes(ax)
    count = Counter(item.assessment.replace("_", " ") for item in found.items)
    names = [name for name, _ in count.most_common()]
    ax.bar_label(ax.barh(names, [count[name] for name in names]), padding=3)
    ax.margins(x=0.1)
    ax.invert_yaxis()
    ax.set(xlabel="Statements", title="Seed paper, item by item")
    return ax


def codes(found: Reproduction, ax: Axes | None) -> Axes:
    ax = new_axes(ax)
    names = [f"{run.code}, {run.case}, {run.quantity}" for run in found.runs]
    ax.plot([run.found_percent for run in found.runs], range(len(names)), "s")
    ax.set_yticks(range(len(names)), names, fontsize="x-small")
    ax.invert_yaxis()
    ax.set(xlabel="Difference of percuss (%)", title="percuss and other codes", xscale="symlog")
    return ax


def damping(found: Reproduction, ax: Axes | None) -> Axes:
    ax = new_axes(ax)
    # The mesh of all velocities.
    meshes = Counter(run.projectile_elements for run in found.runs)
    ((mesh, _),) = meshes.most_common(1)
    for way in dict.fromkeys(run.damping for run in found.runs):
        runs = [run for run in found.runs if run.damping == way and run.projectile_elements == mesh]
        runs.sort(key=lambda run: float(run.impact_velocity_m_s))
        ax.plot([s.impact_velocity_m_s for s in runs], [s.depth_of_penetration_mm for s in runs], marker=".", label=way)
    reference = [(at.impact_velocity_m_s, at.depth_of_penetration_mm) for at in found.reference]
    ax.plot(*zip(*reference, strict=True), "k*", label="axisymmetric reference")
    ax.set(xlabel="Impact velocity (m/s)", ylabel="Depth of penetration (mm)", yscale="log", title=f"Damping, {mesh} elements")
    ax.legend(fontsize="small")
    return ax
