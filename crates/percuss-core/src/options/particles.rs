//! Options of the model of bonded particles.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{
    ArtificialViscosity,
    axi::Eos,
    common::{OF_TWO, check_end, check_viscosity, refuse_without_heating, refuse_without_target},
    defaults::{HEAT_FRACTION, MAX_STEPS, defaults},
};
use crate::{
    check::{Check, Limits, limits},
    problem::Target,
    units::{Length, Time},
};

/// Options of the model `particles`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(transform = particles_in_schema)]
#[non_exhaustive]
pub struct ParticlesOptions {
    /// Plane in which the bodies deform, or space.
    pub space: Option<Space>,
    /// What the forces between particles follow from.
    pub formulation: Option<Formulation>,
    /// What projectile and target are made of.
    pub contact: Option<ParticleContact>,
    /// Distance of neighbouring particles [m]; it is reduced until whole rows fill the body.
    pub spacing: Option<Length>,
    /// Width of the target across the direction of impact [m].
    pub width: Option<Length>,
    /// Outline of a target.
    pub outline: Option<Outline>,
    /// Straight cuts through the lattice, free of stress at the start; none when not given.
    pub notches: Option<Vec<Notch>>,
    /// Where the particles stand.
    pub packing: Option<PackingKind>,
    /// How far an irregular packing moves them at most, in spacings.
    pub amplitude: Option<f64>,
    /// Seed of an irregular packing: another one gives another specimen of the same solid.
    pub seed: Option<u64>,
    /// Whether bonds break: the material of the lattice needs a table `fracture`.
    pub fracture: Option<bool>,
    /// Elongation at which a bond has failed over that at which it starts to soften.
    pub softening: Option<f64>,
    /// What starts the softening of a bond.
    pub failure_criterion: Option<FailureCriterion>,
    /// Part of the velocity with which two pieces, or balls, that collide part.
    pub restitution: Option<f64>,
    /// Coefficient of friction between pieces, or of balls.
    pub friction: Option<f64>,
    /// Equation of state of particles with a stress.
    pub equation_of_state: Option<Eos>,
    /// Artificial viscosity of particles with a stress, in compression.
    pub artificial_viscosity: Option<ArtificialViscosity>,
    /// Whether strength laws of particles with a stress see the strain rate.
    pub rate_effects: Option<bool>,
    /// Whether plastic work heats particles with a stress.
    pub adiabatic_heating: Option<bool>,
    /// Fraction of plastic work that becomes heat.
    pub heat_fraction: Option<f64>,
    /// Time step as a part of the largest stable one.
    pub courant: Option<f64>,
    /// Time at which a run is ended [s].
    pub end_time: Option<Time>,
    /// Time steps after which a run is ended.
    pub max_steps: Option<u64>,
}

/// Plane in which bodies deform, or space.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Space {
    /// Bodies that are long across the plane: no strain across it. Poisson's ratio up to 1/4.
    #[default]
    PlaneStrain,
    /// Thin plates seen from their face: no stress across the plane. Poisson's ratio up to 1/3.
    PlaneStress,
    /// Bodies in space. Poisson's ratio up to 0.4.
    #[serde(rename = "3d")]
    ThreeDimensional,
}

/// What the forces between particles follow from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Formulation {
    /// Springs between neighbours: elastic and brittle solids.
    #[default]
    Springs,
    /// The stress of every particle by the strength law of its material: metals that yield, of any Poisson's ratio, in plane strain. Nothing
    /// breaks.
    ParticleStress,
}

/// What starts the softening of a bond.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum FailureCriterion {
    /// Its own elongation and slide. Compression across the tension lowers the strength.
    #[default]
    Elongation,
    /// The larger principal stress around one of its ends, whatever the stress across the tension. For spacings that resolve the tensile
    /// strength.
    PrincipalStress,
}

/// Outline of a target.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Outline {
    /// A rectangle of the thickness and the width.
    #[default]
    Plate,
    /// A disc with the thickness of the target as diameter, struck at its rim.
    Disc,
    /// A ball with the thickness of the target as diameter, of `contact = "hertz"`.
    Ball,
}

/// What projectile and target are made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ParticleContact {
    /// One is a lattice of particles, the other is rigid.
    #[default]
    Lattice,
    /// The projectile is one elastic ball, on a rigid wall, a half-space or another ball: forces by Hertz and Mindlin, with friction and
    /// rotation.
    Hertz,
}

