//! The chain with a shear band around the plug and a plate that dishes, against exact answers.

use std::f64::consts::PI;

use percuss::{
    Scenario, case,
    model::{self, Control},
    outcome::{Outcome, RunResult, Termination},
};

fn scenario(velocity: f64, target: &str, chain: &str) -> Scenario {
    let text = format!(
        r#"
        projectile = {{ material = "stiff", mass = "197 g", diameter = "20 mm", impact_velocity = "{velocity} m/s" }}
        target = {{ material = "stiff", thickness = "12 mm", back_face = "free"{target} }}
        materials.stiff = {{ name = "stiff", density = "7850 kg/m3", youngs_modulus = "1400 GPa", poissons_ratio = 0.3, strength = {{ elastic = {{}} }} }}
        [chain]
        border_shear_law = "shear-band"
        {chain}
        "#
    );
    case::load_str("plug", &text).unwrap_or_else(|error| panic!("{error}"))
}

fn run(scenario: &Scenario) -> RunResult {
    let chain = model::model("chain").unwrap();
    model::run(chain, scenario, &mut Control::recording()).unwrap_or_else(|error| panic!("{error}"))
}

fn balanced(result: &RunResult) {
    let numerics = result.numerics();
    assert!(numerics.energy_residual < 1e-3, "{numerics:?}");
    assert!(numerics.momentum_residual < 1e-9, "{numerics:?}");
}

/// Stiff bodies without bounce move as rigid ones under a force that is small for them; the band takes the same work at any speed.
const LUMPED: &str = r#"
    projectile_elements = 1
    target_elements = 2
    damping_ratio = 2.0
    artificial_viscosity = { linear = 10.0 }
    shear_band = { width = "1.5 mm", shear_strength = "20 MPa", failure_strain = 2.0 }
"#;

/// Mass of the projectile and of the plug [kg].
fn masses() -> (f64, f64) {
    (0.197, 7850.0 * PI * 1e-4 * 0.012)
}

#[test]
fn with_its_shear_work_lumped_it_is_recht_and_ipson() {
    let (mass, plug) = masses();
    // The band is as long as the plug that is still inside: ∫ τ π D (h − u) du up to u = γ w.
    let slip: f64 = 2.0 * 1.5e-3;
    let work = 20e6 * PI * 0.02 * (0.012 * slip - 0.5 * slip * slip);
    let limit = (2.0 * work * (mass + plug)).sqrt() / mass;
    for speed in [1.2, 1.5, 2.0, 3.0].map(|k| k * limit) {
        let result = run(&scenario(speed, "", LUMPED));
        balanced(&result);
        assert_eq!(result.outcome, Outcome::Perforated);
        assert_eq!(result.termination, Termination::PlugFree);
        let exact = mass / (mass + plug) * (speed * speed - limit * limit).sqrt();
        let residual = result.residual_velocity.unwrap();
        let taken = result.numerics().energy.border_shear;
        println!(
            "{speed:.2} m/s, limit {limit:.2}: {residual:.4} of {exact:.4} ({:+.1e}), plug {:.4}, work {:+.1e}",
            residual / exact - 1.0,
            result.plug_velocity.unwrap(),
            taken / work - 1.0
        );
        assert!((residual / exact - 1.0).abs() < 1e-3);
        assert!((taken / work - 1.0).abs() < 1e-3);
        assert!((result.plug_mass.unwrap() / plug - 1.0).abs() < 1e-12);
    }
    for speed in [0.97, 0.995].map(|k| k * limit) {
        let result = run(&scenario(speed, "", LUMPED));
        balanced(&result);
        assert_ne!(result.outcome, Outcome::Perforated);
        assert_eq!(result.plug_velocity, None);
    }
}

/// A light projectile bounces off the plug that it drives out: the hole is open all the same.
#[test]
fn a_plug_that_leaves_alone_leaves_a_hole() {
    let chain =
        "shear_band = { width = \"0.1 mm\", shear_strength = \"100 MPa\", failure_strain = 1.0 }";
    let mut light = scenario(100.0, "", chain);
    let mut material = (*light.projectile.material).clone();
    material.density = percuss::units::Density::new(4000.0);
    light.projectile.material = material.into();
    light.projectile.mass *= 4000.0 / 7850.0;
    light.projectile.length *= 0.05;
    light.projectile.mass *= 0.05;
    let result = run(&light);
    balanced(&result);
    println!("{} {:?}", result.criterion, result.residual_velocity);
    assert_eq!(result.outcome, Outcome::Perforated);
    assert!(result.residual_velocity.unwrap() < 0.0);
    assert!(result.plug_velocity.unwrap() > 1.0);
    assert!(
        result.criterion.contains("open hole"),
        "{}",
        result.criterion
    );
}

