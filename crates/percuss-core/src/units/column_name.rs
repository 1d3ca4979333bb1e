//! Names of columns in tables of users: `time_ms`, `time (ms)` and `time [ms]` are one.

use super::{ALL_DIMENSIONS, ResultUnit, UnitSystem, normalise};

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

    /// The unit with this symbol of the kind of another.
    pub fn named(symbol: &str, of: ResultUnit) -> Option<Self> {
        let symbol = normalise(symbol);
        let mut known = candidates(of);
        known.find_map(|(name, unit)| (normalise(name) == symbol).then_some(unit))
    }
}

impl ColumnName {
    /// What a name says of a quantity, given as its name without a unit and a unit of its kind.
    pub fn of(name: &str, quantity: &str, unit: ResultUnit) -> Self {
        if let Some((words, symbol)) = in_brackets(name) {
            let symbol = normalise(symbol);
            return match candidates(unit).find(|(known, _)| normalise(known) == symbol) {
                _ if plain(words) != quantity => Self::Other,
                Some((_, unit)) => Self::InUnit(unit),
                None => Self::UnknownUnit(symbol),
            };
        }
        let name = plain(name);
        let Some(rest) = name.strip_prefix(quantity) else {
            return Self::Other;
        };
        match candidates(unit).find(|(symbol, _)| suffix(symbol) == rest) {
            Some((_, unit)) => Self::InUnit(unit),
            None if rest.is_empty() => Self::WithoutUnit,
            None => Self::Other,
        }
    }
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

/// A name in lower case with underscores.
fn plain(name: &str) -> String {
    name.trim().to_lowercase().replace(' ', "_")
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
        let symbols = column_symbols(U::US);
        assert_eq!(symbols, "us, ns, s, ms");
    }
}
