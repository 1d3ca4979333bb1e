//! Tables of a validation report.

use std::collections::BTreeMap;

use percuss::{
    experiments::{Experiment, Kind},
    material::references,
    units::significant,
    validate::{self, Errors, Group, Grouping, Prediction, SEPARATOR, Standing, Validation},
};

use crate::table::{Rows, Table};

/// A relative error in per cent.
pub(super) fn percent(error: f64) -> String {
    format!("{:.1}", 100.0 * error)
}

/// A relative error in per cent with its sign.
fn signed(error: f64) -> String {
    format!("{:+.1}", 100.0 * error)
}

fn of_kind(validation: &Validation, kind: Kind, grouping: Grouping) -> Vec<Group> {
    let mut groups = validate::statistics(validation, grouping);
    groups.retain(|group| group.kind == kind);
    groups
}

/// Columns of error statistics.
fn errors<R>(rows: Rows<'_, R>, of: impl Fn(&R) -> &Errors) -> Rows<'_, R> {
    rows.numbers("n", "", |row| of(row).count.to_string())
        .numbers("bias", "%", |row| signed(of(row).bias))
        .numbers("RMS", "%", |row| percent(of(row).rms))
        .numbers("median", "%", |row| percent(of(row).median_absolute))
        .numbers("worst", "%", |row| signed(of(row).worst))
}

/// Errors of the models on tests of a kind, one row per model.
pub fn models(validation: &Validation, kind: Kind) -> Table {
    let groups = of_kind(validation, kind, Grouping::All);
    let rows = Table::of(&groups).words("model", Group::model_in_words);
    errors(rows, |group| &group.errors)
        .words("worst test", |group| group.errors.worst_id.clone())
        .table()
}

/// Errors on tests of a kind by a property of the tests, one row per model and value of the property.
pub fn by_property(validation: &Validation, kind: Kind, grouping: Grouping) -> Table {
    let groups = of_kind(validation, kind, grouping);
    let heading = format!("by {}", grouping.describe());
    let rows = Table::of(&groups).words(heading, |group| group.value.clone());
    errors(rows, |group| &group.errors).table()
}

/// One row per group and model, sorted by groups.
pub(super) fn groups(validation: &Validation, kind: Kind, grouping: Grouping) -> Table {
    let mut groups = of_kind(validation, kind, grouping);
    // A stable sort: within a group the models keep their order.
    groups.sort_by(|a, b| a.value.cmp(&b.value));
    let of_value = groups.chunk_by(|a, b| a.value == b.value);
    // Only the first row of a group has its value.
    let rows: Vec<(bool, &Group)> = of_value
        .flat_map(|group| group.iter().enumerate().map(|(i, group)| (i == 0, group)))
        .collect();
    let parts = grouping.parts();
    let rows = Table::of(&rows)
        .each(parts.iter().enumerate(), |rows, (i, part)| {
            rows.words(*part, |(first, group)| {
                let value = group.value.splitn(parts.len(), SEPARATOR).nth(i);
                value.filter(|_| *first).unwrap_or_default()
            })
        })
        .words("model", |(_, group)| group.model);
    errors(rows, |(_, group)| &group.errors)
        .words("worst test", |(_, group)| group.errors.worst_id.clone())
        .table()
}

/// Use of the tests of a kind, for the models that predict the measured quantity.
pub(super) fn coverage(validation: &Validation, kind: Kind) -> Table {
    const STANDINGS: [&str; 8] = [
        "counted",
        "suspect",
        "repeated",
        "partial penetration",
        "no case",
        "not given",
        "does not apply",
        "failed",
    ];
    let mut coverage = validate::coverage(validation);
    coverage.retain(|coverage| coverage.kind == kind && coverage.is_given());
    Table::of(&coverage)
        .words("model", |coverage| coverage.model)
        .numbers("tests", "", |coverage| coverage.total().to_string())
        .each(
            STANDINGS.into_iter().zip(Standing::ALL),
            |rows, (name, standing)| {
                rows.numbers(name, "", |coverage| coverage.count(standing).to_string())
            },
        )
        .words("most frequent reason", |coverage| {
            let reason = coverage.reason.as_ref();
            reason.map_or_else(String::new, |(reason, count)| format!("{reason} ({count})"))
        })
        .table()
}

/// Suspect tests with the errors of the models.
pub(super) fn suspects(validation: &Validation) -> Table {
    let suspects = validation.tests.iter().enumerate();
    let suspects: Vec<(usize, &Experiment)> =
        suspects.filter(|(_, test)| test.flag.is_some()).collect();
    Table::of(&suspects)
        .words("test", |(_, test)| test.id.clone())
        .words("source", |(_, test)| test.source.clone())
        .words("reason", |(_, test)| test.flag.clone().unwrap_or_default())
        .numbers("measured", "", |(_, test)| {
            significant(test.kind.shown(test.measured), 5)
        })
        .words("unit", |(_, test)| test.kind.unit())
        .words("model and error [%]", |(index, _)| {
            answers(validation, *index)
        })
        .table()
}

/// Errors of all models with a prediction for a test with its main record.
fn answers(validation: &Validation, test: usize) -> String {
    let of_test = validation
        .predictions
        .iter()
        .filter(|p| p.test == test && p.main_record);
    let answer = |p: &Prediction| {
        let error = signed(p.relative_error?).replace('-', "\u{2212}");
        Some(format!("{} {error}", p.model))
    };
    of_test.filter_map(answer).collect::<Vec<_>>().join(", ")
}

/// Sources of the tests.
pub(super) fn sources(validation: &Validation) -> Table {
    let mut groups: BTreeMap<&str, Vec<&Experiment>> = BTreeMap::new();
    for test in &validation.tests {
        groups.entry(&test.source).or_default().push(test);
    }
    let groups: Vec<(&str, Vec<&Experiment>)> = groups.into_iter().collect();
    let all = |tests: &[&Experiment], of: fn(&Experiment) -> &str| {
        words(tests.iter().map(|test| of(test)))
    };
    Table::of(&groups)
        .words("source", |(source, _)| *source)
        .words("work", |(source, _)| {
            references().get(*source).map_or_else(String::new, |work| {
                format!("{}. {}. {}", work.label, work.title, work.place)
            })
        })
        .numbers("tests", "", |(_, tests)| tests.len().to_string())
        .words("split", |(_, tests)| all(tests, |test| test.split.name()))
        .words("licence", |(_, tests)| all(tests, |test| &test.licence))
        .words("data", |(source, _)| {
            let work = references().get(*source);
            work.map_or_else(String::new, |work| work.note.clone())
        })
        .table()
}

/// Different words, each once.
fn words<'a>(words: impl Iterator<Item = &'a str>) -> String {
    let mut words: Vec<&str> = words.collect();
    words.sort_unstable();
    words.dedup();
    words.join(", ")
}

