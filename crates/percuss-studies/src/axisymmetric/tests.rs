use std::ops::ControlFlow;

use super::*;
use crate::case;

const CELLS: [f64; 3] = [3.0, 4.0, 6.0];

fn meshes(values: &[f64]) -> Vec<OnMesh> {
    let cells = CELLS.iter().zip(values);
    cells
        .map(|(&cells, &value)| OnMesh { cells, value })
        .collect()
}

fn of_order(order: f64) -> MeshLimit {
    let value = |cells: f64| 2.0 - 0.8 * cells.powf(-order);
    limit(&meshes(&CELLS.map(value)), 0.0, 0.0).unwrap()
}

#[test]
fn a_power_of_the_cell_size_gives_its_limit() {
    for order in [1.0, 1.5, 2.0] {
        let limit = of_order(order);
        assert!((limit.value - 2.0).abs() < 1e-9, "{order}: {limit:?}");
        assert!((limit.order.unwrap() - order).abs() < 1e-6);
        // With the factor of safety of three meshes, 5/4.
        let error = 1.25 * 0.8 * 6.0_f64.powf(-order);
        assert!(limit.uncertainty >= error.max(0.02) - 1e-12, "{limit:?}");
    }
    // Above the order of the scheme the true limit is missed, and the interval holds it.
    let limit = of_order(2.8);
    assert!((limit.value - 2.0).abs() < limit.uncertainty);
    assert!((limit.value - 2.0).abs() > 1e-4);
}

#[test]
fn low_orders_are_not_extrapolated_and_the_interval_holds_their_limit() {
    let found = of_order(0.6);
    let error = 0.8 * 6.0_f64.powf(-0.6);
    assert_eq!((found.value, found.order), (2.0 - error, None));
    assert!((found.uncertainty - error).abs() < 1e-9, "{found:?}");
}

#[test]
fn orders_that_are_not_credible_are_not_extrapolated() {
    for order in [0.2, 4.0] {
        let found = of_order(order);
        let finest = 2.0 - 0.8 * 6.0_f64.powf(-order);
        assert_eq!((found.value, found.order), (finest, None));
    }
}

#[test]
fn values_that_are_not_monotone_are_not_extrapolated() {
    for values in [[1.0, 1.2, 1.1], [1.0, 1.1, 1.3], [1.2, 1.0, 1.3]] {
        let found = limit(&meshes(&values), 0.0, 0.0).unwrap();
        assert_eq!((found.value, found.order), (values[2], None));
        let spread = values.iter().fold(0.0, |most: f64, a| {
            values.iter().fold(most, |most, b| most.max(a - b))
        });
        assert!(found.uncertainty >= spread - 1e-12, "{found:?}");
        // Two thirds of the cells: an error of first order is twice the difference.
        assert!(found.uncertainty >= 2.0 * (values[2] - values[1]).abs() - 1e-12);
    }
}

#[test]
fn equal_values_keep_the_least_uncertainty() {
    let depth = limit(&meshes(&[2.0; 3]), 0.0, 0.0).unwrap();
    assert_eq!((depth.value, depth.order), (2.0, None));
    assert!((depth.uncertainty - 0.02).abs() < 1e-12);
    // Of a rod that is 10 % shorter, 1 % of the shortening.
    let length = limit(&meshes(&[18.0; 3]), 20.0, 0.0).unwrap();
    assert!((length.uncertainty - 0.02).abs() < 1e-12);
    // A dent that is shallower than a cell is known to the resolution of the mesh.
    let dent = limit(&meshes(&[0.1; 3]), 0.0, 0.05).unwrap();
    assert_eq!(dent.uncertainty, 0.05);
}

#[test]
fn depths_are_resolved_to_a_part_that_falls_with_the_cell_size() {
    // Deep craters on 6 and 12 cells; a dent to a part of a cell.
    assert!((depth_resolution(10.0, 5.0, 6.0) - 0.5).abs() < 1e-12);
    assert!((depth_resolution(10.0, 5.0, 12.0) - 0.25).abs() < 1e-12);
    assert!((depth_resolution(0.1, 5.0, 8.0) - 0.08 * 2.5 / 8.0).abs() < 1e-12);
}

