"""Uncertainties and calibrations: the numbers of the program, and the samples behind them."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path
from typing import Any

import numpy
import percuss
import pytest
from conftest import ROOT, Program, of_arguments

SPREAD = "cases/paper-table1-uncertainty/scenario.toml"
BAD = sorted(path.relative_to(ROOT) for path in ROOT.glob("crates/percuss-cli/tests/bad-uncertainties/*.toml"))
COEFFICIENT = "materials.copper-woodward.strength.power_law.coefficient"
WILKINS: dict[str, Any] = {"data": "builtin", "source": "wilkins1973", "model": "wilkins_guinan"}
SMALL: dict[str, Any] = {"ensembles": 2, "walkers": 4, "steps": 15}


def words(options: dict[str, Any]) -> list[str]:
    """Options as the command line has them."""
    return [word for name, value in options.items() for word in (f"--{name.replace('_', '-')}", str(value))]


def answer(program: Program, *line: str) -> Any:
    said = program(*line, "--json")
    assert said.returncode == 0, said.stderr
    return json.loads(said.stdout)


def small_spread() -> percuss.Case:
    """The case of the worked example on a coarse mesh."""
    return percuss.load(SPREAD).replace({"chain.projectile_elements": 8, "chain.target_elements": 12})


def test_an_uncertainty_is_that_of_the_program(program: Program, tmp_path: Path) -> None:
    case = small_spread()
    case.save(tmp_path / f"{case.name}.toml")
    line = ["uncertainty", str(tmp_path / f"{case.name}.toml"), "--samples", "16", "--seed", "3", "--velocity", "200,230.5"]
    theirs = answer(program, *line, "--quantity", "peak_force_kn", "--quantity", "depth_of_penetration_mm", "--out", str(tmp_path / "out"))
    options: dict[str, Any] = {"samples": 16, "seed": 3, "velocity": [200, 230.5]}
    ours = percuss.uncertainty(case, **options, quantity=["peak_force_kn", "depth_of_penetration_mm"])
    assert ours.to_dict() == theirs
    # From the file as well, with other threads.
    again = percuss.uncertainty(tmp_path / f"{case.name}.toml", **options, quantity="peak_force_kn", threads=1)
    assert again.quantities == ours.quantities[:1]

    import pandas

    written = pandas.read_csv(tmp_path / "out/samples.csv")
    draws = ours.draws
    assert draws.names() == [name for name in written.columns if name not in ("outcome", "error")]
    assert draws.outcome == written["outcome"].tolist() and len(draws) == 16
    for name in draws.names():
        array = draws[name]
        assert numpy.array_equal(array, written[name], equal_nan=True), name
        assert not array.flags.owndata and not array.flags.writeable
        assert numpy.shares_memory(array, numpy.asarray(ours._native.column(name)))
    assert draws.to_pandas()["outcome"].tolist() == draws.to_arrow()["outcome"].to_pylist() == draws.outcome
    depth = draws.depth_of_penetration_mm
    assert ours.percentile(50, "depth_of_penetration_mm") == pytest.approx(numpy.median(depth), rel=1e-12)


@pytest.mark.parametrize("path", BAD, ids=lambda path: path.stem)
def test_a_bad_uncertainty_is_refused_in_the_words_of_the_program(path: Path, program: Program) -> None:
    printed = program("uncertainty", path)
    for read in (lambda: path, lambda: percuss.load(path)):
        with pytest.raises(percuss.CaseError) as caught:
            percuss.uncertainty(read())
        assert str(caught.value) == printed.stderr.rstrip() and printed.returncode == 2


def test_a_material_whose_id_is_digits_can_be_uncertain(program: Program, tmp_path: Path) -> None:
    key = "materials.4340.strength.perfectly_plastic.flow_stress"
    steel = {
        "name": "4340",
        "density": "7.85 g/cm3",
        "youngs_modulus": "200 GPa",
        "poissons_ratio": 0.29,
        "strength": {"perfectly_plastic": {"flow_stress": "900 MPa"}},
    }
    case = percuss.Case(
        "rod",
        projectile={"material": "4340", "length": "25 mm", "diameter": "7.6 mm", "impact_velocity": "200 m/s"},
        target={"rigid_wall": True},
        materials={"4340": steel},
        uncertainty={"parameter": [{"key": key, "normal": {"mean": "900 MPa", "standard_deviation": "50 MPa"}}]},
    )
    found = percuss.uncertainty(case, model="taylor", samples=16)
    assert found.inputs[0].key == key and found.failures.runs == 0
    case.save(tmp_path / "rod.toml")
    assert found.to_dict() == answer(program, "uncertainty", str(tmp_path / "rod.toml"), "--model", "taylor", "--samples", "16")
    # The length left rises with the flow stress.
    order = numpy.argsort(found.draws[f"{key}_mpa"])
    assert numpy.all(numpy.diff(found.draws.projectile_final_length_mm[order]) > 0)


def test_what_is_not_there_is_said() -> None:
    case = small_spread()
    found = percuss.uncertainty(case, samples=16, no_indices=True)
    with pytest.raises(KeyError, match="quantities: depth_of_penetration_mm"):
        found.quantity("depth")
    with pytest.raises(ValueError, match="percentiles: 1, 5"):
        found.percentile(17)
    with pytest.raises(ValueError, match="not asked for"):
        found.plot_indices()
    for plot in (found.plot_bands, found.plot_perforation):
        with pytest.raises(ValueError, match="give it a `velocity`"):
            plot()
    with pytest.raises(percuss.UsageError, match="no run of model `chain` has a value of ballistic_limit_m_s"):
        percuss.uncertainty(case, samples=16, no_indices=True, quantity="ballistic_limit_m_s")
    with pytest.raises(percuss.UsageError, match="from 16 to 1048576"):
        percuss.uncertainty(case, samples=3)
    with pytest.raises(percuss.NotApplicableError):
        percuss.uncertainty(case, samples=16, model="taylor")


def test_a_calibration_is_that_of_the_program(program: Program, tmp_path: Path) -> None:
    import pyarrow.parquet

    fit = f"{COEFFICIENT}=150..900 MPa"
    line = ["calibrate", *words(WILKINS | SMALL), "--hold-out", "zelepugin2023", "--seed", "5", "--fit", fit]
    theirs = answer(program, *line, "--out", str(tmp_path / "out"))
    ours = percuss.calibrate(fit={COEFFICIENT: "150..900 MPa"}, hold_out="zelepugin2023", seed=5, **WILKINS, **SMALL)
    assert ours.to_dict() == theirs
    written = pyarrow.parquet.read_table(tmp_path / "out/sample.parquet")
    sample = ours.sample
    assert sample.names() == written.column_names and len(sample) == written.num_rows == 120
    for name in sample.names():
        array = sample[name]
        assert numpy.array_equal(array, written[name].to_numpy()), name
        assert not array.flags.owndata and not array.flags.writeable
    assert not sample.outcome

    # The material that comes of it is that of the program's file, and a case can use it.
    ours.save_materials(tmp_path / "mine.toml")
    assert tomllib.loads((tmp_path / "mine.toml").read_text()) == tomllib.loads((tmp_path / "out/material.toml").read_text())
    (name,) = ours.materials
    shot = {"material": name, "length": "23.47 mm", "diameter": "7.62 mm", "impact_velocity": "183 m/s"}
    wall = {"rigid_wall": True}
    runs = [
        percuss.run(percuss.Case(projectile=shot, target=wall, **materials), "wilkins_guinan")
        for materials in ({"materials": ours.to_dict()["materials"]}, {"material_files": [tmp_path / "mine.toml"]})
    ]
    assert runs[0].projectile_final_length_mm == runs[1].projectile_final_length_mm
    (best,) = [p.best for p in ours.predictions if p.impact_velocity_m_s == 183]
    assert runs[0].projectile_final_length_mm == pytest.approx(best, rel=1e-5)


def test_cases_and_priors_in_code_are_those_of_files(program: Program, tmp_path: Path) -> None:
    runs = [
        percuss.Case(
            f"shot-{i}",
            projectile={"material": "copper", "length": "23.47 mm", "diameter": "7.62 mm", "impact_velocity": velocity},
            target={"rigid_wall": True},
            experiments=[{"impact_velocity": velocity, "projectile_final_length": length, "source": "wilkins1973"}],
        )
        for i, (velocity, length) in enumerate([("183 m/s", "16.81 mm"), ("150 m/s", "18.5 mm")])
    ]
    key = "taylor.dynamic_yield_stress"
    prior = {"normal": {"mean": "400 MPa", "standard_deviation": "200 MPa", "min": "50 MPa"}}
    (tmp_path / "fit.toml").write_text(percuss._percuss.toml_text({"parameter": [{"key": key, **prior}]}))
    for shot in runs:
        shot.save(tmp_path / f"{shot.name}.toml")
    line = ["calibrate", *(str(tmp_path / f"{shot.name}.toml") for shot in runs), "--fit", str(tmp_path / "fit.toml")]
    theirs = answer(program, *line, "--model", "taylor", "--noise", "2 %", "--least-squares")
    for fit in ({key: prior}, tmp_path / "fit.toml"):
        for noise in ("2 %", 0.02):
            ours = percuss.calibrate(runs, fit=fit, model="taylor", noise=noise, least_squares=True)
            assert ours.to_dict() == theirs
    assert ours.parameter("dynamic_yield_stress") == ours.parameter() and ours.materials.keys() == []
    with pytest.raises(ValueError, match="was not sampled"):
        _ = ours.sample


def test_a_bad_calibration_is_refused_in_the_words_of_the_program(program: Program, tmp_path: Path) -> None:
    cases: list[tuple[Any, dict[str, Any], type[Exception]]] = [
        ({COEFFICIENT: "150..900 mm"}, {}, percuss.CaseError),
        ({"materials.ofhc-coper.density": "8..9 g/cm3"}, {}, percuss.MaterialError),
        ("a", {}, percuss.CaseError),
        ("nothing.toml", {}, percuss.ReadError),
        ({COEFFICIENT: "150..900 MPa"}, {"hold_out": "nobody1999"}, percuss.UsageError),
        ({COEFFICIENT: "150..900 MPa"}, {"noise": "stated"}, percuss.UsageError),
        ({COEFFICIENT: "150..900 MPa"}, {"walkers": 5}, percuss.UsageError),
    ]
    for fit, more, error in cases:
        text = fit if isinstance(fit, str) else "=".join(next(iter(fit.items())))
        printed = program("calibrate", *words(WILKINS | more), "--fit", text)
        with pytest.raises(error) as caught:
            percuss.calibrate(fit=fit, **WILKINS, **more)
        assert str(caught.value) == of_arguments(printed.stderr), text
    with pytest.raises(percuss.CaseError, match="fit.toml:6"):
        percuss.calibrate(fit={COEFFICIENT: {"normal": {"mean": "400 m", "standard_deviation": "20 MPa"}}}, **WILKINS)
    with pytest.raises(percuss.UsageError, match="is not a prior"):
        percuss.calibrate(fit={COEFFICIENT: 3.0}, **WILKINS)  # type: ignore[dict-item]
    with pytest.raises(KeyError, match="names no single parameter"):
        percuss.calibrate(fit={COEFFICIENT: "150..900 MPa"}, least_squares=True, **WILKINS).parameter("exponent")


def test_progress_rises_and_can_end_a_study() -> None:
    class Enough(Exception):
        pass

    heard: list[float] = []

    def hear(fraction: float, _words: str) -> None:
        heard.append(fraction)
        if len(heard) == 3:
            raise Enough

    with pytest.raises(Enough):
        percuss.uncertainty(percuss.load(SPREAD), samples=4096, progress=hear)
    assert heard == sorted(heard) and 0.0 <= heard[-1] < 1.0
    heard.clear()
    with pytest.raises(Enough):
        percuss.calibrate(fit={COEFFICIENT: "150..900 MPa"}, steps=100000, progress=hear, **WILKINS)
    assert heard == sorted(heard) and 0.0 <= heard[-1] < 1.0
