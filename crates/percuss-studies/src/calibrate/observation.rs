//! Measured data: `[[experiments]]` and `[[measured_curves]]` of case files, and published tests.

use serde::Serialize;

use super::{Fitted, correction::Correction, curve::CurveSet, noise::Spread, problem::refuse};
use crate::{
    Error, Scenario,
    case::{self, Document, Template},
    check::Diagnostic,
    experiments::{Experiment, Struck},
    material::{Library, MaterialEntry},
    outcome::BandQuantity,
    units::shorten,
};

/// A measured value and the case that has to give it.
#[derive(Debug, Clone)]
pub struct Observation {
    /// Id of the test, or name of the case with the number of its entry.
    pub id: String,
    /// Bibliography keys, or whatever words the data give.
    pub sources: Vec<String>,
    /// What was measured.
    pub quantity: BandQuantity,
    /// Impact velocity [m/s].
    pub impact_velocity: f64,
    /// The measured value [m or m/s].
    pub measured: f64,
    /// Its standard deviation, where it is stated [m or m/s].
    pub uncertainty: Option<f64>,
    /// Whether it is kept out of the fit, to test it.
    pub held_out: bool,
    pub(super) template: Template,
    pub(super) correction: Option<Correction>,
}

/// A measured value that is not used.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct LeftOut {
    /// Id of the test, or name of the case with the number of its entry.
    pub id: String,
    /// Why.
    pub reason: String,
}

/// Measured values with those that cannot be used.
#[derive(Debug, Clone, Default)]
pub struct Observations {
    /// The values.
    pub used: Vec<Observation>,
    /// Measured curves, those of a case together.
    pub curves: Vec<CurveSet>,
    /// Those that are not.
    pub left_out: Vec<LeftOut>,
}

impl Observations {
    /// Adds what was measured on a case: its `[[experiments]]` and `[[measured_curves]]`.
    ///
    /// # Errors
    /// [`Error::Input`] when the case is not valid, or nothing was measured on it.
    pub fn add_case(&mut self, document: &Document) -> Result<(), Error> {
        let template = Template::of(document)?;
        let scenario = case::scenario(document)?;
        self.curves
            .extend(CurveSet::of(document, &template, &scenario));
        if scenario.experiments.is_empty() && scenario.measured_curves.is_empty() {
            let help = "add [[experiments]] with impact_velocity, a measured quantity and source, or [[measured_curves]]";
            let diagnostic = Diagnostic::whole("the case has no measured value", help);
            return Err(document.place(diagnostic).into());
        }
        for (i, experiment) in scenario.experiments.iter().enumerate() {
            self.used.push(Observation {
                id: format!("{} {}", scenario.name, i + 1),
                sources: experiment.sources.clone(),
                quantity: experiment.quantity,
                impact_velocity: experiment
                    .impact_velocity
                    .unwrap_or(scenario.impact_velocity),
                measured: experiment.value,
                uncertainty: experiment.uncertainty,
                held_out: false,
                template: template.clone(),
                correction: None,
            });
        }
        Ok(())
    }

    /// Adds published tests. Where constants of materials are fitted, only tests whose projectile or target is one of them are
    /// taken, and that record stands for the projectile. Suspect and repeated rows are left out.
    ///
    /// # Errors
    /// [`Error::Input`] when a material does not exist.
    pub fn add_tests(
        &mut self,
        tests: &[Experiment],
        library: &Library,
        fitted: &[Fitted],
    ) -> Result<(), Error> {
        let mut fitted_materials: Vec<&MaterialEntry> = Vec::new();
        for parameter in fitted {
            if let Some((id, _)) = parameter.material() {
                let entry = library.find(id).ok_or_else(|| {
                    let near = library.suggestion(id);
                    let help = format!("{near}`percuss materials` lists all");
                    parameter.no_material(&library.unknown(id), &help)
                })?;
                fitted_materials.push(entry);
            }
        }
        for test in tests {
            let Some(record) = record_for(test, library, &fitted_materials) else {
                continue;
            };
            let reason = match (&test.flag, &test.duplicate_of) {
                (Some(flag), _) => Some(format!("suspect: {flag}")),
                (_, Some(first)) => Some(format!("repeats {first}")),
                _ => test.no_case(),
            };
            if let Some(reason) = reason {
                self.left_out.push(LeftOut {
                    id: test.id.clone(),
                    reason,
                });
                continue;
            }
            self.used.push(Observation {
                id: test.id.clone(),
                sources: vec![test.source.clone()],
                quantity: test.kind.quantity(),
                impact_velocity: test.impact_velocity,
                measured: test.measured,
                uncertainty: test.uncertainty,
                held_out: false,
                template: Template::of_case(&test.id, &test.case(&record, library), library)?,
                correction: None,
            });
        }
        Ok(())
    }

