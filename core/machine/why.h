/* Why transitions do not fire: the condition of each as a tree of terms with their values and
   bounds, and how far each is from holding. Nothing here changes the run. The world opens a look
   (world/behaviour_look.h), in which the agents sense what the next step's think will sense; within
   it these functions may be called for any agent. run/why/ makes text and JSON of the result. */
#ifndef JOX_MACHINE_WHY_H
#define JOX_MACHINE_WHY_H

#include "machine/run.h"

#define JOX_WHY_NONE UINT32_MAX

/* How far a term is from holding: the number of its terms that would have to change, and the sum of
   their distances, each from 0 (nearly there) to 1. Both 0: it holds. */
typedef struct JoxWhyGap {
    uint32_t misses;
    double far;
} JoxWhyGap;

typedef enum JoxWhyKind {
    JOX_WHY_ALL, /* holds if all of its inputs hold */
    JOX_WHY_ANY, /* holds if one of its inputs holds */
    JOX_WHY_WORD /* a comparison, a word, memory: has no inputs */
} JoxWhyKind;

typedef struct JoxWhyTerm {
    JoxWhyKind kind;
    uint32_t first, next; /* index of its first input, and of the next input of what it is an
                             input of; JOX_WHY_NONE: none */
    bool holds;
    bool negated;  /* under an odd number of `not` */
    bool is_infix; /* a comparison, written with its sign in the middle */
    bool beats;    /* holds every so many seconds, for one step */
    JoxWhyGap gap; /* from holding */
    JoxText text;  /* a word as written, with `not` where it is negated; else empty */
    JoxText note;  /* what there is instead, as "the nearest is agent 12, 7.3 m away"; may be
                      empty */
    /* A number that is compared with a bound: holds if `value relation bound`. */
    bool measured;
    double value, bound;
    const char *relation; /* "<", ">=", "is", "is not", ... */
    const char *unit;     /* "m"; "" unknown or none */
} JoxWhyTerm;

/* What is known of the chance of a transition. */
typedef enum JoxWhyChance {
    JOX_WHY_CERTAIN, /* it has none */
    JOX_WHY_TO_ROLL, /* rolled when its condition next becomes true */
    JOX_WHY_LOST     /* rolled when the condition became true, and lost: rolled again only after the
                        condition has been false */
} JoxWhyChance;

/* Why one transition of an agent's present state does not fire, or that it will. */
typedef struct JoxWhyTransition {
    uint32_t index; /* in the state */
    uint16_t to;    /* state to which it leads this agent; for `back` the one that it left */
    JoxWhyTerm *terms;
    uint32_t count, root; /* root JOX_WHY_NONE: no condition, or a function */
    size_t capacity;
    bool is_function; /* its condition is a plain function, whose last result is `held_before` */
    bool holds;       /* of a compiled condition: now */
    bool held_before; /* in the last think of this state */
    bool fires;       /* it would be taken in the next step, if none before it is */
    JoxWhyGap gap;
    JoxWhyChance chance;
    double chance_value;
} JoxWhyTransition;

/* Explains transition `index` of the present state of an agent, within a look. Free it by
   jox_why_free. */
void jox_why_transition(const JoxMachineRun *run, uint32_t agent, uint32_t index,
                        JoxWhyTransition *out);
void jox_why_free(JoxWhyTransition *transition);
/* why_deeds.c: appends the steering of a state, without weights: "field(mine.who) + spread". */
void jox_why_spell_steering(const JoxMachine *machine, const JoxState *state, JoxText *out);
/* Appends a line for the steering of an agent's state that has a target, "steering:
   seek(ball): body 'ball', 1.5 m away", and a line for each action that something keeps from its
   target, "take ball: ... beyond the reach of 0.6 m". Within a look. Returns whether something does
   not work. */
bool jox_why_add_deeds(const JoxMachineRun *run, uint32_t agent, JoxText *out);
/* Appends how an agent uses a lift, and what its car does, in words; nothing if it uses none. */
void jox_why_add_ride(const JoxMachineRun *run, uint32_t agent, JoxText *out);
/* Appends a message in words: "'shot' of agent 3, told at 2.30 s, damage 2". */
void jox_why_add_message(const JoxMachineRun *run, const JoxMessage *message, JoxText *out);
/* Returns whether gap `a` is less than gap `b`. */
static inline bool jox_why_is_nearer(JoxWhyGap a, JoxWhyGap b) {
    return a.misses != b.misses ? a.misses < b.misses : a.far < b.far;
}

/* A look at the machines between two steps: what it replaces of the run. */
typedef struct JoxMachineLook {
    const JoxNeighbours *neighbours;
    uint32_t tick;
    JoxV2 *heading;
    JoxMachineState *state;
    JoxMachineState delivered; /* the state, after messages that were sent have been delivered */
    uint32_t lost_name_count;
    uint32_t watched_count;
    size_t notes;
} JoxMachineLook;
/* Begins a look: makes signals, messages, states, places and queues known as the think at `tick`
   will know them; changes scratch alone. The world has set the inputs of the run before. */
void jox_machines_look(JoxMachineRun *run, JoxPool *pool, const JoxNeighbours *neighbours,
                       uint32_t tick, JoxMachineLook *before);
void jox_machines_end_look(JoxMachineRun *run, JoxMachineLook *before);

#endif
