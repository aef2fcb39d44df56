/* Running machines: the stages think and prefer over all agents of a world. */
#ifndef JOX_MACHINE_RUN_H
#define JOX_MACHINE_RUN_H

#include "agents/agents.h"
#include "agents/neighbours.h"
#include "base/text.h"
#include "geom/field/field.h"
#include "geom/objects.h"
#include "geom/place.h"
#include "jostle.h"
#include "machine/machine.h"
#include "task/pool.h"

typedef enum JoxHookKind {
    JOX_HOOK_ENTER,
    JOX_HOOK_EXIT,
    JOX_HOOK_TAKE,
    JOX_HOOK_WHEN,
    JOX_HOOK_STEER,
    JOX_HOOK_KINDS
} JoxHookKind;

/* Runs one Lua function for one agent, on the stepping thread, agents in ascending id. WHEN
   returns 0/1 in result[0], STEER a velocity in result[0..1]. Returns false if it failed (WHEN
   then counts as false, STEER as standing still). NULL where there is no Lua. */
typedef bool JoxHookCall(void *context, const JoxMachine *machine, int32_t hook, JoxHookKind kind,
                         uint32_t agent, double result[2]);
/* Before the first hook of a step, for machines whose hooks look at other agents, and after the
   last, when what they wrote to others is carried out. May be NULL. */
typedef void JoxHookBracket(void *context, bool begins);

/* Lists what the hooks of a machine carry from step to step themselves. May be NULL. */
typedef void JoxHookSections(void *context, const JoxMachine *machine, JoxSections *sections);

/* One transition taken; kept for the step, in ascending agent id. */
typedef struct JoxTaken {
    uint32_t agent_id;
    uint16_t machine, from, to, transition;
} JoxTaken;

enum { JOX_MOST_MACHINES = 64, JOX_MOST_GIVEN = 256 };

/* What an agent called out, for others to hear in the next step. */
typedef struct JoxSignal {
    uint32_t name; /* number of the name */
    uint32_t agent_id;
    float x, y; /* m */
} JoxSignal;

/* A body that an agent picks up or throws. */
typedef struct JoxGrip {
    uint32_t object, agent_id;
    bool takes;     /* else it lets go with the velocity */
    JoxV3 velocity; /* m/s */
} JoxGrip;

/* Kinds of ways round walls and large bodies. */
typedef enum JoxRouteKind {
    JOX_ROUTE_NOW,   /* as all stands now */
    JOX_ROUTE_OPEN,  /* as if walls that open were open, and what can be moved were away: for those
                      who have no other way, and wait at a gate */
    JOX_ROUTE_CROWD, /* as all stands now, slower where people bound for the place are held up: for
                        those who walk by the law */
    JOX_ROUTE_KINDS
} JoxRouteKind;

/* Who wrote a value of a watched agent last. */
typedef enum JoxWriter {
    JOX_WROTE_TRANSITION, /* its `set`, */
    JOX_WROTE_STATE,      /* or that of a state, on entering */
    JOX_WROTE_FUNCTION,   /* a plain function */
    JOX_WROTE_PROGRAM     /* between two steps: a program, an input log */
} JoxWriter;
typedef struct JoxWrote {
    bool is_memory;
    uint16_t machine, index; /* slot of its memory, or parameter */
    JoxWriter by;
    uint16_t state, transition; /* of the first two: of a transition that it leaves */
    uint32_t tick;
    char file[128]; /* of a function */
    int line;
} JoxWrote;

/* An agent whose last transition is kept, with the reason for it, and who wrote its values. */
typedef struct JoxWatched {
    JoxWrote *wrote; /* one for each value that was written since it is watched */
    uint32_t wrote_count;
    size_t wrote_capacity;
    uint32_t agent_id;
    bool took; /* one since it is watched: then the rest says which */
    uint32_t tick;
    char from[64], to[64];
    JoxText why; /* as jox_machines_explain says it */
} JoxWatched;

/* A parameter that a person set while the world ran. */
typedef struct JoxParameterEdit {
    uint32_t machine;
    int32_t state; /* -1: of the machine's defaults */
    int32_t parameter;
    uint32_t unused; /* 0: cells of sections have no padding */
    double value;
} JoxParameterEdit;

