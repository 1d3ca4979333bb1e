//! Checking a parameter of a sweep file and turning it into an axis.

use super::{
    axis::{Axis, Values},
    distribution::{Cut, Distribution},
    file::{Design, Parameter, Steps},
    list_value::ListValue,
    quantity_literal::QuantityLiteral,
};
use percuss_core::statistics::evenly;

use crate::{check::Check, document::Renamed};

/// Most values of one list.
pub(crate) const MAX_VALUES: u64 = 1_000_000;
/// Most values of all lists together: a long one leaves room for others.
pub(crate) const MAX_TOGETHER: u64 = 4 * MAX_VALUES;
/// Part of a distribution that its limits have to leave.
const LEAST_LEFT: f64 = 1e-6;

/// Reads the amounts of a parameter and sees that they are of one unit.
struct Amounts {
    unit: Option<String>,
    whole: bool,
    samples: Vec<(String, f64)>,
}

impl Amounts {
    fn read(&mut self, check: &mut Check<'_>, key: &str, amount: &QuantityLiteral) -> f64 {
        let unit = self.unit.get_or_insert_with(|| amount.unit.clone());
        if *unit != amount.unit {
            let named = |unit: &str| match unit {
                "" => "without a unit".to_owned(),
                unit => format!("in {unit}"),
            };
            check.fail(
                key,
                format!(
                    "this is {}, another amount is {}",
                    named(&amount.unit),
                    named(unit)
                ),
                "write all amounts of a parameter in one unit",
            );
        }
        self.whole &= amount.whole;
        amount.value
    }

    /// Reads an amount that the case has to accept.
    fn sample(&mut self, check: &mut Check<'_>, key: &str, amount: &QuantityLiteral) -> f64 {
        let value = self.read(check, key, amount);
        self.samples.push((key.to_owned(), value));
        value
    }

    /// Reads a list that is written down value by value, for a key of the case.
    fn entries(
        &mut self,
        check: &mut Check<'_>,
        of: &str,
        entries: &[ListValue],
    ) -> Option<Values> {
        let (mut numbers, mut options) = (Vec::new(), Vec::new());
        for (i, entry) in entries.iter().enumerate() {
            let key = format!("values.{i}");
            match entry.of_key(of) {
                Err((message, help)) => {
                    check.fail(&key, message, help);
                    return None;
                }
                Ok(ListValue::QuantityLiteral(amount)) => {
                    numbers.push(self.sample(check, &key, &amount))
                }
                Ok(ListValue::Option(value)) if options.contains(&value) => {
                    check.fail(&key, format!("{value} is in the list twice"), "remove one");
                    return None;
                }
                Ok(ListValue::Option(value)) => {
                    self.samples.push((key.clone(), i as f64));
                    options.push(value);
                }
            }
            if !numbers.is_empty() && !options.is_empty() {
                check.fail(
                    &key,
                    "the list has numbers and words",
                    "write numbers only, such as 2.7 or \"230 m/s\", or words only, such as \"column\"",
                );
                return None;
            }
        }
        Some(match options.is_empty() {
            true => Values::List(numbers),
            false => Values::Options(options),
        })
    }

    fn steps(&mut self, check: &mut Check<'_>, kind: &str, steps: &Steps) -> Option<(f64, f64)> {
        let from = self.sample(check, &format!("{kind}.from"), &steps.from);
        let to = self.sample(check, &format!("{kind}.to"), &steps.to);
        let last = steps.count.wrapping_sub(1) as f64;
        self.whole &= kind == "linear" && (to - from) % last == 0.0;
        if !(2..=MAX_VALUES).contains(&steps.count) {
            check.fail(
                &format!("{kind}.count"),
                format!("{} is out of range", steps.count),
                format!("allowed: 2 to {MAX_VALUES}; for one value write values = [VALUE]"),
            );
            return None;
        }
        if kind == "log" && (from <= 0.0 || to <= 0.0) {
            let key = if from <= 0.0 { "log.from" } else { "log.to" };
            check.fail(
                key,
                "a logarithmic range has positive ends only",
                "use linear = { … }",
            );
            return None;
        }
        Some((from, to))
    }

    fn cut(
        &mut self,
        check: &mut Check<'_>,
        kind: &str,
        ends: [Option<&QuantityLiteral>; 2],
    ) -> Cut {
        let mut end = |name: &str, amount: Option<&QuantityLiteral>, open: f64| {
            amount.map_or(open, |amount| {
                self.sample(check, &format!("{kind}.{name}"), amount)
            })
        };
        Cut {
            min: end("min", ends[0], f64::NEG_INFINITY),
            max: end("max", ends[1], f64::INFINITY),
        }
    }
}

