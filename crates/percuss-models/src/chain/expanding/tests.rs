//! Exact checks of the parts of the expanding cavity and of their interaction.

use std::{f64::consts::PI, sync::Arc};

use super::{
    CavityRun, StepControl,
    resistance::{Pressures, Resistance},
    rod::Rod,
    slice::Metal,
};
use crate::{
    Scenario,
    case::{self, TargetResistanceModel},
    model::{self, Control},
    outcome::{Outcome, PLANE_IMPACT, RunResult},
    resistance::{CustomResistance, ResistanceLaw},
};

fn scenario(projectile: &str, target: &str, length: f64, speed: f64, more: &str) -> Scenario {
    let text = format!(
        "[projectile]\nmaterial = \"{projectile}\"\nlength = \"{length} mm\"\ndiameter = \"5 mm\"\nimpact_velocity = \"{speed} m/s\"\n\
         [target]\nmaterial = \"{target}\"\nthickness = \"semi-infinite\"\n\
         [chain]\ntarget_resistance = \"expanding-cavity\"\n{more}"
    );
    case::load_str("impact", &text).unwrap()
}

fn run(scenario: &Scenario) -> RunResult {
    CavityRun::new(scenario, &mut Control::default())
        .unwrap()
        .run(&mut Control::default())
        .unwrap()
}

const RADIUS: f64 = 2.5e-3;
const LENGTH: f64 = 50e-3;

/// A rod that does not flow, long against its radius.
fn elastic_rod(slices: usize) -> Rod {
    let steel = toml::from_str(
        "name = 'a'\ndensity = '7850 kg/m3'\nyoungs_modulus = '205 GPa'\npoissons_ratio = 0.3\n\
         strength.perfectly_plastic = { flow_stress = '1e4 GPa' }",
    );
    let metal = Metal::new(&steel.unwrap(), 0.0, false);
    Rod::new(metal, slices, LENGTH, PI * RADIUS * RADIUS, 293.0, 0.0)
}

fn advance(rod: &mut Rod, step: f64) {
    rod.collect();
    rod.kick(step);
    kick_tip(rod, step);
    rod.drift(step).unwrap();
}

/// A tip that nothing pushes.
fn kick_tip(rod: &mut Rod, step: f64) {
    let mut tip = rod.tip().unwrap();
    tip.kick(tip.whole_force() * step);
    rod.nodes.set_last(tip);
}

/// Square of the circular frequency of waves of a wave number, over ρ: the lower root of
/// `[(λ + 2G)k² − ρω²] [4(λ + G) + ½R²(Gk² − ρω²)] = 4λ²k²`, which follows from axial and radial balance \[mindlin1952\].
fn dispersion(metal: &Metal, wave_number: f64) -> f64 {
    let shear = metal.shear_modulus;
    let lame = metal.bulk_modulus - shear / 1.5;
    let square = wave_number * wave_number;
    let half = 0.5 * RADIUS * RADIUS;
    let axial = (lame + 2.0 * shear) * square;
    let radial = 4.0 * (lame + shear) + half * shear * square;
    // half x² − (radial + half axial) x + axial radial − 4λ²k² = 0
    let linear = radial + half * axial;
    let constant = axial * radial - 4.0 * lame * lame * square;
    2.0 * constant / (linear + (linear * linear - 4.0 * half * constant).sqrt())
}

#[test]
fn long_waves_travel_as_in_loves_bar_with_its_shear() {
    // Love's bar has the inertia of its widening only: E k² (1 − ½ν²R²k²) for long waves [love1927]. Shear between slices takes the
    // part G/E of that back.
    let (modulus, ratio, wave_number): (f64, f64, f64) = (205e9, 0.3, 40.0);
    let shear = 0.5 / (1.0 + ratio);
    let delay = 0.5 * (ratio * RADIUS * wave_number).powi(2) * (1.0 - shear);
    let expected = modulus * wave_number * wave_number * (1.0 - delay);
    let found = dispersion(&elastic_rod(1).metal, wave_number);
    assert!((found / expected - 1.0).abs() < 1e-6, "{found} {expected}");
}

