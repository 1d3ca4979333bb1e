//! Tables of a validation report.

use std::collections::BTreeMap;

use percuss::{
    material::references,
    shots::{Kind, Shot},
    units::significant,
    validate::{self, Errors, Group, Grouping, Prediction, SEPARATOR, Standing, Validation},
};

use crate::page::Table;

/// A relative error in per cent.
pub(super) fn percent(error: f64) -> String {
    format!("{:.1}", 100.0 * error).replace('-', "\u{2212}")
}

/// A relative error in per cent with its sign.
fn signed(error: f64) -> String {
    format!("{:+.1}", 100.0 * error).replace('-', "\u{2212}")
}

fn of_kind(validation: &Validation, kind: Kind, grouping: Grouping) -> Vec<Group> {
    let mut groups = validate::statistics(validation, grouping);
    groups.retain(|group| group.kind == kind);
    groups
}

const ERRORS: [&str; 6] = [
    "#n",
    "#bias [%]",
    "#RMS [%]",
    "#median [%]",
    "#worst [%]",
    "worst shot",
];

fn errors(errors: &Errors) -> Vec<String> {
    vec![
        errors.count.to_string(),
        signed(errors.bias),
        percent(errors.rms),
        percent(errors.median_absolute),
        signed(errors.worst),
        errors.worst_id.clone(),
    ]
}

/// One row a model.
pub(super) fn models(validation: &Validation, kind: Kind) -> Table {
    let mut table = Table::new(&[&["model"], ERRORS.as_slice()].concat());
    for group in of_kind(validation, kind, Grouping::All) {
        let mut row = vec![group.model_in_words()];
        row.extend(errors(&group.errors));
        table.rows.push(row);
    }
    table
}

/// One row a group and model; the groups together, for the models to be compared.
pub(super) fn groups(validation: &Validation, kind: Kind, grouping: Grouping) -> Table {
    let mut groups = of_kind(validation, kind, grouping);
    // A stable sort: within a group the models keep their order.
    groups.sort_by(|a, b| a.value.cmp(&b.value));
    let parts = grouping.parts().len();
    let mut table = Table::new(&[grouping.parts(), &["model"], ERRORS.as_slice()].concat());
    let mut last = String::new();
    for group in groups {
        let mut row = if group.value == last {
            vec![String::new(); parts]
        } else {
            let value = group.value.splitn(parts, SEPARATOR);
            value.map(str::to_owned).collect()
        };
        row.push(group.model.to_owned());
        row.extend(errors(&group.errors));
        table.rows.push(row);
        last = group.value;
    }
    table
}

/// What became of the shots of a kind, for the models that give what it measures.
pub(super) fn coverage(validation: &Validation, kind: Kind) -> Table {
    let mut table = Table::new(&[
        "model",
        "#shots",
        "#counted",
        "#suspect",
        "#repeated",
        "#stopped",
        "#no case",
        "#not given",
        "#does not apply",
        "#failed",
        "commonest reason",
    ]);
    for coverage in validate::coverage(validation)
        .into_iter()
        .filter(|c| c.kind == kind && c.is_given())
    {
        let mut row = vec![coverage.model.to_owned(), coverage.total().to_string()];
        row.extend(Standing::ALL.map(|standing| coverage.count(standing).to_string()));
        let reason = coverage.reason;
        row.push(reason.map_or_else(String::new, |(reason, count)| format!("{reason} ({count})")));
        table.rows.push(row);
    }
    table
}

/// Suspect rows, with what the models say of them.
pub(super) fn suspects(validation: &Validation) -> Table {
    let mut table = Table::new(&[
        "shot",
        "source",
        "why",
        "#measured",
        "unit",
        "model and error [%]",
    ]);
    for (index, shot) in validation.shots.iter().enumerate() {
        let Some(flag) = &shot.flag else { continue };
        table.rows.push(vec![
            shot.id.clone(),
            shot.source.clone(),
            flag.clone(),
            significant(shot.kind.shown(shot.measured), 5),
            shot.kind.unit().to_owned(),
            answers(validation, index),
        ]);
    }
    table
}

/// Errors of all models that gave a number for a shot with its main record.
fn answers(validation: &Validation, shot: usize) -> String {
    let of_shot = validation
        .predictions
        .iter()
        .filter(|p| p.shot == shot && p.main_record);
    let answers: Vec<String> = of_shot
        .filter_map(|p| Some(format!("{} {}", p.model, signed(p.relative_error?))))
        .collect();
    answers.join(", ")
}

/// Works that the shots come from.
pub(super) fn sources(validation: &Validation) -> Table {
    let mut groups: BTreeMap<&str, Vec<&Shot>> = BTreeMap::new();
    for shot in &validation.shots {
        groups.entry(&shot.source).or_default().push(shot);
    }
    let mut table = Table::new(&[
        "source",
        "work",
        "#shots",
        "split",
        "licence",
        "what was read",
    ]);
    for (source, shots) in groups {
        let (work, note) = references()
            .get(source)
            .map_or_else(Default::default, |reference| {
                (
                    format!(
                        "{}. {}. {}",
                        reference.label, reference.title, reference.place
                    ),
                    reference.note.clone(),
                )
            });
        table.rows.push(vec![
            source.to_owned(),
            work,
            shots.len().to_string(),
            words(shots.iter().map(|shot| shot.split.name())),
            words(shots.iter().map(|shot| shot.licence.as_str())),
            note,
        ]);
    }
    table
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
            .any(|p| p.model == model && p.predicted.is_some() && validation.shot(p).kind == kind)
    };
    let models: Vec<&str> = validation
        .models
        .iter()
        .copied()
        .filter(|model| gave(model))
        .collect();
    let mut table = Table::new(&["shot", "source", "record", "target", "#speed [m/s]"]);
    table.head.push(format!("#measured [{}]", kind.unit()));
    table.head.extend(
        models
            .iter()
            .map(|model| format!("#{model} [{}] (error [%])", kind.unit())),
    );
    table
        .head
        .extend(["not counted because", "read at"].map(str::to_owned));
    let mut rows: BTreeMap<(usize, bool, &str), Vec<&Prediction>> = BTreeMap::new();
    for prediction in validation
        .predictions
        .iter()
        .filter(|p| validation.shot(p).kind == kind)
    {
        let key = (
            prediction.shot,
            !prediction.main_record,
            prediction.record.as_str(),
        );
        rows.entry(key).or_default().push(prediction);
    }
    for ((index, _, record), predictions) in rows {
        let shot = &validation.shots[index];
        let mut row = vec![
            shot.id.clone(),
            shot.source.clone(),
            record.to_owned(),
            shot.target.name().to_owned(),
            significant(shot.impact_velocity, 5),
            significant(kind.shown(shot.measured), 5),
        ];
        row.extend(models.iter().map(|model| {
            predictions
                .iter()
                .find(|p| p.model == *model)
                .map_or_else(String::new, |prediction| answer(prediction))
        }));
        row.push(
            shot.no_case()
                .or(shot.flag.clone())
                .or(shot.duplicate_of.as_ref().map(|id| format!("repeats {id}")))
                .unwrap_or_default(),
        );
        row.push(shot.read_at.clone());
        table.rows.push(row);
    }
    table
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
