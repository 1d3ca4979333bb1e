//! Equations of state that are linear in the energy, and the Hugoniot.

use super::Material;

/// Compression `s η` at which the linear Hugoniot is taken to have run out: it is singular at 1.
const LARGEST_COMPRESSION: f64 = 0.95;

/// Equation of state `p = a(V) + b(V) e`, V and e per mass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StateEquation {
    /// Mie–Grüneisen about the Hugoniot `U_s = c₀ + s u_p`, `Γρ` constant; linear elastic in expansion.
    MieGruneisen {
        /// Density at rest ρ₀ [kg/m3].
        density: f64,
        /// Bulk sound speed c₀ [m/s].
        sound_speed: f64,
        /// Slope s.
        slope: f64,
        /// Grüneisen's parameter Γ₀ at rest.
        gruneisen: f64,
    },
    /// `p = (γ − 1) ρ e`.
    IdealGas {
        /// Ratio of specific heats γ.
        gamma: f64,
    },
}

impl StateEquation {
    /// The Mie–Grüneisen equation of a material, if its record has one.
    pub fn of(material: &Material) -> Option<Self> {
        let eos = material.equation_of_state.as_ref()?;
        Some(Self::MieGruneisen {
            density: material.density.si(),
            sound_speed: eos.sound_speed.si(),
            slope: eos.slope,
            gruneisen: eos.gruneisen,
        })
    }

    /// `a` [Pa] and `b` [kg/m3] at a specific volume [m3/kg].
    #[inline(always)]
    pub fn coefficients(&self, volume: f64) -> (f64, f64) {
        match *self {
            Self::MieGruneisen {
                density, gruneisen, ..
            } => {
                let compression = 1.0 - density * volume;
                let (pressure, _) = self.hugoniot(compression);
                let factor = 1.0 - 0.5 * gruneisen * compression;
                (pressure * factor, gruneisen * density)
            }
            Self::IdealGas { gamma } => (0.0, (gamma - 1.0) / volume),
        }
    }

    /// Pressure [Pa] at a specific volume [m3/kg] and energy [J/kg].
    pub fn pressure(&self, volume: f64, energy: f64) -> f64 {
        let (cold, slope) = self.coefficients(volume);
        cold + slope * energy
    }

    /// Square of the isentropic bulk sound speed [m2/s2]: `c² = V² (−∂p/∂V + p ∂p/∂e)`; 0 where it would be negative.
    #[inline(always)]
    pub fn sound_speed_squared(&self, volume: f64, pressure: f64) -> f64 {
        let squared = match *self {
            Self::MieGruneisen {
                density, gruneisen, ..
            } => {
                let compression = 1.0 - density * volume;
                let (reference, slope) = self.hugoniot(compression);
                let stiffness = density
                    * (slope * (1.0 - 0.5 * gruneisen * compression) - 0.5 * gruneisen * reference);
                volume * volume * (stiffness + gruneisen * density * pressure)
            }
            Self::IdealGas { gamma } => gamma * pressure * volume,
        };
        squared.max(0.0)
    }

    /// Whether the equation reaches as far as a specific volume.
    pub fn reaches(&self, volume: f64) -> bool {
        match *self {
            Self::MieGruneisen { density, slope, .. } => {
                slope * (1.0 - density * volume) < LARGEST_COMPRESSION
            }
            Self::IdealGas { .. } => volume > 0.0,
        }
    }

    /// Pressure on the Hugoniot at a compression `η = 1 − ρ₀ V`, and its slope [Pa].
    #[inline(always)]
    fn hugoniot(&self, compression: f64) -> (f64, f64) {
        let Self::MieGruneisen {
            density,
            sound_speed,
            slope,
            ..
        } = *self
        else {
            return (0.0, 0.0);
        };
        let bulk = density * sound_speed * sound_speed;
        if compression <= 0.0 {
            return (bulk * compression, bulk);
        }
        let rest = 1.0 - slope * compression;
        (
            bulk * compression / (rest * rest),
            bulk * (1.0 + slope * compression) / rest.powi(3),
        )
    }

