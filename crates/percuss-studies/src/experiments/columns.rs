//! Columns of a file of tests.

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
    required("id", "a name that no other test has"),
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
