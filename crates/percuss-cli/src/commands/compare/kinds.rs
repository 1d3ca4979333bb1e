//! What a model says at many speeds, put together where it differs in numbers only.

use super::head::speed_range;

/// A text that a model says at some of the speeds.
pub struct Kind<'a> {
    masked: String,
    text: &'a str,
    first: usize,
    /// Whether its numbers change with the speed.
    varies: bool,
    /// Where it is said, one flag a speed.
    at: Vec<bool>,
}

/// The kinds of texts among these, each with the index of its speed, rising; `count` is the number of speeds.
pub fn kinds<'a>(texts: impl Iterator<Item = (usize, &'a str)>, count: usize) -> Vec<Kind<'a>> {
    let mut kinds: Vec<Kind<'a>> = Vec::new();
    for (speed, text) in texts {
        let masked = masked(text);
        match kinds.iter_mut().find(|kind| kind.masked == masked) {
            Some(kind) => {
                kind.varies |= kind.text != text;
                kind.at[speed] = true;
            }
            None => {
                let mut at = vec![false; count];
                at[speed] = true;
                kinds.push(Kind {
                    masked,
                    text,
                    first: speed,
                    varies: false,
                    at,
                });
            }
        }
    }
    kinds
}

impl Kind<'_> {
    /// The text as it is at its first speed, which is named where the numbers are those of that speed alone.
    pub fn describe(&self, speeds: &[f64]) -> String {
        let speed = speed_range(&speeds[self.first..=self.first]);
        match self.varies && !self.text.contains(&speed) {
            true => format!("{} (at {speed})", self.text),
            false => self.text.to_owned(),
        }
    }

    /// ` at 200 to 300 m/s and 450 m/s`; nothing where it holds at all speeds.
    pub fn place(&self, speeds: &[f64]) -> String {
        if self.at.iter().all(|said| *said) {
            return String::new();
        }
        let mut parts = Vec::new();
        let mut from = 0;
        for run in self.at.chunk_by(|a, b| a == b) {
            if run[0] {
                parts.push(speed_range(&speeds[from..from + run.len()]));
            }
            from += run.len();
        }
        format!(" at {}", parts.join(" and "))
    }
}

/// A text without its numbers, and without the prefixes of pressures, which follow the numbers.
fn masked(text: &str) -> String {
    let mut masked = String::new();
    for c in text.chars() {
        if !c.is_ascii_digit() {
            masked.push(c);
        } else if !masked.ends_with('#') {
            // A decimal point belongs to its number.
            if masked.ends_with("#.") {
                masked.pop();
            } else {
                masked.push('#');
            }
        }
    }
    ["kPa", "MPa", "GPa"]
        .iter()
        .fold(masked, |text, unit| text.replace(unit, "Pa"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_that_differ_in_numbers_are_of_one_kind() {
        let speeds = [200.0, 300.0, 400.0, 500.0];
        let texts = [
            "the pressure is 812.5 MPa",
            "the pressure is 1.2 GPa",
            "it is too fast: 3 elements",
            "the pressure is 2 GPa",
        ];
        let kinds = kinds(texts.into_iter().enumerate(), 4);
        let said: Vec<(String, String)> = kinds
            .iter()
            .map(|kind| (kind.place(&speeds), kind.describe(&speeds)))
            .collect();
        let pair = |a: &str, b: &str| (a.to_owned(), b.to_owned());
        assert_eq!(
            said,
            [
                pair(
                    " at 200 to 300 m/s and 500 m/s",
                    "the pressure is 812.5 MPa (at 200 m/s)"
                ),
                pair(" at 400 m/s", "it is too fast: 3 elements"),
            ]
        );
    }

    #[test]
    fn a_text_that_holds_everywhere_has_no_place() {
        let kinds = kinds([(0, "a 1"), (1, "a 1")].into_iter(), 2);
        assert_eq!(kinds.len(), 1);
        assert_eq!(kinds[0].place(&[1.0, 2.0]), "");
        assert_eq!(kinds[0].describe(&[1.0, 2.0]), "a 1");
    }
}
