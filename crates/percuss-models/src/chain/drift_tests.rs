use super::*;
use crate::{case, chain::mesh};

/// A chain at rest, of a projectile of a metal.
fn chain(metal: &str) -> State {
    let text = format!(
        "projectile = {{ material = '{metal}', length = '12.74 mm', diameter = '4.8 mm', impact_velocity = '200 m/s' }}\n\
         target = {{ material = 'aluminium-2024-t351', thickness = '25 mm' }}\n\
         [chain]\ntarget_resistance = 'column'\nprojectile_elements = 27\ntarget_elements = 5\n"
    );
    mesh::build(&case::load_str("shot", &text).unwrap_or_else(|error| panic!("{error}")))
}

/// Everything that flow changes.
fn bits(element: &Element) -> [u64; 9] {
    [
        element.spring.stress,
        element.plastic.step,
        element.plastic.strain,
        element.plastic.axial,
        element.spring.unloaded_length,
        element.plastic.temperature,
        element.plastic.largest_rate,
        element.yield_point.stress(),
        element.yield_point.strain_slope(),
    ]
    .map(f64::to_bits)
}

#[test]
fn elements_that_flow_side_by_side_do_so_to_the_bits_of_each_by_itself() {
    for metal in [
        "copper-woodward",
        "ofhc-copper-johnson-cook",
        "tungsten-alloy-steinberg",
    ] {
        flow_both_ways(metal);
    }
}

fn flow_both_ways(metal: &str) {
    const TIME_STEP: f64 = 1e-8;
    let mut state = chain(metal);
    let part = &state.parts[0];
    let law = part.strength.in_lanes().unwrap();
    let together = &mut state.elements[..part.elements];
    let mut alone = together.to_vec();
    let (mut flowed, mut iterated) = (0, 0);
    for step in 0..60 {
        let mut working = Vec::new();
        for (i, (one, other)) in together.iter_mut().zip(&mut alone).enumerate() {
            // Compression and tension in turn, from what stays elastic to what only iteration follows.
            let size = 0.12 * ((step * 7 + i * 5) % 29) as f64 / 29.0;
            let length = one.rest_length * (1.0 + size * if step % 4 < 2 { -1.0 } else { 1.0 });
            let step_before = one.stretch(part, length);
            other.stretch(part, length);
            let flows = !one.yield_point.holds(one.spring.stress.abs());
            working.push(YieldingElement {
                element: i,
                step_before,
                flows,
            });
            flowed += usize::from(flows);
            iterated += usize::from(one.spring.stress.abs() > 0.09 * part.modulus);
            if flows {
                other.flow(part, TIME_STEP);
            }
        }
        law.visit(FlowTogether {
            elements: together,
            working: &working,
            part,
            time_step: TIME_STEP,
        });
        for (one, other) in together.iter().zip(&alone) {
            assert_eq!(bits(one), bits(other), "step {step}: {one:?} {other:?}");
        }
    }
    assert!(flowed > 300 && iterated > 30, "{flowed} {iterated}");
}
