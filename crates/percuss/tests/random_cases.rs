//! Valid cases at random, by every model: each ends with a result that keeps the invariants, or with a typed error.
//!
//! `PERCUSS_CASES` sets how many, `PERCUSS_SEED` which; a case that fails is printed.

use std::{collections::BTreeMap, sync::Mutex};

use percuss::{
    Error, Scenario, case,
    material::Library,
    model::{self, Control, CostClass, MODELS, Model},
    outcome::{Outcome, RunResult},
};
use proptest::{
    prelude::*,
    sample::select,
    strategy::ValueTree,
    test_runner::{Config, RngAlgorithm, TestRng, TestRunner},
};
use rayon::prelude::*;

/// Cases of a test run, and the part of them that `axi` computes.
const CASES: u64 = 2000;
const AXISYMMETRIC: u64 = 20;
/// Steps of `axi`, and of the other solvers: a case that goes on is out of time.
const STEPS: [u32; 2] = [300, 4000];

/// Ends without a result.
const NOT_APPLICABLE: &str = "not applicable";
const FAILED: &str = "numerical failure";

fn material() -> impl Strategy<Value = String> {
    let ids = Library::built_in().iter().map(|entry| entry.id.clone());
    select(ids.collect::<Vec<_>>())
}

/// A nose and its length in diameters.
fn nose() -> impl Strategy<Value = (String, f64)> {
    prop_oneof![
        3 => Just((String::new(), 0.0)),
        1 => Just(("nose = \"hemisphere\"\n".to_owned(), 0.5)),
        1 => (0.5..3.0_f64).prop_map(|length| {
            (format!("nose = {{ cone = {{ length_to_diameter = {length:.2} }} }}\n"), length)
        }),
    ]
}

fn thickness() -> impl Strategy<Value = String> {
    prop_oneof![
        1 => Just("semi-infinite".to_owned()),
        4 => (0.5..80.0_f64).prop_map(|mm| format!("{mm:.3} mm")),
    ]
}

fn target() -> impl Strategy<Value = String> {
    let back = select(vec!["fixed", "free", "non-reflecting"]);
    let plate = (material(), thickness(), back).prop_map(|(material, thickness, back)| {
        let back = match thickness.as_str() {
            "semi-infinite" => String::new(),
            _ => format!("back_face = \"{back}\"\n"),
        };
        format!("material = \"{material}\"\nthickness = \"{thickness}\"\n{back}")
    });
    let layers = (material(), 0.5..20.0_f64, material(), thickness()).prop_map(
        |(first, mm, second, thickness)| {
            format!("layers = [{{ material = \"{first}\", thickness = \"{mm:.3} mm\" }}, {{ material = \"{second}\", thickness = \"{thickness}\" }}]\n")
        },
    );
    prop_oneof![
        6 => plate,
        2 => layers,
        1 => Just("rigid_wall = true\n".to_owned()),
        1 => (1.0..3000.0_f64).prop_map(|mpa| format!("constant_pressure = \"{mpa:.1} MPa\"\n")),
    ]
}

/// Options of the three numerical models.
fn options() -> impl Strategy<Value = String> {
    let chain = (
        1..30_u32,
        prop_oneof![3 => Just(None), 1 => (0.1..0.9_f64).prop_map(Some)],
    );
    let fdm = (any::<bool>(), 2..40_u32, 0.1..0.8_f64);
    let axi = (
        2..5_u32,
        1..4_u32,
        0.1..0.9_f64,
        select(vec!["free", "fixed", "non-reflecting"]),
        select(vec![
            "frictional\"\nfriction = 0.2\n",
            "frictional\"\n",
            "sticking\"\n",
        ]),
        any::<bool>(),
        prop_oneof![2 => Just(None), 1 => (0.5..3.0_f64).prop_map(Some)],
    );
    (chain, fdm, axi).prop_map(|((elements, chain_courant), fdm, axi)| {
        let (planar, cells, courant) = fdm;
        let (per_radius, per_side, axi_courant, edge, contact, rate, erosion) = axi;
        let chain_courant = chain_courant.map(|c| format!("courant = {c:.3}\n")).unwrap_or_default();
        let erosion = erosion.map(|e| format!("erosion_strain = {e:.3}\n")).unwrap_or_default();
        format!(
            "[chain]\nmax_steps = {}\nprojectile_elements = {elements}\n{chain_courant}\
             [fdm]\nmax_steps = {}\ngeometry = \"{}\"\nprojectile_elements = {cells}\ncourant = {courant:.3}\n\
             [axi]\nmax_steps = {}\ncells_per_radius = {per_radius}\nparticles_per_side = {per_side}\ncourant = {axi_courant:.3}\nedge = \"{edge}\"\n\
             contact = \"{contact}rate_effects = {rate}\n{erosion}",
            STEPS[1], STEPS[1], if planar { "planar" } else { "rod" }, STEPS[0],
        )
    })
}