#[test]
fn a_bar_vibrates_as_mindlin_and_herrmann_have_it() {
    // The ends are free of shear, which a wave of one shape is not: that leaves a little of an end effect.
    for mode in [1.0, 3.0] {
        let mut rod = elastic_rod(200);
        let wave_number = mode * PI / LENGTH;
        rod.nodes.change(|_, node| {
            node.velocity = (wave_number * (node.position + LENGTH)).cos();
        });
        let exact = 2.0 * PI / (dispersion(&rod.metal, wave_number) / rod.metal.density).sqrt();
        let step = 0.5 * rod.stable_step(1.0);
        // Quarter periods of the tail: its velocity passes zero at 1/4 and at 17/4 of a period.
        let (mut crossings, mut time, mut before) = (Vec::new(), 0.0, 1.0_f64);
        while crossings.len() < 9 {
            advance(&mut rod, step);
            time += step;
            // The widening rings by itself, much faster and weaker: the mode is what is left on the mean over the bar.
            let after: f64 = rod
                .nodes
                .iter()
                .map(|n| n.mass() * n.velocity * (wave_number * (n.position + LENGTH)).cos())
                .sum();
            if before.signum() != after.signum() && time > step {
                crossings.push(time - step * after / (after - before));
            }
            before = after;
        }
        let period = (crossings[8] - crossings[0]) / 4.0;
        assert!(
            (period / exact - 1.0).abs() < 6e-4,
            "mode {mode}: {period} {exact}"
        );
    }
}

/// Largest momentum of the first mode of a free bar in successive half periods, under damping.
fn momentum_peaks(control: &StepControl, slices: usize, half_periods: usize) -> Vec<f64> {
    let mut rod = elastic_rod(slices);
    let shape = |position: f64| (PI / LENGTH * (position + LENGTH)).cos();
    rod.nodes
        .change(|_, node| node.velocity = shape(node.position));
    let step = 0.3 * rod.stable_step(1.0);
    let (mut peaks, mut largest, mut before) = (Vec::new(), 0.0_f64, 1.0_f64);
    while peaks.len() < half_periods {
        rod.collect();
        rod.damp(control, 0.0);
        rod.kick(step);
        kick_tip(&mut rod, step);
        rod.drift(step).unwrap();
        let momentum: f64 = rod
            .nodes
            .iter()
            .map(|n| n.mass() * n.velocity * shape(n.position))
            .sum();
        if momentum.signum() != before.signum() {
            peaks.push(std::mem::take(&mut largest));
        }
        largest = largest.max(momentum.abs());
        before = momentum;
    }
    peaks
}

#[test]
fn a_damped_bar_loses_the_exact_part_of_its_amplitude() {
    let control = |options: &str| {
        StepControl::new(&toml::from_str(options).unwrap(), 0.5, 2.0, f64::INFINITY)
    };
    // On the way out local damping adds its part to the stiffness, on the way back it takes it off: sqrt((1 - a)/(1 + a)) in a half period.
    for fraction in [0.05_f64, 0.2] {
        let peaks = momentum_peaks(&control(&format!("local_damping = {fraction}")), 100, 7);
        let exact = ((1.0 - fraction) / (1.0 + fraction)).powf(0.5 * 6.0);
        let found = peaks[6] / peaks[0];
        assert!(
            (found.ln() / exact.ln() - 1.0).abs() < 0.02,
            "{fraction}: {found} {exact}"
        );
    }
    // Dashpots in proportion to the springs damp the mode by a part of its critical damping: half the angle that it turns in the time that a
    // wave takes through a slice, times the ratio.
    let (slices, ratio) = (50, 1.0);
    let peaks = momentum_peaks(&control("damping_ratio = 1.0"), slices, 7);
    let part = 0.5 * ratio * PI / slices as f64;
    let exact = (-6.0 * PI * part).exp();
    let found = peaks[6] / peaks[0];
    assert!(
        (found.ln() / exact.ln() - 1.0).abs() < 0.02,
        "{found} {exact}"
    );
}

/// In the seed paper's case the peak contact force of fine meshes is that of the plane impact, before the edges are felt.
#[test]
fn the_peak_contact_force_converges_to_that_of_a_plane_impact() {
    let peak = |elements: u32| {
        let text = format!(
            "[projectile]\nmaterial = 'copper-woodward'\nlength = '12.74 mm'\ndiameter = '4.8 mm'\nimpact_velocity = '230 m/s'\n\
             [target]\nmaterial = 'aluminium-2024-t351-woodward'\nthickness = '25 mm'\n\
             [chain]\nend_time = '0.4 us'\nprojectile_elements = {elements}"
        );
        let result = run(&case::load_str("the paper's case", &text).unwrap());
        let plane = result.details.iter().find(|d| d.name == PLANE_IMPACT);
        let plane = plane.unwrap().value * 1e3;
        assert!((plane / 43.1e3 - 1.0).abs() < 5e-3, "{plane}");
        result.peak_force.unwrap()
    };
    // By hand, with flow stresses of 300 and 533 MPa at the 2 % of strain behind the waves: offsets of 110 MPa in the copper and 196 MPa in
    // the aluminium, bulk impedances of 31.8 and 13.8 MPa s/m.
    let exact = 43.1e3;
    let peaks = [40, 80, 160, 320].map(peak);
    let limit = 2.0 * peaks[3] - peaks[2];
    assert!((limit / exact - 1.0).abs() < 0.03, "{limit} {exact}");
    assert!(peaks.is_sorted(), "{peaks:?}");
    // What is said of the default mesh.
    assert!(
        (0.92..0.94).contains(&(peaks[0] / exact)),
        "{}",
        peaks[0] / exact
    );
}

