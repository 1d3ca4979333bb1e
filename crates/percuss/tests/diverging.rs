//! Ladder 1, 5 and 8: targets that widen, against what is known exactly of a cone and of steady penetration.

use std::f64::consts::PI;

use crate::common::{assert_near, paper, plastic_metal, run, run_recorded};
use percuss::{analytic::Rods, case, history::Sample, outcome::RunResult};

const RADIUS: f64 = 5e-3;
const NU: f64 = 0.3;

/// A long elastic rod on an elastic target of the same radius as its mouth, in small strain.
fn elastic(back_face: &str, thickness_mm: f64, elements: (u32, u32)) -> String {
    format!(
        r#"
        projectile = {{ material = "rod", length = "400 mm", diameter = "10 mm", impact_velocity = "1 m/s" }}
        target = {{ material = "plate", thickness = "{thickness_mm} mm", back_face = "{back_face}" }}
        [chain]
        projectile_elements = {}
        target_elements = {}
        target_resistance = "diverging"
        kinematics = "small-strain"
        end_time = "100 us"
        [materials.rod]
        name = "rod"
        density = "8000 kg/m3"
        youngs_modulus = "200 GPa"
        poissons_ratio = 0.3
        strength.elastic = {{}}
        [materials.plate]
        name = "plate"
        density = "2700 kg/m3"
        youngs_modulus = "70 GPa"
        poissons_ratio = {NU}
        strength.elastic = {{}}
        "#,
        elements.0, elements.1
    )
}

/// Static stiffness of a half-space under the rod [N/m], time constant of the relaxation [s], impedance of the rod [N s/m].
fn exact() -> (f64, f64, f64) {
    let stiffness = 2.0 * 70e9 * RADIUS / (1.0 - NU * NU);
    let area = PI * RADIUS * RADIUS;
    let (rod, mouth) = (
        (200e9_f64 * 8e3).sqrt() * area,
        (70e9_f64 * 2.7e3).sqrt() * area,
    );
    (stiffness, (rod + mouth) / stiffness, rod)
}

fn samples(result: &RunResult, from: f64, to: f64) -> impl Iterator<Item = &Sample> {
    let samples = &result.history.as_ref().unwrap().samples;
    samples.iter().filter(move |s| (from..to).contains(&s.time))
}

/// In a cone `(z₀ + z) u` obeys the wave equation, so its mouth is a dashpot and a spring side by side; with the dashpot of the rod
/// the face moves as `x = (Z_r V/k)(1 − exp(−kt/(Z_r + Z_c)))`.
#[test]
fn an_elastic_cone_relaxes_exponentially_and_the_error_falls_with_the_mesh() {
    let (stiffness, relaxation, rod) = exact();
    let errors: Vec<f64> = [(200, 50), (400, 100), (800, 200)]
        .map(|mesh| {
            let result = run_recorded(&elastic("non-reflecting", 100.0, mesh));
            let last = rod / stiffness;
            // The wave comes back from the rod's tail at 160 us, and through the whole cone at 39 us.
            let (mut sum, mut count) = (0.0, 0.0);
            for s in samples(&result, 0.0, 6.0 * relaxation) {
                let exact = last * (1.0 - (-s.time / relaxation).exp());
                sum += ((s.depth - exact) / last).powi(2);
                count += 1.0;
            }
            f64::sqrt(sum / count)
        })
        .to_vec();
    println!("elastic cone, rms error of the displacement: {errors:?}");
    let order = (errors[0] / errors[2]).log2() / 2.0;
    println!("order {order:.2}");
    assert!(order > 1.5 && errors[2] < 2e-3, "{errors:?}");
}

/// Held long enough, the force over the displacement is the half-space's; a short cone with an open end knows what is behind it.
#[test]
fn the_static_stiffness_is_that_of_a_half_space_under_a_disc() {
    let (stiffness, relaxation, _) = exact();
    for (thickness, elements) in [(100.0, 100), (20.0, 40), (5.0, 20)] {
        let result = run_recorded(&elastic("non-reflecting", thickness, (400, elements)));
        let late: Vec<&Sample> = samples(&result, 12.0 * relaxation, 100e-6).collect();
        let mean = |value: fn(&Sample) -> f64| {
            late.iter().map(|s| value(s)).sum::<f64>() / late.len() as f64
        };
        let measured = mean(|s| s.contact_force) / mean(|s| s.depth);
        assert_near("static stiffness [N/m]", measured, stiffness, 2e-3);
        let numerics = result.numerics();
        assert!(numerics.energy_residual <= 1e-6 && numerics.momentum_residual <= 1e-12);
    }
    // With a fixed back at depth T the cone is stiffer by 1 + z₀/T.
    let result = run_recorded(&elastic("fixed", 20.0, (400, 40)));
    let late: Vec<&Sample> = samples(&result, 30e-6, 100e-6).collect();
    let force: f64 = late.iter().map(|s| s.contact_force).sum();
    let depth: f64 = late.iter().map(|s| s.depth).sum();
    let apex = 0.5 * PI * (1.0 - NU * NU) * RADIUS;
    assert_near(
        "stiffness with a fixed back [N/m]",
        force / depth,
        stiffness * (1.0 + apex / 20e-3),
        1e-2,
    );
}