prop_compose! {
    fn any_case()(
        rod in material(),
        shank in 1.0..100.0_f64,
        diameter in 0.5..30.0_f64,
        velocity in prop_oneof![1 => Just(0.0), 1 => 0.001..10.0_f64, 8 => 10.0..3000.0_f64],
        nose in nose(),
        target in target(),
        options in options(),
    ) -> String {
        let (nose, nose_length) = nose;
        let length = shank + (nose_length + 0.01) * diameter;
        // A wall has neither edge nor contact.
        let of_target = ["edge", "contact", "friction"];
        let options: String = options
            .lines()
            .filter(|line| target.contains("material") || !of_target.iter().any(|key| line.starts_with(key)))
            .map(|line| format!("{line}\n"))
            .collect();
        format!(
            "[projectile]\nmaterial = \"{rod}\"\nlength = \"{length:.3} mm\"\ndiameter = \"{diameter:.3} mm\"\nimpact_velocity = \"{velocity:.4} m/s\"\n{nose}\
             [target]\n{target}{options}"
        )
    }
}

/// What is wrong with a result, if anything is.
fn broken(model: &dyn Model, scenario: &Scenario, result: &RunResult) -> Option<String> {
    let numbers = [
        ("depth", result.depth_of_penetration),
        ("residual velocity", result.residual_velocity),
        ("final length", result.projectile_final_length),
        ("final mass", result.projectile_final_mass),
        ("peak force", result.peak_force),
        ("end time", result.end_time),
    ];
    for (name, number) in numbers {
        let Some(number) = number else { continue };
        if !number.is_finite() {
            return Some(format!("{name} = {number}"));
        }
        if number < 0.0 && !["residual velocity", "peak force", "depth"].contains(&name) {
            return Some(format!("{name} = {number}"));
        }
    }
    let speed = result.residual_velocity.unwrap_or(0.0).abs();
    if speed > scenario.impact_velocity * (1.0 + 1e-9) {
        return Some(format!(
            "it leaves at {speed} m/s and came at {}",
            scenario.impact_velocity
        ));
    }
    let thickness = scenario.target_thickness().unwrap_or(f64::INFINITY);
    let depth = result.depth_of_penetration.unwrap_or(0.0);
    // The tip of a nose that is stuck may stand out behind.
    let nose = scenario
        .projectile
        .nose
        .length(scenario.projectile.diameter);
    // A plate that dishes takes the crater along.
    let mut dished = result.details.iter();
    let dished = dished.find(|detail| detail.name == "deflection of the plate at the rim");
    let dished = dished.map_or(0.0, |detail| detail.value * 1e-3);
    if depth - dished > thickness + nose
        && result.outcome != Outcome::Perforated
        && !model.has_fields()
    {
        return Some(format!("depth {depth} m in a target of {thickness} m"));
    }
    if depth < -1e-3 * scenario.projectile.length {
        return Some(format!("depth {depth} m"));
    }
    let numerics = result.numerics.as_ref()?;
    let balances = [numerics.energy_residual, numerics.momentum_residual];
    // Not a number is none.
    if !balances
        .iter()
        .all(|residual| (0.0..=0.05).contains(residual))
    {
        return Some(format!("balances {balances:?}"));
    }
    None
}

/// Runs a case by a model, twice; gives the kind of its end, or what is wrong.
fn check(model: &dyn Model, scenario: &Scenario) -> Result<String, String> {
    let run = || model::run(model, scenario, &mut Control::default());
    let result = match run() {
        Ok(result) => result,
        Err(Error::NotApplicable { .. }) => return Ok(NOT_APPLICABLE.to_owned()),
        Err(Error::Numerical(_)) => return Ok(FAILED.to_owned()),
        Err(other) => return Err(format!("{other}")),
    };
    if let Some(what) = broken(model, scenario, &result) {
        return Err(what);
    }
    let again = run().map(|again| format!("{again:?}"));
    match again.is_ok_and(|again| again == format!("{result:?}")) {
        true => Ok(format!("{:?}", result.outcome)),
        false => Err("another result when it is repeated".to_owned()),
    }
}

