//! Flow of a rod against the floor of a crater: how far it spreads, and how fast it leaves.

/// Iterations of Newton's method: quadratic convergence needs a handful.
const ITERATIONS: u32 = 60;
const TOLERANCE: f64 = 1e-14;

/// A rod that flows at one stress.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct RodFlow {
    /// Density [kg/m3].
    pub(super) density: f64,
    /// Flow stress Y [Pa].
    pub(super) strength: f64,
    /// Cross-section [m2].
    pub(super) area: f64,
}

/// What becomes of the metal of a rod at the floor of a crater.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Turned {
    /// Area of the floor over the cross-section of the rod.
    pub(super) spread: f64,
    /// Speed at which the metal leaves the floor over that at which it arrives.
    pub(super) leaving: f64,
}

impl RodFlow {
    /// The flow of metal that arrives at a speed w [m/s] in the frame of the floor.
    ///
    /// With `e = ρw²/Y` and x the speed of leaving over w: force over stagnation pressure is `κ = (1 + e(1 + x))/(1 + e/2)`, and the
    /// energy per volume gives `x² = 1 − (2/e) ln κ`. The miss is convex and grows with x, so that Newton's method from x = 1 descends to the one root.
    pub(super) fn turned(&self, speed: f64) -> Turned {
        let e = self.density * speed * speed / self.strength;
        if e < 1e-9 {
            // x = 3e/8 and κ = 1 + e/2 to first order.
            return Turned {
                spread: 1.0 + 0.5 * e,
                leaving: 0.375 * e,
            };
        }
        let spread = |x: f64| e * (0.5 + x) / (1.0 + 0.5 * e);
        let mut x = 1.0;
        for _ in 0..ITERATIONS {
            let growth = spread(x);
            let miss = x * x - 1.0 + 2.0 / e * growth.ln_1p();
            let slope = 2.0 * x + 2.0 / (1.0 + e * (1.0 + x));
            let step = miss / slope;
            x = (x - step).clamp(0.0, 1.0);
            if step.abs() < TOLERANCE {
                break;
            }
        }
        Turned {
            spread: 1.0 + spread(x),
            leaving: x,
        }
    }

    /// Force of the rod on the floor [N]: `A [Y + ρw²(1 + x)]`.
    pub(super) fn force(&self, speed: f64, turned: Turned) -> f64 {
        self.area * (self.strength + self.density * speed * speed * (1.0 + turned.leaving))
    }

    /// Plastic work per volume of metal that spreads to the floor's area [J/m3]: `Y (1 + ln κ)`.
    ///
    /// In the flow `v_z = wz/s` a particle that enters at r₀ leaves at r with the strain `ln(r²/r₀²)`, whose mean over the
    /// cross-section is `1 + ln(r²/a²)`.
    pub(super) fn plastic_work(&self, turned: Turned) -> f64 {
        self.strength * (1.0 + turned.spread.ln())
    }
}
