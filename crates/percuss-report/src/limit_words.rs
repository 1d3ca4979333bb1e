//! A ballistic limit in words: the one to use, and the axisymmetric one.

use percuss::{
    limit::{Bracket, LimitRange, Limits, ModelLimit},
    units::significant,
};

use crate::result_rows::with_uncertainty;

/// The limit to use, and how far to trust it; the range of all where no model is recommended.
pub fn limit_headline(limits: &Limits) -> Option<String> {
    let Some(choice) = limits.recommended.first() else {
        return match &limits.range {
            Some(range) => Some(unrecommended(limits, range)),
            None => extrapolated(limits),
        };
    };
    let line = match limits.results.iter().find(|l| l.model == choice.model) {
        Some(entry) => {
            let value = entry.ballistic_limit_m_s?;
            let error = entry.expected_error.as_ref();
            let error = match error {
                Some(e) => {
                    let against = limits.contradiction.map_or_else(String::new, |axi| {
                        format!("; `axi` gives {} m/s", significant(axi, 3))
                    });
                    format!(", model error {}{against}", e.errors.describe())
                }
                None if limits.measured().is_some() => String::new(),
                None => unknown_error(limits),
            };
            format!(
                "Ballistic limit {} m/s ({}){error}{}",
                limit_of(entry, value),
                choice.model,
                from_measured(limits, value)
            )
        }
        None => format!(
            "Axisymmetric ballistic limit {}",
            axisymmetric_limit(limits)?
        ),
    };
    Some(line)
}

/// The limits of models of which none is recommended.
fn unrecommended(limits: &Limits, range: &LimitRange) -> String {
    let [low, high] = [range.lowest_m_s, range.highest_m_s].map(|limit| significant(limit, 4));
    let mut found = limits.results.iter();
    match (
        found.find(|entry| entry.ballistic_limit_m_s == Some(range.lowest_m_s)),
        range.models,
    ) {
        (Some(entry), 1) => {
            let error = entry.expected_error.as_ref();
            format!(
                "Ballistic limit {} m/s ({}), model error {}{}",
                limit_of(entry, range.lowest_m_s),
                entry.model,
                error.map_or_else(|| "not known".to_owned(), |e| e.errors.describe()),
                from_measured(limits, range.lowest_m_s)
            )
        }
        (None, 1) => format!(
            "Axisymmetric ballistic limit {}: no other model is within its range of validity",
            axisymmetric_limit(limits).unwrap_or(low)
        ),
        // Columns by two methods are one model.
        _ if low == high => format!("Ballistic limit {low} m/s: no model is recommended"),
        _ => format!("Ballistic limit {low} to {high} m/s: no model is recommended"),
    }
}

/// Part of a limit from which on its bracket is shown in its place: between its ends the runs are undecided.
const WIDE: f64 = 0.02;

/// Limit of a model, or the bracket that it lies in where that is wide and the model states none [m/s].
fn limit_of(entry: &ModelLimit, limit: f64) -> String {
    let wide = |bracket: &Bracket| bracket.perforated_m_s - bracket.stopped_m_s > WIDE * limit;
    let is_stated = entry.stated_limit_m_s == Some(limit);
    match entry.bracket.filter(wide).filter(|_| !is_stated) {
        Some(bracket) => format!(
            "between {} and {}",
            significant(bracket.stopped_m_s, 4),
            significant(bracket.perforated_m_s, 4)
        ),
        None => significant(limit, 4),
    }
}

/// Limits of models that are all outside their ranges of validity, or of layers that cannot fail; `None` without any.
fn extrapolated(limits: &Limits) -> Option<String> {
    let (low, high) = extremes(limits)?;
    let values = match low < high {
        true => format!(
            "limits from {} to {}",
            significant(low, 4),
            significant(high, 4)
        ),
        false => format!("a limit of {}", significant(low, 4)),
    };
    Some(format!(
        "No ballistic limit is predicted: the models give {values} m/s outside their ranges of validity"
    ))
}

/// What stands in place of an error that is not known: the range of all limits.
fn unknown_error(limits: &Limits) -> String {
    let Some((low, high)) = extremes(limits).filter(|(low, high)| low < high) else {
        return ", model error not known".to_owned();
    };
    format!(
        ", model error not known: all models give {} to {} m/s",
        significant(low, 3),
        significant(high, 3)
    )
}

/// Lowest and highest limit of all models, the axisymmetric one included [m/s].
fn extremes(limits: &Limits) -> Option<(f64, f64)> {
    let values = limits.results.iter().filter_map(|l| l.ballistic_limit_m_s);
    let axisymmetric = limits.axisymmetric.as_ref();
    let values = values.chain(axisymmetric.and_then(|limit| limit.ballistic_limit_m_s));
    let pairs = values.map(|value| (value, value));
    pairs.reduce(|(low, high), (value, _)| (low.min(value), high.max(value)))
}

/// Difference from the measured limit in words; empty without one.
fn from_measured(limits: &Limits, value: f64) -> String {
    limits.measured().map_or_else(String::new, |(measured, _)| {
        format!(
            ", {:+.1} % from the measured {} m/s",
            100.0 * (value / measured - 1.0),
            significant(measured, 4)
        )
    })
}

/// The axisymmetric limit with its uncertainty, if there is one.
pub fn axisymmetric_limit(limits: &Limits) -> Option<String> {
    let limit = limits.axisymmetric.as_ref()?;
    let value = limit.ballistic_limit_m_s?;
    let shown = with_uncertainty(value, limit.uncertainty_m_s.unwrap_or(0.0), "m/s");
    Some(shown + &from_measured(limits, value))
}

#[cfg(test)]
mod tests {
    use super::limit_headline;
    use crate::limit_figure::tests::limits_by;

    #[test]
    fn limits_without_a_recommended_model_have_a_headline() {
        let headline = |names: &[&str]| {
            let (_, found) = limits_by(names);
            assert_eq!(found.recommended, []);
            limit_headline(&found).unwrap()
        };
        let one = headline(&["awerbuch_bodner"]);
        assert!(
            one.starts_with("Ballistic limit ")
                && one.ends_with(" m/s (awerbuch_bodner), model error not known"),
            "{one}"
        );
        let two = headline(&["plugging", "awerbuch_bodner"]);
        assert!(
            two.contains(" to ") && two.ends_with(" m/s: no model is recommended"),
            "{two}"
        );
    }
}