    /// Speed of a shock with a particle speed [m/s], `c₀ + s u`; `None` for a gas.
    pub fn shock_speed(&self, particle_speed: f64) -> Option<f64> {
        match *self {
            Self::MieGruneisen {
                sound_speed, slope, ..
            } => Some(sound_speed + slope * particle_speed),
            Self::IdealGas { .. } => None,
        }
    }

    /// Grüneisen's coefficient over volume, `Γ ρ` [kg/m3].
    pub fn heating_by_compression(&self, volume: f64) -> f64 {
        self.coefficients(volume).1
    }
}

/// Particle speed [m/s] and pressure [Pa] behind the shocks of an impact, strength left out: `p₁(V − u) = p₂(u)` with
/// `p(u) = ρ₀ (c₀ + s u) u`. `None` for the target is a rigid wall.
pub fn impedance_match(
    projectile: &Material,
    target: Option<&Material>,
    velocity: f64,
) -> Option<(f64, f64)> {
    let line = |material: &Material| {
        let eos = material.equation_of_state.as_ref()?;
        let density = material.density.si();
        Some((density * eos.sound_speed.si(), density * eos.slope))
    };
    let (linear, quadratic) = line(projectile)?;
    let pressure = |u: f64| (linear + quadratic * u) * u;
    let Some(target) = target else {
        return Some((0.0, pressure(velocity)));
    };
    let (target_linear, target_quadratic) = line(target)?;
    // b u² + a u = B (V − u)² + A (V − u), written as p u² + q u = r.
    let p = target_quadratic - quadratic;
    let q = target_linear + linear + 2.0 * quadratic * velocity;
    let r = (linear + quadratic * velocity) * velocity;
    let root = (q * q + 4.0 * p * r).sqrt();
    let u = 2.0 * r / (q + root);
    Some((u, (target_linear + target_quadratic * u) * u))
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALUMINIUM: StateEquation = StateEquation::MieGruneisen {
        density: 2790.0,
        sound_speed: 5330.0,
        slope: 1.34,
        gruneisen: 2.0,
    };

    /// Along the Hugoniot `e = ½ p (V₀ − V)`, so the equation must give back `p = ρ₀ U_s u_p`.
    #[test]
    fn the_hugoniot_lies_on_the_surface() {
        for u in [50.0, 500.0, 2000.0] {
            let shock = 5330.0 + 1.34 * u;
            let pressure = 2790.0 * shock * u;
            let volume = (1.0 - u / shock) / 2790.0;
            let energy = 0.5 * u * u;
            let found = ALUMINIUM.pressure(volume, energy);
            assert!((found / pressure - 1.0).abs() < 1e-12, "{found} {pressure}");
        }
    }

    /// The sound speed is the slope of the isentrope, followed here in small steps.
    #[test]
    fn the_sound_speed_is_the_slope_of_the_isentrope() {
        for equation in [ALUMINIUM, StateEquation::IdealGas { gamma: 1.4 }] {
            let (volume, energy) = (1.0 / 3100.0, 3e6);
            let pressure = equation.pressure(volume, energy);
            let step = 1e-6 * volume;
            let compressed = equation.pressure(volume - step, energy + pressure * step);
            let expanded = equation.pressure(volume + step, energy - pressure * step);
            let slope = volume * volume * (compressed - expanded) / (2.0 * step);
            let squared = equation.sound_speed_squared(volume, pressure);
            assert!((squared / slope - 1.0).abs() < 1e-6, "{squared} {slope}");
        }
        let at_rest = ALUMINIUM.sound_speed_squared(1.0 / 2790.0, 0.0);
        assert!((at_rest.sqrt() / 5330.0 - 1.0).abs() < 1e-12);
    }
}
