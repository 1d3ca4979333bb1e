//! Velocity fields of the plate: their dissipation and inertia, and the parameters that make the dissipation least.

use std::f64::consts::PI;

use super::flow::Flow;
use crate::minimum::least;

/// Uniaxial over shear flow stress (von Mises).
const SQRT_3: f64 = 1.732_050_807_568_877_2;

/// Band at the rim of a plug.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Rim {
    /// Width [m].
    pub width: f64,
    /// Shear force over the area of the rim [Pa].
    pub stress: f64,
    /// Equivalent plastic strain in the band.
    pub strain: f64,
    /// Equivalent strain rate in the band [1/s].
    pub rate: f64,
}

impl Rim {
    /// Slip for which the band was found [m].
    pub fn slip(&self) -> f64 {
        SQRT_3 * self.strain * self.width
    }
}

/// Slip of the plug against the plate around it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Slip {
    /// Radius of the plug [m].
    pub radius: f64,
    /// Slip [m].
    pub slip: f64,
    /// Its rate [m/s].
    pub rate: f64,
    /// Width of the band so far [m]: metal that has sheared stays in the band.
    pub width: f64,
}

/// Widths that are tried: from the radius down in steps of this ratio.
const NARROWER: f64 = 0.8;
/// Narrowest band in radii.
const NARROWEST: f64 = 1e-7;
const REFINEMENTS: u32 = 16;
/// A wider band over the narrowest: if it needs more force, no minimum lies just beside it.
const BESIDE_NARROWEST: f64 = 1.001;

/// The band of the least power between a plug and the plate around it.
///
/// The velocity falls linearly over the width w, so that the power per slip rate and rim area is `τ(γ = s/w, γ̇ = ṡ/w) (1 + w/2a)`. Of its
/// minima, the widest counts: at a narrower one the metal would have softened without the work that this takes.
pub(super) fn rim(flow: &Flow, slip: &Slip) -> Rim {
    let at = |width: f64| {
        let strain = slip.slip / width / SQRT_3;
        let rate = slip.rate / width / SQRT_3;
        Rim {
            width,
            stress: flow.stress(strain, rate) / SQRT_3 * (1.0 + width / (2.0 * slip.radius)),
            strain,
            rate,
        }
    };
    let narrowest = slip.width.max(NARROWEST * slip.radius);
    let held = at(narrowest);
    let mut best = at(slip.radius.max(narrowest));
    loop {
        let next = at((best.width * NARROWER).max(narrowest));
        if next.stress > best.stress {
            break;
        }
        if next.width <= narrowest {
            if at(narrowest * BESIDE_NARROWEST).stress >= held.stress {
                return held;
            }
            break;
        }
        best = next;
    }
    let low = (best.width * NARROWER).max(narrowest);
    let high = (best.width / NARROWER).min(slip.radius).max(low);
    let width = least(low.ln(), high.ln(), REFINEMENTS, |x| at(x.exp()).stress).exp();
    at(width.max(narrowest))
}

/// Distance of the places by which a minimum is refined; the parabola's error is of the fourth power.
const BESIDE: f64 = 0.02;
/// Bound on the moves to a minimum.
const MOST_MOVES: u32 = 400;

/// Place of the least value of a function near a place: the vertex of a parabola through three places that enclose it.
fn least_near(place: f64, value: impl Fn(f64) -> f64) -> f64 {
    let (mut middle, mut here) = (place, value(place));
    let (mut left, mut right) = (value(middle - BESIDE), value(middle + BESIDE));
    for _ in 0..MOST_MOVES {
        if left < here {
            (middle, right, here) = (middle - BESIDE, here, left);
            left = value(middle - BESIDE);
        } else if right < here {
            (middle, left, here) = (middle + BESIDE, here, right);
            right = value(middle + BESIDE);
        } else {
            break;
        }
    }
    let bend = left - 2.0 * here + right;
    let aside = 0.5 * BESIDE * (left - right) / bend.max(f64::MIN_POSITIVE);
    middle + aside.clamp(-0.5 * BESIDE, 0.5 * BESIDE)
}

/// Growth of a hole through the plate, whose metal thickens it out to a radius.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Hole {
    /// Power over the speed of the nose, without inertia [N].
    pub force: f64,
    /// Radius of the moving metal over that of the widest part of the hole.
    pub extent: f64,
    /// Coefficient of the inertial pressure `B ρ ċ²`.
    pub inertia: f64,
}

