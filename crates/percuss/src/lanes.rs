//! Numbers of one run or of eight side by side, for equations that are written once.
//!
//! An equation is generic over [`Real`]: `f64` is one run, element or particle, [`Lanes`] are eight, on which one instruction works. Each
//! operation is rounded in its lane as in `f64`: a lane has the bits of the run alone. Every function on the way is `#[inline(always)]`, and
//! the loop over elements is dispatched to an instruction set by `pulp`. Then a compiler at its highest level makes vector instructions of
//! the operators. (At lower levels only loops over whole arrays become vector instructions.)

use std::ops::{
    Add, AddAssign, BitAnd, BitOr, Deref, DerefMut, Div, Mul, Neg, Not, Sub, SubAssign,
};

use crate::power::power_here;

/// Lanes: as many numbers as the widest registers hold.
pub(crate) const LANES: usize = 8;

/// A number of one run, or one of each of eight.
pub(crate) trait Real:
    Copy
    + Default
    + Add<Output = Self>
    + Add<f64, Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Mul<f64, Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
{
    /// Answer to a comparison.
    type Mask: Mask;

    /// The same number everywhere.
    fn all(value: f64) -> Self;

    fn below(self, other: Self) -> Self::Mask;
    fn at_most(self, other: Self) -> Self::Mask;
    fn equals(self, other: Self) -> Self::Mask;

    /// Magnitude.
    fn size(self) -> Self;

    /// Its magnitude with the sign of another one.
    fn signed_as(self, other: Self) -> Self;

    /// `x^n` as [`power`](crate::power::power) has it.
    fn to_power(self, n: Self) -> Self;

    /// One of two numbers: the first one where the mask is true.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;

    /// A function of the numbers of every lane, for rare cases: it is not made of vector instructions.
    fn each(self, function: fn(f64) -> f64) -> Self;

    #[inline(always)]
    fn above(self, other: Self) -> Self::Mask {
        other.below(self)
    }

    #[inline(always)]
    fn at_least(self, other: Self) -> Self::Mask {
        other.at_most(self)
    }

    #[inline(always)]
    fn inverse(self) -> Self {
        Self::all(1.0) / self
    }
}

/// Whether something is so, in one run or in each of eight.
pub(crate) trait Mask:
    Copy + Default + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self>
{
    /// In one run at least.
    fn any(self) -> bool;

    /// In every run.
    fn every(self) -> bool;
}

/// The larger of two numbers of which neither is undefined.
#[inline(always)]
pub(crate) fn larger<R: Real>(a: R, b: R) -> R {
    R::select(a.above(b), a, b)
}

/// The smaller of two numbers of which neither is undefined.
#[inline(always)]
pub(crate) fn smaller<R: Real>(a: R, b: R) -> R {
    R::select(a.below(b), a, b)
}

impl Mask for bool {
    #[inline(always)]
    fn any(self) -> bool {
        self
    }

    #[inline(always)]
    fn every(self) -> bool {
        self
    }
}

impl Real for f64 {
    type Mask = bool;

    #[inline(always)]
    fn all(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn below(self, other: Self) -> bool {
        self < other
    }

    #[inline(always)]
    fn at_most(self, other: Self) -> bool {
        self <= other
    }

    #[inline(always)]
    fn equals(self, other: Self) -> bool {
        self == other
    }

    #[inline(always)]
    fn size(self) -> Self {
        self.abs()
    }

    #[inline(always)]
    fn signed_as(self, other: Self) -> Self {
        self.copysign(other)
    }

    #[inline(always)]
    fn to_power(self, n: Self) -> Self {
        power_here(self, n)
    }

    #[inline(always)]
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }

    #[inline(always)]
    fn each(self, function: fn(f64) -> f64) -> Self {
        function(self)
    }
}

/// A number in every lane, which one load brings.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[repr(C, align(64))]
pub(crate) struct Lanes(pub(crate) [f64; LANES]);

/// Whether something is so in every lane.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct LaneMask(pub(crate) [bool; LANES]);

impl Lanes {
    /// The same number in every lane.
    #[inline(always)]
    pub(crate) const fn all(value: f64) -> Self {
        Self([value; LANES])
    }
}

