"""The same case gives the same numbers as the program, to the last bit."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import numpy
import percuss
import pytest
from conftest import CASES, Program

MINE = {
    "name": "mine",
    "density": "8 g/cm3",
    "youngs_modulus": "100 GPa",
    "poissons_ratio": 0.3,
    "strength": {"perfectly_plastic": {"flow_stress": "300 MPa"}},
}


def answer(program: Program, *words: str) -> Any:
    """What the program prints. JSON holds as many digits as it takes to read a number back unchanged."""
    return json.loads(program(*words, "--json").stdout)


@pytest.mark.parametrize("case", CASES)
def test_a_run_gives_the_numbers_of_the_program(case: str, program: Program) -> None:
    path = f"cases/{case}/scenario.toml"
    # By a model that the case has expected values of.
    named = re.search(r'^model = "(\w+)"', Path(f"cases/{case}/expected.toml").read_text(), re.MULTILINE)
    model = named[1] if named else "chain"
    whole = answer(program, "run", path, "--model", model, "--fast")
    (result,) = whole.pop("results")
    assert percuss.run(path, model).to_dict() == whole | result
    assert percuss.run(percuss.load(path), model, history=False).to_dict() == whole | result


def test_a_run_without_a_model_takes_the_one_of_the_program(program: Program, tmp_path: Path) -> None:
    sharp = percuss.Case(
        projectile={
            "material": "4340",
            "length": "60 mm",
            "diameter": "8 mm",
            "nose": {"ogive": {"crh": 3.0}},
            "impact_velocity": "400 m/s",
        },
        target={"material": "6061-t6", "thickness": "semi-infinite"},
    )
    sharp.save(tmp_path / "sharp.toml")
    whole = answer(program, "run", str(tmp_path / "sharp.toml"), "--fast")
    (result,) = whole.pop("results")
    ran = percuss.run(tmp_path / "sharp.toml")
    assert ran.to_dict() == whole | result
    assert ran.model == percuss.compare(sharp, fast=True).recommended[0].models[0].model != "chain"
    assert ran.model_choice is not None and "instead of the default `chain`" in ran.model_choice
    with pytest.raises(percuss.NotApplicableError, match="it takes flat noses"):
        percuss.run(sharp, "chain")
    assert percuss.run(sharp.replace({"target": {"rigid_wall": True}})).model == "axi"
    layer = {"material": "6061-t6", "thickness": "4 mm"}
    apart = {"layers": [layer, layer | {"gap": "9 mm"}]}
    with pytest.raises(percuss.NotApplicableError, match="no model applies to this case"):
        percuss.run(sharp.replace({"target": apart}))


def test_the_axisymmetric_answer_is_that_of_the_program(program: Program, tmp_path: Path) -> None:
    case = percuss.Case(
        projectile={"material": "copper", "length": "5 mm", "diameter": "5 mm", "impact_velocity": "300 m/s"},
        target={"material": "aluminium-2024-t351", "thickness": "25 mm"},
        axi={"target_radius": "8 mm", "target_depth": "8 mm"},
    )
    case.save(tmp_path / "short.toml")
    whole = answer(program, "run", str(tmp_path / "short.toml"))
    (result,) = whole.pop("results")
    ran = percuss.run(tmp_path / "short.toml", reference="standard")
    assert ran.to_dict() == whole | result
    written = percuss.run(tmp_path / "short.toml", reference="standard", out=tmp_path / "out")
    assert written.to_dict() == ran.to_dict()
    found = ran.axisymmetric
    assert found is not None and found.quantity == "depth_of_penetration_mm"
    assert found.value > found.uncertainty > 0 and [mesh.cells_per_radius for mesh in found.meshes] == [3, 4, 6]
    said = re.search(r"axisymmetric depth of penetration ([\d.]+) ± ([\d.]+) mm \(3 meshes\)", repr(ran))
    assert said is not None and said.group(0).removeprefix("axisymmetric ") in ran._repr_html_()
    assert float(said.group(1)) == pytest.approx(found.value, rel=5e-3) and float(said.group(2)) == pytest.approx(found.uncertainty, rel=0.05)
    assert len(ran.history) > 2
    # Unless it is asked for, there is none.
    fast = percuss.run(case)
    assert fast.axisymmetric is None and "axisymmetric" not in fast._repr_html_()
    pressed = case.replace({"target": {"constant_pressure": "2 GPa"}, "axi": None, "projectile.material": "ofhc-copper"})
    refused = percuss.run(pressed, reference="fine").axisymmetric
    assert refused is not None and refused.value is None and "constant pressure" in refused.reason
    with pytest.raises(percuss.UsageError, match="`reference`"):
        percuss.run(case, model="fdm", reference="fine")
    with pytest.raises(percuss.UsageError, match="`reference`"):
        percuss.run(case, reference="finest")


def test_every_command_gives_the_answer_of_the_program(program: Program, tmp_path: Path) -> None:
    case = "cases/taylor-copper-wilkins/scenario.toml"
    loaded = percuss.load(case).replace({"materials.mine": MINE})
    loaded.save(tmp_path / "mine.toml")
    of_case = answer(program, "materials", "--case", str(tmp_path / "mine.toml"))
    for given in (loaded, tmp_path / "mine.toml"):
        listed = [m.to_dict() | {"origin": ""} for m in percuss.materials(case=given)]
        assert listed == [m | {"origin": ""} for m in of_case]
        assert percuss.material("mine", case=given).density == "8000 kg/m3"

    speeds = [150.0, 183.1]
    compared = percuss.compare(case, velocity=speeds, model=["chain", "taylor", "tate"])
    words = ["--velocity", "150,183.1", "--model", "chain", "--model", "taylor", "--model", "tate"]
    assert compared.to_dict() == answer(program, "compare", case, *words)

    plate = "cases/weldox-460e-12mm-blunt/scenario.toml"
    limits = percuss.limit(plate, model="plugging", velocity=(50, 400), tolerance=0.5, points=3)
    words = ["--model", "plugging", "--velocity", "50..400", "--tolerance", "0.5 m/s", "--points", "3"]
    assert limits.to_dict() == answer(program, "limit", plate, *words)

    assert limits.rear_face is not None and not limits.rear_face.assumed
    assert [m.to_dict() for m in percuss.materials("titanium")] == answer(program, "materials", "titanium")
    hard = percuss.materials("armour", group="steel", hardness=(350, 500))
    assert [m.to_dict() for m in hard] == answer(program, "materials", "armour", "--group", "steel", "--hardness", "350..500")
    curves = percuss.flow_curves("rha", "4340", rate=["1 1/s"], temperature="400 K")
    said = answer(program, "materials", "compare", "rha", "4340", "--rate", "1 1/s", "--temperature", "400 K")
    assert [c.to_dict() for c in curves] == said and len(curves) == 2
    assert percuss.flow_curves(["rha", "4340"], rate=["1 1/s"], temperature="400 K") == curves

    deck = tmp_path / "steel.k"
    text = percuss.export_materials("4340-johnson-cook", format="ls-dyna", units="mm-t-s", out=deck)
    assert text == deck.read_text(encoding="utf-8")
    imported = percuss.import_materials(deck, units="mm-t-s")
    assert imported.to_dict() == answer(program, "materials", "import", str(deck), "--units", "mm-t-s")
    [(name, steel)] = imported.records.to_dict().items()
    rod = {"material": name, "length": "25 mm", "diameter": "8 mm", "impact_velocity": "200 m/s"}
    own = percuss.run(percuss.Case(projectile=rod, target={"rigid_wall": True}, materials={name: steel}), model="taylor")
    known = percuss.run(
        percuss.Case(projectile=rod | {"material": "4340-johnson-cook"}, target={"rigid_wall": True}), model="taylor"
    )
    assert own.projectile_final_length_mm == pytest.approx(known.projectile_final_length_mm, rel=1e-2)
    with pytest.raises(percuss.CaseError, match="steel.k"):
        percuss.import_materials(deck, units="in-lbf-s")
    with pytest.raises(percuss.ReadError):
        percuss.import_materials(tmp_path / "gone.k", units="mm-t-s")

    tests = tmp_path / "tests.csv"
    tests.write_text("impact_velocity_m_s,perforated\n180,no\n186,yes\n184,no\n183,yes\n190,yes\n178,no\n")
    assert percuss.limit(tests=tests).to_dict() == answer(program, "limit", "--tests", str(tests))

    assert percuss.converge(case, levels=3).to_dict() == answer(program, "converge", case, "--levels", "3")
    validated = percuss.validate(model="taylor", kind="taylor")
    assert validated.to_dict() == answer(program, "validate", "--model", "taylor", "--kind", "taylor")
    assert [m.to_dict() for m in percuss.materials()] == answer(program, "materials")
    assert percuss.material("copper").to_dict() == answer(program, "materials", "show", "copper")
    assert [m.to_dict() for m in percuss.models()] == answer(program, "models")
    assert percuss.model("chain").to_dict() == answer(program, "models", "chain")
    assert percuss.schema() == json.loads(program("schema").stdout)
    assert percuss.reproduce("paper").to_dict() == answer(program, "reproduce", "paper")


def test_histories_are_those_of_the_program(program: Program, tmp_path: Path) -> None:
    import pyarrow.parquet

    case = "cases/paper-table1/scenario.toml"
    assert program("run", case, "--fast", "--out", tmp_path).returncode == 0
    written = pyarrow.parquet.read_table(tmp_path / "history.parquet")
    result = percuss.run(case)
    history = result.history
    assert history.names() == written.column_names
    for name, column in zip(history.names(), written.columns, strict=True):
        assert not history[name].flags.writeable
        assert numpy.array_equal(history[name], column.to_numpy(), equal_nan=True), name

    profile = history.profiles[-1]
    elements = pyarrow.parquet.read_table(tmp_path / "profiles.parquet").to_pandas()
    assert ["time_us", *profile.names()] == list(elements.columns)
    last = elements[elements["time_us"] == profile.time_us]
    for name in profile.names():
        assert numpy.array_equal(profile[name], last[name]), name


def test_gauges_are_those_of_the_program(program: Program, tmp_path: Path) -> None:
    import pandas

    text = Path("cases/paper-table1/scenario.toml").read_text()
    file = tmp_path / "gauges.toml"
    file.write_text(text + "\n[[gauges]]\nname = 'tip'\nposition = '-1 mm'\n[[gauges]]\nposition = '5 mm'\n")
    assert program("run", file, "--fast", "--out", tmp_path).returncode == 0
    written = pandas.read_csv(tmp_path / "gauges.csv")
    gauges = percuss.run(file).history.gauges
    assert list(gauges) == ["tip", "gauge 2"]
    for name, gauge in gauges.items():
        rows = written[written["gauge"] == name]
        assert numpy.array_equal(gauge.time_us, rows["time_us"])
        for column in gauge.names():
            assert numpy.array_equal(gauge[column], rows[column], equal_nan=True), column
        assert numpy.array_equal(gauge.si.velocity_m_s, gauge.velocity_m_s)


def test_columns_in_si_units_are_the_memory_of_the_result() -> None:
    result = percuss.run("cases/paper-table1/scenario.toml")
    history = result.history
    # Factors written by hand, from the SI unit of each name.
    factors = {"_us": ("_s", 1e6), "_mm": ("_m", 1e3), "_kn": ("_n", 1e-3), "_mpa": ("_pa", 1e-6)}
    for rows in (history, history.profiles[-1]):
        for name, si_name in zip(rows.names(), rows.si.names(), strict=True):
            end = next((end for end in factors if name.endswith(end)), None)
            si_end, factor = factors[end] if end else ("", 1.0)
            assert si_name == name.removesuffix(end or "") + si_end
            array = rows.si[si_name]
            assert not array.flags.owndata and not array.flags.writeable
            assert numpy.array_equal(array * factor, rows[name], equal_nan=True), name
    assert list(history.si.to_pandas().columns) == history.si.names()
    # Two arrays of one column are the same memory, and neither is a copy of the other.
    again = numpy.asarray(result._native.sample_column("depth_m"))
    assert numpy.shares_memory(history.si.depth_m, again)


def test_a_column_by_its_name_in_si_units_names_the_new_one() -> None:
    history = percuss.run("cases/paper-table1/scenario.toml").history
    with pytest.raises(AttributeError, match="`depth_mm` is in mm, and `si.depth_m` in SI units"):
        _ = history.depth_m
    with pytest.raises(KeyError, match="`contact_force_kn` is in kN"):
        _ = history["contact_force_n"]
    with pytest.raises(AttributeError, match="`stress_mpa` is in MPa"):
        _ = history.profiles[0].stress_pa
    with pytest.raises(AttributeError, match="`time_us` is in us"):
        _ = history.profiles[0].time_s


def test_arrays_outlive_their_result() -> None:
    depth = percuss.run("cases/paper-table1/scenario.toml").history.si.depth_m
    expected = depth.copy()
    for _ in range(20):
        percuss.run("cases/paper-table1/scenario.toml")
    assert numpy.array_equal(depth, expected)


def test_a_formula_has_no_history() -> None:
    result = percuss.run("cases/taylor-copper-wilkins/scenario.toml", "taylor")
    with pytest.raises(AttributeError, match="has no history"):
        _ = result.history


def test_a_mesh_within_a_tolerance_is_that_of_the_program(program: Program) -> None:
    path = "cases/paper-table1/scenario.toml"
    whole = answer(program, "run", path, "--fast", "--mesh-tolerance", "1%")
    (result,) = whole.pop("results")
    found = percuss.run(path, mesh_tolerance="1%").to_dict()
    assert found == whole | result
    chosen = {detail["name"]: detail["value"] for detail in found["details"]}
    assert chosen["tolerance of the mesh error"] == 1 > chosen["estimated mesh error of the main number"] > 0
    with pytest.raises(percuss.PercussError, match="allowed: 0.01 to 50 percent"):
        percuss.run(path, mesh_tolerance="1")
    with pytest.raises(percuss.UsageError, match="needs laws of the library"):
        percuss.run(path, mesh_tolerance="1%", target_law=lambda strain, rate, temperature: 300e6)
