/*
 * Chains of masses and springs by central differences. POWER names the file with the function `power`:
 *     cc -O3 -march=native -fopenmp -DPOWER='"power_polynomial.h"' chain.c -o chain -lm
 * An own power is computed in stages, or with -DPLAIN in one go.
 * Usage: chain PROBLEM one|batch power|linear THREADS END
 */
#include <math.h>
#include <omp.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

#define PROGRAM "chain"
#include "program.h"

#include POWER

#ifdef STAGES
/* An own power, in one go. */
static inline __attribute__((always_inline)) double power(double x, double n) { return raise(logarithm(split(x), n)); }
#endif

enum { LANES = 8, MOST_SPRINGS = 1024 };

/* A chain, ready for the loop: a spring's constants at the same place of every array. */
typedef struct {
    int springs;
    int rod;
    long chains;
    long steps;
    double time_step;
    double kick[MOST_SPRINGS];        /* time step over mass */
    double per_length[MOST_SPRINGS];  /* 1 / length */
    double stiffness[MOST_SPRINGS];   /* elastic force at strain 1 */
    double coefficient[MOST_SPRINGS]; /* force of the power law at strain 1 */
    double exponent[MOST_SPRINGS];
    double *speed; /* of every chain */
} Problem;

static Problem *read_problem(const char *path)
{
    Problem *p = reserve(sizeof *p);
    FILE *file = fopen(path, "r");
    if (!file)
        fail("cannot open the problem");
    if (fscanf(file, "%d %d %ld %ld %lf", &p->springs, &p->rod, &p->chains, &p->steps, &p->time_step) != 5
        || p->springs < 1 || p->springs > MOST_SPRINGS)
        fail("the problem has no proper first line");
    for (int i = 0; i < p->springs; i++) {
        double mass, length;
        if (fscanf(file, "%lf %lf %lf %lf %lf", &mass, &length, &p->stiffness[i], &p->coefficient[i], &p->exponent[i]) != 5)
            fail("the problem lacks springs");
        p->kick[i] = p->time_step / mass;
        p->per_length[i] = 1.0 / length;
    }
    p->speed = reserve(sizeof(double) * p->chains);
    for (long c = 0; c < p->chains; c++)
        if (fscanf(file, "%lf", &p->speed[c]) != 1)
            fail("the problem lacks speeds");
    fclose(file);
    return p;
}

/* Force of spring i at a strain. */
static inline __attribute__((always_inline)) double force(const Problem *p, int i, double strain, bool linear)
{
    if (linear)
        return p->stiffness[i] * strain;
    double size = fabs(strain);
    double elastic = p->stiffness[i] * size;
    double flow = p->coefficient[i] * power(size, p->exponent[i]);
    return copysign(flow < elastic ? flow : elastic, strain);
}

/* One chain, springs side by side. */
static inline __attribute__((always_inline)) void advance_one(const Problem *p, long chain, double *end, bool linear)
{
    _Alignas(64) double u[MOST_SPRINGS + 1] = {0}, v[MOST_SPRINGS] = {0}, forces[MOST_SPRINGS + 1] = {0};
    const int springs = p->springs;
    const double time_step = p->time_step;
    for (int i = 0; i < p->rod; i++)
        v[i] = p->speed[chain];
    for (long step = 0; step < p->steps; step++) {
#pragma omp simd
        for (int i = 0; i < springs; i++)
            forces[i + 1] = force(p, i, (u[i] - u[i + 1]) * p->per_length[i], linear);
#pragma omp simd
        for (int i = 0; i < springs; i++) {
            v[i] += (forces[i] - forces[i + 1]) * p->kick[i];
            u[i] += v[i] * time_step;
        }
    }
    memcpy(end, u, sizeof(double) * springs);
}

/* Chains that start, one in each lane. */
static inline void set_out(const Problem *p, long chain, double v[][LANES])
{
    for (int i = 0; i < p->rod; i++)
        for (int l = 0; l < LANES; l++)
            v[i][l] = p->speed[chain + l];
}

static inline void arrive(const Problem *p, double u[][LANES], double *end)
{
    for (int l = 0; l < LANES; l++)
        for (int i = 0; i < p->springs; i++)
            end[l * p->springs + i] = u[i][l];
}

/* LANES chains, one in each lane: chains side by side. */
static inline __attribute__((always_inline)) void advance_lanes(const Problem *p, long chain, double *end, bool linear)
{
    _Alignas(64) double u[MOST_SPRINGS + 1][LANES] = {0}, v[MOST_SPRINGS][LANES] = {0};
    const int springs = p->springs;
    const double time_step = p->time_step;
    set_out(p, chain, v);
    for (long step = 0; step < p->steps; step++) {
        _Alignas(64) double behind[LANES] = {0};
        for (int i = 0; i < springs; i++) {
#pragma omp simd simdlen(LANES)
            for (int l = 0; l < LANES; l++) {
                double ahead = force(p, i, (u[i][l] - u[i + 1][l]) * p->per_length[i], linear);
                v[i][l] += (behind[l] - ahead) * p->kick[i];
                u[i][l] += v[i][l] * time_step;
                behind[l] = ahead;
            }
        }
    }
    arrive(p, u, end);
}

