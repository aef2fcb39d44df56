/* Declarations shared by the files of machine/ and machine/steering/, and by nothing above them. */
#ifndef JOX_MACHINE_MACHINE_PARTS_H
#define JOX_MACHINE_MACHINE_PARTS_H

#include <math.h>

#include "geom/hand_reach.h"
#include "machine/lists.h"
#include "machine/run.h"

enum { JOX_BATCH = 256 };

/* A batch: at most JOX_BATCH agents in one state of one machine, by ascending index. */
typedef struct JoxBatchRange {
    uint16_t machine, state;
    uint32_t begin, count; /* range of scratch->grouped */
} JoxBatchRange;

/* Numbers of actions that machines compute; they count on from the parameters, and each slot of
   memory from JOX_ACTION_MEMORY. */
typedef enum JoxActionNumber {
    JOX_ACTION_KICK = JOX_PARAM_COUNT,
    JOX_ACTION_KICK_SPEED,
    JOX_ACTION_LIFT,
    JOX_ACTION_THROW,
    JOX_ACTION_GRIP,
    JOX_ACTION_LASTS,
    JOX_ACTION_TELL,
    JOX_ACTION_MEMORY
} JoxActionNumber;

/* A parameter or number of an action that was computed to an invalid number, such as NaN
   (invalid_values.c). */
typedef struct JoxTold JoxTold;
typedef struct JoxOdd {
    bool found;
    uint16_t machine, state;
    uint32_t agent_id;
    int32_t parameter, line; /* JoxParameter or JoxActionNumber */
    uint32_t source;         /* index of the line's file in the machine's `files` */
    double value;
} JoxOdd;

/* A change of arrived_at. */
typedef struct JoxArrival {
    uint32_t agent, place; /* index of the agent; reference to the place */
} JoxArrival;

typedef double JoxRegisters[JOX_MOST_REGISTERS][JOX_BATCH];

typedef struct JoxMachineScratch {
    uint32_t capacity;
    uint32_t *grouped; /* indices of all agents, sorted by machine and state */
    JoxBatchRange *batches;
    uint32_t batch_count, batch_capacity;
    uint32_t *state_first; /* per state of all machines, and one more: its first index in grouped */
    uint32_t *part_first;  /* the same per state and part, for parts that are sorted in parallel */
    size_t state_capacity, part_capacity;
    uint32_t *in_state; /* per agent: number of its state among the states of all machines */
    int16_t *fired;     /* per agent: transition to take, -1 none */
    uint32_t *reacts; /* per agent: bits of the reactions to carry out; only if machines have any */
    uint32_t *rank;   /* per agent: place in the queue it stands in */
    int32_t *queue;   /* per agent that queues: the queue's place */
    JoxV2 *heading;   /* per agent: velocity it preferred in the step before; NULL: no machine
                         reads it */
    size_t heading_capacity;
    uint32_t *list;  /* agents to handle one by one, sorted by id */
    uint32_t *spare; /* second buffer for sorting `list` */
    uint32_t list_count;
    JoxV2 *row;                  /* per agent in a row or a waiting area: position of its spot, m */
    struct JoxRowEntry *entries; /* agents that stand in rows */
    /* Agents that wait in areas (JOX_STEER_GATHER); empty if there are none. */
    struct JoxGathering *gathered;
    void *gather_blocks;
    uint32_t gather_capacity;
    uint32_t *gather_number;              /* per waiting agent: its number in its part of the
                                             ground */
    struct JoxGatherPlace *gather_places; /* per place, front and part of the ground */
    uint32_t gather_count;
    size_t gather_place_capacity;
    struct JoxGatherGround *gather_grounds; /* per place */
    uint32_t ground_count;
    size_t ground_capacity;
    /* Per agent, for each term `field` of its state that may lead to what is no place (lead.c): the
       direction of the way, (0, 0) if that is straight. Empty if there are none. */
    JoxV2 *leads;
    size_t lead_capacity;
    JoxSignal *heard; /* signals of the last step, sorted by name and x */
    uint32_t heard_count;
    uint32_t *everywhere; /* names announced to everybody in the last step */
    uint32_t everywhere_count;
    size_t heard_capacity, everywhere_capacity;
    JoxArrival *arrivals; /* changes of this step */
    size_t arrival_capacity;
    JoxHands hands;  /* obstacles between an agent and a body it picks up */
    uint64_t *marks; /* a bit per rank of an agent, for sorting a long list by id */
    uint32_t mark_capacity;
    uint32_t *place_people; /* per place: number of people in it; UINT32_MAX: not counted, as no
                               machine reads it */
    uint32_t *place_queue;  /* per place: length of its queue */
    uint32_t place_capacity;
    JoxRegisters *registers; /* one set per worker */
    JoxOdd *odd;             /* per worker: the first one it found */
    uint32_t workers;
} JoxMachineScratch;

