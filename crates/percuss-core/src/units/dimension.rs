//! The dimensions that case and material files use, each with its units.

use super::Quantity;

/// A unit of a dimension.
#[derive(Debug)]
pub struct Unit {
    /// The symbol that messages show.
    pub symbol: &'static str,
    /// Other ways to write it, after normalisation (`µ` is `u`, `³` is `3`).
    pub aliases: &'static [&'static str],
    /// SI value of one unit.
    pub factor: f64,
    /// SI value at zero; not 0 for Celsius only.
    pub offset: f64,
}

const fn unit(symbol: &'static str, factor: f64, aliases: &'static [&'static str]) -> Unit {
    Unit {
        symbol,
        aliases,
        factor,
        offset: 0.0,
    }
}

/// A physical dimension and the units that files may use for it.
pub trait Dimension: 'static {
    /// Name without an article, for example `length`.
    const NAME: &'static str;
    /// Name with its article, for example `a length`.
    const ARTICLE_NAME: &'static str;
    /// Name of the schema definition.
    const TYPE_NAME: &'static str;
    /// A quantity as a file would have it.
    const EXAMPLE: &'static str;
    /// All units, the SI unit first.
    const UNITS: &'static [Unit];
    /// Symbols to display with, largest unit first.
    const DISPLAY: &'static [&'static str];
}

/// A dimension's names and units, to tell a wrong dimension from an unknown unit.
pub(super) struct DimensionInfo {
    pub(super) name: &'static str,
    pub(super) type_name: &'static str,
    pub(super) units: &'static [Unit],
}

macro_rules! dimensions {
    ($($(#[$doc:meta])* $quantity:ident, $marker:ident, $name:literal, $article:literal, $example:literal,
        show $display:expr, [$($unit:expr),* $(,)?];)*) => {
        $(
            /// Marks a dimension in a type.
            #[derive(Debug)]
            pub enum $marker {}

            impl Dimension for $marker {
                const NAME: &'static str = $name;
                const ARTICLE_NAME: &'static str = $article;
                const TYPE_NAME: &'static str = stringify!($quantity);
                const EXAMPLE: &'static str = $example;
                const UNITS: &'static [Unit] = &[$($unit),*];
                const DISPLAY: &'static [&'static str] = &$display;
            }

            $(#[$doc])*
            pub type $quantity = Quantity<$marker>;
        )*

        pub(super) const ALL_DIMENSIONS: &[DimensionInfo] = &[
            $(DimensionInfo {
                name: $marker::NAME,
                type_name: $marker::TYPE_NAME,
                units: $marker::UNITS,
            }),*
        ];
    };
}

dimensions! {
    /// A length [m].
    Length, OfLength, "length", "a length", "4.8 mm", show ["m", "mm", "um"], [
        unit("m", 1.0, &["metre", "meter"]),
        unit("cm", 1e-2, &[]),
        unit("mm", 1e-3, &[]),
        unit("um", 1e-6, &["micron"]),
        unit("in", 0.0254, &["inch", "inches"]),
        unit("ft", 0.3048, &["foot", "feet"]),
        unit("mil", 2.54e-5, &["thou"]),
    ];
    /// A mass [kg].
    Mass, OfMass, "mass", "a mass", "12.7 g", show ["kg", "g"], [
        unit("kg", 1.0, &[]),
        unit("g", 1e-3, &["gram"]),
        unit("mg", 1e-6, &[]),
        unit("grain", 6.479891e-5, &["grains", "gr"]),
        unit("oz", 0.028349523125, &[]),
        unit("lb", 0.45359237, &["lbs"]),
    ];
    /// A time [s].
    Time, OfTime, "time", "a time", "50 us", show ["s", "ms", "us", "ns"], [
        unit("s", 1.0, &[]),
        unit("ms", 1e-3, &[]),
        unit("us", 1e-6, &[]),
        unit("ns", 1e-9, &[]),
    ];
    /// A speed [m/s].
    Velocity, OfVelocity, "speed", "a speed", "230 m/s", show ["m/s"], [
        unit("m/s", 1.0, &[]),
        unit("km/s", 1e3, &["mm/us"]),
        unit("km/h", 1.0 / 3.6, &["kph"]),
        unit("ft/s", 0.3048, &["fps"]),
        unit("mph", 0.44704, &["mi/h"]),
    ];
    /// A pressure, stress or modulus [Pa].
    Pressure, OfPressure, "stress", "a stress", "443 MPa", show ["GPa", "MPa", "kPa", "Pa"], [
        unit("Pa", 1.0, &["N/m2"]),
        unit("kPa", 1e3, &[]),
        unit("MPa", 1e6, &["N/mm2"]),
        unit("GPa", 1e9, &[]),
        unit("bar", 1e5, &[]),
        unit("kbar", 1e8, &[]),
        unit("Mbar", 1e11, &[]),
        unit("psi", 6894.757293168361, &[]),
        unit("ksi", 6894757.293168361, &[]),
    ];
    /// A density [kg/m3].
    Density, OfDensity, "density", "a density", "8500 kg/m3", show ["kg/m3"], [
        unit("kg/m3", 1.0, &[]),
        unit("g/cm3", 1e3, &["g/cc"]),
        unit("lb/in3", 27679.904710203125, &[]),
    ];
    /// A temperature [K].
    Temperature, OfTemperature, "temperature", "a temperature", "293 K", show ["K"], [
        unit("K", 1.0, &["kelvin"]),
        Unit { symbol: "celsius", aliases: &["C", "°C", "degC"], factor: 1.0, offset: 273.15 },
    ];
    /// An angle [rad].
    Angle, OfAngle, "angle", "an angle", "30 deg", show ["deg"], [
        unit("rad", 1.0, &["radian", "radians"]),
        unit("deg", std::f64::consts::PI / 180.0, &["degree", "degrees", "°"]),
    ];
    /// A strain rate [1/s].
    StrainRate, OfStrainRate, "strain rate", "a strain rate", "1 1/s", show ["1/s"], [
        unit("1/s", 1.0, &["/s", "s-1"]),
    ];
    /// A specific heat capacity [J/(kg K)].
    SpecificHeat, OfSpecificHeat, "specific heat", "a specific heat", "383 J/(kg K)", show ["J/(kg K)"], [
        unit("J/(kg K)", 1.0, &["J/kg/K", "J/kg K", "J/(kgK)", "J/kgK"]),
        unit("kJ/(kg K)", 1e3, &["kJ/kg/K", "kJ/kg K"]),
    ];
    /// An energy per area [J/m2].
    EnergyPerArea, OfEnergyPerArea, "energy per area", "an energy per area", "10 kJ/m2", show ["kJ/m2", "J/m2"], [
        unit("J/m2", 1.0, &["N/m"]),
        unit("kJ/m2", 1e3, &["N/mm"]),
    ];
    /// A change per pressure [1/Pa].
    InversePressure, OfInversePressure, "change per stress", "a change per stress", "0.028 1/GPa", show ["1/GPa"], [
        unit("1/Pa", 1.0, &["/Pa"]),
        unit("1/GPa", 1e-9, &["/GPa"]),
        unit("1/Mbar", 1e-11, &["/Mbar"]),
    ];
    /// A change per temperature [1/K].
    InverseTemperature, OfInverseTemperature, "change per temperature", "a change per temperature", "3.8e-4 1/K", show ["1/K"], [
        unit("1/K", 1.0, &["/K"]),
    ];
}
