//! Energy and momentum balances: every joule and every newton-second of a run has a line.

/// Where the energy of a run is [J].
#[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize, serde::Deserialize)]
#[non_exhaustive]
pub struct EnergyLedger {
    /// Kinetic energy at the start.
    pub initial: f64,
    /// Kinetic energy of the projectile.
    pub kinetic_projectile: f64,
    /// Kinetic energy of the target.
    pub kinetic_target: f64,
    /// Recoverable elastic energy of the projectile.
    pub elastic_projectile: f64,
    /// Recoverable elastic energy of the target.
    pub elastic_target: f64,
    /// Plastic work done in the projectile.
    pub plastic_projectile: f64,
    /// Plastic work done in the target.
    pub plastic_target: f64,
    /// Work against border shear, plastic work of a shear band, or work against the pressure of a constant-pressure target.
    pub border_shear: f64,
    /// Work against artificial viscosity and damping.
    pub viscous: f64,
    /// Lost when free ends meet: contact conserves momentum, not energy; it vanishes with the element mass.
    /// And what a penetrating tip lost to the target that it took up.
    pub contact: f64,
    /// Energy that left through a non-reflecting rear face, or is stored in what stands behind it.
    pub boundary: f64,
    /// Energy that eroded elements and target that was turned aside carried away.
    pub eroded: f64,
    /// Work that opened cracks: their fracture energy.
    pub fracture: f64,
    /// Taken by changes of the time step: velocities half a step behind positions keep their energy only while the step stays the same. It
    /// vanishes with the square of the step.
    #[serde(default)]
    pub step_changes: f64,
    /// Lost between particles and grid: motion finer than the grid; it vanishes with the cell size.
    pub transfer: f64,
    /// Energy of the forces that hold particles to the mean gradient of their deformation, stored and lost.
    #[serde(default)]
    pub stabilisation: f64,
    /// Kinetic energy of the plate around a plug.
    #[serde(default)]
    pub kinetic_plate: f64,
    /// Recoverable elastic energy of the plate around a plug.
    #[serde(default)]
    pub elastic_plate: f64,
    /// Plastic work of bending the plate around a plug.
    #[serde(default)]
    pub plastic_plate: f64,
}

impl EnergyLedger {
    /// Labels and values of all lines but the initial energy, in reading order.
    pub fn lines(&self) -> [(&'static str, f64); 18] {
        [
            ("kinetic, projectile", self.kinetic_projectile),
            ("kinetic, target", self.kinetic_target),
            ("elastic, projectile", self.elastic_projectile),
            ("elastic, target", self.elastic_target),
            ("plastic, projectile", self.plastic_projectile),
            ("plastic, target", self.plastic_target),
            ("border shear", self.border_shear),
            ("viscosity and damping", self.viscous),
            ("contact", self.contact),
            ("through rear face", self.boundary),
            ("eroded", self.eroded),
            ("fracture", self.fracture),
            ("kinetic, plate", self.kinetic_plate),
            ("elastic, plate", self.elastic_plate),
            ("plastic, plate", self.plastic_plate),
            ("particles to grid", self.transfer),
            ("changes of the time step", self.step_changes),
            ("stabilisation", self.stabilisation),
        ]
    }

    /// Sum of all lines but the initial energy [J].
    pub fn total(&self) -> f64 {
        self.lines().iter().map(|line| line.1).sum()
    }

    /// Part of the initial energy that changes of the time step took; 0 when nothing moved at the start.
    pub fn step_change(&self) -> f64 {
        if self.initial == 0.0 {
            return 0.0;
        }
        self.step_changes / self.initial
    }

    /// Part of the initial energy that no line accounts for; where there was none, that energy itself [J].
    pub fn residual(&self) -> f64 {
        if self.initial == 0.0 {
            return self.total();
        }
        (self.total() - self.initial) / self.initial
    }
}

/// Where the momentum of a run is [N s], along the direction of impact.
#[derive(Debug, Clone, Copy, PartialEq, Default, serde::Serialize, serde::Deserialize)]
#[non_exhaustive]
pub struct MomentumLedger {
    /// Momentum at the start.
    pub initial: f64,
    /// Momentum of the projectile.
    pub projectile: f64,
    /// Momentum of the target.
    pub target: f64,
    /// Impulse taken by a fixed rear face, a wall, a non-reflecting boundary or the support of a plate.
    pub support: f64,
    /// Impulse taken by border shear, or by a constant-pressure target.
    pub border_shear: f64,
    /// Momentum that eroded elements and target that was turned aside carried away.
    pub eroded: f64,
    /// Impulse taken by local damping, which pushes against every node by itself.
    pub damping: f64,
    /// Momentum of the plate around a plug.
    #[serde(default)]
    pub plate: f64,
}

impl MomentumLedger {
    /// Labels and values of all lines but the initial momentum, in reading order.
    pub fn lines(&self) -> [(&'static str, f64); 7] {
        [
            ("projectile", self.projectile),
            ("target", self.target),
            ("support", self.support),
            ("border shear", self.border_shear),
            ("eroded", self.eroded),
            ("local damping", self.damping),
            ("plate", self.plate),
        ]
    }

    /// Part of the initial momentum that no line accounts for; where there was none, that momentum itself [N s].
    pub fn residual(&self) -> f64 {
        let total: f64 = self.lines().iter().map(|line| line.1).sum();
        if self.initial == 0.0 {
            return total;
        }
        (total - self.initial) / self.initial
    }
}
