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
#include "machine/expressions.h"
#include "machine/target_kinds.h"

enum { JOX_MOST_TRANSITIONS = 32, JOX_MOST_TERMS = 8 };
/* Greatest absolute weight of a steering term. */
enum { JOX_MOST_WEIGHT = 1000000 };
/* Greatest absolute component of a drift, in multiples of the wanted speed. */
enum { JOX_MOST_DRIFT = 100 };
/* Force with which an agent holds on to another, N: default, and greatest. */
enum { JOX_GRIP = 300, JOX_MOST_GRIP = 5000 };

/* Poses of a state on the live page: of the arms, then of the whole body. */
#define JOX_POSES(X)                                                                               \
    X(BRACE, "brace")                                                                              \
    X(RAISE, "raise")                                                                              \
    X(CARRY, "carry")                                                                              \
    X(THROW, "throw")                                                                              \
    X(POINT, "point")                                                                              \
    X(SIT, "sit")                                                                                  \
    X(KNEEL, "kneel")
enum JoxStatePose {
    JOX_POSE_NONE,
#define X(pose, name) JOX_POSE_##pose,
    JOX_POSES(X)
#undef X
        JOX_POSE_COUNT
};
extern const char *const jox_poses[JOX_POSE_COUNT]; /* names; NULL of none */

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
                            front, which lies in direction args[0], degrees; with args[1] spread
                            over all of it */
    JOX_STEER_RIDE,      /* in a lift to target, the place of a lift on a storey */
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

/* Slots of memory of a way round walls to what is no place: the next point of it, the one after
   that, and the end for which it was found, x and y each, m; tick at which it was last followed. */
enum { JOX_LEAD_NEXT, JOX_LEAD_THEN = 2, JOX_LEAD_END = 4, JOX_LEAD_TICK = 6, JOX_LEAD_SLOTS };

