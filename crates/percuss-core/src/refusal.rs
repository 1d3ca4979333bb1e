//! Refusal: why a model does not apply to a case, and the remedy.

use std::fmt;

/// Why a model does not apply to a case, and what to do about it.
///
/// ```
/// use percuss::Refusal;
///
/// let refusal = Refusal::new("the target never yields").with_remedy("give it another strength law");
/// assert_eq!(refusal.to_string(), "the target never yields; give it another strength law");
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct Refusal {
    /// Why the model does not apply.
    pub reason: String,
    /// What to do about it, where the model has an advice.
    pub remedy: Option<String>,
}

impl Refusal {
    /// A refusal without a remedy.
    pub fn new(reason: impl Into<String>) -> Self {
        Self {
            reason: reason.into(),
            remedy: None,
        }
    }

    /// The same with a remedy, in the imperative.
    #[must_use]
    pub fn with_remedy(self, remedy: impl Into<String>) -> Self {
        Self {
            remedy: Some(remedy.into()),
            ..self
        }
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.reason)?;
        match &self.remedy {
            Some(remedy) => write!(f, "; {remedy}"),
            None => Ok(()),
        }
    }
}

impl From<String> for Refusal {
    fn from(reason: String) -> Self {
        Self::new(reason)
    }
}

impl From<&str> for Refusal {
    fn from(reason: &str) -> Self {
        Self::new(reason)
    }
}
