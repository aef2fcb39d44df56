/* A state machine as data: states, their parameters and ordered transitions, and the expressions
   that conditions and computed numbers are compiled to. lua/ builds a machine; once added to a set
   (run.h) it is immutable, except that run/ links states that switch to another machine (`become`).
   The stages think and prefer execute it. Nothing here depends on Lua. */
#ifndef JOX_MACHINE_MACHINE_H
#define JOX_MACHINE_MACHINE_H

#include <stdbool.h>
#include <stdint.h>

#include "agents/parameters.h"
#include "base/format/colour.h"
#include "base/number/distribution.h"
#include "machine/target_kinds.h"

enum { JOX_MOST_TRANSITIONS = 32, JOX_MOST_REGISTERS = 32, JOX_MOST_TERMS = 8 };
/* Greatest absolute weight of a steering term. */
enum { JOX_MOST_WEIGHT = 1000000 };
/* Greatest absolute component of a drift, in multiples of the wanted speed. */
enum { JOX_MOST_DRIFT = 100 };
/* Force with which an agent holds on to another, N: default, and greatest. */
enum { JOX_GRIP = 300, JOX_MOST_GRIP = 5000 };

#define JOX_LOAD_MEANING                                                                           \
    "greatest push borne from any one direction: over directions d, the greatest sum of the "      \
    "positive parts of f.d over its contacts f"

/* Quantities measured of the agent itself. Each row is the complete definition: name (`now.NAME`),
   word, unit, meaning, and the value for agent `i` of `run` with columns `a`. Rows of
   JOX_MEASURED_WORDS can also be written as the plain word in their second column. */
/* clang-format off */
#define JOX_MEASURED_WORDS(X)                                                                      \
    X(density, density_here, "1/m2",                                                               \
      "people per square metre about the agent, from its neighbours' distances", a->density[i])    \
    X(headway, headway, "m",                                                                       \
      "free distance ahead to the next neighbour that does not come the other way; the perception " \
      "radius if there is none", jox_headway(run, i))                                                            \
    X(eagerness, eagerness, "",                                                                    \
      "how eager the agent is to get on, 0 to 1: the crowd about it raises it, within the bounds " \
      "of `haste`", a->eager[i])                                                                   \
    X(pushed, pushed, "N", "magnitude of the net force on the agent",                              \
      jox_length((JoxV2){a->force_x[i], a->force_y[i]}))                                           \
    X(compression, compression, "N/m", "sum of contact force magnitudes, divided by the circumference",      \
      a->compression[i])                                                                           \
    X(load, load, "N", JOX_LOAD_MEANING, a->load[i])                                               \
    X(contacts, contacts, "", "agents and bodies touched", a->contacts[i])                         \
    X(holders, holders, "", "agents that hold on to the agent (see `grasp`)", a->held[i])                \
    X(time_in_state, time_in_state, "s", "since the state was entered", jox_time_in_state(run, i))
#define JOX_MEASURED_OTHERS(X)                                                                     \
    X(speed, , "m/s", "present speed", jox_length((JoxV2){a->vx[i], a->vy[i]}))                    \
    X(fallen, , "s", "time since the agent fell; 0 while it stands", a->fallen[i])                 \
    X(x, , "m", "position east", a->x[i])                                                          \
    X(y, , "m", "position north", a->y[i])                                                         \
    X(neighbours, , "", "neighbours seen", run->neighbours->count[i])                              \
    X(driven, , "m/s", "speed that a person or an input log asks of the agent (`player`); 0: none", \
      jox_driven(run, i))                                                                          \
    X(time, , "s", "simulated time", run->tick * run->dt)
#define JOX_MEASURED(X) JOX_MEASURED_OTHERS(X) JOX_MEASURED_WORDS(X)
/* clang-format on */

typedef enum JoxNow {
#define X(name, ...) JOX_NOW_##name,
    JOX_MEASURED(X)
#undef X
        JOX_NOW_COUNT
} JoxNow;

