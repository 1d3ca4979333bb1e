//! Models of energy, momentum and power balance against the axisymmetric model, as stored in `docs/models/`.
//!
//! `REWRITE_REFERENCES=1 cargo test --release --workspace --test all balances::` computes both sides again, in about a minute.
//! Otherwise every number of the models is compared, and those of `axi` of the first case.

use std::{env, fmt::Write as _, fs, path::Path};

use percuss::{
    Scenario, case,
    model::{self, Control},
    outcome::RunResult,
};

/// Projectile, target, L/D and velocities [m/s] of flat rods of 5 mm.
const RODS: &[(&str, &str, f64, &[f64])] = &[
    (
        "4340-johnson-cook",
        "6061-t6-lesuer",
        3.0,
        &[300.0, 1000.0, 2000.0],
    ),
    (
        "ofhc-copper-johnson-cook",
        "6061-t6-lesuer",
        3.0,
        &[300.0, 600.0, 1500.0, 4000.0],
    ),
    (
        "tungsten-alloy-steinberg",
        "4340-johnson-cook",
        3.0,
        &[600.0, 1500.0, 3000.0],
    ),
    (
        "tungsten-alloy-steinberg",
        "4340-johnson-cook",
        10.0,
        &[1500.0],
    ),
    (
        "armco-iron-johnson-cook",
        "ofhc-copper-johnson-cook",
        1.0,
        &[300.0, 1000.0],
    ),
    ("6061-t6-lesuer", "4340-johnson-cook", 3.0, &[600.0, 1500.0]),
];

/// Thicknesses over the diameter of plates.
const THICKNESSES: [f64; 5] = [0.25, 0.5, 1.0, 1.5, 2.0];

fn rod(projectile: &str, target: &str, slenderness: f64, speed: f64, cells: u32) -> Scenario {
    let text = format!(
        "projectile = {{ material = '{projectile}', length = '{} mm', diameter = '5 mm', impact_velocity = '{speed} m/s' }}\n\
         target = {{ material = '{target}', thickness = 'semi-infinite' }}\naxi.cells_per_radius = {cells}",
        5.0 * slenderness
    );
    case::load_str("rod", &text).unwrap_or_else(|error| panic!("{error}"))
}

