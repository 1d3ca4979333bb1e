//! Every numerical solver continues from a checkpoint with the same bits, and gives its fields.

use std::{ops::ControlFlow, sync::Arc};

use percuss::{
    Error, Scenario, case,
    frames::{Fields, Frame},
    model::{self, Checkpoints, Control},
    outcome::{Outcome, RunResult},
    resistance::{CustomResistance, ResistanceLaw},
};

/// A model with a case for each kind of state that its checkpoints hold.
const CASES: &[(&str, &str, &str)] = &[
    ("target column, eroding", "chain", COLUMN),
    ("plug, plate that dishes, shear bands", "chain", PLUG),
    ("cracks in a plate", "chain", FAILURE),
    ("expanding cavity, free rear face", "chain", CAVITY),
    ("expanding cavity, cracks", "chain", CAVITY_FAILURE),
    ("published scheme", "chain", PUBLISHED),
    ("rod", "fdm", COLUMN_WITHOUT_EROSION),
    ("planar impact with spall", "fdm", SPALL),
    ("plug that damage cuts out", "axi", CUT),
    ("nose whose surface is followed", "axi", ROUND),
    ("lattice under a rigid nose", "particles", LATTICE),
    ("pieces of a lattice", "particles", PIECES),
    ("pieces at an angle", "particles", OBLIQUE),
    ("pieces in space", "particles", IN_SPACE),
    ("cracks from a notch", "particles", NOTCHED),
    ("disc", "particles", DISC),
    ("bonds that fail by their stress", "particles", BY_STRESS),
    ("balls with friction", "particles", BALLS),
    ("strip of metal on a wall", "particles", METAL_STRIP),
    ("metal under a rigid nose", "particles", METAL_PLATE),
];

const COLUMN: &str = r#"
    projectile = { material = "copper", length = "12.74 mm", diameter = "4.8 mm", impact_velocity = "800 m/s" }
    target = { material = "aluminium-2024-t351", thickness = "50 mm" }
    chain = { target_resistance = "column", erosion_strain = 1.0 }
    history = { interval = "0.3 us" }
"#;
const COLUMN_WITHOUT_EROSION: &str = r#"
    projectile = { material = "copper", length = "12.74 mm", diameter = "4.8 mm", impact_velocity = "230 m/s" }
    target = { material = "aluminium-2024-t351", thickness = "50 mm" }
"#;
const CUT: &str = r#"
    projectile = { material = "tool-steel-hrc53", length = "10 mm", diameter = "20 mm", impact_velocity = "500 m/s" }
    target = { material = "weldox-460-e", thickness = "5 mm", back_face = "free" }
    axi = { cells_per_radius = 4, target_radius = "30 mm" }
"#;
const ROUND: &str = r#"
    projectile = { material = "tool-steel-hrc53", length = "20 mm", diameter = "20 mm", impact_velocity = "500 m/s", nose = "hemisphere" }
    target = { material = "weldox-460-e", thickness = "5 mm", back_face = "free" }
    axi = { cells_per_radius = 4, target_radius = "30 mm" }
"#;
/// Materials of a rigid projectile and of a target that breaks.
macro_rules! hard_and_brittle {
    () => {
        r#"
    [materials.hard]
    name = "Elastic"
    density = "2500 kg/m3"
    youngs_modulus = "70 GPa"
    poissons_ratio = 0.22
    strength.elastic = {}
    [materials.brittle]
    name = "Glass"
    density = "2500 kg/m3"
    youngs_modulus = "70 GPa"
    poissons_ratio = 0.22
    strength.elastic = {}
    fracture = { energy = "8 J/m2", tensile_strength = "40 MPa" }
"#
    };
}

const LATTICE: &str = r#"
    projectile = { material = "hard", length = "10 mm", diameter = "6 mm", impact_velocity = "20 m/s", nose = "hemisphere" }
    target = { material = "hard", thickness = "5 mm", back_face = "free" }
    particles = { spacing = "0.7 mm", width = "40 mm" }
    [materials.hard]
    name = "Elastic"
    density = "2500 kg/m3"
    youngs_modulus = "70 GPa"
    poissons_ratio = 0.22
    strength.elastic = {}
