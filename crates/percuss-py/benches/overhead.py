"""What a call of the package costs beyond the solver, which takes its own time.

    python crates/percuss-py/benches/overhead.py

PERCUSS_PROGRAM names the program that sweeps are compared with, one of the same profile as the package; the wheel's own command when it is not set.
"""

from __future__ import annotations

import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import percuss

ROOT = Path(__file__).resolve().parents[3]
CALLS = 500
ALTERNATIONS = 5


def beyond(call: Callable[[], percuss.RunResult]) -> tuple[float, float]:
    """Shortest and median time of a call beyond the solver [us]."""
    call()
    times = []
    for _ in range(CALLS):
        start = time.perf_counter()
        result = call()
        elapsed = time.perf_counter() - start
        solver = result._native.solver_seconds()
        assert solver is not None
        times.append(1e6 * (elapsed - solver))
    return min(times), statistics.median(times)


def processor_time(*line: str | Path) -> float:
    """Processor time of a command [s]."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(line, check=True, stdout=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def sweep_ratio() -> float:
    """Processor time of a sweep in Python over that of the same sweep by the program, in alternation; another load does not change it."""
    sweep = ROOT / "cases/paper-table1/sweep.toml"
    program = os.environ.get("PERCUSS_PROGRAM") or Path(sys.executable).with_name("percuss")
    times: dict[str, list[float]] = {"program": [], "python": [], "start": []}
    with tempfile.TemporaryDirectory() as folder:
        for i in range(ALTERNATIONS):
            times["program"].append(processor_time(program, "sweep", sweep, "--out", Path(folder, f"program-{i}"), "--quiet"))
            words = "import sys, percuss; percuss.sweep(sys.argv[1], sys.argv[2])"
            times["python"].append(processor_time(sys.executable, "-c", words, sweep, Path(folder, f"python-{i}")))
            times["start"].append(processor_time(sys.executable, "-c", "import percuss"))
    median = {name: statistics.median(values) for name, values in times.items()}
    return (median["python"] - median["start"]) / median["program"]


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
    print(f"sweep: {sweep_ratio():.2f} times the processor time of the program, Python's own start apart")


if __name__ == "__main__":
    main()
