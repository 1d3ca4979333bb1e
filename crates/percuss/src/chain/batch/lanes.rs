//! One number of eight shots.

/// Shots side by side: as many numbers as the widest registers hold.
pub(in crate::chain) const LANES: usize = 8;

/// A number of every shot, where one load brings all of them.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[repr(C, align(64))]
pub(super) struct Lanes(pub(super) [f64; LANES]);

impl Lanes {
    pub(super) const fn all(value: f64) -> Self {
        Self([value; LANES])
    }
}

/// The lanes whose bits are set in a number, and after them others.
pub(super) const SET_LANES: [[u32; LANES]; 256] = {
    let mut table = [[0; LANES]; 256];
    let mut bits = 0;
    while bits < 256 {
        let (mut count, mut lane) = (0, 0);
        while lane < LANES {
            if bits >> lane & 1 == 1 {
                table[bits][count] = lane as u32;
                count += 1;
            }
            lane += 1;
        }
        bits += 1;
    }
    table
};

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