/// Cases of longer runs in which a rule was broken.
const FOUND: [&str; 1] = [
    // Three bodies stuck at the same nodes pair by pair, and contact gave energy.
    r#"
    projectile = { material = "bis-uhh-plate", length = "78.479 mm", diameter = "26.296 mm", impact_velocity = "5.0098 m/s" }
    target.layers = [{ material = "weldox-700-e-flores-johnson", thickness = "5.831 mm" }, { material = "6082-t6-plate", thickness = "5.665 mm" }]
    axi = { max_steps = 300, cells_per_radius = 4, particles_per_side = 3, courant = 0.686, edge = "fixed", contact = "sticking", rate_effects = false, erosion_strain = 1.189 }
    "#,
];

#[test]
fn what_was_found_keeps_the_rules() {
    for text in FOUND {
        let scenario = case::load_str("found", text).unwrap();
        for model in MODELS {
            if let Err(what) = check(*model, &scenario) {
                panic!("{}: {what}\n{text}", model.name());
            }
        }
    }
}

/// A metal in plane strain, whose particles have a stress: a strip on a wall, or a plate under a rigid projectile.
fn any_metal() -> impl Strategy<Value = String> {
    let packing = select(vec!["hexagonal", "irregular"]);
    let options = (
        packing,
        0.1..0.6_f64,
        select(vec!["linear", "mie-gruneisen"]),
        any::<bool>(),
        any::<bool>(),
    );
    let case = (
        material(),
        10.0..1000.0_f64,
        any::<bool>(),
        nose(),
        0.0..60.0_f64,
    );
    (case, options).prop_map(|((material, velocity, on_wall, (nose, length), angle), options)| {
        let (packing, courant, state, rate, heat) = options;
        let length = 6.0 * (length + 1.0);
        let particles = format!(
            "[particles]\nformulation = \"particle-stress\"\nspacing = \"0.8 mm\"\npacking = \"{packing}\"\ncourant = {courant:.3}\nfracture = false\n\
             equation_of_state = \"{state}\"\nrate_effects = {rate}\nadiabatic_heating = {heat}\nmax_steps = 400\n"
        );
        match on_wall {
            true => format!(
                "projectile = {{ material = \"{material}\", length = \"12 mm\", diameter = \"5 mm\", impact_velocity = \"{velocity:.3} m/s\" }}\n\
                 target.rigid_wall = true\n{particles}"
            ),
            false => format!(
                "[projectile]\nmaterial = \"hard\"\nlength = \"{length:.3} mm\"\ndiameter = \"5 mm\"\nimpact_velocity = \"{velocity:.3} m/s\"\n\
                 obliquity = \"{angle:.2} deg\"\n{nose}[target]\nmaterial = \"{material}\"\nthickness = \"6 mm\"\nback_face = \"free\"\n\
                 {particles}width = \"30 mm\"\n[materials.hard]\nname = \"Elastic\"\ndensity = \"7800 kg/m3\"\nyoungs_modulus = \"200 GPa\"\n\
                 poissons_ratio = 0.3\nstrength.elastic = {{}}\n"
            ),
        }
    })
}

