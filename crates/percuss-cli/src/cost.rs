//! Notes on the cost of a computation, before it starts.

pub use percuss::cost::{of_run, of_runs};
use percuss::{
    input_file::size,
    model::{Estimate, time_in_words},
};

use crate::diagnostic;

/// Processor time from which the cost is told [s].
const NOTABLE: f64 = 30.0;
/// Processor time from which a cheaper way is told [s].
const LONG: f64 = 60.0;

/// Tells on standard error what a computation will cost, if that is much.
pub fn tell(estimate: Estimate, quiet: bool) {
    tell_with(estimate, "", quiet);
}

/// The same, with a cheaper way where the computation takes more than a minute; none where that is empty.
pub fn tell_with(estimate: Estimate, cheaper: &str, quiet: bool) {
    if let Some(words) = note(estimate, cheaper).filter(|_| !quiet) {
        diagnostic::print(&format!("note: {words}\n"));
    }
}

fn note(estimate: Estimate, cheaper: &str) -> Option<String> {
    let Estimate {
        memory,
        steps,
        seconds,
    } = estimate;
    (seconds >= NOTABLE).then(|| {
        let mut words = format!(
            "estimated cost: {} of processor time",
            time_in_words(seconds)
        );
        // A formula has neither.
        if steps >= 1.0 {
            words += &format!(", {steps:.1e} time steps");
        }
        if memory >= 1.0 {
            words += &format!(", {} of memory", size(memory as u64));
        }
        if seconds > LONG && !cheaper.is_empty() {
            words += &format!("; {cheaper}");
        }
        words
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_long_computations_have_a_note() {
        let estimate = |seconds: f64| Estimate {
            memory: 3e9,
            steps: 1_234_567.0,
            seconds,
        };
        assert_eq!(note(estimate(29.0), ""), None);
        assert_eq!(note(estimate(f64::NAN), ""), None);
        let words = note(estimate(20_000.0), "").unwrap();
        assert_eq!(
            words,
            "estimated cost: 6 h of processor time, 1.2e6 time steps, 2.8 GiB of memory"
        );
        let cheaper = |seconds| note(estimate(seconds), "try less").unwrap();
        assert!(!cheaper(50.0).contains("try less"));
        assert!(cheaper(70.0).ends_with("memory; try less"));
        let of_a_formula = Estimate {
            memory: 0.0,
            steps: 0.0,
            seconds: 35.0,
        };
        let words = note(of_a_formula, "").unwrap();
        assert_eq!(words, "estimated cost: 35 s of processor time");
    }
}
