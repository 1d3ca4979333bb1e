//! What is printed of an analysis of uncertainty.

use percuss::{
    Scenario,
    uncertainty::{Band, Estimate, Index, Perforation, QuantityResult, TornadoBar, Uncertainty},
    units::significant,
};

use crate::{
    table::{Column, blocks},
    terminal::{bold, width, wrap, yellow},
};

/// Everything.
pub fn text(scenario: &Scenario, found: &Uncertainty) -> String {
    let mut text = head(scenario, found) + &inputs(found) + &outcome(found) + &spread(found);
    for quantity in &found.quantities {
        text += &influence(found, quantity);
    }
    if let Some(why) = &found.no_indices {
        text += &format!(
            "{}\n\n",
            wrap(&format!("no Sobol' indices: {why}"), width(), 0)
        );
    }
    text + &bands(found) + &warnings(found)
}

/// One line of pairs a quantity.
pub fn lines(found: &Uncertainty) -> String {
    let probability = found.perforation.map(|p| p.probability);
    let probability = probability.map_or_else(|| "null".to_owned(), |p| significant(p, 4));
    let line = |q: &QuantityResult| {
        let s = &q.statistics;
        let at = |percent| significant(s.percentile(percent).value, 6);
        format!(
            "quantity={} mean={} standard_deviation={} p05={} p50={} p95={} shots={} failed={} perforation={probability}\n",
            q.quantity,
            significant(s.mean, 6),
            significant(s.standard_deviation, 6),
            at(5.0),
            at(50.0),
            at(95.0),
            s.shots,
            found.failures.shots,
        )
    };
    found.quantities.iter().map(line).collect()
}

fn head(scenario: &Scenario, found: &Uncertainty) -> String {
    let title = match scenario.title.is_empty() {
        true => &scenario.name,
        false => &scenario.title,
    };
    let line = format!(
        "case {}, model {}, statistics of {} shots, seed {}, {} shots in all",
        found.case, found.model, found.samples, found.seed, found.shots
    );
    let (title, line) = (wrap(title, width(), 0), wrap(&line, width(), 0));
    format!("{}\n{line}\n\n", bold(title))
}

fn column(heading: &str, cells: Vec<String>) -> Column {
    Column {
        heading: heading.to_owned(),
        cells,
        numbers: true,
    }
}

fn names(heading: &str, cells: Vec<String>) -> Column {
    Column {
        numbers: false,
        ..column(heading, cells)
    }
}

fn inputs(found: &Uncertainty) -> String {
    let inputs = found.inputs.iter();
    let heading = match found.correlated {
        true => "uncertain (correlated)",
        false => "uncertain",
    };
    let first = names(
        heading,
        inputs.clone().map(|input| input.label.clone()).collect(),
    );
    let words = inputs.map(|input| input.distribution.clone()).collect();
    blocks(&first, vec![names("distribution", words)])
}

fn outcome(found: &Uncertainty) -> String {
    let mut rows = vec![(
        "with all at their medians",
        found.nominal.outcome.in_words().to_owned(),
    )];
    if let Some(p) = &found.perforation {
        rows.push(("chance of perforation", chance(p)));
    }
    if found.failures.shots > 0 {
        rows.push((
            "shots without a result",
            format!("{} of {}", found.failures.shots, found.samples),
        ));
    }
    let row = |(name, value): &(&str, String)| format!("{name:<28}{value}\n");
    rows.iter().map(row).collect::<String>() + "\n"
}

fn percent(part: f64) -> String {
    significant((1000.0 * part).round() / 10.0, 4)
}

fn chance(p: &Perforation) -> String {
    format!(
        "{} % ({} … {} %), {} of {} shots",
        percent(p.probability),
        percent(p.low),
        percent(p.high),
        p.perforated,
        p.perforated + p.stopped
    )
}

/// A row a statistic, a column a quantity.
fn spread(found: &Uncertainty) -> String {
    if found.quantities.is_empty() {
        return String::new();
    }
    let rows = [
        "all at their medians",
        "mean",
        "its standard error",
        "standard deviation",
        "5 % lie below",
        "50 %",
        "95 %",
        "shots",
    ];
    let of = |quantity: &QuantityResult| {
        let s = &quantity.statistics;
        let at = |percent: f64| significant(s.percentile(percent).value, 4);
        let cells = vec![
            value(quantity.nominal),
            significant(s.mean, 4),
            significant(s.standard_error, 2),
            significant(s.standard_deviation, 3),
            at(5.0),
            at(50.0),
            at(95.0),
            s.shots.to_string(),
        ];
        column(&heading(quantity), cells)
    };
    let first = names("", rows.map(str::to_owned).to_vec());
    blocks(&first, found.quantities.iter().map(of).collect())
}

