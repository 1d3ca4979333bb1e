//! Ladder 1: bodies that part in tension, against exact solutions of elastic bars.

use crate::common::{assert_near, mean, run_recorded};
use percuss::{fragments::Fragment, outcome::RunResult};

/// A flyer (length, modulus, density) at a speed on a free plate; all elastic, in small strain.
struct Plates {
    flyer_mm: f64,
    plate_mm: f64,
    /// Young's modulus [GPa] and density [kg/m3].
    flyer: (f64, f64),
    plate: (f64, f64),
    velocity: f64,
    /// Elements of the plate; those of the flyer have the same transit time.
    elements: u32,
    options: String,
}

impl Plates {
    fn wave_speed((modulus, density): (f64, f64)) -> f64 {
        (modulus * 1e9 / density).sqrt()
    }

    fn impedance((modulus, density): (f64, f64)) -> f64 {
        (modulus * 1e9 * density).sqrt()
    }

    /// Speed and stress that the impact gives to the interface.
    fn impact(&self) -> (f64, f64) {
        let (flyer, plate) = (Self::impedance(self.flyer), Self::impedance(self.plate));
        let speed = flyer * self.velocity / (flyer + plate);
        (speed, plate * speed)
    }

    /// Thickness that the releases of both free faces cut off the plate, and when they meet.
    fn scab(&self) -> (f64, f64) {
        let through = self.flyer_mm * 1e-3 / Self::wave_speed(self.flyer);
        let speed = Self::wave_speed(self.plate);
        (speed * through, self.plate_mm * 1e-3 / speed + through)
    }

    fn run(&self) -> RunResult {
        let transit = self.flyer_mm
            / Self::wave_speed(self.flyer)
            / (self.plate_mm / Self::wave_speed(self.plate));
        let flyer_elements = (f64::from(self.elements) * transit).round();
        run_recorded(&format!(
            r#"
            projectile = {{ material = "flyer", length = "{} mm", diameter = "20 mm", impact_velocity = "{} m/s" }}
            target = {{ material = "plate", thickness = "{} mm", back_face = "free" }}
            [chain]
            projectile_elements = {flyer_elements}
            target_elements = {}
            border_shear = 0.0
            kinematics = "small-strain"
            {}
            [materials.flyer]
            name = "flyer"
            density = "{} kg/m3"
            youngs_modulus = "{} GPa"
            poissons_ratio = 0.3
            strength.elastic = {{}}
            [materials.plate]
            name = "plate"
            density = "{} kg/m3"
            youngs_modulus = "{} GPa"
            poissons_ratio = 0.3
            strength.elastic = {{}}
            "#,
            self.flyer_mm,
            self.velocity,
            self.plate_mm,
            self.elements,
            self.options,
            self.flyer.1,
            self.flyer.0,
            self.plate.1,
            self.plate.0,
        ))
    }
}

const STEEL: (f64, f64) = (200.0, 8000.0);
const LIGHT: (f64, f64) = (70.0, 2800.0);

fn plates(flyer: (f64, f64), elements: u32, options: &str) -> Plates {
    Plates {
        flyer_mm: 2.0,
        plate_mm: 6.0,
        flyer,
        plate: STEEL,
        velocity: 40.0,
        elements,
        options: options.to_owned(),
    }
}

/// Plates that spall at a fraction of the stress of the impact.
fn spalling(flyer: (f64, f64), elements: u32, fraction: f64) -> Plates {
    let mut plates = plates(flyer, elements, "");
    let strength = fraction * plates.impact().1 / 1e6;
    plates.options = format!("failure = {{ spall = {{ strength = \"{strength} MPa\" }} }}");
    plates
}

fn detail(result: &RunResult, name: &str) -> f64 {
    let found = result.details.iter().find(|detail| detail.name == name);
    found
        .unwrap_or_else(|| panic!("no `{name}` in {:?}", result.details))
        .value
}

fn first_parting(result: &RunResult) -> (f64, f64) {
    (
        detail(result, "first crack, initial position") * 1e-3,
        detail(result, "first crack, time") * 1e-6,
    )
}

/// The piece of the plate that carries most of the momentum.
fn scab(result: &RunResult) -> &Fragment {
    let momentum = |f: &&Fragment| f.mass * f.velocity;
    result
        .fragments
        .iter()
        .max_by(|a, b| momentum(a).total_cmp(&momentum(b)))
        .unwrap()
}

