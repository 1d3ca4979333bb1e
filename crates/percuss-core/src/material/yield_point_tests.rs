use std::cell::Cell;

use pulp::{Arch, NullaryFnOnce};

use super::*;
use crate::{
    lanes::{LANES, Lanes, lanes},
    material::{
        JohnsonCookLaw, LaneLaw, LawKind, Material,
        plastic_return::{Logarithmic, TOLERANCE},
    },
};

const MODULUS: f64 = 200e9;
const TIME: f64 = 1e-8;

fn prepared(strength: &str) -> Box<dyn PreparedStrength> {
    let metal: Material = toml::from_str(&format!(
        "name = 'a'\ndensity = '8000 kg/m3'\nyoungs_modulus = '200 GPa'\npoissons_ratio = 0.3\n\
         melting_temperature = '1800 K'\nstrength.{strength}"
    ))
    .unwrap();
    metal.strength.law().prepare(&metal, 1.0)
}

fn laws() -> impl Iterator<Item = Box<dyn PreparedStrength>> {
    [
        "perfectly_plastic = { flow_stress = '400 MPa' }",
        "power_law = { coefficient = '800 MPa', exponent = 0.1 }",
        "johnson_cook = { a = '300 MPa', b = '500 MPa', n = 0.3, c = 0.02, m = 1.0, reference_rate = '1 1/s' }",
        "johnson_cook = { a = '490 MPa', b = '383 MPa', n = 0.45, c = 0.0114, m = 0.94, reference_rate = '5e-4 1/s', rate_form = 'power' }",
    ]
    .into_iter()
    .map(prepared)
}

fn trial(stress: f64) -> Trial {
    Trial {
        stress,
        modulus: MODULUS,
        pressure_fall: 0.0,
        elapsed: Some(TIME),
    }
}

fn state() -> FlowState {
    FlowState {
        plastic_strain: 0.02,
        strain_rate: 0.0,
        temperature: 400.0,
        pressure: 0.0,
    }
}

fn flow_stress(law: &dyn PreparedStrength, start: &FlowState, increment: f64) -> f64 {
    let state = FlowState {
        plastic_strain: start.plastic_strain + increment,
        strain_rate: increment / TIME,
        ..*start
    };
    law.flow_stress(&state).stress
}

#[test]
fn the_stress_ends_on_the_yield_surface() {
    for law in laws() {
        for stress in [0.9e9, 2e9, 20e9] {
            let mut point = YieldPoint::slow(&*law, &state());
            let increment = point.plastic_increment(&*law, &state(), &trial(stress));
            let flow = flow_stress(&*law, &state(), increment);
            assert!(
                (point.stress() / flow - 1.0).abs() < 2.0 * TOLERANCE * stress / flow,
                "{law:?} {stress}"
            );
            assert!((stress - MODULUS * increment - point.stress()).abs() < 1e-3);
        }
    }
}

#[test]
fn where_a_return_starts_does_not_matter() {
    for law in laws() {
        for before in [0.9e9, 1.2e9, 20e9] {
            let mut point = YieldPoint::slow(&*law, &state());
            let mut now = state();
            now.plastic_strain += point.plastic_increment(&*law, &now, &trial(before));
            now.temperature += 50.0;
            for stress in [0.3e9, 0.65e9, 0.7e9, 0.9e9, 3e9] {
                let from_flow = point.clone().plastic_increment(&*law, &now, &trial(stress));
                let from_rest =
                    YieldPoint::slow(&*law, &now).plastic_increment(&*law, &now, &trial(stress));
                assert!(
                    (from_flow - from_rest).abs() <= 2.0 * TOLERANCE * stress / MODULUS,
                    "{law:?} {before} {stress}: {from_flow} {from_rest}"
                );
            }
        }
    }
}

#[test]
fn a_body_that_stops_flowing_is_elastic_below_its_slow_flow_stress() {
    for law in laws() {
        let mut point = YieldPoint::slow(&*law, &state());
        let mut now = state();
        now.plastic_strain += point.plastic_increment(&*law, &now, &trial(1e9));
        let slow = law.flow_stress(&now).stress;
        assert_eq!(
            point.plastic_increment(&*law, &now, &trial(0.999 * slow)),
            0.0
        );
        assert!(point.holds(0.999 * slow) && !point.holds(1.001 * slow));
    }
}

/// Numbers from 0 to 1 without a pattern.
struct Chance(u64);

impl Chance {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, least: f64, most: f64) -> f64 {
        least + (most - least) * self.next()
    }
}

