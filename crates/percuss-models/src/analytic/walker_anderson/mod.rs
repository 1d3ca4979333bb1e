//! Model `walker_anderson`: the long rod of Walker and Anderson, followed in time from the impact shock to rest.

mod flow;
mod motion;
#[cfg(test)]
mod tests;

use std::borrow::Cow;

use flow::Flow;
use motion::Motion;

use super::{
    long_rod::{LongRod, at_rest, rests_on, sharp_and_rigid, strength},
    tate::LONG_ROD,
};
use crate::{
    Error, Refusal, Scenario,
    material::Material,
    outcome::{BandQuantity, Detail, RunResult},
    regime::{ProjectileRegime, TargetKind},
    solver::{Control, Model},
    units::{Length, significant},
    validity::ValidityDomain,
};

/// The long rod of Walker and Anderson.
#[derive(Debug, Clone, Copy)]
pub struct WalkerAnderson;

/// Slope of shock speed against particle speed where a material has none: metals have 1.2 to 1.7.
const TYPICAL_SLOPE: f64 = 1.5;

/// Crater radius over the rod's at an impact velocity [m/s], a fit to steel targets \[walker1995\].
fn crater_ratio(speed: f64) -> f64 {
    1.0 + 2.87e-4 * speed + 1.48e-7 * speed * speed
}

/// Bulk sound speed [m/s] and slope of a material, and whether they had to be estimated.
fn shock(material: &Material) -> (f64, f64, bool) {
    let state = material.equation_of_state.as_ref();
    let slope = state.map_or(TYPICAL_SLOPE, |state| state.slope);
    (material.bulk_sound_speed(), slope, state.is_none())
}

impl WalkerAnderson {
    /// The rod, what it does, and warnings on what had to be estimated.
    fn motion<'a>(scenario: &'a Scenario) -> Result<(LongRod<'a>, Motion, Vec<String>), Refusal> {
        let rod = LongRod::to_integrate(scenario)?;
        let options = &scenario.options.walker_anderson;
        let (density, target_density) = rod.densities();
        let mut warnings = Vec::new();
        let mut shock_of = |material: &Material, what: &str| {
            let (sound_speed, slope, estimated) = shock(material);
            if estimated {
                warnings.push(format!(
                    "the {what}'s material has no `equation_of_state`: bulk sound speed {} m/s from its elastic constants, \
                     slope {TYPICAL_SLOPE} assumed",
                    significant(sound_speed, 4)
                ));
            }
            (sound_speed, slope)
        };
        let (sound_speed, slope) = shock_of(rod.projectile, "projectile");
        let (target_sound_speed, target_slope) = shock_of(rod.target, "target");
        let own = |given, material, what, key| strength(given, material, what, key);
        let motion = Motion {
            density,
            strength: own(
                options.projectile_strength,
                rod.projectile,
                "projectile",
                "walker_anderson.projectile_strength",
            )?,
            bar_speed: rod.projectile.bar_wave_speed(),
            sound_speed,
            slope,
            target: Flow {
                density: target_density,
                shear_modulus: rod.target.shear_modulus(),
                strength: own(
                    options.target_strength,
                    rod.target,
                    "target",
                    "walker_anderson.target_strength",
                )?,
                sound_speed: target_sound_speed,
                slope: target_slope,
            },
            crater_radius: options
                .crater_radius
                .map_or(0.5 * rod.diameter * crater_ratio(rod.speed), Length::si),
        };
        if motion.target.strength >= 2.0 * motion.target.shear_modulus {
            return Err("the target's strength is beyond twice its shear modulus".into());
        }
        if rod.speed > 0.0 {
            let tip = motion.tip_speed_at_impact(rod.speed);
            let limit = target_sound_speed + target_slope * tip;
            if tip >= limit {
                return Err(Refusal::new(format!(
                    "the tip would move at {} m/s, faster than the target's shock at {} m/s: the flow of the target is not the \
                     model's",
                    significant(tip, 4),
                    significant(limit, 4)
                )));
            }
            if motion.plastic_length(rod.speed, tip) >= rod.length {
                return Err(
                    Refusal::new("the plastic zone at impact is longer than the rod").with_remedy(
                        "give a longer rod or a smaller `walker_anderson.crater_radius`",
                    ),
                );
            }
        }
        Ok((rod, motion, warnings))
    }
}

