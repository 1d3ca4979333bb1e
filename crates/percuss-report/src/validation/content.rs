//! Content of the validation report.

use percuss::{
    experiments::{Experiment, Kind, Split},
    validate::{Grouping, Standing, Validation, statistics, without_tests},
};

use super::{Origin, figures::ModelFigure, tables};
use crate::{page::Block, table::Table};

pub(super) fn page<'a>(
    validation: &Validation,
    origin: &Origin,
    figures: &'a [ModelFigure],
) -> Vec<Block<'a>> {
    let mut page = vec![
        Block::Title("Validation against tests".to_owned()),
        Block::Text(format!(
            "Every model of percuss {} on every test to which it applies. Tests: {}. Command: {}",
            env!("CARGO_PKG_VERSION"),
            origin.files.join(", "),
            origin.command
        )),
        Block::List(counts(validation)),
        Block::Heading("Definitions".to_owned()),
        Block::List(
            [
                "Relative error = predicted / measured - 1.",
                "Bias: mean error. RMS: root mean square error. Median: median absolute error. Worst: largest absolute error, with its test.",
                "A test counts once, with the main material record of its projectile. Alternative records are in the tables by material record.",
                "Heated rods have a separate line, because few models apply to them. All others are compared at room temperature.",
                "Suspect tests, repeated tests and partial penetrations (measured residual velocity 0) are computed and listed, but not counted.",
                "predictions.csv and predictions.parquet, which percuss validate --out FOLDER writes, contain all numbers, with the source of each test.",
            ]
            .map(str::to_owned)
            .to_vec(),
        ),
    ];
    for kind in Kind::ALL {
        if validation.tests.iter().any(|test| test.kind == kind) {
            page.extend(section(validation, kind, figures));
        }
    }
    page.extend(blind(validation));
    page.push(Block::Heading("Suspect tests".to_owned()));
    let suspects = tables::suspects(validation);
    if suspects.is_empty() {
        page.push(Block::Text("None.".to_owned()));
    } else {
        page.push(Block::Text(
            "Tests far from their series or out of order with a neighbour. They are in no statistics."
                .to_owned(),
        ));
        page.push(Block::Table(suspects));
    }
    page.push(Block::Heading("Sources".to_owned()));
    page.push(Block::Table(tables::sources(validation)));
    page.push(Block::WebOnly(every_test(validation)));
    page
}

fn counts(validation: &Validation) -> Vec<String> {
    let tests = &validation.tests;
    let count = |of: &dyn Fn(&Experiment) -> bool| tests.iter().filter(|&test| of(test)).count();
    let kinds: Vec<String> = Kind::ALL
        .into_iter()
        .map(|kind| (kind, count(&|test| test.kind == kind)))
        .filter(|(_, count)| *count > 0)
        .map(|(kind, count)| format!("{count} {}", kind.describe()))
        .collect();
    vec![
        format!("{} tests: {}", tests.len(), kinds.join(", ")),
        format!(
            "{} repeat others, {} are suspect, {} cannot be made a case, {} are oblique",
            count(&|test| test.duplicate_of.is_some()),
            count(&|test| test.flag.is_some()),
            count(&|test| test.unusable.is_some()),
            count(&|test| test.unusable.is_none() && test.obliquity_deg != 0.0)
        ),
        format!("models: {}", validation.models.join(", ")),
        match without_tests(validation).as_slice() {
            [] => "every model has a counted test".to_owned(),
            models => format!(
                "{} of {} models have no counted test yet: {}",
                models.len(),
                validation.models.len(),
                models.join(", ")
            ),
        },
    ]
}

fn heading(kind: Kind) -> String {
    let words = kind.describe();
    let first = words.chars().take(1).flat_map(char::to_uppercase);
    first.chain(words.chars().skip(1)).collect()
}

fn section<'a>(validation: &Validation, kind: Kind, figures: &'a [ModelFigure]) -> Vec<Block<'a>> {
    let mut blocks = vec![Block::Heading(heading(kind))];
    let table = tables::models(validation, kind);
    if table.is_empty() {
        blocks.push(Block::Text("No prediction is counted.".to_owned()));
    } else {
        blocks.push(Block::Table(table));
        blocks.extend(breakdown(validation, kind));
    }
    blocks.push(Block::Folded(
        "Use of the tests, with reasons".to_owned(),
        vec![Block::Table(tables::coverage(validation, kind))],
    ));
    for &model in &validation.models {
        let of_model = figures
            .iter()
            .filter(|figure| figure.kind == kind && figure.model == model);
        blocks.extend(of_model.map(|figure| Block::Figure(&figure.drawing)));
    }
    blocks
}

