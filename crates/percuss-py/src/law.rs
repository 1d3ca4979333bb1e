//! Strength laws in Python; slow, because every flow stress is a call into the interpreter.

use std::{ops::ControlFlow, sync::Arc};

use percuss::{
    Scenario,
    case::ScenarioChange,
    check::Check,
    material::{FlowState, FlowStress, Material, OwnLaw, PreparedStrength, Strength, StrengthLaw},
    scenario::TargetBody,
};
use pyo3::{exceptions::PyValueError, prelude::*};

use percuss_cli::Failure;

use crate::{errors::raise, first_error::FirstError, resistance::resistance};

/// Stress that stands in once a law has failed [Pa]: the run goes on to the next place where it can be ended.
const STAND_IN: f64 = 1e6;
/// Steps in strain and strain rate [1/s] for slopes, and the part of the value that they grow with.
const STEP: f64 = 1e-6;
const RATE_STEP: f64 = 1e-2;
const PART: f64 = 1e-4;
/// Relative rounding of a stress.
const ROUNDING: f64 = 1e-12;

/// The laws that take the place of a case's own.
#[derive(Default)]
pub struct Laws {
    /// Strength of the projectile.
    pub projectile: Option<Py<PyAny>>,
    /// Strength of the target.
    pub target: Option<Py<PyAny>>,
    /// Resistance of the target.
    pub resistance: Option<Py<PyAny>>,
    pub error: FirstError,
}

impl Laws {
    /// The case with these laws; the same case where there are none.
    ///
    /// # Errors
    /// A law of a target whose case has no solid one.
    pub fn put_into(&self, py: Python<'_>, scenario: &Arc<Scenario>) -> PyResult<Arc<Scenario>> {
        self.check(py, scenario)?;
        Ok(match self.are_none() {
            true => Arc::clone(scenario),
            false => Arc::new(self.changed(py, (**scenario).clone())),
        })
    }

    /// Refuses a law of a target whose case has no solid one.
    pub fn check(&self, py: Python<'_>, scenario: &Scenario) -> PyResult<()> {
        if self.target.is_none() || matches!(scenario.target, TargetBody::Layers { .. }) {
            return Ok(());
        }
        let refusal = Failure::Usage {
            message: "`target_law` has no effect: the case has no solid target".to_owned(),
            help: "leave it out, or give the target a material and a thickness".to_owned(),
        };
        Err(raise(py, refusal))
    }

    /// Whether there is no law.
    pub fn are_none(&self) -> bool {
        self.projectile.is_none() && self.target.is_none() && self.resistance.is_none()
    }

    /// A case with these laws.
    fn changed(&self, py: Python<'_>, mut changed: Scenario) -> Scenario {
        if let Some(law) = &self.projectile {
            let material = &changed.projectile.material;
            changed.projectile.material = self.with_law(py, material, law);
        }
        if let (Some(law), TargetBody::Layers { layers, .. }) = (&self.target, &mut changed.target)
        {
            for layer in layers {
                layer.material = self.with_law(py, &layer.material, law);
            }
        }
        if let Some(law) = &self.resistance {
            changed.resistance = Some(resistance(law.clone_ref(py), self.error.clone()));
        }
        changed
    }

    /// The laws as a change of every case of a study; `name` tells them from others.
    pub fn as_change(self: Arc<Self>, name: String) -> ScenarioChange {
        ScenarioChange {
            name,
            change: Arc::new(move |scenario| Python::attach(|py| self.changed(py, scenario))),
        }
    }

    fn with_law(&self, py: Python<'_>, material: &Material, law: &Py<PyAny>) -> Arc<Material> {
        let law = Law {
            function: Arc::new(law.clone_ref(py)),
            error: self.error.clone(),
            room_temperature: material.room_temperature.si(),
            stiffness: 3.0 * material.shear_modulus(),
        };
        Arc::new(Material {
            // Warnings name the material.
            name: format!("{} with a strength law in Python", material.name),
            strength: Strength::Own(OwnLaw(Arc::new(law))),
            ..material.clone()
        })
    }