#if defined STAGES && !defined PLAIN
enum { TILE = 12 };

/* The same, with the stages of the powers of TILE springs one after the other: shorter chains of dependent operations overlap better. */
static inline __attribute__((always_inline)) void advance_staged(const Problem *p, long chain, double *end)
{
    _Alignas(64) double u[MOST_SPRINGS + 1][LANES] = {0}, v[MOST_SPRINGS][LANES] = {0};
    _Alignas(64) double strain[TILE][LANES], first[TILE][LANES], second[TILE][LANES];
    const int springs = p->springs;
    const double time_step = p->time_step;
    set_out(p, chain, v);
    for (long step = 0; step < p->steps; step++) {
        _Alignas(64) double behind[LANES] = {0};
        for (int start = 0; start < springs; start += TILE) {
            const int stop = springs - start < TILE ? springs - start : TILE;
            for (int t = 0; t < stop; t++) {
                const int i = start + t;
#pragma omp simd simdlen(LANES)
                for (int l = 0; l < LANES; l++) {
                    strain[t][l] = (u[i][l] - u[i + 1][l]) * p->per_length[i];
                    Pair x = split(fabs(strain[t][l]));
                    first[t][l] = x.first;
                    second[t][l] = x.second;
                }
            }
            for (int t = 0; t < stop; t++) {
                const int i = start + t;
#pragma omp simd simdlen(LANES)
                for (int l = 0; l < LANES; l++) {
                    Pair y = logarithm((Pair){first[t][l], second[t][l]}, p->exponent[i]);
                    first[t][l] = y.first;
                    second[t][l] = y.second;
                }
            }
            for (int t = 0; t < stop; t++) {
                const int i = start + t;
#pragma omp simd simdlen(LANES)
                for (int l = 0; l < LANES; l++) {
                    double elastic = p->stiffness[i] * fabs(strain[t][l]);
                    double flow = p->coefficient[i] * raise((Pair){first[t][l], second[t][l]});
                    double ahead = copysign(flow < elastic ? flow : elastic, strain[t][l]);
                    v[i][l] += (behind[l] - ahead) * p->kick[i];
                    u[i][l] += v[i][l] * time_step;
                    behind[l] = ahead;
                }
            }
        }
    }
    arrive(p, u, end);
}
#endif

/* The loops once for every law, so that the law is no question inside them. */
static __attribute__((noinline)) void one_power(const Problem *p, long c, double *end) { advance_one(p, c, end, false); }
static __attribute__((noinline)) void one_linear(const Problem *p, long c, double *end) { advance_one(p, c, end, true); }
#if defined STAGES && !defined PLAIN
static __attribute__((noinline)) void lanes_power(const Problem *p, long c, double *end) { advance_staged(p, c, end); }
#else
static __attribute__((noinline)) void lanes_power(const Problem *p, long c, double *end) { advance_lanes(p, c, end, false); }
#endif
static __attribute__((noinline)) void lanes_linear(const Problem *p, long c, double *end) { advance_lanes(p, c, end, true); }

int main(int count, char **words)
{
    if (count != 6)
        fail("usage: chain PROBLEM one|batch power|linear THREADS END");
    Problem *p = read_problem(words[1]);
    bool batch = !strcmp(words[2], "batch"), linear = !strcmp(words[3], "linear");
    omp_set_num_threads(atoi(words[4]));
    long together = batch ? LANES : 1;
    if (p->chains % together)
        fail("a batch is a multiple of 8 chains");
    void (*advance)(const Problem *, long, double *)
        = batch ? (linear ? lanes_linear : lanes_power) : (linear ? one_linear : one_power);
    double *end = reserve(sizeof(double) * p->chains * p->springs);
    /* Threads start before the clock does. */
#pragma omp parallel
    {
    }
    double start = omp_get_wtime(), start_of_work = processor_time();
#pragma omp parallel for schedule(dynamic)
    for (long c = 0; c < p->chains; c += together)
        advance(p, c, end + c * p->springs);
    printf("%.9f %.9f\n", omp_get_wtime() - start, processor_time() - start_of_work);
    FILE *file = fopen(words[5], "wb");
    if (!file || fwrite(end, sizeof(double), p->chains * p->springs, file) != (size_t)(p->chains * p->springs) || fclose(file))
        fail("cannot write where the chains end");
    return 0;
}