/// A straight cut through a lattice: no bond crosses it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Notch {
    /// One end: distance from the axis, and depth below the struck face [m].
    pub from: [Length; 2],
    /// The other end, the tip, from which crack lengths and angles are measured.
    pub to: [Length; 2],
    /// Width of a slot with a round end at the tip, whose faces cannot meet while it is open: no particle stands in it [m]. A cut of no
    /// width, whose faces meet as those of a crack, when not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub width: Option<Length>,
}

impl Notch {
    /// Both ends as distance from the axis and depth [m].
    pub fn ends(&self) -> [[f64; 2]; 2] {
        [self.from, self.to].map(|end| end.map(|part| part.si()))
    }
}

/// Where particles stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum PackingKind {
    /// In a plane, on a regular lattice, whose rows are along the struck face: cracks like to follow its directions.
    Hexagonal,
    /// In space, on a body-centred cubic lattice.
    #[serde(rename = "body-centred-cubic")]
    Cubic,
    /// Moved from it at random.
    Irregular,
}

impl Space {
    /// Plane or space in words.
    pub fn describe(self) -> &'static str {
        match self {
            Self::PlaneStrain => "plane strain",
            Self::PlaneStress => "plane stress",
            Self::ThreeDimensional => "three dimensions",
        }
    }
}

/// Time steps, as parts of the largest stable one.
const COURANT: Limits = Limits {
    min: 0.01,
    max: 0.9,
};

/// Distances of irregular packings, in spacings: beyond it triangles would be slivers.
const AMPLITUDE: Limits = Limits { min: 0.0, max: 0.3 };
/// Softening of bonds: at 1 they would break at once.
const SOFTENING: Limits = Limits {
    min: 1.05,
    max: 1e4,
};

/// Restitution of pieces: below it the force of a contact would be no spring any more.
const RESTITUTION: Limits = Limits {
    min: 0.05,
    max: 1.0,
};
/// Places of the ends of a notch [m].
const NOTCH: Limits = Limits {
    min: -100.0,
    max: 100.0,
};
/// Most notches of a case.
const MOST_NOTCHES: usize = 64;
/// Coefficients of friction: pieces and balls are rougher than the interfaces of `limits::FRICTION`.
const FRICTION: Limits = Limits { min: 0.0, max: 2.0 };

defaults! { ParticlesOptions, particles_in_schema {
    /// Plane in which the bodies deform, or space.
    space: Space = Space::PlaneStrain;
    /// Outline of a target.
    outline: Outline = Outline::Plate;
    /// What projectile and target are made of.
    contact: ParticleContact = ParticleContact::Lattice;
    /// What the forces between particles follow from.
    formulation: Formulation = Formulation::Springs;
    /// Equation of state of particles with a stress.
    equation_of_state: Eos = Eos::Linear;
    /// Artificial viscosity of particles with a stress.
    artificial_viscosity: ArtificialViscosity = ArtificialViscosity { linear: 0.3, quadratic: 1.2 };
    /// Whether strength laws of particles with a stress see the strain rate.
    rate_effects: bool = true;
    /// Whether plastic work heats particles with a stress.
    adiabatic_heating: bool = true;
    /// Fraction of plastic work that becomes heat.
    heat_fraction: f64 = HEAT_FRACTION;
    /// Time step as a part of the largest stable one.
    courant: f64 = 0.5;
    /// Time steps after which a run is ended.
    max_steps: u64 = MAX_STEPS;
    /// How far an irregular packing moves them at most, in spacings.
    amplitude: f64 = 0.3;
    /// Seed of an irregular packing.
    seed: u64 = 1;
    /// What starts the softening of a bond.
    failure_criterion: FailureCriterion = FailureCriterion::Elongation;
    /// Part of the velocity with which two pieces, or balls, that collide part.
    restitution: f64 = 0.9;
    /// Coefficient of friction between pieces, or of balls.
    friction: f64 = 0.3;
    depending fracture: "`true` where the material of the lattice has a table `fracture`, otherwise `false`";
    depending packing: "`\"irregular\"` where bonds break, otherwise the regular lattice: `\"hexagonal\"`, or `\"body-centred-cubic\"` in space";
    depending softening: "that which has both the fracture energy and the tensile strength of the material, and at least 3";
    depending end_time: "where bonds break, ten times what a longitudinal wave takes across the body and the time in which the projectile \
        goes its thickness; otherwise long enough for the case to end by itself";
    depending spacing: "a tenth of the projectile's diameter, or of the target's thickness where that is less";
    depending width: "ten diameters of the projectile, or four thicknesses of the target where those are more";
} }

