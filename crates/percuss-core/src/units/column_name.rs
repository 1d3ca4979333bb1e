//! Names of columns in tables of users: `time_ms`, `time (ms)` and `time [ms]` are one.

use super::{ALL_DIMENSIONS, ResultUnit, UnitSystem, normalise};

/// Spellings of units that tables of instruments have, and the usual ones.
const SPELLINGS: [(&str, &str); 9] = [
    ("sec", "s"),
    ("msec", "ms"),
    ("usec", "us"),
    ("nsec", "ns"),
    ("m/sec", "m/s"),
    ("ft/sec", "ft/s"),
    ("m s-1", "m/s"),
    ("m s⁻¹", "m/s"),
    ("ms⁻¹", "m/s"),
];

/// Longest name that can be one of a quantity [bytes]: every word of a name may begin its unit.
const LONGEST: usize = 200;

/// What a column name says of a quantity.
#[derive(Debug, Clone, PartialEq)]
pub enum ColumnName {
    /// It names another quantity.
    Other,
    /// It names the quantity without the unit that it needs.
    WithoutUnit,
    /// It names the quantity with a unit of another kind, or none that is known.
    UnknownUnit(String),
    /// It names the quantity in this unit.
    InUnit(ColumnUnit),
}

/// Unit of a column.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColumnUnit {
    /// SI value of one unit.
    factor: f64,
    /// SI value at zero.
    offset: f64,
}

impl ColumnUnit {
    /// A number of the column in SI units.
    pub fn to_si(self, value: f64) -> f64 {
        value * self.factor + self.offset
    }

    /// A difference of two numbers of the column in SI units.
    pub fn difference_to_si(self, value: f64) -> f64 {
        value * self.factor
    }

    /// Whether numbers of the column are in a unit of results.
    pub fn is(self, unit: ResultUnit) -> bool {
        self.offset == 0.0 && self.factor == 1.0 / unit.per_si
    }

    /// The unit with this symbol of the kind of another.
    pub fn named(symbol: &str, of: ResultUnit) -> Option<Self> {
        let symbol = normalise(symbol);
        let symbol = SPELLINGS
            .iter()
            .find(|(other, _)| *other == symbol)
            .map_or(symbol, |(_, usual)| (*usual).to_owned());
        let mut known = candidates(of);
        known.find_map(|(name, unit)| (normalise(name) == symbol).then_some(unit))
    }
}

impl ColumnName {
    /// What a name says of a quantity, given as its name without a unit and a unit of its kind.
    pub fn of(name: &str, quantity: &str, unit: ResultUnit) -> Self {
        Self::of_any(name, &[quantity], unit)
    }

    /// What a name says of a quantity that has several names: `impact_velocity_m_s`, `Impact velocity, V0 (m/s)` and `V_0 [m/s]` are one.
    pub fn of_any(name: &str, quantities: &[&str], unit: ResultUnit) -> Self {
        let name = name.trim();
        if name.len() > LONGEST {
            return Self::Other;
        }
        let with_unit = |(words, symbol): (&str, &str)| {
            let known = ColumnUnit::named(symbol, unit);
            let of = known.map_or_else(|| Self::UnknownUnit(normalise(symbol)), Self::InUnit);
            is_one_of(words, quantities).then_some(of)
        };
        if let Some(found) = in_brackets(name).and_then(with_unit) {
            return found;
        }
        if is_one_of(name, quantities) {
            let plain_number = candidates(unit).find(|(symbol, _)| symbol.is_empty());
            return plain_number.map_or(Self::WithoutUnit, |(_, unit)| Self::InUnit(unit));
        }
        if let Some(found) = name.rsplit_once(',').and_then(with_unit) {
            return found;
        }
        let mut ends = name.char_indices().filter(|(_, c)| matches!(c, ' ' | '_'));
        let found = ends.find_map(|(at, separator)| {
            let (words, end) = (&name[..at], &name[at + 1..]);
            if !is_one_of(words, quantities) {
                return None;
            }
            let in_lower_case = || {
                let end = format!("_{}", end.to_lowercase());
                let mut known = candidates(unit);
                known.find_map(|(symbol, unit)| (suffix(symbol) == end).then_some(unit))
            };
            let named = ColumnUnit::named(end, unit);
            named.or_else(|| (separator == '_').then(in_lower_case).flatten())
        });
        found.map_or(Self::Other, Self::InUnit)
    }
}

/// Whether words are one of the names of a quantity, or two of them side by side, as in `velocity V0`.
fn is_one_of(words: &str, quantities: &[&str]) -> bool {
    // Other signs may be a unit, as in `strain %`.
    let is_of_name = |c: char| c.is_alphanumeric() || " _-.,?/#'".contains(c);
    if !words.chars().all(is_of_name) {
        return false;
    }
    let words = plain_name(words);
    let is_name = |part: &str| quantities.iter().any(|name| plain_name(name) == part);
    is_name(&words)
        || quantities.iter().any(|name| {
            let rest = words.strip_prefix(&plain_name(name));
            rest.is_some_and(|rest| rest != plain_name(name) && is_name(rest))
        })
}

/// The letters and digits of a name in lower case: `V_0`, `v0` and `V-0` are one.
pub fn plain_name(name: &str) -> String {
    let subscript = |c| match c {
        '₀' => '0',
        other => other,
    };
    let letters = name.chars().map(subscript).filter(|c| c.is_alphanumeric());
    letters.flat_map(char::to_lowercase).collect()
}

