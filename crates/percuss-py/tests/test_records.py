"""Results: typed names, tables, figures and what a notebook shows."""

from __future__ import annotations

import copy
import json
import pickle
import typing
from functools import cached_property
from pathlib import Path
from typing import Any

import matplotlib.pyplot
import percuss
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from percuss import _percuss
from percuss.record import Record
from test_folders import REFERENCE

CASE = "cases/paper-table1/scenario.toml"


def save(axes: Axes, path: Path) -> None:
    figure = axes.figure
    assert isinstance(figure, Figure)
    figure.savefig(path)
    matplotlib.pyplot.close(figure)


@pytest.fixture(scope="module")
def records(tmp_path_factory: pytest.TempPathFactory) -> dict[type[Record], list[Record]]:
    case = Path(__file__).resolve().parents[3] / CASE
    wall = case.parents[1] / "taylor-copper-wilkins/scenario.toml"
    plate = case.parents[1] / "weldox-460e-12mm-blunt/scenario.toml"
    spread = percuss.load(case.parents[1] / "paper-table1-uncertainty/scenario.toml")
    spread = spread.replace({"chain.projectile_elements": 8, "chain.target_elements": 12})
    law = "materials.copper-woodward.strength.power_law"
    folder = tmp_path_factory.mktemp("tests")
    tests, reference = folder / "tests.csv", folder / "reference.csv"
    reference.write_text(REFERENCE)
    tests.write_text("impact_velocity_m_s,perforated\n180,no\n186,yes\n184,no\n183,yes\n190,yes\n178,no\n")
    coefficient = {f"{law}.coefficient": "150..900 MPa"}
    copper: dict[str, Any] = {"data": "builtin", "source": "wilkins1973", "model": "wilkins_guinan"}
    return {
        percuss.RunResult: [percuss.run(case), percuss.run(wall, "taylor", history=False)],
        percuss.Comparison: [percuss.compare(case), percuss.compare(case, velocity="200..400:3")],
        percuss.Limits: [percuss.limit(plate, model=["plugging", "recht_ipson", "tate"], tests=tests)],
        percuss.Convergence: [percuss.converge(wall, levels=3)],
        percuss.Validation: [percuss.validate(model="taylor", kind="taylor")],
        percuss.Uncertainty: [percuss.uncertainty(spread, samples=16, velocity=[150, 230])],
        percuss.Calibration: [
            percuss.calibrate(fit={**coefficient, f"{law}.exponent": (0.02, 0.4)}, **copper, ensembles=2, walkers=6, steps=20),
            percuss.calibrate(fit=coefficient, **copper, least_squares=True),
        ],
        percuss.Benchmark: [percuss.benchmark(reference=reference)],
        percuss.Reproduction: [percuss.reproduce("paper")],
        percuss.Material: [percuss.material("copper"), *percuss.materials()],
        percuss.Model: list(percuss.models()),
    }


def test_types_know_the_names_of_the_program(records: dict[type[Record], list[Record]]) -> None:
    for kind, all_of_kind in records.items():
        typed = {name for name in typing.get_type_hints(kind) if not name.startswith("_")}
        for record in all_of_kind:
            missing = typed - set(record.keys())
            assert not missing, f"{kind.__name__} promises {missing}"


def test_the_values_of_a_run_are_those_of_the_library(records: dict[type[Record], list[Record]]) -> None:
    fields = _percuss.result_fields()
    names = {field.name for field in fields}
    types = {"str": str, "float": float, "int": int, "list": list, "Record": Record, "None": type(None)}
    assert len(names) == len(fields) > 40
    for run in records[percuss.RunResult]:
        assert set(run.keys()) == names | {"case", "percuss_version", "axisymmetric", "seeds"}
        for field in fields:
            kinds = tuple(types[word.split()[0]] for word in field.kind.split(" or "))
            assert isinstance(getattr(run, field.name), kinds), field.name
    described = percuss.RunResult.__doc__ or ""
    assert set(typing.get_type_hints(percuss.RunResult)) >= names
    added = {name for name, value in vars(percuss.RunResult).items() if isinstance(value, cached_property)}
    assert added == names
    for field in fields:
        assert field.description in (vars(percuss.RunResult)[field.name].__doc__ or "")
        assert f"\n    {field.name} : {field.kind}\n" in described
    assert "{" not in described


def test_records_become_tables(records: dict[type[Record], list[Record]]) -> None:
    for kind, all_of_kind in records.items():
        for record in all_of_kind:
            if not hasattr(kind, "to_pandas"):
                continue
            frame, table = record.to_pandas(), record.to_arrow()
            assert len(frame) == table.num_rows > 0 and list(frame.columns) == table.column_names
    (run, _) = records[percuss.RunResult]
    assert run.to_pandas()["depth_of_penetration_mm"].tolist() == [run.depth_of_penetration_mm]
    history = run.history
    assert history.to_pandas()["depth_mm"].tolist() == history.to_arrow()["depth_mm"].to_pylist() == history.depth_mm.tolist()
    assert len(history) == len(history.time_us)


