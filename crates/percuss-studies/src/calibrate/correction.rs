//! Axisymmetric correction of the prediction of a measured value.

use std::ops::ControlFlow;

use super::problem::Silent;
use crate::{
    Error, Scenario,
    axisymmetric::{self, AxisymmetricAnswer, Request, on_mesh, untouched},
    model::{self, Control, Progress},
    outcome::BandQuantity,
};

/// Axisymmetric answer of a measured value's case at some values of the parameters [m or m/s].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Answer {
    /// Limit of fine meshes.
    pub(super) value: f64,
    /// Its discretisation uncertainty.
    pub(super) uncertainty: f64,
    /// Cells along the projectile's radius of the finest mesh.
    cells: u32,
    /// Number of the finest mesh.
    finest: f64,
}

/// Correction of the prediction of a measured value [m or m/s].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Correction {
    /// Answer at the values of the first round.
    pub(super) first: Answer,
    /// Axisymmetric number at the values of the last round: that of the finest mesh, carried to the limit as in the first round.
    pub(super) value: f64,
    /// Its difference from the value that the number has if the impact changes nothing.
    pub(super) change: f64,
    /// Number of the model at the values of the last round.
    pub(super) model: f64,
}

impl Correction {
    /// Computes the correction at some values of the parameters, whose case is given, with the model's number; `before` is the correction of
    /// the round before. `report` gets the fraction done.
    pub(super) fn at(
        scenario: &Scenario,
        quantity: BandQuantity,
        model: f64,
        request: Request,
        before: Option<&Self>,
        report: &mut (dyn FnMut(f64) -> ControlFlow<()> + Send),
    ) -> Result<Self, Silent> {
        let (first, value) = match before {
            None => {
                let answer = Answer::of(scenario, quantity, request, report)?;
                (answer, answer.value)
            }
            Some(Self { first, .. }) => {
                let finest = number_on(scenario, quantity, first.cells, report)?;
                (*first, carried(quantity, finest, first.finest, first.value))
            }
        };
        if model <= 0.0 && quantity != BandQuantity::ResidualVelocity {
            return Err(Silent::Here(
                "the model gives 0, which has no factor".to_owned(),
            ));
        }
        let untouched = si(quantity, untouched(scenario, quantity));
        Ok(Self {
            first,
            value,
            change: (value - untouched).abs(),
            model,
        })
    }

    /// What the model gives, corrected.
    pub(super) fn of(&self, quantity: BandQuantity, model: f64) -> f64 {
        carried(quantity, model, self.model, self.value)
    }
}

impl Answer {
    fn of(
        scenario: &Scenario,
        quantity: BandQuantity,
        request: Request,
        report: &mut (dyn FnMut(f64) -> ControlFlow<()> + Send),
    ) -> Result<Self, Silent> {
        let answer = request.answer(scenario, report).map_err(silent)?;
        let finest = answer.meshes.last();
        let numbers = finest.and_then(|mesh| Some((mesh, limit(&answer, quantity)?)));
        let usable = numbers.filter(|_| answer.doubt.is_none());
        let Some((mesh, (value, uncertainty))) = usable else {
            return Err(none(quantity, answer.remark()));
        };
        let finest = measurable(quantity, mesh.value(quantity)).unwrap_or(value);
        Ok(Self {
            value: si(quantity, value),
            uncertainty: si(quantity, uncertainty),
            cells: mesh.cells_per_radius,
            finest: si(quantity, finest),
        })
    }
}

/// Number of an answer and its uncertainty, in the unit of its name.
fn limit(answer: &AxisymmetricAnswer, quantity: BandQuantity) -> Option<(f64, f64)> {
    let value = match quantity {
        BandQuantity::DepthOfPenetration => answer.depth_of_penetration_mm,
        BandQuantity::ProjectileFinalLength => answer.projectile_final_length_mm,
        BandQuantity::ResidualVelocity => answer.residual_velocity_m_s,
        BandQuantity::BallisticLimit => None,
    };
    let is_main = answer.quantity == Some(quantity);
    let uncertainty = answer.uncertainty.filter(|_| is_main).unwrap_or(0.0);
    Some((measurable(quantity, value)?, uncertainty))
}

/// Number of one mesh [m or m/s].
fn number_on(
    scenario: &Scenario,
    quantity: BandQuantity,
    cells: u32,
    report: &mut (dyn FnMut(f64) -> ControlFlow<()> + Send),
) -> Result<f64, Silent> {
    let axi = model::model(axisymmetric::MODEL).map_err(silent)?;
    let mut watch = |now: Progress| report(now.fraction);
    let mut control = Control {
        progress: Some(&mut watch),
        ..Control::default()
    };
    let (mesh, _) = on_mesh(axi, scenario, cells, &mut control).map_err(silent)?;
    measurable(quantity, mesh.value(quantity))
        .map(|value| si(quantity, value))
        .ok_or_else(|| none(quantity, None))
}

/// A number that is `from` where another is `to`: a length in proportion, a velocity with the same difference.
fn carried(quantity: BandQuantity, number: f64, from: f64, to: f64) -> f64 {
    match quantity {
        BandQuantity::ResidualVelocity => (number + to - from).max(0.0),
        _ => number * to / from,
    }
}

/// A projectile that is stopped or thrown back has a residual velocity of 0.
fn measurable(quantity: BandQuantity, value: Option<f64>) -> Option<f64> {
    match quantity {
        BandQuantity::ResidualVelocity => value.map(|velocity| velocity.max(0.0)),
        _ => value,
    }
}

fn si(quantity: BandQuantity, value: f64) -> f64 {
    value / quantity.in_unit(1.0)
}

fn none(quantity: BandQuantity, why: Option<&str>) -> Silent {
    let why = why.map(|why| format!(": {why}")).unwrap_or_default();
    Silent::Always(format!(
        "`axi` gives no {} for it{why}",
        quantity.describe()
    ))
}

fn silent(error: Error) -> Silent {
    match error {
        Error::Cancelled { .. } => Silent::Stopped,
        error => Silent::Here(error.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_length_is_scaled_and_a_residual_velocity_shifted() {
        let at = |quantity| carried(quantity, 2.0, 4.0, 6.0);
        assert_eq!(at(BandQuantity::DepthOfPenetration), 3.0);
        assert_eq!(at(BandQuantity::ResidualVelocity), 4.0);
        let stopped = carried(BandQuantity::ResidualVelocity, 2.0, 4.0, 0.0);
        assert_eq!(stopped, 0.0);
    }
}