/* X(op): registers a, b, c are inputs; numbers are doubles; conditions are 0 or 1. Target -1 is the
   agent itself. x / 0 is 0. CLAMP: a within [b, c]. DISTANCE: metres from the agent's centre to the
   target, infinite when absent. PLACE_DENSITY, PLACE_COUNT: people in place (a polygon, else a disc
   of 2 m about it). INSIDE: target is in place. ARRIVED: the agent is in place, or agents who have
   arrived there keep it off. NEAR: target is nearer than a metres. CROSSES: the last move crossed
   line `place` from its right to its left. FIRST_IN: the agent heads its queue. JOINED: it has its
   place in its queue. AFTER: time in state is at least a. LASTED: the drawn duration of the state
   is over. STUCK: the agent has not moved 0.25 m for a seconds. FALLEN: the agent lies after a
   fall. TOUCHES: the gap to target is below 0.05 m. GROUNDED: target, a body, touches the ground.
   KICKED: the agent kicked target, or a body with its tag, in the last step. HIT_BY: target, faster
   than 1 m/s, touches the agent, or such a body hit it in the last step. INCOMING: target, at its
   present velocity, comes within a metres of where the agent stands during the next 2 s. SEES:
   target exists within perception. HAS: the agent holds target, a body or an agent. HEARD: another
   agent within perception, and within a metres, gave the signal `name` in the last step.
   NEIGHBOURS: number of neighbours that match target. THEIRS: memory `name` of the agent that is
   the target, if its machine makes that public; else 0. OF: what is measured of the target, a
   JoxNow in `arg`; 0 if there is none. EXISTS: target is in the world, seen or not. SAME: target
   and `place`, a second target, are the same person, body or place. TOLD: a message `name` waits
   for the agent. MESSAGE: the value called names[arg] of the oldest such message; 0 if there is
   none. EVERY: the time in state has reached a multiple of a, s, in this step. SHUT: a gate at
   place is closed, and the agent sees it. QUEUED: number of agents in the queue `place`. OPEN: the
   gates called `name` are open. Agents behind a wall are not seen, heard or touched. */
/* clang-format off */
#define JOX_OPS(X)                                                              \
    X(CONST) X(NOW) X(OWN) X(MEMORY)                                            \
    X(ADD) X(SUB) X(MUL) X(DIV) X(MIN) X(MAX) X(NEG) X(ABS) X(SQRT) X(CLAMP)    \
    X(GT) X(GE) X(LT) X(LE) X(EQ) X(AND) X(OR) X(NOT)                           \
    X(DISTANCE) X(PLACE_DENSITY) X(PLACE_COUNT)                                 \
    X(INSIDE) X(ARRIVED) X(NEAR) X(CROSSES) X(FIRST_IN) X(JOINED) X(AFTER)      \
    X(LASTED) X(STUCK) X(TOUCHES) X(FALLEN) X(GROUNDED) X(KICKED) X(HIT_BY)     \
    X(INCOMING) X(SEES)                                                         \
    X(HAS) X(HEARD) X(NEIGHBOURS) X(THEIRS) X(OF) X(EXISTS) X(SAME) X(TOLD)     \
    X(MESSAGE) X(EVERY) X(SHUT)                                                 \
    X(PROGRAM_NUMBER) X(PROGRAM_CONDITION)                                      \
    X(QUEUED) X(OPEN)
/* clang-format on */

typedef enum JoxOp {
#define X(name) JOX_OP_##name,
    JOX_OPS(X)
#undef X
        JOX_OP_COUNT
} JoxOp;

typedef struct JoxInstruction {
    uint8_t op, to, a, b, c;
    int16_t target, place; /* indices into the machine's targets; -1 none (or: the agent itself) */
    int16_t name;          /* index into the machine's names; -1 none */
    uint16_t skip; /* if `to` is 0 for all agents, the next `skip` instructions change nothing */
    int32_t arg;
    double number;
} JoxInstruction;

/* A compiled condition or number: straight-line code that leaves its result in register 0. Parts of
   it may be skipped: the right side of an AND if its left side is false for all agents. */
