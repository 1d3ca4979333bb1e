//! Warnings about forces: the peak at the first contact, and the force on a fixed rear face.

use super::plane_impact;
use crate::{
    problem::RearFaceCondition,
    scenario::{Scenario, TargetBody},
    units::significant,
};

/// Force of a plane impact of the projectile on the target [N]; `None` with a resistance law of the caller's own, to which it does not belong.
pub(super) fn plane_impact_force(scenario: &Scenario) -> Option<f64> {
    let TargetBody::Layers { layers, .. } = &scenario.target else {
        return None;
    };
    let (rod, target) = (&scenario.projectile, &layers.first()?.material);
    let speed = scenario.impact_velocity;
    if speed > 0.0 && scenario.resistance.is_none() {
        plane_impact::force(&rod.material, target, speed, rod.area())
    } else {
        None
    }
}

/// Time in which a wave from the edge of the struck face reaches the axis [s].
pub(super) fn edge_wave_time(scenario: &Scenario) -> f64 {
    let rod = &scenario.projectile;
    0.5 * rod.diameter / rod.material.bar_wave_speed()
}

/// Error of a peak contact force that is mentioned.
const NOTABLE_PEAK_ERROR: f64 = 0.05;

/// How far the forces of an expanding cavity may be relied on: the peak [N] at the first contact beside the force of a plane impact [N],
/// and the force on a fixed rear face beside that of `axi`.
pub(super) fn warning(
    scenario: &Scenario,
    first_contact: Option<f64>,
    plane_impact: Option<f64>,
) -> Option<String> {
    let kn = |force: f64| significant(force * 1e-3, 3);
    let peak = first_contact.filter(|peak| *peak > 0.0).and_then(|peak| {
        let words = "the peak contact force belongs to the first contact and depends on the mesh";
        match plane_impact {
            Some(plane) if (peak / plane - 1.0).abs() <= NOTABLE_PEAK_ERROR => None,
            Some(plane) => Some(format!(
                "{words}: {} kN here, {} kN by the theory of a plane impact",
                kn(peak),
                kn(plane)
            )),
            None => Some(words.to_owned()),
        }
    });
    let rear = matches!(
        &scenario.target,
        TargetBody::Layers { layers, back_face: RearFaceCondition::Fixed, .. } if layers.iter().all(|plate| plate.thickness.is_some())
    );
    let rear = rear.then(|| {
        "the force on the fixed rear face is that of a plate of infinite width: in the seed paper's case 26 to 41 % above that of `axi` at 5 \
         projectile diameters of thickness, and 71 to 87 % at one"
            .to_owned()
    });
    match (peak, rear) {
        (Some(peak), Some(rear)) => Some(format!("{peak}; {rear}")),
        (peak, rear) => peak.or(rear),
    }
}
