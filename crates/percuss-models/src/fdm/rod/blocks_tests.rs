use super::super::{
    cell::{RodCell, RodCells},
    mesh,
};
use crate::{
    case,
    fdm::grid::{Cells, Law, Motions, load_one_by_one, stable_step_one_by_one},
    lanes::LANES,
    options::ArtificialViscosity,
};

/// Everything that a load changes; 0 and −0 are one.
fn bits(cell: &RodCell) -> [u64; 12] {
    [
        cell.elastic.length,
        cell.elastic.strain,
        cell.elastic.stress,
        cell.elastic.stress_before,
        cell.plastic.axial,
        cell.plastic.step,
        cell.plastic.strain,
        cell.plastic.largest_rate,
        cell.plastic.temperature,
        cell.viscous_pressure,
        cell.yield_point.stress(),
        cell.plastic_work,
    ]
    .map(|number| (number + 0.0).to_bits())
}

#[test]
fn cells_in_blocks_have_the_bits_of_each_by_itself() {
    for metal in [
        "copper-woodward",
        "ofhc-copper-johnson-cook",
        "tungsten-alloy-steinberg",
    ] {
        for viscosity in [0.0, 0.2] {
            load_both_ways(metal, viscosity);
        }
    }
}

/// Loads 27 cells of a projectile and 5 of a target, which share a block, in turns of compression and tension.
fn load_both_ways(metal: &str, viscosity: f64) {
    let text = format!(
        "projectile = {{ material = '{metal}', length = '12.74 mm', diameter = '4.8 mm', impact_velocity = '200 m/s' }}\n\
         target = {{ material = 'aluminium-2024-t351', thickness = '25 mm' }}\n\
         [fdm]\nprojectile_elements = 27\ntarget_elements = 5\n"
    );
    let scenario = case::load_str("rod", &text).unwrap_or_else(|error| panic!("{error}"));
    let options = scenario.options.fdm.of_rod(&scenario.options.chain);
    let mut grid = mesh::build(&scenario, &options);
    for law in &mut grid.bodies {
        law.viscosity = ArtificialViscosity {
            linear: viscosity,
            quadratic: viscosity,
        };
    }
    let count = grid.cells.count();
    let mut alone = RodCells::default();
    let cells = (0..count).map(|c| grid.cells.get(c));
    cells.for_each(|cell| alone.add(cell));
    let rest: Vec<f64> = (0..count).map(|c| alone.get(c).rest_length()).collect();
    let mut flowed = 0;
    for step in 0..60 {
        let mut lengths = vec![1.0; count.next_multiple_of(LANES)];
        let mut approaches = vec![0.0; lengths.len()];
        for (c, rest) in rest.iter().enumerate() {
            let size = 0.12 * ((step * 7 + c * 5) % 29) as f64 / 29.0;
            let sign = if step % 4 < 2 { -1.0 } else { 1.0 };
            lengths[c] = rest * (1.0 + size * sign);
            approaches[c] = -300.0 * size * sign;
        }
        let motions = Motions {
            lengths: &lengths,
            approaches: &approaches,
            since_load: 1e-8,
            time_step: 1e-8,
        };
        let mut forces = [vec![0.0; lengths.len()], vec![0.0; lengths.len()]];
        let [together, apart] = &mut forces;
        for segment in &grid.segments {
            let (law, range) = (&grid.bodies[segment.body], segment.cells.clone());
            law.load_all(&mut grid.cells, range.clone(), &motions, together);
            load_one_by_one(law, &mut alone, range.clone(), &motions, apart);
            let ends = [&lengths[..], &approaches[..]];
            let steps = [
                law.stable_step_of_all(&grid.cells, range.clone(), ends),
                stable_step_one_by_one(law, &grid.cells, range, ends),
            ];
            assert_eq!(steps[0].to_bits(), steps[1].to_bits());
        }
        for c in 0..count {
            let (cell, other) = (alone.get(c), grid.cells.get(c));
            assert_eq!(
                bits(&cell),
                bits(&other),
                "step {step}, {metal}: {cell:?} {other:?}"
            );
            assert_eq!(together[c].to_bits(), apart[c].to_bits());
            flowed += usize::from(cell.plastic.step != 0.0);
        }
    }
    assert!(flowed > 300, "{flowed}");
}