#[test]
fn a_plug_that_is_free_keeps_its_momentum() {
    let chain =
        "shear_band = { width = \"0.2 mm\", shear_strength = \"300 MPa\", failure_strain = 1.0 }";
    let result = run(&scenario(150.0, "", chain));
    balanced(&result);
    let history = result.history.as_ref().unwrap();
    let free = result
        .details
        .iter()
        .find(|detail| detail.name == "plug free")
        .unwrap()
        .value
        * 1e-6;
    let after: Vec<f64> = history
        .samples
        .iter()
        .filter(|sample| sample.time > free && sample.contact_force == 0.0)
        .map(|sample| sample.momentum.target)
        .collect();
    assert!(after.len() > 20);
    let last = after[after.len() - 1];
    // From where projectile and plug have parted for good nothing acts on it.
    let parted = after
        .iter()
        .rev()
        .take_while(|p| (*p / last - 1.0).abs() < 1e-12);
    assert!(parted.count() > after.len() / 3, "{after:?}");
    assert!((result.plug_mass.unwrap() * result.plug_velocity.unwrap() / last - 1.0).abs() < 1e-12);
}

/// The blunt shot on Weldox, at a speed and on a mesh, with more options of the chain.
fn weldox(speed: f64, elements: (u32, u32), chain: &str) -> Scenario {
    let text = format!(
        r#"
        projectile = {{ material = "tool-steel-hrc53", mass = "197 g", diameter = "20 mm", impact_velocity = "{speed} m/s" }}
        target = {{ material = "weldox-460-e", thickness = "12 mm", back_face = "free", plate_diameter = "500 mm" }}
        [chain]
        border_shear_law = "shear-band"
        projectile_elements = {}
        target_elements = {}
        {chain}
        "#,
        elements.0, elements.1
    );
    case::load_str("weldox", &text).unwrap_or_else(|error| panic!("{error}"))
}

/// Middle of a bracket between runs that are stopped and runs that go through [m/s].
fn limit(within: f64, shot: impl Fn(f64) -> Scenario) -> f64 {
    let (mut low, mut high) = (40.0, 300.0);
    while high - low > within {
        let speed = 0.5 * (low + high);
        let result = run(&shot(speed));
        balanced(&result);
        match result.outcome {
            Outcome::Perforated => high = speed,
            Outcome::AtRest | Outcome::Rebounded => low = speed,
            other => panic!("{speed} m/s: {other:?}"),
        }
    }
    0.5 * (low + high)
}

#[test]
fn limit_and_residual_velocity_converge_with_the_mesh() {
    let meshes = [(10, 6), (20, 12), (40, 24), (80, 48)];
    let limits = meshes.map(|mesh| limit(0.25, |speed| weldox(speed, mesh, "dishing = true")));
    let residuals = meshes.map(|mesh| {
        let result = run(&weldox(300.0, mesh, "dishing = true"));
        result.residual_velocity.unwrap()
    });
    println!("limits {limits:.2?} m/s, residual velocities at 300 m/s {residuals:.2?} m/s");
    for values in [limits, residuals] {
        let changes = [1, 2, 3].map(|i| (values[i] / values[i - 1] - 1.0).abs());
        assert!(
            changes[0] > changes[1] && changes[1] > changes[2],
            "{values:?}"
        );
        assert!(changes[1] < 0.04 && changes[2] < 0.006, "{values:?}");
    }
    // Against 184.5 m/s measured: 26 % high, told of in the case. A change of it is a change of the prediction.
    assert!((limits[2] / 232.7 - 1.0).abs() < 0.01, "{limits:?}");
}

#[test]
fn the_books_close_whatever_holds_the_plug() {
    let runs = [
        ("", 90.0),
        ("dishing = true", 60.0),
        ("dishing = true", 108.0),
        ("dishing = true\nconstraint_factor = 1.0", 250.0),
        ("dishing = true\nconstraint_factor = 1.0", 700.0),
        (
            "dishing = true\nerosion_strain = 0.3\nconstraint_factor = 1.0",
            600.0,
        ),
        (
            "dishing = true\nshear_band = { failure = \"never\" }",
            250.0,
        ),
        ("shear_band = { failure = \"never\" }", 300.0),
        (
            "dishing = true\nshear_band = { failure = \"instability\" }",
            400.0,
        ),
        (
            "dishing = true\nshear_band = { width = \"0.05 mm\" }",
            150.0,
        ),
        (
            "dishing = true\nartificial_viscosity = { linear = 0.06, quadratic = 1.5 }\ndamping_ratio = 0.05",
            150.0,
        ),
        (
            "rate_effects = false\nadiabatic_heating = false\nshear_band = { width = \"1 mm\" }",
            200.0,
        ),
    ];
    for (chain, speed) in runs {
        let result = run(&weldox(speed, (20, 12), chain));
        println!(
            "{speed} m/s, {chain:?}: {:?}, residuals {:.1e} and {:.1e}",
            result.outcome,
            result.numerics().energy_residual,
            result.numerics().momentum_residual
        );
        balanced(&result);
        let energy = &result.numerics().energy;
        assert!(energy.border_shear > 0.0);
        assert_eq!(energy.kinetic_plate > 0.0, chain.contains("dishing"));
    }
}

