//! Checks of the chain's options of failure, and of what does not go with them or with separate layers.

use super::{
    chain::ChainOptions,
    chain_enums::{ErosionCriterion, TargetResistanceModel},
    common::OF_TWO,
};
use crate::{
    check::{Check, limits},
    problem::Target,
};

impl ChainOptions {
    pub(super) fn check_failure(&self, check: &mut Check<'_>) {
        if let Some(failure) = &self.failure {
            let key = format!("failure.{}", failure.key());
            failure.law().check(&mut check.within(&key));
            if self.erosion_criterion() == ErosionCriterion::Tate {
                check.fail(
                    "failure",
                    "the erosion criterion `tate` holds the target in place: nothing of it can separate",
                    OF_TWO,
                );
            }
        }
        check.quantity(
            "fracture_energy",
            self.fracture_energy,
            limits::FRACTURE_ENERGY,
        );
        if self.fracture_energy.is_some() && self.failure.is_none() {
            check.fail(
                "fracture_energy",
                "`fracture_energy` has no effect without `failure`: nothing parts",
                "add `failure`, for example failure = { spall = { strength = \"1.5 GPa\" } }",
            );
        }
    }

    /// Reports layers that the other options cannot keep apart.
    pub(super) fn check_layers(&self, check: &mut Check<'_>, target: &Target) {
        if !target.has_separate_layers() {
            return;
        }
        let held = match (self.erosion_criterion(), self.target_resistance()) {
            (ErosionCriterion::Tate, _) => Some(("erosion_criterion", "tate")),
            (_, TargetResistanceModel::Column) => None,
            (_, resistance) => Some(("target_resistance", resistance.name())),
        };
        if let Some((key, name)) = held {
            check.fail(
                key,
                format!(
                    "`{key}` = \"{name}\" takes the layers as one body: `gap`, `interface` and `column_diameter` of a layer have no effect"
                ),
                "remove the keys from the layers, or this one",
            );
        }
    }
}