/* What agents of this version of a machine were in a state for. */
typedef struct JoxStateCounts {
    uint64_t spent; /* agent-steps */
    uint64_t steps; /* in which anybody was in it */
    double sight;   /* m: the greatest perception of those who were, looked at in every 16th step */
} JoxStateCounts;

/* How often the transitions of a machine were taken since the start, by all agents. */
typedef struct JoxMachineCounts {
    JoxStateCounts *states;
    uint32_t state_count, since; /* since: the tick at which this version began */
    size_t state_capacity;
    uint64_t *taken; /* by number: state->first_transition + place in the state */
    uint32_t taken_count;
    size_t taken_capacity;
    /* From one state to another, by names, by transitions of versions that were replaced. */
    struct JoxTakenBefore {
        char *from, *to;
        uint64_t taken;
    } * before;
    uint32_t before_count;
    size_t before_capacity;
} JoxMachineCounts;

/* Model: the machines of a world. Machines are added, and replaced by a reload; what people set
   while a world runs (JoxMachineState.edits) is applied to a copy, so that a machine never changes
   once it is built. Owned. Zero-initialised is empty. */
typedef struct JoxMachineSet {
    const JoxMachine
        *items[JOX_MOST_MACHINES];         /* as they run: built, or edited where there is one */
    JoxMachine *built[JOX_MOST_MACHINES];  /* as the file says */
    JoxMachine *edited[JOX_MOST_MACHINES]; /* copies with the parameters that were set; NULL */
    uint32_t count;
    char **names; /* number -> name, shared by all machines; only grows */
    uint32_t name_count;
    size_t name_capacity;
    uint32_t *name_table; /* by hash, in a table with gaps: a name's number and one, or 0 */
    size_t name_room;     /* a power of two */
} JoxMachineSet;

/* State: what a step leaves to the next, besides the agents' columns. Zero-initialise. */
typedef struct JoxMachineState {
    JoxSignal *called; /* since the last think, in the order of calling */
    uint32_t called_count;
    size_t called_capacity;
    uint32_t *announced; /* names called out to everybody since the last think */
    uint32_t announced_count;
    size_t announced_capacity;
    uint32_t *pending; /* ids of agents whose entry hook has yet to run, in the order of spawning */
    uint32_t pending_count;
    size_t pending_capacity;
    JoxParameterEdit *edits; /* in the order of setting, one for each parameter */
    uint32_t edit_count;
    size_t edit_capacity;
    JoxMachineCounts counts[JOX_MOST_MACHINES]; /* figures: no step reads them */
    uint64_t hook_failures; /* figure: calls of hooks that failed since the start */
    uint64_t changes_lost;  /* figure: changes of others' memory that another change overwrote */
} JoxMachineState;

