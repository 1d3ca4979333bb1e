//! Estimates of the cost of runs against the runs.

use percuss::{
    Scenario, case,
    model::{self, Control, Estimate},
};

use crate::random_cases::texts;

fn estimate(model: &str, scenario: &Scenario) -> Estimate {
    model::model(model).unwrap().estimate(scenario)
}

/// Steps of a run over those that were estimated; `None` where the model gives no result.
fn ratio(name: &str, scenario: &Scenario) -> Option<f64> {
    let model = model::model(name).unwrap();
    let result = model::run(model, scenario, &mut Control::default()).ok()?;
    Some(result.numerics?.steps as f64 / estimate(name, scenario).steps)
}

fn random(count: u64) -> Vec<Scenario> {
    let without_limit = |text: String| {
        let lines = text.lines().filter(|line| !line.starts_with("max_steps"));
        lines.map(|line| format!("{line}\n")).collect::<String>()
    };
    let texts = texts(count, 5).into_iter().map(without_limit);
    let scenarios = texts.map(|text| case::load_str("random", &text).unwrap());
    scenarios.filter(|s| s.impact_velocity > 10.0).collect()
}

#[test]
fn estimated_steps_are_of_the_order_of_those_that_are_taken() {
    const FACTOR: f64 = 6.0;
    let scenarios = random(600);
    for (name, every, least) in [("chain", 4, 0.8), ("fdm", 1, 0.7), ("axi", 60, 0.7)] {
        let of_model = scenarios.iter().step_by(every);
        let ratios: Vec<f64> = of_model.filter_map(|s| ratio(name, s)).collect();
        let near = ratios
            .iter()
            .filter(|r| (1.0 / FACTOR..FACTOR).contains(*r));
        let part = near.count() as f64 / ratios.len() as f64;
        println!("{name}: {part:.2} of {} within {FACTOR}", ratios.len());
        assert!(
            ratios.len() > 5 && part > least,
            "{name}: {part} {ratios:?}"
        );
    }
}

const BRITTLE: &str = r#"
    projectile = { material = "own", length = "20 mm", diameter = "6 mm", impact_velocity = "100 m/s", nose = "hemisphere" }
    target = { material = "own", thickness = "6 mm", back_face = "free" }
    materials.own = { name = "Glass", density = "2500 kg/m3", youngs_modulus = "70 GPa", poissons_ratio = 0.2, strength.elastic = {} }
"#;

#[test]
fn steps_of_a_lattice_are_estimated() {
    let scenario = case::load_str("brittle", BRITTLE).unwrap();
    let ratio = ratio("particles", &scenario).unwrap();
    println!("particles: {ratio}");
    assert!((0.2..5.0).contains(&ratio), "{ratio}");
}

/// Metals in plane strain: a strip on a wall, below and at its largest deformations, and a plate under a round nose.
#[test]
fn steps_of_particles_with_a_stress_are_estimated() {
    let on_wall = |velocity: f64, packing: &str| {
        format!(
            "projectile = {{ material = 'copper', length = '12 mm', diameter = '4 mm', impact_velocity = '{velocity} m/s' }}\n\
             target.rigid_wall = true\n\
             particles = {{ formulation = 'particle-stress', packing = '{packing}' }}\n"
        )
    };
    let plate = "projectile = { material = 'hard', length = '10 mm', diameter = '6 mm', impact_velocity = '100 m/s', nose = 'hemisphere' }\n\
         target = { material = 'copper', thickness = '6 mm', back_face = 'free' }\n\
         particles = { formulation = 'particle-stress', width = '40 mm' }\n\
         materials.hard = { name = 'Elastic', density = '7800 kg/m3', youngs_modulus = '200 GPa', poissons_ratio = 0.3, strength.elastic = {} }\n";
    for text in [
        on_wall(50.0, "hexagonal"),
        on_wall(150.0, "irregular"),
        plate.to_owned(),
    ] {
        let scenario = case::load_str("metal", &text).unwrap();
        let ratio = ratio("particles", &scenario).unwrap();
        println!("{ratio:.2}\n{text}");
        assert!((0.2..5.0).contains(&ratio), "{ratio}\n{text}");
    }
}

/// Walks of valid options that would take hours say so, and those that end early do not.
#[test]
fn cost_follows_the_options() {
    let of = |options: &str, model: &str| {
        let text = format!(
            "projectile = {{ material = 'copper', length = '50 mm', diameter = '10 mm', impact_velocity = '500 m/s' }}\n\
             target = {{ material = 'aluminium-2024-t351', thickness = '100 mm' }}\n{options}"
        );
        estimate(model, &case::load_str("walk", &text).unwrap())
    };
    let fine = "projectile_elements = 100000, target_elements = 100000";
    for model in ["chain", "fdm"] {
        let [usual, long, short] = [
            of("", model),
            of(&format!("{model} = {{ {fine} }}"), model),
            of(&format!("{model} = {{ {fine}, max_steps = 10 }}"), model),
        ];
        assert!(usual.seconds < 1.0, "{model}: {usual:?}");
        assert!(long.seconds > 600.0, "{model}: {long:?}");
        assert!(long.memory > 50e6 && long.memory < 1e9, "{model}: {long:?}");
        assert!(
            short.seconds < 1.0 && short.steps == 10.0,
            "{model}: {short:?}"
        );
    }
    let [usual, small, late] = [
        of("", "axi"),
        of("axi = { courant = 0.001 }", "axi"),
        of("axi = { cells_per_radius = 40, end_time = '1 us' }", "axi"),
    ];
    assert!(usual.seconds < 60.0 && small.seconds > 100.0 * usual.seconds);
    assert!(late.steps < 2000.0, "{late:?}");
}

/// A history keeps no more of a fine mesh than pictures show, in every solver.
#[test]
fn profiles_of_fine_meshes_are_thinned_out() {
    let case = |target: &str, scheme: &str| {
        let fine = "projectile_elements = 3000, target_elements = 3000, max_steps = 300";
        let text = format!(
            "projectile = {{ material = 'copper', length = '20 mm', diameter = '10 mm', impact_velocity = '200 m/s' }}\n\
             target = {{ material = 'aluminium-2024-t351', thickness = '{target}' }}\n\
             chain = {{ {fine}{scheme} }}\nfdm = {{ {fine} }}\n"
        );
        case::load_str("fine", &text).unwrap()
    };
    let whole = case("50 mm", "");
    let column = case("50 mm", ", target_resistance = 'column'");
    let published = case("50 mm", ", scheme = 'published'");
    for (name, scenario) in [
        ("chain", &whole),
        ("chain", &column),
        ("chain", &published),
        ("fdm", &whole),
    ] {
        let mut control = Control::recording();
        let result = model::run(model::model(name).unwrap(), scenario, &mut control).unwrap();
        let history = result.history.unwrap();
        let most = history
            .profiles
            .iter()
            .map(|profile| profile.elements.len())
            .max();
        assert!(
            most.is_some_and(|most| (100..2100).contains(&most)),
            "{name}: {most:?}"
        );
    }
}