#[test]
fn an_impact_begins_in_uniaxial_strain() {
    // Before a wave from the side arrives, the end of a rod that is stopped is under ρ c_p V.
    let mut rod = elastic_rod(800);
    let speed = 1.0;
    rod.nodes.change(|_, node| node.velocity = speed);
    let mut tip = rod.tip().unwrap();
    tip.velocity = 0.0;
    rod.nodes.set_last(tip);
    let wave_speed = ((rod.metal.bulk_modulus + rod.metal.shear_modulus / 0.75) / 7850.0).sqrt();
    let step = 0.2 * rod.stable_step(1.0);
    let mut stresses = Vec::new();
    let until = 0.15 * RADIUS / wave_speed;
    for i in 0..(until / step) as usize {
        rod.collect();
        rod.kick(step);
        rod.drift(step).unwrap();
        if i as f64 * step > 0.3 * until {
            stresses.push(rod.slices.last().unwrap().axial_stress());
        }
    }
    let mean = stresses.iter().sum::<f64>() / stresses.len() as f64;
    let exact = 7850.0 * wave_speed * speed;
    assert!((mean / exact - 1.0).abs() < 0.02, "{mean} {exact}");
}

#[test]
fn a_slow_rod_only_dents_the_target_elastically() {
    let result = run(&scenario("s-7-tool-steel", "4340", 25.0, 5.0, ""));
    assert_eq!(result.permanent_depth, Some(0.0));
    assert!(result.depth_of_penetration.unwrap() > 0.0);
    assert_eq!(result.outcome, Outcome::Rebounded);
    assert!(
        result.warnings.iter().any(|w| w.contains("stays elastic")),
        "{:?}",
        result.warnings
    );
}

#[test]
fn a_rigid_rod_is_stopped_by_the_resistance_alone() {
    // Nothing of the rod flows, its waves are faint, and the ground is stiff against the resistance: (M + m_a) dv/dt = −A [p(δ) + ½σ(δ) + ½ρv²].
    let (speed, length) = (50.0, 50e-3);
    let text = "[projectile]\nmaterial = \"rigid\"\nlength = \"50 mm\"\ndiameter = \"5 mm\"\nimpact_velocity = \"50 m/s\"\n\
                [target]\nmaterial = \"soft\"\nthickness = \"semi-infinite\"\n\
                [chain]\ntarget_resistance = \"expanding-cavity\"\nprojectile_elements = 100\n\
                [materials.rigid]\nname = \"rigid\"\ndensity = \"7850 kg/m3\"\nyoungs_modulus = \"1500 GPa\"\npoissons_ratio = 0.3\n\
                strength.perfectly_plastic = { flow_stress = \"20 GPa\" }\n\
                [materials.soft]\nname = \"soft\"\ndensity = \"2700 kg/m3\"\nyoungs_modulus = \"70 GPa\"\npoissons_ratio = 0.33\n\
                strength.perfectly_plastic = { flow_stress = \"20 MPa\" }\n";
    let scenario = case::load_str("impact", text).unwrap();
    let result = run(&scenario);
    let struck = &super::struck(&scenario).unwrap().material;
    let resistance =
        Resistance::new(struck, struck.room_temperature.si(), RADIUS, 0.0, 0.0, None).unwrap();
    let area = PI * RADIUS * RADIUS;
    let mass = 7850.0 * area * length + 4.0 / 3.0 * 2700.0 * RADIUS.powi(3);
    // The added mass is set in motion by the rod when they meet.
    let mut velocity = speed * 7850.0 * area * length / mass;
    let (mut depth, step) = (0.0, 1e-9);
    while velocity > 0.0 {
        let drag = 0.5 * 2700.0 * velocity * velocity;
        let Pressures { cavity, flat_face } = resistance.at(depth);
        velocity -= area * (cavity + flat_face + drag) / mass * step;
        depth += velocity * step;
    }
    let found = result.permanent_depth.unwrap();
    assert!((found / depth - 1.0).abs() < 0.01, "{found} {depth}");
}

