//! Numbers of the records and their laws against those of the sources.

use super::*;

const K: f64 = 1e3;

fn find(name: &str) -> &'static Material {
    let entry = Library::built_in().find(name);
    &entry
        .unwrap_or_else(|| panic!("no material {name}"))
        .material
}

fn prepared(name: &str) -> Box<dyn PreparedStrength> {
    let material = find(name);
    material.strength.law().prepare(material, 1.0)
}

fn state(plastic_strain: f64, strain_rate: f64, temperature: f64, pressure: f64) -> FlowState {
    FlowState {
        plastic_strain,
        strain_rate,
        temperature,
        pressure,
    }
}

fn assert_close(found: f64, expected: f64, tolerance: f64, what: &str) {
    assert!(
        (found - expected).abs() <= tolerance * expected.abs(),
        "{what}: {found} instead of {expected}"
    );
}

/// Elastic constants against the shear and bulk moduli of the sources [GPa].
#[test]
fn elastic_constants_follow_from_the_moduli_of_the_source() {
    let moduli = [
        ("ofhc-copper-johnson-cook", 46.0, 129.0),
        ("6061-t6-lesuer", 26.0, 66.4),
        ("4340-johnson-cook", 80.0, 173.33),
        ("armco-iron-johnson-cook", 80.0, 164.0),
        ("s-7-tool-steel-johnson-cook", 77.0, 159.0),
        ("etp-copper-johnson-cook", 45.45, 136.35),
        ("tungsten-alloy-johnson-cook", 124.0, 268.7),
        ("ofhc-copper-steinberg", 47.7, 8930.0 * 3.94f64.powi(2) / K),
        ("6061-t6-steinberg", 27.6, 2703.0 * 5.24f64.powi(2) / K),
        ("2024-t4-steinberg", 28.6, 2785.0 * 5.328f64.powi(2) / K),
        ("7075-t6-steinberg", 26.7, 2803.0 * 5.2f64.powi(2) / K),
        ("tantalum-steinberg", 69.0, 16690.0 * 3.41f64.powi(2) / K),
        ("tungsten-steinberg", 160.0, 19300.0 * 4.03f64.powi(2) / K),
        (
            "tungsten-alloy-steinberg",
            145.0,
            18167.0 * 4.03f64.powi(2) / K,
        ),
        ("ti-6al-4v-steinberg", 41.9, 4419.0 * 5.13f64.powi(2) / K),
    ];
    for (id, shear, bulk) in moduli {
        let material = find(id);
        assert_close(material.shear_modulus() / 1e9, shear, 2e-3, id);
        // The bulk modulus magnifies the rounding of Poisson's ratio to three digits.
        assert_close(material.bulk_modulus() / 1e9, bulk, 6e-3, id);
    }
}

/// Flow stresses computed by hand from the published constants [MPa].
#[test]
fn laws_give_the_published_numbers() {
    let cases = [
        // (90 + 292·0.3^0.31)(1 + 0.025 ln 1000)
        (
            "ofhc-copper-johnson-cook",
            state(0.3, 1e3, 294.0, 0.0),
            341.305,
        ),
        // The same, 206 K above room temperature: times 1 − (206/1062)^1.09
        (
            "ofhc-copper-johnson-cook",
            state(0.3, 1e3, 500.0, 0.0),
            284.186,
        ),
        // (792 + 510·0.1^0.26)(1 + 0.014 ln 1e4)
        ("4340-johnson-cook", state(0.1, 1e4, 298.0, 0.0), 1210.529),
        // (324 + 114·0.2^0.42), slower than the reference rate
        ("6061-t6-lesuer", state(0.2, 1e-3, 294.0, 0.0), 381.988),
        // (819 + 308·0.1^0.64)(1 + 2e6)^0.0098
        (
            "weldox-700-e-flores-johnson",
            state(0.1, 1e3, 293.0, 0.0),
            1025.474,
        ),
        // 290 (1 + 125·0.1)^0.1 at 300 K
        ("6061-t6-steinberg", state(0.1, 1e6, 300.0, 0.0), 376.211),
        // The same, at 2 GPa and 500 K: times 1 + 0.0652·2 − 6.16e-4·200
        ("6061-t6-steinberg", state(0.1, 1e6, 500.0, 2e9), 378.920),
        // Beyond the largest work-hardened yield stress
        ("ofhc-copper-steinberg", state(5.0, 1e6, 300.0, 0.0), 640.0),
        ("ti-6al-4v-static", state(0.5, 1e6, 900.0, 0.0), 880.0),
        // 443·(ε_y + 0.2)^0.1 with ε_y = (443/114000)^(1/0.9) = 0.0020973
        ("copper-woodward", state(0.2, 0.0, 293.0, 0.0), 377.537),
    ];
    for (id, state, expected) in cases {
        let stress = prepared(id).flow_stress(&state).stress / 1e6;
        assert_close(stress, expected, 2e-5, id);
    }
}

