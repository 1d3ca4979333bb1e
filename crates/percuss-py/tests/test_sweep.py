"""Sweeps: the folders of the program, bit for bit."""

from __future__ import annotations

import gc
import hashlib
import json
from pathlib import Path
from typing import Any

import percuss
import pytest
from conftest import Program, content

# Small enough for a test.
SWEEP: dict[str, Any] = {
    "model": "chain",
    "design": "latin-hypercube",
    "samples": 24,
    "seed": 7,
    "block_size": 4,
    "parameter": [
        {"key": "projectile.impact_velocity", "uniform": {"from": "150 m/s", "to": "300 m/s"}},
        {"key": "projectile.diameter", "normal": {"mean": "4.8 mm", "standard_deviation": "0.2 mm"}},
    ],
}


def contents(folder: Path) -> dict[str, str]:
    """Files of results and what they hold."""
    names = [*folder.glob("block-*.parquet"), folder / "manifest.json"]
    return {path.name: hashlib.sha256(path.read_bytes()).hexdigest() for path in names}


def sweep_file(folder: Path, elements: int = 10) -> Path:
    """The sweep as a file, with its case beside it, which has so many elements along the projectile and twice as many in the target."""
    case = percuss.load("cases/paper-table1/scenario.toml")
    case.replace({"chain.projectile_elements": elements, "chain.target_elements": 2 * elements}).save(folder / "small.toml")
    text = percuss._percuss.toml_text({**SWEEP, "base": "small.toml"})
    path = folder / "sweep.toml"
    path.write_text(text)
    return path


def test_a_sweep_is_that_of_the_program(program: Program, tmp_path: Path) -> None:
    path = sweep_file(tmp_path)
    assert program("sweep", path, "--out", tmp_path / "cli").returncode == 0
    heard: list[float] = []
    rows = percuss.sweep(path, tmp_path / "python", threads=1, progress=lambda part, _: heard.append(part))
    assert contents(tmp_path / "cli") == contents(tmp_path / "python")
    assert rows.complete and rows.status.runs_done == 24 and len(rows.files()) == 6
    assert rows.to_arrow().num_rows == 24
    assert rows.to_pandas()["run"].tolist() == list(range(24))
    assert rows.merge(tmp_path / "all.parquet") == 24
    assert program("sweep", "merge", tmp_path / "cli", "--out", tmp_path / "cli.parquet").returncode == 0
    assert (tmp_path / "all.parquet").read_bytes() == (tmp_path / "cli.parquet").read_bytes()
    # Both draw the same figure into the folder.
    for words in ({}, {"style": "map", "quantity": "peak_force_kn"}, {"x": "projectile.impact_velocity"}):
        drawn = percuss.plot(rows, out=tmp_path / "drawn", **words)
        line = [word for name, value in words.items() for word in (f"--{name}", value)]
        assert program("sweep", "plot", tmp_path / "cli", "--out", tmp_path / "figure", *line).returncode == 0
        for file in drawn.files:
            assert content(file) == content(tmp_path / "figure" / file.name)
        assert [file.suffix for file in drawn.files] == [".svg", ".png"] and drawn._repr_svg_().startswith("<svg")
    with pytest.raises(percuss.UsageError, match=r"does not\s+vary `speed`"):
        percuss.plot(rows, x="speed")
    status = program("sweep", "status", tmp_path / "python", "--json")
    assert json.loads(status.stdout) == rows.status.to_dict()
    axes = rows.plot("projectile.impact_velocity_m_s", "depth_of_penetration_mm", "projectile.diameter_mm")
    assert axes.get_xlabel() == "projectile.impact_velocity_m_s" and axes.collections
    assert "24 of 24" in repr(rows) and "small" in rows._repr_html_()
    depths = rows.to_pandas()["depth_of_penetration_mm"]
    assert f"; depth of penetration {depths.min():.3g} to {depths.max():.3g} mm; " in repr(rows) and "units: " in repr(rows)


def test_parts_resume_and_merge(program: Program, tmp_path: Path) -> None:
    path = sweep_file(tmp_path)
    whole = percuss.sweep(path, tmp_path / "whole")
    whole.merge(tmp_path / "whole.parquet")
    parts = [percuss.sweep(path, tmp_path / f"part-{i}", shard=(i, 2)).folder for i in (1, 2)]
    assert percuss.merge(parts, tmp_path / "parts.parquet") == 24
    assert (tmp_path / "parts.parquet").read_bytes() == (tmp_path / "whole.parquet").read_bytes()

    before = contents(tmp_path / "whole")
    (tmp_path / "whole/block-000002.parquet").unlink()
    (tmp_path / "whole/block-000003.parquet").write_bytes(b"PAR1")
    assert not whole.complete and whole.status.blocks_damaged == [3]
    with pytest.raises(percuss.UsageError, match="the folder holds this") as refused:
        percuss.sweep(path, tmp_path / "whole")
    printed = program("sweep", path, "--out", tmp_path / "whole")
    assert str(refused.value) == printed.stderr.rstrip()
    percuss.sweep(path, tmp_path / "whole", resume=True)
    assert contents(tmp_path / "whole") == before
    with pytest.raises(percuss.UsageError, match="3/2"):
        percuss.sweep(path, tmp_path / "none", shard=(3, 2))


