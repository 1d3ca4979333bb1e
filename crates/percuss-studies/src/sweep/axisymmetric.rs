//! Axisymmetric answers of some runs of a sweep.

use std::{collections::BTreeSet, ops::ControlFlow};

use super::{Sweep, SweepRun};
use crate::{
    Error,
    axisymmetric::{AxisymmetricAnswer, ReferenceMeshes, Request, plan, seconds},
    model::{self, Control},
    outcome::BandQuantity,
    summary::ResultRecord,
};

/// Number of a run by the sweep's model, and by the axisymmetric model.
#[derive(Debug, Clone, PartialEq)]
pub struct AxisymmetricRow {
    /// Number of the run, counted from 0.
    pub index: u64,
    /// Its values, in the order and the units of the axes.
    pub inputs: Vec<f64>,
    /// The axisymmetric main number; `None` without an answer.
    pub quantity: Option<BandQuantity>,
    /// That number by the sweep's model.
    pub model_value: Option<f64>,
    /// By the axisymmetric model, in the limit of its meshes.
    pub value: Option<f64>,
    /// Half width of its discretisation uncertainty.
    pub uncertainty: Option<f64>,
    /// Observed order of convergence.
    pub order: Option<f64>,
    /// Reason why there is no answer, or what is missing of it.
    pub remark: String,
}

impl Sweep {
    /// Numbers of `count` runs spread over all, in rising order: multiples of the golden ratio, which follow no axis of a grid.
    pub fn spread(&self, count: u64) -> Vec<u64> {
        spread(self.runs(), count)
    }

    /// Estimated processor time of the axisymmetric answer of a run [s]; 0 where there is none.
    pub fn axisymmetric_seconds(&self, index: u64) -> f64 {
        let Ok(scenario) = self.run(index).scenario else {
            return 0.0;
        };
        match plan(&scenario, ReferenceMeshes::default(), None) {
            Ok(plan) => plan.cells.iter().map(|n| seconds(&scenario, *n)).sum(),
            Err(_) => 0.0,
        }
    }

    /// Memory of the axisymmetric answer of a run [bytes]; 0 where there is none.
    pub fn axisymmetric_memory(&self, index: u64) -> f64 {
        let scenario = self.run(index).scenario;
        scenario.map_or(0.0, |scenario| Request::default().memory(&scenario))
    }

    /// The axisymmetric answer of a run, on the standard meshes, beside the number of the sweep's model.
    ///
    /// # Errors
    /// [`Error::Cancelled`]. A run without an answer has a remark.
    pub fn axisymmetric(
        &self,
        index: u64,
        progress: &mut (dyn FnMut(f64) -> ControlFlow<()> + Send),
    ) -> Result<AxisymmetricRow, Error> {
        let SweepRun {
            inputs, scenario, ..
        } = self.run(index);
        let without = |reason| AxisymmetricAnswer::without(ReferenceMeshes::default(), reason);
        let (found, own) = match scenario {
            Err(reason) => (without(reason.clone()), Err(reason)),
            Ok(scenario) => {
                let found = Request::default().answer(&scenario, progress)?;
                let own = model::run(self.model, &scenario, &mut Control::default());
                let own = own.map(|own| ResultRecord::new(&scenario, &own));
                (found, own.map_err(|error| error.to_string()))
            }
        };
        let remark = found.remark().or(own.as_ref().err().map(String::as_str));
        let remark = remark.unwrap_or_default().to_owned();
        let model_value = found
            .quantity
            .zip(own.ok())
            .and_then(|(quantity, record)| record.value(quantity));
        Ok(AxisymmetricRow {
            index,
            inputs,
            quantity: found.quantity,
            model_value,
            value: found.value,
            uncertainty: found.uncertainty,
            order: found.order,
            remark,
        })
    }
}

/// `count` different numbers below `all`, or all of them.
fn spread(all: u64, count: u64) -> Vec<u64> {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    if count >= all {
        return (0..all).collect();
    }
    let mut chosen = BTreeSet::new();
    let mut place = 0.5_f64;
    while (chosen.len() as u64) < count {
        // Where a number is taken already, the next free one is.
        let mut index = (place * all as f64) as u64 % all;
        while !chosen.insert(index) {
            index = (index + 1) % all;
        }
        place = (place + GOLDEN).fract();
    }
    chosen.into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chosen_runs_are_different_and_leave_no_wide_gap() {
        for (all, count) in [(1000, 20), (64, 8), (10, 9), (7, 7), (3, 9)] {
            let chosen = spread(all, count);
            assert_eq!(chosen.len() as u64, count.min(all));
            let mut from = 0;
            for index in chosen.iter().copied().chain([all]) {
                assert!(index - from <= 3 * all / count + 1, "{all} {chosen:?}");
                from = index;
            }
            assert!(chosen.is_sorted_by(|a, b| a < b) && chosen.iter().all(|index| *index < all));
        }
    }
}
