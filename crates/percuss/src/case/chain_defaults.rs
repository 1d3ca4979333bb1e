//! Options of the 1-D discrete element model with their defaults in place of what is not given.

use super::{
    chain_words::{ErosionClosure, Kinematics, TargetClosure},
    number_or_word::ConstraintFactor,
    options::ChainOptions,
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

    /// Keys that only a column has, and whether they are given.
    pub(super) fn column_keys(&self) -> [(&'static str, bool); 3] {
        [
            ("constraint_factor", self.constraint_factor.is_some()),
            ("border_shear", self.border_shear.is_some()),
            (
                "erosion_closure",
                self.erosion_closure() == ErosionClosure::Tate,
            ),
        ]
    }

    /// Keys of a chain of springs through the target that an expanding cavity has no use for, and whether they are given.
    pub(super) fn spring_keys(&self) -> [(&'static str, bool); 6] {
        [
            ("kinematics", self.kinematics.is_some()),
            ("artificial_viscosity", self.artificial_viscosity.is_some()),
            ("damping_ratio", self.damping_ratio.is_some()),
            ("local_damping", self.local_damping.is_some()),
            ("failure", self.failure.is_some()),
            ("fracture_energy", self.fracture_energy.is_some()),
        ]
    }

    /// Whether an option is given that an expanding cavity does not have.
    pub(crate) fn asks_for_a_column(&self) -> bool {
        let perforates =
            self.border_shear_law.is_some() || self.shear_band.is_some() || self.dishing.is_some();
        let given = |(_, given): &(&str, bool)| *given;
        perforates || self.column_keys().iter().any(given) || self.spring_keys().iter().any(given)
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
