//! Values of the options of `percuss calibrate`.

pub(super) fn walkers(text: &str) -> Result<usize, String> {
    let number = text.parse::<usize>().ok();
    number
        .filter(|number| number % 2 == 0 && (4..=10_000).contains(number))
        .ok_or_else(|| "allowed: an even number, 4 to 10000".to_owned())
}

pub(super) fn material_id(text: &str) -> Result<String, String> {
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    match !text.is_empty() && text.chars().all(plain) {
        true => Ok(text.to_owned()),
        false => Err("allowed: letters, digits, hyphens and underscores".to_owned()),
    }
}
