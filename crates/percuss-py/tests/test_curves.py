"""Measured curves of cases in code."""

from __future__ import annotations

import pytest

import percuss

TABLES = {
    "projectile": {"material": "copper", "length": "12.74 mm", "diameter": "4.8 mm", "impact_velocity": "230 m/s"},
    "target": {"material": "aluminium-2024-t351", "thickness": "25 mm"},
    "gauges": [{"name": "rod", "position": "-6 mm"}],
}


def test_a_history_is_its_own_measured_curve() -> None:
    history = percuss.run(percuss.Case(**TABLES)).history
    gauge = history.gauges["rod"]
    rows = "".join(f"{time!r},{stress!r}\n" for time, stress in zip(gauge.time_us.tolist(), gauge.stress_mpa.tolist()))
    depths = "".join(f"{1e-3 * time!r},{0.1 * depth + 0.02!r}\n" for time, depth in zip(history.time_us.tolist(), history.depth_mm.tolist()))
    curves = [{"csv": f"time_us,stress_mpa\n{rows}", "gauge": "rod", "name": "same"}, {"csv": f"Time (ms),Depth (cm)\n{depths}"}]
    result = percuss.run(percuss.Case(**TABLES, measured_curves=curves), history=False)
    same, higher = result.measured_curves
    assert (same.name, same.gauge, same.quantity, same.unit, same.reason) == ("same", "rod", "stress", "MPa", None)
    assert same.rms_difference == pytest.approx(0.0, abs=1e-9) and same.time_shift_us == 0.0
    assert higher.rms_difference == pytest.approx(0.2, rel=1e-9) and higher.largest_difference == pytest.approx(0.2, rel=1e-9)
    assert result.depth_of_penetration_mm == pytest.approx(percuss.run(percuss.Case(**TABLES)).depth_of_penetration_mm, rel=0)


def test_a_wrong_curve_is_refused_with_its_place() -> None:
    with pytest.raises(percuss.CaseError, match="time 1 does not come after 2") as caught:
        percuss.Case(**TABLES, measured_curves=[{"csv": "time_us,depth_mm\n0,0\n2,1\n1,2\n"}])
    assert (caught.value.line, caught.value.key) == (4, "time_us")


def test_a_curve_is_fitted_to() -> None:
    bar = {
        "projectile": {"material": "bar", "length": "40 mm", "diameter": "10 mm", "impact_velocity": "10 m/s"},
        "target": {"material": "bar", "thickness": "80 mm"},
        "gauges": [{"name": "bar", "position": "30 mm"}],
        "chain": {
            "target_resistance": "column",
            "border_shear": 0.0,
            "kinematics": "small-strain",
            "projectile_elements": 20,
            "target_elements": 40,
            "end_time": "20 us",
        },
    }
    material = {"name": "bar", "density": "8930 kg/m3", "poissons_ratio": 0.34, "strength": {"elastic": {}}}

    def case(modulus: str, **more: object) -> percuss.Case:
        return percuss.Case(**bar, materials={"bar": {**material, "youngs_modulus": modulus}}, **more)

    gauge = percuss.run(case("124 GPa")).history.gauges["bar"]
    rows = "".join(f"{time!r},{stress!r}\n" for time, stress in zip(gauge.time_us.tolist(), gauge.stress_mpa.tolist()))
    table = {"csv": f"time_us,stress_mpa\n{rows}", "gauge": "bar", "name": "gauge 1", "uncertainty": "2 MPa", "correlation_time": "1 us"}
    found = percuss.calibrate(
        case("90 GPa", measured_curves=[table]),
        fit={"materials.bar.youngs_modulus": "60..200 GPa"},
        noise="stated",
        ensembles=2,
        walkers=4,
        steps=20,
    )
    assert found.parameters[0].best == pytest.approx(124, rel=1e-4)
    (curve,) = found.curves
    assert found.training is None and found.predictions == []
    assert (curve.name, curve.correlation_time_us, curve.correlation_estimated) == ("gauge 1", pytest.approx(1), False)
    assert curve.best.rms_difference < 0.02 * curve.before.rms_difference
    assert len(curve.points.time_us) == curve.values == len(curve.points.predictive_band[0])
    assert "gauge 1" in repr(found)
    axes = found.plot_curve()
    assert axes.get_ylabel() == "Stress (MPa)"
