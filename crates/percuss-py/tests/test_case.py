"""Cases that are built in code."""

from __future__ import annotations

import pickle
import tomllib
from pathlib import Path
from typing import Any

import numpy
import percuss
import pytest
from percuss import quantities
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
    for case in (built, read.replace({"projectile.impact_velocity": "230 m/s"}), pickle.loads(pickle.dumps(read))):
        assert percuss.run(case).depth_of_penetration_mm == depth
        assert percuss.compare(case, model="chain").results[0].depth_of_penetration_mm == depth
    with pytest.raises(percuss.MaterialError, match="cannot read"):
        percuss.Case("shot", **tables)


@pytest.mark.parametrize("value", [4.8e-3, 5, numpy.float64(4.8e-3), numpy.float32(4.8e-3)])
def test_a_number_without_a_unit_is_refused_with_the_remedy(value: Any) -> None:
    with pytest.raises(percuss.CaseError) as caught:
        percuss.Case(projectile={**COPPER, "diameter": value}, target=PLATE)
    assert caught.value.key == "projectile.diameter" and "the unit is missing" in str(caught.value)
    assert 'write a length as a quoted number with a unit, for example "4.8 mm"' in str(caught.value)
    case = percuss.Case(projectile=COPPER, target=PLATE)
    with pytest.raises(percuss.CaseError, match="the unit is missing"):
        case.replace({"projectile.impact_velocity": 400.0})


class Pint:
    """What the package needs of a quantity of pint."""

    def __init__(self, magnitude: Any, **units: float) -> None:
        self.magnitude, self.units = magnitude, units

    def to_base_units(self) -> Pint:
        return self

    def unit_items(self) -> Any:
        return self.units.items()

    def tolist(self) -> Any:
        raise AssertionError("its list would lose its unit")


def test_quantities_have_their_unit() -> None:
    rod = {"material": "mine", "length": Pint(12.74e-3, meter=1), "diameter": Pint(4.8e-3, meter=1), "impact_velocity": Pint(230.0, meter=1, second=-1)}
    mine = {"name": "mine", "density": Pint(8000, kilogram=1, meter=-3), "youngs_modulus": Pint(100e9, kilogram=1, meter=-1, second=-2),
            "poissons_ratio": Pint(0.3), "strength": {"perfectly_plastic": {"flow_stress": "300 MPa"}}}
    case = percuss.Case(projectile=rod, target=PLATE, materials={"mine": mine})
    texts = percuss.Case(
        projectile={**COPPER, "material": "mine"},
        target=PLATE,
        materials={"mine": {**mine, "density": "8000 kg/m3", "youngs_modulus": "100 GPa", "poissons_ratio": 0.3}},
    )
    assert percuss.run(case).depth_of_penetration_mm == pytest.approx(percuss.run(texts).depth_of_penetration_mm, rel=1e-9)
    with pytest.raises(percuss.CaseError, match="`kg` is a unit of mass, but a length is due here"):
        percuss.Case(projectile={**COPPER, "diameter": Pint(1.0, kilogram=1)}, target=PLATE)
    with pytest.raises(ValueError, match="`diameter`: no number of a case has the unit of"):
        percuss.Case(projectile={**COPPER, "diameter": Pint(1.0, ampere=1)}, target=PLATE)
    with pytest.raises(percuss.CaseError):
        percuss.Case(projectile={**COPPER, "diameter": Pint(1.0)}, target=PLATE)
    speeds = percuss.compare(texts, velocity=Pint(numpy.array([200.0, 230.0]), meter=1, second=-1), model="chain")  # type: ignore[arg-type]
    assert [result.impact_velocity_m_s for result in speeds.results] == [200.0, 230.0]


def test_quantities_of_pint() -> None:
    units = pytest.importorskip("pint").UnitRegistry(autoconvert_offset_to_baseunit=True)
    rod = {"material": "copper", "length": 12.74 * units.mm, "diameter": 0.48 * units.cm, "impact_velocity": 0.23 * units("mm/us"),
           "temperature": 293 * units.kelvin}
    case = percuss.Case(projectile=rod, target={**PLATE, "thickness": units("25 mm")})
    assert case.impact_velocity_m_s == pytest.approx(230.0, rel=1e-15)
    texts = percuss.Case(projectile={**COPPER, "temperature": "293 K"}, target=PLATE)
    assert quantities.text(units.Quantity(20, "degC")) == "293.15 K"
    assert quantities.text(750 * units.ft / units.s) == "228.6 m/s"
    assert percuss.run(case).depth_of_penetration_mm == pytest.approx(percuss.run(texts).depth_of_penetration_mm, rel=1e-9)
    with pytest.raises(percuss.CaseError, match="but a length is due here"):
        case.replace({"projectile.diameter": 3 * units.kg})


def test_quantities_of_astropy() -> None:
    units = pytest.importorskip("astropy.units")
    assert quantities.text(20 * units.deg_C) == "293.15 K"
    assert quantities.text(750 * units.imperial.ft / units.s) == "228.6 m/s"
    rod = {"material": "copper", "length": 12.74 * units.mm, "diameter": 0.48 * units.cm, "impact_velocity": 0.23 * units.km / units.s}
    case = percuss.Case(projectile=rod, target={**PLATE, "thickness": 25 * units.mm})
    assert case.impact_velocity_m_s == pytest.approx(230.0, rel=1e-15)
    assert percuss.run(case).depth_of_penetration_mm == pytest.approx(percuss.run(percuss.Case(projectile=COPPER, target=PLATE)).depth_of_penetration_mm, rel=1e-9)
    with pytest.raises(percuss.CaseError, match="but a length is due here"):
        case.replace({"projectile.diameter": 3 * units.kg})


