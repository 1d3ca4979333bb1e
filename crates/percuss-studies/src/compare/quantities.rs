//! Most informative quantities of a case.

use crate::{
    outcome::{BandQuantity, Outcome},
    regime::{THIN, is_thinner},
    scenario::{Scenario, TargetBody},
    summary::ResultRecord,
};

/// The quantities that tell most of a case, the leading one first: the final length on a rigid wall, residual velocity and
/// ballistic limit of a plate that is thin or that any model perforates, the depth otherwise. What no model gives is left
/// out, unless nothing would remain.
pub(super) fn leading(scenario: &Scenario, results: &[ResultRecord]) -> Vec<BandQuantity> {
    use BandQuantity::{
        BallisticLimit, DepthOfPenetration, ProjectileFinalLength, ResidualVelocity,
    };
    let thickness = scenario.target_thickness();
    let thin = thickness.is_some_and(|thickness| is_thinner(thickness, THIN, scenario));
    let perforated = results
        .iter()
        .any(|result| result.outcome == Outcome::Perforated);
    let wanted: &[BandQuantity] = match scenario.target {
        TargetBody::RigidWall => &[ProjectileFinalLength],
        _ if thickness.is_some() && (thin || perforated) => &[ResidualVelocity, BallisticLimit],
        _ => &[DepthOfPenetration],
    };
    let given = |quantity: &BandQuantity| {
        results
            .iter()
            .any(|result| result.value(*quantity).is_some())
    };
    let mut quantities: Vec<BandQuantity> = wanted.iter().copied().filter(given).collect();
    if quantities.is_empty() {
        quantities.extend(BandQuantity::ALL.iter().copied().find(given));
    }
    if quantities.is_empty() {
        quantities.extend(wanted.first());
    }
    quantities
}
