//! Stages of a calibration.

/// What a calibration is doing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// Looking for the best values.
    LeastSquares,
    /// Sampling the posterior.
    Sampling,
    /// Putting the sample through the model.
    Predicting,
}

/// Parts of the whole at which the stages begin and end, where the posterior is sampled: nearly all runs are the sampler's.
const WITH_SAMPLE: [f64; 4] = [0.0, 0.05, 0.97, 1.0];
const LEAST_SQUARES_ONLY: [f64; 4] = [0.0, 0.9, 0.9, 1.0];

impl Stage {
    /// Part of the whole that is done with a part of the stage, where the posterior is sampled or is not.
    pub fn of_whole(self, part: f64, sampled: bool) -> f64 {
        let ends = match sampled {
            true => WITH_SAMPLE,
            false => LEAST_SQUARES_ONLY,
        };
        let at = match self {
            Self::LeastSquares => 0,
            Self::Sampling => 1,
            Self::Predicting => 2,
        };
        ends[at] + part * (ends[at + 1] - ends[at])
    }

    /// It in words, with the runs so far.
    pub fn describe(self, runs: u64) -> String {
        let what = match self {
            Self::LeastSquares => "least squares",
            Self::Sampling => "sampling",
            Self::Predicting => "predicting",
        };
        format!("{what}, {runs} runs")
    }
}