    /// Keeps what comes from these sources out of the fit.
    ///
    /// # Errors
    /// [`Error::Calibration`] when nothing comes from a source.
    pub fn hold_out(&mut self, sources: &[String]) -> Result<(), Error> {
        for source in sources {
            let mut found = false;
            let values = self.used.iter_mut();
            let values = values.map(|value| (&value.sources, &mut value.held_out));
            let curves = self.curves.iter_mut().flat_map(|set| &mut set.curves);
            let curves = curves.map(|curve| (&curve.curve.sources, &mut curve.held_out));
            for (sources, held_out) in values.chain(curves) {
                if sources.contains(source) {
                    *held_out = true;
                    found = true;
                }
            }
            if !found {
                return Err(self.no_source(source));
            }
        }
        Ok(())
    }

    /// Keeps those whose sources are wanted.
    pub fn keep(&mut self, wanted: impl Fn(&[String]) -> bool) {
        self.used.retain(|value| wanted(&value.sources));
        for set in &mut self.curves {
            set.curves.retain(|curve| wanted(&curve.curve.sources));
        }
    }

    /// The error of a source that nothing comes from.
    pub fn no_source(&self, key: &str) -> Error {
        let known = self.sources().join(", ");
        refuse(
            format!("no measured value comes from `{}`", shorten(key)),
            match known.as_str() {
                "" => "there is no measured value at all".to_owned(),
                known => format!("sources: {known}"),
            },
        )
    }

    /// Sources of all values, each once.
    pub fn sources(&self) -> Vec<&str> {
        let mut sources: Vec<&str> = Vec::new();
        let values = self.used.iter().map(|value| &value.sources);
        let curves = self.curves.iter().flat_map(|set| &set.curves);
        for source in values.chain(curves.map(|c| &c.curve.sources)).flatten() {
            if !sources.contains(&source.as_str()) {
                sources.push(source);
            }
        }
        sources
    }
}

impl Observation {
    /// The case with its impact velocity and with values for what is fitted; otherwise why there is none.
    pub(super) fn scenario(&self, fitted: &[Fitted], values: &[f64]) -> Result<Scenario, String> {
        scenario(&self.template, fitted, values, self.impact_velocity)
    }

    /// What is predicted for it where the model gives a value [m or m/s].
    pub(super) fn predicted(&self, model: f64) -> f64 {
        self.correction
            .map_or(model, |correction| correction.of(self.quantity, model))
    }

    /// How it is distributed about the model.
    pub(super) fn spread(&self) -> Spread {
        let stated = self.uncertainty.unwrap_or(0.0);
        let of_meshes = self.correction.map_or(0.0, |c| c.first.uncertainty);
        Spread {
            stated: stated.hypot(of_meshes),
            scale: self.scale(),
            weight: 1.0,
        }
    }

    /// What a relative scatter is a part of: the measured value, or the impact velocity for a residual velocity, which may be 0.
    pub(super) fn scale(&self) -> f64 {
        match self.quantity {
            BandQuantity::ResidualVelocity => self.impact_velocity,
            _ => self.measured,
        }
    }
}

/// A case with values for what is fitted and an impact velocity; otherwise why there is none.
pub(super) fn scenario(
    template: &Template,
    fitted: &[Fitted],
    values: &[f64],
    impact_velocity: f64,
) -> Result<Scenario, String> {
    let changes: Vec<(&str, toml::Value)> = fitted
        .iter()
        .zip(values)
        .map(|(parameter, value)| parameter.change(*value))
        .collect();
    let scenario = template.scenario(&changes).map_err(|diagnostics| {
        let words = diagnostics.into_iter().map(|diagnostic| diagnostic.message);
        words.collect::<Vec<_>>().join("; ")
    })?;
    Ok(scenario.at_impact_velocity(impact_velocity))
}

/// The record that stands for a test's projectile, if the test has to do with the materials that are fitted.
fn record_for(test: &Experiment, library: &Library, fitted: &[&MaterialEntry]) -> Option<String> {
    let main = test.projectile_materials.first();
    if fitted.is_empty() {
        return main.cloned();
    }
    let entry = |name: &str| library.find(name);
    for wanted in fitted {
        let named = test
            .projectile_materials
            .iter()
            .filter_map(|name| entry(name))
            .any(|listed| listed.id == wanted.id);
        let family = main.and_then(|name| entry(name)).is_some_and(|listed| {
            listed.material.family.is_some() && listed.material.family == wanted.material.family
        });
        if named || family {
            return Some(wanted.id.clone());
        }
    }
    let Struck::Body {
        material,
        properties: None,
        ..
    } = &test.target
    else {
        return None;
    };
    let struck = entry(material)?;
    let is_fitted = fitted.iter().any(|wanted| wanted.id == struck.id);
    is_fitted.then(|| main.cloned().unwrap_or_default())
}
