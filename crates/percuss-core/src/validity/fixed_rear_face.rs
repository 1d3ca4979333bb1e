//! Plates on a fixed rear face.

use crate::{
    problem::RearFaceCondition,
    regime::{THICK, is_thinner},
    scenario::{Scenario, TargetBody},
};

/// Why a projectile behind a fixed rear face has no velocity.
pub const THROUGH_FIXED_FACE: &str = "the projectile reaches the rear face, which is fixed (the default): nothing behind it is a result. \
                                      Set `back_face = \"free\"`";

/// Warning of a model without a mesh, which takes every rear face as free, behind a plate that it perforates.
pub fn free_rear_face_assumed(scenario: &Scenario) -> Option<&'static str> {
    match scenario.rear_face()? {
        RearFaceCondition::Free => None,
        RearFaceCondition::Fixed => Some(
            "the model takes the rear face as free. The case fixes it (the default), so that nothing can leave the target: set \
             `back_face = \"free\"`",
        ),
        RearFaceCondition::NonReflecting => Some(
            "the model takes the rear face as free, and that of the case is non-reflecting: set `back_face = \"free\"`",
        ),
    }
}

/// Warning of a fixed rear face behind a plate that is not thick: perforation is impossible.
pub fn fixed_rear_face_warning(scenario: &Scenario) -> Option<String> {
    let TargetBody::Layers {
        back_face: RearFaceCondition::Fixed,
        ..
    } = scenario.target
    else {
        return None;
    };
    is_thinner(scenario.target_thickness()?, THICK, scenario).then(|| {
        "perforation is impossible: the rear face is fixed (the default). Set \
         \"free\" for a plate that the projectile may perforate"
            .to_owned()
    })
}
