/*
 * x^n right to the last two places, by compensated sums, fused where the compiler can.
 *
 * For positive normal x. At x = 0 it is some small positive number, which the cap by the elastic line takes away.
 */
#include "stages.h"

/* n log2 x as a sum of which the first part is exact. log2 m = s L(s^2), the first term of L in two numbers. */
static inline __attribute__((always_inline)) Pair logarithm(Pair x, double n)
{
    double k = x.first, s = x.second, z = s * s, z2 = z * z;
    double low = (0.961796693925976 + z * 0.5770780163541355) + z2 * (0.412198583898078 + z * 0.32059873801756367);
    double high = (0.2623236397004895 + z * 0.221189987214124) + z2 * 0.21087079476015172;
    double log = s * 2.8853900817779268 + s * (4.0710547481862066e-17 + z * (low + z2 * z2 * high));
    double n_high = as_number(as_bits(n) & 0xfffffffff8000000);
    return (Pair){n_high * k, (n - n_high) * k + n * log};
}

/* Two to the sum, less the nearest whole number, which stands in the low bits of the sum with 1.5 * 2^52. */
static inline __attribute__((always_inline)) double raise(Pair y)
{
    double shifted = (y.first + y.second) + 0x1.8p52, r = (y.first - (shifted - 0x1.8p52)) + y.second;
    double r2 = r * r, r4 = r2 * r2;
    double first = (0.6931471805599453 + r * 0.24022650695910097) + r2 * (0.0555041086648216 + r * 0.009618129107606888);
    double next = (0.0013333558146416936 + r * 0.0001540353044173605) + r2 * (1.525273382983612e-05 + r * 1.321544258792169e-06);
    double last = (1.0178062445845774e-07 + r * 7.072585949269223e-09) + r2 * 4.4549605981865186e-10;
    double result = 1.0 + r * (first + r4 * (next + r4 * last));
    return as_number(as_bits(result) + (as_bits(shifted) << 52));
}
