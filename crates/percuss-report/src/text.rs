//! Texts of drawings.

/// Text as it stands, on one line and not longer than `most` characters: a dollar sign would begin a formula.
pub(crate) fn plain(text: &str, most: usize) -> String {
    let line = text.split_whitespace().collect::<Vec<_>>().join(" ");
    let line = if line.chars().count() > most {
        let kept: String = line.chars().take(most.saturating_sub(1)).collect();
        format!("{}…", kept.trim_end())
    } else {
        line
    };
    line.replace('$', "\\$")
}
