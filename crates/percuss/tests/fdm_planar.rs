//! Planar finite differences against exact shocks, jump conditions and wave diagrams.

use crate::common::{assert_near, fdm_recorded};
use percuss::{
    fdm::planar::{
        Boundary, CellState, Layer, Medium, PlanarGrid, Solid, StateEquation, impedance_match,
    },
    material::Material,
    options::FdmOptions,
};

const COURANT: f64 = 0.7;

/// The elastic-plastic metal of the piston problem.
mod piston {
    pub const DENSITY: f64 = 2790.0;
    pub const SHEAR: f64 = 28.6e9;
    pub const YIELD: f64 = 0.26e9;
    pub const SPEED: f64 = 100.0;
}

const ALUMINIUM: StateEquation = StateEquation::MieGruneisen {
    density: piston::DENSITY,
    sound_speed: 5330.0,
    slope: 1.34,
    gruneisen: 2.0,
};

/// A material with a strength law, for what the column takes from it.
fn material(strength: &str) -> Material {
    toml::from_str(&format!(
        "name = 'a'\ndensity = '2790 kg/m3'\nyoungs_modulus = '76 GPa'\npoissons_ratio = 0.33\nstrength.{strength}"
    ))
    .unwrap()
}

fn solid(strength: &str) -> Medium {
    Medium {
        state: ALUMINIUM,
        density: piston::DENSITY,
        energy: 0.0,
        solid: Some(Solid {
            shear_modulus: piston::SHEAR,
            material: material(strength),
        }),
        spall_strength: None,
    }
}

/// State behind a shock.
#[derive(Debug, Clone, Copy)]
struct State {
    volume: f64,
    stress: f64,
    pressure: f64,
    energy: f64,
    velocity: f64,
}

/// The exact two-wave structure: an elastic precursor to the yield point and a plastic shock behind it.
///
/// Both waves obey the jump conditions `σ₂ − σ₁ = (v₂ − v₁)²/(V₁ − V₂)` and `e₂ − e₁ = ½ (σ₁ + σ₂)(V₁ − V₂)`, with
/// `p = a(V) + b e`. The axial deviator is 2Y/3 behind the precursor; where it is reached depends on the elastic law:
/// `s = (4/3) G ln(ρ/ρ₀)` for a rate law with a constant modulus (hypoelastic), `s = (4/3) G (1 − ρ₀/ρ)` for one that is
/// linear in the engineering strain.
fn exact(
    yield_volume: f64,
    piston_speed: f64,
    coefficients: fn(f64) -> (f64, f64),
) -> (State, State, f64, f64) {
    let start = State {
        volume: 1.0 / piston::DENSITY,
        stress: 0.0,
        pressure: 0.0,
        energy: 0.0,
        velocity: 0.0,
    };
    let deviator = 2.0 / 3.0 * piston::YIELD;
    let behind = |ahead: State, volume: f64| {
        let change = ahead.volume - volume;
        let (cold, slope) = coefficients(volume);
        // p = a + b [e₁ + ½ (σ₁ + p + s) ΔV], solved for p.
        let known = cold + slope * (ahead.energy + 0.5 * (ahead.stress + deviator) * change);
        let pressure = known / (1.0 - 0.5 * slope * change);
        let stress = pressure + deviator;
        State {
            volume,
            stress,
            pressure,
            energy: ahead.energy + 0.5 * (ahead.stress + stress) * change,
            velocity: ahead.velocity + ((stress - ahead.stress) * change).sqrt(),
        }
    };
    let speed = |ahead: State, behind: State| {
        let mass = ((behind.stress - ahead.stress) / (ahead.volume - behind.volume)).sqrt();
        ahead.velocity + ahead.volume * mass
    };
    let yielded = behind(start, yield_volume);
    let (mut low, mut high) = (0.8 * yield_volume, yield_volume);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if behind(yielded, middle).velocity > piston_speed {
            low = middle;
        } else {
            high = middle;
        }
    }
    let last = behind(yielded, low);
    (yielded, last, speed(start, yielded), speed(yielded, last))
}

/// The equation of state of the library: `Γρ` constant.
fn constant_product(volume: f64) -> (f64, f64) {
    ALUMINIUM.coefficients(volume)
}

