//! Warnings of columns of target: where a plate would be plugged or pierced, of border shear, and of the mesh.

use crate::{
    problem::RearFaceCondition,
    scenario::{Scenario, TargetBody},
    units::significant,
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

/// Warns that the border shear of a column decides its depth; the table has the coefficient.
pub fn border_shear_warning(table: &str, coefficient: f64) -> Option<String> {
    (coefficient > 0.0).then(|| {
        format!(
            "the result depends on the target resistance model (constraint factor and border shear C = {}): `{table}.border_shear = 0.0` \
             gives the other end of the range",
            significant(coefficient, 4)
        )
    })
}

/// Warns of a depth [m] below one `piece` of the mesh, of a size [m], or near the end of the column that stands for a semi-infinite target.
pub fn column_mesh_warnings(
    scenario: &Scenario,
    depth: f64,
    piece: &str,
    size: f64,
) -> impl Iterator<Item = String> {
    let shallow = (depth > 0.0 && depth < size).then(|| {
        format!(
            "the depth ({} mm) is less than one target {piece} ({} mm): see `percuss converge`",
            significant(depth * 1e3, 3),
            significant(size * 1e3, 3)
        )
    });
    let length = scenario.modelled_length();
    let is_semi_infinite = scenario.layers().iter().any(|p| p.thickness.is_none());
    let deep = (is_semi_infinite && depth > 0.75 * length).then(|| {
        format!(
            "the depth is close to the {} mm that stand for a semi-infinite target: give a thickness",
            significant(length * 1e3, 3)
        )
    });
    shallow.into_iter().chain(deep)
}
