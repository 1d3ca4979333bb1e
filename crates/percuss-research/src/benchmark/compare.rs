//! Depths by all models compared with the reference.

use std::sync::atomic::AtomicBool;

use percuss::{
    Error, Scenario, chain,
    model::{self, Control, Model},
    model_error::{Candidate, ErrorRecord, candidates, ratios},
    regime::Regime,
};
use rayon::prelude::*;

use super::{case::BenchmarkCase, check_references, estimate::Estimate, reference::Reference};

/// A case with its reference.
struct Compared<'a> {
    case: &'a BenchmarkCase,
    reference: Estimate,
    scenario: Scenario,
    regime: Regime,
    /// Of strength and density.
    ratios: [f64; 2],
}

/// Runs every candidate on every case whose reference passes its check. Failed runs are left out.
///
/// # Errors
/// [`Error::Input`] when a case's materials are not in the library.
pub fn compare(
    cases: &[BenchmarkCase],
    references: &[Reference],
) -> Result<Vec<ErrorRecord>, Error> {
    let checked = check_references(cases, references);
    let compared: Result<Vec<Option<Compared<'_>>>, Error> = checked
        .par_iter()
        .filter_map(|entry| Some((&entry.case, entry.estimate.ok()?)))
        .map(|(case, reference)| {
            let scenario = case.scenario()?;
            let regime = Regime::of(&scenario);
            Ok(ratios(&scenario).map(|ratios| Compared {
                case,
                reference,
                scenario,
                regime,
                ratios,
            }))
        })
        .collect();
    let compared: Vec<Compared<'_>> = compared?.into_iter().flatten().collect();
    // Of every candidate, in the order of the cases.
    let depths: Vec<Vec<Option<f64>>> = candidates()
        .par_iter()
        .map(|candidate| depths(candidate, &compared))
        .collect();
    let records = compared.iter().enumerate().flat_map(|(c, compared)| {
        let depths = candidates().iter().zip(&depths);
        depths.filter_map(move |(candidate, depths)| Some(compared.record(candidate, depths[c]?)))
    });
    Ok(records.collect())
}

impl Compared<'_> {
    /// The depth of a candidate [m] beside the reference.
    fn record(&self, candidate: &Candidate, depth: f64) -> ErrorRecord {
        let [strength_ratio, density_ratio] = self.ratios;
        ErrorRecord {
            candidate: candidate.name.to_owned(),
            projectile: self.case.projectile.clone(),
            target: self.case.target.clone(),
            strength_ratio,
            density_ratio,
            length_to_diameter: self.case.length_to_diameter,
            impact_velocity_m_s: self.case.speed,
            regime: self.regime.projectile,
            depth_of_penetration_mm: depth * 1e3,
            reference_depth_mm: self.reference.depth_mm,
            reference_uncertainty_mm: self.reference.uncertainty_mm,
        }
    }
}

/// Depths of penetration [m] of cases by a candidate, side by side where it can; `None` where the model does not apply or fails.
fn depths(candidate: &Candidate, compared: &[Compared<'_>]) -> Vec<Option<f64>> {
    let model = candidate.model;
    let scenarios: Vec<Scenario> = compared
        .iter()
        .map(|compared| candidate.scenario(&compared.scenario))
        .collect();
    let together = |scenario: &Scenario| {
        let side_by_side = model.name() == chain::Chain.name() && chain::is_for_batch(scenario);
        side_by_side && model::applicability(model, scenario).is_ok()
    };
    let (batch, alone): (Vec<usize>, Vec<usize>) =
        (0..scenarios.len()).partition(|i| together(&scenarios[*i]));
    let of_batch: Vec<&Scenario> = batch.iter().map(|i| &scenarios[*i]).collect();
    let results = chain::run_batch(&of_batch, &AtomicBool::new(false)).unwrap_or_default();
    let results = batch.into_iter().zip(results).map(|(i, result)| {
        let result =
            result.and_then(|result| model::complete(model, &scenarios[i], Vec::new(), result));
        (i, result)
    });
    let single = alone.into_par_iter().map(|i| {
        let result = model::run(model, &scenarios[i], &mut Control::default());
        (i, result)
    });
    let mut depths = vec![None; scenarios.len()];
    for (i, result) in results.chain(single.collect::<Vec<_>>()) {
        depths[i] = result.ok().and_then(|result| result.depth_of_penetration);
    }
    depths
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
