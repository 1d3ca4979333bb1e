use std::{
    f64::consts::{FRAC_1_SQRT_2, PI},
    path::PathBuf,
    sync::{
        Mutex,
        atomic::{AtomicBool, AtomicU32, Ordering},
    },
};

use super::{design::Rows, indices::indices, *};
use crate::{
    Error,
    case::ConstraintFactor,
    model::model,
    outcome::Outcome,
    summary::ResultRecord,
    sweep::{Kernel, Row, ScalarKernel, Shot, Stopped},
};

const CASE: &str = "
projectile = { material = 'copper', length = '12.74 mm', diameter = '4.8 mm', velocity = '230 m/s' }
target = { material = 'aluminium-2024-t351', thickness = '25 mm' }
";
const NORMALS: &str = "
[[uncertainty.parameter]]
key = 'projectile.velocity'
normal = { mean = '230 m/s', standard_deviation = '4 m/s' }
[[uncertainty.parameter]]
key = 'target.thickness'
normal = { mean = '25 mm', standard_deviation = '0.5 mm' }
[[uncertainty.parameter]]
key = 'chain.constraint_factor'
normal = { mean = 2.7, standard_deviation = 0.2 }
";
const CORRELATION: &str = "
[uncertainty.correlation]
parameters = ['projectile.velocity', 'target.thickness']
matrix = [[1, 0.6], [0.6, 1]]
";
const SLOPES: [f64; 3] = [0.5, -3.0, 10.0];
const MEANS: [f64; 3] = [230.0, 25.0, 2.7];
const DEVIATIONS: [f64; 3] = [4.0, 0.5, 0.2];

