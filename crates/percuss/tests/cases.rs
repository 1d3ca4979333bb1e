//! Every folder of `cases/` gives what its `expected.toml` says.

use std::{fs, path::PathBuf};

use percuss::{
    case,
    model::{self, Control},
    summary::ResultRecord,
    units::{Time, Velocity},
};
use serde::Deserialize;

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    expected: Vec<Expected>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Expected {
    /// Model that gives the number.
    #[serde(default = "chain")]
    model: String,
    quantity: String,
    /// Impact speed in place of the scenario's.
    velocity: Option<Velocity>,
    /// Span of time over which a sampled quantity is averaged.
    mean_from: Option<Time>,
    mean_to: Option<Time>,
    value: f64,
    tolerance: f64,
    /// The tolerance is a difference, not a fraction of the value.
    #[serde(default)]
    absolute: bool,
    kind: Kind,
    source: String,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Kind {
    Analytic,
    Paper,
    Experiment,
    Golden,
}

fn chain() -> String {
    "chain".to_owned()
}

fn check(folder: &str) {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("../../cases")
        .join(folder);
    let text = fs::read_to_string(root.join("expected.toml")).unwrap();
    let file: File = toml::from_str(&text).unwrap_or_else(|error| panic!("{error}"));
    for expected in file.expected {
        let mut scenario =
            case::load(root.join("scenario.toml")).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(scenario.name, folder);
        if let Some(velocity) = expected.velocity {
            scenario.impact_speed = velocity.si();
        }
        let result = model::run(
            model::model(&expected.model).unwrap(),
            &scenario,
            &mut Control::recording(),
        )
        .unwrap_or_else(|error| panic!("{error}"));
        let value = match (
            expected.mean_from,
            expected.mean_to,
            expected.quantity.as_str(),
        ) {
            (Some(from), Some(to), "interface_velocity_m_s") => {
                crate::common::mean(&result, from.si(), to.si(), |s| s.interface_velocity)
            }
            (Some(from), Some(to), "back_velocity_m_s") => {
                crate::common::mean(&result, from.si(), to.si(), |s| s.back_velocity)
            }
            (Some(from), Some(to), "contact_force_kn") => {
                crate::common::mean(&result, from.si(), to.si(), |s| s.contact_force * 1e-3)
            }
            (None, None, "projectile_mass_g") => scenario.projectile.mass * 1e3,
            (None, None, quantity) => {
                let record = serde_json::to_value(ResultRecord::new(&scenario, &result)).unwrap();
                // A name, or a path such as `/fragments/2/velocity_m_s`.
                let number = record.pointer(quantity).or_else(|| record.get(quantity));
                number
                    .and_then(serde_json::Value::as_f64)
                    .unwrap_or_else(|| panic!("{folder}: no number is named {quantity}"))
            }
            other => panic!("{folder}: {other:?} is not understood"),
        };
        let allowed = if expected.absolute {
            expected.tolerance
        } else {
            expected.tolerance * expected.value.abs()
        };
        let off = (value - expected.value).abs();
        println!(
            "{folder}: {} = {value:.6}, {:?} {}",
            expected.quantity, expected.kind, expected.value
        );
        assert!(
            off <= allowed + 1e-12 * expected.value.abs(),
            "{folder}: {} = {value} is {off:.3e} off {} ({:?}, {}); allowed {allowed:.3e}",
            expected.quantity,
            expected.value,
            expected.kind,
            expected.source
        );
    }
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
