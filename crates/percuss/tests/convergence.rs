//! Ladder 8: observed order of convergence on problems with an exact solution.

use crate::common::{mean, run, run_recorded};

/// Order from errors on meshes that are each twice as fine as the last, from the coarsest to the finest.
fn order(errors: &[f64]) -> f64 {
    let (first, last) = (errors[0], errors[errors.len() - 1]);
    (first / last).log2() / (errors.len() - 1) as f64
}

fn report(what: &str, errors: &[f64]) -> f64 {
    let order = order(errors);
    let texts: Vec<String> = errors.iter().map(|error| format!("{error:.2e}")).collect();
    println!("{what}: errors {}, order {order:.2}", texts.join(", "));
    order
}

const MESHES: [u32; 4] = [50, 100, 200, 400];

#[test]
fn elastic_front() {
    // Mean error of the velocity along an elastic bar with a sharp front half-way.
    let errors: Vec<f64> = MESHES
        .iter()
        .map(|n| {
            let result = run_recorded(&format!(
                r#"
                projectile = {{ material = "e", length = "100 mm", diameter = "5 mm", impact_velocity = "1 m/s" }}
                target = {{ rigid_wall = true }}
                [chain]
                projectile_elements = {n}
                kinematics = "small-strain"
                end_time = "10 us"
                [materials.e]
                name = "elastic"
                density = "8000 kg/m3"
                youngs_modulus = "200 GPa"
                poissons_ratio = 0.3
                strength.elastic = {{}}
                "#
            ));
            let profile = result.history.as_ref().unwrap().profiles.last().unwrap();
            let front = 5000.0 * profile.time;
            let stress = 200e9 / 5000.0;
            let total: f64 = profile
                .elements
                .iter()
                .map(|e| {
                    let exact = if -e.initial_position < front { stress } else { 0.0 };
                    (e.stress - exact).abs() / stress
                })
                .sum();
            total / profile.elements.len() as f64
        })
        .collect();
    // A front that stays sharp rings over a few elements; without dissipation the ringing thins out slowly.
    assert!(report("elastic front, mean stress error", &errors) > 0.3);
}

#[test]
fn plastic_plateau() {
    let errors: Vec<f64> = MESHES
        .iter()
        .map(|n| {
            let result = run_recorded(&format!(
                r#"
                projectile = {{ material = "b", length = "50 mm", diameter = "5 mm", impact_velocity = "40 m/s" }}
                target = {{ rigid_wall = true }}
                [chain]
                projectile_elements = {n}
                kinematics = "small-strain"
                adiabatic_heating = false
                artificial_viscosity = {{ linear = 0.1 }}
                [materials.b]
                name = "bilinear"
                density = "8000 kg/m3"
                youngs_modulus = "100 GPa"
                poissons_ratio = 0.3
                strength.johnson_cook = {{ a = "200 MPa", b = "5 GPa", n = 1.0, c = 0.0, m = 1.0 }}
                "#
            ));
            let (elastic, plastic) = ((100e9_f64 / 8e3).sqrt(), (100e9 * 5e9 / 105e9_f64 / 8e3).sqrt());
            let exact = 200e6 + 8e3 * plastic * (40.0 - 200e6 / (8e3 * elastic));
            let area = std::f64::consts::PI * 25e-6 / 4.0;
            (mean(&result, 0.5e-6, 24e-6, |s| s.contact_force) / area / exact - 1.0).abs()
        })
        .collect();
    assert!(report("plastic plateau from 0.5 us on", &errors) > 0.5);
}

#[test]
fn copper_taylor_bar() {
    let lengths: Vec<f64> = [20, 40, 80, 160, 320]
        .iter()
        .map(|n| {
            run(&format!(
                r#"
                projectile = {{ material = "copper", length = "23.47 mm", diameter = "7.62 mm", impact_velocity = "183 m/s" }}
                target = {{ rigid_wall = true }}
                [chain]
                projectile_elements = {n}
                "#
            ))
            .projectile_final_length
            .unwrap()
                * 1e3
        })
        .collect();
    let differences: Vec<f64> = lengths
        .windows(2)
        .map(|pair| (pair[1] - pair[0]).abs())
        .collect();
    println!("lengths [mm]: {lengths:?}");
    assert!(report("Taylor bar, change of final length [mm]", &differences) > 0.7);
}

#[test]
fn constant_pressure_in_the_time_step() {
    let exact = 8000.0 * 0.05 * 1e4 / (2.0 * 100e6);
    let errors: Vec<f64> = [0.8, 0.4, 0.2]
        .iter()
        .map(|courant| {
            let result = run(&format!(
                r#"
                projectile = {{ material = "s", length = "50 mm", diameter = "10 mm", impact_velocity = "100 m/s" }}
                target = {{ constant_pressure = "100 MPa" }}
                [chain]
                projectile_elements = 20
                courant = {courant}
                kinematics = "small-strain"
                [materials.s]
                name = "nearly rigid"
                density = "8000 kg/m3"
                youngs_modulus = "1000 GPa"
                poissons_ratio = 0.3
                strength.elastic = {{}}
                "#
            ));
            (result.depth_of_penetration.unwrap() / exact - 1.0).abs()
        })
        .collect();
    // What is left is the elastic shortening of a projectile that is not quite rigid, not the time step.
    report("constant pressure", &errors);
    assert!(errors.iter().all(|error| *error < 2e-3), "{errors:?}");
}
