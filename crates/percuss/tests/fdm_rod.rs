//! The finite-difference rod against exact solutions and against the chain.

use crate::common::{
    assert_near, fdm, fdm_recorded, mean, paper,
    rods::{assert_levels, assert_wilkins, elastic_bars, taylor_length},
    run,
};
use percuss::{
    model::{self, Control},
    outcome::{Outcome, RunResult},
};

fn assert_books(result: &RunResult) {
    let numerics = result.numerics();
    assert!(
        numerics.energy_residual <= 1e-3,
        "{:e}",
        numerics.energy_residual
    );
    assert!(
        numerics.momentum_residual <= 1e-9,
        "{:e}",
        numerics.momentum_residual
    );
}

/// Two elastic bars on a mesh.
fn bars(
    velocity: f64,
    target: &str,
    thickness_mm: f64,
    back_face: &str,
    cells: (u32, u32),
) -> String {
    let (projectile, plate) = cells;
    let options = format!(
        "[fdm]\nprojectile_elements = {projectile}\ntarget_elements = {plate}\nborder_shear = 0.0"
    );
    elastic_bars(velocity, target, thickness_mm, back_face, &options)
}

#[test]
fn interface_speed_and_stress_of_unlike_bars() {
    let velocity = 0.5;
    let result = fdm_recorded(&bars(velocity, "plate", 25.0, "fixed", (80, 160)));
    let (z1, z2) = ((114e9_f64 * 8500.0).sqrt(), (70e9_f64 * 2780.0).sqrt());
    let area = std::f64::consts::PI * 4.8e-3 * 4.8e-3 / 4.0;
    let (from, to) = (1.5e-6, 6.3e-6);
    let speed = mean(&result, from, to, |s| s.interface_velocity);
    assert_near(
        "interface speed [m/s]",
        speed,
        z1 * velocity / (z1 + z2),
        1e-3,
    );
    let stress = mean(&result, from, to, |s| s.contact_force / area);
    assert_near(
        "interface stress [Pa]",
        stress,
        z1 * z2 * velocity / (z1 + z2),
        1e-3,
    );
    assert!(result.numerics().momentum_residual <= 1e-12);
    // The book closes to second order in the strain, so its residual falls with the speed.
    let slower = fdm(&bars(0.1 * velocity, "plate", 25.0, "fixed", (80, 160)));
    let residuals = [result, slower].map(|result| result.numerics().energy_residual);
    println!(
        "energy residuals {:.1e} and {:.1e}",
        residuals[0], residuals[1]
    );
    assert!(
        residuals[0] <= 3e-5 && residuals[1] <= 0.15 * residuals[0],
        "{residuals:?}"
    );
}

#[test]
fn like_bars_exchange_their_velocities() {
    let mut losses = Vec::new();
    for cells in [20, 80, 320] {
        let result = fdm(&bars(0.5, "rod", 12.74, "free", (cells, cells)));
        let speed = result.residual_velocity.unwrap();
        let loss = result.numerics().energy.contact / result.numerics().energy.initial;
        println!("{cells} cells: left with {speed:.2e} of 0.5 m/s, contact loss {loss:.2e}");
        assert!(speed.abs() < 0.5 * 0.03, "{speed}");
        losses.push(loss);
        assert_books(&result);
    }
    // What the inelastic meeting of two nodes costs is a part of one cell's energy.
    assert!(
        (losses[0] / losses[2] / 16.0 - 1.0).abs() < 0.2,
        "{losses:?}"
    );
}

fn stiff(target: &str, length_mm: f64, velocity: f64, strength: &str, cells: u32) -> String {
    format!(
        r#"
        projectile = {{ material = "stiff", length = "{length_mm} mm", diameter = "10 mm", impact_velocity = "{velocity} m/s" }}
        target = {{ {target} }}
        [fdm]
        projectile_elements = {cells}
        [materials.stiff]
        name = "nearly rigid"
        density = "8000 kg/m3"
        youngs_modulus = "1000 GPa"
        poissons_ratio = 0.3
        strength.{strength}
        "#
    )
}

