//! Validity domains: cases inside, at an edge and outside, with their messages.

use percuss::validity::{
    Applicability, FirstChoice, Measure, NoseKind, Outside, Range, ValidityDomain, list,
};
use percuss::{
    Scenario, case,
    material::MaterialClass,
    model::{Control, MODELS},
    regime::{ProjectileRegime, Regime, TargetKind},
};

/// A rod of 5 mm × 50 mm on a plate or a pressure; its flow stress is 400 MPa.
fn scenario(target: &str, nose: &str, speed: f64) -> Scenario {
    let text = format!(
        "projectile = {{ material = 'rod', length = '50 mm', diameter = '5 mm', impact_velocity = '{speed} m/s', nose = {nose} }}\n\
         target = {{ {target} }}\n\
         [materials.rod]\nname = 'rod'\ndensity = '8000 kg/m3'\nyoungs_modulus = '200 GPa'\npoissons_ratio = 0.3\n\
         strength.perfectly_plastic.flow_stress = '400 MPa'\n\
         [materials.concrete]\nname = 'concrete'\ndensity = '2300 kg/m3'\nyoungs_modulus = '30 GPa'\npoissons_ratio = 0.2\n\
         strength.concrete.compressive_strength = '40 MPa'\n"
    );
    case::load_str("validity", &text).unwrap()
}

fn applicability(validity: &ValidityDomain, scenario: &Scenario) -> Applicability {
    validity.applicability(scenario, &Regime::of(scenario))
}

fn reason(validity: &ValidityDomain, scenario: &Scenario) -> String {
    match applicability(validity, scenario) {
        Applicability::Outside(refusal) => refusal.to_string(),
        Applicability::Inside(warnings) => panic!("let pass with {warnings:?}"),
    }
}

/// A column is pushed out of a free face, or into a gap, as a whole, where a plate would be pierced.
#[test]
fn a_target_that_is_pushed_out_and_holds_is_no_result() {
    use percuss::validity::pushed_column_warning;
    let warned = |target: &str, depth: f64| {
        pushed_column_warning(&scenario(target, "'flat'", 200.0), Some(depth)).is_some()
    };
    let free = "material = 'rod', thickness = '10 mm', back_face = 'free'";
    assert!(warned(free, 6e-3) && !warned(free, 4e-3));
    let gap = "layers = [{ material = 'rod', thickness = '4 mm' }, { material = 'rod', thickness = '40 mm', gap = '1 mm' }]";
    assert!(warned(gap, 3e-3) && !warned(gap, 1e-3));
    for held in [
        "material = 'rod', thickness = '10 mm', back_face = 'fixed'",
        "material = 'rod', thickness = 'semi-infinite'",
        "rigid_wall = true",
    ] {
        assert!(!warned(held, 9e-3), "{held}");
    }
}

/// The steps of an integration are parts of the time in which a rod advances by its diameter.
#[test]
fn rods_of_a_million_diameters_are_not_integrated() {
    let slender = |length: &str| {
        let text = format!(
            "projectile = {{ material = 'tungsten', length = '{length}', diameter = '10 um', impact_velocity = '4 km/s' }}\n\
             target = {{ material = 'copper', thickness = 'semi-infinite' }}\n"
        );
        case::load_str("slender", &text).unwrap()
    };
    for name in ["momentum_balance", "energy_balance", "walker_anderson"] {
        let model = MODELS.iter().find(|model| model.name() == name).unwrap();
        let run = |length| model.run(&slender(length), &mut Control::default());
        assert!(run("9.9 cm").unwrap().depth_of_penetration.unwrap() > 0.1);
        let error = run("10 m").unwrap_err().to_string();
        assert!(error.contains("up to 10000 diameters"), "{name}: {error}");
    }
}

const PLATE: &str = "material = 'rod', thickness = '30 mm'";

#[test]
fn an_open_guard_lets_every_metal_pass() {
    for target in [PLATE, "rigid_wall = true", "constant_pressure = '2 GPa'"] {
        let scenario = scenario(target, "'flat'", 500.0);
        assert_eq!(
            applicability(&ValidityDomain::OPEN, &scenario),
            Applicability::Inside(Vec::new())
        );
    }
    let concrete = scenario("material = 'concrete', thickness = '1 m'", "'flat'", 500.0);
    assert_eq!(
        reason(&ValidityDomain::OPEN, &concrete),
        "it takes targets of metal, and this one is of concrete"
    );
    let rod = ValidityDomain {
        projectile_materials: &[MaterialClass::Concrete],
        ..ValidityDomain::OPEN
    };
    assert_eq!(
        reason(&rod, &scenario(PLATE, "'flat'", 500.0)),
        "it takes projectiles of concrete, and this one is of metal"
    );
}

