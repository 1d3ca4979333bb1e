//! Rods whose waves and lengths are known, for every model of rods.

use percuss::outcome::RunResult;

use super::{assert_near, wilkins};

/// Two elastic bars with the elastic constants of Table 1; `options` is the table of the model.
pub fn elastic_bars(
    velocity: f64,
    target: &str,
    thickness_mm: f64,
    back_face: &str,
    options: &str,
) -> String {
    format!(
        r#"
        projectile = {{ material = "rod", length = "12.74 mm", diameter = "4.8 mm", impact_velocity = "{velocity} m/s" }}
        target = {{ material = "{target}", thickness = "{thickness_mm} mm", back_face = "{back_face}" }}
        {options}
        [materials.rod]
        name = "elastic copper"
        density = "8500 kg/m3"
        youngs_modulus = "114 GPa"
        poissons_ratio = 0.34
        strength.elastic = {{}}
        [materials.plate]
        name = "elastic aluminium"
        density = "2780 kg/m3"
        youngs_modulus = "70 GPa"
        poissons_ratio = 0.33
        strength.elastic = {{}}
        "#
    )
}

/// Final length over initial length of a rigid, perfectly plastic rod for `ρ v²/Y`: Taylor's moving front in the true-stress,
/// constant-volume form.
///
/// Across the front `ρ v²/Y = e²/(1 − e)`, with `e = 1 − A₀/A`; the undeformed rear `h` shortens by
/// `dh = h d(ρv²/Y)/(2e)` and what passed the front is shortened by `1 − e`.
pub fn taylor_length(number: f64) -> f64 {
    let strain = |number: f64| 0.5 * (-number + (number * number + 4.0 * number).sqrt());
    let steps = 200_000;
    // In s = sqrt(number) the integrand is smooth: d(number)/(2e) = (s/e) ds.
    let step = number.sqrt() / f64::from(steps);
    let (mut rear, mut length) = (1.0_f64, 0.0);
    for i in (0..steps).rev() {
        let s = (f64::from(i) + 0.5) * step;
        let e = strain(s * s);
        let before = rear;
        rear *= (-s / e * step).exp();
        length += (before - rear) * (1.0 - e);
    }
    rear + length
}

/// Copper rods of Wilkins & Guinan (1973), the paper's power law, nothing fitted, end as long as they were measured.
pub fn assert_wilkins(run: impl Fn(&str) -> RunResult) {
    for (velocity, measured_mm) in [
        (89.0, 21.01),
        (123.0, 19.60),
        (153.0, 18.31),
        (183.0, 16.81),
    ] {
        let length = run(&wilkins(velocity)).projectile_final_length.unwrap() * 1e3;
        let what = format!("final length at {velocity} m/s [mm]");
        assert_near(&what, length, measured_mm, 0.03);
    }
}

/// Levels of plastic strain stand where their speed [m/s] has taken them from the wall by the last profile.
pub fn assert_levels(result: &RunResult, speed: impl Fn(f64) -> f64) {
    let profile = result.history.as_ref().unwrap().profiles.last().unwrap();
    // From the wall inwards plastic strain falls off; find where each level stands.
    let points: Vec<(f64, f64)> = profile
        .elements
        .iter()
        .rev()
        .map(|element| (-element.initial_position, element.plastic_strain))
        .collect();
    // The wall sees the speed ∫ c dε: it must lie beyond the levels looked at.
    let mut checked = 0;
    for plastic_strain in [0.005, 0.01, 0.015, 0.02] {
        let Some(pair) = points
            .windows(2)
            .find(|p| p[0].1 >= plastic_strain && p[1].1 < plastic_strain)
        else {
            continue;
        };
        let share = (pair[0].1 - plastic_strain) / (pair[0].1 - pair[1].1);
        let position = pair[0].0 + share * (pair[1].0 - pair[0].0);
        let what = format!("speed of plastic strain {plastic_strain} [m/s]");
        assert_near(&what, position / profile.time, speed(plastic_strain), 1e-2);
        checked += 1;
    }
    assert!(checked >= 3, "only {checked} levels were reached");
}
