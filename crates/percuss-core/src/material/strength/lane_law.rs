//! Strength laws of one body or of eight side by side: constants in lanes, equations that are part of the loop that needs them.

use std::marker::PhantomData;

use pulp::{Arch, NullaryFnOnce};

use super::{
    FlowState, FlowStress, Hardening, JohnsonCookLaw, ModifiedJohnsonCookLaw, SteinbergGuinanLaw,
};
use crate::lanes::{PerLane, Real};

/// Equations of a strength law, for code that has been dispatched to an instruction set: sums, products and fused multiply-adds without
/// branches, so that a loop over eight lanes becomes vector instructions.
pub trait LaneStrength: Copy {
    /// Whether the flow stress grows with the logarithm of the strain rate, or a power of it that is close to it.
    const LOGARITHMIC: bool = false;

    /// Exponent e of the power of the strain rate that has slope and curvature of the flow stress at a rate [1/s]: the curvature is (e − 1)
    /// times slope over rate. 0 for a logarithm, 1 for a straight line.
    fn rate_exponent(&self, strain_rate: f64) -> f64 {
        let _ = strain_rate;
        1.0
    }

    /// What the flow stress owes to the temperature [K]: it stays the same during a return.
    fn thermal(&self, temperature: f64) -> f64;

    /// Flow stress in a state, with what it owes to its temperature.
    fn flow_stress(&self, thermal: f64, state: &FlowState) -> FlowStress;

    /// Whether neither strain rate nor temperature nor pressure matter.
    fn depends_on_strain_only(&self) -> bool;
}

/// What is done with a law whose equations are known: compiled once for every law and instruction set.
pub trait LawVisitor<R: Real> {
    /// Its result.
    type Output;

    /// Does it with the constants of a law, of one body or of eight, in code that has been dispatched to an instruction set. An
    /// implementation is `#[inline(always)]`, to become a part of that code.
    fn visit<L>(self, law: &L) -> Self::Output
    where
        L: PerLane + Copy + Default,
        L::One: LaneStrength;
}

/// A visitor at a law, to be dispatched to an instruction set.
struct Visit<'a, R, V, L> {
    visitor: V,
    law: &'a L,
    lanes: PhantomData<R>,
}

impl<R, V, L> NullaryFnOnce for Visit<'_, R, V, L>
where
    R: Real,
    V: LawVisitor<R>,
    L: PerLane + Copy + Default,
    L::One: LaneStrength,
{
    type Output = V::Output;

    #[inline(always)]
    fn call(self) -> V::Output {
        self.visitor.visit(self.law)
    }
}

macro_rules! lane_laws {
    ($($(#[$doc:meta])* $name:ident($law:ident)),* $(,)?) => {
        /// A strength law whose equations are known here, with its constants: of one body, or of eight side by side.
        #[derive(Debug, Clone, Copy)]
        pub enum LaneLaw<R: Real = f64> {
            $($(#[$doc])* $name($law<R>),)*
        }

        /// Equations of a [`LaneLaw`]: bodies that have the same can be computed side by side.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
        pub enum LawKind {
            $($(#[$doc])* $name,)*
        }

        impl<R: Real> LaneLaw<R> {
            /// A law with all constants 0.
            pub fn of_kind(kind: LawKind) -> Self {
                match kind {
                    $(LawKind::$name => Self::$name($law::default()),)*
                }
            }

            /// Its equations.
            pub fn kind(&self) -> LawKind {
                match self {
                    $(Self::$name(_) => LawKind::$name,)*
                }
            }

            /// Puts a law with the same equations into a lane; one with others takes all lanes.
            pub fn set_lane(&mut self, lane: usize, law: LaneLaw) {
                if self.kind() != law.kind() {
                    *self = Self::of_kind(law.kind());
                    for lane in 0..R::LANES {
                        self.set_lane(lane, law);
                    }
                }
                match (self, law) {
                    $((Self::$name(laws), LaneLaw::$name(law)) => laws.set_lane(lane, law),)*
                    _ => {}
                }
            }
        }

        impl<R: Real> LaneLaw<R>
        where
            $($law<R>: PerLane<One = $law>,)*
        {
            /// Does something with its constants, in code for this processor.
            #[inline(always)]
            pub fn visit<V: LawVisitor<R>>(&self, visitor: V) -> V::Output {
                match self {
                    $(Self::$name(law) => Arch::new().dispatch(Visit {
                        visitor,
                        law,
                        lanes: PhantomData,
                    }),)*
                }
            }
        }
    };
}

lane_laws! {
    /// A power of the plastic strain, or a constant.
    Hardening(Hardening),
    /// Johnson–Cook with the logarithm of the strain rate.
    JohnsonCook(JohnsonCookLaw),
    /// Johnson–Cook with a power of the strain rate.
    ModifiedJohnsonCook(ModifiedJohnsonCookLaw),
    /// Steinberg–Cochran–Guinan.
    SteinbergGuinan(SteinbergGuinanLaw),
}

impl LaneLaw {
    /// Flow stress in a state: the one-lane instance of the equations.
    pub(super) fn flow_stress(&self, state: &FlowState) -> FlowStress {
        self.visit(At(state))
    }
}

/// Flow stress of one body in a state.
struct At<'a>(&'a FlowState);

impl LawVisitor<f64> for At<'_> {
    type Output = FlowStress;

    #[inline(always)]
    fn visit<L>(self, law: &L) -> FlowStress
    where
        L: PerLane + Copy + Default,
        L::One: LaneStrength,
    {
        let (state, law) = (self.0, law.lane(0));
        law.flow_stress(law.thermal(state.temperature), state)
    }
}
