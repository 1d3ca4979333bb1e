//! Terminal output of one model.

use percuss::validity::{FirstChoice, of_material};

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
    for line in model.validity.describe() {
        text += &item(&line);
    }
    if !model.validity.first_choice.is_empty() {
        text += &format!("\n{}\n", bold("first choice for"));
        for choice in model.validity.first_choice {
            text += &item(&describe(choice));
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

fn describe(choice: &FirstChoice) -> String {
    let targets: Vec<&str> = choice.targets.iter().map(|kind| kind.describe()).collect();
    let noses: Vec<&str> = choice.noses.iter().map(|nose| nose.name()).collect();
    format!(
        "{} projectiles with {} noses against {}{}: {}",
        choice.projectile.describe(),
        noses.join(", "),
        targets.join(", "),
        of_material(choice.targets, &[choice.target_material]),
        choice.because
    )
}
