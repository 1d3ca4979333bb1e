//! Depths of all contenders beside those of the reference.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::{
    contender::contenders, design::Shot, estimate::check_references, reference::Reference,
};
use crate::{
    Error,
    regime::{ProjectileRegime, Regime},
};

/// What one contender says of one shot. A row of the stored judgement.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    /// Name of the contender.
    pub contender: String,
    /// Id of the projectile's material.
    pub projectile: String,
    /// Id of the target's material.
    pub target: String,
    /// Length of the projectile over its diameter.
    pub length_to_diameter: f64,
    /// Impact speed [m/s].
    pub impact_velocity_m_s: f64,
    /// What the projectile does in this shot.
    pub regime: ProjectileRegime,
    /// Depth by the contender [mm].
    pub depth_of_penetration_mm: f64,
    /// Depth by the reference [mm], extrapolated in the cell size.
    pub reference_depth_mm: f64,
    /// Distance of that from the reference's finest mesh [mm].
    pub reference_uncertainty_mm: f64,
}

/// Uncertainty over depth up to which a reference is called sharp: well below the errors that are judged by it.
pub const SHARP: f64 = 0.1;

impl Verdict {
    /// Relative error: positive where the contender goes deeper than the reference.
    pub fn error(&self) -> f64 {
        self.depth_of_penetration_mm / self.reference_depth_mm - 1.0
    }

    /// Whether the reference of this shot is known within [`SHARP`].
    pub fn is_sharp(&self) -> bool {
        self.reference_uncertainty_mm <= SHARP * self.reference_depth_mm
    }

    /// Whether this is of a shot.
    pub fn is_of(&self, shot: &Shot) -> bool {
        self.projectile == shot.projectile
            && self.target == shot.target
            && self.length_to_diameter == shot.length_to_diameter
            && self.impact_velocity_m_s == shot.speed
    }
}

/// Runs every contender on every shot whose reference passes its check. A contender that fails on a shot is left out there.
///
/// # Errors
/// [`Error::Input`] when a shot's materials are not in the library.
pub fn judge(shots: &[Shot], references: &[Reference]) -> Result<Vec<Verdict>, Error> {
    let contenders = contenders();
    let checked = check_references(shots, references);
    let judged: Result<Vec<Vec<Verdict>>, Error> = checked
        .par_iter()
        .filter_map(|entry| Some((&entry.shot, entry.estimate.ok()?)))
        .map(|(shot, reference)| {
            let scenario = shot.scenario()?;
            let regime = Regime::of(&scenario).projectile;
            let depths = contenders.iter().filter_map(|contender| {
                let depth = contender.depth(&scenario).ok().flatten()?;
                Some(Verdict {
                    contender: contender.name.to_owned(),
                    projectile: shot.projectile.clone(),
                    target: shot.target.clone(),
                    length_to_diameter: shot.length_to_diameter,
                    impact_velocity_m_s: shot.speed,
                    regime,
                    depth_of_penetration_mm: depth * 1e3,
                    reference_depth_mm: reference.depth_mm,
                    reference_uncertainty_mm: reference.uncertainty_mm,
                })
            });
            Ok(depths.collect())
        })
        .collect();
    Ok(judged?.into_iter().flatten().collect())
}

/// The judgement as the CSV file that the library stores.
///
/// # Errors
/// Those of the CSV writer.
pub fn to_csv(verdicts: &[Verdict]) -> Result<Vec<u8>, csv::Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for verdict in verdicts {
        writer.serialize(verdict)?;
    }
    writer
        .into_inner()
        .map_err(|error| error.into_error().into())
}
