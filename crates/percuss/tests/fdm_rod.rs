//! The finite-difference rod against exact solutions and against the chain.

mod common;

use common::{assert_near, fdm, fdm_recorded, mean};
use percuss::{
    case::load_str,
    model::{self, Control},
    outcome::{Outcome, RunResult},
};

#[test]
fn scan() {
    for mesh in [(10, 20), (40, 80)] {
        for speed in [150.0, 230.0, 300.0, 400.0, 600.0, 800.0, 1000.0] {
            let case = format!(
                r#"
        projectile = {{ material = "copper", length = "12.74 mm", diameter = "4.8 mm", velocity = "{speed} m/s" }}
        target = {{ material = "aluminium-2024-t351", thickness = "25 mm" }}
        [chain]
        projectile_elements = {}
        target_elements = {}
        "#,
                mesh.0, mesh.1
            );
            let scenario = load_str("a", &case).unwrap();
            let start = std::time::Instant::now();
            let never = load_str("a", &format!("{case}\nerosion_strain = \"never\"")).unwrap();
            let chain = model::run(model::model("chain").unwrap(), &scenario, &mut Control::default()).unwrap();
            let t1 = start.elapsed();
            let start = std::time::Instant::now();
            let chain2 = model::run(model::model("chain").unwrap(), &never, &mut Control::default());
            let start2 = std::time::Instant::now();
            let f = model::run(model::model("fdm").unwrap(), &scenario, &mut Control::default());
            let t2 = start2.elapsed();
            let _ = start;
            match f {
                Ok(f) => println!(
                "{mesh:?} {speed}: chain {:.5} never {:?} fdm {:.5} {:?} {:?} steps {} {} res {:.1e} {:.1e} {:.1e} {:?} {:?} t {:?} {:?}",
                chain.depth_of_penetration.unwrap() * 1e3,
                chain2.map(|c| c.depth_of_penetration.unwrap() * 1e3).ok(),
                f.depth_of_penetration.unwrap() * 1e3,
                f.outcome, f.termination, chain.numerics().steps,
                f.numerics().steps, f.numerics().energy_residual, chain.numerics().energy_residual, f.numerics().momentum_residual, f.residual_velocity, chain.residual_velocity,
                t1, t2
            ),
            Err(e) => println!("{mesh:?} {speed} chain {:?} {:?} {e}", chain.depth_of_penetration.unwrap()*1e3,  chain2.map(|c| c.depth_of_penetration.unwrap() * 1e3).ok()),
            }
        }
    }
}
