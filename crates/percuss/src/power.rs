//! `x^n` and small strains, written so that a loop over many numbers becomes vector instructions.
//!
//! Sums, products and fused multiply-adds in a fixed order. A fused multiply-add is rounded once and correctly wherever it is computed, so every
//! machine and every width of vector gives the same bits. A processor without one (x86-64 before 2013) computes it in software: the same bits, but much
//! more slowly.

use pulp::{Arch, NullaryFnOnce};

#[cfg(test)]
#[path = "power_tests.rs"]
mod tests;

/// Bits of `sqrt(1/2)`: the number is split into `2^k m` with `m` from there to `sqrt(2)`.
const SQRT_HALF: u64 = 0x3fe6_a09e_667f_3bcd;
const ONE: u64 = 0x3ff0_0000_0000_0000;
const EXPONENT: u64 = 0xfff0_0000_0000_0000;
/// 2^52: a small whole number in its low bits makes it that much larger.
const COUNTER: f64 = 4_503_599_627_370_496.0;
/// 1.5 · 2^52: adding and taking it away rounds to a whole number, which stands in the low bits in between.
const ROUNDER: f64 = 6_755_399_441_055_744.0;

/// `log2 m / s` in powers of `s²`, with `s = (m − 1)/(m + 1)`: interpolated at Chebyshev points, 7e-15 of `log2 m`.
const LOG: [f64; 6] = [
    2.885_390_081_777_428_5,
    0.961_796_694_399_656_3,
    0.577_077_887_919_534_6,
    0.412_213_478_534_201_6,
    0.319_762_170_652_681_37,
    0.284_672_888_719_683_8,
];
/// `(2^r − 1) / r` in powers of `r` from −1/2 to 1/2: the largest error is the smallest possible, 1.6e-14 of `2^r`.
const EXP: [f64; 9] = [
    0.693_147_180_559_885_4,
    0.240_226_506_957_232_72,
    0.055_504_108_668_407_08,
    0.009_618_129_181_066_776,
    0.001_333_355_762_615_605_3,
    0.000_154_034_409_466_494_62,
    1.525_298_983_123_263_3e-5,
    1.325_832_309_950_517_2e-6,
    1.014_835_160_765_126_7e-7,
];

/// `x^n` of a positive number, 0 of zero, no number of what is none: within 2.2e-14 of its value for exponents up to 1 in magnitude.
///
/// `x` is 0 or normal, and `x^n` neither overflows nor becomes subnormal. The error is at most 1.7e-14 and 5e-15 for each unit of the exponent, and
/// 1.6e-16 more for each factor of 2 that the power is away from 1. Powers of 0 and of 1, and powers of two that are powers of two, are exact.
///
/// ```
/// use percuss::power::power;
/// assert_eq!(power(32.0, 0.2), 2.0);
/// assert_eq!(power(0.0, 0.1), 0.0);
/// assert!((power(2.0, 0.5) - 2.0_f64.sqrt()).abs() < 3e-14);
/// ```
pub fn power(x: f64, n: f64) -> f64 {
    struct Power(f64, f64);
    impl NullaryFnOnce for Power {
        type Output = f64;
        #[inline(always)]
        fn call(self) -> f64 {
            power_here(self.0, self.1)
        }
    }
    Arch::new().dispatch(Power(x, n))
}

/// The same for code that has been dispatched to an instruction set, of which it becomes a part; elsewhere it would be slow.
#[inline(always)]
pub(crate) fn power_here(x: f64, n: f64) -> f64 {
    let result = Split::of(x).logarithm(n).raise();
    if x > 0.0 { result } else { x }
}

/// The first of three stages of a [`power`]: `x = 2^binary (1 + ratio)/(1 − ratio)`.
///
/// A loop over many powers is faster as three loops, one for each stage: the chains of dependent operations are shorter, so that a processor
/// works on more of them at a time. The loops have to be dispatched to an instruction set with fused multiply-add, as by the crate `pulp`.
#[derive(Debug, Clone, Copy, Default)]
pub struct Split {
    /// A whole number.
    pub binary: f64,
    /// At most 0.172 in magnitude.
    pub ratio: f64,
}

