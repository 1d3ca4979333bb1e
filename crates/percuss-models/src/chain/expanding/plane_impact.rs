//! Force of a plane impact: that of the first contact, before a wave from the edge of the projectile arrives.
//!
//! Behind an elastic precursor and a bulk wave the stress is `σ = Z_e u` up to the Hugoniot elastic limit and `σ_e + Z_b (u − u_e)` beyond
//! it, in both bodies, whose changes of velocity add up to the impact velocity.
//!
//! Flow stresses are slow ones at room temperature. The waves are linear, which underestimates the stress: by 5 % at 9 % of the bulk modulus (copper on aluminium at 600 m/s).

use crate::{bisection::bisected, material::Material};

/// Halvings of the interval of the interface velocity: to 1e-12 of it.
const HALVINGS: u32 = 40;

/// Largest stress over the bulk modulus at which waves are taken as linear.
const LINEAR: f64 = 0.1;

/// Stress behind a plane wave that changes the velocity by some amount.
struct PlaneWave {
    /// Impedances of the precursor and of the wave behind it [kg/(m2 s)].
    elastic: f64,
    bulk: f64,
    /// Plastic strain of a change of velocity, per velocity [s/m].
    strain: f64,
    /// Hugoniot elastic limit over the flow stress.
    limit: f64,
}

impl PlaneWave {
    fn new(material: &Material) -> Self {
        let (density, bulk) = (material.density.si(), material.bulk_modulus());
        let plane = bulk + material.shear_modulus() / 0.75;
        Self {
            elastic: (density * plane).sqrt(),
            bulk: (density * bulk).sqrt(),
            strain: (density / bulk).sqrt() / 1.5,
            limit: plane / (2.0 * material.shear_modulus()),
        }
    }

    /// Stress [Pa] of a change of velocity [m/s], with the flow stress at the plastic strain that it reaches.
    fn stress(&self, material: &Material, change: f64) -> f64 {
        let elastic = self.elastic * change;
        let Some(flow) = material.flow_stress(self.strain * change) else {
            return elastic;
        };
        let limit = self.limit * flow;
        elastic.min(limit + self.bulk * (change - limit / self.elastic))
    }
}

/// Force [N] on an area [m2] of two bodies that meet at a velocity [m/s]; `None` where the waves are not linear.
pub(super) fn force(
    projectile: &Material,
    target: &Material,
    velocity: f64,
    area: f64,
) -> Option<f64> {
    let waves = [projectile, target].map(PlaneWave::new);
    let is_below = |change: f64| {
        waves[1].stress(target, change) < waves[0].stress(projectile, velocity - change)
    };
    let stress = waves[1].stress(target, bisected(0.0, velocity, HALVINGS, is_below));
    let softer = projectile.bulk_modulus().min(target.bulk_modulus());
    (stress <= LINEAR * softer).then_some(area * stress)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn material(flow: &str, density: f64) -> Material {
        let text = format!(
            "name = 'a'\ndensity = '{density} kg/m3'\nyoungs_modulus = '70 GPa'\npoissons_ratio = 0.25\n\
             strength.perfectly_plastic = {{ flow_stress = '{flow}' }}"
        );
        toml::from_str(&text).unwrap()
    }

    #[test]
    fn equal_elastic_bodies_share_the_velocity() {
        let metal = material("100 GPa", 2700.0);
        // Plane modulus: 1.2 times Young's at a Poisson's ratio of a quarter.
        let exact = (84e9_f64 * 2700.0).sqrt() * 50.0 * 2e-6;
        assert!((force(&metal, &metal, 100.0, 2e-6).unwrap() / exact - 1.0).abs() < 1e-9);
    }

    #[test]
    fn beyond_the_elastic_limit_the_stress_grows_with_the_bulk_impedance() {
        let metal = material("280 MPa", 2700.0);
        // Limit = flow stress x (1 - v)/(1 - 2v); bulk modulus: two thirds of Young's.
        let limit = 280e6 * 1.5;
        let [elastic, bulk] = [84e9_f64, 140e9 / 3.0].map(|modulus| (modulus * 2700.0).sqrt());
        let exact = limit + bulk * (100.0 - limit / elastic);
        assert!((force(&metal, &metal, 200.0, 1.0).unwrap() / exact - 1.0).abs() < 1e-9);
        // A body of nine times the density has three times the impedance, and takes a quarter of the velocity.
        let [light, heavy] = [2700.0, 24300.0].map(|density| material("100 GPa", density));
        let exact = (84e9_f64 * 2700.0).sqrt() * 75.0;
        assert_eq!(force(&light, &heavy, 1000.0, 1.0), None);
        assert!((force(&light, &heavy, 100.0, 1.0).unwrap() / exact - 1.0).abs() < 1e-9);
    }
}
