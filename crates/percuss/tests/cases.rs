//! Expected values of every folder of `cases/`.
//!
//! After an intended change of results, `RETAKE_GOLDEN=1 cargo test -p percuss --test all cases::` writes the golden numbers and the
//! known errors of the files again; exact, published and measured values stay as they are. The difference is for a person to read.

use std::{
    collections::HashMap,
    env, fs,
    path::{Path, PathBuf},
    rc::Rc,
};

use percuss::{
    Scenario, case,
    model::{self, Control},
    outcome::{Outcome, RunResult},
    summary::ResultRecord,
};
use toml_edit::{DocumentMut, Item, value};

use crate::common::expected::{Expected, File, Kind};

/// A case as it was run, with its result.
type Run = Rc<(Scenario, RunResult)>;

/// Runs of a case by model and impact velocity: entries share them.
struct Runs<'a> {
    folder: &'a Path,
    done: HashMap<(String, Option<u64>), Run>,
}

impl Runs<'_> {
    fn run(&mut self, expected: &Expected, velocity: Option<f64>) -> Run {
        let key = (expected.model.clone(), velocity.map(f64::to_bits));
        let run = || Rc::new(run(self.folder, &expected.model, velocity));
        Rc::clone(self.done.entry(key).or_insert_with(run))
    }
}

fn run(folder: &Path, model: &str, velocity: Option<f64>) -> (Scenario, RunResult) {
    let mut scenario =
        case::load(folder.join("scenario.toml")).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(scenario.name, folder.file_name().unwrap().to_string_lossy());
    if let Some(velocity) = velocity {
        scenario.impact_velocity = velocity;
    }
    let model = model::model(model).unwrap();
    let result = model::run(model, &scenario, &mut Control::recording())
        .unwrap_or_else(|error| panic!("{error}"));
    (scenario, result)
}

/// The number of an entry as the program computes it.
fn compute(runs: &mut Runs<'_>, expected: &Expected) -> f64 {
    let folder = runs.folder;
    if let Some(bracket) = &expected.bracket {
        return limit(
            runs,
            expected,
            bracket.each_ref().map(|velocity| velocity.si()),
        );
    }
    let velocity = expected
        .impact_velocity
        .as_ref()
        .map(|velocity| velocity.si());
    let (scenario, result) = &*runs.run(expected, velocity);
    let span = expected.mean_from.as_ref().zip(expected.mean_to.as_ref());
    let span = span.map(|(from, to)| (from.si(), to.si()));
    match (span, expected.quantity.as_str()) {
        (Some((from, to)), "interface_velocity_m_s") => {
            crate::common::mean(result, from, to, |s| s.interface_velocity)
        }
        (Some((from, to)), "back_velocity_m_s") => {
            crate::common::mean(result, from, to, |s| s.back_velocity)
        }
        (Some((from, to)), "contact_force_kn") => {
            crate::common::mean(result, from, to, |s| s.contact_force * 1e-3)
        }
        (None, "projectile_mass_g") => scenario.projectile.mass * 1e3,
        (None, "perforates") => f64::from(result.outcome == Outcome::Perforated),
        (None, quantity) => {
            let record = serde_json::to_value(ResultRecord::new(scenario, result)).unwrap();
            // A name, or a path such as `/fragments/2/velocity_m_s`.
            let number = record.pointer(quantity).or_else(|| record.get(quantity));
            number
                .and_then(serde_json::Value::as_f64)
                .unwrap_or_else(|| panic!("{}: no number is named {quantity}", folder.display()))
        }
        other => panic!("{}: {other:?} is not understood", folder.display()),
    }
}

/// Middle of a bracket of impact velocities, of which only the upper one perforates.
fn limit(runs: &mut Runs<'_>, expected: &Expected, bracket: [f64; 2]) -> f64 {
    assert_eq!(expected.quantity, "ballistic_limit_m_s");
    let perforates = bracket.map(|velocity| {
        let (_, result) = &*runs.run(expected, Some(velocity));
        result.outcome == Outcome::Perforated
    });
    assert_eq!(
        perforates,
        [false, true],
        "{}: the limit is not between {bracket:?} m/s; find it with `percuss limit` and write the new bracket",
        runs.folder.display()
    );
    0.5 * (bracket[0] + bracket[1])
}

/// The independent value of an entry, and the error against it.
fn beside(expected: &Expected, computed: f64) -> String {
    let Some(independent) = &expected.independent else {
        return String::new();
    };
    let uncertainty = independent
        .uncertainty
        .map_or(String::new(), |u| format!(" ± {u}"));
    format!(
        ", independent {}{uncertainty}: error {:+.4}",
        independent.value,
        expected.error_of(computed, independent.value)
    )
}