typedef struct JoxSteerTerm {
    JoxSteerKind kind;
    int16_t target; /* -1 none */
    int32_t hook;   /* FUNCTION; -1 none */
    JoxValue weight;
    JoxValue drift[2]; /* DRIFT */
    uint32_t lead; /* FIELD to what may be no place: 1 + the first of its JOX_LEAD_SLOTS slots of
                      memory; else 0 */
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

enum { JOX_MOST_SET = 64 };

/* Changes of a list in memory: the item is added at its end, and the first goes if it is full; or
   all that equal the item are removed, or all. */
typedef enum { JOX_LIST_NONE, JOX_LIST_PUSH, JOX_LIST_REMOVE, JOX_LIST_CLEAR } JoxListChange;

/* Side effects of entering a state or taking a transition. What is told and what memory is set to
   is evaluated on what was before any of it. */
typedef struct JoxActions {
    struct JoxAssign {
        int32_t slot; /* memory slot */
        JoxValue value;
        int16_t target;       /* somebody, in place of `value`; -1: none */
        JoxListChange change; /* of a list: what is done with the value */
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
    uint16_t
        to; /* next state; its own for a reaction; with `back`: if there is none to go back to */
    bool stays;    /* it is a reaction */
    bool back;     /* leads to the state that was left for the present one */
    uint8_t level; /* number of outer states around the state that lists it, which it leaves */
    uint16_t item; /* its number in that state's list, from 0 */
    JoxActions does;
    int32_t when;      /* index of an expression; -1: always (unless when_hook) */
    int32_t when_hook; /* index of a Lua function; -1 none */
    int32_t rests;     /* the expression on whose messages it rests: `when`, or the condition that
                          the function extends; -1: none */
    JoxValue chance;   /* UNSET: certain */
    int32_t on_take;   /* hook or -1 */
    int32_t line;
    uint16_t source; /* index of the line's file in the machine's `files` */
} JoxTransition;

/* Greatest number of outer states around a state. */
enum { JOX_MOST_LEVELS = 3 };

/* A state. An outer state runs a machine of its own; agents are in the states of that machine,
   never in the outer state itself. States inherit from the outer states around them: their
   transitions come first, outermost first, and what a state does not set. */
typedef struct JoxState {
    char *name;                       /* of a state within an outer one: "Guard.Walk" */
    uint8_t depth;                    /* number of outer states around it */
    uint16_t around[JOX_MOST_LEVELS]; /* their indices in JoxMachine.outer, outermost first */
    uint16_t start;                   /* for an outer state: where its machine begins */
    bool ends;                        /* the machine that has this state ends in it */
    uint8_t done;         /* bit per level of an outer state around it: its machine has ended */
    int8_t goal_level;    /* level of the state from which it has a target "one of" */
    uint32_t came_from;   /* 1 + slot of memory that holds 1 + index of the state that was left for
                             this one (0: none); 0: no transition leads back from it */
    JoxColour colour;     /* colour of its agents in pictures */
    uint32_t name_number; /* number of the name in the set of machines; assigned when the
                             machine is added */
    uint32_t also[9];     /* numbers of its other names, with `:in_state`: "Guard", "Walk" */
    uint8_t also_count;
    uint32_t first_transition; /* number of its first transition, counted over all states; assigned
                                  likewise */
    JoxValue param[JOX_PARAM_COUNT]; /* UNSET: inherits the machine's default, then the engine's */
    uint64_t sets; /* parameters that it sets itself, a bit each; others in `param` are inherited */
    JoxSteerTerm steer[JOX_MOST_TERMS]; /* behind a FUNCTION: terms of the steering it extends */
    uint32_t steer_count;
    JoxTransition *transitions;
    uint32_t transition_count;
    bool has_lasts;
    JoxDist lasts;            /* s, drawn on entry */
    int32_t lasts_expression; /* expression for it, evaluated on entry; -1 none */
    bool removes;             /* agents that enter leave the world */
    bool lies;                /* agents are drawn lying down; no step reads it */
    uint8_t pose;             /* JOX_POSE_*: how agents are drawn; no step reads it */
    int32_t push_when;        /* expression; -1 always */
    int16_t push_toward;      /* target; -1: along the preferred velocity */
    bool push_nearest;        /* push_weight "nearest" instead of "equal" */
    int16_t face, approach;   /* targets; -1 none */
    int16_t stays_in;         /* target: place that the agent does not leave; -1 none */
    uint64_t ignore, push_only;
    int16_t kick, kick_at; /* targets; -1 none */
    JoxValue kick_impulse; /* N s per kg of the body: the velocity change, m/s */
    JoxValue kick_speed;   /* speed after the kick, m/s; UNSET: kick_impulse holds */
    JoxValue kick_lift;    /* angle above the horizontal, degrees; UNSET: 0 */
    int16_t take;          /* target: body to pick up when within reach; -1 none */
    int16_t drop;          /* target: body to put down; -1 none */
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
    uint32_t general; /* 1 + slot of the own value of which this is the default within an outer
                        state; 0: none */
    bool kept;        /* carried over from an earlier version; this version does not
                         read it */
    bool declared;    /* in the machine's `own`: no group need set it */
    uint32_t nest;    /* while it is built: number of the machine that declares it */
    int32_t line, column, end_column; /* first use of own.NAME in the source; 0 unknown */
    uint32_t source;                  /* index of that file in the machine's `files` */
} JoxOwnSlot;

typedef enum {
    JOX_MEMORY_NUMBER,
    JOX_MEMORY_BOOLEAN,
    JOX_MEMORY_SOMEBODY, /* a person, body or place: see JOX_WHO_BODY */
    JOX_MEMORY_LIST,     /* length of a list of numbers */
    JOX_MEMORY_PEOPLE,   /* length of a list of persons, bodies and places */
    JOX_MEMORY_STATE,    /* 1 + index of a state, 0: none; hidden slots alone */
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
/* Prefixes of the identities of hidden slots of nested machines: state that was left for the named
   one; tick at which the outer state on a level was entered, and its duration, s. */
#define JOX_IDENTITY_CAME_FROM "\6"
#define JOX_IDENTITY_CLOCK "\7"
#define JOX_IDENTITY_LASTS "\10"
/* Prefix of the identities of hidden slots of ways (lead.c), before their number. */
#define JOX_IDENTITY_LEAD "\11"
#define JOX_IDENTITY_ITEM "\13"
/* Greatest number of dormant slots of a machine, memory that no name refers to any more; beyond it
   the oldest are dropped. */
enum { JOX_MOST_DORMANT = 64 };

typedef struct JoxMemorySlot {
    char *name;     /* "" for hidden slots */
    char *identity; /* hidden slots: key by which a later version finds the slot again; else NULL */
    bool dormant;   /* hidden because this version lacks a name that an earlier one had */
    JoxMemoryKind kind;
    double initial;
    uint32_t capacity, items; /* for a list: greatest length, and the slot of its first item */
    bool is_public;           /* other machines may read it */
    uint32_t name_number;     /* number of the name in the set of machines, if is_public */
    bool unset; /* a number that the machine reads and never sets; a scene may give it a value */
    int32_t line, column, end_column; /* if unset: where it is declared; 0 unknown */
    uint32_t source;                  /* index of that file in the machine's `files` */
} JoxMemorySlot;

/* circuits: net counter-clockwise turns about `target` since the agent first crossed its start line
   (without one: since it was spawned). Uses memory slots value, turned angle (rad) and begun
   (0/1). */
typedef struct JoxCounter {
    int16_t target;
    int32_t value, angle, begun;
    int32_t state; /* state in which it counts; -1: all states; else -2 - index of an outer state */
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
    JoxState *outer; /* states that run a machine, those around others before them */
    uint32_t outer_count;
    uint32_t clock[JOX_MOST_LEVELS]; /* per level: 1 + memory slot of the clock of the outer states
                                        on it; 0: none */
    uint32_t lasting[JOX_MOST_LEVELS]; /* likewise of their drawn durations */
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
/* Greatest capacity of a list in memory. Items have identities of two characters before the name,
   JOX_IDENTITY_ITEM and 'a' + their number. */
enum { JOX_MOST_ITEMS = 16 };
static inline bool jox_memory_is_list(const JoxMemorySlot *slot) {
    return slot->kind == JOX_MEMORY_LIST || slot->kind == JOX_MEMORY_PEOPLE;
}
/* Returns the name of the memory to which a hidden slot belongs, by its identity; NULL if the
   identity is not that of a hidden slot. */
static inline const char *jox_identity_owner(const char *identity) {
    if (*identity == *JOX_IDENTITY_ITEM && identity[1])
        return identity + 2;
    return *identity && *identity <= JOX_LAST_IDENTITY ? identity + 1 : NULL;
}
/* Returns the index of an outer state by name, or -1. */
int jox_machine_outer(const JoxMachine *machine, const char *name);
/* Returns the state that agents enter by this name: the state itself, or the one in which an outer
   state's machine begins; -1: none. */
int jox_machine_entry(const JoxMachine *machine, const char *name);
/* Returns the state on a level: the outer state around `state`, or `state` itself. */
static inline const JoxState *jox_state_on_level(const JoxMachine *machine, const JoxState *state,
                                                 uint32_t level) {
    return level < state->depth ? &machine->outer[state->around[level]] : state;
}
/* Returns the state that sets a parameter of `state`: itself or an outer state around it; NULL if
   defaults do. */
const JoxState *jox_parameter_setter(const JoxMachine *machine, const JoxState *state, int p);
/* Returns whether a state is within an outer state, whose level is given. */
static inline bool jox_state_is_within(const JoxState *state, uint32_t level, uint32_t outer) {
    return state->depth > level && state->around[level] == outer;
}
/* Returns whether a state has this name, or is within an outer state that has it. */
bool jox_state_is_in(const JoxState *state, const char *name);
/* Returns whether `:in_state` means a state by this name: its whole name, or parts of it. */
bool jox_state_answers(const JoxState *state, const char *name);
/* Returns the name of the state to which a transition leads; "back" if the agent's past decides. */
const char *jox_transition_leads_to(const JoxMachine *machine, const JoxTransition *t);
/* Returns whether a state is a step of a sequence: one of those beside it has a number as its name,
   "2 wait". */
bool jox_state_is_step(const JoxMachine *machine, const JoxState *state);
/* Returns the first state within an outer state, by its index. */
const JoxState *jox_first_state_within(const JoxMachine *machine, uint32_t outer);
/* Writes the path of a state's table: "states.Guard.runs.states.Walk". */
void jox_state_path(const JoxState *state, char path[256]);
/* Returns whether a counter counts in a state. */
bool jox_counter_counts(const JoxMachine *machine, const JoxCounter *counter, uint32_t state);
/* Returns the memory slot of a name, or -1; slots without a name are never found. */
int32_t jox_machine_memory(const JoxMachine *machine, const char *name);
/* Gives a machine that no set has yet an own value for a rare parameter, so that groups can set it;
   has no effect if it has one, or computes the parameter. */
void jox_machine_own_parameter(JoxMachine *machine, JoxParameter parameter);
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
/* Returns whether condition `when`, -1: none, asks for messages. */
bool jox_asks_for_messages(const JoxMachine *machine, int32_t when);
/* Frees the machine with everything it owns (made by jox_alloc / jox_strdup). */
void jox_machine_free(JoxMachine *machine);

#endif
