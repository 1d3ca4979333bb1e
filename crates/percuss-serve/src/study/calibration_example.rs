//! Example of measured values of a case.

use percuss::{
    Scenario,
    model::ChosenModel,
    outcome::{Outcome, RunResult},
    units::significant,
};

use crate::{job::Stop, problem::Problem, response};

/// Parts of the impact velocity at which there is a value, and parts of the computed number that it is.
const VALUES: [(f64, f64); 3] = [(0.8, 0.92), (1.0, 0.9), (1.2, 0.91)];
/// Digits of a value.
const DIGITS: usize = 4;

/// The text of a case with three tables `experiments` at its end, whose values are no measurements and say so.
pub(super) fn with_example(
    text: &str,
    scenario: &Scenario,
    chosen: &ChosenModel,
    stop: &Stop,
) -> Result<String, Problem> {
    let mut example = format!(
        "\n# Values for the button `Calibrate`. They are no measurements, but results of the model {}, changed by about 10 %: replace them by your own.\n",
        chosen.model.name()
    );
    let mut count = 0;
    for (part, factor) in VALUES {
        let speed = significant(part * scenario.impact_velocity, DIGITS);
        let at = speed.parse().unwrap_or(scenario.impact_velocity);
        let result = response::run(&scenario.at_impact_velocity(at), chosen, stop, None)?;
        if let Some((key, value, unit)) = main_number(&result) {
            count += 1;
            example += &format!(
                "[[experiments]]\nimpact_velocity = \"{speed} m/s\"\n{key} = \"{} {unit}\"\nsource = \"example\"\nnote = \"no measurement\"\n\n",
                significant(factor * value, DIGITS)
            );
        }
    }
    match count {
        0 => Err(Problem::refused(
            format!(
                "the case has no measured value, and the model `{}` gives no number that could be an example",
                chosen.model.name()
            ),
            "write a table `experiments` into the case, or select another model",
        )),
        _ => Ok(format!("{}\n{}\n", text.trim_end(), example.trim_end())),
    }
}

/// The number of a run that a test would measure: its key in a table `experiments`, value and unit.
fn main_number(result: &RunResult) -> Option<(&'static str, f64, &'static str)> {
    let positive = |value: Option<f64>| value.filter(|value| *value > 0.0);
    let residual = match result.outcome {
        Outcome::Perforated => positive(result.residual_velocity),
        _ => None,
    };
    let length = |value: Option<f64>| positive(value).map(|value| 1e3 * value);
    None.or(residual.map(|value| ("residual_velocity", value, "m/s")))
        .or(length(result.depth_of_penetration).map(|value| ("depth_of_penetration", value, "mm")))
        .or(length(result.projectile_final_length)
            .map(|value| ("projectile_final_length", value, "mm")))
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use percuss::{calibrate::Observations, case::Document, model};

    use super::*;
    use crate::cases;

    #[test]
    fn ready_cases_without_measured_values_can_have_one() {
        for wanted in [
            "paper-table1",
            "copper-on-aluminium-800",
            "layered-with-gap",
        ] {
            let all = cases::all();
            let case = all.iter().find(|case| case.name() == wanted).unwrap();
            let scenario = percuss::case::load_str(wanted, case.text()).unwrap();
            let chosen = model::default_model(&scenario).unwrap();
            let stop = Stop::after(Duration::from_secs(60));
            let text = with_example(case.text(), &scenario, &chosen, &stop).unwrap();
            assert!(text.starts_with(case.text().trim_end()), "{wanted}");
            assert!(text.contains("They are no measurements"), "{wanted}");
            let mut observations = Observations::default();
            let document = Document::new(wanted, text);
            observations.add_case(&document).unwrap();
            assert_eq!(observations.used.len(), VALUES.len(), "{wanted}");
        }
    }
}
