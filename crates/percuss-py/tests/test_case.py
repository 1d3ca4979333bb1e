"""Cases that are built in code."""

from __future__ import annotations

import math
import pickle
import tomllib
from pathlib import Path
from typing import Any

import numpy
import percuss
import pytest
from conftest import CASES, ROOT, Program

COPPER = {"material": "copper", "length": "12.74 mm", "diameter": "4.8 mm", "impact_velocity": "230 m/s"}
PLATE = {"material": "aluminium-2024-t351", "thickness": "25 mm"}


@pytest.mark.parametrize("case", CASES)
def test_the_tables_of_a_case_make_the_same_case(case: str) -> None:
    path = Path(f"cases/{case}/scenario.toml")
    tables = tomllib.loads(path.read_text())
    built = percuss.Case(case, **tables)
    speeds = [built.impact_velocity_m_s]
    ours = percuss.compare(built, velocity=speeds, model=["chain", "taylor", "forrestal_concrete"])
    theirs = percuss.compare(path, velocity=speeds, model=["chain", "taylor", "forrestal_concrete"])
    assert ours.to_dict() == theirs.to_dict()


def test_material_files_are_found_from_where_the_case_stands(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "shot"
    folder.mkdir()
    (folder / "mine.toml").write_text(Path("crates/percuss-core/materials/woodward1982.toml").read_text().replace("[copper-woodward]", "[mine]"))
    tables: dict[str, Any] = {"material_files": ["mine.toml"], "projectile": {**COPPER, "material": "mine"}, "target": PLATE}
    monkeypatch.chdir(folder)
    built = percuss.Case("shot", **tables)
    built.save("shot.toml")
    monkeypatch.chdir(tmp_path)
    read = percuss.load("shot/shot.toml")
    depth = percuss.run(read).depth_of_penetration_mm
    # Changed or sent elsewhere on this machine, it still finds them.
    for case in (built, read.replace({"projectile.impact_velocity": 230.0}), pickle.loads(pickle.dumps(read))):
        assert percuss.run(case).depth_of_penetration_mm == depth
        assert percuss.compare(case, model="chain").results[0].depth_of_penetration_mm == depth
    with pytest.raises(percuss.MaterialError, match="cannot read"):
        percuss.Case("shot", **tables)


def test_numbers_are_in_si_units_where_a_quantity_is_due() -> None:
    with_units = percuss.Case(
        projectile={**COPPER, "temperature": "293 K"},
        target=PLATE,
        chain={"constraint_factor": 2.7, "courant": 0.5, "end_time": "50 us"},
        experiments=[{"impact_velocity": "230 m/s", "depth_of_penetration": "0.25 mm", "source": "user"}],
        materials={"mine": {"name": "mine", "density": "8000 kg/m3", "youngs_modulus": "100 GPa", "poissons_ratio": 0.3,
                            "strength": {"perfectly_plastic": {"flow_stress": "300 MPa"}}}},
    )
    numbers = percuss.Case(
        projectile={"material": "copper", "length": 12.74e-3, "diameter": 4.8e-3, "impact_velocity": 230, "temperature": 293},
        target={"material": "aluminium-2024-t351", "thickness": numpy.float64(25e-3)},
        chain={"constraint_factor": numpy.float32(2.7).item(), "courant": 0.5, "end_time": 50e-6},
        experiments=[{"impact_velocity": 230.0, "depth_of_penetration": 0.25e-3, "source": "user"}],
        materials={"mine": {"name": "mine", "density": 8000, "youngs_modulus": 100e9, "poissons_ratio": 0.3,
                            "strength": {"perfectly_plastic": {"flow_stress": 300e6}}}},
    )
    assert 'impact_velocity = "230 m/s"' in numbers.text and "courant = 0.5" in numbers.text
    first, second = (percuss.run(case).to_dict() for case in (with_units, numbers))
    for name, value in first.items():
        if isinstance(value, float):
            assert math.isclose(value, second[name], rel_tol=1e-6, abs_tol=1e-12), name


def test_an_si_number_keeps_all_its_bits() -> None:
    speed = 230.0 * (1 + 2**-50)
    case = percuss.Case(projectile={**COPPER, "impact_velocity": speed}, target=PLATE)
    assert case.impact_velocity_m_s == speed
    assert percuss.Case.from_text(case.text).impact_velocity_m_s == speed


def test_a_case_can_be_written_changed_and_sent(tmp_path: Path, program: Program) -> None:
    case = percuss.Case("shot", projectile=COPPER, target=PLATE, chain=None)
    case.save(tmp_path / "shot.toml")
    assert f"{percuss.run(case).depth_of_penetration_mm}" in program("run", tmp_path / "shot.toml", "--fast", "--json").stdout
    faster = case.replace({"projectile.impact_velocity": 400.0, "chain.target_elements": 40})
    assert (faster.impact_velocity_m_s, case.impact_velocity_m_s) == (400.0, 230.0)
    assert tomllib.loads(faster.text)["chain"]["target_elements"] == 40
    sent = pickle.loads(pickle.dumps(faster))
    assert (sent.name, sent.text) == (faster.name, faster.text)
    assert repr(case) == "<Case shot, 230 m/s>" and "thickness" in case._repr_html_()


@pytest.mark.parametrize(
    ("value", "error", "words"),
    [
        (object(), TypeError, "`diameter`: a object has no place in a case"),
        (float("nan"), percuss.CaseError, "NaN m"),
        (2**70, ValueError, "`diameter`: the whole number is too large"),
        ("4.8 kg", percuss.CaseError, "`kg` is a unit of mass, but a length is due here"),
        (-1.0, percuss.CaseError, "allowed"),
    ],
)
def test_what_has_no_place_in_a_case_is_refused(value: Any, error: type[Exception], words: str) -> None:
    with pytest.raises(error) as caught:
        percuss.Case(projectile={**COPPER, "diameter": value}, target=PLATE)
    assert words in str(caught.value)


def test_what_holds_itself_or_is_too_deep_is_refused() -> None:
    own: dict[str, Any] = {}
    own["inside"] = own
    ring: list[Any] = []
    ring.append(ring)
    deep: dict[str, Any] = {}
    inside = deep
    for _ in range(100_000):
        inside["a"] = inside = {}
    long: list[Any] = []
    for _ in range(100_000):
        long = [long]
    wide: list[Any] = [0.0]
    for _ in range(20):
        wide = [wide] * 10

    class Endless:
        def tolist(self) -> Endless:
            return self

    case = percuss.Case(projectile=COPPER, target=PLATE)
    for value in (own, ring, deep, long, Endless()):
        for build in (
            lambda value=value: percuss.Case(projectile=value, target=PLATE),
            lambda value=value: case.replace({"projectile.length": value}),
            lambda value=value: percuss.sweep({"base": case, "parameter": [value]}, "nowhere"),
        ):
            with pytest.raises(ValueError, match="is nested more than 32 levels deep"):
                build()
    assert not Path("nowhere").exists()
    with pytest.raises(ValueError, match="more than 1000000 values in all"):
        percuss.Case(projectile=wide, target=PLATE)


def test_the_cost_of_a_run_is_estimated() -> None:
    case = percuss.load(ROOT / "cases/paper-table1/scenario.toml")
    formula = case.estimate("crater_energy")
    assert formula == {"memory_bytes": 0.0, "steps": 0.0, "seconds": 0.0}
    usual = case.estimate()
    steps = percuss.run(case).steps
    assert usual["steps"] / 6 < steps < usual["steps"] * 6
    fine = case.replace({"chain.projectile_elements": 100_000, "chain.target_elements": 100_000})
    assert fine.estimate("chain")["seconds"] > 1000 and fine.estimate("chain")["memory_bytes"] > 1e8
    with pytest.raises(percuss.NotApplicableError, match="memory"):
        case.replace({"axi.cells_per_radius": 1000}).estimate("axi")
