//! Projectiles that start hot.

use percuss::{
    Error, case,
    model::{self, Control},
    outcome::RunResult,
};

fn run(material: &str, temperature: &str) -> Result<RunResult, Error> {
    let text = format!(
        "projectile = {{ material = '{material}', length = '30 mm', diameter = '6 mm', impact_velocity = '188 m/s'{temperature} }}\n\
         target = {{ rigid_wall = true }}"
    );
    let scenario = case::load_str("hot", &text)?;
    model::run(model::model("chain")?, &scenario, &mut Control::default())
}

#[test]
fn a_hotter_rod_ends_shorter() {
    let length = |temperature| {
        let result = run("etp-copper-johnson-cook", temperature).unwrap();
        result.projectile_final_length.unwrap()
    };
    let room = length("");
    // The record's own room temperature, said aloud, changes nothing.
    assert_eq!(length(", temperature = '294 K'"), room);
    let (warm, hot) = (
        length(", temperature = '500 K'"),
        length(", temperature = '718 K'"),
    );
    assert!(
        hot < 0.95 * warm && warm < 0.98 * room,
        "{hot} {warm} {room}"
    );
}

#[test]
fn a_rod_gets_hotter_from_where_it_starts() {
    let text = "projectile = { material = 'etp-copper-johnson-cook', length = '30 mm', diameter = '6 mm', impact_velocity = '188 m/s', temperature = '718 K' }\n\
                target = { rigid_wall = true }";
    let scenario = case::load_str("hot", text).unwrap();
    let chain = model::model("chain").unwrap();
    let result = model::run(chain, &scenario, &mut Control::recording()).unwrap();
    assert!(result.numerics().largest_temperature.0 > 718.0);
    // Elements have equal masses, and nine tenths of the plastic work are heat.
    let last = result.history.as_ref().unwrap().profiles.last().unwrap();
    let rises = last.elements.iter().map(|e| e.temperature - 718.0);
    let mean = rises.sum::<f64>() / last.elements.len() as f64;
    let heat = 0.9 * result.numerics().energy.plastic_projectile;
    let expected = heat / (scenario.projectile.mass * 383.0);
    println!("mean rise {mean} K of {expected} K");
    assert!((mean / expected - 1.0).abs() < 1e-10);
}

#[test]
fn what_cannot_follow_the_temperature_refuses_it() {
    let reason = match run("copper-woodward", ", temperature = '718 K'") {
        Err(Error::NotApplicable { refusal, .. }) => refusal.to_string(),
        other => panic!("{other:?}"),
    };
    assert!(reason.contains("does not tell 718 K"), "{reason}");
    // The record has 293 K.
    assert!(run("copper-woodward", ", temperature = '20 celsius'").is_ok());
    assert!(run("copper-woodward", ", temperature = '300 K'").is_err());
    let melted = run("etp-copper-johnson-cook", ", temperature = '1400 K'")
        .unwrap_err()
        .to_string();
    assert!(
        melted.contains("projectile.temperature") && melted.contains("melts at 1356 K"),
        "{melted}"
    );
}