/* The machines at work: what they are, what they read and write, and what the step did. */
typedef struct JoxMachineRun {
    JoxMachineSet *set;
    JoxMachineState *state;
    JoxAgents *agents;
    JoIsa isa; /* of the kernels */
    /* Given by the world before each stage. */
    const JoxNeighbours *neighbours;
    const JoxObjects *objects;
    const JoxPlace *places;
    uint32_t place_count;
    const JoxWalls *walls;       /* all, gates that are open too; NULL: none */
    const JoxWalls *wall_images; /* of standing walls, beyond joined edges; NULL: none */
    uint32_t walls_version;      /* counts their changes */
    uint64_t seed;
    uint32_t tick;      /* number of this step, or of the last one, from 0 */
    double dt, gravity; /* s; m/s2, for throws */
    JoxHookCall *call;
    JoxHookBracket *bracket;
    JoxHookSections *hook_sections;
    void *call_context;
    /* Velocity that the player (or the input log) wants for the agent with this id; (0,0) default.
     */
    const struct JoxPlayerInput {
        uint32_t agent_id;
        float vx, vy;
    } * inputs;
    uint32_t input_count;
    /* Ways, [place * JOX_ROUTE_KINDS + kind]; NULL where there is none yet. What is asked for is
       marked in `wanted`, by place, a bit for each kind, for the world to make or renew. */
    JoxField *const *fields;
    uint8_t *wanted;

    /* Results of the step. */
    JoxTaken *taken;
    uint32_t taken_count;
    size_t taken_capacity;
    JoxImpulse *kicks; /* impulses on bodies, by agent id */
    uint32_t kick_count;
    size_t kick_capacity;
    JoxGrip *grips; /* by agent id */
    uint32_t grip_count;
    size_t grip_capacity;
    uint32_t without_spot; /* agents that gather in a place that has no room for them */
    /* What states say of pushing, per agent index, for the force stage; until the next think. */
    uint8_t *push_on, *push_nearest;
    float *push_toward_x, *push_toward_y; /* unit direction; (0, 0): the preferred velocity's */

    /* Explanations for those who look on; no step reads them. */
    uint32_t edits_made; /* parameters that were set so far */
    bool traces;         /* transitions of the agent with this id are explained in `trace` */
    uint32_t trace_id;
    JoxText trace;
    JoxWatched *watched; /* given by the world */
    uint32_t watched_count;

    /* Parameters that came out as no value for them, a line each; whoever reads them empties them.
       Each place in a machine is told of once. */
    JoxText notes;
    struct JoxTold {
        uint32_t machine, reloads, source;
        int32_t line, parameter;
    } * told;
    uint32_t told_count, told_capacity;

    bool spawning;                     /* within jox_machines_spawn: nothing can be sensed */
    struct JoxMachineScratch *scratch; /* made on first use */
} JoxMachineRun;

/* Takes the machine over and returns its index. Widens the agents' rows as needed. */
uint32_t jox_machines_add(JoxMachineRun *run, JoxMachine *machine);
/* Makes the agent at index `agent` a fresh instance of `machine`: draws its own values (overrides:
   per own slot, NULL or an array of pointers, of which the first JOX_MOST_GIVEN count, NULL where
   the machine's own distribution stands), memory (likewise), enters the start state (its parameters
   are written; on_enter is queued and runs in the next think). */
/* m: radius that jox_machines_spawn gives the agent that gets this id. */
float jox_machines_birth_radius(const JoxMachineRun *run, uint32_t id, uint32_t machine,
                                const JoxDist *const *own);
void jox_machines_spawn(JoxMachineRun *run, uint32_t agent, uint32_t machine,
                        const JoxDist *const *own, const JoxDist *const *memory);
/* Evaluates counters, transitions, parameters, kicks. Agents with `removes` states get `removed`.
 */
void jox_machines_think(JoxMachineRun *run, JoxPool *pool);
/* Writes pref_x, pref_y and face_x, face_y of every agent. */
void jox_machines_prefer(JoxMachineRun *run, JoxPool *pool);
/* What it takes to put `next` in the place of `old`, worked out beforehand, on any thread: which
   state, own value, memory and condition goes on as which, which parameters differ, and what is
   drawn anew for all agents with ids below `next_id`. Own values whose distribution has changed are
   drawn afresh from the agent's same random numbers, but for those that the scene or a function
   gave. Both machines must outlive it. */
typedef struct JoxReplacement JoxReplacement;
JoxReplacement *jox_replacement_prepare(const JoxMachine *old, JoxMachine *next, uint64_t seed,
                                        uint32_t next_id);
void jox_replacement_free(JoxReplacement *replacement);
/* Tells, a line each, what memory of so many people the swap keeps, takes up again or drops. */
void jox_replacement_tell(const JoxReplacement *replacement, const char *people, JoxText *out);
/* Adds a dormant slot of memory behind the others, to a machine that does not run yet. */
void jox_dormant_add(JoxMachine *machine, const char *identity, JoxMemoryKind kind, double initial);
/* Whether it may be done now: NULL, or why not ("312 agents are in 'Greet', which this version
   lacks"), written into `why`. */
const char *jox_machines_refuses(const JoxMachineRun *run, uint32_t index,
                                 const JoxReplacement *replacement, char *why, uint32_t size);
/* Swaps machine `index` for the next (taken over; the old one is returned, caller frees). Agents
   keep state (by name or `renamed`), time, memory and own values; enter and exit hooks do not run.
 */