/// The same Hugoniot with a constant Γ: `p = p_H + Γρ (e − e_H)`, `e_H = ½ p_H (V₀ − V)`.
fn constant_gruneisen(volume: f64) -> (f64, f64) {
    let compression = 1.0 - piston::DENSITY * volume;
    let bulk = piston::DENSITY * 5330.0_f64.powi(2);
    let hugoniot = bulk * compression / (1.0 - 1.34 * compression).powi(2);
    let slope = 2.0 / volume;
    let energy = 0.5 * hugoniot * compression / piston::DENSITY;
    (hugoniot - slope * energy, slope)
}

fn hypoelastic() -> f64 {
    (-piston::YIELD / (2.0 * piston::SHEAR)).exp() / piston::DENSITY
}

/// With a constant Γ the derivation gives the numbers that are known for this problem, for both elastic laws. The library's
/// constant `Γρ` changes them by 1e-5 and 3e-5.
#[test]
fn the_exact_piston_states_are_the_known_ones() {
    let hyperelastic = (1.0 - piston::YIELD / (2.0 * piston::SHEAR)) / piston::DENSITY;
    for (volume, known) in [
        (
            hypoelastic(),
            [
                2802.7107, 0.364661e9, 6520.66, 29.5721, 5505.53, 1.445555e9, 2839.2268,
            ],
        ),
        (
            hyperelastic,
            [
                2802.7397, 0.365501e9, 6518.34, 29.6288, 5505.60, 1.445539e9, 2839.2264,
            ],
        ),
    ] {
        let (yielded, last, elastic, plastic) = exact(volume, piston::SPEED, constant_gruneisen);
        let found = [
            1.0 / yielded.volume,
            yielded.pressure,
            elastic,
            yielded.velocity,
            plastic,
            last.pressure,
            1.0 / last.volume,
        ];
        for (found, known) in found.into_iter().zip(known) {
            assert_near("exact state", found, known, 1.5e-6);
        }
        let (yielded_here, last_here, ..) = exact(volume, piston::SPEED, constant_product);
        assert_near(
            "Γρ constant, p_y",
            yielded_here.pressure,
            yielded.pressure,
            2e-5,
        );
        assert_near("Γρ constant, p_2", last_here.pressure, last.pressure, 5e-5);
    }
}

fn push(zones: usize, time: f64) -> Vec<CellState> {
    let layer = Layer {
        medium: solid("perfectly_plastic = { flow_stress = '260 MPa' }"),
        thickness: 0.1,
        cells: zones,
        velocity: 0.0,
    };
    let ends = [Boundary::Piston(piston::SPEED), Boundary::Free];
    let mut column = PlanarGrid::new(&[layer], ends, FdmOptions::PLANAR_VISCOSITY, COURANT);
    column.advance_to(time).unwrap();
    assert!(column.energy().residual().abs() < 1e-9 * column.energy().total());
    assert!(column.momentum().residual().abs() < 1e-9 * column.momentum().projectile);
    column.cells()
}

fn average(cells: &[CellState], from: f64, to: f64, value: fn(&CellState) -> f64) -> f64 {
    let inside = cells
        .iter()
        .filter(|cell| (from..to).contains(&cell.position));
    let values: Vec<f64> = inside.map(value).collect();
    assert!(values.len() > 5, "{} cells", values.len());
    values.iter().sum::<f64>() / values.len() as f64
}

/// Where the velocity falls through a level, from the right.
fn front(cells: &[CellState], level: f64) -> f64 {
    let pair = cells
        .windows(2)
        .rfind(|pair| pair[0].velocity >= level && pair[1].velocity < level)
        .unwrap();
    let share = (pair[0].velocity - level) / (pair[0].velocity - pair[1].velocity);
    pair[0].position + share * (pair[1].position - pair[0].position)
}