impl LaneMask {
    /// From a number with a bit for every lane.
    #[inline(always)]
    pub(crate) fn of_bits(bits: u8) -> Self {
        let mut mask = [false; LANES];
        for (lane, entry) in mask.iter_mut().enumerate() {
            *entry = bits >> lane & 1 == 1;
        }
        Self(mask)
    }

    /// A number with a bit for every lane.
    #[inline(always)]
    pub(crate) fn bits(self) -> u8 {
        let mut bits = 0;
        for lane in 0..LANES {
            bits |= u8::from(self.0[lane]) << lane;
        }
        bits
    }

    /// Lanes in which it is so.
    pub(crate) fn lanes(self) -> impl Iterator<Item = usize> {
        (0..LANES).filter(move |&lane| self.0[lane])
    }
}

/// Operators lane by lane.
macro_rules! lane_by_lane {
    ($($type:ident: $trait:ident $function:ident $operator:tt $zero:expr;)*) => {$(
        impl $trait for $type {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                let (a, b) = (self.0, other.0);
                let mut result = [$zero; LANES];
                for lane in 0..LANES {
                    result[lane] = a[lane] $operator b[lane];
                }
                Self(result)
            }
        }
    )*};
}
lane_by_lane! {
    Lanes: Add add + 0.0;
    Lanes: Sub sub - 0.0;
    Lanes: Mul mul * 0.0;
    Lanes: Div div / 0.0;
    LaneMask: BitAnd bitand & false;
    LaneMask: BitOr bitor | false;
}

impl Add<f64> for Lanes {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: f64) -> Self {
        self + Self::all(other)
    }
}

impl Mul<f64> for Lanes {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: f64) -> Self {
        self * Self::all(other)
    }
}

impl AddAssign for Lanes {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for Lanes {
    #[inline(always)]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl Neg for Lanes {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        lanes(|lane| -self.0[lane])
    }
}

impl Not for LaneMask {
    type Output = Self;

    #[inline(always)]
    fn not(self) -> Self {
        let mut mask = [false; LANES];
        for lane in 0..LANES {
            mask[lane] = !self.0[lane];
        }
        Self(mask)
    }
}

impl Mask for LaneMask {
    #[inline(always)]
    fn any(self) -> bool {
        let mut any = false;
        for lane in 0..LANES {
            any |= self.0[lane];
        }
        any
    }

    #[inline(always)]
    fn every(self) -> bool {
        !(!self).any()
    }
}

/// Comparisons lane by lane.
macro_rules! compare {
    ($($function:ident $operator:tt;)*) => {$(
        #[inline(always)]
        fn $function(self, other: Self) -> LaneMask {
            let (a, b) = (self.0, other.0);
            let mut mask = [false; LANES];
            for lane in 0..LANES {
                mask[lane] = a[lane] $operator b[lane];
            }
            LaneMask(mask)
        }
    )*};
}

impl Real for Lanes {
    type Mask = LaneMask;

    compare! {
        below <;
        at_most <=;
        equals ==;
    }

    #[inline(always)]
    fn all(value: f64) -> Self {
        Self([value; LANES])
    }

    #[inline(always)]
    fn size(self) -> Self {
        lanes(|lane| self.0[lane].abs())
    }

    #[inline(always)]
    fn signed_as(self, other: Self) -> Self {
        lanes(|lane| self.0[lane].copysign(other.0[lane]))
    }

    #[inline(always)]
    fn to_power(self, n: Self) -> Self {
        lanes(|lane| power_here(self.0[lane], n.0[lane]))
    }

    #[inline(always)]
    fn select(mask: LaneMask, yes: Self, no: Self) -> Self {
        let mut result = [0.0; LANES];
        for lane in 0..LANES {
            result[lane] = if mask.0[lane] {
                yes.0[lane]
            } else {
                no.0[lane]
            };
        }
        Self(result)
    }

    #[cold]
    #[inline(never)]
    fn each(self, function: fn(f64) -> f64) -> Self {
        lanes(|lane| function(self.0[lane]))
    }
}

/// What has something for every lane.
pub(crate) trait PerLane {
    /// The same for one run.
    type One;

    /// What a lane has.
    fn lane(&self, lane: usize) -> Self::One;

