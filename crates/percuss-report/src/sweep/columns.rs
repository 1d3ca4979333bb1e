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
    columns.push(text("target_closure", |r| word(&r.target_closure), ""));
    columns.push(text(
        "criterion",
        |r| r.criterion.clone().unwrap_or_default(),
        "",
    ));
    let numbers: [(&str, ReadNumber); 32] = [
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
        ("contact_time_us", |r| r.contact_time_us),
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

#[cfg(test)]
mod tests {
    use percuss::{
        case::{self, Document},
        model::{self, Control},
        summary::ResultRecord,
        sweep::Sweep,
    };

    use super::columns;

    const CASE: &str = "projectile = { material = 'copper', length = '12.74 mm', diameter = '4.8 mm', velocity = '230 m/s' }\n\
                        target = { material = 'aluminium-2024-t351', thickness = '25 mm' }\n";

    /// Results that are no scalar, and the columns that hold them.
    const NOT_SCALAR: [(&str, &[&str]); 8] = [
        // The same in every row: the manifest has it.
        ("model", &[]),
        ("reason", &["error"]),
        ("band", &["band_of", "band_low", "band_high"]),
        (
            "expected_error",
            &[
                "expected_error",
                "expected_error_low",
                "expected_error_high",
            ],
        ),
        ("details", &["details"]),
        // A sweep names its model.
        ("model_choice", &[]),
        ("target_closure_choice", &["target_closure"]),
        ("warnings", &["warnings"]),
    ];

    #[test]
    fn every_scalar_result_is_a_column() {
        let scenario = case::load_str("case", CASE).unwrap();
        let chain = model::model("chain").unwrap();
        let result = model::run(chain, &scenario, &mut Control::default()).unwrap();
        let record = serde_json::to_value(ResultRecord::new(&scenario, &result)).unwrap();
        let file = "title = 'speeds'\nbase = 'case.toml'\nmodel = 'chain'\ndesign = 'grid'\n\
                    [[parameter]]\nkey = 'projectile.velocity'\nvalues = ['200 m/s', '230 m/s']\n";
        let (file, case) = (Document::new("sweep", file), Document::new("case", CASE));
        let sweep = Sweep::of(&file, &case).unwrap();
        let columns = columns(&sweep);
        let names: Vec<&str> = columns.iter().map(|column| column.name()).collect();
        let mut checked = 0;
        for (key, value) in record.as_object().unwrap() {
            let standing_for = NOT_SCALAR.iter().find(|(name, _)| name == key);
            match standing_for {
                Some((_, others)) => assert!(
                    others.iter().all(|name| names.contains(name)),
                    "{key}: {others:?}"
                ),
                // A list of objects of any number has no place in a row.
                None if key == "fragments" => assert!(value.is_array()),
                None => assert!(
                    names.contains(&key.as_str()),
                    "{key} is no column: {names:?}"
                ),
            }
            checked += 1;
        }
        assert!(checked > 30, "{checked}");
    }
}
