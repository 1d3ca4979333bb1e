//! Models that have the same to be said of them, in one line.

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
