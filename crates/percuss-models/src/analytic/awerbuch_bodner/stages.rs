//! The three stages of the perforation of a plate by a blunt rigid projectile.

use crate::bisection::bisect;

/// A flat rigid projectile against a plate that crushes and shears.
#[derive(Debug, Clone, Copy)]
pub(super) struct Impact {
    /// Mass of the projectile [kg].
    pub mass: f64,
    /// Area of its face [m2].
    pub area: f64,
    /// Thickness of the plate [m].
    pub thickness: f64,
    /// Density of the plate [kg/m3].
    pub density: f64,
    /// Force that crushes the metal in front of the face [N].
    pub crushing_force: f64,
    /// Shear force per length of rim along the thickness [N/m]: `τ π D`.
    pub rim_force: f64,
}

/// One moment of a case.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct MotionState {
    /// Time [s].
    pub time: f64,
    /// Depth of the projectile's face below the original face [m].
    pub depth: f64,
    /// Thickness of plate that was crushed and moves with the projectile [m].
    pub crushed: f64,
    /// Velocity of the projectile [m/s].
    pub speed: f64,
    /// Speed of the rest of the plug [m/s].
    pub plug_speed: f64,
    /// Plastic work of crushing [J].
    pub crushing_work: f64,
    /// Energy lost to the capture of crushed metal [J].
    pub capture: f64,
    /// Work against shear along the rim [J].
    pub shear_work: f64,
    /// Impulse that the rest of the plate took [N s].
    pub impulse: f64,
}

/// A whole case.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Perforation {
    /// MotionState at which the plug starts to move.
    pub plug_starts: MotionState,
    /// MotionState from which projectile and plug move as one.
    pub one_body: MotionState,
    /// Last moment: the plug has left, or everything stands still.
    pub last: MotionState,
    /// Time at which the plug leaves the plate [s]; `None` when it does not.
    pub contact_time: Option<f64>,
    /// Moments with the force on the projectile [N], when they were asked for.
    pub moments: Vec<(MotionState, f64)>,
}

/// Part of a changing quantity by which one step may change it.
const STEP: f64 = 0.05;
/// Steps over the time that the plate's thickness takes at the impact velocity.
const STEPS: f64 = 200.0;
/// Difference of speeds, and thickness left, that count as none, as parts of the speed and the thickness at the start.
const NOTHING: f64 = 1e-9;
/// Bound on the number of steps; every run ends long before it.
const MOST_STEPS: u32 = 100_000;
/// Moments that a stage with a closed form is recorded at.
const RECORDED: u32 = 60;
/// Halvings between two speeds, one at most twice the other, to a part in 1e7.
const HALVINGS: u32 = 24;

impl Impact {
    /// Mass of plate per thickness [kg/m].
    fn line_mass(&self) -> f64 {
        self.density * self.area
    }

    /// Mass of the projectile and the whole plug [kg].
    pub fn joint_mass(&self) -> f64 {
        self.mass + self.line_mass() * self.thickness
    }

    /// Length of rim in shear [m].
    fn rim(&self, moment: &MotionState) -> f64 {
        (self.thickness - moment.depth).max(0.0)
    }

    fn plug_mass(&self, moment: &MotionState) -> f64 {
        self.line_mass() * (self.thickness - moment.crushed)
    }

    /// Kinetic energy of everything that moves [J].
    pub fn kinetic_energy(&self, moment: &MotionState) -> f64 {
        0.5 * (self.mass + self.line_mass() * moment.crushed) * moment.speed.powi(2)
            + 0.5 * self.plug_mass(moment) * moment.plug_speed.powi(2)
    }

    /// Momentum of the target's part in motion [N s].
    pub fn target_momentum(&self, moment: &MotionState) -> f64 {
        self.line_mass() * moment.crushed * moment.speed
            + self.plug_mass(moment) * moment.plug_speed
    }

    /// Force on the projectile alone while metal is crushed [N]: its mass times its deceleration.
    fn crushing(&self, moment: &MotionState) -> f64 {
        let closing = moment.speed - moment.plug_speed;
        let front = self.crushing_force + self.line_mass() * closing * closing;
        self.mass / (self.mass + self.line_mass() * moment.crushed) * front
    }

    /// Force on the projectile alone while everything moves as one [N].
    fn shearing(&self, moment: &MotionState) -> f64 {
        self.mass / self.joint_mass() * self.rim_force * self.rim(moment)
    }

