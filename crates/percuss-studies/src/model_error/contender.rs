//! What is judged: every quick model that gives depths, and every closure of the chain's target.

use std::sync::LazyLock;

use crate::{
    Scenario,
    case::{ArtificialViscosity, ChainOptions, ErosionStrain, TargetClosure},
    model::{self, Model},
    outcome::BandQuantity,
};

/// A model, with one choice of the options that decide its depth.
#[derive(Clone, Copy)]
pub struct Contender {
    /// Its name: that of the model, and of the closure where it is not the default one.
    pub name: &'static str,
    /// The model.
    pub model: &'static dyn Model,
    /// The closure, for the chain.
    closure: Option<Closure>,
}

/// Options of the chain that close its target.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Closure {
    target: TargetClosure,
    border_shear: Option<f64>,
}

/// Closures of the chain's target.
const CLOSURES: &[(&str, Closure)] = &[
    ("chain: column", Closure::of(TargetClosure::Column)),
    (
        "chain: column, no border shear",
        Closure {
            target: TargetClosure::Column,
            border_shear: Some(0.0),
        },
    ),
    ("chain: diverging", Closure::of(TargetClosure::Diverging)),
    (
        "chain: diverging-penetrable",
        Closure::of(TargetClosure::DivergingPenetrable),
    ),
    (
        "chain: expanding-cavity",
        Closure::of(TargetClosure::ExpandingCavity),
    ),
];

impl Closure {
    const fn of(target: TargetClosure) -> Self {
        Self {
            target,
            border_shear: None,
        }
    }

    /// Whether a case has this closure, and the constants that it was judged with.
    fn is_of(&self, options: &ChainOptions) -> bool {
        let own = self.options();
        let column = options.border_shear() == own.border_shear()
            && options.constraint_factor() == own.constraint_factor();
        // Mesh and end of a run may differ: a depth hardly depends on them.
        options.scheme == own.scheme
            && options.target_closure() == own.target_closure()
            && options.erosion_closure() == own.erosion_closure()
            && options.kinematics() == own.kinematics()
            && options.erosion_strain.unwrap_or(ErosionStrain::At(2.0)) == ErosionStrain::At(2.0)
            && options.rate_effects.unwrap_or(true)
            && options.adiabatic_heating.unwrap_or(true)
            && options.heat_fraction.unwrap_or(0.9) == 0.9
            && options.artificial_viscosity.unwrap_or_default() == ArtificialViscosity::default()
            && options.damping_ratio.unwrap_or(0.0) == 0.0
            && options.local_damping.unwrap_or(0.0) == 0.0
            && options.failure.is_none()
            && (self.target != TargetClosure::Column || column)
    }

    fn options(&self) -> ChainOptions {
        ChainOptions {
            target_closure: Some(self.target),
            border_shear: self.border_shear,
            ..ChainOptions::default()
        }
    }
}

/// All contenders.
pub fn contenders() -> &'static [Contender] {
    static CONTENDERS: LazyLock<Vec<Contender>> = LazyLock::new(list);
    &CONTENDERS
}

fn list() -> Vec<Contender> {
    let mut contenders = Vec::new();
    for model in model::quick() {
        let depth = model
            .guard()
            .predicts
            .contains(&BandQuantity::DepthOfPenetration);
        if model.name() == "chain" {
            contenders.extend(CLOSURES.iter().map(|(name, closure)| Contender {
                name,
                model,
                closure: Some(*closure),
            }));
        } else if depth {
            contenders.push(Contender {
                name: model.name(),
                model,
                closure: None,
            });
        }
    }
    contenders
}

impl Contender {
    /// The contender that a model is, with the options of a case; `None` with options that were not judged.
    pub fn of(model: &dyn Model, scenario: &Scenario) -> Option<Self> {
        let options = &scenario.options;
        let judged = |contender: &Contender| match contender.closure {
            Some(closure) => closure.is_of(&options.chain),
            None => options.are_default(contender.name),
        };
        let mut own = contenders()
            .iter()
            .filter(|c| c.model.name() == model.name());
        own.find(|contender| judged(contender)).copied()
    }

    /// A case with the options of the contender.
    pub fn scenario(&self, scenario: &Scenario) -> Scenario {
        let mut scenario = scenario.clone();
        if let Some(closure) = self.closure {
            scenario.options.chain = closure.options();
        }
        scenario
    }
}

impl std::fmt::Debug for Contender {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Contender")
            .field("name", &self.name)
            .finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use super::Contender;
    use crate::{case, model};

    #[test]
    fn only_what_was_judged_is_a_contender() {
        let shot = "projectile = { material = 'copper', length = '12.74 mm', diameter = '4.8 mm', velocity = '900 m/s' }\n\
                    target = { material = 'aluminium-2024-t351', thickness = '25 mm' }\n";
        for (name, options, expected) in [
            ("chain", "", Some("chain: expanding-cavity")),
            (
                "chain",
                "chain.projectile_elements = 80",
                Some("chain: expanding-cavity"),
            ),
            (
                "chain",
                "chain.target_closure = 'column'",
                Some("chain: column"),
            ),
            (
                "chain",
                "chain.constraint_factor = 2.7",
                Some("chain: expanding-cavity"),
            ),
            ("chain", "chain.constraint_factor = 2.5", None),
            (
                "chain",
                "chain.border_shear = 0.0",
                Some("chain: column, no border shear"),
            ),
            (
                "chain",
                "chain.target_closure = 'diverging'",
                Some("chain: diverging"),
            ),
            ("chain", "chain.kinematics = 'small-strain'", None),
            ("chain", "chain.scheme = 'published'", None),
            ("chain", "chain.rate_effects = false", None),
            ("chain", "chain.local_damping = 0.1", None),
            ("chain", "chain.failure.spall = {}", None),
            ("tate", "", Some("tate")),
            ("tate", "tate.target_resistance = '3 GPa'", None),
            ("axi", "", None),
            ("taylor", "", None),
        ] {
            let scenario = case::load_str("a", &format!("{options}\n{shot}")).unwrap();
            let contender = Contender::of(model::model(name).unwrap(), &scenario);
            assert_eq!(contender.map(|c| c.name), expected, "{name} {options}");
        }
    }
}
