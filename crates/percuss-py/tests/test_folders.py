"""What ``out`` writes is what the program writes, file by file; runs go on from their checkpoints."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import percuss
import pytest
from conftest import ROOT, Program, content

TAYLOR = "cases/taylor-copper-wilkins/scenario.toml"
PLATE = "cases/weldox-460e-12mm-blunt/scenario.toml"
# A shot of the design with depths made up.
REFERENCE = """\
projectile,target,length_to_diameter,impact_velocity_m_s,cells_per_radius,depth_of_penetration_mm,largest_depth_mm,\
projectile_final_length_mm,projectile_final_diameter_mm,outcome,energy_residual,transfer_loss,steps,particles
copper-woodward,aluminium-2024-t351-woodward,1.0,600.0,4,1.8,1.9,3.0,8.0,rebounded,0.002,0.05,1000,6000
copper-woodward,aluminium-2024-t351-woodward,1.0,600.0,8,1.9,1.9,3.0,8.0,rebounded,0.002,0.05,2000,24000
copper-woodward,aluminium-2024-t351-woodward,1.0,600.0,16,1.95,1.96,3.0,8.0,rebounded,0.002,0.05,4000,96000
"""
Call = Callable[[Path, Path], Any]


def small(path: str, folder: Path, **more: Any) -> percuss.Case:
    """A case on a coarse mesh, with a file beside it."""
    meshes = {"chain.projectile_elements": 8}
    case = percuss.load(path)
    if "rigid_wall" not in case.text:
        meshes["chain.target_elements"] = 12
    case = case.replace({**meshes, **more})
    case.save(folder / f"{case.name}.toml")
    return case


# Words of the command before --out, and the same in Python; both get a folder with the files that they name.
CALLS: dict[str, tuple[Callable[[Path], list[str]], Call]] = {
    "run": (lambda _: ["run", TAYLOR, "--fast"], lambda _, out: percuss.run(TAYLOR, out=out)),
    "compare": (
        lambda _: ["compare", TAYLOR, "--model", "taylor", "--velocity", "150,190"],
        lambda _, out: percuss.compare(TAYLOR, model="taylor", velocity=[150, 190], out=out),
    ),
    "limit": (
        lambda at: ["limit", PLATE, "--model", "plugging", "--points", "2", "--tests", f"{at}/tests.csv"],
        lambda at, out: percuss.limit(PLATE, model="plugging", points=2, tests=at / "tests.csv", out=out),
    ),
    "converge": (
        lambda at: ["converge", f"{at}/taylor-copper-wilkins.toml", "--levels", "3"],
        lambda at, out: percuss.converge(small(TAYLOR, at), levels=3, out=out),
    ),
    "uncertainty": (
        lambda at: ["uncertainty", f"{at}/paper-table1-uncertainty.toml", "--samples", "16", "--no-indices"],
        lambda at, out: percuss.uncertainty(
            small("cases/paper-table1-uncertainty/scenario.toml", at), samples=16, no_indices=True, out=out
        ),
    ),
    "calibrate": (
        lambda _: [
            *["calibrate", "--data", "builtin", "--source", "wilkins1973", "--model", "wilkins_guinan", "--least-squares"],
            *["--fit", "materials.copper-woodward.strength.power_law.coefficient=150..900 MPa"],
        ],
        lambda _, out: percuss.calibrate(
            data="builtin",
            source="wilkins1973",
            model="wilkins_guinan",
            least_squares=True,
            fit={"materials.copper-woodward.strength.power_law.coefficient": "150..900 MPa"},
            out=out,
        ),
    ),
    "validate": (
        lambda _: ["validate", "--model", "taylor", "--kind", "taylor"],
        lambda _, out: percuss.validate(model="taylor", kind="taylor", out=out),
    ),
    "benchmark": (
        lambda at: ["benchmark", "--reference", f"{at}/reference.csv"],
        lambda at, out: percuss.benchmark(reference=at / "reference.csv", out=out),
    ),
}


def contents(folder: Path) -> dict[str, bytes]:
    """All files of a folder and its folders."""
    return {str(path.relative_to(folder)): content(path) for path in folder.rglob("*") if path.is_file()}


@pytest.mark.parametrize("what", CALLS)
def test_a_folder_is_that_of_the_program(what: str, program: Program, tmp_path: Path) -> None:
    (tmp_path / "tests.csv").write_text("impact_velocity_m_s,perforated\n180,no\n186,yes\n184,no\n183,yes\n190,yes\n178,no\n")
    (tmp_path / "reference.csv").write_text(REFERENCE)
    words, call = CALLS[what]
    # Reports name the command that wrote them: both write to a folder of the same name.
    result = call(tmp_path, tmp_path / "out")
    assert json.loads(program(*words(tmp_path), "--json").stdout) == result.to_dict() or what == "run"
    ours = contents(tmp_path / "out")
    written = {str(path.relative_to(tmp_path / "out")) for path in result.files}
    assert written == set(ours)
    (tmp_path / "out").rename(tmp_path / "python")
    said = program(*words(tmp_path), "--out", tmp_path / "out")
    assert said.returncode == 0, said.stderr
    theirs = contents(tmp_path / "out")
    assert set(ours) == set(theirs) and len(ours) > 1
    for name in theirs:
        assert ours[name] == theirs[name], name


def test_without_a_folder_nothing_is_written() -> None:
    assert percuss.run(TAYLOR, "taylor").files == () and percuss.compare(TAYLOR, model="taylor").files == ()


def test_a_run_that_is_stopped_goes_on_to_the_folder_of_the_program(program: Program, tmp_path: Path) -> None:
    case = percuss.Case(
        "short",
        projectile={"material": "copper", "length": "6 mm", "diameter": "4 mm", "impact_velocity": "400 m/s"},
        target={"material": "aluminium-2024-t351", "thickness": "4 mm"},
        axi={"cells_per_radius": 16, "target_radius": "8 mm", "end_time": "24 us"},
    )
    case.save(tmp_path / "short.toml")

    class Enough(Exception):
        pass

    def hear(part: float, _words: str) -> None:
        if part > 0.0:
            raise Enough

    out = tmp_path / "out"
    with pytest.raises(Enough):
        percuss.run(case, "axi", out=out, field="speed", fields=True, animation=True, frames=20, checkpoint="1 h", progress=hear)
    assert (out / "checkpoint.percuss").is_file() and not (out / "result.json").exists()
    rest = percuss.run(case, "axi", out=out, field="speed", fields=True, animation=True, frames=20, resume=True)
    assert rest.to_dict() == percuss.run(case, "axi").to_dict()
    # Pictures are named by their folder, fields by the file that lists them.
    assert {out / "frames", out / "fields.pvd", out / "animation.gif", out / "field.vtp", out / "field.png"} <= set(rest.files)
    ours = contents(out)
    out.rename(tmp_path / "python")
    asked = ("--field", "speed", "--fields", "--animation", "--frames", "20")
    said = program("run", tmp_path / "short.toml", "--model", "axi", *asked, "--out", out)
    assert said.returncode == 0, said.stderr
    theirs = contents(out)
    assert set(ours) == set(theirs)
    for name in theirs:
        assert ours[name] == theirs[name], name


def test_what_has_no_effect_is_refused(program: Program, tmp_path: Path) -> None:
    for given in ({"field": "speed"}, {"fields": True}, {"animation": True}, {"resume": True}, {"checkpoint": 60.0}):
        with pytest.raises(percuss.UsageError, match="--out <DIR>"):
            percuss.run(TAYLOR, **given)
        with pytest.raises(percuss.UsageError, match="has no effect with model `taylor`, which does not step through time"):
            percuss.run(TAYLOR, model="taylor", out=tmp_path, **given)
    for given in ({"field": "speed"}, {"animation": True}):
        with pytest.raises(percuss.UsageError, match="has no effect with model `chain`, whose fields are one-dimensional"):
            percuss.run(TAYLOR, out=tmp_path, **given)
    with pytest.raises(percuss.UsageError, match="leave out `out`"):
        percuss.run(TAYLOR, out=tmp_path, projectile_law=lambda *_: 3e8)
    (tmp_path / "file").write_text("")
    printed = program("compare", TAYLOR, "--out", tmp_path / "file")
    with pytest.raises(percuss.WriteError) as refused:
        percuss.compare(TAYLOR, out=tmp_path / "file")
    assert str(refused.value) == printed.stderr.rstrip()


def test_the_case_that_was_run_is_kept(tmp_path: Path) -> None:
    case = small(TAYLOR, tmp_path)
    percuss.run(case, out=tmp_path / "out")
    assert (tmp_path / "out/case-as-run.toml").read_text() == case.text


def test_a_starter_case_is_that_of_the_program(program: Program, tmp_path: Path) -> None:
    path = percuss.new(tmp_path / "shot")
    assert path == tmp_path / "shot/scenario.toml"
    with pytest.raises(percuss.WriteError, match=r"it exists\s+already") as refused:
        percuss.new(tmp_path / "shot")
    assert str(refused.value) == program("new", tmp_path / "shot").stderr.rstrip()
    text = path.read_text()
    path.write_text("")
    assert percuss.new(tmp_path / "shot", force=True).read_text() == text
    assert program("new", tmp_path / "other").returncode == 0
    assert (tmp_path / "other/scenario.toml").read_text() == text


def test_the_reference_is_computed_where_it_lacks(tmp_path: Path) -> None:
    assert (ROOT / "crates/percuss-research/data/reference.csv").is_file()
    with pytest.raises(percuss.UsageError, match="--reference FILE"):
        percuss.benchmark(compute=True)
    with pytest.raises(percuss.UsageError, match="--compute"):
        percuss.benchmark(cells=4)


def test_figures_have_the_formats_that_are_asked_for(tmp_path: Path) -> None:
    def suffixes(figures: str | list[str] | None) -> set[str]:
        result = percuss.run("cases/taylor-copper-wilkins/scenario.toml", out=tmp_path / "out", figures=figures, progress=False)
        return {file.suffix for file in result.files} & {".svg", ".png", ".pdf"}

    assert suffixes(None) == {".svg", ".png"}
    assert suffixes(["pdf"]) == suffixes("pdf") == {".pdf"}
    assert suffixes([]) == suffixes("none") == set()
    with pytest.raises(percuss.UsageError, match="svg, png, pdf"):
        suffixes("tiff")
    with pytest.raises(percuss.UsageError, match="--out"):
        percuss.converge("cases/taylor-copper-wilkins/scenario.toml", figures="pdf")


def test_figures_have_the_width_that_is_asked_for(tmp_path: Path) -> None:
    def widths(width: str | None) -> set[str]:
        case = "cases/taylor-copper-wilkins/scenario.toml"
        result = percuss.run(case, out=tmp_path / "out", figures="svg", figure_width=width, progress=False)
        figures = [file for file in result.files if file.suffix == ".svg"]
        return {width for file in figures for width in re.findall(r'<svg[^>]* width="(\d+)"', file.read_text())}

    assert widths("91 mm") == {"430"}
    assert widths(None) == {"860"}
    with pytest.raises(percuss.UsageError, match="60 mm to 182 mm"):
        widths("5 mm")
