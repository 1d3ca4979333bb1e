"""Decks of OpenRadioss: a rod on a rigid wall, axisymmetric quadrilaterals. UNTRIED: no run of this deck was made.

OPENRADIOSS_STARTER and OPENRADIOSS_ENGINE name the two programs. The stored numbers are from decks that were written by hand for an earlier comparison. Units of
the deck: mm, ms, g, MPa, m/s. The rod's law is tabulated: stress against plastic strain."""

from __future__ import annotations

import os
import re
import subprocess
from pathlib import Path

from case import Case, Job, program
from rows import Row

NAME = "openradioss"
CODE = "OpenRadioss"
COMMIT = "bd4557ba"


def jobs() -> list[Job]:
    return [Job("copper-on-wall", 183.0, mesh) for mesh in (0.48, 0.24)]


def table(case: Case) -> list[tuple[float, float]]:
    """Plastic strain and flow stress [MPa] of the power law."""
    of = case.material("projectile")
    law = of.law("power_law")
    first = (law["coefficient"] / of.youngs_modulus) ** (1 / (1 - law["exponent"]))
    strains = [0.0] + [1e-4 * 10 ** (i / 12) for i in range(60)]
    return [(strain, 1e-6 * law["coefficient"] * (first + strain) ** law["exponent"]) for strain in strains]


def block(*lines: str) -> str:
    return "\n".join(lines) + "\n"


def fields(*values: object) -> str:
    """Fields of twenty characters."""
    return "".join(f"{value:>20.9g}" if isinstance(value, float) else f"{value!s:>20}" for value in values)


def write(case: Case, job: Job, folder: Path) -> None:
    of = case.material("projectile")
    radius, length = 500 * case.length("projectile", "diameter"), 1e3 * case.length("projectile", "length")
    across, along = round(radius / job.mesh), round(length / job.mesh)
    # In axisymmetric analysis y is the radius and z the axis.
    number = lambda i, j: 1 + i + j * (across + 1)  # noqa: E731
    nodes = [
        f"{number(i, j):>10}" + fields(0.0, i * radius / across, j * length / along) for j in range(along + 1) for i in range(across + 1)
    ]
    quads = [
        f"{1 + i + j * across:>10}" + "".join(f"{node:>10}" for node in (number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)))
        for j in range(along)
        for i in range(across)
    ]
    everything = "".join(f"{i:>10}" + ("\n" if i % 10 == 0 else "") for i in range(1, (across + 1) * (along + 1) + 1)).rstrip("\n")
    axis = "".join(f"{number(0, j):>10}" + ("\n" if j % 10 == 9 else "") for j in range(along + 1)).rstrip("\n")
    curve = [fields(strain, stress) for strain, stress in table(case)]
    starter = block(
        "#RADIOSS STARTER",
        "# UNTRIED deck",
        "/BEGIN",
        "rod",
        f"{2022:>10}{0:>10}",
        fields("g", "mm", "ms"),
        fields("g", "mm", "ms"),
        "/ANALY",
        f"{1:>10}{0:>10}",
        "/MAT/LAW36/1",
        "rod",
        fields(1e-6 * of.density),
        fields(1e-6 * of.youngs_modulus, of.poissons_ratio, 0.0, 0.0, 0.0),
        f"{1:>10}{0:>10}" + fields(0.0, 0.0, 0.0),
        f"{0:>10}" + fields(0.0) + f"{0:>10}",
        f"{1:>10}",
        fields(1.0),
        fields(0.0),
        "/FUNCT/1",
        "flow stress against plastic strain",
        *curve,
        "/PROP/TYPE14/1",
        "rod",
        f"{1:>10}{1:>10}" + 6 * f"{0:>10}" + fields(0.0),
        fields(1.1, 0.05, 0.0, 0.0, 0.0),
        fields(0.0) + f"{0:>10}{0:>10}",
        "/PART/1",
        "rod",
        f"{1:>10}{1:>10}{0:>10}",
        "/NODE",
        *nodes,
        "/QUAD/1",
        *quads,
        "/GRNOD/NODE/1",
        "rod",
        everything,
        "/GRNOD/NODE/2",
        "axis",
        axis,
        "/BCS/1",
        "axis",
        "   010 000" + f"{0:>10}{2:>10}",
        "/INIVEL/TRA/1",
        "impact",
        fields(0.0, 0.0, -case.velocity) + f"{1:>10}{0:>10}",
        "/RWALL/PLANE/1",
        "wall",
        f"{0:>10}{0:>10}{1:>10}{0:>10}",
        fields(0.0, 0.0, 0.0, 0.0, 0.0),
        fields(0.0, 0.0, 0.0),
        fields(0.0, 0.0, 1.0),
        "/TH/NODE/1",
        "length",
        f"{'Z':>10}",
        f"{number(0, along):>10}{0:>10}",
        f"{number(0, 0):>10}{0:>10}",
        "/END",
    )
    end = 0.95e3 * case.length("projectile", "length") / case.velocity
    engine = block("/RUN/rod/1", f"{end:.6g}", "/TFILE", f"{end / 500:.6g}", "/PRINT/-100", "/DT/QUAD/DEL", "0.6 1e-6", "/VERS/2022")
    (folder / "rod_0000.rad").write_text(starter)
    (folder / "rod_0001.rad").write_text(engine)


def run(job: Job, folder: Path) -> list[Row]:
    starter, engine = program("OPENRADIOSS_STARTER", "OpenRadioss"), program("OPENRADIOSS_ENGINE", "OpenRadioss")
    reader = program("OPENRADIOSS_TH_TO_CSV", "the converter of its time histories to CSV")
    for code, deck in ((starter, "rod_0000.rad"), (engine, "rod_0001.rad")):
        done = subprocess.run([str(code), "-i", deck, "-nt", "1"], cwd=folder, capture_output=True, text=True, env=os.environ)
        (folder / f"{deck}.log").write_text(done.stdout + done.stderr)
        if done.returncode != 0 or re.search(r"\bERROR TERMINATION\b", done.stdout):
            raise RuntimeError(f"see {folder / deck}.log")
    subprocess.run([str(reader), "rodT01"], cwd=folder, check=True, capture_output=True)
    lines = (folder / "rodT01.csv").read_text().splitlines()
    names = [name.strip(' "') for name in lines[0].split(",")]
    places = [i for i, name in enumerate(names) if name.endswith("Z")]
    if len(places) != 2:
        raise RuntimeError(f"expected two histories of Z, found {names}")
    lengths = [abs(float(row[places[0]]) - float(row[places[1]])) for row in (line.split(",") for line in lines[1:])]
    end = lengths[4 * len(lengths) // 5 :]
    return [Row(job.case, job.velocity, CODE, COMMIT, f"one-point quadrilaterals, {job.mesh:g} mm", "final-length", sum(end) / len(end), "mm")]