typedef struct JoxExpression {
    JoxInstruction *code;
    uint32_t count;
} JoxExpression;

typedef enum JoxValueKind {
    JOX_VALUE_UNSET,
    JOX_VALUE_CONST,
    JOX_VALUE_OWN,
    JOX_VALUE_EXPRESSION
} JoxValueKind;
typedef struct JoxValue {
    JoxValueKind kind;
    double number;   /* CONST */
    int32_t index;   /* own slot, or expression */
    int32_t line;    /* line that sets it; 0: default; JOX_LINE_LIVE: set by a person during a
                        run */
    uint16_t source; /* index of the line's file in the machine's `files` */
} JoxValue;
enum { JOX_LINE_LIVE = -1 };

typedef enum JoxSteerKind {
    JOX_STEER_HOLD, /* stand still */
    JOX_STEER_SEEK, /* to the nearest point of target (line, gate: to a point drawn per agent) */
    JOX_STEER_AWAY_FROM, /* straight away from target */
    JOX_STEER_DODGE,     /* out of target's line of motion, until that is args[0] metres away */
    JOX_STEER_ORBIT,     /* round a place counter-clockwise; args: see JoxOrbitArg */
    JOX_STEER_QUEUE,     /* to the agent's place in the queue */
    JOX_STEER_FOLLOW,    /* behind target, args[0] metres */
    JOX_STEER_DRIFT,     /* along the vector `drift` */
    JOX_STEER_SPREAD,    /* away from the neighbours' centroid */
    JOX_STEER_EVADE,     /* sideways, out of the way of oncoming agents */
    JOX_STEER_ALONG,     /* along a line's direction or a queue's polyline towards its head */
    JOX_STEER_FIELD,     /* the shortest way to a place round walls */
    JOX_STEER_TOGETHER,  /* towards teammates in sight that are farther away than args[0] m */
    JOX_STEER_WANDER,    /* in a gradually turning direction; within target, if given */
    JOX_STEER_FORMATION, /* to the agent's place in a row: along a line, or abreast behind another
                            agent; spacing args[0] m */
    JOX_STEER_GATHER,    /* to the agent's spot in a polygon of waiting agents, filled from its
                            front; the front lies in direction args[0], degrees */
    JOX_STEER_PLAYER,    /* the velocity that the input log gives; stand still if it gives none */
    JOX_STEER_FUNCTION   /* hook: a Lua function returns the velocity */
} JoxSteerKind;

/* Indices into the args of ORBIT, guidance round a solid (steering/steer_wide.c): inward weight and
   the density profile that it follows. */
typedef enum {
    JOX_ORBIT_INWARD,
    JOX_ORBIT_DENSITY_NEAR,
    JOX_ORBIT_DENSITY_FAR,
    JOX_ORBIT_FAR,
    JOX_ORBIT_RETURN
} JoxOrbitArg;

typedef struct JoxSteerTerm {
    JoxSteerKind kind;
    int16_t target; /* -1 none */
    int32_t hook;   /* FUNCTION; -1 none */
    JoxValue weight;
    JoxValue drift[2]; /* DRIFT */
    double args[6];
} JoxSteerTerm;

enum { JOX_MOST_CARRIED = 4, JOX_NO_STATE = UINT16_MAX };

/* A message that an agent tells another one, or all that a target chooses from. */
typedef struct JoxTell {
    int16_t to;   /* target */
    int16_t name; /* name of the message */
    bool all;
    uint32_t count;
    struct JoxCarried {
        int16_t name;   /* name of the value */
        int16_t target; /* somebody, in place of `value`; -1: none */
        JoxValue value;
    } carries[JOX_MOST_CARRIED];
} JoxTell;

/* Side effects of entering a state or taking a transition. */
typedef struct JoxActions {
    struct JoxAssign {
        int32_t slot; /* memory slot */
        JoxValue value;
        int16_t target; /* somebody, in place of `value`; -1: none */
    } * set;
    uint32_t set_count;
    JoxTell *tell;  /* NULL: nothing is told */
    int16_t signal; /* name of the signal to give; -1 none */
    bool sets_team, sets_tags;
    uint16_t team; /* the agent's new team */
    uint64_t tags; /* the agent's new tags, one bit each */
} JoxActions;

