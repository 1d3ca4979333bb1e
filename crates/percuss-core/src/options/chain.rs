//! Options of the 1-D discrete element model.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{
    chain_enums::{
        ArtificialViscosity, ErosionCriterion, Kinematics, Scheme, TargetResistanceModel,
    },
    common::{OF_TWO, check_end, check_viscosity, refuse_without_heating, refuse_without_target},
    number_or_name::{ConstraintFactor, ErosionStrain, NumberOrName},
    published_options::{ContactSpring, Interface, PublishedBorderShear, PublishedOptions},
    shear_band::{BorderShearLaw, ShearBandOptions},
};
use crate::{
    check::{
        Check,
        limits::{self, MAX_ELEMENTS},
    },
    material::Failure,
    problem::Target,
    units::{EnergyPerArea, Time},
};

/// Options of the model `chain`; the schema has the defaults.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(transform = super::chain_defaults::chain_in_schema)]
pub struct ChainOptions {
    /// Numerical scheme.
    pub scheme: Scheme,
    /// Elements along the projectile.
    pub projectile_elements: Option<u32>,
    /// Elements through the target, shared among its layers by thickness.
    pub target_elements: Option<u32>,
    /// Target resistance model; scheme `conservative` only.
    pub target_resistance: Option<TargetResistanceModel>,
    /// Factor on the target's flow stress for the lateral constraint \[woodward1982\].
    pub constraint_factor: Option<ConstraintFactor>,
    /// Border-shear coefficient C in `Fy = C π d h σ_f` \[paper, eq. 24\].
    pub border_shear: Option<f64>,
    /// What holds the column of target to the plate around it; scheme `conservative` only.
    pub border_shear_law: Option<BorderShearLaw>,
    /// The shear band, with `border_shear_law = "shear-band"`.
    pub shear_band: Option<ShearBandOptions>,
    /// Whether the plate around the column dishes, with a shear band and `target.plate_diameter`.
    pub dishing: Option<bool>,
    /// Strain measure and area change; scheme `conservative` only.
    pub kinematics: Option<Kinematics>,
    /// Courant number on the current smallest transit time; scheme `conservative` only.
    pub courant: Option<f64>,
    /// Magnitude of strain at which an element erodes, or `"never"`; scheme `conservative` only.
    pub erosion_strain: Option<ErosionStrain>,
    /// How what erodes leaves the tip; scheme `conservative` only.
    pub erosion_criterion: Option<ErosionCriterion>,
    /// Artificial viscosity in compression; scheme `conservative` only.
    pub artificial_viscosity: Option<ArtificialViscosity>,
    /// Viscous damping of every spring as a fraction of critical; scheme `conservative` only.
    pub damping_ratio: Option<f64>,
    /// Local damping: part of the unbalanced force on every node that acts against its motion; scheme `conservative`
    /// only.
    pub local_damping: Option<f64>,
    /// When material in tension parts; never when not given; scheme `conservative` only.
    pub failure: Option<Failure>,
    /// Energy that a crack takes to open, per area [J/m2]; none when not given.
    pub fracture_energy: Option<EnergyPerArea>,
    /// Whether strength and damage laws see the strain rate; scheme `conservative` only.
    pub rate_effects: Option<bool>,
    /// Whether plastic work heats the material; scheme `conservative` only.
    pub adiabatic_heating: Option<bool>,
    /// Fraction of plastic work that becomes heat; scheme `conservative` only.
    pub heat_fraction: Option<f64>,
    /// Time at which a run is ended [s]; long enough for the case to end by itself when not given.
    pub end_time: Option<Time>,
    /// Time steps after which a run is ended.
    pub max_steps: Option<u64>,
    /// Whether a run is ended when the projectile's momentum is used up, as soon as the depth of penetration is known; scheme `conservative` only.
    pub end_at_rest: Option<bool>,
    /// Readings of the paper; scheme `published` only.
    pub published: Option<PublishedOptions>,
}

impl ChainOptions {
    /// Reports values that are not allowed, each with its key, its allowed range and a remedy.
    pub fn check(&self, check: &mut Check<'_>, target: &Target) {
        let target_is_solid = target.is_solid();
        self.check_target(check, target_is_solid);
        self.check_closure(check, target);
        self.check_border_shear(check, target);
        for (key, elements) in [
            ("projectile_elements", self.projectile_elements),
            ("target_elements", self.target_elements),
        ] {
            if let Some(elements) = elements.filter(|n| !(1..=MAX_ELEMENTS).contains(n)) {
                let size = if elements > MAX_ELEMENTS {
                    format!(
                        "; this mesh would take about {:.0} MB and the time grows with the square of the number; \
                         `percuss converge` shows how many are enough",
                        f64::from(elements) * 200.0 / 1e6
                    )
                } else {
                    String::new()
                };
                check.out_of_range(
                    key,
                    format!("{elements} elements"),
                    format!("allowed: 1 to {MAX_ELEMENTS}{size}"),
                );
            }
        }
        let numbers = [
            ("border_shear", self.border_shear, limits::BORDER_SHEAR),
            ("courant", self.courant, limits::COURANT),
            ("damping_ratio", self.damping_ratio, limits::DAMPING),
            ("local_damping", self.local_damping, limits::LOCAL_DAMPING),
            ("heat_fraction", self.heat_fraction, limits::HEAT_FRACTION),
            (
                "constraint_factor",
                self.constraint_factor.and_then(|factor| factor.number()),
                limits::CONSTRAINT_FACTOR,
            ),
            (
                "erosion_strain",
                self.erosion_strain.and_then(|strain| strain.number()),
                limits::EROSION_STRAIN,
            ),
        ];
        for (key, number, limits) in numbers {
            check.number(key, number, limits);
        }
        check_viscosity(check, self.artificial_viscosity);
        check_end(check, self.end_time, self.max_steps);
        check.quantity(
            "published.target_mass",
            self.published().target_mass,
            limits::MASS,
        );
        self.check_failure(check);
        self.check_layers(check, target);
        self.check_scheme(check);
    }

