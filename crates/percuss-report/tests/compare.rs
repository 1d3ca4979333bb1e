//! The figure and the files of a comparison of models that are made up.

use std::fs;

use parquet::file::reader::{FileReader, SerializedFileReader};
use percuss::{
    Error, Scenario, case,
    compare::{Comparison, Observer, compare},
    material::MaterialClass,
    model::{Control, Model},
    outcome::{Band, BandQuantity, Outcome, RunResult, Termination},
    regime::{ProjectileRegime, TargetKind},
    validity::{FirstChoice, Measure, NoseKind, Outside, Range, ValidityDomain},
};
use percuss_report::{FigureFormat, compare_figures, write_comparison};

/// A model that gives `scale` times a depth that grows with the speed.
struct Fake {
    name: &'static str,
    validity: ValidityDomain,
    scale: f64,
    band: bool,
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
        let speed = scenario.impact_velocity / 1000.0;
        let depth_mm = self.scale * 30.0 * speed * speed / (1.0 + speed);
        let mut result = RunResult::new(self.name, "", Outcome::AtRest, Termination::ClosedForm);
        result.depth_of_penetration = Some(depth_mm * 1e-3);
        result.band = self.band.then_some(Band {
            quantity: BandQuantity::DepthOfPenetration,
            low: 0.85 * depth_mm,
            high: 1.2 * depth_mm,
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
        because: "it is made up",
    }
}

const SLOW: ValidityDomain = ValidityDomain {
    ranges: &[speeds(0.0, 700.0)],
    ..ValidityDomain::OPEN
};
const FAST: ValidityDomain = ValidityDomain {
    ranges: &[speeds(600.0, 5000.0)],
    first_choice: &[FirstChoice {
        projectile: ProjectileRegime::Eroding,
        targets: TargetKind::ALL,
        noses: NoseKind::ALL,
        target_material: MaterialClass::Metal,
        because: "it is made up for it",
    }],
    ..ValidityDomain::OPEN
};
const NEVER: ValidityDomain = ValidityDomain {
    ranges: &[speeds(9000.0, 9001.0)],
    ..ValidityDomain::OPEN
};

fn comparison(case: &str, speeds: &[f64]) -> (Scenario, Comparison) {
    let validity = [ValidityDomain::OPEN, FAST, SLOW];
    let names = [
        "chain",
        "tate",
        "forrestal",
        "fdm",
        "walker_anderson",
        "poncelet",
        "crater_energy",
        "lanz_odermatt",
        "hydrodynamic",
        "plate_cavity",
        "never",
    ];
    let fakes: Vec<Fake> = names
        .iter()
        .enumerate()
        .map(|(i, name)| Fake {
            name,
            validity: match *name {
                "never" => NEVER,
                "tate" => FAST,
                "walker_anderson" => ValidityDomain {
                    first_choice: &[],
                    ..FAST
                },
                _ => ValidityDomain {
                    first_choice: &[],
                    ..validity[i % 3]
                },
            },
            scale: 0.7 + 0.08 * ((7 * i) % 11) as f64,
            band: i == 0 || i == 7,
        })
        .collect();
    let models: Vec<&dyn Model> = fakes.iter().map(|fake| fake as &dyn Model).collect();
    let scenario = case::load_str("made-up", case).unwrap();
    let comparison = compare(&models, None, &scenario, speeds, &mut Observer::default()).unwrap();
    (scenario, comparison)
}

const CASE: &str = "
projectile = { material = 'copper', length = '40 mm', diameter = '5 mm', impact_velocity = '1000 m/s' }
target = { material = 'aluminium-2024-t351', thickness = 'semi-infinite' }
[[experiments]]
impact_velocity = '1000 m/s'
depth_of_penetration = '16 mm'
uncertainty = '1.5 mm'
source = 'a'
[[experiments]]
impact_velocity = '500 m/s'
depth_of_penetration = '5 mm'
source = 'a'
";

fn sweep() -> Vec<f64> {
    (0..27).map(|i| 200.0 + 50.0 * f64::from(i)).collect()
}

#[test]
fn every_model_with_a_value_has_its_line() {
    let (scenario, comparison) = comparison(CASE, &sweep());
    let figure = compare_figures(&scenario, &comparison).remove(0);
    assert_eq!(figure.name, "compare");
    for text in [
        "chain",
        "Alekseevskii–Tate ★",
        "experiment",
        "Depth of penetration (mm)",
        "Impact velocity (m/s)",
    ] {
        assert!(figure.svg.contains(&format!(">{text}</text>")), "{text}");
    }
    assert!(!figure.svg.contains(">never</text>"));
    assert!(!figure.svg.contains("NaN"));
    let folder = tempfile::tempdir().unwrap();
    let folder = std::env::var_os("PERCUSS_FIGURES").map_or(folder.path().to_owned(), Into::into);
    for file in figure.write(&folder, FigureFormat::DEFAULT).unwrap() {
        assert!(fs::metadata(file).unwrap().len() > 1000);
    }
}

#[test]
fn one_velocity_gives_one_row_per_model() {
    let (scenario, comparison) = comparison(CASE, &[1000.0]);
    let figure = compare_figures(&scenario, &comparison).remove(0);
    for text in [
        "chain",
        "Alekseevskii–Tate ★",
        "experiment",
        "Depth of penetration (mm)",
    ] {
        assert!(figure.svg.contains(&format!(">{text}</text>")), "{text}");
    }
    assert!(!figure.svg.contains(">Forrestal</text>"));
    let folder = tempfile::tempdir().unwrap();
    let folder = std::env::var_os("PERCUSS_FIGURES").map_or(folder.path().to_owned(), |path| {
        std::path::Path::new(&path).join("one")
    });
    figure.write(&folder, FigureFormat::DEFAULT).unwrap();
    // Without a value of any model there is nothing to draw.
    let wall = CASE.replace(
        "material = 'aluminium-2024-t351', thickness = 'semi-infinite'",
        "rigid_wall = true",
    );
    let wall = wall.split("[[").next().unwrap();
    let (scenario, mut comparison) = self::comparison(wall, &[1000.0]);
    comparison.results.retain(|record| record.model == "never");
    assert!(compare_figures(&scenario, &comparison).is_empty());
}

#[test]
fn files_have_a_row_a_speed_and_model() {
    let (_, comparison) = comparison(CASE, &[500.0, 1000.0]);
    let folder = tempfile::tempdir().unwrap();
    let [csv, parquet] = write_comparison(folder.path(), &comparison, None)
        .unwrap()
        .try_into()
        .unwrap();
    let mut reader = csv::Reader::from_path(csv).unwrap();
    let header = reader.headers().unwrap().clone();
    let column = |name: &str| header.iter().position(|column| column == name).unwrap();
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    assert_eq!(rows.len(), comparison.results.len());
    for (row, record) in rows.iter().zip(&comparison.results) {
        assert_eq!(&row[column("model")], record.model);
        let depth = row[column("depth_of_penetration_mm")].parse().ok();
        assert_eq!(depth, record.depth_of_penetration_mm);
        assert_eq!(row[column("reason")].is_empty(), record.reason.is_none());
        let low = row[column("low_depth_of_penetration_mm")].parse().ok();
        assert_eq!(low, record.band.as_ref().map(|band| band.low));
    }
    assert!(rows.iter().any(|row| &row[column("recommended")] == "1"));
    let reader = SerializedFileReader::new(fs::File::open(parquet).unwrap()).unwrap();
    assert_eq!(
        reader.metadata().file_metadata().num_rows(),
        rows.len() as i64
    );
    let nulls = reader
        .get_row_iter(None)
        .unwrap()
        .filter(|row| {
            row.as_ref()
                .unwrap()
                .to_string()
                .contains(" depth_of_penetration_mm: null")
        })
        .count();
    let absent = comparison
        .results
        .iter()
        .filter(|r| r.depth_of_penetration_mm.is_none());
    assert_eq!(nulls, absent.count());
}
