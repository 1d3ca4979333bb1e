//! Numbers side by side: eight elements, particles or runs, on which one instruction works.
//!
//! Loops over the lanes work on copies of whole arrays: what a compiler can tell apart from memory becomes vector instructions. Code that
//! uses them is dispatched to an instruction set by `pulp`, and has the same bits on all of them.

use std::ops::{Deref, DerefMut};

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
