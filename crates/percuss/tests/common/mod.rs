//! Cases that several tests build on.

pub mod expected;
pub mod plates;
pub mod rods;

use percuss::{
    Scenario, case,
    history::Sample,
    model::{self, Control},
    outcome::RunResult,
};

/// Reads a case, failing the test with the message a user would see.
pub fn scenario(text: &str) -> Scenario {
    case::load_str("test", text).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// Runs a case by the chain model.
pub fn run(text: &str) -> RunResult {
    run_with(text, &mut Control::default())
}

/// Runs a case by the chain model, keeping its histories.
pub fn run_recorded(text: &str) -> RunResult {
    run_with(text, &mut Control::recording())
}

fn run_with(text: &str, control: &mut Control<'_>) -> RunResult {
    let chain = model::model("chain").unwrap();
    model::run(chain, &scenario(text), control).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// Runs a case by the finite-difference model.
pub fn fdm(text: &str) -> RunResult {
    fdm_with(text, &mut Control::default())
}

/// Runs a case by the finite-difference model, keeping its histories.
pub fn fdm_recorded(text: &str) -> RunResult {
    fdm_with(text, &mut Control::recording())
}

fn fdm_with(text: &str, control: &mut Control<'_>) -> RunResult {
    let fdm = model::model("fdm").unwrap();
    model::run(fdm, &scenario(text), control).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// Mean of a value over the samples of a span of time [s], weighted by time.
pub fn mean(result: &RunResult, from: f64, to: f64, value: impl Fn(&Sample) -> f64) -> f64 {
    let samples = &result.history.as_ref().unwrap().samples;
    let (mut sum, mut time) = (0.0, 0.0);
    for pair in samples
        .windows(2)
        .filter(|pair| pair[0].time >= from && pair[1].time <= to)
    {
        let step = pair[1].time - pair[0].time;
        sum += 0.5 * step * (value(&pair[0]) + value(&pair[1]));
        time += step;
    }
    assert!(
        time > 0.5 * (to - from),
        "too few samples between {from} and {to} s"
    );
    sum / time
}

/// Fails unless a value is within a fraction of what it should be.
#[track_caller]
pub fn assert_near(what: &str, value: f64, exact: f64, fraction: f64) {
    let error = (value - exact) / exact;
    println!(
        "{what}: {value:.6e}, exact {exact:.6e}, error {:+.4} %",
        100.0 * error
    );
    assert!(
        error.abs() <= fraction,
        "{what}: {value:e} is {:+.4} % off {exact:e}, more than {} %",
        100.0 * error,
        100.0 * fraction
    );
}

/// The paper's rod and target: Table 1.
pub fn paper(velocity: f64, elements: (u32, u32), options: &str) -> String {
    format!(
        r#"
        projectile = {{ material = "copper", length = "12.74 mm", diameter = "4.8 mm", impact_velocity = "{velocity} m/s" }}
        target = {{ material = "aluminium-2024-t351", thickness = "25 mm" }}
        [chain]
        projectile_elements = {}
        target_elements = {}
        {options}
        "#,
        elements.0, elements.1
    )
}

/// A copper rod of Wilkins & Guinan on a rigid wall.
pub fn wilkins(velocity: f64) -> String {
    format!(
        r#"
        projectile = {{ material = "copper", length = "23.47 mm", diameter = "7.62 mm", impact_velocity = "{velocity} m/s" }}
        target = {{ rigid_wall = true }}
        "#
    )
}

/// A perfectly plastic metal of a case.
pub fn plastic_metal(
    id: &str,
    density: f64,
    youngs_modulus_gpa: f64,
    flow_stress_mpa: f64,
) -> String {
    format!(
        r#"
        [materials.{id}]
        name = "{id}"
        density = "{density} kg/m3"
        youngs_modulus = "{youngs_modulus_gpa} GPa"
        poissons_ratio = 0.3
        strength.perfectly_plastic = {{ flow_stress = "{flow_stress_mpa} MPa" }}
        "#
    )
}