/// A solid of bonded particles: a strip on a wall, or a plate that may break under a rigid projectile.
fn any_brittle() -> impl Strategy<Value = String> {
    let ids = [
        "alumina-98-makeitfrom",
        "boron-carbide-makeitfrom",
        "concrete-35-elastic",
        "silicon-carbide-makeitfrom",
        "soda-lime-glass-float",
        "soft",
    ];
    // In three dimensions there is one packing and one way to fail.
    let kind = prop_oneof![
        6 => (
            select(vec!["plane-strain", "plane-stress"]),
            select(vec!["hexagonal", "irregular"]),
            select(vec!["elongation", "principal-stress"]),
        )
            .prop_map(|(space, packing, failure)| {
                format!("space = \"{space}\"\npacking = \"{packing}\"\nfailure_criterion = \"{failure}\"\n")
            }),
        1 => Just("space = \"3d\"\n".to_owned()),
    ];
    let options = (kind, 0.05..0.5_f64, 1.0..20.0_f64, any::<bool>());
    let case = (
        select(ids.to_vec()),
        1.0..200.0_f64,
        any::<bool>(),
        nose(),
        0.0..60.0_f64,
    );
    (case, options).prop_map(|((material, velocity, on_wall, (nose, length), angle), options)| {
        let (kind, courant, softening, breaks) = options;
        let length = 6.0 * (length + 1.0);
        let solid = kind.contains("3d");
        let spacing = if solid { 1.2 } else { 0.7 };
        let breaks = breaks && material != "soft";
        let fracture = match breaks {
            true => format!("softening = {softening:.2}\n"),
            false => "fracture = false\n".to_owned(),
        };
        let kind: String = (kind.lines())
            .filter(|line| breaks || !line.starts_with("failure_criterion"))
            .map(|line| format!("{line}\n"))
            .collect();
        let particles = format!(
            "[particles]\nspacing = \"{spacing} mm\"\ncourant = {courant:.3}\nmax_steps = 400\n{kind}{fracture}"
        );
        let own = "[materials.soft]\nname = \"Elastic\"\ndensity = \"1200 kg/m3\"\nyoungs_modulus = \"3 GPa\"\n\
             poissons_ratio = 0.1\nstrength.elastic = {}\n\
             [materials.hard]\nname = \"Elastic\"\ndensity = \"7800 kg/m3\"\nyoungs_modulus = \"200 GPa\"\n\
             poissons_ratio = 0.3\nstrength.elastic = {}\n";
        match on_wall && !solid {
            true => format!(
                "projectile = {{ material = \"{material}\", length = \"12 mm\", diameter = \"5 mm\", impact_velocity = \"{velocity:.3} m/s\" }}\n\
                 target.rigid_wall = true\n{particles}{own}"
            ),
            false => {
                let oblique = match solid {
                    true => String::new(),
                    false => format!("obliquity = \"{angle:.2} deg\"\n"),
                };
                let nose = match solid {
                    true => "nose = \"hemisphere\"\n".to_owned(),
                    false => nose,
                };
                format!(
                    "[projectile]\nmaterial = \"hard\"\nlength = \"{length:.3} mm\"\ndiameter = \"5 mm\"\nimpact_velocity = \"{velocity:.3} m/s\"\n\
                     {oblique}{nose}[target]\nmaterial = \"{material}\"\nthickness = \"6 mm\"\nback_face = \"free\"\n\
                     {particles}width = \"20 mm\"\n{own}"
                )
            }
        }
    })
}

/// Cases for models of narrow ranges: long rods on thick steel, and rigid projectiles in concrete.
fn any_of_narrow_ranges() -> impl Strategy<Value = String> {
    let rods = vec![
        "tungsten-alloy-steinberg",
        "4340-johnson-cook",
        "rha-class-1-plate",
    ];
    let long_rod = (select(rods), 2.0..12.0_f64, 8.0..35.0_f64, 900.0..2600.0_f64).prop_map(
        |(rod, diameter, slenderness, velocity)| {
            let length = diameter * slenderness;
            format!(
                "projectile = {{ material = \"{rod}\", length = \"{length:.3} mm\", diameter = \"{diameter:.3} mm\", impact_velocity = \"{velocity:.3} m/s\" }}\n\
                 target = {{ material = \"rha-class-1-plate\", thickness = \"semi-infinite\" }}\n"
            )
        },
    );
    let concrete = (10.0..90.0_f64, 4.0..12.0_f64, 1.0..6.0_f64, 100.0..1000.0_f64).prop_map(
        |(diameter, slenderness, crh, velocity)| {
            let length = diameter * slenderness;
            format!(
                "projectile = {{ material = \"4340-johnson-cook\", length = \"{length:.3} mm\", diameter = \"{diameter:.3} mm\", \
                 impact_velocity = \"{velocity:.3} m/s\", nose = {{ ogive = {{ crh = {crh:.2} }} }} }}\n\
                 target = {{ material = \"concrete-35-forrestal\", thickness = \"semi-infinite\" }}\n"
            )
        },
    );
    prop_oneof![long_rod, concrete]
}

/// So many cases of a seed.
pub fn texts(cases: u64, seed: u64) -> Vec<String> {
    drawn(&any_case(), cases, seed)
}

