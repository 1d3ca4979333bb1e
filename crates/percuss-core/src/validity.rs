//! Validity domain of a model, as data: projectile, target, nose, materials, and ranges of ratios and velocity.

mod first_choice;
mod fitted_to;
mod fixed_rear_face;
mod lists;
mod nose_kind;
mod oblique;
mod plastic_shock;
mod pushed_column;
mod range;
mod temperature;

pub use first_choice::FirstChoice;
pub use fitted_to::FittedTo;
pub use fixed_rear_face::{THROUGH_FIXED_FACE, fixed_rear_face_warning, free_rear_face_assumed};
pub use nose_kind::NoseKind;
pub use plastic_shock::plastic_shock_warning;
pub use pushed_column::{border_shear_warning, column_mesh_warnings, pushed_column_warning};
pub use range::{Measure, Outside, Range};

use serde::Serialize;

use crate::{
    Refusal,
    material::MaterialClass,
    outcome::BandQuantity,
    regime::{ProjectileRegime, Regime, STRENGTH_STRAIN, TargetKind},
    scenario::{Scenario, TargetBody},
    units::significant,
};

use lists::conjunction;
pub use lists::list;
pub use lists::of_material;

/// The regime that a model declares. A case outside gets a reason instead of a number; at an edge, a warning.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ValidityDomain {
    /// What the projectile may do.
    pub projectile: &'static [ProjectileRegime],
    /// What may be struck.
    pub targets: &'static [TargetKind],
    /// Noses that it tells apart or allows.
    pub noses: &'static [NoseKind],
    /// Classes of material that the projectile may be made of.
    pub projectile_materials: &'static [MaterialClass],
    /// Classes of material that the target may be made of.
    pub target_materials: &'static [MaterialClass],
    /// Ranges of ratios and speed.
    pub ranges: &'static [Range],
    /// What it predicts, where the case has it.
    pub predicts: &'static [BandQuantity],
    /// Noses with which it takes oblique impact; none when it takes normal impact alone.
    pub oblique_noses: &'static [NoseKind],
    /// Whether it follows a projectile or a target that is not at the temperature its material was measured at.
    pub start_temperature: bool,
    /// Whether it breaks brittle materials: they stay whole in others.
    pub breaks_brittle: bool,
    /// Whether it takes gaps between layers, bonded interfaces and layers of different diameter.
    pub separate_layers: bool,
    /// Whether it takes a law of resistance of the caller's own.
    #[serde(skip)]
    pub own_resistance: bool,
    /// Whether it models the rear face of a plate: one that does not gives no depth close to the thickness.
    pub sees_back_face: bool,
    /// Cases for which it is the first choice.
    pub first_choice: &'static [FirstChoice],
    /// What it was fitted to or chosen on: validation does not take it for blind there.
    pub fitted_to: &'static [FittedTo],
    /// What it takes and leaves out, one line each.
    pub notes: &'static [&'static str],
}

/// Part of a plate's thickness beyond which a depth depends on the rear face.
const BACK_FACE_DEPTH: f64 = 0.8;

/// Whether the struck material never yields.
fn never_yields(scenario: &Scenario) -> bool {
    match &scenario.target {
        TargetBody::Layers { layers, .. } => layers
            .first()
            .is_some_and(|front| front.material.flow_stress(STRENGTH_STRAIN).is_none()),
        TargetBody::RigidWall | TargetBody::ConstantPressure(_) => false,
    }
}

impl ValidityDomain {
    /// Whether a model with this validity predicts the perforation of a target.
    pub fn decides_perforation(&self) -> bool {
        [BandQuantity::BallisticLimit, BandQuantity::ResidualVelocity]
            .iter()
            .any(|quantity| self.predicts.contains(quantity))
    }

    /// A validity domain of everything made of metal, for a model to narrow down.
    pub const OPEN: Self = Self {
        projectile: ProjectileRegime::ALL,
        targets: TargetKind::ALL,
        noses: NoseKind::ALL,
        projectile_materials: &[MaterialClass::Metal],
        target_materials: &[MaterialClass::Metal],
        ranges: &[],
        predicts: &[
            BandQuantity::DepthOfPenetration,
            BandQuantity::ResidualVelocity,
            BandQuantity::ProjectileFinalLength,
        ],
        oblique_noses: &[],
        start_temperature: false,
        breaks_brittle: false,
        separate_layers: false,
        own_resistance: false,
        sees_back_face: true,
        first_choice: &[],
        fitted_to: &[],
        notes: &[],
    };