/// A perfectly plastic steel rod of a flow stress [MPa], 5 mm in diameter, on aluminium of 400 MPa.
fn plastic_rod(flow_stress: u32, length: u32, speed: u32, elements: u32) -> Scenario {
    let text = format!(
        "[projectile]\nmaterial = \"rod\"\nlength = \"{length} mm\"\ndiameter = \"5 mm\"\nimpact_velocity = \"{speed} m/s\"\n\
         [target]\nmaterial = \"block\"\nthickness = \"semi-infinite\"\n\
         [chain]\ntarget_resistance = \"expanding-cavity\"\nprojectile_elements = {elements}\n\
         [materials.rod]\nname = \"rod\"\ndensity = \"7830 kg/m3\"\nyoungs_modulus = \"200 GPa\"\npoissons_ratio = 0.29\n\
         strength.perfectly_plastic = {{ flow_stress = \"{flow_stress} MPa\" }}\n\
         [materials.block]\nname = \"block\"\ndensity = \"2700 kg/m3\"\nyoungs_modulus = \"70 GPa\"\npoissons_ratio = 0.33\n\
         strength.perfectly_plastic = {{ flow_stress = \"400 MPa\" }}\n"
    );
    case::load_str("impact", &text).unwrap()
}

#[test]
fn a_rigid_rod_goes_as_deep_as_in_the_axisymmetric_model() {
    // Depths of `axi` on 8 and 16 cells per radius [mm]; their error falls with the cell size, and the limit is twice the second less
    // the first.
    for (speed, coarse, fine) in [(300, 3.1597, 3.2469), (600, 9.913, 10.443)] {
        let found = run(&plastic_rod(20_000, 15, speed, 40));
        let depth = found.depth_of_penetration.unwrap() * 1e3;
        let limit = 2.0 * fine - coarse;
        assert!((depth / limit - 1.0).abs() < 0.025, "{depth} {limit}");
    }
}

#[test]
fn a_fast_weak_rod_erodes_by_the_equation_of_alekseevskii_and_tate() {
    let impact = plastic_rod(500, 100, 2000, 400);
    let depth = run(&impact).depth_of_penetration.unwrap();
    let tate = model::model("tate").unwrap();
    let expected = model::run(tate, &impact, &mut Control::default()).unwrap();
    let expected = expected.depth_of_penetration.unwrap();
    assert!((depth / expected - 1.0).abs() < 0.05, "{depth} {expected}");
}

#[test]
fn the_balances_close_and_the_depth_grows_with_speed() {
    for (projectile, target) in [
        ("copper-woodward", "aluminium-2024-t351-woodward"),
        ("4340-johnson-cook", "6061-t6-lesuer"),
        ("tungsten-alloy-steinberg", "4340-johnson-cook"),
    ] {
        let mut deepest = 0.0;
        for speed in [50.0, 150.0, 400.0, 900.0, 1500.0] {
            let result = run(&scenario(projectile, target, 15.0, speed, ""));
            let numerics = result.numerics.as_ref().unwrap();
            assert!(numerics.energy_residual < 1e-3, "{projectile} {speed}");
            assert!(numerics.momentum_residual < 1e-12, "{projectile} {speed}");
            let depth = result.depth_of_penetration.unwrap();
            assert!(depth >= deepest, "{projectile} {speed}: {depth} {deepest}");
            deepest = depth;
        }
    }
}

#[test]
fn the_depth_converges_with_the_mesh() {
    let depth = |elements: u32, courant: f64| {
        let options = format!("projectile_elements = {elements}\ncourant = {courant}\n");
        let impact = scenario(
            "4340-johnson-cook",
            "weldox-460-e-borvik",
            15.0,
            300.0,
            &options,
        );
        run(&impact).depth_of_penetration.unwrap()
    };
    let (coarse, medium, fine) = (depth(20, 0.3), depth(40, 0.3), depth(80, 0.3));
    assert!(
        (medium / fine - 1.0).abs() < 0.03,
        "{coarse} {medium} {fine}"
    );
    assert!(
        (coarse / fine - 1.0).abs() < 0.06,
        "{coarse} {medium} {fine}"
    );
    // Halving the step changes next to nothing.
    assert!((depth(40, 0.15) / medium - 1.0).abs() < 0.01);
}

