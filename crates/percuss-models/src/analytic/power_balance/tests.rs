use std::f64::consts::PI;

use super::{
    bulge::Bulge,
    fields::{Dish, HoleStress, Layer, Slip, hole, punch, rim},
    flow::{Flow, METALS, Metal, OTHER_METALS, own_melting_heat},
    forces::LAYERS,
    history, impact,
    links::{Body, Row, step},
    motion::{Impact, Keep, MotionState},
    order_of_limit,
};
use crate::{
    analytic::plate_impact::PlateImpact,
    case,
    material::{Library, Material, tensile_strength},
};

const PERFECT: &str = "perfectly_plastic = { flow_stress = '400 MPa' }";
const POWER: &str = "power_law = { coefficient = '400 MPa', exponent = 0.2 }";
const JOHNSON: &str = "johnson_cook = { a = '300 MPa', b = '400 MPa', n = 0.4, c = 0.01, m = 1.0, reference_rate = '1 1/s' }";
/// No heating: the law of the record alone.
const COLD: &str = "power_balance = { heat_fraction = 0.0 }";
const NOSES: [&str; 4] = [
    "'flat'",
    "'hemisphere'",
    "{ cone = { length_to_diameter = 1.0 } }",
    "{ ogive = { crh = 3.0 } }",
];

/// 197 g, 20 mm against a plate of this thickness [mm].
fn of(strength: &str, nose: &str, thickness: f64, options: &str) -> Impact {
    let text = format!(
        "projectile = {{ material = 'rigid', mass = '197 g', diameter = '20 mm', nose = {nose}, impact_velocity = '300 m/s' }}
        target = {{ material = 'plate', thickness = '{thickness} mm', back_face = 'free' }}
        materials.rigid = {{ name = 'rigid', density = '7850 kg/m3', youngs_modulus = '210 GPa', poissons_ratio = 0.3, strength.elastic = {{}} }}
        materials.plate = {{ name = 'plate', density = '7850 kg/m3', youngs_modulus = '200 GPa', poissons_ratio = 0.3, specific_heat = '450 J/(kg K)', melting_temperature = '1800 K', strength = {{ {strength} }} }}
        {options}"
    );
    let scenario = case::load_str("plate", &text).unwrap_or_else(|error| panic!("{error}"));
    let plate = PlateImpact::of(&scenario).unwrap();
    impact(&scenario, &plate).unwrap()
}

fn flow(strength: &str) -> Flow {
    of(strength, NOSES[0], 12.0, COLD).flow
}

/// Power of the field under a punch over π a² V Y, by its strain rates on a fine mesh, and its mean strain rate.
fn punch_power(depth: f64, extent: f64, (p, q): (f64, f64)) -> (f64, f64) {
    let panels = 120;
    let (mut sum, mut square) = (0.0, 0.0);
    let gap = extent * extent - 1.0;
    for (low, high) in [(0.0, 1.0), (1.0, extent)] {
        for i in 0..panels {
            let r = low + (high - low) * (f64::from(i) + 0.5) / f64::from(panels);
            let u = (extent * extent - r * r) / gap;
            let slope = -2.0 * r / gap;
            let (f, f1, f2) = match r < 1.0 {
                true => (r * r / 2.0, r, 1.0),
                false => (
                    0.5 * u.powf(p),
                    0.5 * p * u.powf(p - 1.0) * slope,
                    0.5 * p
                        * ((p - 1.0) * u.powf(p - 2.0) * slope * slope
                            - 2.0 * u.powf(p - 1.0) / gap),
                ),
            };
            for j in 0..panels {
                let s = 1.0 - (f64::from(j) + 0.5) / f64::from(panels);
                let g = s.powf(q);
                let g1 = -q * s.powf(q - 1.0) / depth;
                let g2 = q * (q - 1.0) * s.powf(q - 2.0) / (depth * depth);
                let (radial, hoop, axial) =
                    (-g1 * (f1 / r - f / (r * r)), -f * g1 / (r * r), f1 * g1 / r);
                assert!((radial + hoop + axial).abs() < 1e-9, "volume is kept");
                let shear = -f * g2 / r + g * (f2 / r - f1 / (r * r));
                let direct = radial * radial + hoop * hoop + axial * axial;
                let rate = (2.0 / 3.0 * direct + shear * shear / 3.0).sqrt();
                let ring = 2.0 * PI * r * (high - low) * depth / f64::from(panels * panels);
                sum += rate * ring;
                square += rate * rate * ring;
            }
        }
    }
    // Under the edge of the punch metal sinks inside and rises outside.
    let edge = 2.0 * PI * (1.0 + p / gap) * depth / (q + 1.0) / 3.0_f64.sqrt();
    ((sum + edge) / PI, square / sum)
}

