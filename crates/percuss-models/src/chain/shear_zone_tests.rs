use super::*;
use crate::material::{FlowState, FlowStress, PreparedStrength};

const YIELD: f64 = 400e6;
const RADIUS: f64 = 0.01;

/// `σ = (Y + H ε)(1 − b T)(ε̇/1 s⁻¹)^m`.
#[derive(Debug)]
struct Law {
    hardening: f64,
    softening: f64,
    sensitivity: f64,
}

impl PreparedStrength for Law {
    fn flow_stress(&self, state: &FlowState) -> FlowStress {
        let rate = state.strain_rate.max(1.0);
        let factor = (1.0 - self.softening * state.temperature) * rate.powf(self.sensitivity);
        let stress = (YIELD + self.hardening * state.plastic_strain) * factor;
        FlowStress {
            stress,
            strain_slope: self.hardening * factor,
            rate_slope: self.sensitivity * stress / rate,
        }
    }
}

const SOFTENS: Law = Law {
    hardening: 500e6,
    softening: 8e-4,
    sensitivity: 0.0,
};

fn sheared(law: &Law) -> Sheared<'_> {
    Sheared {
        strength: law,
        heating: 0.25e-6,
        temperature: 0.0,
        rate_effects: true,
    }
}

#[test]
fn the_maximum_is_where_hardening_and_softening_balance() {
    let (_, found) = sheared(&SOFTENS).zone(RADIUS, 100.0).unwrap();
    // dσ/dε = 0 where H = s (Y + H ε)², s = b × heating, as dT/dε = heating σ.
    let s: f64 = SOFTENS.softening * 0.25e-6;
    let strain = ((SOFTENS.hardening / s).sqrt() - YIELD) / SOFTENS.hardening;
    assert!((found.unwrap() - strain).abs() < 2e-3, "{found:?} {strain}");
}

/// Without hardening and heat the strain falls off as `(r/a)^(1/m)` inside and `(a/r)^(1/m)` outside.
#[test]
fn the_rate_alone_spreads_a_zone_of_known_width() {
    for m in [0.01, 0.03, 0.1] {
        let law = Law {
            hardening: 0.0,
            softening: 0.0,
            sensitivity: m,
        };
        let (zone, instability) = sheared(&law).zone(RADIUS, 100.0).unwrap();
        let exact = RADIUS * (m / (1.0 - m) + m / (1.0 + 3.0 * m));
        assert_eq!(instability, None);
        for &width in &zone.widths {
            assert!((width / exact - 1.0).abs() < 5e-3, "{m}: {width} {exact}");
        }
    }
}

/// While it hardens, a metal without rate dependence shears as equilibrium says: `τ = τ_a a/r` and `τ_a r/a`, by a fine quadrature.
#[test]
fn the_zone_before_the_maximum_is_that_of_equilibrium() {
    let metal = sheared(&SOFTENS);
    let (zone, instability) = metal.zone(RADIUS, 100.0).unwrap();
    let curve = metal.curve(0.0);
    let rim = (0.7 * instability.unwrap() / STRAIN_STEP).round() * STRAIN_STEP;
    let strain_at = |below: f64| {
        let (mut low, mut high) = (0.0, rim);
        for _ in 0..50 {
            let middle = 0.5 * (low + high);
            if curve.logarithm(middle) < curve.logarithm(rim) - below {
                low = middle;
            } else {
                high = middle;
            }
        }
        low
    };
    let count = 4000;
    let slip: f64 = (0..count)
        .map(|i| {
            let x = (f64::from(i) + 0.5) / f64::from(count);
            let outside = 2.0 * strain_at((1.0 + 2.0 * x).ln());
            let inside = strain_at(-(1.0 - x).ln()) * (1.0 - x).powi(2);
            SQRT_3 * RADIUS * (outside + inside) / f64::from(count)
        })
        .sum();
    let steps = (rim / STRAIN_STEP).round() as usize;
    let found: f64 = zone.widths[..steps]
        .iter()
        .map(|width| SQRT_3 * STRAIN_STEP * width)
        .sum();
    assert!((found / slip - 1.0).abs() < 0.01, "{found} {slip}");
}

/// Beyond the maximum strain gathers at the rim, so that the slip comes to an end whatever strain the rim bears; and all of it scales with the plug.
#[test]
fn beyond_the_maximum_the_zone_closes() {
    let law = Law {
        sensitivity: 0.01,
        ..SOFTENS
    };
    let metal = sheared(&law);
    let (zone, instability) = metal.zone(RADIUS, 100.0).unwrap();
    let at_maximum = (instability.unwrap() / STRAIN_STEP) as usize;
    assert!(zone.widths.len() > at_maximum, "{zone:?}");
    assert!(
        zone.widths[at_maximum..]
            .windows(2)
            .all(|pair| pair[1] <= pair[0])
    );
    let last = zone.widths[zone.widths.len() - 1];
    assert!((last / (NARROWEST * zone.mean_width) - 1.0).abs() < 1e-12);
    let (double, _) = metal.zone(2.0 * RADIUS, 200.0).unwrap();
    assert!((double.mean_width / zone.mean_width - 2.0).abs() < 1e-6);
}

#[test]
fn nothing_spreads_what_neither_hardens_nor_knows_a_rate() {
    let plastic = Law {
        hardening: 0.0,
        softening: 8e-4,
        sensitivity: 0.0,
    };
    assert_eq!(sheared(&plastic).zone(RADIUS, 100.0), None);
}
