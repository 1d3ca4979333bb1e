//! Numbers of drawings in single precision.

use serde::{Serialize, Serializer};

/// The precision of a drawing.
pub(crate) fn ends((low, high): (f64, f64)) -> (f32, f32) {
    (low as f32, high as f32)
}

/// Writes a number.
pub(crate) fn number<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    (*value as f32).serialize(serializer)
}

/// Writes two numbers.
pub(crate) fn pair<S: Serializer>(pair: &(f64, f64), serializer: S) -> Result<S::Ok, S::Error> {
    ends(*pair).serialize(serializer)
}

/// Writes two numbers, or null.
pub(crate) fn range<S: Serializer>(
    range: &Option<(f64, f64)>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    range.map(ends).serialize(serializer)
}
