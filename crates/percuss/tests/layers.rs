//! Ladder 1: layers of elastic material, against exact solutions.

use crate::common::{assert_near, run, run_recorded};
use percuss::{history::ElementState, outcome::RunResult};

/// Elastic materials: Young's modulus [GPa] and density [kg/m3].
const STEEL: (f64, f64) = (200.0, 8000.0);
const LIGHT: (f64, f64) = (70.0, 2800.0);

fn impedance((modulus, density): (f64, f64)) -> f64 {
    (modulus * 1e9 * density).sqrt()
}

fn wave_speed((modulus, density): (f64, f64)) -> f64 {
    (modulus * 1e9 / density).sqrt()
}

/// A projectile of steel on layers as the case file has them.
fn case(velocity: f64, rod_mm: f64, layers: &str, back_face: &str, options: &str) -> String {
    let material = |name: &str, (modulus, density): (f64, f64), law: &str| {
        format!(
            "[materials.{name}]\nname = \"{name}\"\ndensity = \"{density} kg/m3\"\nyoungs_modulus = \"{modulus} GPa\"\n\
             poissons_ratio = 0.3\nstrength.{law}\n"
        )
    };
    format!(
        "projectile = {{ material = \"steel\", length = \"{rod_mm} mm\", diameter = \"10 mm\", impact_velocity = \"{velocity} m/s\" }}\n\
         target = {{ layers = [{layers}], back_face = \"{back_face}\" }}\n[chain]\n{options}\n{}{}{}",
        material("steel", STEEL, "elastic = {}"),
        material("light", LIGHT, "elastic = {}"),
        material(
            "soft",
            LIGHT,
            "perfectly_plastic = { flow_stress = \"200 MPa\" }"
        ),
    )
}

/// Mean stress of the elements whose middle lies between two places [mm], over a span of time [us].
fn stress(result: &RunResult, part: usize, place: (f64, f64), time: (f64, f64)) -> f64 {
    let profiles = &result.history.as_ref().unwrap().profiles;
    let (mut sum, mut count) = (0.0, 0);
    let within = |value: f64, (from, to): (f64, f64)| from <= value && value <= to;
    for profile in profiles.iter().filter(|p| within(p.time * 1e6, time)) {
        let inside = |e: &&ElementState| e.part == part && within(e.initial_position * 1e3, place);
        for element in profile.elements.iter().filter(inside) {
            sum += element.stress;
            count += 1;
        }
    }
    assert!(count > 1000, "only {count} values");
    sum / f64::from(count)
}

/// A wave of stress σ that meets an interface goes on as `2 Z₂/(Z₁ + Z₂) σ`, and comes back as `(Z₂ − Z₁)/(Z₁ + Z₂) σ` on top of it.
#[test]
fn waves_are_transmitted_and_reflected_as_the_impedances_have_it() {
    for (second, interface, name) in [
        (LIGHT, "bonded", "light"),
        (LIGHT, "sliding", "light"),
        (STEEL, "bonded", "steel"),
    ] {
        let (z1, z2) = (impedance(STEEL), impedance(second));
        let layers = format!(
            "{{ material = \"steel\", thickness = \"20 mm\" }}, \
             {{ material = \"{name}\", thickness = \"20 mm\", interface = \"{interface}\" }}"
        );
        let options = "kinematics = \"small-strain\"\nborder_shear = 0.0\nprojectile_elements = 400\ntarget_elements = 800\n\
                       end_time = \"8 us\"";
        let result = run_recorded(&case(10.0, 20.0, &layers, "free", options));
        let incident = 0.5 * z1 * 10.0;
        // c = 5 mm/us in both: the wave is at the interface at 4 us, and at 7.5 us 17.5 mm beyond it on either side.
        let before = stress(&result, 1, (1.0, 12.0), (3.0, 3.9));
        let behind = stress(&result, 1, (8.0, 19.0), (7.0, 7.5));
        let ahead = stress(&result, 2, (21.0, 32.0), (7.0, 7.5));
        assert_near("incident", before, incident, 1e-3);
        let transmission = 2.0 * z2 / (z1 + z2);
        assert_near(
            "transmission coefficient",
            ahead / before,
            transmission,
            1e-3,
        );
        let reflection = (z2 - z1) / (z1 + z2);
        let found = (behind - before) / before;
        println!("{interface} {name}: reflection coefficient {found:.6}, exact {reflection:.6}");
        assert!((found - reflection).abs() < 1e-3);
        assert!(result.numerics().energy_residual < 1e-9);
    }
    assert_near("wave speed", wave_speed(LIGHT), wave_speed(STEEL), 1e-12);
}

fn numbers(result: &RunResult) -> Vec<f64> {
    let n = result.numerics();
    vec![
        result.residual_velocity.unwrap(),
        result.largest_depth.unwrap(),
        result.peak_force.unwrap(),
        result.end_time.unwrap(),
        n.energy.kinetic_target,
        n.energy.elastic_target,
        n.energy.plastic_target,
        n.momentum.target,
    ]
}

