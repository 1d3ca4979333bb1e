//! What every solver of the chain does between its steps: look at the books, say how far it has come, keep a history.

use crate::{
    error::NumericalError,
    history::{Profile, Recorder, Sample},
    solver::Progress,
};

/// Largest energy residual of a run that counts.
pub const ENERGY_TOLERANCE: f64 = 1e-3;
/// Largest momentum residual of a run that counts.
pub const MOMENTUM_TOLERANCE: f64 = 1e-9;

/// Largest residuals of the books so far, as parts of what was there at first.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Residuals {
    pub(super) energy: f64,
    pub(super) momentum: f64,
}

/// Step and time at which a run stands.
#[derive(Debug, Clone, Copy)]
pub(super) struct Moment {
    pub(super) step: u64,
    /// [s].
    pub(super) time: f64,
}

impl Residuals {
    /// Looks at the residuals of a moment.
    ///
    /// # Errors
    /// When a book is off by more than it may be.
    pub(super) fn audit(
        &mut self,
        [energy, momentum]: [f64; 2],
        moment: Moment,
        courant: f64,
    ) -> Result<(), NumericalError> {
        self.energy = self.energy.max(energy.abs());
        self.momentum = self.momentum.max(momentum.abs());
        for (book, residual, tolerance) in [
            ("energy", energy, ENERGY_TOLERANCE),
            ("momentum", momentum, MOMENTUM_TOLERANCE),
        ] {
            if residual.is_nan() || residual.abs() > tolerance {
                return Err(moment.failure(
                    format!("the {book} book is off by {residual:.2e} of the initial {book}, more than {tolerance:e},"),
                    format!("lower `chain.courant` (now {courant})"),
                ));
            }
        }
        Ok(())
    }
}

impl Moment {
    /// A run that fails here.
    pub(super) fn failure(self, what: String, remedy: String) -> NumericalError {
        NumericalError {
            what,
            step: self.step,
            time_us: self.time * 1e6,
            element: None,
            remedy,
        }
    }

    /// How far a run is that gives up at an end time, by its time or by what a projectile of a mass and a momentum has lost of its speed.
    pub(super) fn progress(
        self,
        end_time: f64,
        (mass, momentum): (f64, f64),
        impact_speed: f64,
        depth: f64,
    ) -> Progress {
        let slowed = if mass > 0.0 {
            1.0 - momentum / (mass * impact_speed)
        } else {
            1.0
        };
        Progress {
            step: self.step,
            time: self.time,
            fraction: (self.time / end_time).max(0.95 * slowed).clamp(0.0, 1.0),
            depth,
        }
    }

    /// Keeps what the recorder wants of this moment.
    pub(super) fn record(
        self,
        recorder: &mut Option<Recorder>,
        sample: impl FnOnce() -> Sample,
        profile: impl FnOnce() -> Profile,
    ) {
        let Some(recorder) = recorder else { return };
        if recorder.wants_sample(self.step) {
            recorder.sample(sample());
        }
        if recorder.wants_profile(self.step) {
            recorder.profile(profile());
        }
    }
}