#[test]
fn target_and_nose_are_refused_by_name() {
    let deep = ValidityDomain {
        targets: &[TargetKind::SemiInfinite, TargetKind::RigidWall],
        ..ValidityDomain::OPEN
    };
    assert_eq!(
        reason(&deep, &scenario(PLATE, "'flat'", 500.0)),
        "it takes semi-infinite targets or rigid walls, and this is a thick plate (6 projectile diameters)"
    );
    let sharp = ValidityDomain {
        noses: NoseKind::SHARP,
        ..ValidityDomain::OPEN
    };
    assert_eq!(
        reason(&sharp, &scenario(PLATE, "'flat'", 500.0)),
        "it takes hemisphere, cone or ogive noses, and this nose is of the shape `flat`"
    );
    let cone = scenario(PLATE, "{ cone = { length_to_diameter = 1.0 } }", 500.0);
    assert!(matches!(
        applicability(&sharp, &cone),
        Applicability::Inside(_)
    ));
}

#[test]
fn a_neighbouring_regime_passes_with_a_warning() {
    let rigid = ValidityDomain {
        projectile: &[ProjectileRegime::Rigid],
        ..ValidityDomain::OPEN
    };
    let pressed = |stress: f64| {
        scenario(
            &format!("constant_pressure = '{stress} MPa'"),
            "'flat'",
            500.0,
        )
    };
    assert_eq!(
        applicability(&rigid, &pressed(300.0)),
        Applicability::Inside(Vec::new())
    );
    let Applicability::Inside(warnings) = applicability(&rigid, &pressed(500.0)) else {
        panic!("refused at the edge");
    };
    assert_eq!(
        warnings,
        [
            "model taken at the edge of its regime: the projectile is deforming rather than rigid: the pressure is 500 MPa \
          against its flow stress of 400 MPa"
        ]
    );
    assert_eq!(
        reason(&rigid, &pressed(700.0)),
        "it takes rigid projectiles, and this one is deforming: the pressure is 700 MPa against its flow stress of 400 MPa"
    );
}

/// On a target that never yields, a projectile is rigid only if it does not either.
#[test]
fn what_makes_a_projectile_rigid_is_said_where_nothing_else_can() {
    let rigid = ValidityDomain {
        projectile: &[ProjectileRegime::Rigid],
        ..ValidityDomain::OPEN
    };
    let remedy = |target: &str| {
        let case = scenario(target, "'flat'", 100.0);
        match applicability(&rigid, &case) {
            Applicability::Outside(refusal) => refusal.remedy,
            Applicability::Inside(warnings) => panic!("let pass with {warnings:?}"),
        }
    };
    let glass = remedy("material = 'glass', thickness = '10 mm'").unwrap();
    assert!(glass.contains("`strength.elastic = {}`"), "{glass}");
    let why = reason(
        &rigid,
        &scenario("material = 'glass', thickness = '10 mm'", "'flat'", 100.0),
    );
    let words = "this one is deforming: the target never yields, the projectile does, at a flow stress of 400 MPa";
    assert!(why.contains(words), "{why}");
    assert_eq!(
        remedy("material = '4340-johnson-cook', thickness = '10 mm'"),
        None
    );
}

