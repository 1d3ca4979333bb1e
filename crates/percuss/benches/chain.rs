//! Time of runs of the chain model, single and side by side. Compare two versions side by side on one machine; absolute times wander.

use std::{hint::black_box, sync::atomic::AtomicBool};

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use percuss::{
    Scenario, case,
    model::{self, Control},
    sweep::{BatchKernel, Kernel, SweepRun},
};

const COLUMN: &str = "target_resistance = \"column\"";

fn paper(velocity: f64, elements: (u32, u32), options: &str) -> Scenario {
    let text = format!(
        "projectile = {{ material = \"copper\", length = \"12.74 mm\", diameter = \"4.8 mm\", impact_velocity = \"{velocity} m/s\" }}\n\
         target = {{ material = \"aluminium-2024-t351\", thickness = \"25 mm\" }}\n\
         [chain]\nprojectile_elements = {}\ntarget_elements = {}\n{options}\n",
        elements.0, elements.1
    );
    case::load_str("bench", &text).unwrap_or_else(|error| panic!("{error}"))
}

fn runs(criterion: &mut Criterion) {
    let chain = model::model("chain").unwrap_or_else(|error| panic!("{error}"));
    let mut group = criterion.benchmark_group("chain");
    for (name, scenario) in [
        ("paper case to rest, 40-80", paper(230.0, (40, 80), COLUMN)),
        (
            "paper case to rest, 160-320",
            paper(230.0, (160, 320), COLUMN),
        ),
        (
            "600 m/s with erosion, 40-80",
            paper(600.0, (40, 80), COLUMN),
        ),
        (
            "expanding cavity to rest, 40-80",
            paper(230.0, (40, 80), ""),
        ),
        (
            "published, chain, 40-80",
            paper(230.0, (40, 80), "scheme = \"published\""),
        ),
    ] {
        let run = || model::run(chain, &scenario, &mut Control::default());
        let steps = run()
            .unwrap_or_else(|error| panic!("{error}"))
            .numerics()
            .steps;
        let elements =
            scenario.options.chain.projectile_elements() + scenario.options.chain.target_elements();
        group.throughput(Throughput::Elements(steps * elements as u64));
        group.bench_function(name, |bencher| bencher.iter(|| black_box(run())));
    }
    group.finish();
}

fn side_by_side(criterion: &mut Criterion) {
    let chain = model::model("chain").unwrap_or_else(|error| panic!("{error}"));
    let shot = |i: u32| SweepRun {
        index: u64::from(i),
        inputs: Vec::new(),
        scenario: Ok(paper(150.0 + 3.5 * f64::from(i), (40, 80), COLUMN)),
    };
    let runs: Vec<SweepRun> = (0..64).map(shot).collect();
    let mut group = criterion.benchmark_group("chain");
    group.throughput(Throughput::Elements(runs.len() as u64));
    group.bench_function("64 runs side by side, 40-80", |bencher| {
        let rows = || BatchKernel::new(chain).rows(runs.clone(), &AtomicBool::new(false));
        bencher.iter(|| black_box(rows()));
    });
    group.finish();
}

criterion_group!(benches, runs, side_by_side);
criterion_main!(benches);