/// A law with constants of its own, of each kind.
fn random(kind: LawKind, chance: &mut Chance) -> Box<dyn PreparedStrength> {
    let mut mpa = |least: f64, most: f64| format!("'{} MPa'", chance.between(least, most));
    let (first, second) = (mpa(50.0, 900.0), mpa(100.0, 900.0));
    let mut number = |least: f64, most: f64| chance.between(least, most);
    let text = match kind {
        LawKind::Hardening if number(0.0, 1.0) < 0.3 => {
            format!("perfectly_plastic = {{ flow_stress = {first} }}")
        }
        LawKind::Hardening => {
            let exponent = number(0.02, 0.5);
            format!("power_law = {{ coefficient = {second}, exponent = {exponent} }}")
        }
        LawKind::JohnsonCook | LawKind::ModifiedJohnsonCook => {
            let form = match kind {
                LawKind::JohnsonCook => "logarithmic",
                _ => "power",
            };
            let (n, c, m) = (number(0.1, 0.9), number(0.0, 0.06), number(0.6, 1.6));
            let rate = 10.0_f64.powf(number(-4.0, 1.0));
            format!(
                "johnson_cook = {{ a = {first}, b = {second}, n = {n}, c = {c}, m = {m}, reference_rate = '{rate} 1/s', \
                 rate_form = '{form}' }}"
            )
        }
        LawKind::SteinbergGuinan => {
            let (beta, n) = (number(1.0, 200.0), number(0.1, 0.6));
            let (pressure, heat) = (number(1e-12, 4e-11), number(1e-5, 1e-3));
            format!(
                "steinberg_guinan = {{ y0 = {first}, y_max = '1500 MPa', beta = {beta}, n = {n}, \
                 pressure_coefficient = '{pressure} 1/Pa', temperature_coefficient = '{heat} 1/K' }}"
            )
        }
    };
    prepared(&text)
}

const KINDS: [LawKind; 4] = [
    LawKind::Hardening,
    LawKind::JohnsonCook,
    LawKind::ModifiedJohnsonCook,
    LawKind::SteinbergGuinan,
];

/// Returns of eight bodies of one kind of law side by side.
#[derive(Clone, Copy)]
struct SideBySide<'a>(&'a YieldPoint<Lanes>, &'a LaneTrial<Lanes>, Lanes);

impl LawVisitor<Lanes> for SideBySide<'_> {
    type Output = Vec<(Lanes, YieldPoint<Lanes>)>;

    fn visit<L>(self, law: &L) -> Self::Output
    where
        L: PerLane + Copy + Default,
        L::One: LaneStrength,
    {
        struct Of<'a, L>(SideBySide<'a>, L);
        impl<L> NullaryFnOnce for Of<'_, L>
        where
            L: PerLane,
            L::One: LaneStrength,
        {
            type Output = (Lanes, YieldPoint<Lanes>);

            #[inline(always)]
            fn call(self) -> Self::Output {
                let SideBySide(point, trial, places) = self.0;
                let mut point = *point;
                (
                    plastic_increments(&self.1, &mut point, trial, &places),
                    point,
                )
            }
        }
        let run = Of(self, *law);
        let mut all = vec![
            Arch::new().dispatch(Of(self, *law)),
            Arch::Scalar.dispatch(run),
        ];
        #[cfg(target_arch = "x86_64")]
        {
            all.extend(pulp::x86::V3::try_new().map(|avx2| avx2.vectorize(Of(self, *law))));
            all.extend(pulp::x86::V4::try_new().map(|avx512| avx512.vectorize(Of(self, *law))));
        }
        all
    }
}

