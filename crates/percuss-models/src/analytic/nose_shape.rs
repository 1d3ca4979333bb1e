//! Part of a plate that a nose has opened, by the shape of the nose.

use std::f64::consts::PI;

use super::gauss::integral;
use crate::{bisection::bisected, problem::Nose};

/// Panels of the nose; one is exact for hemispheres and cones.
const PANELS: u32 = 4;

/// Volume [m3] of the part of the projectile within a distance behind its tip [m].
fn volume_behind_tip(nose: Nose, diameter: f64, distance: f64) -> f64 {
    if distance <= 0.0 {
        return 0.0;
    }
    let within_nose = distance.min(nose.length(diameter));
    let square = |x: f64| nose.radius(diameter, x).powi(2);
    PI * integral(0.0, within_nose, PANELS, square)
        + PI * diameter * diameter / 4.0 * (distance - within_nose)
}

/// Volume of a plate [m3] that is filled when the tip has moved this far below the struck face [m].
pub(super) fn opened_volume(nose: Nose, diameter: f64, thickness: f64, tip: f64) -> f64 {
    volume_behind_tip(nose, diameter, tip) - volume_behind_tip(nose, diameter, tip - thickness)
}

/// Depth of the tip [m] at which this part of the hole through a plate is opened, 0 to 1.
pub(super) fn tip_depth(nose: Nose, diameter: f64, thickness: f64, part: f64) -> f64 {
    let whole = PI * diameter * diameter / 4.0 * thickness;
    let deepest = thickness + nose.length(diameter);
    bisected(0.0, deepest, 60, |tip| {
        opened_volume(nose, diameter, thickness, tip) < part * whole
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Integral of the square of the radius over a distance behind the tip, within the nose.
    fn squares_behind_tip(nose: Nose, diameter: f64, x: f64) -> f64 {
        let shank = diameter / 2.0;
        let length = nose.length(diameter);
        match nose {
            Nose::Flat => 0.0,
            Nose::Hemisphere => x * x * (shank - x / 3.0),
            Nose::Cone { .. } => shank * shank * x.powi(3) / (3.0 * length * length),
            Nose::Ogive { crh } => {
                let arc = crh * diameter;
                let centre = arc - shank;
                // Over the distance to the shank: (√(arc² − y²) − centre)².
                let primitive = |y: f64| {
                    let of_root = y * (arc * arc - y * y).sqrt() + arc * arc * (y / arc).asin();
                    (arc * arc + centre * centre) * y - y.powi(3) / 3.0 - centre * of_root
                };
                primitive(length) - primitive(length - x)
            }
        }
    }

    #[test]
    fn volumes_have_their_closed_forms() {
        let diameter = 0.02;
        for nose in [
            Nose::Hemisphere,
            Nose::Cone {
                length_to_diameter: 1.5,
            },
            Nose::Ogive { crh: 0.5 },
            Nose::Ogive { crh: 3.0 },
        ] {
            for part in [0.03, 0.4, 1.0] {
                let distance = part * nose.length(diameter);
                let volume = volume_behind_tip(nose, diameter, distance);
                let exact = PI * squares_behind_tip(nose, diameter, distance);
                let error = volume / exact - 1.0;
                // The closed form of an ogive loses digits near its tip.
                assert!(error.abs() < 1e-9, "{nose:?} {part}: {error}");
            }
        }
    }

    #[test]
    fn a_nose_that_went_through_opened_the_whole_hole() {
        for nose in [
            Nose::Hemisphere,
            Nose::Cone {
                length_to_diameter: 1.5,
            },
            Nose::Ogive { crh: 3.0 },
        ] {
            let (diameter, thickness) = (0.02, 0.012);
            let through = thickness + nose.length(diameter);
            let whole = PI * diameter * diameter / 4.0 * thickness;
            let opened = opened_volume(nose, diameter, thickness, through);
            assert!(
                (opened / whole - 1.0).abs() < 1e-6,
                "{nose:?} {opened} {whole}"
            );
            let nose_volume = volume_behind_tip(nose, diameter, nose.length(diameter));
            assert!(
                (nose_volume / nose.volume(diameter) - 1.0).abs() < 1e-6,
                "{nose:?}"
            );
            assert!(tip_depth(nose, diameter, thickness, 0.0) < 1e-9);
        }
    }

    #[test]
    fn a_cone_opens_the_cube_of_its_depth() {
        let nose = Nose::Cone {
            length_to_diameter: 2.0,
        };
        let opened = |tip| opened_volume(nose, 0.01, 0.02, tip);
        assert!((opened(0.01) / opened(0.005) - 8.0).abs() < 1e-9);
    }
}
