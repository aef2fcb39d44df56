/* State machines at work. The world calls, once per step, jox_machines_think (transitions and
   actions), then jox_machines_prefer (preferred velocities) over all agents. A JoxMachineSet is
   part of the model, a JoxMachineState part of the state, and a JoxMachineRun joins both with the
   columns and the scratch of a world. */
#ifndef JOX_MACHINE_RUN_H
#define JOX_MACHINE_RUN_H

#include <stdatomic.h>

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

/* Calls one Lua function for one agent, on the stepping thread, agents by ascending id. WHEN
   returns 0/1 in result[0], STEER a velocity in result[0..1], m/s. Returns false if it failed (WHEN
   then counts as false, STEER as standing still). NULL where there is no Lua. */
typedef bool JoxHookCall(void *context, const JoxMachine *machine, int32_t hook, JoxHookKind kind,
                         uint32_t agent, double result[2]);
/* Called before the first hook of a step (`begins`) of machines whose hooks read other agents, and
   after the last, when their writes to other agents are carried out. May be NULL. */
typedef void JoxHookBracket(void *context, bool begins);

/* Lists the state that the hooks of a machine keep themselves. May be NULL. */
typedef void JoxHookSections(void *context, const JoxMachine *machine, JoxSections *sections);

/* One transition that was taken; kept for the step, sorted by agent id. */
typedef struct JoxTaken {
    uint32_t agent_id;
    uint16_t machine, from, to, transition;
} JoxTaken;

enum { JOX_MOST_MACHINES = 64, JOX_MOST_GIVEN = 256 };

/* A signal that an agent gave; others hear it in the next step. */
typedef struct JoxSignal {
    uint32_t name; /* number of the name in the set */
    uint32_t agent_id;
    float x, y; /* m */
} JoxSignal;

/* JOX_MOST_WAITING: messages that wait for one agent. JOX_MOST_SENT: messages that functions send
   in a step. */
enum { JOX_MOST_WAITING = 16, JOX_MOST_SENT = 1000000 };

/* Use that was made of a message. One that items or functions use in the stage think is seen by all
   items of the agent until the stage ends, and removed before the next step. */
typedef enum JoxMessageUse {
    JOX_MESSAGE_USED = 1,        /* it is used up */
    JOX_MESSAGE_BY_ITEM = 2,     /* an item that was carried out in this step rests on it */
    JOX_MESSAGE_BY_FUNCTION = 4, /* a function took it in this step */
} JoxMessageUse;

/* A message from one agent to another. */
typedef struct JoxMessage {
    uint32_t to, from;                /* ids */
    uint32_t name;                    /* number of the name in the set */
    uint32_t sent;                    /* tick */
    uint32_t used;                    /* bits of JoxMessageUse; 0: it waits */
    uint32_t count;                   /* of values */
    uint32_t somebody;                /* bits of the values that mean somebody */
    uint32_t unused;                  /* 0: sections hold no padding bytes */
    uint32_t names[JOX_MOST_CARRIED]; /* numbers of their names */
    double values[JOX_MOST_CARRIED];
} JoxMessage;

/* The agent that kicked or threw a body last. */
typedef struct JoxThrown {
    uint32_t body, agent; /* ids */
} JoxThrown;

/* Number of times that a signal was given, and who gave it last. */
typedef struct JoxNameCall {
    uint64_t count;
    uint32_t tick;     /* at which it was heard */
    uint32_t agent_id; /* UINT32_MAX: announced to everybody */
    float x, y;        /* m */
} JoxNameCall;

/* Number of times that messages of a name were told, and their fate; and the last that came to its
   receiver. */
typedef struct JoxMessageTally {
    uint64_t count, to_nobody, unasked, lost; /* that came to an agent which asks for them; see
                                                 messages_to_nobody and the like */
    uint32_t sent, from, to, unused;          /* tick; ids; 0: sections hold no padding bytes */
} JoxMessageTally;

/* A body that an agent picks up or lets go. */
typedef struct JoxGrip {
    uint32_t object, agent_id;
    bool takes;     /* false: it lets go, with `velocity` */
    JoxV3 velocity; /* m/s */
} JoxGrip;

