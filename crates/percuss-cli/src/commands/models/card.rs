//! Terminal output of one model.

use percuss::guard::{FirstChoice, of_material};

use super::ModelRecord;
use crate::terminal::{bold, width, wrap};

/// Name, range of validity, first choices, options, and page of a model.
pub fn text(model: &ModelRecord) -> String {
    let mut text = format!(
        "{}\n{}\n\n{}\n",
        bold(model.name),
        wrap(model.summary, width(), 0),
        bold("range of validity")
    );
    for line in model.guard.in_words() {
        text += &item(&line);
    }
    if !model.guard.first_choice.is_empty() {
        text += &format!("\n{}\n", bold("first choice for"));
        for choice in model.guard.first_choice {
            text += &item(&in_words(choice));
        }
    }
    if !model.options.is_empty() {
        let title = format!("options in [{}] of a case file", model.name);
        text += &format!("\n{}\n", bold(&title));
        for option in &model.options {
            text += &item(&format!("{}: {}", option.key, option.meaning));
        }
    }
    let page = format!(
        "{}: equations, sources, checks, and whether the formulae were read in the source, derived or reconstructed",
        model.page
    );
    text + &format!("\n{}\n{}", bold("page"), item(&page))
}

fn item(line: &str) -> String {
    format!("  - {}\n", wrap(line, width() - 4, 4))
}

fn in_words(choice: &FirstChoice) -> String {
    let targets: Vec<&str> = choice.targets.iter().map(|kind| kind.in_words()).collect();
    let noses: Vec<&str> = choice.noses.iter().map(|nose| nose.name()).collect();
    format!(
        "{} projectiles with {} noses against {}{}: {}",
        choice.projectile.in_words(),
        noses.join(", "),
        targets.join(", "),
        of_material(choice.targets, &[choice.target_material]),
        choice.because
    )
}
