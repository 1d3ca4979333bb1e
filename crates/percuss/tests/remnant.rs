//! Length of a projectile whose hot remnant is drawn out after a very fast impact.

use crate::common::{assert_near, run};

const LENGTH: f64 = 2.5e-3;

/// A copper disc on tungsten carbide at 2870 m/s: nearly molten, its tail flies back from its foot.
fn case(elements: u32, more: &str) -> String {
    format!(
        r#"
        projectile = {{ material = "ofhc-copper", length = "2.5 mm", diameter = "5 mm", impact_velocity = "2870 m/s" }}
        target = {{ material = "tungsten-carbide", thickness = "semi-infinite" }}
        chain = {{ projectile_elements = {elements}{more} }}
        "#
    )
}

const DRAWN_OUT: &str = "were drawn out to as much as";

#[test]
fn a_remnant_that_is_drawn_out_is_no_longer_than_its_material_was() {
    for elements in [20, 40, 80] {
        let result = run(&case(elements, ""));
        let length = result.projectile_final_length.unwrap();
        assert!(length < LENGTH);
        // Drawn out it is 2.0, 3.7 and 6.4 mm long, on these meshes.
        assert_near("final length", length, 0.4e-3, 0.2);
        let warned = &result.warnings[0];
        assert!(
            warned.contains(DRAWN_OUT) && warned.contains("nothing fails in tension"),
            "{warned}"
        );
    }
}

#[test]
fn the_length_of_a_drawn_out_remnant_does_not_depend_on_when_the_run_ends() {
    let length = |end: &str| {
        let result = run(&case(40, &format!(", end_time = '{end}'")));
        result.projectile_final_length.unwrap()
    };
    // Drawn out it grows by two fifths in between. At 6.0 us an element erodes, so the length falls by a fifth.
    assert_near("final length", length("6.5 us"), length("8 us"), 0.15);
}

#[test]
fn a_remnant_in_one_piece_has_the_length_that_it_has() {
    let text = case(40, "").replace("2870 m/s", "600 m/s");
    let result = run(&text);
    assert!(result.projectile_final_length.unwrap() < LENGTH);
    assert!(
        !result
            .warnings
            .iter()
            .any(|words| words.contains(DRAWN_OUT))
    );
}
