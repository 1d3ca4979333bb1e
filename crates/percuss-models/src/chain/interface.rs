//! Joints between neighbouring ends: free ends that may meet, ends that touch, ends that hold together.

use serde::{Deserialize, Serialize};

/// Two neighbouring ends of segments.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Interface {
    /// Whether they touch and move as one.
    pub(super) closed: bool,
    /// What keeps them from parting.
    pub(super) bond: CohesiveLaw,
    /// Force with which the bond of a gap pulls in this step [N].
    pub(super) pull: f64,
}

/// What keeps two ends from parting.
///
/// An unbroken bond carries any tension. A cracked one carries a tension that falls linearly with the widest opening so far, so that
/// opening it for good takes the fracture energy, whatever the mesh [hillerborg1976]. It pulls with that tension however far it
/// has closed again: nothing of the work is stored.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) enum CohesiveLaw {
    /// Nothing: the ends part as soon as they are pulled.
    None,
    /// Material, or an interface that is bonded.
    Unbroken,
    /// A crack with cohesive traction.
    Cracked {
        /// Tension at which it broke [N].
        strength: f64,
        /// Opening at which nothing holds any more [m].
        critical: f64,
        /// Widest opening so far [m].
        widest: f64,
    },
}

impl CohesiveLaw {
    /// A fresh crack that broke at a tension [N] and takes an energy [J] to open.
    pub(super) fn crack(strength: f64, energy: f64) -> Self {
        if energy == 0.0 || strength <= 0.0 {
            return Self::None;
        }
        Self::Cracked {
            strength,
            critical: 2.0 * energy / strength,
            widest: 0.0,
        }
    }

    /// Largest tension that it carries now [N].
    pub(super) fn holds(self) -> f64 {
        match self {
            Self::None => 0.0,
            Self::Unbroken => f64::INFINITY,
            Self::Cracked {
                strength,
                critical,
                widest,
            } => strength * (1.0 - widest / critical).max(0.0),
        }
    }

    /// Lets the opening [m] grow.
    fn open_to(&mut self, opening: f64) {
        if let Self::Cracked { widest, .. } = self {
            *widest = widest.max(opening);
        }
    }
}

impl Interface {
    /// Free ends apart.
    pub(super) const OPEN: Self = Self::new(false, CohesiveLaw::None);
    /// Ends that touch and hold on to each other by nothing.
    pub(super) const TOUCHING: Self = Self::new(true, CohesiveLaw::None);
    /// Ends that are bonded.
    pub(super) const BONDED: Self = Self::new(true, CohesiveLaw::Unbroken);

    pub(super) const fn new(closed: bool, bond: CohesiveLaw) -> Self {
        Self {
            closed,
            bond,
            pull: 0.0,
        }
    }

    /// Force with which the interface pulls its ends together across a gap [N].
    pub(super) fn pull_at(&mut self, gap: f64) -> f64 {
        self.bond.open_to(gap);
        self.pull = if self.closed { 0.0 } else { self.bond.holds() };
        self.pull
    }

    /// Parts the ends, which a bond that is not broken may still pull together.
    pub(super) fn part(&mut self) -> f64 {
        self.closed = false;
        self.pull = self.bond.holds();
        self.pull
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn opening_a_crack_takes_its_energy() {
        let (strength, energy) = (1500.0, 0.3);
        let mut interface = Interface::new(false, CohesiveLaw::crack(strength, energy));
        let step = 1e-8;
        let mut work = 0.0;
        let mut gap = 0.0;
        while interface.pull_at(gap + 0.5 * step) > 0.0 {
            work += interface.pull * step;
            gap += step;
        }
        assert!((work / energy - 1.0).abs() < 1e-4, "{work}");
        assert!(
            (gap / (2.0 * energy / strength) - 1.0).abs() < 1e-4,
            "{gap}"
        );
    }

    #[test]
    fn without_an_energy_nothing_holds_and_an_unbroken_bond_holds_anything() {
        assert_eq!(CohesiveLaw::crack(1500.0, 0.0), CohesiveLaw::None);
        assert_eq!(Interface::TOUCHING.bond.holds(), 0.0);
        assert_eq!(Interface::BONDED.bond.holds(), f64::INFINITY);
    }
}