/* The point that a target resolves to, m, m/s, with its place, body or agent. */
typedef struct JoxSpot {
    bool found;
    float x, y, z, vx, vy, radius;
    int32_t place, object; /* index of the place or row of the body, or -1 */
    uint32_t agent;        /* JOX_NO_INDEX if none */
} JoxSpot;

static const JoxSpot JOX_NO_SPOT = {.place = -1, .object = -1, .agent = JOX_NO_INDEX};

static inline const JoxMachine *jox_machine_of(const JoxMachineRun *run, uint32_t agent) {
    return run->set->items[run->agents->machine[agent]];
}
/* Returns whether a time since `time - dt` has reached a multiple of an interval, s; never at 0. */
static inline bool jox_is_interval_over(double time, double dt, double every) {
    return time > 0.0 && every > 0.0 &&
           floor(time / every + 1e-9) > floor((time - dt) / every + 1e-9);
}
static inline double jox_time_in_state(const JoxMachineRun *run, uint32_t agent) {
    return (double)(run->tick - run->agents->entered[agent]) * run->dt;
}

/* Returns the time since the tick in a slot of the agent's memory, s. */
static inline double jox_time_since(const JoxMachineRun *run, uint32_t agent, uint32_t slot) {
    const JoxAgents *a = run->agents;
    return (run->tick - a->memory[(size_t)agent * a->memory_stride + slot]) * run->dt;
}

/* Returns the agent's post (where it entered the world): x and y in its memory. Only for machines
   with `home`. */
static inline double *jox_home_position(const JoxMachineRun *run, uint32_t agent) {
    const JoxAgents *a = run->agents;
    return a->memory + (size_t)agent * a->memory_stride + jox_machine_of(run, agent)->home - 1;
}

/* Makes the agent's present position its post. */
void jox_set_home_post(JoxMachineRun *run, uint32_t agent);

/* Notes which agent kicked or threw a body, by their ids. */
void jox_throwers_note(JoxMachineRun *run, uint32_t body, uint32_t agent);
/* target.c: notes where agents see those whom they remember, for machines that ask for it. */
void jox_sightings_note(JoxMachineRun *run);
/* Notes the same for one agent. */
void jox_sightings_note_agent(const JoxMachineRun *run, uint32_t agent);
/* Returns who or what a target is for an agent. What it remembers, holds or was struck by it knows
   out of sight, too, unless the target has a filter. */
double jox_target_who(const JoxMachineRun *run, uint32_t agent, int32_t index);
/* Returns whether there is anybody, a body, a place or a point that a target means. */
bool jox_target_exists(const JoxMachineRun *run, uint32_t agent, int32_t index);
/* Does as jox_target_who, but draws a member of the set that a target `one_of` names. Draws in one
   step with the same `number` are the same. */
double jox_target_draw_who(const JoxMachineRun *run, uint32_t agent, int32_t index,
                           uint32_t number);
