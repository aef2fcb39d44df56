/* When people left, and by which exit: to a step of a run, to a frame of a recording. */
#ifndef JOX_RECORD_DANGER_LEAVING_H
#define JOX_RECORD_DANGER_LEAVING_H

#include <stdio.h>

#include "base/format/json_writer.h"
#include "base/sections.h"
#include "world/exits.h"

enum {
    JOX_LEAVING_EXITS = 16, /* that are told apart; the rest left elsewhere */
    JOX_LEFT_ELSEWHERE = -1,
    JOX_LEFT_ANYWHERE = -2
};

/* So many people at one moment. */
typedef struct JoxLeave {
    double time; /* s */
    uint32_t people;
    int32_t exit; /* index of the exits, or JOX_LEFT_ELSEWHERE */
} JoxLeave;

typedef struct JoxLeaving {
    JoxLeave *items; /* ascending in time */
    uint32_t count, capacity;
    uint64_t left; /* what was counted so far */
    uint32_t by_exit[JOX_LEAVING_EXITS];
} JoxLeaving;

/* Exits as they are at a time; times ascend. */
void jox_leaving_note(JoxLeaving *leaving, const JoxExits *exits, double time);
/* How many left by an exit, JOX_LEFT_ELSEWHERE or JOX_LEFT_ANYWHERE. */
uint64_t jox_leaving_count(const JoxLeaving *leaving, int32_t exit);
/* The time, s, by which a share (0 to 1) of those had left: of the first of them at 0, of the last
   at 1; NAN of nobody. */
double jox_leaving_quantile(const JoxLeaving *leaving, int32_t exit, double share);
/* Adds "leaving_s": {"first", "p25", "p50", "p75", "p95", "last"}. */
void jox_leaving_json(const JoxLeaving *leaving, JoxJson *json);
/* A table: time, people, and the exit's name of `names`; empty where it is none of them. */
void jox_leaving_csv(const JoxLeaving *leaving, char *const *names, uint32_t count, FILE *out);
void jox_leaving_sections(JoxLeaving *leaving, JoxSections *sections);
void jox_leaving_free(JoxLeaving *leaving);

#endif
