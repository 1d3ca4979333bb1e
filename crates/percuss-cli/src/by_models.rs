//! Models by their names, and those that have the same to be said of them, in one line.

use percuss::model::{self, MODELS, Model};

/// The models of these names in the order of the list; the quick ones where there are no names.
pub fn named(names: &[String]) -> Vec<&'static dyn Model> {
    if names.is_empty() {
        return model::fast_models();
    }
    let models = MODELS.iter().copied();
    let is_named = |model: &&dyn Model| names.iter().any(|name| name == model.name());
    models.filter(is_named).collect()
}

/// Entries with the same text as one, all their models before it.
pub fn by_models<'a>(entries: impl IntoIterator<Item = (&'a str, String)>) -> Vec<String> {
    let mut groups: Vec<(Vec<&str>, String)> = Vec::new();
    for (model, text) in entries {
        match groups.iter_mut().find(|group| group.1 == text) {
            Some(group) => group.0.push(model),
            None => groups.push((vec![model], text)),
        }
    }
    groups
        .into_iter()
        .map(|(models, text)| format!("{}: {text}", models.join(", ")))
        .collect()
}
