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

/// Design of the benchmark's cases.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Design {
    /// Seven pairs of materials at every L/D and velocity of the grid: the cases of the tables and figures.
    #[default]
    Grid,
    /// Other pairs, four cases of each, spread over L/D 1 to 20 and 100 to 2500 m/s.
    Spread,
}

impl Design {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Grid, Self::Spread];

    /// Its cases.
    pub fn cases(self) -> Vec<BenchmarkCase> {
        match self {
            Self::Grid => cases(),
            Self::Spread => spread(),
        }
    }
}

/// Pairs of the spread design. Ratios of strength are 0.1 to 10, of density 0.15 to 7; every strength law is in both roles.
pub const SPREAD_PAIRS: &[(&str, &str)] = &[
    ("tungsten-steinberg", "6061-t6-steinberg"),
    ("6061-t6-steinberg", "tungsten-alloy-steinberg"),
    ("tantalum-steinberg", "4340-johnson-cook"),
    ("4340-johnson-cook", "tantalum-steinberg"),
    ("7075-t6-steinberg", "ofhc-copper-steinberg"),
    ("ofhc-copper-steinberg", "7075-t651-flores-johnson"),
    ("s-7-tool-steel-johnson-cook", "2024-t4-steinberg"),
    ("2024-t4-steinberg", "s-7-tool-steel-johnson-cook"),
    ("cartridge-brass-johnson-cook", "6061-t6-lesuer"),
    ("etp-copper-johnson-cook", "aluminium-2024-t351-woodward"),
    ("copper-woodward", "copper-woodward"),
    ("aluminium-2024-t351-woodward", "copper-woodward"),
    ("ti-6al-4v-steinberg", "6061-t6-lesuer"),
    ("ti-6al-4v-static", "7075-t651-flores-johnson"),
    ("tungsten-carbide-c10", "armco-iron-johnson-cook"),
    ("armco-iron-johnson-cook", "weldox-700-e-flores-johnson"),
    ("weldox-460-e-borvik", "aluminium-2024-t351-woodward"),
    ("ofhc-copper-johnson-cook", "tool-steel-hrc53-hardness"),
    ("tool-steel-hrc53-hardness", "ofhc-copper-steinberg"),
    ("tungsten-alloy-johnson-cook", "weldox-700-e-flores-johnson"),
    ("tungsten-alloy-johnson-cook", "7075-t651-flores-johnson"),
    ("weldox-700-e-flores-johnson", "ti-6al-4v-static"),
    (
        "cartridge-brass-johnson-cook",
        "cartridge-brass-johnson-cook",
    ),
    ("armco-iron-johnson-cook", "tungsten-alloy-johnson-cook"),
    ("tantalum-steinberg", "ofhc-copper-johnson-cook"),
    ("6061-t6-lesuer", "ti-6al-4v-steinberg"),
];

/// Cases of each pair of the spread design.
const EACH: usize = 4;

/// Cases of the spread design: points of a Halton sequence in the logarithms of L/D (1 to 20) and velocity (100 to 2500 m/s), rounded.
fn spread() -> Vec<BenchmarkCase> {
    let pairs = SPREAD_PAIRS.iter().enumerate();
    let cases = pairs.flat_map(|(pair, (projectile, target))| {
        (0..EACH).map(move |k| {
            let index = EACH * pair + k + 1;
            let length_to_diameter = 20.0_f64.powf(radical_inverse(index, 3));
            let velocity = 100.0 * 25.0_f64.powf(radical_inverse(index, 2));
            BenchmarkCase {
                projectile: (*projectile).to_owned(),
                target: (*target).to_owned(),
                length_to_diameter: (10.0 * length_to_diameter).round() / 10.0,
                speed: 10.0 * (0.1 * velocity).round(),
            }
        })
    });
    cases.collect()
}

/// Digits of a number in a base, mirrored at the point: low discrepancy over 0 to 1.
fn radical_inverse(mut index: usize, base: usize) -> f64 {
    let (mut sum, mut place) = (0.0, 1.0);
    while index > 0 {
        place /= base as f64;
        sum += place * (index % base) as f64;
        index /= base;
    }
    sum
}

/// All cases of the grid, in order of rising cost.
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
