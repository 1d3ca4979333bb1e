//! Model `lanz_odermatt`: the regression of Lanz and Odermatt for tungsten rods on steel.

use std::borrow::Cow;

use super::{deep_penetration::NOT_ONE_TARGET, long_rod::LongRod};
use crate::{
    Error, Refusal, Scenario,
    outcome::{BandQuantity, Detail, Outcome, RunResult, Termination},
    regime::TargetKind,
    solver::{Control, Model},
    units::significant,
    validity::{Measure, Outside, Range, ValidityDomain},
};

/// The regression of Lanz and Odermatt.
#[derive(Debug, Clone, Copy)]
pub struct LanzOdermatt;

/// Densities by which a tungsten alloy is recognised [kg/m3].
const TUNGSTEN: std::ops::RangeInclusive<f64> = 16_500.0..=18_500.0;
/// Densities by which a steel is recognised [kg/m3].
const STEEL: std::ops::RangeInclusive<f64> = 7600.0..=8100.0;
/// Brinell hardness that the regression covers.
const HARDNESS: std::ops::RangeInclusive<f64> = 200.0..=600.0;
/// Largest exponent of the strength term that is taken for valid: the published smallest speeds (929, 973 and 1011 m/s at a
/// hardness of 240, 270 and 300) have it in common.
const LARGEST_EXPONENT: f64 = 1.8;

/// Strength term `s = (138 − 0.100 B) B` [Pa] of a target of Brinell hardness B.
fn strength_term(hardness: f64) -> f64 {
    (138.0 - 0.1 * hardness) * hardness * 1e6
}

/// Depth over length of a rod at a speed [m/s]:
/// `P/L = 0.921 coth(0.283 + 0.0656 L/D) √(ρ_p/ρ_t) exp(−s/(ρ_p V²))` \[lanz1992\].
pub fn depth_over_length(
    length_to_diameter: f64,
    densities: (f64, f64),
    hardness: f64,
    speed: f64,
) -> f64 {
    let slenderness = (0.283 + 0.0656 * length_to_diameter).tanh().recip();
    let exponent = strength_term(hardness) / (densities.0 * speed * speed);
    0.921 * slenderness * (densities.0 / densities.1).sqrt() * (-exponent).exp()
}

/// Smallest speed for which the regression holds [m/s]: `√(s/(1.8 ρ_p))`.
pub fn smallest_speed(projectile_density: f64, hardness: f64) -> f64 {
    (strength_term(hardness) / (LARGEST_EXPONENT * projectile_density)).sqrt()
}

impl LanzOdermatt {
    fn hardness(scenario: &Scenario, rod: &LongRod<'_>) -> Option<f64> {
        scenario
            .options
            .lanz_odermatt
            .target_hardness
            .or(rod.target.brinell_hardness)
    }
}

