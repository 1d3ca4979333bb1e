//! A calibration as text.

use percuss::{
    calibrate::{Calibration, Marginal, ParameterRecord, Quality},
    units::significant,
};

use crate::{
    table::{keep_whole, table, text as text_of},
    terminal::{bold, counted, width, wrap, yellow},
};

/// The whole result.
pub fn text(calibration: &Calibration) -> String {
    let mut text = format!(
        "{}\n",
        bold(format!(
            "calibration, model {}, {} runs",
            calibration.model, calibration.runs
        ))
    );
    for parameter in &calibration.parameters {
        text += &format!("  {}\n", parameter.key);
    }
    text += &parameters(calibration);
    text += &quality(calibration);
    text += &sample(calibration);
    if !calibration.left_out.is_empty() {
        text += &left_out(calibration);
    }
    let findings = calibration.findings.iter().map(|finding| &finding.words);
    let mut notes = list("not determined", &mut findings.cloned());
    notes += &list("warning", &mut calibration.warnings.iter().cloned());
    text + &notes
}

/// One line of NAME=VALUE pairs a parameter.
pub fn lines(calibration: &Calibration) -> String {
    let line = |parameter: &ParameterRecord| {
        let mut line = format!(
            "key={} unit={} best={:?}",
            parameter.key, parameter.unit, parameter.best
        );
        if let Some(m) = &parameter.posterior {
            let [low, median, high] = m.quantiles;
            line += &format!(
                " median={median:?} low={low:?} high={high:?} r_hat={:?} bulk_effective_size={:?} tail_effective_size={:?}",
                m.r_hat, m.bulk_effective_size, m.tail_effective_size
            );
        }
        line + "\n"
    };
    calibration.parameters.iter().map(line).collect()
}

fn parameters(calibration: &Calibration) -> String {
    let sampled = calibration.sampling.is_some();
    let mut header = vec!["parameter", "prior 95 %", "best ± error"];
    if sampled {
        header.extend(["posterior 95 %", "R-hat", "bulk", "tail"]);
    }
    let mut table = table(header.into_iter().map(str::to_owned).collect());
    let rounded = |value: f64| significant(value, 4);
    let from_to = |low: f64, high: f64| format!("{} to {}", rounded(low), rounded(high));
    let sampled_cells = |marginal: Option<Marginal>| {
        let Some(m) = marginal else {
            return vec![String::new(); 4];
        };
        let [low, _, high] = m.quantiles;
        vec![
            from_to(low, high),
            format!("{:.3}", m.r_hat),
            format!("{:.0}", m.bulk_effective_size),
            format!("{:.0}", m.tail_effective_size),
        ]
    };
    let names = names(&calibration.parameters);
    for (parameter, name) in calibration.parameters.iter().zip(names) {
        let error = parameter
            .standard_error
            .map_or_else(|| "?".to_owned(), |error| significant(error, 2));
        let mut row = vec![
            name,
            from_to(parameter.prior[0], parameter.prior[2]),
            format!("{} ± {error}", rounded(parameter.best)),
        ];
        if sampled {
            row.extend(sampled_cells(parameter.posterior));
        }
        table.add_row(row);
    }
    let scatter = &calibration.scatter;
    let mut row = vec![
        "relative scatter [%]".to_owned(),
        if scatter.estimated { "" } else { "given" }.to_owned(),
        rounded(100.0 * scatter.best),
    ];
    if sampled {
        row.extend(sampled_cells(scatter.posterior.map(|m| Marginal {
            quantiles: m.quantiles.map(|value| 100.0 * value),
            ..m
        })));
    }
    table.add_row(row);
    keep_whole(&mut table, 1..if sampled { 6 } else { 3 });
    text_of(&table)
}

/// Names for a table: the last part of each key, unless two keys end alike.
fn names(parameters: &[ParameterRecord]) -> Vec<String> {
    let last = |key: &str| key.rsplit('.').next().unwrap_or(key).to_owned();
    let short: Vec<String> = parameters.iter().map(|p| last(&p.key)).collect();
    let twice = |name: &String| short.iter().filter(|other| *other == name).count() > 1;
    let whole = short.iter().any(twice);
    let of = |(parameter, short): (&ParameterRecord, &String)| {
        let name = if whole { &parameter.key } else { short };
        match parameter.unit.as_str() {
            "" => name.clone(),
            unit => format!("{name} [{unit}]"),
        }
    };
    parameters.iter().zip(&short).map(of).collect()
}

fn quality(calibration: &Calibration) -> String {
    let mut header = vec!["values", "count", "RMS before", "RMS", "bias"];
    if calibration.sampling.is_some() {
        header.push("in the 95 % band");
    }
    let mut table = table(header.into_iter().map(str::to_owned).collect());
    let percent = |value: f64| format!("{:.1} %", 100.0 * value);
    let mut row = |name: &str, quality: &Quality| {
        let mut cells = vec![
            name.to_owned(),
            quality.count.to_string(),
            quality.rms_before.map_or_else(String::new, percent),
            percent(quality.rms),
            percent(quality.bias),
        ];
        cells.extend(quality.inside.map(|count| count.to_string()));
        table.add_row(cells);
    };
    row("fitted to", &calibration.training);
    if let Some(quality) = &calibration.hold_out {
        row("held out", quality);
    }
    text_of(&table)
}

fn sample(calibration: &Calibration) -> String {
    let Some(record) = &calibration.sampling else {
        return String::new();
    };
    let of = record.sampling;
    format!(
        "{} of {} walkers, {} steps after {}, seed {}; {:.0} % of the moves were made\n\n",
        counted(of.ensembles, "ensemble"),
        of.walkers,
        of.steps,
        of.burn_in,
        calibration.seed,
        100.0 * record.acceptance
    )
}

fn left_out(calibration: &Calibration) -> String {
    const SHOWN: usize = 6;
    let all = &calibration.left_out;
    let mut text = format!(
        "{}\n",
        bold(format!("{} left out", counted(all.len(), "value")))
    );
    for left in all.iter().take(SHOWN) {
        let line = format!("{}: {}", left.id, left.reason);
        text += &format!("  {}\n", wrap(&line, width() - 2, 4));
    }
    if all.len() > SHOWN {
        text += &format!("  and {} more, see --json\n", all.len() - SHOWN);
    }
    text + "\n"
}

fn list(what: &str, words: &mut dyn Iterator<Item = String>) -> String {
    words
        .map(|words| {
            let line = wrap(&words, width() - what.len() - 2, 2);
            format!("{}: {line}\n", yellow(what))
        })
        .collect()
}