/// The releases of both free faces meet one pulse under the back. There the plate parts at once, and all the momentum of the flyer,
/// which is in the scab by then, flies off with it at twice the speed of the pulse.
#[test]
fn elastic_plates_spall_where_and_when_the_releases_meet() {
    for flyer in [STEEL, LIGHT] {
        let mut errors = Vec::new();
        for elements in [60, 120, 240, 480, 960] {
            let plates = spalling(flyer, elements, 2.0 / 3.0);
            let (thickness, meeting) = plates.scab();
            let result = plates.run();
            let (position, time) = first_parting(&result);
            let size = 6e-3 / f64::from(elements);
            let off = (position - (6e-3 - thickness)).abs();
            println!(
                "{elements}: plane off by {:.2} elements, time by {:+.3} %",
                off / size,
                100.0 * (time / meeting - 1.0)
            );
            assert!(off <= 4.0 * size, "{off}");
            assert!(
                (time - meeting).abs() <= 8.0 * size / Plates::wave_speed(STEEL),
                "{time} {meeting}"
            );
            let numerics = result.numerics();
            assert!(numerics.energy_residual < 1e-9 && numerics.momentum_residual < 1e-12);
            errors.push(1.0 - scab(&result).velocity / (2.0 * plates.impact().0));
            // What the mesh leaves between the two is a few elements on any mesh, and so less and less.
            let between = &result.fragments[2..result.fragments.len() - 1];
            let crumbs: f64 = between.iter().map(|f| f.length).sum();
            println!(
                "crumbs {:.1} elements, scab {:+.3} %",
                crumbs / size,
                -100.0 * errors[errors.len() - 1]
            );
            assert!(crumbs <= 10.1 * size, "{crumbs}");
        }
        assert!(errors[4].abs() < 5e-3, "{errors:?}");
        assert!(errors[4].abs() < 0.25 * errors[0].abs(), "{errors:?}");
    }
}

/// A law without a number anywhere is refused; a body without numbers is told of.
#[test]
fn bodies_that_cannot_part_are_named() {
    let shot = |spall: &str| {
        format!(
            "projectile = {{ material = \"4340\", length = \"5 mm\", diameter = \"8 mm\", impact_velocity = \"100 m/s\" }}\n\
             target = {{ material = \"own\", thickness = \"10 mm\", back_face = \"free\" }}\n[chain]\nfailure = {{ spall = {{}} }}\n\
             [materials.own]\nname = \"own\"\ndensity = \"7800 kg/m3\"\nyoungs_modulus = \"200 GPa\"\npoissons_ratio = 0.3\n{spall}\n\
             strength.elastic = {{}}"
        )
    };
    let chain = percuss::model::model("chain").unwrap();
    let reason =
        percuss::model::applicability(chain, &crate::common::scenario(&shot(""))).unwrap_err();
    let reason = reason.to_string();
    assert!(
        reason.contains("`chain.failure.spall`") && reason.contains("`spall_strength`"),
        "{reason}"
    );
    let result = run_recorded(&shot("spall_strength = \"2 GPa\""));
    let named = |id: &str| {
        result
            .warnings
            .iter()
            .any(|w| w.contains(id) && w.contains("does not part"))
    };
    assert!(named("4340") && !named("own"), "{:?}", result.warnings);
}

/// Gaps and bonds are the chain's alone.
#[test]
fn models_that_take_layers_as_one_body_refuse_gaps() {
    let scenario = crate::common::scenario(
        "projectile = { material = \"4340\", length = \"5 mm\", diameter = \"8 mm\", impact_velocity = \"100 m/s\" }\n\
         target = { layers = [{ material = \"4340\", thickness = \"5 mm\" }, { material = \"4340\", thickness = \"5 mm\", gap = \"1 mm\" }] }",
    );
    for model in percuss::model::MODELS {
        let takes = percuss::model::applicability(*model, &scenario).is_ok();
        assert_eq!(takes, model.name() == "chain", "{}", model.name());
    }
}

#[test]
fn a_free_surface_doubles_the_velocity() {
    let plates = plates(STEEL, 480, "end_time = \"2.4 us\"");
    let result = plates.run();
    // The pulse is at the back from 1.2 to 2.0 us.
    let speed = mean(&result, 1.3e-6, 1.9e-6, |s| s.back_velocity);
    assert_near(
        "free-surface velocity",
        speed,
        2.0 * plates.impact().0,
        1e-3,
    );
    assert_eq!(result.fragments.len(), 2);
}

#[test]
fn a_plate_that_is_stronger_than_the_pull_stays_whole() {
    let result = spalling(STEEL, 240, 1.6).run();
    assert_eq!(result.fragments.len(), 2);
    assert_eq!(result.numerics().energy.fracture, 0.0);
}