"#;
const PIECES: &str = concat!(
    r#"
    projectile = { material = "hard", length = "10 mm", diameter = "6 mm", impact_velocity = "20 m/s", nose = "hemisphere" }
    target = { material = "brittle", thickness = "5 mm", back_face = "free" }
    particles = { spacing = "0.7 mm", width = "40 mm", end_time = "40 us" }
"#,
    hard_and_brittle!()
);
const OBLIQUE: &str = concat!(
    r#"
    projectile = { material = "hard", length = "10 mm", diameter = "6 mm", impact_velocity = "30 m/s", nose = "hemisphere", obliquity = "40 deg" }
    target = { material = "brittle", thickness = "5 mm", back_face = "free" }
    particles = { spacing = "0.7 mm", width = "40 mm", end_time = "40 us" }
"#,
    hard_and_brittle!()
);
const IN_SPACE: &str = concat!(
    r#"
    projectile = { material = "hard", length = "6 mm", diameter = "6 mm", impact_velocity = "30 m/s", nose = "hemisphere", obliquity = "20 deg" }
    target = { material = "brittle", thickness = "4 mm", back_face = "free" }
    particles = { space = "3d", spacing = "0.9 mm", width = "16 mm", end_time = "12 us", courant = 0.3 }
"#,
    hard_and_brittle!()
);
const NOTCHED: &str = concat!(
    r#"
    projectile = { material = "hard", length = "10 mm", diameter = "6 mm", impact_velocity = "20 m/s" }
    target = { material = "brittle", thickness = "6 mm", back_face = "free" }
    particles = { spacing = "0.7 mm", width = "40 mm", end_time = "40 us", notches = [{ from = ["3.2 mm", "6 mm"], to = ["3.2 mm", "3 mm"] }] }
"#,
    hard_and_brittle!()
);
const DISC: &str = concat!(
    r#"
    projectile = { material = "hard", length = "10 mm", diameter = "6 mm", impact_velocity = "20 m/s" }
    target = { material = "brittle", thickness = "10 mm", back_face = "free" }
    particles = { spacing = "0.7 mm", outline = "disc", end_time = "40 us" }
"#,
    hard_and_brittle!()
);
const BALLS: &str = concat!(
    r#"
    projectile = { material = "hard", mass = "0.2827433 g", diameter = "6 mm", impact_velocity = "5 m/s", nose = "hemisphere", obliquity = "20 deg" }
    target = { material = "hard", thickness = "5 mm", back_face = "free" }
    particles = { contact = "hertz", outline = "ball" }
"#,
    hard_and_brittle!()
);
const BY_STRESS: &str = concat!(
    r#"
    projectile = { material = "hard", length = "10 mm", diameter = "6 mm", impact_velocity = "20 m/s", nose = "hemisphere" }
    target = { material = "brittle", thickness = "5 mm", back_face = "free" }
    particles = { spacing = "0.22 mm", width = "40 mm", end_time = "15 us", failure_criterion = "principal-stress" }
"#,
    hard_and_brittle!()
);
const METAL_STRIP: &str = r#"
    projectile = { material = "copper", length = "12 mm", diameter = "4 mm", impact_velocity = "200 m/s" }
    target = { rigid_wall = true }
    particles = { formulation = "particle-stress", packing = "irregular", end_time = "15 us" }
"#;
const METAL_PLATE: &str = concat!(
    r#"
    projectile = { material = "hard", length = "10 mm", diameter = "6 mm", impact_velocity = "200 m/s", nose = "hemisphere", obliquity = "20 deg" }
    target = { material = "ofhc-copper-johnson-cook", thickness = "6 mm", back_face = "free" }
    particles = { formulation = "particle-stress", width = "30 mm", equation_of_state = "mie-gruneisen", end_time = "10 us" }
"#,
    hard_and_brittle!()
);
const PLUG: &str = include_str!("../../../cases/weldox-460e-12mm-blunt/scenario.toml");
const FAILURE: &str = include_str!("../../../cases/spall-two-plates/scenario.toml");
const CAVITY: &str = r#"
    projectile = { material = "copper", length = "12.74 mm", diameter = "4.8 mm", impact_velocity = "230 m/s" }
    target = { material = "aluminium-2024-t351", thickness = "25 mm", back_face = "free" }
"#;
const CAVITY_FAILURE: &str = r#"
    projectile = { material = "copper", length = "12.74 mm", diameter = "4.8 mm", impact_velocity = "400 m/s" }
    target = { material = "aluminium-2024-t351", thickness = "25 mm" }
    chain.failure.spall.strength = '80 MPa'
"#;
const PUBLISHED: &str = r#"
    projectile = { material = "copper", length = "12.74 mm", diameter = "4.8 mm", impact_velocity = "230 m/s" }
    target = { material = "aluminium-2024-t351", thickness = "25 mm" }
    chain = { scheme = "published" }
