//! Consistent unit systems: of decks, which carry no units, and of output.

use super::ResultUnit;

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
    /// Symbol and end of a name of its units of length, mass, time, velocity, force, energy and momentum.
    symbols: [[&'static str; 2]; 7],
    /// End of a name of its unit of pressure.
    pressure_suffix: &'static str,
}

const fn system(
    name: &'static str,
    [pressure_unit, pressure_suffix]: [&'static str; 2],
    [length, mass, time]: [f64; 3],
    symbols: [[&'static str; 2]; 7],
) -> UnitSystem {
    UnitSystem {
        name,
        pressure_unit,
        mass,
        length,
        time,
        symbols,
        pressure_suffix,
    }
}

/// Pound-force times second squared per inch [kg], from 1 lbf = 4.4482216152605 N and 1 in = 0.0254 m.
const POUND_FORCE_MASS: f64 = 4.448_221_615_260_5 / 0.0254;

/// Other names of systems.
const ALIASES: [[&str; 2]; 3] = [
    ["SI", "m-kg-s"],
    ["mm-ms-kN", "mm-kg-ms"],
    ["in-lb-s", "in-lbf-s"],
];

impl UnitSystem {
    /// The systems that decks and output have.
    pub const ALL: [Self; 6] = [
        system(
            "m-kg-s",
            ["Pa", "_pa"],
            [1.0, 1.0, 1.0],
            [
                ["m", "_m"],
                ["kg", "_kg"],
                ["s", "_s"],
                ["m/s", "_m_s"],
                ["N", "_n"],
                ["J", "_j"],
                ["N s", "_n_s"],
            ],
        ),
        system(
            "mm-t-s",
            ["MPa", "_mpa"],
            [1e-3, 1e3, 1.0],
            [
                ["mm", "_mm"],
                ["t", "_t"],
                ["s", "_s"],
                ["mm/s", "_mm_s"],
                ["N", "_n"],
                ["mJ", "_mj"],
                ["N s", "_n_s"],
            ],
        ),
        system(
            "mm-kg-ms",
            ["GPa", "_gpa"],
            [1e-3, 1.0, 1e-3],
            [
                ["mm", "_mm"],
                ["kg", "_kg"],
                ["ms", "_ms"],
                ["mm/ms", "_mm_ms"],
                ["kN", "_kn"],
                ["J", "_j"],
                ["kN ms", "_kn_ms"],
            ],
        ),
        system(
            "mm-g-ms",
            ["MPa", "_mpa"],
            [1e-3, 1e-3, 1e-3],
            [
                ["mm", "_mm"],
                ["g", "_g"],
                ["ms", "_ms"],
                ["mm/ms", "_mm_ms"],
                ["N", "_n"],
                ["mJ", "_mj"],
                ["N ms", "_n_ms"],
            ],
        ),
        system(
            "cm-g-us",
            ["Mbar", "_mbar"],
            [1e-2, 1e-3, 1e-6],
            [
                ["cm", "_cm"],
                ["g", "_g"],
                ["us", "_us"],
                ["cm/us", "_cm_us"],
                ["Mbar cm2", "_mbar_cm2"],
                ["Mbar cm3", "_mbar_cm3"],
                ["g cm/us", "_g_cm_us"],
            ],
        ),
        system(
            "in-lbf-s",
            ["psi", "_psi"],
            [0.0254, POUND_FORCE_MASS, 1.0],
            [
                ["in", "_in"],
                ["lbf s2/in", "_lbf_s2_in"],
                ["s", "_s"],
                ["in/s", "_in_s"],
                ["lbf", "_lbf"],
                ["in lbf", "_in_lbf"],
                ["lbf s", "_lbf_s"],
            ],
        ),
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

    /// The system of a name, or of another name of it: `SI`, `mm-ms-kN` or `in-lb-s`.
    pub fn named(name: &str) -> Option<Self> {
        let alias = ALIASES.iter().find(|[alias, _]| *alias == name);
        let name = alias.map_or(name, |[_, of]| of);
        Self::ALL.into_iter().find(|system| system.name == name)
    }

    /// The names and the other names of all systems.
    pub fn all_names() -> impl Iterator<Item = &'static str> {
        let aliases = ALIASES.iter().map(|[alias, _]| *alias);
        Self::NAMES.into_iter().chain(aliases)
    }

    /// Its unit of the same kind as another unit. Ratios, counts and temperatures keep theirs, and angles theirs but in SI units.
    pub fn unit(&self, of: ResultUnit) -> ResultUnit {
        let [length, mass, time, velocity, force, energy, momentum] = self.symbols;
        let stress = [self.pressure_unit, self.pressure_suffix];
        let of_area = self.length * self.length;
        let (names, si) = match of.si_symbol {
            "m" => (length, self.length),
            "m2" => (area(length[0]), of_area),
            "kg" => (mass, self.mass),
            "s" => (time, self.time),
            "m/s" => (velocity, self.velocity()),
            "N" => (force, self.pressure() * of_area),
            "Pa" => (stress, self.pressure()),
            "J" => (energy, self.pressure() * of_area * self.length),
            "N s" => (momentum, self.pressure() * of_area * self.time),
            "rad" if self.name == Self::ALL[0].name => ([of.si_symbol, of.si_suffix], 1.0),
            _ => return of,
        };
        let [symbol, suffix] = names;
        ResultUnit {
            symbol,
            suffix,
            per_si: 1.0 / si,
            ..of
        }
    }

    /// Name of a column in its unit, and what its numbers are multiplied by; `None` for a column whose name ends with no unit, or with its
    /// own.
    pub fn column(&self, name: &str) -> Option<(String, f64)> {
        let (quantity, from) = ResultUnit::split(name);
        let to = self.unit(from);
        let renamed = || format!("{quantity}{}", to.suffix);
        (to != from).then(|| (renamed(), to.per_si / from.per_si))
    }

    /// Unit of density [kg/m3].
    pub fn density(&self) -> f64 {
        self.mass / self.length.powi(3)
    }

    /// Unit of pressure [Pa].
    pub fn pressure(&self) -> f64 {
        self.mass / (self.length * self.time * self.time)
    }

    /// Unit of velocity [m/s].
    pub fn velocity(&self) -> f64 {
        self.length / self.time
    }

    /// Unit of strain rate [1/s].
    pub fn rate(&self) -> f64 {
        1.0 / self.time
    }

    /// Unit of specific heat [J/(kg K)].
    pub fn specific_heat(&self) -> f64 {
        self.velocity().powi(2)
    }
}

/// Symbol and end of names of the square of a unit of length.
fn area(length: &str) -> [&'static str; 2] {
    match length {
        "m" => ["m2", "_m2"],
        "cm" => ["cm2", "_cm2"],
        "in" => ["in2", "_in2"],
        _ => ["mm2", "_mm2"],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(value: f64, known: f64) {
        assert!((value / known - 1.0).abs() < 1e-6, "{value}, not {known}");
    }

    fn of(name: &str) -> UnitSystem {
        UnitSystem::named(name).unwrap()
    }

    #[test]
    fn columns_are_renamed_and_scaled() {
        let inches = of("in-lb-s");
        let (name, factor) = inches.column("depth_of_penetration_mm").unwrap();
        assert_eq!(name, "depth_of_penetration_in");
        near(factor * 25.4, 1.0);
        for name in [
            "energy_residual",
            "target_temperature_k",
            "outcome",
            "density_kg_m3",
        ] {
            assert_eq!(inches.column(name), None, "{name}");
        }
        assert_eq!(of("SI").column("residual_velocity_m_s"), None);
        for (system, name, square) in [
            ("SI", "crack_area_m2", 1e6),
            ("cm-g-us", "crack_area_cm2", 1e2),
            ("in-lbf-s", "crack_area_in2", 25.4 * 25.4),
        ] {
            let (found, factor) = of(system).column("crack_area_mm2").unwrap();
            assert_eq!(found, name);
            near(factor * square, 1.0);
        }
        assert_eq!(of("mm-t-s").column("crack_area_mm2"), None);
        // Every unit of length of a system has its square.
        for system in UnitSystem::ALL {
            let [length, square] = ["x_mm", "x_mm2"].map(|name| system.column(name));
            let suffix =
                |column: Option<(String, f64)>, own: &str| column.map_or(own.to_owned(), |c| c.0);
            assert_eq!(suffix(square, "x_mm2"), suffix(length, "x_mm") + "2");
        }
    }

    #[test]
    fn systems_have_their_known_units() {
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

    /// Values of the units that other tables of units give.
    #[test]
    fn results_are_converted_to_the_unit_of_their_kind() {
        use ResultUnit as U;
        for (system, unit, si, symbol, value) in [
            ("SI", U::MM, 0.0127, "m", 0.0127),
            ("SI", U::KN, 250.0, "N", 250.0),
            ("mm-ms-kN", U::KN, 250.0, "kN", 0.25),
            ("mm-ms-kN", U::US, 5e-5, "ms", 0.05),
            ("mm-ms-kN", U::M_S, 230.0, "mm/ms", 230.0),
            ("mm-ms-kN", U::MPA, 4.43e8, "GPa", 0.443),
            ("mm-kg-ms", U::N_S, 3.0, "kN ms", 3.0),
            ("mm-t-s", U::J, 2.0, "mJ", 2000.0),
            ("mm-t-s", U::M_S, 230.0, "mm/s", 230_000.0),
            ("mm-g-ms", U::N_S, 3.0, "N ms", 3000.0),
            ("cm-g-us", U::MPA, 1e9, "Mbar", 0.01),
            ("cm-g-us", U::KN, 1e7, "Mbar cm2", 1.0),
            ("cm-g-us", U::J, 1e5, "Mbar cm3", 1.0),
            ("cm-g-us", U::N_S, 10.0, "g cm/us", 1.0),
            ("in-lb-s", U::MM, 0.0127, "in", 0.5),
            ("in-lb-s", U::KN, 4.448_221_615, "lbf", 1.0),
            ("in-lb-s", U::J, 1.355_817_948, "in lbf", 12.0),
            (
                "in-lb-s",
                U::G,
                0.453_592_37,
                "lbf s2/in",
                1.0 / 386.088_583,
            ),
            ("cm-g-us", U::K, 300.0, "K", 300.0),
            ("in-lb-s", U::NONE, 0.5, "", 0.5),
        ] {
            let unit = of(system).unit(unit);
            assert_eq!(unit.symbol, symbol, "{system}");
            near(unit.of_si(si), value);
        }
        let angle = of("SI").unit(U::DEG);
        assert_eq!((angle.symbol, angle.of_si(1.0)), ("rad", 1.0));
        assert_eq!(of("mm-t-s").unit(U::DEG), U::DEG);
    }
}
