//! Thresholds worked out by hand for perfectly plastic materials.

use percuss::regime::{ProjectileRegime, Regime, TargetKind, nose_factor};
use percuss::{
    Scenario, case, case::Nose, material::cavity_expansion_pressure, scenario::TargetBody,
};

/// A rod of 5 mm and a flow stress [MPa], density 8000 kg/m3, E = 200 GPa, wave speed 5000 m/s; the target the same material
/// with another flow stress [MPa] and a density of 2700 kg/m3.
fn scenario(rod: f64, plate: f64, target: &str, nose: &str, speed: f64) -> Scenario {
    let material = |name: &str, density: f64, stress: f64| {
        format!(
            "[materials.{name}]\nname = '{name}'\ndensity = '{density} kg/m3'\nyoungs_modulus = '200 GPa'\n\
             poissons_ratio = 0.3\nstrength.perfectly_plastic.flow_stress = '{stress} MPa'\n"
        )
    };
    let text = format!(
        "projectile = {{ material = 'rod', length = '50 mm', diameter = '5 mm', impact_velocity = '{speed} m/s', nose = {nose} }}\n\
         target = {{ {target} }}\n{}{}",
        material("rod", 8000.0, rod),
        material("plate", 2700.0, plate)
    );
    case::load_str("regime", &text).unwrap()
}

const DEEP: &str = "material = 'plate', thickness = 'semi-infinite'";

fn classified(
    rod: f64,
    plate: f64,
    target: &str,
    nose: &str,
    speed: f64,
) -> (ProjectileRegime, Option<ProjectileRegime>) {
    let regime = Regime::of(&scenario(rod, plate, target, nose, speed));
    (regime.projectile, regime.neighbour)
}

use ProjectileRegime::{Deforming, Eroding, Rigid};

#[test]
fn a_wall_and_a_pressure_compare_one_stress() {
    // On a wall: ρ c V = 8000 × 5000 × V, 400 MPa at 10 m/s.
    let wall = |speed| classified(400.0, 100.0, "rigid_wall = true", "'flat'", speed);
    assert_eq!(wall(0.0), (Rigid, None));
    assert_eq!(wall(6.6), (Rigid, None));
    assert_eq!(wall(6.7), (Rigid, Some(Deforming)));
    assert_eq!(wall(9.99), (Rigid, Some(Deforming)));
    assert_eq!(wall(10.01), (Deforming, Some(Rigid)));
    assert_eq!(wall(14.9), (Deforming, Some(Rigid)));
    assert_eq!(wall(15.1), (Deforming, None));
    let pressure = |stress: &str| {
        classified(
            400.0,
            100.0,
            &format!("constant_pressure = '{stress}'"),
            "'flat'",
            900.0,
        )
    };
    assert_eq!(pressure("266 MPa"), (Rigid, None));
    assert_eq!(pressure("399 MPa"), (Rigid, Some(Deforming)));
    assert_eq!(pressure("401 MPa"), (Deforming, Some(Rigid)));
    assert_eq!(pressure("601 MPa"), (Deforming, None));
}

/// Resistance of the plate [Pa]: `(2Y/3)(1 + ln(2E/3Y))` within its terms of order Y/E.
fn resistance(plate: f64) -> f64 {
    let scenario = scenario(1000.0, plate, DEEP, "'flat'", 1.0);
    let TargetBody::Layers { layers, .. } = &scenario.target else {
        panic!("no layers");
    };
    let resistance = cavity_expansion_pressure(&layers[0].material).unwrap();
    let stress = plate * 1e6;
    let closed = 2.0 / 3.0 * stress * (1.0 + (2.0 * 200e9 / (3.0 * stress)).ln());
    assert!(
        (resistance / closed - 1.0).abs() < 5e-3,
        "{resistance} {closed}"
    );
    resistance
}