"#;
const SPALL: &str = r#"
    projectile = { material = "ofhc-copper-steinberg", length = "2 mm", diameter = "80 mm", impact_velocity = "400 m/s" }
    target = { material = "ofhc-copper-steinberg", thickness = "4 mm", back_face = "free" }
    fdm = { geometry = "planar", spall_strength = "1 GPa", projectile_elements = 40 }
"#;

fn scenario(text: &str) -> Scenario {
    // Histories at gauges continue too.
    let second = match text.contains("rigid_wall") {
        true => "-2 mm",
        false => "2 mm",
    };
    let gauges = format!("[[gauges]]\nposition = '-1 mm'\n[[gauges]]\nposition = '{second}'\n");
    case::load_str("checkpoints", &format!("{text}\n{gauges}")).unwrap()
}

fn run(model: &str, scenario: &Scenario, control: &mut Control<'_>) -> Result<RunResult, Error> {
    model::run(model::model(model).unwrap(), scenario, control)
}

/// Keeps one checkpoint and stops the run there.
struct Keeper {
    asked: u32,
    wanted: u32,
    kept: Vec<u8>,
}

impl Checkpoints for Keeper {
    fn is_due(&mut self) -> bool {
        self.asked += 1;
        self.asked == self.wanted
    }

    fn keep(&mut self, bytes: &[u8]) -> ControlFlow<()> {
        self.kept = bytes.to_vec();
        ControlFlow::Break(())
    }
}

/// Checkpoint at the opportunity with this number, counted from 1; `None` in a run that ends before.
fn interrupted(model: &str, scenario: &Scenario, wanted: u32) -> Option<Vec<u8>> {
    let mut keeper = Keeper {
        asked: 0,
        wanted,
        kept: Vec::new(),
    };
    let mut control = Control {
        checkpoints: Some(&mut keeper),
        ..Control::recording()
    };
    match run(model, scenario, &mut control) {
        Err(Error::Cancelled { .. }) => Some(keeper.kept),
        Ok(_) => None,
        Err(other) => panic!("{other}"),
    }
}

/// All numbers of a result, as text: what is gone has no velocity, which is a number that equals no other.
fn numbers(result: &RunResult) -> String {
    format!("{result:?}")
}

#[test]
fn every_solver_continues_from_a_checkpoint_with_the_same_bits() {
    for (what, model, text) in CASES {
        let scenario = scenario(text);
        let whole = run(model, &scenario, &mut Control::recording())
            .unwrap_or_else(|error| panic!("{what}: {error}"));
        let of_whole = numbers(&whole);
        let mut resumed = 0;
        let mut wanted = 1;
        while let Some(bytes) = interrupted(model, &scenario, wanted) {
            let mut control = Control {
                resume: Some(&bytes),
                ..Control::recording()
            };
            let result = run(model, &scenario, &mut control).unwrap();
            assert!(numbers(&result) == of_whole, "{what}, checkpoint {wanted}");
            resumed += 1;
            wanted *= 3;
        }
        println!(
            "{what}: {} steps, {resumed} checkpoints, {} warnings",
            whole.numerics().steps,
            whole.warnings.len()
        );
        assert!(resumed >= 2, "{what}: {}", whole.numerics().steps);
    }
}

/// Bonds that break, pieces that meet, notches: none of it depends on how the work is shared.
#[test]
fn cracks_have_the_same_bits_on_any_number_of_threads() {
    for text in [PIECES, OBLIQUE, IN_SPACE, NOTCHED, DISC, BY_STRESS] {
        let scenario = scenario(text);
        let on = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            let pool = pool.build().unwrap();
            pool.install(|| run("particles", &scenario, &mut Control::recording()).unwrap())
        };
        let one = on(1);
        let of_one = numbers(&one);
        assert!(one.cracks.as_ref().unwrap().broken_bonds > 0, "{text}");
        for threads in [2, 3, 8] {
            assert!(numbers(&on(threads)) == of_one, "{threads} threads: {text}");
        }
    }
}

/// The end of a run is no part of its state: a checkpoint goes on to a later one, with the bits of a run that had it from the start.
#[test]
fn a_checkpoint_goes_on_to_a_later_end() {
    let early = scenario(PIECES);
    let mut late = early.clone();
    late.options.particles.end_time = Some("45 us".parse().unwrap());
    let bytes = interrupted("particles", &early, 2).unwrap();
    let mut control = Control {
        resume: Some(&bytes),
        ..Control::recording()
    };
    let resumed = run("particles", &late, &mut control).unwrap();
    let whole = run("particles", &late, &mut Control::recording()).unwrap();
    assert!(resumed.end_time.unwrap() > 44e-6);
    let numbers = |result: &RunResult| {
        let state = (
            result.residual_velocity,
            result.largest_depth,
            result.cracks,
        );
        format!("{state:?} {:?}", result.details)
    };
    assert_eq!(numbers(&resumed), numbers(&whole));
}

