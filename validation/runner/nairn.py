"""Decks and results of NairnMPM: rods on a rigid wall, axisymmetric, hyperelastic plasticity.

NAIRN_MPM names the program, NAIRN_MPM_DTD its NairnMPM.dtd (default: beside the program). The deck was run. Units of the deck: mm, ms, g/cm3, MPa,
mm/s. The wall is a fixed boundary, which holds the rod in tension as well: lengths are means over the ringing at the end."""

from __future__ import annotations

import math
import os
import re
import struct
import subprocess
from pathlib import Path

from case import Case, Job, Material, program
from rows import Row

NAME = "nairn"
CODE = "NairnMPM"
COMMIT = "7f47b022"
METHODS = {"USF": 0, "USAVG": 2, "USL": 3}
# Cells beside and above the rod.
WIDTH, ABOVE = 2.4, 4
# Slowest flow [1/s] and smallest plastic strain that count for the excess of the flow stress, as in percuss.
SLOWEST, SMALLEST = 2e3, 0.02


def jobs() -> list[Job]:
    lengths = [Job(case, velocity, 8) for case, velocity in (("copper-on-wall", 183.0), ("johnson-cook-rod-on-wall", 190.0))]
    rate = "johnson-cook-rate-rod-on-wall"
    steps = [{}, {"courant": 0.1}, {"method": "USL"}]
    return lengths + [Job(rate, 190.0, mesh, options) for mesh in (4, 8) for options in steps if not (mesh == 8 and "courant" in options)]


def hardening(of: Material, rate: bool) -> str:
    if "power_law" in of.strength:
        law = of.law("power_law")
        # Y (1 + e/e_y)^n is the power law of the total strain that meets the elastic line at e_y.
        strain = (law["coefficient"] / of.youngs_modulus) ** (1 / (1 - law["exponent"]))
        stress = 1e-6 * of.youngs_modulus * strain
        return (
            f"<Hardening>Nonlinear</Hardening><yield>{stress:.9g}</yield>"
            f"<Khard>{1 / strain:.9g}</Khard><nhard>{law['exponent']:.9g}</nhard>"
        )
    law = of.law("johnson_cook")
    # Without heating the temperature stays that of reference, 0 here: the thermal factor is 1.
    return (
        f"<Hardening>JohnsonCook</Hardening><Ajc>{1e-6 * law['a']:.9g}</Ajc><Bjc>{1e-6 * law['b']:.9g}</Bjc><njc>{law['n']:.9g}</njc>"
        f"<Cjc>{law['c'] if rate else 0:.9g}</Cjc><ep0jc>{law.get('reference_rate', 1.0):.9g}</ep0jc><Tmjc>1e9</Tmjc><mjc>1</mjc>"
    )


def shape(case: Case, job: Job) -> tuple[float, float, int]:
    """Radius [mm], length [mm] and rows of cells along the rod, a whole number: a particle belongs to the rod if its centre does."""
    radius, length = 500 * case.length("projectile", "diameter"), 1e3 * case.length("projectile", "length")
    return radius, length, round(length * job.mesh / radius)


def write(case: Case, job: Job, folder: Path) -> None:
    of = case.material("projectile")
    axi = case.options("axi")
    if axi.get("adiabatic_heating", True) and "johnson_cook" in of.strength:
        raise RuntimeError("the deck has no heating: it needs axi.adiabatic_heating = false")
    radius, length, rows = shape(case, job)
    cell, height = radius / job.mesh, length / rows
    # Three passages of the rod's length at the impact velocity [ms]: the end of plastic flow, and ringing.
    time = 0.95e3 * case.length("projectile", "length") / case.velocity
    frames = 300
    # Archived: position, velocity, stress, plastic strain.
    order = "iYYYNNNNNNNNNYNNNNNNNNNN"
    deck = f"""<?xml version='1.0'?>
<!DOCTYPE JANFEAInput SYSTEM "NairnMPM.dtd">
<JANFEAInput version='3'>
  <Header><Description>{job.label()}</Description><Analysis>13</Analysis></Header>
  <MPMHeader>
    <MPMMethod>{METHODS[job.options.get("method", "USAVG")]}</MPMMethod>
    <Timing CFL="{job.options.get("courant", 0.4)}"/>
    <MatlPtsPerElement>4</MatlPtsPerElement>
    <MaxTime units="ms">{time:.6g}</MaxTime>
    <ArchiveTime units="ms">{time / frames:.6g}</ArchiveTime>
    <ArchiveRoot>fields/f.</ArchiveRoot>
    <MPMArchiveOrder>{order}</MPMArchiveOrder>
    <GlobalArchiveTime units="ms">{time / frames:.6g}</GlobalArchiveTime>
    <GlobalArchive type="Kinetic Energy"/>
    <GlobalArchive type="Work Energy"/>
    <GIMP type="lCPDI"/>
  </MPMHeader>
  <Mesh output="file">
    <Grid xmin="0" xmax="{math.ceil(WIDTH * job.mesh) * cell:.9g}" ymin="0" ymax="{(rows + ABOVE) * height:.9g}">
      <Horiz cellsize="{cell:.9g}" symmin="0"/>
      <Vert cellsize="{height:.9g}" symmin="0"/>
    </Grid>
  </Mesh>
  <MaterialPoints>
    <Body mat="1" angle="0" thick="1" vx="0" vy="{-1e3 * case.velocity:.9g}"><Rect xmin="0" xmax="{radius:.9g}" ymin="0" ymax="{length:.9g}"/></Body>
  </MaterialPoints>
  <Material Type="24" Name="rod">
    <rho>{1e-3 * of.density:.9g}</rho><G1>{1e-6 * of.shear_modulus:.9g}</G1><K>{1e-6 * of.bulk_modulus:.9g}</K><alpha>0</alpha>
    {hardening(of, axi.get("rate_effects", True))}
  </Material>
</JANFEAInput>
"""
    (folder / "deck.fmcmd").write_text(deck)


