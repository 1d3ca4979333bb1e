//! Scenarios that a program changed after they were read: they are checked as case files are.

use std::sync::Arc;

use percuss::{
    Error, Scenario, case,
    check::Check,
    compare,
    limit::{self, Observer, Range, Search, Tolerance},
    material::{FlowState, FlowStress, Material, OwnLaw, PreparedStrength, Strength, StrengthLaw},
    mesh_choice::choose_mesh,
    model::{Control, applicability, model, run},
    scenario::TargetBody,
    units::Density,
};

fn scenario() -> Scenario {
    let text = "projectile = { material = 'copper', length = '12.74 mm', diameter = '4.8 mm', impact_velocity = '230 m/s' }\n\
                target = { material = 'aluminium-2024-t351', thickness = '25 mm' }\n";
    case::load_str("changed", text).unwrap()
}

/// A law of one number that nothing checks.
#[derive(Debug, Clone, Copy)]
struct Unchecked(f64);

impl StrengthLaw for Unchecked {
    fn prepare(&self, _: &Material, factor: f64) -> Box<dyn PreparedStrength> {
        Box::new(Self(factor * self.0))
    }

    fn flow_stress_at_unit_strain(&self, _: &Material) -> Option<f64> {
        Some(self.0)
    }

    fn initial_yield_stress(&self, _: &Material) -> Option<f64> {
        Some(self.0)
    }

    fn equation(&self) -> &'static str {
        "σ = Y"
    }

    fn parameters(&self) -> Vec<(&'static str, String)> {
        Vec::new()
    }

    fn check(&self, _: &mut Check<'_>) {}
}

impl PreparedStrength for Unchecked {
    fn flow_stress(&self, _: &FlowState) -> FlowStress {
        FlowStress {
            stress: self.0,
            ..FlowStress::default()
        }
    }
}

fn with_law(scenario: &mut Scenario, law: Unchecked) {
    let rod = Arc::make_mut(&mut scenario.projectile.material);
    rod.strength = Strength::Own(OwnLaw(Arc::new(law)));
}

/// A change of a case, and the start of the key that it makes wrong.
type Change = (fn(&mut Scenario), &'static str);

const CHANGES: &[Change] = &[
    (
        |s| *s = s.at_impact_velocity(f64::NAN),
        "projectile.impact_velocity",
    ),
    (
        |s| *s = s.at_impact_velocity(f64::INFINITY),
        "projectile.impact_velocity",
    ),
    (
        |s| *s = s.at_impact_velocity(-10.0),
        "projectile.impact_velocity",
    ),
    (
        |s| *s = s.at_impact_velocity(1e-9),
        "projectile.impact_velocity",
    ),
    (|s| s.projectile.diameter = 0.0, "projectile.diameter"),
    (|s| s.projectile.mass = f64::NAN, "projectile.mass"),
    (
        |s| s.projectile.temperature = Some(-1.0),
        "projectile.temperature",
    ),
    (|s| s.obliquity = 2.0, "projectile.obliquity"),
    (
        |s| {
            if let TargetBody::Layers { layers, .. } = &mut s.target {
                layers.clear();
            }
        },
        "target",
    ),
    (
        |s| {
            if let TargetBody::Layers { layers, .. } = &mut s.target {
                layers[0].thickness = Some(-1.0);
            }
        },
        "target.layers.0.thickness",
    ),
    (
        |s| s.options.chain.courant = Some(f64::NAN),
        "chain.courant",
    ),
    (
        |s| s.options.axi.cells_per_radius = Some(0),
        "axi.cells_per_radius",
    ),
    (
        |s| {
            let rod = Arc::make_mut(&mut s.projectile.material);
            rod.density = Density::new(f64::NAN);
        },
        "materials.",
    ),
    (|s| with_law(s, Unchecked(f64::NAN)), "materials."),
    (|s| with_law(s, Unchecked(-3e8)), "materials."),
];

#[test]
fn no_model_computes_what_a_case_file_could_not_say() {
    for (number, (change, key)) in CHANGES.iter().enumerate() {
        let mut changed = scenario();
        change(&mut changed);
        for name in ["chain", "axi", "fdm", "crater_energy", "energy_balance"] {
            let model = model(name).unwrap();
            match run(model, &changed, &mut Control::default()) {
                Err(Error::Input(error)) => {
                    assert!(error.key.starts_with(key), "{number}: {}", error.key);
                    assert!(!error.help.is_empty(), "{number}: {error}");
                }
                other => panic!("{number}, {name}: {other:?}"),
            }
            let refusal = applicability(model, &changed).unwrap_err();
            assert!(refusal.to_string().contains(key), "{number}: {refusal}");
        }
    }
}

#[test]
fn a_law_with_a_stress_is_as_good_as_one_of_the_program() {
    let mut own = scenario();
    with_law(&mut own, Unchecked(3e8));
    let chain = model("chain").unwrap();
    let result = run(chain, &own, &mut Control::default()).unwrap();
    assert!(result.depth_of_penetration.is_some_and(|depth| depth > 0.0));
}

#[test]
fn searches_and_meshes_ask_for_what_there_is() {
    let models = [model("plugging").unwrap()];
    let wrong = |from: f64, to: f64, tolerance: Tolerance| {
        let search = Search {
            range: Range { from, to },
            tolerance,
            ..Search::default()
        };
        match limit::limits(&models, &scenario(), &search, &mut Observer::default()) {
            Err(Error::Input(error)) => error.key,
            other => panic!("{from} {to} {tolerance:?}: {other:?}"),
        }
    };
    let narrow = Tolerance::Absolute(0.1);
    for (from, to) in [
        (2000.0, 0.0),
        (0.0, f64::INFINITY),
        (f64::NAN, 100.0),
        (-5.0, 100.0),
    ] {
        assert_eq!(wrong(from, to, narrow), "range");
    }
    for tolerance in [0.0, -1.0, f64::NAN] {
        assert_eq!(
            wrong(0.0, 100.0, Tolerance::Absolute(tolerance)),
            "tolerance"
        );
    }
    assert_eq!(wrong(0.0, 100.0, Tolerance::Relative(2.0)), "tolerance");
    for speeds in [[100.0, f64::NAN], [-1.0, 2.0]] {
        let observer = &mut compare::Observer::default();
        let found = compare::compare(&models, None, &scenario(), &speeds, observer);
        assert!(matches!(found, Err(Error::Input(_))), "{speeds:?}");
    }
    for tolerance in [0.0, -0.01, f64::NAN] {
        let chosen = choose_mesh(models[0], &scenario(), tolerance, &mut Control::default());
        assert!(matches!(chosen, Err(Error::Input(_))), "{tolerance}");
    }
}

#[test]
fn a_case_that_was_read_passes() {
    assert!(scenario().check().is_ok());
    assert!(scenario().at_impact_velocity(0.0).check().is_ok());
    for target in [
        "rigid_wall = true",
        "constant_pressure = '1 GPa'",
        "material = '4340', thickness = 'semi-infinite', temperature = '400 K'",
        "layers = [{ material = '4340', thickness = '2 mm' }, { material = '6061', thickness = '3 mm', gap = '1 mm', column_diameter = '9 mm' }], \
         back_face = 'free'",
    ] {
        let text = format!(
            "projectile = {{ material = 'copper', mass = '3 g', diameter = '4.8 mm', impact_velocity = '230 m/s', nose = {{ cone = {{ angle = '60 deg' }} }} }}\n\
             target = {{ {target} }}\n"
        );
        let scenario = case::load_str("read", &text).unwrap();
        assert!(scenario.check().is_ok(), "{target}: {:?}", scenario.check());
    }
}