fn depth_mm(velocity: f64, elements: (u32, u32), options: &str) -> f64 {
    run(&paper(velocity, elements, options))
        .depth_of_penetration
        .unwrap()
        * 1e3
}

/// A program written apart from this one, with areas from the middle of each element, on meshes of equal elements: 0.193 and
/// 0.196 mm at 230 m/s, 1.94 mm at 600 m/s without erosion.
#[test]
fn an_independent_program_gives_the_same_depths() {
    let never = "target_resistance = \"diverging\"\nerosion_strain = \"never\"";
    for (velocity, elements, other_mm) in [
        (230.0, (20, 50), 0.1928),
        (230.0, (40, 100), 0.1963),
        (600.0, (20, 50), 1.9417),
        (600.0, (40, 100), 1.9369),
    ] {
        let what = format!("depth [mm] at {velocity} m/s on {elements:?}");
        assert_near(&what, depth_mm(velocity, elements, never), other_mm, 0.02);
    }
}

#[test]
fn depths_converge() {
    for (resistance, velocity, tolerance) in [
        ("diverging", 230.0, 0.04),
        ("diverging-penetrable", 230.0, 0.04),
        ("diverging-penetrable", 600.0, 0.01),
        ("diverging-penetrable", 1500.0, 0.05),
    ] {
        let options = format!("target_resistance = \"{resistance}\"");
        let depths = [(40, 100), (80, 200)].map(|mesh| depth_mm(velocity, mesh, &options));
        println!("{resistance} at {velocity} m/s: {depths:?} mm");
        assert!((depths[0] / depths[1] - 1.0).abs() < tolerance);
    }
}

#[test]
fn the_books_balance_with_any_back_face_and_layers() {
    for resistance in ["diverging", "diverging-penetrable"] {
        for target in [
            "material = \"6061-t6\", thickness = \"20 mm\", back_face = \"fixed\"",
            "material = \"6061-t6\", thickness = \"20 mm\", back_face = \"free\"",
            "material = \"6061-t6\", thickness = \"20 mm\", back_face = \"non-reflecting\"",
            "material = \"4340\", thickness = \"semi-infinite\"",
            "layers = [{ material = \"4340\", thickness = \"3 mm\" }, { material = \"6061-t6\", thickness = \"semi-infinite\" }]",
        ] {
            if resistance == "diverging-penetrable" && target.starts_with("layers") {
                continue;
            }
            for velocity in [100.0, 600.0, 1500.0] {
                let result = run(&format!(
                    r#"
                    projectile = {{ material = "4340", length = "20 mm", diameter = "5 mm", impact_velocity = "{velocity} m/s" }}
                    target = {{ {target} }}
                    [chain]
                    projectile_elements = 40
                    target_resistance = "{resistance}"
                    "#
                ));
                let numerics = result.numerics();
                let residuals = (numerics.energy_residual, numerics.momentum_residual);
                println!(
                    "{resistance}, {target}, {velocity} m/s: {residuals:?}, {:?}, {:?}",
                    result.depth_of_penetration, result.outcome
                );
                assert!(residuals.0 <= 1e-3 && residuals.1 <= 1e-12);
                assert!(numerics.energy.plastic_target >= 0.0 && numerics.energy.eroded >= 0.0);
            }
        }
    }
}

/// A rod of one flow stress on a target of one, both of steel.
fn rods(diameters: u32, strengths_mpa: (f64, f64), velocity: f64, per_diameter: u32) -> String {
    format!(
        r#"
        projectile = {{ material = "rod", length = "{} mm", diameter = "10 mm", impact_velocity = "{velocity} m/s" }}
        target = {{ material = "target", thickness = "semi-infinite" }}
        [chain]
        projectile_elements = {}
        target_elements = 120
        target_resistance = "diverging-penetrable"
        {}{}
        "#,
        10 * diameters,
        per_diameter * diameters,
        plastic_metal("rod", 7850.0, 200.0, strengths_mpa.0),
        plastic_metal("target", 7850.0, 200.0, strengths_mpa.1)
    )
}

