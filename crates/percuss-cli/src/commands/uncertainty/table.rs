//! Terminal output of an uncertainty analysis.

use percuss::{
    Scenario,
    uncertainty::{
        Band, Estimate, Index, Perforation, QuantityResult, Statistics, TornadoBar, Uncertainty,
    },
    units::significant,
};
use percuss_report::{
    result_rows::with_uncertainty,
    table::{Table, number},
};

use crate::{
    table::blocks,
    terminal::{self, bold, paragraph, title, width, wrap},
};

/// All tables and warnings.
pub fn text(scenario: &Scenario, found: &Uncertainty) -> String {
    let mut text = head(scenario, found) + &inputs(found) + &outcome(found) + &spread(found);
    text += &axisymmetric(found);
    for quantity in &found.quantities {
        text += &influence(found, quantity);
    }
    if let Some(why) = &found.no_indices {
        text += &format!("{}\n", paragraph(&format!("no Sobol' indices: {why}")));
    }
    text + &bands(found) + &warnings(found)
}

/// One line of NAME=VALUE pairs per quantity; one for its axisymmetric correction, and one per impact velocity for its bands.
pub fn lines(found: &Uncertainty) -> String {
    let probability = found.perforation.map(|p| p.probability);
    let probability = probability.map_or_else(|| "null".to_owned(), |p| significant(p, 4));
    let line = |q: &QuantityResult| {
        let s = &q.statistics;
        let at = |percent| significant(s.percentile(percent).value, 6);
        format!(
            "quantity={} mean={} standard_deviation={} p05={} p50={} p95={} runs={} failed={} perforation={probability}\n",
            q.quantity,
            significant(s.mean, 6),
            significant(s.standard_deviation, 6),
            at(5.0),
            at(50.0),
            at(95.0),
            s.runs,
            found.failures.runs,
        )
    };
    let mut text: String = found.quantities.iter().map(line).collect();
    if let Some(spread) = &found.axisymmetric {
        text += &format!(
            "axisymmetric.quantity={} mean={} standard_error={} standard_deviation={} p05={} p50={} p95={} runs={} left_out={}\n",
            spread.quantity,
            significant(spread.mean, 6),
            significant(spread.standard_error, 6),
            significant(spread.standard_deviation, 6),
            significant(spread.p05, 6),
            significant(spread.p50, 6),
            significant(spread.p95, 6),
            spread.points.len(),
            spread.left_out,
        );
    }
    for band in &found.bands {
        for (i, quantity) in found.quantities.iter().enumerate() {
            let statistics = band.quantities[i].statistics.as_ref();
            let at = |percent| {
                let value = statistics.map(|s| significant(s.percentile(percent).value, 6));
                value.unwrap_or_else(|| "null".to_owned())
            };
            text += &format!(
                "impact_velocity_m_s={} quantity={} p05={} p50={} p95={} runs={} failed={}\n",
                significant(band.impact_velocity_m_s, 6),
                quantity.quantity,
                at(5.0),
                at(50.0),
                at(95.0),
                band.runs,
                band.failed,
            );
        }
    }
    text
}

fn head(scenario: &Scenario, found: &Uncertainty) -> String {
    let line = format!(
        "case {}, model {}, {} samples, seed {}, {} runs in total",
        found.case, found.model, found.samples, found.seed, found.runs
    );
    format!("{}{}\n", title(scenario), paragraph(&line))
}

fn inputs(found: &Uncertainty) -> String {
    let heading = match found.correlated {
        true => "parameter (correlated)",
        false => "parameter",
    };
    let table = Table::of(&found.inputs)
        .words(heading, |input| input.label.clone())
        .words("distribution", |input| input.distribution.clone());
    blocks(&table.table())
}

fn outcome(found: &Uncertainty) -> String {
    let mut rows = vec![(
        "outcome at median inputs",
        found.nominal.outcome.describe().to_owned(),
    )];
    if let Some(p) = &found.perforation {
        rows.push(("probability of perforation", probability(p)));
    }
    if found.failures.runs > 0 {
        rows.push((
            "runs without a result",
            format!("{} of {}", found.failures.runs, found.samples),
        ));
    }
    let row = |(name, value): &(&str, String)| format!("{name:<28}{value}\n");
    rows.iter().map(row).collect::<String>() + "\n"
}

fn percent(part: f64) -> String {
    significant((1000.0 * part).round() / 10.0, 4)
}

fn probability(p: &Perforation) -> String {
    format!(
        "{} % ({} … {} %), {} of {} runs",
        percent(p.probability),
        percent(p.low),
        percent(p.high),
        p.perforated,
        p.perforated + p.stopped
    )
}

/// One row per statistic, one column per quantity.
fn spread(found: &Uncertainty) -> String {
    if found.quantities.is_empty() {
        return String::new();
    }
    type Read = fn(&QuantityResult) -> String;
    const ROWS: [(&str, Read); 8] = [
        ("at median inputs", |q| number(q.nominal, 4)),
        ("mean", |q| significant(q.statistics.mean, 4)),
        ("standard error of the mean", |q| {
            significant(q.statistics.standard_error, 2)
        }),
        ("standard deviation", |q| {
            significant(q.statistics.standard_deviation, 3)
        }),
        ("5th percentile", |q| percentile(&q.statistics, 5.0)),
        ("median", |q| percentile(&q.statistics, 50.0)),
        ("95th percentile", |q| percentile(&q.statistics, 95.0)),
        ("runs", |q| q.statistics.runs.to_string()),
    ];
    let table =
        Table::of(&ROWS)
            .words("", |(name, _)| *name)
            .each(&found.quantities, |rows, quantity| {
                rows.numbers(
                    heading(quantity),
                    quantity.what().unit.symbol,
                    |(_, read)| read(quantity),
                )
            });
    blocks(&table.table())
}

