/* What the files of machine share. */
#ifndef JOX_MACHINE_INTERNAL_H
#define JOX_MACHINE_INTERNAL_H

#include "geom/hands.h"
#include "machine/run.h"

enum { JOX_BATCH = 256 };

/* Agents of one state of one machine, at most a batch, in ascending index. */
typedef struct JoxBatchRange {
    uint16_t machine, state;
    uint32_t begin, count; /* in grouped */
} JoxBatchRange;

/* A parameter that came out as no value for it (odd.c). */
typedef struct JoxTold JoxTold;
typedef struct JoxOdd {
    bool found;
    uint16_t machine, state;
    uint32_t agent_id;
    int32_t parameter, line;
    uint32_t source; /* number of the file of the line */
    double value;
} JoxOdd;

typedef double JoxRegisters[JOX_MOST_REGISTERS][JOX_BATCH];

typedef struct JoxMachineScratch {
    uint32_t capacity;
    uint32_t *grouped; /* indices of agents by machine and state */
    JoxBatchRange *batches;
    uint32_t batch_count, batch_capacity;
    uint32_t *state_first; /* per state of all machines, and behind them */
    uint32_t *part_first;  /* the same of each part that is sorted by itself */
    size_t state_capacity, part_capacity;
    uint32_t *in_state; /* per agent: number among all states, as it is grouped by them */
    int16_t *fired;     /* per agent: transition to take, -1 none */
    uint32_t *rank;     /* per agent: place in the queue it stands in */
    int32_t *queue;     /* per agent that queues: where */
    JoxV2 *heading;     /* per agent: the velocity it preferred in the step before; or NULL */
    size_t heading_capacity;
    uint32_t *list;  /* agents that take something, by id */
    uint32_t *spare; /* room to sort it */
    uint32_t list_count;
    JoxV2 *row;                  /* per agent that stands in a row: where in it */
    struct JoxRowEntry *entries; /* those who do */
    /* Of those who gather in places: their spots stand in `row`, too. Nothing where nobody does. */
    struct JoxGathering *gathered;
    void *gather_blocks;
    uint32_t gather_capacity;
    uint32_t *gather_number;              /* by agent that gathers: its number in its part */
    struct JoxGatherPlace *gather_places; /* by place, front and part */
    uint32_t gather_count;
    size_t gather_place_capacity;
    struct JoxGatherGround *gather_grounds; /* by place */
    uint32_t ground_count;
    size_t ground_capacity;
    JoxSignal *heard; /* called in the last step, by name and x */
    uint32_t heard_count;
    uint32_t *everywhere; /* names called out to everybody in the last step */
    uint32_t everywhere_count;
    size_t heard_capacity, everywhere_capacity;
    JoxHands hands;  /* what is in the way of who picks something up */
    uint64_t *marks; /* a bit per id */
    uint32_t mark_capacity;
    uint32_t *place_people; /* per place; UINT32_MAX: nobody asked */
    uint32_t *place_queue;  /* per place: who stand in its queue */
    uint32_t place_capacity;
    JoxRegisters *registers; /* one set per worker */
    JoxOdd *odd;             /* the first that each worker met */
    uint32_t workers;
} JoxMachineScratch;

/* Something a target resolves to. */
typedef struct JoxSpot {
    bool found;
    float x, y, z, vx, vy, radius;
    int32_t place, object; /* index of what it is, or -1 */
    uint32_t agent;        /* JOX_NO_INDEX if none */
} JoxSpot;

static inline const JoxMachine *jox_machine_of(const JoxMachineRun *run, uint32_t agent) {
    return run->set->items[run->agents->machine[agent]];
}
static inline double jox_time_in_state(const JoxMachineRun *run, uint32_t agent) {
    return (double)(run->tick - run->agents->entered[agent]) * run->dt;
}

/* Where the agent came in, x and y, of a machine that asks for it. */
static inline double *jox_post(const JoxMachineRun *run, uint32_t agent) {
    const JoxAgents *a = run->agents;
    return a->memory + (size_t)agent * a->memory_stride + jox_machine_of(run, agent)->home - 1;
}

/* Makes that where it is now. */
void jox_post_set(JoxMachineRun *run, uint32_t agent);

