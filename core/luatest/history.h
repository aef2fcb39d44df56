/* Record of which agents have been in which state since a test's scene was loaded; `reaches`,
   `never` and `entered` of tests (scene_methods.c) read it. */
#ifndef JOX_LUATEST_HISTORY_H
#define JOX_LUATEST_HISTORY_H

#include "machine/run.h"

enum { JOX_TEST_STATES = 1024 }; /* the most names of states that are recorded */

/* Zero-initialise. States of different machines with the same name are one. */
typedef struct JoxTestHistory {
    char *names[JOX_TEST_STATES];
    uint8_t *been[JOX_TEST_STATES]; /* 1 if an agent has been in the state; by agent id */
    uint32_t name_count, id_capacity;
    int32_t *group; /* index of the group, or -1; by agent id */
    uint32_t known; /* ids below this one have been recorded */
} JoxTestHistory;

/* Records new agents and the transitions of the last step. */
void jox_test_history_note(JoxTestHistory *history, const JoxMachineRun *machines);
/* Returns the number of agents of a group (-1: of all) that have been in a state, or in one within
   it; writes the id of the first of them to `first`, unless NULL. */
uint32_t jox_test_history_been(const JoxTestHistory *history, const char *state, int32_t group,
                               int32_t *first);
void jox_test_history_free(JoxTestHistory *history);

#endif
