//! Terminal output of the benchmark.

use percuss_report::table::{Table, number};
use percuss_research::{
    benchmark::{self, Group, Grouping},
    benchmark_report::{
        BenchmarkResults, Origin,
        tables::{self, signed},
    },
};

use crate::{
    table::plain,
    terminal::{bold, width, wrap},
};

/// Spaces between columns.
const SPACES: u16 = 2;

/// Findings, errors over all cases, medians by velocity, length and regime, and the requested groups.
pub fn text(compared: &BenchmarkResults, origin: &Origin, by: &[Grouping]) -> String {
    let verdicts = &compared.verdicts;
    let mut text = format!(
        "{}\n{}\n",
        bold("Depth models against the axisymmetric reference"),
        wrap(&format!("reference: {}", origin.reference), width(), 2)
    );
    for sentence in benchmark::findings(verdicts) {
        text += &format!("{}\n", wrap(&format!("- {sentence}"), width(), 2));
    }
    let refused = compared.references.iter().filter(|r| r.estimate.is_err());
    let refused = refused.count();
    if refused > 0 {
        let sentence = format!(
            "- {refused} more cases are left out of all numbers: their reference fails the check. `--out DIR` and `--json` list the reasons."
        );
        text += &format!("{}\n", wrap(&sentence, width(), 2));
    }
    let mut add = |title: &str, table: &Table| {
        text += &format!("\n{}\n{}", bold(title), plain(table, SPACES));
    };
    let all = benchmark::statistics(verdicts, Grouping::All);
    add(
        "all cases, errors in % (P10-P90: 10th-90th percentile)",
        &errors(&all),
    );
    for &grouping in by {
        let groups = benchmark::statistics(verdicts, grouping);
        for value in grouping.values() {
            let mut own = groups.clone();
            own.retain(|group| group.value == value);
            if !own.is_empty() {
                add(&value, &errors(&own));
            }
        }
    }
    if by.is_empty() {
        for grouping in [Grouping::Speed, Grouping::Length, Grouping::Regime] {
            let title = format!("median error in % by {}", grouping.describe());
            let groups = benchmark::statistics(verdicts, grouping);
            add(&title, &medians(&groups, grouping));
        }
        let mut variants = tables::variants(&compared.variants);
        variants.columns.remove(1);
        for column in &mut variants.columns {
            column.heading = column.heading.replace("depth at ", "");
        }
        let title = "case of the seed paper, one change at a time: depths in mm, errors in %";
        add(title, &variants);
        let hint = "`--by WHAT` prints the errors by speed, length, regime, materials or uncertainty of the reference; `--out DIR` writes \
                    the whole report with figures.";
        text += &format!("\n{}\n", wrap(hint, width(), 0));
    }
    text
}

/// Errors in columns that fit 80 characters.
fn errors(groups: &[Group]) -> Table {
    Table::of(groups)
        .words("model", |group| group.candidate)
        .numbers("n", "", |group| group.errors.count.to_string())
        .numbers("median", "", |group| signed(group.errors.median))
        .numbers("P10-P90", "", |group| {
            let errors = &group.errors;
            format!("{} … {}", signed(errors.low), signed(errors.high))
        })
        .numbers("median |e|", "", |group| {
            format!("{:.0}", 100.0 * group.errors.median_absolute)
        })
        .numbers("within 25 %", "", |group| {
            format!("{:.0} %", 100.0 * group.errors.within_25_percent)
        })
        .table()
}

/// One row per candidate, one column per group.
fn medians(groups: &[Group], grouping: Grouping) -> Table {
    let mut candidates: Vec<&str> = groups.iter().map(|group| group.candidate).collect();
    candidates.dedup();
    let values = grouping.values().into_iter();
    let values = values.filter(|value| groups.iter().any(|group| group.value == *value));
    Table::of(&candidates)
        .words("model", |candidate| *candidate)
        .each(values, |rows, value| {
            rows.numbers(value.clone(), "", |candidate| {
                let is_own = |group: &&Group| group.candidate == *candidate && group.value == value;
                let group = groups.iter().find(is_own);
                group.map_or_else(|| number(None, 0), |group| signed(group.errors.median))
            })
        })
        .table()
}

/// Candidate as one line of NAME=VALUE pairs.
pub fn one_line(group: &Group) -> String {
    let errors = &group.errors;
    format!(
        "candidate={} count={} median={} low={} high={} median_absolute={} within_25_percent={}\n",
        group
            .candidate
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
