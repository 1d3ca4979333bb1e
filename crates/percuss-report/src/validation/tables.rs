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

/// Columns of errors, of which each row has some.
fn errors<R>(rows: Rows<'_, R>, of: impl Fn(&R) -> &Errors) -> Rows<'_, R> {
    rows.numbers("n", "", |row| of(row).count.to_string())
        .numbers("bias", "%", |row| signed(of(row).bias))
        .numbers("RMS", "%", |row| percent(of(row).rms))
        .numbers("median", "%", |row| percent(of(row).median_absolute))
        .numbers("worst", "%", |row| signed(of(row).worst))
}

/// Errors of the models on shots of a kind, one row per model.
pub fn models(validation: &Validation, kind: Kind) -> Table {
    let groups = of_kind(validation, kind, Grouping::All);
    let rows = Table::of(&groups).words("model", Group::model_in_words);
    errors(rows, |group| &group.errors)
        .words("worst shot", |group| group.errors.worst_id.clone())
        .table()
}

/// Errors on shots of a kind by a property of the shots, one row per model and value of the property.
pub fn by_property(validation: &Validation, kind: Kind, grouping: Grouping) -> Table {
    let groups = of_kind(validation, kind, grouping);
    let heading = format!("by {}", grouping.describe());
    let rows = Table::of(&groups).words(heading, |group| group.value.clone());
    errors(rows, |group| &group.errors).table()
}

/// One row a group and model; the groups together, for the models to be compared.
pub(super) fn groups(validation: &Validation, kind: Kind, grouping: Grouping) -> Table {
    let mut groups = of_kind(validation, kind, grouping);
    // A stable sort: within a group the models keep their order.
    groups.sort_by(|a, b| a.value.cmp(&b.value));
    let of_value = groups.chunk_by(|a, b| a.value == b.value);
    // The value stands in the first row of its group.
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
        .words("worst shot", |(_, group)| group.errors.worst_id.clone())
        .table()
}

/// What became of the shots of a kind, for the models that give what it measures.
pub(super) fn coverage(validation: &Validation, kind: Kind) -> Table {
    const STANDINGS: [&str; 8] = [
        "counted",
        "suspect",
        "repeated",
        "stopped",
        "no case",
        "not given",
        "does not apply",
        "failed",
    ];
    let mut coverage = validate::coverage(validation);
    coverage.retain(|coverage| coverage.kind == kind && coverage.is_given());
    Table::of(&coverage)
        .words("model", |coverage| coverage.model)
        .numbers("shots", "", |coverage| coverage.total().to_string())
        .each(
            STANDINGS.into_iter().zip(Standing::ALL),
            |rows, (name, standing)| {
                rows.numbers(name, "", |coverage| coverage.count(standing).to_string())
            },
        )
        .words("commonest reason", |coverage| {
            let reason = coverage.reason.as_ref();
            reason.map_or_else(String::new, |(reason, count)| format!("{reason} ({count})"))
        })
        .table()
}

/// Suspect rows, with what the models say of them.
pub(super) fn suspects(validation: &Validation) -> Table {
    let suspects = validation.tests.iter().enumerate();
    let suspects: Vec<(usize, &Experiment)> =
        suspects.filter(|(_, shot)| shot.flag.is_some()).collect();
    Table::of(&suspects)
        .words("shot", |(_, shot)| shot.id.clone())
        .words("source", |(_, shot)| shot.source.clone())
        .words("why", |(_, shot)| shot.flag.clone().unwrap_or_default())
        .numbers("measured", "", |(_, shot)| {
            significant(shot.kind.shown(shot.measured), 5)
        })
        .words("unit", |(_, shot)| shot.kind.unit())
        .words("model and error [%]", |(index, _)| {
            answers(validation, *index)
        })
        .table()
}

/// Errors of all models that gave a number for a shot with its main record.
fn answers(validation: &Validation, shot: usize) -> String {
    let of_shot = validation
        .predictions
        .iter()
        .filter(|p| p.test == shot && p.main_record);
    let answer = |p: &Prediction| {
        let error = signed(p.relative_error?).replace('-', "\u{2212}");
        Some(format!("{} {error}", p.model))
    };
    of_shot.filter_map(answer).collect::<Vec<_>>().join(", ")
}

/// Works that the shots come from.
pub(super) fn sources(validation: &Validation) -> Table {
    let mut groups: BTreeMap<&str, Vec<&Experiment>> = BTreeMap::new();
    for shot in &validation.tests {
        groups.entry(&shot.source).or_default().push(shot);
    }
    let groups: Vec<(&str, Vec<&Experiment>)> = groups.into_iter().collect();
    let all = |shots: &[&Experiment], of: fn(&Experiment) -> &str| {
        words(shots.iter().map(|shot| of(shot)))
    };
    Table::of(&groups)
        .words("source", |(source, _)| *source)
        .words("work", |(source, _)| {
            references().get(*source).map_or_else(String::new, |work| {
                format!("{}. {}. {}", work.label, work.title, work.place)
            })
        })
        .numbers("shots", "", |(_, shots)| shots.len().to_string())
        .words("split", |(_, shots)| all(shots, |shot| shot.split.name()))
        .words("licence", |(_, shots)| all(shots, |shot| &shot.licence))
        .words("what was read", |(source, _)| {
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

/// Every shot of a kind with every record: a column a model that gave any number.
pub(super) fn shots(validation: &Validation, kind: Kind) -> Table {
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
        .words("shot", |(shot, ..)| shot.id.clone())
        .words("source", |(shot, ..)| shot.source.clone())
        .words("record", |(_, record, _)| *record)
        .words("target", |(shot, ..)| shot.target.name())
        .numbers("speed", "m/s", |(shot, ..)| {
            significant(shot.impact_velocity, 5)
        })
        .numbers("measured", unit, |(shot, ..)| {
            significant(kind.shown(shot.measured), 5)
        })
        .each(models, |rows, model| {
            let heading = format!("{model} [{unit}] (error [%])");
            rows.numbers(heading, "", |(_, _, predictions)| {
                let prediction = predictions.iter().find(|p| p.model == model);
                prediction.map_or_else(String::new, |prediction| answer(prediction))
            })
        })
        .words("not counted because", |(shot, ..)| {
            let repeats = || shot.duplicate_of.as_ref().map(|id| format!("repeats {id}"));
            let reason = shot.no_case().or(shot.flag.clone()).or_else(repeats);
            reason.unwrap_or_default()
        })
        .words("read at", |(shot, ..)| shot.read_at.clone())
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