/// The exact mean pressure on a smooth circular punch is 2.845 Y for Tresca's yield condition, which lies within that of von Mises.
#[test]
fn the_field_under_a_punch_is_an_upper_bound_and_the_least_of_its_kind() {
    let (pressure, rate) = punch_power(punch::DEPTH, punch::EXTENT, punch::EXPONENTS);
    assert!(
        (pressure / punch::PRESSURE - 1.0).abs() < 2e-3,
        "{pressure}"
    );
    assert!((rate / punch::RATE - 1.0).abs() < 0.02, "{rate}");
    const { assert!(punch::PRESSURE >= 2.845 && punch::PRESSURE < 1.13 * 2.845) };
    let (p, q) = punch::EXPONENTS;
    for other in [
        punch_power(0.8 * punch::DEPTH, punch::EXTENT, (p, q)),
        punch_power(1.2 * punch::DEPTH, punch::EXTENT, (p, q)),
        punch_power(punch::DEPTH, 0.9 * punch::EXTENT, (p, q)),
        punch_power(punch::DEPTH, 1.1 * punch::EXTENT, (p, q)),
        punch_power(punch::DEPTH, punch::EXTENT, (0.8 * p, q)),
        punch_power(punch::DEPTH, punch::EXTENT, (1.2 * p, q)),
        punch_power(punch::DEPTH, punch::EXTENT, (p, 0.8 * q)),
        punch_power(punch::DEPTH, punch::EXTENT, (p, 1.2 * q)),
    ] {
        assert!(other.0 > pressure, "{other:?}");
    }
}

/// With one stress and a face that does not sink, `V_r = m/(m + m_p) √(V² − V_bl²)` with the work `τ π D h²/2`.
#[test]
fn a_plug_of_constant_shear_has_the_residual_velocity_of_recht_and_ipson() {
    for thickness in [2.0, 12.0, 20.0] {
        let impact = of(
            PERFECT,
            NOSES[0],
            thickness,
            "power_balance = { indentation = false, bulging = false }",
        );
        let height = impact.thickness;
        let shear = 400e6 / 3.0_f64.sqrt();
        let work = shear * PI * 0.02 * height * height / 2.0;
        let plug = 7850.0 * PI * 1e-4 * height;
        let limit = (2.0 * work * (0.197 + plug)).sqrt() / 0.197;
        let found = impact.ballistic_limit(limit);
        assert!(
            (found / limit - 1.0).abs() < 1e-4,
            "{thickness} {found} {limit}"
        );
        for speed in [1.2 * limit, 2.0 * limit, 5.0 * limit] {
            let run = impact.case(speed, Keep::End);
            let exact = 0.197 / (0.197 + plug) * (speed * speed - limit * limit).sqrt();
            let residual = run.last.velocities[0];
            assert!(
                (residual / exact - 1.0).abs() < 1e-4,
                "{thickness} {residual} {exact}"
            );
            assert!((run.last.rim_work / work - 1.0).abs() < 1e-4);
            let capture = 0.5 * 0.197 * speed * speed * plug / (0.197 + plug);
            assert!((run.last.capture / capture - 1.0).abs() < 1e-4);
        }
    }
}

#[test]
fn energy_and_momentum_close_at_every_moment() {
    for strength in [PERFECT, POWER, JOHNSON] {
        for nose in NOSES {
            for (thickness, speed) in [(4.0, 100.0), (12.0, 60.0), (12.0, 300.0), (40.0, 500.0)] {
                let impact = of(strength, nose, thickness, "");
                let run = impact.case(speed, Keep::Moments);
                for moment in &run.moments {
                    let energy = history::energy(&impact, moment, speed).residual();
                    let momentum = history::momentum(&impact, moment, speed).residual();
                    assert!(
                        energy.abs() < 1e-9,
                        "{strength} {nose} {thickness} {moment:?} {energy}"
                    );
                    assert!(
                        momentum.abs() < 1e-9,
                        "{strength} {nose} {thickness} {momentum}"
                    );
                }
                let work = [
                    run.last.local_work,
                    run.last.dish_work,
                    run.last.rim_work,
                    run.last.capture,
                ];
                let initial = 0.5 * impact.mass * speed * speed;
                assert!(
                    work.iter().all(|work| *work > -1e-6 * initial),
                    "{nose} {work:?}"
                );
            }
        }
    }
}

