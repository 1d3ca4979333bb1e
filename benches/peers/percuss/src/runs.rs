//! Runs of a case as percuss itself computes them, with its balances, each to its end.

use std::{fs, path::Path, sync::atomic::AtomicBool};

use percuss::{
    Scenario, case,
    model::{self, Control},
    sweep::{BatchKernel, Kernel, SweepRun},
};
use rayon::prelude::*;

use crate::Outcome;

/// Runs that are computed together, as many as in a block of `percuss sweep`.
const BLOCK: usize = 64;

/// How a run ends: depth [m], velocity [m/s], time to rest [s] and number of steps.
pub(crate) type End = [f64; 4];

/// Runs of a case at speeds from 150 to 400 m/s.
pub(crate) fn scenarios(case: &str, count: u32) -> Outcome<Vec<Scenario>> {
    let scenario = case::load(Path::new(case))?;
    let speeds = (0..count).map(|i| 150.0 + 250.0 * (f64::from(i) + 0.5) / f64::from(count));
    let scenarios = speeds.map(|impact_velocity| Scenario {
        impact_velocity,
        ..scenario.clone()
    });
    Ok(scenarios.collect())
}

/// Runs of the default model that `runner/work.py` has written.
pub(crate) fn of_cavity(path: &str) -> Outcome<Vec<Scenario>> {
    let text = fs::read_to_string(path)?;
    let words: Vec<&str> = text.split_ascii_whitespace().collect();
    let Some((constants, speeds)) = words.split_first_chunk::<16>() else {
        return Err("the problem ends too early".into());
    };
    let [slices, springs, _, length, diameter, thickness, metals @ ..] = constants;
    let (rod, target) = metals.split_at(5);
    let metal = |constants: &[&str]| -> String {
        format!(
            "{{ name = 'metal', density = '{} kg/m3', youngs_modulus = '{} Pa', poissons_ratio = {}, \
             strength.power_law = {{ coefficient = '{} Pa', exponent = {} }} }}",
            constants[0], constants[1], constants[2], constants[3], constants[4]
        )
    };
    let case = format!(
        "projectile = {{ material = 'rod', length = '{length} m', diameter = '{diameter} m', impact_velocity = '230 m/s' }}\n\
         target = {{ material = 'plate', thickness = '{thickness} m', back_face = 'fixed' }}\n\
         chain = {{ projectile_elements = {slices}, target_elements = {springs} }}\n\
         materials.rod = {}\nmaterials.plate = {}\n",
        metal(rod),
        metal(target)
    );
    let scenario = case::load_str(path, &case)?;
    let of_speed = |speed: &&str| -> Outcome<Scenario> {
        Ok(Scenario {
            impact_velocity: speed.parse()?,
            ..scenario.clone()
        })
    };
    speeds.iter().map(of_speed).collect()
}

/// Computes runs as `percuss sweep` does, on the threads of the pool.
pub(crate) fn side_by_side(scenarios: &[Scenario]) -> Outcome<Vec<End>> {
    let kernel = BatchKernel::new(model::model("chain")?);
    let stop = AtomicBool::new(false);
    let blocks = scenarios.par_chunks(BLOCK).map(|block| {
        let runs = block.iter().enumerate().map(|(i, scenario)| SweepRun {
            index: i as u64,
            inputs: vec![scenario.impact_velocity],
            scenario: Ok(scenario.clone()),
        });
        let rows = kernel.rows(runs.collect(), &stop);
        let rows = rows.map_err(|_| "the runs were stopped".to_owned())?;
        let ends = rows.into_iter().map(|row| {
            let record = row.record?;
            let steps = record.steps.ok_or(record.reason.unwrap_or_default())?;
            Ok([
                record.depth_of_penetration_mm.unwrap_or(f64::NAN) * 1e-3,
                record.residual_velocity_m_s.unwrap_or(f64::NAN),
                record.time_to_rest_us.unwrap_or(f64::NAN) * 1e-6,
                steps as f64,
            ])
        });
        ends.collect::<Result<Vec<End>, String>>()
    });
    let blocks = blocks.collect::<Result<Vec<_>, String>>()?;
    Ok(blocks.concat())
}

/// Computes runs as `percuss run` does.
pub(crate) fn one_by_one(scenarios: &[Scenario]) -> Outcome<Vec<End>> {
    let chain = model::model("chain")?;
    let ends = scenarios.iter().map(|scenario| {
        let result = model::run(chain, scenario, &mut Control::default())?;
        Ok([
            result.depth_of_penetration.unwrap_or(f64::NAN),
            result.residual_velocity.unwrap_or(f64::NAN),
            result.time_to_rest.unwrap_or(f64::NAN),
            result.numerics().steps as f64,
        ])
    });
    ends.collect()
}

/// Elements times steps of runs: all have as many elements.
pub(crate) fn amount(scenarios: &[Scenario], ends: &[End]) -> f64 {
    let elements = scenarios.first().map_or(0, |scenario| {
        let chain = &scenario.options.chain;
        chain.projectile_elements() + chain.target_elements()
    });
    elements as f64 * ends.iter().map(|end| end[3]).sum::<f64>()
}
