"""Impacts of balls in Kratos DEM: reads a list of cases as JSON (first word), writes the list of results (second word). `balls` runs it."""

import json
import math
import os
import sys
import tempfile
from pathlib import Path

import KratosMultiphysics as kratos
from KratosMultiphysics import DEMApplication as dem
from KratosMultiphysics.DEMApplication.DEM_analysis_stage import DEMAnalysisStage

STIFFER = 1e9
"""Young's modulus of the plane over that of the ball: the plane is rigid."""


def block(kind: str, rows: list[object]) -> str:
    """A block of an mdpa file."""
    return "\n".join([f"Begin {kind}", *map(str, rows), f"End {kind.split()[0]}", ""])


def group(name: str, nodes: int, kind: str, members: int) -> str:
    """The group of all nodes, and of all elements or conditions."""
    lists = [block("SubModelPartNodes", range(1, nodes + 1)), block(f"SubModelPart{kind}", range(1, members + 1))]
    return block(f"SubModelPart {name}", lists)


def write(case: dict[str, float], folder: Path) -> None:
    """Geometry and materials. Balls are aligned along z; a plane is two triangles at z = 0."""
    radius, second = case["radius_m"], case["partner"] == "ball"
    heights = [1.0001 * radius, -1.0001 * radius] if second else [1.0001 * radius]
    balls = len(heights)
    head = block("Properties 0", [])
    sphere = [
        head,
        block("Nodes", [f"{i} 0 0 {height!r}" for i, height in enumerate(heights, 1)]),
        block("Elements SphericParticle3D", [f"{i} 0 {i}" for i in range(1, balls + 1)]),
        block("NodalData RADIUS", [f"{i} 0 {radius!r}" for i in range(1, balls + 1)]),
        group("balls", balls, "Elements", balls),
    ]
    (folder / "impactDEM.mdpa").write_text("\n".join(sphere))
    if not second:
        side = 20 * radius
        corners = [(-side, -side), (side, -side), (side, side), (-side, side)]
        plane = [
            head,
            block("Nodes", [f"{i} {x!r} {y!r} 0" for i, (x, y) in enumerate(corners, 1)]),
            block("Conditions RigidFace3D3N", ["1 0 1 2 3", "2 0 1 3 4"]),
            group("plane", 4, "Conditions", 2),
        ]
        (folder / "impactDEM_FEM_boundary.mdpa").write_text("\n".join(plane))
    elastic = {"YOUNG_MODULUS": case["young_pa"], "POISSON_RATIO": case["poisson"]}
    contact = {
        "COEFFICIENT_OF_RESTITUTION": case["restitution"],
        "STATIC_FRICTION": case["friction"],
        "DYNAMIC_FRICTION": case["friction"],
        "FRICTION_DECAY": 500.0,
        "ROLLING_FRICTION": 0.0,
        "ROLLING_FRICTION_WITH_WALLS": 0.0,
        "DEM_DISCONTINUUM_CONSTITUTIVE_LAW_NAME": "DEM_D_Hertz_viscous_Coulomb",
    }
    materials = {
        "materials": [
            {"material_name": "ball", "material_id": 1, "Variables": {"PARTICLE_DENSITY": case["density_kg_m3"], **elastic}},
            {"material_name": "plane", "material_id": 2, "Variables": {**elastic, "YOUNG_MODULUS": STIFFER * case["young_pa"]}},
        ],
        "material_relations": [
            {"material_names_list": ["ball", other], "material_ids_list": [1, number], "Variables": contact}
            for number, other in enumerate(["ball", "plane"], 1)
        ],
        "material_assignation_table": [["SpheresPart.balls", "ball"]] + ([] if second else [["RigidFacePart.plane", "plane"]]),
    }
    (folder / "MaterialsDEM.json").write_text(json.dumps(materials))
    parameters = {
        "problem_name": "impact",
        "do_print_results_option": False,
        "dem_inlet_option": False,
        "GravityZ": 0.0,
        "ElementType": "SphericPartDEMElement3D",
        "NeighbourSearchFrequency": 10,
        "SearchTolerance": 0.01 * radius,
        "search_tolerance_against_walls": 0.01 * radius,
        "MaxTimeStep": case["time_step_s"],
        "FinalTime": case["time_step_s"] * case["steps"],
        "solver_settings": {"strategy": "sphere_strategy"},
    }
    (folder / "ProjectParametersDEM.json").write_text(json.dumps(parameters))


class Impact(DEMAnalysisStage):
    """An impact, ended when the ball has parted."""

    def __init__(self, case: dict[str, float], folder: Path) -> None:
        os.chdir(folder)
        self.case = case
        self.approach = self.force = 0.0
        self.contacts = 0
        self.parted = False
        super().__init__(kratos.Model(), kratos.Parameters((folder / "ProjectParametersDEM.json").read_text()))

    def Initialize(self) -> None:
        super().Initialize()
        case = self.case
        self.balls = list(self.spheres_model_part.Nodes)
        angle = math.radians(case["angle_deg"])
        share = 1 / len(self.balls)
        for ball, sign in zip(self.balls, (1, -1)):
            velocity = [sign * share * case["speed_m_s"] * math.sin(angle), 0.0, -sign * share * case["speed_m_s"] * math.cos(angle)]
            ball.SetSolutionStepValue(kratos.VELOCITY, velocity)

    def FinalizeSolutionStep(self) -> None:
        super().FinalizeSolutionStep()
        first = self.balls[0]
        force = first.GetSolutionStepValue(kratos.TOTAL_FORCES)[2]
        height = first.Z - (self.balls[1].Z if len(self.balls) > 1 else 0.0)
        touch = len(self.balls) * self.case["radius_m"]
        self.approach = max(self.approach, touch - height)
        self.force = max(self.force, force)
        if force > 0:
            self.contacts += 1
        self.parted = self.contacts > 0 and force <= 0

    def KeepAdvancingSolutionLoop(self) -> bool:
        return not self.parted and super().KeepAdvancingSolutionLoop()

    def result(self) -> dict[str, float]:
        velocity = list(self.balls[0].GetSolutionStepValue(kratos.VELOCITY))
        if len(self.balls) > 1:
            velocity = [a - b for a, b in zip(velocity, self.balls[1].GetSolutionStepValue(kratos.VELOCITY))]
        angle, speed = math.radians(self.case["angle_deg"]), self.case["speed_m_s"]
        along = speed * math.sin(angle)
        return {
            "approach_um": self.approach * 1e6,
            "force_n": self.force,
            "time_us": self.contacts * self.case["time_step_s"] * 1e6,
            "restitution": velocity[2] / (speed * math.cos(angle)),
            "restitution_along": velocity[0] / along if along else 0.0,
            "spin_rad_s": abs(self.balls[0].GetSolutionStepValue(kratos.ANGULAR_VELOCITY)[1]),
        }


def main() -> None:
    cases = json.loads(Path(sys.argv[1]).read_text())
    out = Path(sys.argv[2]).resolve()
    kratos.Logger.GetDefaultOutput().SetSeverity(kratos.Logger.Severity.WARNING)
    results = []
    for case in cases:
        with tempfile.TemporaryDirectory() as folder:
            write(case, Path(folder))
            impact = Impact(case, Path(folder))
            impact.Run()
            results.append(impact.result())
            os.chdir("/")
    out.write_text(json.dumps(results))


main()
