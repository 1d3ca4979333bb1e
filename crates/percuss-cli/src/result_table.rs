//! The result of a run as text for people.

use percuss::{
    Scenario,
    outcome::RunResult,
    summary::ResultRecord,
    units::{Velocity, significant},
};

use crate::terminal::{bold, width, wrap, yellow};

const LABEL: usize = 28;
/// Characters of a full bar.
const BAR: f64 = 30.0;
/// Part of the initial energy below which a line is rounding, not physics.
const NEGLIGIBLE: f64 = 1e-9;

/// Table, energy shares, books and warnings.
pub fn text(scenario: &Scenario, result: &RunResult, record: &ResultRecord) -> String {
    let mut text = String::new();
    head(scenario, result, &mut text);
    outcome(scenario, result, record, &mut text);
    energy(result, &mut text);
    books(record, &mut text);
    warnings(result, &mut text);
    text
}

fn head(scenario: &Scenario, result: &RunResult, text: &mut String) {
    let title = if scenario.title.is_empty() {
        &scenario.name
    } else {
        &scenario.title
    };
    *text += &format!("{}\n", bold(wrap(title, width(), 0)));
    let line = format!(
        "case {}, impact at {}, model {}, scheme {}",
        scenario.name,
        Velocity::new(scenario.impact_speed),
        result.model,
        result.scheme
    );
    *text += &format!("{}\n\n", wrap(&line, width(), 0));
}

fn outcome(scenario: &Scenario, result: &RunResult, record: &ResultRecord, text: &mut String) {
    row("outcome", bold(result.outcome.in_words()), text);
    let reason = wrap(result.termination.in_words(), width() - LABEL, 0);
    row(
        "run ended because",
        reason.replace('\n', &format!("\n{:LABEL$}", "")),
        text,
    );
    let mm = |value: Option<f64>| value.map(|value| number(value, "mm"));
    let lengths = [
        ("depth of penetration", record.depth_of_penetration_mm),
        ("largest depth", record.largest_depth_mm),
        ("permanent depth", record.permanent_depth_mm),
    ];
    for (label, value) in lengths {
        optional(label, mm(value), "none", text);
    }
    optional(
        "time to rest",
        record.time_to_rest_us.map(|time| number(time, "us")),
        "not reached",
        text,
    );
    let direction = match record.residual_velocity_m_s {
        v if v < 0.0 => " (backwards)",
        v if v > 0.0 => " (forward)",
        _ => "",
    };
    row(
        "residual velocity",
        number(record.residual_velocity_m_s, "m/s") + direction,
        text,
    );
    let rod = &scenario.projectile;
    row(
        "final projectile length",
        of_initial(record.projectile_final_length_mm, rod.length * 1e3, "mm"),
        text,
    );
    optional(
        "final projectile diameter",
        record
            .projectile_final_diameter_mm
            .map(|diameter| of_initial(diameter, rod.diameter * 1e3, "mm")),
        "none",
        text,
    );
    row(
        "final projectile mass",
        of_initial(record.projectile_final_mass_g, rod.mass * 1e3, "g"),
        text,
    );
    row("peak force", number(record.peak_force_kn, "kN"), text);
}

fn energy(result: &RunResult, text: &mut String) {
    let initial = result.energy.initial;
    if initial == 0.0 {
        return;
    }
    let heading = format!("energy at the end, in % of {}", number(initial, "J"));
    *text += &format!("\n{}\n", bold(heading));
    for (label, value) in result.energy.lines() {
        let share = value / initial;
        if share.abs() < NEGLIGIBLE {
            continue;
        }
        let bar = "█".repeat((share.max(0.0) * BAR).round().min(2.0 * BAR) as usize);
        let percent = percentage(share);
        *text += format!("  {label:<26}{percent:>7} %  {bar}").trim_end();
        text.push('\n');
    }
}

fn books(record: &ResultRecord, text: &mut String) {
    *text += &format!("\n{}\n", bold("books and steps"));
    let off = |residual: f64, what: &str| match residual {
        0.0 => format!("0 of the initial {what}"),
        _ => format!("{residual:.1e} of the initial {what}"),
    };
    row(
        "energy residual",
        off(record.energy_residual, "energy"),
        text,
    );
    row(
        "momentum residual",
        off(record.momentum_residual, "momentum"),
        text,
    );
    let steps = format!(
        "{}, up to {}",
        record.steps,
        number(record.end_time_us, "us")
    );
    row("steps", steps, text);
    let mut step = number(record.time_step_ns, "ns");
    if record.smallest_time_step_ns < record.time_step_ns {
        step += &format!(
            " at first, smallest {}",
            number(record.smallest_time_step_ns, "ns")
        );
    }
    row("time step", step, text);
}

fn warnings(result: &RunResult, text: &mut String) {
    for warning in &result.warnings {
        let wrapped = wrap(&format!("warning: {warning}"), width(), 9);
        let marked = wrapped.replacen("warning:", &yellow("warning:"), 1);
        *text += &format!("\n{marked}\n");
    }
}

fn row(label: &str, value: impl AsRef<str>, text: &mut String) {
    *text += &format!("{label:<LABEL$}{}\n", value.as_ref());
}

fn optional(label: &str, value: Option<String>, otherwise: &str, text: &mut String) {
    row(label, value.as_deref().unwrap_or(otherwise), text);
}

fn number(value: f64, unit: &str) -> String {
    format!("{} {unit}", significant(value, 5))
}

fn of_initial(value: f64, initial: f64, unit: &str) -> String {
    format!(
        "{} ({} % of {})",
        number(value, unit),
        percentage(value / initial),
        number(initial, unit)
    )
}

/// Two decimals, and more for what would read as nothing.
fn percentage(share: f64) -> String {
    let percent = 100.0 * share;
    if percent != 0.0 && percent.abs() < 0.005 {
        format!("{percent:.0e}")
    } else {
        format!("{percent:.2}")
    }
}
