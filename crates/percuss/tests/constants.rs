//! The study of the seed paper's constants: which of them matters, by its own equations and by the conservative scheme.

use std::{path::Path, sync::atomic::AtomicBool};

use percuss::{
    model,
    sweep::BatchKernel,
    uncertainty::{Observer, Settings, Study, analyse},
};

/// Total index of a constant for the depth.
fn index_of(key: &str, file: &str, samples: u64) -> f64 {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases/paper-table1-constants");
    let study = Study::load(folder.join(file)).unwrap();
    let settings = Settings {
        samples,
        seed: 0,
        quantities: Vec::new(),
        indices: true,
        velocities: Vec::new(),
    };
    let watch = Observer {
        stop: &AtomicBool::new(false),
        progress: &|_, _| {},
    };
    let chain = model::model("chain").unwrap();
    let found = analyse(&study, chain, &BatchKernel::new(chain), &settings, &watch).unwrap();
    let depth = &found.quantities[0];
    assert_eq!(depth.quantity, "depth_of_penetration_mm");
    let indices = depth.indices.as_ref().unwrap();
    let of = |one: &str| {
        let found = indices.parameters.iter().find(|p| p.key == one).unwrap();
        found.total.value
    };
    let all: f64 = indices.parameters.iter().map(|p| p.total.value).sum();
    println!("{file}: {key} {:.3} of {all:.3}", of(key));
    assert!((0.7..1.4).contains(&all));
    of(key)
}

#[test]
fn border_shear_matters_where_books_balance_and_not_in_the_paper() {
    let key = "chain.border_shear";
    assert!(index_of(key, "scenario.toml", 16) < 0.01);
    assert!((0.03..0.15).contains(&index_of(key, "joined.toml", 64)));
    assert!(index_of(key, "conservative.toml", 64) > 0.7);
}
