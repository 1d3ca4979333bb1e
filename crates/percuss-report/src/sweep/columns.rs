//! Columns of a sweep: inputs, outcome, scalar results, warnings and errors.

use percuss::{
    model_error::ModelErrorEstimate,
    summary::{ResultRecord, Role, result_numbers},
    sweep::{Sweep, SweepRow},
};
use serde::Serialize;

use crate::column::{Column, word};

/// The result number that the ends of ranges and the estimated error follow.
const BEFORE_RANGES: &str = "ballistic_limit_m_s";

/// The columns of a sweep's rows. A number that a run does not have is null, a text empty.
pub(super) fn columns(sweep: &Sweep) -> Vec<Column<SweepRow>> {
    let mut columns = vec![Column::integer("run", |row: &SweepRow| row.index as i64)];
    for (i, axis) in sweep.axes.iter().enumerate() {
        let value = move |row: &SweepRow| row.inputs[i];
        columns.push(Column::varied(axis.column(), axis.words(), value));
    }
    columns.push(text("outcome", |r| word(&r.outcome), "failed"));
    columns.push(text("termination", |r| word(&r.termination), ""));
    columns.push(text("scheme", |r| r.scheme.to_owned(), ""));
    columns.push(text(
        "target_resistance",
        |r| word(&r.target_resistance),
        "",
    ));
    columns.push(text(
        "criterion",
        |r| r.criterion.clone().unwrap_or_default(),
        "",
    ));
    // What the case gives stands before what comes of it.
    let given = result_numbers().filter(|number| number.role == Role::Input);
    let computed = result_numbers().filter(|number| number.role != Role::Input);
    for result in given.chain(computed) {
        columns.push(number(result.name, |r| result.of(r)));
        if result.name == BEFORE_RANGES {
            columns.extend(ranges());
        }
    }
    let band = |r: &ResultRecord| {
        r.band
            .as_ref()
            .map_or_else(String::new, |b| word(&b.quantity))
    };
    columns.push(text("band_of", band, ""));
    columns.push(text("details", |r| json(&r.details), "[]"));
    columns.push(text("warnings", |r| json(&r.warnings), "[]"));
    columns.push(Column::text("error", |row: &SweepRow| match &row.record {
        Ok(record) => record.reason.clone().unwrap_or_default(),
        Err(reason) => reason.clone(),
    }));
    columns
}

/// The ends of the range that a model gives, and the estimated error of the depth.
fn ranges() -> [Column<SweepRow>; 5] {
    let error = |name, read: fn(&ModelErrorEstimate) -> f64| {
        number(name, move |r| r.expected_error.as_ref().map(read))
    };
    [
        number("band_low", |r| r.band.as_ref().map(|band| band.low)),
        number("band_high", |r| r.band.as_ref().map(|band| band.high)),
        error("expected_error", |e| e.median),
        error("expected_error_low", |e| e.low),
        error("expected_error_high", |e| e.high),
    ]
}

/// A number of the result, null where there is none.
fn number(name: &str, read: impl Fn(&ResultRecord) -> Option<f64> + 'static) -> Column<SweepRow> {
    Column::optional(name, move |row: &SweepRow| {
        row.record.as_ref().ok().and_then(&read)
    })
}

/// A text of the result; `without` stands where there is no case to compute.
fn text(
    name: &str,
    read: impl Fn(&ResultRecord) -> String + 'static,
    without: &'static str,
) -> Column<SweepRow> {
    Column::text(name, move |row: &SweepRow| match &row.record {
        Ok(record) => read(record),
        Err(_) => without.to_owned(),
    })
}

fn json(value: &impl Serialize) -> String {
    // Words and numbers always make JSON.
    serde_json::to_string(value).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use percuss::{
        case::Document,
        summary::{RESULT_FIELDS, result_numbers},
        sweep::Sweep,
    };

    use super::columns;

    const CASE: &str = "projectile = { material = 'copper', length = '12.74 mm', diameter = '4.8 mm', impact_velocity = '230 m/s' }\n\
                        target = { material = 'aluminium-2024-t351', thickness = '25 mm' }\n";

    /// Results that are no number, and the columns that hold them.
    const NO_NUMBERS: [(&str, &[&str]); 15] = [
        // The same in every row: the manifest has it.
        ("model", &[]),
        ("scheme", &["scheme"]),
        // A sweep names its model.
        ("model_choice", &[]),
        ("target_resistance", &["target_resistance"]),
        ("target_resistance_choice", &[]),
        ("outcome", &["outcome"]),
        ("criterion", &["criterion"]),
        ("termination", &["termination"]),
        ("reason", &["error"]),
        (
            "expected_error",
            &[
                "expected_error",
                "expected_error_low",
                "expected_error_high",
            ],
        ),
        ("band", &["band_of", "band_low", "band_high"]),
        // A list of tables of any number has no place in a row.
        ("fragments", &[]),
        // Measured curves are of the case as it stands.
        ("measured_curves", &[]),
        ("details", &["details"]),
        ("warnings", &["warnings"]),
    ];

    #[test]
    fn columns_are_the_fields_of_a_result_and_nothing_else() {
        let file = "title = 'speeds'\nbase = 'case.toml'\nmodel = 'chain'\ndesign = 'grid'\n\
                    [[parameter]]\nkey = 'projectile.impact_velocity'\nvalues = ['200 m/s', '230 m/s']\n";
        let (file, case) = (Document::new("sweep", file), Document::new("case", CASE));
        let sweep = Sweep::of(&file, &case).unwrap();
        let columns = columns(&sweep);
        let found: BTreeSet<&str> = columns.iter().map(|column| column.name()).collect();
        let mut expected = BTreeSet::from(["run", "projectile.impact_velocity_m_s"]);
        for field in RESULT_FIELDS {
            let held = NO_NUMBERS.iter().find(|(name, _)| *name == field.name);
            match (&field.number, held) {
                (Some(number), None) => assert!(expected.insert(number.name)),
                (None, Some((_, names))) => expected.extend(*names),
                other => panic!("{}: {other:?}", field.name),
            }
        }
        assert_eq!(found, expected);
        assert_eq!(found.len(), columns.len());
        let kind = |name: &str| columns.iter().find(|c| c.name() == name).unwrap().kind();
        assert!(result_numbers().all(|number| kind(number.name) == "number"));
    }
}
