//! The result of a run as rows of a label and a value, for a terminal and a page alike.

use percuss::{
    Scenario,
    outcome::{Detail, Numerics, RunResult},
    summary::ResultRecord,
    units::significant,
};

/// A label and a value with its unit.
pub type Row = (String, String);

#[derive(Default)]
struct Rows(Vec<Row>);

impl Rows {
    fn add(&mut self, label: &str, value: impl Into<String>) {
        self.0.push((label.to_owned(), value.into()));
    }
}

/// How the shot ended and what is left.
pub fn outcome_rows(scenario: &Scenario, result: &RunResult, record: &ResultRecord) -> Vec<Row> {
    let mut rows = Rows::default();
    rows.add("outcome", result.outcome.in_words());
    if let Some(criterion) = &record.criterion {
        rows.add("told by", criterion.as_str());
    }
    rows.add("run ended because", result.termination.in_words());
    let mut present = |label: &str, value: Option<f64>, unit: &str| {
        if let Some(value) = value {
            rows.add(label, number(value, unit));
        }
    };
    present("depth of penetration", record.depth_of_penetration_mm, "mm");
    if let Some(expected) = &record.expected_error {
        let words = format!(
            "{} against the axisymmetric reference, over the {} most similar shots of the judgement",
            expected.in_words(),
            expected.shots
        );
        rows.add("its expected error", words);
    }
    let mut present = |label: &str, value: Option<f64>, unit: &str| {
        if let Some(value) = value {
            rows.add(label, number(value, unit));
        }
    };
    present("largest depth", record.largest_depth_mm, "mm");
    present("permanent depth", record.permanent_depth_mm, "mm");
    present("ballistic limit", record.ballistic_limit_m_s, "m/s");
    if let Some(band) = &record.band {
        let range = format!(
            "{} to {} ({})",
            significant(band.low, 4),
            number(band.high, band.quantity.unit()),
            band.basis
        );
        rows.add(&format!("range of {}", band.quantity.in_words()), range);
    }
    if let Some(time) = record.time_to_rest_us {
        rows.add("time to rest", number(time, "us"));
    } else if result.numerics.is_some() {
        rows.add("time to rest", "not reached");
    }
    if let Some(velocity) = record.residual_velocity_m_s {
        let direction = match velocity {
            v if v < 0.0 => " (backwards)",
            v if v > 0.0 => " (forward)",
            _ => "",
        };
        rows.add("residual velocity", number(velocity, "m/s") + direction);
    }
    if let (Some(mass), Some(velocity)) = (record.plug_mass_g, record.plug_velocity_m_s) {
        let flight = format!("{} at {}", number(mass, "g"), number(velocity, "m/s"));
        rows.add("plug", flight);
    }
    let rod = &scenario.projectile;
    let remains = [
        (
            "final projectile length",
            record.projectile_final_length_mm,
            rod.length * 1e3,
            "mm",
        ),
        (
            "final projectile diameter",
            record.projectile_final_diameter_mm,
            rod.diameter * 1e3,
            "mm",
        ),
        (
            "final projectile mass",
            record.projectile_final_mass_g,
            rod.mass * 1e3,
            "g",
        ),
    ];
    for (label, value, initial, unit) in remains {
        if let Some(value) = value {
            rows.add(label, of_initial(value, initial, unit));
        } else if result.numerics.is_some() {
            rows.add(label, "none");
        }
    }
    if let Some(force) = record.peak_force_kn {
        rows.add("peak force", number(force, "kN"));
    }
    if let Some(time) = record.contact_time_us {
        rows.add("contact time", number(time, "us"));
    }
    rows.0
}

/// Numbers that a model alone has.
pub fn detail_rows(result: &RunResult) -> Vec<Row> {
    let row = |detail: &Detail| (detail.name.to_owned(), number(detail.value, detail.unit));
    result.details.iter().map(row).collect()
}

/// How well the books balance, and the steps.
pub fn book_rows(numerics: &Numerics, end_time: f64) -> Vec<Row> {
    let off = |residual: f64, what: &str| match residual {
        0.0 => format!("0 of the initial {what}"),
        _ => format!("{residual:.1e} of the initial {what}"),
    };
    let mut rows = Rows::default();
    rows.add("energy residual", off(numerics.energy_residual, "energy"));
    rows.add(
        "momentum residual",
        off(numerics.momentum_residual, "momentum"),
    );
    let steps = format!("{}, up to {}", numerics.steps, number(end_time * 1e6, "us"));
    rows.add("steps", steps);
    let mut step = number(numerics.first_time_step * 1e9, "ns");
    if numerics.smallest_time_step < numerics.first_time_step {
        step += &format!(
            " at first, smallest {}",
            number(numerics.smallest_time_step * 1e9, "ns")
        );
    }
    rows.add("time step", step);
    rows.0
}

/// A number to five digits with its unit.
pub fn number(value: f64, unit: &str) -> String {
    format!("{} {unit}", significant(value, 5))
        .trim_end()
        .to_owned()
}

fn of_initial(value: f64, initial: f64, unit: &str) -> String {
    format!(
        "{} ({} % of {})",
        number(value, unit),
        percentage(value / initial),
        number(initial, unit)
    )
}

/// A share in percent: two decimals, and more for what would read as nothing.
pub fn percentage(share: f64) -> String {
    let percent = 100.0 * share;
    if percent != 0.0 && percent.abs() < 0.005 {
        format!("{percent:.0e}")
    } else {
        format!("{percent:.2}")
    }
}