    /// Whether to go on.
    pub fn flow(&self) -> ControlFlow<()> {
        match self.error.is_set() {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    }

    /// What the first law that failed raised.
    pub fn take_error(&self) -> Option<PyErr> {
        self.error.take()
    }
}

/// A law for one material, and the same made ready by a factor.
#[derive(Debug, Clone)]
struct Law {
    function: Arc<Py<PyAny>>,
    error: FirstError,
    room_temperature: f64,
    /// Three times the shear modulus [Pa].
    stiffness: f64,
}

#[derive(Debug)]
struct Prepared {
    law: Law,
    factor: f64,
}

impl Law {
    /// Flow stress at a strain, a strain rate [1/s] and a temperature [K].
    fn stress(&self, strain: f64, rate: f64, temperature: f64) -> f64 {
        // What follows a failure counts for nothing.
        if self.error.is_set() {
            return STAND_IN;
        }
        let called = Python::attach(|py| {
            let stress = self.function.call1(py, (strain, rate, temperature))?;
            let stress: f64 = stress.extract(py)?;
            if stress.is_finite() && stress >= 0.0 {
                return Ok(stress);
            }
            Err(PyValueError::new_err(format!(
                "the strength law gives {stress} Pa at {}; allowed: 0 or more",
                place(strain, rate, temperature)
            )))
        });
        match called {
            Ok(stress) => stress,
            Err(error) => {
                self.error.set(error);
                STAND_IN
            }
        }
    }
}

impl Law {
    /// Refuses slopes for which the flow stress of a step has no single value.
    fn check_slopes(&self, flow: &FlowStress, state: &FlowState) {
        let fall = match flow {
            // Rounding of a law that is flat.
            _ if flow.rate_slope * RATE_STEP < -ROUNDING * flow.stress => "with the strain rate",
            _ if flow.strain_slope <= -self.stiffness => {
                "with the plastic strain by more than three times the shear modulus"
            }
            _ => return,
        };
        let place = place(state.plastic_strain, state.strain_rate, state.temperature);
        self.error.set(PyValueError::new_err(format!(
            "the strength law falls {fall} at {place}; a step has no single flow stress then"
        )));
    }
}

fn place(strain: f64, rate: f64, temperature: f64) -> String {
    format!(
        "a plastic strain of {strain}, a strain rate of {rate} 1/s and a temperature of {temperature} K"
    )
}

impl PreparedStrength for Prepared {
    fn flow_stress(&self, state: &FlowState) -> FlowStress {
        let (strain, rate) = (state.plastic_strain, state.strain_rate);
        let at = |strain, rate| self.factor * self.law.stress(strain, rate, state.temperature);
        let stress = at(strain, rate);
        let (step, rate_step) = (STEP + PART * strain, RATE_STEP + PART * rate);
        let flow = FlowStress {
            stress,
            strain_slope: (at(strain + step, rate) - stress) / step,
            rate_slope: (at(strain, rate + rate_step) - stress) / rate_step,
        };
        self.law.check_slopes(&flow, state);
        flow
    }
}

impl StrengthLaw for Law {
    fn prepare(&self, _: &Material, factor: f64) -> Box<dyn PreparedStrength> {
        Box::new(Prepared {
            law: self.clone(),
            factor,
        })
    }

    fn flow_stress_at_unit_strain(&self, _: &Material) -> Option<f64> {
        Some(self.stress(1.0, 0.0, self.room_temperature))
    }

    fn initial_yield_stress(&self, _: &Material) -> Option<f64> {
        Some(self.stress(0.0, 0.0, self.room_temperature))
    }

    fn depends_on_temperature(&self) -> bool {
        true
    }

    fn equation(&self) -> &'static str {
        "a function of Python"
    }

    fn parameters(&self) -> Vec<(&'static str, String)> {
        Vec::new()
    }

    fn check(&self, _: &mut Check<'_>) {}
}
