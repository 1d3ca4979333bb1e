//! Return of moments and shear forces of a plate to its yield surface, eight rings side by side.

use super::plate_section::PlateSection;
use crate::{
    lanes::{LANES, Lanes, PerLane, any, flags, lanes, settled},
    material::{Called, FlowState, LaneStrength, LawVisitor},
};

/// Part of the moment to which the yield surface is met.
const TOLERANCE: f64 = 1e-10;
/// The same, from which a step of Newton's method meets it: its error falls with the square.
const LAST_EXCESS: f64 = 1e-6;
/// Steps of Newton's method that is kept in its bracket; far more than it needs.
const MOST_ITERATIONS: u32 = 100;

/// Eight rings whose trial moments and shear forces are beyond the yield surface.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct FlowingRings {
    /// Sum and difference of the trial moments, and the trial shear force.
    pub(super) trial: [Lanes; 3],
    /// Multiplier of normal flow: of the last flow, then of this one.
    pub(super) multiplier: Lanes,
    pub(super) plastic_strain: Lanes,
    pub(super) temperature: Lanes,
    /// 1 in lanes with a ring, or 0.
    pub(super) present: Lanes,
}

impl FlowingRings {
    /// Finds the multipliers of normal flow at which the moments meet the flow stress.
    pub(super) fn find_multipliers(&mut self, section: &PlateSection, time_step: f64) {
        let strength = &*section.strength;
        match strength.in_lanes() {
            Some(law) => law.visit(Return {
                rings: self,
                section,
                time_step,
            }),
            None => self.search(&Called(strength), section, time_step),
        }
    }

    /// Newton's method from the last multipliers, kept in brackets.
    #[inline(always)]
    fn search(&mut self, law: &impl LaneStrength, section: &PlateSection, time_step: f64) {
        let per_time = match section.rate_effects {
            true => 1.0 / time_step,
            false => 0.0,
        };
        let [sum, difference, shear] = self.trial;
        let (strain, temperature) = (self.plastic_strain, self.temperature);
        let mut thermal = Lanes::all(0.0);
        for l in 0..LANES {
            thermal[l] = law.thermal(temperature[l]);
        }
        let thermal = settled(thermal);
        let scale = settled(lanes(|l| {
            section.equivalent([sum[l], difference[l], shear[l]])
        }));
        let (mut low, mut high) = (Lanes::all(0.0), Lanes::all(f64::INFINITY));
        let mut left = MOST_ITERATIONS;
        let mut open = self.present;
        while any(&open) && left > 0 {
            left -= 1;
            let (multiplier, before) = (self.multiplier, open);
            let (mut excess, mut step) = (Lanes::all(0.0), Lanes::all(0.0));
            for l in 0..LANES {
                let trial = Trial {
                    loads: [sum[l], difference[l], shear[l]],
                    thermal: thermal[l],
                    plastic_strain: strain[l],
                    temperature: temperature[l],
                    per_time,
                };
                [excess[l], step[l]] = trial.excess(law, section, multiplier[l]);
            }
            let (excess, step) = (settled(excess), settled(step));
            let lower = settled(lanes(|l| {
                if excess[l] > 0.0 {
                    multiplier[l]
                } else {
                    low[l]
                }
            }));
            let upper = settled(lanes(|l| {
                if excess[l] > 0.0 {
                    high[l]
                } else {
                    multiplier[l]
                }
            }));
            let inside = flags(|l| {
                let newton = multiplier[l] - step[l];
                (newton > lower[l]) & (newton < upper[l])
            });
            let moves = flags(|l| (before[l] > 0.0) & (excess[l].abs() > TOLERANCE * scale[l]));
            open = flags(|l| {
                let is_last = (inside[l] > 0.0) & (excess[l].abs() <= LAST_EXCESS * scale[l]);
                (moves[l] > 0.0) & !is_last
            });
            self.multiplier = settled(lanes(|l| {
                let other = if upper[l] < f64::INFINITY {
                    0.5 * (lower[l] + upper[l])
                } else {
                    2.0 * multiplier[l]
                };
                let newton = multiplier[l] - step[l];
                let after = if inside[l] > 0.0 { newton } else { other };
                if moves[l] > 0.0 { after } else { multiplier[l] }
            }));
            (low, high) = (lower, upper);
        }
    }
}

/// A ring beyond the yield surface.
struct Trial {
    loads: [f64; 3],
    /// What its flow stress owes to its temperature.
    thermal: f64,
    plastic_strain: f64,
    temperature: f64,
    /// Strain rate per plastic strain [1/s].
    per_time: f64,
}

