"""The table."""

import csv
import statistics
from collections.abc import Callable
from pathlib import Path

import measure
import work
from measure import RUNS, SWEEPS, Checked, Timing, Work
from prepare import BATCH, BATCH_ON_TWO, CAVITIES, ONE_CAVITY, ONE_LINEAR, ONE_POWER

COLUMNS = [
    (ONE_POWER, "one chain, power law"),
    (ONE_LINEAR, "one chain, linear"),
    (BATCH, "batch, power law"),
    (BATCH_ON_TWO, "batch, two cores"),
]
RUN_COLUMNS = [(ONE_CAVITY, "one by one"), (CAVITIES, "sweep or batch")]
Results = dict[tuple[str, Work], list[Timing]]


def number(rate: float) -> str:
    return f"{rate:.2f}" if rate < 1 else f"{rate:.1f}" if rate < 30 else f"{rate:.0f}"


def cell(results: Results, name: str, kind: Work) -> str:
    timings = results.get((name, kind))
    if not timings:
        return "-"
    rates = [t.rate for t in timings]
    middle, lowest, highest = statistics.median(rates), min(rates), max(rates)
    return f"{number(middle)} ({number(lowest)} to {number(highest)}) x{measure.ratio(results, name, kind):.2f}"


def run_cell(results: Results, name: str, kind: Work) -> str:
    timings = results.get((name, kind))
    if not timings:
        return "-"
    costs = [1e3 / t.rate for t in timings]
    ratios = measure.ratios(results, name, kind)
    middle, each = statistics.median(costs), 1e3 * statistics.median(t.each for t in timings)
    spread = f"{min(costs):.2f} to {max(costs):.2f}"
    return f"{middle:.2f} ({spread}) {each:.2f} ms x{statistics.median(ratios):.2f} ({min(ratios):.2f} to {max(ratios):.2f})"


def rows_of(checked: list[Checked], columns: list[tuple[Work, str]], results: Results, one_cell: Callable) -> list[list[str]]:
    """A line a program that knows some of the work, under the titles; nothing where none does."""
    kinds = [kind for kind, _ in columns]
    off = {}
    for c in checked:
        if c.work in kinds:
            off[c.program.name] = max(off.get(c.program.name, 0.0), c.difference)
    rows = [["", *(title for _, title in columns), "off by"]]
    rows += [[name, *(one_cell(results, name, kind) for kind in kinds), f"{difference:.0e}"] for name, difference in off.items()]
    return rows if off else []


def aligned(rows: list[list[str]]) -> list[str]:
    widths = [max(len(row[i]) for row in rows if row) for i in range(len(rows[0]))]
    lines = ["  ".join(word.ljust(width) for word, width in zip(row, widths)).rstrip() for row in rows]
    lines.insert(1, "-" * max(map(len, lines)))
    return lines


def text(checked: list[Checked], results: Results, skipped: dict[str, str], rounds: int) -> str:
    lines = []
    if rows := rows_of(checked, COLUMNS, results, cell):
        rows.append([])
        for name in (RUNS, SWEEPS):
            rows.append([name, *(cell(results, name, kind) for kind, _ in COLUMNS), ""])
        lines += aligned(rows)
        lines += [
            "",
            f"Million elements times steps a second: median (range) of {rounds} rounds, and the ratio to percuss of the same rounds.",
            "One core: of processor time. Two cores: by the clock. Off by: largest difference of an end from percuss's, as a part of the largest displacement.",
            "The two last rows are percuss's full runs of the same case (large strain, contact, border shear, energy balance; powers only where material flows).",
            "",
        ]
    if rows := rows_of(checked, RUN_COLUMNS, results, run_cell):
        lines += aligned(rows)
        lines += [
            "",
            f"Complete runs of the default model, {work.SLOWEST_M_S:g} to {work.FASTEST_M_S:g} m/s: ns of processor time an element and step, median (range)",
            f"of {rounds} rounds; ms a run; speed over percuss's in the same rounds (range). Off by: largest difference of depth, velocity, time to rest or steps",
            "from percuss's, as a part of each.",
            "",
        ]
    busy = [t.share for timings in results.values() for t in timings]
    if statistics.median(busy) < 0.9:
        lines.append(f"Others used this machine: programs had {statistics.median(busy):.0%} of their cores. Figures by the clock do not count.")
    lines += [f"skipped: {name}: {why}" for name, why in skipped.items()]
    lines += [
        f"not timed: {c.program.name}, {measure.words_of(c.work)}: off by {c.difference:.1e}, more than {c.program.tolerance:g}"
        for c in checked
        if not c.agrees
    ]
    return "\n".join(lines)


def write(path: Path, checked: list[Checked], results: Results) -> None:
    """The table as CSV, a row a program and kind of work."""
    off = {(c.program.name, c.work): c.difference for c in checked}
    with path.open("w", encoding="utf-8", newline="") as file:
        rows = csv.writer(file)
        rows.writerow(
            "program,chains,law,cores,clock,rounds,median,lowest,highest,ratio_to_percuss,share_of_cores,difference".split(",")
        )
        for (name, kind), timings in results.items():
            rates = [t.rate for t in timings]
            together, law, cores = kind
            figures = (statistics.median(rates), min(rates), max(rates), measure.ratio(results, name, kind))
            shares = statistics.median(t.share for t in timings)
            clock = "processor" if cores == 1 else "wall"
            difference = f"{off[name, kind]:.2e}" if (name, kind) in off else ""
            rows.writerow(
                [name, together, law, cores, clock, len(timings), *(f"{x:.4g}" for x in figures), f"{shares:.2f}", difference]
            )