fn load(case: &str) -> Result<Study, Error> {
    static COUNT: AtomicU32 = AtomicU32::new(0);
    let number = COUNT.fetch_add(1, Ordering::Relaxed);
    let folder =
        std::env::temp_dir().join(format!("percuss-study-{}-{number}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let path: PathBuf = folder.join("case.toml");
    std::fs::write(&path, case).unwrap();
    let study = Study::load(&path);
    std::fs::remove_dir_all(&folder).unwrap();
    study
}

fn study(inputs: &str) -> Study {
    load(&format!("{CASE}{inputs}")).unwrap()
}

fn settings(samples: u64) -> Settings {
    Settings {
        samples,
        seed: 3,
        quantities: Vec::new(),
        indices: true,
        speeds: Vec::new(),
    }
}

/// A kernel whose depth is a linear function of speed, thickness and constraint factor.
struct Linear {
    /// Shots that are faster have no result.
    fails_above: f64,
}

const LINEAR: Linear = Linear {
    fails_above: f64::INFINITY,
};

fn linear(scenario: &crate::Scenario) -> f64 {
    let inputs = [
        scenario.impact_speed,
        1e3 * scenario.target_thickness().unwrap(),
        match scenario.options.chain.constraint_factor() {
            ConstraintFactor::Value(factor) => factor,
            ConstraintFactor::CavityExpansion => f64::NAN,
        },
    ];
    SLOPES.iter().zip(inputs).map(|(slope, x)| slope * x).sum()
}

impl Kernel for Linear {
    fn rows(&self, shots: Vec<Shot>, stop: &AtomicBool) -> Result<Vec<Row>, Stopped> {
        if stop.load(Ordering::Relaxed) {
            return Err(Stopped);
        }
        let row = |shot: Shot| {
            let scenario = shot.scenario.unwrap();
            let error = Error::Cancelled {
                step: 0,
                time_us: 0.0,
            };
            let mut record = ResultRecord::without_result(&scenario, "chain", &error);
            if scenario.impact_speed <= self.fails_above {
                record.outcome = Outcome::AtRest;
                record.reason = None;
                record.depth_of_penetration_mm = Some(linear(&scenario));
            }
            Row {
                index: shot.index,
                inputs: shot.inputs,
                record: Ok(record),
            }
        };
        Ok(shots.into_iter().map(row).collect())
    }
}

fn analysed(study: &Study, kernel: &dyn Kernel, settings: &Settings) -> Uncertainty {
    let watch = Watch {
        stop: &AtomicBool::new(false),
        progress: &|_, _| {},
    };
    analyse(study, model("chain").unwrap(), kernel, settings, &watch).unwrap()
}

/// Indices of a function of numbers drawn evenly between 0 and 1.
fn indices_of(function: &dyn Fn(&[f64]) -> f64, dimensions: usize, seed: u64) -> SobolIndices {
    let rows = Rows::new(4096, seed, dimensions);
    let row = |i| {
        (0..rows.width())
            .map(|place| function(&rows.point(i, place)))
            .collect()
    };
    let values: Vec<Vec<f64>> = (0..4096).map(row).collect();
    let keys: Vec<String> = (0..dimensions).map(|i| i.to_string()).collect();
    let keys: Vec<&str> = keys.iter().map(String::as_str).collect();
    indices(&values, &keys, seed).unwrap()
}

fn holds(found: Estimate, exact: f64, most: f64, name: &str) {
    assert!(
        found.low <= exact && exact <= found.high,
        "{name}: {found:?}, exact {exact}"
    );
    assert!(
        (found.value - exact).abs() < most,
        "{name}: {found:?}, exact {exact}"
    );
    assert!(
        found.low <= found.value && found.value <= found.high,
        "{name}: {found:?}"
    );
}

/// Ishigami's function: `sin x + 7 sin² y + 0.1 z⁴ sin x`, each between -π and π.
#[test]
fn indices_of_ishigamis_function_are_the_exact_ones() {
    let (a, b) = (7.0, 0.1_f64);
    let function = |u: &[f64]| {
        let x: Vec<f64> = u.iter().map(|u| PI * (2.0 * u - 1.0)).collect();
        x[0].sin() + a * x[1].sin().powi(2) + b * x[2].powi(4) * x[0].sin()
    };
    let v1 = 0.5 * (1.0 + b * PI.powi(4) / 5.0).powi(2);
    let v2 = a * a / 8.0;
    let v13 = b * b * PI.powi(8) * (1.0 / 18.0 - 1.0 / 50.0);
    let v = v1 + v2 + v13;
    for seed in [1, 2] {
        let found = indices_of(&function, 3, seed).parameters;
        let first = [v1, v2, 0.0];
        let total = [v1 + v13, v2, v13];
        for i in 0..3 {
            holds(
                found[i].first_order,
                first[i] / v,
                0.02,
                &format!("first {i}"),
            );
            holds(found[i].total, total[i] / v, 0.02, &format!("total {i}"));
        }
    }
}

/// Sobol's function: the product of `(|4 x - 2| + a) / (1 + a)`.
#[test]
fn indices_of_the_g_function_are_the_exact_ones() {
    let a = [0.0, 1.0, 4.5, 9.0, 99.0, 99.0];
    let function = |u: &[f64]| {
        let factor = |(u, a): (&f64, &f64)| ((4.0 * u - 2.0).abs() + a) / (1.0 + a);
        u.iter().zip(&a).map(factor).product::<f64>()
    };
    let parts: Vec<f64> = a
        .iter()
        .map(|a| 1.0 / 3.0 / (1.0 + a) / (1.0 + a))
        .collect();
    let whole: f64 = parts.iter().map(|v| 1.0 + v).product::<f64>() - 1.0;
    let found = indices_of(&function, 6, 4).parameters;
    for (i, part) in parts.iter().enumerate() {
        let others = (whole + 1.0) / (1.0 + part);
        holds(
            found[i].first_order,
            part / whole,
            0.02,
            &format!("first {i}"),
        );
        holds(
            found[i].total,
            part * others / whole,
            0.02,
            &format!("total {i}"),
        );
    }
}

#[test]
fn a_constant_has_no_indices() {
    let rows = vec![vec![2.5; 5]; 64];
    let refused = indices(&rows, &["a", "b", "c"], 0).unwrap_err();
    assert!(refused.contains("the same in all shots"), "{refused}");
    assert!(indices(&rows[..3], &["a", "b", "c"], 0).is_err());
}

fn mean() -> f64 {
    SLOPES
        .iter()
        .zip(MEANS)
        .map(|(slope, mean)| slope * mean)
        .sum()
}

/// Variance that a parameter of the linear model causes.
fn part(i: usize) -> f64 {
    (SLOPES[i] * DEVIATIONS[i]).powi(2)
}

/// Normal scores of the percentiles.
const SCORES: [(f64, f64); 7] = [
    (1.0, -2.326_347_874_040_841),
    (5.0, -1.644_853_626_951_472_7),
    (25.0, -0.674_489_750_196_081_7),
    (50.0, 0.0),
    (75.0, 0.674_489_750_196_081_7),
    (95.0, 1.644_853_626_951_472_7),
    (99.0, 2.326_347_874_040_841),
];

#[test]
fn a_linear_model_has_its_exact_statistics_and_indices() {
    let found = analysed(&study(NORMALS), &LINEAR, &settings(4096));
    assert_eq!(found.quantities.len(), 1);
    let depth = &found.quantities[0];
    let deviation = (0..3).map(part).sum::<f64>().sqrt();
    assert_eq!(depth.quantity, "depth_of_penetration_mm");
    assert!((depth.nominal.unwrap() - mean()).abs() < 1e-9);
    assert!((depth.statistics.mean - mean()).abs() < 1e-3 * deviation);
    assert!((depth.statistics.standard_deviation / deviation - 1.0).abs() < 2e-3);
    for (percent, score) in SCORES {
        let found = depth.statistics.percentile(percent);
        let exact = mean() + score * deviation;
        let off = (found.value - exact).abs() / deviation;
        // The tails have fewer shots.
        assert!(
            off < if score.abs() > 2.0 { 0.03 } else { 0.01 },
            "{percent}: {off}"
        );
        assert!(
            found.low.unwrap() <= exact && exact <= found.high.unwrap(),
            "{percent}"
        );
    }
    let indices = depth.indices.as_ref().unwrap();
    assert_eq!(indices.rows, 4096);
    for (i, index) in indices.parameters.iter().enumerate() {
        let exact = part(i) / deviation.powi(2);
        holds(index.first_order, exact, 0.01, &index.key);
        holds(index.total, exact, 0.01, &index.key);
    }
    // The bars of the linear model are exact, and the longest stands first.
    for bar in &depth.tornado {
        let i = found
            .inputs
            .iter()
            .position(|input| input.key == bar.key)
            .unwrap();
        let exact = SLOPES[i] * DEVIATIONS[i] * 1.644_853_626_951_472_7;
        assert!((bar.at_high.unwrap() - mean() - exact).abs() < 1e-9);
        assert!((bar.at_low.unwrap() - mean() + exact).abs() < 1e-9);
    }
    assert!(
        depth
            .tornado
            .windows(2)
            .all(|pair| pair[0].length() >= pair[1].length())
    );
    assert_eq!(found.shots, 1 + 6 + 5 * 4096);
}

#[test]
fn correlated_parameters_have_their_exact_spread_and_no_indices() {
    let found = analysed(
        &study(&format!("{NORMALS}{CORRELATION}")),
        &LINEAR,
        &settings(8192),
    );
    let depth = &found.quantities[0];
    let shared = 2.0 * 0.6 * SLOPES[0] * SLOPES[1] * DEVIATIONS[0] * DEVIATIONS[1];
    let deviation = ((0..3).map(part).sum::<f64>() + shared).sqrt();
    assert!((depth.statistics.mean - mean()).abs() < 2e-3 * deviation);
    assert!((depth.statistics.standard_deviation / deviation - 1.0).abs() < 3e-3);
    assert!(depth.indices.is_none());
    assert!(found.no_indices.unwrap().contains("correlated"));
    assert_eq!(found.shots, 1 + 6 + 4096);
}

#[test]
fn standard_errors_shrink_and_means_err_less() {
    let study = study(NORMALS);
    let of = |samples| {
        let settings = Settings {
            indices: false,
            ..settings(samples)
        };
        analysed(&study, &LINEAR, &settings).quantities[0]
            .statistics
            .clone()
    };
    let (few, many) = (of(256), of(4096));
    assert!((few.standard_error / many.standard_error / 4.0 - 1.0).abs() < 0.02);
    for statistics in [few, many] {
        assert!((statistics.mean - mean()).abs() < 0.2 * statistics.standard_error);
    }
}

#[test]
fn shots_that_fail_are_counted_and_left_out() {
    let kernel = Linear { fails_above: 236.0 };
    let found = analysed(&study(NORMALS), &kernel, &settings(1024));
    let failed = found
        .draws
        .iter()
        .filter(|draw| draw.inputs[0] > 236.0)
        .count();
    // One normal variable in 15 is more than 1.5 deviations above its mean.
    assert!((60..77).contains(&failed), "{failed}");
    assert_eq!(found.failures.shots, failed);
    let depth = &found.quantities[0];
    assert_eq!(
        (depth.statistics.shots, depth.without_value),
        (1024 - failed, 0)
    );
    let rows = depth.indices.as_ref().unwrap().rows;
    assert!(rows < 1024 - failed && rows > 800, "{rows}");
    assert!(
        found.warnings[0].contains("have no result and are left out"),
        "{:?}",
        found.warnings
    );
    let perforation = found.perforation.unwrap();
    assert_eq!(
        (perforation.undecided, perforation.probability),
        (failed, 0.0)
    );
}

#[test]
fn bands_hold_the_speed_and_spread_the_rest() {
    let settings = Settings {
        indices: false,
        speeds: vec![150.0, 400.0],
        ..settings(256)
    };
    let found = analysed(&study(NORMALS), &LINEAR, &settings);
    let deviation = (part(1) + part(2)).sqrt();
    for band in &found.bands {
        let exact = mean() + SLOPES[0] * (band.velocity_m_s - MEANS[0]);
        let statistics = band.quantities[0].statistics.as_ref().unwrap();
        assert!(
            (statistics.mean - exact).abs() < 0.02 * deviation,
            "{}",
            band.velocity_m_s
        );
        assert!((statistics.standard_deviation / deviation - 1.0).abs() < 0.02);
        assert_eq!(band.shots, 256);
    }
}

const PLATE: &str = "
projectile = { material = 'tool-steel-hrc53', mass = '197 g', diameter = '20 mm', velocity = '187 m/s' }
target = { material = 'weldox-460-e', thickness = '12 mm', back_face = 'free' }
recht_ipson = { ballistic_limit = '184.5 m/s' }
";

/// A target that is perforated above a known speed, by speeds of a known distribution.
#[test]
fn the_chance_of_perforation_is_exact() {
    let inputs = "[[uncertainty.parameter]]
key = 'projectile.velocity'
normal = { mean = '187 m/s', standard_deviation = '5 m/s' }";
    let study = load(&format!("{PLATE}{inputs}")).unwrap();
    let model = model("recht_ipson").unwrap();
    let watch = Watch {
        stop: &AtomicBool::new(false),
        progress: &|_, _| {},
    };
    let settings = settings(1024);
    let found = analyse(&study, model, &ScalarKernel::new(model), &settings, &watch).unwrap();
    let exact = 0.5 * libm::erfc(-0.5 * FRAC_1_SQRT_2);
    let perforation = found.perforation.unwrap();
    assert!(
        (perforation.probability - exact).abs() <= 1.0 / 1024.0,
        "{perforation:?}"
    );
    assert!(perforation.low < exact && exact < perforation.high);
    assert_eq!(perforation.undecided, 0);
    let residual = &found.quantities[0];
    assert_eq!(residual.quantity, "residual_velocity_m_s");
    // What is stopped counts as 0.
    assert_eq!(
        (residual.statistics.shots, residual.statistics.smallest),
        (1024, 0.0)
    );
}

#[test]
fn threads_make_no_difference_and_progress_reaches_its_end() {
    let study = study(NORMALS);
    let with = |threads| {
        let reached = Mutex::new((0, 0));
        let watch = Watch {
            stop: &AtomicBool::new(false),
            progress: &|done, total| {
                let mut reached = reached.lock().unwrap();
                *reached = (done.max(reached.0), total);
            },
        };
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        let chain = model("chain").unwrap();
        let found = pool.install(|| analyse(&study, chain, &LINEAR, &settings(128), &watch));
        let (done, total) = *reached.lock().unwrap();
        assert_eq!((done, total), (6 + 128 * 5, 6 + 128 * 5));
        found.unwrap()
    };
    assert_eq!(with(1), with(3));
}

#[test]
fn a_stopped_analysis_says_so_and_a_model_that_does_not_apply_why() {
    let study = study(NORMALS);
    let chain = model("chain").unwrap();
    let stop = AtomicBool::new(true);
    let watch = |stop| Watch {
        stop,
        progress: &|_, _| {},
    };
    let ended = analyse(&study, chain, &LINEAR, &settings(64), &watch(&stop));
    assert!(matches!(ended, Err(Error::Cancelled { .. })));
    let concrete = model("forrestal_concrete").unwrap();
    let go = AtomicBool::new(false);
    let kernel = ScalarKernel::new(concrete);
    let ended = analyse(&study, concrete, &kernel, &settings(64), &watch(&go));
    assert!(
        matches!(ended, Err(Error::NotApplicable { .. })),
        "{ended:?}"
    );
}

#[test]
fn a_case_without_the_table_says_what_to_write() {
    let error = load(CASE).unwrap_err().to_string();
    assert!(
        error.contains("says nothing of what is uncertain"),
        "{error}"
    );
    assert!(error.contains("[[uncertainty.parameter]]"), "{error}");
}
