//! Measured final values: lines across a chart versus time, and marks in a chart versus impact velocity.

use percuss::{
    Scenario, compare::ExperimentRecord, history::History, outcome::BandQuantity,
    units::significant,
};

use crate::{Series, Style, palette};

/// Relative difference of impact speeds that are one.
const SAME_SPEED: f64 = 1e-3;

/// A line a measured value of a quantity, with a band as wide as it may be off: of tests at the speed of the case.
pub(crate) fn lines(scenario: &Scenario, quantity: BandQuantity, history: &History) -> Vec<Series> {
    let (Some(first), Some(last)) = (history.samples.first(), history.samples.last()) else {
        return Vec::new();
    };
    let speed = scenario.impact_velocity;
    let of_this_test = scenario.experiments.iter().filter(|measured| {
        let same = |at: f64| (at - speed).abs() <= SAME_SPEED * speed;
        measured.quantity == quantity && measured.impact_velocity.is_some_and(same)
    });
    of_this_test
        .map(|measured| {
            let value = quantity.in_unit(measured.value);
            let error = measured.uncertainty.map(|error| quantity.in_unit(error));
            let off =
                error.map_or_else(String::new, |error| format!(" ± {}", significant(error, 4)));
            let name = format!(
                "measured {}{off} {} ({})",
                significant(value, 4),
                quantity.unit(),
                measured.sources.join(", ")
            );
            let times = [first.time * 1e6, last.time * 1e6];
            let band = error.map(|error| (value - error, value + error));
            Series::new(name, times.map(|time| (time, value)))
                .style(Style::Dashed)
                .width(2.0)
                .color(palette::EXPERIMENT)
                .band(band.into_iter().flat_map(|ends| [ends, ends]))
        })
        .collect()
}

/// Marks of the measured values of a quantity at their impact velocities; `None` without any.
pub(crate) fn versus_speed(
    measured: &[ExperimentRecord],
    quantity: BandQuantity,
) -> Option<Series> {
    let of_quantity = measured.iter().filter(|one| one.quantity == quantity);
    let placed: Vec<_> = of_quantity
        .filter_map(|one| Some((one.impact_velocity_m_s?, one)))
        .collect();
    let bar = |error: Option<f64>| error.map_or((0.0, 0.0), |error| (error, error));
    (!placed.is_empty()).then(|| {
        let points = placed.iter().map(|(speed, one)| (*speed, one.value));
        Series::new("experiment", points)
            .style(Style::Markers)
            .color(palette::EXPERIMENT)
            .error_bars(placed.iter().map(|(_, one)| bar(one.uncertainty)))
    })
}

#[cfg(test)]
mod tests {
    use percuss::{case, model};

    use super::*;

    #[test]
    fn lines_are_those_of_the_same_quantity_and_speed() {
        let test = |speed: u32, more: &str| {
            format!("[[experiments]]\nimpact_velocity = \"{speed} m/s\"\nsource = \"a\"\n{more}\n")
        };
        let text = [
            "projectile = { material = \"copper\", length = \"20 mm\", diameter = \"5 mm\", impact_velocity = \"200 m/s\" }\n",
            "target = { rigid_wall = true }\n",
            &test(
                200,
                "projectile_final_length = \"15 mm\"\nuncertainty = \"0.5 mm\"",
            ),
            &test(300, "projectile_final_length = \"12 mm\""),
        ];
        let scenario = case::load_str("case", &text.concat()).unwrap();
        let chain = model::model("chain").unwrap();
        let run = model::run(chain, &scenario, &mut model::Control::recording()).unwrap();
        let history = run.history.unwrap();
        let length = BandQuantity::ProjectileFinalLength;
        let found = lines(&scenario, length, &history);
        let [line] = found.as_slice() else {
            panic!("{found:?}");
        };
        assert_eq!(line.name, "measured 15 ± 0.5 mm (a)");
        let end = history.samples.last().unwrap().time * 1e6;
        assert_eq!(line.points, [(0.0, 15.0), (end, 15.0)]);
        assert_eq!(line.band, [(14.5, 15.5); 2]);
        assert!(lines(&scenario.at_impact_velocity(250.0), length, &history).is_empty());
        assert!(lines(&scenario, BandQuantity::DepthOfPenetration, &history).is_empty());
    }
}
