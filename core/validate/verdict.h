/* What a figure's values over seeds say about its band. */
#ifndef JOX_VALIDATE_VERDICT_H
#define JOX_VALIDATE_VERDICT_H

#include <stdbool.h>
#include <stdint.h>

typedef struct JoxVerdict {
    double mean, least, most; /* over seeds; NAN: not measured */
    double p95;               /* 95 % of the values lie below it, linear between ranks */
    double bound;             /* the mean is so sure to 95 %, to either side; NAN of one seed */
    uint32_t seeds;
    bool inside; /* the mean lies in the band */
    bool thin;   /* an edge of the band lies within the bound about the mean */
} JoxVerdict;

JoxVerdict jox_verdict(const double *values, uint32_t count, double low, double high);
enum { JOX_BOUND_SIZE = 24 };
/* "+- 0.47": a bound in two digits, or whole where it is greater; "" of one that is not finite. */
void jox_bound_write(char out[JOX_BOUND_SIZE], double bound);
/* Of "101" or "101-110", which is ten of them; at most 1000. False of anything else. */
bool jox_seeds_read(const char *text, uint64_t *first, uint32_t *count);

#endif