impl Parameter {
    /// Names of the ways to give values that are there.
    fn kinds(&self) -> Vec<&'static str> {
        [
            ("values", self.values.is_some()),
            ("linear", self.linear.is_some()),
            ("log", self.log.is_some()),
            ("normal", self.normal.is_some()),
            ("lognormal", self.lognormal.is_some()),
            ("uniform", self.uniform.is_some()),
            ("triangular", self.triangular.is_some()),
        ]
        .into_iter()
        .filter_map(|(name, given)| given.then_some(name))
        .collect()
    }

    /// Checks the parameter; `None` when something is wrong with it.
    pub fn resolve(&self, check: &mut Check<'_>, design: Design) -> Option<Axis> {
        if let Some(renamed) = Renamed::of(&self.key) {
            check.fail("key", renamed.message(), renamed.help());
            return None;
        }
        const WAYS: &str =
            "give one of values, linear, log, normal, lognormal, uniform and triangular";
        let kind = match self.kinds().as_slice() {
            [] => {
                check.fail("", format!("`{}` has no values", self.key), WAYS);
                return None;
            }
            [kind] => *kind,
            [first, second, ..] => {
                let message = format!("values are given twice, by {first} and by {second}");
                check.fail(second, message, WAYS);
                return None;
            }
        };
        let mut amounts = Amounts {
            unit: None,
            whole: true,
            samples: Vec::new(),
        };
        let values = match self.list(check, &mut amounts) {
            Some(list) => list?,
            None => Values::Distribution(self.distribution(check, &mut amounts, design)?),
        };
        Some(Axis {
            key: self.key.clone(),
            kind,
            unit: amounts.unit.unwrap_or_default(),
            whole: amounts.whole && matches!(values, Values::List(_)),
            values,
            samples: amounts.samples,
        })
    }

    /// The values of a list: `None` when the parameter has a distribution, `Some(None)` when the list is wrong.
    fn list(&self, check: &mut Check<'_>, amounts: &mut Amounts) -> Option<Option<Values>> {
        if let Some(values) = &self.values {
            if values.is_empty() {
                check.fail("values", "the list is empty", "give at least one value");
                return Some(None);
            }
            return Some(amounts.entries(check, &self.key, values));
        }
        let (kind, steps) = match (&self.linear, &self.log) {
            (Some(steps), _) => ("linear", steps),
            (_, Some(steps)) => ("log", steps),
            _ => return None,
        };
        let Some((from, to)) = amounts.steps(check, kind, steps) else {
            return Some(None);
        };
        let last = steps.count - 1;
        let values = match kind {
            "linear" => evenly(from, to, last).collect(),
            _ => {
                let ends = (libm::log(from), libm::log(to));
                let inside = evenly(ends.0, ends.1, last).enumerate();
                let value = |(i, log): (usize, f64)| match i as u64 {
                    0 => from,
                    i if i == last => to,
                    _ => libm::exp(log),
                };
                inside.map(value).collect()
            }
        };
        Some(Some(Values::List(values)))
    }

    fn distribution(
        &self,
        check: &mut Check<'_>,
        amounts: &mut Amounts,
        design: Design,
    ) -> Option<Distribution> {
        let kind = *self.kinds().first()?;
        if design == Design::Grid {
            check.fail(
                kind,
                "a grid has no distributions",
                "give values, linear or log, or use design = \"latin-hypercube\" or \"sobol\"",
            );
            return None;
        }
        let key = |name: &str| format!("{kind}.{name}");
        let distribution = if let Some(normal) = &self.normal {
            Distribution::Normal {
                mean: amounts.sample(check, &key("mean"), &normal.mean),
                deviation: amounts.read(
                    check,
                    &key("standard_deviation"),
                    &normal.standard_deviation,
                ),
                cut: amounts.cut(check, kind, [normal.min.as_ref(), normal.max.as_ref()]),
            }
        } else if let Some(lognormal) = &self.lognormal {
            Distribution::Lognormal {
                median: amounts.sample(check, &key("median"), &lognormal.median),
                deviation: lognormal.log_standard_deviation,
                cut: amounts.cut(
                    check,
                    kind,
                    [lognormal.min.as_ref(), lognormal.max.as_ref()],
                ),
            }
        } else if let Some(uniform) = &self.uniform {
            Distribution::Uniform {
                from: amounts.sample(check, &key("from"), &uniform.from),
                to: amounts.sample(check, &key("to"), &uniform.to),
            }
        } else {
            let triangular = self.triangular.as_ref()?;
            Distribution::Triangular {
                from: amounts.sample(check, &key("from"), &triangular.from),
                mode: amounts.sample(check, &key("mode"), &triangular.mode),
                to: amounts.sample(check, &key("to"), &triangular.to),
            }
        };
        possible(check, kind, &distribution).then_some(distribution)
    }
}

/// Whether the numbers of a distribution make one; says what is wrong if they do not.
fn possible(check: &mut Check<'_>, kind: &str, distribution: &Distribution) -> bool {
    let mut fail = |name: &str, message: &str, help: &str| {
        check.fail(&format!("{kind}.{name}"), message, help);
        false
    };
    let positive = "allowed: more than 0";
    let fine = match *distribution {
        Distribution::Normal { deviation, .. } => {
            deviation > 0.0
                || fail(
                    "standard_deviation",
                    "the standard deviation is not positive",
                    positive,
                )
        }
        Distribution::Lognormal {
            median, deviation, ..
        } => {
            (median > 0.0 || fail("median", "the median is not positive", positive))
                && (deviation > 0.0 && deviation <= 10.0
                    || fail(
                        "log_standard_deviation",
                        "the standard deviation of the logarithm is out of range",
                        "allowed: more than 0, up to 10; 0.1 stands for about 10 %",
                    ))
        }
        Distribution::Uniform { from, to } => {
            from < to || fail("to", "`to` is not above `from`", "exchange them")
        }
        Distribution::Triangular { from, mode, to } => {
            (from < to || fail("to", "`to` is not above `from`", "exchange them"))
                && ((from..=to).contains(&mode)
                    || fail(
                        "mode",
                        "the mode is not between `from` and `to`",
                        "move it there",
                    ))
        }
    };
    // NaN, which ends that are no numbers would give, is outside too.
    if fine && !(LEAST_LEFT..=1.0).contains(&distribution.part_left()) {
        check.fail(
            kind,
            "`min` and `max` leave next to nothing of the distribution",
            "move them closer to its middle, and `min` below `max`",
        );
        return false;
    }
    fine
}