/* Draws a member of the set of a target `one_of`; -1 for other targets, and if there is none. */
int32_t jox_target_draw_place(const JoxMachineRun *run, uint32_t agent, const JoxTarget *target,
                              uint32_t number);
/* Returns whom a target means that names somebody and does not choose, whatever its filter, and
   also if that one has left the world. */
double jox_target_named_who(const JoxMachineRun *run, const JoxTarget *target, uint32_t agent);
/* Returns the spot of somebody, seen or not. */
JoxSpot jox_who_spot(const JoxMachineRun *run, uint32_t agent, double who);
/* m: a body that is nearer and faster than 1 m/s hits the agent. */
#define JOX_HIT_GAP 0.1f

/* somebody.c: return the spot of an agent as agent i sees it, across a joined edge if that is
   nearer; of a body, by its row; of a place, its nearest point, for -1 JOX_NO_SPOT. */
JoxSpot jox_spot_agent(const JoxMachineRun *run, uint32_t i, uint32_t other);
JoxSpot jox_spot_body(const JoxObject *o, int32_t row);
JoxSpot jox_spot_place(const JoxMachineRun *run, uint32_t i, int32_t place);
/* Makes a spot the candidate that `other` means in this thread, NULL: none; and returns it. */
void jox_target_consider(const JoxSpot *candidate);
const JoxSpot *jox_target_considered(void);
/* Returns what is measured of a target: of a place or body only its position and speed; 0 if it is
   not there. */
double jox_target_measure(const JoxMachineRun *run, uint32_t agent, int32_t index, JoxNow what);

/* Returns the value of a message by the number of its name, a number or somebody; 0 if it has no
   such value, or one of the other kind. */
double jox_message_value(const JoxMessage *message, uint32_t name, bool somebody);
/* tell.c: tells a message. */
void jox_tell(JoxMachineRun *run, const JoxMachine *machine, const JoxTell *tell, uint32_t agent);
/* Delivers what was told since the last step, and drops what was used. */
void jox_messages_deliver(JoxMachineRun *run);
/* Marks the messages as used on which the condition of an item of an agent's state rests. */
void jox_messages_use(JoxMachineRun *run, const JoxMachine *machine, const JoxTransition *item,
                      uint32_t agent);
/* Drops messages for an agent that neither its new machine nor one that it may become asks for. */
void jox_messages_recheck(JoxMachineRun *run, uint32_t agent);
/* Makes messages that were used in the stage think invisible from now on. */
void jox_messages_settle(JoxMachineRun *run);
/* watched_messages.c: record for watched agents a message that comes, is dropped, or is used by an
   item, NULL: by a function; and the signals that are heard in this step. */
void jox_watch_message(const JoxMachineRun *run, const JoxMessage *message);
void jox_watch_lost_message(const JoxMachineRun *run, const JoxMessage *message);
void jox_watch_used_message(const JoxMachineRun *run, const JoxMessage *message,
                            const JoxMachine *machine, const JoxTransition *item);
void jox_watch_calls(const JoxMachineRun *run);

/* best_of.c: returns the candidate with the greatest score among those that the agent sees and that
   match the target; of equal ones agents before bodies, by ascending id. */
JoxSpot jox_find_best(const JoxMachineRun *run, uint32_t agent, const JoxTarget *target);
/* Returns the member of a set of places with the greatest score; the place itself if it is none. */
int32_t jox_find_best_place(const JoxMachineRun *run, uint32_t agent, const JoxTarget *target,
                            int32_t set);

/* Resolves target `index` of the agent's machine; index -1 is the agent itself. */
JoxSpot jox_target_find(const JoxMachineRun *run, uint32_t agent, int32_t index);
/* Returns the place that a target names for this agent, or -1. */
int32_t jox_target_place(const JoxMachineRun *run, uint32_t agent, int32_t index);
/* Writes the place of a target for each of `count` agents of one machine, -1 where there is
   none. */
