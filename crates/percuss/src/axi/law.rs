//! What a body is made of, and how its particles answer to a velocity gradient.

use super::particle::{Particle, equivalent};
use crate::{
    case::ArtificialViscosity,
    fdm::StateEquation,
    material::{DamageState, FlowState, PreparedDamage, PreparedStrength, Trial, YieldPoint},
};

/// Pressure against volume and energy.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Pressure {
    /// `p = K (ρ/ρ₀ − 1)`.
    Linear,
    /// Mie–Grüneisen about the linear Hugoniot.
    MieGruneisen(StateEquation),
}

/// The constants of a body.
#[derive(Debug)]
pub(super) struct Law {
    pub(super) density: f64,
    pub(super) shear_modulus: f64,
    pub(super) bulk_modulus: f64,
    pub(super) pressure: Pressure,
    pub(super) strength: Box<dyn PreparedStrength>,
    pub(super) rate_effects: bool,
    /// Temperature rise per plastic work per mass [K kg/J]; 0 without heating.
    pub(super) heating: f64,
    pub(super) viscosity: ArtificialViscosity,
    /// Tension beyond which a particle spalls [Pa].
    pub(super) spall_strength: Option<f64>,
    /// How plastic strain uses a particle up.
    pub(super) damage: Option<PreparedDamage>,
    /// Equivalent plastic strain at which a particle fails.
    pub(super) failure_strain: Option<f64>,
    /// Whether a particle that fails leaves the body.
    pub(super) erode_failed: bool,
    /// Equivalent plastic strain at which a particle leaves the body.
    pub(super) erosion_strain: Option<f64>,
    /// Off only in plane strain, which some exact checks need.
    pub(super) axisymmetric: bool,
}

/// What a step did in a particle [J].
#[derive(Debug, Clone, Copy, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub(super) struct Work {
    pub(super) total: f64,
    pub(super) plastic: f64,
    pub(super) viscous: f64,
    pub(super) failure: f64,
    /// Power of the stress at the start and at the end of the step, both on the strain rate of the step [W].
    pub(super) power_at_start: f64,
    pub(super) power_at_end: f64,
}

impl Law {
    /// Where a particle stands that does not flow.
    pub(super) fn slow_yield_point(&self, particle: &Particle) -> YieldPoint {
        YieldPoint::slow(&*self.strength, &flow_state(particle))
    }

    /// Square of the speed of longitudinal waves [m2/s2].
    #[inline(always)]
    pub(super) fn wave_speed_squared(&self, particle: &Particle) -> f64 {
        let shear = 4.0 / 3.0 * self.shear_modulus;
        let volume = particle.volume * (1.0 / particle.mass);
        match &self.pressure {
            // dp/dρ is K/ρ₀ at any density.
            Pressure::Linear => self.bulk_modulus / self.density + shear * volume,
            Pressure::MieGruneisen(state) => {
                state.sound_speed_squared(volume, particle.pressure) + shear * volume
            }
        }
    }

