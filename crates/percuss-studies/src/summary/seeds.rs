//! Result numbers over several packings of particles.

use serde::Serialize;

use super::{Role, result_numbers};
use crate::{
    Scenario,
    outcome::RunResult,
    statistics::{mean, variance},
};

/// Results of a case over seeds.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SeedStudy {
    /// Seeds of the packings, in order.
    pub seeds: Vec<u64>,
    /// One entry per result number that every seed gives.
    pub numbers: Vec<SeedNumber>,
}

/// A result number over seeds, in the unit of its name.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SeedNumber {
    /// Name as in the result record.
    pub name: &'static str,
    /// Its name in words.
    pub label: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Mean over the seeds.
    pub mean: f64,
    /// Standard deviation of one run.
    pub standard_deviation: f64,
    /// Smallest value.
    pub smallest: f64,
    /// Largest value.
    pub largest: f64,
    /// Value of each seed.
    pub values: Vec<f64>,
}

impl SeedStudy {
    /// The study of the results of successive seeds.
    pub fn new(scenario: &Scenario, first: u64, results: &[&RunResult]) -> Self {
        let of_results = |role: Role| role.is_result() || role == Role::Detail;
        let numbers = result_numbers()
            .filter(|number| of_results(number.role))
            .filter_map(|number| {
                let values = results.iter().map(|result| number.of_run(scenario, result));
                let values: Vec<f64> = values.collect::<Option<_>>()?;
                Some(SeedNumber {
                    name: number.name,
                    label: number.label,
                    unit: number.unit.symbol,
                    mean: mean(&values),
                    standard_deviation: variance(&values).sqrt(),
                    smallest: values.iter().copied().fold(f64::INFINITY, f64::min),
                    largest: values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
                    values,
                })
            })
            .collect();
        Self {
            seeds: (first..).take(results.len()).collect(),
            numbers,
        }
    }
}