    /// The case at an impact velocity above zero [m/s].
    pub fn case(&self, speed: f64, record: bool) -> Perforation {
        let mut moments = Vec::new();
        let start = MotionState {
            speed,
            ..MotionState::default()
        };
        let plug_starts = self.crush(start, record.then_some(&mut moments));
        if plug_starts.speed == 0.0 {
            return Perforation {
                plug_starts,
                one_body: plug_starts,
                last: plug_starts,
                contact_time: None,
                moments,
            };
        }
        let (one_body, left_early) =
            self.push_plug(plug_starts, speed, record.then_some(&mut moments));
        let (last, left) = self.shear(one_body, record.then_some(&mut moments));
        Perforation {
            plug_starts,
            one_body,
            last,
            contact_time: left_early.or(left),
            moments,
        }
    }

    /// First stage: the plate in front is crushed and carried along, `d(M v)/dt = −F`, until it takes more to crush than to shear.
    ///
    /// With `P = M v` and `dx = v dt`: `P² = P₀² − 2F (m x + ρA x²/2)`, and the time is `(P₀ − P)/F`.
    fn crush(
        &self,
        start: MotionState,
        moments: Option<&mut Vec<(MotionState, f64)>>,
    ) -> MotionState {
        let force = self.crushing_force;
        let line = self.line_mass();
        let initial = self.mass * start.speed;
        let thinnest = if self.rim_force > 0.0 {
            self.thickness - force / self.rim_force
        } else {
            0.0
        };
        if thinnest <= 0.0 {
            return start;
        }
        let at = |depth: f64| {
            let swept = self.mass * depth + line * depth * depth / 2.0;
            let momentum = (initial * initial - 2.0 * force * swept).max(0.0).sqrt();
            let speed = momentum / (self.mass + line * depth);
            let lost = 0.5 * initial * start.speed - 0.5 * momentum * speed;
            MotionState {
                time: (initial - momentum) / force,
                depth,
                crushed: depth,
                speed,
                plug_speed: 0.0,
                crushing_work: force * depth,
                capture: lost - force * depth,
                shear_work: 0.0,
                impulse: initial - momentum,
            }
        };
        let square = initial * initial / force;
        let stops = square / (self.mass + (self.mass * self.mass + line * square).sqrt());
        let end = stops.min(thinnest);
        if let Some(moments) = moments {
            moments.extend((0..RECORDED).map(|i| {
                let moment = at(end * f64::from(i) / f64::from(RECORDED));
                (moment, self.crushing(&moment))
            }));
        }
        let mut last = at(end);
        if stops <= thinnest {
            last.speed = 0.0;
        }
        last
    }

    /// Second stage: crushing goes on while the plug gathers speed against shear, until both move as one.
    ///
    /// Returns the time at which the plug leaves the plate, if it does so meanwhile.
    fn push_plug(
        &self,
        start: MotionState,
        impact_velocity: f64,
        mut moments: Option<&mut Vec<(MotionState, f64)>>,
    ) -> (MotionState, Option<f64>) {
        let mut now = start;
        let mut left = None;
        for _ in 0..MOST_STEPS {
            let closing = now.speed - now.plug_speed;
            let rest = self.thickness - now.crushed;
            if closing <= NOTHING * impact_velocity || rest <= NOTHING * self.thickness {
                break;
            }
            if let Some(moments) = &mut moments {
                moments.push((now, self.crushing(&now)));
            }
            let rates = self.rates(&now);
            let braking = rates.plug_speed - rates.speed;
            let step = (self.thickness / impact_velocity / STEPS)
                .min(STEP * closing / braking.max(f64::MIN_POSITIVE))
                .min(STEP * rest / closing);
            let next = self.step(&now, &rates, step);
            if left.is_none() && next.depth >= self.thickness {
                let part = (self.thickness - now.depth) / (next.depth - now.depth);
                left = Some(now.time + part * step);
            }
            now = next;
        }
        // What difference of speed is left goes into the capture; momentum is kept.
        let before = self.kinetic_energy(&now);
        let crushed = self.mass + self.line_mass() * now.crushed;
        let speed =
            (crushed * now.speed + self.plug_mass(&now) * now.plug_speed) / self.joint_mass();
        now.speed = speed;
        now.plug_speed = speed;
        now.capture += before - self.kinetic_energy(&now);
        (now, left)
    }

