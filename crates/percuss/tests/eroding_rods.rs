//! Ladder 5: long eroding rods by the chain against Alekseevskii and Tate with the same strengths.

mod common;

use common::{run, run_recorded, scenario};
use percuss::{
    analytic::{Rods, Tate},
    case,
    history::Sample,
    model::{Control, Model},
    outcome::RunResult,
};

const DIAMETER_MM: f64 = 10.0;
const FLOW_STRESS_MPA: f64 = 800.0;
const STEEL: f64 = 7850.0;
const TUNGSTEN: f64 = 17600.0;
const LIGHT: f64 = 2700.0;

/// A rod of one density on another, both perfectly plastic with one flow stress.
#[derive(Clone, Copy)]
struct Shot {
    densities: (f64, f64),
    constraint: f64,
    speed: f64,
    length_to_diameter: u32,
}

impl Shot {
    fn length(self) -> f64 {
        f64::from(self.length_to_diameter) * DIAMETER_MM * 1e-3
    }

    /// Elements are a twentieth of a diameter long.
    fn case(self, options: &str) -> String {
        let elements = 20 * self.length_to_diameter;
        format!(
            r#"
            projectile = {{ material = "rod", length = "{} mm", diameter = "{DIAMETER_MM} mm", velocity = "{} m/s" }}
            target = {{ material = "target", thickness = "{} mm", back_face = "non-reflecting" }}
            [chain]
            constraint_factor = {}
            projectile_elements = {elements}
            target_elements = {}
            {options}
            [materials.rod]
            name = "rod"
            density = "{} kg/m3"
            youngs_modulus = "200 GPa"
            poissons_ratio = 0.3
            strength.perfectly_plastic = {{ flow_stress = "{FLOW_STRESS_MPA} MPa" }}
            [materials.target]
            name = "target"
            density = "{} kg/m3"
            youngs_modulus = "200 GPa"
            poissons_ratio = 0.3
            strength.perfectly_plastic = {{ flow_stress = "{FLOW_STRESS_MPA} MPa" }}
            "#,
            self.length() * 1e3,
            self.speed,
            2.0 * self.length() * 1e3,
            self.constraint,
            2 * elements,
            self.densities.0,
            self.densities.1,
        )
    }

    fn rods(self) -> Rods {
        Rods {
            projectile_density: self.densities.0,
            target_density: self.densities.1,
            projectile_strength: FLOW_STRESS_MPA * 1e6,
            target_resistance: self.constraint * FLOW_STRESS_MPA * 1e6,
        }
    }

    /// Time [s], depth [m] and tip speed [m/s] by Tate when the rod has a part of its length left.
    fn tate_at(self, part_left: f64) -> (f64, f64, f64) {
        let rods = self.rods();
        let (mut speed, mut length, mut depth, mut time) = (self.speed, self.length(), 0.0, 0.0);
        let step = 1e-4 * length / speed;
        while length > part_left * self.length() {
            // The midpoint rule is exact to the step squared: far below the differences that are measured.
            let slowing =
                |length: f64| rods.projectile_strength / (rods.projectile_density * length);
            let half = speed - 0.5 * step * slowing(length);
            let middle = length - 0.5 * step * rods.erosion_speed(speed);
            depth += step * rods.penetration_speed(half);
            length -= step * rods.erosion_speed(half);
            speed -= step * slowing(middle);
            time += step;
        }
        (time, depth, rods.penetration_speed(speed))
    }

    /// Mean speed of the tip, and depth per length of rod, between the times at which Tate's rod has 80 % and 40 % of its length
    /// left; both over Tate's.
    fn steady_ratios(self, result: &RunResult) -> (f64, f64) {
        let samples = &result.history.as_ref().unwrap().samples;
        let at = |time: f64, value: fn(&Sample) -> f64| {
            let after = samples.iter().position(|s| s.time >= time).unwrap();
            let (a, b) = (&samples[after - 1], &samples[after]);
            value(a) + (value(b) - value(a)) * (time - a.time) / (b.time - a.time)
        };
        let ((from, depth_from, _), (to, depth_to, _)) = (self.tate_at(0.8), self.tate_at(0.4));
        let depth = at(to, |s| s.depth) - at(from, |s| s.depth);
        let length = at(from, |s| s.projectile_length) - at(to, |s| s.projectile_length);
        let by_tate = depth_to - depth_from;
        (
            depth / by_tate,
            depth / length / (by_tate / (0.4 * self.length())),
        )
    }
}

const CLOSURE: &str = "erosion_closure = \"tate\"";
/// The same mesh as by default, without the border shear that Tate has no counterpart of.
const DEFAULT: &str = "border_shear = 0.0";