/// Depth `ρ L V²/(2R)` of a projectile that does not deform against a constant pressure R.
#[test]
fn a_constant_pressure_stops_it_where_its_energy_is_used_up() {
    for (pressure_mpa, velocity) in [(100.0, 100.0), (500.0, 300.0), (50.0, 20.0)] {
        let target = format!("constant_pressure = \"{pressure_mpa} MPa\"");
        let result = fdm(&stiff(&target, 50.0, velocity, "elastic = {}", 20));
        let exact = 8000.0 * 0.05 * velocity * velocity / (2.0 * pressure_mpa * 1e6);
        let depth = result.depth_of_penetration.unwrap();
        assert_eq!(result.outcome, Outcome::AtRest);
        assert_near("depth [m]", depth, exact, 5e-3);
        assert_near(
            "time to rest [s]",
            result.time_to_rest.unwrap(),
            2.0 * exact / velocity,
            5e-3,
        );
        assert_books(&result);
    }
}

#[test]
fn a_rigid_plastic_rod_shortens_as_taylor_says() {
    for velocity in [30.0, 60.0, 100.0] {
        let strength = "perfectly_plastic = { flow_stress = \"200 MPa\" }";
        let result = fdm(&stiff("rigid_wall = true", 100.0, velocity, strength, 200));
        assert_books(&result);
        let number = 8000.0 * velocity * velocity / 200e6;
        let length = result.projectile_final_length.unwrap() / 0.1;
        assert_near("Lf/L0", length, taylor_length(number), 5e-3);
        if velocity == 30.0 {
            // A front that stands still, to first order in ρV²/Y.
            assert_near("Lf/L0, standing front", length, (-0.5 * number).exp(), 2e-3);
        }
    }
}

#[test]
fn copper_rods_end_as_long_as_they_were_measured() {
    assert_wilkins(|case| {
        let result = fdm(case);
        assert_books(&result);
        result
    });
}

/// Every level of strain travels at its own speed. In finite strain the force is `A₀ σ e^ε` and the engineering strain
/// `1 − e^{−ε}`, so in the initial coordinates `c² = (dσ/dε + σ) e^{2ε}/ρ` with the tangent `dσ/dε = E H/(E + H)`.
#[test]
fn strain_levels_travel_at_their_own_speeds() {
    let (modulus, density, coefficient, exponent) = (100e9, 8000.0, 500e6_f64, 0.3);
    let time = 30e-6;
    let result = fdm_recorded(&format!(
        r#"
        projectile = {{ material = "hardening", length = "200 mm", diameter = "5 mm", impact_velocity = "60 m/s" }}
        target = {{ rigid_wall = true }}
        [fdm]
        projectile_elements = 2000
        end_time = "30 us"
        artificial_viscosity = {{ linear = 0.02 }}
        [materials.hardening]
        name = "hardening"
        density = "8000 kg/m3"
        youngs_modulus = "100 GPa"
        poissons_ratio = 0.3
        strength.power_law = {{ coefficient = "500 MPa", exponent = {exponent} }}
        "#
    ));
    assert_books(&result);
    let yield_strain = (coefficient / modulus).powf(1.0 / (1.0 - exponent));
    let speed = |plastic_strain: f64| {
        let strain = yield_strain + plastic_strain;
        let stress = coefficient * strain.powf(exponent);
        let hardening = exponent * stress / strain;
        let tangent = modulus * hardening / (modulus + hardening);
        let logarithmic = plastic_strain + stress / modulus;
        ((tangent + stress) / density).sqrt() * logarithmic.exp()
    };
    assert_levels(&result, speed);
    let last = result.history.as_ref().unwrap().profiles.last().unwrap();
    assert!(last.time >= time);
}

/// The seed paper's figure 7: discrete elements against finite differences, here without erosion in either.
#[test]
fn the_chain_and_finite_differences_agree() {
    for (mesh, tolerance) in [((10, 20), 0.025), ((40, 80), 0.015)] {
        for velocity in [150.0, 230.0, 300.0, 400.0, 600.0, 800.0, 1000.0] {
            let case = paper(
                velocity,
                mesh,
                "target_resistance = \"column\"\nerosion_strain = \"never\"",
            );
            let (chain, here) = (run(&case), fdm(&case));
            let depth = |result: &RunResult| result.depth_of_penetration.unwrap() * 1e3;
            println!(
                "| {}–{} | {velocity} | {:.4} | {:.4} | {:+.2} % |",
                mesh.0,
                mesh.1,
                depth(&chain),
                depth(&here),
                100.0 * (depth(&here) / depth(&chain) - 1.0)
            );
            let difference = depth(&here) / depth(&chain) - 1.0;
            assert!(
                difference.abs() < tolerance,
                "{mesh:?} {velocity} m/s: {difference}"
            );
            assert_books(&here);
        }
    }
}

