/* What the files of machine share. */
#ifndef JOX_MACHINE_INTERNAL_H
#define JOX_MACHINE_INTERNAL_H

#include "machine/mind.h"

enum { JOX_BATCH = 256 };

/* Agents of one state of one machine, at most a batch, in ascending index. */
typedef struct JoxBatchRange {
    uint16_t machine, state;
    uint32_t begin, count; /* in grouped */
} JoxBatchRange;

typedef double JoxRegisters[JOX_MOST_REGISTERS][JOX_BATCH];

typedef struct JoxMindScratch {
    uint32_t capacity;
    uint32_t *grouped; /* indices of agents by machine and state */
    JoxBatchRange *batches;
    uint32_t batch_count, batch_capacity;
    uint32_t *state_first; /* per state of all machines */
    uint32_t state_capacity;
    int16_t *fired;  /* per agent: transition to take, -1 none */
    uint32_t *rank;  /* per agent: place in the queue it stands in */
    int32_t *queue;  /* per agent that queues: where */
    JoxV2 *heading;  /* per agent: the velocity it preferred in the step before */
    uint32_t *list;  /* agents that take something, by id */
    uint32_t *spare; /* room to sort it */
    uint32_t list_count;
    uint32_t *pending; /* ids whose on_enter has yet to run, ascending */
    uint32_t pending_count, pending_capacity;
    uint64_t *marks; /* a bit per id */
    uint32_t mark_capacity;
    uint32_t *place_people; /* per place; UINT32_MAX: nobody asked */
    uint32_t place_capacity;
    JoxRegisters *registers; /* one set per worker */
    uint32_t workers;
} JoxMindScratch;

/* Something a target resolves to. */
typedef struct JoxSpot {
    bool found;
    float x, y, z, vx, vy, radius;
    int32_t place, object; /* index of what it is, or -1 */
    uint32_t agent;        /* JOX_NO_INDEX if none */
} JoxSpot;

static inline const JoxMachine *jox_machine_of(const JoxMind *mind, uint32_t agent) {
    return mind->machines[mind->agents->machine[agent]];
}
static inline double jox_time_in_state(const JoxMind *mind, uint32_t agent) {
    return (double)(mind->tick - mind->agents->entered[agent]) * mind->dt;
}

/* Resolves target `index` of the agent's machine; index -1 is the agent itself. */
JoxSpot jox_target_find(const JoxMind *mind, uint32_t agent, int32_t index);
/* The place a target names for this agent, or -1. */
int32_t jox_target_place(const JoxMind *mind, uint32_t agent, int32_t index);
/* Gap between the agent's disc and a spot, m. */
float jox_spot_gap(const JoxMind *mind, uint32_t agent, const JoxSpot *spot);
/* Distance from the agent's centre to a target, INFINITY if absent. */
float jox_target_distance(const JoxMind *mind, uint32_t agent, int32_t index);
/* Free distance ahead, m. */
float jox_headway(const JoxMind *mind, uint32_t agent);

/* Runs a program over `count` agents of one machine; results in registers[0]. */
void jox_eval(const JoxMind *mind, const JoxMachine *machine, const JoxProgram *program,
              const uint32_t *agents, uint32_t count, JoxRegisters registers);
/* One agent's value: a constant, its own, or a program. */
double jox_value(const JoxMind *mind, const JoxMachine *machine, const JoxValue *value,
                 uint32_t agent);

/* Makes what was called in the last step audible. */
void jox_mind_listen(JoxMind *mind);
/* Whether another agent within `reach` metres called the name. */
bool jox_heard(const JoxMind *mind, uint32_t agent, uint32_t name, double reach);
/* Neighbours of a kind (a tag's bit or JoxKin), and, with a name, in states of that name. */
uint32_t jox_neighbours_of(const JoxMind *mind, uint32_t agent, int32_t kind, int32_t name);
/* Row of the body that the agent holds and the target means, or -1. */
int32_t jox_holding(const JoxMind *mind, uint32_t agent, int32_t target);
/* Memory that is set and signals that are given on entering or taking something. */
void jox_actions_do(JoxMind *mind, const JoxMachine *machine, const JoxActions *actions,
                    uint32_t agent);
/* Signals that go on while a state lasts. */
void jox_mind_repeat_signals(JoxMind *mind);
/* Gives a machine's names their numbers. */
void jox_mind_number_names(JoxMind *mind, JoxMachine *machine);

/* Sorts indices of agents by id. */
void jox_sort_by_id(JoxMind *mind, uint32_t *list, uint32_t count);
/* Grows the scratch and groups agents by state; ranks the queues. */
void jox_mind_group(JoxMind *mind, JoxPool *pool);
/* The target whose queue a state stands in, or -1. */
int16_t jox_queue_target(const JoxState *state);
void jox_mind_count_places(JoxMind *mind);
void jox_mind_scratch_free(JoxMind *mind);
/* Enters a state: clock, duration, goal, constant parameters. Hooks are the caller's. */
void jox_mind_enter(JoxMind *mind, uint32_t agent, uint16_t state);
/* Writes the parameters that are constant or own values in the agent's present state. */
void jox_mind_write_parameters(JoxMind *mind, uint32_t agent);
/* The parameter as the state, else the machine, sets it; UNSET if neither does. */
const JoxValue *jox_state_parameter(const JoxMachine *machine, const JoxState *state,
                                    int parameter);
/* Counts of transitions that a machine, or those before it, lack by now. */
void jox_machine_add_before(JoxMachine *machine, const char *from, const char *to, uint64_t taken);
void jox_machine_carry_before(const JoxMachine *old, JoxMachine *next);
/* Parameters that are programs, pushing, approach and kicks, after the transitions. */
void jox_mind_act(JoxMind *mind, JoxPool *pool);

#endif