#[test]
fn a_strong_rod_stays_rigid_up_to_the_speed_at_which_its_nose_yields() {
    // R = 1.000 GPa of a plate of 200 MPa; R + N ρ V² = 2 GPa at V = √((2e9 − R)/(2700 N)).
    let resistance = resistance(200.0);
    for (nose, factor) in [("'flat'", 1.0), ("'hemisphere'", 0.5)] {
        let yields = ((2e9 - resistance) / (2700.0 * factor)).sqrt();
        let at = |speed: f64| classified(2000.0, 200.0, DEEP, nose, speed);
        assert_eq!(at(0.999 * yields), (Rigid, Some(Deforming)), "{nose}");
        assert_ne!(at(1.001 * yields).0, Rigid, "{nose}");
        // Not close: 1.5 (R + N ρ V²) < 2 GPa.
        let sharp = ((2e9 / 1.5 - resistance) / (2700.0 * factor)).sqrt();
        assert_eq!(at(0.999 * sharp), (Rigid, None), "{nose}");
        assert_eq!(at(1.001 * sharp), (Rigid, Some(Deforming)), "{nose}");
    }
    // A flat nose yields below √(2(Y − R)/ρt), so there is a range in which the rod deforms; it is close to rigid there.
    let erodes = (2.0 * (2e9 - resistance) / 2700.0).sqrt();
    let at = |speed: f64| classified(2000.0, 200.0, DEEP, "'flat'", speed);
    assert_eq!(at(0.999 * erodes).0, Deforming);
    assert_eq!(at(1.001 * erodes).0, Eroding);
}

#[test]
fn a_weak_rod_erodes_above_the_speed_at_which_it_penetrates() {
    // Y = 100 MPa < R: √(2(R − Y)/ρp), whatever the density of the target.
    let threshold = (2.0 * (resistance(200.0) - 100e6) / 8000.0).sqrt();
    let at = |speed: f64| classified(100.0, 200.0, DEEP, "'flat'", speed);
    assert_eq!(at(0.79 * threshold), (Deforming, None));
    assert_eq!(at(0.81 * threshold), (Deforming, Some(Eroding)));
    assert_eq!(at(0.999 * threshold), (Deforming, Some(Eroding)));
    assert_eq!(at(1.001 * threshold), (Eroding, Some(Deforming)));
    assert_eq!(at(1.24 * threshold), (Eroding, Some(Deforming)));
    assert_eq!(at(1.26 * threshold), (Eroding, None));
}

/// Johnson and Cook's factor `1 − T*` at half the way to melting halves both stresses.
#[test]
fn hot_bodies_are_as_weak_as_they_are() {
    let of = |rod: f64, target: f64| {
        let text = format!(
            r#"
            projectile = {{ material = "metal", length = "50 mm", diameter = "5 mm", impact_velocity = "300 m/s", temperature = "{rod} K" }}
            target = {{ material = "metal", thickness = "semi-infinite", temperature = "{target} K" }}
            [materials.metal]
            density = "8000 kg/m3"
            youngs_modulus = "200 GPa"
            poissons_ratio = 0.3
            specific_heat = "500 J/(kg K)"
            room_temperature = "300 K"
            melting_temperature = "1800 K"
            strength.johnson_cook = {{ a = "1000 MPa", b = "0 MPa", n = 1.0, c = 0.0, m = 1.0, reference_rate = "1 1/s" }}
            "#
        );
        let scenario = case::load_str("hot", &text).unwrap();
        Regime::of(&scenario).describe(&scenario)
    };
    assert!(
        of(300.0, 300.0).contains("flow stress of 1 GPa"),
        "{}",
        of(300.0, 300.0)
    );
    assert!(
        of(1050.0, 300.0).contains("flow stress of 500 MPa"),
        "{}",
        of(1050.0, 300.0)
    );
    // (2Y/3)(1 + ln(2E/3Y)) with Y = 500 MPa.
    let hot = of(300.0, 1050.0);
    assert!(hot.contains("target resistance 2.2 GPa"), "{hot}");
}

#[test]
fn targets_are_told_apart_by_their_thickness() {
    let kind = |target: &str| Regime::of(&scenario(400.0, 200.0, target, "'flat'", 100.0)).target;
    let plate = |mm: f64| kind(&format!("material = 'plate', thickness = '{mm} mm'"));
    // The rod has 5 mm: thin below 4.33 mm, thick from 25 mm on.
    assert_eq!(plate(4.32), TargetKind::ThinPlate);
    assert_eq!(plate(4.34), TargetKind::Plate);
    assert_eq!(plate(24.9), TargetKind::Plate);
    assert_eq!(plate(25.1), TargetKind::ThickPlate);
    assert_eq!(kind(DEEP), TargetKind::SemiInfinite);
    assert_eq!(kind("rigid_wall = true"), TargetKind::RigidWall);
    assert_eq!(
        kind("constant_pressure = '1 GPa'"),
        TargetKind::ConstantPressure
    );
    let layers = "layers = [{ material = 'plate', thickness = '1 mm' }, { material = 'rod', thickness = '1 mm' }]";
    assert_eq!(kind(layers), TargetKind::Layered);
}

