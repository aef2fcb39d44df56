/* The verdict on a figure: whether its mean over seeds is in its band, and how certain that is. */
#ifndef JOX_VALIDATE_VERDICT_H
#define JOX_VALIDATE_VERDICT_H

#include <stdbool.h>
#include <stdint.h>

typedef struct JoxVerdict {
    double mean, least, most; /* over seeds; NAN: not measured */
    double p95;               /* 95th percentile of the values, linear between ranks */
    /* half width of the 95 % confidence interval of the mean; NAN for one seed */
    double bound;
    /* number of runs that the values come from, or the fewest and most if the values do not tell */
    uint32_t seeds, most_seeds;
    bool inside; /* the mean is in the band; of a figure that must be `sure`, its bound too */
    /* an edge of the band is within the confidence interval; a figure that must be `sure` has none
     */
    bool thin;
} JoxVerdict;

/* Computes the verdict on a figure from its values, one per seed, and its band. */
JoxVerdict jox_verdict(const double *values, uint32_t count, double low, double high);
/* Returns whether the figure was measured and is not in its band. */
bool jox_verdict_misses(const JoxVerdict *verdict);
enum { JOX_BOUND_SIZE = 24, JOX_SEEDS_SIZE = 32 };
/* Writes a bound as "+- 0.47", with two digits or as a whole number; "" if it is not finite. */
void jox_bound_write(char out[JOX_BOUND_SIZE], double bound);
/* Writes a number of seeds as "3", or as "1 to 3" if it is not known better; returns `out`. */
const char *jox_seeds_write(char out[JOX_SEEDS_SIZE], uint32_t fewest, uint32_t most);
/* Parses "101", or "101-110" for ten seeds, at most 1000. Returns false for anything else. */
bool jox_seeds_read(const char *text, uint64_t *first, uint32_t *count);

#endif
