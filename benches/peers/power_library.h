/* The power of the C library; with -ffast-math that of libmvec, for a vector at a time. */
#define power pow