#[test]
fn a_piston_drives_the_exact_elastic_and_plastic_shocks() {
    let (yielded, last, elastic, plastic) = exact(hypoelastic(), piston::SPEED, constant_product);
    let (early, late) = (push(1000, 7e-6), push(1000, 14e-6));
    let check = |what: &str, from, to, state: State| {
        let mean = |value| average(&late, from, to, value);
        assert_near(
            &format!("{what} density"),
            mean(|c| c.density),
            1.0 / state.volume,
            1e-4,
        );
        assert_near(
            &format!("{what} pressure"),
            mean(|c| c.pressure),
            state.pressure,
            5e-3,
        );
        let stress = mean(|c| c.pressure + c.deviator);
        assert_near(&format!("{what} stress"), stress, state.stress, 5e-3);
        assert_near(
            &format!("{what} velocity"),
            mean(|c| c.velocity),
            state.velocity,
            5e-3,
        );
    };
    // The precursor stands from 77 to 91 mm, the plastic state behind it down to the piston at 1.4 mm.
    check("precursor", 0.081, 0.088, yielded);
    check("plastic", 0.01, 0.07, last);
    assert_near(
        "energy",
        average(&late, 0.01, 0.07, |c| c.energy),
        last.energy,
        5e-3,
    );
    for (what, level, speed) in [
        ("elastic", 0.5 * yielded.velocity, elastic),
        ("plastic", 0.5 * (yielded.velocity + last.velocity), plastic),
    ] {
        let found = (front(&late, level) - front(&early, level)) / 7e-6;
        assert_near(&format!("{what} shock speed"), found, speed, 3e-3);
    }
}

/// Mean error of the velocity against the exact two steps, over all and over what lies behind the precursor.
///
/// A shock makes every such scheme first order. Weak shocks get there late: until its width is steady a front spreads by
/// diffusion with a viscosity proportional to the cell, which alone would give one half. So the order must rise towards 1.
#[test]
fn the_piston_problem_converges() {
    let (yielded, last, elastic, plastic) = exact(hypoelastic(), piston::SPEED, constant_product);
    let time = 14e-6;
    let error = |zones: usize| {
        let mut sums = [0.0; 2];
        for cell in push(zones, time) {
            let exact = if cell.position < plastic * time {
                last.velocity
            } else if cell.position < elastic * time {
                yielded.velocity
            } else {
                0.0
            };
            let error = (cell.velocity - exact).abs() / zones as f64;
            sums[0] += error;
            if cell.position < 0.5 * (plastic + elastic) * time {
                sums[1] += error;
            }
        }
        sums
    };
    let errors = [125, 250, 500, 1000].map(error);
    for (what, part) in [("both waves", 0), ("plastic shock", 1)] {
        let orders: Vec<f64> = errors
            .windows(2)
            .map(|pair| (pair[0][part] / pair[1][part]).log2())
            .collect();
        println!(
            "{what}: mean error of velocity {:.4?} m/s, observed orders {orders:.2?}",
            errors.map(|error| error[part])
        );
        let rising = orders.windows(2).all(|pair| pair[1] > pair[0]);
        assert!(
            rising && orders[0] > 0.5 && orders[2] < 1.1,
            "{what} {orders:?}"
        );
    }
}

/// Noh: cold gas of γ = 5/3 stops at a wall; density 4 behind a shock that moves at |v₀|/3.
#[test]
fn nohs_gas_piles_up_to_density_four() {
    let layer = Layer {
        medium: Medium::ideal_gas(5.0 / 3.0, 1.0, 0.0),
        thickness: 1.0,
        cells: 400,
        velocity: 1.0,
    };
    let ends = [Boundary::Free, Boundary::Piston(0.0)];
    let mut column = PlanarGrid::new(&[layer], ends, FdmOptions::PLANAR_VISCOSITY, COURANT);
    let time = 0.6;
    column.advance_to(time).unwrap();
    let cells = column.cells();
    // The wall stands at 1, the shock at 1 − t/3.
    let plateau = |value| average(&cells, 0.82, 0.97, value);
    assert_near("density", plateau(|c| c.density), 4.0, 5e-3);
    assert_near("pressure", plateau(|c| c.pressure), 4.0 / 3.0, 5e-3);
    assert_near("energy", plateau(|c| c.energy), 0.5, 5e-3);
    let pair = cells.windows(2).find(|pair| pair[1].density > 2.5).unwrap();
    assert_near(
        "distance of the shock",
        1.0 - pair[0].position,
        time / 3.0,
        1e-2,
    );
    // Artificial viscosity heats the first cells at the wall too much: there the density falls short.
    let last = cells[cells.len() - 1];
    let heated = cells.iter().rev().take_while(|c| c.density < 3.96).count();
    println!(
        "wall heating: density {:.3} in the cell at the wall, {heated} cells below 3.96",
        last.density
    );
    assert!(last.density < 3.9 && heated < 12);
    assert!(column.energy().residual().abs() < 1e-9);
}

