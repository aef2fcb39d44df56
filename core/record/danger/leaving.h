/* Times at which people left and by which exit, to the step of a run or the frame of a recording.
   danger.c feeds it; reports read quantiles and the table. */
#ifndef JOX_RECORD_DANGER_LEAVING_H
#define JOX_RECORD_DANGER_LEAVING_H

#include <stdio.h>

#include "base/format/json_writer.h"
#include "base/sections.h"
#include "world/exits.h"

enum {
    JOX_LEAVING_EXITS = 16, /* exits that are told apart; further ones count as elsewhere */
    JOX_LEFT_ELSEWHERE = -1,
    JOX_LEFT_ANYWHERE = -2
};

/* Number of people who left by an exit at one time. */
typedef struct JoxLeave {
    double time; /* s */
    uint32_t people;
    int32_t exit; /* index in JoxExits, or JOX_LEFT_ELSEWHERE */
} JoxLeave;

typedef struct JoxLeaving {
    JoxLeave *items; /* in ascending order of time */
    uint32_t count, capacity;
    uint64_t left; /* people counted so far, in all and by exit */
    uint32_t by_exit[JOX_LEAVING_EXITS];
} JoxLeaving;

/* Adds the people who left since the last call. `time`, s, must ascend. */
void jox_leaving_update(JoxLeaving *leaving, const JoxExits *exits, double time);
/* Returns how many people left by an exit, JOX_LEFT_ELSEWHERE or JOX_LEFT_ANYWHERE. */
uint64_t jox_leaving_count(const JoxLeaving *leaving, int32_t exit);
/* Returns the time, s, by which a share (0 to 1) of the people who left by an exit had left: the
   first of them at 0, the last at 1; NAN if there are none. */
double jox_leaving_quantile(const JoxLeaving *leaving, int32_t exit, double share);
/* Writes "leaving_s": {"first", "p25", "p50", "p75", "p95", "last"}. */
void jox_leaving_json(const JoxLeaving *leaving, JoxJson *json);
/* Writes a table: time, people and name of the exit; the name is empty for exits beyond `count`. */
void jox_leaving_csv(const JoxLeaving *leaving, char *const *names, uint32_t count, FILE *out);
void jox_leaving_sections(JoxLeaving *leaving, JoxSections *sections);
void jox_leaving_free(JoxLeaving *leaving);

#endif
