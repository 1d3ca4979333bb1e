//! Options of the axisymmetric model.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{
    ArtificialViscosity,
    common::{OF_TWO, check_end, check_viscosity, refuse_without_heating, refuse_without_target},
    defaults::{HEAT_FRACTION, MAX_STEPS, defaults},
};
use crate::{
    check::{Check, Limits, limits},
    problem::{RearFaceCondition, Target},
    units::{Length, Pressure, Time},
};

/// Options of the model `axi`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(transform = axi_in_schema)]
#[non_exhaustive]
pub struct AxiOptions {
    /// Cells along the projectile's radius.
    pub cells_per_radius: Option<u32>,
    /// Particles along each side of a cell at the start; two make four in a cell.
    pub particles_per_side: Option<u32>,
    /// Radius of the target that is modelled [m]; 10 radii of the projectile when not given.
    pub target_radius: Option<Length>,
    /// Depth of the target that is modelled when the target is thicker [m]; what the impact is expected to need when not given.
    pub target_depth: Option<Length>,
    /// What holds the target at `target_radius`.
    pub edge: Option<Edge>,
    /// How bodies meet.
    pub contact: Option<ContactKind>,
    /// Coulomb's coefficient of friction of contact `frictional`.
    pub friction: Option<f64>,
    /// Equation of state.
    pub equation_of_state: Option<Eos>,
    /// Courant number on the fastest wave and particle.
    pub courant: Option<f64>,
    /// Artificial viscosity in compression.
    pub artificial_viscosity: Option<ArtificialViscosity>,
    /// Whether strength and damage laws see the strain rate.
    pub rate_effects: Option<bool>,
    /// Whether plastic work heats the material.
    pub adiabatic_heating: Option<bool>,
    /// Fraction of plastic work that becomes heat.
    pub heat_fraction: Option<f64>,
    /// Whether damage accumulates with plastic strain, by the constants of the material's record.
    pub damage: Option<bool>,
    /// Width of the band in which localized strain makes damage grow [m].
    pub band_width: Option<Length>,
    /// Equivalent plastic strain at which material loses its strength in shear and tension; never when not given.
    pub failure_strain: Option<f64>,
    /// Equivalent plastic strain at which material is taken out; never when not given.
    pub erosion_strain: Option<f64>,
    /// Whether material that fails is taken out, not left without strength.
    pub erode_failed: Option<bool>,
    /// Whether material spalls at the spall strength of its record.
    pub spall: Option<bool>,
    /// Tensile stress at which material spalls, instead of that of the materials' records [Pa].
    pub spall_strength: Option<Pressure>,
    /// Time at which a run is ended [s]; long enough for the case to end by itself when not given.
    pub end_time: Option<Time>,
    /// Time steps after which a run is ended.
    pub max_steps: Option<u64>,
    /// Whether a run is ended when the projectile's momentum is used up, as soon as the depth of penetration is known.
    pub end_at_rest: Option<bool>,
}

/// What holds a target at its outer radius.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Edge {
    /// Nothing: waves come back with the other sign.
    Free,
    /// A smooth rigid ring.
    Fixed,
    /// Waves leave, as if the target went on.
    #[default]
    NonReflecting,
}

/// How bodies meet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ContactKind {
    /// They press, slide with Coulomb friction, and part.
    #[default]
    Frictional,
    /// They move as one wherever they meet, and never part.
    Sticking,
}

/// Equation of state.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Eos {
    /// `p = K (ρ/ρ₀ − 1)`.
    #[default]
    Linear,
    /// Mie–Grüneisen; every material's record must have it.
    MieGruneisen,
}

/// Cells along a radius beyond which a run would take days.
const CELLS: (u32, u32) = (2, 200);
const PARTICLES: (u32, u32) = (1, 4);
const STRAIN: Limits = limits::EROSION_STRAIN;

defaults! { AxiOptions, axi_in_schema {
    /// Cells along the projectile's radius.
    cells_per_radius: u32 = 8;
    /// Particles along each side of a cell.
    particles_per_side: u32 = 2;
    /// What holds the target at its outer radius.
    edge: Edge = Edge::NonReflecting;
    /// How bodies meet.
    contact: ContactKind = ContactKind::Frictional;
    /// Coulomb's coefficient of friction.
    friction: f64 = 0.0;
    /// Equation of state.
    equation_of_state: Eos = Eos::Linear;
    /// Courant number.
    courant: f64 = 0.7;
    /// Artificial viscosity.
    artificial_viscosity: ArtificialViscosity = ArtificialViscosity { linear: 0.06, quadratic: 1.2 };
    /// Whether strength and damage laws see the strain rate.
    rate_effects: bool = true;
    /// Whether plastic work heats the material.
    adiabatic_heating: bool = true;
    /// Fraction of plastic work that becomes heat.
    heat_fraction: f64 = HEAT_FRACTION;
    /// Width of the band in which localized strain makes damage grow.
    band_width: Length = Length::new(0.25e-3);
    /// Time steps after which a run is ended.
    max_steps: u64 = MAX_STEPS;
    /// Whether a run is ended when the depth is known.
    end_at_rest: bool = false;
    depending damage: "`true` where the rear face of the target is free, otherwise `false`";
    depending erode_failed: "`true` where damage accumulates in a target with a free rear face and less than 5 projectile diameters thick, \
        otherwise `false`";
    depending spall: "`false`, and `true` where `spall_strength` is given";
} }

