/* Running machines: the stages think and prefer over all agents of a world. */
#ifndef JOX_MACHINE_MIND_H
#define JOX_MACHINE_MIND_H

#include "agents/agents.h"
#include "agents/neighbours.h"
#include "base/text.h"
#include "geom/field.h"
#include "geom/objects.h"
#include "geom/place.h"
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

/* One transition taken; kept for the step, in ascending agent id. */
typedef struct JoxTaken {
    uint32_t agent_id;
    uint16_t machine, from, to, transition;
} JoxTaken;

enum { JOX_MOST_MACHINES = 64 };

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
typedef enum JoxWayKind {
    JOX_WAY_NOW,  /* as all stands now */
    JOX_WAY_OPEN, /* as if walls that open were open, and what can be moved were away: for those who
                     have no other way, and wait at a gate */
    JOX_WAY_KINDS
} JoxWayKind;

/* An agent whose last transition is kept, with the reason for it. */
typedef struct JoxWatched {
    uint32_t agent_id;
    bool took; /* one since it is watched: then the rest says which */
    uint32_t tick;
    char from[64], to[64];
    JoxText why; /* as jox_mind_explain says it */
} JoxWatched;

typedef struct JoxMind {
    /* Given by the world before each stage. */
    JoxAgents *agents;
    const JoxNeighbours *neighbours;
    const JoxObjects *objects;
    const JoxPlace *places;
    uint32_t place_count;
    uint64_t seed;
    uint32_t tick; /* this step's number, from 0 */
    double dt;
    JoxHookCall *call;
    JoxHookBracket *bracket;
    void *call_context;
    /* Velocity that the player (or the input log) wants for the agent with this id; (0,0) default.
     */
    struct JoxPlayerInput {
        uint32_t agent_id;
        float vx, vy;
    } * inputs;
    uint32_t input_count;

    /* Machines in use; owned. A reload replaces an entry (see jox_mind_replace). */
    JoxMachine **machines;
    uint32_t machine_count, machine_capacity;

    /* Results of the step. */
    JoxTaken *taken;
    uint32_t taken_count, taken_capacity;
    JoxImpulse *kicks; /* impulses on bodies, by agent id */
    uint32_t kick_count, kick_capacity;
    JoxGrip *grips; /* by agent id */
    uint32_t grip_count, grip_capacity;
    JoxSignal *called; /* in this step, in the order of calling; state that is carried on */
    uint32_t called_count, called_capacity;
    JoxSignal *heard; /* called in the last step, by name and x */
    uint32_t heard_count, heard_capacity;
    /* Names called out to everybody: since the last think (carried on), and before it. */
    uint32_t *announced, *everywhere;
    uint32_t announced_count, announced_capacity, everywhere_count, everywhere_capacity;
    char **names; /* number -> name, shared by all machines */
    uint32_t name_count, name_capacity;

    /* Ways, [place * JOX_WAY_KINDS + kind]; NULL where there is none yet. What is asked for is
       marked in `wanted`, by place, a bit for each kind, for the world to make or renew. */
    JoxField *const *fields;
    uint8_t *wanted;
    double gravity; /* m/s2, for throws */

    bool spawning; /* within jox_mind_spawn: nothing can be sensed */
    /* Transitions of the agent with this id are explained in `trace` as they are taken. */
    bool traces;
    uint32_t trace_id;
    JoxText trace;

    JoxWatched *watched; /* given by the world */
    uint32_t watched_count;

    /* What states say of pushing, per agent index, for the force stage; valid until the next think.
     */
    uint8_t *push_on, *push_nearest;
    float *push_toward_x, *push_toward_y; /* unit direction; (0, 0): the preferred velocity's */

    struct JoxMindScratch *scratch; /* made on first use */
} JoxMind;

