//! The columns of a sweep: inputs, outcome, every scalar result, warnings and errors.

use percuss::{summary::ResultRecord, sweep::Row, sweep::Sweep};
use serde::Serialize;

use crate::column::Column;

/// How a number that a result may lack is read off it.
type ReadNumber = fn(&ResultRecord) -> Option<f64>;

/// The columns of a sweep's rows. A number that a shot does not have is null, a text empty.
pub(super) fn columns(sweep: &Sweep) -> Vec<Column<Row>> {
    let mut columns = vec![Column::integer("shot", |row: &Row| row.index as i64)];
    for (i, axis) in sweep.axes.iter().enumerate() {
        columns.push(match axis.words() {
            None => Column::float(axis.column(), move |row: &Row| row.inputs[i]),
            Some(words) => Column::text(axis.column(), move |row: &Row| {
                words[row.inputs[i] as usize].clone()
            }),
        });
    }
    columns.push(text("outcome", |r| word(&r.outcome), "failed"));
    columns.push(text("termination", |r| word(&r.termination), ""));
    columns.push(text("scheme", |r| r.scheme.to_owned(), ""));
    let numbers: [(&str, ReadNumber); 31] = [
        ("impact_velocity_m_s", |r| Some(r.impact_velocity_m_s)),
        ("impact_energy_j", |r| Some(r.impact_energy_j)),
        ("depth_of_penetration_mm", |r| r.depth_of_penetration_mm),
        ("largest_depth_mm", |r| r.largest_depth_mm),
        ("permanent_depth_mm", |r| r.permanent_depth_mm),
        ("residual_velocity_m_s", |r| r.residual_velocity_m_s),
        ("ballistic_limit_m_s", |r| r.ballistic_limit_m_s),
        ("band_low", |r| r.band.as_ref().map(|band| band.low)),
        ("band_high", |r| r.band.as_ref().map(|band| band.high)),
        ("expected_error", |r| {
            r.expected_error.as_ref().map(|e| e.median)
        }),
        ("expected_error_low", |r| {
            r.expected_error.as_ref().map(|e| e.low)
        }),
        ("expected_error_high", |r| {
            r.expected_error.as_ref().map(|e| e.high)
        }),
        ("projectile_final_length_mm", |r| {
            r.projectile_final_length_mm
        }),
        ("projectile_final_diameter_mm", |r| {
            r.projectile_final_diameter_mm
        }),
        ("projectile_final_mass_g", |r| r.projectile_final_mass_g),
        ("plug_mass_g", |r| r.plug_mass_g),
        ("plug_velocity_m_s", |r| r.plug_velocity_m_s),
        ("time_to_rest_us", |r| r.time_to_rest_us),
        ("peak_force_kn", |r| r.peak_force_kn),
        ("end_time_us", |r| r.end_time_us),
        ("steps", |r| r.steps.map(|steps| steps as f64)),
        ("time_step_ns", |r| r.time_step_ns),
        ("smallest_time_step_ns", |r| r.smallest_time_step_ns),
        ("eroded_projectile_elements", |r| {
            r.eroded_projectile_elements.map(|n| n as f64)
        }),
        ("eroded_target_elements", |r| {
            r.eroded_target_elements.map(|n| n as f64)
        }),
        ("projectile_plastic_strain", |r| r.projectile_plastic_strain),
        ("target_plastic_strain", |r| r.target_plastic_strain),
        ("projectile_temperature_k", |r| r.projectile_temperature_k),
        ("target_temperature_k", |r| r.target_temperature_k),
        ("energy_residual", |r| r.energy_residual),
        ("momentum_residual", |r| r.momentum_residual),
    ];
    for (name, read) in numbers {
        columns.push(Column::optional(name, move |row: &Row| {
            row.record.as_ref().ok().and_then(read)
        }));
    }
    let band = |r: &ResultRecord| {
        r.band
            .as_ref()
            .map_or_else(String::new, |b| word(&b.quantity))
    };
    columns.push(text("band_of", band, ""));
    columns.push(text("details", |r| json(&r.details), "[]"));
    columns.push(text("warnings", |r| r.warnings.join("\n"), ""));
    columns.push(Column::text("error", |row: &Row| match &row.record {
        Ok(record) => record.reason.clone().unwrap_or_default(),
        Err(reason) => reason.clone(),
    }));
    columns
}

/// A text of the result; `without` stands where there is no case to compute.
fn text(
    name: &str,
    read: impl Fn(&ResultRecord) -> String + 'static,
    without: &'static str,
) -> Column<Row> {
    Column::text(name, move |row: &Row| match &row.record {
        Ok(record) => read(record),
        Err(_) => without.to_owned(),
    })
}

/// The name that a value has in JSON; empty when there is none.
pub(super) fn word(value: &impl Serialize) -> String {
    json(value).trim_matches('"').replace("null", "")
}

fn json(value: &impl Serialize) -> String {
    // Words and numbers always make JSON.
    serde_json::to_string(value).unwrap_or_default()
}
