use super::*;
use crate::{case, chain::mesh};

/// A chain at rest, of a projectile of a metal, and how it advances.
fn chain(metal: &str, options: &str) -> (State, StepControl) {
    let text = format!(
        "projectile = {{ material = '{metal}', length = '12.74 mm', diameter = '4.8 mm', impact_velocity = '200 m/s' }}\n\
         target = {{ material = 'aluminium-2024-t351', thickness = '25 mm' }}\n\
         [chain]\ntarget_resistance = 'column'\nprojectile_elements = 27\ntarget_elements = 5\n{options}\n"
    );
    let scenario = case::load_str("run", &text).unwrap_or_else(|error| panic!("{error}"));
    let control = StepControl::new(&scenario.options.chain, 0.8, 2.0, f64::INFINITY);
    (mesh::build(&scenario), control)
}

/// Everything that a drift changes; 0 and −0 are one.
fn bits(element: &Element) -> [u64; 14] {
    [
        element.length,
        element.strain,
        element.axial_force,
        element.viscous_force,
        element.spring.stress,
        element.spring.stress_before,
        element.spring.unloaded_length,
        element.plastic.step,
        element.plastic.strain,
        element.plastic.axial,
        element.plastic.temperature,
        element.plastic.largest_rate,
        element.yield_point.stress(),
        element.yield_point.strain_slope(),
    ]
    .map(|number| (number + 0.0).to_bits())
}

#[test]
fn elements_side_by_side_have_the_bits_of_each_by_itself() {
    for metal in [
        "copper-woodward",
        "ofhc-copper-johnson-cook",
        "tungsten-alloy-steinberg",
    ] {
        for options in [
            "",
            "kinematics = 'small-strain'",
            "artificial_viscosity = { linear = 0.06, quadratic = 1.5 }",
        ] {
            drift_both_ways(metal, options);
        }
    }
}

/// Drifts elements 3 to 21 of a chain, which fill neither their first nor their last block, and leaves the others alone.
fn drift_both_ways(metal: &str, options: &str) {
    const TIME_STEP: f64 = 1e-8;
    const EXACT: f64 = (1_u64 << 40) as f64;
    let (mut state, control) = chain(metal, options);
    let part = &state.parts[0];
    let law = part.strength.in_lanes().unwrap();
    let mut alone = state.elements.clone();
    let mut sums = [[0.0; 3]; 2];
    let (mut flowed, mut iterated) = (0, 0);
    for step in 0..60 {
        let mut position = 0.0;
        for i in 0..part.elements {
            // Compression and tension in turn, from what stays elastic to what only iteration follows.
            let size = 0.12 * ((step * 7 + i * 5) % 29) as f64 / 29.0;
            let strain = size * if step % 4 < 2 { -1.0 } else { 1.0 };
            state.nodes.position[i] = position;
            // Some stand still, and keep their distances, beside what moves.
            let stands = |i: usize| step > 0 && (step + i / 5).is_multiple_of(3);
            state.nodes.velocity[i] = if stands(i) { 0.0 } else { strain * 1e3 };
            let one = alone.get(i);
            position += if stands(i) && stands(i + 1) {
                one.length
            } else {
                // Sums of such numbers are exact.
                (one.rest_length * (1.0 + strain) * EXACT).round() / EXACT
            };
        }
        let new = || Found {
            stable_step: f64::INFINITY,
            fastest: 0.0,
            largest_strain: 0.0,
        };
        let (mut together, mut apart) = (new(), new());
        let mut drift = SegmentDrift {
            blocks: state.elements.blocks_mut(),
            nodes: &state.nodes,
            shift: 0,
            elements: 3..22,
            working: &mut state.working,
            part,
            control: &control,
            time_step: TIME_STEP,
        };
        let borne = match part.kinematics {
            Kinematics::Logarithmic => drift.bear::<false>(&mut together),
            Kinematics::SmallStrain => drift.bear::<true>(&mut together),
        };
        assert!(borne.is_ok());
        drift.flow(&law);
        drift.settle(&mut sums[0][0], &mut together);
        for e in 3..22 {
            let drift = ElementDrift {
                ends: [0, 1].map(|side| state.nodes.at(e + side)),
                part,
                time_step: TIME_STEP,
                limit: None,
            };
            let work = alone.change(e, |element| drift.alone(element, &control, &mut apart));
            sums[1][0] += work.unwrap();
        }
        for (sums, found) in sums.iter_mut().zip([&together, &apart]) {
            sums[1] = found.stable_step;
            sums[2] = found.fastest + found.largest_strain;
        }
        assert_eq!(sums[0].map(f64::to_bits), sums[1].map(f64::to_bits));
        for e in 0..state.elements.len() {
            let (one, other) = (state.elements.get(e), alone.get(e));
            assert_eq!(bits(&one), bits(&other), "step {step}: {one:?} {other:?}");
            flowed += usize::from(one.plastic.step != 0.0);
            iterated += usize::from(one.plastic.step.abs() > 0.08);
        }
    }
    assert!(
        flowed > 300 && iterated > 30,
        "{metal}: {flowed} {iterated}"
    );
}