/* Takes the machine over and returns its index. Widens the agents' rows as needed. */
uint32_t jox_mind_add(JoxMind *mind, JoxMachine *machine);
/* Makes the agent at index `agent` a fresh instance of `machine`: draws its own values (overrides:
   per own slot, NULL or an array of own_count pointers, NULL where the machine's own distribution
   stands), memory (likewise), enters the start state (its parameters are written; on_enter is
   queued and runs in the next think). */
void jox_mind_spawn(JoxMind *mind, uint32_t agent, uint32_t machine, const JoxDist *const *own,
                    const JoxDist *const *memory);
/* Evaluates counters, transitions, parameters, kicks. Agents with `removes` states get `removed`.
 */
void jox_mind_think(JoxMind *mind, JoxPool *pool);
/* Writes pref_x, pref_y and face_x, face_y of every agent. */
void jox_mind_prefer(JoxMind *mind, JoxPool *pool);
/* What it takes to put `next` in the place of `old`, worked out beforehand, on any thread: which
   state, own value, memory and condition goes on as which, which parameters differ, and what is
   drawn anew for all agents with ids below `next_id`. Own values whose distribution has changed are
   drawn afresh from the agent's same random numbers, but for those that the scene or a function
   gave. Both machines must outlive it. */
typedef struct JoxReplacement JoxReplacement;
JoxReplacement *jox_replacement_prepare(const JoxMachine *old, JoxMachine *next, uint64_t seed,
                                        uint32_t next_id);
void jox_replacement_free(JoxReplacement *replacement);
/* Whether it may be done now: NULL, or why not ("312 agents are in 'Greet', which this version
   lacks"), written into `why`. */
const char *jox_mind_refuses(const JoxMind *mind, uint32_t index, const JoxReplacement *replacement,
                             char *why, uint32_t size);
/* Swaps machine `index` for the next (taken over; the old one is returned, caller frees). Agents
   keep state (by name or `renamed`), time, memory and own values; enter and exit hooks do not run.
 */
JoxMachine *jox_mind_replace(JoxMind *mind, uint32_t index, const JoxReplacement *replacement);
/* Agents per state of machine `index`, written to people (as many as it has states). */
void jox_mind_census(const JoxMind *mind, uint32_t index, uint32_t *people);
/* How often agents of machine `index` went from state to state so far: visits each pair once, by
   the names of the states, those of this version first. */
typedef void JoxTakenVisit(void *context, const char *from, const char *to, uint64_t taken);
void jox_mind_taken(const JoxMind *mind, uint32_t index, JoxTakenVisit *visit, void *context);
/* Makes the agent go on with another machine, from its start state: it keeps its body, what the
   scene gave it and its memory, by name; the rest is drawn anew. */
void jox_mind_become(JoxMind *mind, uint32_t agent, uint32_t machine);
/* Gives the agent an own value, as the scene's group might have done. */
void jox_mind_set_own(JoxMind *mind, uint32_t agent, uint32_t slot, double value);
/* Sets a parameter of one state (-1: of the defaults) to a number within its range, for all who are
   in it and who will be, until the machine is replaced. In the defaults the own value of that name
   follows, but for those to whom the scene gave theirs. */
void jox_mind_set_parameter(JoxMind *mind, uint32_t machine, int32_t state, int parameter,
                            double value);
/* Number of a name that machines share; new names are added. */
uint32_t jox_mind_name(JoxMind *mind, const char *name);
/* The agent calls out a name (by number). */
void jox_mind_call(JoxMind *mind, uint32_t agent, uint32_t name);
/* Everybody hears the name (by number) in the next think, wherever they are. */
void jox_mind_announce(JoxMind *mind, uint32_t name);
/* Marks in `wanted` the ways that agents want in the states that they are in. */
void jox_mind_ask_ways(JoxMind *mind);
/* Appends who went where by which transition, with the values of its condition at present. */
void jox_mind_explain(const JoxMind *mind, const JoxTaken *taken, JoxText *out);
void jox_mind_free(JoxMind *mind);

#endif