    /// Gives it to a lane.
    fn set_lane(&mut self, lane: usize, one: Self::One);

    /// One of two: the first one in lanes where the mask is true.
    fn choose(mask: LaneMask, yes: Self, no: Self) -> Self;
}

impl PerLane for Lanes {
    type One = f64;

    #[inline(always)]
    fn lane(&self, lane: usize) -> f64 {
        self.0[lane]
    }

    #[inline(always)]
    fn set_lane(&mut self, lane: usize, one: f64) {
        self.0[lane] = one;
    }

    #[inline(always)]
    fn choose(mask: LaneMask, yes: Self, no: Self) -> Self {
        Self::select(mask, yes, no)
    }
}

impl PerLane for LaneMask {
    type One = bool;

    #[inline(always)]
    fn lane(&self, lane: usize) -> bool {
        self.0[lane]
    }

    #[inline(always)]
    fn set_lane(&mut self, lane: usize, one: bool) {
        self.0[lane] = one;
    }

    #[inline(always)]
    fn choose(mask: LaneMask, yes: Self, no: Self) -> Self {
        (yes & mask) | (no & !mask)
    }
}

impl<T: PerLane + Copy, const N: usize> PerLane for [T; N] {
    type One = [T::One; N];

    #[inline(always)]
    fn lane(&self, lane: usize) -> Self::One {
        std::array::from_fn(|i| self[i].lane(lane))
    }

    #[inline(always)]
    fn set_lane(&mut self, lane: usize, one: Self::One) {
        for (all, one) in self.iter_mut().zip(one) {
            all.set_lane(lane, one);
        }
    }

    #[inline(always)]
    fn choose(mask: LaneMask, yes: Self, no: Self) -> Self {
        std::array::from_fn(|i| T::choose(mask, yes[i], no[i]))
    }
}

/// Implements [`PerLane`] for a struct of numbers, all of whose fields are named.
macro_rules! per_lane {
    ($name:ident { $($field:ident),* $(,)? }) => {
        impl $crate::lanes::PerLane for $name<$crate::lanes::Lanes> {
            type One = $name<f64>;

            #[inline(always)]
            fn lane(&self, lane: usize) -> $name<f64> {
                $name { $($field: $crate::lanes::PerLane::lane(&self.$field, lane),)* }
            }

            #[inline(always)]
            fn set_lane(&mut self, lane: usize, one: $name<f64>) {
                $($crate::lanes::PerLane::set_lane(&mut self.$field, lane, one.$field);)*
            }

            #[inline(always)]
            fn choose(mask: $crate::lanes::LaneMask, yes: Self, no: Self) -> Self {
                Self { $($field: $crate::lanes::PerLane::choose(mask, yes.$field, no.$field),)* }
            }
        }
    };
}
pub(crate) use per_lane;

impl Deref for Lanes {
    type Target = [f64; LANES];

    #[inline(always)]
    fn deref(&self) -> &[f64; LANES] {
        &self.0
    }
}

impl DerefMut for Lanes {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [f64; LANES] {
        &mut self.0
    }
}

/// A number in every lane, from the lane.
#[inline(always)]
pub(crate) fn lanes(value: impl Fn(usize) -> f64) -> Lanes {
    let mut all = [0.0; LANES];
    for (lane, entry) in all.iter_mut().enumerate() {
        *entry = value(lane);
    }
    Lanes(all)
}

/// Several numbers in every lane.
#[inline(always)]
pub(crate) fn each_of<const N: usize>(values: impl Fn(usize) -> [f64; N]) -> [Lanes; N] {
    let mut all = [Lanes::all(0.0); N];
    for lane in 0..LANES {
        for (entry, value) in all.iter_mut().zip(values(lane)) {
            entry.0[lane] = value;
        }
    }
    all
}

/// The numbers of one lane. (`map` would now and then not be inlined, and then lacks the wide instructions.)
#[inline(always)]
pub(crate) fn one<const N: usize>(all: &[Lanes; N], lane: usize) -> [f64; N] {
    let mut values = [0.0; N];
    for (value, entry) in values.iter_mut().zip(all) {
        *value = entry.0[lane];
    }
    values
}
