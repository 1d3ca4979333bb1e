//! Motion of a rigid projectile against `σ_n = R + b v_n²` on its nose, in closed form.

use super::nose_load::NoseLoad;

/// A rigid projectile and what resists it.
#[derive(Debug, Clone, Copy)]
pub(super) struct RigidMotion {
    /// Mass [kg].
    pub(super) mass: f64,
    pub(super) nose: NoseLoad,
    /// Strength part R of the normal stress [Pa].
    pub(super) strength: f64,
    /// Inertia part b of the normal stress [kg/m3].
    pub(super) inertia: f64,
}

/// How a projectile came to rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stop {
    /// Depth of the tip [m].
    pub(super) depth: f64,
    /// Time [s], where there is a closed form.
    pub(super) time: Option<f64>,
    /// Largest force [N].
    pub(super) peak_force: f64,
}

impl RigidMotion {
    /// With the whole nose loaded from first contact: `X = m/(2π a² N b) ln(1 + N b V²/(M R))`,
    /// `t = m/(π a² √(M R N b)) atan(V √(N b/(M R)))`.
    pub(super) fn embedded(&self, speed: f64) -> Stop {
        let (strength, inertia) = self.nose.factors();
        let (strength, inertia) = (strength * self.strength, inertia * self.inertia);
        let (depth, time) = self.shank(strength, inertia, speed);
        Stop {
            depth,
            time: Some(time),
            peak_force: self.nose.area() * (strength + inertia * speed * speed),
        }
    }

    /// With that part of the nose loaded which is below the original surface.
    ///
    /// `d(V²)/dx = −(2π a²/m) [M(x) R + N(x) b V²]` is linear in V², so that with `κ = 2π a² b/m` and `P = ∫₀ˣ N dx`
    /// `V² = e^{−κP} [V₀² − (2π a² R/m) ∫₀ˣ M e^{κP} dx]`; once the nose is in, the closed form for the whole nose takes over.
    pub(super) fn gradual(&self, speed: f64) -> Stop {
        if speed <= 0.0 {
            return self.embedded(0.0);
        }
        let decay = 2.0 * self.nose.area() * self.inertia / self.mass;
        let drain = 2.0 * self.nose.area() * self.strength / self.mass;
        let square = speed * speed;
        let force = |strength: f64, inertia: f64, square: f64| {
            self.nose.area() * (strength * self.strength + inertia * self.inertia * square)
        };
        let mut peak_force: f64 = 0.0;
        let (end, stopped) = self.nose.walk_with(decay, square / drain, |point| {
            let left = (-decay * point.path).exp() * (square - drain * point.work);
            peak_force = peak_force.max(force(point.strength, point.inertia, left));
        });
        let left = if stopped {
            0.0
        } else {
            ((-decay * end.path).exp() * (square - drain * end.work)).max(0.0)
        };
        peak_force = peak_force.max(force(end.strength, end.inertia, left));
        let further = if stopped {
            0.0
        } else {
            let (strength, inertia) = (end.strength * self.strength, end.inertia * self.inertia);
            self.shank(strength, inertia, left.sqrt()).0
        };
        Stop {
            depth: end.depth + further,
            time: None,
            peak_force,
        }
    }

