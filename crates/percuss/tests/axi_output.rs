//! Output of model `axi` besides its result: frames, and checkpoints from which a run continues with the same bits.

use std::ops::ControlFlow;

use percuss::{
    Error, Scenario, case,
    checkpoint::Header,
    model::{self, Checkpoints, Control},
    outcome::RunResult,
};

fn scenario(speed: &str) -> Scenario {
    let text = format!(
        r#"
        projectile = {{ material = "copper", length = "6 mm", diameter = "4 mm", impact_velocity = "{speed}" }}
        target = {{ material = "aluminium-2024-t351", thickness = "semi-infinite" }}
        [axi]
        cells_per_radius = 4
        target_radius = "12 mm"
        target_depth = "14 mm"
        end_time = "6 us"
        "#
    );
    case::load_str("axi-output", &text).unwrap()
}

fn run(scenario: &Scenario, control: &mut Control<'_>) -> Result<RunResult, Error> {
    model::run(model::model("axi").unwrap(), scenario, control)
}

/// Keeps the first checkpoint, of the second time that it is asked, and may stop the run there.
#[derive(Default)]
struct Keeper {
    asked: u32,
    stop: bool,
    kept: Vec<u8>,
}

impl Checkpoints for Keeper {
    fn is_due(&mut self) -> bool {
        self.asked += 1;
        self.asked == 2
    }

    fn keep(&mut self, bytes: &[u8]) -> ControlFlow<()> {
        self.kept = bytes.to_vec();
        if self.stop {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }
}

fn interrupted(scenario: &Scenario) -> Vec<u8> {
    let mut keeper = Keeper {
        stop: true,
        ..Keeper::default()
    };
    let mut control = Control {
        checkpoints: Some(&mut keeper),
        ..Control::recording()
    };
    let stopped = run(scenario, &mut control);
    assert!(matches!(stopped, Err(Error::Cancelled { step: 20, .. })));
    keeper.kept
}

fn resumed(scenario: &Scenario, bytes: &[u8]) -> Result<RunResult, Error> {
    let mut control = Control {
        resume: Some(bytes),
        ..Control::recording()
    };
    run(scenario, &mut control)
}

/// Everything that a run says, in words that are the same only for the same bits: displacements of cells are no numbers, which equal nothing.
fn words(result: &RunResult) -> String {
    format!("{result:?}")
}

#[test]
fn an_interrupted_run_goes_on_with_the_same_bits_on_any_number_of_threads() {
    let scenario = scenario("600 m/s");
    let whole = run(&scenario, &mut Control::recording()).unwrap();
    assert!(whole.numerics().steps > 60);
    let bytes = interrupted(&scenario);
    for threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        let found = pool.install(|| resumed(&scenario, &bytes)).unwrap();
        assert_eq!(words(&found), words(&whole));
        let repeated = pool.install(|| run(&scenario, &mut Control::recording()));
        assert_eq!(words(&repeated.unwrap()), words(&whole));
    }
}

#[test]
fn a_checkpoint_that_is_left_changes_nothing() {
    let scenario = scenario("600 m/s");
    let whole = run(&scenario, &mut Control::recording()).unwrap();
    let mut keeper = Keeper::default();
    let mut control = Control {
        checkpoints: Some(&mut keeper),
        ..Control::recording()
    };
    assert_eq!(words(&run(&scenario, &mut control).unwrap()), words(&whole));
    let header = Header::read(&keeper.kept, "axi", &scenario).unwrap();
    assert_eq!(header.step, 20);
    assert!(header.time > 0.0 && header.time < 6e-6);
}

#[test]
fn a_run_may_go_on_for_longer_than_it_was_meant_to() {
    let scenario = scenario("600 m/s");
    let bytes = interrupted(&scenario);
    let mut longer = scenario.clone();
    longer.title = "for longer".to_owned();
    longer.options.axi.end_time = Some(percuss::units::Time::new(7e-6));
    let result = resumed(&longer, &bytes).unwrap();
    assert!(result.end_time.unwrap() >= 7e-6);
    let whole = run(&longer, &mut Control::recording()).unwrap();
    assert_eq!(words(&result), words(&whole));
}

