use std::sync::atomic::AtomicBool;

use super::{accepts, run};
use crate::{Error, Scenario, case, chain::column::ColumnRun, lanes::LANES, model::Control};

/// A shot of the paper's rod and plate with other numbers.
fn shot(rod: &str, target: &str, velocity: f64, options: &str) -> Scenario {
    let text = format!(
        "projectile = {{ material = '{rod}', length = '12.74 mm', diameter = '4.8 mm', impact_velocity = '{velocity} m/s' }}\n\
         target = {{ {target} }}\n[chain]\ntarget_resistance = 'column'\n{options}\n[materials.elastic]\nname = 'e'\n\
         density = '8000 kg/m3'\nyoungs_modulus = '200 GPa'\npoissons_ratio = 0.3\nstrength.elastic = {{}}\n\
         [materials.perfect]\nname = 'p'\ndensity = '8000 kg/m3'\nyoungs_modulus = '200 GPa'\npoissons_ratio = 0.3\n\
         specific_heat = '400 J/(kg K)'\nstrength.perfectly_plastic = {{ flow_stress = '600 MPa' }}\n"
    );
    case::load_str("shot", &text).unwrap_or_else(|error| panic!("{error}"))
}

const PLATE: &str = "material = 'aluminium-2024-t351', thickness = '25 mm'";

/// Runs over speeds, materials, meshes, closures, back faces and ends.
fn runs() -> Vec<Scenario> {
    let coarse = "projectile_elements = 10\ntarget_elements = 20";
    let mut runs = Vec::new();
    for velocity in [20.0, 150.0, 190.0, 230.0, 310.0, 400.0] {
        for more in ["", "border_shear = 0.0", "constraint_factor = 1.0"] {
            let options = format!("{coarse}\n{more}");
            runs.push(shot("copper", PLATE, velocity, &options));
        }
    }
    let free = "material = 'aluminium-2024-t351', thickness = '9 mm', back_face = 'free'";
    let thin = "material = 'aluminium-2024-t351', thickness = '3 mm', back_face = 'free'";
    let endless = "material = 'aluminium-2024-t351', thickness = 'semi-infinite'";
    let elastic = "material = 'elastic', thickness = '25 mm'";
    let perfect = "material = 'perfect', thickness = '25 mm', column_diameter = '6 mm'";
    for (rod, target, velocity, more) in [
        ("copper", PLATE, 900.0, ""),
        ("copper", PLATE, 600.0, "erosion_strain = 'never'"),
        ("copper", PLATE, 300.0, "courant = 0.3"),
        ("copper", PLATE, 300.0, "max_steps = 77"),
        ("copper", PLATE, 300.0, "end_time = '9 us'"),
        ("copper", PLATE, 300.0, "end_at_rest = true"),
        ("copper", PLATE, 900.0, "end_at_rest = true"),
        ("copper", free, 350.0, "end_at_rest = true"),
        ("elastic", PLATE, 250.0, "end_at_rest = true"),
        ("copper", free, 350.0, "border_shear = 0.0"),
        (
            "copper",
            free,
            350.0,
            "border_shear = 0.1\nconstraint_factor = 1.0",
        ),
        (
            "copper",
            thin,
            400.0,
            "border_shear = 0.05\nconstraint_factor = 1.0",
        ),
        ("copper", endless, 300.0, ""),
        ("copper", endless, 2500.0, "border_shear = 0.0"),
        ("elastic", elastic, 100.0, "border_shear = 0.0"),
        ("elastic", PLATE, 250.0, ""),
        ("perfect", perfect, 250.0, "adiabatic_heating = false"),
        ("perfect", PLATE, 180.0, "erosion_strain = 0.3"),
        // Erosion of the rod, of the target and of both, at their ends and inside, in company and in pieces that meet again.
        ("copper", PLATE, 450.0, ""),
        ("copper", PLATE, 500.0, "erosion_strain = 1.0"),
        ("copper", PLATE, 700.0, "courant = 0.4"),
        ("copper", PLATE, 700.0, "border_shear = 0.0"),
        ("copper", PLATE, 1300.0, "courant = 0.2"),
        ("copper", endless, 700.0, "erosion_strain = 0.8"),
        ("copper", free, 700.0, "erosion_strain = 0.6"),
        ("elastic", PLATE, 700.0, "erosion_strain = 0.4"),
        ("elastic", PLATE, 1500.0, ""),
        ("elastic", endless, 900.0, "erosion_strain = 0.5"),
        (
            "elastic",
            free,
            600.0,
            "constraint_factor = 1.0\nerosion_strain = 0.5",
        ),
        ("perfect", perfect, 400.0, "erosion_strain = 0.2"),
        ("perfect", perfect, 800.0, "erosion_strain = 0.2"),
        (
            "perfect",
            perfect,
            600.0,
            "constraint_factor = 1.0\nerosion_strain = 0.3",
        ),
        (
            "perfect",
            PLATE,
            900.0,
            "erosion_strain = 0.6\nborder_shear = 0.0",
        ),
    ] {
        runs.push(shot(rod, target, velocity, &format!("{coarse}\n{more}")));
    }
    for (rod, target) in [(1, 1), (2, 3), (7, 5)] {
        let mesh = format!("projectile_elements = {rod}\ntarget_elements = {target}");
        runs.push(shot("copper", PLATE, 230.0, &mesh));
    }
    runs
}