#[test]
fn the_sentence_holds_the_numbers() {
    let wall = scenario(400.0, 100.0, "rigid_wall = true", "'flat'", 12.0);
    assert_eq!(
        Regime::of(&wall).describe(&wall),
        "deforming projectile (or rigid), a rigid wall: an elastic impact on the wall would stress it to 480 MPa against its \
         flow stress of 400 MPa"
    );
    let plate = scenario(
        100.0,
        200.0,
        "material = 'plate', thickness = '10 mm'",
        "'flat'",
        2000.0,
    );
    let regime = Regime::of(&plate);
    assert_eq!(
        regime.kind_in_words(&plate),
        "eroding projectile, a plate of medium thickness (2 projectile diameters)"
    );
    assert!(
        regime
            .because
            .contains("it erodes above 474 m/s (target resistance 1 GPa)"),
        "{}",
        regime.because
    );
}

#[test]
fn what_never_yields_stays_rigid_and_what_it_meets_deforms() {
    let elastic = "[materials.e]\nname = 'e'\ndensity = '8000 kg/m3'\nyoungs_modulus = '200 GPa'\npoissons_ratio = 0.3\nstrength.elastic = {}\n";
    let rod = |projectile: &str, target: &str| {
        let text = format!(
            "projectile = {{ material = '{projectile}', length = '50 mm', diameter = '5 mm', impact_velocity = '900 m/s' }}\n\
             target = {{ material = '{target}', thickness = 'semi-infinite' }}\n{elastic}"
        );
        let regime = Regime::of(&case::load_str("elastic", &text).unwrap());
        (regime.projectile, regime.neighbour, regime.because)
    };
    assert_eq!(
        rod("e", "copper"),
        (Rigid, None, "its material never yields".to_owned())
    );
    let (projectile, neighbour, because) = rod("copper", "e");
    assert_eq!((projectile, neighbour), (Deforming, None));
    assert!(because.starts_with("the target never yields"), "{because}");
}

#[test]
fn nose_factors_meet_where_shapes_do() {
    assert_eq!(nose_factor(Nose::Flat), 1.0);
    // An ogive of half a caliber is a hemisphere.
    assert_eq!(
        nose_factor(Nose::Ogive { crh: 0.5 }),
        nose_factor(Nose::Hemisphere)
    );
    // A right cone of 45° has sin² = 1/2.
    assert_eq!(
        nose_factor(Nose::Cone {
            length_to_diameter: 0.5
        }),
        0.5
    );
    assert!((nose_factor(Nose::Ogive { crh: 3.0 }) - 23.0 / 216.0).abs() < 1e-15);
}

/// A rod of ten diameters is one in any size: its ratio, over the mass and the density, is 10 but for rounding.
#[test]
fn a_bound_of_a_range_belongs_to_it_in_every_size() {
    let tate = percuss::model::model("tate").unwrap();
    let text = |length: f64, diameter: f64| {
        format!(
            "projectile = {{ material = 'tungsten-alloy', length = '{length} mm', diameter = '{diameter} mm', impact_velocity = '1500 m/s' }}\n\
             target = {{ material = '4340', thickness = '{} mm', back_face = 'free' }}",
            5.0 * diameter
        )
    };
    for size in 1..40 {
        let diameter = 0.5 * f64::from(size);
        for (ratio, is_inside) in [(10.0, true), (9.999, false)] {
            let scenario = case::load_str("rod", &text(ratio * diameter, diameter)).unwrap();
            let mut ranges = tate.validity().ranges.iter();
            let outside = ranges.find_map(|range| range.diagnostic(&scenario));
            assert_eq!(
                outside.is_none(),
                is_inside,
                "{ratio} {diameter} mm: {outside:?}"
            );
            let target = Regime::of(&scenario).target;
            assert_eq!(target, TargetKind::ThickPlate, "{diameter} mm");
        }
    }
}