#[test]
fn ranges_refuse_or_warn_and_hold_their_ends() {
    const fn range(measure: Measure, min: f64, max: f64, outside: Outside) -> Range {
        Range {
            measure,
            min,
            max,
            outside,
            because: "it was fitted there",
        }
    }
    const SPEED: &[Range] = &[range(
        Measure::ImpactSpeed,
        100.0,
        900.0,
        Outside::NotApplicable,
    )];
    const LENGTH: &[Range] = &[range(Measure::LengthToDiameter, 0.0, 8.0, Outside::Warning)];
    const THICKNESS: &[Range] = &[range(
        Measure::ThicknessToDiameter,
        7.0,
        f64::INFINITY,
        Outside::NotApplicable,
    )];
    let speed = ValidityDomain {
        ranges: SPEED,
        ..ValidityDomain::OPEN
    };
    let at = |speed: f64| scenario(PLATE, "'flat'", speed);
    for inside in [100.0, 900.0] {
        assert_eq!(
            applicability(&speed, &at(inside)),
            Applicability::Inside(Vec::new())
        );
    }
    assert_eq!(
        reason(&speed, &at(99.9)),
        "impact velocity is 99.9 m/s, and it takes 100 to 900 m/s: it was fitted there"
    );
    let length = ValidityDomain {
        ranges: LENGTH,
        ..ValidityDomain::OPEN
    };
    assert_eq!(
        applicability(&length, &at(500.0)),
        Applicability::Inside(vec![
            "length to diameter is 10, and it takes up to 8: it was fitted there".to_owned()
        ])
    );
    let thickness = ValidityDomain {
        ranges: THICKNESS,
        ..ValidityDomain::OPEN
    };
    assert_eq!(
        reason(&thickness, &at(500.0)),
        "thickness to projectile diameter is 6, and it takes 7 or more: it was fitted there"
    );
    // What has no thickness has nothing to be measured.
    let wall = scenario("rigid_wall = true", "'flat'", 500.0);
    assert_eq!(
        applicability(&thickness, &wall),
        Applicability::Inside(Vec::new())
    );
}

#[test]
fn a_depth_near_the_back_face_is_refused_where_it_is_not_seen() {
    let blind = ValidityDomain {
        sees_back_face: false,
        ..ValidityDomain::OPEN
    };
    let plate = scenario(PLATE, "'flat'", 500.0);
    assert_eq!(blind.depth_at_back_face(&plate, 0.0239), None);
    let reason = blind.depth_at_back_face(&plate, 0.0241).unwrap();
    assert!(
        reason.contains("24.1 mm is more than 80 % of the thickness of 30 mm"),
        "{reason}"
    );
    assert_eq!(ValidityDomain::OPEN.depth_at_back_face(&plate, 0.1), None);
    let deep = scenario(
        "material = 'rod', thickness = 'semi-infinite'",
        "'flat'",
        500.0,
    );
    assert_eq!(blind.depth_at_back_face(&deep, 10.0), None);
}

#[test]
fn a_first_choice_fits_its_kind_of_case_only() {
    let choice = FirstChoice {
        projectile: ProjectileRegime::Deforming,
        targets: &[TargetKind::ThickPlate, TargetKind::ConstantPressure],
        noses: &[NoseKind::Flat],
        target_material: MaterialClass::Metal,
        because: "it is made up for it",
    };
    let fits = |scenario: &Scenario| choice.fits(scenario, &Regime::of(scenario));
    let pressure = "constant_pressure = '2 GPa'";
    assert!(fits(&scenario(pressure, "'flat'", 100.0)));
    assert!(!fits(&scenario(pressure, "'hemisphere'", 100.0)));
    assert!(!fits(&scenario(
        "constant_pressure = '1 MPa'",
        "'flat'",
        100.0
    )));
    assert!(!fits(&scenario("rigid_wall = true", "'flat'", 100.0)));
    // Layers that are together as thin as a thin plate are no case for it.
    let layers = |each: f64| {
        let layer = format!("{{ material = 'rod', thickness = '{each} mm' }}");
        let case = scenario(&format!("layers = [{layer}, {layer}]"), "'flat'", 100.0);
        let regime = Regime::of(&case);
        let choice = FirstChoice {
            projectile: regime.projectile,
            targets: &[TargetKind::Layered],
            ..choice
        };
        choice.fits(&case, &regime)
    };
    // 0.88 and 0.84 diameters.
    assert!(layers(2.2) && !layers(2.1));
    assert!(fits(&scenario(PLATE, "'flat'", 100.0)));
    let concrete = FirstChoice {
        target_material: MaterialClass::Concrete,
        ..choice
    };
    let plate = scenario(PLATE, "'flat'", 100.0);
    assert!(!concrete.fits(&plate, &Regime::of(&plate)));
}

#[test]
fn lists_read_as_english() {
    assert_eq!(list([].into_iter()), "nothing");
    assert_eq!(list(["a"].into_iter()), "a");
    assert_eq!(list(["a", "b"].into_iter()), "a or b");
    assert_eq!(list(["a", "b", "c"].into_iter()), "a, b or c");
}

