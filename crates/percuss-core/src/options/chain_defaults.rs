//! Options of the 1-D discrete element model with their defaults for options that are not given.

use super::{
    chain::ChainOptions,
    chain_enums::{ArtificialViscosity, ErosionCriterion, Kinematics, TargetResistanceModel},
    defaults::{HEAT_FRACTION, MAX_STEPS, defaults},
    number_or_name::{ConstraintFactor, ErosionStrain, NumberOrName},
    published_options::PublishedOptions,
    shear_band::BorderShearLaw,
};

defaults! { ChainOptions, chain_in_schema {
    /// Factor on the target's flow stress.
    constraint_factor: ConstraintFactor = ConstraintFactor::Value(2.7);
    /// Border-shear coefficient C.
    border_shear: f64 = 0.577;
    /// What holds the column of target to the plate around it.
    border_shear_law: BorderShearLaw = BorderShearLaw::Friction;
    /// Whether the plate around the column dishes.
    dishing: bool = false;
    /// Strain at which an element erodes.
    erosion_strain: ErosionStrain = ErosionStrain::At(2.0);
    /// How what erodes leaves the tip.
    erosion_criterion: ErosionCriterion = ErosionCriterion::Strain;
    /// Artificial viscosity.
    artificial_viscosity: ArtificialViscosity = ArtificialViscosity::default();
    /// Damping of every spring as a fraction of critical.
    damping_ratio: f64 = 0.0;
    /// Local damping.
    local_damping: f64 = 0.0;
    /// Whether strength and damage laws see the strain rate.
    rate_effects: bool = true;
    /// Whether plastic work heats the material.
    adiabatic_heating: bool = true;
    /// Fraction of plastic work that becomes heat.
    heat_fraction: f64 = HEAT_FRACTION;
    /// Time steps after which a run is ended.
    max_steps: u64 = MAX_STEPS;
    /// Whether a run is ended when the depth is known.
    end_at_rest: bool = false;
    also kinematics = Kinematics::Logarithmic;
    also courant = ChainOptions::COURANT;
    depending projectile_elements: many_elements();
    depending target_elements: few_elements();
    depending target_resistance: resistance_model();
} }

fn many_elements() -> String {
    format!(
        "{}, and in a projectile longer than {} diameters as many as make elements of half a diameter; always {0} in scheme `published`",
        ChainOptions::PROJECTILE_ELEMENTS,
        f64::from(ChainOptions::PROJECTILE_ELEMENTS) * ChainOptions::LONGEST_ELEMENT
    )
}

fn few_elements() -> String {
    format!(
        "{}, and in a target thinner than half the projectile's length fewer, a fourth as long as the projectile's but at least 24; always {0} in scheme `published`",
        ChainOptions::TARGET_ELEMENTS
    )
}

fn resistance_model() -> String {
    let default = ChainOptions::default();
    let lacks: Vec<String> = default
        .cavity_lacks()
        .map(|(key, _)| format!("`{key}`"))
        .collect();
    format!(
        "`expanding-cavity` for a flat-ended projectile on one layer that yields, semi-infinite or at least 0.866 projectile diameters thick, \
         unless {} or `target.column_diameter` differs from its default: the expanding cavity has none of these. `column` otherwise",
        lacks.join(", ")
    )
}

impl ChainOptions {
    /// Elements along the projectile, if it is not long.
    pub const PROJECTILE_ELEMENTS: u32 = 40;
    /// Longest element of a projectile by default, in its diameters.
    pub const LONGEST_ELEMENT: f64 = 0.5;
    /// Elements through a target that is not thin.
    pub const TARGET_ELEMENTS: u32 = 80;
    /// Courant number.
    pub const COURANT: f64 = 0.8;

    /// Elements along the projectile: of a [`Scenario`](crate::Scenario), where those of a long one are known.
    pub fn projectile_elements(&self) -> usize {
        self.projectile_elements
            .unwrap_or(Self::PROJECTILE_ELEMENTS) as usize
    }

    /// Elements through the target: of a [`Scenario`](crate::Scenario), where those of a thin one are known.
    pub fn target_elements(&self) -> usize {
        self.target_elements.unwrap_or(Self::TARGET_ELEMENTS) as usize
    }

    /// Courant number.
    pub fn courant(&self) -> f64 {
        self.courant.unwrap_or(Self::COURANT)
    }

    /// What stands for the target: of a [`Scenario`](crate::Scenario), where the default of its case is worked out.
    pub fn target_resistance(&self) -> TargetResistanceModel {
        self.target_resistance.unwrap_or_default()
    }

    /// Keys that only a column has, and whether their values differ from the default: writing down a default changes nothing.
    pub(super) fn column_keys(&self) -> [(&'static str, bool); 3] {
        let default = Self::default();
        [
            (
                "constraint_factor",
                match (
                    self.constraint_factor().number(),
                    default.constraint_factor().number(),
                ) {
                    (Some(given), Some(default)) => differ(given, default),
                    (given, default) => given != default,
                },
            ),
            (
                "border_shear",
                differ(self.border_shear(), default.border_shear()),
            ),
            (
                "erosion_criterion",
                self.erosion_criterion() != default.erosion_criterion(),
            ),
        ]
    }

    /// Keys that an expanding cavity does not have, and whether their values differ from the default.
    pub(super) fn cavity_lacks(&self) -> impl Iterator<Item = (&'static str, bool)> {
        let default = Self::default();
        let others = [
            ("kinematics", self.kinematics() != default.kinematics()),
            (
                "border_shear_law",
                self.border_shear_law() != default.border_shear_law(),
            ),
            ("dishing", self.dishing() != default.dishing()),
        ];
        self.column_keys().into_iter().chain(others)
    }

    /// The first key whose value an expanding cavity does not have, if there is one.
    pub fn asks_for_a_column(&self) -> Option<&'static str> {
        let mut keys = self.cavity_lacks();
        keys.find_map(|(key, differs)| differs.then_some(key))
    }

    /// Whether a dotted key of a case is an option that an expanding cavity does not have.
    pub fn is_of_a_column(key: &str) -> bool {
        let default = Self::default();
        let mut keys = default.cavity_lacks();
        key == "target.column_diameter"
            || key
                .strip_prefix("chain.")
                .is_some_and(|key| keys.any(|(own, _)| key.split('.').next() == Some(own)))
    }

    /// Strain measure; the erosion criterion of Tate has one of its own.
    pub fn kinematics(&self) -> Kinematics {
        match self.erosion_criterion() {
            ErosionCriterion::Strain => self.kinematics.unwrap_or_default(),
            ErosionCriterion::Tate => Kinematics::SmallStrain,
        }
    }

    /// Readings of the paper.
    pub fn published(&self) -> PublishedOptions {
        self.published.unwrap_or_default()
    }
}

/// Whether two numbers differ by more than single precision does.
fn differ(given: f64, default: f64) -> bool {
    (given - default).abs() > 1e-6 * default.abs()
}