    /// Brings a particle, whose velocity gradient is new, to the end of a step.
    #[inline(always)]
    pub(super) fn deform(
        &self,
        particle: &mut Particle,
        hoop_rate: f64,
        time_step: f64,
        cell: f64,
    ) -> Work {
        let ([rr, rz, zr, zz], hoop_rate) = midpoint(particle.gradient, hoop_rate, time_step);
        let expansion = rr + zz + hoop_rate;
        let before = particle.deviator;
        let pressure_before = particle.pressure;
        let volume_before = particle.volume;
        // (1 + x/2)/(1 − x/2) is the exponential to third order and reversible.
        let half = 0.5 * time_step * expansion;
        particle.volume *= (1.0 + half) / (1.0 - half);
        let third = expansion / 3.0;
        let rate = [rr - third, zz - third, 0.5 * (rz + zr)];
        let mut trial = turned(before, 0.5 * (rz - zr) * time_step);
        let stiffness = 2.0 * self.shear_modulus * time_step;
        for k in 0..3 {
            trial[k] += stiffness * rate[k];
        }
        let size = equivalent(&trial);
        let mean_volume = 0.5 * (volume_before + particle.volume);
        let mut work = Work::default();
        let mut increment = 0.0;
        if particle.has_failed() {
            trial = [0.0; 3];
        } else if !particle.yield_point.holds(size) {
            let before = particle.yield_point.stress();
            increment = self.flow(particle, &mut trial, size, time_step);
            let after = size - 3.0 * self.shear_modulus * increment;
            work.plastic = 0.5 * (before.min(after) + after) * increment * mean_volume;
        }
        particle.deviator = trial;
        work.power_at_start = volume_before
            * (shear_power(&before, &rate)
                - (pressure_before + particle.viscous_pressure) * expansion);
        let mean = std::array::from_fn(|k| 0.5 * (before[k] + trial[k]));
        let shear_work = mean_volume * time_step * shear_power(&mean, &rate);
        let per_mass = 1.0 / particle.mass;
        let density = particle.mass / particle.volume;
        let approach = -cell * expansion;
        particle.viscous_pressure = if approach > 0.0 {
            let sound = self.wave_speed_squared(particle).sqrt();
            density
                * approach
                * (self.viscosity.quadratic * approach + self.viscosity.linear * sound)
        } else {
            0.0
        };
        let change = particle.volume - volume_before;
        work.viscous = -particle.viscous_pressure * change;
        let volume_work =
            self.compress(particle, pressure_before, change, shear_work + work.viscous);
        particle.temperature += self.heating * (work.plastic + work.viscous) * per_mass;
        work.total = shear_work + volume_work + work.viscous;
        if self.strength.depends_on_pressure() {
            particle.yield_point.forget();
        }
        if !particle.has_failed() {
            self.fail(particle, increment, time_step, &mut work);
        }
        let pressure = particle.pressure + particle.viscous_pressure;
        work.power_at_end =
            particle.volume * (shear_power(&particle.deviator, &rate) - pressure * expansion);
        work
    }

    /// New pressure and energy; gives the work of the pressure [J].
    #[inline(always)]
    fn compress(&self, particle: &mut Particle, before: f64, change: f64, other_work: f64) -> f64 {
        // Divisions take long, and the compiler shares those that are alike.
        let per_mass = 1.0 / particle.mass;
        match &self.pressure {
            Pressure::Linear => {
                let density = particle.mass / particle.volume;
                particle.pressure =
                    whole(particle, self.bulk_modulus * (density / self.density - 1.0));
                let work = -0.5 * (before + particle.pressure) * change;
                particle.energy += (work + other_work) * per_mass;
                work
            }
            Pressure::MieGruneisen(state) => {
                // The pressure is linear in the energy, so the energy that takes half the new pressure's work is explicit.
                let (cold, slope) = state.coefficients(particle.volume * per_mass);
                let specific = change * per_mass;
                let known =
                    particle.energy + other_work * per_mass - 0.5 * (before + cold) * specific;
                particle.energy = known / (1.0 + 0.5 * slope * specific);
                particle.pressure = whole(particle, cold + slope * particle.energy);
                -0.5 * (before + particle.pressure) * change
            }
        }
    }

    /// Returns a trial deviator to the yield surface, radially; gives the increment of plastic strain.
    #[inline]
    fn flow(
        &self,
        particle: &mut Particle,
        deviator: &mut [f64; 3],
        size: f64,
        time_step: f64,
    ) -> f64 {
        let state = flow_state(particle);
        let trial = Trial {
            stress: size,
            modulus: 3.0 * self.shear_modulus,
            pressure_fall: 0.0,
            elapsed: self.rate_effects.then_some(time_step),
        };
        let increment = particle
            .yield_point
            .plastic_increment(&*self.strength, &state, &trial);
        let scale = 1.0 - trial.modulus * increment / size;
        for entry in deviator.iter_mut() {
            *entry *= scale;
        }
        particle.plastic_strain += increment;
        increment
    }