    /// Reports keys that would have no effect.
    fn check_target(&self, check: &mut Check<'_>, target_is_solid: bool) {
        let column_only = [
            ("target_elements", self.target_elements.is_some()),
            ("target_resistance", self.target_resistance.is_some()),
            ("constraint_factor", self.constraint_factor.is_some()),
            ("border_shear", self.border_shear.is_some()),
            ("erosion_criterion", self.erosion_criterion.is_some()),
            ("end_at_rest", self.end_at_rest.is_some()),
        ];
        if !target_is_solid {
            refuse_without_target(check, &column_only);
        }
        if self.erosion_criterion() == ErosionCriterion::Tate {
            let of_strain = [
                ("kinematics", self.kinematics.is_some()),
                ("erosion_strain", self.erosion_strain.is_some()),
                ("border_shear", self.border_shear.is_some()),
            ];
            let message =
                |key: &str| format!("`{key}` has no effect with the erosion criterion `tate`");
            check.refuse(&of_strain, message, OF_TWO);
        }
        refuse_without_heating(check, self.heat_fraction, self.adiabatic_heating);
    }

    /// Reports keys that a cone has no use for.
    fn check_closure(&self, check: &mut Check<'_>, target: &Target) {
        let resistance = self.target_resistance();
        if resistance == TargetResistanceModel::Column {
            return;
        }
        let lacks: Vec<_> = match resistance {
            TargetResistanceModel::ExpandingCavity => self.cavity_lacks().collect(),
            _ => self.column_keys().to_vec(),
        };
        let message = |key: &str| {
            format!(
                "`{key}` belongs to a column: the target resistance model `{}` has none",
                resistance.name()
            )
        };
        let remedy = "remove the key, or use target_resistance = \"column\"";
        check.refuse(&lacks, message, remedy);
        if target.column_diameter.is_some() {
            check.fail(
                "target_resistance",
                format!(
                    "the target resistance model `{}` starts with the projectile's area: `target.column_diameter` has no effect",
                    resistance.name()
                ),
                "remove `target.column_diameter`, or use target_resistance = \"column\"",
            );
        }
        let one_material = [
            TargetResistanceModel::DivergingPenetrable,
            TargetResistanceModel::ExpandingCavity,
        ];
        if one_material.contains(&resistance) && target.layers.len() > 1 {
            check.fail(
                "target_resistance",
                format!(
                    "the target resistance model `{}` has one resistance: it takes a target of one material",
                    resistance.name()
                ),
                "use target_resistance = \"diverging\" or \"column\"",
            );
        }
    }

    /// Reports keys that the selected scheme would ignore.
    fn check_scheme(&self, check: &mut Check<'_>) {
        // Every option by its name: the compiler asks for a new one here.
        let Self {
            scheme: _,
            projectile_elements: _,
            target_elements: _,
            target_resistance,
            constraint_factor: _,
            border_shear,
            border_shear_law: _,
            shear_band: _,
            dishing: _,
            kinematics,
            courant,
            erosion_strain,
            erosion_criterion,
            artificial_viscosity,
            damping_ratio,
            local_damping,
            failure,
            fracture_energy,
            rate_effects,
            adiabatic_heating,
            heat_fraction,
            end_time: _,
            max_steps: _,
            end_at_rest,
            published,
        } = self;
        let conservative_only = [
            ("kinematics", kinematics.is_some()),
            ("courant", courant.is_some()),
            ("erosion_strain", erosion_strain.is_some()),
            ("erosion_criterion", erosion_criterion.is_some()),
            ("target_resistance", target_resistance.is_some()),
            ("artificial_viscosity", artificial_viscosity.is_some()),
            ("damping_ratio", damping_ratio.is_some()),
            ("local_damping", local_damping.is_some()),
            ("failure", failure.is_some()),
            ("fracture_energy", fracture_energy.is_some()),
            ("rate_effects", rate_effects.is_some()),
            ("adiabatic_heating", adiabatic_heating.is_some()),
            ("heat_fraction", heat_fraction.is_some()),
            ("end_at_rest", end_at_rest.is_some()),
        ];
        match self.scheme {
            Scheme::Published => {
                let message = |key: &str| format!("scheme `published` has no `{key}`");
                let remedy = "remove the key, or use scheme = \"conservative\"";
                check.refuse(&conservative_only, message, remedy);
                let readings = published.unwrap_or_default();
                if border_shear.is_some() && readings.border_shear == PublishedBorderShear::None {
                    check.fail(
                        "border_shear",
                        "`border_shear` has no effect with `published.border_shear = \"none\"`",
                        OF_TWO,
                    );
                }
                if readings.contact_spring != ContactSpring::default()
                    && readings.interface != Interface::Chain
                {
                    check.fail(
                        "published.contact_spring",
                        "`contact_spring` has no effect where rod and target are joined",
                        OF_TWO,
                    );
                }
            }
            Scheme::Conservative if published.is_some() => check.fail(
                "published",
                "scheme `conservative` does not use the readings of the paper",
                "remove the table, or use scheme = \"published\"",
            ),
            Scheme::Conservative => {}
        }
    }
}
