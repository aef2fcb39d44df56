/* Figures of several summaries, joined. */
#ifndef JOX_RECORD_AGGREGATE_H
#define JOX_RECORD_AGGREGATE_H

#include <stdbool.h>
#include <stddef.h>

#include "base/text.h"

/* Each text is a JSON object; writes one object with, for every number that all of them hold, its
   dotted path: {mean, p5, p95} (linear between ranks). False if a text is not JSON. */
bool jox_aggregate(const char *const *texts, size_t count, JoxText *out);

#endif