    /// Failure in shear and in tension: what a failed particle gives up counts as failure work.
    #[inline(always)]
    fn fail(&self, particle: &mut Particle, increment: f64, time_step: f64, work: &mut Work) {
        if let Some(law) = self.damage.filter(|_| increment > 0.0) {
            let strain_rate = if self.rate_effects {
                increment / time_step
            } else {
                0.0
            };
            let state = DamageState {
                triaxiality: -particle.pressure / particle.equivalent_stress(),
                strain_rate,
                temperature: particle.temperature,
            };
            particle.damage = law.grow(particle.damage, &state, increment);
        }
        let sheared = self
            .failure_strain
            .is_some_and(|most| particle.plastic_strain >= most);
        let torn = self
            .spall_strength
            .is_some_and(|most| particle.pressure < 0.0 && particle.largest_tension() > most);
        if !(particle.has_failed() || sheared || torn) {
            return;
        }
        let whole = self.elastic_energy(particle);
        particle.damage = 1.0;
        particle.deviator = [0.0; 3];
        particle.pressure = particle.pressure.max(0.0);
        work.failure += whole - self.elastic_energy(particle);
    }

    /// Elastic energy of a particle, for small strains [J].
    pub(super) fn elastic_energy(&self, particle: &Particle) -> f64 {
        let shear = particle.equivalent_stress();
        let per_volume = shear * shear / (6.0 * self.shear_modulus)
            + particle.pressure * particle.pressure / (2.0 * self.bulk_modulus);
        per_volume * particle.volume
    }

    /// Whether a particle is to leave its body.
    #[inline(always)]
    pub(super) fn erodes(&self, particle: &Particle) -> bool {
        (self.erode_failed && particle.has_failed())
            || self
                .erosion_strain
                .is_some_and(|most| particle.plastic_strain >= most)
    }
}

/// A pressure that the particle can bear: no tension when it has failed.
#[inline(always)]
fn whole(particle: &Particle, pressure: f64) -> f64 {
    if particle.has_failed() {
        pressure.max(0.0)
    } else {
        pressure
    }
}

impl Particle {
    /// Largest principal stress [Pa].
    fn largest_tension(&self) -> f64 {
        let [rr, zz, rz] = self.deviator;
        let in_plane = 0.5 * (rr + zz) + (0.25 * (rr - zz) * (rr - zz) + rz * rz).sqrt();
        in_plane.max(self.hoop_deviator()) - self.pressure
    }
}

fn flow_state(particle: &Particle) -> FlowState {
    FlowState {
        plastic_strain: particle.plastic_strain,
        strain_rate: 0.0,
        temperature: particle.temperature,
        pressure: particle.pressure,
    }
}

/// The velocity gradient on the configuration half a step on, `C (1 + C Δt/2)⁻¹`, and so the hoop rate.
///
/// Particles move by the velocities at the start of the step, which the gradient C belongs to: on the mean configuration it gives
/// their change of shape to second order, and that of a turning body, which straight ways make larger, too.
#[inline(always)]
fn midpoint([rr, rz, zr, zz]: [f64; 4], hoop_rate: f64, time_step: f64) -> ([f64; 4], f64) {
    let half = 0.5 * time_step;
    let product = half * (rr * zz - rz * zr);
    let scale = 1.0 / (1.0 + half * (rr + zz + product));
    (
        [
            (rr + product) * scale,
            rz * scale,
            zr * scale,
            (zz + product) * scale,
        ],
        hoop_rate / (1.0 + half * hoop_rate),
    )
}

/// Power per volume of a deviator on a deviatoric rate, both `[rr, zz, rz]` [W/m3].
#[inline(always)]
fn shear_power(deviator: &[f64; 3], rate: &[f64; 3]) -> f64 {
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