#[test]
fn eight_returns_side_by_side_have_the_bits_of_each_by_itself() {
    let mut chance = Chance(1);
    let (mut flowed, mut elastic, mut rated) = (0, 0, 0);
    for kind in KINDS {
        for _ in 0..40 {
            let laws: [_; LANES] = std::array::from_fn(|_| random(kind, &mut chance));
            let mut in_lanes = LaneLaw::<Lanes>::of_kind(kind);
            for (l, law) in laws.iter().enumerate() {
                in_lanes.set_lane(l, law.in_lanes().unwrap());
            }
            let mut alone: [YieldPoint; LANES] = std::array::from_fn(|_| YieldPoint::default());
            let mut points = YieldPoint::<Lanes>::default();
            let mut strains = [0.0; LANES];
            for step in 0..30 {
                let mut trials = LaneTrial::<Lanes>::default();
                let places = (256.0 * chance.next()) as u8;
                let mut expected = [0.0; LANES];
                for l in 0..LANES {
                    let start = FlowState {
                        plastic_strain: strains[l],
                        strain_rate: 0.0,
                        // Some of them molten.
                        temperature: chance.between(250.0, 1900.0),
                        pressure: chance.between(-2e9, 20e9),
                    };
                    // From elastic to what only iteration follows.
                    let stress = 10.0_f64.powf(chance.between(7.0, 10.5));
                    let time = 10.0_f64.powf(chance.between(-9.5, -6.0));
                    let trial = Trial {
                        stress,
                        modulus: chance.between(30e9, 300e9),
                        pressure_fall: chance.between(-1e11, 1e11),
                        elapsed: (chance.next() < 0.8).then_some(time),
                    };
                    rated += usize::from(trial.elapsed.is_some());
                    trials.set_lane(l, LaneTrial::new(&start, &trial));
                    if step % 7 == 3 {
                        alone[l].forget();
                        points.set_lane(l, alone[l]);
                    }
                    if places >> l & 1 == 1 {
                        expected[l] = alone[l].plastic_increment(&*laws[l], &start, &trial);
                        strains[l] += expected[l];
                        flowed += usize::from(expected[l] > 0.0);
                        elastic += usize::from(expected[l] == 0.0);
                    }
                }
                let found = in_lanes.visit(SideBySide(
                    &points,
                    &trials,
                    lanes(|l| f64::from(places >> l & 1)),
                ));
                for (increments, ends) in &found {
                    for l in 0..LANES {
                        assert_eq!(
                            increments[l].to_bits(),
                            expected[l].to_bits(),
                            "{:?}",
                            laws[l]
                        );
                        assert_eq!(bits(&ends.lane(l)), bits(&alone[l]), "{:?}", laws[l]);
                    }
                }
                points = found[0].1;
            }
        }
    }
    assert!(
        flowed > 5000 && elastic > 2000 && rated > 5000,
        "{flowed} {elastic} {rated}"
    );
}

fn bits(point: &YieldPoint) -> [u64; 5] {
    let YieldPoint {
        stress,
        strain_slope,
        rate_slope,
        strain_rate,
        elastic_to,
    } = *point;
    [stress, strain_slope, rate_slope, strain_rate, elastic_to].map(f64::to_bits)
}

/// A Johnson–Cook law that counts how often its flow stress is asked for.
#[derive(Clone, Copy)]
struct Counted<'a> {
    law: JohnsonCookLaw,
    evaluations: &'a Cell<u32>,
}

impl LaneStrength for Counted<'_> {
    const LOGARITHMIC: bool = true;

    fn rate_exponent(&self, strain_rate: f64) -> f64 {
        self.law.rate_exponent(strain_rate)
    }

    fn thermal(&self, temperature: f64) -> f64 {
        self.law.thermal(temperature)
    }

    fn flow_stress(&self, thermal: f64, state: &FlowState) -> FlowStress {
        self.evaluations.set(self.evaluations.get() + 1);
        self.law.flow_stress(thermal, state)
    }

    fn depends_on_strain_only(&self) -> bool {
        false
    }
}

impl PerLane for Counted<'_> {
    type One = Self;

    fn lane(&self, _: usize) -> Self {
        *self
    }

    fn set_lane(&mut self, _: usize, one: Self) {
        *self = one;
    }

    fn choose(&mut self, _: usize, is_so: bool, yes: Self, no: Self) {
        *self = if is_so { yes } else { no };
    }
}

#[test]
fn a_rate_that_changes_takes_one_evaluation_and_a_new_start_few() {
    let strength = "johnson_cook = { a = '300 MPa', b = '500 MPa', n = 0.3, c = 0.02, m = 1.0, reference_rate = '1 1/s' }";
    let prepared = prepared(strength);
    let Some(LaneLaw::JohnsonCook(law)) = prepared.in_lanes() else {
        panic!("a Johnson-Cook law has its equations in lanes");
    };
    let evaluations = Cell::new(0);
    let law = Counted {
        law,
        evaluations: &evaluations,
    };
    let mut now = state();
    let mut point = YieldPoint::default();
    let mut flow = |expected: f64, stress: Option<f64>| {
        let on_surface = MODULUS * expected + flow_stress(&*prepared, &now, expected);
        let stress = stress.unwrap_or(on_surface);
        evaluations.set(0);
        let trial = LaneTrial::new(&now, &trial(stress));
        let increment = plastic_increments(&law, &mut point, &trial, &1.0);
        let bound = 2.0 * TOLERANCE * stress / MODULUS;
        assert!(
            (increment - expected).abs() < bound,
            "{increment} {expected}"
        );
        now.plastic_strain += increment;
        evaluations.get()
    };
    flow(1e-4, None);
    for expected in [1e-4, 1.3e-4, 1e-4, 0.75e-4, 1e-4] {
        assert_eq!(flow(expected, None), 1, "{expected}");
    }
    // What asks for the slow flow stress is one of these.
    for (expected, most) in [(5e-6, 3), (1e-7, 3), (4e-4, 5)] {
        let evaluations = flow(expected, None);
        assert!(evaluations <= most, "{expected}: {evaluations}");
    }
    assert_eq!(flow(0.0, Some(100e6)), 1);
    assert_eq!(flow(0.0, Some(50e6)), 0);
    assert!(flow(1e-6, None) <= 2);
}

