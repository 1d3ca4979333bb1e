//! Projectiles that start hot.

use percuss::{
    Error, case,
    model::{self, Control},
    outcome::RunResult,
};

fn run(material: &str, temperature: &str) -> Result<RunResult, Error> {
    let text = format!(
        "projectile = {{ material = '{material}', length = '30 mm', diameter = '6 mm', velocity = '188 m/s'{temperature} }}\n\
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
    let result = run("etp-copper-johnson-cook", ", temperature = '718 K'").unwrap();
    assert!(result.numerics().largest_temperature.0 > 718.0);
}

#[test]
fn what_cannot_follow_the_temperature_refuses_it() {
    let reason = match run("copper-woodward", ", temperature = '718 K'") {
        Err(Error::NotApplicable { reason, .. }) => reason,
        other => panic!("{other:?}"),
    };
    assert!(reason.contains("does not tell 718 K"), "{reason}");
    let melted = run("etp-copper-johnson-cook", ", temperature = '1400 K'")
        .unwrap_err()
        .to_string();
    assert!(
        melted.contains("projectile.temperature") && melted.contains("melts at 1356 K"),
        "{melted}"
    );
}