fn metal(name: &str) -> Material {
    let library = percuss::material::Library::built_in();
    (*library.find(name).unwrap().material).clone()
}

/// A record without its strength: the Hugoniot alone.
fn fluid(name: &str) -> Medium {
    Medium {
        solid: None,
        spall_strength: None,
        ..Medium::of(&metal(name)).unwrap()
    }
}

fn plates(flyer: (Medium, f64), target: (Medium, f64), size: f64, velocity: f64) -> PlanarGrid {
    let layer = |(medium, thickness): (Medium, f64), velocity| Layer {
        medium,
        thickness,
        cells: (thickness / size).round() as usize,
        velocity,
    };
    let layers = [layer(flyer, velocity), layer(target, 0.0)];
    PlanarGrid::new(
        &layers,
        [Boundary::Free, Boundary::Free],
        FdmOptions::PLANAR_VISCOSITY,
        COURANT,
    )
}

#[test]
fn unlike_plates_meet_where_their_hugoniots_intersect() {
    let pairs = [
        ("tungsten-steinberg", "6061-t6-steinberg"),
        ("6061-t6-steinberg", "ofhc-copper-steinberg"),
        ("tantalum-steinberg", "tantalum-steinberg"),
    ];
    for (flyer, target) in pairs {
        for velocity in [400.0, 1500.0] {
            let (speed, pressure) =
                impedance_match(&metal(flyer), Some(&metal(target)), velocity).unwrap();
            if flyer == target {
                assert_near("symmetric impact", speed, 0.5 * velocity, 1e-12);
            }
            let mut column = plates((fluid(flyer), 5e-3), (fluid(target), 5e-3), 1e-5, velocity);
            column.advance_to(0.6e-6).unwrap();
            let cells = column.cells();
            // One millimetre on either side of the interface lies behind both shocks.
            let first = cells.iter().position(|cell| cell.layer == 1).unwrap();
            for side in [
                &cells[first - 100..first - 10],
                &cells[first + 10..first + 100],
            ] {
                let mean = |value: fn(&CellState) -> f64| {
                    side.iter().map(value).sum::<f64>() / side.len() as f64
                };
                let what = format!("{flyer} on {target} at {velocity} m/s");
                assert_near(&format!("{what}: speed"), mean(|c| c.velocity), speed, 3e-3);
                assert_near(
                    &format!("{what}: pressure"),
                    mean(|c| c.pressure),
                    pressure,
                    3e-3,
                );
            }
            let initial = column.energy().initial;
            assert!((column.energy().total() - initial).abs() < 1e-9 * initial);
        }
    }
}

/// Longitudinal wave speed of the elastic plates.
fn longitudinal() -> f64 {
    (5330.0_f64.powi(2) + 4.0 / 3.0 * piston::SHEAR / piston::DENSITY).sqrt()
}

/// In a weak elastic wave the free surface moves twice as fast as the material behind the wave.
#[test]
fn a_free_surface_doubles_the_speed() {
    let velocity = 10.0;
    let elastic = || solid("elastic = {}");
    let mut column = plates((elastic(), 5e-3), (elastic(), 5e-3), 2e-5, velocity);
    column.advance_to(5e-3 / longitudinal() * 0.8).unwrap();
    let cells = column.cells();
    let behind = average(&cells, 5e-3, 8e-3, |c| c.velocity);
    assert_near("speed behind the wave", behind, 0.5 * velocity, 1e-3);
    column.advance_to(5e-3 / longitudinal() * 1.6).unwrap();
    assert_near(
        "speed of the free surface",
        column.end_velocities().1,
        velocity,
        1e-2,
    );
}

