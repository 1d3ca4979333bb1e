//! Rate measure of rate-dependent laws: homogeneous flow with an exact stress.

use std::sync::Arc;

use percuss::{
    case,
    material::{FlowState, Material, Trial, YieldPoint},
};

/// A perfectly plastic metal whose strength depends on the strain rate alone: `A (1 + C ln(ε̇/ε̇₀))` with A 90 MPa, C 0.025 and ε̇₀ 1/s.
fn metal() -> Arc<Material> {
    let text = r#"
        projectile = { material = "rod", length = "20 mm", diameter = "5 mm", impact_velocity = "100 m/s" }
        target = { rigid_wall = true }
        [materials.rod]
        name = "perfectly plastic, with strain rate"
        density = "8960 kg/m3"
        youngs_modulus = "123.3 GPa"
        poissons_ratio = 0.341
        strength.johnson_cook = { a = "90 MPa", b = "0 Pa", n = 1.0, c = 0.025, m = 1.0 }
        "#;
    case::load_str("flow", text).unwrap().projectile.material
}

type Tensor = [[f64; 3]; 3];

fn contract(a: &Tensor, b: &Tensor) -> f64 {
    (0..9).map(|i| a[i / 3][i % 3] * b[i / 3][i % 3]).sum()
}

/// Stress deviator after homogeneous isochoric flow at a constant rate of deformation [1/s], in so many steps, without spin; by the return
/// that all numerical models use.
fn flow(rate: &Tensor, strain: f64, steps: u32) -> Tensor {
    let metal = metal();
    let shear = metal.youngs_modulus.si() / (2.0 * (1.0 + metal.poissons_ratio));
    let law = metal.strength.law().prepare(&metal, 1.0);
    let equivalent_rate = (2.0 / 3.0 * contract(rate, rate)).sqrt();
    let time_step = strain / equivalent_rate / f64::from(steps);
    let mut deviator = Tensor::default();
    let (mut point, mut plastic_strain) = (YieldPoint::default(), 0.0);
    for _ in 0..steps {
        for (row, rates) in deviator.iter_mut().zip(rate) {
            for (entry, rate) in row.iter_mut().zip(rates) {
                *entry += 2.0 * shear * time_step * rate;
            }
        }
        let size = (1.5 * contract(&deviator, &deviator)).sqrt();
        let state = FlowState {
            plastic_strain,
            strain_rate: 0.0,
            temperature: 293.0,
            pressure: 0.0,
        };
        let trial = Trial {
            stress: size,
            modulus: 3.0 * shear,
            pressure_fall: 0.0,
            elapsed: Some(time_step),
        };
        let increment = point.plastic_increment(&*law, &state, &trial);
        plastic_strain += increment;
        for entry in deviator.as_flattened_mut() {
            *entry *= 1.0 - 3.0 * shear * increment / size;
        }
    }
    deviator
}

/// With `ε̇ = √(2/3 D:D)` a compression test and a shear test at any rate have the stress of the law; in compression ε̇ is the axial rate.
#[test]
fn homogeneous_flow_has_the_stress_of_its_rate() {
    let law = |rate: f64| 90e6 * (1.0 + 0.025 * f64::ln(rate));
    for rate in [1e3, 1e5] {
        let compression = [
            [0.5 * rate, 0.0, 0.0],
            [0.0, 0.5 * rate, 0.0],
            [0.0, 0.0, -rate],
        ];
        let stress = flow(&compression, 0.2, 2000);
        let axial = stress[0][0] - stress[2][2];
        println!(
            "compression at {rate}/s: {axial:.6e} Pa, exact {:.6e} Pa",
            law(rate)
        );
        assert!((axial / law(rate) - 1.0).abs() < 1e-6);
        // The norm of the rate of deformation would give this stress instead.
        let other = law((1.5_f64).sqrt() * rate);
        assert!((axial / other - 1.0).abs() > 3e-3);

        let slide = 0.5 * rate;
        let shear = [[0.0, slide, 0.0], [slide, 0.0, 0.0], [0.0; 3]];
        let stress = flow(&shear, 0.2, 2000)[0][1] * 3.0_f64.sqrt();
        assert!((stress / law(rate / 3.0_f64.sqrt()) - 1.0).abs() < 1e-6);
    }
}

/// The same strain in a tenth of the steps: the stress of steady flow is independent of the time step.
#[test]
fn the_stress_of_steady_flow_is_independent_of_the_time_step() {
    let compression = [[50.0, 0.0, 0.0], [0.0, 50.0, 0.0], [0.0, 0.0, -100.0]];
    let [coarse, fine] = [200, 2000].map(|steps| flow(&compression, 0.2, steps)[2][2]);
    assert!((coarse / fine - 1.0).abs() < 1e-9, "{coarse} {fine}");
}