/* An item of a state: a transition, or a reaction, which does something and stays in the state. */
typedef struct JoxTransition {
    char *id;
    uint16_t to; /* of a reaction: its own state */
    bool stays;  /* it is a reaction */
    JoxActions does;
    int32_t when;      /* index of an expression; -1: always (unless when_hook) */
    int32_t when_hook; /* index of a Lua function; -1 none */
    JoxValue chance;   /* UNSET: certain */
    int32_t on_take;   /* hook or -1 */
    int32_t line;
    uint16_t source; /* index of the line's file in the machine's `files` */
} JoxTransition;

typedef struct JoxState {
    char *name;
    JoxColour colour;          /* colour of its agents in pictures */
    uint32_t name_number;      /* number of the name in the set of machines; assigned when the
                                  machine is added */
    uint32_t first_transition; /* number of its first transition, counted over all states; assigned
                                  likewise */
    JoxValue param[JOX_PARAM_COUNT]; /* UNSET: inherits the machine's default, then the engine's */
    JoxSteerTerm steer[JOX_MOST_TERMS]; /* behind a FUNCTION: terms of the steering it extends */
    uint32_t steer_count;
    JoxTransition *transitions;
    uint32_t transition_count;
    bool has_lasts;
    JoxDist lasts;            /* s, drawn on entry */
    int32_t lasts_expression; /* expression for it, evaluated on entry; -1 none */
    bool removes;             /* agents that enter leave the world */
    bool lies;                /* agents are drawn lying down; no step reads it */
    int32_t push_when;        /* expression; -1 always */
    int16_t push_toward;      /* target; -1: along the preferred velocity */
    bool push_nearest;        /* push_weight "nearest" instead of "equal" */
    int16_t face, approach;   /* targets; -1 none */
    uint64_t ignore, push_only;
    int16_t kick, kick_at; /* targets; -1 none */
    JoxValue kick_impulse; /* N s per kg of the body: the velocity change, m/s */
    JoxValue kick_speed;   /* speed after the kick, m/s; UNSET: kick_impulse holds */
    JoxValue kick_lift;    /* angle above the horizontal, degrees; UNSET: 0 */
    int16_t take;          /* target: body to pick up when within reach; -1 none */
    int16_t toss, toss_at; /* targets: body to throw, and where to; -1 none */
    JoxValue toss_speed;   /* horizontal speed of the throw, m/s */
    int16_t grasp;         /* target: agent to hold on to when within reach; -1 none */
    JoxValue grip;         /* greatest force of the hold, N; UNSET: JOX_GRIP */
    JoxActions enters;
    double signal_every;    /* s between repetitions of enters.signal during the state; 0: given
                               once */
    char *become;           /* name of the behaviour that the agent switches to; NULL none */
    int32_t become_machine; /* its machine's index; -1 until resolved */
    char *become_file;      /* file that says so: the machine's, or a mod's */
    int32_t become_line, become_column;
    int32_t on_enter, on_exit; /* hooks; -1 none */
    int32_t line;
    uint16_t source; /* index of the line's file in the machine's `files` */
} JoxState;

typedef struct JoxOwnSlot {
    char *name;   /* "speed", "court"; "" for a distribution written in a state */
    JoxDist dist; /* drawn once per agent; groups may override it by name */
    bool is_place;
    bool kept;                        /* carried over from an earlier version; this version does not
                                         read it */
    bool declared;                    /* in the machine's `own`: no group need set it */
    int32_t line, column, end_column; /* first use of own.NAME in the source; 0 unknown */
    uint32_t source;                  /* index of that file in the machine's `files` */
} JoxOwnSlot;

