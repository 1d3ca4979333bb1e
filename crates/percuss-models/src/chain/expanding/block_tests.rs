use super::super::{
    rod::Rod,
    slice::{Metal, Slice},
};

#[test]
fn slices_side_by_side_have_the_bits_of_slices_by_themselves() {
    let material = toml::from_str(
        "name = 'a'\ndensity = '8930 kg/m3'\nyoungs_modulus = '124 GPa'\npoissons_ratio = 0.34\nspecific_heat = '383 J/(kg K)'\n\
         strength.power_law = { coefficient = '450 MPa', exponent = 0.3 }",
    );
    let metal = Metal::new(&material.unwrap(), 0.9, true);
    let mut rod = Rod::new(metal, 11, 50e-3, 2e-5, 293.0, 0.0);
    for (i, node) in rod.nodes.iter_mut().enumerate() {
        node.velocity = 200.0 - 30.0 * (i as f64) * (1.0 + (i as f64).sin());
    }
    let mut flowing = 0;
    for _ in 0..300 {
        let metal = &rod.metal;
        let ends = rod.nodes.windows(2).zip(&rod.slices);
        let expected = ends.fold(f64::INFINITY, |step, (pair, slice)| {
            let approach = (pair[0].velocity - pair[1].velocity).abs() / slice.length;
            let rate = approach.max(slice.radial_velocity.abs() / slice.radius);
            let frequency = (slice.stiffness(metal) / metal.density).sqrt();
            step.min(2.0 / frequency).min(0.02 / rate)
        });
        let step = rod.stable_step(0.02);
        assert_eq!(step, expected);
        let before = rod.slices.clone();
        rod.collect();
        rod.kick(0.5 * step);
        rod.drift(0.5 * step).unwrap();
        for (slice, mut alone) in rod.slices.iter().zip(before) {
            [alone.length, alone.radius] = [slice.length, slice.radius];
            flowing += usize::from(slice.plastic_strain > alone.plastic_strain);
            alone.deform(&rod.metal, 0.5 * step);
            let of = |slice: &Slice| {
                let forces = [slice.axial_force, slice.radial_force, slice.yield_stress()];
                let reached = [slice.plastic_strain, slice.largest_rate, slice.temperature];
                [forces, reached].map(|numbers| numbers.map(f64::to_bits))
            };
            assert_eq!(of(slice), of(&alone));
        }
    }
    assert!(flowing > 300 && flowing < 2900, "{flowing}");
}