def test_a_quantity_keeps_all_its_bits() -> None:
    speed = 230.0 * (1 + 2**-50)
    case = percuss.Case(projectile={**COPPER, "impact_velocity": Pint(speed, meter=1, second=-1)}, target=PLATE)
    assert case.impact_velocity_m_s == speed
    assert percuss.Case.from_text(case.text).impact_velocity_m_s == speed


def test_values_are_read_and_set() -> None:
    case = percuss.Case("shot", projectile=COPPER, target=PLATE)
    other = case.replace({})
    assert case.projectile.impact_velocity == "230 m/s" and case.projectile.nose is None
    case.projectile.impact_velocity = "0.25 km/s"
    assert case.impact_velocity_m_s == 250.0 and other.impact_velocity_m_s == 230.0
    case.chain.target_elements = 40
    case.target = {"layers": [{"material": "6061-t6", "thickness": "5 mm"}, {"material": "6061-t6", "thickness": "9 mm"}]}
    case.target.layers[1].thickness = "10 mm"
    assert tomllib.loads(case.text)["target"]["layers"][1] == {"material": "6061-t6", "thickness": "10 mm"}
    assert case.chain.to_dict() == {"target_elements": 40} and repr(case.chain) == "<chain: target_elements=40>"
    del case.chain.target_elements
    case.title = "two plates"  # type: ignore[misc]
    assert case.chain.target_elements is None and case.title == "two plates"
    assert percuss.run(case, history=False).outcome


def test_a_nose_is_given_by_any_of_its_dimensions() -> None:
    case = percuss.Case("shot", projectile={**COPPER, "nose": {"cone": {"angle": "60 deg"}}}, target=PLATE)
    case.projectile.nose.cone.angle = "90 deg"
    assert tomllib.loads(case.text)["projectile"]["nose"] == {"cone": {"angle": "90 deg"}}
    with pytest.raises(percuss.CaseError, match="given where just one can be"):
        case.projectile.nose = {"cone": {"angle": "90 deg", "half_angle": "45 deg"}}


def test_what_is_set_is_checked_at_once_and_refused_without_a_trace() -> None:
    case = percuss.Case("shot", projectile=COPPER, target=PLATE)
    before = case.text
    for value, words in [(250.0, "the unit is missing"), ("4 kg", "a length is due here"), ("40 m", "allowed"), (None, "diameter")]:
        with pytest.raises(percuss.CaseError, match=words):
            case.projectile.diameter = value
    with pytest.raises(percuss.CaseError, match="impact_velocity"):
        case.projectile.velocity = "230 m/s"
    with pytest.raises(AttributeError, match="`projectile` has no `colour`; it has: diameter"):
        _ = case.projectile.colour
    with pytest.raises(AttributeError, match="a case has no `projectil`; its tables: .*projectile"):
        _ = case.projectil
    assert case.text == before


def test_completion_names_tables_and_their_keys() -> None:
    case = percuss.Case("shot", projectile=COPPER, target=PLATE)
    assert {"projectile", "target", "chain", "gauges", "impact_velocity_m_s", "save"} <= set(dir(case))
    assert {"impact_velocity", "diameter", "nose"} <= set(dir(case.projectile))
    assert {"material", "thickness", "layers"} <= set(dir(case.target))
    assert {"interface"} <= set(dir(case.chain.published))


def test_a_case_can_be_written_changed_and_sent(tmp_path: Path, program: Program) -> None:
    case = percuss.Case("shot", projectile=COPPER, target=PLATE, chain=None)
    case.save(tmp_path / "shot.toml")
    assert f"{percuss.run(case).depth_of_penetration_mm}" in program("run", tmp_path / "shot.toml", "--fast", "--json").stdout
    faster = case.replace({"projectile.impact_velocity": "400 m/s", "chain.target_elements": 40})
    assert (faster.impact_velocity_m_s, case.impact_velocity_m_s) == (400.0, 230.0)
    assert tomllib.loads(faster.text)["chain"]["target_elements"] == 40
    sent = pickle.loads(pickle.dumps(faster))
    assert (sent.name, sent.text) == (faster.name, faster.text)
    assert repr(case) == "<Case shot, 230 m/s>" and "thickness" in case._repr_html_()


@pytest.mark.parametrize(
    ("value", "error", "words"),
    [
        (object(), TypeError, "`diameter`: a object has no place in a case"),
        (float("nan"), percuss.CaseError, "the unit is missing"),
        (2**70, ValueError, "`diameter`: the whole number is too large"),
        ("4.8 kg", percuss.CaseError, "`kg` is a unit of mass, but a length is due here"),
        ("-1 m", percuss.CaseError, "allowed"),
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
    assert steps is not None and usual["steps"] / 6 < steps < usual["steps"] * 6
    fine = case.replace({"chain.projectile_elements": 100_000, "chain.target_elements": 100_000})
    assert fine.estimate("chain")["seconds"] > 1000 and fine.estimate("chain")["memory_bytes"] > 1e8
    with pytest.raises(percuss.NotApplicableError, match="memory"):
        case.replace({"projectile.length": "5 m", "axi.cells_per_radius": 60}).estimate("axi")