fn tate(strengths_mpa: (f64, f64)) -> Rods {
    let case = rods(3, strengths_mpa, 1000.0, 1);
    let scenario = case::load_str("test", &case).unwrap();
    let percuss::scenario::TargetBody::Layers { layers, .. } = &scenario.target else {
        unreachable!()
    };
    Rods {
        projectile_density: 7850.0,
        target_density: 7850.0,
        projectile_strength: strengths_mpa.0 * 1e6,
        target_resistance: percuss::material::cavity_expansion_pressure(&layers[0].material)
            .unwrap(),
    }
}

/// A rod that stays rigid stops at `(ρ_p L/ρ_t) ln(1 + ρ_t V²/2p_s)`, except for what the cone yields until it carries p_s.
#[test]
fn a_rigid_rod_stops_where_steady_penetration_stops_it() {
    let strengths = (20_000.0, 200.0);
    for (diameters, velocity) in [(10, 500.0), (10, 800.0), (20, 800.0)] {
        let result = run(&rods(diameters, strengths, velocity, 8));
        let exact = tate(strengths).rigid_depth(velocity, f64::from(diameters) * 10e-3);
        let excess = result.depth_of_penetration.unwrap() - exact;
        println!(
            "L/D = {diameters}, {velocity} m/s: {:.2} mm, exact {:.2} mm, entry {:.2} radii",
            result.depth_of_penetration.unwrap() * 1e3,
            exact * 1e3,
            excess / RADIUS
        );
        assert!(excess > 0.0 && excess < 1.7 * RADIUS);
    }
}

/// An eroding rod digs as Alekseevskii and Tate have it, with the strengths of both bodies as they are.
#[test]
fn an_eroding_rod_digs_at_the_speed_of_steady_flow() {
    for (strengths, velocity) in [
        ((400.0, 400.0), 1500.0),
        ((400.0, 400.0), 2500.0),
        ((800.0, 400.0), 1500.0),
    ] {
        let rods_of_tate = tate(strengths);
        let errors = [10, 20].map(|per_diameter| {
            let result = run_recorded(&rods(10, strengths, velocity, per_diameter));
            let samples = &result.history.as_ref().unwrap().samples;
            let length = 0.1;
            let at = |part: f64| {
                samples
                    .iter()
                    .find(|s| s.projectile_length < part * length)
                    .unwrap()
            };
            let (from, to) = (at(0.8), at(0.4));
            let speed = (to.depth - from.depth) / (to.time - from.time);
            // The tail hardly slows down meanwhile.
            let tail = 0.5 * (from.tail_velocity + to.tail_velocity);
            speed / rods_of_tate.penetration_speed(tail) - 1.0
        });
        println!("{strengths:?} MPa, {velocity} m/s: U is off by {errors:?}");
        assert!(errors.iter().all(|error| error.abs() < 0.055));
    }
}

/// Where the target can resist, the tip does not penetrate, and the two cones are one.
#[test]
fn below_the_threshold_a_penetrable_cone_is_the_plain_one() {
    let never = "erosion_strain = \"never\"";
    for velocity in [100.0, 230.0, 400.0] {
        let [plain, penetrable] = ["diverging", "diverging-penetrable"].map(|resistance| {
            depth_mm(
                velocity,
                (40, 100),
                &format!("target_resistance = \"{resistance}\"\n{never}"),
            )
        });
        println!("{velocity} m/s: {plain:.4} mm, penetrable {penetrable:.4} mm");
        assert!((penetrable / plain - 1.0).abs() < 1e-3);
    }
}

#[test]
fn keys_of_a_column_are_refused() {
    for (options, key) in [
        ("border_shear = 0.1", "border_shear"),
        ("constraint_factor = 2.5", "constraint_factor"),
        ("erosion_criterion = \"tate\"", "erosion_criterion"),
        ("scheme = \"published\"", "target_resistance"),
    ] {
        let text = paper(
            230.0,
            (4, 8),
            &format!("target_resistance = \"diverging\"\n{options}"),
        );
        let error = case::load_str("test", &text).unwrap_err().to_string();
        assert!(error.contains(key), "{error}");
    }
    let text = paper(230.0, (4, 8), "target_resistance = \"diverging\"")
        .replace("25 mm\" }", "25 mm\", column_diameter = \"5 mm\" }");
    let error = case::load_str("test", &text).unwrap_err().to_string();
    assert!(error.contains("column_diameter"), "{error}");
}