/* Kinds of distance fields round walls and large bodies. */
typedef enum JoxRouteKind {
    JOX_ROUTE_NOW,   /* walls and bodies as they stand */
    JOX_ROUTE_OPEN,  /* as if gates were open and movable bodies away: for agents that have no other
                        way, and wait at a gate */
    JOX_ROUTE_CROWD, /* as NOW, but slower where people bound for the place are held up: for agents
                        under the walking law */
    JOX_ROUTE_STEPLESS, /* as NOW, without stairs and escalators: for agents that cannot use them;
                           only in worlds with storeys */
    JOX_ROUTE_LIFTS,    /* as NOW, and by lifts: for agents that choose between these and stairs;
                           only in worlds with lifts, as the next kind */
    JOX_ROUTE_STEPLESS_LIFTS, /* as STEPLESS, and by lifts */
    JOX_ROUTE_KINDS
} JoxRouteKind;

/* Last writer of a value of a watched agent. */
typedef enum JoxWriter {
    JOX_WROTE_TRANSITION, /* actions of a transition */
    JOX_WROTE_STATE,      /* actions on entering a state */
    JOX_WROTE_FUNCTION,   /* a Lua function */
    JOX_WROTE_PROGRAM     /* a program or an input log, between two steps */
} JoxWriter;
typedef struct JoxWrote {
    bool is_memory;
    uint16_t machine, index; /* slot of memory, or parameter */
    JoxWriter by;
    uint16_t state, transition; /* TRANSITION, STATE: the state, and a transition that leaves it; an
                                   outer state counts on from the others */
    uint32_t tick;
    char file[128]; /* FUNCTION: its file */
    int line;
} JoxWrote;

/* A watched agent: its last transition with the reason, and the last writers of its values. */
typedef struct JoxWatched {
    JoxWrote *wrote; /* one for each value that was written since watching began */
    uint32_t wrote_count;
    size_t wrote_capacity;
    uint32_t agent_id;
    bool took; /* a transition was taken since watching began; `tick`, `from`, `to` and `why`
                  describe the last */
    uint32_t tick;
    char from[64], to[64];
    JoxText why, due; /* jox_machines_explain of that, and of the one due in this step */
    /* Last roll of each chance since the state was entered. */
    struct JoxRolled {
        bool rolled;
        uint32_t tick;
        double drawn; /* the chance was won if it was greater */
    } rolls[JOX_MOST_TRANSITIONS];
    uint32_t begun; /* tick at which watching began */
    /* Per name, the last message that came since then. */
    struct JoxCame {
        uint32_t name, count; /* number of the name; messages that came */
        uint32_t sent, from;  /* tick; id */
        enum { JOX_CAME_WAITS, JOX_CAME_USED, JOX_CAME_LOST } fate;
        uint32_t tick; /* when that happened */
        char by[96];   /* its user, as "its transition to It (tag.lua:12)" */
    } * came;
    uint32_t came_count;
    size_t came_capacity;
    /* Per name, the last call of a signal, the nearest of several in a step; and where the agent
       was. */
    struct JoxOverheard {
        uint32_t name, tick, agent_id; /* as in JoxNameCall */
        float x, y, own_x, own_y;      /* m */
    } * overheard;
    uint32_t overheard_count;
    size_t overheard_capacity;
} JoxWatched;

/* A parameter that a person set while the world ran. */
typedef struct JoxParameterEdit {
    uint32_t machine;
    int32_t state; /* index of the state; -1: the machine's defaults; -2 - index of an outer
                      state */
    int32_t parameter;
    uint32_t unused; /* 0: sections hold no padding bytes */
    double value;
} JoxParameterEdit;

/* Time that agents spent in a state of this version of a machine. */
typedef struct JoxStateCounts {
    uint64_t spent; /* agent-steps */
    uint64_t steps; /* steps in which at least one agent was in the state */
    double sight;   /* greatest perception of its agents, m, sampled every 16th step */
} JoxStateCounts;

/* Counts of the transitions of a machine since the start, over all agents. */
typedef struct JoxMachineCounts {
    JoxStateCounts *states;
    uint32_t state_count, since; /* since: the tick at which this version began */
    size_t state_capacity;
    uint64_t *taken; /* by number of the transition: state->first_transition + its index in the
                        state */
    uint32_t taken_count;
    size_t taken_capacity;
    /* Counts of transitions of replaced versions, by the names of both states. */
    struct JoxTakenBefore {
        char *from, *to;
        uint64_t taken;
    } * before;
    uint32_t before_count;
    size_t before_capacity;
} JoxMachineCounts;