/// Releases from the two free faces meet one flyer thickness under the target's back.
#[test]
fn elastic_plates_spall_where_and_when_the_releases_meet() {
    let (flyer, target, velocity) = (2e-3, 5e-3, 20.0);
    let strong = Medium {
        // Two thirds of the tension that the releases could pull.
        spall_strength: Some(2.0 / 3.0 * 0.5 * piston::DENSITY * longitudinal() * velocity),
        ..solid("elastic = {}")
    };
    for size in [4e-5, 1e-5] {
        let mut column = plates(
            (strong.clone(), flyer),
            (strong.clone(), target),
            size,
            velocity,
        );
        column
            .advance_to(1.6 * (flyer + target) / longitudinal())
            .unwrap();
        let spalls = column.spalls();
        println!("{spalls:?}");
        let (position, time) = spalls[0];
        let plane = flyer + target - flyer;
        assert!((position - plane).abs() < 5.0 * size, "{position}");
        let meeting = (flyer + target) / longitudinal();
        assert_near(
            "time of spall [s]",
            time,
            meeting,
            10.0 * size / (flyer + target),
        );
        assert!(column.energy().residual().abs() < 1e-9);
    }
    let held = Medium {
        spall_strength: Some(1.1 * 0.5 * piston::DENSITY * longitudinal() * velocity),
        ..strong
    };
    let mut column = plates((held.clone(), flyer), (held, target), 2e-5, velocity);
    column
        .advance_to(1.6 * (flyer + target) / longitudinal())
        .unwrap();
    assert_eq!(column.spalls(), []);
}

/// A case with a flyer plate of a built-in material.
fn shot(length_mm: f64, material: &str, velocity: f64, fdm: &str) -> String {
    format!(
        r#"
        projectile = {{ material = "{material}", length = "{length_mm} mm", diameter = "60 mm", impact_velocity = "{velocity} m/s" }}
        target = {{ material = "{material}", thickness = "6 mm", back_face = "free" }}
        [fdm]
        geometry = "planar"
        {fdm}
        "#
    )
}

fn detail(result: &percuss::outcome::RunResult, name: &str) -> f64 {
    let found = result.details.iter().find(|detail| detail.name == name);
    found
        .unwrap_or_else(|| panic!("no `{name}` in {:?}", result.details))
        .value
}

#[test]
fn a_flyer_plate_as_a_case() {
    let result = fdm_recorded(&shot(
        3.0,
        "6061-t6-steinberg",
        500.0,
        "spall_strength = \"1.2 GPa\"",
    ));
    println!("{:?}\n{:?}", result.details, result.warnings);
    // Strength adds to the pressure of the Hugoniot, by less than two thirds of 400 MPa: the precursor moves the material already.
    let excess = detail(&result, "interface stress, plateau")
        - detail(&result, "impedance match: pressure without strength");
    assert!((0.1..0.267).contains(&excess), "{excess}");
    assert_near(
        "particle speed [m/s]",
        detail(&result, "impedance match: particle speed"),
        250.0,
        1e-9,
    );
    assert!((480.0..520.0).contains(&detail(&result, "largest speed of the rear face")));
    // Plastic release lags behind elastic, so the plane lies near, not at, one flyer thickness under the back.
    assert!((2.5..4.5).contains(&detail(&result, "first spall plane, below the struck face")));
    assert_eq!(result.depth_of_penetration, None);
    let numerics = result.numerics();
    assert!(numerics.energy_residual < 1e-9 && numerics.momentum_residual < 1e-9);
    assert!(!result.history.unwrap().profiles.is_empty());
}

/// Plastic work heats by the fraction that the case gives, and strength that falls with the temperature shows it.
#[test]
fn plastic_work_heats_a_flyer_by_its_fraction() {
    let temperature = |chain: &str| {
        let text = format!(
            "{}
[chain]\n{chain}",
            shot(3.0, "ofhc-copper", 800.0, "")
        );
        let result = fdm_recorded(&text);
        result.numerics().largest_temperature.1
    };
    let [none, half, usual, whole] = [
        "adiabatic_heating = false",
        "heat_fraction = 0.45",
        "",
        "heat_fraction = 1.0",
    ]
    .map(temperature);
    assert_eq!(usual, temperature("heat_fraction = 0.9"));
    assert!(
        none < half && half < usual && usual < whole,
        "{none} {half} {usual} {whole}"
    );
    assert!(((usual - none) / (half - none) / 2.0 - 1.0).abs() < 0.1);
}

