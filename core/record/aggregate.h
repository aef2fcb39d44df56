/* Summaries of several runs, joined. */
#ifndef JOX_RECORD_AGGREGATE_H
#define JOX_RECORD_AGGREGATE_H

#include <stdbool.h>
#include <stddef.h>

#include "base/text.h"

/* What a number of a summary is, by its dotted path. Figures are statistics of a run, of which a
   mean makes sense; so are costs, which depend on the machine as well. All else is listed: what the
   run was given, texts, and coordinates, whose mean would be a place where nothing was. */
typedef enum JoxSummaryKind {
    JOX_SUMMARY_GIVEN,
    JOX_SUMMARY_FIGURE,
    JOX_SUMMARY_COST
} JoxSummaryKind;
JoxSummaryKind jox_summary_kind(const char *path);

/* Each text is a summary: a JSON object. Writes one object by dotted paths: "figures", which are
   statistics of a run, have {mean, p5, p95} (linear between ranks) where every run has a number;
   all else is in "given", once where the runs agree, else as a list with null where a run has
   none. False, and nothing written, if a text is no JSON object. */
bool jox_aggregate(const char *const *texts, size_t count, JoxText *out);

#endif
