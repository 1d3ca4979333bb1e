/*
 * x^n by a polynomial logarithm and a polynomial exponential, 1e-10 of the power for exponents up to 1/4.
 *
 * For positive normal x. At x = 0 it is some small positive number, which the cap by the elastic line takes away.
 */
#include "bits.h"

static inline __attribute__((always_inline)) double power(double x, double n)
{
    /* x = 2^k m with m from sqrt(1/2) to sqrt(2); k by the low bits of 2^52 + k. */
    uint64_t bits = as_bits(x), moved = bits + (0x3ff0000000000000 - 0x3fe6a09e667f3bcd);
    double k = as_number(moved >> 52 | 0x4330000000000000) - (0x1p52 + 1023.0);
    double m = as_number(bits - (moved & 0xfff0000000000000) + 0x3ff0000000000000);
    /* log2 m = s L(s^2), s = (m - 1)/(m + 1). */
    double s = (m - 1.0) / (m + 1.0), z = s * s;
    double log = (2.8853900798033365 + z * 0.96179883880211) + z * z * (0.5767151860190234 + z * 0.43171769745887384);
    double y = n * (k + s * log);
    /* 2^y = 2^whole 2^r, r from -1/2 to 1/2; whole stands in the low bits of y + 1.5 * 2^52. */
    double shifted = y + 0x1.8p52, r = y - (shifted - 0x1.8p52), r2 = r * r;
    double low = (0.9999999999595618 + r * 0.6931471805568324) + r2 * (0.24022651213498092 + r * 0.055504109063258665);
    double high = (0.009618025613318034 + r * 0.0013333478473685416) + r2 * (0.00015469729214118296 + r * 1.5303700711365693e-05);
    return as_number(as_bits(low + r2 * r2 * high) + (as_bits(shifted) << 52));
}
