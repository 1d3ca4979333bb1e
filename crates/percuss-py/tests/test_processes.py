"""Commands with threads in processes that were forked, spawned or started by a server of them."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest
from conftest import ROOT

SCRIPT = """
import multiprocessing, sys
import percuss

def depths(speed):
    case = percuss.load("cases/paper-table1/scenario.toml").replace({"projectile.impact_velocity": f"{speed} m/s"})
    compared = percuss.compare(case, model=["chain", "taylor"], fast=True).to_dict()
    axisymmetric = percuss.run(case.replace({"axi.max_steps": 20, "axi.cells_per_radius": 2}), "axi").to_dict()
    for of_run in (compared, axisymmetric):
        of_run.pop("solver_time_s", None)
    return repr(compared), axisymmetric["depth_of_penetration_mm"]

if __name__ == "__main__":
    # The pool of threads is there before the fork.
    own = [depths(230), depths(400)]
    with multiprocessing.get_context(sys.argv[1]).Pool(2) as pool:
        others = pool.map_async(depths, [230, 400]).get(timeout=100)
    assert own == others, (own, others)
    print("equal")
"""


@pytest.mark.parametrize("method", ["fork", "spawn", "forkserver"])
def test_other_processes_give_the_same_numbers(method: str, tmp_path: object) -> None:
    script = f"{tmp_path}/script.py"
    with open(script, "w", encoding="utf-8") as file:
        file.write(SCRIPT)
    done = subprocess.run([sys.executable, script, method], capture_output=True, text=True, timeout=300, cwd=ROOT)
    assert done.stdout == "equal\n", done.stderr


EXECUTOR = """
from concurrent.futures import ProcessPoolExecutor
import percuss

def depth(case):
    return percuss.run(case).depth_of_penetration_mm

if __name__ == "__main__":
    case = percuss.load("cases/paper-table1/scenario.toml")
    cases = [case.replace({"projectile.impact_velocity": f"{speed} m/s"}) for speed in (200, 230, 400)]
    with ProcessPoolExecutor(2) as pool:
        depths = list(pool.map(depth, cases))
    assert depths == [depth(case) for case in cases], depths
    print("equal")
"""


def test_an_executor_of_processes_gives_the_same_numbers(tmp_path: object) -> None:
    script = f"{tmp_path}/script.py"
    with open(script, "w", encoding="utf-8") as file:
        file.write(EXECUTOR)
    done = subprocess.run([sys.executable, script], capture_output=True, text=True, timeout=300, cwd=ROOT)
    assert done.stdout == "equal\n", done.stderr


CRAMPED = """
import resource
import percuss

resource.setrlimit(resource.RLIMIT_AS, (1 << 30, 1 << 30))
case = percuss.load("cases/paper-table1/scenario.toml")
for command in (percuss.run, percuss.compare):
    try:
        command(case)
    except percuss.PercussError as error:
        assert "cannot start the threads" in str(error), error
    else:
        raise SystemExit("no error")
print("refused")
"""


@pytest.mark.skipif(sys.platform != "linux", reason="needs limits of Linux")
def test_threads_that_cannot_be_started_are_an_error() -> None:
    environment = {**os.environ, "RAYON_NUM_THREADS": "1000"}
    command = [sys.executable, "-c", CRAMPED]
    done = subprocess.run(command, capture_output=True, text=True, timeout=100, cwd=ROOT, env=environment)
    assert done.stdout == "refused\n", done.stderr