/// Every test of a kind with every record, with one column per model with predictions.
pub(super) fn tests(validation: &Validation, kind: Kind) -> Table {
    let gave = |model: &str| {
        validation
            .predictions
            .iter()
            .any(|p| p.model == model && p.predicted.is_some() && validation.test(p).kind == kind)
    };
    let models: Vec<&str> = validation
        .models
        .iter()
        .copied()
        .filter(|model| gave(model))
        .collect();
    let mut rows: BTreeMap<(usize, bool, &str), Vec<&Prediction>> = BTreeMap::new();
    for prediction in &validation.predictions {
        if validation.test(prediction).kind == kind {
            let record = prediction.record.as_str();
            let key = (prediction.test, !prediction.main_record, record);
            rows.entry(key).or_default().push(prediction);
        }
    }
    let rows: Vec<(&Experiment, &str, Vec<&Prediction>)> = rows
        .into_iter()
        .map(|((index, _, record), predictions)| (&validation.tests[index], record, predictions))
        .collect();
    let unit = kind.unit();
    Table::of(&rows)
        .words("test", |(test, ..)| test.id.clone())
        .words("source", |(test, ..)| test.source.clone())
        .words("record", |(_, record, _)| *record)
        .words("target", |(test, ..)| test.target.name())
        .numbers("impact velocity", "m/s", |(test, ..)| {
            significant(test.impact_velocity, 5)
        })
        .numbers("measured", unit, |(test, ..)| {
            significant(kind.shown(test.measured), 5)
        })
        .each(models, |rows, model| {
            let heading = format!("{model} [{unit}] (error [%])");
            rows.numbers(heading, "", |(_, _, predictions)| {
                let prediction = predictions.iter().find(|p| p.model == model);
                prediction.map_or_else(String::new, |prediction| answer(prediction))
            })
        })
        .words("reason of exclusion", |(test, ..)| {
            let repeats = || test.duplicate_of.as_ref().map(|id| format!("repeats {id}"));
            let reason = test.no_case().or(test.flag.clone()).or_else(repeats);
            reason.unwrap_or_default()
        })
        .words("place in the source", |(test, ..)| test.read_at.clone())
        .table()
}

fn answer(prediction: &Prediction) -> String {
    match (prediction.predicted, prediction.relative_error) {
        (Some(predicted), Some(error)) => {
            format!("{} ({})", significant(predicted, 4), signed(error))
        }
        (Some(predicted), None) => significant(predicted, 4),
        _ => "\u{2013}".to_owned(),
    }
}