/// What of an entry a computed number contradicts.
fn contradiction(expected: &Expected, computed: f64) -> Option<String> {
    let Expected {
        quantity,
        model,
        kind,
        value,
        source,
        ..
    } = expected;
    if !expected.holds(computed) {
        let error = expected.error_of(computed, *value);
        return Some(format!(
            "{model}, {quantity}: {computed} against {kind:?} {value} ({source}): error {error:+.5}, stated {:+}, tolerance {}",
            expected.error.unwrap_or(0.0),
            expected.tolerance
        ));
    }
    let independent = expected.independent.as_ref()?;
    let error = expected.error_of(computed, independent.value);
    let allowed = match expected.absolute {
        true => expected.tolerance,
        false => 0.005,
    };
    ((error - independent.error).abs() > allowed).then(|| {
        format!(
            "{model}, {quantity}: {computed} against {} ({}): error {error:+.4}, stated {:+}",
            independent.value, independent.source, independent.error
        )
    })
}

/// Writes a computed number into the entry that it belongs to, where the entry is this program's own or states an error.
fn retake(entry: &mut Item, expected: &Expected, computed: f64) {
    let rounded = |number: f64, digits: usize| format!("{number:.digits$}").parse::<f64>().unwrap();
    let significant = |number: f64| format!("{number:.5e}").parse::<f64>().unwrap();
    if expected.kind == Kind::Golden && !expected.holds(computed) {
        entry["value"] = value(significant(computed));
    }
    if let Some(independent) = &expected.independent {
        entry["independent"]["error"] =
            value(rounded(expected.error_of(computed, independent.value), 4));
    }
    if expected.error.is_some() {
        entry["error"] = value(rounded(expected.error_of(computed, expected.value), 4));
    }
}

fn check(name: &str) {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("../../cases")
        .join(name);
    let path = folder.join("expected.toml");
    let text = fs::read_to_string(&path).unwrap();
    let file = File::read(&text).unwrap_or_else(|error| panic!("{name}: {error}"));
    let mut document: DocumentMut = text.parse().unwrap();
    let entries = document["expected"].as_array_of_tables_mut().unwrap();
    let mut contradictions = Vec::new();
    let mut runs = Runs {
        folder: &folder,
        done: HashMap::new(),
    };
    for (expected, table) in file.expected.iter().zip(entries.iter_mut()) {
        let computed = compute(&mut runs, expected);
        println!(
            "{name}: {} = {computed:.6}{}",
            expected.quantity,
            beside(expected, computed)
        );
        if let Some(found) = contradiction(expected, computed) {
            contradictions.push(found);
            let mut entry = Item::Table(table.clone());
            retake(&mut entry, expected, computed);
            *table = entry.into_table().unwrap();
        }
    }
    if env::var_os("RETAKE_GOLDEN").is_some() && !contradictions.is_empty() {
        fs::write(&path, document.to_string()).unwrap();
        println!("{name}: written again\n{}", contradictions.join("\n"));
        return;
    }
    assert!(
        contradictions.is_empty(),
        "{name}:\n{}\nRETAKE_GOLDEN=1 writes golden numbers and known errors again",
        contradictions.join("\n")
    );
}

/// One test a folder, so that a failure names it; the list is checked against what is there.
macro_rules! cases {
    ($($name:ident: $folder:literal),* $(,)?) => {
        $(#[test] fn $name() { check($folder); })*

        #[test]
        fn every_folder_is_tested() {
            let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../cases");
            let mut found: Vec<String> = fs::read_dir(root)
                .unwrap()
                .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
                .collect();
            found.sort();
            let mut listed = vec![$($folder.to_owned()),*];
            listed.sort();
            assert_eq!(found, listed);
        }
    };
}

cases! {
    paper_table1: "paper-table1",
    paper_table1_constants: "paper-table1-constants",
    paper_table1_uncertainty: "paper-table1-uncertainty",
    copper_on_aluminium_800: "copper-on-aluminium-800",
    taylor_copper_wilkins: "taylor-copper-wilkins",
    taylor_copper_hot: "taylor-copper-hot",
    elastic_bars: "elastic-bars",
    lattice_strip_on_wall: "lattice-strip-on-wall",
    rigid_on_glass_plane: "rigid-on-glass-plane",
    cracks_in_glass_plate: "cracks-in-glass-plate",
    plane_strain_taylor: "plane-strain-taylor",
    oblique_strip_on_glass: "oblique-strip-on-glass",
    ball_on_glass_plate: "ball-on-glass-plate",
    cracks_from_two_notches: "cracks-from-two-notches",
    disc_split_at_its_rim: "disc-split-at-its-rim",
    chung_ooi_1_two_balls: "chung-ooi-1-two-balls",
    chung_ooi_2_ball_on_plane: "chung-ooi-2-ball-on-plane",
    chung_ooi_3_restitution: "chung-ooi-3-restitution",
    chung_ooi_4_oblique: "chung-ooi-4-oblique",
    spall_two_plates: "spall-two-plates",
    spall_delayed: "spall-delayed",
    torn_off_by_johnson_cook: "torn-off-by-johnson-cook",
    layered_with_gap: "layered-with-gap",
    local_damping: "local-damping",
    concrete_forrestal_1994: "concrete-forrestal-1994",
    weldox_460e_12mm_blunt: "weldox-460e-12mm-blunt",
    apm2_core_oblique: "apm2-core-oblique",
    ball_on_304_sheet: "ball-on-304-sheet",
}
