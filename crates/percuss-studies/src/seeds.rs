//! Results over several packings of particles: each seed is another specimen of the same solid.

use crate::{
    Error, Scenario,
    model::{Control, Model, run},
    outcome::RunResult,
};

/// The same case with the packing of another seed.
pub fn with_seed(scenario: &Scenario, seed: u64) -> Scenario {
    let mut other = scenario.clone();
    other.options.particles.seed = Some(seed);
    other
}

/// Runs a case with a number of successive seeds, from that of the case, and returns the result of every run.
///
/// # Errors
/// As those of a run.
pub fn results(
    model: &dyn Model,
    scenario: &Scenario,
    seeds: impl IntoIterator<Item = u64>,
    control: &mut Control<'_>,
) -> Result<Vec<RunResult>, Error> {
    let of = |seed| run(model, &with_seed(scenario, seed), control);
    seeds.into_iter().map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{case, summary::SeedStudy};

    /// A study has the mean and the spread of its runs, and every run is that of its seed alone.
    #[test]
    fn a_study_has_the_numbers_of_its_runs() {
        let text = "[projectile]\nmaterial = 'steel'\nlength = '10 mm'\ndiameter = '10 mm'\nimpact_velocity = '20 m/s'\n\
             nose = 'hemisphere'\n[target]\nmaterial = 'soda-lime-glass-float'\nthickness = '5 mm'\nback_face = 'free'\n\
             [particles]\nspacing = '0.7 mm'\nwidth = '30 mm'\nend_time = '10 us'\n[materials.steel]\nname = 'steel'\n\
             density = '7850 kg/m3'\nyoungs_modulus = '210 GPa'\npoissons_ratio = 0.3\nstrength.elastic = {}\n";
        let scenario = case::load_str("seeds", text).unwrap();
        let model = crate::model::model("particles").unwrap();
        let found = results(model, &scenario, 1..=3, &mut Control::default()).unwrap();
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
