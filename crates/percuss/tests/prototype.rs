//! Cross-check against figures of an independent implementation of the same scheme.
//!
//! Its figures are depths [mm] with the tip at the moment the projectile's momentum is used up. They are no truth; where
//! the two differ, `docs/verification.md` says why.

use crate::common::{assert_near, paper, run, wilkins};

/// The target that both implement.
const COLUMN: &str = "target_resistance = \"column\"";

fn depth_mm(text: &str) -> f64 {
    run(text).depth_of_penetration.unwrap() * 1e3
}

#[test]
fn without_border_shear_the_depths_agree() {
    for (elements, other) in [
        ((20, 40), 0.187),
        ((40, 80), 0.173),
        ((80, 160), 0.168),
        ((160, 320), 0.168),
    ] {
        let depth = depth_mm(&paper(
            230.0,
            elements,
            &format!("{COLUMN}\nborder_shear = 0.0"),
        ));
        assert_near(&format!("depth on {elements:?} [mm]"), depth, other, 0.01);
    }
}

#[test]
fn with_border_shear_they_agree_on_fine_meshes() {
    for (elements, other) in [
        ((40, 80), 0.036),
        ((80, 160), 0.028),
        ((160, 320), 0.0250),
        ((320, 640), 0.0247),
    ] {
        let depth = depth_mm(&paper(230.0, elements, COLUMN));
        assert_near(&format!("depth on {elements:?} [mm]"), depth, other, 0.05);
    }
}

/// At high speed the two agree where the way in which eroded length is closed matters little.
#[test]
fn with_erosion_they_agree_at_800_and_1000_m_s() {
    for (velocity, other) in [(800.0, 2.12), (1000.0, 3.51)] {
        let text = paper(velocity, (40, 80), COLUMN).replace("25 mm", "50 mm");
        assert_near(
            &format!("depth at {velocity} m/s [mm]"),
            depth_mm(&text),
            other,
            0.05,
        );
    }
}

#[test]
fn taylor_bars_agree() {
    for (velocity, other) in [
        (89.0, 21.30),
        (123.0, 19.74),
        (153.0, 18.17),
        (183.0, 16.48),
    ] {
        let result = run(&wilkins(velocity));
        let length = result.projectile_final_length.unwrap() * 1e3;
        assert_near(
            &format!("final length at {velocity} m/s [mm]"),
            length,
            other,
            0.025,
        );
    }
}
