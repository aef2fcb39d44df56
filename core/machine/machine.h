/* A state machine as data: states, their parameters, their ordered transitions, and the expressions
   that their conditions and computed numbers are compiled to. lua/ builds it; it is immutable
   from when it is added to a set (run.h), except that run/ links it to those that it becomes. Think
   and prefer run it. Knows no Lua. */
#ifndef JOX_MACHINE_MACHINE_H
#define JOX_MACHINE_MACHINE_H

#include <stdbool.h>
#include <stdint.h>

#include "agents/parameters.h"
#include "base/format/colour.h"
#include "base/number/distribution.h"

enum { JOX_MOST_TRANSITIONS = 32, JOX_MOST_REGISTERS = 32, JOX_MOST_TERMS = 8 };
/* Greatest weight of a steering term, of either sign. */
enum { JOX_MOST_WEIGHT = 1000000 };
/* Greatest figure of a drift, of either sign, in wanted speeds. */
enum { JOX_MOST_DRIFT = 100 };
/* N: with which somebody is held on to, where a state does not say; and at most. */
enum { JOX_GRIP = 300, JOX_MOST_GRIP = 5000 };

#define JOX_LOAD_MEANING                                                                           \
    "greatest push borne from any one direction: over directions d, the greatest sum of the "      \
    "positive parts of f.d over its contacts f"

/* What is measured of the agent itself. A row is all there is to one: its name (`now.NAME`), its
   unit, what it means, and its value for agent `i` of a run, whose columns are `a`. Those of
   JOX_MEASURED_WORDS are also words by themselves, given in the second place. */
/* clang-format off */
#define JOX_MEASURED_WORDS(X)                                                                      \
    X(density, density_here, "1/m2",                                                               \
      "people per square metre about the agent, from its neighbours' distances", a->density[i])    \
    X(headway, headway, "m",                                                                       \
      "free way ahead to the neighbour in it who does not come the other way; perception where "   \
      "nobody is", jox_headway(run, i))                                                            \
    X(eagerness, eagerness, "",                                                                    \
      "how eager the agent is to get on, 0 to 1: the crowd about it raises it, within the bounds " \
      "of `haste`", a->eager[i])                                                                   \
    X(pushed, pushed, "N", "magnitude of the net force on the agent",                              \
      jox_length((JoxV2){a->force_x[i], a->force_y[i]}))                                           \
    X(compression, compression, "N/m", "sum of contact force magnitudes over circumference",       \
      a->compression[i])                                                                           \
    X(load, load, "N", JOX_LOAD_MEANING, a->load[i])                                               \
    X(contacts, contacts, "", "agents and bodies touched", a->contacts[i])                         \
    X(holders, holders, "", "agents that hold on to the agent (see `grasp`)", a->held[i])                \
    X(time_in_state, time_in_state, "s", "since the state was entered", jox_time_in_state(run, i))
#define JOX_MEASURED_OTHERS(X)                                                                     \
    X(speed, , "m/s", "present speed", jox_length((JoxV2){a->vx[i], a->vy[i]}))                    \
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
   agent itself. x / 0 is 0.
   CLAMP: a within [b, c]. DISTANCE: metres from the agent's centre to the target, infinite when
   absent. PLACE_DENSITY, PLACE_COUNT: people in place (a polygon, else a disc of 2 m about it).
   INSIDE: target is in place. NEAR: target is nearer than a metres. CROSSES: the last move crossed
   line `place` from its right to its left. FIRST_IN: the agent heads its queue. AFTER: time in
   state is at least a. LASTED: it has reached the drawn duration. STUCK: has not moved 0.25 m for a
   seconds. TOUCHES: the gap to target is below 0.05 m. GROUNDED: target, a body, touches the
   ground. KICKED: the agent kicked target, or what bears its tag, in the last step. HIT_BY: target,
   faster than 1 m/s, touches the agent, or such a body hit it in the last step. INCOMING: target,
   as it moves, comes within a metres during the next 2 s. SEES: target exists within perception.
   HAS: the agent holds target, a body or an agent. HEARD: another agent within perception, and
   within a metres, gave the signal `name` in the last step. NEIGHBOURS: how many of them are what
   target asks for. THEIRS: what the agent that target is remembers as `name`, if its machine makes
   that public; else 0. SHUT: a gate at place stands, and the agent sees it. QUEUED: how many stand
   in the queue `place`. OPEN: the gates called `name` are open. Whom a wall hides is not seen,
   heard or touched. */