impl Model for WalkerAnderson {
    fn name(&self) -> &'static str {
        "walker_anderson"
    }

    fn label(&self) -> Cow<'static, str> {
        Cow::Borrowed("Walker–Anderson")
    }

    fn summary(&self) -> &'static str {
        "long rod of Walker and Anderson: in time from the impact shock to rest, eroding or rigid"
    }

    fn validity(&self) -> &'static ValidityDomain {
        const {
            &ValidityDomain {
                predicts: &[
                    BandQuantity::DepthOfPenetration,
                    BandQuantity::ProjectileFinalLength,
                ],
                projectile: &[ProjectileRegime::Eroding, ProjectileRegime::Rigid],
                targets: TargetKind::DEEP,
                ranges: LONG_ROD,
                sees_back_face: false,
                notes: &[
                    "normal impact; the shape of the nose is left out: a rod with a nose counts as the flat-ended one of its mass",
                    "the radius of the crater is an input: when not given it comes from a fit to steel targets",
                ],
                ..ValidityDomain::OPEN
            }
        }
    }

    fn not_applicable(&self, scenario: &Scenario) -> Option<Refusal> {
        sharp_and_rigid(scenario).or_else(|| Self::motion(scenario).err())
    }

    fn run(&self, scenario: &Scenario, _: &mut Control<'_>) -> Result<RunResult, Error> {
        let (rod, motion, mut warnings) = Self::motion(scenario)
            .map_err(|refusal| Error::not_applicable(self.name(), refusal))?;
        if rod.speed == 0.0 {
            let mut result = at_rest(self.name(), "", &rod, (0.0, rod.length));
            rod.set_final(scenario, rod.length, &mut result);
            return Ok(result);
        }
        let stop = motion.penetrate(rod.speed, rod.length)?;
        let mut result = at_rest(self.name(), "", &rod, (stop.depth, stop.length));
        rod.set_final(scenario, stop.length, &mut result);
        result.time_to_rest = Some(stop.time);
        result.end_time = Some(stop.time);
        let tip = motion.tip_speed_at_impact(rod.speed);
        let alpha = motion.target.extent(tip).alpha;
        result.details = vec![
            Detail::new("projectile strength", "MPa", motion.strength * 1e-6),
            Detail::new("target strength", "MPa", motion.target.strength * 1e-6),
            Detail::new("crater radius", "mm", motion.crater_radius * 1e3),
            Detail::new("tip speed at impact", "m/s", tip),
            Detail::new("extent of the plastic zone at impact", "", alpha),
            Detail::new(
                "target resistance at impact",
                "MPa",
                motion.target.resistance(alpha) * 1e-6,
            ),
            Detail::new(
                "tip speed at the end of erosion",
                "m/s",
                stop.hand_over_speed,
            ),
            Detail::new("depth made rigid", "mm", stop.rigid_depth * 1e3),
        ];
        warnings.push(rests_on(
            motion.strength,
            motion.target.resistance(alpha),
            "which changes as the tip slows; the strengths are `walker_anderson.projectile_strength` and \
             `walker_anderson.target_strength`, flow stresses at a plastic strain of 0.1 when not given",
        ));
        if scenario.options.walker_anderson.crater_radius.is_none() {
            warnings.push(
                "the radius of the crater comes from a fit to steel targets: `walker_anderson.crater_radius` replaces it"
                    .to_owned(),
            );
        }
        result.warnings = warnings;
        Ok(result)
    }
}
