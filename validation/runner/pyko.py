"""Decks and results of pyKO: plates in uniaxial strain, perfectly plastic, with Mie-Grueneisen equations of state.

PYKO names the folder of pyko.py; PYKO_PYTHON a Python with its requirements (default: the one that runs this). The deck was run."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

from case import Case, Job, Material, program
from rows import Row

NAME = "pyko"
CODE = "pyKO"
COMMIT = "9bccb4a1"
# Window of the plateau of the interface stress [s]: the second half of the wave's way through the flyer.
PLATEAU = (0.2e-6, 0.4e-6)


def jobs() -> list[Job]:
    return [Job("copper-plate-on-aluminium", 500.0, 100), Job("copper-plate-on-aluminium-spall", 500.0, 50)]


def material(of: Material, cells: int, start: float, length: float, velocity: float, spall: float | None) -> dict[str, object]:
    if of.equation_of_state is None:
        raise RuntimeError("pyKO needs an equation of state")
    state = {key: float(str(value).split()[0]) for key, value in of.equation_of_state.items() if key in ("sound_speed", "slope", "gruneisen")}
    deck: dict[str, object] = {
        "mesh": {"cells": cells, "xstart": start, "length": length},
        "init": {"up0": velocity, "rho0": of.density, "p0": 0.0, "e0": 0.0, "t0": 293.0},
        "eos": {
            "name": "metal",
            "type": "MGR",
            "rhoref": of.density,
            "c0": state["sound_speed"],
            "s1": state["slope"],
            "gamma0": state["gruneisen"],
            "cv": 1e3,
        },
        "str": {"type": "VM", "gmod": of.shear_modulus, "ys": of.law("perfectly_plastic")["flow_stress"]},
    }
    if spall is not None:
        # Its second condition, a density below this part of the reference, would hold back spall at a strain of 1 %.
        deck["frac"] = {"pfrac": spall, "nrhomin": 0.99}
    return deck


UNITS = {
    "units": {
        "time": "second", "length": "meter", "velocity": "meter/second", "density": "kg/m^3", "mass": "kg", "pressure": "Pa", "temperature": "K",
        "energy": "J", "sp_energy": "J/kg", "sp_entropy": "J/kg/K", "sp_heat_cap": "J/kg/K", "gravity": "m/s^2", "s2": "second/meter",
    },
    "codeunits": {
        "time": "microseconds", "length": "cm", "mass": "g", "density": "g/cm^3", "relative_volume": "dimensionless",
        "velocity": "cm/microsecond", "pressure": "megabar", "temperature": "K", "energy": "eu", "sp_energy": "eu/g", "sp_heat_cap": "eu/K/g",
        "sp_entropy": "eu/K/g", "ie_perv0": "eu/cm^3", "cv_perv0": "eu/cm^3/K", "gravity": "cm/microseconds^2", "s2": "microseconds/cm",
    },
}  # fmt: skip


def write(case: Case, job: Job, folder: Path) -> None:
    flyer, target = case.material("projectile"), case.material("target")
    cells = int(job.mesh)
    long, thick = case.length("projectile", "length"), case.length("target", "thickness")
    fdm = case.options("fdm")
    mean = None
    if "spall_strength" in fdm:
        # pyKO spalls at a mean tension; the axial stress of percuss has two thirds of the yield stress more.
        mean = case.length("fdm", "spall_strength") - 2 / 3 * target.law("perfectly_plastic")["flow_stress"]
    deck = {
        "name": job.label(),
        "outputfilename": "fields.dat",
        "outputformat": "BIN",
        "tstop": case.length("fdm", "end_time"),
        "dtstart": 1e-10,
        "dtoutput": 5e-9,
        "mat1": material(flyer, cells, -long, long, case.velocity, None),
        "mat2": material(target, round(cells * thick / long), 0.0, thick, 0.0, mean),
        "boundaries": {"ibc": "FREE", "ip0": 0.0, "obc": "FREE", "op0": 0.0},
        "geometry": "PLA",
        "gravity": 0.0,
        "pvoid": 0.0,
        **UNITS,
    }
    # JSON is YAML.
    (folder / "deck.yml").write_text(json.dumps(deck, indent=1))


def run(job: Job, folder: Path) -> list[Row]:
    home = program("PYKO", "pyKO")
    python = os.environ.get("PYKO_PYTHON", sys.executable)
    reader = Path(__file__).with_name("pyko_reader.py")
    done = subprocess.run([python, str(reader), str(home), "5" if "spall" in job.case else "0"], cwd=folder, capture_output=True, text=True)
    (folder / "log.txt").write_text(done.stdout + done.stderr)
    if done.returncode != 0 or not (folder / "result.json").is_file():
        raise RuntimeError(f"see {folder / 'log.txt'}")
    found = json.loads((folder / "result.json").read_text())
    return rows(job, found)


def rows(job: Job, found: dict[str, object]) -> list[Row]:
    times, rear, face = found["time_s"], found["rear_velocity_m_s"], found["interface_stress_pa"]
    assert isinstance(times, list) and isinstance(rear, list) and isinstance(face, list)
    first = rear.index(max(rear))
    if "spall" in job.case:
        second = min(range(first, len(rear)), key=lambda i: rear[i])
        values = [("pull-back-minimum", rear[second], "m/s"), ("velocity-after-spall", max(rear[second:]), "m/s")]
    else:
        plateau = [stress for time, stress in zip(times, face, strict=True) if PLATEAU[0] <= time <= PLATEAU[1]]
        values = [
            ("interface-stress", 1e-9 * sum(plateau) / len(plateau), "GPa"),
            ("free-surface-velocity", rear[first], "m/s"),
            ("precursor-arrival", 1e6 * arrival(times, rear, 50.0), "us"),
            ("plastic-arrival", 1e6 * arrival(times, rear, 350.0), "us"),
        ]
    mesh = f"{job.mesh:g} cells per flyer"
    error = found["energy_error_percent"]
    assert isinstance(error, float)
    return [Row(job.case, job.velocity, CODE, COMMIT, mesh, quantity, value, unit, error) for quantity, value, unit in values]


def arrival(times: list[float], velocities: list[float], level: float) -> float:
    later = next(i for i, velocity in enumerate(velocities) if velocity >= level)
    part = (level - velocities[later - 1]) / (velocities[later] - velocities[later - 1])
    return times[later - 1] + part * (times[later] - times[later - 1])
