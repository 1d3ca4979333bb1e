//! Separation and renewed contact of bodies, checked on the state of the chain.

use super::{column::ColumnRun, mesh, solver::StepControl, state::State};
use crate::{
    Scenario,
    case::{self, ArtificialViscosity},
    solver::Control,
};

const CONTROL: StepControl = StepControl {
    courant: 0.5,
    viscosity: ArtificialViscosity {
        linear: 0.0,
        quadratic: 0.0,
    },
    damping_ratio: 0.0,
    local_damping: 0.0,
    erosion_strain: 1.0,
    fails: true,
    longest_step: f64::INFINITY,
};

fn scenario(failure: &str, layers: &str, speed: f64) -> Scenario {
    case::load_str(
        "test",
        &format!(
            r#"
            projectile = {{ material = "4340", length = "15 mm", diameter = "8 mm", impact_velocity = "{speed} m/s" }}
            target = {{ layers = [{layers}], back_face = "free" }}
            [chain]
            border_shear = 0.0
            projectile_elements = 30
            target_elements = 60
            {failure}
            [materials.brittle]
            name = "brittle"
            density = "2700 kg/m3"
            youngs_modulus = "70 GPa"
            poissons_ratio = 0.33
            strength.perfectly_plastic = {{ flow_stress = "300 MPa" }}
            damage = {{ d1 = 0.02, d2 = 0.02, d3 = -1.5 }}
            "#
        ),
    )
    .unwrap_or_else(|error| panic!("{error}"))
}

const LAYERS: &str = r#"
    { material = "aluminium-2024-t351", thickness = "6 mm" },
    { material = "4340", thickness = "4 mm", gap = "0.3 mm", column_diameter = "12 mm" },
    { material = "brittle", thickness = "3 mm", interface = "bonded" },
    { material = "copper", thickness = "6 mm", gap = "0.1 mm" }"#;

/// A rod behind a plug on its way to a plate behind a gap.
fn across_a_gap(millimetres: f64) -> Scenario {
    let text = format!(
        r#"
        projectile = {{ material = "4340", length = "20 mm", diameter = "8 mm", impact_velocity = "900 m/s" }}
        [target]
        back_face = "free"
        layers = [
            {{ material = "6061-t6", thickness = "4 mm" }},
            {{ material = "4340", thickness = "6 mm", gap = "{millimetres} mm" }},
        ]
        "#
    );
    case::load_str("test", &text).unwrap()
}

/// Nothing holds a plug on its way through a gap: border shear takes nothing, to the bit.
#[test]
fn border_shear_does_not_act_in_a_gap() {
    let mut state = mesh::build(&across_a_gap(100.0));
    // Back and front of the plug: what has eroded at its face belongs to no segment.
    let ends = |state: &State| {
        let mut plug = state.segments.iter().filter(|segment| segment.part == 1);
        let first = plug.clone().next().unwrap();
        let last = plug.next_back().unwrap();
        [first.first_node, last.last_node].map(|node| state.nodes.position[node])
    };
    let mut taken = |depth: f64| {
        while ends(&state)[0] < depth {
            state.advance(&CONTROL).unwrap();
            assert!(state.energy().residual().abs() <= 1e-3 && state.time < 1e-3);
        }
        assert!(ends(&state)[1] < 104e-3);
        state.accumulated.kicks.friction
    };
    // The plug has left the first plate, and does not yet touch the second.
    let [left, later] = [5e-3, 80e-3].map(&mut taken);
    assert!(left.work > 1.0, "{left:?}");
    assert_eq!(
        [left.work.to_bits(), left.impulse.to_bits()],
        [later.work.to_bits(), later.impulse.to_bits()]
    );
}

/// Across a wide gap a plug goes further ahead of the rod, which is all that the width changes.
#[test]
fn the_width_of_a_gap_matters_little() {
    let residual = |gap: f64| {
        let scenario = across_a_gap(gap);
        let control = &mut Control::default();
        let run = ColumnRun::new(&scenario, control).unwrap().run(control);
        run.unwrap().residual_velocity.unwrap()
    };
    let [near, far] = [20.0, 100.0].map(residual);
    assert!(
        near > 200.0 && (far / near - 1.0).abs() < 0.1,
        "{near} {far}"
    );
}

/// How often ends had met, bodies had separated and elements had eroded when a time was over; the balances are checked in every step.
fn run(scenario: &Scenario, control: &StepControl, until: f64) -> (State, usize) {
    let mut state = mesh::build(scenario);
    let mass: f64 = state.nodes.mass.iter().sum();
    while state.time < until {
        state.advance(control).unwrap();
        let (energy, momentum) = (state.energy(), state.momentum());
        assert!(
            energy.residual().abs() <= 1e-3,
            "{} at {}",
            energy.residual(),
            state.time
        );
        assert!(
            momentum.residual().abs() <= 1e-12,
            "{}",
            momentum.residual()
        );
        for work in [
            energy.contact,
            energy.fracture,
            energy.plastic_target,
            energy.viscous,
        ] {
            assert!(
                work >= -1e-6 * energy.initial,
                "a dissipative line gives energy back: {energy:?}"
            );
        }
    }
    let elements = || state.elements.iter(0..state.elements.len());
    let eroded = elements().filter(|element| element.eroded).count();
    let left: f64 = state
        .segments
        .iter()
        .flat_map(|s| &state.nodes.mass[s.first_node..=s.last_node])
        .sum();
    let gone: f64 = elements()
        .filter(|element| element.eroded)
        .map(|element| element.end_masses[0] + element.end_masses[1])
        .sum();
    assert!(((left + gone) / mass - 1.0).abs() < 1e-12);
    (state, eroded)
}

#[test]
fn the_balances_close_through_partings_erosion_and_meetings() {
    for (failure, speed) in [
        ("failure = { spall = { strength = \"0.6 GPa\" } }", 250.0),
        (
            "failure = { spall = { strength = \"0.6 GPa\" } }\nfracture_energy = \"2 kJ/m2\"",
            250.0,
        ),
        (
            "failure = { tuler_butcher = { threshold = \"0.3 GPa\", exponent = 2.0, time_at_twice_threshold = \"0.2 us\" } }",
            250.0,
        ),
        ("failure = { johnson_cook = {} }", 700.0),
        ("failure = { spall = { strength = \"0.6 GPa\" } }", 900.0),
    ] {
        let (state, eroded) = run(&scenario(failure, LAYERS, speed), &CONTROL, 60e-6);
        println!(
            "{failure} at {speed} m/s: {} meetings, {} partings, {eroded} eroded, {} pieces, energy off by {:.1e}",
            state.meetings,
            state.partings.len(),
            state.fragments().len(),
            state.energy().residual()
        );
        assert!(state.meetings >= 5 && !state.partings.is_empty());
        assert!(speed < 800.0 || eroded > 0);
        // What is listed is all that is left.
        let momentum = state.momentum();
        let listed: f64 = state.fragments().iter().map(|f| f.mass * f.velocity).sum();
        let off = listed - momentum.projectile - momentum.target;
        assert!(off.abs() < 1e-12 * momentum.initial);
    }
}

#[test]
fn local_damping_keeps_the_balances() {
    let control = StepControl {
        local_damping: 0.4,
        ..CONTROL
    };
    let failure = "failure = { spall = { strength = \"0.6 GPa\" } }";
    let (state, _) = run(&scenario(failure, LAYERS, 250.0), &control, 40e-6);
    assert!(state.momentum().damping != 0.0 && state.energy().viscous > 0.0);
}
