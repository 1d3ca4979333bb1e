/* What the programs share: an end with an error, memory and processor time. PROGRAM is the name of the one that includes it. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static void fail(const char *what)
{
    fprintf(stderr, PROGRAM ": %s\n", what);
    exit(1);
}

static void *reserve(size_t bytes)
{
    void *memory = aligned_alloc(64, (bytes + 63) / 64 * 64);
    if (!memory)
        fail("no memory left");
    memset(memory, 0, bytes);
    return memory;
}

/* Time [s] that processors have spent on this process. */
static double processor_time(void)
{
    struct timespec time;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return time.tv_sec + 1e-9 * time.tv_nsec;
}
