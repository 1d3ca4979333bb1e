//! Numbers side by side: eight elements, particles or runs, on which one instruction works.
//!
//! An equation is a function of single numbers, written once: one run calls it, and eight call it in a loop over the lanes. Such a function is
//! `#[inline(always)]` and has no branches. The loop works on copies of whole arrays: what a compiler can tell apart from memory becomes
//! vector instructions. Code that uses lanes is dispatched to an instruction set by `pulp`, and has the same bits on all of them.
//!
//! A struct that is generic over [`Real`] has the numbers of one run or of eight; `per_lane!` gives it those of a lane. A function that is generic
//! over it loops over the lanes, and is that of one run where there is one.

mod blocks;

use std::{
    fmt::Debug,
    ops::{Deref, DerefMut},
};

pub use blocks::{Blocks, blocks_of};

/// Lanes: as many numbers as the widest registers hold.
pub const LANES: usize = 8;

/// A number in every lane, which one load brings.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[repr(C, align(64))]
pub struct Lanes(pub [f64; LANES]);

impl Lanes {
    /// The same number in every lane.
    #[inline(always)]
    pub const fn all(value: f64) -> Self {
        Self([value; LANES])
    }
}

/// Whether something is so in every lane.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct LaneFlags(pub [bool; LANES]);

/// A number of one run, or one of each of eight.
pub trait Real: PerLane<One = f64> + Copy + Default {
    /// The same for what is so or not.
    type Flag: PerLane<One = bool> + Copy + Default + Debug;

    /// Runs that it has a number of. A loop over the lanes of one run is no loop once it is compiled.
    const LANES: usize;

    /// The same number in every lane.
    fn all(value: f64) -> Self;
}

impl Real for f64 {
    type Flag = bool;

    const LANES: usize = 1;

    #[inline(always)]
    fn all(value: f64) -> Self {
        value
    }
}

impl Real for Lanes {
    type Flag = LaneFlags;

    const LANES: usize = LANES;

    #[inline(always)]
    fn all(value: f64) -> Self {
        Self::all(value)
    }
}

/// What one run has, or each of eight in a lane.
pub trait PerLane {
    /// What one run has.
    type One;

    /// That of a lane.
    fn lane(&self, lane: usize) -> Self::One;

    /// Gives it to a lane.
    fn set_lane(&mut self, lane: usize, one: Self::One);

    /// Gives one of two to a lane: the first one where something is so.
    fn choose(&mut self, lane: usize, is_so: bool, yes: Self::One, no: Self::One);
}

/// What one run has by itself.
macro_rules! one_run {
    ($($one:ty),*) => {
        $(
            impl PerLane for $one {
                type One = Self;

                #[inline(always)]
                fn lane(&self, _: usize) -> Self {
                    *self
                }

                #[inline(always)]
                fn set_lane(&mut self, _: usize, one: Self) {
                    *self = one;
                }

                #[inline(always)]
                fn choose(&mut self, _: usize, is_so: bool, yes: Self, no: Self) {
                    *self = if is_so { yes } else { no };
                }
            }
        )*
    };
}

one_run!(f64, bool);

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
    fn choose(&mut self, lane: usize, is_so: bool, yes: f64, no: f64) {
        self.0[lane] = if is_so { yes } else { no };
    }
}

impl PerLane for LaneFlags {
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
    fn choose(&mut self, lane: usize, is_so: bool, yes: bool, no: bool) {
        self.0[lane] = if is_so { yes } else { no };
    }
}

impl<T: PerLane> PerLane for [T; 2] {
    type One = [T::One; 2];

    #[inline(always)]
    fn lane(&self, lane: usize) -> Self::One {
        [self[0].lane(lane), self[1].lane(lane)]
    }

    #[inline(always)]
    fn set_lane(&mut self, lane: usize, [first, second]: Self::One) {
        self[0].set_lane(lane, first);
        self[1].set_lane(lane, second);
    }

    #[inline(always)]
    fn choose(&mut self, lane: usize, is_so: bool, yes: Self::One, no: Self::One) {
        let ([yes, other_yes], [no, other_no]) = (yes, no);
        self[0].choose(lane, is_so, yes, no);
        self[1].choose(lane, is_so, other_yes, other_no);
    }
}

