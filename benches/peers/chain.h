/* The work of every program in C: reading the chains, advancing them, writing where they end. */
#ifndef CHAIN_H
#define CHAIN_H

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

#endif
