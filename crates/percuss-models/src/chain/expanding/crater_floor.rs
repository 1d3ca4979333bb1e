//! The crater floor: what goes on between the tip of the projectile and the far field.

use serde::{Deserialize, Serialize};

use super::resistance::{FLAT_FACE, Pressures, Resistance};
use crate::{Error, resistance::CustomResistance, solver::archive::Archive};

/// Added mass of a disc that moves normal to itself, on one side of it, over `ρ a³` \[lamb1932\].
const ADDED_MASS: f64 = 4.0 / 3.0;

/// Whether the tip is on the floor.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Contact {
    Open,
    Closed,
}

/// What pushes back on the floor.
#[derive(Debug)]
pub(super) enum TargetResistance {
    /// The pressure of an expanding cavity, and that which turns the target aside.
    Cavity(Resistance),
    /// A law of the caller's own.
    Own(CustomResistance),
}

impl TargetResistance {
    /// Pressures on a floor and the largest one that what lies beside it can press with [Pa], at a depth [m], a speed [m/s] and a
    /// density of the target [kg/m3].
    fn pressures(&self, depth: f64, speed: f64, density: f64) -> (Pressures, f64) {
        match self {
            Self::Cavity(resistance) => {
                let mut pressures = resistance.at(depth);
                pressures.cavity += 0.5 * density * speed * speed;
                (pressures, resistance.steady())
            }
            Self::Own(own) => {
                let cavity = own.0.pressure(depth, speed);
                let flat_face = 0.0;
                (Pressures { cavity, flat_face }, cavity)
            }
        }
    }
}

/// The floor has a permanent depth below the ground that carries it.
#[derive(Debug)]
pub(super) struct CraterFloor {
    resistance_law: TargetResistance,
    /// Area of the undeformed projectile [m2].
    area: f64,
    /// Density of the target [kg/m3], and mass of it that moves with the floor [kg].
    density: f64,
    added_mass: f64,
    pub(super) contact: Contact,
    pub(super) depth: f64,
    /// Speed at which it advances into the far field, never negative [m/s].
    pub(super) speed: f64,
    /// Lengths of what eroded, which stands between the tip and the floor no more [m].
    pub(super) lost_length: f64,
}

/// What the tip of the projectile brings to the floor.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Tip {
    pub(super) area: f64,
    /// That it flows with now, and that which it could bear [Pa].
    pub(super) flow_stress: f64,
    pub(super) yield_stress: f64,
    pub(super) density: f64,
    /// Speed at which the projectile behind it catches up with it [m/s].
    pub(super) closing: f64,
}

impl CraterFloor {
    /// Everything that a step changes.
    pub(super) fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), Error> {
        archive.item(&mut self.contact)?;
        archive.item(&mut self.depth)?;
        archive.item(&mut self.speed)?;
        archive.item(&mut self.lost_length)
    }

    pub(super) fn new(resistance_law: TargetResistance, area: f64, density: f64) -> Self {
        Self {
            resistance_law,
            area,
            density,
            added_mass: ADDED_MASS * density * (area / std::f64::consts::PI).powf(1.5),
            contact: Contact::Closed,
            depth: 0.0,
            speed: 0.0,
            lost_length: 0.0,
        }
    }

    /// Mass of target that moves with the floor [kg].
    pub(super) fn added_mass(&self) -> f64 {
        self.added_mass
    }

    /// Inverse of the inertia of the floor against an impulse on it [1/kg]; none as long as it stands.
    pub(super) fn mobility(&self) -> f64 {
        if self.speed > 0.0 {
            1.0 / self.added_mass()
        } else {
            0.0
        }
    }

    /// Force at which it advances at its present speed [N]: on the area of the undeformed projectile the target's resistance and the
    /// pressure that turns it aside, and what a flat face and the metal spread beyond that area add.
    ///
    /// The spread metal flows outwards and presses with its own flow stress; what a face adds, the weaker of the two metals bears. From
    /// both the stagnation force `S = ½ρ_p w²` on the undeformed area is taken, which is on the axis and presses on the floor. Once
    /// metal leaves the head, the stream of momentum is `2S`: half of it is the stagnation, and the other half presses beside the
    /// floor. The floor then advances by the equation of Alekseevskii and Tate.
    pub(super) fn resistance(&self, tip: Tip) -> f64 {
        let (pressures, largest) =
            self.resistance_law
                .pressures(self.depth, self.speed, self.density);
        let pressing = tip.flow_stress.min(largest);
        let stagnation = 0.5 * tip.density * self.area * tip.closing * tip.closing;
        let flat_face = self.area
            * pressures
                .flat_face
                .min(FLAT_FACE * tip.yield_stress.max(0.0));
        let spread = (tip.area - self.area).max(0.0) * pressing;
        let least = if self.lost_length > 0.0 {
            stagnation
        } else {
            0.0
        };
        self.area * pressures.cavity + (flat_face + spread - stagnation).max(least)
    }

    /// Kinetic energy of the target that moves with it [J].
    pub(super) fn kinetic_energy(&self) -> f64 {
        0.5 * self.added_mass() * self.speed * self.speed
    }

    /// Slows down by itself while the tip is off it; gives the energy that this takes [J].
    pub(super) fn coast(&mut self, kick: f64) -> f64 {
        let before = self.kinetic_energy();
        let force = self.resistance(Tip::default());
        self.speed = (self.speed - force * kick / self.added_mass()).max(0.0);
        before - self.kinetic_energy()
    }
}
