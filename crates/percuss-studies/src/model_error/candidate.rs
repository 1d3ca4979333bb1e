//! Candidates of the benchmark: every fast model that gives depths, and every target resistance model of the chain.

use std::sync::LazyLock;

use crate::{
    Scenario,
    case::{ChainOptions, ModelOptions, TargetResistanceModel},
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
        // An option that is new stops the compiler here.
        let ChainOptions {
            scheme,
            failure,
            // Mesh and end of a run may differ: a depth hardly depends on them.
            projectile_elements: _,
            target_elements: _,
            courant: _,
            end_time: _,
            max_steps: _,
            end_at_rest: _,
            // Of the shear band, of failure and of the published scheme, which are not in the benchmark.
            shear_band: _,
            dishing: _,
            fracture_energy: _,
            published: _,
            // Compared by their defaults.
            target_resistance: _,
            constraint_factor: _,
            border_shear: _,
            border_shear_law: _,
            kinematics: _,
            erosion_strain: _,
            erosion_criterion: _,
            artificial_viscosity: _,
            damping_ratio: _,
            local_damping: _,
            rate_effects: _,
            adiabatic_heating: _,
            heat_fraction: _,
        } = options;
        *scheme == own.scheme
            && failure.is_none()
            && options.target_resistance() == own.target_resistance()
            && options.border_shear_law() == own.border_shear_law()
            && options.erosion_criterion() == own.erosion_criterion()
            && options.kinematics() == own.kinematics()
            && options.erosion_strain() == own.erosion_strain()
            && options.damping_ratio() == own.damping_ratio()
            && options.local_damping() == own.local_damping()
            && has_material_response_of(options, &own)
            && (self.target != TargetResistanceModel::Column || has_column_of(options, &own))
    }

    fn options(&self) -> ChainOptions {
        ChainOptions {
            target_resistance: Some(self.target),
            border_shear: self.border_shear,
            ..ChainOptions::default()
        }
    }
}

/// Whether two cases have the same rate effects, heating and viscosity.
fn has_material_response_of(options: &ChainOptions, own: &ChainOptions) -> bool {
    options.rate_effects() == own.rate_effects()
        && options.adiabatic_heating() == own.adiabatic_heating()
        && options.heat_fraction() == own.heat_fraction()
        && options.artificial_viscosity() == own.artificial_viscosity()
}

/// Whether two cases have the same constants of a column.
fn has_column_of(options: &ChainOptions, own: &ChainOptions) -> bool {
    options.border_shear() == own.border_shear()
        && options.constraint_factor() == own.constraint_factor()
}

/// Whether a case has the options of a model that it had in the benchmark; `fdm` takes some from `[chain]`.
fn has_defaults_of(model: &str, options: &ModelOptions) -> bool {
    let (chain, own) = (&options.chain, ChainOptions::default());
    options.are_default(model)
        && (model != "fdm"
            || has_material_response_of(chain, &own)
                && has_column_of(chain, &own)
                && chain.erosion_strain() == own.erosion_strain())
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
            None => has_defaults_of(candidate.name, options),
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
                    target = { material = 'aluminium-2024-t351', thickness = '25 mm', back_face = 'free' }\n";
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
            (
                "chain",
                "chain.target_resistance = 'column'\nchain.border_shear_law = 'shear-band'",
                None,
            ),
            ("fdm", "", Some("fdm")),
            ("fdm", "chain.projectile_elements = 80", Some("fdm")),
            ("fdm", "chain.local_damping = 0.1", Some("fdm")),
            ("fdm", "fdm.constraint_factor = 2.5", None),
            ("fdm", "chain.constraint_factor = 2.5", None),
            ("fdm", "chain.border_shear = 0.0", None),
            ("fdm", "chain.rate_effects = false", None),
            (
                "fdm",
                "chain.artificial_viscosity = { linear = 0.5, quadratic = 2.0 }",
                None,
            ),
            ("fdm", "fdm.courant = 0.7", Some("fdm")),
            ("fdm", "fdm.courant = 0.5", None),
            (
                "energy_balance",
                "energy_balance.entry = true",
                Some("energy_balance"),
            ),
            ("energy_balance", "energy_balance.entry = false", None),
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