/* Resolves target `index` of the agent's machine; index -1 is the agent itself. */
JoxSpot jox_target_find(const JoxMachineRun *run, uint32_t agent, int32_t index);
/* The place a target names for this agent, or -1. */
int32_t jox_target_place(const JoxMachineRun *run, uint32_t agent, int32_t index);
/* Those of some agents of one machine. */
void jox_target_places(const JoxMachineRun *run, const JoxMachine *machine, int32_t index,
                       const uint32_t *agents, uint32_t count, int32_t *places);
/* Gap between the agent's disc and a spot, m. */
float jox_spot_gap(const JoxMachineRun *run, uint32_t agent, const JoxSpot *spot);
/* Distance from the agent's centre to a target, INFINITY if absent. */
/* Whether body `row` is the target, or bears its tag; false of -1. */
bool jox_target_means(const JoxMachineRun *run, uint32_t agent, int32_t index, int32_t row);
float jox_target_distance(const JoxMachineRun *run, uint32_t agent, int32_t index);
/* What a person or an input log asks of the agent: its wanted velocity, m/s; (0, 0): nothing. Its
   size. */
JoxV2 jox_player_wants(const JoxMachineRun *run, uint32_t agent);
float jox_driven(const JoxMachineRun *run, uint32_t agent);
/* The velocity that an agent preferred in the step before, m/s. Where no machine asks, none is
   kept, and whoever looks on sees the present one. */
static inline JoxV2 jox_heading_of(const JoxMachineRun *run, uint32_t agent) {
    const JoxAgents *a = run->agents;
    return run->scratch->heading ? run->scratch->heading[agent]
                                 : (JoxV2){a->pref_x[agent], a->pref_y[agent]};
}
/* Free distance ahead, m. */
float jox_headway(const JoxMachineRun *run, uint32_t agent);

/* What one term of a state asks of an agent, as a share of the wanted speed: of length 1 at most,
   drift and player aside. Not of those that are done for a batch at once, and not evade. */
JoxV2 jox_steer_word(const JoxMachineRun *run, uint32_t agent, const JoxSteerTerm *term);
/* About, turning gradually; back from walls, and into the place that it keeps to. */
JoxV2 jox_steer_wander(const JoxMachineRun *run, uint32_t agent, int32_t target);
/* steering/rows.c: finds for all who stand in rows where in them that is, into the scratch's `row`.
 */
void jox_rows_form(JoxMachineRun *run);
/* gather_ground.c: the term by which those in a state gather in a place, or NULL. */
const JoxSteerTerm *jox_gather_term(const JoxState *state);
/* steering/gather.c: finds for all who gather in a place where to stand, into the scratch's `row`.
 */
void jox_gatherings_form(JoxMachineRun *run);
/* gather_ground.c */
void jox_gatherings_free(JoxMachineScratch *scratch);
/* The spots of places are found anew. */
void jox_gatherings_forget(JoxMachineScratch *scratch);
/* Full speed towards a point, less when it is near. */
JoxV2 jox_steer_arrive(JoxV2 from, JoxV2 to, float speed);
/* Past those who come towards where the other terms lead. */
JoxV2 jox_steer_evade(const JoxMachineRun *run, uint32_t agent, JoxV2 ahead);
/* Towards a target, straight; slower where it is about to arrive at a point. */
JoxV2 jox_steer_seek(const JoxMachineRun *run, uint32_t agent, int32_t target);

/* Runs an expression over `count` agents of one machine; results in registers[0]. */
void jox_eval(const JoxMachineRun *run, const JoxMachine *machine, const JoxExpression *expression,
              const uint32_t *agents, uint32_t count, JoxRegisters registers);
/* Whether all of `values` are 0: a condition. */
bool jox_holds_for_nobody(const double *values, uint32_t count);
/* One agent's value: a constant, its own, or an expression. */
double jox_value(const JoxMachineRun *run, const JoxMachine *machine, const JoxValue *value,
                 uint32_t agent);

/* Checks, called through JOX_CHECK (machine_checks.c): a machine as it is put into a set; the
   batches; ranks in queues, of a list sorted by turn; a list by id; signals heard; agents' states
   and rows; what is done to bodies and of pushing; transitions taken; preferred velocities; what
   people set; and counts of transitions that a new version took over. */
