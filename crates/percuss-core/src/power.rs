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

/// `ln 2`, and what its rounding takes from it.
const LN_2: [f64; 2] = [std::f64::consts::LN_2, 2.319_046_813_846_299_6e-17];

/// `(ln((1 + s)/(1 − s)) − 2 s)/s³` in powers of `s²` up to 0.0405: interpolated at Chebyshev points, 7e-19 of the logarithm.
const NATURAL_LOG: [f64; 8] = [
    0.666_666_666_666_666_6,
    0.400_000_000_000_085_23,
    0.285_714_285_670_146_2,
    0.222_222_230_916_411_4,
    0.181_817_342_464_003_22,
    0.153_890_021_251_657_32,
    0.132_070_800_820_693_64,
    0.136_291_107_218_612_68,
];

/// `(e^r − 1 − r)/r²` in powers of `r` up to `ln(2)/2` in magnitude: interpolated at Chebyshev points, 1.6e-17 of `e^r`.
const NATURAL_EXP: [f64; 10] = [
    0.500_000_000_000_000_1,
    0.166_666_666_666_666_69,
    0.041_666_666_666_624_164,
    0.008_333_333_333_330_065,
    0.001_388_888_891_719_688_1,
    0.000_198_412_698_630_406_7,
    2.480_152_132_211_682_5e-5,
    2.755_726_848_011_633_3e-6,
    2.762_007_599_981_065e-7,
    2.510_037_592_470_971_7e-8,
];

/// 2^54: a subnormal number times it is normal.
const FROM_SUBNORMAL: f64 = 18_014_398_509_481_984.0;

/// `ln x`: within 1 unit in the last place, exactly 0 at 1.
///
/// As the standard has it elsewhere: −∞ at 0, ∞ at ∞, and no number below 0 or of what is none. Subnormal numbers are as good as others.
/// For code that has been dispatched to an instruction set with fused multiply-add, of which it becomes a part without a branch; the same
/// bits, but much more slowly, elsewhere.
#[inline(always)]
pub fn ln(x: f64) -> f64 {
    let is_subnormal = x < f64::MIN_POSITIVE;
    let raised = x * if is_subnormal { FROM_SUBNORMAL } else { 1.0 };
    let log = ln_scaled(raised, if is_subnormal { -54.0 } else { 0.0 });
    let of_limit = if x == 0.0 { f64::NEG_INFINITY } else { x + x };
    let is_inside = (x > 0.0) & (x < f64::INFINITY);
    let beyond = if x < 0.0 { f64::NAN } else { of_limit };
    if is_inside { log } else { beyond }
}

/// `ln x` of a positive normal number, as by [`ln`], without looking for others.
#[inline(always)]
pub fn ln_of_normal(x: f64) -> f64 {
    ln_scaled(x, 0.0)
}

/// `ln(2^more x)` of a positive normal number and a whole one.
#[inline(always)]
fn ln_scaled(x: f64, more: f64) -> f64 {
    let bits = x.to_bits();
    let moved = bits.wrapping_add(ONE - SQRT_HALF);
    let binary = f64::from_bits((moved >> 52) | COUNTER.to_bits()) - (COUNTER + 1023.0) + more;
    let m = f64::from_bits(bits.wrapping_sub(moved & EXPONENT).wrapping_add(ONE));
    // The difference is exact: all but it may be rounded, since it is the largest.
    let f = m - 1.0;
    let s = f / (2.0 + f);
    let z = s * s;
    let half = 0.5 * f * f;
    let low = s.mul_add(z.mul_add(artanh_tail(z), half), LN_2[1] * binary);
    LN_2[0].mul_add(binary, f - (half - low))
}

/// `(ln((1 + s)/(1 − s)) − 2 s)/s³` of `s²`.
#[inline(always)]
fn artanh_tail(z: f64) -> f64 {
    let c = &NATURAL_LOG;
    let z2 = z * z;
    let high = c[7].mul_add(z, c[6]).mul_add(z2, c[5].mul_add(z, c[4]));
    let low = c[3].mul_add(z, c[2]).mul_add(z2, c[1].mul_add(z, c[0]));
    high.mul_add(z2 * z2, low)
}

/// `ln(a/b)` of two positive normal numbers, within 3 units in the last place however close they are: `2 artanh((a − 2^k b)/(a + 2^k b))`
/// and `k ln 2`. `a` is from 2^−1021 to 2^1022. Exactly 0 where they are equal; no number where one of them is not positive.
///
/// For code that has been dispatched to an instruction set, as [`ln`].
#[inline(always)]
pub fn log_ratio(a: f64, b: f64) -> f64 {
    // Of two exponents and a half, so that no difference of two is negative.
    const MIDDLE: u64 = (2047 << 52) + (1 << 51);
    let (a_bits, b_bits) = (a.to_bits(), b.to_bits());
    let moved = a_bits.wrapping_sub(b_bits).wrapping_add(MIDDLE) >> 52;
    let binary = f64::from_bits(moved | COUNTER.to_bits()) - (COUNTER + 2047.0);
    let near = f64::from_bits(b_bits.wrapping_add(moved.wrapping_sub(2047) << 52));
    // The difference is exact.
    let s = (a - near) / (a + near);
    let z = s * s;
    let low = (s * z).mul_add(artanh_tail(z), LN_2[1] * binary);
    let log = LN_2[0].mul_add(binary, s.mul_add(2.0, low));
    if (a > 0.0) & (b > 0.0) { log } else { f64::NAN }
}

/// `e^x`: within 1 unit in the last place, exactly 1 at 0.
///
/// ∞ from where it overflows (709.79), subnormal below −708.4 with one rounding more, 0 from where it is too small for that (−745.14) and at
/// −∞, and no number of what is none. For code that has been dispatched to an instruction set, as [`ln`].
#[inline(always)]
pub fn exponential(x: f64) -> f64 {
    // Beyond these the two factors below would not do; written so that what is no number stays so.
    let x = if x > 710.0 { 710.0 } else { x };
    let x = if x < -746.0 { -746.0 } else { x };
    let shifted = x.mul_add(std::f64::consts::LOG2_E, ROUNDER);
    let binary = shifted - ROUNDER;
    let r = (-LN_2[1]).mul_add(binary, (-LN_2[0]).mul_add(binary, x));
    let c = &NATURAL_EXP;
    let r2 = r * r;
    let r4 = r2 * r2;
    let low = c[3].mul_add(r, c[2]).mul_add(r2, c[1].mul_add(r, c[0]));
    let middle = c[7].mul_add(r, c[6]).mul_add(r2, c[5].mul_add(r, c[4]));
    let high = c[9].mul_add(r, c[8]);
    let tail = high.mul_add(r4, middle).mul_add(r4, low);
    let value = 1.0 + tail.mul_add(r2, r);
    // Two factors: neither overflows where the power does not.
    let halved = 0.5_f64.mul_add(binary, ROUNDER);
    let rest = shifted.to_bits().wrapping_sub(halved.to_bits());
    let factor = |exponent: u64| f64::from_bits((exponent << 52).wrapping_add(ONE));
    value * factor(halved.to_bits()) * factor(rest)
}
