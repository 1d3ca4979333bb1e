//! Candidates of the benchmark: every fast model that gives depths, and every target resistance model of the chain.

use std::sync::LazyLock;

use crate::{
    Scenario,
    case::{ArtificialViscosity, ChainOptions, ErosionStrain, TargetResistanceModel},
    model::{self, Model},
    outcome::BandQuantity,
};

/// A model, with one choice of the options that decide its depth.
#[derive(Clone, Copy)]
pub struct Candidate {
    /// Its name: that of the model, and of the target resistance model where it is not the default one.
    pub name: &'static str,
    /// The model.
    pub model: &'static dyn Model,
    /// The target resistance model, for the chain.
    resistance: Option<ResistanceOptions>,
}

/// Options of the chain that close its target.
#[derive(Debug, Clone, Copy, PartialEq)]
struct ResistanceOptions {
    target: TargetResistanceModel,
    border_shear: Option<f64>,
}

/// Closures of the chain's target.
const RESISTANCE_MODELS: &[(&str, ResistanceOptions)] = &[
    (
        "chain: column",
        ResistanceOptions::of(TargetResistanceModel::Column),
    ),
    (
        "chain: column, no border shear",
        ResistanceOptions {
            target: TargetResistanceModel::Column,
            border_shear: Some(0.0),
        },
    ),
    (
        "chain: diverging",
        ResistanceOptions::of(TargetResistanceModel::Diverging),
    ),
    (
        "chain: diverging-penetrable",
        ResistanceOptions::of(TargetResistanceModel::DivergingPenetrable),
    ),
    (
        "chain: expanding-cavity",
        ResistanceOptions::of(TargetResistanceModel::ExpandingCavity),
    ),
];

impl ResistanceOptions {
    const fn of(target: TargetResistanceModel) -> Self {
        Self {
            target,
            border_shear: None,
        }
    }

    /// Whether a case has this target resistance model, and the constants that it had in the benchmark.
    fn is_of(&self, options: &ChainOptions) -> bool {
        let own = self.options();
        let column = options.border_shear() == own.border_shear()
            && options.constraint_factor() == own.constraint_factor();
        // Mesh and end of a run may differ: a depth hardly depends on them.
        options.scheme == own.scheme
            && options.target_resistance() == own.target_resistance()
            && options.erosion_criterion() == own.erosion_criterion()
            && options.kinematics() == own.kinematics()
            && options.erosion_strain.unwrap_or(ErosionStrain::At(2.0)) == ErosionStrain::At(2.0)
            && options.rate_effects.unwrap_or(true)
            && options.adiabatic_heating.unwrap_or(true)
            && options.heat_fraction.unwrap_or(0.9) == 0.9
            && options.artificial_viscosity.unwrap_or_default() == ArtificialViscosity::default()
            && options.damping_ratio.unwrap_or(0.0) == 0.0
            && options.local_damping.unwrap_or(0.0) == 0.0
            && options.failure.is_none()
            && (self.target != TargetResistanceModel::Column || column)
    }

    fn options(&self) -> ChainOptions {
        ChainOptions {
            target_resistance: Some(self.target),
            border_shear: self.border_shear,
            ..ChainOptions::default()
        }
    }
}

/// All candidates.
pub fn candidates() -> &'static [Candidate] {
    static CONTENDERS: LazyLock<Vec<Candidate>> = LazyLock::new(list);
    &CONTENDERS
}

fn list() -> Vec<Candidate> {
    let mut candidates = Vec::new();
    for model in model::fast_models() {
        let depth = model
            .validity()
            .predicts
            .contains(&BandQuantity::DepthOfPenetration);
        if model.name() == "chain" {
            candidates.extend(
                RESISTANCE_MODELS
                    .iter()
                    .map(|(name, resistance)| Candidate {
                        name,
                        model,
                        resistance: Some(*resistance),
                    }),
            );
        } else if depth {
            candidates.push(Candidate {
                name: model.name(),
                model,
                resistance: None,
            });
        }
    }
    candidates
}

impl Candidate {
    /// The candidate that a model is, with the options of a case; `None` with options that are not in the benchmark.
    pub fn of(model: &dyn Model, scenario: &Scenario) -> Option<Self> {
        let options = &scenario.options;
        let matching = |candidate: &Candidate| match candidate.resistance {
            Some(resistance) => resistance.is_of(&options.chain),
            None => options.are_default(candidate.name),
        };
        let mut own = candidates()
            .iter()
            .filter(|c| c.model.name() == model.name());
        own.find(|candidate| matching(candidate)).copied()
    }

    /// A case with the options of the candidate.
    pub fn scenario(&self, scenario: &Scenario) -> Scenario {
        let mut scenario = scenario.clone();
        if let Some(resistance) = self.resistance {
            scenario.options.chain = resistance.options();
        }
        scenario
    }
}

impl std::fmt::Debug for Candidate {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Candidate")
            .field("name", &self.name)
            .finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use super::Candidate;
    use crate::{case, model};

    #[test]
    fn only_what_is_in_the_benchmark_is_a_candidate() {
        let case = "projectile = { material = 'copper', length = '12.74 mm', diameter = '4.8 mm', impact_velocity = '900 m/s' }\n\
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
                "chain.target_resistance = 'column'",
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
                "chain.target_resistance = 'diverging'",
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
            let scenario = case::load_str("a", &format!("{options}\n{case}")).unwrap();
            let candidate = Candidate::of(model::model(name).unwrap(), &scenario);
            assert_eq!(candidate.map(|c| c.name), expected, "{name} {options}");
        }
    }
}
