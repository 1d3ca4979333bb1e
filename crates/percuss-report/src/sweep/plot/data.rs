//! Rows of a sweep with labels and groups for its figures.

use std::collections::BTreeMap;

use percuss::{model, statistics::sorted};

use super::{
    super::{
        manifest::{Manifest, Varied},
        rows::Rows,
    },
    label, quantity,
};
use crate::{Axis, names};

/// Largest number of names along an axis.
const NAMES: usize = 12;
/// Relative difference of steps that count as even.
const EVEN: f64 = 1e-6;
/// Decades from which on the values of a list stand on a logarithmic axis.
const INPUT_DECADES: f64 = 2.0;
/// Decades from which on results do.
const RESULT_DECADES: f64 = 3.0;

/// Whether values are positive and span so many decades.
fn spans(values: &[f64], decades: f64) -> bool {
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(0.0, f64::max);
    low > 0.0 && high.is_finite() && (high / low).log10() >= decades
}

/// Whether the steps between values are equal.
pub(super) fn is_even(values: impl Iterator<Item = f64> + Clone) -> bool {
    let mut steps = values.clone().skip(1).zip(values).map(|(b, a)| b - a);
    steps
        .next()
        .is_some_and(|first| steps.all(|step| (step - first).abs() <= EVEN * first.abs()))
}

/// Rows of a sweep with one result.
pub(super) struct Data<'a> {
    manifest: &'a Manifest,
    pub(super) quantity: &'a str,
    pub(super) rows: Rows,
}

/// Values of the runs at one place of a figure.
#[derive(Debug, Clone, Copy)]
pub(super) struct Group {
    pub(super) count: u32,
    sum: f64,
    pub(super) low: f64,
    pub(super) high: f64,
    /// Failed runs.
    pub(super) failed: u32,
    /// Runs without this result that did not fail.
    pub(super) without: u32,
}

impl Default for Group {
    fn default() -> Self {
        Self {
            count: 0,
            sum: 0.0,
            low: f64::INFINITY,
            high: f64::NEG_INFINITY,
            failed: 0,
            without: 0,
        }
    }
}

impl Group {
    pub(super) fn add(&mut self, value: f64, failed: bool) {
        match (value.is_finite(), failed) {
            (true, _) => {
                self.count += 1;
                self.sum += value;
                self.low = self.low.min(value);
                self.high = self.high.max(value);
            }
            (false, true) => self.failed += 1,
            (false, false) => self.without += 1,
        }
    }

    /// Mean of the values; NaN when there are none.
    pub(super) fn mean(&self) -> f64 {
        match self.count {
            0 => f64::NAN,
            // The mean of one value, or of equal ones, is that value to the last digit.
            _ => (self.sum / f64::from(self.count)).clamp(self.low, self.high),
        }
    }
}

impl<'a> Data<'a> {
    pub(super) fn new(manifest: &'a Manifest, quantity: &'a str, rows: Rows) -> Self {
        Self {
            manifest,
            quantity,
            rows,
        }
    }

