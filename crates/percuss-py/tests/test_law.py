"""Strength laws written in Python."""

from __future__ import annotations

import math
from typing import Any

import percuss
import pytest

MINE: dict[str, Any] = {
    "name": "mine",
    "density": 8000.0,
    "youngs_modulus": 120e9,
    "poissons_ratio": 0.3,
    "strength": {"perfectly_plastic": {"flow_stress": 300e6}},
}


def shot(target: dict[str, Any], material: dict[str, Any] = MINE) -> percuss.Case:
    return percuss.Case(
        projectile={"material": "mine", "length": 0.02, "diameter": 0.005, "velocity": 150.0},
        target=target,
        chain={"projectile_elements": 10, "target_elements": 20, "target_closure": "column"} if "material" in target
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
    case = shot({"material": "mine", "thickness": 0.02})
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
        if strain > 0.01:
            if error is None:
                raise ZeroDivisionError("a mistake in the law")
            return result
        return 300e6

    with pytest.raises(error or ZeroDivisionError):
        percuss.run(shot({"rigid_wall": True}), projectile_law=law)
    assert calls > 10