def test_records_are_shown_and_drawn(records: dict[type[Record], list[Record]], tmp_path: Path) -> None:
    for all_of_kind in records.values():
        for i, record in enumerate(all_of_kind):
            text = record._repr_html_()
            assert text.startswith("<table>") and text.endswith("</table>") and "<script" not in text
            assert repr(record).startswith(f"{type(record).__name__}(")
            assert not isinstance(record, percuss.Result) or len(repr(record)) < 600
            if hasattr(record, "plot") and not (isinstance(record, percuss.RunResult) and i == 1):
                axes = record.plot()
                assert (axes.get_xlabel() or axes.get_title()) and (axes.lines or axes.patches)
                save(axes, tmp_path / f"{type(record).__name__}-{i}.png")
    (run, _) = records[percuss.RunResult]
    assert isinstance(run, percuss.RunResult)
    assert run.plot("contact_force_kn").get_ylabel() == "Contact force (kN)"
    assert run.plot_stress().get_ylabel() == "Time (us)"
    (spread,) = records[percuss.Uncertainty]
    assert isinstance(spread, percuss.Uncertainty)
    drawn = [spread.plot_tornado(), spread.plot_indices(), spread.plot_bands(), spread.plot_perforation()]
    (limits,) = records[percuss.Limits]
    assert isinstance(limits, percuss.Limits)
    drawn.append(limits.plot_v50())
    (benchmark,) = records[percuss.Benchmark]
    assert isinstance(benchmark, percuss.Benchmark)
    for by in ("speed", "length", "regime", "materials", "uncertainty"):
        assert {error.candidate for error in benchmark.errors(by)} == {error.candidate for error in benchmark.errors()}
        save(benchmark.plot(by), tmp_path / f"{by}.png")
    with pytest.raises(percuss.UsageError, match="groups: speed, length"):
        benchmark.plot("moon")
    (found, _) = records[percuss.Calibration]
    assert isinstance(found, percuss.Calibration)
    drawn += [found.plot_posterior("coefficient"), found.plot_posterior("scatter"), found.plot_pair("coefficient", "exponent")]
    for i, axes in enumerate(drawn):
        assert axes.get_xlabel() and axes.get_legend() is not None
        save(axes, tmp_path / f"study-{i}.png")


def test_lists_are_tables() -> None:
    for listed in (percuss.materials(), percuss.models()):
        assert len(listed.to_pandas()) == listed.to_arrow().num_rows == len(listed) > 10
        assert listed._repr_html_().count("<tr>") == len(listed) + 1


def test_what_was_not_asked_for_is_not_drawn(tmp_path: Path) -> None:
    tests = tmp_path / "tests.csv"
    tests.write_text("impact_velocity_m_s,perforated\n180,no\n186,yes\n184,no\n183,yes\n")
    limits = percuss.limit(tests=tests)
    assert limits.to_pandas().empty and limits.plot_v50().lines
    with pytest.raises(ValueError, match="no case was searched"):
        limits.plot()
    with pytest.raises(ValueError, match="no test results were given"):
        percuss.limit("cases/weldox-460e-12mm-blunt/scenario.toml", model="plugging", points=0).plot_v50()


def test_damping_is_drawn_by_way_of_damping() -> None:
    class Answer:
        """What the study prints, which takes half a minute; a test of the program holds the names."""

        def json(self) -> str:
            shot = {"damping": "none", "impact_velocity_m_s": 230.0, "projectile_elements": 40, "depth_of_penetration_mm": 0.2}
            way = {**shot, "damping": "ratio 0.1", "depth_of_penetration_mm": 0.1}
            reference = [{"impact_velocity_m_s": 230.0, "depth_of_penetration_mm": 0.25}]
            return json.dumps({"work": "damping", "findings": ["less"], "runs": [shot, way], "reference": reference})

        def files(self) -> list[str]:
            return []

    study = percuss.Reproduction(Answer())  # type: ignore[arg-type]
    assert [line.get_label() for line in study.plot().lines] == ["none", "ratio 0.1", "axisymmetric reference"]
    assert len(study.to_pandas()) == 2 and "less" in study._repr_html_()


def test_text_of_a_case_cannot_become_markup() -> None:
    record = Record({"name": "<script>alert(1)</script>"})
    assert "<script" not in record._repr_html_()


def test_a_misspelt_name_says_which_there_are() -> None:
    run = percuss.run(CASE, history=True)
    with pytest.raises(AttributeError, match="depth_of_penetration_mm"):
        _ = run.depth_of_penetration
    with pytest.raises(AttributeError, match="columns: time_us, step"):
        _ = run.history.depth
    with pytest.raises(KeyError, match="no column"):
        _ = run.history["depth"]
    assert "outcome" in dir(run) and "depth_mm" in dir(run.history)


def test_records_are_copied_and_pickled() -> None:
    result = percuss.run(CASE)
    error = result.expected_error
    assert isinstance(error, Record)
    assert copy.copy(error) == copy.deepcopy(error) == pickle.loads(pickle.dumps(error)) == error
    assert copy.copy(result).depth_of_penetration_mm == result.depth_of_penetration_mm
    assert copy.copy(result.history.si).names() == result.history.si.names()
    # What is taken out is a copy.
    table = result.to_dict()
    table.clear()
    assert "depth" in repr(result)


def test_a_formula_has_no_history() -> None:
    result = percuss.run(CASE, model="crater_energy")
    assert not hasattr(result, "history")
    with pytest.raises(AttributeError, match="`crater_energy` has no history"):
        result.history


def test_the_table_of_a_gauge_has_its_times() -> None:
    case = percuss.load(CASE).replace({"gauges": [{"name": "rod", "position": "-6 mm"}]})
    gauge = percuss.run(case).history.gauges["rod"]
    table = gauge.to_pandas(units="SI")
    assert table.columns[0] == "time_s" and gauge.names()[0] == "time_us"
    assert not gauge.time_us.flags.writeable and gauge.time_us is gauge.time_us


def test_whole_numbers_of_numpy_are_velocities() -> None:
    import numpy

    whole: Any = numpy.int64(200)
    found = percuss.compare(CASE, velocity=whole, fast=True)
    assert {record.impact_velocity_m_s for record in found.results} == {200.0}
    with pytest.raises(TypeError, match="velocity"):
        percuss.compare(CASE, velocity=True)