#[test]
fn what_has_no_material_is_said_to_be_of_none() {
    for (targets, words) in [
        (&[TargetKind::RigidWall][..], "against rigid walls"),
        (
            &[TargetKind::RigidWall, TargetKind::ConstantPressure],
            "against rigid walls or constant pressures",
        ),
        (
            &[TargetKind::RigidWall, TargetKind::ThinPlate],
            "against rigid walls or thin plates, of metal",
        ),
    ] {
        let validity = ValidityDomain {
            targets,
            ..ValidityDomain::OPEN
        };
        assert_eq!(validity.describe()[1], words);
    }
}

#[test]
fn every_model_says_what_it_is_made_for() {
    for model in MODELS {
        let (name, validity) = (model.name(), model.validity());
        let lines = validity.describe();
        assert!(
            lines.len() >= 2 && lines.iter().all(|line| !line.trim().is_empty()),
            "{name}: {lines:?}"
        );
        assert!(
            lines[0].contains("projectiles of") && lines[1].starts_with("against "),
            "{name}"
        );
        for range in validity.ranges {
            assert!(range.min < range.max && !range.because.is_empty(), "{name}");
        }
        for choice in validity.first_choice {
            assert!(validity.projectile.contains(&choice.projectile), "{name}");
            assert!(
                choice
                    .targets
                    .iter()
                    .all(|target| validity.targets.contains(target)),
                "{name}"
            );
            assert!(
                choice
                    .noses
                    .iter()
                    .all(|nose| validity.noses.contains(nose)),
                "{name}"
            );
            assert!(
                validity.target_materials.contains(&choice.target_material),
                "{name}"
            );
        }
    }
}

/// Particles with a stress take what yields, and refuse what they would leave out: cracks, several layers, an equation of state that is not there.
#[test]
fn particles_with_a_stress_refuse_what_they_leave_out() {
    let refused = |target: &str, options: &str| {
        let text = format!(
            "projectile = {{ material = 'hard', length = '10 mm', diameter = '6 mm', impact_velocity = '50 m/s' }}\n\
             target = {{ {target} }}\nparticles = {{ formulation = 'particle-stress', max_steps = 1 {options} }}\n\
             [materials.hard]\nname = 'Elastic'\ndensity = '8000 kg/m3'\nyoungs_modulus = '200 GPa'\npoissons_ratio = 0.3\nstrength.elastic = {{}}\n"
        );
        let scenario = case::load_str("metal", &text).unwrap();
        let particles = percuss::model::model("particles").unwrap();
        match percuss::model::run(particles, &scenario, &mut Default::default()) {
            Err(percuss::Error::NotApplicable { refusal, .. }) => refusal.to_string(),
            other => other.map(|_| "taken".to_owned()).unwrap(),
        }
    };
    let plate = |material: &str| format!("material = '{material}', thickness = '5 mm'");
    let glass = plate("soda-lime-glass-float");
    for (target, options, said) in [
        (plate("copper"), "", "taken"),
        (glass.clone(), ", fracture = false", "taken"),
        (glass, "", "no bond breaks"),
        (
            plate("hard"),
            ", equation_of_state = 'mie-gruneisen'",
            "equation of state",
        ),
        (
            "layers = [{ material = 'copper', thickness = '2 mm' }, { material = 'copper', thickness = '2 mm' }]".to_owned(),
            "",
            "layered target",
        ),
    ] {
        let found = refused(&target, options);
        assert!(found.contains(said), "{target}: {found}");
    }
}

/// A fixed rear face is the default: nothing goes through it, which plates of up to three diameters are warned of.
#[test]
fn a_thin_plate_before_a_fixed_face_is_warned_of() {
    let warned = |target: &str| {
        let text = format!(
            "projectile = {{ material = '4340', length = '30 mm', diameter = '10 mm', impact_velocity = '300 m/s' }}\n\
             target = {{ material = '6061', {target} }}\nchain = {{ projectile_elements = 10, target_elements = 10 }}\n"
        );
        let scenario = case::load_str("plate", &text).unwrap();
        let model = MODELS.iter().find(|model| model.name() == "chain").unwrap();
        let result = model.run(&scenario, &mut Control::default()).unwrap();
        result
            .warnings
            .iter()
            .any(|warning| warning.starts_with("perforation is impossible"))
    };
    assert!(warned("thickness = '10 mm'"));
    assert!(!warned("thickness = '10 mm', back_face = 'free'"));
    assert!(!warned("thickness = '60 mm'"));
}
