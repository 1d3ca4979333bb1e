//! Plates on a fixed rear face.

use crate::{
    problem::RearFaceCondition,
    regime::THICK,
    scenario::{Scenario, TargetBody},
};

/// Warning of a fixed rear face behind a plate that is not thick: perforation is impossible.
pub fn fixed_rear_face_warning(scenario: &Scenario) -> Option<String> {
    let TargetBody::Layers {
        back_face: RearFaceCondition::Fixed,
        ..
    } = scenario.target
    else {
        return None;
    };
    let ratio = scenario.target_thickness()? / scenario.projectile.diameter;
    (ratio < THICK).then(|| {
        "perforation is impossible: the rear face is fixed (the default). Set \
         \"free\" for a plate that the projectile may perforate"
            .to_owned()
    })
}
