//! Columns of a file of tests.

use super::Kind;
use crate::{
    csv_table::{KnownColumn, names},
    units::ResultUnit,
};

/// Name of the target of a Taylor test.
pub(super) const RIGID_WALL: &str = "rigid-wall";
/// Thickness of a target whose rear face does not matter.
pub(super) const SEMI_INFINITE: &str = "semi-infinite";

/// A column of a file of tests.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CsvColumn {
    /// Its name, with its unit.
    pub name: &'static str,
    /// Whether a file has to have it.
    pub required: bool,
    /// What it holds.
    pub meaning: &'static str,
}

const fn required(name: &'static str, meaning: &'static str) -> CsvColumn {
    CsvColumn {
        name,
        required: true,
        meaning,
    }
}

const fn optional(name: &'static str, meaning: &'static str) -> CsvColumn {
    CsvColumn {
        name,
        required: false,
        meaning,
    }
}

/// All columns, in the order in which the program's own files have them. A file may leave out those that are not required.
pub const COLUMNS: &[CsvColumn] = &[
    optional(
        "id",
        "a name that no other test has; the number of the row when there is none",
    ),
    optional("source", "bibliography key, or any words"),
    optional("read_at", "the public place where the row was read"),
    optional("licence", "under which licence the row is passed on"),
    required(
        "kind",
        "taylor, ballistic_limit, depth or residual_velocity",
    ),
    optional("projectile_class", "the projectile in a word or two"),
    required(
        "projectile_material",
        "records or families of the material library, separated by spaces; the first one is the main one",
    ),
    optional("nose", "flat (when empty), hemisphere, cone or ogive"),
    optional(
        "nose_ratio",
        "caliber-radius-head of an ogive, length over diameter of a cone",
    ),
    optional("length_mm", "length of the projectile, nose included"),
    required("diameter_mm", "diameter of the shank, or of the core"),
    optional(
        "mass_g",
        "mass of the projectile or core; this or length_mm",
    ),
    optional(
        "temperature_k",
        "temperature of the projectile before the impact",
    ),
    required(
        "impact_velocity_m_s",
        "impact velocity; may be empty for a ballistic limit, which stands for it",
    ),
    optional("obliquity_deg", "angle to the normal of the struck face"),
    required(
        "target_material",
        "rigid-wall, a name of the material library, or any name with the properties that follow",
    ),
    optional("thickness_mm", "thickness of the target, or semi-infinite"),
    optional("target_density_kg_m3", "density of the target"),
    optional("target_youngs_modulus_gpa", "its Young's modulus"),
    optional("target_poissons_ratio", "its Poisson's ratio"),
    optional("target_yield_mpa", "its yield stress"),
    optional("target_ultimate_mpa", "its ultimate tensile strength"),
    optional(
        "target_hardening_exponent",
        "n of σ = Y (E ε/Y)ⁿ; perfectly plastic when empty",
    ),
    optional("target_brinell_hardness", "its Brinell hardness number"),
    optional(
        "target_concrete_strength_mpa",
        "unconfined compressive strength, instead of a yield stress",
    ),
    required("measured", "what was measured, in the unit of its kind"),
    required("unit", "mm for taylor and depth, m/s otherwise"),
    optional("uncertainty", "standard deviation, in the same unit"),
    optional("trust", "A, B or C; empty when it is not graded"),
    optional("split", "blind (when empty) or calibration"),
    optional("flag", "why the row is suspect; no statistic counts it"),
    optional(
        "duplicate_of",
        "id of the row that it repeats; no statistic counts it",
    ),
    optional("unusable", "why no case can be made of the row"),
    optional("note", "Other remarks"),
];

/// Columns that give a measured value, its unit and its kind, in place of `measured`, `unit` and `kind`.
pub(super) const MEASURED: [(Kind, &str); 4] = [
    (Kind::Taylor, "final_length_mm"),
    (Kind::Depth, "depth_of_penetration_mm"),
    (Kind::ResidualVelocity, "residual_velocity_m_s"),
    (Kind::BallisticLimit, "ballistic_limit_m_s"),
];

/// The columns as tables may name them.
pub(super) fn known() -> Vec<KnownColumn<'static>> {
    let own = COLUMNS.iter().map(|column| column.name);
    own.map(known_column).collect()
}

/// The columns of [`MEASURED`] as tables may name them.
pub(super) fn known_measured() -> impl Iterator<Item = KnownColumn<'static>> {
    MEASURED.into_iter().map(|(_, name)| known_column(name))
}

fn known_column(name: &'static str) -> KnownColumn<'static> {
    let other_unit = |quantity, suffix, symbol, si_symbol, per_si| KnownColumn {
        name,
        quantity,
        aliases: &[],
        unit: Some(ResultUnit {
            symbol,
            suffix,
            si_symbol,
            si_suffix: "",
            per_si,
        }),
    };
    let aliases: &[&str] = match name {
        "id" => &[
            "test",
            "test id",
            "test no",
            "test number",
            "shot",
            "shot no",
            "no",
        ],
        "projectile_material" => &["rod material", "penetrator material", "core material"],
        "target_material" => &["plate material"],
        "length_mm" => &[
            "projectile length",
            "rod length",
            "initial length",
            "l",
            "l0",
        ],
        "diameter_mm" => &[
            "projectile diameter",
            "rod diameter",
            "caliber",
            "calibre",
            "d",
            "d0",
        ],
        "mass_g" => &["projectile mass", "rod mass", "m"],
        "temperature_k" => &["projectile temperature", "initial temperature"],
        "impact_velocity_m_s" => names::IMPACT_VELOCITY,
        "obliquity_deg" => &["obliquity angle", "angle of obliquity"],
        "thickness_mm" => &["target thickness", "plate thickness", "h", "t"],
        "final_length_mm" => names::FINAL_LENGTH,
        "depth_of_penetration_mm" => names::DEPTH,
        "residual_velocity_m_s" => names::RESIDUAL_VELOCITY,
        "ballistic_limit_m_s" => names::BALLISTIC_LIMIT,
        "target_density_kg_m3" => {
            return other_unit("target_density", "_kg_m3", "kg/m3", "kg/m3", 1.0);
        }
        "target_youngs_modulus_gpa" => {
            return other_unit("target_youngs_modulus", "_gpa", "GPa", "Pa", 1e-9);
        }
        _ => &[],
    };
    KnownColumn::of(name, aliases)
}
