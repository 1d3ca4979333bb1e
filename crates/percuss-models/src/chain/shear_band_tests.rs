//! Single shear band at a prescribed velocity.

use super::{
    super::{adiabatic::Sheared, band_law::Failure, shear_zone::SQRT_3, state::Node},
    *,
};
use crate::{Refusal, case, scenario::TargetBody};

const SPEED: f64 = 100.0;
const LENGTH: f64 = 0.002;
const PERIMETER: f64 = 0.06;

fn law(chain: &str) -> Result<BandLaw, Refusal> {
    law_of("weldox-460-e", chain, "")
}

/// The law of a plate, with materials of its own.
fn law_of(plate: &str, chain: &str, materials: &str) -> Result<BandLaw, Refusal> {
    let scenario = case::load_str(
        "band",
        &format!(
            r#"
            projectile = {{ material = "tool-steel-hrc53", mass = "197 g", diameter = "20 mm", impact_velocity = "{SPEED} m/s" }}
            target = {{ material = "{plate}", thickness = "12 mm", back_face = "free" }}
            [chain]
            border_shear_law = "shear-band"
            {chain}
            {materials}
            "#
        ),
    )
    .unwrap_or_else(|error| panic!("{error}"));
    let TargetBody::Layers { layers, .. } = &scenario.target else {
        panic!("no plate");
    };
    BandLaw::new(&layers[0], 0.01, SPEED, &scenario.options.chain)
}

/// Slides a node at a constant speed until its band has ended; returns the bands, the work of the force, and stresses against slips.
fn slide(law: BandLaw, back: f64) -> (Bands, f64, Vec<[f64; 2]>) {
    let mut bands = Bands::new(vec![law], PERIMETER, back);
    bands.hold(0, 0.0, [0.0, LENGTH], 0);
    let mut nodes = Nodes::default();
    let node = Node {
        mass: 1.0,
        velocity: SPEED,
        ..Node::default()
    };
    nodes.insert(0, node);
    let step = 2e-9;
    let (mut work, mut time, mut curve) = (0.0, 0.0, Vec::new());
    while bands.hold_any() && time < 1e-3 {
        nodes.force[0] = 0.0;
        let force = bands.pull(&mut nodes);
        assert_eq!(nodes.force[0], -force);
        work += force * SPEED * step;
        let stress = bands.bands[0].stress;
        curve.push([nodes.position[0], stress]);
        nodes.position[0] += SPEED * step;
        time += step;
        bands.update(&nodes, 0.0, step, time);
    }
    (bands, work, curve)
}

#[test]
fn its_energy_is_the_integral_of_its_stress_over_slip_and_area() {
    for (chain, back) in [
        ("", 0.1),
        ("shear_band = { failure = \"instability\" }", 0.1),
        ("shear_band = { failure = \"never\" }", LENGTH),
        (
            "shear_band = { width = \"0.2 mm\", failure_strain = 3.0 }",
            0.1,
        ),
    ] {
        let law = law(chain).unwrap();
        let (bands, work, curve) = slide(law, back);
        let integral: f64 = curve
            .windows(2)
            .map(|pair| {
                let slip = 0.5 * (pair[0][0] + pair[1][0]);
                let held = if back < 0.1 { LENGTH - slip } else { LENGTH };
                let stress = 0.5 * (pair[0][1] + pair[1][1]);
                stress * PERIMETER * held * (pair[1][0] - pair[0][0])
            })
            .sum();
        println!(
            "{chain}: {:.5} J, integral {integral:.5}, by force {work:.5}",
            bands.accumulated.work
        );
        assert!((bands.accumulated.work / integral - 1.0).abs() < 1e-3);
        assert!((work / integral - 1.0).abs() < 1e-3);
        assert!(bands.accumulated.last_end.is_some());
    }
}

/// At a constant rate an even band follows the adiabatic curve, and is strongest where that curve is.
#[test]
fn its_stress_is_largest_at_the_instability() {
    let width = 0.65e-3;
    let law = law("shear_band = { width = \"0.65 mm\", failure = \"never\" }").unwrap();
    let sheared = Sheared {
        strength: &*law.strength,
        heating: law.heating,
        temperature: law.start_temperature,
        rate_effects: true,
    };
    let strain = SQRT_3 * sheared.instability(width, SPEED).unwrap();
    let (_, _, curve) = slide(law, LENGTH);
    let largest = curve.iter().max_by(|a, b| a[1].total_cmp(&b[1])).unwrap();
    println!(
        "largest {:.1} MPa at {:.4}, instability {strain:.4}",
        largest[1] * 1e-6,
        largest[0] / width
    );
    assert!(
        (largest[0] / width / strain - 1.0).abs() < 0.01,
        "{largest:?} {strain}"
    );
}

