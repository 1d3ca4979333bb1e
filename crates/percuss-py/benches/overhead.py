"""What a call of the package costs beyond the solver, which takes its own time.

    python crates/percuss-py/benches/overhead.py
"""

from __future__ import annotations

import statistics
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import percuss

ROOT = Path(__file__).resolve().parents[3]
CALLS = 500


def beyond(call: Callable[[], percuss.RunResult]) -> tuple[float, float]:
    """Shortest and median time of a call beyond the solver [us]."""
    call()
    times = []
    for _ in range(CALLS):
        start = time.perf_counter()
        result = call()
        elapsed = time.perf_counter() - start
        times.append(1e6 * (elapsed - result._native.solver_seconds()))
    return min(times), statistics.median(times)


def main() -> None:
    case = percuss.load(ROOT / "cases/taylor-copper-wilkins/scenario.toml")

    def plain() -> percuss.RunResult:
        return percuss.run(case, "wilkins_guinan", history=False)

    def without_bar() -> percuss.RunResult:
        return percuss.run(case, "wilkins_guinan", history=False, progress=False)

    def with_numbers() -> percuss.RunResult:
        result = plain()
        assert result.projectile_final_length_mm
        return result

    for name, call in [("run", plain), ("run, no progress", without_bar), ("run and read its numbers", with_numbers)]:
        shortest, median = beyond(call)
        print(f"{name:26}{shortest:6.1f} us at best, {median:6.1f} us median beyond the solver")
    with tempfile.TemporaryDirectory() as folder:
        start = time.perf_counter()
        percuss.sweep(ROOT / "cases/paper-table1/sweep.toml", Path(folder, "rows"))
        print(f"sweep of the paper's case, all threads: {132 / (time.perf_counter() - start):.0f} shots/s")


if __name__ == "__main__":
    main()