/// Tables by further properties; the main ones are open, the others folded.
fn breakdown<'a>(validation: &Validation, kind: Kind) -> Vec<Block<'a>> {
    let groupings: &[Grouping] = match kind {
        Kind::Taylor => &[
            Grouping::Projectile,
            Grouping::RecordAndSource,
            Grouping::Record,
            Grouping::Source,
            Grouping::Split,
        ],
        _ => &[
            Grouping::Projectile,
            Grouping::Target,
            Grouping::Source,
            Grouping::Regime,
            Grouping::Split,
        ],
    };
    let mut blocks = Vec::new();
    for (i, &grouping) in groupings.iter().enumerate() {
        let title = format!("By {}", grouping.describe());
        let table = Block::Table(tables::groups(validation, kind, grouping));
        if i == 0 || grouping == Grouping::RecordAndSource {
            blocks.extend([Block::Subheading(title), table]);
        } else {
            blocks.push(Block::Folded(title, vec![table]));
        }
    }
    blocks
}

/// Predictions that are not blind: one line for the data, and one per model and reason.
fn not_blind(validation: &Validation) -> Vec<String> {
    let fitted = validation
        .tests
        .iter()
        .filter(|test| test.split == Split::Calibration);
    let mut sources: Vec<&str> = fitted.map(|test| test.source.as_str()).collect();
    sources.sort_unstable();
    sources.dedup();
    let mut lines = Vec::new();
    if !sources.is_empty() {
        lines.push(format!(
            "Every model on {}: a constant of the library may have been fitted to these data.",
            sources.join(", ")
        ));
    }
    for (model, fitted) in validation.models.iter().zip(&validation.fitted_to) {
        lines.extend(fitted.iter().map(|fitted| {
            format!(
                "{model} on {}: {}.",
                fitted.sources.join(", "),
                fitted.because
            )
        }));
    }
    lines
}

fn blind<'a>(validation: &Validation) -> Vec<Block<'a>> {
    let table = Table::of(&statistics(validation, Grouping::Split))
        .words("kind", |group| heading(group.kind))
        .words("model", |group| group.model)
        .words("split", |group| group.value.clone())
        .numbers("n", "", |group| group.errors.count.to_string())
        .numbers("bias", "%", |group| tables::percent(group.errors.bias))
        .numbers("RMS", "%", |group| tables::percent(group.errors.rms))
        .table();
    let mut exceptions = not_blind(validation);
    if exceptions.is_empty() {
        exceptions.push("none".to_owned());
    }
    let counted = |standing| {
        validation
            .predictions
            .iter()
            .filter(|p| p.standing == standing)
            .count()
    };
    vec![
        Block::Heading("Blind predictions".to_owned()),
        Block::Text(
            "The split is by source and model. A prediction is blind if no constant of the program was fitted to the source of its test and \
             neither a constant nor the form of the model was selected with it. All predictions are blind except these, which have \
             separate lines in the table by split:"
                .to_owned(),
        ),
        Block::List(exceptions),
        Block::Text("Notes:".to_owned()),
        Block::List(vec![
            "Properties of a plate (yield stress, hardening) are part of its test data: measured or handbook values, not fitted to limits."
                .to_owned(),
            "A ballistic limit is computed for the regime at the measured limit. The result is independent of that velocity, which a test of \
             the program checks."
                .to_owned(),
            format!(
                "Predictions counted: {}; failed: {}.",
                counted(Standing::Counted),
                counted(Standing::Failed)
            ),
        ]),
        Block::Table(table),
    ]
}

fn every_test<'a>(validation: &Validation) -> Vec<Block<'a>> {
    let mut blocks = vec![Block::Heading("Every test".to_owned())];
    for kind in Kind::ALL {
        let table = tables::tests(validation, kind);
        if !table.is_empty() {
            blocks.push(Block::Folded(
                format!("{} ({} lines)", heading(kind), table.len()),
                vec![Block::Table(table)],
            ));
        }
    }
    blocks
}
