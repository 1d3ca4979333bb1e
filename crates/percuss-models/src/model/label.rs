//! Names of models in figures.

use std::borrow::Cow;

use super::MODELS;

/// Name for readers of a model by its name; one that is not in the list of models has its name with spaces. Words after a colon, as in
/// `chain: column`, are kept.
pub fn label(name: &str) -> Cow<'_, str> {
    let (model, more) = match name.find(':') {
        Some(colon) => name.split_at(colon),
        None => (name, ""),
    };
    let known = MODELS.iter().find(|known| known.name() == model);
    let label = match known {
        Some(known) => known.label(),
        None => Cow::Owned(model.replace('_', " ")),
    };
    match more {
        "" => label,
        more => Cow::Owned(format!("{label}{more}")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_model_has_a_name_for_readers_of_its_own() {
        let labels: Vec<_> = MODELS.iter().map(|model| model.label()).collect();
        for (i, label) in labels.iter().enumerate() {
            assert!(!label.contains('_') && !label.is_empty(), "{label}");
            assert!(!labels[..i].contains(label), "{label}");
        }
    }

    #[test]
    fn variants_and_models_of_users_have_names_for_readers() {
        assert_eq!(label("crater_energy"), "crater energy");
        assert_eq!(label("lambert_jonas"), "Lambert–Jonas");
        assert_eq!(label("chain: column"), "chain: column");
        assert_eq!(label("fdm: rod"), "finite differences: rod");
        assert_eq!(label("my_model"), "my model");
    }
}