impl Split {
    /// Splits a positive normal number. 0 is taken for some very small number.
    #[inline(always)]
    pub fn of(x: f64) -> Self {
        let bits = x.to_bits();
        let moved = bits.wrapping_add(ONE - SQRT_HALF);
        let binary = f64::from_bits((moved >> 52) | COUNTER.to_bits()) - (COUNTER + 1023.0);
        let m = f64::from_bits(bits.wrapping_sub(moved & EXPONENT).wrapping_add(ONE));
        let ratio = (m - 1.0) / (m + 1.0);
        Self { binary, ratio }
    }

    /// The second stage.
    #[inline(always)]
    pub fn logarithm(self, n: f64) -> Logarithm {
        let s = self.ratio;
        let z = s * s;
        let high = LOG[5].mul_add(z, LOG[4]);
        let high = high.mul_add(z, LOG[3]).mul_add(z, LOG[2]);
        let fraction = high.mul_add(z, LOG[1]).mul_add(z, LOG[0]);
        Logarithm(n * s.mul_add(fraction, self.binary))
    }
}

/// The second stage of a [`power`]: `n log2 x`.
#[derive(Debug, Clone, Copy, Default)]
pub struct Logarithm(pub f64);

impl Logarithm {
    /// The third stage: the power.
    #[inline(always)]
    pub fn raise(self) -> f64 {
        // Less the nearest whole number.
        let shifted = self.0 + ROUNDER;
        let r = self.0 - (shifted - ROUNDER);
        let high = EXP[8].mul_add(r, EXP[7]);
        let high = high.mul_add(r, EXP[6]).mul_add(r, EXP[5]);
        let middle = high.mul_add(r, EXP[4]).mul_add(r, EXP[3]);
        let low = middle.mul_add(r, EXP[2]).mul_add(r, EXP[1]);
        let scaled = low.mul_add(r, EXP[0]).mul_add(r, 1.0);
        f64::from_bits(scaled.to_bits().wrapping_add(shifted.to_bits() << 52))
    }
}

/// Largest `(a − b)/(a + b)` for which [`small_log_ratio`] is exact to the last places.
const SMALL: f64 = 0.05;

/// `ln(a/b)` of two positive numbers.
#[inline(always)]
pub(crate) fn log_ratio(a: f64, b: f64) -> f64 {
    let (log, is_exact) = small_log_ratio(a, b);
    if is_exact { log } else { (a / b).ln() }
}

/// `ln(a/b) = 2 artanh((a − b)/(a + b))` of two numbers that differ by less than a tenth, and whether they do.
#[inline(always)]
pub(crate) fn small_log_ratio(a: f64, b: f64) -> (f64, bool) {
    let s = (a - b) / (a + b);
    let z = s * s;
    let tail = (1.0 / 3.0 + z * (1.0 / 5.0))
        + z * z * ((1.0 / 7.0 + z * (1.0 / 9.0)) + z * z * (1.0 / 11.0));
    let twice = 2.0 * s;
    (twice + twice * (z * tail), s.abs() <= SMALL)
}

/// `e^x`.
#[inline(always)]
pub(crate) fn exponential(x: f64) -> f64 {
    let (value, is_exact) = small_exponential(x);
    if is_exact { value } else { x.exp() }
}

/// `e^x` of a number of magnitude 1/20 at most, and whether it is.
#[inline(always)]
pub(crate) fn small_exponential(x: f64) -> (f64, bool) {
    let x2 = x * x;
    let low = 1.0 / 2.0 + x * (1.0 / 6.0);
    let middle = 1.0 / 24.0 + x * (1.0 / 120.0);
    let high = (1.0 / 720.0 + x * (1.0 / 5040.0)) + x2 * (1.0 / 40320.0);
    (
        1.0 + (x + x2 * (low + x2 * (middle + x2 * high))),
        x.abs() <= SMALL,
    )
}
