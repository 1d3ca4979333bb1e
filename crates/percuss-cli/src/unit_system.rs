//! Unit systems on the command line.

use clap::builder::{PossibleValuesParser, TypedValueParser};
use percuss::units::UnitSystem;

/// A unit system, by its name.
pub fn unit_system() -> impl TypedValueParser<Value = UnitSystem> {
    let names = PossibleValuesParser::new(UnitSystem::all_names());
    names.try_map(|name| UnitSystem::named(&name).ok_or("it is no unit system"))
}