/// A rigid-plastic plate pushes a flat face with the pressure of the punch at most, beside inertia.
#[test]
fn the_force_on_a_flat_face_is_that_of_the_punch_at_most() {
    for thickness in [6.0, 20.0, 40.0] {
        let impact = of(PERFECT, NOSES[0], thickness, "");
        let run = impact.case(400.0, Keep::End);
        let most = punch::PRESSURE * 400e6 + 0.5 * 7850.0 * 400.0 * 400.0;
        let force = run.peak_force / impact.area();
        assert!(
            force <= most * (1.0 + 1e-6) && force > 0.9 * most,
            "{force} {most}"
        );
    }
}

/// In a power law the least power is at `w = 2 a n/(1 − n)`, whatever the slip.
#[test]
fn the_band_of_a_power_law_has_the_width_of_its_exponent() {
    let flow = flow(POWER);
    for slip in [0.02, 0.05] {
        let band = rim(
            &flow,
            &Slip {
                radius: 0.01,
                slip,
                rate: 100.0,
                width: 0.0,
            },
        );
        let exact = 2.0 * 0.01 * 0.2 / 0.8;
        assert!((band.width / exact - 1.0).abs() < 5e-3, "{band:?} {exact}");
    }
    let flow = self::flow(PERFECT);
    let band = rim(
        &flow,
        &Slip {
            radius: 0.01,
            slip: 1e-3,
            rate: 100.0,
            width: 0.0,
        },
    );
    assert!((band.stress * 3.0_f64.sqrt() / 400e6 - 1.0).abs() < 1e-6);
}

/// Thicker plates resist the opening of a hole more, up to the pressure of a cavity, which a thick plate has exactly.
#[test]
fn a_hole_in_a_thick_plate_has_the_pressure_of_a_cavity() {
    let stress = HoleStress::new(&flow(PERFECT), 10.0);
    // The same growth in all layers.
    let even = |radius: f64, thickness: f64| {
        let layer = Layer {
            radius,
            gain: 2.0 * PI * radius * thickness / LAYERS as f64,
        };
        let hole = hole(&stress, &[layer; LAYERS], thickness, None);
        (hole.force / (2.0 * PI * radius * thickness), hole)
    };
    let mut before = 0.0;
    for thickness in [0.001, 0.01, 0.1, 1.0, 10.0] {
        let (pressure, hole) = even(0.01, thickness);
        assert!(pressure > before && hole.extent > 1.0, "{hole:?}");
        before = pressure;
    }
    // The least over R of σ[∫ε̇ r dr + (R h/2√3 c)/(R² − c²)] at h/c = 3.5, by quadrature.
    let exact = (1..4000)
        .map(|i| {
            let extent = 1.0 + 1e-3 * f64::from(i);
            let (square, panels) = (extent * extent, 2000);
            let step = extent.ln() / f64::from(panels);
            let volume: f64 = (0..panels)
                .map(|j| {
                    let r2 = ((2.0 * f64::from(j) + 1.0) * step).exp();
                    let part = square / r2;
                    (2.0 / 3.0 * (2.0 * part * part + 6.0)).sqrt() / (square - 1.0) * r2 * step
                })
                .sum();
            volume + extent * 3.5 / (2.0 * 3.0_f64.sqrt() * (square - 1.0))
        })
        .fold(f64::INFINITY, f64::min);
    let (pressure, _) = even(0.01, 0.035);
    assert!(
        (pressure / 400e6 / exact - 1.0).abs() < 3e-3,
        "{pressure} {exact}"
    );
    let thick = of(PERFECT, NOSES[1], 5000.0, "");
    let (force, _) = thick.opening(1.0, 0.0, &mut None);
    let exact = thick.cavity_pressures[1] * PI * 1e-4;
    assert!((force / exact - 1.0).abs() < 1e-12, "{force} {exact}");
    // Of an unbounded field, ln(R/c) − 3/4.
    let (_, wide) = even(1e-5, 10.0);
    assert!(
        (wide.inertia - (wide.extent.ln() - 0.75)).abs() < 1e-4 * wide.inertia,
        "{wide:?}"
    );
}