/// So many texts of a kind, of a seed.
fn drawn(strategy: &impl Strategy<Value = String>, cases: u64, seed: u64) -> Vec<String> {
    let mut bytes = [0; 32];
    bytes[..8].copy_from_slice(&seed.to_le_bytes());
    let random = TestRng::from_seed(RngAlgorithm::ChaCha, &bytes);
    let mut runner = TestRunner::new_with_rng(Config::default(), random);
    (0..cases)
        .map(|_| strategy.new_tree(&mut runner).unwrap().current())
        .collect()
}

fn from_environment(name: &str, default: u64) -> u64 {
    std::env::var(name).map_or(default, |text| text.parse().unwrap())
}

#[test]
fn valid_cases_keep_the_invariants_in_every_model() {
    let cases = from_environment("PERCUSS_CASES", CASES);
    let seed = from_environment("PERCUSS_SEED", 1);
    let slow = |model: &dyn Model, i: usize| {
        model.cost() == CostClass::Minutes && !(i as u64).is_multiple_of(AXISYMMETRIC)
    };
    let results = keep_the_invariants(&texts(cases, seed), |model, i| !slow(model, i));
    // Those without a result here have cases of their own below.
    let others = ["particles", "lanz_odermatt"];
    for model in MODELS {
        let has_some = results.contains_key(model.name());
        assert!(
            has_some || others.contains(&model.name()),
            "{}",
            model.name()
        );
    }
}

#[test]
fn metals_in_plane_strain_keep_the_invariants() {
    let cases = from_environment("PERCUSS_CASES", CASES) / AXISYMMETRIC;
    let seed = from_environment("PERCUSS_SEED", 1);
    let results = keep_the_invariants(&drawn(&any_metal(), cases, seed), |model, _| {
        model.name() == "particles"
    });
    assert!(2 * results["particles"] > cases, "{results:?}");
}

#[test]
fn bonded_particles_keep_the_invariants() {
    let cases = from_environment("PERCUSS_CASES", CASES) / AXISYMMETRIC;
    let seed = from_environment("PERCUSS_SEED", 1);
    let results = keep_the_invariants(&drawn(&any_brittle(), cases, seed), |model, _| {
        model.name() == "particles"
    });
    assert!(2 * results["particles"] > cases, "{results:?}");
}

#[test]
fn models_of_narrow_ranges_keep_the_invariants() {
    let cases = from_environment("PERCUSS_CASES", CASES) / 10;
    let seed = from_environment("PERCUSS_SEED", 1);
    let results = keep_the_invariants(&drawn(&any_of_narrow_ranges(), cases, seed), |model, _| {
        model.cost() != CostClass::Minutes
    });
    for model in ["lanz_odermatt", "forrestal_concrete"] {
        assert!(10 * results[model] > cases, "{results:?}");
    }
}

/// Runs cases by the models that are asked for a case of a number; gives how many results each has.
fn keep_the_invariants(
    texts: &[String],
    asks: impl Fn(&dyn Model, usize) -> bool + Sync,
) -> BTreeMap<&'static str, u64> {
    let ends: Mutex<BTreeMap<(&'static str, String), u64>> = Mutex::default();
    let failures: Mutex<Vec<String>> = Mutex::default();
    texts.par_iter().enumerate().for_each(|(i, text)| {
        let scenario = match case::load_str("random", text) {
            Ok(scenario) => scenario,
            Err(error) => {
                failures.lock().unwrap().push(format!("{error}\n{text}"));
                return;
            }
        };
        for model in MODELS {
            if !asks(*model, i) {
                continue;
            }
            match check(*model, &scenario) {
                Ok(end) => *ends.lock().unwrap().entry((model.name(), end)).or_default() += 1,
                Err(what) => failures
                    .lock()
                    .unwrap()
                    .push(format!("{}: {what}\n{text}", model.name())),
            }
        }
    });
    let mut results = BTreeMap::new();
    for ((model, end), count) in ends.into_inner().unwrap() {
        println!("{model:20} {end:20} {count}");
        if ![NOT_APPLICABLE, FAILED].contains(&end.as_str()) {
            *results.entry(model).or_default() += count;
        }
    }
    let failures = failures.into_inner().unwrap();
    let shown: Vec<&str> = failures.iter().take(5).map(String::as_str).collect();
    assert!(
        failures.is_empty(),
        "{} failures:\n{}",
        failures.len(),
        shown.join("\n\n")
    );
    results
}
