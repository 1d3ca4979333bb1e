"""The chains with NumPy: whole arrays at a time, a row a chain."""

import numpy as np
import problem


def advance(chains: problem.Problem, together: str, law: str, threads: int):
    if threads != 1:
        raise SystemExit("one thread only")
    groups = [chains.speeds] if together == "batch" else [np.array([speed]) for speed in chains.speeds]
    per_length = 1.0 / chains.length
    kick = chains.time_step / chains.mass

    def march(speeds: np.ndarray) -> np.ndarray:
        u = np.zeros((len(speeds), chains.springs + 1))
        v = np.zeros((len(speeds), chains.springs))
        v[:, : chains.rod] = speeds[:, None]
        force = np.zeros((len(speeds), chains.springs + 1))
        for _ in range(chains.steps):
            strain = (u[:, :-1] - u[:, 1:]) * per_length
            if law == "linear":
                force[:, 1:] = chains.stiffness * strain
            else:
                size = np.abs(strain)
                flow = chains.coefficient * size**chains.exponent
                force[:, 1:] = np.copysign(np.minimum(flow, chains.stiffness * size), strain)
            v += (force[:, :-1] - force[:, 1:]) * kick
            u[:, :-1] += v * chains.time_step
        return u[:, :-1]

    return lambda: np.concatenate([march(speeds) for speeds in groups])


if __name__ == "__main__":
    problem.main(advance)