typedef enum {
    JOX_MEMORY_NUMBER,
    JOX_MEMORY_BOOLEAN,
    JOX_MEMORY_SOMEBODY, /* a person, body or place: see JOX_WHO_BODY */
    JOX_MEMORY_KINDS
} JoxMemoryKind;
/* Prefixes that turn the name of memory into the identities of hidden slots: of a counter, turned
   angle and whether it has begun; of a sighting, who was seen, and where. */
#define JOX_IDENTITY_ANGLE "\1"
#define JOX_IDENTITY_BEGUN "\2"
#define JOX_IDENTITY_SEEN "\3"
#define JOX_IDENTITY_SEEN_X "\4"
#define JOX_IDENTITY_SEEN_Y "\5"
#define JOX_LAST_IDENTITY '\5'
/* Greatest number of dormant slots of a machine, memory that no name refers to any more; beyond it
   the oldest are dropped. */
enum { JOX_MOST_DORMANT = 64 };

typedef struct JoxMemorySlot {
    char *name;     /* "" for hidden slots */
    char *identity; /* hidden slots: key by which a later version finds the slot again; else NULL */
    bool dormant;   /* hidden because this version lacks a name that an earlier one had */
    JoxMemoryKind kind;
    double initial;
    bool is_public;       /* other machines may read it */
    uint32_t name_number; /* number of the name in the set of machines, if is_public */
} JoxMemorySlot;

/* circuits: net counter-clockwise turns about `target` since the agent first crossed its start line
   (without one: since it was spawned). Uses memory slots value, turned angle (rad) and begun
   (0/1). */
typedef struct JoxCounter {
    int16_t target;
    int32_t value, angle, begun;
    int32_t state; /* state in which it counts; -1: all states */
} JoxCounter;

/* Where an agent last saw what a slot of memory holds. Uses memory slots `who`, for whom the
   position is valid, x and y, m. */
typedef struct JoxSighting {
    int32_t memory, who, x, y;
} JoxSighting;

/* Uses of names that all machines of a set share: signals, and names of states, machines and memory
   by which behaviours refer to other agents. */
typedef enum {
    JOX_NAME_STATE = 1,
    JOX_NAME_SIGNALLED = 2,
    JOX_NAME_HEARD = 4,
    JOX_NAME_MACHINE = 8,
    JOX_NAME_MEMORY = 16,
    JOX_NAME_GATE = 32,
    JOX_NAME_TOLD = 64,    /* messages that are asked for */
    JOX_NAME_SENT = 128,   /* messages that are told */
    JOX_NAME_READ = 256,   /* values of messages that are read */
    JOX_NAME_CARRIED = 512 /* values that messages carry */
} JoxNameUse;
typedef struct JoxName {
    char *text;
    uint32_t uses;   /* bits of JoxNameUse */
    uint32_t number; /* the same for equal texts in all machines of a set; assigned when the machine
                        is added */
    int32_t line, column, end_column; /* first use of the name in the source; 0 unknown */
    uint32_t source;                  /* index of that file in the machine's `files` */
} JoxName;

/* A tag or team that a machine names. Tags and teams of the scene keep their number; others get one
   when the machine is put into a run, and until then `number` is provisional. */
typedef struct JoxBelonging {
    char *name;
    bool is_team;
    bool is_set, is_asked; /* is_set: a state assigns it to agents; is_asked: a target or parameter
                              tests for it */
    uint16_t number;       /* tag: bit; team: number */
    int32_t line, column, end_column; /* first use of the name in the source; 0 unknown */
    uint32_t source;                  /* index of that file in the machine's `files` */
} JoxBelonging;

/* Numbers for teams that no group of the scene has and that states assign. */
enum { JOX_MOST_SET_TEAMS = 64, JOX_FIRST_SET_TEAM = 65536 - JOX_MOST_SET_TEAMS };

