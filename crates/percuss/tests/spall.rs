//! Pull-back of the free surface of a plate that spalls.
//!
//! A crack at the tension σ_s ends the slowing down of the free surface. The pull-back Δu is the largest velocity of that surface less the
//! smallest one after it. Where the release that pulls is a ramp, the plate is in tension up to σ_s for some time and the exact elastic
//! pull-back is `2σ_s/(ρ c_l)`. Where the release is a step, the tension that passes the plane before the crack lasts no longer than the
//! front of the step is wide, here a few cells: it dies out on its way to the surface.

use crate::common::assert_near;
use percuss::{
    fdm::planar::{Boundary, Layer, Medium, PlanarGrid, Solid, StateEquation},
    options::FdmOptions,
};

const DENSITY: f64 = 2700.0;
const BULK: f64 = 5300.0;
const SHEAR: f64 = 27e9;

/// Wave speed in uniaxial strain.
fn longitudinal() -> f64 {
    (BULK * BULK + 4.0 / 3.0 * SHEAR / DENSITY).sqrt()
}

fn medium(strength: Option<&str>, spall_strength: f64) -> Medium {
    let solid = strength.map(|strength| Solid {
        shear_modulus: SHEAR,
        material: toml::from_str(&format!(
            "name = 'a'\ndensity = '2700 kg/m3'\nyoungs_modulus = '72 GPa'\npoissons_ratio = 0.33\nstrength.{strength}"
        ))
        .unwrap(),
    });
    Medium {
        state: StateEquation::MieGruneisen {
            density: DENSITY,
            sound_speed: BULK,
            slope: 1.4,
            gruneisen: 2.0,
        },
        density: DENSITY,
        energy: 0.0,
        solid,
        spall_strength: Some(spall_strength),
    }
}

/// A layer [mm] of a medium at a velocity, its impedance a part of the medium's at the same wave speed.
fn layer(medium: &Medium, thickness: f64, velocity: f64, part: f64, cells_per_mm: usize) -> Layer {
    let mut medium = medium.clone();
    medium.density *= part;
    if let StateEquation::MieGruneisen { density, .. } = &mut medium.state {
        *density *= part;
    }
    if let Some(solid) = &mut medium.solid {
        solid.shear_modulus *= part;
    }
    if part < 1.0 {
        medium.spall_strength = None;
    }
    Layer {
        medium,
        thickness: thickness * 1e-3,
        cells: (thickness * cells_per_mm as f64).round() as usize,
        velocity,
    }
}

/// Release of the flyer: as steep as the mesh, or spread by layers of falling impedance behind it.
#[derive(Clone, Copy, PartialEq)]
enum Release {
    Steep,
    Ramp,
}

/// Pull-back of the free surface of a plate of 6 mm that a flyer of 2 mm strikes [m/s], and the first spall.
fn pull_back(
    medium: &Medium,
    release: Release,
    velocity: f64,
    cells_per_mm: usize,
) -> (f64, Option<(f64, f64)>) {
    let mut layers = vec![
        layer(medium, 2.0, velocity, 1.0, cells_per_mm),
        layer(medium, 6.0, 0.0, 1.0, cells_per_mm),
    ];
    if release == Release::Ramp {
        for i in 1..40 {
            let part = 1.0 - f64::from(i) / 40.0;
            layers.insert(0, layer(medium, 0.1, velocity, part, cells_per_mm));
        }
    }
    let mut column = PlanarGrid::new(
        &layers,
        [Boundary::Free, Boundary::Free],
        FdmOptions::PLANAR_VISCOSITY,
        0.7,
    );
    let end = 20e-3 / BULK;
    let (mut largest, mut smallest) = (0.0, 0.0);
    while column.time() < end * (1.0 - 1e-12) {
        column.step(end).unwrap();
        let speed = column.end_velocities().1;
        if speed > largest {
            (largest, smallest) = (speed, speed);
        }
        smallest = f64::min(smallest, speed);
    }
    let spall = column.spalls().first().copied();
    (largest - smallest, spall)
}

/// Elastic pull-back of a tension: the surface doubles the velocity of the wave.
fn exact(stress: f64, wave_speed: f64) -> f64 {
    2.0 * stress / (DENSITY * wave_speed)
}

