//! Varied and uncertain numbers of a case: parameters with their values or distributions, and how they depend on each other.

mod axis;
mod copula;
mod correlation;
mod distribution;
mod file;
mod list_value;
mod parameter;
mod quantity_literal;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use axis::{Axis, Values, column_name, values};
pub use copula::Copula;
pub use correlation::Correlation;
pub use distribution::{Distribution, normal_probability, score};
pub use file::{Design, Lognormal, Normal, Parameter, Steps, Triangular, Uniform};
pub use list_value::ListValue;
pub use quantity_literal::QuantityLiteral;

use crate::check::Check;
use parameter::MAX_TOGETHER;

/// What is uncertain in a case: the table `uncertainty` of its file, which `percuss uncertainty` reads and no model sees.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct UncertainInputs {
    /// Numbers of the case with their distributions.
    #[serde(default)]
    pub parameter: Vec<Parameter>,
    /// How they depend on each other; independent when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub correlation: Option<Correlation>,
}

impl UncertainInputs {
    /// Checks what can be said without the rest of the case.
    pub(crate) fn check(&self, check: &mut Check<'_>) {
        self.resolve(check);
    }

    /// The parameters as axes, and what joins them; what is wrong becomes a diagnostic.
    pub fn resolve(&self, check: &mut Check<'_>) -> (Vec<Axis>, Option<Copula>) {
        if self.parameter.is_empty() {
            let help = "write one under [[uncertainty.parameter]]: key = \"projectile.impact_velocity\" and \
                        normal = { mean = \"230 m/s\", standard_deviation = \"3 m/s\" }";
            check.fail("", "nothing is uncertain", help);
        }
        resolve(
            &self.parameter,
            self.correlation.as_ref(),
            Design::Sobol,
            check,
        )
    }
}

/// Checks parameters and what joins them; those that are wrong are left out.
pub fn resolve(
    parameters: &[Parameter],
    correlation: Option<&Correlation>,
    design: Design,
    check: &mut Check<'_>,
) -> (Vec<Axis>, Option<Copula>) {
    let mut axes: Vec<Axis> = Vec::new();
    let mut listed = 0;
    for (i, parameter) in parameters.iter().enumerate() {
        let mut check = check.within(&format!("parameter.{i}"));
        if axes.iter().any(|axis| axis.key == parameter.key) {
            let message = format!("`{}` is varied twice", parameter.key);
            check.fail("key", message, "remove one of the two");
        }
        let axis = parameter.resolve(&mut check, design);
        listed += axis.as_ref().and_then(Axis::count).unwrap_or(0);
        if listed > MAX_TOGETHER {
            let message = format!("all lists together have more than {MAX_TOGETHER} values");
            check.fail("", message, "give fewer values, or a distribution");
            return (Vec::new(), None);
        }
        axes.extend(axis);
    }
    let copula = match correlation {
        Some(_) if design == Design::Grid => {
            check.fail(
                "correlation",
                "a grid has no distributions to correlate",
                "use design = \"latin-hypercube\" or \"sobol\"",
            );
            None
        }
        // A parameter that is wrong would also be missing here.
        Some(correlation) if axes.len() == parameters.len() => {
            correlation.resolve(&axes, &mut check.within("correlation"))
        }
        _ => None,
    };
    (axes, copula)
}
