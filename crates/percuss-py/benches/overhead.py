"""What a call of the package costs beyond the solver, measured on models that answer at once.

    python crates/percuss-py/benches/overhead.py

A run by a formula is mostly overhead; the model's own time is that of the same run in a sweep of many shots on one thread.
"""

from __future__ import annotations

import tempfile
import time
from pathlib import Path

import percuss

ROOT = Path(__file__).resolve().parents[3]
REPEATS = 2000


def best(call: object, repeats: int = REPEATS) -> float:
    """Shortest mean time of a call over five rounds [us]."""
    assert callable(call)
    rounds = []
    for _ in range(5):
        start = time.perf_counter()
        for _ in range(repeats):
            call()
        rounds.append((time.perf_counter() - start) / repeats * 1e6)
    return min(rounds)


def main() -> None:
    case = percuss.load(ROOT / "cases/paper-table1/scenario.toml").replace({"projectile.velocity": 1500.0})
    print(f"{'model':18}{'run [us]':>12}{'and read [us]':>15}{'and its numbers [us]':>22}")
    for model in ("hydrodynamic", "lanz_odermatt", "tate"):
        try:
            percuss.run(case, model)
        except percuss.NotApplicableError as error:
            print(f"{model:18}{error.reason}")
            continue
        plain = best(lambda: percuss.run(case, model, history=False))  # noqa: B023
        no_bar = best(lambda: percuss.run(case, model, history=False, progress=False))  # noqa: B023
        read = best(lambda: percuss.run(case, model, history=False).depth_of_penetration_mm)  # noqa: B023
        print(f"{model:18}{no_bar:>12.1f}{plain:>15.1f}{read:>22.1f}")
    with tempfile.TemporaryDirectory() as folder:
        for threads in (1, None):
            start = time.perf_counter()
            percuss.sweep(ROOT / "cases/paper-table1/sweep.toml", Path(folder, str(threads)), threads=threads)
            seconds = time.perf_counter() - start
            print(f"sweep of the paper's case, {threads or 'all'} threads: {132 / seconds:.0f} shots/s")


if __name__ == "__main__":
    main()
