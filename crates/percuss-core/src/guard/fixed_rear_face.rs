//! Plates on a fixed rear face.

use crate::{
    problem::BackFace,
    regime::THICK,
    scenario::{Scenario, TargetBody},
};

/// Warning that a fixed rear face lets nothing out of a plate that is not thick.
pub fn fixed_rear_face_warning(scenario: &Scenario) -> Option<String> {
    let TargetBody::Layers {
        back_face: BackFace::Fixed,
        ..
    } = scenario.target
    else {
        return None;
    };
    let ratio = scenario.target_thickness()? / scenario.projectile.diameter;
    (ratio < THICK).then(|| {
        "the back face is held (`target.back_face = \"fixed\"`, the default of a plate): nothing can leave through it; give \
         \"free\" for a plate that the projectile may perforate"
            .to_owned()
    })
}