#[test]
fn a_power_of_the_rate_is_met_at_rates_near_the_reference_rate_too() {
    let law = prepared(
        "johnson_cook = { a = '490 MPa', b = '383 MPa', n = 0.45, c = 0.06, m = 0.94, reference_rate = '1e4 1/s', rate_form = 'power' }",
    );
    let mut point = YieldPoint::default();
    let mut now = state();
    let mut worst = 0.0_f64;
    for step in 0..400 {
        // From a hundredth of the reference rate to ten times it, by a tenth up and down.
        let rate = 1e4 * 10.0_f64.powf(-0.5 + 1.5 * (0.05 * f64::from(step)).sin());
        let expected = TIME * rate;
        let stress = MODULUS * expected + flow_stress(&*law, &now, expected);
        let increment = point.plastic_increment(&*law, &now, &trial(stress));
        worst = worst.max(MODULUS * (increment - expected).abs() / stress);
        now.plastic_strain += increment;
    }
    assert!(worst <= 2.0 * TOLERANCE, "{worst}");
}

#[test]
fn the_ratio_along_a_logarithm_is_positive_and_that_of_the_equation_where_it_is_near_one_or_small()
{
    for [hardening, rate] in [[1.0, 0.01], [1.0, 1.0], [0.01, 1.0]] {
        let along = Logarithmic { hardening, rate };
        let stress = |ratio: f64| hardening * ratio + rate * ratio.ln();
        for ratio in [1.0_f64, 1.0 + 1e-3, 1.0 - 1e-3, 1e-6, 1e-9] {
            let step = along.step(stress(ratio) - hardening);
            let cube = (ratio - 1.0).abs().powi(3);
            let is_near = ratio > 0.5;
            assert!(!is_near || (step - ratio).abs() <= cube / 3.0 + 1e-15);
            let root = along.root(stress(ratio));
            let bound = if is_near {
                cube
            } else {
                4.0 * hardening / rate * ratio
            };
            assert!(
                root > 0.0 && (root / ratio - 1.0).abs() <= bound + 1e-12,
                "{hardening} {rate} {ratio}: {root}"
            );
        }
        for excess in [-500.0, -1.0, 1.0, 500.0] {
            assert!(along.root(hardening + excess * rate) > 0.0);
        }
    }
}

#[test]
fn a_law_in_lanes_has_the_bits_of_its_flow_stress() {
    let mut chance = Chance(7);
    for kind in KINDS {
        for _ in 0..200 {
            let law = random(kind, &mut chance);
            let state = FlowState {
                plastic_strain: chance.between(0.0, 2.0),
                strain_rate: 10.0_f64.powf(chance.between(-5.0, 7.0)),
                temperature: chance.between(200.0, 2500.0),
                pressure: chance.between(-1e9, 1e10),
            };
            assert_eq!(law.in_lanes().unwrap().kind(), kind);
            // What libm makes of the slope, by differences of the stress.
            let step = 1e-6 * (state.plastic_strain + 1e-3);
            let further = FlowState {
                plastic_strain: state.plastic_strain + step,
                ..state
            };
            let (here, there) = (law.flow_stress(&state), law.flow_stress(&further));
            let slope = (there.stress - here.stress) / step;
            let scale = here.strain_slope.abs() + 1e-6 * here.stress.abs() / step;
            assert!((slope - here.strain_slope).abs() <= 1e-3 * scale, "{law:?}");
        }
    }
}

#[test]
fn johnson_cook_is_that_of_libm() {
    let law = prepared(
        "johnson_cook = { a = '300 MPa', b = '500 MPa', n = 0.3, c = 0.02, m = 1.1, reference_rate = '1 1/s' }",
    );
    let mut chance = Chance(3);
    for _ in 0..2000 {
        let state = FlowState {
            plastic_strain: chance.between(0.0, 3.0),
            strain_rate: 10.0_f64.powf(chance.between(-3.0, 7.0)),
            temperature: chance.between(200.0, 2000.0),
            pressure: 0.0,
        };
        let homologous = ((state.temperature - 293.0) / (1800.0 - 293.0)).clamp(0.0, 1.0);
        let exact = (300e6 + 500e6 * state.plastic_strain.max(1e-9).powf(0.3))
            * (1.0 + 0.02 * state.strain_rate.max(1.0).ln())
            * (1.0 - homologous.powf(1.1));
        let stress = law.flow_stress(&state).stress;
        // Near the melting point the thermal factor is a small difference.
        assert!(
            (stress - exact).abs() <= 1e-13 * 1e9,
            "{state:?}: {stress} {exact}"
        );
    }
}