fn shots() -> Vec<Shot> {
    let mut shots = Vec::new();
    for densities in [(STEEL, STEEL), (TUNGSTEN, STEEL), (LIGHT, STEEL)] {
        for constraint in [1.0, 4.0] {
            for speed in [1000.0, 1500.0, 2000.0, 2500.0, 3000.0] {
                let shot = Shot {
                    densities,
                    constraint,
                    speed,
                    length_to_diameter: 10,
                };
                // Near the threshold the flow is nowhere steady.
                if shot.rods().penetration_speed(speed) > 0.2 * speed {
                    shots.push(shot);
                }
            }
        }
    }
    shots
}

#[test]
fn the_closure_of_tate_meets_tate_in_the_steady_limit() {
    // Largest differences of U and P/L where Tate's tip is steady, and where it slows by more than 10 % meanwhile.
    let mut worst = [[0.0_f64; 2]; 2];
    for shot in shots() {
        let result = run_recorded(&shot.case(CLOSURE));
        let (speed, depth) = shot.steady_ratios(&result);
        let by_tate = shot.rods().penetrate(shot.speed, shot.length()).unwrap();
        let whole = result.depth_of_penetration.unwrap() / by_tate.depth;
        let kept = shot.tate_at(0.4).2 / shot.rods().penetration_speed(shot.speed);
        println!(
            "{:?} kg/m3, R/Y {}, {} m/s: U {speed:.3}, P/L {depth:.3} ({:.0} % of its speed kept); whole P {whole:.3} of Tate's",
            shot.densities,
            shot.constraint,
            shot.speed,
            100.0 * kept,
        );
        let worst = &mut worst[usize::from(kept < 0.9)];
        worst[0] = worst[0].max((speed - 1.0).abs());
        worst[1] = worst[1].max((depth - 1.0).abs());
        assert!((whole - 1.0).abs() < 0.1, "{whole}");
    }
    println!(
        "largest differences of U and P/L: steady {:.4?}, slowing {:.4?}",
        worst[0], worst[1]
    );
    assert!(worst[0].iter().all(|worst| *worst < 0.05), "{worst:?}");
    assert!(worst[1].iter().all(|worst| *worst < 0.25), "{worst:?}");
}

/// Without the closure the chain is no more than near Tate: the ratios are reported, and bounded so that a change shows.
#[test]
fn the_chain_without_the_closure_is_near_tate() {
    for shot in shots() {
        let result = run_recorded(&shot.case(DEFAULT));
        let (ratio, depth) = shot.steady_ratios(&result);
        println!(
            "{:?} kg/m3, R/Y {}, {} m/s: U {ratio:.3}, P/L {depth:.3} of Tate's",
            shot.densities, shot.constraint, shot.speed
        );
        assert!((0.75..1.25).contains(&ratio), "{ratio}");
    }
}

#[test]
fn the_closure_balances_its_books_and_leaves_the_tips_mass_out_of_the_projectile() {
    for densities in [(STEEL, STEEL), (TUNGSTEN, STEEL), (LIGHT, STEEL)] {
        let shot = Shot {
            densities,
            constraint: 4.0,
            speed: 1200.0,
            length_to_diameter: 10,
        };
        let result = run(&shot.case(CLOSURE));
        let numerics = result.numerics();
        assert!(numerics.energy_residual < 1e-3 && numerics.momentum_residual < 1e-9);
        let scenario = scenario(&shot.case(CLOSURE));
        let left = result.projectile_final_mass.unwrap();
        let elements = 200 - numerics.eroded_elements.0;
        let expected = scenario.projectile.mass * elements as f64 / 200.0;
        assert!(
            (left - expected).abs() < 1e-9 * scenario.projectile.mass,
            "{left} {expected}"
        );
    }
}

#[test]
fn the_closure_refuses_keys_that_it_would_ignore() {
    let shot = Shot {
        densities: (TUNGSTEN, STEEL),
        constraint: 4.0,
        speed: 1500.0,
        length_to_diameter: 10,
    };
    for key in [
        "kinematics = \"logarithmic\"",
        "erosion_strain = 1.5",
        "border_shear = 0.0",
    ] {
        let text = shot.case(&format!("{CLOSURE}\n{key}"));
        let error = case::load_str("test", &text).unwrap_err().to_string();
        assert!(
            error.contains("has no effect with the erosion closure `tate`"),
            "{error}"
        );
    }
}

/// Both models take a case as it is: with one constant flow stress the strengths of Tate are those of the chain.
#[test]
fn tate_reads_the_same_strengths_from_the_case() {
    let shot = Shot {
        densities: (TUNGSTEN, STEEL),
        constraint: 4.0,
        speed: 1500.0,
        length_to_diameter: 20,
    };
    let text = shot.case(CLOSURE).replace(
        "[materials.rod]",
        "[tate]\ntarget_resistance = \"3200 MPa\"\n[materials.rod]",
    );
    let result = Tate.run(&scenario(&text), &mut Control::default()).unwrap();
    let exact = shot.rods().penetrate(1500.0, 0.2).unwrap();
    assert!((result.depth_of_penetration.unwrap() / exact.depth - 1.0).abs() < 1e-12);
}