/// On the same mesh a bonded interface is nothing at all, elastic or not, in tension too.
#[test]
fn two_bonded_layers_of_one_material_are_one_layer() {
    // Rounding grows with time where material flows.
    for (material, velocity, time, tolerance) in [
        ("light", 20.0, 40, 1e-12),
        ("soft", 150.0, 8, 1e-12),
        ("soft", 150.0, 40, 1e-9),
    ] {
        let options = format!(
            "border_shear = 0.3\nprojectile_elements = 40\ntarget_elements = 60\nend_time = \"{time} us\""
        );
        let one = format!("{{ material = \"{material}\", thickness = \"15 mm\" }}");
        let two = format!(
            "{{ material = \"{material}\", thickness = \"5 mm\" }}, \
             {{ material = \"{material}\", thickness = \"10 mm\", interface = \"bonded\" }}"
        );
        let run = |layers: &str| run(&case(velocity, 10.0, layers, "free", &options));
        let (one, two) = (run(&one), run(&two));
        let largest = |values: &[f64]| values.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        for (a, b) in numbers(&one).iter().zip(&numbers(&two)) {
            println!("{material}: {a:.15e} {b:.15e}");
            assert!(
                (a - b).abs() <= tolerance * largest(&[*a, *b, 1.0]),
                "{a} {b}"
            );
        }
    }
}

/// Free plates of one length pass a velocity on across gaps, as balls do: every one flies at the velocity of the projectile until it
/// strikes the next.
#[test]
fn a_row_of_plates_with_gaps_passes_the_velocity_on() {
    let layer = |gap: &str| format!("{{ material = \"steel\", thickness = \"10 mm\"{gap} }}");
    let gap = ", gap = \"2 mm\"";
    let layers = [layer(""), layer(gap), layer(gap)].join(", ");
    let options = "kinematics = \"small-strain\"\nborder_shear = 0.0\nprojectile_elements = 200\ntarget_elements = 600";
    let result = run_recorded(&case(20.0, 10.0, &layers, "free", options));
    println!(
        "{:#?} {:?} {}",
        result.fragments, result.outcome, result.criterion
    );
    assert_eq!(result.fragments.len(), 4);
    for piece in &result.fragments[..3] {
        assert!(piece.velocity.abs() < 0.01 * 20.0, "{piece:?}");
    }
    assert_near(
        "speed of the last plate",
        result.fragments[3].velocity,
        20.0,
        1e-2,
    );
    // Each plate takes a length over the wave speed to be passed, and flies 2 mm at 20 m/s before it strikes.
    let samples = &result.history.as_ref().unwrap().samples;
    let exact = 3.0 * 10e-3 / 5000.0 + 2.0 * 2e-3 / 20.0;
    let arrival = samples
        .iter()
        .find(|s| s.back_velocity > 10.0)
        .unwrap()
        .time;
    assert_near("time to the back of the last plate", arrival, exact, 5e-3);
    assert!(
        result.numerics().momentum_residual < 1e-12 && result.numerics().energy_residual < 1e-9
    );
}

/// A light rod bounces off a plate, which crosses a gap to a plate that is held: the run does not end before they have met.
#[test]
fn a_run_goes_on_until_layers_have_met() {
    for back_face in ["fixed", "free"] {
        let layers = "{ material = \"steel\", thickness = \"10 mm\" }, { material = \"steel\", thickness = \"10 mm\", gap = \"0.5 mm\" }";
        let options = "border_shear = 0.0\nprojectile_elements = 20\ntarget_elements = 80";
        let text =
            case(40.0, 5.0, layers, back_face, options).replacen("\"steel\"", "\"light\"", 1);
        let result = run(&text);
        // The momentum that the rod gives: V (Z₁ Z₂/(Z₁ + Z₂)) for 2L/c, on a plate of 10 mm.
        let (light, steel) = (impedance(LIGHT), impedance(STEEL));
        let speed =
            2.0 * (5e-3 / 5000.0) * 40.0 * light * steel / (light + steel) / (8000.0 * 10e-3);
        let flight = 0.5e-3 / speed;
        println!(
            "{back_face}: {:?}, meeting at {:.1} us, end at {:.1} us",
            result.outcome,
            flight * 1e6,
            result.end_time.unwrap() * 1e6
        );
        assert_eq!(result.outcome, percuss::outcome::Outcome::Rebounded);
        assert!(result.end_time.unwrap() > flight);
        if back_face == "free" {
            // The first plate still rings when it strikes: how much it gives depends on the phase, the sum does not.
            let [first, second] = [1, 2].map(|i| result.fragments[i].velocity);
            assert_near(
                "momentum of both plates, as a speed",
                first + second,
                speed,
                0.01,
            );
            assert!(second > 2.0 * first, "{first} {second}");
        }
    }
}

/// A plug that has crossed a gap is not held by the next layer: a foil there takes no more than it would alone.
#[test]
fn border_shear_stays_with_its_layer() {
    let velocity = |layers: &str| {
        let text = format!(
            "projectile = {{ material = '4340', length = '50 mm', diameter = '10 mm', impact_velocity = '400 m/s' }}\n\
             target = {{ back_face = 'free', layers = [{layers}] }}\nchain.target_elements = 40"
        );
        run(&text).residual_velocity.unwrap()
    };
    let plate = "{ material = '2024-t3', thickness = '4 mm' }";
    let behind = |thickness: &str| {
        velocity(&format!(
            "{plate}, {{ material = '2024-t3', thickness = '{thickness}', gap = '50 mm' }}"
        ))
    };
    let (foil, thicker, two) = (behind("0.01 mm"), behind("0.1 mm"), behind("4 mm"));
    println!("foil {foil}, 0.1 mm {thicker}, 4 mm {two}");
    assert!((foil / thicker - 1.0).abs() < 2e-3, "{foil} {thicker}");
    assert!(two < 0.95 * foil, "{two} {foil}");
}