    /// Rates of change during the second stage; those of the time are of no use.
    fn rates(&self, moment: &MotionState) -> MotionState {
        let closing = moment.speed - moment.plug_speed;
        let line = self.line_mass();
        let shear = self.rim_force * self.rim(moment);
        let plug_mass = self.plug_mass(moment).max(NOTHING * line * self.thickness);
        MotionState {
            time: 1.0,
            depth: moment.speed,
            crushed: closing,
            speed: -(self.crushing_force + line * closing * closing)
                / (self.mass + line * moment.crushed),
            plug_speed: (self.crushing_force - shear) / plug_mass,
            crushing_work: self.crushing_force * closing,
            capture: 0.5 * line * closing.powi(3),
            shear_work: shear * moment.plug_speed,
            impulse: shear,
        }
    }

    /// One step of the classical Runge–Kutta method.
    fn step(&self, now: &MotionState, first: &MotionState, step: f64) -> MotionState {
        let second = self.rates(&now.plus(step / 2.0, first));
        let third = self.rates(&now.plus(step / 2.0, &second));
        let fourth = self.rates(&now.plus(step, &third));
        now.plus(step / 6.0, first)
            .plus(step / 3.0, &second)
            .plus(step / 3.0, &third)
            .plus(step / 6.0, &fourth)
    }

    /// Third stage: projectile and plug move as one against shear along what is left of the rim, `M dv/dt = −k (h − x)`.
    fn shear(
        &self,
        start: MotionState,
        moments: Option<&mut Vec<(MotionState, f64)>>,
    ) -> (MotionState, Option<f64>) {
        let rim = self.rim(&start);
        if rim == 0.0 {
            return (start, None);
        }
        let mass = self.joint_mass();
        let rate = (self.rim_force / mass).sqrt();
        let at = |time: f64| {
            // sinh(ωt)/ω stays finite as the shear force vanishes.
            let (cosh, reach) = if rate > 0.0 {
                ((rate * time).cosh(), (rate * time).sinh() / rate)
            } else {
                (1.0, time)
            };
            let left = rim * cosh - start.speed * reach;
            let speed = (start.speed * cosh - rate * rate * rim * reach).max(0.0);
            MotionState {
                time: start.time + time,
                depth: self.thickness - left.max(0.0),
                speed,
                plug_speed: speed,
                shear_work: start.shear_work + 0.5 * mass * (start.speed.powi(2) - speed.powi(2)),
                impulse: start.impulse + mass * (start.speed - speed),
                ..start
            }
        };
        let ratio = start.speed / (rate * rim);
        let leaves = ratio > 1.0;
        // At the ballistic limit itself the plug takes for ever; a part in 1e15 away it does not.
        let duration = if rate == 0.0 || ratio.is_infinite() {
            rim / start.speed
        } else if leaves {
            ratio.recip().min(1.0 - f64::EPSILON).atanh() / rate
        } else {
            ratio.min(1.0 - f64::EPSILON).atanh() / rate
        };
        let mut last = at(duration);
        if leaves {
            last.depth = self.thickness;
        } else {
            last.speed = 0.0;
            last.plug_speed = 0.0;
        }
        if let Some(moments) = moments {
            moments.extend((0..RECORDED).map(|i| {
                let moment = at(duration * f64::from(i) / f64::from(RECORDED));
                (moment, self.shearing(&moment))
            }));
            moments.push((last, self.shearing(&last)));
        }
        (last, leaves.then_some(last.time))
    }

    /// Ballistic limit [m/s]: the lowest speed at which the plug leaves, to a part in 1e7, by bisection from a speed of this order.
    pub fn ballistic_limit(&self, order: f64) -> f64 {
        let leaves = |speed: f64| self.case(speed, false).contact_time.is_some();
        let (mut low, mut high) = (0.0, order);
        while !leaves(high) && high < 1e6 {
            low = high;
            high *= 2.0;
        }
        bisect(low, high, HALVINGS, |speed| !leaves(speed)).1
    }
}

impl MotionState {
    fn plus(&self, step: f64, rates: &Self) -> Self {
        Self {
            time: self.time + step * rates.time,
            depth: self.depth + step * rates.depth,
            crushed: self.crushed + step * rates.crushed,
            speed: self.speed + step * rates.speed,
            plug_speed: self.plug_speed + step * rates.plug_speed,
            crushing_work: self.crushing_work + step * rates.crushing_work,
            capture: self.capture + step * rates.capture,
            shear_work: self.shear_work + step * rates.shear_work,
            impulse: self.impulse + step * rates.impulse,
        }
    }
}