#[test]
fn a_checkpoint_of_something_else_is_refused() {
    let scenario = scenario("600 m/s");
    let bytes = interrupted(&scenario);
    let reason = |scenario: &Scenario, bytes: &[u8]| match resumed(scenario, bytes) {
        Err(Error::Checkpoint { reason, .. }) => reason,
        other => panic!("{other:?}"),
    };
    let faster = scenario.at_impact_velocity(601.0);
    assert!(reason(&faster, &bytes).contains("another case"));
    assert!(reason(&scenario, b"something").contains("no checkpoint"));
    assert!(reason(&scenario, &bytes[..bytes.len() - 1]).contains("damaged"));
    let mut turned = bytes.clone();
    let last = turned.len() - 9;
    turned[last] ^= 1;
    assert!(reason(&scenario, &turned).contains("damaged"));
    let other = Header::read(&bytes, "chain", &scenario);
    assert!(matches!(other, Err(Error::Checkpoint { .. })));
}

#[test]
fn frames_come_at_even_intervals_and_hold_the_whole_mass() {
    let scenario = scenario("600 m/s");
    let (mut times, mut numbers) = (Vec::new(), Vec::new());
    let mut look = |frame: &percuss::frames::Frame<'_>| {
        let mass: f64 = frame
            .fields
            .particles()
            .map(|(_, particle)| particle.mass)
            .sum();
        let rod: f64 = frame
            .fields
            .particles()
            .filter(|(body, _)| *body == 0)
            .map(|(_, particle)| particle.mass)
            .sum();
        assert!((rod / scenario.projectile.mass - 1.0).abs() < 1e-12);
        assert!(mass > rod && frame.fields.particles().any(|(body, _)| body == 1));
        if frame.last && numbers.last() == Some(&frame.number) {
            return ControlFlow::Continue(());
        }
        times.push(frame.time);
        numbers.push(frame.number);
        ControlFlow::Continue(())
    };
    let mut control = Control {
        frames: Some(&mut look),
        ..Control::default()
    };
    let result = run(&scenario, &mut control).unwrap();
    assert_eq!(times[0], 0.0);
    assert_eq!(times.last().copied(), result.end_time);
    assert!(numbers.windows(2).all(|pair| pair[0] < pair[1]));
    // 6 mm at 600 m/s take 10 us, of which the run has 6.
    assert!((55..=62).contains(&times.len()), "{}", times.len());
    let shapes = result.shapes.unwrap();
    assert_eq!(shapes.crater[0][0], 0.0);
    assert_eq!(shapes.crater[0][1], result.permanent_depth.unwrap());
    let length = shapes.projectile.last().unwrap()[1] - shapes.projectile[0][1];
    assert_eq!(Some(length), result.projectile_final_length);
}

/// The crater of a target whose layers have parted is in the first of them. Where the plate has bent by less than its thickness, from 2.5 diameters
/// on, every surface of the second layer is deeper than 4 mm; the volume is below that of the first.
#[test]
fn a_crater_is_in_the_struck_layer() {
    let text = r#"
        projectile = { material = "4340", length = "50 mm", diameter = "10 mm", impact_velocity = "400 m/s" }
        target = { back_face = "free", layers = [{ material = "2024-t3", thickness = "4 mm" }, { material = "2024-t3", thickness = "4 mm" }] }
        axi.cells_per_radius = 3
    "#;
    let scenario = case::load_str("two-layers", text).unwrap();
    let result = run(&scenario, &mut Control::default()).unwrap();
    let crater = result.shapes.unwrap().crater;
    let far: Vec<_> = crater.iter().filter(|[r, _]| *r > 25e-3).collect();
    println!("{far:.4?}");
    assert!(
        far.len() > 3 && far.iter().all(|[_, depth]| *depth < 4e-3),
        "{far:.4?}"
    );
    let volume = result
        .details
        .iter()
        .find(|detail| detail.name.contains("crater volume"));
    let volume = volume.unwrap().value;
    assert!(
        volume < std::f64::consts::PI * 50.0 * 50.0 * 4.0,
        "{volume}"
    );
}
