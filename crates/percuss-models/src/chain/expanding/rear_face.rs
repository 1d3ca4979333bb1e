//! Reflections from the rear face of a plate.
//!
//! A wave that leaves the crater keeps spreading after it was reflected, as if it went on into the image of the plate: the cone is
//! unfolded at the rear face and at the struck face \[wolf1994\]. With the outgoing displacement `f(t)` at the mouth of the cone,
//! the mouth moves by
//!
//! `u(t) = f(t) + 2 Σ_j s^j f(t − 2jh/c) / (1 + 2jh/z₀)`,
//!
//! with s = −1 for a fixed rear face and +1 for a free one. A finite cone would focus the wave on the crater again instead.
//!
//! The force on a fixed rear face needs no cone. Integrated over planes parallel to the faces, the equations of an elastic plate are
//! those of a bar with the wave speed `c_p`, for every distribution of the load, so that
//! `B(t) = 2 Σ_j (−1)^j F(t − (2j + 1)h/c_p)` is exact for the contact force F.

use super::delay_line::DelayLine;
use crate::{Error, chain::cone::Cone, problem::RearFaceCondition, solver::archive::Archive};

/// Samples of a delay line per transit of the thickness.
const SAMPLES: usize = 64;
/// Reflections that are summed up: the last ones are below 0.3 % of the first wave in a plate of one diameter.
const MOST_ECHOES: i64 = 200;
/// Samples of a delay line from one echo to the next.
const DELAY: i64 = 2 * SAMPLES as i64;

/// A rear face that reflects.
#[derive(Debug)]
pub(super) struct RearFace {
    /// -1 when fixed, +1 when free.
    sign: f64,
    cone: Cone,
    thickness: f64,
    /// Speed of waves in the cone [m/s].
    speed: f64,
    /// Amplitudes of the waves from the images at the mouth, with their signs.
    shares: Vec<f64>,
    /// Displacement of the mouth in the outgoing wave [m], sampled.
    outgoing: DelayLine,
    /// Impulse of the contact force [N s], sampled.
    impulse: DelayLine,
    /// Displacement of the mouth by reflected waves [m], and its velocity in the current step [m/s].
    pub(super) displacement: f64,
    pub(super) velocity: f64,
    /// Start and end of the last step [s].
    step: [f64; 2],
}

impl RearFace {
    /// Everything that a step changes.
    pub(super) fn archive(&mut self, archive: &mut Archive<'_>) -> Result<(), Error> {
        archive.item(&mut self.outgoing)?;
        archive.item(&mut self.impulse)?;
        archive.item(&mut self.displacement)?;
        archive.item(&mut self.velocity)?;
        archive.item(&mut self.step)
    }

    /// Of a plate of a thickness [m]; `speeds` are those of waves in the cone and of plane longitudinal waves [m/s]. `None` for a
    /// face that does not reflect.
    pub(super) fn new(
        face: RearFaceCondition,
        cone: Cone,
        thickness: f64,
        speeds: [f64; 2],
    ) -> Option<Self> {
        let sign = match face {
            RearFaceCondition::Fixed => -1.0,
            RearFaceCondition::Free => 1.0,
            RearFaceCondition::NonReflecting => return None,
        };
        let lines = speeds.map(|speed| {
            let most = 2 * SAMPLES * (MOST_ECHOES as usize + 1);
            DelayLine::new(thickness / (speed * SAMPLES as f64), most)
        });
        let [outgoing, impulse] = lines;
        let image = |j: i64| 2.0 * j as f64 * thickness;
        let shares = (1..=MOST_ECHOES).map(|j| sign_of(sign, j) / cone.stretch(image(j)));
        Some(Self {
            sign,
            shares: shares.collect(),
            cone,
            thickness,
            speed: speeds[0],
            outgoing,
            impulse,
            displacement: 0.0,
            velocity: 0.0,
            step: [0.0; 2],
        })
    }

    pub(super) fn is_fixed(&self) -> bool {
        self.sign < 0.0
    }

    /// Longest time step for which an echo is known beforehand [s].
    pub(super) fn longest_step(&self) -> f64 {
        0.5 * SAMPLES as f64 * self.outgoing.spacing()
    }

