//! Cases of the benchmark: flat-ended rods on semi-infinite targets.

use percuss::{
    Error, Scenario, case as case_file,
    model_error::{
        ErrorRecord,
        design::{LENGTHS, VELOCITIES},
    },
};

/// Projectile and target, by the names of their materials.
pub const PAIRS: &[(&str, &str)] = &[
    ("copper-woodward", "aluminium-2024-t351-woodward"),
    ("ofhc-copper-johnson-cook", "6061-t6-lesuer"),
    ("4340-johnson-cook", "6061-t6-lesuer"),
    ("4340-johnson-cook", "weldox-460-e-borvik"),
    ("tungsten-alloy-steinberg", "4340-johnson-cook"),
    ("6061-t6-lesuer", "4340-johnson-cook"),
    ("armco-iron-johnson-cook", "ofhc-copper-johnson-cook"),
];

/// Diameter of all projectiles [m]. Rate-dependent strength laws cause a small size effect.
pub const DIAMETER: f64 = 5e-3;

/// Benchmark case: a flat-ended rod on a semi-infinite target.
#[derive(Debug, Clone, PartialEq)]
pub struct BenchmarkCase {
    /// Id of the projectile's material.
    pub projectile: String,
    /// Id of the target's material.
    pub target: String,
    /// Length of the projectile over its diameter.
    pub length_to_diameter: f64,
    /// Impact velocity [m/s].
    pub speed: f64,
}

impl BenchmarkCase {
    /// Whether a benchmark result is of this case.
    pub fn is_of(&self, verdict: &ErrorRecord) -> bool {
        verdict.projectile == self.projectile
            && verdict.target == self.target
            && verdict.length_to_diameter == self.length_to_diameter
            && verdict.impact_velocity_m_s == self.speed
    }

    /// Resolved case.
    ///
    /// # Errors
    /// [`Error::Input`] when the library has no such materials.
    pub fn scenario(&self) -> Result<Scenario, Error> {
        let text = format!(
            "[projectile]\nmaterial = \"{}\"\nlength = \"{} mm\"\ndiameter = \"{} mm\"\nimpact_velocity = \"{} m/s\"\n\
             [target]\nmaterial = \"{}\"\nthickness = \"semi-infinite\"\n",
            self.projectile,
            self.length_to_diameter * DIAMETER * 1e3,
            DIAMETER * 1e3,
            self.speed,
            self.target,
        );
        case_file::load_str("benchmark case", &text)
    }
}

/// All cases, in order of rising cost.
pub fn cases() -> Vec<BenchmarkCase> {
    let mut cases = Vec::new();
    for &length_to_diameter in LENGTHS {
        for &speed in VELOCITIES {
            for (projectile, target) in PAIRS {
                cases.push(BenchmarkCase {
                    projectile: (*projectile).to_owned(),
                    target: (*target).to_owned(),
                    length_to_diameter,
                    speed,
                });
            }
        }
    }
    cases
}