/// Part of the plate's thickness around the nose.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Layer {
    /// Radius of the hole [m].
    pub radius: f64,
    /// Volume that the hole gains in this layer over the distance that the nose moves, `2π c c′ Δz` [m2].
    pub gain: f64,
}

/// Stress of metal that moves around a growing hole, by the radius out to which it moves.
#[derive(Debug)]
pub(super) struct HoleStress {
    /// Power over the gain of volume [Pa] at the extents `1 + e^x`, x from `CLOSEST` in steps of `SPACING`.
    volume: Vec<f64>,
    /// Flow stress at rest [Pa].
    edge: f64,
}

const CLOSEST: f64 = -7.0;
const SPACING: f64 = 0.125;
const EXTENTS: u32 = 112;

/// Largest radius of moving metal in radii of the hole.
const WIDEST_HOLE: f64 = 1e3;
const PANELS: u32 = 12;

impl HoleStress {
    /// Around a hole that grows at a strain rate of this order [1/s].
    pub fn new(flow: &Flow, nominal_rate: f64) -> Self {
        let volume = |node: u32| {
            let extent = 1.0 + (CLOSEST + SPACING * f64::from(node)).exp();
            let square = extent * extent;
            let span = extent.ln() / f64::from(PANELS);
            let panel = |i: u32| {
                let place = ((f64::from(i) + 0.5) * span).exp();
                let part = square / (place * place);
                let (radial, hoop, axial) = (-(part + 1.0), part - 1.0, 2.0);
                let sum: f64 = radial * radial + hoop * hoop + axial * axial;
                let rate = (2.0 / 3.0 * sum).sqrt() / (square - 1.0);
                let strain = -(-1.0 / (place * place)).ln_1p() / SQRT_3;
                flow.stress(strain, rate * nominal_rate) * rate * place * place * span
            };
            (0..PANELS).map(panel).sum()
        };
        Self {
            volume: (0..EXTENTS).map(volume).collect(),
            edge: flow.stress(0.0, nominal_rate),
        }
    }

    fn at(&self, extent: f64) -> f64 {
        let last = self.volume.len() - 1;
        let place = ((extent - 1.0).ln() - CLOSEST) / SPACING;
        // Beyond the last node the stress goes on rising with the logarithm.
        let node = (place.max(0.0) as usize).min(last - 1);
        let (below, above) = (self.volume[node], self.volume[node + 1]);
        below + (place - node as f64) * (above - below)
    }
}

/// The field of least power around a hole through layers of a plate of a thickness [m].
///
/// In a layer whose hole grows at ċ, `v_r = ċ c (R² − r²)/(r (R² − c²))` with a common R, where nothing moves inwards and the metal shears over
/// the thickness; no volume changes, so that the layer thickens at `2 ċ c/(R² − c²)`. Metal moves away from the middle of the plate, which
/// needs the least shear. The strain of a ring is that of a hole grown from nothing in plane strain, `−ln(1 − c²/r²)/√3`.
///
/// `near`: radius of the moving metal over that of the hole in a similar field, where one is known.
pub(super) fn hole<const LAYERS: usize>(
    stress: &HoleStress,
    layers: &[Layer; LAYERS],
    thickness: f64,
    near: Option<f64>,
) -> Hole {
    let widest = layers.iter().fold(0.0_f64, |most, l| most.max(l.radius));
    let height = thickness / LAYERS as f64;
    let power = |extent: f64| {
        let edge = extent * widest;
        let thickening = |l: &Layer| l.gain / PI / (edge * edge - l.radius * l.radius);
        let (mut volume, mut moved, mut all) = (0.0, [0.0; LAYERS], 0.0);
        for (l, moved) in layers.iter().zip(&mut moved) {
            if l.gain > 0.0 {
                volume += l.gain * stress.at(edge / l.radius);
            }
            let own = thickening(l);
            *moved = all + 0.5 * own;
            all += own;
        }
        let middle = 0.5 * (moved[LAYERS / 2 - 1] + moved[LAYERS / 2]);
        let shear: f64 = moved.iter().map(|v| (v - middle).abs()).sum();
        volume + 2.0 * PI * edge * height * shear * stress.edge / SQRT_3
    };
    let gap = |log: f64| power(1.0 + log.exp());
    let near = near.map_or_else(
        || least(1e-3_f64.ln(), WIDEST_HOLE.ln(), 20, gap),
        |extent| (extent - 1.0).ln(),
    );
    let extent = 1.0 + least_near(near, gap).exp();
    Hole {
        force: power(extent),
        extent,
        inertia: hole_inertia(extent),
    }
}

