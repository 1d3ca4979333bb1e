//! Repeated runs with smaller Courant numbers.

use serde::{Deserialize, Serialize};

use super::interface::Retry;
use crate::{Error, error::NumericalError, units::significant};

/// Why an attempt at a run gave no result.
pub enum AttemptError {
    /// The energy or momentum balance does not close: a smaller time step may help.
    Unbalanced(NumericalError),
    /// Any other error: it ends the run.
    Other(Error),
}

impl AttemptError {
    /// The numerical error after which the run is repeated.
    ///
    /// # Errors
    /// The error that ends the run.
    pub(super) fn retried(self, retry: Retry) -> Result<NumericalError, Error> {
        match (self, retry) {
            (Self::Unbalanced(error), _) => Ok(error),
            (Self::Other(Error::Numerical(error)), Retry::OfAnyError { .. }) => Ok(*error),
            (Self::Other(error), _) => Err(error),
        }
    }
}

impl From<NumericalError> for AttemptError {
    fn from(error: NumericalError) -> Self {
        Self::Other(error.into())
    }
}

impl From<Error> for AttemptError {
    fn from(error: Error) -> Self {
        Self::Other(error)
    }
}

/// Courant number of a run, halved after a numerical error unless the case gives one of its own.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct CourantRetry {
    number: f64,
    first: f64,
    smallest: f64,
    /// Why it was lowered.
    reason: Option<String>,
}

impl CourantRetry {
    /// With the number that a case gives, the default, and the smallest one. A default that is written down is a default.
    pub fn new(given: Option<f64>, default: f64, smallest: f64) -> Self {
        let first = given.unwrap_or(default);
        Self {
            number: first,
            first,
            smallest: if first == default {
                smallest
            } else {
                f64::INFINITY
            },
            reason: None,
        }
    }

    pub fn number(&self) -> f64 {
        self.number
    }

    /// Halves the number after an error.
    ///
    /// # Errors
    /// The error itself, when the number would become too small or is the case's own.
    pub fn halve(&mut self, error: NumericalError) -> Result<(), Error> {
        if 0.5 * self.number < self.smallest {
            return Err(error.into());
        }
        self.number *= 0.5;
        self.reason.get_or_insert(error.what);
        Ok(())
    }

    /// Remarks on a number that was lowered.
    pub fn warning(&self) -> Option<String> {
        let reason = self.reason.as_ref()?;
        Some(format!(
            "the Courant number was reduced from {} to {}: with {} {reason}",
            significant(self.first, 3),
            significant(self.number, 3),
            significant(self.first, 3)
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::CourantRetry;
    use crate::error::NumericalError;

    fn error() -> NumericalError {
        NumericalError {
            what: "the energy balance is off".to_owned(),
            step: 3,
            time_us: 1.0,
            element: None,
            remedy: String::new(),
        }
    }

    #[test]
    fn a_default_is_halved_down_to_the_smallest_and_says_so() {
        for given in [None, Some(0.5)] {
            let mut courant = CourantRetry::new(given, 0.5, 0.05);
            assert!(courant.warning().is_none());
            for expected in [0.25, 0.125, 0.0625] {
                courant.halve(error()).unwrap();
                assert_eq!(courant.number(), expected);
            }
            let warning = courant.warning().unwrap();
            assert!(warning.contains("from 0.5 to 0.0625"), "{warning}");
            assert!(warning.contains("energy balance"), "{warning}");
            assert!(courant.halve(error()).is_err());
        }
    }

    #[test]
    fn a_number_of_the_case_stays() {
        assert!(
            CourantRetry::new(Some(0.4), 0.5, 0.05)
                .halve(error())
                .is_err()
        );
    }
}