void jox_machine_check(const JoxMachine *machine);
void jox_groups_check(const JoxMachineRun *run);
void jox_queues_check(const JoxMachineRun *run, const uint32_t *list, uint32_t count);
void jox_by_id_check(const JoxAgents *agents, const uint32_t *list, uint32_t count);
void jox_heard_check(const JoxMachineRun *run);
/* What of signals, of agents' states or of set parameters does not hold; NULL: all does. */
const char *jox_signals_fault(const JoxMachineRun *run);
const char *jox_states_fault(const JoxMachineRun *run);
const char *jox_edits_fault(const JoxMachineRun *run);
void jox_states_check(const JoxMachineRun *run);
void jox_acts_check(const JoxMachineRun *run);
void jox_taken_check(const JoxMachineRun *run);
void jox_preferred_check(const JoxMachineRun *run);
void jox_edits_check(const JoxMachineRun *run);
void jox_counts_carried_check(const JoxMachineCounts *was, const JoxMachineCounts *is);

/* The scratch, made on first use. */
JoxMachineScratch *jox_machines_scratch(JoxMachineRun *run);
/* Makes what was called in the last step audible. */
void jox_machines_listen(JoxMachineRun *run);
/* Whether another agent within `reach` metres called the name. */
bool jox_heard(const JoxMachineRun *run, uint32_t agent, uint32_t name, double reach);
/* sight.c: whether a wall that stands hides one point from another; those that people look over do
   so only where `touched`. */
bool jox_is_hidden(const JoxMachineRun *run, JoxV2 from, JoxV2 to, bool touched);
/* Whether a body hides one point from another: one that reaches above 1.3 m, half a metre wide at
   least, in which neither lies; not that of row `but`. */
bool jox_is_behind_body(const JoxMachineRun *run, JoxV2 from, JoxV2 to, int32_t but);
/* Whether a wall of another ring than `but` hides one point from another. */
bool jox_is_hidden_by(const JoxMachineRun *run, uint32_t but, JoxV2 from, JoxV2 to, bool touched);
/* The first wall that stands on the way from one point to another: true with its unit normal. */
bool jox_meets_wall(const JoxMachineRun *run, JoxV2 from, JoxV2 to, JoxV2 *normal);
/* Whether agent j, whom agent i sees, is what a target of i's machine asks for. */
bool jox_is_wanted(const JoxMachineRun *run, const JoxTarget *target, uint32_t i, uint32_t j);
/* Neighbours that a target asks for. */
uint32_t jox_neighbours_of(const JoxMachineRun *run, uint32_t agent, int32_t target);
/* What an agent's memory holds by the name with this number; NAN unless that is public. */
double jox_remembered(const JoxMachineRun *run, uint32_t agent, uint32_t name);
/* What the agent that a target is remembers by the name with this number; 0 unless public. */
double jox_theirs(const JoxMachineRun *run, uint32_t agent, int32_t target, uint32_t name);
/* Whether a gate at the place stands and the agent sees it: within perception, and no other wall
   lies before it. */
bool jox_sees_shut(const JoxMachineRun *run, uint32_t agent, int32_t place);
/* Whether the agent carries such a body, or holds on to such an agent. */
bool jox_has(const JoxMachineRun *run, uint32_t agent, int32_t target);
/* Row of the body that the agent holds and the target means, or -1. */
int32_t jox_holding(const JoxMachineRun *run, uint32_t agent, int32_t target);
/* Memory that is set and signals that are given on entering or taking something. */
void jox_actions_do(JoxMachineRun *run, const JoxMachine *machine, const JoxActions *actions,
                    uint32_t agent);
/* Signals that go on while a state lasts. */
void jox_machines_repeat_signals(JoxMachineRun *run);

/* dormant.c: the name that the part had which is called `name` now; the same where it was not
 * renamed. */
const char *jox_name_before(const JoxMachine *old, const JoxMachine *next, JoxPart part,
                            const char *name);
