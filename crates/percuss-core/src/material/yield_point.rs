//! Where a body stands on its yield surface, for every model that follows stress in time.

use serde::{Deserialize, Serialize};

use super::{
    FlowState, FlowStress, LaneStrength, LawVisitor, PreparedStrength, plastic_increments,
    plastic_return::Logarithmic,
};
use crate::lanes::{PerLane, Real};

#[cfg(test)]
#[path = "yield_point_tests.rs"]
mod tests;

/// A stress beyond the yield surface, if nothing flowed, and what flow does to it.
#[derive(Debug, Clone, Copy)]
pub struct Trial {
    /// Equivalent stress [Pa].
    pub stress: f64,
    /// Its fall per plastic strain [Pa].
    pub modulus: f64,
    /// Fall of the pressure per plastic strain [Pa].
    pub pressure_fall: f64,
    /// Time in which the strain came about [s]; `None` leaves the strain rate out.
    pub elapsed: Option<f64>,
}

crate::per_lane! {
    /// A [`Trial`] and the state that it starts from, of one body or of eight side by side.
    #[derive(Debug, Clone, Copy, Default)]
    pub struct LaneTrial<R: Real = f64> {
        /// Equivalent stress [Pa].
        pub stress: R,
        /// Its fall per plastic strain [Pa].
        pub modulus: R,
        /// Fall of the pressure per plastic strain [Pa].
        pub pressure_fall: R,
        /// Strain rate per plastic strain: one over the time in which it came about, or 0 to leave the strain rate out [1/s].
        pub per_time: R,
        /// Plastic strain before.
        pub plastic_strain: R,
        /// Temperature [K].
        pub temperature: R,
        /// Pressure of the trial [Pa].
        pub pressure: R,
    }
}

impl LaneTrial {
    /// Of a trial stress and the state that it starts from.
    #[inline(always)]
    pub fn new(start: &FlowState, trial: &Trial) -> Self {
        Self {
            stress: trial.stress,
            modulus: trial.modulus,
            pressure_fall: trial.pressure_fall,
            per_time: match trial.elapsed {
                Some(time) if time > 0.0 => 1.0 / time,
                _ => 0.0,
            },
            plastic_strain: start.plastic_strain,
            temperature: start.temperature,
            pressure: start.pressure,
        }
    }

    /// State after an increment of plastic strain.
    #[inline(always)]
    pub(super) fn at(&self, increment: f64) -> FlowState {
        FlowState {
            plastic_strain: self.plastic_strain + increment,
            strain_rate: increment * self.per_time,
            temperature: self.temperature,
            pressure: self.pressure - self.pressure_fall * increment,
        }
    }

    /// Where a body stands that does not flow.
    #[inline(always)]
    pub(super) fn slow(&self, law: &impl LaneStrength, thermal: f64) -> YieldPoint {
        let state = FlowState {
            strain_rate: 0.0,
            ..self.at(0.0)
        };
        YieldPoint::at_rest(law.flow_stress(thermal, &state))
    }
}

crate::per_lane! {
    /// Where a body last stood on its yield surface: the next return starts there.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
    pub struct YieldPoint<R: Real = f64> {
        /// At the end of the last flow, as are slopes and rate.
        pub(super) stress: R,
        pub(super) strain_slope: R,
        pub(super) rate_slope: R,
        pub(super) strain_rate: R,
        /// The slow flow stress of the current state where that is known: up to it a stress is elastic. −∞ where it is unknown.
        pub(super) elastic_to: R,
    }
}

impl<R: Real> Default for YieldPoint<R> {
    fn default() -> Self {
        Self {
            stress: R::default(),
            strain_slope: R::default(),
            rate_slope: R::default(),
            strain_rate: R::default(),
            elastic_to: R::all(f64::NEG_INFINITY),
        }
    }
}

/// A law of the caller's own, which is called.
#[derive(Debug, Clone, Copy)]
pub struct Called<'a>(pub &'a dyn PreparedStrength);

impl LaneStrength for Called<'_> {
    fn thermal(&self, _: f64) -> f64 {
        1.0
    }

    fn flow_stress(&self, _: f64, state: &FlowState) -> FlowStress {
        self.0.flow_stress(state)
    }

    fn depends_on_strain_only(&self) -> bool {
        self.0.depends_on_strain_only()
    }
}

impl PerLane for Called<'_> {
    type One = Self;

    fn lane(&self, _: usize) -> Self {
        *self
    }

    fn set_lane(&mut self, _: usize, one: Self) {
        *self = one;
    }

    fn choose(&mut self, _: usize, is_so: bool, yes: Self, no: Self) {
        *self = if is_so { yes } else { no };
    }
}

/// The return of a single body.
struct Return<'a> {
    point: &'a mut YieldPoint,
    trial: &'a LaneTrial,
}

impl LawVisitor<f64> for Return<'_> {
    type Output = f64;

    #[inline(always)]
    fn visit<L>(self, law: &L) -> f64
    where
        L: PerLane + Copy + Default,
        L::One: LaneStrength,
    {
        plastic_increments(law, self.point, self.trial, &1.0)
    }
}

