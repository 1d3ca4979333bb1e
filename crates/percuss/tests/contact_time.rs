//! Contact time of equal elastic bodies: the wave goes once to the free end and back, `2L/c`, in every solver.

use crate::common::{assert_near, scenario};
use percuss::{
    model::{self, Control},
    outcome::RunResult,
};

/// Steel without a yield stress, `c = 5000 m/s` along a bar.
fn elastic(poissons_ratio: f64) -> String {
    format!(
        r#"
        [materials.e]
        name = "elastic steel"
        density = "8000 kg/m3"
        youngs_modulus = "200 GPa"
        poissons_ratio = {poissons_ratio}
        equation_of_state = {{ sound_speed = "4500 m/s", slope = 1.5, gruneisen = 2.0 }}
        strength.elastic = {{}}
        "#
    )
}

/// Bar of 50 mm in length and 10 mm in diameter on a target.
fn bar(target: &str, options: &str, poissons_ratio: f64) -> String {
    format!(
        r#"
        projectile = {{ material = "e", length = "50 mm", diameter = "10 mm", impact_velocity = "5 m/s" }}
        target = {{ {target} }}
        {options}
        {}
        "#,
        elastic(poissons_ratio)
    )
}

fn contact_time(name: &str, text: &str) -> RunResult {
    let model = model::model(name).unwrap();
    model::run(model, &scenario(text), &mut Control::default())
        .unwrap_or_else(|error| panic!("{error}\n{text}"))
}

const EXACT: f64 = 2.0 * 50e-3 / 5000.0;
const EQUAL_BAR: &str = "material = 'e', thickness = '50 mm', back_face = 'free'";

#[track_caller]
fn check(what: &str, name: &str, text: &str, exact: f64, within: f64) {
    let result = contact_time(name, text);
    assert_near(what, result.contact_time.unwrap(), exact, within);
}

#[test]
fn equal_bars_touch_for_a_round_trip() {
    let mesh = "projectile_elements = 200\ntarget_elements = 200\nborder_shear = 0.0";
    let chain = format!("[chain]\n{mesh}\nkinematics = 'small-strain'");
    let text = bar(EQUAL_BAR, &chain, 0.3);
    check("chain", "chain", &text, EXACT, 0.01);
    let text = bar(EQUAL_BAR, &format!("[fdm]\n{mesh}"), 0.3);
    check("fdm, rod", "fdm", &text, EXACT, 0.01);
}

/// The run of the published scheme ends when the tip stops: with a fixed rear face that is when the bars would part.
#[test]
fn equal_bars_touch_for_a_round_trip_in_the_published_scheme() {
    let options = "[chain]\nscheme = 'published'\nprojectile_elements = 200\ntarget_elements = 200\nborder_shear = 0.0";
    let text = bar("material = 'e', thickness = '50 mm'", options, 0.3);
    check("published", "chain", &text, EXACT, 0.02);
}

#[test]
fn a_bar_touches_a_rigid_wall_for_a_round_trip() {
    let wall = "rigid_wall = true";
    let mesh = "projectile_elements = 200";
    for (what, name, options) in [
        (
            "chain",
            "chain",
            format!("[chain]\n{mesh}\nkinematics = 'small-strain'"),
        ),
        ("fdm, rod", "fdm", format!("[fdm]\n{mesh}")),
    ] {
        check(what, name, &bar(wall, &options, 0.3), EXACT, 0.01);
    }
    // Without lateral strain the axisymmetric bar is one-dimensional.
    for cells in [4, 8] {
        let options = format!("[axi]\ncells_per_radius = {cells}");
        let what = format!("axi on {cells} cells");
        check(&what, "axi", &bar(wall, &options, 0.0), EXACT, 0.03);
    }
}

/// In uniaxial strain the wave runs at `c_l`, here by the bulk sound speed of the equation of state and the shear modulus.
#[test]
fn equal_plates_touch_for_a_round_trip() {
    let shear: f64 = 200e9 / 2.6;
    let speed = (4500.0_f64.powi(2) + 4.0 / 3.0 * shear / 8000.0).sqrt();
    let text = format!(
        r#"
        projectile = {{ material = "e", length = "5 mm", diameter = "100 mm", impact_velocity = "5 m/s" }}
        target = {{ material = "e", thickness = "5 mm", back_face = "free" }}
        fdm = {{ geometry = "planar" }}
        {}
        "#,
        elastic(0.3)
    );
    check("fdm, planar", "fdm", &text, 2.0 * 5e-3 / speed, 0.02);
}

/// A pause between two contacts does not count.
#[test]
fn a_gap_is_no_contact() {
    let text = bar(EQUAL_BAR, "[fdm]\nprojectile_elements = 100", 0.3);
    let result = contact_time("fdm", &text);
    assert!(result.end_time.unwrap() > 1.5 * result.contact_time.unwrap());
}