/* Model: the machines of a world. Machines are added, and replaced by a reload. Parameters that
   people set during a run (JoxMachineState.edits) are applied to a copy, so that a machine never
   changes once it is built. The set owns its machines. Zero-initialised is empty. */
typedef struct JoxMachineSet {
    const JoxMachine *items[JOX_MOST_MACHINES]; /* the ones that run: edited[n] if there is one,
                                                   else built[n] */
    JoxMachine *built[JOX_MOST_MACHINES];       /* as their files say */
    JoxMachine *edited[JOX_MOST_MACHINES]; /* copies with the parameters that people set, or NULL */
    uint32_t count;
    char **names; /* names by number, shared by all machines; only grows */
    uint32_t name_count;
    size_t name_capacity;
    uint32_t *name_table; /* hash table with open addressing: 1 + number of a name; 0: empty */
    size_t name_room;     /* size of name_table, a power of two */
} JoxMachineSet;

/* State: what a step leaves to the next, besides the agents' columns. Zero-initialise. */
typedef struct JoxMachineState {
    JoxSignal *called; /* signals given since the last think, in order */
    uint32_t called_count;
    size_t called_capacity;
    uint32_t *announced; /* names called out to everybody since the last think */
    uint32_t announced_count;
    size_t announced_capacity;
    uint32_t *pending; /* ids of agents whose entry hook is still to run, in the order of
                          spawning */
    uint32_t pending_count;
    size_t pending_capacity;
    JoxMessage *sent; /* messages told since the last think, in order */
    uint32_t sent_count;
    size_t sent_capacity;
    JoxMessage *waiting; /* messages that wait, by id of the receiver, the oldest first */
    uint32_t waiting_count;
    size_t waiting_capacity;
    JoxThrown *thrown; /* bodies that agents kicked or threw, the last one last */
    uint32_t thrown_count;
    size_t thrown_capacity;
    JoxParameterEdit *edits; /* in the order of setting, at most one per parameter */
    uint32_t edit_count;
    size_t edit_capacity;
    JoxMachineCounts counts[JOX_MOST_MACHINES]; /* statistics; no step reads them */
    JoxNameCall *calls; /* statistics, by number of the name, as far as names were called */
    uint32_t call_count;
    size_t call_capacity;
    JoxMessageTally *tallies; /* statistics, by number of the name, as far as names were told */
    uint32_t tally_count;
    size_t tally_capacity;
    /* Statistics: messages dropped because too many waited; that the receiver's machine never asks
       for; that had no receiver. */
    uint64_t messages_lost, messages_unasked, messages_to_nobody;
    uint64_t hook_failures; /* statistic: calls of hooks that failed since the start */
    uint64_t changes_lost;  /* statistic: writes to memory of other agents that a later write
                               replaced */
} JoxMachineState;

/* A number or condition that the program computes. */
typedef struct JoxProgramWord {
    const char *name;
    JoWordValues *values; /* NULL: an action */
    void *context;
    const JoWorld *world;
    atomic_uint invalid; /* values that were not finite, since run/ last looked */
} JoxProgramWord;

