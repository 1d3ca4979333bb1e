"""Laws of strength and of resistance written in Python."""

from __future__ import annotations

import math
import random
from pathlib import Path
from typing import Any

import percuss
import pytest

MINE: dict[str, Any] = {
    "name": "mine",
    "density": "8000 kg/m3",
    "youngs_modulus": "120 GPa",
    "poissons_ratio": 0.3,
    "strength": {"perfectly_plastic": {"flow_stress": "300 MPa"}},
}


def shot(target: dict[str, Any], material: dict[str, Any] = MINE) -> percuss.Case:
    return percuss.Case(
        projectile={"material": "mine", "length": "20 mm", "diameter": "5 mm", "impact_velocity": "150 m/s"},
        target=target,
        chain={"projectile_elements": 10, "target_elements": 20, "target_resistance": "column"} if "material" in target
        else {"projectile_elements": 10},
        materials={"mine": material},
    )


def test_a_constant_in_python_is_the_law_of_the_library() -> None:
    case = shot({"rigid_wall": True})
    # The library's law knows its slopes, this one has them by differences, which of a constant are exact.
    own = percuss.run(case, projectile_law=lambda *_: 300e6)
    library = percuss.run(case)
    assert math.isclose(own.projectile_final_length_mm or 0, library.projectile_final_length_mm or 1, rel_tol=1e-9)
    assert own.energy_residual is not None and own.energy_residual < 1e-3
    softer = percuss.run(case, projectile_law=lambda *_: 200e6)
    assert (softer.projectile_final_length_mm or 99) < (own.projectile_final_length_mm or 0)


def test_the_law_of_a_target_is_its_own() -> None:
    case = shot({"material": "mine", "thickness": "20 mm"})
    both = percuss.run(case, projectile_law=lambda *_: 300e6, target_law=lambda *_: 300e6)
    assert math.isclose(both.depth_of_penetration_mm or 0, percuss.run(case).depth_of_penetration_mm or 1, rel_tol=1e-9)
    weak = percuss.run(case, target_law=lambda *_: 100e6)
    assert (weak.depth_of_penetration_mm or 0) > (both.depth_of_penetration_mm or 99)


@pytest.mark.parametrize(("result", "error"), [("soft", TypeError), (None, TypeError), (1 / 3, None)])
def test_what_a_law_raises_ends_the_run(result: Any, error: type[Exception] | None) -> None:
    calls = 0

    def law(strain: float, _rate: float, _temperature: float) -> Any:
        nonlocal calls
        calls += 1
        # Some strains are asked for before the first step.
        if calls > 50 and strain > 0.001:
            if error is None:
                raise ZeroDivisionError("a mistake in the law")
            return result
        return 300e6

    with pytest.raises(error or ZeroDivisionError):
        percuss.run(shot({"rigid_wall": True}), projectile_law=law)
    # Nothing is asked of a law that has failed.
    assert 50 < calls < 10_000


# Hard enough to stay rigid, into a target that a law of resistance stands for.
RIGID: dict[str, Any] = {**MINE, "youngs_modulus": "1500 GPa", "strength": {"perfectly_plastic": {"flow_stress": "20 GPa"}}}
BLOCK = {"material": "aluminium-2024-t351", "thickness": "semi-infinite"}


def thick(speed: float, **chain: Any) -> percuss.Case:
    return percuss.Case(
        projectile={"material": "mine", "length": "50 mm", "diameter": "5 mm", "impact_velocity": f"{speed!r} m/s"},
        target=BLOCK,
        chain={"projectile_elements": 20, "target_elements": 20, **chain},
        materials={"mine": RIGID},
    )


def test_a_constant_resistance_takes_up_the_energy_of_a_rigid_rod() -> None:
    result = percuss.run(thick(150.0), resistance_law=lambda _depth, _speed: 300e6)
    area, added = math.pi * 0.0025**2, 4 / 3 * 2780.0 * 0.0025**3
    mass = 8000.0 * area * 0.05
    # The target's added mass is set in motion by the rod when they meet, and slows down with it.
    expected = 0.5 * mass**2 / (mass + added) * 150.0**2 / (300e6 * area)
    assert result.depth_of_penetration_mm == pytest.approx(1e3 * expected, rel=0.02)
    assert result.expected_error is None and "resistance law" in result.warnings[0]
    assert result.energy_residual is not None and result.energy_residual < 1e-2