/// The observed differences shrink with the mesh: both converge to one answer.
#[test]
fn finer_meshes_agree_better() {
    let difference = |factor: u32| {
        let case = paper(
            230.0,
            (10 * factor, 20 * factor),
            "target_resistance = \"column\"",
        );
        let (chain, here) = (run(&case), fdm(&case));
        here.depth_of_penetration.unwrap() / chain.depth_of_penetration.unwrap() - 1.0
    };
    let differences = [1, 4, 16].map(difference);
    println!("{differences:.5?}");
    assert!(
        differences[2].abs() < 0.5 * differences[0].abs(),
        "{differences:?}"
    );
}

#[test]
fn a_rod_that_erodes_is_refused_unless_the_case_asks_for_no_erosion() {
    let model = model::model("fdm").unwrap();
    let run = |options: &str| {
        let scenario = crate::common::scenario(&paper(1000.0, (10, 20), options));
        model::run(model, &scenario, &mut Control::default())
    };
    let refused = run("").unwrap_err().to_string();
    assert!(refused.contains("no erosion"), "{refused}");
    assert!(run("erosion_strain = \"never\"").is_ok());
}

#[test]
fn without_erosion_a_crushed_cell_is_warned_of() {
    let says = |result: RunResult| {
        result
            .warnings
            .iter()
            .any(|line| line.contains("no erosion"))
    };
    assert!(says(fdm(&paper(
        1000.0,
        (10, 20),
        "erosion_strain = \"never\""
    ))));
    assert!(!says(fdm(&paper(230.0, (10, 20), ""))));
}

#[test]
fn zero_speed_gives_zero_depth() {
    let result = fdm(&paper(0.0, (10, 20), ""));
    assert_eq!(result.depth_of_penetration, Some(0.0));
    assert_eq!(result.outcome, Outcome::AtRest);
}

/// What `[chain]` says holds unless `[fdm]` says otherwise.
#[test]
fn the_chains_options_are_taken_over() {
    let chained = fdm(&paper(230.0, (10, 20), "border_shear = 0.0"));
    let own = fdm(&paper(
        230.0,
        (40, 80),
        "[fdm]\nprojectile_elements = 10\ntarget_elements = 20\nborder_shear = 0.0",
    ));
    assert_eq!(chained.numerics().elements, (10, 20));
    assert_eq!(chained.depth_of_penetration, own.depth_of_penetration);
    let closed = fdm(&paper(230.0, (10, 20), ""));
    assert!(closed.depth_of_penetration < chained.depth_of_penetration);
}

#[test]
fn layers_and_back_faces() {
    for back_face in ["fixed", "free", "non-reflecting"] {
        let result = fdm(&format!(
            r#"
            projectile = {{ material = "copper", length = "12.74 mm", diameter = "4.8 mm", impact_velocity = "230 m/s" }}
            [target]
            back_face = "{back_face}"
            layers = [
                {{ material = "4340", thickness = "2 mm" }},
                {{ material = "aluminium-2024-t351", thickness = "10 mm" }},
            ]
            "#
        ));
        println!(
            "{back_face}: {:?} {:?}",
            result.outcome, result.depth_of_penetration
        );
        assert_books(&result);
        let deep = run(&format!(
            r#"
            projectile = {{ material = "copper", length = "12.74 mm", diameter = "4.8 mm", impact_velocity = "230 m/s" }}
            [target]
            back_face = "{back_face}"
            layers = [
                {{ material = "4340", thickness = "2 mm" }},
                {{ material = "aluminium-2024-t351", thickness = "10 mm" }},
            ]
            "#
        ));
        assert_eq!(deep.outcome, result.outcome);
        let (a, b) = (
            deep.depth_of_penetration.unwrap(),
            result.depth_of_penetration.unwrap(),
        );
        assert_near("depth against the chain [m]", b, a, 0.03);
    }
}