/// Twice the threshold pulls at the plane of spall from the meeting of the releases on, and parts it after the time of the law. Until
/// then it takes momentum from the scab.
#[test]
fn cumulative_damage_parts_the_plane_after_its_time() {
    let delay = 0.3e-6;
    for (elements, tolerance) in [(120, 0.012), (480, 0.006)] {
        let mut plates = plates(STEEL, elements, "");
        plates.options = format!(
            "failure = {{ tuler_butcher = {{ threshold = \"{} MPa\", exponent = 2.0, time_at_twice_threshold = \"0.3 us\" }} }}",
            0.5 * plates.impact().1 / 1e6
        );
        let (thickness, meeting) = plates.scab();
        let result = plates.run();
        let (position, time) = first_parting(&result);
        let size = 6e-3 / f64::from(elements);
        assert!(
            (position - 6e-3 + thickness).abs() <= 1.01 * size,
            "{position}"
        );
        assert_near("time of parting", time, meeting + delay, tolerance);
        assert!(
            result.numerics().energy_residual < 1e-9 && result.numerics().momentum_residual < 1e-12
        );
    }
}

/// With a fracture energy the plate parts in one plane, whatever the mesh, and that takes the energy of one crack: those beside it that
/// began to open closed again.
#[test]
fn a_fracture_energy_leaves_one_plane_and_no_crumbs() {
    let area = std::f64::consts::PI * 0.02 * 0.02 / 4.0;
    let (mut works, mut speeds) = (Vec::new(), Vec::new());
    for elements in [120, 240, 480] {
        let mut plates = spalling(STEEL, elements, 2.0 / 3.0);
        plates.options += "\nfracture_energy = \"1 kJ/m2\"\nend_time = \"15 us\"";
        let result = plates.run();
        assert_eq!(result.fragments.len(), 3);
        let size = 6e-3 / f64::from(elements);
        assert!((scab(&result).initial_from - 4e-3).abs() <= 1.01 * size);
        works.push(result.numerics().energy.fracture / (1000.0 * area));
        speeds.push(scab(&result).velocity);
        let numerics = result.numerics();
        assert!(numerics.energy_residual < 1e-9 && numerics.momentum_residual < 1e-12);
    }
    println!("{works:?} {speeds:?}");
    for work in works {
        assert!((0.999..1.02).contains(&work), "{work}");
    }
    for speed in &speeds {
        assert!((speed / speeds[2] - 1.0).abs() < 0.02, "{speeds:?}");
    }
}

const ELASTIC_STEEL: &str = r#"
    [materials.steel]
    name = "steel"
    density = "8000 kg/m3"
    youngs_modulus = "200 GPa"
    poissons_ratio = 0.3
    strength.elastic = {}
"#;

/// One element on a wall is a mass on a spring: the damping adds its fraction to the spring when it loads and takes it off when it
/// unloads, so that the peak force falls by `sqrt(1 + α)`.
#[test]
fn local_damping_of_a_mass_on_a_spring() {
    let peak = |damping: f64| {
        let result = run_recorded(&format!(
            r#"
            projectile = {{ material = "steel", length = "20 mm", diameter = "10 mm", impact_velocity = "10 m/s" }}
            target = {{ rigid_wall = true }}
            [chain]
            projectile_elements = 1
            kinematics = "small-strain"
            courant = 0.002
            local_damping = {damping}
            end_time = "20 us"
            {ELASTIC_STEEL}
            "#
        ));
        assert!(
            result.numerics().energy_residual < 1e-9 && result.numerics().momentum_residual < 1e-12
        );
        result.peak_force.unwrap()
    };
    let area = std::f64::consts::PI * 0.01 * 0.01 / 4.0;
    let (mass, stiffness) = (0.5 * 8000.0 * area * 0.02, 200e9 * area / 0.02);
    for damping in [0.0, 0.3, 0.8_f64] {
        let exact = 10.0 * (mass * stiffness / (1.0 + damping)).sqrt();
        assert_near("peak force", peak(damping), exact, 1e-4);
    }
}

/// What is locally damped is stiffer when it slows down, so that steps have to be shorter by `sqrt(1 + α)`: a bar at nearly the longest
/// stable step keeps below its energy at the start.
#[test]
fn a_locally_damped_bar_is_stable_at_its_longest_step() {
    for damping in [0.2, 0.5, 0.8] {
        let result = run_recorded(&format!(
            r#"
            projectile = {{ material = "steel", length = "1 mm", diameter = "0.5 mm", impact_velocity = "0.001 m/s" }}
            target = {{ material = "steel", thickness = "0.5 mm" }}
            [chain]
            projectile_elements = 9
            target_elements = 4
            kinematics = "small-strain"
            courant = 0.99
            local_damping = {damping}
            end_time = "20 us"
            {ELASTIC_STEEL}
            "#
        ));
        let speeds = result.history.as_ref().unwrap().samples.iter();
        let fastest = speeds.map(|s| s.tip_velocity.abs()).fold(0.0, f64::max);
        println!("damping {damping}: fastest {fastest} m/s");
        assert!(fastest < 1.1e-3, "{damping}: {fastest}");
    }
}