/// The work of a whole passage, and its contact, do not depend on the number of layers.
#[test]
fn layers_are_fine_enough() {
    for nose in &NOSES[1..] {
        for thickness in [10.0, 20.0, 40.0] {
            let impact = of(PERFECT, nose, thickness, COLD);
            let steps = 200;
            let step = impact.passage() / f64::from(steps);
            let (mut coarse, mut fine) = (0.0, 0.0);
            for i in 0..steps {
                let sunk = (f64::from(i) + 0.5) * step;
                let few = impact.layers::<LAYERS>(sunk);
                let many = impact.layers::<128>(sunk);
                let gain = |layers: &[Layer]| layers.iter().map(|l| l.gain).sum::<f64>();
                assert!((gain(&few) / gain(&many) - 1.0).abs() < 1e-9);
                coarse += hole(&impact.hole_stress, &few, impact.thickness, None).force;
                fine += hole(&impact.hole_stress, &many, impact.thickness, None).force;
            }
            println!("{nose} {thickness}: {}", coarse / fine - 1.0);
            assert!((coarse / fine - 1.0).abs() < 2e-2, "{nose} {thickness}");
        }
    }
}

#[test]
fn the_dish_has_the_mass_of_its_field_and_the_load_of_its_hinges() {
    let dish = Dish {
        rim: 0.01,
        thickness: 0.01,
        density: 7850.0,
        inner_mass: 0.0,
    };
    let (edge, other, panels) = (0.035, 0.05, 20_000);
    let field = |r: f64, b: f64| ((b - r) / (b - 0.01)).max(0.0);
    let (mut own, mut both, mut momentum) = (0.0, 0.0, 0.0);
    for i in 0..panels {
        let r = 0.01 + (edge - 0.01) * (f64::from(i) + 0.5) / f64::from(panels);
        let ring = 2.0 * PI * r * 7850.0 * 0.01 * (edge - 0.01) / f64::from(panels);
        own += ring * field(r, edge).powi(2);
        both += ring * field(r, edge) * field(r, other);
        momentum += ring * field(r, edge);
    }
    assert!((dish.mass(edge) / own - 1.0).abs() < 1e-6);
    assert!((dish.common(edge, other) / both - 1.0).abs() < 1e-6);
    assert!((dish.momentum(edge) / momentum - 1.0).abs() < 1e-6);
    // A flat plate far from its support carries 4 π M, as yield lines have it.
    let moment = 2.0 / 3.0_f64.sqrt() * 400e6 * 0.01 * 0.01 / 4.0;
    let load = dish.resistance(1e4, 0.0, 400e6);
    assert!((load / (4.0 * PI * moment) - 1.0).abs() < 1e-5);
}

#[test]
fn bodies_in_a_row_hold_until_their_links_yield() {
    let body = |mass, velocity, largest: f64| Body {
        mass,
        velocity,
        largest,
        least: -largest,
    };
    let rigid = |bodies: &[Body]| {
        let mobility = 0.0;
        step(Row { bodies, mobility })
    };
    // Strong links: one body that loses what the last link takes.
    let held = rigid(&[body(2.0, 10.0, 1e9), body(1.0, 0.0, 3.0)]);
    assert!(
        held.velocities[..2]
            .iter()
            .all(|v| (v - 17.0 / 3.0).abs() < 1e-12)
    );
    // A weak first link yields, and the second body stays where it is.
    let weak = rigid(&[body(2.0, 10.0, 1.0), body(1.0, 0.0, 3.0)]);
    assert_eq!((weak.velocities[0], weak.velocities[1]), (9.5, 0.0));
    // A slower body behind is parted from, not pulled.
    let parted = rigid(&[
        Body {
            least: 0.0,
            ..body(2.0, 1.0, 1.0)
        },
        body(1.0, 5.0, 0.5),
    ]);
    assert_eq!((parted.velocities[0], parted.velocities[1]), (1.0, 4.5));
    // An elastic plate of mobility c takes v′/c.
    let held = step(Row {
        bodies: &[body(2.0, 10.0, 1e9), body(1.0, 0.0, 1e9)],
        mobility: 0.5,
    });
    assert!((held.velocities[1] - 4.0).abs() < 1e-12 && (held.impulses[1] - 8.0).abs() < 1e-12);
}