JoxMachine *jox_machines_replace(JoxMachineRun *run, uint32_t index,
                                 const JoxReplacement *replacement);
/* Agents per state of machine `index`, written to people (as many as it has states). */
void jox_machines_people(const JoxMachineRun *run, uint32_t index, uint32_t *people);
/* How often agents of machine `index` went from state to state so far: visits each pair once, by
   the names of the states, those of this version first. */
typedef void JoxTakenVisit(void *context, const char *from, const char *to, uint64_t taken);
void jox_machines_taken(const JoxMachineRun *run, uint32_t index, JoxTakenVisit *visit,
                        void *context);
/* Makes the agent go on with another machine, from its start state: it keeps its body, what the
   scene gave it and its memory, by name; the rest is drawn anew. */
void jox_machines_become(JoxMachineRun *run, uint32_t agent, uint32_t machine);
/* Puts the agent into a state, between two steps: as jox_machines_spawn does, it has no neighbours
   to look at yet. */
void jox_machines_set_state(JoxMachineRun *run, uint32_t agent, uint16_t state);
/* Gives the agent an own value, as the scene's group might have done. */
void jox_machines_set_own(JoxMachineRun *run, uint32_t agent, uint32_t slot, double value);
/* Sets a parameter of one state (-1: of the defaults) to a number within its range, for all who are
   in it and who will be, until the machine is replaced. In the defaults the own value of that name
   follows, but for those to whom the scene gave theirs. */
void jox_machines_set_parameter(JoxMachineRun *run, uint32_t machine, int32_t state, int parameter,
                                double value);
/* Number of a name that machines share; new names are added. */
uint32_t jox_machines_name(JoxMachineRun *run, const char *name);
/* The agent calls out a name (by number). */
void jox_machines_call(JoxMachineRun *run, uint32_t agent, uint32_t name);
/* In a crowd of so many at most, agents see all others within perception, not their neighbours
   alone: a game's opponents, not a pilgrimage. */
enum { JOX_SMALL_CROWD = 64 };
/* Agents that an agent sees, no wall between them, nearest first; of equal distance, the lesser id.
   Returns how many. */
uint32_t jox_machines_seen(const JoxMachineRun *run, uint32_t agent,
                           uint32_t seen[JOX_SMALL_CROWD]);
/* Everybody hears the name (by number) in the next think, wherever they are. */
void jox_machines_announce(JoxMachineRun *run, uint32_t name);
/* The place that an agent goes to by a field in the state it is in and that it has not reached; -1:
   none. *shut, unless NULL: no way leads there as all stands now, as far as that is known. */
int32_t jox_machines_field_goal(const JoxMachineRun *run, uint32_t i, bool *shut);
/* The place that somebody goes to by a field in the state they are in and to which no way leads,
   not through walls that open either; -1: none. That a way leads through these is known half a
   second after it was asked for. */
int32_t jox_machines_no_way(const JoxMachineRun *run, uint32_t i);
/* Places that an agent goes to by a field in any state of its machine: those that the machine
   names, and the agent's own. Writes at most `most` of them, a place again where several states go
   there, and returns how many. */
uint32_t jox_machines_goals(const JoxMachineRun *run, uint32_t i, int32_t *places, uint32_t most);
/* Marks in `wanted` the ways that agents want in the states that they are in. */
void jox_machines_ask_routes(JoxMachineRun *run);
/* Notes who wrote a value of agent i, if it is watched. */
void jox_machines_wrote(JoxMachineRun *run, uint32_t i, const JoxWrote *wrote);
/* Frees what is kept of one who is no longer watched. */
void jox_watched_end(JoxWatched *watched);
/* Appends who went where by which transition, with the values of its condition at present. */
void jox_machines_explain(const JoxMachineRun *run, const JoxTaken *taken, JoxText *out);
/* Lists the state of the machines. After jox_agents_sections, whose machines and states it checks
   when it restores. */
void jox_machines_sections(JoxMachineRun *run, JoxSections *sections);
/* Overwrites what a step may forget: no later step may notice. */
void jox_machines_forget(JoxMachineRun *run);
/* Frees the set and the state too. */
void jox_machines_free(JoxMachineRun *run);

#endif
