use super::*;
use crate::{check::Diagnostic, material::Library};

fn metal(damage: &str) -> Material {
    toml::from_str(&format!(
        "name = 'a'\ndensity = '7830 kg/m3'\nyoungs_modulus = '208 GPa'\npoissons_ratio = 0.3\n\
         melting_temperature = '1793 K'\nroom_temperature = '298 K'\n\
         strength.perfectly_plastic = {{ flow_stress = '800 MPa' }}\ndamage = {{ {damage} }}"
    ))
    .unwrap()
}

fn prepared(damage: &str) -> PreparedDamage {
    let metal = metal(damage);
    metal.damage.as_ref().unwrap().prepare(&metal)
}

fn slow(triaxiality: f64) -> DamageState {
    DamageState {
        triaxiality,
        strain_rate: 0.0,
        temperature: 298.0,
    }
}

fn assert_close(found: f64, expected: f64) {
    assert!(
        (found / expected - 1.0).abs() < 1e-12,
        "{found} instead of {expected}"
    );
}

#[test]
fn the_failure_strain_is_that_of_the_formula() {
    let law = prepared("d1 = 0.05, d2 = 3.44, d3 = -2.12, d4 = 0.002, d5 = 0.61");
    // In shear, in tension of a bar, and in compression of one: σ* = 0, 1/3, −1/3.
    assert_close(law.failure_strain(&slow(0.0)), 3.49);
    let third = 1.0 / 3.0;
    assert_close(
        law.failure_strain(&slow(third)),
        0.05 + 3.44 * (-2.12_f64 / 3.0).exp(),
    );
    assert_close(
        law.failure_strain(&slow(-third)),
        0.05 + 3.44 * (2.12_f64 / 3.0).exp(),
    );
    // Fast and half way from room temperature to melting.
    let fast = DamageState {
        triaxiality: third,
        strain_rate: 1e4,
        temperature: 0.5 * (298.0 + 1793.0),
    };
    assert_close(
        law.failure_strain(&fast),
        (0.05 + 3.44 * (-2.12_f64 / 3.0).exp()) * (1.0 + 0.002 * 1e4_f64.ln()) * 1.305,
    );
    // Below the reference rate and below room temperature nothing changes; beyond melting nothing more does.
    let (cold, molten, beyond) = (200.0, 1793.0, 3000.0);
    let at = |temperature| {
        law.failure_strain(&DamageState {
            temperature,
            strain_rate: 0.5,
            ..slow(0.0)
        })
    };
    assert_close(at(cold), 3.49);
    assert_close(at(molten), 3.49 * 1.61);
    assert_close(at(beyond), at(molten));
}

#[test]
fn the_rate_factor_can_be_a_power() {
    let law = prepared(
        "d1 = 0.0705, d2 = 1.732, d3 = -0.54, d4 = -0.015, reference_rate = '5e-4 1/s', rate_form = 'power'",
    );
    let state = DamageState {
        strain_rate: 1e4,
        ..slow(0.0)
    };
    assert_close(
        law.failure_strain(&state),
        1.8025 * (1.0 + 2e7_f64).powf(-0.015),
    );
}

#[test]
fn damage_in_one_state_is_the_part_of_the_failure_strain_and_parts_add_up() {
    let law = prepared("d1 = 0.54, d2 = 4.89, d3 = -3.03");
    let (shear, tension) = (slow(0.0), slow(1.0));
    let mut damage = 0.0;
    for _ in 0..100 {
        damage = law.grow(damage, &shear, 0.01 * 0.25 * 5.43);
    }
    assert!((damage - 0.25).abs() < 1e-12);
    // The rest in another state: 3/4 of that failure strain leaves it just whole, a little more fails it.
    let rest = 0.75 * (0.54 + 4.89 * (-3.03_f64).exp());
    assert!(law.grow(damage, &tension, 0.999 * rest) < 1.0);
    assert_eq!(law.grow(damage, &tension, 1.001 * rest), 1.0);
    assert_eq!(law.grow(damage, &tension, 0.0), damage);
}

#[test]
fn where_the_formula_leaves_no_strain_the_first_flow_fails() {
    let law = prepared("d1 = -0.77, d2 = 1.45, d3 = -0.47, d5 = 1.6");
    let triaxial = slow(1.4);
    assert_eq!(law.failure_strain(&triaxial), 0.0);
    assert_eq!(law.grow(0.0, &triaxial, 1e-12), 1.0);
    assert_eq!(law.grow(0.2, &triaxial, 0.0), 0.2);
    // Compression without end takes no part of it.
    assert_eq!(law.grow(0.2, &slow(-1e9), 0.1), 0.2);
    assert_eq!(law.grow(0.2, &slow(f64::NEG_INFINITY), 0.1), 0.2);
    assert_eq!(law.grow(0.2, &slow(f64::NAN), 0.1), 0.2);
    let constant = prepared("d1 = 0.3, d2 = 0.0, d3 = -1.0");
    assert_eq!(constant.failure_strain(&slow(f64::NEG_INFINITY)), 0.3);
}

fn keys(material: &Material) -> Vec<String> {
    let mut diagnostics: Vec<Diagnostic> = Vec::new();
    material.check(&mut Check::new(&mut diagnostics));
    diagnostics
        .into_iter()
        .map(|diagnostic| diagnostic.key)
        .collect()
}

#[test]
fn wrong_signs_and_what_cannot_be_evaluated_are_findings() {
    let good = "d1 = 0.05, d2 = 3.44, d3 = -2.12";
    assert_eq!(keys(&metal(good)), [""; 0]);
    let of = |damage: &str| keys(&metal(damage));
    assert_eq!(of("d1 = 0.05, d2 = 3.44, d3 = 2.12"), ["damage.d3"]);
    assert_eq!(of("d1 = -0.5, d2 = 0.3, d3 = -1.0"), ["damage.d1"]);
    assert_eq!(of(&format!("{good}, d4 = 2.0")), ["damage.d4"]);
    assert_eq!(of(&format!("{good}, d5 = nan")), ["damage.d5"]);
    let mut unmelting = metal(&format!("{good}, d5 = 0.6"));
    unmelting.melting_temperature = None;
    assert_eq!(keys(&unmelting), ["damage.d5"]);
}

#[test]
fn shipped_constants_are_sourced_and_fail_in_tension_before_they_fail_in_shear() {
    let mut count = 0;
    for entry in Library::built_in().iter() {
        let Some(damage) = &entry.material.damage else {
            continue;
        };
        count += 1;
        assert!(
            !damage.sources.is_empty() && !damage.note.is_empty(),
            "{}",
            entry.id
        );
        for source in &damage.sources {
            assert!(crate::material::references().contains_key(source));
        }
        let law = damage.prepare(&entry.material);
        let room = entry.material.room_temperature.si();
        let at = |triaxiality| {
            law.failure_strain(&DamageState {
                temperature: room,
                ..slow(triaxiality)
            })
        };
        assert!(
            at(1.0 / 3.0) < at(0.0) && at(0.0) < at(-1.0 / 3.0),
            "{}",
            entry.id
        );
        assert!((0.1..10.0).contains(&at(1.0 / 3.0)), "{}", entry.id);
    }
    assert_eq!(count, 8);
}
