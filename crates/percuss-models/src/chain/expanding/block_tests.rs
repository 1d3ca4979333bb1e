use super::super::{
    node::Node,
    rod::Rod,
    slice::{Metal, Shear, Slice},
};
use crate::material::{FlowState, FlowStress, Hardening, PreparedStrength};

/// A law of which nobody knows that it is a power of the plastic strain.
#[derive(Debug)]
struct Unknown(Hardening);

impl PreparedStrength for Unknown {
    fn flow_stress(&self, state: &FlowState) -> FlowStress {
        self.0.flow_stress(state)
    }

    fn depends_on_strain_only(&self) -> bool {
        true
    }
}

fn metal() -> Metal {
    let material = toml::from_str(
        "name = 'a'\ndensity = '8930 kg/m3'\nyoungs_modulus = '124 GPa'\npoissons_ratio = 0.34\nspecific_heat = '383 J/(kg K)'\n\
         strength.power_law = { coefficient = '450 MPa', exponent = 0.3 }",
    );
    Metal::new(&material.unwrap(), 0.9, true)
}

/// A rod whose nodes have velocities of their own.
fn shaken(metal: Metal, slices: usize) -> Rod {
    let mut rod = Rod::new(metal, slices, 50e-3, 2e-5, 293.0, 0.0);
    rod.nodes.change(|i, node| {
        node.velocity = 200.0 - 30.0 * (i as f64) * (1.0 + (i as f64).sin());
    });
    rod
}

fn step(rod: &mut Rod, time: f64) -> f64 {
    rod.collect();
    rod.kick(time);
    rod.drift(time).unwrap()
}

fn bits(rod: &Rod) -> Vec<u64> {
    let of = |slice: Slice| {
        let shape = [slice.length, slice.radius, slice.strain];
        let forces = [
            slice.axial_force,
            slice.radial_force,
            slice.yield_point.stress(),
        ];
        let reached = [
            slice.plastic.strain,
            slice.plastic.largest_rate,
            slice.plastic.temperature,
        ];
        [shape, forces, reached].concat()
    };
    let numbers: Vec<f64> = rod.slices.iter().flat_map(of).collect();
    numbers.into_iter().map(f64::to_bits).collect()
}

#[test]
fn flow_of_eight_slices_has_the_bits_of_flow_one_by_one() {
    let law = metal().strength.hardening().unwrap();
    let mut one_by_one = metal();
    one_by_one.strength = Box::new(Unknown(law));
    let (mut rod, mut other) = (shaken(metal(), 11), shaken(one_by_one, 11));
    let mut flowing = 0;
    for _ in 0..300 {
        let time = 0.5 * rod.stable_step(0.02);
        assert_eq!(other.stable_step(0.02), 2.0 * time);
        let before: Vec<f64> = rod.slices.iter().map(|s| s.plastic.strain).collect();
        assert_eq!(step(&mut rod, time), step(&mut other, time));
        assert_eq!(bits(&rod), bits(&other));
        let after = rod.slices.iter().zip(before);
        flowing += after
            .filter(|(s, before)| s.plastic.strain > *before)
            .count();
    }
    assert!(flowing > 300 && flowing < 2900, "{flowing}");
}

#[test]
fn what_limits_a_step_is_the_stiffest_and_the_fastest_slice() {
    let mut rod = shaken(metal(), 11);
    for _ in 0..100 {
        let nodes: Vec<Node> = rod.nodes.iter().collect();
        let expected =
            nodes
                .windows(2)
                .zip(rod.slices.iter())
                .fold(f64::INFINITY, |step, (pair, slice)| {
                    let approach = (pair[0].velocity - pair[1].velocity).abs() / slice.length;
                    let rate = approach.max(slice.radial_velocity.abs() / slice.radius);
                    let axial = slice.axial_stress();
                    let inverse = [slice.length, slice.radius].map(|size| 1.0 / size);
                    let stiffness = rod.metal.stiffness(axial, inverse);
                    let frequency = (stiffness / rod.metal.density).sqrt();
                    step.min(2.0 / frequency).min(0.02 / rate)
                });
        // As the last step left it, and looked at again.
        let found = rod.stable_step(0.02);
        assert!((found / expected - 1.0).abs() < 1e-14, "{found} {expected}");
        rod.fastest = None;
        assert_eq!(rod.stable_step(0.02), found);
        step(&mut rod, 0.5 * expected);
    }
}

#[test]
fn slices_do_not_depend_on_the_lane_that_they_are_in() {
    // Two more slices behind a rod, at rest against it: until a wave arrives from them, those ahead know nothing of it.
    for more in [1, 2, 5] {
        let mut rod = Rod::new(metal(), 16, 50e-3, 2e-5, 293.0, 0.0);
        let length = 50e-3 / 16.0 * f64::from(16 + more);
        let mut longer = Rod::new(metal(), 16 + more as usize, length, 2e-5, 293.0, 0.0);
        for rod in [&mut rod, &mut longer] {
            let count = rod.nodes.len();
            rod.nodes.change(|i, node| {
                // Only the last nodes move: places are then the same numbers.
                node.position = -50e-3 / 16.0 * (count - 1 - i) as f64;
                node.velocity = if i + 4 < count { 0.0 } else { -40.0 };
            });
            rod.slices.change(|_, slice| slice.length = 50e-3 / 16.0);
        }
        for _ in 0..4 {
            let time = 0.5 * rod.stable_step(0.02);
            step(&mut rod, time);
            step(&mut longer, time);
        }
        let ahead = |rod: &Rod| bits(rod).into_iter().rev().take(9 * 8).collect::<Vec<_>>();
        assert_eq!(ahead(&rod), ahead(&longer), "{more}");
        assert!(
            rod.slices
                .iter()
                .skip(12)
                .any(|slice| slice.plastic.strain > 0.0)
        );
    }
}

#[test]
fn inert_lanes_stay_what_they_are() {
    let mut rod = shaken(metal(), 11);
    for left in (3..=11).rev() {
        for _ in 0..5 {
            let time = 0.5 * rod.stable_step(0.02);
            step(&mut rod, time);
        }
        for (b, block) in rod.slices.blocks().iter().enumerate() {
            for lane in (0..8).filter(|lane| b * 8 + lane >= left) {
                let idle = crate::lanes::PerLane::lane(block, lane);
                assert_eq!(idle.radius, rod.size.radius);
                assert_eq!([idle.axial_force, idle.radial_force, idle.strain], [0.0; 3]);
            }
        }
        for (b, block) in rod.shears.blocks().iter().enumerate() {
            for lane in (0..8).filter(|lane| b * 8 + lane + 1 >= left) {
                let idle: Shear = crate::lanes::PerLane::lane(block, lane);
                assert_eq!([idle.force, idle.stress[1]], [0.0; 2]);
            }
        }
        rod.erode_tip();
    }
}
