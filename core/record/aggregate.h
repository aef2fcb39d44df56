/* Joins the summaries of several runs into one, with means and quantiles. run/results/ calls it. */
#ifndef JOX_RECORD_AGGREGATE_H
#define JOX_RECORD_AGGREGATE_H

#include <stdbool.h>
#include <stddef.h>

#include "base/text.h"

/* Kind of a value in a summary, by its dotted path. FIGURE is a result of a run, which may be
   averaged; COST may be averaged, too, but depends on the machine. GIVEN is everything else, which
   is listed run by run: input, texts, and coordinates, whose mean would be a meaningless point. */
typedef enum JoxSummaryKind {
    JOX_SUMMARY_GIVEN,
    JOX_SUMMARY_FIGURE,
    JOX_SUMMARY_COST
} JoxSummaryKind;
JoxSummaryKind jox_summary_kind(const char *path);

/* Joins `count` summaries, each a JSON object, into one object with dotted paths. "figures" has
   {mean, p5, p95} (linear between ranks) of the figures and costs that are numbers in all runs.
   "given" has everything else: once where all runs agree, else as a list with null for runs without
   it. Returns false and writes nothing if a text is no JSON object. */
bool jox_aggregate(const char *const *texts, size_t count, JoxText *out);

#endif
