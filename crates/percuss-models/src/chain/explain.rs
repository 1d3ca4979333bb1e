//! Sensitivity of a depth to modelling choices: additional runs beside the one asked for.

use super::expanding::{self, CavityRun};
use crate::{
    Error,
    options::{ErosionStrain, TargetResistanceModel},
    outcome::{Band, BandQuantity, RunResult, Termination},
    scenario::Scenario,
    solver::Control,
    units::significant,
};

/// Difference of two depths that is reported to the user.
const NOTABLE_DIFFERENCE: f64 = 0.1;
/// Erosion strain below which the rod would lose material that still presses on the target.
const EARLIEST_EROSION: f64 = 1.0;

/// Steps of a run without erosion, whose crushed elements make the step ever smaller, after which it is given up.
const MOST_STEPS: u64 = 500_000;

/// Adds which target resistance model is in force where the case did not choose it and it is not the usual one, and the range of the
/// depth over the erosion strain where the rod eroded.
///
/// It may run the case again, up to three times.
///
/// # Errors
/// [`Error::Cancelled`].
pub(crate) fn explain(
    scenario: &Scenario,
    result: &mut RunResult,
    control: &mut Control<'_>,
) -> Result<(), Error> {
    if let Some(reason) = &scenario.resistance_reason {
        let words = of_resistance(scenario, reason, result, control)?;
        result.target_resistance_choice = Some(words);
    }
    if result.band.is_none() && super::is_expanding(scenario) {
        result.band = over_erosion(scenario, result, control)?;
    }
    Ok(())
}

/// A run without histories beside another one; `None` where it fails.
fn beside(
    scenario: &Scenario,
    change: impl FnOnce(&mut Scenario),
    control: &mut Control<'_>,
) -> Result<Option<RunResult>, Error> {
    let mut other = scenario.clone();
    change(&mut other);
    let mut quiet = Control::default();
    let mut report = |now| match &mut control.progress {
        Some(report) => report(now),
        None => std::ops::ControlFlow::Continue(()),
    };
    quiet.progress = Some(&mut report);
    match CavityRun::new(&other, &mut quiet).and_then(|run| run.run(&mut quiet)) {
        Ok(found) => Ok(Some(found)),
        Err(error @ Error::Cancelled { .. }) => Err(error),
        Err(_) => Ok(None),
    }
}

fn of_resistance(
    scenario: &Scenario,
    reason: &str,
    result: &RunResult,
    control: &mut Control<'_>,
) -> Result<String, Error> {
    let mut words = format!("the target resistance model is `column`: {reason}");
    if expanding::not_applicable(scenario).is_some() {
        return Ok(words);
    }
    let cavity = TargetResistanceModel::ExpandingCavity;
    let found = beside(
        scenario,
        |other| other.options.chain.target_resistance = Some(cavity),
        control,
    )?;
    let by_cavity = found.and_then(|found| found.depth_of_penetration);
    if let (Some(depth), Some(by_cavity)) = (result.depth_of_penetration, by_cavity)
        && (by_cavity - depth).abs() > NOTABLE_DIFFERENCE * depth
    {
        words += &format!(
            "; `{}` gives a depth of {} mm instead of {} mm",
            cavity.name(),
            significant(by_cavity * 1e3, 3),
            significant(depth * 1e3, 3)
        );
    }
    Ok(words)
}

/// Depths with the erosion strain at [`EARLIEST_EROSION`] and without erosion, where the rod eroded at the default one.
fn over_erosion(
    scenario: &Scenario,
    result: &RunResult,
    control: &mut Control<'_>,
) -> Result<Option<Band>, Error> {
    let eroded = result
        .numerics
        .as_ref()
        .is_some_and(|numerics| numerics.eroded_elements.0 > 0);
    let (true, Some(depth)) = (eroded, result.depth_of_penetration) else {
        return Ok(None);
    };
    let mut band = [depth, depth];
    let mut basis =
        "erosion strain from 1 to the default: a numerical limit without a measured value";
    for strain in [ErosionStrain::At(EARLIEST_EROSION), ErosionStrain::Never] {
        let change = |other: &mut Scenario| {
            let chain = &mut other.options.chain;
            chain.erosion_strain = Some(strain);
            chain.max_steps = Some(chain.max_steps().min(MOST_STEPS));
        };
        let found = beside(scenario, change, control)?;
        let found = found.filter(|found| found.termination != Termination::StepLimit);
        if let Some(depth) = found.and_then(|found| found.depth_of_penetration) {
            band = [band[0].min(depth), band[1].max(depth)];
            if strain == ErosionStrain::Never {
                basis =
                    "erosion strain from 1 to never: a numerical limit without a measured value";
            }
        }
    }
    Ok(Some(Band {
        quantity: BandQuantity::DepthOfPenetration,
        low: band[0] * 1e3,
        high: band[1] * 1e3,
        basis,
    }))
}
