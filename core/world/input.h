/* The input log: what people did, with the tick at which it took effect. Played back, it drives a
   run to the same state. Text, one entry a line, '#' starts a comment:
       TICK player AGENT VX VY      from TICK on, the player's agent wants this velocity, m/s
   Ticks never decrease. */
#ifndef JOX_WORLD_INPUT_H
#define JOX_WORLD_INPUT_H

#include "base/diag.h"
#include "machine/mind.h"

typedef struct JoxInputEntry {
    uint32_t tick, agent_id;
    float vx, vy;
} JoxInputEntry;

/* Zero-initialised is empty. */
typedef struct JoxInputLog {
    JoxInputEntry *entries;
    size_t count, capacity;
    size_t next; /* first entry that has not taken effect */
    /* What each player's agent wants at present; handed to the machines. */
    struct JoxPlayerInput *present;
    uint32_t present_count;
    size_t present_capacity;
} JoxInputLog;

/* Appends the entries of `text`; every wrong line is an error of `file`. */
bool jox_input_parse(JoxInputLog *log, const char *file, const char *text, size_t length,
                     JoxDiagnostics *diagnostics);
void jox_input_add(JoxInputLog *log, JoxInputEntry entry);
/* Lets all entries up to `tick` take effect. */
void jox_input_advance(JoxInputLog *log, uint32_t tick);
void jox_input_free(JoxInputLog *log);

#endif