impl ParticlesOptions {
    /// Reports values that are not allowed, each with its key, its allowed range and a remedy.
    pub fn check(&self, check: &mut Check<'_>, target: &Target) {
        for (key, length, limits) in [
            ("spacing", self.spacing, limits::LENGTH),
            ("width", self.width, limits::LENGTH),
        ] {
            check.quantity(key, length, limits);
        }
        for (key, number, limits) in [
            ("courant", self.courant, COURANT),
            ("amplitude", self.amplitude, AMPLITUDE),
            ("softening", self.softening, SOFTENING),
            ("restitution", self.restitution, RESTITUTION),
            ("friction", self.friction, FRICTION),
            ("heat_fraction", self.heat_fraction, limits::HEAT_FRACTION),
        ] {
            check.number(key, number, limits);
        }
        check_viscosity(check, self.artificial_viscosity);
        self.check_formulation(check);
        match self.contact() {
            ParticleContact::Hertz => self.check_balls(check),
            ParticleContact::Lattice => {
                self.check_use(check);
                self.check_space(check);
            }
        }
        check_end(check, self.end_time, self.max_steps);
        if !target.is_solid() {
            refuse_without_target(check, &[("width", self.width.is_some())]);
        }
        self.check_outline(check, target);
        self.check_notches(check);
    }

    /// Reports keys without effect on springs, or on particles with a stress.
    fn check_formulation(&self, check: &mut Check<'_>) {
        if self.formulation() == Formulation::Springs {
            let of_stress = [
                ("equation_of_state", self.equation_of_state.is_some()),
                ("artificial_viscosity", self.artificial_viscosity.is_some()),
                ("rate_effects", self.rate_effects.is_some()),
                ("adiabatic_heating", self.adiabatic_heating.is_some()),
                ("heat_fraction", self.heat_fraction.is_some()),
            ];
            let message = |key: &str| format!("`{key}` has no effect: springs are elastic");
            let remedy = "remove the key, or give `formulation = \"particle-stress\"`";
            check.refuse(&of_stress, message, remedy);
            return;
        }
        let of_springs = [
            ("fracture", self.fracture == Some(true)),
            ("notches", self.notches.is_some()),
            ("softening", self.softening.is_some()),
            ("failure_criterion", self.failure_criterion.is_some()),
            ("restitution", self.restitution.is_some()),
            ("friction", self.friction.is_some()),
            ("contact", self.contact() == ParticleContact::Hertz),
        ];
        let message = |key: &str| {
            format!(
                "`{key}` is not for `formulation = \"particle-stress\"`: nothing breaks, and the contact has no friction"
            )
        };
        let remedy = "remove the key, or give `formulation = \"springs\"`";
        check.refuse(&of_springs, message, remedy);
        if self.space() != Space::PlaneStrain {
            let message = format!(
                "`formulation = \"particle-stress\"` is for plane strain, and not for {}",
                self.space().describe()
            );
            check.fail(
                "space",
                message,
                "allowed: \"plane-strain\"; or remove the key",
            );
        }
        refuse_without_heating(check, self.heat_fraction, self.adiabatic_heating);
    }

    /// Reports keys that balls of one particle do not have.
    fn check_balls(&self, check: &mut Check<'_>) {
        let of_lattices = [
            ("spacing", self.spacing.is_some()),
            ("width", self.width.is_some()),
            ("notches", self.notches.is_some()),
            ("packing", self.packing.is_some()),
            ("amplitude", self.amplitude.is_some()),
            ("seed", self.seed.is_some()),
            ("fracture", self.fracture.is_some()),
            ("softening", self.softening.is_some()),
            ("failure_criterion", self.failure_criterion.is_some()),
        ];
        let message = |key: &str| {
            format!("`{key}` has no effect: with `contact = \"hertz\"` every body is one particle")
        };
        check.refuse(&of_lattices, message, OF_TWO);
        if self
            .space
            .is_some_and(|space| space != Space::ThreeDimensional)
        {
            let message = format!(
                "`contact = \"hertz\"` is that of balls, and there are none in {}",
                self.space().describe()
            );
            check.fail("space", message, "allowed: \"3d\"; or remove the key");
        }
    }