impl Trial {
    /// Moment beyond the yield surface after normal flow with a multiplier, and the step of Newton's method from there.
    #[inline(always)]
    fn excess(&self, law: &impl LaneStrength, section: &PlateSection, multiplier: f64) -> [f64; 2] {
        let returned = section.returned(self.loads, multiplier);
        let moment = section.equivalent(returned);
        let moment_slope = section.slope_of_equivalent(returned, multiplier, moment);
        let increment = section.strain(multiplier, moment);
        let state = FlowState {
            plastic_strain: self.plastic_strain + increment,
            strain_rate: increment * self.per_time,
            temperature: self.temperature,
            pressure: 0.0,
        };
        let flow = law.flow_stress(self.thermal, &state);
        let strain_slope = section.strain(1.0, moment + multiplier * moment_slope);
        let hardening = (flow.strain_slope + flow.rate_slope * self.per_time) * strain_slope;
        let excess = moment - section.modulus() * flow.stress;
        [
            excess,
            excess / (moment_slope - section.modulus() * hardening),
        ]
    }
}

/// The search by a strength law of the library.
struct Return<'a> {
    rings: &'a mut FlowingRings,
    section: &'a PlateSection,
    time_step: f64,
}

impl LawVisitor<f64> for Return<'_> {
    type Output = ();

    #[inline(always)]
    fn visit<L>(self, law: &L)
    where
        L: PerLane + Copy + Default,
        L::One: LaneStrength,
    {
        self.rings
            .search(&law.lane(0), self.section, self.time_step);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        chain::band_law::Failure,
        material::{FlowStress, Library, PreparedStrength},
        options::ChainOptions,
    };

    /// A law whose equations are not known.
    #[derive(Debug)]
    struct Unknown(Box<dyn PreparedStrength>);

    impl PreparedStrength for Unknown {
        fn flow_stress(&self, state: &FlowState) -> FlowStress {
            self.0.flow_stress(state)
        }
    }

    fn section(material: &str) -> PlateSection {
        let material = &Library::built_in().find(material).unwrap().material;
        {
            let room = material.room_temperature.si();
            PlateSection::new(
                material,
                0.012,
                room,
                Failure::Never,
                &ChainOptions::default(),
            )
        }
    }

    /// Five rings of different loads and states.
    fn rings() -> FlowingRings {
        let mut rings = FlowingRings::default();
        for lane in 0..LANES {
            let part = 1.0 + 0.3 * lane as f64;
            rings.trial[0][lane] = 6e4 * part;
            rings.trial[1][lane] = -1e4 * part * part;
            rings.trial[2][lane] = 2e6 / part;
            rings.multiplier[lane] = 1e-3 * part;
            rings.plastic_strain[lane] = 0.02 * (part - 1.0);
            rings.temperature[lane] = 293.15 + 50.0 * part;
            rings.present[lane] = if lane < 5 { 1.0 } else { 0.0 };
        }
        rings
    }

    /// On the yield surface, whose flow stress here is asked of the law itself; what is no ring stays as it is.
    #[test]
    fn moments_return_to_the_yield_surface() {
        for material in ["weldox-460-e-borvik", "copper", "7085-t711-plate"] {
            let section = section(material);
            let (time_step, before) = (2e-8, rings());
            let mut after = before;
            after.find_multipliers(&section, time_step);
            for lane in 0..5 {
                let trial = before.trial.map(|trial| trial[lane]);
                let moment = section.equivalent(section.returned(trial, after.multiplier[lane]));
                let strain = section.strain(after.multiplier[lane], moment);
                let stress = section.strength.flow_stress(&FlowState {
                    plastic_strain: before.plastic_strain[lane] + strain,
                    strain_rate: strain / time_step,
                    temperature: before.temperature[lane],
                    pressure: 0.0,
                });
                let beyond = moment - section.modulus() * stress.stress;
                assert!(beyond.abs() < 1e-9 * section.equivalent(trial), "{beyond}");
                assert!(strain > 0.0);
            }
            for lane in 5..LANES {
                assert_eq!(after.multiplier[lane], before.multiplier[lane]);
            }
        }
    }

    #[test]
    fn a_law_that_is_called_gives_the_same_bits() {
        for material in ["weldox-460-e-borvik", "copper", "7085-t711-plate"] {
            let (known, mut unknown) = (section(material), section(material));
            unknown.strength = Box::new(Unknown(unknown.strength));
            let (mut first, mut second) = (rings(), rings());
            first.find_multipliers(&known, 2e-8);
            second.find_multipliers(&unknown, 2e-8);
            assert_eq!(first.multiplier, second.multiplier, "{material}");
        }
    }
}