#[test]
fn two_meshes_have_a_wide_uncertainty_and_one_has_none() {
    let found = limit(&meshes(&[1.0, 1.1]), 0.0, 0.0).unwrap();
    assert_eq!((found.value, found.order), (1.1, None));
    assert!((found.uncertainty - 0.3).abs() < 1e-9, "{found:?}");
    assert_eq!(limit(&meshes(&[1.0]), 0.0, 0.0), None);
}

fn scenario(text: &str) -> Scenario {
    case::load_str("case", text).unwrap()
}

const BALL: &str = "projectile = { material = 'copper', length = '5 mm', diameter = '5 mm', impact_velocity = '300 m/s' }\n\
                    target = { material = 'aluminium-2024-t351', thickness = '25 mm' }\n\
                    axi = { target_radius = '8 mm', target_depth = '8 mm' }\n";
const WALL: &str = "projectile = { material = 'ofhc-copper', length = '10 mm', diameter = '5 mm', impact_velocity = '180 m/s' }\n\
                    target = { rigid_wall = true }\n";

fn compute(text: &str) -> AxisymmetricAnswer {
    let scenario = scenario(text);
    let plan = plan(&scenario, ReferenceMeshes::Standard, Some(BUDGET)).unwrap();
    answer(&scenario, &plan, &mut |_| ControlFlow::Continue(())).unwrap()
}

#[test]
fn the_answer_is_the_limit_of_runs_of_the_model() {
    let found = compute(BALL);
    assert_eq!(found.quantity, Some(BandQuantity::DepthOfPenetration));
    assert_eq!(found.value, found.depth_of_penetration_mm);
    let cells: Vec<u32> = found.meshes.iter().map(|m| m.cells_per_radius).collect();
    assert_eq!(cells, ReferenceMeshes::Standard.cells());
    let mut alone = scenario(BALL);
    alone.options.axi.cells_per_radius = Some(4);
    let axi = model::model(MODEL).unwrap();
    let run = model::run(axi, &alone, &mut Control::default()).unwrap();
    assert_eq!(found.meshes[1], MeshResult::new(4, &run));
    let depths: Vec<f64> = found
        .meshes
        .iter()
        .filter_map(|mesh| mesh.depth_of_penetration_mm)
        .collect();
    // Eight hundredths of a cell, of six in the radius, and a twentieth of the depth.
    let least = (0.08 * 2.5 / 6.0_f64).max(0.05 * depths[2]);
    let own = limit(&meshes(&depths), 0.0, least).unwrap();
    assert_eq!((found.value, found.order), (Some(own.value), own.order));
    assert!((found.uncertainty.unwrap() - own.uncertainty).abs() < 1e-12);
}

#[test]
fn on_a_rigid_wall_the_final_length_is_the_main_number() {
    let found = compute(WALL);
    assert_eq!(found.quantity, Some(BandQuantity::ProjectileFinalLength));
    assert_eq!(found.depth_of_penetration_mm, None);
    let (length, off) = (found.value.unwrap(), found.uncertainty.unwrap());
    assert!(length < 9.5 && length > 5.0, "{length}");
    assert!(off >= 0.01 * (10.0 - length) && off < 0.1 * length, "{off}");
}

