/* Targets as data: what a machine may refer to for each agent, and somebody as a number. machine.h
   includes it; target.c resolves targets. */
#ifndef JOX_MACHINE_TARGET_KINDS_H
#define JOX_MACHINE_TARGET_KINDS_H

#include <stdbool.h>
#include <stdint.h>

typedef enum JoxTargetKind {
    JOX_TARGET_PLACE,      /* arg: index of the place in the world, -1 while unresolved */
    JOX_TARGET_OWN_PLACE,  /* arg: own slot that holds a place index */
    JOX_TARGET_GOAL,       /* the place in the agent's `goal` column */
    JOX_TARGET_ONE_OF,     /* arg: place index of a set; on entering the state, goal := a member */
    JOX_TARGET_ONE_OF_OWN, /* like ONE_OF; arg: own slot that holds the set */
    JOX_TARGET_BEST_PLACE, /* arg: place index of a set; its member with the greatest score */
    JOX_TARGET_BEST_OWN,   /* like BEST_PLACE; arg: own slot that holds the set */
    JOX_TARGET_NEAREST,    /* arg: tag bit; nearest seen body or agent with that tag */
    JOX_TARGET_OPPONENT,   /* nearest seen agent of another team */
    JOX_TARGET_TEAMMATE,   /* nearest seen agent of the same team */
    JOX_TARGET_ANYONE,     /* nearest seen agent */
    JOX_TARGET_MEMORY,     /* arg: slot of memory that holds somebody */
    JOX_TARGET_HOLDING,    /* the body that the agent carries, else the agent that it holds on to */
    JOX_TARGET_STRIKER,    /* the agent that kicked or threw the body which hit this one in the last
                              step, else the body */
    JOX_TARGET_OTHER,      /* in the score of a target: the candidate */
    JOX_TARGET_MESSAGE,    /* arg: name of a message; who told it, or its value `field` */
    JOX_TARGET_ITEM,       /* arg: slot of a list; its first item, or with `field` 1 its last */
    JOX_TARGET_NOBODY,     /* never there */
    JOX_TARGET_HOME,       /* the agent's own post: the position at which it entered the world */
    JOX_TARGET_LAST_SEEN   /* arg: index of a sighting; the point where the agent last saw it */
} JoxTargetKind;

/* Returns whether a target of this kind is a person or a body, or may be one; others are places and
   points. */
static inline bool jox_target_kind_moves(JoxTargetKind kind) {
    return kind >= JOX_TARGET_NEAREST && kind <= JOX_TARGET_NOBODY;
}
/* Returns whether a target of this kind chooses among those that the agent sees. */
static inline bool jox_target_kind_chooses(JoxTargetKind kind) {
    return kind >= JOX_TARGET_NEAREST && kind <= JOX_TARGET_ANYONE;
}
/* Returns whether a target of this kind is a place, or may be one. */
static inline bool jox_target_kind_is_place(JoxTargetKind kind) {
    return kind < JOX_TARGET_NEAREST || kind == JOX_TARGET_MEMORY;
}

/* Somebody as a number, which memory holds: nobody; 1 + id of an agent; JOX_WHO_BODY + id of a
   body; JOX_WHO_PLACE + index of a place. Neither ids of agents nor of bodies are used twice. */
#define JOX_NOBODY 0.0
#define JOX_WHO_BODY 8589934592.0   /* 2^33 */
#define JOX_WHO_PLACE 17179869184.0 /* 2^34 */

/* Filter on the agents and bodies that a target accepts. All zero accepts all. */
typedef struct JoxAgentFilter {
    bool some; /* whether a condition on names or memory applies, which no body meets */
    int16_t state, machine, memory; /* indices into the machine's names; -1: any */
    int32_t group;                  /* number of the scene's group; -1: any */
    double least, greatest;         /* accepted range of the memory value */
    bool flies;                     /* bodies in the air alone, and no agents */
    bool fallen;                    /* agents that lie after a fall alone */
    float comes;  /* m: what passes within this distance alone (jox_pass_distance); 0: anything */
    float within; /* m: what is nearer than this alone; 0: any distance */
    float ahead;  /* degrees: what lies within this angle of where the agent looks alone; 0: any
                     direction */
} JoxAgentFilter;

typedef struct JoxTarget {
    JoxTargetKind kind;
    int32_t arg;
    char *name; /* as written: place, own, or tag name */
    JoxAgentFilter filter;
    int16_t field; /* MESSAGE: name of a value; -1: the sender */
    int32_t score; /* 1 + expression by which the best of those seen is chosen; 0: the nearest */
} JoxTarget;

#endif