void jox_target_places(const JoxMachineRun *run, const JoxMachine *machine, int32_t index,
                       const uint32_t *agents, uint32_t count, int32_t *places);
/* Returns the gap between the agent and a spot, m: of their torsos, or of their discs if less. */
float jox_spot_gap(const JoxMachineRun *run, uint32_t agent, const JoxSpot *spot);
/* Returns whether body `row` is the target or has its tag; false for row -1. */
bool jox_target_means(const JoxMachineRun *run, uint32_t agent, int32_t index, int32_t row);
/* Returns the distance from the agent's centre to a target, m; INFINITY if absent. */
float jox_target_distance(const JoxMachineRun *run, uint32_t agent, int32_t index);
/* Returns what a person or an input log gives the agent; NULL: nothing so far. */
const struct JoxPlayerInput *jox_player_input(const JoxMachineRun *run, uint32_t agent);
/* Return the velocity that it gives, m/s, (0, 0) if none; and its magnitude. */
JoxV2 jox_player_wants(const JoxMachineRun *run, uint32_t agent);
float jox_driven(const JoxMachineRun *run, uint32_t agent);
/* Returns the velocity that an agent preferred in the step before, m/s. If no machine reads it, it
   is not stored, and the present one is returned. */
static inline JoxV2 jox_heading_of(const JoxMachineRun *run, uint32_t agent) {
    const JoxAgents *a = run->agents;
    return run->scratch->heading ? run->scratch->heading[agent]
                                 : (JoxV2){a->pref_x[agent], a->pref_y[agent]};
}
/* Returns the free distance ahead, m (`headway` in machine.h). */
float jox_headway(const JoxMachineRun *run, uint32_t agent);

/* Returns the velocity that one steering term asks for, as a share of the wanted speed: length at
   most 1, except drift and player. Not for evade and the terms that are computed per batch. */
JoxV2 jox_steer_word(const JoxMachineRun *run, uint32_t agent, const JoxSteerTerm *term);
/* Returns the direction of a term wander: it turns gradually, leads away from walls, and back into
   the place `target` if that is given. */
JoxV2 jox_steer_wander(const JoxMachineRun *run, uint32_t agent, int32_t target);
/* steering/formation.c: writes the spots of all agents in rows to scratch->row. */
void jox_rows_form(JoxMachineRun *run);
/* gather_ground.c: returns the term by which agents in a state wait in an area, or NULL. */
const JoxSteerTerm *jox_gather_term(const JoxState *state);
/* steering/gather.c: writes the spots of all agents that wait in areas to scratch->row. */
void jox_gatherings_form(JoxMachineRun *run);
/* gather_ground.c: frees the ground and spots of waiting areas. */
void jox_gatherings_free(JoxMachineScratch *scratch);
/* Discards the spots of waiting areas; the next step computes them anew. */
void jox_gatherings_forget(JoxMachineScratch *scratch);
/* Finds the ways of terms `field` to what is no place, before the batches of prefer. */
void jox_leads_form(JoxMachineRun *run);
/* Returns the direction of an agent's way to such a target; straight where nothing is between. */
JoxV2 jox_steer_lead(const JoxMachineRun *run, const JoxMachine *machine, const JoxSteerTerm *term,
                     uint32_t agent);
/* Returns the velocity towards a point: full `speed`, less near the point. */
JoxV2 jox_steer_arrive(JoxV2 from, JoxV2 to, float speed);
/* Returns a velocity sideways, past the agents that come against `ahead`, the sum of the other
   terms. */
JoxV2 jox_steer_evade(const JoxMachineRun *run, uint32_t agent, JoxV2 ahead);
/* Returns the velocity straight towards a target; it slows down near a point. */
JoxV2 jox_steer_seek(const JoxMachineRun *run, uint32_t agent, int32_t target);

/* Evaluates an expression for `count` agents of one machine; results in registers[0]. */
void jox_eval(const JoxMachineRun *run, const JoxMachine *machine, const JoxExpression *expression,
              const uint32_t *agents, uint32_t count, JoxRegisters registers);
