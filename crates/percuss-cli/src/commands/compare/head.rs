//! Head of a comparison: case, impact regime and recommended models.

use percuss::{
    Scenario,
    compare::{Comparison, Recommendation},
    units::significant,
};

use crate::terminal::{bold, counted, paragraph, title, width, wrap};

const LABEL: usize = 13;

/// Case, regime and recommendation; at many velocities, once per range in which they are constant.
pub fn text(scenario: &Scenario, comparison: &Comparison) -> String {
    let speeds = comparison.velocities();
    let at = match speeds.len() {
        1 => speed_range(&speeds),
        count => format!("{count} velocities, {}", speed_range(&speeds)),
    };
    let models = counted(comparison.models().len(), "model");
    let line = format!("case {}, impact at {at}, {models}", scenario.name);
    let mut text = title(scenario) + &paragraph(&line);
    let mut from = 0;
    while from < speeds.len() {
        let same = |i: &usize| {
            let (a, b) = (
                &comparison.regime[from].regime,
                &comparison.regime[*i].regime,
            );
            (a.projectile, a.neighbour) == (b.projectile, b.neighbour)
                && recommendation_key(&comparison.recommended[from])
                    == recommendation_key(&comparison.recommended[*i])
        };
        let to = (from..speeds.len()).take_while(same).count() + from;
        text.push('\n');
        let regime = &comparison.regime[from].regime;
        let words = if speeds.len() == 1 {
            regime.describe(scenario)
        } else {
            text += &format!("{}\n", bold(speed_range(&speeds[from..to])));
            regime.kind_in_words(scenario)
        };
        row("regime", &words, &mut text);
        recommendation(&comparison.recommended[from], &mut text);
        from = to;
    }
    text.push('\n');
    text
}

/// Key of equal recommendations: models and start of the note; the reasons contain numbers that change with the velocity.
fn recommendation_key(recommendation: &Recommendation) -> (Vec<&str>, &str) {
    let models = recommendation.models.iter().map(|choice| choice.model);
    let note = recommendation.note.as_deref().unwrap_or_default();
    let start = note.split([':', ',']).next().unwrap_or_default();
    (models.collect(), start)
}

fn recommendation(recommendation: &Recommendation, text: &mut String) {
    for choice in &recommendation.models {
        let words = format!("{}: {}", choice.model, choice.because);
        row("recommended", &words, text);
    }
    if let Some(note) = &recommendation.note {
        let label = match recommendation.models.is_empty() {
            true => "recommended",
            false => "note",
        };
        row(label, note, text);
    }
}

fn row(label: &str, words: &str, text: &mut String) {
    let wrapped = wrap(words, width() - LABEL, 0).replace('\n', &format!("\n{:LABEL$}", ""));
    *text += &format!("{label:<LABEL$}{wrapped}\n");
}

/// `230 m/s`, or `200 to 450 m/s`.
pub fn speed_range(speeds: &[f64]) -> String {
    match speeds {
        [] => String::new(),
        [one] => format!("{} m/s", significant(*one, 4)),
        [first, .., last] => {
            format!(
                "{} to {} m/s",
                significant(*first, 4),
                significant(*last, 4)
            )
        }
    }
}