/// Name and unit of a quantity in narrow lines.
fn heading(quantity: &QuantityResult) -> String {
    let what = quantity.what();
    let words = match what.label.rsplit_once(' ') {
        Some((start, end)) => format!("{start}\n{end}"),
        None => what.label.to_owned(),
    };
    format!("{words}\n[{}]", what.unit.symbol)
}

fn value(value: Option<f64>) -> String {
    value.map_or_else(|| "–".to_owned(), |v| significant(v, 4))
}

fn influence(found: &Uncertainty, quantity: &QuantityResult) -> String {
    let bars = quantity.tornado.iter();
    let each = |of: &dyn Fn(&TornadoBar) -> String| bars.clone().map(of).collect();
    let unit = quantity.what().unit.symbol;
    let first = names("parameter", each(&|bar| found.label(&bar.key).to_owned()));
    let mut columns = vec![
        column(&format!("at 5 %\n[{unit}]"), each(&|bar| value(bar.at_low))),
        column(
            &format!("at 95 %\n[{unit}]"),
            each(&|bar| value(bar.at_high)),
        ),
    ];
    if let Some(indices) = &quantity.indices {
        let index = |key: &str, of: fn(&Index) -> Estimate| {
            let found = indices.parameters.iter().find(|index| index.key == key);
            found.map_or_else(String::new, |index| with_error(of(index)))
        };
        columns.push(column(
            "index,\nfirst order",
            each(&|bar| index(&bar.key, |i| i.first_order)),
        ));
        columns.push(column(
            "index,\ntotal",
            each(&|bar| index(&bar.key, |i| i.total)),
        ));
    }
    let title = format!("what moves the {}", quantity.what().label);
    let mut text = format!("{}\n{}", bold(title), blocks(&first, columns));
    if let (Some(why), None) = (&quantity.no_indices, &found.no_indices) {
        text += &format!(
            "{}\n\n",
            wrap(&format!("no Sobol' indices: {why}"), width(), 0)
        );
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
    let first = column(
        "speed\n[m/s]",
        bands
            .iter()
            .map(|b| significant(b.velocity_m_s, 4))
            .collect(),
    );
    let mut columns = Vec::new();
    if bands
        .iter()
        .any(|band| band.perforation.is_some_and(|p| p.perforated > 0))
    {
        let cell = |band: &Band| {
            band.perforation
                .map_or_else(|| "–".to_owned(), |p| percent(p.probability))
        };
        columns.push(column("perforation\n[%]", bands.iter().map(cell).collect()));
    }
    for (i, quantity) in found.quantities.iter().enumerate() {
        for at in [5.0, 50.0, 95.0] {
            let cell = |band: &Band| {
                let statistics = band.quantities[i].statistics.as_ref();
                statistics.map_or_else(
                    || "–".to_owned(),
                    |s| significant(s.percentile(at).value, 4),
                )
            };
            let heading = format!("{}\n{at} %", heading(quantity));
            columns.push(column(&heading, bands.iter().map(cell).collect()));
        }
    }
    if bands.iter().any(|band| band.failed > 0) {
        columns.push(column(
            "failed",
            bands.iter().map(|band| band.failed.to_string()).collect(),
        ));
    }
    let title = format!(
        "over speed, {} shots each; the speed itself is exact",
        bands[0].shots
    );
    format!("{}\n{}", bold(title), blocks(&first, columns))
}

fn warnings(found: &Uncertainty) -> String {
    let mut text = String::new();
    let nominal = found.nominal.warnings.iter();
    for warning in found.warnings.iter().chain(nominal) {
        let line = wrap(&format!("warning: {warning}"), width(), 9);
        text += &line.replacen("warning:", &yellow("warning:"), 1);
        text += "\n\n";
    }
    text + &wrap(&found.caution(), width(), 0) + "\n"
}
