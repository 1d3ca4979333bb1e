//! A validation in the terminal.

use comfy_table::{CellAlignment, Table, presets::NOTHING};
use percuss::{
    shots::Kind,
    validate::{self, Coverage, Errors, Group, Grouping, Standing, Validation},
};

use crate::terminal::{bold, width, wrap};

/// What the command prints; `in_detail` breaks each kind down.
pub fn text(validation: &Validation, files: &[String], in_detail: bool) -> String {
    let mut text = format!(
        "{}\n{}\n",
        bold("Validation on published shots"),
        wrap(&format!("data: {}", files.join(", ")), width(), 2)
    );
    let repeated = validation
        .shots
        .iter()
        .filter(|shot| shot.duplicate_of.is_some())
        .count();
    let suspect = validation
        .shots
        .iter()
        .filter(|shot| shot.flag.is_some())
        .count();
    if repeated + suspect > 0 {
        text += &format!("not counted: {suspect} suspect and {repeated} repeated rows\n");
    }
    text += "errors are relative, in %: predicted over measured, less 1\n";
    for kind in Kind::ALL {
        if validation.shots.iter().any(|shot| shot.kind == kind) {
            text += &section(validation, kind, in_detail);
        }
    }
    if !in_detail {
        let hint = "`--model NAME` breaks a model down by source, target and more; `--out DIR` writes all of it with figures. `axi` takes minutes and runs when it is named.";
        text += &format!("\n{}\n", wrap(hint, width(), 0));
    }
    text
}

fn section(validation: &Validation, kind: Kind, in_detail: bool) -> String {
    let coverage = validate::coverage(validation);
    let of_kind = |grouping| {
        let mut groups = groups(validation, grouping);
        groups.retain(|group| group.kind == kind);
        groups
    };
    let all = of_kind(Grouping::All);
    let mut text = format!(
        "\n{}\n",
        bold(format!("{} (--kind {})", kind.in_words(), kind.name()))
    );
    if !all.is_empty() {
        let rows = all
            .iter()
            .map(|group| (group.model_in_words(), &group.errors));
        text += &table("model", rows, true);
    }
    // Models of which the same is to be said share a line; those that are for something else are left out.
    let mut lines: Vec<(Vec<&str>, String)> = Vec::new();
    for coverage in coverage
        .iter()
        .filter(|c| c.kind == kind && (in_detail || c.is_given()))
    {
        let line = unused(coverage);
        match lines.iter_mut().find(|(_, other)| *other == line) {
            Some((models, _)) => models.push(coverage.model),
            None => lines.push((vec![coverage.model], line)),
        }
    }
    for (models, line) in lines.iter().filter(|(_, line)| !line.is_empty()) {
        let line = format!("{}: {line}", models.join(", "));
        text += &format!("{}\n", wrap(&line, width(), 2));
    }
    if !in_detail {
        return text;
    }
    let groupings = match kind {
        Kind::Taylor => [Grouping::Record, Grouping::Source],
        _ => [Grouping::Projectile, Grouping::Target],
    };
    for groups in groupings
        .map(of_kind)
        .iter()
        .filter(|groups| !groups.is_empty())
    {
        let rows = groups
            .iter()
            .map(|group| (group.value.clone(), &group.errors));
        text += &format!(
            "\n{}",
            table(
                &format!("by {}", groups[0].grouping.in_words()),
                rows,
                false
            )
        );
    }
    text
}

fn groups(validation: &Validation, grouping: Grouping) -> Vec<Group> {
    validate::statistics(validation, grouping)
}

/// What is to be said of the shots that a model is not counted on, without its name.
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
        line += &format!(", {stopped} stopped in the test, which leaves no relative error");
    }
    if without > 0 {
        line += &format!(", {without} without a number{reason}");
    }
    line
}

fn table<'a>(
    first: &str,
    rows: impl Iterator<Item = (String, &'a Errors)>,
    with_worst_shot: bool,
) -> String {
    let mut table = Table::new();
    table.load_style(NOTHING);
    let columns = if with_worst_shot { 7 } else { 6 };
    let header = [first, "n", "bias", "RMS", "median", "worst", "worst shot"];
    table.set_header(header[..columns].to_vec());
    let percent = |error: f64| format!("{:.1}", 100.0 * error);
    let signed = |error: f64| format!("{:+.1}", 100.0 * error);
    for (name, errors) in rows {
        let row = [
            name,
            errors.count.to_string(),
            signed(errors.bias),
            percent(errors.rms),
            percent(errors.median_absolute),
            signed(errors.worst),
            errors.worst_id.clone(),
        ];
        table.add_row(row[..columns].to_vec());
    }
    for column in table.column_iter_mut() {
        column.set_padding((0, 2));
    }
    for column in table.column_iter_mut().skip(1).take(5) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    format!("{}\n", table.trim_fmt())
}

/// A group in one line for scripts.
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
