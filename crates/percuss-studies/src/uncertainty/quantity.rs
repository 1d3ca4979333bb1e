//! Results that an uncertainty is computed of.

use crate::summary::{ResultNumber, result_numbers};

/// The result numbers that an uncertainty is computed of, in the order of JSON.
pub fn quantities() -> impl Iterator<Item = &'static ResultNumber> + Clone {
    result_numbers().filter(|number| number.role.is_result())
}

/// The quantity of this name.
pub fn quantity(name: &str) -> Option<&'static ResultNumber> {
    quantities().find(|quantity| quantity.name == name)
}
