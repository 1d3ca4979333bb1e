//! Numbers of runs in a block.

use super::tests::load;

fn block_size(name: &str, samples: u64, more: &str) -> u64 {
    let text = format!(
        "base = 'scenario.toml'\nmodel = 'chain'\ndesign = 'sobol'\nsamples = {samples}\n\
         [[parameter]]\nkey = 'projectile.impact_velocity'\nuniform = {{ from = '100 m/s', to = '400 m/s' }}\n{more}"
    );
    let sweep = load(name, &text).unwrap_or_else(|error| panic!("{name}: {error}"));
    sweep.block_size
}

#[test]
fn runs_side_by_side_fill_their_lanes() {
    let column = "[[parameter]]\nkey = 'chain.border_shear'\nvalues = [0.5]";
    for (samples, expected) in [(5, 5), (64, 16), (132, 17), (5000, 79), (1_000_000, 1024)] {
        let name = format!("lanes-{samples}");
        assert_eq!(block_size(&name, samples, column), expected, "{samples}");
    }
}

#[test]
fn runs_one_after_the_other_are_shared_among_threads() {
    for (samples, expected) in [(5, 1), (64, 1), (132, 3), (1_000_000, 1024)] {
        let name = format!("alone-{samples}");
        assert_eq!(block_size(&name, samples, ""), expected, "{samples}");
    }
}