def run(job: Job, folder: Path) -> list[Row]:
    code = program("NAIRN_MPM", "NairnMPM")
    dtd = Path(os.environ.get("NAIRN_MPM_DTD", code.with_name("NairnMPM.dtd")))
    if not dtd.is_file():
        raise RuntimeError(f"no file {dtd}: set NAIRN_MPM_DTD")
    (folder / "NairnMPM.dtd").write_bytes(dtd.read_bytes())
    fields = folder / "fields"
    fields.mkdir(exist_ok=True)
    for old in fields.iterdir():
        old.unlink()
    done = subprocess.run([str(code), "-np", "1", "deck.fmcmd"], cwd=folder, capture_output=True, text=True)
    (folder / "log.txt").write_text(done.stdout + done.stderr)
    if done.returncode != 0:
        raise RuntimeError(f"exit status {done.returncode}, see {folder / 'log.txt'}")
    case = Case.load(job.case, job.velocity)
    frames = read(fields, done.stdout)
    mesh = ", ".join(["lCPDI, FLIP", job.options.get("method", "USAVG"), f"Courant {job.options.get('courant', 0.4)}", f"{job.mesh:g} cells per radius"])
    # The rod has come to rest in the last fifth.
    end = frames[4 * len(frames) // 5 :]
    radius, length, rows = shape(case, job)
    mean = [sum(values) / len(end) for values in zip(*(size(frame, radius, length, rows, job.mesh) for frame in end), strict=True)]
    numbers = [("final-length", mean[0], "mm"), ("foot-diameter", mean[1], "mm")]
    of = case.material("projectile")
    if "johnson_cook" in of.strength and case.options("axi").get("rate_effects", True):
        numbers.append(("stress-excess", excess(frames, of.law("johnson_cook")), "%"))
    energy = energy_error(fields, of.density, case)
    return [Row(job.case, job.velocity, CODE, COMMIT, mesh, quantity, value, unit, energy) for quantity, value, unit in numbers]


class Frame:
    """Material points at one time [s]; lengths in mm, stresses in MPa."""

    # Element, mass, material, two spare bytes, angle, thickness, position, first position, velocity, stress (rr, zz, tt, rz), plastic strain.
    RECORD = struct.Struct("<idhhdd2d2d2d4dd")
    HEADER = 64

    def __init__(self, time: float, data: bytes) -> None:
        if (len(data) - self.HEADER) % self.RECORD.size:
            raise RuntimeError("the archive has records of another length")
        self.time = time
        self.points = list(self.RECORD.iter_unpack(data[self.HEADER :]))


def read(fields: Path, log: str) -> list[Frame]:
    steps = re.findall(r"^\s*\d+\s+([0-9.e+-]+)\s+f\.(\d+)\s*$", log, re.MULTILINE)
    if not steps:
        raise RuntimeError("no archived steps in the output")
    return [Frame(1e-3 * float(time), (fields / f"f.{step}").read_bytes()) for time, step in steps]


def size(frame: Frame, radius: float, length: float, rows: int, cells: float) -> tuple[float, float]:
    """Length on all of the tail, and diameter of the foot [mm]: particles are half a cell wide at first."""
    across, along = radius / cells / 4, length / rows / 4
    tail = [point[7] for point in frame.points if point[9] > length - 1.2 * along]
    foot = [point[6] for point in frame.points if point[9] < 1.2 * along]
    return sum(tail) / len(tail) + along, 2 * (max(foot) + across)


def excess(frames: list[Frame], law: dict[str, float]) -> float:
    """Mean of stress over law at the mean plastic strain rate, less 1 [%], weighted by the rate."""
    total = weights = 0.0
    for before, now, after in zip(frames, frames[1:], frames[2:], strict=False):
        for first, point, last in zip(before.points, now.points, after.points, strict=True):
            strain, rate = point[16], (last[16] - first[16]) / (after.time - before.time)
            if rate < SLOWEST or strain < SMALLEST:
                continue
            rr, zz, tt, rz = point[12:16]
            stress = 1e-6 * math.sqrt(0.5 * ((rr - zz) ** 2 + (zz - tt) ** 2 + (tt - rr) ** 2) + 3 * rz * rz)
            slow = 1e-6 * (law["a"] + law["b"] * strain ** law["n"])
            total += rate * (stress / (slow * (1 + law["c"] * math.log(rate / law.get("reference_rate", 1.0)))) - 1)
            weights += rate
    return 100 * total / weights


def energy_error(fields: Path, density: float, case: Case) -> float:
    """Kinetic energy and work of the stresses at the end over the impact energy, less 1 [%]."""
    lines = [line for line in next(fields.glob("*.global")).read_text().splitlines() if line and not line.startswith("#")]
    # Energies are those of one radian.
    last = [2 * math.pi * float(word) for word in lines[-1].split()]
    area = math.pi * case.length("projectile", "diameter") ** 2 / 4
    impact = 0.5 * density * area * case.length("projectile", "length") * case.velocity**2
    return 100 * (sum(last[1:3]) / impact - 1)
