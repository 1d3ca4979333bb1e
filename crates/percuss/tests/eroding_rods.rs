//! Ladder 5: long eroding rods by the chain against Alekseevskii and Tate with the same strengths.

use std::{f64::consts::PI, fmt};

use crate::common::{plastic_metal, run, run_recorded, scenario};
use percuss::{
    analytic::{Rods, Tate},
    case,
    history::Sample,
    model::{Control, Model},
    outcome::RunResult,
};

const DIAMETER_MM: f64 = 10.0;
const FLOW_STRESS_MPA: f64 = 800.0;
const YOUNGS_MODULUS_GPA: f64 = 200.0;
const STEEL: f64 = 7850.0;
const TUNGSTEN: f64 = 17600.0;
const LIGHT: f64 = 2700.0;
/// Rod that Tate's shot has eroded at the start and at the end of the measurement, in diameters.
const WINDOW: (f64, f64) = (2.0, 6.0);
/// Promised tolerance.
const TOLERANCE: f64 = 0.05;
/// Thickness of the target, in diameters of the rod; the held target does not feel it.
const TARGET: u32 = 20;

/// A rod of one density on another, both perfectly plastic with one flow stress.
#[derive(Clone, Copy)]
struct Shot {
    densities: (f64, f64),
    constraint: f64,
    speed: f64,
    length_to_diameter: u32,
}

impl fmt::Display for Shot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (rod, target) = self.densities;
        let Shot {
            constraint,
            speed,
            length_to_diameter,
            ..
        } = self;
        write!(
            f,
            "{rod} on {target} kg/m3, R/Y {constraint}, {speed} m/s, L/D {length_to_diameter}"
        )
    }
}

impl Shot {
    fn with_length(self, length_to_diameter: u32) -> Self {
        Self {
            length_to_diameter,
            ..self
        }
    }

    fn length(self) -> f64 {
        f64::from(self.length_to_diameter) * DIAMETER_MM * 1e-3
    }

