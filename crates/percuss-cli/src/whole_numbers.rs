//! Whole numbers of the command line.

use std::{fmt::Display, str::FromStr};

/// A parser of whole numbers from one to another; `what` they are, with an article.
pub fn from_to<T>(
    low: T,
    high: T,
    what: &'static str,
) -> impl Fn(&str) -> Result<T, String> + Clone + Send + Sync + 'static
where
    T: FromStr + PartialOrd + Display + Copy + Send + Sync + 'static,
{
    move |text| match text.parse::<T>() {
        Ok(number) if (low..=high).contains(&number) => Ok(number),
        _ => Err(format!("{what} is a whole number from {low} to {high}")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_out_of_range_is_refused_in_words() {
        let meshes = from_to::<u32>(3, 8, "a number of meshes");
        assert_eq!(meshes("8"), Ok(8));
        let refused = "a number of meshes is a whole number from 3 to 8".to_owned();
        for text in ["2", "9", "-3", "3.5", "99999999999999999999", "many", ""] {
            assert_eq!(meshes(text), Err(refused.clone()), "{text}");
        }
    }
}