    /// Takes the velocity that brings the mouth to the echo at the end of a step from `time`; gives its change [m/s].
    pub(super) fn begin_step(&mut self, time: f64, time_step: f64) -> f64 {
        let before = self.velocity;
        self.velocity = (self.echo(time + time_step) - self.displacement) / time_step;
        self.velocity - before
    }

    /// Ends a step at a time, with the outgoing displacement of the mouth and the impulse of the contact force so far.
    pub(super) fn end_step(&mut self, time: f64, time_step: f64, outgoing: f64, impulse: f64) {
        self.displacement += self.velocity * time_step;
        self.outgoing.push(time, outgoing);
        self.impulse.push(time, impulse);
        self.step = [self.step[1], time];
    }

    /// Impulse on a fixed rear face [N s].
    pub(super) fn support_impulse(&self) -> f64 {
        self.support_impulse_at(self.step[1])
    }

    /// Force on a fixed rear face in the last step [N].
    pub(super) fn support_force(&self) -> f64 {
        let [start, end] = self.step;
        if end <= start {
            return 0.0;
        }
        (self.support_impulse_at(end) - self.support_impulse_at(start)) / (end - start)
    }

    fn support_impulse_at(&self, time: f64) -> f64 {
        match self.is_fixed() {
            true => self.reflections(&self.impulse, time),
            false => 0.0,
        }
    }

    /// Displacement of the mouth by reflected waves at a time [m].
    fn echo(&self, time: f64) -> f64 {
        let echoes = self.outgoing.delayed(time, DELAY, 1..=MOST_ECHOES);
        let echoes = echoes.zip(&self.shares);
        2.0 * echoes.map(|(value, share)| share * value).sum::<f64>()
    }

    /// `2 Σ_j s^j g(t − (2j + 1)h/c)`: what arrives at the rear face.
    fn reflections(&self, line: &DelayLine, time: f64) -> f64 {
        let shifted = time - SAMPLES as f64 * line.spacing();
        let mut values = line.delayed(shifted, DELAY, 0..=MOST_ECHOES);
        let first = values.next().unwrap_or(0.0);
        let signed = values
            .zip(1..)
            .map(|(value, j)| sign_of(self.sign, j) * value);
        2.0 * (first + signed.sum::<f64>())
    }

    /// Displacement [m], compressive strain and velocity [m/s] that reflected waves add at a depth [m].
    pub(super) fn reflected(&self, depth: f64, time: f64) -> [f64; 3] {
        let transits = time * self.speed / self.thickness;
        let echoes = (0.5 * (transits + 1.0)).ceil() as i64;
        let mut sum = [0.0; 3];
        for j in 1..=echoes.min(MOST_ECHOES) {
            let image = 2.0 * j as f64 * self.thickness;
            let sign = sign_of(self.sign, j);
            // One of the two waves runs towards the struck face: the other way round, so that its strain has the other sign.
            for (place, direction) in [(image + depth, 1.0), (image - depth, -1.0)] {
                let [displacement, strain, velocity] = self.outgoing_at(place, time);
                sum[0] += sign * displacement;
                sum[1] += sign * direction * strain;
                sum[2] += sign * velocity;
            }
        }
        sum
    }

    /// Displacement [m], compressive strain and velocity [m/s] of the outgoing wave at a depth of the unfolded cone [m].
    fn outgoing_at(&self, depth: f64, time: f64) -> [f64; 3] {
        let line = &self.outgoing;
        let at = time - depth / self.speed;
        let half = 0.5 * line.spacing();
        let velocity = (line.at(at + half) - line.at(at - half)) / line.spacing();
        let share = 1.0 / self.cone.stretch(depth);
        let displacement = line.at(at);
        let strain = share / self.cone.distance_to_apex(depth) * displacement
            + share * velocity / self.speed;
        [share * displacement, strain, share * velocity]
    }

    /// Velocity of a free rear face on the axis [m/s].
    pub(super) fn velocity_of_face(&self, time: f64) -> f64 {
        if self.is_fixed() {
            return 0.0;
        }
        let past = self.outgoing.spacing();
        let place = |time| {
            let own = self.outgoing_at(self.thickness, time)[0];
            own + self.reflected(self.thickness, time)[0]
        };
        (place(time) - place(time - past)) / past
    }
}

/// Sign of the `j`-th reflection at a face that reflects with a sign.
fn sign_of(sign: f64, j: i64) -> f64 {
    if j % 2 == 0 { 1.0 } else { sign }
}
