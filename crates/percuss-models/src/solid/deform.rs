//! Constitutive update of a block of particles from its velocity gradients.

use super::{
    law::{Law, Pressure},
    points::MaterialPoints,
    rates::Rates,
};
use crate::{
    lanes::{LANES, Lanes, PerLane, each_of, lanes, one, settled},
    material::{LaneStrength, LaneTrial, LawVisitor, Trial, YieldPoint, plastic_increments},
    solver::equivalent,
};

/// What a step did in every particle of a block [J].
#[derive(Debug, Clone, Copy)]
pub(crate) struct Work {
    pub(crate) total: Lanes,
    pub(crate) plastic: Lanes,
    pub(crate) viscous: Lanes,
    pub(crate) failure: Lanes,
    /// Power of the stress at the start and at the end of the step, both on the strain rate of the step [W].
    pub(crate) power_at_start: Lanes,
    pub(crate) power_at_end: Lanes,
}

impl Work {
    /// That of a step that takes no time.
    pub(crate) const NONE: Self = Self {
        total: Lanes::all(0.0),
        plastic: Lanes::all(0.0),
        viscous: Lanes::all(0.0),
        failure: Lanes::all(0.0),
        power_at_start: Lanes::all(0.0),
        power_at_end: Lanes::all(0.0),
    };
}

impl Law {
    /// Brings particles, whose velocity gradients are new, to the end of a step.
    #[inline(always)]
    pub(crate) fn deform(
        &self,
        block: &mut MaterialPoints,
        rates: &Rates,
        time_step: f64,
        cell: &Lanes,
    ) -> Work {
        let Rates {
            shape: [rr, zz, rz],
            expansion,
            relaxation,
            excess,
            spin,
        } = *rates;
        let rate = |l: usize| [rr[l], zz[l], rz[l]];
        let before = block.deviator;
        let pressure_before = block.pressure;
        let volume_before = block.volume;
        let volume = lanes(|l| {
            // (1 + x/2)/(1 − x/2) is the exponential to third order and reversible.
            let half = 0.5 * time_step * (expansion[l] + relaxation[l]);
            volume_before[l] * ((1.0 + half) / (1.0 - half))
        });
        let stiffness = 2.0 * self.shear_modulus * time_step;
        let trial = each_of(|l| {
            let mut trial = turned(one(&before, l), spin[l] * time_step);
            for (entry, rate) in trial.iter_mut().zip(rate(l)) {
                *entry += stiffness * rate;
            }
            trial
        });
        let size = settled(lanes(|l| equivalent(&one(&trial, l))));
        let mut trial = settled(trial);
        let mean_volume = lanes(|l| 0.5 * (volume_before[l] + volume[l]));
        let elastic_to = block.yield_point.elastic_to();
        let (damage, present) = (block.damage, block.mass);
        let flows = settled(lanes(|l| {
            let is_elastic = (size[l] <= elastic_to[l]) | (damage[l] >= 1.0);
            let flows = (present[l] > 0.0) & !is_elastic;
            if flows { 1.0 } else { 0.0 }
        }));
        for entry in &mut trial {
            let stress = *entry;
            *entry = lanes(|l| if damage[l] >= 1.0 { 0.0 } else { stress[l] });
        }
        let mut plastic = Lanes::all(0.0);
        let mut increments = Lanes::all(0.0);
        if flows.contains(&1.0) {
            let before = lanes(|l| block.yield_point.lane(l).stress());
            increments = settled(self.flows(block, &size, &flows, time_step));
            let modulus = 3.0 * self.shear_modulus;
            // Without flow the stress stays as it is; one of 0 has no direction to return along.
            let after = lanes(|l| size[l] - modulus * increments[l]);
            for entry in &mut trial {
                let stress = *entry;
                *entry = lanes(|l| {
                    let scaled = stress[l] * (1.0 - modulus * increments[l] / size[l]);
                    if increments[l] > 0.0 {
                        scaled
                    } else {
                        stress[l]
                    }
                });
            }
            plastic = lanes(|l| {
                let mean = 0.5 * (before[l].min(after[l]) + after[l]);
                let work = mean * increments[l] * mean_volume[l];
                if increments[l] > 0.0 { work } else { 0.0 }
            });
        }
        block.deviator = trial;
        block.volume = volume;
        let viscous_before = block.viscous_pressure;
        let power_at_start = lanes(|l| {
            volume_before[l]
                * (shear_power(one(&before, l), rate(l))
                    - (pressure_before[l] + viscous_before[l]) * expansion[l])
        });
        let shear_work = lanes(|l| {
            let (before, trial) = (one(&before, l), one(&trial, l));
            let mean = [
                0.5 * (before[0] + trial[0]),
                0.5 * (before[1] + trial[1]),
                0.5 * (before[2] + trial[2]),
            ];
            mean_volume[l] * time_step * shear_power(mean, rate(l))
        });
        block.viscous_pressure = self.artificial_viscosity(block, &expansion, cell);
        let viscous_pressure = block.viscous_pressure;
        let change = lanes(|l| volume[l] - volume_before[l]);
        // What the difference from the mean pressure gives up in its decay is heat.
        let viscous = lanes(|l| {
            let decay = mean_volume[l] * time_step * relaxation[l] * excess[l];
            decay - 0.5 * (viscous_before[l] + viscous_pressure[l]) * change[l]
        });
        let volume_work = self.compress(block, &change, &lanes(|l| shear_work[l] + viscous[l]));
        let (temperature, mass) = (block.temperature, block.mass);
        block.temperature = lanes(|l| {
            let heated =
                temperature[l] + self.heating * (plastic[l] + viscous[l]) * (1.0 / mass[l]);
            // A particle that has left stays what it was.
            if mass[l] > 0.0 {
                heated
            } else {
                temperature[l]
            }
        });
        let total = lanes(|l| shear_work[l] + volume_work[l] + viscous[l]);
        if self.strength.depends_on_pressure() {
            for l in 0..LANES {
                let mut point = block.yield_point.lane(l);
                point.forget();
                block.yield_point.set_lane(l, point);
            }
        }
        let mut failure = Lanes::all(0.0);
        if self.can_fail() {
            for l in (0..LANES).filter(|&l| mass[l] > 0.0) {
                let mut particle = block.particle(l);
                failure[l] = self.fail(&mut particle, increments[l], cell[l], time_step);
                block.set_particle(l, &particle);
            }
        }
        let (deviator, pressure) = (block.deviator, block.pressure);
        let power_at_end = lanes(|l| {
            let pressure = pressure[l] + viscous_pressure[l];
            let power = shear_power(one(&deviator, l), rate(l));
            volume[l] * (power - pressure * expansion[l])
        });
        Work {
            total,
            plastic,
            viscous,
            failure,
            power_at_start,
            power_at_end,
        }
    }