    /// Elements are a twentieth of a diameter long.
    fn case(self, options: &str) -> String {
        let elements = 20 * self.length_to_diameter;
        let metal = |id, density| plastic_metal(id, density, YOUNGS_MODULUS_GPA, FLOW_STRESS_MPA);
        format!(
            r#"
            projectile = {{ material = "rod", length = "{} mm", diameter = "{DIAMETER_MM} mm", impact_velocity = "{} m/s" }}
            target = {{ material = "target", thickness = "{} mm", back_face = "non-reflecting" }}
            [chain]
            constraint_factor = {}
            projectile_elements = {elements}
            target_elements = {}
            {options}
            {}{}
            "#,
            self.length() * 1e3,
            self.speed,
            f64::from(TARGET) * DIAMETER_MM,
            self.constraint,
            20 * TARGET,
            metal("rod", self.densities.0),
            metal("target", self.densities.1),
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

    /// Change of the tip's speed as a part of it when the elastic wave of the strength `Y` comes back to the tip: the rod is slower
    /// by `2Y/(ρ c)`.
    fn wave_step(self) -> f64 {
        let rods = self.rods();
        let wave_speed = (YOUNGS_MODULUS_GPA * 1e9 / self.densities.0).sqrt();
        let step = 2.0 * rods.projectile_strength / (self.densities.0 * wave_speed);
        let speed = rods.penetration_speed(self.speed);
        let slope = (speed - rods.penetration_speed(0.999 * self.speed)) / (1e-3 * self.speed);
        slope * step / speed
    }

    /// Time [s] and depth [m] by Tate when a length [diameters] of the rod has eroded.
    fn tate_at(self, eroded: f64) -> (f64, f64) {
        let rods = self.rods();
        let (mut speed, mut length, mut depth, mut time) = (self.speed, self.length(), 0.0, 0.0);
        let left = length - eroded * DIAMETER_MM * 1e-3;
        let step = 1e-4 * length / speed;
        while length > left {
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
        (time, depth)
    }

    /// Mean speed of the tip, and depth per length of rod that is used up, in the window; both over Tate's.
    fn ratios(self, result: &RunResult, used_up: impl Fn(&Sample) -> f64) -> (f64, f64) {
        let samples = &result.history.as_ref().unwrap().samples;
        let at = |time: f64, value: &dyn Fn(&Sample) -> f64| {
            let after = samples.iter().position(|s| s.time >= time).unwrap();
            let (a, b) = (&samples[after - 1], &samples[after]);
            value(a) + (value(b) - value(a)) * (time - a.time) / (b.time - a.time)
        };
        let (from, depth_from) = self.tate_at(WINDOW.0);
        let (to, depth_to) = self.tate_at(WINDOW.1);
        let depth = at(to, &|s| s.depth) - at(from, &|s| s.depth);
        let length = at(to, &used_up) - at(from, &used_up);
        let by_tate = depth_to - depth_from;
        let per_length = by_tate / ((WINDOW.1 - WINDOW.0) * DIAMETER_MM * 1e-3);
        (depth / by_tate, depth / length / per_length)
    }

    /// The case up to the end of the window.
    fn case_of_window(self, options: &str) -> String {
        let end = 1.01e6 * self.tate_at(WINDOW.1).0;
        self.case(&format!("{options}\nend_time = \"{end} us\""))
    }

    /// Ratios with the resistance: every length of rod that it uses up has taken the work of the flow stress over that length,
    /// which leaves out what the rod shortens elastically.
    fn closure_ratios(self, case: &str) -> (f64, f64) {
        let radius = 0.5 * DIAMETER_MM * 1e-3;
        let force = self.rods().projectile_strength * PI * radius * radius;
        self.ratios(&run_recorded(case), |s| s.energy.plastic_projectile / force)
    }
}

const CLOSURE: &str = "erosion_criterion = \"tate\"";
/// The same mesh as by default, without the border shear that Tate has no counterpart of.
const DEFAULT: &str = "border_shear = 0.0";

fn runs() -> Vec<Shot> {
    let mut runs = Vec::new();
    for densities in [(STEEL, STEEL), (TUNGSTEN, STEEL), (LIGHT, STEEL)] {
        for constraint in [1.0, 4.0] {
            for speed in [1000.0, 1500.0, 2000.0, 2500.0, 3000.0] {
                let shot = Shot {
                    densities,
                    constraint,
                    speed,
                    length_to_diameter: 10,
                };
                if shot.rods().penetration_speed(speed) > 0.0 {
                    runs.push(shot);
                }
            }
        }
    }
    runs
}

/// Over one length of erosion Tate's tip slows the less the longer the rod is: the steady limit is L/D → ∞.
///
/// Tate's rod is rigid. As long as no wave has come back to the tip, an elastic rod is slower there by `Y/(ρ c)`, which is half
/// of [`Shot::wave_step`] whatever its length: where this half alone is above the tolerance, it bounds the difference.
#[test]
fn the_closure_meets_tate_in_the_limit_of_long_rods() {
    let mut in_the_limit = Vec::new();
    for length_to_diameter in [10, 20, 40] {
        // Largest differences of U and P/L: all that the limit holds for; steps within the tolerance; steps above it.
        let [mut all, mut small, mut large] = [[0.0_f64; 2]; 3];
        for shot in runs() {
            let shot = shot.with_length(length_to_diameter);
            let (speed, depth) = shot.closure_ratios(&shot.case_of_window(CLOSURE));
            let step = shot.wave_step();
            println!("{shot}: wave step {step:.4}, U {speed:.3}, P/L {depth:.3} of Tate's");
            let difference = [(speed - 1.0).abs(), (depth - 1.0).abs()];
            let enter = |largest: &mut [f64; 2]| {
                *largest = [0, 1].map(|i| largest[i].max(difference[i]));
            };
            enter(if step <= TOLERANCE {
                &mut small
            } else {
                &mut large
            });
            if 0.5 * step <= TOLERANCE {
                enter(&mut all);
            } else if length_to_diameter == 40 {
                assert!(
                    difference.iter().all(|part| *part < 0.5 * step),
                    "{difference:?}"
                );
            }
        }
        println!(
            "L/D {length_to_diameter}: largest differences of U and P/L {all:.4?}; step small {small:.4?}, large {large:.4?}"
        );
        // What a user can tell from the step beforehand; at L/D 10 P/L has more to come from the tip's inertia.
        let depth_tolerance = if length_to_diameter == 10 {
            0.06
        } else {
            TOLERANCE
        };
        assert!(
            small[0] < TOLERANCE && small[1] < depth_tolerance,
            "{small:?}"
        );
        in_the_limit.push(all);
    }
    assert!(
        in_the_limit[2].iter().all(|part| *part < TOLERANCE),
        "{in_the_limit:?}"
    );
    for (shorter, longer) in in_the_limit.iter().zip(&in_the_limit[1..]) {
        assert!(
            longer[0] < shorter[0] && longer[1] < shorter[1],
            "{in_the_limit:?}"
        );
    }
}

/// A cycle of the tip has no part of first order in the length of an element: the mesh does not show.
#[test]
fn the_speed_of_the_closures_tip_does_not_depend_on_the_mesh() {
    let shot = Shot {
        densities: (TUNGSTEN, STEEL),
        constraint: 4.0,
        speed: 1000.0,
        length_to_diameter: 20,
    };
    let text = shot.case_of_window(CLOSURE);
    let [coarse, fine] = [10, 40].map(|elements| {
        let meshed = text
            .replace(
                "projectile_elements = 400",
                &format!("projectile_elements = {}", 20 * elements),
            )
            .replace(
                "target_elements = 400",
                &format!("target_elements = {}", TARGET * elements),
            );
        shot.closure_ratios(&meshed).0
    });
    println!("U {coarse:.4} with 10 elements a diameter, {fine:.4} with 40");
    assert!((coarse - fine).abs() < 0.01, "{coarse} {fine}");
}

#[test]
fn the_closures_whole_depth_is_near_tate() {
    for shot in runs() {
        // Near the threshold the entry, of the order of a diameter, is all there is.
        if shot.rods().penetration_speed(shot.speed) < 0.2 * shot.speed {
            continue;
        }
        let by_tate = shot.rods().penetrate(shot.speed, shot.length()).unwrap();
        let whole = run(&shot.case(CLOSURE)).depth_of_penetration.unwrap() / by_tate.depth;
        println!("{shot}: whole P {whole:.3} of Tate's");
        assert!((whole - 1.0).abs() < 0.1, "{whole}");
    }
}

/// Without the resistance the chain is no more than near Tate: the ratios are reported, and bounded so that a change shows.
#[test]
fn the_chain_without_the_closure_is_near_tate() {
    for shot in runs() {
        // Nearer to the threshold the ratio says nothing: the tip stops before the window ends.
        if shot.rods().penetration_speed(shot.speed) < 0.2 * shot.speed {
            continue;
        }
        let result = run_recorded(&shot.case_of_window(DEFAULT));
        let (ratio, depth) = shot.ratios(&result, |s| shot.length() - s.projectile_length);
        println!("{shot}: default U {ratio:.3}, P/L {depth:.3} of Tate's");
        assert!((0.75..1.25).contains(&ratio), "{ratio}");
    }
}

#[test]
fn the_criterion_closes_its_balances_and_leaves_the_tips_mass_out_of_the_projectile() {
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
            error.contains("has no effect with the erosion criterion `tate`"),
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