/* clang-format off */
#define JOX_OPS(X)                                                              \
    X(CONST) X(NOW) X(OWN) X(MEMORY)                                            \
    X(ADD) X(SUB) X(MUL) X(DIV) X(MIN) X(MAX) X(NEG) X(ABS) X(SQRT) X(CLAMP)    \
    X(GT) X(GE) X(LT) X(LE) X(EQ) X(AND) X(OR) X(NOT)                           \
    X(DISTANCE) X(PLACE_DENSITY) X(PLACE_COUNT)                                 \
    X(INSIDE) X(NEAR) X(CROSSES) X(FIRST_IN) X(AFTER) X(LASTED) X(STUCK)        \
    X(TOUCHES) X(GROUNDED) X(KICKED) X(HIT_BY) X(INCOMING) X(SEES)              \
    X(HAS) X(HEARD) X(NEIGHBOURS) X(THEIRS) X(SHUT)                             \
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
    uint16_t skip; /* this many of those that follow change nothing where `to` is 0 for all */
    int32_t arg;
    double number;
} JoxInstruction;

/* A compiled condition or number: straight-line code that leaves its result in register 0. Parts of
   it may be skipped: the right side of an AND where its left side holds for nobody. */
typedef struct JoxExpression {
    JoxInstruction *code;
    uint32_t count;
} JoxExpression;

typedef enum JoxTargetKind {
    JOX_TARGET_PLACE,      /* arg: place index of the world, -1 while unresolved */
    JOX_TARGET_OWN_PLACE,  /* arg: own slot that holds a place index */
    JOX_TARGET_GOAL,       /* the place in the agent's `goal` column */
    JOX_TARGET_ONE_OF,     /* arg: place index of a set; on entering the state, goal := a member */
    JOX_TARGET_ONE_OF_OWN, /* the same; arg: own slot that holds the set */
    JOX_TARGET_NEAREST,    /* arg: tag bit; nearest seen body or agent that bears it */
    JOX_TARGET_OPPONENT,   /* nearest seen agent of another team */
    JOX_TARGET_TEAMMATE,   /* nearest seen agent of the same team */
    JOX_TARGET_ANYONE,     /* nearest seen agent */
    JOX_TARGET_HOME        /* the agent's own post: where it came in */
} JoxTargetKind;

/* Whom of the agents that a target asks for it means. Zero: all of them. */
typedef struct JoxWhose {
    bool some;                      /* whether anything of the following is asked */
    int16_t state, machine, memory; /* indices into the machine's names; -1: any */
    int32_t group;                  /* number of the scene's group; -1: any */
    double least, greatest;         /* of what memory holds */
} JoxWhose;

typedef struct JoxTarget {
    JoxTargetKind kind;
    int32_t arg;
    char *name; /* as written: place, own, or tag name */
    JoxWhose whose;
} JoxTarget;

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
    int32_t line;    /* where it was set; 0 default; JOX_LINE_LIVE: by a person, in a run */
    uint16_t source; /* number of the machine's file that the line is of */
} JoxValue;
enum { JOX_LINE_LIVE = -1 };

typedef enum JoxSteerKind {
    JOX_STEER_HOLD, /* stand still */
    JOX_STEER_SEEK, /* to the nearest point of target (a line, gate: to a point drawn per agent) */
    JOX_STEER_AWAY_FROM, /* straight away from target */
    JOX_STEER_ORBIT,     /* round a place counter-clockwise; args: see JoxOrbitArg */
    JOX_STEER_QUEUE,     /* to the agent's place in the queue */
    JOX_STEER_FOLLOW,    /* behind target, args[0] metres */
    JOX_STEER_DRIFT,     /* along the vector `drift` */
    JOX_STEER_SPREAD,    /* away from the neighbours' centroid */
    JOX_STEER_EVADE,     /* sideways, out of the way of those who come towards */
    JOX_STEER_ALONG,     /* along a line's direction or a queue's polyline towards its head */
    JOX_STEER_FIELD,     /* the shortest way to a place round walls */
    JOX_STEER_TOGETHER,  /* towards the mates that are seen, once they are farther than args[0] m */
    JOX_STEER_WANDER,    /* about, turning gradually; within target, if that is given */
    JOX_STEER_FORMATION, /* to the agent's place in a row: along a line, or behind somebody across
                            the way they look; args[0] metres apart */
    JOX_STEER_GATHER,    /* to the agent's spot among those who wait in a polygon, which they fill
                            from its front: towards args[0] degrees */
    JOX_STEER_PLAYER,    /* as the input log says; holds while it says nothing */
    JOX_STEER_FUNCTION   /* hook: a Lua function returns the velocity */
} JoxSteerKind;

/* Guidance round a solid (see prefer.h): inward weight and the density profile it follows. */
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