/// Mean and spread corrected by axisymmetric runs.
fn axisymmetric(found: &Uncertainty) -> String {
    let Some(spread) = &found.axisymmetric else {
        return String::new();
    };
    let (what, unit) = (spread.what().label, spread.what().unit.symbol);
    let with_error = |value: f64, error: f64| with_uncertainty(value, error, unit);
    let plain = |value: f64| format!("{} {unit}", significant(value, 4));
    let mut rows = vec![
        ("mean", with_error(spread.mean, spread.standard_error)),
        (
            "standard deviation",
            with_error(spread.standard_deviation, spread.standard_deviation_error),
        ),
        ("5th percentile", plain(spread.p05)),
        ("median", plain(spread.p50)),
        ("95th percentile", plain(spread.p95)),
    ];
    if let Some(uncertainty) = spread.discretisation_uncertainty {
        rows.push((
            "discretisation uncertainty",
            format!("± {} {unit}", significant(uncertainty, 2)),
        ));
    }
    rows.push((
        "correlation",
        format!(
            "{} with `{}`",
            significant(spread.correlation, 3),
            found.model
        ),
    ));
    let points = match spread.left_out {
        0 => format!("{} runs of `axi`", spread.points.len()),
        out => format!(
            "{} runs of `axi`, {out} left out without this number",
            spread.points.len()
        ),
    };
    let title = format!("axisymmetric {what}, corrected by {points}; ± is a standard error");
    let title = wrap(&title, width(), 0);
    let row = |(name, value): &(&str, String)| format!("{name:<28}{value}\n");
    format!(
        "{}\n{}\n",
        bold(title),
        rows.iter().map(row).collect::<String>()
    )
}

fn percentile(statistics: &Statistics, percent: f64) -> String {
    significant(statistics.percentile(percent).value, 4)
}

/// Name of a quantity in two lines.
fn heading(quantity: &QuantityResult) -> String {
    let words = quantity.what().label;
    match words.rsplit_once(' ') {
        Some((start, end)) => format!("{start}\n{end}"),
        None => words.to_owned(),
    }
}

fn influence(found: &Uncertainty, quantity: &QuantityResult) -> String {
    let unit = quantity.what().unit.symbol;
    let mut rows = Table::of(&quantity.tornado)
        .words("parameter", |bar| found.label(&bar.key).to_owned())
        .numbers("at 5th\npercentile", unit, |bar| number(bar.at_low, 4))
        .numbers("at 95th\npercentile", unit, |bar| number(bar.at_high, 4));
    if let Some(indices) = &quantity.indices {
        let index = |bar: &TornadoBar, of: fn(&Index) -> Estimate| {
            let mut all = indices.parameters.iter();
            let found = all.find(|index| index.key == bar.key);
            found.map_or_else(String::new, |index| with_error(of(index)))
        };
        rows = rows
            .numbers("first-order\nindex", "", |bar| {
                index(bar, |i| i.first_order)
            })
            .numbers("total-effect\nindex", "", |bar| index(bar, |i| i.total));
    }
    let title = format!("sensitivity of the {}", quantity.what().label);
    let mut text = format!("{}\n{}", bold(title), blocks(&rows.table()));
    if let (Some(why), None) = (&quantity.no_indices, &found.no_indices) {
        text += &format!("{}\n", paragraph(&format!("no Sobol' indices: {why}")));
    }
    text
}

/// An estimate and half the length of its interval.
fn with_error(estimate: Estimate) -> String {
    // A zero is never negative.
    let number = |value: f64| format!("{:.2}", (100.0 * value).round() / 100.0 + 0.0);
    format!(
        "{} ± {}",
        number(estimate.value),
        number(0.5 * (estimate.high - estimate.low))
    )
}

fn bands(found: &Uncertainty) -> String {
    if found.bands.is_empty() {
        return String::new();
    }
    let bands = &found.bands;
    let perforates = |band: &Band| band.perforation.is_some_and(|p| p.perforated > 0);
    let table = Table::of(bands)
        .numbers("velocity", "m/s", |band| {
            significant(band.impact_velocity_m_s, 4)
        })
        .when(bands.iter().any(perforates), |rows| {
            rows.numbers("probability of\nperforation", "%", |band| {
                let perforation = band.perforation;
                perforation.map_or_else(|| number(None, 0), |p| percent(p.probability))
            })
        })
        .each(
            found.quantities.iter().enumerate(),
            |rows, (i, quantity)| {
                let unit = quantity.what().unit.symbol;
                rows.each([5.0, 50.0, 95.0], |rows, at| {
                    let heading = format!("{}\n[{unit}]\nP{at}", heading(quantity));
                    rows.numbers(heading, "", |band| {
                        let statistics = band.quantities[i].statistics.as_ref();
                        statistics.map_or_else(|| number(None, 0), |s| percentile(s, at))
                    })
                })
            },
        )
        .when(bands.iter().any(|band| band.failed > 0), |rows| {
            rows.numbers("failed", "", |band| band.failed.to_string())
        });
    let title = format!(
        "percentiles versus impact velocity, {} runs each; the velocity itself is exact",
        bands[0].runs
    );
    format!("{}\n{}", bold(title), blocks(&table.table()))
}

fn warnings(found: &Uncertainty) -> String {
    let mut text = String::new();
    let nominal = found.nominal.warnings.iter();
    for warning in found.warnings.iter().chain(nominal) {
        text += &format!("{}\n", terminal::warning(warning));
    }
    text + &paragraph(&found.caution())
}
