"""Impacts of balls in Yade: reads a list of cases as JSON (first word), writes the list of results (second word). With a third word, a number of
steps, the first is the folder of `percuss export --to lammps`: the plate is advanced without output, or, for 0 steps, the result is the speed of its
longest wave. `balls` runs it with `yade -n -x`."""

import json
import math
import sys
from pathlib import Path

from yade import *

STIFFER = 1e9
"""Young's modulus of the plane over that of the ball."""
LARGER = 1e5
"""Radius of the plane over that of the ball. A wall or facet of Yade gives R* = R/2 or 2R/3 instead of R."""


def impact(case: dict[str, float]) -> dict[str, float]:
    """One impact along -z, at an angle towards x. The second ball comes the other way; a plane is a large, stiff, fixed ball."""
    O.reset()
    radius, speed, angle = case["radius_m"], case["speed_m_s"], math.radians(case["angle_deg"])
    friction = math.atan(case["friction"])
    soft, hard = (
        O.materials.append(
            FrictMat(density=case["density_kg_m3"], young=factor * case["young_pa"], poisson=case["poisson"], frictionAngle=friction)
        )
        for factor in (1.0, STIFFER)
    )
    two = case["partner"] == "ball"
    share = 0.5 if two else 1.0
    first = O.bodies[O.bodies.append(sphere((0, 0, 1.0001 * radius), radius, material=soft))]
    first.state.vel = share * speed * Vector3(math.sin(angle), 0, -math.cos(angle))
    if two:
        other = O.bodies[O.bodies.append(sphere((0, 0, -1.0001 * radius), radius, material=soft))]
        other.state.vel = -first.state.vel
    else:
        other = O.bodies[O.bodies.append(sphere((0, 0, -LARGER * radius), LARGER * radius, material=hard, fixed=True))]
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb()]),
        InteractionLoop(
            [Ig2_Sphere_Sphere_ScGeom()],
            [Ip2_FrictMat_FrictMat_MindlinPhys(en=case["restitution"], es=1.0)],
            [Law2_ScGeom_MindlinPhys_Mindlin()],
        ),
        NewtonIntegrator(damping=0),
    ]
    O.dt = case["time_step_s"]
    approach = force = 0.0
    contacts = 0
    for _ in range(case["steps"]):
        O.step()
        push = O.forces.f(first.id)[2]
        if push > 0:
            contacts += 1
            force = max(force, push)
            approach = max(approach, O.interactions[first.id, other.id].geom.penetrationDepth)
        elif contacts:
            break
    velocity = first.state.vel - other.state.vel
    along = speed * math.sin(angle)
    return {
        "approach_um": approach * 1e6,
        "force_n": force,
        "time_us": contacts * O.dt * 1e6,
        "restitution": velocity[2] / (speed * math.cos(angle)),
        "restitution_along": velocity[0] / along if along else 0.0,
        "spin_rad_s": abs(first.state.angVel[1]),
    }


def section(text: str, name: str) -> list[list[str]]:
    """Rows of a section of a LAMMPS data file."""
    rows = text.split(f"\n{name}", 1)[1].split("\n", 2)[2]
    return [line.split() for line in rows.split("\n\n")[0].splitlines()]


def plate(folder: Path) -> None:
    """The exported plate without its projectile: spheres of the same masses on the same lattice, bonds of the same stiffness per metre of width."""
    data, script = (folder / "particles.data").read_text(), (folder / "impact.in").read_text()
    lines = [line.split() for line in script.splitlines()]
    stiffness = {words[1]: (float(words[2]), float(words[3])) for words in lines if words[:1] == ["bond_coeff"]}
    O.dt = next(float(words[1]) for words in lines if words[:1] == ["timestep"])
    materials: dict[str, int] = {}
    for _, _, _, diameter, density, x, y, _ in section(data, "Atoms")[:-1]:
        if density not in materials:
            materials[density] = O.materials.append(
                CohFrictMat(density=float(density), young=1e9, poisson=0.1, frictionAngle=0.0, normalCohesion=1e30, shearCohesion=1e30)
            )
        O.bodies.append(sphere((float(x), float(y), 0.0), float(diameter) / 2, material=materials[density]))
    near = 1.01
    bounds, shape = Bo1_Sphere_Aabb(aabbEnlargeFactor=near), Ig2_Sphere_Sphere_ScGeom6D(interactionDetectionFactor=near)
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([bounds]),
        InteractionLoop([shape], [Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionNow=True)], [Law2_ScGeom6D_CohFrictPhys_CohesionMoment()]),
        NewtonIntegrator(damping=0),
    ]
    O.step()
    bounds.aabbEnlargeFactor = shape.interactionDetectionFactor = 1.0
    bonds = section(data, "Bonds")
    if len(bonds) != sum(1 for bond in O.interactions if bond.isReal):
        raise SystemExit("not the bonds of the plate")
    for _, kind, first, second in bonds:
        physics = O.interactions[int(first) - 1, int(second) - 1].phys
        physics.kn, physics.ks = stiffness[kind]


def long_wave() -> float:
    """Speed of the longest wave of the free strip: it starts with the velocities of that wave, which vanish after a quarter of its period. Rows are
    in turn a spacing shorter."""
    places = [body.state.pos[0] for body in O.bodies]
    spacing = 2 * O.bodies[0].shape.radius
    length = max(places) - min(places) - spacing / 2
    shape = [math.sin(-math.pi * x / length) for x in places]
    for body, part in zip(O.bodies, shape):
        body.state.vel = Vector3(1e-3 * part, 0, 0)
    since, last, every = O.time, 1.0, 5
    while True:
        O.run(every, True)
        now = sum(part * body.state.mass * body.state.vel[0] for body, part in zip(O.bodies, shape))
        if now < 0:
            break
        last = now
    quarter = O.time - since - O.dt / 2 - every * O.dt * now / (now - last)
    return length / 2 / quarter


source, result = Path(sys.argv[1]), Path(sys.argv[2])
if len(sys.argv) == 3:
    result.write_text(json.dumps([impact(case) for case in json.loads(source.read_text())]))
elif int(sys.argv[3]):
    plate(source)
    for body in list(O.bodies)[:200]:
        body.state.vel = Vector3(0, 1e-3, 0)
    O.run(int(sys.argv[3]), True)
    result.write_text(json.dumps(sum(body.state.vel.norm() for body in O.bodies)))
else:
    plate(source)
    result.write_text(json.dumps(long_wave()))
