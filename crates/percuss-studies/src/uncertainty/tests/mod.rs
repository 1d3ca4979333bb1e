//! Studies whose answers are known.

mod ends;
mod indices;
mod linear;
mod perforation;

use std::{
    path::PathBuf,
    sync::atomic::{AtomicBool, AtomicU32, Ordering},
};

use super::*;
use crate::{
    Error,
    case::ConstraintFactor,
    model::model,
    outcome::Outcome,
    summary::ResultRecord,
    sweep::{Kernel, ScalarKernel, Stopped, SweepRow, SweepRun},
};

const CASE: &str = "
projectile = { material = 'copper', length = '12.74 mm', diameter = '4.8 mm', impact_velocity = '230 m/s' }
target = { material = 'aluminium-2024-t351', thickness = '25 mm' }
";
const NORMALS: &str = "
[[uncertainty.parameter]]
key = 'projectile.impact_velocity'
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
parameters = ['projectile.impact_velocity', 'target.thickness']
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
        velocities: Vec::new(),
    }
}

/// A kernel whose depth is a linear function of velocity, thickness and constraint factor.
struct Linear {
    /// Runs that are faster have no result.
    fails_above: f64,
}

const LINEAR: Linear = Linear {
    fails_above: f64::INFINITY,
};

fn linear(scenario: &crate::Scenario) -> f64 {
    let inputs = [
        scenario.impact_velocity,
        1e3 * scenario.target_thickness().unwrap(),
        match scenario.options.chain.constraint_factor() {
            ConstraintFactor::Value(factor) => factor,
            ConstraintFactor::CavityExpansion => f64::NAN,
        },
    ];
    SLOPES.iter().zip(inputs).map(|(slope, x)| slope * x).sum()
}

impl Kernel for Linear {
    fn rows(&self, runs: Vec<SweepRun>, stop: &AtomicBool) -> Result<Vec<SweepRow>, Stopped> {
        if stop.load(Ordering::Relaxed) {
            return Err(Stopped);
        }
        let row = |run: SweepRun| {
            let scenario = run.scenario.unwrap();
            let error = Error::Cancelled {
                step: 0,
                time_us: 0.0,
            };
            let mut record = ResultRecord::without_result(&scenario, "chain", &error);
            if scenario.impact_velocity <= self.fails_above {
                record.outcome = Outcome::AtRest;
                record.reason = None;
                record.depth_of_penetration_mm = Some(linear(&scenario));
            }
            SweepRow {
                index: run.index,
                inputs: run.inputs,
                record: Ok(record),
            }
        };
        Ok(runs.into_iter().map(row).collect())
    }
}

fn analysed(study: &Study, kernel: &dyn Kernel, settings: &Settings) -> Uncertainty {
    let observer = Observer {
        stop: &AtomicBool::new(false),
        progress: &|_, _| {},
    };
    analyse(study, model("chain").unwrap(), kernel, settings, &observer).unwrap()
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
