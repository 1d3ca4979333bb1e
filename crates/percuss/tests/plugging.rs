//! The chain with a shear band around the plug and a plate that dishes, against exact answers.

use std::f64::consts::PI;

use percuss::{
    Scenario, case,
    model::{self, Control},
    outcome::{Outcome, RunResult, Termination},
};

fn scenario(velocity: f64, target: &str, chain: &str) -> Scenario {
    let text = format!(
        r#"
        projectile = {{ material = "stiff", mass = "197 g", diameter = "20 mm", velocity = "{velocity} m/s" }}
        target = {{ material = "stiff", thickness = "12 mm", back_face = "free"{target} }}
        materials.stiff = {{ name = "stiff", density = "7850 kg/m3", youngs_modulus = "1400 GPa", poissons_ratio = 0.3, strength = {{ elastic = {{}} }} }}
        [chain]
        border_shear_law = "shear-band"
        {chain}
        "#
    );
    case::load_str("plug", &text).unwrap_or_else(|error| panic!("{error}"))
}

fn run(scenario: &Scenario) -> RunResult {
    let chain = model::model("chain").unwrap();
    model::run(chain, scenario, &mut Control::recording()).unwrap_or_else(|error| panic!("{error}"))
}

fn balanced(result: &RunResult) {
    let numerics = result.numerics();
    assert!(numerics.energy_residual < 1e-3, "{numerics:?}");
    assert!(numerics.momentum_residual < 1e-9, "{numerics:?}");
}

/// Stiff bodies without bounce move as rigid ones under a force that is small for them; the band takes the same work at any speed.
const LUMPED: &str = r#"
    projectile_elements = 1
    target_elements = 2
    damping_ratio = 2.0
    artificial_viscosity = { linear = 10.0 }
    shear_band = { width = "1.5 mm", shear_strength = "20 MPa", failure_strain = 2.0 }
"#;

/// Mass of the projectile and of the plug [kg].
fn masses() -> (f64, f64) {
    (0.197, 7850.0 * PI * 1e-4 * 0.012)
}

#[test]
fn with_its_shear_work_lumped_it_is_recht_and_ipson() {
    let (mass, plug) = masses();
    // The band is as long as the plug that is still inside: ∫ τ π D (h − u) du up to u = γ w.
    let slip: f64 = 2.0 * 1.5e-3;
    let work = 20e6 * PI * 0.02 * (0.012 * slip - 0.5 * slip * slip);
    let limit = (2.0 * work * (mass + plug)).sqrt() / mass;
    for speed in [1.2, 1.5, 2.0, 3.0].map(|k| k * limit) {
        let result = run(&scenario(speed, "", LUMPED));
        balanced(&result);
        assert_eq!(result.outcome, Outcome::Perforated);
        assert_eq!(result.termination, Termination::PlugFree);
        let exact = mass / (mass + plug) * (speed * speed - limit * limit).sqrt();
        let residual = result.residual_velocity.unwrap();
        let taken = result.numerics().energy.border_shear;
        println!(
            "{speed:.2} m/s, limit {limit:.2}: {residual:.4} of {exact:.4} ({:+.1e}), plug {:.4}, work {:+.1e}",
            residual / exact - 1.0,
            result.plug_velocity.unwrap(),
            taken / work - 1.0
        );
        assert!((residual / exact - 1.0).abs() < 1e-3);
        assert!((taken / work - 1.0).abs() < 1e-3);
        assert!((result.plug_mass.unwrap() / plug - 1.0).abs() < 1e-12);
    }
    for speed in [0.97, 0.995].map(|k| k * limit) {
        let result = run(&scenario(speed, "", LUMPED));
        balanced(&result);
        assert_ne!(result.outcome, Outcome::Perforated);
        assert_eq!(result.plug_velocity, None);
    }
}

#[test]
fn a_plug_that_is_free_keeps_its_momentum() {
    let chain =
        "shear_band = { width = \"0.2 mm\", shear_strength = \"300 MPa\", failure_strain = 1.0 }";
    let result = run(&scenario(150.0, "", chain));
    balanced(&result);
    let history = result.history.as_ref().unwrap();
    let free = result
        .details
        .iter()
        .find(|detail| detail.name == "plug free")
        .unwrap()
        .value
        * 1e-6;
    let after: Vec<f64> = history
        .samples
        .iter()
        .filter(|sample| sample.time > free && sample.contact_force == 0.0)
        .map(|sample| sample.momentum.target)
        .collect();
    assert!(after.len() > 20);
    let last = after[after.len() - 1];
    // From where projectile and plug have parted for good nothing acts on it.
    let parted = after
        .iter()
        .rev()
        .take_while(|p| (*p / last - 1.0).abs() < 1e-12);
    assert!(parted.count() > after.len() / 3, "{after:?}");
    assert!((result.plug_mass.unwrap() * result.plug_velocity.unwrap() / last - 1.0).abs() < 1e-12);
}