/* Evaluates a score of one agent for `count` candidates, at most JOX_BATCH; results in
   registers[0]. */
void jox_eval_scores(const JoxMachineRun *run, uint32_t agent, const JoxExpression *score,
                     const JoxSpot *candidates, uint32_t count, JoxRegisters registers);
/* Returns whether all values of a condition are 0. */
bool jox_holds_for_nobody(const double *values, uint32_t count);
/* Returns a value for one agent: a constant, an own value, or an expression. */
double jox_value(const JoxMachineRun *run, const JoxMachine *machine, const JoxValue *value,
                 uint32_t agent);

/* Checks of invariants, called through JOX_CHECK (machine_checks.c), in this order: a machine on
   entering a set; the batches; ranks in queues, of a list sorted by turn; a list sorted by id;
   signals heard; states and rows of agents; results of act; transitions taken; preferred
   velocities; parameters set by people; counts carried over to a new version. */
void jox_machine_check(const JoxMachine *machine);
void jox_groups_check(const JoxMachineRun *run);
void jox_queues_check(const JoxMachineRun *run, const uint32_t *list, uint32_t count);
void jox_by_id_check(const JoxAgents *agents, const uint32_t *list, uint32_t count);
void jox_heard_check(const JoxMachineRun *run);
/* Return the first broken condition, as text, of signals, agents' states or set parameters; NULL if
   all hold. */
const char *jox_signals_fault(const JoxMachineRun *run);
const char *jox_states_fault(const JoxMachineRun *run);
const char *jox_edits_fault(const JoxMachineRun *run);
void jox_states_check(const JoxMachineRun *run);
void jox_acts_check(const JoxMachineRun *run);
void jox_taken_check(const JoxMachineRun *run);
void jox_preferred_check(const JoxMachineRun *run);
void jox_edits_check(const JoxMachineRun *run);
void jox_counts_carried_check(const JoxMachineCounts *was, const JoxMachineCounts *is);

/* Returns the scratch, which is made on first use. */
JoxMachineScratch *jox_machines_scratch(JoxMachineRun *run);
/* Makes the signals of the last step audible; counts who gave them. */
void jox_machines_listen(JoxMachineRun *run);
/* Makes them audible for a look between two steps, and leaves them to the next step. */
void jox_signals_peek(JoxMachineRun *run);
/* Returns whether another agent within `reach` metres gave the signal. */
bool jox_heard(const JoxMachineRun *run, uint32_t agent, uint32_t name, double reach);
/* sight.c: returns whether a closed wall hides one point from another. People can look over low
   walls, which hide only if `touched`. */
bool jox_is_hidden(const JoxMachineRun *run, JoxV2 from, JoxV2 to, bool touched);
/* An edge that hid a point; zero-initialised: none. */
typedef struct JoxHidingEdge {
    const JoxWalls *walls;
    uint32_t edge;
} JoxHidingEdge;
/* Returns the same of touched walls, for points one beside the other: tests the edge that hid the
   last one first. */
bool jox_is_reach_hidden(const JoxMachineRun *run, JoxV2 from, JoxV2 to, JoxHidingEdge *last);
/* Returns whether a body hides one point from another: a body that reaches above 1.3 m, is at least
   half a metre wide, contains neither point, and is not row `but`. */
bool jox_is_behind_body(const JoxMachineRun *run, JoxV2 from, JoxV2 to, int32_t but);
/* Returns whether a wall of another ring than `but` hides one point from another. */
bool jox_is_hidden_by(const JoxMachineRun *run, uint32_t but, JoxV2 from, JoxV2 to, bool touched);
/* Finds the first closed wall between two points: true with its unit normal. */
bool jox_meets_wall(const JoxMachineRun *run, JoxV2 from, JoxV2 to, JoxV2 *normal);
/* Returns whether something at `offset` from agent i, m, moving at `velocity`, m/s, passes the
   filter's conditions on distance and direction. */
