//! Names that tables of tests give to quantities, beside those of the program.

/// Impact velocity.
pub const IMPACT_VELOCITY: &[&str] = &[
    "velocity",
    "speed",
    "v",
    "v0",
    "vi",
    "vs",
    "v_impact",
    "v_strike",
    "impact speed",
    "striking velocity",
    "striking speed",
    "strike velocity",
    "initial velocity",
    "incident velocity",
];

/// Residual velocity.
pub const RESIDUAL_VELOCITY: &[&str] = &[
    "vr",
    "vres",
    "v_residual",
    "residual speed",
    "exit velocity",
];

/// Ballistic limit.
pub const BALLISTIC_LIMIT: &[&str] = &[
    "v50",
    "vbl",
    "bl",
    "limit velocity",
    "ballistic limit velocity",
];

/// Final length of the projectile.
pub const FINAL_LENGTH: &[&str] = &["lf", "length after impact", "final rod length"];

/// Depth of penetration.
pub const DEPTH: &[&str] = &[
    "p",
    "dop",
    "depth",
    "depth of penetration",
    "penetration depth",
    "penetration",
];

/// Time.
pub const TIME: &[&str] = &["t"];

/// Result of a test of a ballistic limit.
pub const PERFORATED: &[&str] = &[
    "result",
    "outcome",
    "penetration",
    "perforation",
    "cp/pp",
    "pp/cp",
    "complete or partial",
];

/// Other names of a quantity of a history or of a gauge, by its name.
pub fn of_curve(quantity: &str) -> &'static [&'static str] {
    match quantity {
        "time" => TIME,
        "depth" => DEPTH,
        "contact_force" => &["force", "f", "load", "impact force"],
        "back_velocity" => &["rear face velocity", "free surface velocity"],
        "stress" => &["sigma", "σ", "axial stress"],
        "strain" => &["epsilon", "ε", "axial strain"],
        "velocity" => &["v", "particle velocity"],
        _ => &[],
    }
}