    /// Depth [m] and time [s] against a mean pressure `strength + inertia V²`.
    fn shank(&self, strength: f64, inertia: f64, speed: f64) -> (f64, f64) {
        let per_area = self.mass / self.nose.area();
        let ratio = inertia * speed * speed / strength;
        // Below it the logarithm and the arc tangent are their arguments to rounding, and 0/0 is avoided.
        if ratio < 1e-16 {
            return (
                per_area * speed * speed / (2.0 * strength),
                per_area * speed / strength,
            );
        }
        (
            per_area / (2.0 * inertia) * ratio.ln_1p(),
            per_area / (strength * inertia).sqrt() * ratio.sqrt().atan(),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Nose;

    const NOSES: [Nose; 4] = [
        Nose::Flat,
        Nose::Hemisphere,
        Nose::Cone {
            length_to_diameter: 1.5,
        },
        Nose::Ogive { crh: 3.0 },
    ];

    fn motion(nose: Nose, friction: f64) -> RigidMotion {
        RigidMotion {
            mass: 0.02,
            nose: NoseLoad::new(nose, 0.007, friction),
            strength: 1.2e9,
            inertia: 1.5 * 2710.0,
        }
    }

    #[test]
    fn a_hemispherical_nose_has_its_own_formula_and_its_equation_of_motion() {
        // P = (L + 2a/3)(ρp/(Bρt)) ln[1 + (B/(2A)) ρt V²/Y]
        let (density, shank, a, speed): (f64, f64, f64, f64) = (8000.0, 0.07, 0.0035, 900.0);
        let area = std::f64::consts::PI * a * a;
        let motion = RigidMotion {
            mass: density * area * (shank + 2.0 * a / 3.0),
            ..motion(Nose::Hemisphere, 0.0)
        };
        let (resistance, inertia) = (motion.strength, motion.inertia);
        let formula = (shank + 2.0 * a / 3.0) * density / inertia
            * (1.0 + inertia * speed * speed / (2.0 * resistance)).ln();
        let found = motion.embedded(speed);
        assert!(
            (found.depth / formula - 1.0).abs() < 1e-10,
            "{found:?} {formula}"
        );

        // m dV/dt = −F, dx/dt = V, with V as the variable: no event to find.
        let rates = |v: f64| {
            let force = area * (resistance + 0.5 * inertia * v * v);
            (motion.mass * v / force, motion.mass / force)
        };
        let n = 2000;
        let h = speed / f64::from(n);
        let (mut depth, mut time) = (0.0, 0.0);
        for i in 0..n {
            let v = f64::from(i) * h;
            let (a, b, c) = (rates(v), rates(v + h / 2.0), rates(v + h));
            depth += h / 6.0 * (a.0 + 4.0 * b.0 + c.0);
            time += h / 6.0 * (a.1 + 4.0 * b.1 + c.1);
        }
        let errors = (found.depth / depth - 1.0, found.time.unwrap() / time - 1.0);
        println!("hemisphere: closed form against integration {errors:?}");
        assert!(
            errors.0.abs() < 1e-10 && errors.1.abs() < 1e-10,
            "{errors:?}"
        );
    }

    #[test]
    fn gradual_entry_solves_its_equation_of_motion() {
        for nose in NOSES {
            for friction in [0.0, 0.1] {
                for speed in [60.0, 900.0] {
                    let motion = motion(nose, friction);
                    let found = motion.gradual(speed);
                    let depth = integrated(&motion, nose, friction, speed);
                    let error = found.depth / depth - 1.0;
                    println!("{nose:?}, friction {friction}, {speed} m/s: {error:.1e}");
                    assert!(error.abs() < 1e-10, "{nose:?} {friction} {speed} {error:e}");
                }
            }
        }
    }

    /// Depth by Runge–Kutta steps in the tip's depth, with the load in closed form.
    fn integrated(motion: &RigidMotion, nose: Nose, friction: f64, speed: f64) -> f64 {
        let a = 0.0035_f64;
        let length = nose.length(2.0 * a);
        // M and N within x behind the tip.
        let load = |x: f64| -> (f64, f64) {
            let x = x.min(length);
            match nose {
                Nose::Flat => (1.0, 1.0),
                Nose::Hemisphere => {
                    // x = a(1 − cos t)
                    let t = (1.0 - x / a).clamp(-1.0, 1.0).acos();
                    (
                        t.sin().powi(2) + friction * (t - t.sin() * t.cos()),
                        0.5 * (1.0 - t.cos().powi(4))
                            + friction * (t / 4.0 - (4.0 * t).sin() / 16.0),
                    )
                }
                Nose::Cone { length_to_diameter } => {
                    let part = (x / length).powi(2) * (1.0 + 2.0 * length_to_diameter * friction);
                    (part, part / (1.0 + 4.0 * length_to_diameter.powi(2)))
                }
                Nose::Ogive { crh } => {
                    let s = 2.0 * crh * a;
                    let tip = (length / s).asin();
                    let phi = ((length - x) / s).clamp(-1.0, 1.0).asin();
                    // Antiderivatives of y s (sin φ + μ cos φ) and of the same times sin²φ.
                    let m = |p: f64| {
                        let (sin, cos) = p.sin_cos();
                        s * (s * sin * sin / 2.0 + (s - a) * cos)
                            + friction * s * (s * (p + sin * cos) / 2.0 - (s - a) * sin)
                    };
                    let n = |p: f64| {
                        let (sin, cos) = p.sin_cos();
                        s * (s * sin.powi(4) / 4.0 + (s - a) * (cos - cos.powi(3) / 3.0))
                            + friction
                                * s
                                * (s * (p - (4.0 * p).sin() / 4.0) / 8.0
                                    - (s - a) * sin.powi(3) / 3.0)
                    };
                    let scale = 2.0 / (a * a);
                    (scale * (m(tip) - m(phi)), scale * (n(tip) - n(phi)))
                }
            }
        };
        // V² as a function of s, x = length s², until the nose is in; then in steps of V.
        let area = motion.nose.area();
        let slope = |s: f64, square: f64| {
            let (m, n) = load(length * s * s);
            -2.0 * area / motion.mass
                * (m * motion.strength + n * motion.inertia * square)
                * 2.0
                * length
                * s
        };
        let n = 4000;
        let h = 1.0 / f64::from(n);
        let advance = |s: f64, square: f64, h: f64| {
            let a = slope(s, square);
            let b = slope(s + h / 2.0, square + h / 2.0 * a);
            let c = slope(s + h / 2.0, square + h / 2.0 * b);
            let d = slope(s + h, square + h * c);
            square + h / 6.0 * (a + 2.0 * b + 2.0 * c + d)
        };
        let mut square = speed * speed;
        if length > 0.0 {
            for i in 0..n {
                let s = f64::from(i) * h;
                let next = advance(s, square, h);
                if next <= 0.0 {
                    let (mut low, mut high) = (0.0, h);
                    for _ in 0..60 {
                        let middle = f64::midpoint(low, high);
                        if advance(s, square, middle) > 0.0 {
                            low = middle;
                        } else {
                            high = middle;
                        }
                    }
                    return length * (s + low).powi(2);
                }
                square = next;
            }
        }
        let (m, factor) = load(length);
        let left = square.sqrt();
        let h = left / f64::from(n);
        let rate = |v: f64| {
            motion.mass * v / (area * (m * motion.strength + factor * motion.inertia * v * v))
        };
        let sum: f64 = (0..n)
            .map(|i| {
                let v = f64::from(i) * h;
                h / 6.0 * (rate(v) + 4.0 * rate(v + h / 2.0) + rate(v + h))
            })
            .sum();
        length + sum
    }

    #[test]
    fn slow_cases_stop_after_their_energy_over_the_force() {
        for nose in NOSES {
            let motion = motion(nose, 0.0);
            let depth = motion.embedded(1.0).depth;
            let energy = 0.5 * motion.mass / (motion.nose.area() * motion.strength);
            assert!((depth / energy - 1.0).abs() < 2e-6, "{nose:?}");
            assert_eq!(motion.embedded(0.0).depth, 0.0);
            assert_eq!(motion.gradual(0.0).depth, 0.0);
        }
    }

    #[test]
    fn gradual_entry_goes_deeper_by_less_than_the_nose() {
        for nose in NOSES {
            let motion = motion(nose, 0.0);
            let (whole, gradual) = (motion.embedded(900.0).depth, motion.gradual(900.0).depth);
            assert!(
                gradual >= whole && gradual < whole + nose.length(0.007) + 1e-15,
                "{nose:?}"
            );
        }
    }
}
