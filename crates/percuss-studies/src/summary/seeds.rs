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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        case,
        model::{Control, model, run},
    };
    use percuss_models::particles::with_seed;

    /// A study has the mean and the spread of its runs, and every run is that of its seed alone.
    #[test]
    fn a_study_has_the_numbers_of_its_runs() {
        let text = "[projectile]\nmaterial = 'steel'\nlength = '10 mm'\ndiameter = '10 mm'\nimpact_velocity = '20 m/s'\n\
             nose = 'hemisphere'\n[target]\nmaterial = 'soda-lime-glass-float'\nthickness = '5 mm'\nback_face = 'free'\n\
             [particles]\nspacing = '0.7 mm'\nwidth = '30 mm'\nend_time = '10 us'\n[materials.steel]\nname = 'steel'\n\
             density = '7850 kg/m3'\nyoungs_modulus = '210 GPa'\npoissons_ratio = 0.3\nstrength.elastic = {}\n";
        let scenario = case::load_str("seeds", text).unwrap();
        let model = model("particles").unwrap();
        let of = |seed| run(model, &with_seed(&scenario, seed), &mut Control::default()).unwrap();
        let found = [1, 2, 3].map(of);
        let study = SeedStudy::new(&scenario, 1, &found.iter().collect::<Vec<_>>());
        assert_eq!(study.seeds, [1, 2, 3]);
        let broken = study.numbers.iter().find(|n| n.name == "broken_bonds");
        let broken = broken.unwrap();
        let alone = run(model, &with_seed(&scenario, 2), &mut Control::default()).unwrap();
        let of_alone = alone.cracks.unwrap().broken_bonds as f64;
        assert_eq!(broken.values[1], of_alone);
        assert!(broken.standard_deviation > 0.0 && of_alone > 0.0);
        assert_eq!(broken.mean, broken.values.iter().sum::<f64>() / 3.0);
        assert!(broken.smallest < broken.mean && broken.mean < broken.largest);
    }
}