#[test]
fn meshes_that_disagree_on_perforation_have_no_uncertainty() {
    let held = scenario(BALL);
    let mut scenario = held.clone();
    if let TargetBody::Layers { back_face, .. } = &mut scenario.target {
        *back_face = RearFaceCondition::Free;
    }
    let mesh = |cells_per_radius, outcome, depth, velocity| MeshResult {
        cells_per_radius,
        outcome,
        depth_of_penetration_mm: depth,
        residual_velocity_m_s: Some(velocity),
        projectile_final_length_mm: Some(4.0),
        steps: None,
        energy_residual: None,
    };
    let through = mesh(6, Outcome::Perforated, None, 40.0);
    let stopped = mesh(4, Outcome::AtRest, Some(9.0), 0.0);
    let of = |meshes| AxisymmetricAnswer::of(&scenario, ReferenceMeshes::Standard, meshes, &[]);
    let mixed = of(vec![
        mesh(3, Outcome::AtRest, Some(8.0), 0.0),
        stopped,
        through,
    ]);
    assert_eq!(mixed.quantity, Some(BandQuantity::ResidualVelocity));
    assert_eq!((mixed.value, mixed.uncertainty), (Some(40.0), None));
    let doubt = mixed.doubt.unwrap();
    assert!(
        doubt.starts_with("the meshes differ in their outcome; `percuss run --reference fine`"),
        "{doubt}"
    );
    // What has passed a fixed rear face is no result.
    let meshes = vec![stopped, through];
    let refused = AxisymmetricAnswer::of(&held, ReferenceMeshes::Standard, meshes, &[]);
    assert_eq!((refused.quantity, refused.value), (None, None));
    assert!(refused.reason.unwrap().contains("`back_face = \"free\"`"));
    let all = of(vec![mesh(4, Outcome::Perforated, None, 50.0), through]);
    assert!(all.uncertainty.unwrap() >= 20.0);
    assert_eq!(all.depth_of_penetration_mm, None);
    assert!(all.doubt.unwrap().contains("50 % of the number"));
    // Meshes of one outcome that are far apart.
    let depth = |cells, depth| mesh(cells, Outcome::AtRest, Some(depth), 0.0);
    let apart = of(vec![depth(3, 6.1), depth(4, 5.9), depth(6, 20.1)]);
    assert!(apart.uncertainty.unwrap() > apart.value.unwrap());
    assert!(apart.doubt.unwrap().contains("larger"));
    let rough = of(vec![depth(3, 5.0), depth(4, 6.0), depth(6, 8.0)]);
    assert!(
        rough.doubt.as_ref().unwrap().contains(" % of the number"),
        "{rough:?}"
    );
    assert_eq!(rough.remark(), rough.doubt.as_deref());
    assert_eq!(
        of(vec![depth(3, 5.0), depth(4, 5.1), depth(6, 5.2)]).doubt,
        None
    );
}

/// Blunt steel on a steel plate, with its rear face where it is given.
fn blunt(velocity: f64, plate: &str) -> Scenario {
    let text = format!(
        "projectile = {{ material = 'tool-steel-hrc53', mass = '197 g', diameter = '20 mm', impact_velocity = '{velocity} m/s' }}\n\
         target = {{ material = 'weldox-460-e', thickness = '12 mm'{plate} }}"
    );
    case::load_str("blunt", &text).unwrap()
}

#[test]
fn what_another_first_choice_perforates_is_doubted() {
    let doubt = |scenario: &Scenario, outcome, velocity| {
        let mesh = |cells_per_radius| MeshResult {
            cells_per_radius,
            outcome,
            depth_of_penetration_mm: Some(4.0),
            residual_velocity_m_s: Some(velocity),
            projectile_final_length_mm: None,
            steps: None,
            energy_residual: None,
        };
        let meshes = vec![mesh(4), mesh(6)];
        AxisymmetricAnswer::of(scenario, ReferenceMeshes::Standard, meshes, &[]).doubt
    };
    let held = doubt(&blunt(300.0, ""), Outcome::Rebounded, -2.0).unwrap();
    assert!(
        held.contains("`power_balance` perforates the plate"),
        "{held}"
    );
    // Who writes that it is fixed means it; slow impacts are stopped either way.
    let fixed = blunt(300.0, ", back_face = 'fixed'");
    assert_eq!(doubt(&fixed, Outcome::Rebounded, -2.0), None);
    assert_eq!(doubt(&blunt(100.0, ""), Outcome::Rebounded, -2.0), None);
    // A plate that cannot fail takes too much energy.
    let mut free = blunt(300.0, ", back_face = 'free'");
    assert_eq!(doubt(&free, Outcome::Perforated, 150.0), None);
    let TargetBody::Layers { layers, .. } = &mut free.target else {
        panic!("no plate");
    };
    let mut ductile = (*layers[0].material).clone();
    ductile.damage = None;
    layers[0].material = ductile.into();
    let said = doubt(&free, Outcome::Perforated, 150.0).unwrap();
    assert!(
        said.contains("has no `damage`") && said.contains("`power_balance`"),
        "{said}"
    );
}

