/* What the own powers share: a number as its bits, and the stages that a power has. */
#include <stdint.h>
#include <string.h>

static inline double as_number(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

static inline uint64_t as_bits(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

#define STAGES

typedef struct {
    double first, second;
} Pair;

/* The first stage: x = 2^k m with m from sqrt(1/2) to sqrt(2), k by the low bits of 2^52 + k; and (m - 1)/(m + 1). */
static inline __attribute__((always_inline)) Pair split(double x)
{
    uint64_t bits = as_bits(x), moved = bits + (0x3ff0000000000000 - 0x3fe6a09e667f3bcd);
    double k = as_number(moved >> 52 | 0x4330000000000000) - (0x1p52 + 1023.0);
    double m = as_number(bits - (moved & 0xfff0000000000000) + 0x3ff0000000000000);
    return (Pair){k, (m - 1.0) / (m + 1.0)};
}