/// A struct that is generic over [`Real`], with [`PerLane`].
#[doc(hidden)]
#[macro_export]
macro_rules! per_lane {
    (
        $(#[$attribute:meta])*
        $visible:vis struct $name:ident<R $(: $bound:ident)? = f64> {
            $($(#[$note:meta])* $seen:vis $field:ident: $type:ty,)*
        }
    ) => {
        $(#[$attribute])*
        $visible struct $name<R $(: $bound)? = f64> {
            $($(#[$note])* $seen $field: $type,)*
        }

        impl<R: $crate::lanes::Real> $crate::lanes::PerLane for $name<R> {
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
            fn choose(&mut self, lane: usize, is_so: bool, yes: Self::One, no: Self::One) {
                $($crate::lanes::PerLane::choose(&mut self.$field, lane, is_so, yes.$field, no.$field);)*
            }
        }
    };
}

/// A struct of numbers, and a list of such, which has a list of every number: what a step does with one of them reads no others.
#[doc(hidden)]
#[macro_export]
macro_rules! number_lists {
    (
        $(#[$about:meta])* $visible:vis $one:ident,
        $(#[$about_all:meta])* $all:ident { $($(#[$note:meta])* $number:ident,)* }
    ) => {
        $(#[$about])*
        #[derive(Debug, Clone, Copy, Default)]
        $visible struct $one {
            $($(#[$note])* $visible $number: f64,)*
        }

        $(#[$about_all])*
        #[derive(Debug, Clone, Default, serde::Serialize, serde::Deserialize)]
        $visible struct $all {
            $($(#[$note])* $visible $number: Vec<f64>,)*
        }

        impl $all {
            /// A copy of one.
            $visible fn at(&self, i: usize) -> $one {
                $one { $($number: self.$number[i],)* }
            }

            /// Puts one in front of another one, or behind the last one.
            $visible fn insert(&mut self, i: usize, one: $one) {
                $(self.$number.insert(i, one.$number);)*
            }
        }
    };
}

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
pub fn lanes(value: impl Fn(usize) -> f64) -> Lanes {
    let mut all = [0.0; LANES];
    for (lane, entry) in all.iter_mut().enumerate() {
        *entry = value(lane);
    }
    Lanes(all)
}

/// Several numbers in every lane.
#[inline(always)]
pub fn each_of<const N: usize>(values: impl Fn(usize) -> [f64; N]) -> [Lanes; N] {
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
pub fn one<const N: usize>(all: &[Lanes; N], lane: usize) -> [f64; N] {
    let mut values = [0.0; N];
    for (value, entry) in values.iter_mut().zip(all) {
        *value = entry.0[lane];
    }
    values
}

/// Eight numbers of a list from a place on.
#[inline(always)]
pub fn load(numbers: &[f64], place: usize) -> Lanes {
    let mut eight = [0.0; LANES];
    eight.copy_from_slice(&numbers[place..][..LANES]);
    Lanes(eight)
}

/// Puts eight numbers back.
#[inline(always)]
pub fn store(numbers: &mut [f64], place: usize, eight: &Lanes) {
    numbers[place..][..LANES].copy_from_slice(&eight.0);
}

/// Numbers by way of memory: a loop that computed them stays vector instructions although lanes are read one by one afterwards.
#[inline(always)]
pub fn settled<T>(numbers: T) -> T {
    std::hint::black_box(numbers)
}

/// 1 in the lanes in which something is so, 0 in the others.
#[inline(always)]
pub fn flags(is_so: impl Fn(usize) -> bool) -> Lanes {
    settled(lanes(|l| if is_so(l) { 1.0 } else { 0.0 }))
}

/// Whether a number is not 0 in any lane, of numbers of which none is −0.
#[inline(always)]
pub fn any<R: Real>(numbers: &R) -> bool {
    let mut bits = 0;
    for l in 0..R::LANES {
        bits |= numbers.lane(l).to_bits();
    }
    bits != 0
}

/// A bit for each lane that has a 1 and not a 0.
#[inline(always)]
pub fn bits_of(flags: &Lanes) -> u8 {
    let mut bits = 0;
    for l in 0..LANES {
        // The exponent of 1 has more ones than there are lanes.
        bits |= (flags[l].to_bits() >> 52) & (1 << l);
    }
    bits as u8
}

/// The larger of two numbers of which neither is undefined.
#[inline(always)]
pub fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The smaller of two numbers of which neither is undefined.
#[inline(always)]
pub fn smaller(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}
