//! Terminal output of a validation.

use percuss::{
    experiments::Kind,
    validate::{self, Coverage, Group, Grouping, Standing, Validation},
};
use percuss_report::validation::tables;

use crate::{
    by_models::by_models,
    table::plain,
    terminal::{bold, width, wrap},
};

/// Spaces between columns.
const SPACES: u16 = 2;

/// Tables of a validation by the models that were named; those of one model come with tables by source, target and projectile.
pub fn text(validation: &Validation, files: &[String], named: &[String]) -> String {
    let in_detail = named.len() == 1;
    let mut text = format!(
        "{}\n{}\n",
        bold("Validation against tests"),
        wrap(&format!("data: {}", files.join(", ")), width(), 2)
    );
    let repeated = validation
        .tests
        .iter()
        .filter(|test| test.duplicate_of.is_some())
        .count();
    let suspect = validation
        .tests
        .iter()
        .filter(|test| test.flag.is_some())
        .count();
    if repeated + suspect > 0 {
        text += &format!("not counted: {suspect} suspect and {repeated} repeated tests\n");
    }
    text += "relative errors in %: predicted / measured - 1\n";
    for kind in Kind::ALL {
        if validation.tests.iter().any(|test| test.kind == kind) {
            text += &section(validation, kind, in_detail);
        }
    }
    if !in_detail {
        let hint = "`--model NAME` prints tables of a model by source, target and more; `--out DIR` writes the whole report with figures.";
        let of_axi = " `axi` takes minutes and runs only when it is named.";
        let hint = match named.is_empty() {
            true => format!("{hint}{of_axi}"),
            false => hint.to_owned(),
        };
        text += &format!("\n{}\n", wrap(&hint, width(), 0));
    }
    text
}

fn section(validation: &Validation, kind: Kind, in_detail: bool) -> String {
    let coverage = validate::coverage(validation);
    let models = tables::models(validation, kind);
    let mut text = format!(
        "\n{}\n",
        bold(format!("{} (--kind {})", kind.describe(), kind.name()))
    );
    if !models.is_empty() {
        text += &plain(&models, SPACES);
    }
    // Models that never give this quantity are left out.
    let shown = coverage
        .iter()
        .filter(|c| c.kind == kind && (in_detail || c.is_given()));
    let said = shown.map(|coverage| (coverage.model, unused(coverage)));
    for line in by_models(said.filter(|(_, line)| !line.is_empty())) {
        text += &format!("{}\n", wrap(&line, width(), 2));
    }
    if !in_detail {
        return text;
    }
    let groupings = match kind {
        Kind::Taylor => [Grouping::Record, Grouping::Source],
        _ => [Grouping::Projectile, Grouping::Target],
    };
    let tables = groupings.map(|grouping| tables::by_property(validation, kind, grouping));
    for table in tables.iter().filter(|table| !table.is_empty()) {
        text += &format!("\n{}", plain(table, SPACES));
    }
    text
}

/// Tests on which a model is not counted, with the reasons; without the name of the model.
fn unused(coverage: &Coverage) -> String {
    let counted = coverage.count(Standing::Counted);
    let without: usize = [
        Standing::NoCase,
        Standing::NotGiven,
        Standing::NotApplicable,
        Standing::Failed,
    ]
    .map(|standing| coverage.count(standing))
    .iter()
    .sum();
    let stopped = coverage.count(Standing::MeasuredZero);
    if without == 0 && stopped == 0 {
        return String::new();
    }
    let reason = coverage
        .reason
        .as_ref()
        .map_or_else(String::new, |(reason, count)| {
            let most = if *count == without {
                String::new()
            } else {
                format!(" ({count})")
            };
            format!(": {reason}{most}")
        });
    let mut line = format!("{counted} of {} counted", coverage.total());
    if stopped > 0 {
        line += &format!(
            ", {stopped} with a partial penetration in the test, where no relative error exists"
        );
    }
    if without > 0 {
        line += &format!(", {without} without a prediction{reason}");
    }
    line
}

/// Group as one line of NAME=VALUE pairs.
pub fn one_line(group: &Group) -> String {
    let errors = &group.errors;
    format!(
        "model={} kind={} count={} bias={} rms={} median_absolute={} worst={} worst_id={} group={}\n",
        group.model,
        group.kind.name(),
        errors.count,
        errors.bias,
        errors.rms,
        errors.median_absolute,
        errors.worst,
        errors.worst_id,
        group.value
    )
}
