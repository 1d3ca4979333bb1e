//! Depths by all models compared with the reference.

use percuss::{
    Error, Scenario,
    model::{self, Control},
    model_error::{Contender, Verdict, contenders},
    regime::Regime,
};
use rayon::prelude::*;

use super::{case::BenchmarkCase, check_references, reference::Reference};

/// Runs every contender on every case whose reference passes its check. Failed runs are left out.
///
/// # Errors
/// [`Error::Input`] when a case's materials are not in the library.
pub fn compare(cases: &[BenchmarkCase], references: &[Reference]) -> Result<Vec<Verdict>, Error> {
    let contenders = contenders();
    let checked = check_references(cases, references);
    let compared: Result<Vec<Vec<Verdict>>, Error> = checked
        .par_iter()
        .filter_map(|entry| Some((&entry.case, entry.estimate.ok()?)))
        .map(|(case, reference)| {
            let scenario = case.scenario()?;
            let regime = Regime::of(&scenario).projectile;
            let depths = contenders.iter().filter_map(|contender| {
                let depth = depth(contender, &scenario)?;
                Some(Verdict {
                    contender: contender.name.to_owned(),
                    projectile: case.projectile.clone(),
                    target: case.target.clone(),
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
pub fn to_csv(verdicts: &[Verdict]) -> Result<Vec<u8>, csv::Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for verdict in verdicts {
        writer.serialize(verdict)?;
    }
    writer
        .into_inner()
        .map_err(|error| error.into_error().into())
}

/// Depth of penetration [m]; `None` where the model does not apply or fails.
fn depth(contender: &Contender, scenario: &Scenario) -> Option<f64> {
    let scenario = contender.scenario(scenario);
    let result = model::run(contender.model, &scenario, &mut Control::default());
    result.ok()?.depth_of_penetration
}