/// `σ = K εⁿ exp(−β K εⁿ⁺¹/((n + 1) H))`, H the heat that melts the metal.
#[test]
fn a_law_without_temperature_softens_to_the_melting_point() {
    let flow = of(POWER, NOSES[0], 12.0, "").flow;
    let cold = self::flow(POWER);
    let melting = 7850.0 * 450.0 * (1800.0 - 293.15);
    for strain in [0.05, 0.3, 1.0, 4.0] {
        let work = 400e6 * f64::powf(strain, 1.2) / 1.2;
        let exact = cold.stress(strain, 1e3) * (-0.9 * work / melting).exp();
        let found = flow.stress(strain, 1e3);
        assert!((found / exact - 1.0).abs() < 1e-3, "{found} {exact}");
    }
    // A constant stress is a mean over the heating.
    let perfect = of(PERFECT, NOSES[0], 12.0, "").flow;
    assert_eq!(perfect.stress(4.0, 1e3), 400e6);
}

/// What stands for the heat of a record without it is the median of the records of its metal, recognised by density and modulus alone.
#[test]
fn melting_heats_are_the_medians_of_the_library() {
    let records = || Library::built_in().iter().map(|entry| &*entry.material);
    let median = |wanted: &dyn Fn(&Material) -> bool| {
        let alike = records().filter(|record| wanted(record));
        let ratios =
            alike.filter_map(|record| Some(own_melting_heat(record)? / record.youngs_modulus.si()));
        let mut ratios: Vec<f64> = ratios.collect();
        ratios.sort_by(f64::total_cmp);
        let (low, high) = ((ratios.len() - 1) / 2, ratios.len() / 2);
        0.5 * (ratios[low] + ratios[high])
    };
    for metal in &METALS {
        let found = median(&|record| record.group == Some(metal.group));
        assert!(
            (found - metal.heat).abs() < 6e-5,
            "{:?}: {found}",
            metal.group
        );
    }
    assert!((median(&|_| true) - OTHER_METALS).abs() < 6e-5);
    // A plate of glass does not flow.
    for record in records().filter(|record| tensile_strength(record).is_some()) {
        let bare = Material {
            group: None,
            ..record.clone()
        };
        let group = |material: &Material| Metal::of(material).map(|metal| metal.group);
        assert_eq!(group(&bare), group(record), "{}", record.name);
    }
}

/// The exit velocity rises with the impact velocity: what the band has come to does not depend on where time steps fall.
#[test]
fn exit_velocities_rise_with_impact_velocity() {
    let text = "projectile = { material = '4340', mass = '53.78 g', diameter = '19.9 mm', impact_velocity = '360 m/s' }
        target = { material = 'plate', thickness = '22.7 mm', back_face = 'free' }
        materials.plate = { name = 'plate', density = '2870 kg/m3', youngs_modulus = '71.7 GPa', poissons_ratio = 0.33, strength.power_law = { coefficient = '637.93 MPa', exponent = 0.0374 } }";
    let scenario = case::load_str("plate", text).unwrap();
    let plate = impact(&scenario, &PlateImpact::of(&scenario).unwrap()).unwrap();
    let mut before = 0.0;
    for speed in 300..340 {
        let run = plate.case(f64::from(speed), Keep::End);
        let exit = if run.perforated {
            run.last.velocities[0]
        } else {
            0.0
        };
        assert!(exit >= before, "{speed} m/s: {exit} after {before}");
        before = exit;
    }
    assert!(before > 80.0);
}

/// A slow impact on a plate that does not yield: `m v̇ = −8 √(ρ h D) v`, so that all energy goes into waves and `δ = m V/(8 √(ρ h D))`.
#[test]
fn an_elastic_plate_takes_the_momentum_of_a_slow_impact() {
    for nose in NOSES {
        let impact = of(PERFECT, nose, 2.0, "");
        let speed = 3.0;
        let run = impact.case(speed, Keep::End);
        let stiffness = 200e9 * 0.002_f64.powi(3) / 12.0 / (1.0 - 0.09);
        let impedance = 8.0 * (7850.0 * 0.002 * stiffness).sqrt();
        let exact = 0.197 * speed / impedance;
        let found = run.last.flexure;
        assert!((found / exact - 1.0).abs() < 0.02, "{nose} {found} {exact}");
        assert!(run.last.deflection == 0.0 && !run.perforated, "{nose}");
    }
}

