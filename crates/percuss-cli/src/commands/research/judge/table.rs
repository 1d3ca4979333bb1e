//! The benchmark in the terminal.

use comfy_table::{CellAlignment, Table, presets::NOTHING};
use percuss::units::significant;
use percuss_research::{
    benchmark::{self, Errors, Group, Grouping},
    benchmark_report::{Benchmark, Origin},
    paper_case::{self, ablation::Line},
};

use crate::terminal::{bold, width, wrap};

/// What the command prints: sentences, all errors together, their medians by what may decide them, and the groups asked for.
pub fn text(judgement: &Benchmark, origin: &Origin, by: &[Grouping]) -> String {
    let verdicts = &judgement.verdicts;
    let mut text = format!(
        "{}\n{}\n",
        bold("Depth models against the axisymmetric reference"),
        wrap(&format!("reference: {}", origin.reference), width(), 2)
    );
    for sentence in benchmark::findings(verdicts) {
        text += &format!("{}\n", wrap(&format!("- {sentence}"), width(), 2));
    }
    let refused = judgement.references.iter().filter(|r| r.estimate.is_err());
    let refused = refused.count();
    if refused > 0 {
        let sentence = format!(
            "- {refused} more shots are left out of all numbers: their reference fails the check. `--out DIR` and `--json` list the reasons."
        );
        text += &format!("{}\n", wrap(&sentence, width(), 2));
    }
    text += &format!(
        "\n{}\n{}",
        bold("all shots, errors in %"),
        table(
            "model",
            benchmark::statistics(verdicts, Grouping::All).iter(),
            |group| { group.contender.to_owned() }
        )
    );
    if by.is_empty() {
        for grouping in [Grouping::Speed, Grouping::Length, Grouping::Regime] {
            text += &format!(
                "\n{}\n{}",
                bold(format!("median error in % by {}", grouping.in_words())),
                medians(&benchmark::statistics(verdicts, grouping), grouping)
            );
        }
        text += &ablation(&judgement.ablation);
        let hint = "`--by WHAT` prints all errors by speed, length, regime, materials or the reference's uncertainty; `--out DIR` writes \
                    all of it with figures.";
        text += &format!("\n{}\n", wrap(hint, width(), 0));
    }
    for &grouping in by {
        let groups = benchmark::statistics(verdicts, grouping);
        for value in grouping.values() {
            let own = groups.iter().filter(|group| group.value == value);
            if own.clone().next().is_some() {
                let name = |group: &Group| group.contender.to_owned();
                text += &format!("\n{}\n{}", bold(&value), table("model", own, name));
            }
        }
    }
    text
}

fn signed(error: f64) -> String {
    match (100.0 * error).round() {
        0.0 => "0".to_owned(),
        percent => format!("{percent:+.0}"),
    }
}

fn range(errors: &Errors) -> String {
    format!("{} … {}", signed(errors.low), signed(errors.high))
}

fn table<'a>(
    first: &str,
    groups: impl Iterator<Item = &'a Group>,
    name: impl Fn(&Group) -> String,
) -> String {
    let head = [
        first,
        "n",
        "median",
        "eight of ten",
        "|median|",
        "within 25 %",
    ];
    let rows = groups.map(|group| {
        let errors = &group.errors;
        vec![
            name(group),
            errors.count.to_string(),
            signed(errors.median),
            range(errors),
            format!("{:.0}", 100.0 * errors.median_absolute),
            format!("{:.0} %", 100.0 * errors.within_25_percent),
        ]
    });
    plain(head.map(str::to_owned).to_vec(), rows, 1)
}

/// A row a contender, a column a group.
fn medians(groups: &[Group], grouping: Grouping) -> String {
    let values: Vec<String> = grouping
        .values()
        .into_iter()
        .filter(|value| groups.iter().any(|group| group.value == *value))
        .collect();
    let mut contenders: Vec<&str> = groups.iter().map(|group| group.contender).collect();
    contenders.dedup();
    let mut head = vec!["model".to_owned()];
    head.extend(values.iter().cloned());
    let rows = contenders.iter().map(|contender| {
        let cells = values.iter().map(|value| {
            let own = |group: &&Group| group.contender == *contender && group.value == *value;
            let median = groups.iter().find(own).map(|group| group.errors.median);
            median.map_or_else(|| "–".to_owned(), signed)
        });
        std::iter::once((*contender).to_owned())
            .chain(cells)
            .collect()
    });
    plain(head, rows, 1)
}

fn ablation(lines: &[Line]) -> String {
    let mut head = vec!["target".to_owned()];
    for speed in paper_case::SPEEDS {
        head.extend([format!("{speed} m/s"), "error".to_owned()]);
    }
    let mut names: Vec<&str> = Vec::new();
    for line in lines {
        if !names.contains(&line.variant) {
            names.push(line.variant);
        }
    }
    let rows = names.iter().map(|name| {
        let mut row = vec![(*name).to_owned()];
        for &speed in paper_case::SPEEDS {
            let own = |line: &&Line| line.variant == *name && line.impact_velocity_m_s == speed;
            let line = lines.iter().find(own);
            let depth = line.map(|line| significant(line.depth_of_penetration_mm, 3));
            let error = line.and_then(|line| line.error).map(signed);
            row.extend([depth, error].map(|cell| cell.unwrap_or_else(|| "–".to_owned())));
        }
        row
    });
    format!(
        "\n{}\n{}",
        bold("the paper's case one thing at a time: depths in mm, errors in %"),
        plain(head, rows, 1)
    )
}

/// A table whose columns after the first `words` hold numbers.
fn plain(head: Vec<String>, rows: impl Iterator<Item = Vec<String>>, words: usize) -> String {
    let mut table = Table::new();
    table.load_style(NOTHING).set_header(head);
    for row in rows {
        table.add_row(row);
    }
    for column in table.column_iter_mut() {
        column.set_padding((0, 2));
    }
    for column in table.column_iter_mut().skip(words) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    format!("{}\n", table.trim_fmt())
}

/// A contender in one line for scripts.
pub fn one_line(group: &Group) -> String {
    let errors = &group.errors;
    format!(
        "contender={} count={} median={} low={} high={} median_absolute={} within_25_percent={}\n",
        group
            .contender
            .replace(": ", ":")
            .replace(", ", ",")
            .replace(' ', "-"),
        errors.count,
        errors.median,
        errors.low,
        errors.high,
        errors.median_absolute,
        errors.within_25_percent
    )
}
