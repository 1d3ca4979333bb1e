"""Long computations let other threads run, end on Ctrl-C, and say how far they are."""

from __future__ import annotations

import subprocess
import sys
import threading
import time
from pathlib import Path

import percuss
import pytest
from conftest import ROOT

# Each takes minutes when nobody stops it.
LONG = {
    "run": "percuss.run(case, 'axi')",
    "compare": "percuss.compare(case, model='axi', velocity=[300, 400, 500, 600])",
    "sweep": "percuss.sweep({'base': case, 'model': 'chain', 'design': 'sobol', 'samples': 100000, 'parameter': [{'key':"
    " 'projectile.impact_velocity', 'uniform': {'from': '150 m/s', 'to': '400 m/s'}}]}, sys.argv[1])",
    "uncertainty": "percuss.uncertainty('cases/paper-table1-uncertainty/scenario.toml', samples=1048576)",
    "run with its folder": "percuss.run(case, 'axi', out=sys.argv[1])",
    "benchmark": "percuss.benchmark(compute=True, paper_case=sys.argv[1] + '.csv')",
    "reproduce": "percuss.reproduce('damping')",
    "calibrate": "percuss.calibrate(data='builtin', source='wilkins1973', model='wilkins_guinan', steps=1000000,"
    " fit={'materials.copper-woodward.strength.power_law.coefficient': '150..900 MPa'})",
}

# A shell that starts the tests in the background lets them ignore Ctrl-C.
SCRIPT = """
import signal, sys, percuss
signal.signal(signal.SIGINT, signal.default_int_handler)
case = percuss.load("cases/paper-table1/scenario.toml").replace({{"axi.cells_per_radius": 24}})
print("started", flush=True)
try:
    {}
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""


@pytest.mark.parametrize("what", LONG)
def test_ctrl_c_ends_it(what: str, tmp_path: Path) -> None:
    import signal

    line = [sys.executable, "-c", SCRIPT.format(LONG[what]), str(tmp_path / "rows")]
    with subprocess.Popen(line, stdout=subprocess.PIPE, text=True, cwd=ROOT) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "started\n"
        time.sleep(1.0)
        process.send_signal(signal.SIGINT)
        start = time.monotonic()
        try:
            output, _ = process.communicate(timeout=60)
        finally:
            process.kill()
        assert output == "interrupted\n"
        assert time.monotonic() - start < 20
    if what == "run with its folder":
        assert (tmp_path / "rows/checkpoint.percuss").is_file()


def test_progress_is_heard_and_can_end_a_run() -> None:
    class Enough(Exception):
        pass

    heard: list[tuple[float, str]] = []

    def hear(fraction: float, words: str) -> None:
        heard.append((fraction, words))
        if len(heard) == 3:
            raise Enough

    case = percuss.load("cases/paper-table1/scenario.toml").replace({"axi.cells_per_radius": 24})
    with pytest.raises(Enough):
        percuss.run(case, "axi", progress=hear)
    assert len(heard) == 3 and all(0.0 <= fraction <= 1.0 and "us" in words for fraction, words in heard)


def test_other_threads_run_meanwhile() -> None:
    stop, counted = threading.Event(), 0

    def hear(_fraction: float, _words: str) -> None:
        if counted > 3:
            raise InterruptedError

    def count() -> None:
        nonlocal counted
        while not stop.wait(0.02):
            counted += 1

    thread = threading.Thread(target=count)
    thread.start()
    case = percuss.load("cases/paper-table1/scenario.toml").replace({"axi.cells_per_radius": 24})
    try:
        with pytest.raises(InterruptedError):
            percuss.run(case, "axi", progress=hear)
    finally:
        stop.set()
        thread.join()
    assert counted > 3
