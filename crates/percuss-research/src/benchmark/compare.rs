//! Depths by all models beside those by the reference.

use percuss::{
    Error, Scenario,
    model::{self, Control},
    model_error::{Candidate, ErrorRecord, candidates},
    regime::Regime,
};
use rayon::prelude::*;

use super::{check_references, reference::Reference, shot::Shot};

/// Runs every candidate on every shot whose reference passes its check. A candidate that fails on a shot is left out there.
///
/// # Errors
/// [`Error::Input`] when a shot's materials are not in the library.
pub fn compare(shots: &[Shot], references: &[Reference]) -> Result<Vec<ErrorRecord>, Error> {
    let candidates = candidates();
    let checked = check_references(shots, references);
    let compared: Result<Vec<Vec<ErrorRecord>>, Error> = checked
        .par_iter()
        .filter_map(|entry| Some((&entry.shot, entry.estimate.ok()?)))
        .map(|(shot, reference)| {
            let scenario = shot.scenario()?;
            let regime = Regime::of(&scenario).projectile;
            let depths = candidates.iter().filter_map(|candidate| {
                let depth = depth(candidate, &scenario)?;
                Some(ErrorRecord {
                    candidate: candidate.name.to_owned(),
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
    Ok(compared?.into_iter().flatten().collect())
}

/// The results as the CSV file that the library stores.
///
/// # Errors
/// Those of the CSV writer.
pub fn to_csv(verdicts: &[ErrorRecord]) -> Result<Vec<u8>, csv::Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for verdict in verdicts {
        writer.serialize(verdict)?;
    }
    writer
        .into_inner()
        .map_err(|error| error.into_error().into())
}

/// Depth of penetration [m]; `None` where the model does not apply or fails.
fn depth(candidate: &Candidate, scenario: &Scenario) -> Option<f64> {
    let scenario = candidate.scenario(scenario);
    let result = model::run(candidate.model, &scenario, &mut Control::default());
    result.ok()?.depth_of_penetration
}
