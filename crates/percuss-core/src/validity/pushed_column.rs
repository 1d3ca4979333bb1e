//! Columns that hold where a plate would be plugged or pierced.

use crate::{
    problem::RearFaceCondition,
    scenario::{Scenario, TargetBody},
};

/// Part of the thickness up to a free face from which on a target that holds is warned of.
const PUSHED: f64 = 0.5;

/// Warning of a target that holds at a depth [m]: a column of it is pushed out of a free face as a whole, against the shear of its border.
pub fn pushed_column_warning(scenario: &Scenario, depth: Option<f64>) -> Option<String> {
    let TargetBody::Layers {
        layers, back_face, ..
    } = &scenario.target
    else {
        return None;
    };
    let is_free = |layer: usize| match layers.get(layer + 1) {
        Some(next) => next.gap > 0.0,
        None => *back_face == RearFaceCondition::Free,
    };
    let mut deep = 0.0;
    let is_pushed = layers.iter().enumerate().any(|(i, layer)| {
        // A semi-infinite layer has no free face.
        deep += layer.thickness.unwrap_or(f64::INFINITY);
        is_free(i) && depth.is_some_and(|depth| depth > PUSHED * deep)
    });
    // The axisymmetric model takes no layers apart from each other.
    let remedy = match layers.iter().any(|layer| layer.gap > 0.0) {
        true => "no model here that computes a plug or a bulge takes layers with a gap",
        false => "`--model axi` and `percuss limit` say whether it is perforated",
    };
    is_pushed.then(|| {
        format!(
            "that the target holds is not a result: a column without a plug or a bulge overestimates the resistance of a plate with \
             a free face; {remedy}"
        )
    })
}