#[test]
fn a_case_that_the_model_does_not_take_has_the_reason() {
    let oblique = BALL.replace("'300 m/s' }", "'300 m/s', obliquity = '30 deg' }");
    for text in [
        oblique.as_str(),
        "projectile = { material = 'copper', length = '5 mm', diameter = '5 mm', impact_velocity = '300 m/s' }\n\
         target = { constant_pressure = '2 GPa' }\n",
    ] {
        let scenario = scenario(text);
        let axi = model::model(MODEL).unwrap();
        let refused = model::applicability(axi, &scenario).unwrap_err();
        let plan = plan(&scenario, ReferenceMeshes::Fine, None);
        assert_eq!(plan, Err(refused));
    }
}

#[test]
fn a_long_case_is_shortened_or_left_out_unless_it_is_asked_for() {
    let long = |length: u32| {
        scenario(&format!(
            "projectile = {{ material = '4340', length = '{length} mm', diameter = '5 mm', impact_velocity = '1500 m/s' }}\n\
             target = {{ material = '6061-t6', thickness = 'semi-infinite' }}\n"
        ))
    };
    let standard = |length, budget| plan(&long(length), ReferenceMeshes::Standard, budget);
    let cost = |cells: &[u32]| {
        let costs = cells.iter().map(|&cells| seconds(&long(100), cells));
        costs.sum::<f64>()
    };
    assert_eq!(standard(100, None).unwrap().cells, [3, 4, 6]);
    let enough = standard(100, Some(1.01 * cost(&[3, 4, 6]))).unwrap();
    assert_eq!((enough.cells.len(), enough.note), (3, None));
    let two = standard(100, Some(0.99 * cost(&[3, 4, 6]))).unwrap();
    assert_eq!(two.cells, [3, 4]);
    let note = two.note.unwrap();
    assert!(
        note.contains("mesh of 6 cells is left out") && note.contains("`--reference standard`")
    );
    let none = standard(100, Some(0.99 * cost(&[3, 4]))).unwrap_err();
    assert!(
        none.to_string()
            .contains("of processor time; `--reference standard`")
    );
    // An ordinary case is within the budget.
    let short = plan(&long(15), ReferenceMeshes::Standard, Some(BUDGET)).unwrap();
    assert_eq!(short.cells.len(), 3);
}

#[test]
fn the_caller_can_stop_the_runs() {
    let scenario = scenario(BALL);
    let plan = plan(&scenario, ReferenceMeshes::Standard, None).unwrap();
    let mut calls = 0;
    let stopped = answer(&scenario, &plan, &mut |fraction| {
        assert!((0.0..=1.0).contains(&fraction));
        calls += 1;
        ControlFlow::Break(())
    });
    assert!(matches!(stopped, Err(Error::Cancelled { .. })));
    // Each run reports once at most before it stops.
    assert!((1..=3).contains(&calls), "{calls}");
}

/// Meshes that each fit into the limit of the memory are refused where they do not fit side by side.
#[test]
fn meshes_count_together_against_the_memory() {
    let text = r#"
        projectile = { material = "copper", length = "5 mm", diameter = "5 mm", impact_velocity = "200 m/s" }
        target = { rigid_wall = true }
    "#;
    let mut scenario = case::load_str("long rod", text).unwrap();
    let axi = model::model("axi").unwrap();
    let memory =
        |scenario: &Scenario, cells: u32| axi.estimate(&plan::on_cells(scenario, cells)).memory;
    let limit = model::memory::memory_limit() as f64;
    scenario.projectile.length *= 0.8 * limit / memory(&scenario, 6);
    assert!(memory(&scenario, 6) < limit);
    let reason = plan(&scenario, ReferenceMeshes::Standard, None).unwrap_err();
    assert!(
        reason
            .to_string()
            .contains("of memory, more than the limit"),
        "{reason}"
    );
}
