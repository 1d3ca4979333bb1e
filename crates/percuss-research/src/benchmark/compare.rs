//! Depths by all models compared with the reference.

use percuss::{
    Error, Scenario,
    model::{self, Control},
    model_error::{Candidate, ErrorRecord, candidates, ratios},
    regime::Regime,
};
use rayon::prelude::*;

use super::{case::BenchmarkCase, check_references, reference::Reference};

/// Runs every candidate on every case whose reference passes its check. Failed runs are left out.
///
/// # Errors
/// [`Error::Input`] when a case's materials are not in the library.
pub fn compare(
    cases: &[BenchmarkCase],
    references: &[Reference],
) -> Result<Vec<ErrorRecord>, Error> {
    let candidates = candidates();
    let checked = check_references(cases, references);
    let compared: Result<Vec<Vec<ErrorRecord>>, Error> = checked
        .par_iter()
        .filter_map(|entry| Some((&entry.case, entry.estimate.ok()?)))
        .map(|(case, reference)| {
            let scenario = case.scenario()?;
            let regime = Regime::of(&scenario).projectile;
            let Some([strength_ratio, density_ratio]) = ratios(&scenario) else {
                return Ok(Vec::new());
            };
            let depths = candidates.iter().filter_map(|candidate| {
                let depth = depth(candidate, &scenario)?;
                Some(ErrorRecord {
                    candidate: candidate.name.to_owned(),
                    projectile: case.projectile.clone(),
                    target: case.target.clone(),
                    strength_ratio,
                    density_ratio,
                    length_to_diameter: case.length_to_diameter,
                    impact_velocity_m_s: case.speed,
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

/// Results as the CSV file that the library stores.
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