/// Half the width takes less work, twice the width more.
#[test]
fn the_width_is_the_length_scale() {
    let of_width = |width: &str| {
        let chain = format!("shear_band = {{ width = \"{width}\" }}");
        limit(2.0, |speed| weldox(speed, (20, 12), &chain))
    };
    let limits = ["0.325 mm", "0.65 mm", "1.3 mm"].map(of_width);
    println!("limits by width, rigid plate: {limits:.1?} m/s");
    assert!(limits[0] < 0.85 * limits[1] && limits[1] < 0.85 * limits[2]);
}

/// Where the plate dishes the width hardly matters from a 48th of the thickness on; what is narrower is finer than a plate's section can be told of.
#[test]
fn between_plates_only_a_narrow_width_is_the_length_scale() {
    let of_width = |width: &str| {
        let chain = format!("dishing = true\nshear_band = {{ width = \"{width}\" }}");
        limit(2.0, |speed| weldox(speed, (40, 24), &chain))
    };
    let limits = ["0.0625 mm", "0.125 mm", "0.25 mm", "0.5 mm", "1 mm"].map(of_width);
    println!("limits by width, with dishing: {limits:.1?} m/s");
    assert!((limits[3] / limits[2] - 1.0).abs() < 0.06);
    assert!((limits[4] / limits[2] - 1.0).abs() < 0.06);
    assert!(limits[1] < 0.9 * limits[2] && limits[0] < 0.75 * limits[1]);
}

#[test]
fn a_material_that_gives_no_width_is_refused_in_words() {
    let chain = model::model("chain").unwrap();
    let refused = |scenario: Scenario| match model::run(chain, &scenario, &mut Control::default()) {
        Err(percuss::Error::NotApplicable { refusal, .. }) => refusal.to_string(),
        other => panic!("{other:?}"),
    };
    let elastic = scenario(100.0, "", "");
    assert!(refused(elastic).contains("never yields"));
    let mut plastic = weldox(100.0, (20, 12), "");
    if let percuss::scenario::TargetBody::Layers { layers, .. } = &mut plastic.target {
        layers[0].material = plastic.projectile.material.clone();
    }
    assert!(refused(plastic).contains("give `chain.shear_band.width`"));
}

/// Bands follow the nodes of a plug that parts: a scab leaves, what is behind it stays held, and nothing is lost.
#[test]
fn the_books_close_where_the_plug_spalls() {
    let spall = "failure = { spall = { strength = \"600 MPa\" } }\nfracture_energy = \"20 kJ/m2\"";
    for (more, speed) in [
        ("", 60.0),
        ("", 300.0),
        ("dishing = true", 100.0),
        ("dishing = true", 300.0),
        ("dishing = true\nconstraint_factor = 1.0", 500.0),
        (
            "dishing = true\nerosion_strain = 0.3\nconstraint_factor = 1.0",
            600.0,
        ),
    ] {
        let result = run(&weldox(speed, (40, 24), &format!("{spall}\n{more}")));
        let detail = |name: &str| result.details.iter().find(|detail| detail.name == name);
        println!(
            "{more:?} {speed} m/s: {:?} by {:?}, {}; cracks {:?}, free {:?}, energy {:.1e}, momentum {:.1e}",
            result.outcome,
            result.termination,
            result.criterion,
            detail("cracks").map(|detail| detail.value),
            result
                .fragments
                .iter()
                .map(|f| (f.origin.as_str(), f.mass, f.velocity))
                .collect::<Vec<_>>(),
            result.numerics().energy_residual,
            result.numerics().momentum_residual,
        );
        balanced(&result);
        if speed >= 100.0 {
            assert!(
                detail("cracks").is_some_and(|detail| detail.value >= 1.0),
                "{more:?} {speed}"
            );
        }
        // What flies free at the end is all there is, except for what eroded, once the plug is free.
        if result.outcome == Outcome::Perforated && !more.contains("erosion") {
            let free: f64 = result.fragments.iter().map(|piece| piece.mass).sum();
            let (mass, plug) = masses();
            assert!((free / (mass + plug) - 1.0).abs() < 1e-9, "{free}");
        }
    }
}