/// The plate keeps the sum of its dishes: each a straight line from the rim to its edge.
#[test]
fn the_bulge_is_the_sum_of_the_dishes() {
    let mut bulge = Bulge::new(0.01);
    bulge.add(0.03, 2e-3);
    assert!((bulge.half_radius().unwrap() - 0.02).abs() < 1e-9);
    bulge.add(0.05, 1e-3);
    for [radius, found] in &bulge.rings {
        let line = |edge: f64, depth: f64| (depth * (edge - radius) / (edge - 0.01)).max(0.0);
        let sum = line(0.03, 2e-3) + line(0.05, 1e-3);
        assert!((found - sum).abs() < 1e-15, "{radius}");
    }
    let run = of(PERFECT, "'hemisphere'", 5.0, "").case(100.0, Keep::Shape);
    let rings = &run.bulge.rings;
    assert!(run.last.deflection > 1e-3);
    assert!((rings[0][1] / run.last.deflection - 1.0).abs() < 1e-9);
    assert!(rings.windows(2).all(|pair| pair[1][1] <= pair[0][1]));
    assert!(run.moments.is_empty());
}

/// The kinetic energy that a plate has when the projectile leaves it goes into plastic work and waves.
#[test]
fn a_perforated_plate_comes_to_rest() {
    // A plug leaves, and an ogive slides through, once the plate is at rest.
    for nose in &NOSES[1..3] {
        let impact = of(POWER, nose, 4.0, "");
        let run = impact.case(1.02 * impact.ballistic_limit(100.0), Keep::Shape);
        assert!(run.perforated, "{nose}");
        let mut bulge = Bulge::new(impact.radius());
        let (exit, rest) = (run.last, impact.settle(&run.last, &mut bulge));
        let kinetic = |moment| impact.kinetic_energy(moment)[2];
        let work = |moment: &MotionState| moment.dish_work + moment.wave_work + moment.capture;
        let lost = kinetic(&exit) - kinetic(&rest);
        let more = rest.deflection - exit.deflection;
        assert!(
            lost > 0.5 * kinetic(&exit) && more > 1e-6,
            "{nose} {lost} {more}"
        );
        let part = (work(&rest) - work(&exit)) / lost;
        assert!((part - 1.0).abs() < 1e-9, "{nose} {part}");
        assert!((bulge.depth() / more - 1.0).abs() < 1e-9, "{nose}");
        assert!(
            (run.bulge.depth() / rest.deflection - 1.0).abs() < 1e-9,
            "{nose}"
        );
    }
}

/// A record's `damage` does not end the band of a plug: limits under a flat nose rise with the thickness, and are those of the record without it.
#[test]
fn limits_of_records_with_damage_rise_with_the_thickness() {
    let limit = |damage: &str, thickness: f64| {
        let text = format!(
            "projectile = {{ material = 'tool-steel-hrc53', length = '60 mm', diameter = '10 mm', impact_velocity = '400 m/s' }}
            target = {{ material = 'plate', thickness = '{thickness} mm', back_face = 'free' }}
            [materials.plate]
            name = 'plate'
            density = '2700 kg/m3'
            youngs_modulus = '70 GPa'
            poissons_ratio = 0.33
            specific_heat = '880 J/(kg K)'
            melting_temperature = '925 K'
            strength.johnson_cook = {{ a = '289.6 MPa', b = '203.4 MPa', n = 0.35, c = 0.011, m = 1.34, reference_rate = '1 1/s' }}
            {damage}"
        );
        let scenario = case::load_str("plate", &text).unwrap_or_else(|error| panic!("{error}"));
        let plate = PlateImpact::of(&scenario).unwrap();
        let impact = impact(&scenario, &plate).unwrap();
        impact.ballistic_limit(order_of_limit(&plate).unwrap())
    };
    // Those of 6061-T6 [banerjee-vaango]: a failure strain of 0.7 at no mean stress.
    let damage = "damage = { d1 = -0.77, d2 = 1.45, d3 = -0.47, d4 = 0.0, d5 = 1.6, reference_rate = '1 1/s' }";
    let limits = [3.0, 4.0, 5.0, 7.0, 10.0, 15.0, 20.0].map(|thickness| {
        let found = limit(damage, thickness);
        assert_eq!(found, limit("", thickness));
        found
    });
    assert!(limits.is_sorted_by(|a, b| 1.02 * a < *b), "{limits:?}");
}