/// A zone is strongest, and fails, at the slip that it gives to the strain of its rim.
#[test]
fn a_zone_slips_as_its_rim_strains() {
    let law = law("shear_band = { failure = \"instability\" }").unwrap();
    let Failure::Strain(strain) = law.failure else {
        panic!("{:?}", law.failure)
    };
    let slip = SQRT_3 * strain * law.spread.mean_width();
    let (bands, _, curve) = slide(law, 0.1);
    let largest = curve.iter().max_by(|a, b| a[1].total_cmp(&b[1])).unwrap();
    let last = bands.accumulated.largest_slip;
    // The elastic slip comes on top, and the maximum is flat.
    assert!((last / slip - 1.0).abs() < 0.03, "{last} {slip}");
    assert!(largest[0] > 0.9 * last, "{largest:?} {last}");
}

/// Perfectly plastic and of one strength: the work is τ A γ w whatever the width, so that the width is the length scale.
#[test]
fn a_constant_strength_takes_its_work() {
    for width in [0.1e-3, 1e-3] {
        let chain = format!(
            "shear_band = {{ width = \"{} mm\", shear_strength = \"400 MPa\", failure_strain = 1.5 }}",
            width * 1e3
        );
        let (bands, ..) = slide(law(&chain).unwrap(), 0.1);
        let exact = 400e6 * PERIMETER * LENGTH * 1.5 * width;
        // What the band stores before it fails comes on top.
        assert!(
            (bands.accumulated.work / exact - 1.0).abs() < 5e-3,
            "{width}"
        );
    }
}

/// Where a plug parts, both ends together hold what the node held; the end ahead has left the plate first.
/// Damage sees the rate where strength does: without rate effects its rate constant changes nothing.
#[test]
fn damage_sees_the_rate_where_strength_does() {
    let slip_at_end = |d4: f64, rate_effects: bool| {
        let chain = format!("rate_effects = {rate_effects}\nshear_band = {{ width = '0.2 mm' }}");
        let plate = format!(
            r#"
            [materials.plate]
            density = "7850 kg/m3"
            youngs_modulus = "200 GPa"
            poissons_ratio = 0.33
            strength.perfectly_plastic = {{ flow_stress = "600 MPa" }}
            damage = {{ d1 = 0.3, d2 = 0.2, d3 = -1.5, d4 = {d4} }}
            "#
        );
        let law = law_of("plate", &chain, &plate).unwrap();
        assert!(matches!(law.failure, Failure::Damage(_)));
        let [slip, _] = *slide(law, 1.0).2.last().unwrap();
        slip
    };
    let steady = slip_at_end(0.0, false);
    assert_eq!(slip_at_end(0.1, false), steady);
    assert_eq!(slip_at_end(0.0, true), steady);
    // The rate is that of the slip over the width, and the failure strain grows with its logarithm.
    let rate: f64 = SPEED / (SQRT_3 * 2e-4);
    let grown = slip_at_end(0.1, true) / steady;
    assert!(
        (grown / (1.0 + 0.1 * rate.ln()) - 1.0).abs() < 0.02,
        "{grown}"
    );
}

#[test]
fn a_band_is_shared_where_the_plug_parts() {
    let layer = law("shear_band = { failure = \"never\" }").unwrap();
    let mut bands = Bands::new(vec![layer], PERIMETER, 0.004);
    bands.hold(3, 0.0, [0.0, 0.0005], 0);
    bands.hold(4, 0.001, [0.0005, 0.002], 0);
    bands.hold(5, 0.004, [0.002, 0.004], 0);
    // The whole plug has slid by 2.4 mm: 0.4 mm of what belongs to the node in the middle has left the plate.
    let mut nodes = Nodes::default();
    for i in 0..6 {
        nodes.insert(i, Node::default());
    }
    for (position, rest) in nodes.position[3..].iter_mut().zip([0.0, 0.001, 0.004]) {
        *position = rest + 0.0024;
    }
    // Energy is that between two steps.
    bands.update(&nodes, 0.0, 1e-6, 1e-6);
    bands.update(&nodes, 0.0, 1e-6, 2e-6);
    let (energy, work) = (bands.elastic_energy(), bands.accumulated.work);
    let force = bands.pull(&mut nodes);
    bands.part(4);
    nodes.insert(5, nodes.at(4));

    let keys: Vec<usize> = bands.bands.iter().map(|band| band.node).collect();
    assert_eq!(keys, [3, 4, 5, 6]);
    let close = |a: f64, b: f64| (a - b).abs() < 1e-12;
    let [behind, ahead] = [1, 2].map(|i| bands.bands[i]);
    assert!(close(behind.length, 0.0005) && close(behind.held, 0.0005));
    assert!(close(ahead.length, 0.001) && close(ahead.held, 0.0006));
    assert!(close(behind.offset, -0.00025) && close(ahead.offset, 0.0005));
    assert!((bands.elastic_energy() / energy - 1.0).abs() < 1e-12);
    assert!(energy > 0.0);
    assert!((bands.pull(&mut nodes) / force - 1.0).abs() < 1e-12);
    // Nothing is ejected that was not about to leave anyway.
    bands.update(&nodes, 0.0, 1e-6, 3e-6);
    assert!(close(bands.bands[1].held + bands.bands[2].held, 0.0011));
    assert!(close(bands.bands[2].held, 0.0006));
    assert!(bands.accumulated.work >= work);
}