/* What entering a state or taking a transition does besides. */
typedef struct JoxActions {
    struct JoxAssign {
        int32_t slot; /* of memory */
        JoxValue value;
    } * set;
    uint32_t set_count;
    int16_t signal; /* name that is called out; -1 none */
    bool sets_team, sets_tags;
    uint16_t team; /* that it is in from then on */
    uint64_t tags; /* that it bears from then on, a bit each */
} JoxActions;

typedef struct JoxTransition {
    char *id;
    uint16_t to;
    JoxActions does;
    int32_t when;      /* expression; -1: always (unless when_hook) */
    int32_t when_hook; /* a plain function; -1 none */
    JoxValue chance;   /* UNSET: certain */
    int32_t on_take;   /* hook or -1 */
    int32_t line;
    uint16_t source; /* number of the machine's file that the line is of */
} JoxTransition;

typedef struct JoxState {
    char *name;
    JoxColour colour;          /* of who is in it, in pictures */
    uint32_t name_number;      /* of the names that machines share; set when it is added to a set */
    uint32_t first_transition; /* number of its first among all transitions; likewise */
    JoxValue param[JOX_PARAM_COUNT]; /* UNSET: inherits the machine's default, then the engine's */
    JoxSteerTerm steer[JOX_MOST_TERMS];
    uint32_t steer_count;
    JoxTransition *transitions;
    uint32_t transition_count;
    bool has_lasts;
    JoxDist lasts;            /* s, drawn on entry */
    int32_t lasts_expression; /* or an expression evaluated on entry; -1 none */
    bool removes;             /* the agent leaves the world on entering */
    bool lies;                /* it is shown as lying; no step reads it */
    int32_t push_when;        /* expression; -1 always */
    int16_t push_toward;      /* target; -1: along the preferred velocity */
    bool push_nearest;        /* push_weight "nearest" instead of "equal" */
    int16_t face, approach;   /* targets; -1 none */
    uint64_t ignore, push_only;
    int16_t kick, kick_at; /* targets; -1 none */
    JoxValue kick_impulse; /* N s per kg of the body: the velocity change, m/s */
    int16_t take;          /* body that is picked up where it is in reach; -1 none */
    int16_t toss, toss_at; /* body that is thrown, and whereto; -1 none */
    JoxValue toss_speed;   /* level speed of the throw, m/s */
    int16_t grasp;         /* agent that is held on to where it is in reach; -1 none */
    JoxValue grip;         /* the greatest force of that, N; UNSET: JOX_GRIP */
    JoxActions enters;
    double signal_every;    /* s between two calls of enters.signal while in the state; 0: one */
    char *become;           /* behaviour whose machine the agent goes on with; NULL none */
    int32_t become_machine; /* its index, once known; -1 */
    char *become_file;      /* where it is written: of the machine, or of a mod */
    int32_t become_line, become_column;
    int32_t on_enter, on_exit; /* hooks; -1 none */
    int32_t line;
    uint16_t source; /* number of the machine's file that the line is of */
} JoxState;

typedef struct JoxOwnSlot {
    char *name;   /* "speed", "court"; "" for a distribution written in a state */
    JoxDist dist; /* drawn once per agent; groups may override it by name */
    bool is_place;
    bool kept;                        /* of an earlier version: this one does not look at it */
    bool declared;                    /* in the machine's `own`: no group need set it */
    int32_t line, column, end_column; /* where own.NAME was first written; 0 unknown */
    uint32_t source;                  /* number of its file among the machine's files */
} JoxOwnSlot;

typedef enum { JOX_MEMORY_NUMBER, JOX_MEMORY_BOOLEAN } JoxMemoryKind;
/* Before the name of the memory that a counter counts in: identities of its hidden slots. */
#define JOX_IDENTITY_ANGLE "\1"
#define JOX_IDENTITY_BEGUN "\2"
/* Slots that nothing names any more and that are kept, of a machine; the oldest are dropped beyond
 * it. */
enum { JOX_MOST_DORMANT = 64 };

typedef struct JoxMemorySlot {
    char *name; /* "" for hidden slots */
    char *
        identity; /* of hidden slots: what a version that comes later takes them up by; else NULL */
    bool dormant; /* hidden, as this version lacks the name that an earlier one had */
    JoxMemoryKind kind;
    double initial;
    bool is_public;       /* other machines may read it */
    uint32_t name_number; /* of the names that machines share, where it is public */
} JoxMemorySlot;

/* circuits: net counter-clockwise turns about `target` since its start line was first crossed (or
   since spawn, without one). Uses memory slots value, turned angle (rad) and begun (0/1). */
