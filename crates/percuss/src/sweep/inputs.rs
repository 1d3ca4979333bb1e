//! Parameters of a file, checked together, and the numbers of a case that are uncertain.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{
    axis::Axis,
    copula::Copula,
    correlation::Correlation,
    file::{Design, Parameter},
    parameter::MAX_TOGETHER,
};
use crate::{case::Template, check::Check};

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

    /// The parameters as axes, and what joins them; what is wrong becomes a finding.
    pub(crate) fn resolve(&self, check: &mut Check<'_>) -> (Vec<Axis>, Option<Copula>) {
        if self.parameter.is_empty() {
            let help = "write one under [[uncertainty.parameter]]: key = \"projectile.velocity\" and \
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
pub(super) fn resolve(
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
        // A parameter that is wrong would be missing here as well.
        Some(correlation) if axes.len() == parameters.len() => {
            correlation.resolve(&axes, &mut check.within("correlation"))
        }
        _ => None,
    };
    (axes, copula)
}

/// Tries every value that the file writes down on the case, one at a time.
pub(crate) fn check_values(axes: &[Axis], template: &Template, check: &mut Check<'_>) {
    for (i, axis) in axes.iter().enumerate() {
        for (key, value) in &axis.samples {
            let written = axis.written(*value);
            let Err(findings) = template.scenario(&[(&axis.key, written.clone())]) else {
                continue;
            };
            if let Some(finding) = findings.into_iter().next() {
                let of = match finding.key.as_str() {
                    "" => axis.key.clone(),
                    key => key.to_owned(),
                };
                let message = format!(
                    "with {} = {written} the case is not valid: `{of}`: {}",
                    axis.key, finding.message
                );
                check.fail(&format!("parameter.{i}.{key}"), message, finding.help);
                return;
            }
        }
    }
}
