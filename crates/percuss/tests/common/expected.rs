//! The file `expected.toml` of a case folder: numbers that the case stands for, and what each of them rests on.

use percuss::units::{Time, Velocity};
use serde::Deserialize;

/// Largest tolerance of a golden number: it is this program's own and changes only when the program does.
const GOLDEN: f64 = 2e-3;
/// Largest tolerance around a known error: what its rounding leaves. A wider one would hide the error.
const KNOWN_ERROR: f64 = 5e-3;
/// Largest tolerance of an exact solution on the mesh of a case.
const ANALYTIC: f64 = 0.03;

/// The expectations of a case.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct File {
    pub expected: Vec<Expected>,
}

/// One number of a case.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Expected {
    /// Model that gives the number.
    #[serde(default = "chain")]
    pub model: String,
    /// Name of the result record, or a path such as `/fragments/2/velocity_m_s`.
    pub quantity: String,
    /// Impact velocity instead of the scenario's.
    pub impact_velocity: Option<Velocity>,
    /// Impact velocities without and with perforation, for the ballistic limit of a model that does not compute one.
    pub bracket: Option<[Velocity; 2]>,
    /// Span of time over which a sampled quantity is averaged.
    pub mean_from: Option<Time>,
    pub mean_to: Option<Time>,
    pub value: f64,
    /// Known error of the computed value against `value`.
    pub error: Option<f64>,
    pub tolerance: f64,
    /// Tolerance and errors are differences, not fractions of the value.
    #[serde(default)]
    pub absolute: bool,
    pub kind: Kind,
    pub source: String,
    /// Value of the same quantity that does not come from this model.
    pub independent: Option<Independent>,
    /// Reason why there is none.
    pub no_independent: Option<String>,
}

/// What a number is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// An exact solution, or a closed formula evaluated apart from the program.
    Analytic,
    /// A number that a publication prints.
    Paper,
    /// A measured number.
    Experiment,
    /// A number of another program or implementation.
    Independent,
    /// The number of this model itself.
    Golden,
}

/// A value beside a golden number, with the known error of the golden number against it.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Independent {
    pub value: f64,
    /// Stated uncertainty of the value, as a fraction of it or, where the entry is `absolute`, as a difference.
    pub uncertainty: Option<f64>,
    /// Error of the golden number against the value.
    pub error: f64,
    pub source: String,
}

fn chain() -> String {
    "chain".to_owned()
}

impl File {
    /// Reads the text of a file and checks that every entry is what its kind says.
    pub fn read(text: &str) -> Result<Self, String> {
        let file: Self = toml::from_str(text).map_err(|error| error.to_string())?;
        for (index, expected) in file.expected.iter().enumerate() {
            expected
                .check()
                .map_err(|reason| format!("entry {index}, {}: {reason}", expected.quantity))?;
        }
        Ok(file)
    }
}

impl Expected {
    /// What the computed value has to be, to the tolerance.
    pub fn target(&self) -> f64 {
        let error = self.error.unwrap_or(0.0);
        match self.absolute {
            true => self.value + error,
            false => self.value * (1.0 + error),
        }
    }

    /// Whether a computed value is within the tolerance of the target.
    pub fn holds(&self, computed: f64) -> bool {
        let allowed = match self.absolute {
            true => self.tolerance,
            false => self.tolerance * self.value.abs(),
        };
        (computed - self.target()).abs() <= allowed + 1e-12 * self.value.abs()
    }

    /// Error of a computed value against a reference, as the entry states errors.
    pub fn error_of(&self, computed: f64, reference: f64) -> f64 {
        match self.absolute {
            true => computed - reference,
            false => computed / reference - 1.0,
        }
    }

    /// Whether the entry is what its kind says.
    fn check(&self) -> Result<(), String> {
        if self.source.trim().is_empty() {
            return Err("`source` is empty".to_owned());
        }
        self.check_error()?;
        self.check_tolerance()?;
        self.check_independent()
    }

    fn check_error(&self) -> Result<(), String> {
        let is_compared = matches!(self.kind, Kind::Experiment | Kind::Independent);
        match (is_compared, self.error) {
            (true, None) => {
                Err("a measured or independent value needs `error`, the known error".to_owned())
            }
            (false, Some(_)) if self.kind != Kind::Paper => {
                Err("an exact or golden number has no known error".to_owned())
            }
            _ => Ok(()),
        }
    }

    fn check_tolerance(&self) -> Result<(), String> {
        let largest = match self.kind {
            Kind::Golden => GOLDEN,
            Kind::Experiment | Kind::Independent | Kind::Paper => KNOWN_ERROR,
            Kind::Analytic => ANALYTIC,
        };
        if !self.absolute && self.tolerance > largest {
            return Err(format!(
                "`tolerance` {} is above {largest}, the largest of its kind",
                self.tolerance
            ));
        }
        Ok(())
    }

    fn check_independent(&self) -> Result<(), String> {
        let reason = self.no_independent.as_ref().map(|reason| reason.trim());
        match (self.kind, &self.independent, reason) {
            (Kind::Golden, Some(value), None) if !value.source.trim().is_empty() => Ok(()),
            (Kind::Golden, None, Some(reason)) if !reason.is_empty() => Ok(()),
            (Kind::Golden, ..) => Err(
                "a golden number needs `independent = { value, error, source }` or `no_independent = \"reason\"`"
                    .to_owned(),
            ),
            (_, None, None) => Ok(()),
            _ => Err("only a golden number has an independent value beside it".to_owned()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ENTRY: &str = "[[expected]]\nquantity = 'steps'\nsource = 'a'\n";

    fn refusal(keys: &str) -> String {
        File::read(&format!("{ENTRY}{keys}")).unwrap_err()
    }

    #[test]
    fn a_golden_number_needs_an_independent_value_or_a_reason() {
        let golden = "value = 2.0\ntolerance = 1e-3\nkind = 'golden'\n";
        assert!(refusal(golden).contains("`independent"));
        assert!(refusal(&format!("{golden}no_independent = ' '")).contains("`independent"));
        let both = "no_independent = 'b'\nindependent = { value = 1, error = 1, source = 'c' }";
        assert!(refusal(&format!("{golden}{both}")).contains("`independent"));
        for key in both.lines() {
            File::read(&format!("{ENTRY}{golden}{key}")).unwrap();
        }
    }

    #[test]
    fn a_known_error_is_stated_and_not_hidden_by_a_tolerance() {
        let measured = "value = 184.5\nkind = 'experiment'\n";
        assert!(refusal(&format!("{measured}tolerance = 0.001")).contains("`error`"));
        let hidden = format!("{measured}error = 0.0\ntolerance = 0.3");
        assert!(refusal(&hidden).contains("`tolerance` 0.3 is above"));
        let wide = "value = 1\ntolerance = 0.01\nkind = 'golden'\nno_independent = 'b'";
        assert!(refusal(wide).contains("`tolerance` 0.01 is above"));
        let exact = "value = 1\ntolerance = 0.01\nkind = 'analytic'\nerror = 0.1";
        assert!(refusal(exact).contains("no known error"));
    }

    #[test]
    fn a_value_is_held_against_the_stated_error() {
        let stated =
            format!("{ENTRY}value = 200.0\nkind = 'experiment'\nerror = -0.25\ntolerance = 0.005");
        let entry = &File::read(&stated).unwrap().expected[0];
        assert!(entry.holds(150.9) && !entry.holds(151.1) && !entry.holds(200.0));
    }
}
