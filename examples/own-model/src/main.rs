//! A model with options of its own, a strength law and a failure law, all outside percuss.
//!
//! `cargo run --manifest-path examples/own-model/Cargo.toml` computes `case.toml` with them.

mod failure;
mod model;
mod strength;

use std::{error::Error, path::Path, sync::Arc};

use percuss::{
    case,
    material::{Failure, OwnFailure, OwnLaw, Strength},
    model::{Control, run},
    outcome::RunResult,
};

use crate::{failure::LargestTension, model::ConstantResistance, strength::LinearHardening};

fn main() -> Result<(), Box<dyn Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut scenario = case::load(folder.join("case.toml"))?;
    let chain = percuss::model::model("chain")?;

    // The model reads its table of the case.
    show(&run(
        &ConstantResistance,
        &scenario,
        &mut Control::default(),
    )?);
    show(&run(chain, &scenario, &mut Control::default())?);

    // The same rod by another strength law, which the case file does not have.
    let law = LinearHardening {
        yield_stress: 1.1e9,
        modulus: 0.6e9,
    };
    let rod = Arc::make_mut(&mut scenario.projectile.material);
    rod.strength = Strength::Own(OwnLaw(Arc::new(law)));
    show(&run(chain, &scenario, &mut Control::default())?);

    // And with failure at a tension.
    let failure = LargestTension { stress: 60e6 };
    scenario.options.chain.failure = Some(Failure::Own(OwnFailure(Arc::new(failure))));
    show(&run(chain, &scenario, &mut Control::default())?);
    Ok(())
}

fn show(result: &RunResult) {
    let depth = result
        .depth_of_penetration
        .map_or(f64::NAN, |depth| 1e3 * depth);
    println!(
        "{:<20} depth {depth:6.2} mm, {}, {} pieces",
        result.model,
        result.outcome.describe(),
        result.fragments.len()
    );
}