/* The machines of a world with their inputs, and the results of a step. */
typedef struct JoxMachineRun {
    JoxMachineSet *set;
    JoxMachineState *state;
    JoxAgents *agents;
    JoIsa isa; /* instruction set of the kernels */
    /* Inputs, assigned by the world before each stage. */
    const JoxNeighbours *neighbours;
    /* Returns how many agents left the world from a place, by its name; NULL: nobody counts. */
    uint32_t (*count_left)(const void *exits, const char *place);
    const void *exits;
    const struct JoxLiftView *lifts; /* NULL: there are none */
    const JoxObjects *objects;
    const JoxPlace *places;
    uint32_t place_count;
    const JoxWalls *walls;       /* all walls, open gates too; NULL: none */
    const JoxWalls *wall_images; /* images of closed walls beyond joined edges; NULL: none */
    uint32_t walls_version;      /* incremented by each change of the walls */
    uint64_t seed;
    uint32_t tick;      /* number of this step, or of the last one; starts at 0 */
    double dt, gravity; /* s; m/s2 (for throws) */
    JoxHookCall *call;
    JoxHookBracket *bracket;
    JoxHookSections *hook_sections;
    void *call_context;
    JoxProgramWord *program_words; /* by the argument of PROGRAM_NUMBER, PROGRAM_CONDITION */
    /* Velocities, m/s, and the button, 1 while it is held, that the player or the input log gives
       agents; the others get (0, 0) and 0. */
    const struct JoxPlayerInput {
        uint32_t agent_id;
        float vx, vy, button;
    } * inputs;
    uint32_t input_count;
    /* Distance fields, [place * JOX_ROUTE_KINDS + kind]; NULL where there is none yet. Lookups set
       a bit per kind in wanted[place], for the world to make or renew the field. */
    JoxField *const *fields;
    uint8_t *wanted;

    /* Results of the step. */
    JoxTaken *taken;
    uint32_t taken_count;
    size_t taken_capacity;
    JoxImpulse *kicks; /* impulses on bodies, sorted by agent id */
    uint32_t kick_count;
    size_t kick_capacity;
    JoxGrip *grips; /* sorted by agent id */
    uint32_t grip_count;
    size_t grip_capacity;
    uint32_t without_spot; /* number of agents that wait in a place without room for them */
    uint32_t without_way;  /* number of times that no way led to whom `field` leads */
    /* Pushing per agent, for the force stage; valid until the next think. */
    uint8_t *push_on, *push_nearest;
    float *push_toward_x, *push_toward_y; /* unit direction; (0, 0): that of the preferred
                                             velocity */

    /* Explanations for observers; no step reads them. */
    uint32_t edits_made;   /* number of parameters set by people so far */
    bool traces;           /* explain transitions of agent trace_id in `trace` */
    bool trace_shows_item; /* the deeds of the item that is carried out belong to the trace */
    uint32_t trace_id;
    JoxText trace;
    struct JoxTraceTerms *trace_terms; /* terms that the traced agent waits for (trace.c) */
    JoxWatched *watched;               /* owned by the world */
    uint32_t watched_count;

    /* Reports of numbers that were computed and are invalid, one line each; the reader
       empties the text. `told` lists what was reported, once per line of source and parameter. */
    JoxText notes;
    struct JoxTold {
        uint32_t machine, reloads, source;
        int32_t line, parameter;
    } * told;
    uint32_t told_count, told_capacity;
    uint32_t *lost_names; /* names of messages of which it was reported that one was dropped */
    uint32_t lost_name_count;
    size_t lost_name_capacity;

    bool thinks;                       /* in the stage think */
    bool spawning;                     /* inside jox_machines_spawn, when nothing can be sensed */
    struct JoxMachineScratch *scratch; /* made on first use */
} JoxMachineRun;

/* Adds a machine to the set, which owns it from then on; widens the agents' rows as needed. Returns
   its index. */
uint32_t jox_machines_add(JoxMachineRun *run, JoxMachine *machine);
/* Returns the radius, m, that jox_machines_spawn gives the agent with this id. */
float jox_machines_birth_radius(const JoxMachineRun *run, uint32_t id, uint32_t machine,
                                const JoxDist *const *own);
/* Makes the agent at index `agent` a fresh instance of `machine`. Draws its own values and memory;
   `own` and `memory` override the machine's distributions: NULL, or an array with a pointer per
   slot, of which the first JOX_MOST_GIVEN count, NULL where the machine's own stands. Enters the
   start state: parameters are written, on_enter is queued for the next think. */
void jox_machines_spawn(JoxMachineRun *run, uint32_t agent, uint32_t machine,
                        const JoxDist *const *own, const JoxDist *const *memory);
/* Stage think: counters, transitions, parameters, kicks. Agents that enter a state with `removes`
   get `removed`. */
void jox_machines_think(JoxMachineRun *run, JoxPool *pool);
/* Stage prefer: writes pref_x, pref_y and face_x, face_y of every agent. */
void jox_machines_prefer(JoxMachineRun *run, JoxPool *pool);
/* The plan of replacing machine `old` by `next`, which any thread may prepare: which states, own
   values, memory and conditions continue as which, which parameters differ, and new draws for all
   agents with ids below `next_id`. Own values whose distribution changed are drawn from the agent's
   same random numbers, except those that the scene or a function gave. Both machines must outlive
   the plan. */
