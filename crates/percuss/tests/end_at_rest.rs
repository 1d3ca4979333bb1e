//! Runs that end when the depth of penetration is known.

use percuss::{
    Error, case,
    model::{self, Control},
    outcome::{Outcome, RunResult, Termination},
    scenario::Scenario,
};

const THICK: &str = "material = '6061-t6-lesuer', thickness = 'semi-infinite'";

fn scenario(target: &str, velocity: f64, options: &str) -> Result<Scenario, Error> {
    let text = format!(
        "projectile = {{ material = 'etp-copper-johnson-cook', length = '20 mm', diameter = '6 mm', impact_velocity = '{velocity} m/s' }}\n\
         target = {{ {target} }}\n{options}"
    );
    case::load_str("rest", &text)
}

fn run(model: &str, scenario: &Scenario) -> RunResult {
    model::run(
        model::model(model).unwrap(),
        scenario,
        &mut Control::default(),
    )
    .unwrap_or_else(|error| panic!("{model}: {error}"))
}

#[test]
fn a_run_that_ends_at_rest_has_the_same_depth_in_fewer_steps() {
    for (model, target, options) in [
        ("chain", THICK, ""),
        (
            "chain",
            "material = '6061-t6-lesuer', thickness = '40 mm'",
            "",
        ),
        ("chain", THICK, "chain.target_resistance = 'column'"),
        (
            "chain",
            THICK,
            "chain.target_resistance = 'diverging-penetrable'",
        ),
        ("fdm", THICK, ""),
        ("axi", THICK, "axi.cells_per_radius = 3"),
    ] {
        for velocity in [200.0, 500.0] {
            let of = |more: &str| {
                let options = format!("{options}\n{more}");
                run(model, &scenario(target, velocity, &options).unwrap())
            };
            let (whole, short) = (of(""), of(&format!("{model}.end_at_rest = true")));
            let place = format!("{model} {target} {options} {velocity}");
            assert_eq!(short.termination, Termination::AtRest, "{place}");
            assert_eq!(short.outcome, Outcome::AtRest, "{place}");
            assert_eq!(
                short.depth_of_penetration, whole.depth_of_penetration,
                "{place}"
            );
            assert_eq!(short.time_to_rest, whole.time_to_rest, "{place}");
            assert_eq!(short.end_time, short.time_to_rest, "{place}");
            let steps = [&short, &whole].map(|result| result.numerics().steps);
            assert!(steps[0] < steps[1], "{place}: {steps:?}");
            for unknown in [
                short.largest_depth,
                short.permanent_depth,
                short.residual_velocity,
                short.projectile_final_length,
                short.contact_time,
            ] {
                assert_eq!(unknown, None, "{place}");
            }
        }
    }
}

#[test]
fn a_run_that_may_still_perforate_does_not_end_at_rest() {
    // In the thin plate the crater is deeper than half of it when the projectile rests.
    for (thickness, ends) in [(6.0, false), (60.0, true)] {
        let target = format!(
            "material = '6061-t6-lesuer', thickness = '{thickness} mm', back_face = 'fixed'"
        );
        let of = |options: &str| run("chain", &scenario(&target, 550.0, options).unwrap());
        let (whole, short) = (of(""), of("chain.end_at_rest = true"));
        assert_eq!(whole.outcome, Outcome::Rebounded, "{thickness}");
        let depth = whole.depth_of_penetration.unwrap() * 1e3;
        assert_eq!(depth < 0.5 * thickness, ends, "{depth}");
        assert_eq!(short.termination == Termination::AtRest, ends);
        assert_eq!(short.depth_of_penetration, whole.depth_of_penetration);
        assert_eq!(short.permanent_depth == whole.permanent_depth, !ends);
    }
    // A projectile that comes through never rests.
    let thin = "material = '6061-t6-lesuer', thickness = '2 mm'";
    let options = "chain.end_at_rest = true";
    let result = run("chain", &scenario(thin, 700.0, options).unwrap());
    assert_eq!(result.outcome, Outcome::Perforated);
    assert!(result.residual_velocity.unwrap() > 0.0);
}

#[test]
fn where_nothing_comes_to_rest_the_option_is_refused() {
    for (target, options, said) in [
        (
            "rigid_wall = true",
            "chain.end_at_rest = true",
            "a rigid wall or a constant pressure has no `end_at_rest`",
        ),
        (
            "rigid_wall = true",
            "axi.end_at_rest = true",
            "a rigid wall or a constant pressure has no `end_at_rest`",
        ),
        (
            THICK,
            "chain = { scheme = 'published', end_at_rest = true }",
            "scheme `published` has no `end_at_rest`",
        ),
        (
            THICK,
            "fdm = { geometry = 'planar', end_at_rest = true }",
            "geometry `planar` has no `end_at_rest`",
        ),
    ] {
        let error = scenario(target, 300.0, options).unwrap_err().to_string();
        assert!(error.contains(said), "{error}");
    }
}

#[test]
fn a_rod_that_is_still_pushed_back_is_not_at_rest() {
    // At some of these speeds the rod has no momentum at the moment at which a window of the run ends.
    for velocity in [103.0, 196.0, 199.0, 200.0, 202.0, 205.0] {
        let text = format!(
            "projectile = {{ material = 'copper', length = '12.74 mm', diameter = '4.8 mm', impact_velocity = '{velocity} m/s' }}\n\
             target = {{ material = 'aluminium-2024-t351', thickness = 'semi-infinite' }}"
        );
        let result = run("chain", &case::load_str("back", &text).unwrap());
        assert_eq!(result.outcome, Outcome::Rebounded, "{velocity}");
        // From 12.6 m/s at 103 m/s to 16.2 m/s at 205 m/s; it was below 1 % of the impact velocity.
        let rebound = -result.residual_velocity.unwrap();
        assert!((12.0..17.0).contains(&rebound), "{velocity}: {rebound}");
    }
}
