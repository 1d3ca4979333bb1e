//! Values and places that the frames of a run reach, and the part of the plane that shows them.

use percuss::{Scenario, scenario::TargetBody};

use super::raster::View;

/// Part of the values of a frame that may lie beyond the ends of the colours.
const BEYOND: f64 = 1e-3;

/// Smallest and largest of the values of a frame, without the few that lie far beyond.
pub fn usual_range(mut values: Vec<f32>) -> (f32, f32) {
    values.sort_unstable_by(f32::total_cmp);
    let beyond = (BEYOND * values.len() as f64) as usize;
    let at = |index: usize| values.get(index).copied().unwrap_or(0.0);
    (at(beyond), at(values.len().saturating_sub(1 + beyond)))
}

/// What frames reach.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FieldSpan {
    values: (f32, f32),
    /// Largest radius and range of depths of the projectile [m].
    rod: (f32, (f32, f32)),
    /// Largest depth of material of the target near the axis, and of the crater floor [m].
    target: f32,
    /// Largest radius of the target [m].
    across: f32,
    depth: f64,
}

impl FieldSpan {
    /// The span of a frame: of its values, of its places (radius and depth [m], and the index of the body), and of the depth of the crater
    /// floor [m].
    pub fn new(
        values: (f32, f32),
        places: impl Iterator<Item = ([f32; 2], u8)>,
        depth: f64,
    ) -> Self {
        let mut span = Self {
            values,
            rod: (0.0, (0.0, 0.0)),
            target: 0.0,
            across: 0.0,
            depth,
        };
        for ([radius, depth], body) in places {
            if body == 0 {
                let (widest, (back, front)) = span.rod;
                span.rod = (
                    widest.max(radius.abs()),
                    (back.min(depth), front.max(depth)),
                );
            } else {
                span.target = span.target.max(depth);
                span.across = span.across.max(radius.abs());
            }
        }
        span
    }

    /// The span of this and of other frames.
    #[must_use]
    pub fn with(self, other: Self) -> Self {
        let range = |a: (f32, f32), b: (f32, f32)| (a.0.min(b.0), a.1.max(b.1));
        Self {
            values: range(self.values, other.values),
            rod: (self.rod.0.max(other.rod.0), range(self.rod.1, other.rod.1)),
            target: self.target.max(other.target),
            across: self.across.max(other.across),
            depth: self.depth.max(other.depth),
        }
    }

    /// Smallest and largest value.
    pub fn values(&self) -> (f32, f32) {
        self.values
    }

    /// What pictures show: the projectile at all times, and of the target what the impact changes.
    pub fn view(&self, scenario: &Scenario) -> View {
        let radius = 0.5 * scenario.projectile.diameter;
        let (widest, (back, front)) = self.rod;
        let (back, front) = (f64::from(back) - radius, f64::from(front));
        if scenario.target == TargetBody::RigidWall {
            return View {
                radius: f64::from(widest).max(2.0 * radius) + radius,
                depth: (back, 0.8 * radius),
            };
        }
        let shown = (self.depth + 5.0 * radius).max(6.0 * radius);
        // Where a plate ends there is something to be seen of what is behind it.
        let end = match scenario.target_thickness() {
            Some(_) => f64::from(self.target) + radius,
            None => f64::from(self.target),
        };
        View {
            // A narrow target is shown whole.
            radius: (f64::from(widest) + radius)
                .max((6.0 * radius).min(f64::from(self.across) + radius)),
            depth: (back, end.min(shown).max(front + radius)),
        }
    }
}

#[cfg(test)]
mod tests {
    use percuss::case;

    use super::FieldSpan;

    /// A target narrower than three diameters of the projectile is shown whole, a wider one as far as that.
    #[test]
    fn a_narrow_target_fills_the_picture() {
        let text = r#"
            projectile = { material = "copper", length = "10 mm", diameter = "10 mm", impact_velocity = "100 m/s" }
            target = { material = "copper", thickness = "5 mm" }
        "#;
        let scenario = case::load_str("narrow", text).unwrap();
        for (half_width, shown) in [(2.5e-3_f32, 10e-3), (18e-3, 23e-3), (90e-3, 30e-3)] {
            let places = [([5e-3_f32, -10e-3], 0_u8), ([half_width, 5e-3], 1)];
            let span = FieldSpan::new((0.0, 1.0), places.into_iter(), 0.0);
            let radius = span.view(&scenario).radius;
            assert!((radius - shown).abs() < 1e-9, "{half_width}: {radius}");
        }
    }
}