fn run(name: &str, scenario: &Scenario) -> RunResult {
    let model = model::model(name).unwrap();
    let mut control = Control::recording();
    model::run(model, scenario, &mut control).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn detail(result: &RunResult, name: &str) -> f64 {
    let found = result.details.iter().find(|detail| detail.name == name);
    found.unwrap_or_else(|| panic!("no {name}")).value
}

fn row(numbers: &[f64]) -> String {
    numbers.iter().fold(String::new(), |mut row, number| {
        let _ = write!(row, ",{number:.2}");
        row
    })
}

/// Depths on 4 and 6 cells [mm], and shares of the kinetic energy on 6 [%]: rod (plastic, elastic, kinetic), target (the same), viscosity, contact
/// and grid.
fn axi_rod(case: (&str, &str, f64, f64)) -> Vec<f64> {
    let of = |cells| run("axi", &rod(case.0, case.1, case.2, case.3, cells));
    let (coarse, fine) = (of(4), of(6));
    let depth = |result: &RunResult| 1e3 * result.depth_of_penetration.unwrap();
    let energy = fine.numerics().energy;
    let percent = |part: f64| 100.0 * part / energy.initial;
    let lines = [
        energy.plastic_projectile,
        energy.kinetic_projectile + energy.elastic_projectile,
        energy.plastic_target,
        energy.kinetic_target + energy.elastic_target,
        energy.viscous,
        energy.contact + energy.transfer + energy.boundary + energy.eroded,
    ];
    let mut numbers = vec![depth(&coarse), depth(&fine)];
    numbers.extend(lines.map(percent));
    numbers
}

fn own_rod(case: (&str, &str, f64, f64)) -> Vec<f64> {
    let scenario = rod(case.0, case.1, case.2, case.3, 4);
    let result = run("energy_balance", &scenario);
    let mut numbers = vec![1e3 * result.depth_of_penetration.unwrap()];
    numbers.extend(
        [
            "energy: plastic work in the rod",
            "energy: debris of the rod",
            "energy: pressing the target",
            "energy: flow of the target",
            "energy: first contact",
        ]
        .map(|name| detail(&result, name)),
    );
    numbers
}

fn plate(material: &str, nose: &str, thickness: f64, speed: f64, cells: u32) -> Scenario {
    let text = format!(
        "projectile = {{ material = 'elastic', mass = '197 g', diameter = '20 mm', nose = '{nose}', impact_velocity = '{speed} m/s' }}\n\
         target = {{ material = '{material}', thickness = '{} mm', back_face = 'free' }}\naxi.cells_per_radius = {cells}\n\
         materials.elastic = {{ name = 'elastic', density = '7850 kg/m3', youngs_modulus = '210 GPa', poissons_ratio = 0.3, strength = {{ elastic = {{}} }} }}",
        20.0 * thickness
    );
    case::load_str("plate", &text).unwrap_or_else(|error| panic!("{error}"))
}

/// Force over time on even steps [N], its impulse kept in each of them.
fn forces(result: &RunResult, step: f64, steps: usize) -> Vec<f64> {
    let samples = result.history.as_ref().unwrap().samples.clone();
    let mut sums = vec![0.0; steps];
    for pair in samples.windows(2) {
        let impulse =
            0.5 * (pair[0].contact_force + pair[1].contact_force) * (pair[1].time - pair[0].time);
        let place = (0.5 * (pair[0].time + pair[1].time) / step) as usize;
        if let Some(sum) = sums.get_mut(place) {
            *sum += impulse / step;
        }
    }
    sums
}

/// Impulse that two forces over time do not share, over that of the first [%], on twenty steps of the first's contact.
fn difference_of_shape(one: &RunResult, other: &RunResult) -> f64 {
    let end = one.contact_time.unwrap();
    let (a, b) = (forces(one, end / 20.0, 20), forces(other, end / 20.0, 20));
    let apart: f64 = a.iter().zip(&b).map(|(a, b)| (a - b).abs()).sum();
    100.0 * apart / a.iter().sum::<f64>()
}

/// A case's fields and the two halves of its row.
type Line = (String, Box<dyn Fn() -> Vec<f64>>, Box<dyn Fn() -> Vec<f64>>);

/// Compares a stored table with what the models give, or writes it.
fn compare(file: &str, header: &str, lines: &[Line]) {
    let place = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../docs/models")
        .join(file);
    if env::var_os("REWRITE_REFERENCES").is_some() {
        let mut text = format!("{header}\n");
        for (case, own, axi) in lines {
            let _ = writeln!(text, "{case}{}{}", row(&own()), row(&axi()));
        }
        fs::write(&place, text).unwrap();
        return;
    }
    let stored = fs::read_to_string(&place).unwrap();
    let mut rows = stored.lines();
    assert_eq!(rows.next(), Some(header));
    for (index, (case, own, axi)) in lines.iter().enumerate() {
        let stored = rows.next().unwrap_or_else(|| panic!("no row of {case}"));
        let values: Vec<f64> = stored
            .strip_prefix(case.as_str())
            .unwrap_or_else(|| panic!("{stored} is not of {case}"))
            .split(',')
            .skip(1)
            .map(|value| value.parse().unwrap())
            .collect();
        let mut expected = own();
        if index == 0 {
            expected.extend(axi());
        }
        for (value, expected) in values.iter().zip(&expected) {
            assert!(
                (value - expected).abs() < 0.011 + 2e-4 * expected.abs(),
                "{stored}: {expected}"
            );
        }
    }
    assert_eq!(rows.next(), None);
}

#[test]
fn shares_of_energy_are_those_stored() {
    let mut lines: Vec<Line> = Vec::new();
    for &(projectile, target, slenderness, speeds) in RODS {
        for &speed in speeds {
            let case = (projectile, target, slenderness, speed);
            lines.push((
                format!("{projectile},{target},{slenderness},{speed}"),
                Box::new(move || own_rod(case)),
                Box::new(move || axi_rod(case)),
            ));
        }
    }
    compare(
        "energy_balance-axi.csv",
        "projectile,target,length_to_diameter,impact_velocity_m_s,depth_mm,rod_plastic_percent,debris_percent,pressing_percent,flow_percent,first_contact_percent,\
         axi_depth_4_cells_mm,axi_depth_6_cells_mm,axi_rod_plastic_percent,axi_rod_kinetic_elastic_percent,axi_target_plastic_percent,\
         axi_target_kinetic_elastic_percent,axi_viscosity_percent,axi_other_percent",
        &lines,
    );
}

#[test]
fn perforations_are_those_stored() {
    let mut lines: Vec<Line> = Vec::new();
    for (material, nose, speeds) in SPEEDS {
        for (thickness, speed) in THICKNESSES.into_iter().zip(speeds) {
            let own = move || run("power_balance", &plate(material, nose, thickness, speed, 4));
            let residual = |result: &RunResult| result.residual_velocity.unwrap();
            lines.push((
                format!("{material},{nose},{thickness},{speed}"),
                Box::new(move || {
                    let result = own();
                    vec![
                        result.ballistic_limit.unwrap(),
                        residual(&result),
                        1e-3 * result.peak_force.unwrap(),
                        1e6 * result.end_time.unwrap(),
                    ]
                }),
                Box::new(move || {
                    let of = |cells| run("axi", &plate(material, nose, thickness, speed, cells));
                    let (coarse, fine) = (of(4), of(6));
                    vec![
                        residual(&coarse),
                        residual(&fine),
                        1e-3 * fine.peak_force.unwrap(),
                        1e6 * fine.contact_time.unwrap(),
                        difference_of_shape(&fine, &coarse),
                        difference_of_shape(&fine, &own()),
                    ]
                }),
            ));
        }
    }
    compare(
        "power_balance-axi.csv",
        "plate,nose,thickness_to_diameter,impact_velocity_m_s,ballistic_limit_m_s,residual_velocity_m_s,peak_force_kn,contact_time_us,\
         axi_residual_velocity_4_cells_m_s,axi_residual_velocity_6_cells_m_s,axi_peak_force_kn,axi_contact_time_us,axi_force_4_to_6_cells_percent,\
         force_to_axi_percent",
        &lines,
    );
}

/// Impact velocities [m/s] by plate and nose at each thickness: half as much again as the limits of the first version of `power_balance`,
/// in steps of 10 m/s. They stay, so that later versions are compared with the same runs of `axi`.
const SPEEDS: [(&str, &str, [f64; 5]); 6] = [
    (
        "weldox-460-e-borvik",
        "flat",
        [140.0, 170.0, 280.0, 450.0, 660.0],
    ),
    (
        "weldox-460-e-borvik",
        "hemisphere",
        [350.0, 340.0, 470.0, 610.0, 740.0],
    ),
    ("6061-t6-lesuer", "flat", [90.0, 50.0, 90.0, 190.0, 390.0]),
    (
        "6061-t6-lesuer",
        "hemisphere",
        [260.0, 230.0, 320.0, 410.0, 490.0],
    ),
    (
        "1006-johnson-cook",
        "flat",
        [120.0, 170.0, 280.0, 420.0, 590.0],
    ),
    (
        "1006-johnson-cook",
        "hemisphere",
        [300.0, 300.0, 410.0, 530.0, 640.0],
    ),
];