bool jox_passes_view(const JoxMachineRun *run, const JoxAgentFilter *filter, uint32_t i,
                     JoxV2 offset, JoxV2 velocity);
/* Returns whether agent j passes the filter of a target of i's machine. */
bool jox_passes_filter(const JoxMachineRun *run, const JoxAgentFilter *filter, uint32_t i,
                       uint32_t j);
/* Writes the agents that agent i sees and that match a target, nearest first; returns how many. */
uint32_t jox_list_wanted(const JoxMachineRun *run, const JoxTarget *target, uint32_t i,
                         uint32_t found[JOX_SMALL_CROWD]);
/* Returns whether a body matches a target that chooses by tag, seen or not. */
bool jox_is_wanted_body(const JoxMachineRun *run, const JoxTarget *target, uint32_t i,
                        const JoxObject *object);
/* Returns whether agent j, which agent i sees, matches a target of i's machine. */
bool jox_is_wanted(const JoxMachineRun *run, const JoxTarget *target, uint32_t i, uint32_t j);
/* Returns whether agent j is of the kind that a target asks for, seen or not. */
bool jox_is_of_kind(const JoxAgents *agents, const JoxTarget *target, uint32_t i, uint32_t j);
/* Returns the number of neighbours that match a target. */
uint32_t jox_neighbours_of(const JoxMachineRun *run, uint32_t agent, int32_t target);
/* Returns an agent's public memory of the name with this number; NAN if it has none. */
double jox_public_memory(const JoxMachineRun *run, uint32_t agent, uint32_t name);
/* Returns the public memory `name` of the agent that is the target; 0 if there is none. */
double jox_target_memory(const JoxMachineRun *run, uint32_t agent, int32_t target, uint32_t name);
/* Returns whether the agent sees a closed gate at the place: within perception and with no other
   wall before it. */
bool jox_sees_shut(const JoxMachineRun *run, uint32_t agent, int32_t place);
/* Returns whether the agent carries a body, or holds on to an agent, that matches the target. */
bool jox_holds_target(const JoxMachineRun *run, uint32_t agent, int32_t target);
/* Returns the row of the body that the agent holds and that matches the target, or -1. */
int32_t jox_held_body_row(const JoxMachineRun *run, uint32_t agent, int32_t target);
/* Carries out actions of an entry or a transition: sets memory, team and tags, gives the signal. */
void jox_actions_do(JoxMachineRun *run, const JoxMachine *machine, const JoxActions *actions,
                    uint32_t agent);
/* Repeats the signals of states that give one every so many seconds. */
void jox_machines_repeat_signals(JoxMachineRun *run);

/* dormant.c: returns the name that part `name` of the new version had in the old one; `name` itself
   if it was not renamed. */
const char *jox_name_before(const JoxMachine *old, const JoxMachine *next, JoxPart part,
                            const char *name);
/* Returns the old memory slot of the same kind that continues as next->memory[slot], or -1. */
int32_t jox_memory_before(const JoxMachine *old, const JoxMachine *next, uint32_t slot);
/* Adds dormant slots to the new version for memory of the old one that it lacks. */
void jox_dormant_keep(const JoxMachine *old, JoxMachine *next);
/* Appends messages on memory that is kept, taken up again or dropped; `people` names the agents. */
void jox_dormant_tell(const JoxMachine *old, const JoxMachine *next, const char *people,
                      JoxText *out);

/* Sorts indices of agents by id. */
void jox_sort_by_id(JoxMachineRun *run, uint32_t *list, uint32_t count);
/* Grows the scratch, groups agents by state into batches, and ranks the queues. */
void jox_machines_group(JoxMachineRun *run, JoxPool *pool);
/* The same without the queues, whose ranks are forgotten: it changes no state. */
void jox_machines_group_again(JoxMachineRun *run, JoxPool *pool);
/* Ranks agents in queues by turn; those without one get the next rank. In each step one
   agent at most takes its place in a queue: the nearest. */
