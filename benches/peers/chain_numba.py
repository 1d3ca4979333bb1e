"""The chains with numba, as one writes them in Python: loops over springs and steps, and `prange` over the chains."""

import math

import numba
import numpy as np
import problem


@numba.njit(cache=True)
def march(u, v, steps, time_step, kick, per_length, stiffness, coefficient, exponent, linear):
    springs = len(v)
    force = np.zeros(springs + 1)
    for _ in range(steps):
        for i in range(springs):
            strain = (u[i] - u[i + 1]) * per_length[i]
            if linear:
                force[i + 1] = stiffness[i] * strain
            else:
                size = abs(strain)
                flow = coefficient[i] * size ** exponent[i]
                force[i + 1] = math.copysign(min(flow, stiffness[i] * size), strain)
        for i in range(springs):
            v[i] += (force[i] - force[i + 1]) * kick[i]
            u[i] += v[i] * time_step


@numba.njit(cache=True)
def one(speeds, ends, rod, steps, time_step, kick, per_length, stiffness, coefficient, exponent, linear):
    for chain in range(len(speeds)):
        u = np.zeros(len(kick) + 1)
        v = np.zeros(len(kick))
        v[:rod] = speeds[chain]
        march(u, v, steps, time_step, kick, per_length, stiffness, coefficient, exponent, linear)
        ends[chain] = u[:-1]


@numba.njit(parallel=True, cache=True)
def batch(speeds, ends, rod, steps, time_step, kick, per_length, stiffness, coefficient, exponent, linear):
    for chain in numba.prange(len(speeds)):
        u = np.zeros(len(kick) + 1)
        v = np.zeros(len(kick))
        v[:rod] = speeds[chain]
        march(u, v, steps, time_step, kick, per_length, stiffness, coefficient, exponent, linear)
        ends[chain] = u[:-1]


def advance(chains: problem.Problem, together: str, law: str, threads: int):
    numba.set_num_threads(threads)
    function = batch if together == "batch" else one
    ends = np.zeros((len(chains.speeds), chains.springs))

    def work(steps: int = chains.steps) -> np.ndarray:
        function(
            chains.speeds, ends, chains.rod, steps, chains.time_step, chains.time_step / chains.mass, 1.0 / chains.length,
            chains.stiffness, chains.coefficient, chains.exponent, law == "linear",
        )
        return ends

    work(1)  # compiles
    return work


if __name__ == "__main__":
    problem.main(advance)
