//! Options of the border shear of the model `chain`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{
    chain::ChainOptions,
    chain_enums::{ErosionCriterion, Scheme, TargetResistanceModel},
};
use crate::{
    check::{Check, limits},
    problem::{RearFaceCondition, Target},
    units::{Length, Pressure},
};

/// What holds the column of target to the plate around it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum BorderShearLaw {
    /// Dry friction with the coefficient `border_shear`, for ever.
    #[default]
    Friction,
    /// A shear band with the strength law of the plate, until it fails: then the plug flies free.
    ShearBand,
}

/// The band around a plug.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[non_exhaustive]
pub struct ShearBandOptions {
    /// Width of a band that shears evenly [m]; when not given, the shear spreads as equilibrium, hardening and rate say.
    pub width: Option<Length>,
    /// When the band fails; `damage` where the material has damage, otherwise `instability` when not given.
    pub failure: Option<BandFailure>,
    /// Plastic shear strain at which the band fails, instead of `failure`.
    pub failure_strain: Option<f64>,
    /// Constant shear strength [Pa] instead of the material's strength law.
    pub shear_strength: Option<Pressure>,
}

/// When a shear band fails.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum BandFailure {
    /// When the damage of its material is used up, in pure shear.
    Damage,
    /// At the strain at which its shear stress is largest: thermoplastic instability.
    Instability,
    /// Never: a slice of the plug is held until it has left the plate.
    Never,
}

impl ChainOptions {
    /// Reports keys of border shear that are out of range or would have no effect.
    pub(super) fn check_border_shear(&self, check: &mut Check<'_>, target: &Target) {
        if let Some(band) = &self.shear_band {
            band.check(&mut check.within("shear_band"));
        }
        if self.border_shear_law() == BorderShearLaw::Friction {
            let of_bands = [
                ("shear_band", self.shear_band.is_some()),
                ("dishing", self.dishing()),
            ];
            let message = |key: &str| {
                format!("`{key}` has no effect where border shear is friction, the default")
            };
            let remedy = "add border_shear_law = \"shear-band\", or remove the key";
            check.refuse(&of_bands, message, remedy);
            return;
        }
        let conflicts = [
            (
                self.scheme == Scheme::Published,
                "scheme `published` has friction only",
                "use scheme = \"conservative\"",
            ),
            (
                !target.is_solid() || target.without_back_in_words().is_some(),
                "a plug needs a plate with a rear face",
                "give the target a thickness, or remove the key",
            ),
            (
                target.back_face != Some(RearFaceCondition::Free),
                "a plug leaves through a free rear face",
                "add back_face = \"free\" to the target",
            ),
            (
                self.target_resistance() != TargetResistanceModel::Column
                    || self.erosion_criterion() != ErosionCriterion::Strain,
                "a shear band surrounds a column of target",
                "remove `target_resistance` and `erosion_criterion`",
            ),
            (
                self.border_shear.is_some(),
                "`border_shear` is the coefficient of friction, which a shear band replaces",
                "remove `border_shear`, or use border_shear_law = \"friction\"",
            ),
            (
                target.has_separate_layers(),
                "the layers of a plug touch from the start and are as wide as each other",
                "remove `gap`, `interface` and `column_diameter` of the layers",
            ),
        ];
        for (_, message, help) in conflicts.iter().filter(|(found, ..)| *found) {
            check.fail("border_shear_law", *message, *help);
        }
        if self.dishing() && target.plate_diameter.is_none() {
            check.fail(
                "dishing",
                "a plate that dishes ends somewhere",
                "give `target.plate_diameter`, the diameter inside its support",
            );
        }
        if self.dishing() && target.layers.len() > 1 {
            check.fail(
                "dishing",
                "dishing is that of one plate, and this target has layers",
                "remove `dishing`, or give one plate",
            );
        }
    }
}

impl ShearBandOptions {
    fn check(&self, check: &mut Check<'_>) {
        check.quantity("width", self.width, limits::BAND_WIDTH);
        if let Some(strain) = self.failure_strain {
            check.number("failure_strain", strain, limits::BAND_STRAIN);
            if self.failure.is_some() {
                check.fail(
                    "failure_strain",
                    "the failure of the band is given twice",
                    "keep `failure` or `failure_strain`",
                );
            }
        }
        if let Some(strength) = self.shear_strength {
            check.quantity("shear_strength", strength, limits::FLOW_STRESS);
            if self.width.is_none() {
                check.fail(
                    "width",
                    "a constant shear strength has no width of its own",
                    "give `width`",
                );
            }
            if self.failure == Some(BandFailure::Instability) {
                check.fail(
                    "failure",
                    "a constant shear strength has no instability",
                    "use `failure_strain`, or failure = \"never\"",
                );
            }
        }
    }
}