#[test]
fn the_cases_reach_the_states_that_they_are_for() {
    let result = |index: usize| {
        let (_, model, text) = CASES[index];
        run(model, &scenario(text), &mut Control::default()).unwrap()
    };
    assert!(result(0).numerics().eroded_elements.0 > 0);
    assert!(result(1).numerics().energy.plastic_plate > 0.0);
    for index in [2, 4] {
        let cracks = |r: &RunResult| r.details.iter().any(|detail| detail.name == "cracks");
        assert!(cracks(&result(index)), "{index}");
    }
    let spall = |detail: &&percuss::outcome::Detail| detail.name == "spall planes";
    let spalled = result(7).details.iter().find(spall).unwrap().value;
    assert!(spalled > 0.0);
    let cut = result(8);
    assert!(cut.outcome == Outcome::Perforated && cut.numerics().eroded_elements.1 > 0);
}

#[test]
fn a_checkpoint_of_another_solver_of_the_same_model_is_refused() {
    let (column, cavity) = (scenario(COLUMN), scenario(CAVITY));
    let bytes = interrupted("chain", &column, 1).unwrap();
    let mut control = Control {
        resume: Some(&bytes),
        ..Control::default()
    };
    let refused = run("chain", &cavity, &mut control);
    assert!(
        matches!(refused, Err(Error::Checkpoint { .. })),
        "{refused:?}"
    );
}

/// A constant that differs in its last digits makes another case.
#[test]
fn a_checkpoint_of_almost_the_same_case_is_refused() {
    let column = scenario(COLUMN);
    let bytes = interrupted("chain", &column, 1).unwrap();
    let resume = |stiffer: f64| {
        let mut other = column.clone();
        let material = &column.projectile.material;
        let modulus = material.youngs_modulus.si() * stiffer;
        other.projectile.material = std::sync::Arc::new(percuss::material::Material {
            youngs_modulus: percuss::units::Pressure::new(modulus),
            ..(**material).clone()
        });
        let mut control = Control {
            resume: Some(&bytes),
            ..Control::default()
        };
        run("chain", &other, &mut control)
    };
    assert!(resume(1.0).is_ok());
    let refused = resume(1.0 + 1e-12).unwrap_err().to_string();
    assert!(refused.contains("another case"), "{refused}");
}

#[test]
fn a_resumed_run_keeps_the_courant_number_that_it_was_reduced_to() {
    // The rod's default Courant number is too large for this viscosity.
    let viscous = "fdm.artificial_viscosity = { linear = 2.0, quadratic = 0.0 }";
    let scenario = scenario(&format!(
        r#"
        projectile = {{ material = "6061-t6-lesuer", length = "12.74 mm", diameter = "4.8 mm", impact_velocity = "230 m/s" }}
        target = {{ material = "4340-johnson-cook", thickness = "20 mm" }}
        {viscous}
        "#
    ));
    let whole = run("fdm", &scenario, &mut Control::recording()).unwrap();
    let is_reduced = |result: &RunResult| result.warnings.iter().any(|w| w.contains("reduced"));
    assert!(is_reduced(&whole), "{:?}", whole.warnings);
    let mut last = None;
    let mut wanted = 1;
    while let Some(bytes) = interrupted("fdm", &scenario, wanted) {
        last = Some(bytes);
        wanted *= 2;
    }
    let bytes = last.unwrap();
    let mut control = Control {
        resume: Some(&bytes),
        ..Control::recording()
    };
    let resumed = run("fdm", &scenario, &mut control).unwrap();
    assert!(numbers(&resumed) == numbers(&whole));
}