/* Which of the old slots of memory goes on as next->memory[slot], of the same kind; -1: none. */
int32_t jox_memory_before(const JoxMachine *old, const JoxMachine *next, uint32_t slot);
/* Gives the new version dormant slots for memory that it lacks. */
void jox_dormant_keep(const JoxMachine *old, JoxMachine *next);
/* Tells what memory is kept, taken up again or dropped. */
void jox_dormant_tell(const JoxMachine *old, const JoxMachine *next, const char *people,
                      JoxText *out);

/* Sorts indices of agents by id. */
void jox_sort_by_id(JoxMachineRun *run, uint32_t *list, uint32_t count);
/* Grows the scratch and groups agents by state; ranks the queues. */
void jox_machines_group(JoxMachineRun *run, JoxPool *pool);
/* The target whose queue a state stands in, or -1. */
int16_t jox_queue_target(const JoxState *state);
void jox_machines_count_places(JoxMachineRun *run);
void jox_machines_scratch_free(JoxMachineRun *run);
/* The duration that a state computes for an agent, s: what is no number sets none. */
float jox_duration_of(const JoxMachineRun *run, const JoxMachine *machine, const JoxState *state,
                      uint32_t agent);
/* Enters a state: clock, duration, goal, constant parameters. Hooks are the caller's. */
void jox_machines_enter(JoxMachineRun *run, uint32_t agent, uint16_t state);
/* Writes the parameters that are constant or own values in the agent's present state. */
void jox_machines_write_parameters(JoxMachineRun *run, uint32_t agent);
/* The parameter as the state, else the machine, sets it; UNSET if neither does. */
const JoxValue *jox_state_parameter(const JoxMachine *machine, const JoxState *state,
                                    int parameter);
/* Clears the agent's own values and memory beyond those of the machine, so that what an older
   machine left there is no part of the state. */
void jox_rows_end(JoxAgents *agents, uint32_t agent, const JoxMachine *machine);
/* Puts a machine into a place of the set: numbers its names and transitions, widens the agents'
   rows, begins its counts. From here on it does not change. */
void jox_machines_put(JoxMachineRun *run, uint32_t index, JoxMachine *machine);
/* Room for the counts of a machine's transitions and states, with zeros. */
void jox_counts_begin(JoxMachineCounts *counts, const JoxMachine *machine, uint32_t tick);
/* Counts who is in which state, as they are grouped. */
void jox_counts_spend(JoxMachineRun *run);
/* Adds to what transitions between two states, by names, have counted that are no more. */
void jox_counts_add_before(JoxMachineCounts *counts, const char *from, const char *to,
                           uint64_t taken);
void jox_counts_free(JoxMachineCounts *counts);
/* odd.c: whether a number is no value for a parameter; the first of a batch, of those that nobody
   was told of, into `first`, unless that comes before it; tells of it. */
bool jox_is_odd(int parameter, double value);
void jox_odd_look(const JoxMachineRun *run, const uint32_t *agents, uint32_t count, int parameter,
                  const double *values, JoxOdd *first);
const JoxOdd *jox_odd_first(const JoxOdd *odd, uint32_t count);
void jox_odd_tell(JoxMachineRun *run, const JoxOdd *odd);
/* Tells of one agent's. */
void jox_odd_note(JoxMachineRun *run, uint32_t agent, int parameter, double value);
/* Applies to a machine what people set of it; the machine as built where they set nothing. */
void jox_edits_apply(JoxMachineRun *run, uint32_t machine);
/* Forgets what people set of a machine, and its copy. */
void jox_edits_end(JoxMachineRun *run, uint32_t machine);
/* watch.c: notes a transition that was taken, and what actions wrote, of agents that are watched.
 */
void jox_watch_taken(const JoxMachineRun *run, const JoxTaken *taken);
void jox_watch_actions(JoxMachineRun *run, const JoxMachine *machine, const JoxActions *actions,
                       uint32_t agent);
/* grasp.c: of those given, in ascending id: they take hold, pull, and lose hold. */
void jox_machines_grasp(JoxMachineRun *run, const uint32_t *agents, uint32_t count);
/* Parameters that are expressions, pushing, approach, kicks and holds, after the transitions. */
void jox_machines_act(JoxMachineRun *run, JoxPool *pool);

/* machine_checks.c: how many of the registers a, b, c an operation reads. */
uint32_t jox_op_inputs(JoxOp op);

#endif
