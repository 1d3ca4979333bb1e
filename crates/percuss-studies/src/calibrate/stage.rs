//! Stages of a calibration.

/// What a calibration is doing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    /// Correcting the model to axisymmetric answers.
    Correcting,
    /// Looking for the best values.
    LeastSquares,
    /// Sampling the posterior.
    Sampling,
    /// Putting the sample through the model.
    Predicting,
}

/// Optional stages that a calibration has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Stages {
    /// Whether the model is corrected to axisymmetric answers.
    pub corrected: bool,
    /// Whether the posterior is sampled.
    pub sampled: bool,
}

/// Parts of the rest at which the other stages begin and end, where the posterior is sampled: nearly all runs are the sampler's.
const WITH_SAMPLE: [f64; 4] = [0.0, 0.05, 0.97, 1.0];
const LEAST_SQUARES_ONLY: [f64; 4] = [0.0, 0.9, 0.9, 1.0];

impl Stages {
    /// Part of the whole that is done with a part of a stage.
    pub fn of_whole(self, stage: Stage, part: f64) -> f64 {
        let ends = match self.sampled {
            true => WITH_SAMPLE,
            false => LEAST_SQUARES_ONLY,
        };
        // A guess: axisymmetric runs take nearly all the time, unless there is a sample.
        let corrected = match (self.corrected, self.sampled) {
            (false, _) => 0.0,
            (true, true) => 0.5,
            (true, false) => 0.9,
        };
        let at = match stage {
            Stage::Correcting => return corrected * part,
            Stage::LeastSquares => 0,
            Stage::Sampling => 1,
            Stage::Predicting => 2,
        };
        corrected + (1.0 - corrected) * (ends[at] + part * (ends[at + 1] - ends[at]))
    }
}

impl Stage {
    /// It in words, with the runs so far.
    pub fn describe(self, runs: u64) -> String {
        let what = match self {
            Self::Correcting => "correction by axisymmetric runs",
            Self::LeastSquares => "least squares",
            Self::Sampling => "sampling",
            Self::Predicting => "predicting",
        };
        format!("{what}, {runs} runs")
    }
}