    /// Whether a case lies inside.
    pub fn applicability(&self, scenario: &Scenario, regime: &Regime) -> Applicability {
        let mut warnings = Vec::new();
        if !self.targets.contains(&regime.target) {
            return Applicability::refused(format!(
                "it takes {}, and this is {}",
                list(self.targets.iter().map(|kind| kind.describe())),
                regime.target_in_words(scenario)
            ));
        }
        let nose = NoseKind::of(scenario.projectile.nose);
        if !self.noses.contains(&nose) {
            return Applicability::refused(format!(
                "it takes {} noses, and this nose is of the shape `{}`",
                list(self.noses.iter().map(|nose| nose.name())),
                nose.name()
            ));
        }
        if let Some(reason) = oblique::reason(self, scenario, nose) {
            return Applicability::refused(reason);
        }
        if let Some(reason) = self.wrong_material(scenario) {
            return Applicability::refused(reason);
        }
        if let Some(reason) = temperature::reason(self, scenario) {
            return Applicability::refused(reason);
        }
        if !self.separate_layers
            && let TargetBody::Layers {
                separate_layers: true,
                ..
            } = scenario.target
        {
            let refusal = Refusal::new(
                "it takes layers that lie on each other, without a gap, a bonded `interface` or a `column_diameter` of their own",
            );
            let remedy = "use the model `chain`, or give one layer, or layers without these keys";
            return Applicability::refused(refusal.with_remedy(remedy));
        }
        if scenario.resistance.is_some() && !self.own_resistance {
            let refusal = Refusal::new("it takes no resistance law of the caller's own");
            return Applicability::Outside(refusal.with_remedy("use the model `chain`"));
        }
        let neighbour = regime
            .neighbour
            .filter(|neighbour| self.projectile.contains(neighbour));
        if !self.projectile.contains(&regime.projectile) {
            match neighbour {
                None => {
                    let reason = Refusal::new(format!(
                        "it takes {} projectiles, and this one is {}: {}",
                        list(self.projectile.iter().map(|regime| regime.describe())),
                        regime.projectile.describe(),
                        regime.because
                    ));
                    let may_be_rigid = self.projectile.contains(&ProjectileRegime::Rigid);
                    return Applicability::refused(if may_be_rigid && never_yields(scenario) {
                        reason.with_remedy(
                            "give the projectile's material `strength.elastic = {}`: it is then rigid",
                        )
                    } else {
                        reason
                    });
                }
                Some(neighbour) => warnings.push(format!(
                    "model taken at the edge of its regime: the projectile is {} rather than {}: {}",
                    regime.projectile.describe(),
                    neighbour.describe(),
                    regime.because
                )),
            }
        }
        for range in self.ranges {
            let Some(outside) = range.diagnostic(scenario) else {
                continue;
            };
            match range.outside {
                Outside::NotApplicable => return Applicability::refused(outside),
                Outside::Warning => warnings.push(outside),
            }
        }
        let brittle = scenario.brittle();
        if !self.breaks_brittle && !brittle.is_empty() {
            warnings.push(format!(
                "{} is brittle, and stays whole in this model: `particles` breaks it",
                brittle.join(", ")
            ));
        }
        Applicability::Inside(warnings)
    }

    fn wrong_material(&self, scenario: &Scenario) -> Option<String> {
        let class = scenario.projectile.material.class();
        let refuse = |what: &str, allowed: &[MaterialClass], class: MaterialClass| {
            let allowed = list(allowed.iter().map(|class| class.describe()));
            format!(
                "it takes {what}s of {allowed}, and this one is of {}",
                class.describe()
            )
        };
        if !self.projectile_materials.contains(&class) {
            return Some(refuse("projectile", self.projectile_materials, class));
        }
        let TargetBody::Layers { layers, .. } = &scenario.target else {
            return None;
        };
        let classes = layers.iter().map(|layer| layer.material.class());
        classes
            .into_iter()
            .find(|class| !self.target_materials.contains(class))
            .map(|class| refuse("target", self.target_materials, class))
    }

    /// The validity in words, one line each.
    pub fn describe(&self) -> Vec<String> {
        let projectile = format!(
            "{} projectiles of {}, with {} noses",
            list(self.projectile.iter().map(|regime| regime.describe())),
            list(
                self.projectile_materials
                    .iter()
                    .map(|class| class.describe())
            ),
            list(self.noses.iter().map(|nose| nose.name())),
        );
        let target = format!(
            "against {}{}{}",
            list(self.targets.iter().map(|kind| kind.describe())),
            of_material(self.targets, self.target_materials),
            if self.sees_back_face {
                ""
            } else {
                "; it does not model the rear face of a plate"
            }
        );
        let temperature = (!self.start_temperature)
            .then(|| "projectile and target have room temperature".to_owned());
        let predicts = format!(
            "it gives {}",
            conjunction(self.predicts.iter().map(|quantity| quantity.describe()))
        );
        let ranges = self.ranges.iter().map(|range| {
            let outside = match range.outside {
                Outside::NotApplicable => "no number outside",
                Outside::Warning => "a warning outside",
            };
            format!(
                "{} {} ({outside}): {}",
                range.measure.describe(),
                range.describe(),
                range.because
            )
        });
        [projectile, target, predicts]
            .into_iter()
            .chain(temperature)
            .chain([oblique::describe(self)])
            .chain(ranges)
            .chain(self.fitted_to.iter().map(FittedTo::describe))
            .chain(self.notes.iter().map(|&note| note.to_owned()))
            .collect()
    }

    /// Whether the model was fitted to a source or chosen on it.
    pub fn is_fitted_to(&self, source: &str) -> bool {
        self.fitted_to
            .iter()
            .any(|fitted| fitted.sources.contains(&source))
    }

    /// Why a depth of penetration [m] cannot stand, if the rear face of the target would have affected it.
    pub fn depth_at_back_face(&self, scenario: &Scenario, depth: f64) -> Option<String> {
        let thickness = scenario.target_thickness()?;
        (!self.sees_back_face && depth > BACK_FACE_DEPTH * thickness).then(|| {
            format!(
                "it takes the target for semi-infinite, and its depth of {} mm is more than {} % of the thickness of {} mm: \
                 the rear face would affect it",
                significant(depth * 1e3, 3),
                100.0 * BACK_FACE_DEPTH,
                significant(thickness * 1e3, 3)
            )
        })
    }
}

/// Whether a case lies inside a validity.
#[derive(Debug, Clone, PartialEq)]
pub enum Applicability {
    /// It does, with warnings where it stands at an edge.
    Inside(Vec<String>),
    /// It does not.
    Outside(Refusal),
}

impl Applicability {
    fn refused(reason: impl Into<Refusal>) -> Self {
        Self::Outside(reason.into())
    }
}