typedef struct JoxReplacement JoxReplacement;
JoxReplacement *jox_replacement_prepare(const JoxMachine *old, JoxMachine *next, uint64_t seed,
                                        uint32_t next_id);
void jox_replacement_free(JoxReplacement *replacement);
/* Appends a line for each memory that the replacement keeps, takes up again or drops; `people`
   names the agents. */
void jox_replacement_tell(const JoxReplacement *replacement, const char *people, JoxText *out);
/* Appends a dormant slot of memory to a machine that is not in a run yet. */
void jox_dormant_add(JoxMachine *machine, const char *identity, JoxMemoryKind kind, double initial);
/* Returns NULL if the replacement is possible now, else the reason, written to `why` ("312 agents
   are in 'Greet', which this version lacks"). */
const char *jox_machines_refuses(const JoxMachineRun *run, uint32_t index,
                                 const JoxReplacement *replacement, char *why, uint32_t size);
/* Replaces machine `index` by the plan's `next`, which the set owns from then on; the caller frees
   the old one, which is returned. Agents keep state (by name or `renamed`), time, memory and own
   values; enter and exit hooks do not run. */
JoxMachine *jox_machines_replace(JoxMachineRun *run, uint32_t index,
                                 const JoxReplacement *replacement);
/* Writes the number of agents in each state of machine `index` to people[0 .. state_count - 1]. */
void jox_machines_people(const JoxMachineRun *run, uint32_t index, uint32_t *people);
/* Calls `visit` once for each pair of states between which agents of machine `index` went so far,
   by name, those of this version first. */
typedef void JoxTakenVisit(void *context, const char *from, const char *to, uint64_t taken);
void jox_machines_taken(const JoxMachineRun *run, uint32_t index, JoxTakenVisit *visit,
                        void *context);
/* Switches the agent to another machine, in its start state. It keeps its body, the values that the
   scene gave it, and its memory by name; the rest is drawn anew. */
void jox_machines_become(JoxMachineRun *run, uint32_t agent, uint32_t machine);
/* Puts the agent into a state between two steps. As in jox_machines_spawn, neighbours are not
   known. */
void jox_machines_set_state(JoxMachineRun *run, uint32_t agent, uint16_t state);
/* Gives the agent an own value, as its group in the scene could have done. */
void jox_machines_set_own(JoxMachineRun *run, uint32_t agent, uint32_t slot, double value);
/* Returns the number of people in all states within an outer state, by those in each state. */
uint32_t jox_people_within(const JoxMachine *machine, uint32_t outer, const uint32_t *people);
/* Sets a parameter of one state (-1: of the defaults; -2 - index: of an outer state) to a number
   within its range, for all agents that are or will be in it, until the machine is replaced. States
   within an outer state that set the parameter themselves keep their value. A default also sets the
   own value of that name, except of agents to which the scene gave theirs. */
void jox_machines_set_parameter(JoxMachineRun *run, uint32_t machine, int32_t state, int parameter,
                                double value);
/* Returns the number of a name that machines share; adds new names. */
uint32_t jox_machines_name(JoxMachineRun *run, const char *name);
/* Gives a signal (by number) from the agent. */
void jox_machines_call(JoxMachineRun *run, uint32_t agent, uint32_t name);
/* In a crowd of at most this size agents see all others within perception, not their neighbours
   alone, as the opponents in a game. */
enum { JOX_SMALL_CROWD = 64 };
/* Writes the agents that an agent sees, with no wall between, nearest first, ties by id. Returns
   how many. */
uint32_t jox_machines_seen(const JoxMachineRun *run, uint32_t agent,
                           uint32_t seen[JOX_SMALL_CROWD]);
/* Returns whether memory that holds somebody (JOX_WHO_BODY in target_kinds.h) means one who is in
   the world; `who` of an agent is 1 + its id. */
bool jox_who_exists(const JoxMachineRun *run, double who);
/* Returns the index of the agent that it means, or JOX_NO_INDEX; the row of the body, or the index
   of the place, or -1. */
