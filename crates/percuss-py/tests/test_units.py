"""Unit systems of tables, libraries that are not there, and results at a glance."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import percuss
import pytest

CASE = "cases/paper-table1/scenario.toml"


@pytest.fixture(scope="module")
def run() -> percuss.RunResult:
    return percuss.run(CASE)


# Millimetres, metres per second and kilonewtons in each system.
SYSTEMS = {
    "SI": ("m", 1e-3, "m_s", 1.0, "n", 1e3),
    "mm-ms-kN": ("mm", 1.0, "mm_ms", 1.0, "kn", 1.0),
    "cm-g-us": ("cm", 0.1, "cm_us", 1e-4, "mbar_cm2", 1e-4),
    "in-lb-s": ("in", 1 / 25.4, "in_s", 1 / 0.0254, "lbf", 1e3 / 4.4482216152605),
}


@pytest.mark.parametrize("system", SYSTEMS)
def test_tables_are_in_the_units_of_a_system(run: percuss.RunResult, system: str) -> None:
    length, per_mm, velocity, per_m_s, force, per_kn = SYSTEMS[system]
    row = run.to_pandas(units=system).iloc[0]
    assert row[f"depth_of_penetration_{length}"] == pytest.approx((run.depth_of_penetration_mm or 0) * per_mm, rel=1e-12)
    assert row[f"impact_velocity_{velocity}"] == pytest.approx(230.0 * per_m_s, rel=1e-12)
    assert row[f"peak_force_{force}"] == pytest.approx((run.peak_force_kn or 0) * per_kn, rel=1e-12)
    assert row["energy_residual"] == run.energy_residual and row["outcome"] == run.outcome
    history = run.history.to_pandas(units=system)
    assert history[f"depth_{length}"].to_numpy() == pytest.approx(run.history.depth_mm * per_mm, rel=1e-12)
    assert run.history.to_arrow(units=system).column_names == list(history.columns)


def test_the_program_writes_the_tables_of_a_system(run: percuss.RunResult, tmp_path: Path) -> None:
    pandas = pytest.importorskip("pandas")
    percuss.run(CASE, out=tmp_path / "run", units="in-lb-s")
    written = pandas.read_csv(tmp_path / "run/history.csv")
    expected = run.history.to_pandas(units="in-lb-s")
    assert list(written.columns) == list(expected.columns)
    assert written["contact_force_lbf"].to_numpy() == pytest.approx(expected["contact_force_lbf"].to_numpy(), rel=1e-12)
    assert "stress_psi" in pandas.read_csv(tmp_path / "run/final-profile.csv").columns
    assert "stress_psi" in pandas.read_parquet(tmp_path / "run/profiles.parquet").columns
    percuss.compare(CASE, model="chain", out=tmp_path / "compare", units="SI")
    assert "depth_of_penetration_m" in pandas.read_csv(tmp_path / "compare/compare.csv").columns


def test_rows_of_a_sweep_are_merged_in_the_units_of_a_system(tmp_path: Path) -> None:
    pandas = pytest.importorskip("pandas")
    speeds = {"key": "projectile.impact_velocity", "values": ["200 m/s", "230 m/s", "300 m/s"]}
    walls = {"key": "target.thickness", "values": ["3 mm", "25 mm"]}
    rows = percuss.sweep({"base": percuss.load(CASE), "model": "chain", "design": "grid", "parameter": [speeds, walls]}, tmp_path / "rows")
    assert rows.merge(tmp_path / "inches.parquet", units="in-lb-s") == 6
    merged, plain = pandas.read_parquet(tmp_path / "inches.parquet"), rows.to_pandas()
    assert merged.equals(rows.to_pandas(units="in-lb-s"))
    assert len(merged.columns) == len(plain.columns)
    for name, own, factor in [("depth_of_penetration_in", "depth_of_penetration_mm", 1 / 25.4), ("residual_velocity_in_s", "residual_velocity_m_s", 1 / 0.0254)]:
        assert merged[name].isna().tolist() == plain[own].isna().tolist()
        assert merged[name].dropna().to_numpy() == pytest.approx(plain[own].dropna().to_numpy() * factor, rel=1e-12)
    assert merged["outcome"].tolist() == plain["outcome"].tolist()
    rows.merge(tmp_path / "own.parquet")
    assert pandas.read_parquet(tmp_path / "own.parquet").equals(plain)


def test_an_unknown_system_is_refused_with_those_there_are(run: percuss.RunResult) -> None:
    for wrong in (lambda: run.to_pandas(units="furlong"), lambda: run.history.to_arrow(units="furlong")):
        with pytest.raises(percuss.UsageError, match="`furlong` is no unit system; unit systems: .*mm-kg-ms.*SI"):
            wrong()


def test_results_become_datasets(run: percuss.RunResult, tmp_path: Path) -> None:
    pytest.importorskip("xarray")
    history = run.history.to_xarray()
    assert dict(history.sizes) == {"sample": len(run.history)} and list(history.coords) == ["time_us"]
    assert history.depth_mm.attrs == {"units": "mm"} and (history.depth_mm.to_numpy() == run.history.depth_mm).all()
    metres = run.history.to_xarray(units="SI")
    assert metres.depth_m.attrs == {"units": "m"} and list(metres.coords) == ["time_s"]
    models = percuss.compare(CASE, model=["chain", "taylor"]).to_xarray()
    assert models.model.to_numpy().tolist() == ["chain", "taylor"] and "depth_of_penetration_mm" in models
    speeds = {"key": "projectile.impact_velocity", "values": ["200 m/s", "230 m/s"]}
    rows = percuss.sweep({"base": percuss.load(CASE), "model": "chain", "design": "grid", "parameter": [speeds]}, tmp_path / "rows").to_xarray()
    assert rows.impact_velocity_m_s.to_numpy().tolist() == [200.0, 230.0] and list(rows.coords) == ["run"]


@pytest.mark.parametrize("name", ["pandas", "pyarrow", "xarray", "matplotlib"])
def test_a_library_that_is_not_there_is_named_with_the_remedy(run: percuss.RunResult, name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    for module in [module for module in sys.modules if module == name or module.startswith(f"{name}.")]:
        monkeypatch.delitem(sys.modules, module)
    monkeypatch.setitem(sys.modules, name, None)
    uses: dict[str, list[Any]] = {
        "pandas": [run.to_pandas, run.history.to_pandas, percuss.models().to_pandas],
        "pyarrow": [run.to_arrow, run.history.to_arrow],
        "xarray": [run.to_xarray, run.history.to_xarray],
        "matplotlib": [run.plot, run.plot_stress],
    }
    for use in uses[name]:
        with pytest.raises(percuss.LibraryError, match=rf"this needs {name}, .*\nhelp: install it with `pip install {name}`"):
            use()


def test_results_show_what_matters_first(run: percuss.RunResult) -> None:
    assert repr(run).startswith("RunResult(rebounded; depth of penetration 0.208 mm; ")
    history = repr(run.history)
    assert " samples, " in history and "to 41.8 µs, largest depth 0.227 mm; units: µs, m/s, mm, kN" in history
    assert repr(run.history.profiles[-1]).startswith("<Profile at 41.8 µs, ") and "units: mm, MPa, K, m/s>" in repr(run.history.profiles[-1])
    assert "rebounded; depth of penetration 0.208 mm" in run._repr_html_().split("</table>")[0]
    compared = percuss.compare(CASE, model=["chain", "taylor"])
    assert repr(compared).startswith("Comparison(recommended: chain, depth of penetration 0.208 mm; case paper-table1")
    spread = percuss.uncertainty("cases/paper-table1-uncertainty/scenario.toml", samples=16, no_indices=True)
    assert "(5 to 95 %: " in repr(spread) and "16 samples" in repr(spread)
    assert repr(spread.draws).startswith("<Sample of 16 rows, ") and "units: " in repr(spread.draws)
