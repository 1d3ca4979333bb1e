"""Errors have the text and the place that the program prints."""

from __future__ import annotations

import pickle
from pathlib import Path

import percuss
import pytest
from conftest import ROOT, Program, of_arguments

BAD_CASES = sorted(path.relative_to(ROOT) for path in ROOT.glob("crates/percuss-cli/tests/bad-cases/*.toml"))
BAD_SWEEPS = sorted(path.relative_to(ROOT) for path in ROOT.glob("crates/percuss-cli/tests/bad-sweeps/*.toml"))


def test_there_are_bad_files() -> None:
    assert len(BAD_CASES) > 20 and BAD_SWEEPS


@pytest.mark.parametrize("path", BAD_CASES, ids=lambda path: path.stem)
def test_a_bad_case_is_refused_in_the_words_of_the_program(path: Path, program: Program) -> None:
    printed = program("run", path)
    with pytest.raises(percuss.PercussError) as caught:
        percuss.run(path)
    assert str(caught.value) == printed.stderr.rstrip()
    error = caught.value
    if isinstance(error, percuss.CaseError):
        in_material = error.key.startswith(("materials.", "material_files")) or Path(error.file) != path
        named = error.message.startswith(("no material is named", "several materials are named"))
        assert isinstance(error, percuss.MaterialError) == (in_material or named), f"{type(error).__name__}\n{error}"
    if isinstance(error, percuss.CaseError) and error.key:
        # What a material file holds is said of that file.
        assert error.message and (Path(error.file) == path or isinstance(error, percuss.MaterialError))
        assert f":{error.line}:" in str(error) or f"key: {error.key}" in str(error)


@pytest.mark.parametrize("path", BAD_SWEEPS, ids=lambda path: path.stem)
def test_a_bad_sweep_is_refused_in_the_words_of_the_program(path: Path, program: Program, tmp_path: Path) -> None:
    printed = program("sweep", path, "--out", tmp_path / "cli")
    with pytest.raises(percuss.CaseError) as caught:
        percuss.sweep(path, tmp_path / "python")
    assert str(caught.value) == printed.stderr.rstrip()


def test_the_kind_of_error_says_what_is_wrong(program: Program, tmp_path: Path) -> None:
    wall = "cases/taylor-copper-wilkins/scenario.toml"
    with pytest.raises(percuss.NotApplicableError) as refused:
        percuss.run(wall, "tate")
    assert str(refused.value) == program("run", wall, "--model", "tate").stderr.rstrip()
    assert refused.value.model == "tate" and refused.value.reason

    with pytest.raises(percuss.MaterialError) as unknown:
        percuss.material("coper")
    assert str(unknown.value) == program("materials", "show", "coper").stderr.rstrip()

    with pytest.raises(percuss.MaterialError, match="coper"):
        percuss.Case(
            projectile={"material": "coper", "length": "1 mm", "diameter": "1 mm", "impact_velocity": "1 m/s"},
            target={"rigid_wall": True},
        )

    with pytest.raises(percuss.ReadError) as missing:
        percuss.load("no-such.toml")
    assert str(missing.value) == program("run", "no-such.toml").stderr.rstrip()
    assert isinstance(missing.value, OSError) and Path(missing.value.filename) == Path("no-such.toml")

    with pytest.raises(percuss.UsageError) as usage:
        percuss.converge(wall, levels=99)
    assert str(usage.value) == of_arguments(program("converge", wall, "--levels", "99").stderr)
    with pytest.raises(percuss.UsageError, match="no model is named"):
        percuss.run(wall, "chian")

    again = pickle.loads(pickle.dumps(missing.value))
    assert str(again) == str(missing.value) and type(again) is percuss.ReadError


def test_a_numerical_failure_has_time_step_and_element(program: Program, tmp_path: Path) -> None:
    # Elements that never erode are compressed to nothing at this speed.
    failing = tmp_path / "failing.toml"
    failing.write_text(
        "projectile = { material = 'copper', length = '12.74 mm', diameter = '4.8 mm', impact_velocity = '9 km/s' }\n"
        "target = { material = 'aluminium-2024-t351', thickness = 'semi-infinite' }\n"
        "chain = { target_resistance = 'column', erosion_strain = 'never', courant = 1.0 }"
    )
    printed = program("run", failing)
    assert printed.returncode == 3, printed.stderr
    with pytest.raises(percuss.NumericalError) as caught:
        percuss.run(failing)
    assert str(caught.value) == printed.stderr.rstrip()
    assert caught.value.step > 0 and caught.value.time_us > 0.0 and caught.value.help


def test_an_argument_has_its_own_name_in_a_message(tmp_path: Path) -> None:
    case = "cases/paper-table1/scenario.toml"
    with pytest.raises(percuss.UsageError) as velocity:
        percuss.compare(case, velocity="abc")
    assert str(velocity.value).startswith("error: invalid value 'abc' for `velocity`: `abc` is not a number\nallowed: ")
    with pytest.raises(percuss.UsageError) as tolerance:
        percuss.run(case, mesh_tolerance="0")
    assert "for `mesh_tolerance`: " in str(tolerance.value)
    assert "--help" not in str(velocity.value) + str(tolerance.value)
    # A path may be bytes.
    percuss.run(case, out=str(tmp_path / "run").encode(), figures="none")  # type: ignore[arg-type]
    assert (tmp_path / "run" / "result.json").is_file()
