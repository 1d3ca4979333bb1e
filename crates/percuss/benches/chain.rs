//! Time of single runs of the chain model. Compare two versions side by side on one machine; absolute times wander.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use percuss::{
    Scenario, case,
    model::{self, Control},
};

const COLUMN: &str = "target_closure = \"column\"";

fn paper(velocity: f64, elements: (u32, u32), options: &str) -> Scenario {
    let text = format!(
        "projectile = {{ material = \"copper\", length = \"12.74 mm\", diameter = \"4.8 mm\", velocity = \"{velocity} m/s\" }}\n\
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

criterion_group!(benches, runs);
criterion_main!(benches);