def test_the_law_of_resistance_sees_depth_and_speed() -> None:
    seen: list[tuple[float, float]] = []

    def law(depth: float, speed: float) -> float:
        seen.append((depth, speed))
        return 200e6 + 1.5 * 2780.0 * speed**2

    result = percuss.run(thick(400.0), resistance_law=law)
    deepest, fastest = max(depth for depth, _ in seen), max(speed for _, speed in seen)
    assert deepest == pytest.approx(1e-3 * (result.depth_of_penetration_mm or 0), rel=1e-3)
    # Waves in the rod throw its tip forward at first.
    assert 200 < fastest < 800 and min(speed for _, speed in seen) == 0.0


@pytest.mark.parametrize(
    ("law", "error", "words"),
    [
        (lambda _d, _s: math.nan, ValueError, "gives NaN Pa at a depth of"),
        (lambda _d, _s: -1.0, ValueError, "allowed: 0 or more"),
        (lambda _d, _s: "hard", TypeError, "float|real number"),
        (lambda _d: 1e9, TypeError, "argument"),
    ],
)
def test_what_a_law_of_resistance_does_wrong_ends_the_run(law: Any, error: type[Exception], words: str) -> None:
    with pytest.raises(error, match=words):
        percuss.run(thick(150.0), resistance_law=law)


def test_where_there_is_no_crater_floor_a_law_of_resistance_is_refused() -> None:
    for case, model in [(thick(150.0), "fdm"), (thick(150.0, target_resistance="column"), "chain"), (shot({"rigid_wall": True}), "chain")]:
        with pytest.raises(percuss.NotApplicableError, match="resistance law"):
            percuss.run(case, model, resistance_law=lambda _depth, _speed: 1e9)


@pytest.mark.parametrize("wrong", [math.nan, math.inf, -math.inf, -1e9, -1e-300])
@pytest.mark.parametrize("late", [False, True])
def test_a_stress_that_is_none_is_refused_with_its_arguments(wrong: float, late: bool) -> None:
    def law(strain: float, _rate: float, _temperature: float) -> float:
        return wrong if not late or strain > 0.01 else 300e6

    with pytest.raises(ValueError, match=r"the strength law gives .* Pa at a plastic strain of .* and a temperature of .* K"):
        percuss.run(shot({"rigid_wall": True}), projectile_law=law)
    target = shot({"material": "mine", "thickness": "20 mm"})
    with pytest.raises(ValueError, match="allowed: 0 or more"):
        percuss.run(target, target_law=law)


def test_a_law_without_a_single_flow_stress_is_refused() -> None:
    case = shot({"rigid_wall": True})
    with pytest.raises(ValueError, match="falls with the strain rate"):
        percuss.run(case, projectile_law=lambda _strain, rate, _temperature: 300e6 / (1.0 + 1e-3 * rate))
    with pytest.raises(ValueError, match="falls with the plastic strain by more than three times the shear modulus"):
        percuss.run(case, projectile_law=lambda strain, *_: max(300e6 - 2e11 * strain, 200e6))
    with pytest.raises(ValueError, match="flow stress at a plastic strain of 0.1"):
        percuss.run(case, projectile_law=lambda strain, *_: max(300e6 - 2e11 * strain, 0.0))
    # Softening that a step can follow is allowed.
    percuss.run(case, projectile_law=lambda strain, *_: 300e6 * math.exp(-0.2 * strain))


def test_laws_at_random_give_a_result_or_an_error() -> None:
    """A hundred laws with random values, each wrong in some way at some place or not at all: no number comes out of a wrong one."""
    draw = random.Random(1)
    wrong_values = [math.nan, math.inf, -1e6]
    refused = 0
    for _ in range(100):
        start, hardening, rate_part = draw.uniform(1e8, 1e9), draw.uniform(0.0, 1e9), draw.uniform(0.0, 1e4)
        wrong = draw.choice([*wrong_values, None])
        beyond = draw.choice([0.0, 1e-3, 0.02])
        hit = False

        def law(
            strain: float, rate: float, _temperature: float,
            *, a: float = start, b: float = hardening, c: float = rate_part, w: float | None = wrong, place: float = beyond,
        ) -> float:
            nonlocal hit
            if w is not None and strain >= place:
                hit = True
                return w
            return a + b * strain + c * rate

        case = percuss.Case(
            projectile={"material": "mine", "length": "20 mm", "diameter": "5 mm", "impact_velocity": "100 m/s"},
            target={"rigid_wall": True},
            chain={"projectile_elements": 4},
            materials={"mine": MINE},
        )
        try:
            found = percuss.run(case, projectile_law=law)
        except ValueError:
            refused += 1
            assert hit
        else:
            assert not hit
            assert 0.0 < (found.projectile_final_length_mm or 0.0) <= 20.0
    assert 40 < refused < 90