/// Numbers from 0 to 1 without a pattern.
struct Chance(u64);

impl Chance {
    fn between(&mut self, least: f64, most: f64) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        least + (most - least) * (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Text of a strength law with constants of its own.
    fn law(&mut self) -> String {
        let kind = self.between(0.0, 5.0) as u32;
        let (first, second) = (self.between(80.0, 600.0), self.between(100.0, 700.0));
        let n = self.between(0.1, 0.6);
        let (c, m) = (self.between(0.0, 0.04), self.between(0.7, 1.4));
        match kind {
            // Beyond these a power law would yield at once.
            0 => format!(
                "power_law = {{ coefficient = '{} MPa', exponent = {} }}",
                300.0 + second,
                0.4 * n
            ),
            1 => format!("perfectly_plastic = {{ flow_stress = '{first} MPa' }}"),
            2 | 3 => {
                let form = if kind == 2 { "logarithmic" } else { "power" };
                let rate = 10.0_f64.powf(self.between(-3.0, 0.0));
                format!(
                    "johnson_cook = {{ a = '{first} MPa', b = '{second} MPa', n = {n}, c = {c}, m = {m}, \
                     reference_rate = '{rate} 1/s', rate_form = '{form}' }}"
                )
            }
            _ => {
                let (beta, pressure) = (self.between(2.0, 50.0), self.between(1e-12, 4e-11));
                format!(
                    "steinberg_guinan = {{ y0 = '{first} MPa', y_max = '1500 MPa', beta = {beta}, n = {n}, \
                     pressure_coefficient = '{pressure} 1/Pa', temperature_coefficient = '{} 1/K' }}",
                    1e-5 * beta
                )
            }
        }
    }

    /// A shot of two such metals.
    fn shot(&mut self) -> Scenario {
        let metal = |name: &str, law: &str, [modulus, density, room]: [f64; 3]| {
            format!(
                "[materials.{name}]\nname = '{name}'\ndensity = '{density} kg/m3'\nyoungs_modulus = '{modulus} GPa'\n\
                 poissons_ratio = 0.3\nspecific_heat = '450 J/(kg K)'\nroom_temperature = '{room} K'\n\
                 melting_temperature = '1300 K'\nstrength.{law}\n"
            )
        };
        let mut numbers = || {
            [
                self.between(70.0, 210.0),
                self.between(2700.0, 9000.0),
                self.between(250.0, 600.0),
            ]
        };
        let constants = [numbers(), numbers()];
        let (rod, target) = (self.law(), self.law());
        let (velocity, shear) = (self.between(50.0, 900.0), self.between(0.0, 0.6));
        let erosion = self.between(0.3, 1.5);
        let [rate_effects, heating, whole] = [0, 1, 2].map(|_| self.between(0.0, 1.0) < 0.8);
        let [hot_rod, hot_plate] = [0, 1].map(|_| match self.between(0.0, 1.0) < 0.3 {
            true => format!(", temperature = '{} K'", self.between(300.0, 900.0)),
            false => String::new(),
        });
        let text = format!(
            "projectile = {{ material = 'rod', length = '12.74 mm', diameter = '4.8 mm', impact_velocity = '{velocity} m/s'{hot_rod} }}\n\
             target = {{ material = 'plate', thickness = '25 mm'{hot_plate} }}\n[chain]\ntarget_resistance = 'column'\n\
             projectile_elements = 8\ntarget_elements = 15\nborder_shear = {shear}\nerosion_strain = {erosion}\n\
             rate_effects = {rate_effects}\nadiabatic_heating = {heating}\nend_at_rest = {}\n{}{}",
            !whole,
            metal("rod", &rod, constants[0]),
            metal("plate", &target, constants[1]),
        );
        case::load_str("shot", &text).unwrap_or_else(|error| panic!("{error}\n{text}"))
    }
}

/// Everything that a run says, in words that are the same only for the same bits.
fn words(result: &Result<crate::outcome::RunResult, Error>) -> String {
    format!("{result:?}")
}

fn together(runs: &[&Scenario]) -> Vec<String> {
    let results = run(runs, &AtomicBool::new(false)).unwrap();
    assert_eq!(results.len(), runs.len());
    results.iter().map(words).collect()
}

#[test]
fn runs_side_by_side_end_with_the_bits_of_single_runs() {
    let runs = runs();
    assert!(runs.len() > 3 * LANES && runs.iter().all(accepts));
    let results = together(&runs.iter().collect::<Vec<_>>());
    for (shot, result) in runs.iter().zip(&results) {
        let alone = ColumnRun::new(shot, &mut Control::default())
            .unwrap()
            .run(&mut Control::default());
        assert_eq!(result, &words(&alone), "{:?}", shot.options.chain);
    }
    let said = |what: &str| results.iter().filter(|words| words.contains(what)).count();
    // The runs are worth something as a test only if they end in many ways.
    for outcome in [
        "Rebounded",
        "Perforated",
        "StepLimit",
        "EndTime",
        "termination: AtRest",
    ] {
        assert!(said(outcome) > 0, "none is {outcome}");
    }
    let eroded = |words: &&String| {
        words.contains("eroded_elements") && !words.contains("eroded_elements: (0, 0)")
    };
    let eroded: Vec<&str> = results
        .iter()
        .filter(eroded)
        .filter_map(|words| words.split_once("eroded_elements: ")?.1.split_once(')'))
        .map(|(counts, _)| counts)
        .collect();
    let of_rod = eroded
        .iter()
        .filter(|counts| !counts.starts_with("(0,"))
        .count();
    let of_target = eroded
        .iter()
        .filter(|counts| !counts.ends_with(" 0"))
        .count();
    assert!(of_rod >= 8 && of_target >= 4, "{eroded:?}");
}

#[test]
fn a_shot_knows_nothing_of_its_company() {
    let runs = runs();
    let all: Vec<&Scenario> = runs.iter().collect();
    let expected = together(&all);
    let mut backwards: Vec<&Scenario> = all.iter().rev().copied().collect();
    let mut results = together(&backwards);
    results.reverse();
    assert_eq!(results, expected);
    for size in [1, 3, 11] {
        let parts: Vec<String> = all.chunks(size).flat_map(together).collect();
        assert_eq!(parts, expected, "{size} at once");
    }
    backwards.truncate(5);
    backwards.extend(all.iter().take(2));
    assert_eq!(together(&backwards)[5..], expected[..2]);
}

#[test]
fn every_strength_law_has_the_bits_of_single_runs() {
    let mut chance = Chance(5);
    let runs: Vec<Scenario> = (0..120).map(|_| chance.shot()).collect();
    assert!(runs.iter().all(accepts));
    let results = together(&runs.iter().collect::<Vec<_>>());
    let mut penetrated = 0;
    for (shot, result) in runs.iter().zip(&results) {
        let alone = ColumnRun::new(shot, &mut Control::default())
            .and_then(|run| run.run(&mut Control::default()));
        penetrated += usize::from(alone.is_ok());
        assert_eq!(result, &words(&alone), "{shot:?}");
    }
    assert!(penetrated > 100, "{penetrated}");
}

#[test]
fn runs_that_need_more_are_left_to_the_single_run() {
    for more in [
        "damping_ratio = 0.1",
        "local_damping = 0.1",
        "kinematics = 'small-strain'",
        "artificial_viscosity.linear = 0.1",
        "erosion_criterion = 'tate'",
        "failure.spall = { strength = '1 GPa' }",
    ] {
        assert!(!accepts(&shot("copper", PLATE, 200.0, more)), "{more}");
    }
    assert!(accepts(&shot("copper", PLATE, 200.0, "")));
}

#[test]
fn a_stopped_batch_says_so() {
    let runs = runs();
    let all: Vec<&Scenario> = runs.iter().collect();
    assert!(run(&all, &AtomicBool::new(true)).is_err());
}
