//! A rigid projectile against a plate, by any model.

use percuss::{
    Error, Scenario, case,
    model::{self, Control},
    outcome::RunResult,
};

pub fn scenario(nose: &str, velocity: f64, thickness_mm: f64, plate: &str, more: &str) -> Scenario {
    let text = format!(
        r#"
        projectile = {{ material = "rigid", mass = "197 g", diameter = "20 mm", nose = {nose}, impact_velocity = "{velocity} m/s" }}
        target = {{ material = "plate", thickness = "{thickness_mm} mm" }}
        materials.rigid = {{ name = "rigid", density = "7850 kg/m3", youngs_modulus = "210 GPa", poissons_ratio = 0.3, strength = {{ elastic = {{}} }} }}
        materials.plate = {{ name = "plate", density = "2700 kg/m3", youngs_modulus = "70 GPa", poissons_ratio = 0.33, {plate} }}
        {more}
        "#
    );
    case::load_str("plate", &text).unwrap_or_else(|error| panic!("{error}"))
}

pub const METAL: &str = "strength = { power_law = { coefficient = \"400 MPa\", exponent = 0.08 } }";
pub const CONE: &str = "{ cone = { length_to_diameter = 1.5 } }";
pub const OGIVE: &str = "{ ogive = { crh = 3.0 } }";

pub fn run(name: &str, scenario: &Scenario) -> RunResult {
    try_run(name, scenario).unwrap_or_else(|error| panic!("{error}"))
}

pub fn try_run(name: &str, scenario: &Scenario) -> Result<RunResult, Error> {
    model::run(model::model(name)?, scenario, &mut Control::default())
}

pub fn refusal(name: &str, scenario: &Scenario) -> String {
    match try_run(name, scenario) {
        Err(Error::NotApplicable { refusal, .. }) => refusal.to_string(),
        other => panic!("{name}: {other:?}"),
    }
}

pub fn detail(result: &RunResult, name: &str) -> f64 {
    let found = result.details.iter().find(|detail| detail.name == name);
    found.unwrap_or_else(|| panic!("no {name}")).value
}
