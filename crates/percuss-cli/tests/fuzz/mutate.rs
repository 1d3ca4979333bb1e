//! Changes of valid texts: words, numbers, lines and bytes.

use crate::support::Draw;

/// Numbers that programs get wrong.
const NUMBERS: [&str; 24] = [
    "0",
    "-0.0",
    "-1",
    "1",
    "2",
    "1e-320",
    "1e-30",
    "1e-9",
    "0.5",
    "0.999999999999",
    "1e9",
    "1e30",
    "1e308",
    "1e309",
    "-1e308",
    "nan",
    "inf",
    "-inf",
    "9223372036854775807",
    "18446744073709551616",
    "4294967296",
    "0x10",
    "1_000",
    "1e",
];
/// Texts that readers get wrong.
const TEXTS: [&str; 18] = [
    "", " ", "\u{0}", "\u{feff}", "\u{202e}", "é", "𝔘", "\r", "\t", "\\", "\"", "'''", "\"\"\"",
    "#", "=", ",,", "[[", "..",
];
/// Units, of several dimensions.
const UNITS: [&str; 14] = [
    "mm", "um", "m", "km", "m/s", "km/s", "us", "s", "MPa", "GPa", "K", "J/m2", "kg/m3", "parsec",
];

/// Length up to which a word is repeated [bytes].
const LONGEST_WORD: usize = 1 << 20;

/// A text in words: runs of letters, digits, points and signs of numbers; everything else is a word of one character.
fn words(text: &str) -> Vec<&str> {
    let is_part = |c: char| c.is_alphanumeric() || "_.-+/".contains(c);
    let mut found = Vec::new();
    let mut start = None;
    for (place, c) in text.char_indices() {
        match (start, is_part(c)) {
            (None, true) => start = Some(place),
            (Some(from), false) => {
                found.push(&text[from..place]);
                start = None;
            }
            _ => {}
        }
        if !is_part(c) {
            found.push(&text[place..place + c.len_utf8()]);
        }
    }
    found.extend(start.map(|from| &text[from..]));
    found
}

fn is_number(word: &str) -> bool {
    word.starts_with(|c: char| c.is_ascii_digit() || c == '-' || c == '.')
}

/// One of the texts with one to four changes; words and lines also come from the others.
pub fn mutated(draw: &mut Draw, texts: &[String]) -> Vec<u8> {
    let text = texts[draw.below(texts.len())].clone();
    changed(draw, text, texts)
}

/// A text with one to four changes, for which words and lines come from texts.
pub fn changed(draw: &mut Draw, mut text: String, texts: &[String]) -> Vec<u8> {
    for _ in 0..=draw.below(4) {
        let other = &texts[draw.below(texts.len())];
        text = match draw.below(8) {
            0..5 => with_other_word(draw, &text, other),
            5 | 6 => with_other_lines(draw, &text, other),
            _ => with_other_characters(draw, &text),
        };
    }
    let mut bytes = text.into_bytes();
    if draw.below(10) == 0 && !bytes.is_empty() {
        for _ in 0..=draw.below(3) {
            let place = draw.below(bytes.len());
            bytes[place] = draw.below(256) as u8;
        }
    }
    bytes
}

fn with_other_word(draw: &mut Draw, text: &str, other: &str) -> String {
    let mut words: Vec<String> = words(text).into_iter().map(str::to_owned).collect();
    let all: Vec<usize> = (0..words.len())
        .filter(|i| words[*i].len() > 1 || is_number(&words[*i]))
        .collect();
    if all.is_empty() {
        return other.to_owned();
    }
    let numbers: Vec<usize> = all
        .iter()
        .copied()
        .filter(|i| is_number(&words[*i]))
        .collect();
    let of_numbers = !numbers.is_empty() && draw.below(2) == 0;
    let places = if of_numbers { &numbers } else { &all };
    let place = places[draw.below(places.len())];
    let others = self::words(other);
    words[place] = match draw.below(9) {
        0 | 1 => draw.of(&NUMBERS).to_owned(),
        2 => scaled(draw, &words[place]),
        3 => draw.of(&UNITS).to_owned(),
        4 => draw.of(&TEXTS).to_owned(),
        5 => String::new(),
        6 => repeated(&words[place], 1 + draw.below(3) * 700),
        _ if others.is_empty() => String::new(),
        _ => others[draw.below(others.len())].to_owned(),
    };
    words.concat()
}

/// A word so many times, as far as the memory of a test should go: a word that is repeated is longer the next time.
fn repeated(word: &str, times: usize) -> String {
    word.repeat(times.min(1 + LONGEST_WORD / word.len().max(1)))
}

/// A number some orders of magnitude away.
fn scaled(draw: &mut Draw, word: &str) -> String {
    let factor = 10_f64.powf(draw.below(1200) as f64 / 100.0 - 6.0);
    word.parse::<f64>().map_or_else(
        |_| word.to_uppercase(),
        |number| format!("{:e}", number * factor),
    )
}

fn with_other_lines(draw: &mut Draw, text: &str, other: &str) -> String {
    let mut lines: Vec<&str> = text.lines().collect();
    let others: Vec<&str> = other.lines().collect();
    if lines.is_empty() || others.is_empty() {
        return other.to_owned();
    }
    let [place, second] = [0, 1].map(|_| draw.below(lines.len()));
    let foreign = others[draw.below(others.len())];
    match draw.below(6) {
        0 => {
            lines.remove(place);
        }
        1 => lines.insert(place, lines[second]),
        2 => lines.swap(place, second),
        3 => lines[place] = foreign,
        4 => lines.truncate(place),
        _ => lines.insert(place, foreign),
    }
    lines.join("\n")
}

fn with_other_characters(draw: &mut Draw, text: &str) -> String {
    let mut place = draw.below(text.len() + 1);
    while !text.is_char_boundary(place) {
        place -= 1;
    }
    let (before, after) = text.split_at(place);
    let put = match draw.below(6) {
        0 => "[".repeat(1 << draw.below(14)),
        1 => "{a=".repeat(1 << draw.below(12)),
        2 => "a.".repeat(1 << draw.below(12)),
        3 => draw.of(&NUMBERS).to_owned(),
        4 => return before.to_owned(),
        _ => draw.of(&TEXTS).to_owned(),
    };
    format!("{before}{put}{after}")
}
