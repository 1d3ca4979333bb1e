//! `x^n` and small strains, written so that a loop over many numbers becomes vector instructions.
//!
//! Sums and products only, in a fixed order and without fused operations: every machine and every width of vector gives the same bits.

#[cfg(test)]
#[path = "power_tests.rs"]
mod tests;

/// Bits of `sqrt(1/2)`: the number is split into `2^k m` with `m` from there to `sqrt(2)`.
const SQRT_HALF: u64 = 0x3fe6_a09e_667f_3bcd;
const ONE: u64 = 0x3ff0_0000_0000_0000;
const EXPONENT: u64 = 0xfff0_0000_0000_0000;
/// Low bits of an exponent `n` that are split off, so that the rest times `k` is exact.
const HIGH: u64 = 0xffff_ffff_f800_0000;
/// 2^52: a small whole number in its low bits makes it that much larger.
const COUNTER: f64 = 4_503_599_627_370_496.0;
/// 1.5 · 2^52: adding and taking it away rounds to a whole number, which stands in the low bits in between.
const ROUNDER: f64 = 6_755_399_441_055_744.0;

/// `2 / ln 2`, and what its nearest 64-bit number leaves.
const LOG_LEAD: f64 = 2.885_390_081_777_926_8;
const LOG_REST: f64 = 4.071_054_748_186_206_6e-17;
/// `(log2 m / s − 2/ln 2) / s²` in powers of `s²`, with `s = (m − 1)/(m + 1)`: interpolated at Chebyshev points, 5e-18 of the logarithm.
const LOG: [f64; 7] = [
    0.961_796_693_925_976,
    0.577_078_016_354_135_5,
    0.412_198_583_898_078,
    0.320_598_738_017_563_67,
    0.262_323_639_700_489_5,
    0.221_189_987_214_124,
    0.210_870_794_760_151_72,
];
/// `(2^r − 1) / r` in powers of `r` from −1/2 to 1/2: interpolated at Chebyshev points, 2e-17 of the power.
const EXP: [f64; 11] = [
    std::f64::consts::LN_2,
    0.240_226_506_959_100_97,
    0.055_504_108_664_821_6,
    0.009_618_129_107_606_888,
    0.001_333_355_814_641_693_6,
    0.000_154_035_304_417_360_5,
    1.525_273_382_983_612e-5,
    1.321_544_258_792_169e-6,
    1.017_806_244_584_577_4e-7,
    7.072_585_949_269_223e-9,
    4.454_960_598_186_518_6e-10,
];

/// `x^n` of a positive number, 0 of zero, no number of what is none: within 2 units in the last place for exponents up to 1 in magnitude, on average 0.15.
///
/// `x` is 0 or normal, and `x^n` neither overflows nor becomes subnormal. Beyond 1 the error grows with the exponent.
///
/// ```
/// use percuss::power::power;
/// assert_eq!(power(32.0, 0.2), 2.0);
/// assert_eq!(power(0.0, 0.1), 0.0);
/// ```
#[inline(always)]
pub fn power(x: f64, n: f64) -> f64 {
    let result = Split::of(x).logarithm(Exponent::new(n)).raise();
    if x > 0.0 { result } else { x }
}

/// The exponent of a power, in two parts.
#[derive(Debug, Clone, Copy, Default)]
pub struct Exponent {
    n: f64,
    /// Its leading bits: a product with a small whole number is exact.
    high: f64,
    rest: f64,
}

impl Exponent {
    /// The exponent `n`.
    #[inline(always)]
    pub fn new(n: f64) -> Self {
        let high = f64::from_bits(n.to_bits() & HIGH);
        let rest = n - high;
        Self { n, high, rest }
    }

    /// The exponent as a number.
    #[inline(always)]
    pub fn value(self) -> f64 {
        self.n
    }
}

/// The first of three stages of a [`power`]: `x = 2^binary (1 + ratio)/(1 − ratio)`.
///
/// A loop over many powers is faster as three loops, one for each stage: the chains of dependent operations are shorter, so that a processor
/// works on more of them at a time.
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

    /// The second stage: `n log2 x`.
    #[inline(always)]
    pub fn logarithm(self, n: Exponent) -> Logarithm {
        let Self {
            binary: k,
            ratio: s,
        } = self;
        let z = s * s;
        let z2 = z * z;
        let low = (LOG[0] + z * LOG[1]) + z2 * (LOG[2] + z * LOG[3]);
        let high = (LOG[4] + z * LOG[5]) + z2 * LOG[6];
        let fraction = s * LOG_LEAD + s * (LOG_REST + z * (low + z2 * z2 * high));
        Logarithm {
            whole: n.high * k,
            part: n.rest * k + n.n * fraction,
        }
    }
}

/// The second stage of a [`power`]: `n log2 x` as a sum.
#[derive(Debug, Clone, Copy, Default)]
pub struct Logarithm {
    /// What is large in it, exact.
    pub whole: f64,
    /// The rest.
    pub part: f64,
}

impl Logarithm {
    /// The third stage: the power.
    #[inline(always)]
    pub fn raise(self) -> f64 {
        let Self { whole, part } = self;
        // Less the nearest whole number: what is large in it is exact.
        let shifted = (whole + part) + ROUNDER;
        let r = (whole - (shifted - ROUNDER)) + part;
        let r2 = r * r;
        let r4 = r2 * r2;
        let low = (EXP[0] + r * EXP[1]) + r2 * (EXP[2] + r * EXP[3]);
        let middle = (EXP[4] + r * EXP[5]) + r2 * (EXP[6] + r * EXP[7]);
        let high = (EXP[8] + r * EXP[9]) + r2 * EXP[10];
        let scaled = 1.0 + r * (low + r4 * (middle + r4 * high));
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