impl YieldPoint {
    /// A point whose slow flow stress and slope with plastic strain [Pa] are known.
    #[inline(always)]
    pub fn known(stress: f64, strain_slope: f64) -> Self {
        Self::at_rest(FlowStress {
            stress,
            strain_slope,
            rate_slope: 0.0,
        })
    }

    /// A point of a body that does not flow.
    #[inline(always)]
    pub(super) fn at_rest(flow: FlowStress) -> Self {
        Self {
            stress: flow.stress,
            strain_slope: flow.strain_slope,
            rate_slope: flow.rate_slope,
            strain_rate: 0.0,
            elastic_to: flow.stress,
        }
    }

    /// The slow flow stress in a state.
    pub fn slow(strength: &dyn PreparedStrength, state: &FlowState) -> Self {
        Self::at_rest(strength.flow_stress(&FlowState {
            strain_rate: 0.0,
            ..*state
        }))
    }

    /// Slope with the plastic strain [Pa].
    #[inline(always)]
    pub fn strain_slope(&self) -> f64 {
        self.strain_slope
    }

    /// Whether an equivalent stress [Pa] is known to be elastic.
    #[inline(always)]
    pub fn holds(&self, stress: f64) -> bool {
        stress <= self.elastic_to
    }

    /// Whether the slow flow stress of the current state is known.
    #[inline(always)]
    pub(super) fn is_slow(&self) -> bool {
        self.elastic_to > f64::NEG_INFINITY
    }

    /// The return of one body by [`plastic_increments`]: the plastic strain. `start` is the state before the step, its pressure that of the
    /// trial stress.
    pub fn plastic_increment(
        &mut self,
        strength: &dyn PreparedStrength,
        start: &FlowState,
        trial: &Trial,
    ) -> f64 {
        let trial = LaneTrial::new(start, trial);
        match strength.in_lanes() {
            Some(law) => law.visit(Return {
                point: self,
                trial: &trial,
            }),
            None => plastic_increments(&Called(strength), self, &trial, &1.0),
        }
    }

    /// The same with a slow flow stress that is known now.
    #[inline(always)]
    pub(super) fn with_slow(self, slow: Self) -> Self {
        Self {
            elastic_to: slow.elastic_to,
            ..self
        }
    }

    /// Increment at which the tangent of the yield surface in this point meets the trial stress.
    ///
    /// From a slow point the slope with rate is left out: it is far too steep there.
    #[inline(always)]
    pub(super) fn tangent_increment(&self, trial: &LaneTrial) -> f64 {
        let rate_slope = if self.is_slow() { 0.0 } else { self.rate_slope };
        let stress = current_stress(self.stress, self.elastic_to);
        (trial.stress - stress + rate_slope * self.strain_rate)
            / (trial.modulus + self.strain_slope + rate_slope * trial.per_time)
    }

    /// Whether the rate has made a difference in the last flow.
    #[inline(always)]
    pub(super) fn has_rate(&self, trial: &LaneTrial) -> bool {
        self.rate_slope * self.strain_rate * trial.per_time > 0.0
    }

    /// Increment at the rate of the last flow, and the stress along others.
    #[inline(always)]
    fn logarithmic(&self, trial: &LaneTrial) -> (f64, Logarithmic) {
        let near = self.strain_rate / trial.per_time;
        let stress = Logarithmic {
            hardening: (trial.modulus + self.strain_slope) * near,
            rate: self.rate_slope * self.strain_rate,
        };
        (near, stress)
    }

    /// Increment from which a return to the yield surface starts; not positive where the body seems to have stopped flowing.
    #[inline(always)]
    pub(super) fn first_increment<L: LaneStrength>(&self, trial: &LaneTrial) -> f64 {
        let tangent = self.tangent_increment(trial);
        if !L::LOGARITHMIC {
            return tangent;
        }
        let (near, along) = self.logarithmic(trial);
        let excess = trial.stress - self.stress - along.hardening;
        let curved = near * along.step(excess);
        let is_curved = self.has_rate(trial) & (tangent > 0.0) & !self.is_slow();
        if is_curved { curved } else { tangent }
    }

    /// The same of a body that flows again, from its last flow.
    #[inline(always)]
    pub(super) fn increment_from_last_flow(&self, trial: &LaneTrial) -> f64 {
        let (near, along) = self.logarithmic(trial);
        near * along.root(trial.stress - self.stress)
    }
}

/// The slow flow stress where it is known, or the last one.
#[inline(always)]
fn current_stress(last: f64, slow: f64) -> f64 {
    if slow > f64::NEG_INFINITY { slow } else { last }
}

impl<R: Real> YieldPoint<R> {
    /// Flow stress [Pa].
    #[inline(always)]
    pub fn stress(&self) -> R {
        let mut stress = R::default();
        for l in 0..R::LANES {
            stress.set_lane(
                l,
                current_stress(self.stress.lane(l), self.elastic_to.lane(l)),
            );
        }
        stress
    }

    /// Says that the state has changed without flow, and the flow stress with it.
    #[inline(always)]
    pub fn forget(&mut self) {
        self.elastic_to = R::all(f64::NEG_INFINITY);
    }

    /// Equivalent stress up to which a stress is known to be elastic [Pa]; −∞ where the slow flow stress is unknown.
    #[inline(always)]
    pub fn elastic_to(&self) -> R {
        self.elastic_to
    }
}
