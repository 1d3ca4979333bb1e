//! Runs that are stopped while they are set up.
//!
//! `PERCUSS_SET_UP_GIB` sets the memory of their states.

use std::{
    ops::ControlFlow,
    time::{Duration, Instant},
};

use percuss::{
    Error, Scenario, case,
    model::{self, Checkpoints, Control},
};

/// Memory of a state, unless another one is asked for [GiB].
const MEMORY: f64 = 0.5;
/// Largest time from a request to stop to the end of the run.
const PATIENCE: Duration = Duration::from_millis(500);

/// A case whose state is about as large as asked for.
fn large(name: &str) -> Scenario {
    let asked = std::env::var("PERCUSS_SET_UP_GIB").map_or(MEMORY, |text| text.parse().unwrap());
    let model = model::model(name).unwrap();
    let fits = |scenario: &Scenario| model.estimate(scenario).memory <= asked * 1.0737e9;
    let mut scenarios = (1..200).map(|n| case::load_str("large", &text(name, n)).unwrap());
    let mut last = scenarios.next().unwrap();
    for next in scenarios {
        if !fits(&next) {
            break;
        }
        last = next;
    }
    last
}

fn text(name: &str, n: u32) -> String {
    match name {
        "axi" => format!(
            "projectile = {{ material = 'copper', length = '40 mm', diameter = '10 mm', impact_velocity = '1000 m/s' }}\n\
             target = {{ material = 'aluminium-2024-t351', thickness = '150 mm' }}\naxi.cells_per_radius = {}\n",
            4 * n
        ),
        _ => format!(
            "projectile = {{ material = 'own', length = '20 mm', diameter = '6 mm', impact_velocity = '10 m/s', nose = 'hemisphere' }}\n\
             target = {{ material = 'own', thickness = '100 mm', back_face = 'free' }}\nparticles = {{ spacing = '{} um', width = '400 mm' }}\n\
             materials.own = {{ name = 'Glass', density = '2500 kg/m3', youngs_modulus = '70 GPa', poissons_ratio = 0.2, strength.elastic = {{}}, \
             fracture = {{ energy = '10 J/m2', tensile_strength = '30 MPa' }} }}\n",
            2000.0 / f64::from(4 * n)
        ),
    }
}

/// Time from a request to stop, some time after the start, to the end of the run; `None` for a run that took its first step before.
fn latency(name: &str, scenario: &Scenario, wait: Duration) -> Option<Duration> {
    let start = Instant::now();
    let mut begun = false;
    let mut watch = |now: model::Progress| {
        begun |= now.step > 0;
        match begun || start.elapsed() >= wait {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    };
    // Threads of its own: those of the other tests are busy for many seconds.
    let pool = rayon::ThreadPoolBuilder::new().build().unwrap();
    let model = model::model(name).unwrap();
    let end = pool.install(|| {
        let mut control = Control {
            progress: Some(&mut watch),
            ..Control::default()
        };
        model::run(model, scenario, &mut control)
    });
    let latency = start.elapsed().saturating_sub(wait);
    assert!(matches!(end, Err(Error::Cancelled { .. })), "{name}");
    (!begun).then_some(latency)
}

#[test]
fn a_run_is_stopped_while_it_is_set_up() {
    for name in ["axi", "particles"] {
        let scenario = large(name);
        let (mut worst, mut tried, mut wait) = (Duration::ZERO, 0, Duration::ZERO);
        while let Some(latency) = latency(name, &scenario, wait) {
            worst = worst.max(latency);
            tried += 1;
            wait += Duration::from_millis(100).max(wait / 8);
        }
        let memory = model::model(name).unwrap().estimate(&scenario).memory / 1.0737e9;
        println!(
            "{name}: {tried} stops of a state of {memory:.2} GiB, the last one after {worst:?}"
        );
        assert!(tried > 0 && worst < PATIENCE, "{name}: {worst:?}");
    }
}

/// Where a run leaves checkpoints, they stop it: nothing is kept of a state that is not complete.
#[test]
fn a_request_by_way_of_checkpoints_stops_the_set_up() {
    struct Stopped;
    impl Checkpoints for Stopped {
        fn is_due(&mut self) -> bool {
            true
        }
        fn keep(&mut self, _: &[u8]) -> ControlFlow<()> {
            unreachable!("there is no state yet")
        }
        fn is_stopped(&self) -> bool {
            true
        }
    }
    for name in ["axi", "particles"] {
        let mut checkpoints = Stopped;
        let mut control = Control {
            checkpoints: Some(&mut checkpoints),
            ..Control::default()
        };
        let scenario = case::load_str("small", &text(name, 1)).unwrap();
        let end = model::run(model::model(name).unwrap(), &scenario, &mut control);
        assert!(
            matches!(end, Err(Error::Cancelled { step: 0, .. })),
            "{name}: {end:?}"
        );
    }
}