uint32_t jox_who_agent(const JoxMachineRun *run, double who);
int32_t jox_who_row(const JoxMachineRun *run, double who);
int32_t jox_who_place(const JoxMachineRun *run, double who);
/* Returns the body that the agent carries, else the agent that it holds on to. */
double jox_who_is_held(const JoxMachineRun *run, uint32_t agent);
/* Returns the agent, another one, that threw or kicked the body which hits this one (hit_by), else
   that body. */
double jox_who_struck(const JoxMachineRun *run, uint32_t agent);
/* Returns whether agent i has agent j, or body `row`, within perception and in sight. */
bool jox_sees_agent(const JoxMachineRun *run, uint32_t i, uint32_t j);
bool jox_sees_body(const JoxMachineRun *run, uint32_t i, uint32_t row);
/* Appends whom it means: "agent 17", "body 'ball'", "place 'gate'", "nobody". */
void jox_who_print(const JoxMachineRun *run, double who, JoxText *out);
/* Returns the messages that wait for an agent, the oldest first; some may have been used. */
const JoxMessage *jox_messages_of(const JoxMachineRun *run, uint32_t agent, uint32_t *count);
/* Prints a value of memory: a number, "true", whom it holds, or the items of a list. */
void jox_memory_print(const JoxMachineRun *run, const JoxMachine *machine, const double *memory,
                      uint32_t index, JoxText *out);
/* Returns the oldest message of a name, by number, that waits for the agent, or NULL. */
const JoxMessage *jox_message_find(const JoxMachineRun *run, uint32_t agent, uint32_t name);
/* Returns the same message and marks it as used. */
const JoxMessage *jox_message_take(JoxMachineRun *run, uint32_t agent, uint32_t name);
/* Sends a message of a function; false if there are too many. */
bool jox_message_send(JoxMachineRun *run, const JoxMessage *message);
/* Counts a message of this name that has no receiver. */
void jox_message_to_nobody(JoxMachineRun *run, uint32_t name);
/* Gives a signal (by number) that all agents hear in the next think, wherever they are. */
void jox_machines_announce(JoxMachineRun *run, uint32_t name);
/* Returns the place that an agent heads for by a distance field in its state and has not reached;
   -1: none. *shut, unless NULL, tells whether no way leads there with gates as they stand, as far
   as fields are made. */
int32_t jox_machines_field_goal(const JoxMachineRun *run, uint32_t i, bool *shut);
/* Returns the place that the agent heads for by a distance field and that no way leads to, not even
   through open gates; -1: none. Whether a way leads through gates is known half a second after the
   first request. */
int32_t jox_machines_no_way(const JoxMachineRun *run, uint32_t i);
/* Writes the places that an agent heads for by a distance field in any state of its machine: those
   that the machine names, and the agent's own. Writes at most `most`, with repetitions if several
   states head for the same place, and returns how many. */
uint32_t jox_machines_goals(const JoxMachineRun *run, uint32_t i, int32_t *places, uint32_t most);
/* Sets bits in `wanted` for the distance fields that agents need in their states. */
void jox_machines_ask_routes(JoxMachineRun *run);
/* Records the writer of a value of agent i, if it is watched. */
void jox_machines_record_writer(JoxMachineRun *run, uint32_t i, const JoxWrote *wrote);
/* Frees the record of an agent that is no longer watched. */
void jox_watched_end(JoxWatched *watched);
/* Returns the value of an expression of a machine for one agent; conditions are 0 or 1. On the
   stepping thread. */
double jox_machines_expression(const JoxMachineRun *run, const JoxMachine *machine,
                               int32_t expression, uint32_t agent);
/* Appends a transition as text: time, agent, states, and the condition with present values. */
void jox_machines_explain(const JoxMachineRun *run, const JoxTaken *taken, JoxText *out);
/* Lists the state of the machines. Call it after jox_agents_sections: restoring checks the agents'
   machines and states. */
void jox_machines_sections(JoxMachineRun *run, JoxSections *sections);
/* Overwrites the scratch, to prove that no later step depends on it. */
void jox_machines_forget(JoxMachineRun *run);
/* Frees the run with its set and state. */
void jox_machines_free(JoxMachineRun *run);

#endif
