//! One number of eight shots.

/// Shots side by side: as many numbers as the widest registers hold.
pub(super) const LANES: usize = 8;

/// A number of every shot, where one load brings all of them.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[repr(C, align(64))]
pub(super) struct Lanes(pub(super) [f64; LANES]);

impl Lanes {
    pub(super) const fn all(value: f64) -> Self {
        Self([value; LANES])
    }
}

// Loops over the lanes work on copies of whole arrays: what a compiler can tell apart from memory becomes vector instructions.

/// The larger of two numbers of which neither is undefined.
#[inline(always)]
pub(super) fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The smaller of two numbers of which neither is undefined.
#[inline(always)]
pub(super) fn smaller(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}
