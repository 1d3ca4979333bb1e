//! Texts and paths of users as messages quote them: in part, where they are long.

use std::path::Path;

/// A text with its long words cut: what a user wrote may stand in it, and only a path is as long as `LONGEST_WORD`.
pub fn shorten_words(text: &str) -> String {
    const LONGEST_WORD: usize = 320;
    let is_long = |word: &str| word.chars().nth(LONGEST_WORD).is_some();
    if !text.split_whitespace().any(is_long) {
        return text.to_owned();
    }
    let mut short = String::new();
    let mut length = 0;
    for c in text.chars() {
        length = if c.is_whitespace() { 0 } else { length + 1 };
        match length {
            0..LONGEST_WORD => short.push(c),
            LONGEST_WORD => short.push('…'),
            _ => {}
        }
    }
    short
}

/// A text with a capital first letter.
pub fn capitalized(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().into_iter().flat_map(char::to_uppercase);
    first.chain(letters).collect()
}

/// A path in a message: a long one without its middle.
pub fn shown(path: &Path) -> String {
    const MOST: usize = 300;
    let whole: Vec<char> = path.display().to_string().chars().collect();
    if whole.len() <= MOST {
        return whole.into_iter().collect();
    }
    let (start, end) = (&whole[..MOST / 2], &whole[whole.len() - MOST / 2..]);
    start.iter().chain(&['…']).chain(end).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_long_is_cut() {
        let usual = "no material is named `coper`; did you mean `copper`?";
        assert_eq!(shorten_words(usual), usual);
        let long = shorten_words(&format!("a {} b", "x".repeat(100_000)));
        assert!(
            long.starts_with("a xxx") && long.ends_with("x… b"),
            "{long}"
        );
        assert_eq!(long.chars().count(), 4 + 320);
        let path = "folder/".repeat(1000);
        assert_eq!(shown(Path::new("a/b.toml")), "a/b.toml");
        assert_eq!(shown(Path::new(&path)).chars().count(), 301);
    }
}