void jox_queues_rank(JoxMachineRun *run);
/* Ranks them for a look between two steps; gives no places, and changes no state. */
void jox_queues_look(JoxMachineRun *run);
/* Returns the target whose queue agents of this state stand in, or -1. */
int16_t jox_queue_target(const JoxState *state);
void jox_machines_count_places(JoxMachineRun *run);
/* Notes which agents have arrived at places, for machines that ask for it (`arrived`). */
void jox_arrivals_note(JoxMachineRun *run);
void jox_machines_scratch_free(JoxMachineRun *run);
/* Evaluates the duration of a state for an agent, s; INFINITY if the expression yields NaN, which
   is reported. */
float jox_duration_of(JoxMachineRun *run, const JoxMachine *machine, const JoxState *state,
                      uint32_t agent);
/* Puts an agent into a state, and the outer states around it: clock, duration, goal, constant
   parameters. The caller runs hooks. */
void jox_machines_enter(JoxMachineRun *run, uint32_t agent, uint16_t state);
/* The same by a transition on `level`, which leaves the outer states on lower levels as they are.
 */
void jox_machines_enter_level(JoxMachineRun *run, uint32_t agent, uint16_t state, uint32_t level);
/* Evaluates the duration of the agent's state on a level that an expression gives. */
void jox_machines_draw_lasts(JoxMachineRun *run, uint32_t agent, uint32_t level);
/* Returns the time since the agent entered its state, or the outer state on a level, s. */
static inline double jox_time_on_level(const JoxMachineRun *run, const JoxMachine *machine,
                                       uint32_t agent, uint32_t level) {
    return level < machine->states[run->agents->state[agent]].depth
               ? jox_time_since(run, agent, machine->clock[level] - 1)
               : jox_time_in_state(run, agent);
}
/* Calls a function of the agent's machine, if there is one. */
void jox_call_hook(JoxMachineRun *run, int32_t hook, JoxHookKind kind, uint32_t agent);
/* Calls the exit functions of the agent's state and the outer states down to a level. */
void jox_exit_states(JoxMachineRun *run, uint32_t agent, uint32_t level);
/* Carries out the entries of the agent's state and the outer states from a level on, outermost
   first: durations, actions and functions. */
void jox_complete_entry(JoxMachineRun *run, uint32_t agent, uint32_t level);
/* Returns the state to which a transition leads the agent. */
uint16_t jox_destination(const JoxMachineRun *run, const JoxTransition *t, uint32_t agent);
/* Notes the state that the agent leaves by a transition, for transitions that lead back. */
void jox_note_left_state(JoxMachineRun *run, const JoxTransition *t, uint32_t agent, uint16_t to);
/* Writes the parameters of the agent's state that are constants or own values. */
void jox_machines_write_parameters(JoxMachineRun *run, uint32_t agent);
/* Returns the parameter as the state sets it, else as the machine does; UNSET if neither does. */
const JoxValue *jox_state_parameter(const JoxMachine *machine, const JoxState *state,
                                    int parameter);
/* Zeroes the agent's own values and memory beyond those of the machine, since values that an older
   machine left there would be hashed as state. */
void jox_clear_unused_slots(JoxAgents *agents, uint32_t agent, const JoxMachine *machine);
/* Assigns the numbers of a machine's names, unique in the set, and of its transitions, unique in
   the machine. */
void jox_machine_number_names(JoxMachineRun *run, JoxMachine *machine);
/* Stores a machine at an index of the set: numbers its names and transitions, widens the agents'
   rows, starts its counts. From here on it does not change. */
