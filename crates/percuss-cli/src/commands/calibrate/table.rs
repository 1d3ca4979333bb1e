//! Terminal output of a calibration.

use percuss::{
    calibrate::{
        Calibration, CorrectionRecord, CurveError, CurvePrediction, Marginal, ParameterRecord,
    },
    units::significant,
};
use percuss_report::table::{Table, number};

use crate::{
    table::{blocks, wrapped},
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
    text += &calibration.correction.map_or_else(String::new, correction);
    text += &parameters(calibration);
    text += &quality(calibration);
    text += &curves(calibration);
    text += &sample(calibration);
    if !calibration.left_out.is_empty() {
        text += &left_out(calibration);
    }
    let findings = calibration.findings.iter().map(|finding| &finding.words);
    let mut notes = list("not identified", &mut findings.cloned());
    notes += &list("warning", &mut calibration.warnings.iter().cloned());
    text + &notes
}

/// One line of NAME=VALUE pairs per parameter.
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

fn correction(record: CorrectionRecord) -> String {
    let [coarse, medium, fine] = record.reference.cells();
    format!(
        "corrected to `axi` on {coarse}, {medium} and {fine} cells: {} in {}, last difference {:.1} %\n",
        counted(record.answers, "answer"),
        counted(record.rounds, "round"),
        100.0 * record.difference
    )
}

/// Row of the table of parameters.
struct ParameterRow {
    name: String,
    prior: String,
    best: String,
    posterior: Option<Marginal>,
}

fn parameters(calibration: &Calibration) -> String {
    let rounded = |value: f64| significant(value, 4);
    let from_to = |low: f64, high: f64| format!("{} to {}", rounded(low), rounded(high));
    let names = names(&calibration.parameters);
    let parameters = calibration.parameters.iter().zip(names);
    let mut rows: Vec<ParameterRow> = parameters
        .map(|(parameter, name)| {
            let error = parameter.standard_error;
            let error = error.map_or_else(|| "?".to_owned(), |error| significant(error, 2));
            ParameterRow {
                name,
                prior: from_to(parameter.prior[0], parameter.prior[2]),
                best: format!("{} ± {error}", rounded(parameter.best)),
                posterior: parameter.posterior,
            }
        })
        .collect();
    let scatter = &calibration.scatter;
    rows.push(ParameterRow {
        name: "scatter [%]".to_owned(),
        prior: if scatter.estimated { "" } else { "given" }.to_owned(),
        best: rounded(100.0 * scatter.best),
        posterior: scatter.posterior.map(|m| Marginal {
            quantiles: m.quantiles.map(|value| 100.0 * value),
            ..m
        }),
    });
    let sampled = calibration.sampling.is_some();
    let of = |row: &ParameterRow, words: &dyn Fn(&Marginal) -> String| {
        row.posterior.as_ref().map_or_else(String::new, words)
    };
    let table = Table::of(&rows)
        .words("parameter", |row| row.name.clone())
        .words("prior 95 %", |row| row.prior.clone())
        .words("best ± error", |row| row.best.clone())
        .when(sampled, |rows| {
            rows.words("posterior 95 %", |row| {
                of(row, &|m| from_to(m.quantiles[0], m.quantiles[2]))
            })
            .words("R-hat", |row| of(row, &|m| format!("{:.3}", m.r_hat)))
            .words("bulk", |row| {
                of(row, &|m| format!("{:.0}", m.bulk_effective_size))
            })
            .words("tail", |row| {
                of(row, &|m| format!("{:.0}", m.tail_effective_size))
            })
        })
        .table();
    blocks(&table)
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
    let percent = |value: f64| format!("{:.1} %", 100.0 * value);
    let fitted = calibration.training.iter().map(|all| ("fitted", all));
    let held_out = calibration.hold_out.iter().map(|all| ("held out", all));
    let rows: Vec<_> = fitted.chain(held_out).collect();
    if rows.is_empty() {
        return String::new();
    }
    let table = Table::of(&rows)
        .words("values", |(name, _)| *name)
        .words("count", |(_, quality)| quality.count.to_string())
        .words("RMS before", |(_, quality)| {
            quality.rms_before.map_or_else(String::new, percent)
        })
        .words("RMS", |(_, quality)| percent(quality.rms))
        .words("bias", |(_, quality)| percent(quality.bias))
        .when(calibration.sampling.is_some(), |rows| {
            rows.words("in the 95 % band", |(_, quality)| {
                quality
                    .inside
                    .map_or_else(String::new, |count| count.to_string())
            })
        })
        .table();
    wrapped(&table, [])
}

fn curves(calibration: &Calibration) -> String {
    let rows = &calibration.curves;
    if rows.is_empty() {
        return String::new();
    }
    let error = |error: Option<CurveError>| number(error.and_then(|error| error.rms_difference), 3);
    let relative = |curve: &CurvePrediction| {
        let part = curve.best.and_then(|best| best.relative_rms_difference);
        number(part.map(|part| 100.0 * part), 3)
    };
    let correlation = |curve: &CurvePrediction| {
        let time = significant(curve.correlation_time_us, 2);
        match curve.correlation_estimated {
            true => time,
            false => format!("{time} (given)"),
        }
    };
    let table = Table::of(rows)
        .words("curve", |curve| curve.id.clone())
        .words("part", |curve| {
            if curve.held_out { "held out" } else { "fitted" }.to_owned()
        })
        .numbers("values", "", |curve| curve.values.to_string())
        .numbers("effective\nnumber", "", |curve| {
            significant(curve.effective_values, 3)
        })
        .words("correlation\ntime [us]", correlation)
        .words("unit", |curve| curve.unit.to_owned())
        .numbers("RMS diff.\nbefore", "", |curve| error(curve.before))
        .numbers("RMS diff.", "", |curve| error(curve.best))
        .numbers("relative", "%", relative)
        .when(calibration.sampling.is_some(), |rows| {
            rows.numbers("in the 95 %\nband", "%", |curve| {
                number(curve.inside.map(|part| 100.0 * part), 3)
            })
        })
        .table();
    blocks(&table)
}

fn sample(calibration: &Calibration) -> String {
    let Some(record) = &calibration.sampling else {
        return String::new();
    };
    let of = record.sampling;
    format!(
        "{} of {} walkers, {} steps after {}, seed {}; acceptance rate {:.0} %\n\n",
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
    let what = match calibration.curves.is_empty() {
        true => "value",
        false => "value or curve",
    };
    let mut text = format!(
        "{}\n",
        bold(format!("{} left out", counted(all.len(), what)))
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
