//! Options of the 1-D discrete element model with their defaults in place of what is not given.

use super::{
    chain::ChainOptions,
    chain_words::{ErosionClosure, Kinematics, TargetClosure},
    number_or_word::{ConstraintFactor, NumberOrWord},
    published_options::PublishedOptions,
};

impl ChainOptions {
    /// Elements along the projectile.
    pub fn projectile_elements(&self) -> usize {
        self.projectile_elements.unwrap_or(40) as usize
    }

    /// Elements through the target.
    pub fn target_elements(&self) -> usize {
        self.target_elements.unwrap_or(80) as usize
    }

    /// Border-shear coefficient C.
    pub fn border_shear(&self) -> f64 {
        self.border_shear.unwrap_or(0.577)
    }

    /// Factor on the target's flow stress.
    pub fn constraint_factor(&self) -> ConstraintFactor {
        self.constraint_factor
            .unwrap_or(ConstraintFactor::Value(2.7))
    }

    /// What stands for the target: of a [`Scenario`](crate::Scenario), where the default of its case is worked out.
    pub fn target_closure(&self) -> TargetClosure {
        self.target_closure.unwrap_or_default()
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
                "erosion_closure",
                self.erosion_closure() != default.erosion_closure(),
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
    pub(crate) fn asks_for_a_column(&self) -> Option<&'static str> {
        let mut keys = self.cavity_lacks();
        keys.find_map(|(key, differs)| differs.then_some(key))
    }

    /// Whether a dotted key of a case is an option that an expanding cavity does not have.
    pub(crate) fn is_of_a_column(key: &str) -> bool {
        let default = Self::default();
        let mut keys = default.cavity_lacks();
        key == "target.column_diameter"
            || key
                .strip_prefix("chain.")
                .is_some_and(|key| keys.any(|(own, _)| key.split('.').next() == Some(own)))
    }

    /// How what erodes leaves the tip.
    pub fn erosion_closure(&self) -> ErosionClosure {
        self.erosion_closure.unwrap_or_default()
    }

    /// Strain measure; the closure of Tate has one of its own.
    pub fn kinematics(&self) -> Kinematics {
        match self.erosion_closure() {
            ErosionClosure::Strain => self.kinematics.unwrap_or_default(),
            ErosionClosure::Tate => Kinematics::SmallStrain,
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