#[test]
fn johnson_cook_has_no_strength_when_molten() {
    for entry in built_in() {
        let material = &entry.material;
        if let (Strength::JohnsonCook(_), Some(melting)) =
            (&material.strength, material.melting_temperature)
        {
            let law = material.strength.law().prepare(material, 1.0);
            for temperature in [melting.si(), 2.0 * melting.si()] {
                let flow = law.flow_stress(&state(0.2, 1e3, temperature, 0.0));
                assert_eq!(flow.stress, 0.0, "{}", entry.id);
            }
        }
    }
}

#[test]
fn steinberg_stays_below_its_cap() {
    for entry in built_in() {
        let Strength::SteinbergGuinan(law) = &entry.material.strength else {
            continue;
        };
        let prepared = law.prepare(&entry.material, 1.0);
        let flow = prepared.flow_stress(&state(1e6, 1e6, 300.0, 0.0));
        assert_eq!(flow.stress, law.y_max.si(), "{}", entry.id);
        assert_eq!(flow.strain_slope, 0.0, "{}", entry.id);
    }
}

#[test]
fn a_power_law_starts_on_the_elastic_line() {
    let mut count = 0;
    for entry in built_in() {
        let Strength::PowerLaw(law) = &entry.material.strength else {
            continue;
        };
        count += 1;
        let modulus = entry.material.youngs_modulus.si();
        for factor in [1.0, 2.7] {
            let start = law
                .prepare(&entry.material, factor)
                .flow_stress(&state(0.0, 0.0, 293.0, 0.0));
            let elastic = modulus * law.yield_strain(modulus, factor);
            assert_close(start.stress, elastic, 1e-12, &entry.id);
        }
        // Plates whose curve was made to begin at the published yield stress.
        if entry.origin == "ryan2023.toml"
            && let Some(published) = entry.material.yield_stress
        {
            let start = modulus * law.yield_strain(modulus, 1.0);
            assert_close(start, published.si(), 1e-5, &entry.id);
        }
    }
    assert_eq!(count, 20);
}

#[test]
fn slopes_are_the_derivatives_of_the_stress() {
    let step = 1e-5;
    for entry in built_in() {
        let material = &entry.material;
        // An elastic solid has no flow stress.
        if matches!(material.strength, Strength::Elastic(_)) {
            continue;
        }
        let law = material.strength.law().prepare(material, 1.3);
        for strain in [0.003, 0.05, 0.4, 3.0] {
            // Below and above the reference rates, away from the kink at them.
            for rate in [1e-6, 0.3, 20.0, 1e4] {
                for (heat, pressure) in [(10.0, 0.0), (250.0, 3e9)] {
                    let at = |strain: f64, rate: f64| {
                        let temperature = material.room_temperature.si() + heat;
                        law.flow_stress(&state(strain, rate, temperature, pressure))
                    };
                    let flow = at(strain, rate);
                    let difference = |high: FlowStress, low: FlowStress, width: f64| {
                        (high.stress - low.stress) / width
                    };
                    let (de, dr) = (step * strain, step * rate);
                    let by_strain =
                        difference(at(strain + de, rate), at(strain - de, rate), 2.0 * de);
                    let by_rate =
                        difference(at(strain, rate + dr), at(strain, rate - dr), 2.0 * dr);
                    // What rounding of the stress leaves of a difference.
                    let noise = 1e-15 * flow.stress;
                    let what = format!("{} at {strain}, {rate} 1/s, +{heat} K", entry.id);
                    assert!(
                        (flow.strain_slope - by_strain).abs()
                            <= 1e-7 * by_strain.abs() + noise / de,
                        "{what}: strain slope {} instead of {by_strain}",
                        flow.strain_slope
                    );
                    assert!(
                        (flow.rate_slope - by_rate).abs() <= 1e-7 * by_rate.abs() + noise / dr,
                        "{what}: rate slope {} instead of {by_rate}",
                        flow.rate_slope
                    );
                }
            }
        }
    }
}