    pub(super) fn parameters(&self) -> &'a [Varied] {
        &self.manifest.parameters
    }

    /// The parameters that take more than one value.
    pub(super) fn varied(&self) -> Vec<usize> {
        let all = self.parameters().iter().enumerate();
        all.filter(|(_, p)| p.count != Some(1))
            .map(|(i, _)| i)
            .collect()
    }

    pub(super) fn is_numeric(&self, parameter: usize) -> bool {
        self.parameters()[parameter].words.is_empty()
    }

    /// Whether a parameter takes the values of a list.
    pub(super) fn is_list(&self, parameter: usize) -> bool {
        self.parameters()[parameter].count.is_some()
    }

    /// Number of values of a list; unlimited for a distribution.
    pub(super) fn count(&self, parameter: usize) -> usize {
        let count = self.parameters()[parameter].count;
        count.map_or(usize::MAX, |count| count as usize)
    }

    /// The different values that a parameter takes, in order.
    pub(super) fn values(&self, parameter: usize) -> Vec<f64> {
        let values = self.rows.inputs[parameter].iter().copied();
        let mut values = sorted(values.filter(|value| value.is_finite()));
        values.dedup();
        values
    }

    /// Runs grouped by place.
    pub(super) fn grouped<K: Ord>(&self, place: impl Fn(usize) -> K) -> BTreeMap<K, Group> {
        let mut groups = BTreeMap::new();
        for (i, (value, failed)) in self.rows.values.iter().zip(&self.rows.failed).enumerate() {
            let group: &mut Group = groups.entry(place(i)).or_default();
            group.add(*value, *failed);
        }
        groups
    }

    /// All runs together.
    pub(super) fn all(&self) -> Group {
        self.grouped(|_| ())
            .into_values()
            .next()
            .unwrap_or_default()
    }

    /// Axis of a parameter; words are at 1, 2, 3, …
    pub(super) fn axis(&self, parameter: usize) -> Axis {
        let varied = &self.parameters()[parameter];
        let axis = Axis::new(label(varied));
        match (varied.words.is_empty(), varied.kind.as_str()) {
            (false, _) => axis
                .names(varied.words.iter().cloned())
                .range(0.5, varied.words.len() as f64 + 0.5),
            (true, "log") => axis.log(),
            (true, "values") => {
                let values = self.values(parameter);
                // Who asks for even steps sees even steps.
                match spans(&values, INPUT_DECADES) && !is_even(values.iter().copied()) {
                    true => axis.log(),
                    false => axis,
                }
            }
            _ => axis,
        }
    }

    /// Place of a value on the axis of its parameter.
    pub(super) fn at(&self, parameter: usize, value: f64) -> f64 {
        match self.is_numeric(parameter) {
            true => value,
            false => value + 1.0,
        }
    }

    /// A value of a parameter in words.
    pub(super) fn word(&self, parameter: usize, value: f64) -> String {
        let varied = &self.parameters()[parameter];
        match varied.words.get(value as usize) {
            Some(word) if varied.key.ends_with(".material") => {
                names::library_material(word).to_owned()
            }
            Some(word) => word.clone(),
            None => crate::frame::tick_label(value),
        }
    }

    /// Name of the curve of a value, with the name of the parameter for a number.
    pub(super) fn curve(&self, parameter: usize, value: f64) -> String {
        let word = self.word(parameter, value);
        let varied = &self.parameters()[parameter];
        let unit = match varied.unit.as_str() {
            "" => String::new(),
            unit => format!(" {unit}"),
        };
        match self.is_numeric(parameter) {
            true => format!("{} {word}{unit}", names::parameter(&varied.key)),
            false => word,
        }
    }

    pub(super) fn value_axis(&self) -> Axis {
        let axis = Axis::new(quantity::label(self.quantity));
        let all = self.all();
        match all.failed + all.without == 0 && spans(&[all.low, all.high], RESULT_DECADES) {
            true => axis.log(),
            false => axis,
        }
    }

    pub(super) fn title(&self) -> String {
        match self.manifest.title.as_str() {
            "" => quantity::title(self.quantity),
            title => title.to_owned(),
        }
    }

    /// Title of the case, or its name.
    fn heading(&self) -> &str {
        match self.manifest.case_title.as_str() {
            "" => &self.manifest.case,
            title => title,
        }
    }

    /// Heading and number of runs, with the numbers of those that the figure cannot show.
    pub(super) fn caption(&self, more: &str) -> String {
        let all = self.all();
        let rows = self.rows.values.len();
        let mut text = format!(
            "{}; model {}, {}: {rows} runs",
            self.heading(),
            model::label(&self.manifest.model),
            self.manifest.design
        );
        for (count, what) in [
            (u64::from(all.failed), "failed"),
            (u64::from(all.without), "without this result"),
            (self.rows.missing, "more not computed yet"),
        ] {
            if count > 0 {
                text += &format!(", {count} {what}");
            }
        }
        if !more.is_empty() {
            text += &format!("; {more}");
        }
        text
    }

    /// Name of the figure's file.
    pub(super) fn name(&self, style: super::PlotStyle) -> String {
        format!("{}-{}", style.name(), self.quantity)
    }
}

/// Names of values along an axis, at 1, 2, 3, …: no more than there is room for.
pub(super) fn names(words: impl ExactSizeIterator<Item = String>) -> Vec<String> {
    let every = words.len().div_ceil(NAMES).max(1);
    let shown = |(i, word): (usize, String)| match i % every {
        0 => word,
        _ => String::new(),
    };
    words.enumerate().map(shown).collect()
}