/// Symbols of the units that a column of a kind may have, separated by commas.
pub fn column_symbols(unit: ResultUnit) -> String {
    let mut symbols: Vec<&str> = candidates(unit).map(|(symbol, _)| symbol).collect();
    symbols.retain(|symbol| !symbol.is_empty());
    let mut seen = Vec::new();
    symbols.retain(|symbol| {
        !seen.contains(symbol) && {
            seen.push(*symbol);
            true
        }
    });
    symbols.join(", ")
}

/// Units of the kind of another: those of results, of unit systems and of case files.
fn candidates(of: ResultUnit) -> impl Iterator<Item = (&'static str, ColumnUnit)> {
    let scale = |unit: ResultUnit| ColumnUnit {
        factor: 1.0 / unit.per_si,
        offset: 0.0,
    };
    let own = ResultUnit::NAMED.into_iter().chain([ResultUnit::NONE]);
    let own = own.filter(move |unit| unit.si_symbol == of.si_symbol);
    let of_systems = UnitSystem::ALL.into_iter().map(move |all| all.unit(of));
    let of_results = own
        .chain(of_systems)
        .map(move |unit| (unit.symbol, scale(unit)));
    let dimensions = ALL_DIMENSIONS.iter();
    let of_cases = dimensions.filter(move |dimension| {
        let si = dimension.units.first();
        si.is_some_and(|unit| unit.symbol == of.si_symbol)
    });
    let of_cases = of_cases.flat_map(|dimension| dimension.units);
    let of_cases = of_cases.flat_map(|unit| {
        let names = std::iter::once(&unit.symbol).chain(unit.aliases);
        let (factor, offset) = (unit.factor, unit.offset);
        names.map(move |name| (*name, ColumnUnit { factor, offset }))
    });
    let ratios = [("1", 1.0), ("-", 1.0), ("%", 0.01)].into_iter();
    let ratios = ratios.filter(move |_| of.si_symbol.is_empty());
    let ratios = ratios.map(|(name, factor)| {
        let offset = 0.0;
        (name, ColumnUnit { factor, offset })
    });
    of_results.chain(of_cases).chain(ratios)
}

/// Name and unit of `name (unit)` or `name [unit]`.
fn in_brackets(name: &str) -> Option<(&str, &str)> {
    let name = name.trim();
    let (words, unit) = name.split_once(['(', '['])?;
    Some((words, unit.strip_suffix([')', ']'])?.trim()))
}

/// End of a name in a unit.
fn suffix(symbol: &str) -> String {
    if symbol.is_empty() {
        return String::new();
    }
    let symbol = normalise(symbol).to_lowercase();
    format!("_{}", symbol.replace([' ', '/', '('], "_"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn si(name: &str, quantity: &str, unit: ResultUnit) -> Option<f64> {
        match ColumnName::of(name, quantity, unit) {
            ColumnName::InUnit(unit) => Some(unit.to_si(2.0)),
            _ => None,
        }
    }

    /// Reading it word by word would take hours.
    #[test]
    fn a_name_of_a_million_words_is_of_another_quantity() {
        let name = "time ".repeat(1 << 20);
        assert_eq!(
            ColumnName::of(&name, "time", ResultUnit::US),
            ColumnName::Other
        );
    }

    #[test]
    fn a_name_gives_its_unit_in_every_form() {
        use ResultUnit as U;
        for (name, quantity, unit, value) in [
            ("time_us", "time", U::US, 2e-6),
            ("time_ms", "time", U::US, 2e-3),
            ("Time (µs)", "time", U::US, 2e-6),
            ("time [s]", "time", U::US, 2.0),
            (
                "Contact force (lbf)",
                "contact_force",
                U::KN,
                8.896443230521,
            ),
            ("contact_force_n", "contact_force", U::KN, 2.0),
            ("stress_ksi", "stress", U::MPA, 13789514.58633672),
            ("stress [Mbar]", "stress", U::MPA, 2e11),
            ("velocity (km/s)", "velocity", U::M_S, 2000.0),
            ("velocity_ft_s", "velocity", U::M_S, 0.6096),
            ("temperature (°C)", "temperature", U::K, 275.15),
            ("strain", "strain", U::NONE, 2.0),
            ("strain (%)", "strain", U::NONE, 0.02),
            ("strain, %", "strain", U::NONE, 0.02),
            ("DEPTH, in", "depth", U::MM, 0.0508),
            ("depth mm", "depth", U::MM, 2e-3),
            ("Final-length [mm]", "final_length", U::MM, 2e-3),
            ("time (µsec)", "time", U::US, 2e-6),
        ] {
            let found = si(name, quantity, unit).unwrap_or_else(|| panic!("{name}"));
            assert!((found - value).abs() <= 1e-12 * value, "{name}: {found}");
        }
    }

    #[test]
    fn other_names_and_units_are_told_apart() {
        use ResultUnit as U;
        let of = ColumnName::of;
        assert_eq!(of("depth", "depth", U::MM), ColumnName::WithoutUnit);
        assert_eq!(of("depth_of_it_mm", "depth", U::MM), ColumnName::Other);
        assert_eq!(of("note (mm)", "depth", U::MM), ColumnName::Other);
        let kilogram = ColumnName::UnknownUnit("kg".to_owned());
        assert_eq!(of("depth (kg)", "depth", U::MM), kilogram);
        let names = ["impact_velocity", "velocity", "v0"];
        let of = |name| ColumnName::of_any(name, &names, U::M_S);
        for name in ["V_0 [m/s]", "Impact velocity, V₀ (m/s)", "velocity V-0 m/s"] {
            assert!(
                matches!(of(name), ColumnName::InUnit(unit) if unit.is(U::M_S)),
                "{name}"
            );
        }
        assert_eq!(of("v0 v0 (m/s)"), ColumnName::Other);
        let symbols = column_symbols(U::US);
        assert_eq!(symbols, "us, ns, s, ms");
    }
}
