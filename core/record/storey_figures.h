/* Positions in figures and tables: x and y in plan and, in a world with storeys, the name of the
   storey or stair. danger, probes, reports and summaries use it. `storeys` may be NULL. */
#ifndef JOX_RECORD_STOREY_FIGURES_H
#define JOX_RECORD_STOREY_FIGURES_H

#include <math.h>
#include <stdio.h>

#include "base/format/json_writer.h"
#include "base/format/quote.h"
#include "geom/storey_text.h"

/* Writes "PREFIXx", "PREFIXy" and, with storeys, "PREFIXstorey"; null unless `known`. */
static inline void jox_json_add_position(JoxJson *json, const char *prefix,
                                         const JoxStoreys *storeys, JoxV2 at, bool known) {
    const JoxV2 plan = jox_in_plan(storeys, at);
    char key[64];
    snprintf(key, sizeof key, "%sx", prefix);
    jox_json_number(json, key, known ? (double)plan.x : (double)NAN);
    snprintf(key, sizeof key, "%sy", prefix);
    jox_json_number(json, key, known ? (double)plan.y : (double)NAN);
    if (!jox_has_storeys(storeys))
        return;
    snprintf(key, sizeof key, "%sstorey", prefix);
    if (known)
        jox_json_string(json, key, jox_storey_name_at(storeys, at));
    else
        jox_json_null(json, key);
}

/* Writes ",storey", the last column of a header, with storeys alone; and its cell of a row. */
static inline void jox_csv_put_storey_title(FILE *out, const JoxStoreys *storeys) {
    if (jox_has_storeys(storeys))
        fputs(",storey", out);
}
static inline void jox_csv_put_storey(FILE *out, const JoxStoreys *storeys, JoxV2 at, bool known) {
    if (!jox_has_storeys(storeys))
        return;
    fputc(',', out);
    if (known)
        jox_quote_put(out, jox_quote_csv, jox_storey_name_at(storeys, at));
}

#endif