    /// Returns trial stresses to the yield surface, radially, in lanes that flow, with a 1 in `flows`; gives the increments of plastic strain, 0 in others.
    #[inline(always)]
    fn flows(
        &self,
        block: &mut MaterialPoints,
        size: &Lanes,
        flows: &Lanes,
        time_step: f64,
    ) -> Lanes {
        let per_time = if self.rate_effects {
            1.0 / time_step
        } else {
            0.0
        };
        let trial = LaneTrial {
            stress: *size,
            modulus: Lanes::all(3.0 * self.shear_modulus),
            pressure_fall: Lanes::all(0.0),
            per_time: Lanes::all(per_time),
            plastic_strain: block.plastic_strain,
            temperature: block.temperature,
            pressure: block.pressure,
        };
        let increments = match self.strength.in_lanes() {
            Some(law) => law.visit(Return {
                points: &mut block.yield_point,
                trial: &trial,
                flows,
            }),
            None => self.flow_one_by_one(block, size, flows, time_step),
        };
        let strain = block.plastic_strain;
        block.plastic_strain = lanes(|l| strain[l] + increments[l]);
        increments
    }

    /// The same for a law of the caller's own.
    #[cold]
    fn flow_one_by_one(
        &self,
        block: &mut MaterialPoints,
        size: &Lanes,
        flows: &Lanes,
        time_step: f64,
    ) -> Lanes {
        let mut increments = Lanes::all(0.0);
        for l in (0..LANES).filter(|l| flows[*l] > 0.0) {
            let trial = Trial {
                stress: size[l],
                modulus: 3.0 * self.shear_modulus,
                pressure_fall: 0.0,
                elapsed: self.rate_effects.then_some(time_step),
            };
            let mut point = block.yield_point.lane(l);
            let state = block.flow_state(l);
            increments[l] = point.plastic_increment(&*self.strength, &state, &trial);
            block.yield_point.set_lane(l, point);
        }
        increments
    }