    fn check_outline(&self, check: &mut Check<'_>, target: &Target) {
        let has_balls = self.contact() == ParticleContact::Hertz;
        let (other, name, own) = match has_balls {
            true => (Outline::Disc, "disc", "ball"),
            false => (Outline::Ball, "ball", "disc"),
        };
        if self.outline == Some(other) {
            let message = format!(
                "\"{name}\" is no outline of a target with `contact = \"{}\"`",
                if has_balls { "hertz" } else { "lattice" }
            );
            let allowed = format!("allowed: \"plate\", \"{own}\"");
            check.fail("outline", message, allowed);
            return;
        }
        if self.outline() == Outline::Plate {
            return;
        }
        if !target.is_solid() {
            let message =
                "a rigid wall or a constant pressure has no `outline`: it is that of a target";
            check.fail("outline", message, "remove the key");
        } else if self.width.is_some() {
            let message = "a disc has no `width`: its diameter is the thickness of the target";
            check.fail("width", message, "remove the key");
        }
    }

    fn check_notches(&self, check: &mut Check<'_>) {
        let Some(notches) = &self.notches else { return };
        if notches.len() > MOST_NOTCHES {
            let message = format!("{} notches are too many", notches.len());
            check.fail("notches", message, format!("allowed: up to {MOST_NOTCHES}"));
        }
        for (i, notch) in notches.iter().enumerate() {
            let mut check = check.within(&format!("notches.{i}"));
            for (key, end) in [("from", notch.from), ("to", notch.to)] {
                for part in end {
                    check.quantity(key, part, NOTCH);
                }
            }
            if let Some(width) = notch.width {
                check.quantity("width", width, limits::LENGTH);
                if self.outline() == Outline::Disc {
                    let message = "a disc takes notches of no width alone";
                    check.fail("width", message, "remove the key");
                }
            }
            if notch.from == notch.to {
                let message = "both ends of the notch are at one place";
                check.fail(
                    "to",
                    message,
                    "give the tip another place, or remove the notch",
                );
            }
        }
    }

    /// Reports keys that bodies in space do not have, or those of a plane.
    fn check_space(&self, check: &mut Check<'_>) {
        let in_space = self.space() == Space::ThreeDimensional;
        let (other, name, own) = match in_space {
            true => (PackingKind::Hexagonal, "hexagonal", "body-centred-cubic"),
            false => (PackingKind::Cubic, "body-centred-cubic", "hexagonal"),
        };
        if self.packing == Some(other) {
            let message = format!("\"{name}\" is no packing of {}", self.space().describe());
            check.fail(
                "packing",
                message,
                format!("allowed: \"{own}\", \"irregular\""),
            );
        }
        let of_planes = [
            ("outline", self.outline.is_some()),
            ("notches", self.notches.is_some()),
            (
                "failure_criterion",
                self.failure_criterion == Some(FailureCriterion::PrincipalStress),
            ),
            (
                "friction",
                self.friction.is_some_and(|friction| friction != 0.0),
            ),
        ];
        if in_space {
            let message = |key: &str| {
                format!("`{key}` is of plane bodies: in three dimensions there is none yet")
            };
            let remedy = "remove the key, or give another `space`";
            check.refuse(&of_planes, message, remedy);
        }
    }

    /// Reports keys without effect.
    fn check_use(&self, check: &mut Check<'_>) {
        let irregular = match (self.packing, self.fracture) {
            (Some(packing), _) => packing == PackingKind::Irregular,
            (None, fracture) => {
                fracture != Some(false) && self.formulation() == Formulation::Springs
            }
        };
        if !irregular {
            let of_irregular = [
                ("amplitude", self.amplitude.is_some()),
                ("seed", self.seed.is_some()),
            ];
            let message = |key: &str| format!("`{key}` has no effect: the packing is regular");
            let remedy = "remove the key, or give `packing = \"irregular\"`";
            check.refuse(&of_irregular, message, remedy);
        }
        if self.fracture == Some(false) {
            let of_fracture = [
                ("softening", self.softening.is_some()),
                ("failure_criterion", self.failure_criterion.is_some()),
                ("restitution", self.restitution.is_some()),
                ("friction", self.friction.is_some()),
            ];
            let message = |key: &str| {
                format!("`{key}` has no effect: `fracture = false`, and no bond breaks")
            };
            check.refuse(&of_fracture, message, OF_TWO);
        }
    }
}