typedef struct JoxMachine {
    char *name, *path;
    char **files; /* paths of all files it was made from, `path` first; may be empty */
    uint32_t file_count;
    double version;   /* version that the author gave; NaN: none */
    uint32_t reloads; /* number of reloads that led to it */
    uint16_t start;
    JoxValue defaults[JOX_PARAM_COUNT];
    JoxState *states;
    uint32_t state_count;
    JoxExpression *expressions;
    uint32_t expression_count;
    JoxTarget *targets;
    uint32_t target_count;
    JoxOwnSlot *own;
    uint32_t own_count;
    JoxMemorySlot *memory;
    uint32_t memory_count;
    uint32_t home; /* 1 + slot of the x of the agent's own post, with y in the next slot; 0: not
                      used */
    uint32_t name_number; /* number of its own name in the set; assigned when it is added */
    JoxCounter *counters;
    uint32_t counter_count;
    JoxSighting *sightings;
    uint32_t sighting_count;
    JoxName *names;
    uint32_t name_count;
    JoxBelonging *belongings; /* tags and teams that it names */
    uint32_t belonging_count;
    struct JoxRenamed {
        char *from, *to;
    } * renamed; /* new names of states, own values and memory of older versions */
    uint32_t renamed_count;
    uint32_t hook_count;
    bool views;    /* hooks read other agents, as they were before the step */
    bool headings; /* it reads the last step's preferred velocities of others; assigned when it is
                      added to a set */
    bool reacts;   /* it has reactions; assigned like `headings` */
    bool hears_functions, tells_functions; /* its hooks may ask for, or tell, any message */
    bool arrivals; /* it asks for arrival in crowds; assigned like `headings` */
    int32_t vm;    /* index of the Lua state that holds the hooks; -1 none */
} JoxMachine;

/* Renumbers tags and teams: belongings[n] gets numbers[n]. Only for a machine that is not in a run
   yet. */
void jox_machine_renumber(JoxMachine *machine, const uint16_t *numbers);

/* Returns the path of file `source` of a machine (JoxState.source and the like). */
static inline const char *jox_machine_file(const JoxMachine *machine, uint32_t source) {
    return source < machine->file_count ? machine->files[source] : machine->path;
}

/* Return a state and a transition without effect: every index is -1. They own `name` and `id`. */
JoxState jox_state_blank(char *name);
JoxTransition jox_transition_blank(char *id);
/* Returns the index of a state by name, or -1. */
int jox_machine_state(const JoxMachine *machine, const char *name);
/* Returns the key by which a later version finds the slot: its name, or a hidden slot's
   identity. */
static inline const char *jox_memory_identity(const JoxMemorySlot *slot) {
    return *slot->name ? slot->name : slot->identity ? slot->identity : "";
}
/* Returns the name of the memory to which a hidden slot belongs, by its identity; NULL if the
   identity is not that of a hidden slot. */
static inline const char *jox_identity_owner(const char *identity) {
    return *identity && *identity <= JOX_LAST_IDENTITY ? identity + 1 : NULL;
}
/* Returns the memory slot of a name, or -1; slots without a name are never found. */
int32_t jox_machine_memory(const JoxMachine *machine, const char *name);
/* Returns the slot of an own value by name, or -1; slots without a name are never found. */
int32_t jox_machine_own_slot(const JoxMachine *machine, const char *name);
/* Kinds of parts of a machine that have names. */
typedef enum { JOX_PART_STATE, JOX_PART_OWN, JOX_PART_MEMORY } JoxPart;
/* Returns whether the machine has a part of this name. */
bool jox_machine_has(const JoxMachine *machine, JoxPart part, const char *name);
/* Returns the present name of the part that an older version called `name`, by the machine's list
   `renamed`; NULL if `name` still exists or was not renamed. */
const char *jox_machine_renamed(const JoxMachine *machine, JoxPart part, const char *name);
enum { JOX_VERSION_TEXT = 64 };
/* Writes the version as messages show it: "version 10 (reload 3)", without the parts that are
   unknown; the first text without a version is "the first version". Returns `out`. */
const char *jox_machine_version(const JoxMachine *machine, char out[JOX_VERSION_TEXT]);
/* Frees the machine with everything it owns (made by jox_alloc / jox_strdup). */
void jox_machine_free(JoxMachine *machine);

#endif