void jox_machines_put(JoxMachineRun *run, uint32_t index, JoxMachine *machine);
/* Allocates zeroed counts for a machine's states and transitions. */
void jox_counts_begin(JoxMachineCounts *counts, const JoxMachine *machine, uint32_t tick);
/* Adds this step's batches to the time spent in each state. */
void jox_counts_spend(JoxMachineRun *run);
/* Adds to the count between two states, by name, of transitions that no longer exist. */
void jox_counts_add_before(JoxMachineCounts *counts, const char *from, const char *to,
                           uint64_t taken);
void jox_counts_free(JoxMachineCounts *counts);
/* invalid_values.c: odd parameters are numbers that are invalid for their parameter. jox_is_odd
   tests one; jox_odd_look finds the first odd number that a batch computed and that was not
   reported yet, and stores it in `first` if it comes before that; jox_odd_first returns the first
   of all workers; jox_odd_tell reports it. */
bool jox_is_odd(int parameter, JoxValueKind kind, double value);
void jox_odd_look(const JoxMachineRun *run, const uint32_t *agents, uint32_t count, int parameter,
                  const double *values, JoxOdd *first);
const JoxOdd *jox_odd_first(const JoxOdd *odd, uint32_t count);
void jox_odd_tell(JoxMachineRun *run, const JoxOdd *odd);
/* Reports an odd parameter, or number of an action, of one agent; `from` is what it was computed
   from. */
void jox_odd_note(JoxMachineRun *run, uint32_t agent, int parameter, const JoxValue *from,
                  double value);
/* Evaluates a number of an action, and reports one that is not finite. Returns it within the bounds
   of its kind; for NaN the value that means no action. */
double jox_action_number(JoxMachineRun *run, const JoxMachine *machine, JoxActionNumber number,
                         const JoxValue *value, uint32_t agent);
/* Applies the parameters that people set to a copy of the machine; without any, runs the machine as
   it was built. */
void jox_edits_apply(JoxMachineRun *run, uint32_t machine);
/* Forgets the parameters that people set for a machine, and frees the copy. */
void jox_edits_end(JoxMachineRun *run, uint32_t machine);
/* watched_agents.c: explain transitions that are due, before reactions change values; record a
   transition that is taken, and the values that actions wrote, of watched agents. */
void jox_watch_due(const JoxMachineRun *run, const JoxTaken *due);
void jox_watch_taken(const JoxMachineRun *run, const JoxTaken *taken);
/* trace.c: appends the terms that changed of the conditions that the traced agent waits for, unless
   it takes a transition in this step. */
void jox_trace_waiting(JoxMachineRun *run);
/* Explain the transition that is due for the traced agent, before reactions change values; and
   append it when it is taken. */
void jox_trace_due(JoxMachineRun *run, const JoxTaken *due);
void jox_trace_transition(JoxMachineRun *run);
/* Appends a reaction of the traced agent, in full if it is its first time in this stay. */
void jox_trace_reaction(JoxMachineRun *run, const JoxTaken *taken);
void jox_trace_free(JoxMachineRun *run);
/* Appends what an item that the trace shows has done; `first_sent`: its first message in `sent`. */
void jox_trace_actions(JoxMachineRun *run, const JoxMachine *machine, const JoxActions *actions,
                       uint32_t agent, uint32_t first_sent);
/* Records the number that was drawn for the chance of a transition of agent i. */
void jox_watch_roll(const JoxMachineRun *run, uint32_t i, uint32_t transition, double drawn);
void jox_watch_actions(JoxMachineRun *run, const JoxMachine *machine, const JoxActions *actions,
                       uint32_t agent);
/* grasp.c: updates holds between agents for those given, by ascending id: starts, pulls, lets
   go. */
void jox_machines_grasp(JoxMachineRun *run, const uint32_t *agents, uint32_t count);
/* Runs after the transitions: computes parameters, pushing and approach, then kicks, throws, picks
   up and holds. */
void jox_machines_act(JoxMachineRun *run, JoxPool *pool);

/* machine_checks.c: returns how many of the registers a, b, c an operation reads. */
uint32_t jox_op_inputs(JoxOp op);

#endif