/// Parts of the exact pull-back on three meshes, which must rise to it.
fn approach(what: &str, medium: &Medium, velocity: f64, exact: f64) -> [f64; 3] {
    let parts = [50, 100, 200].map(|cells| {
        let (pull_back, spall) = pull_back(medium, Release::Ramp, velocity, cells);
        assert!(spall.is_some());
        pull_back / exact
    });
    println!("{what}: parts of the exact pull-back {parts:.4?}");
    assert!(
        parts[0] < parts[1] && parts[1] < parts[2],
        "{what}: {parts:?}"
    );
    parts
}

/// Impact of two elastic plates at 20 m/s: the pulse has ½ρ c_l V. The crest of the ramp is rounded over the width of a front.
#[test]
fn elastic_pull_back_behind_a_ramp() {
    let pulse = 0.5 * DENSITY * longitudinal() * 20.0;
    for part in [0.3, 0.5] {
        let elastic = medium(Some("elastic = {}"), part * pulse);
        let what = format!("elastic, spall strength {part} of the pulse");
        let parts = approach(&what, &elastic, 20.0, exact(part * pulse, longitudinal()));
        assert_near(&what, parts[2], 1.0, 0.07);
    }
}

/// A fluid has one wave speed: what strength does to the pull-back is not in it.
#[test]
fn fluid_pull_back_behind_a_ramp() {
    let fluid = medium(None, 1e9);
    let parts = approach("fluid, 1 GPa", &fluid, 300.0, exact(1e9, BULK));
    assert_near("fluid, 1 GPa", parts[2], 1.0, 0.08);
}

/// A plate that just holds: the whole pulse is unloaded, and the exact pull-back of its tension is the impact velocity. A steep release
/// overshoots by a part that the mesh does not change.
#[test]
fn elastic_pull_back_of_a_plate_that_holds() {
    let pulse = 0.5 * DENSITY * longitudinal() * 20.0;
    for cells in [50, 100] {
        let elastic = medium(Some("elastic = {}"), 1.05 * pulse);
        let (found, spall) = pull_back(&elastic, Release::Steep, 20.0, cells);
        assert_eq!(spall, None);
        assert_near("pull-back [m/s]", found, exact(pulse, longitudinal()), 0.05);
    }
}

/// Behind a step the same plate shows less than half of the exact pull-back, on every mesh: the tension that passes is as short as the
/// front is wide. No spall strength follows from it.
#[test]
fn elastic_pull_back_behind_a_step_is_no_measure_of_the_spall_strength() {
    let stress = 0.25 * DENSITY * longitudinal() * 20.0;
    let elastic = medium(Some("elastic = {}"), stress);
    for cells in [50, 100, 200] {
        let (found, spall) = pull_back(&elastic, Release::Steep, 20.0, cells);
        assert!(spall.is_some());
        let part = found / exact(stress, longitudinal());
        println!("step, {cells} cells per mm: part of the exact pull-back {part:.3}");
        assert!((0.3..0.45).contains(&part), "{part}");
    }
}

/// Plastic tension runs at the bulk speed to the surface, where it comes back as elastic compression: `σ_s (1/c_b + 1/c_l)/ρ` without
/// attenuation. The compression from the crack runs at c_l, overtakes the tension and takes some more of it. So the elastic relation
/// understates the spall strength, and a steep release does more so, by an amount that depends on the mesh.
#[test]
fn plastic_flow_and_a_steep_release_reduce_the_pull_back() {
    let (stress, speed) = (1e9, longitudinal());
    let unattenuated = stress / DENSITY * (1.0 / BULK + 1.0 / speed);
    for flow_stress in [100, 300] {
        let law = format!("perfectly_plastic = {{ flow_stress = '{flow_stress} MPa' }}");
        let plastic = medium(Some(&law), stress);
        for velocity in [300.0, 500.0] {
            let part = |release| {
                let meshes = [50, 100];
                meshes.map(|cells| pull_back(&plastic, release, velocity, cells).0 / unattenuated)
            };
            let (ramp, steep) = (part(Release::Ramp), part(Release::Steep));
            println!("Y = {flow_stress} MPa, {velocity} m/s: ramp {ramp:.3?}, steep {steep:.3?}");
            assert!(
                ramp.iter().all(|part| (0.8..0.95).contains(part)),
                "{ramp:?}"
            );
            assert!((ramp[1] / ramp[0] - 1.0).abs() < 0.05, "{ramp:?}");
            assert!(
                steep.iter().all(|part| (0.35..0.7).contains(part)),
                "{steep:?}"
            );
            assert!(steep[1] < 0.98 * steep[0], "{steep:?}");
        }
    }
}