    /// Artificial viscosity [Pa].
    #[inline(always)]
    fn artificial_viscosity(
        &self,
        block: &MaterialPoints,
        expansion: &Lanes,
        cell: &Lanes,
    ) -> Lanes {
        let squared = self.wave_speed_squared(block);
        let (mass, volume) = (block.mass, block.volume);
        lanes(|l| {
            let density = mass[l] / volume[l];
            let approach = -cell[l] * expansion[l];
            let sound = squared[l].sqrt();
            let pressure = density
                * approach
                * (self.viscosity.quadratic * approach + self.viscosity.linear * sound);
            if approach > 0.0 { pressure } else { 0.0 }
        })
    }

    /// New pressure and energy; gives the work of the pressure [J].
    #[inline(always)]
    fn compress(&self, block: &mut MaterialPoints, change: &Lanes, other_work: &Lanes) -> Lanes {
        let MaterialPoints {
            mass,
            volume,
            energy,
            damage,
            pressure: before,
            ..
        } = *block;
        // A failed particle bears no tension.
        let whole = |l: usize, pressure: f64| {
            if damage[l] >= 1.0 {
                pressure.max(0.0)
            } else {
                pressure
            }
        };
        let work = |l: usize, pressure: f64| -0.5 * (before[l] + pressure) * change[l];
        let [pressure, energy, done] = match &self.pressure {
            Pressure::Linear => each_of(|l| {
                let density = mass[l] / volume[l];
                let pressure = whole(l, self.bulk_modulus * (density / self.density - 1.0));
                let work = work(l, pressure);
                let energy = energy[l] + (work + other_work[l]) * (1.0 / mass[l]);
                [pressure, energy, work]
            }),
            Pressure::MieGruneisen(state) => each_of(|l| {
                let per_mass = 1.0 / mass[l];
                // The pressure is linear in the energy, so the energy that takes half the new pressure's work is explicit.
                let (cold, slope) = state.coefficients(volume[l] * per_mass);
                let specific = change[l] * per_mass;
                let known =
                    energy[l] + other_work[l] * per_mass - 0.5 * (before[l] + cold) * specific;
                let energy = known / (1.0 + 0.5 * slope * specific);
                let pressure = whole(l, cold + slope * energy);
                [pressure, energy, work(l, pressure)]
            }),
        };
        block.pressure = pressure;
        block.energy = energy;
        done
    }
}

/// Return of the trial stresses of a block.
struct Return<'a> {
    points: &'a mut YieldPoint<Lanes>,
    trial: &'a LaneTrial<Lanes>,
    flows: &'a Lanes,
}

impl LawVisitor<f64> for Return<'_> {
    type Output = Lanes;

    #[inline(always)]
    fn visit<L>(self, law: &L) -> Lanes
    where
        L: PerLane + Copy + Default,
        L::One: LaneStrength,
    {
        plastic_increments(law, self.points, self.trial, self.flows)
    }
}

/// Power per volume of a deviator on a deviatoric rate, both `[rr, zz, rz]` [W/m3].
#[inline(always)]
fn shear_power(deviator: [f64; 3], rate: [f64; 3]) -> f64 {
    deviator[0] * (2.0 * rate[0] + rate[1])
        + deviator[1] * (2.0 * rate[1] + rate[0])
        + 2.0 * deviator[2] * rate[2]
}

/// A deviator `[rr, zz, rz]` turned by an angle, with the rotation of the midpoint rule, which is exact in its invariants.
#[inline(always)]
fn turned([rr, zz, rz]: [f64; 3], angle: f64) -> [f64; 3] {
    let half = 0.5 * angle;
    let scale = 1.0 / (1.0 + half * half);
    let (cosine, sine) = ((1.0 - half * half) * scale, 2.0 * half * scale);
    let (cc, ss, cs) = (cosine * cosine, sine * sine, cosine * sine);
    [
        cc * rr + ss * zz + 2.0 * cs * rz,
        ss * rr + cc * zz - 2.0 * cs * rz,
        (cc - ss) * rz + cs * (zz - rr),
    ]
}