impl AxiOptions {
    /// Whether material spalls.
    pub fn spalls(&self) -> bool {
        self.spall.unwrap_or(self.spall_strength.is_some())
    }

    /// Whether damage accumulates.
    pub fn damages(&self, rear_face: Option<RearFaceCondition>) -> bool {
        self.damage
            .unwrap_or(rear_face == Some(RearFaceCondition::Free))
    }

    /// Whether material that fails is taken out.
    ///
    /// A crater far from the rear face becomes too deep where it is: its material is enclosed, and carries pressure after it failed.
    pub fn erodes_failed(&self, rear_face: Option<RearFaceCondition>, is_thick: bool) -> bool {
        let may_plug = rear_face == Some(RearFaceCondition::Free) && !is_thick;
        self.erode_failed
            .unwrap_or(may_plug && self.damages(rear_face))
    }

    /// Whether anything makes material fail.
    pub fn can_fail(&self, rear_face: Option<RearFaceCondition>) -> bool {
        self.damages(rear_face) || self.failure_strain.is_some() || self.spalls()
    }

    /// Reports values that are not allowed, each with its key, its allowed range and a remedy.
    pub fn check(&self, check: &mut Check<'_>, target: &Target) {
        for (key, value, (least, most)) in [
            ("cells_per_radius", self.cells_per_radius, CELLS),
            ("particles_per_side", self.particles_per_side, PARTICLES),
        ] {
            if let Some(value) = value.filter(|value| !(least..=most).contains(value)) {
                check.out_of_range(key, value, format!("allowed: {least} to {most}"));
            }
        }
        for (key, number, limits) in [
            ("friction", self.friction, limits::FRICTION),
            ("courant", self.courant, limits::COURANT),
            ("heat_fraction", self.heat_fraction, limits::HEAT_FRACTION),
            ("failure_strain", self.failure_strain, STRAIN),
            ("erosion_strain", self.erosion_strain, STRAIN),
        ] {
            check.number(key, number, limits);
        }
        for (key, length) in [
            ("target_radius", self.target_radius),
            ("target_depth", self.target_depth),
            ("band_width", self.band_width),
        ] {
            check.quantity(key, length, limits::LENGTH);
        }
        check_viscosity(check, self.artificial_viscosity);
        check.quantity("spall_strength", self.spall_strength, limits::FLOW_STRESS);
        check_end(check, self.end_time, self.max_steps);
        self.check_effect(check, target);
    }

    /// Reports keys that would have no effect.
    fn check_effect(&self, check: &mut Check<'_>, target: &Target) {
        let of_target = [
            ("target_radius", self.target_radius.is_some()),
            ("target_depth", self.target_depth.is_some()),
            ("edge", self.edge.is_some()),
            ("contact", self.contact.is_some()),
            ("friction", self.friction.is_some()),
            ("end_at_rest", self.end_at_rest.is_some()),
        ];
        if !target.is_solid() {
            refuse_without_target(check, &of_target);
        }
        refuse_without_heating(check, self.heat_fraction, self.adiabatic_heating);
        let without_effect = [
            (
                "friction",
                self.friction.is_some() && self.contact == Some(ContactKind::Sticking),
                "with contact `sticking`",
                OF_TWO,
            ),
            (
                "spall_strength",
                self.spall_strength.is_some() && self.spall == Some(false),
                "with `spall = false`",
                OF_TWO,
            ),
            (
                "band_width",
                self.band_width.is_some() && !self.damages(target.back_face),
                "where damage does not accumulate",
                "remove the key, or add `damage = true`",
            ),
            (
                "erode_failed",
                self.erode_failed == Some(true) && !self.can_fail(target.back_face),
                "where nothing fails",
                "remove the key, or give `damage`, `failure_strain` or `spall`",
            ),
        ];
        for (key, ignored, why, remedy) in without_effect {
            if ignored {
                check.fail(key, format!("`{key}` has no effect {why}"), remedy);
            }
        }
    }
}