def test_a_sweep_needs_no_folder(tmp_path: Path) -> None:
    path = sweep_file(tmp_path)
    rows = percuss.sweep(path)
    folder = rows.folder
    kept = percuss.sweep(path, tmp_path / "kept")
    assert rows.complete and rows.to_arrow().equals(kept.to_arrow())
    # The rows outlive the folder, which goes with the result.
    table = rows.to_pandas()
    del rows
    gc.collect()
    assert not folder.exists() and len(table) == 24
    for more in ({"resume": True}, {"shard": (1, 2)}):
        with pytest.raises(percuss.UsageError, match="give `out`"):
            percuss.sweep(path, **more)
    with pytest.raises(percuss.CaseError):
        percuss.sweep({"base": "none.toml"})


def test_a_mapping_is_a_sweep_file(program: Program, tmp_path: Path) -> None:
    case = percuss.load("cases/paper-table1/scenario.toml")
    sweep = {
        "base": case.replace({"chain.projectile_elements": 10}),
        "model": "chain",
        "design": "grid",
        "parameter": [{"key": "projectile.impact_velocity", "values": ["150 m/s", "200 m/s"]}],
    }
    rows = percuss.sweep(sweep, tmp_path / "rows")
    assert program("sweep", tmp_path / "rows/sweep.toml", "--out", tmp_path / "cli").returncode == 0
    assert contents(tmp_path / "rows") == contents(tmp_path / "cli")
    assert percuss.sweep(sweep, tmp_path / "rows", resume=True).complete
    by_path = percuss.sweep({**sweep, "base": case}, tmp_path / "by-path")
    assert by_path.manifest.case == "paper-table1" and rows.manifest.case == "paper-table1"


def test_the_case_that_is_swept_is_the_one_that_is_given(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    case = percuss.load("cases/paper-table1/scenario.toml").replace({"chain.projectile_elements": 10})
    case.save(tmp_path / "a.toml")
    case = percuss.load(tmp_path / "a.toml")
    speeds = {"key": "projectile.impact_velocity", "values": ["200 m/s", "230 m/s"]}
    sweep = {"base": case, "model": "chain", "design": "grid", "parameter": [speeds]}
    # The file is another case by now, and then gone.
    case.replace({"projectile.diameter": "9 mm"}).save(tmp_path / "a.toml")
    depth = percuss.run(case).depth_of_penetration_mm
    assert percuss.sweep(sweep).to_pandas()["depth_of_penetration_mm"].tolist()[1] == depth
    (tmp_path / "a.toml").unlink()
    monkeypatch.chdir(tmp_path)
    assert percuss.sweep(sweep).to_pandas()["depth_of_penetration_mm"].tolist()[1] == depth


def test_what_is_refused_leaves_the_folder_as_it_was(tmp_path: Path) -> None:
    case = percuss.load("cases/paper-table1/scenario.toml").replace({"chain.projectile_elements": 10})

    def sweep(*speeds: str, key: str = "projectile.impact_velocity", base: percuss.Case = case) -> dict[str, Any]:
        return {"base": base, "model": "chain", "design": "grid", "parameter": [{"key": key, "values": list(speeds)}]}

    def files(folder: Path) -> dict[str, bytes]:
        return {path.name: path.read_bytes() for path in folder.iterdir()}

    rows = tmp_path / "rows"
    percuss.sweep(sweep("200 m/s"), rows)
    before = files(rows)
    with pytest.raises(percuss.UsageError, match=r"another\s+sweep"):
        percuss.sweep(sweep("210 m/s"), rows)
    assert files(rows) == before
    with pytest.raises(percuss.CaseError, match="velicity"):
        percuss.sweep(sweep("1 m/s", key="projectile.velicity"), tmp_path / "none")
    assert not (tmp_path / "none").exists()
    own = tmp_path / "own"
    own.mkdir()
    (own / "sweep.toml").write_text("# mine")
    with pytest.raises(percuss.UsageError, match="is not of this sweep"):
        percuss.sweep(sweep("200 m/s"), own)
    assert files(own) == {"sweep.toml": b"# mine"}
    for name in ("sweep", "a/b"):
        renamed = percuss.Case.from_text(case.text, name)
        assert percuss.sweep(sweep("200 m/s", base=renamed), tmp_path / name.replace("/", "-")).complete


@pytest.mark.parametrize("threads", [0, -1, 1025, 10**9])
def test_a_number_of_threads_that_no_machine_has_is_refused(threads: int, tmp_path: Path) -> None:
    with pytest.raises(percuss.UsageError, match="1 to 1024"):
        percuss.sweep(sweep_file(tmp_path), threads=threads)


def test_a_block_of_another_sweep_is_refused(tmp_path: Path) -> None:
    path = sweep_file(tmp_path)
    sweep = percuss._percuss.Sweep(path)
    folder = percuss._percuss.SweepFolder(tmp_path / "rows", sweep, False)
    block = sweep.block(0)
    for wrong, content in [(99, block), (0, block[:-1]), (0, b"")]:
        with pytest.raises(percuss.UsageError, match="is not this block"):
            folder.put(wrong, content)
    folder.put(0, block)
    assert folder.missing(1, 1) == [1, 2, 3, 4, 5]
    # Nobody else writes to the folder before it is closed.
    with pytest.raises(percuss.UsageError, match="another process"):
        percuss._percuss.SweepFolder(tmp_path / "rows", sweep, True)
    folder.close()
    with pytest.raises(ValueError, match="closed"):
        folder.put(0, block)
    assert percuss.sweep(path, tmp_path / "rows", resume=True).complete