/// The pressure of the cavity, as a law of the caller's own.
struct Same {
    cavity: Resistance,
    density: f64,
}

impl ResistanceLaw for Same {
    fn pressure(&self, depth: f64, speed: f64) -> f64 {
        let Pressures { cavity, flat_face } = self.cavity.at(depth);
        cavity + flat_face + 0.5 * self.density * speed * speed
    }
}

#[test]
fn a_law_of_the_callers_own_takes_the_place_of_the_cavity() {
    // Nothing of the rod flows: the law is all that resists, but for the waves in the rod.
    let mut impact = plastic_rod(20_000, 15, 400, 40);
    let cavity = run(&impact).depth_of_penetration.unwrap();
    let struck = super::struck(&impact).unwrap().material.clone();
    let own = Same {
        cavity: Resistance::new(
            &struck,
            struck.room_temperature.si(),
            RADIUS,
            400.0 / (2.0 * RADIUS),
            0.9,
            None,
        )
        .unwrap(),
        density: struck.density.si(),
    };
    impact.resistance = Some(CustomResistance(Arc::new(own)));
    let result = run(&impact);
    let depth = result.depth_of_penetration.unwrap();
    assert!((depth / cavity - 1.0).abs() < 2e-3, "{depth} {cavity}");
    assert!(result.warnings[0].contains("resistance law"));
    // A plane impact is one on the target's own metal.
    assert!(result.details.iter().all(|d| d.name != PLANE_IMPACT));
    assert!(result.numerics().energy_residual < 1e-2);
}

#[test]
fn a_rigid_rod_against_a_constant_pressure_stops_where_its_energy_is_used_up() {
    struct Constant;
    impl ResistanceLaw for Constant {
        fn pressure(&self, _: f64, _: f64) -> f64 {
            300e6
        }
    }
    let text = "[projectile]\nmaterial = \"rigid\"\nlength = \"50 mm\"\ndiameter = \"5 mm\"\nimpact_velocity = \"150 m/s\"\n\
                [target]\nmaterial = \"light\"\nthickness = \"semi-infinite\"\n\
                [chain]\ntarget_resistance = \"expanding-cavity\"\nprojectile_elements = 100\n\
                [materials.rigid]\nname = \"rigid\"\ndensity = \"7850 kg/m3\"\nyoungs_modulus = \"1500 GPa\"\npoissons_ratio = 0.3\n\
                strength.perfectly_plastic = { flow_stress = \"20 GPa\" }\n\
                [materials.light]\nname = \"light\"\ndensity = \"2000 kg/m3\"\nyoungs_modulus = \"700 GPa\"\npoissons_ratio = 0.33\n\
                strength.elastic = {}\n";
    let mut impact = case::load_str("impact", text).unwrap();
    // An elastic target has no pressure of its own.
    assert!(super::not_applicable(&impact).is_some());
    impact.resistance = Some(CustomResistance(Arc::new(Constant)));
    assert!(super::not_applicable(&impact).is_none());
    let area = PI * RADIUS * RADIUS;
    let (mass, added) = (7850.0 * area * 50e-3, 4.0 / 3.0 * 2000.0 * RADIUS.powi(3));
    // The added mass of the target is set in motion by the rod when they meet, and slows down with it.
    let expected = 0.5 * mass * mass / (mass + added) * 150.0 * 150.0 / (300e6 * area);
    let found = run(&impact).depth_of_penetration.unwrap();
    assert!((found / expected - 1.0).abs() < 0.01, "{found} {expected}");
}

#[test]
fn where_nothing_takes_a_law_of_resistance_it_is_refused() {
    let mut impact = scenario("4340-johnson-cook", "weldox-460-e-borvik", 50.0, 400.0, "");
    let refused = |impact: &Scenario, name: &str| {
        let model = model::model(name).unwrap();
        match model::run(model, impact, &mut Control::default()) {
            Err(error @ crate::Error::NotApplicable { .. }) => error.to_string(),
            other => panic!("{name}: {other:?}"),
        }
    };
    struct Never;
    impl ResistanceLaw for Never {
        fn pressure(&self, _: f64, _: f64) -> f64 {
            unreachable!("no model asks it")
        }
    }
    impact.resistance = Some(CustomResistance(Arc::new(Never)));
    for name in ["fdm", "tate", "axi"] {
        assert!(refused(&impact, name).contains("use the model `chain`"));
    }
    impact.options.chain.target_resistance = Some(TargetResistanceModel::Column);
    assert!(refused(&impact, "chain").contains("expanding-cavity"));
}
