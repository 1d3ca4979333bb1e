//! Consistent unit systems of decks, which carry no units.

/// A consistent system of units: pressure, density and the rest follow from mass, length and time; temperatures are in kelvin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnitSystem {
    /// Name: length, mass and time.
    pub name: &'static str,
    /// Its unit of pressure, in words.
    pub pressure_unit: &'static str,
    /// Unit of mass [kg].
    mass: f64,
    /// Unit of length [m].
    length: f64,
    /// Unit of time [s].
    time: f64,
}

const fn system(
    name: &'static str,
    pressure_unit: &'static str,
    [length, mass, time]: [f64; 3],
) -> UnitSystem {
    UnitSystem {
        name,
        pressure_unit,
        mass,
        length,
        time,
    }
}

/// Pound-force times second squared per inch [kg], from 1 lbf = 4.4482216152605 N and 1 in = 0.0254 m.
const POUND_FORCE_MASS: f64 = 4.448_221_615_260_5 / 0.0254;

impl UnitSystem {
    /// The systems that decks use.
    pub const ALL: [Self; 6] = [
        system("m-kg-s", "Pa", [1.0, 1.0, 1.0]),
        system("mm-t-s", "MPa", [1e-3, 1e3, 1.0]),
        system("mm-kg-ms", "GPa", [1e-3, 1.0, 1e-3]),
        system("mm-g-ms", "MPa", [1e-3, 1e-3, 1e-3]),
        system("cm-g-us", "Mbar", [1e-2, 1e-3, 1e-6]),
        system("in-lbf-s", "psi", [0.0254, POUND_FORCE_MASS, 1.0]),
    ];

    /// The names of all systems.
    pub const NAMES: [&str; Self::ALL.len()] = {
        let mut names = [""; Self::ALL.len()];
        let mut i = 0;
        while i < names.len() {
            names[i] = Self::ALL[i].name;
            i += 1;
        }
        names
    };

    /// The system of a name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|system| system.name == name)
    }

    /// Unit of density [kg/m3].
    pub(super) fn density(&self) -> f64 {
        self.mass / self.length.powi(3)
    }

    /// Unit of pressure [Pa].
    pub(super) fn pressure(&self) -> f64 {
        self.mass / (self.length * self.time * self.time)
    }

    /// Unit of velocity [m/s].
    pub(super) fn velocity(&self) -> f64 {
        self.length / self.time
    }

    /// Unit of strain rate [1/s].
    pub(super) fn rate(&self) -> f64 {
        1.0 / self.time
    }

    /// Unit of specific heat [J/(kg K)].
    pub(super) fn specific_heat(&self) -> f64 {
        self.velocity().powi(2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn systems_have_their_known_units() {
        let of = |name: &str| UnitSystem::named(name).unwrap();
        let near = |value: f64, known: f64| assert!((value / known - 1.0).abs() < 1e-6, "{value}");
        near(of("mm-t-s").pressure(), 1e6);
        near(of("mm-t-s").density(), 1e12);
        near(of("mm-kg-ms").pressure(), 1e9);
        near(of("mm-g-ms").pressure(), 1e6);
        near(of("mm-g-ms").density(), 1e6);
        near(of("cm-g-us").pressure(), 1e11);
        near(of("cm-g-us").specific_heat(), 1e8);
        near(of("in-lbf-s").pressure(), 6_894.757_293);
        near(of("in-lbf-s").density(), 1.068_689e7);
        assert!(UnitSystem::named("furlong").is_none());
    }
}
