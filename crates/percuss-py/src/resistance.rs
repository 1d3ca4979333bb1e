//! Penetration resistance law in Python; slow, because every pressure is a call into the interpreter.

use std::sync::Arc;

use percuss::resistance::{CustomResistance, ResistanceLaw};
use pyo3::{exceptions::PyValueError, prelude::*};

use crate::first_error::FirstError;

/// Pressure that stands in once the law has failed [Pa]: the run goes on to the next place where it can be ended.
const STAND_IN: f64 = 1e9;

struct Law {
    function: Py<PyAny>,
    error: FirstError,
}

/// A function of the depth [m] and the speed [m/s] of the crater floor as a law; what it raises goes to `error`.
pub fn resistance(function: Py<PyAny>, error: FirstError) -> CustomResistance {
    CustomResistance(Arc::new(Law { function, error }))
}

impl ResistanceLaw for Law {
    fn pressure(&self, depth: f64, speed: f64) -> f64 {
        let called = Python::attach(|py| {
            let pressure: f64 = self.function.call1(py, (depth, speed))?.extract(py)?;
            if pressure.is_finite() && pressure >= 0.0 {
                return Ok(pressure);
            }
            Err(PyValueError::new_err(format!(
                "the resistance law gives {pressure} Pa at a depth of {depth} m and a speed of {speed} m/s; allowed: 0 or more"
            )))
        });
        called.unwrap_or_else(|error| {
            self.error.set(error);
            STAND_IN
        })
    }
}