#[test]
fn every_solver_gives_its_fields_from_the_start_to_the_end() {
    for (what, model, text) in CASES {
        let scenario = scenario(text);
        let mut times = Vec::new();
        let mut look = |frame: &Frame<'_>| {
            let (has_projectile, is_sound) = match &frame.fields {
                Fields::Elements(elements) => (
                    elements.iter().any(|element| element.part == 0),
                    elements.iter().all(|element| element.length > 0.0),
                ),
                Fields::Particles { bodies, .. } => (
                    !bodies[0].is_empty(),
                    bodies
                        .iter()
                        .flat_map(|body| body.iter())
                        .all(|p| p.mass == 0.0 || p.volume > 0.0),
                ),
                _ => panic!("{what}"),
            };
            assert!(has_projectile || frame.step > 0, "{what}");
            // Springs of the published scheme may invert.
            assert!(is_sound || *what == "published scheme", "{what}");
            // A run that is repeated with a smaller Courant number starts again.
            if frame.step == 0 {
                times.clear();
            }
            if !frame.last {
                times.push(frame.time);
            }
            ControlFlow::Continue(())
        };
        let mut control = Control {
            frames: Some(&mut look),
            ..Control::default()
        };
        let result = run(model, &scenario, &mut control).unwrap();
        assert!(times.len() > 9 && times[0] == 0.0, "{what}: {times:?}");
        assert!(times.is_sorted() && times[times.len() - 1] <= result.end_time.unwrap());
    }
}

/// A changed bit is found wherever it is: in what a checkpoint says of itself, and in the state.
#[test]
fn a_changed_bit_of_a_checkpoint_is_found() {
    let scenario = scenario(COLUMN_WITHOUT_EROSION);
    let kept = interrupted("chain", &scenario, 3).unwrap();
    let continued = |bytes: &[u8]| {
        let mut control = Control {
            resume: Some(bytes),
            ..Control::recording()
        };
        run("chain", &scenario, &mut control)
    };
    let mut changed = kept.clone();
    // All of the first bytes, and as many bits of the rest, at an odd distance.
    let apart = (kept.len() / 80) | 1;
    let bits = (0..8 * 80).chain((8 * 80..8 * kept.len()).step_by(apart));
    for bit in bits {
        changed[bit / 8] ^= 1 << (bit % 8);
        let error = continued(&changed).unwrap_err();
        assert!(
            matches!(error, Error::Checkpoint { .. }),
            "bit {bit}: {error}"
        );
        changed[bit / 8] ^= 1 << (bit % 8);
    }
    assert!(continued(&kept).is_ok());
}

/// A law of the caller's own, with and without a fingerprint.
struct Constant(f64, bool);

impl ResistanceLaw for Constant {
    fn pressure(&self, _: f64, _: f64) -> f64 {
        self.0
    }

    fn fingerprint(&self) -> Option<String> {
        self.1.then(|| format!("constant {}", self.0))
    }
}

#[test]
fn a_checkpoint_belongs_to_the_law_that_a_program_brought() {
    let with = |law: Constant| Scenario {
        resistance: Some(CustomResistance(Arc::new(law))),
        ..case::load_str("own", CAVITY).unwrap()
    };
    let resume = |scenario: &Scenario, bytes: &[u8]| {
        let mut control = Control {
            resume: Some(bytes),
            ..Control::default()
        };
        run("chain", scenario, &mut control)
    };
    let bytes = interrupted("chain", &with(Constant(2e9, true)), 3).unwrap();
    assert!(resume(&with(Constant(2e9, true)), &bytes).is_ok());
    let other = resume(&with(Constant(5e9, true)), &bytes).unwrap_err();
    assert!(other.to_string().contains("another case"), "{other}");
    // Without one, before the first step.
    let mut keeper = Keeper {
        asked: 0,
        wanted: u32::MAX,
        kept: Vec::new(),
    };
    let mut control = Control {
        checkpoints: Some(&mut keeper),
        ..Control::default()
    };
    let refused = run("chain", &with(Constant(2e9, false)), &mut control).unwrap_err();
    assert!(matches!(refused, Error::Checkpoint { .. }), "{refused}");
    assert_eq!(keeper.asked, 0);
    let nothing = run(
        "chain",
        &with(Constant(f64::NAN, true)),
        &mut Control::default(),
    );
    assert!(nothing.unwrap_err().to_string().contains("NaN Pa"));
}

#[test]
fn a_history_is_that_of_the_whole_run() {
    let scenario = case::load_str("silent", CAVITY).unwrap();
    let mut keeper = Keeper {
        asked: 0,
        wanted: 3,
        kept: Vec::new(),
    };
    let mut control = Control {
        checkpoints: Some(&mut keeper),
        ..Control::default()
    };
    assert!(run("chain", &scenario, &mut control).is_err());
    let mut control = Control {
        resume: Some(&keeper.kept),
        ..Control::recording()
    };
    let refused = run("chain", &scenario, &mut control).unwrap_err();
    assert!(refused.to_string().contains("kept no history"), "{refused}");
}
