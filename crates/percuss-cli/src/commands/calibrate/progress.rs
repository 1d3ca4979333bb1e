//! How far a calibration has come.

use percuss::calibrate::Stage;

/// Parts of the whole at which the stages begin and end, where the posterior is sampled: nearly all runs are the sampler's.
const WITH_SAMPLE: [f64; 4] = [0.0, 0.05, 0.97, 1.0];
const LEAST_SQUARES_ONLY: [f64; 4] = [0.0, 0.9, 0.9, 1.0];

/// Part of the whole that is done.
pub(super) fn whole(stage: Stage, part: f64, sampled: bool) -> f64 {
    let ends = match sampled {
        true => WITH_SAMPLE,
        false => LEAST_SQUARES_ONLY,
    };
    let at = match stage {
        Stage::LeastSquares => 0,
        Stage::Sampling => 1,
        Stage::Predicting => 2,
    };
    ends[at] + part * (ends[at + 1] - ends[at])
}

/// What it is doing.
pub(super) fn words(stage: Stage, runs: u64) -> String {
    let what = match stage {
        Stage::LeastSquares => "least squares",
        Stage::Sampling => "sampling",
        Stage::Predicting => "predicting",
    };
    format!("{what}, {runs} runs")
}
