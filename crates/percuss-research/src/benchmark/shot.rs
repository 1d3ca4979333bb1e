//! Shots of the benchmark: flat-ended rods on semi-infinite targets.

use percuss::{
    Error, Scenario, case,
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

/// Diameter of all projectiles [m]. Laws with a rate effect make the answer depend on it a little.
pub const DIAMETER: f64 = 5e-3;

/// A shot of the design: a flat-ended rod on a semi-infinite target.
#[derive(Debug, Clone, PartialEq)]
pub struct Shot {
    /// Id of the projectile's material.
    pub projectile: String,
    /// Id of the target's material.
    pub target: String,
    /// Length of the projectile over its diameter.
    pub length_to_diameter: f64,
    /// Impact speed [m/s].
    pub speed: f64,
}

impl Shot {
    /// Whether a benchmark result is of this shot.
    pub fn is_of(&self, verdict: &ErrorRecord) -> bool {
        verdict.projectile == self.projectile
            && verdict.target == self.target
            && verdict.length_to_diameter == self.length_to_diameter
            && verdict.impact_velocity_m_s == self.speed
    }

    /// The shot as a case.
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
        case::load_str("shot of the design", &text)
    }
}

/// All shots, the cheapest first.
pub fn shots() -> Vec<Shot> {
    let mut shots = Vec::new();
    for &length_to_diameter in LENGTHS {
        for &speed in VELOCITIES {
            for (projectile, target) in PAIRS {
                shots.push(Shot {
                    projectile: (*projectile).to_owned(),
                    target: (*target).to_owned(),
                    length_to_diameter,
                    speed,
                });
            }
        }
    }
    shots
}
