"""Reading the chains and writing where they end, for the programs in Python."""

import sys
import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Problem:
    """The columns are one number a spring."""

    rod: int
    steps: int
    time_step: float
    mass: np.ndarray
    length: np.ndarray
    stiffness: np.ndarray
    coefficient: np.ndarray
    exponent: np.ndarray
    speeds: np.ndarray

    @property
    def springs(self) -> int:
        return len(self.mass)


def read(path: str) -> Problem:
    with open(path, encoding="utf-8") as file:
        words = file.read().split()
    springs, rod, chains, steps = (int(word) for word in words[:4])
    numbers = np.array([float(word) for word in words[5:]])
    columns = numbers[: 5 * springs].reshape(springs, 5).T.copy()
    return Problem(rod, steps, float(words[4]), *columns, numbers[5 * springs : 5 * springs + chains])


def timed(work: Callable[[], np.ndarray], amount: Callable[[np.ndarray], float] | None = None) -> np.ndarray:
    """Does the work; prints seconds by the clock and of the processor, and how much it was where that is not known beforehand."""
    start, start_of_work = time.perf_counter(), time.process_time()
    ends = work()
    seconds = f"{time.perf_counter() - start:.9f} {time.process_time() - start_of_work:.9f}"
    print(f"{seconds} {amount(ends):.0f}" if amount else seconds)
    return ends


def write(path: str, ends: np.ndarray) -> None:
    np.ascontiguousarray(ends, dtype="<f8").tofile(path)


def main(advance: Callable[[Problem, str, str, int], Callable[[], np.ndarray]]) -> None:
    """`PROGRAM PROBLEM one|batch power|linear THREADS END`: `advance` gets everything ready and gives back the work to be timed."""
    _, path, together, law, threads, end = sys.argv
    write(end, timed(advance(read(path), together, law, int(threads))))