/// `½ρ∫v_r² 2πr dr = πρ B c² ċ²` of the field around a hole, whose pressure is then `B ρ ċ²` at a constant speed of growth.
fn hole_inertia(extent: f64) -> f64 {
    let square = extent * extent;
    let gap = square - 1.0;
    (square * square * extent.ln() - square * gap + (square * square - 1.0) / 4.0) / (gap * gap)
}

/// Plate around the rim that moves with a velocity falling linearly to zero at a radius b.
#[derive(Debug, Clone, Copy)]
pub(super) struct Dish {
    /// Radius of the rim a [m].
    pub rim: f64,
    /// Thickness [m].
    pub thickness: f64,
    /// Density [kg/m3].
    pub density: f64,
    /// Mass inside the rim that moves with it [kg].
    pub inner_mass: f64,
}

impl Dish {
    /// Generalised mass: twice the kinetic energy at unit velocity of the rim [kg].
    pub fn mass(&self, edge: f64) -> f64 {
        self.common(edge, edge)
    }

    /// Product of two fields: `∫ρ h φ₀ φ₁ 2πr dr`, φ = (b − r)/(b − a) [kg].
    pub fn common(&self, first: f64, second: f64) -> f64 {
        let (a, b) = (self.rim, first.min(second));
        let integral = first * second * (b * b - a * a) / 2.0
            - (first + second) * (b.powi(3) - a.powi(3)) / 3.0
            + (b.powi(4) - a.powi(4)) / 4.0;
        self.inner_mass
            + 2.0 * PI * self.density * self.thickness * integral / ((first - a) * (second - a))
    }

    /// True momentum at unit velocity of the rim [kg].
    pub fn momentum(&self, edge: f64) -> f64 {
        let a = self.rim;
        let integral =
            (edge * (edge * edge - a * a) / 2.0 - (edge.powi(3) - a.powi(3)) / 3.0) / (edge - a);
        self.inner_mass + 2.0 * PI * self.density * self.thickness * integral
    }

    /// Resistance at a flow stress [Pa] and a deflection of the rim [m]: hinge circles at a and b with the bending of all rings between
    /// them, `2π M 2b/(b − a)`, and stretching along the radius, `π N δ (b + a)/(b − a)` [N].
    pub fn resistance(&self, edge: f64, deflection: f64, stress: f64) -> f64 {
        let plane = 2.0 / SQRT_3 * stress * self.thickness;
        let moment = plane * self.thickness / 4.0;
        let gap = edge - self.rim;
        (4.0 * PI * moment * edge + PI * plane * deflection.abs() * (edge + self.rim)) / gap
    }

    /// Equivalent strain of a dish of this deflection, and its rate at a velocity of the rim [1/s].
    pub fn strain(&self, edge: f64, deflection: f64, velocity: f64) -> (f64, f64) {
        let gap = edge - self.rim;
        let (slope, turn) = (deflection.abs() / gap, velocity.abs() / gap);
        let bent = self.thickness / (2.0 * gap);
        (slope * bent + slope * slope / 2.0, turn * (bent + slope))
    }
}

/// Field under a flat punch on a half-space: `ψ = F(r) G(z)`, `v_z = F′G/r`, `v_r = −F G′/r`, with `F = r²/2` under the punch,
/// `F = (a²/2)((R² − r²)/(R² − a²))^p` around it and `G = V (1 − z/H)^q`.
pub(in crate::analytic) mod punch {
    /// Depth H of the field in radii.
    pub const DEPTH: f64 = 0.86;
    /// Radius R of the field in radii.
    pub const EXTENT: f64 = 2.31;
    /// Exponents p and q.
    #[cfg(test)]
    pub const EXPONENTS: (f64, f64) = (4.75, 2.9);
    /// Mean pressure over flow stress: the least value over H, R, p and q.
    pub const PRESSURE: f64 = 3.19;
    /// Mean equivalent strain rate, weighted with itself, times radius over velocity.
    pub const RATE: f64 = 1.98;
}
