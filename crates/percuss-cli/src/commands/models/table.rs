//! Table of all models.

use percuss::{
    material::MaterialClass,
    regime::{ProjectileRegime, TargetKind},
};
use percuss_report::table::Table;

use super::ModelRecord;
use crate::{
    table::wrapped,
    terminal::{width, wrap},
};

/// One row per model.
pub fn text(models: &[ModelRecord]) -> String {
    let all = Table::of(models)
        .words("model", |model| model.name)
        .words("description", |model| model.summary)
        .words("projectiles", projectiles)
        .words("targets", targets)
        .table();
    let hint = "`percuss models NAME` prints all properties of a model; `percuss compare CASE.toml` runs the models that apply to a case.";
    wrapped(&all, [0, 2]) + &wrap(hint, width(), 0) + "\n"
}

fn projectiles(model: &ModelRecord) -> String {
    let regimes = model.validity.projectile;
    if ProjectileRegime::ALL
        .iter()
        .all(|regime| regimes.contains(regime))
    {
        return "any".to_owned();
    }
    let words: Vec<&str> = regimes.iter().map(|regime| regime.describe()).collect();
    words.join(", ")
}

/// Targets in one word each, and their material where it is not metal alone.
fn targets(model: &ModelRecord) -> String {
    let kinds = model.validity.targets;
    let word = |kind: &TargetKind| match kind {
        TargetKind::SemiInfinite => "semi-infinite",
        TargetKind::ThickPlate => "thick",
        TargetKind::Plate => "medium",
        TargetKind::ThinPlate => "thin",
        TargetKind::Layered => "layered",
        TargetKind::RigidWall => "wall",
        TargetKind::ConstantPressure => "pressure",
    };
    let mut text = match TargetKind::ALL.iter().all(|kind| kinds.contains(kind)) {
        true => "any".to_owned(),
        false => kinds.iter().map(word).collect::<Vec<_>>().join(", "),
    };
    let materials = model.validity.target_materials;
    if *materials != [MaterialClass::Metal] {
        let words: Vec<&str> = materials.iter().map(|class| class.describe()).collect();
        text += &format!("; {}", words.join(", "));
    }
    text
}
