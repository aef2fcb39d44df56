/* Who has been in which state since a test's scene began. */
#ifndef JOX_LUATEST_HISTORY_H
#define JOX_LUATEST_HISTORY_H

#include "machine/run.h"

enum { JOX_TEST_STATES = 1024 }; /* names of states that are kept */

typedef struct JoxTestHistory {
    char *names[JOX_TEST_STATES];
    uint8_t *been[JOX_TEST_STATES]; /* by agent id */
    uint32_t name_count, id_capacity;
    int32_t *group; /* by agent id */
    uint32_t known; /* ids whose group is known */
} JoxTestHistory;

/* Takes note of new agents and of the transitions of the last step. */
void jox_test_history_note(JoxTestHistory *history, const JoxMachineRun *machines);
/* Index of a state's name in `been`, or -1 where nobody has been in it. */
int jox_test_history_find(const JoxTestHistory *history, const char *name);
/* How many of a group (-1: of all) have been in a state. */
uint32_t jox_test_history_been(const JoxTestHistory *history, const char *state, int32_t group);
void jox_test_history_free(JoxTestHistory *history);

#endif
