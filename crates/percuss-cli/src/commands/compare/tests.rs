//! Output of made-up models.

use percuss::{
    Error, Scenario, case,
    compare::{Comparison, Observer, compare},
    material::MaterialClass,
    model::{Control, Model},
    model_error::ModelErrorEstimate,
    outcome::{Band, BandQuantity, Outcome, RunResult, Termination},
    regime::{ProjectileRegime, TargetKind},
    validity::{FirstChoice, Measure, NoseKind, Outside, Range, ValidityDomain},
};

use super::{head, missing, quantities, single, sweep, warnings};

struct Fake {
    name: &'static str,
    validity: ValidityDomain,
    depth_mm: f64,
}

impl Model for Fake {
    fn name(&self) -> &'static str {
        self.name
    }

    fn summary(&self) -> &'static str {
        "made up"
    }

    fn validity(&self) -> &'static ValidityDomain {
        Box::leak(Box::new(self.validity))
    }

    fn run(&self, scenario: &Scenario, _: &mut Control<'_>) -> Result<RunResult, Error> {
        let depth = self.depth_mm * scenario.impact_velocity / 1000.0;
        let mut result = RunResult::new(self.name, "", Outcome::AtRest, Termination::ClosedForm);
        result.warnings.push(
            "it is made up, and this is a long warning that has to be broken into lines".to_owned(),
        );
        if self.name == "plugging" {
            result.ballistic_limit = Some(321.0);
            return Ok(result);
        }
        result.depth_of_penetration = Some(depth * 1e-3);
        result.band = Some(Band {
            quantity: BandQuantity::DepthOfPenetration,
            low: 0.9 * depth,
            high: 1.1 * depth,
            basis: "made up",
        });
        Ok(result)
    }
}

const fn speeds(min: f64, max: f64) -> Range {
    Range {
        measure: Measure::ImpactSpeed,
        min,
        max,
        outside: Outside::NotApplicable,
        because: "it is made up for these speeds and no others",
    }
}

const FIRST: ValidityDomain = ValidityDomain {
    first_choice: &[FirstChoice {
        projectile: ProjectileRegime::Eroding,
        targets: TargetKind::ALL,
        noses: NoseKind::ALL,
        target_material: MaterialClass::Metal,
        because: "it is made up for it",
    }],
    ..ValidityDomain::OPEN
};
const FAST: ValidityDomain = ValidityDomain {
    ranges: &[speeds(600.0, 5000.0)],
    ..FIRST
};
const MIDDLE: ValidityDomain = ValidityDomain {
    ranges: &[speeds(400.0, 800.0)],
    ..ValidityDomain::OPEN
};
const NEVER: ValidityDomain = ValidityDomain {
    targets: &[TargetKind::RigidWall],
    ..ValidityDomain::OPEN
};

const CASE: &str = "
projectile = { material = 'copper', length = '40 mm', diameter = '5 mm', impact_velocity = '1000 m/s' }
target = { material = 'aluminium-2024-t351', thickness = '500 mm' }
[[experiments]]
impact_velocity = '1000 m/s'
depth_of_penetration = '16 mm'
uncertainty = '1.5 mm'
source = 'a'
[[experiments]]
ballistic_limit = '300 m/s'
source = 'a'
";

fn comparison(speeds: &[f64]) -> (Scenario, Comparison) {
    let names = [
        "chain",
        "fdm",
        "tate",
        "walker_anderson",
        "lanz_odermatt",
        "hydrodynamic",
        "forrestal",
        "poncelet",
        "crater_energy",
        "plate_cavity",
        "plugging",
        "recht_ipson",
        "lambert_jonas",
        "awerbuch_bodner",
        "taylor",
        "wilkins_guinan",
    ];
    let fakes: Vec<Fake> = names
        .iter()
        .enumerate()
        .map(|(i, name)| Fake {
            name,
            validity: match *name {
                "tate" => FAST,
                "forrestal" | "poncelet" => MIDDLE,
                "taylor" | "wilkins_guinan" => NEVER,
                _ => ValidityDomain::OPEN,
            },
            depth_mm: 12.0 + i as f64,
        })
        .collect();
    let models: Vec<&dyn Model> = fakes.iter().map(|fake| fake as &dyn Model).collect();
    let scenario = case::load_str("made-up", CASE).unwrap();
    let mut comparison =
        compare(&models, None, &scenario, speeds, &mut Observer::default()).unwrap();
    // A made-up model is known by its name: what is expected of the real one is not this one's.
    for record in &mut comparison.results {
        record.expected_error = (record.model == "chain").then_some(ModelErrorEstimate {
            median: -0.32 + 1e-4 * record.impact_velocity_m_s,
            low: -0.86,
            high: 0.14,
            cases: 12,
            outside: false,
        });
    }
    (scenario, comparison)
}

fn narrow(text: &str) {
    for line in text.lines() {
        assert!(line.chars().count() <= 80, "{line}\n{text}");
        assert_eq!(line, line.trim_end());
    }
}

#[test]
fn one_speed_is_one_table() {
    let (scenario, comparison) = comparison(&[1000.0]);
    let text = head::text(&scenario, &comparison)
        + &single::text(&comparison)
        + &warnings::text(&comparison)
        + &missing::text(&comparison);
    narrow(&text);
    insta::with_settings!({ snapshot_path => "snapshots", prepend_module_to_snapshot => false, omit_expression => true }, {
        insta::assert_snapshot!("compare-one-speed", text);
    });
}

#[test]
fn a_sweep_is_as_many_tables_as_fit() {
    let speeds: Vec<f64> = (0..9).map(|i| 200.0 + 100.0 * f64::from(i)).collect();
    let (scenario, comparison) = comparison(&speeds);
    let text = head::text(&scenario, &comparison)
        + &sweep::text(&comparison)
        + &warnings::text(&comparison)
        + &missing::text(&comparison);
    narrow(&text);
    insta::with_settings!({ snapshot_path => "snapshots", prepend_module_to_snapshot => false, omit_expression => true }, {
        insta::assert_snapshot!("compare-sweep", text);
    });
}

#[test]
fn what_was_measured_at_other_speeds_is_counted() {
    let (_, here) = comparison(&[1000.0]);
    assert_eq!(quantities::elsewhere(&here), "");
    let (_, elsewhere) = comparison(&[500.0]);
    assert_eq!(
        quantities::elsewhere(&elsewhere),
        "1 experiment at another velocity: `--velocity experiments`\n\n"
    );
}

#[test]
fn without_a_recommendation_all_warnings_are_printed_once() {
    let (_, comparison) = comparison(&[200.0]);
    assert!(comparison.recommended[0].models.is_empty());
    let text = warnings::text(&comparison);
    assert_eq!(text.matches("warning:").count(), 1, "{text}");
    assert!(
        text.starts_with("warning: chain, fdm, walker_anderson"),
        "{text}"
    );
    assert!(!text.contains("of the others"), "{text}");
}