def varied(case: percuss.Case) -> dict[str, Any]:
    speeds = {"key": "projectile.impact_velocity", "values": ["120 m/s", "150 m/s", "180 m/s"]}
    return {"base": case, "model": "chain", "design": "grid", "parameter": [speeds]}


def test_a_sweep_with_a_law_has_the_numbers_of_its_runs(tmp_path: Path) -> None:
    case = shot({"rigid_wall": True})

    def law(strain: float, _rate: float, _temperature: float) -> float:
        return 250e6 + 400e6 * strain

    rows = percuss.sweep(varied(case), tmp_path / "rows", projectile_law=law).to_pandas()
    lengths = rows["projectile_final_length_mm"].tolist()
    runs = [percuss.run(case.replace({"projectile.impact_velocity": f"{speed} m/s"}), projectile_law=law) for speed in (120, 150, 180)]
    assert lengths == [run.projectile_final_length_mm for run in runs]
    own = percuss.sweep(varied(case), tmp_path / "own").to_pandas()["projectile_final_length_mm"].tolist()
    assert all(with_law != without for with_law, without in zip(lengths, own))


def test_a_folder_goes_on_with_its_own_law_only(tmp_path: Path) -> None:
    case, folder = shot({"rigid_wall": True}), tmp_path / "rows"
    percuss.sweep(varied(case), folder, shard=(1, 3), projectile_law=lambda *_: 300e6)
    with pytest.raises(percuss.PercussError, match="another"):
        percuss.sweep(varied(case), folder, resume=True, projectile_law=lambda *_: 200e6)
    with pytest.raises(percuss.PercussError, match="another"):
        percuss.sweep(varied(case), folder, resume=True)
    assert percuss.sweep(varied(case), folder, resume=True, projectile_law=lambda *_: 300e6).complete


def test_what_a_law_raises_ends_a_study_without_a_row(tmp_path: Path) -> None:
    case = shot({"rigid_wall": True})

    def law(strain: float, _rate: float, _temperature: float) -> float:
        if strain > 0.01:
            raise ZeroDivisionError("a mistake in the law")
        return 300e6

    with pytest.raises(ZeroDivisionError, match="a mistake in the law"):
        percuss.sweep(varied(case), tmp_path / "rows", projectile_law=law)
    assert percuss.SweepResult(tmp_path / "rows").status.runs_done == 0
    with pytest.raises(ZeroDivisionError, match="a mistake in the law"):
        percuss.uncertainty(uncertain(case), model="chain", samples=16, no_indices=True, projectile_law=law)


def uncertain(case: percuss.Case) -> percuss.Case:
    speed = {"key": "projectile.impact_velocity", "uniform": {"from": "140 m/s", "to": "160 m/s"}}
    return case.replace({"uncertainty": {"parameter": [speed]}})


def test_the_uncertainty_with_a_law_is_that_of_its_runs() -> None:
    case = uncertain(shot({"rigid_wall": True}))
    own = percuss.uncertainty(case, model="chain", samples=16, no_indices=True)
    found = percuss.uncertainty(case, model="chain", samples=16, no_indices=True, projectile_law=lambda *_: 250e6)
    speed = float(found.draws["projectile.impact_velocity_m_s"][3])
    run = percuss.run(case.replace({"projectile.impact_velocity": f"{speed!r} m/s"}), projectile_law=lambda *_: 250e6)
    assert found.draws["projectile_final_length_mm"][3] == run.projectile_final_length_mm
    assert own.draws["projectile_final_length_mm"][3] != run.projectile_final_length_mm


def test_laws_are_refused_where_they_would_have_no_effect(tmp_path: Path) -> None:
    case = shot({"rigid_wall": True})
    with pytest.raises(percuss.UsageError, match="leave out `client`"):
        percuss.sweep(varied(case), tmp_path / "rows", client=object(), projectile_law=lambda *_: 3e8)  # type: ignore[arg-type]
    for more in ({"out": tmp_path}, {"axisymmetric": 4}):
        with pytest.raises(percuss.UsageError, match="leave them out"):
            percuss.uncertainty(uncertain(case), projectile_law=lambda *_: 3e8, **more)


def test_a_law_of_a_target_that_is_none_is_refused(tmp_path: Path) -> None:
    case = shot({"rigid_wall": True})
    for compute in (lambda law: percuss.run(case, target_law=law), lambda law: percuss.sweep(varied(case), tmp_path / "rows", target_law=law)):
        with pytest.raises(percuss.UsageError, match="no solid target"):
            compute(lambda *_: 300e6)