/// Symmetric impact: each body is a piston at half the speed, whose exact stress is known. The start-up of the artificial viscosity, an
/// overshoot of 2 % on every mesh, is in none of the numbers.
#[test]
fn the_plateau_of_the_interface_stress_is_the_exact_one() {
    let (_, last, ..) = exact(hypoelastic(), piston::SPEED, constant_product);
    for cells in [25, 50, 100, 200, 400] {
        let result = fdm_recorded(&format!(
            r#"
            projectile = {{ material = "a", length = "3 mm", diameter = "60 mm", impact_velocity = "{} m/s" }}
            target = {{ material = "a", thickness = "6 mm", back_face = "free" }}
            fdm = {{ geometry = "planar", projectile_elements = {cells} }}
            [materials.a]
            name = "aluminium of the piston problem"
            density = "2790 kg/m3"
            youngs_modulus = "76.0760 GPa"
            poissons_ratio = 0.33
            equation_of_state = {{ sound_speed = "5330 m/s", slope = 1.34, gruneisen = 2.0 }}
            strength.perfectly_plastic = {{ flow_stress = "260 MPa" }}
            "#,
            2.0 * piston::SPEED
        ));
        let plateau = 1e9 * detail(&result, "interface stress, plateau");
        let what = format!("{cells} cells");
        assert_near(&format!("plateau on {what}"), plateau, last.stress, 1e-3);
        let area = std::f64::consts::PI * 0.03_f64.powi(2);
        let peak = result.peak_force.unwrap() / area;
        assert_near(&format!("peak on {what}"), peak, last.stress, 3e-3);
        let samples = &result.history.as_ref().unwrap().samples;
        let start = samples.iter().map(|s| s.contact_force).fold(0.0, f64::max) / area;
        assert!(
            start > 1.01 * last.stress,
            "no start-up to leave out: {start:e}"
        );
    }
}

/// Unlike plates without strength to speak of: the plateau is the impedance match.
#[test]
fn the_plateau_is_the_impedance_match_of_unlike_plates() {
    let metal = |id: &str, density: f64, speed: f64, slope: f64| {
        format!(
            "[materials.{id}]\nname = '{id}'\ndensity = '{density} kg/m3'\nyoungs_modulus = '100 GPa'\npoissons_ratio = 0.3\n\
             equation_of_state = {{ sound_speed = '{speed} m/s', slope = {slope}, gruneisen = 1.8 }}\n\
             strength.perfectly_plastic = {{ flow_stress = '5 MPa' }}\n"
        )
    };
    let metals = metal("heavy", 8930.0, 3940.0, 1.49) + &metal("light", 2703.0, 5240.0, 1.4);
    for (flyer, target) in [("heavy", "light"), ("light", "heavy")] {
        for cells in [50, 100, 200] {
            let result = fdm_recorded(&format!(
                r#"
                projectile = {{ material = "{flyer}", length = "3 mm", diameter = "60 mm", impact_velocity = "800 m/s" }}
                target = {{ material = "{target}", thickness = "3 mm", back_face = "free" }}
                fdm = {{ geometry = "planar", projectile_elements = {cells} }}
                {metals}
                "#
            ));
            assert_near(
                &format!("{flyer} on {target}, {cells} cells"),
                detail(&result, "interface stress, plateau"),
                detail(&result, "impedance match: pressure without strength"),
                3e-3,
            );
        }
    }
}

#[test]
fn planar_cases_outside_are_refused_with_a_reason() {
    let refusal = |text: &str| {
        let scenario = crate::common::scenario(text);
        let model = percuss::model::model("fdm").unwrap();
        let mut control = percuss::model::Control::default();
        percuss::model::run(model, &scenario, &mut control)
            .unwrap_err()
            .to_string()
    };
    let missing = refusal(&shot(3.0, "copper", 500.0, ""));
    assert!(
        missing.contains("equation_of_state") && missing.contains("copper-woodward"),
        "{missing}"
    );
    let long = refusal(&shot(40.0, "6061-t6", 500.0, ""));
    assert!(long.contains("uniaxial strain"), "{long}");
}

#[test]
fn nothing_moves_at_zero_speed() {
    let result = fdm_recorded(&shot(3.0, "6061-t6", 0.0, ""));
    assert_eq!(result.residual_velocity, Some(0.0));
    assert_eq!(result.peak_force, Some(0.0));
}