typedef struct JoxCounter {
    int16_t target;
    int32_t value, angle, begun;
    int32_t state; /* counts in this state only; -1 in all */
} JoxCounter;

/* Names that machines share: signals, and what others are asked for: states, machines, memory. */
typedef enum {
    JOX_NAME_STATE = 1,
    JOX_NAME_SIGNALLED = 2,
    JOX_NAME_HEARD = 4,
    JOX_NAME_MACHINE = 8,
    JOX_NAME_MEMORY = 16,
    JOX_NAME_GATE = 32
} JoxNameUse;
typedef struct JoxName {
    char *text;
    uint32_t uses;   /* of JoxNameUse */
    uint32_t number; /* equal for equal texts in all machines of a set; set when it is added */
    int32_t line, column, end_column; /* where a state or memory was first written; 0 unknown */
    uint32_t source;                  /* number of its file among the machine's files */
} JoxName;

/* A tag or team that a machine names. Those that the scene has keep their number; another gets one
   when the machine is put into a run, until when `number` is what it was compiled with. */
typedef struct JoxBelonging {
    char *name;
    bool is_team;
    bool is_set, is_asked; /* a state gives it to its agents; a target or a parameter asks for it */
    uint16_t number;       /* bit of the tag; number of the team */
    int32_t line, column, end_column; /* where it was first written; 0 unknown */
    uint32_t source;                  /* number of its file among the machine's files */
} JoxBelonging;

/* Numbers of teams that no group has, and states set. */
enum { JOX_MOST_SET_TEAMS = 64, JOX_FIRST_SET_TEAM = 65536 - JOX_MOST_SET_TEAMS };

typedef struct JoxMachine {
    char *name, *path;
    char **files; /* paths of all files that it was made of, `path` first; may be none */
    uint32_t file_count;
    double version;   /* the author's; NaN: the file has none */
    uint32_t reloads; /* machines that it replaced, one after the other */
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
    uint32_t home; /* memory of the agent's own post, x and y behind it, plus 1; 0: not asked for */
    uint32_t name_number; /* of its own name; set when it is added to a set */
    JoxCounter *counters;
    uint32_t counter_count;
    JoxName *names;
    uint32_t name_count;
    JoxBelonging *belongings; /* tags and teams that it names */
    uint32_t belonging_count;
    struct JoxRenamed {
        char *from, *to;
    } * renamed; /* states, own values and memory of older versions */
    uint32_t renamed_count;
    uint32_t hook_count;
    bool views;    /* hooks look at other agents: as they were before the step */
    bool headings; /* it asks where others headed in the step before; set when it is put in a set */
    int32_t vm;    /* which Lua state owns the hooks; -1 none */
} JoxMachine;

/* Gives tags and teams other numbers: numbers[n] is that of belongings[n]. Of a machine that does
   not run yet. */
void jox_machine_renumber(JoxMachine *machine, const uint16_t *numbers);

/* The file that a line of the machine is of. */
static inline const char *jox_machine_file(const JoxMachine *machine, uint32_t source) {
    return source < machine->file_count ? machine->files[source] : machine->path;
}

/* A state, and a transition, that do nothing yet: every index is -1. The names are taken over. */
JoxState jox_state_blank(char *name);
JoxTransition jox_transition_blank(char *id);
/* Index of a state by name, or -1. */
int jox_machine_state(const JoxMachine *machine, const char *name);
/* What a slot goes on as in a later version: its name, or the identity of a hidden one. */
static inline const char *jox_memory_identity(const JoxMemorySlot *slot) {
    return *slot->name ? slot->name : slot->identity ? slot->identity : "";
}
/* Slot of its memory by name, or -1; slots without a name have none. */
int32_t jox_machine_memory(const JoxMachine *machine, const char *name);
/* What of a machine others name. */
typedef enum { JOX_PART_STATE, JOX_PART_OWN, JOX_PART_MEMORY } JoxPart;
/* Whether it has a part of this name. */
bool jox_machine_has(const JoxMachine *machine, JoxPart part, const char *name);
/* What it calls the part now that was called `name`, which it has no longer; else NULL. */
const char *jox_machine_renamed(const JoxMachine *machine, JoxPart part, const char *name);
enum { JOX_VERSION_TEXT = 64 };
/* Writes what messages call the text that a machine was made of: "version 10 (reload 3)", without
   what it lacks; a first text without a version is "the first version". Returns `out`. */
const char *jox_machine_version(const JoxMachine *machine, char out[JOX_VERSION_TEXT]);
/* Frees the machine with all it owns (everything was made by jox_alloc / jox_strdup). */
void jox_machine_free(JoxMachine *machine);

#endif
