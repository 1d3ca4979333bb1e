/*
 * x^n by a polynomial logarithm and a polynomial exponential, 1e-10 of the power for exponents up to 1/4.
 *
 * For positive normal x. At x = 0 it is some small positive number, which the cap by the elastic line takes away.
 */
#include "stages.h"

/* n log2 x, with log2 m = s L(s^2). */
static inline __attribute__((always_inline)) Pair logarithm(Pair x, double n)
{
    double s = x.second, z = s * s;
    double log = (2.8853900798033365 + z * 0.96179883880211) + z * z * (0.5767151860190234 + z * 0.43171769745887384);
    return (Pair){n * (x.first + s * log), 0.0};
}

/* 2^y = 2^whole 2^r, r from -1/2 to 1/2; whole stands in the low bits of y + 1.5 * 2^52. */
static inline __attribute__((always_inline)) double raise(Pair y)
{
    double shifted = y.first + 0x1.8p52, r = y.first - (shifted - 0x1.8p52), r2 = r * r;
    double low = (0.9999999999595618 + r * 0.6931471805568324) + r2 * (0.24022651213498092 + r * 0.055504109063258665);
    double high = (0.009618025613318034 + r * 0.0013333478473685416) + r2 * (0.00015469729214118296 + r * 1.5303700711365693e-05);
    return as_number(as_bits(low + r2 * r2 * high) + (as_bits(shifted) << 52));
}