impl Model for LanzOdermatt {
    fn name(&self) -> &'static str {
        "lanz_odermatt"
    }

    fn label(&self) -> Cow<'static, str> {
        Cow::Borrowed("Lanz–Odermatt")
    }

    fn summary(&self) -> &'static str {
        "regression of Lanz and Odermatt: tungsten rods on thick steel"
    }

    fn validity(&self) -> &'static ValidityDomain {
        const {
            &ValidityDomain {
                predicts: &[BandQuantity::DepthOfPenetration],
                targets: TargetKind::DEEP,
                ranges: &[Range {
                    measure: Measure::FlatRodLengthToDiameter,
                    min: 4.0,
                    max: f64::INFINITY,
                    outside: Outside::NotApplicable,
                    because: "the regression was made for rods of 4 diameters and more",
                }],
                sees_back_face: false,
                notes: &[
                    "tungsten alloy (recognised by a density of 16500 to 18500 kg/m3) on steel (7600 to 8100 kg/m3) of a Brinell \
                     hardness of 200 to 600, above the smallest speed of the regression",
                    "a regression: outside its data it means nothing; a rod with a nose counts as the flat-ended one of its mass",
                ],
                ..ValidityDomain::OPEN
            }
        }
    }

    fn not_applicable(&self, scenario: &Scenario) -> Option<Refusal> {
        let Some(rod) = LongRod::of(scenario) else {
            return Some(NOT_ONE_TARGET.into());
        };
        let (projectile, target) = rod.densities();
        for (what, density, range, is) in [
            ("projectile", projectile, TUNGSTEN, "a tungsten alloy"),
            ("target", target, STEEL, "steel"),
        ] {
            if !range.contains(&density) {
                return Some(Refusal::new(format!(
                    "its {what} is {is}, recognised by a density of {} to {} kg/m3, and this one has {}",
                    range.start(),
                    range.end(),
                    significant(density, 5)
                )));
            }
        }
        let Some(hardness) = Self::hardness(scenario, &rod) else {
            return Some(
                Refusal::new("the target's Brinell hardness is missing").with_remedy(
                    "give `lanz_odermatt.target_hardness`, or `brinell_hardness` of the target's material",
                ),
            );
        };
        if !HARDNESS.contains(&hardness) {
            return Some(Refusal::new(format!(
                "a Brinell hardness of {} is outside 200 to 600",
                significant(hardness, 4)
            )));
        }
        let smallest = smallest_speed(projectile, hardness);
        (rod.speed < smallest).then(|| {
            Refusal::new(format!(
                "an impact velocity of {} m/s is below the smallest one of the regression, {} m/s",
                significant(rod.speed, 4),
                significant(smallest, 4)
            ))
        })
    }

    fn run(&self, scenario: &Scenario, _: &mut Control<'_>) -> Result<RunResult, Error> {
        let refuse = |refusal: Refusal| Error::not_applicable(self.name(), refusal);
        let rod = LongRod::of(scenario).ok_or_else(|| refuse(NOT_ONE_TARGET.into()))?;
        let hardness = Self::hardness(scenario, &rod)
            .ok_or_else(|| refuse(self.not_applicable(scenario).unwrap_or_default()))?;
        let (outcome, termination) = if rod.speed == 0.0 {
            (Outcome::AtRest, Termination::NothingMoves)
        } else {
            (Outcome::ProjectileEroded, Termination::ClosedForm)
        };
        let ratio = depth_over_length(
            rod.length / rod.diameter,
            rod.densities(),
            hardness,
            rod.speed,
        );
        let mut result = RunResult::new(self.name(), "", outcome, termination);
        result.depth_of_penetration = Some(rod.length * ratio);
        result.residual_velocity = Some(0.0);
        result.details = vec![
            Detail::new("P/L", "", ratio),
            Detail::new("target hardness", "BHN", hardness),
            Detail::new(
                "smallest speed",
                "m/s",
                smallest_speed(rod.densities().0, hardness),
            ),
        ];
        result.warnings = vec![
            "a regression to cases of tungsten rods on steel: the scatter of its cases was not published where it could be read"
                .to_owned(),
        ];
        Ok(result)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{case, model};

    /// Every row of the table that goes with the regression, to the printed digit.
    #[test]
    fn the_published_table_comes_out_to_the_printed_digit() {
        let table = include_str!("../../data/lanz-odermatt.csv");
        let mut rows = 0;
        for row in table.lines().filter(|line| line.starts_with("LO-")) {
            let number =
                |column: usize| -> f64 { row.split(',').nth(column).unwrap().parse().unwrap() };
            let densities = (number(1), number(2));
            let ratio = depth_over_length(number(4), densities, number(3), number(5));
            assert_eq!(format!("{ratio:.4}"), format!("{:.4}", number(6)), "{row}");
            let smallest = smallest_speed(densities.0, number(3));
            assert_eq!(smallest.round(), number(7), "{row}");
            rows += 1;
        }
        assert_eq!(rows, 128);
    }

    #[test]
    fn what_it_does_not_cover_is_refused_with_the_key_to_add() {
        let case = |density: u32, hardness: &str, speed: u32| {
            case::load_str(
                "rod",
                &format!(
                    r#"
                    projectile = {{ material = "rod", length = "100 mm", diameter = "5 mm", impact_velocity = "{speed} m/s" }}
                    target = {{ material = "steel", thickness = "semi-infinite" }}
                    lanz_odermatt = {{ {hardness} }}
                    [materials.rod]
                    name = "rod"
                    density = "{density} kg/m3"
                    youngs_modulus = "350 GPa"
                    poissons_ratio = 0.28
                    strength.perfectly_plastic = {{ flow_stress = "1500 MPa" }}
                    [materials.steel]
                    name = "steel"
                    density = "7850 kg/m3"
                    youngs_modulus = "205 GPa"
                    poissons_ratio = 0.29
                    strength.perfectly_plastic = {{ flow_stress = "900 MPa" }}
                    "#
                ),
            )
            .unwrap()
        };
        let applicability = |scenario: &Scenario| model::applicability(&LanzOdermatt, scenario);
        assert!(applicability(&case(17600, "target_hardness = 300", 1500)).is_ok());
        let missing = applicability(&case(17600, "", 1500)).unwrap_err();
        let remedy = missing.remedy.unwrap_or_default();
        assert!(
            remedy.contains("`lanz_odermatt.target_hardness`"),
            "{remedy}"
        );
        for (refused, word) in [
            (case(7850, "target_hardness = 300", 1500), "tungsten"),
            (case(17600, "target_hardness = 150", 1500), "200 to 600"),
            (case(17600, "target_hardness = 300", 1000), "1011 m/s"),
        ] {
            let reason = applicability(&refused).unwrap_err().reason;
            assert!(reason.contains(word), "{reason}");
        }
    }
}
