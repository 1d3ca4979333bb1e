//! First-order impact and penetration mechanics: depth of penetration, residual velocity and ballistic limit, with an estimated model error.
//!
//! A [`Scenario`] comes from a case file; a [`model::Model`] computes it; a [`outcome::RunResult`] carries the numbers, the
//! energy and momentum balances and the warnings. Everything inside is in SI units, compression positive.
//!
//! ```
//! use percuss::{case, model::{self, Control}};
//!
//! let scenario = case::load_str("example", r#"
//!     projectile = { material = "copper", length = "12.74 mm", diameter = "4.8 mm", impact_velocity = "230 m/s" }
//!     target = { material = "aluminium-2024-t351", thickness = "25 mm" }
//! "#)?;
//! let result = model::run(model::model("chain")?, &scenario, &mut Control::default())?;
//! let depth_mm = result.depth_of_penetration.unwrap() * 1e3;
//! assert!(depth_mm > 0.2 && depth_mm < 0.25);
//! assert!(result.numerics().energy_residual < 1e-3 && result.numerics().momentum_residual < 1e-12);
//! # Ok::<(), percuss::Error>(())
//! ```
//!
//! At several impact velocities, with the history of each run, its fields on the way, and the reason where the model does not apply:
//!
//! ```
//! use std::ops::ControlFlow;
//! use percuss::{Error, case::{Case, Projectile, Target}, frames::Frame, model::{self, Control}, units::{Length, Velocity}};
//!
//! let mm = |value: f64| Length::new(1e-3 * value);
//! let rod = Projectile::rod("copper", mm(12.74), mm(4.8), Velocity::new(230.0));
//! let scenario = Case::new(rod, Target::plate("aluminium-2024-t351", mm(25.0))).scenario("copper-on-aluminium")?;
//! let chain = model::model("chain")?;
//! for speed in [200.0, 300.0, 400.0] {
//!     let mut frames = 0;
//!     let mut count = |_: &Frame<'_>| {
//!         frames += 1;
//!         ControlFlow::Continue(())
//!     };
//!     let mut control = Control { frames: Some(&mut count), ..Control::recording() };
//!     match model::run(chain, &scenario.at_impact_velocity(speed), &mut control) {
//!         Ok(result) => {
//!             let samples = result.history.map_or(0, |history| history.samples.len());
//!             println!("{speed} m/s: {:?} m, {samples} samples, {frames} frames", result.depth_of_penetration);
//!         }
//!         Err(Error::NotApplicable { refusal, .. }) => println!("{speed} m/s: {refusal}"),
//!         Err(other) => return Err(other),
//!     }
//! }
//! # Ok::<(), percuss::Error>(())
//! ```
//!
//! A case is also built without a text: [`case::Case::scenario`]. A scenario that a program changes is checked as a case file is:
//! [`Scenario::check`]. [`model::Model::estimate`] tells time and memory of a run beforehand, and [`solver::checkpoint`] what interrupted
//! ones leave. A model, a strength law, a failure law or a resistance law of your own
//! implements [`model::Model`], [`material::StrengthLaw`], [`material::FailureLaw`] or [`resistance::ResistanceLaw`]; the options of
//! such a model stand in the case under `extensions`. The folder `examples/own-model` of the repository has one of each of the first three.

#[doc(inline)]
pub use percuss_core::{
    Error, InputError, NumericalError, Refusal, Scenario, Subject, check, document, error,
    fragments, history, input_file, ledger, material, options, outcome, power, problem, quote,
    regime, resistance, richardson, scenario, shapes, solver,
    solver::{checkpoint, frames},
    statistics, units, validity,
};
#[doc(inline)]
pub use percuss_input::{case, inputs, lsdyna, material_tables};
#[doc(inline)]
pub use percuss_models::{analytic, axi, chain, fdm, model, particles};
#[doc(inline)]
pub use percuss_studies::{
    axisymmetric, calibrate, compare, converge, cost, experiments, limit, measured_curves,
    mesh_choice, model_error, summary, sweep, uncertainty, v50, validate,
};

/// The library example of the quick start, run from the folder that it stands in.
#[cfg(doctest)]
mod quick_start {
    #![doc = include_str!("../../../docs/quick-start.md")]
}
