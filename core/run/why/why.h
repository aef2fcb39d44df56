/* Why agents stay in their states: every transition out of a state with the terms of its condition,
   nearest to holding first; for one agent, or for many in one state. Text for people and JSON for
   programs are made from the same structures. Called by jo_scene_why, the live page and tests of
   behaviours. */
#ifndef JOX_RUN_WHY_WHY_H
#define JOX_RUN_WHY_WHY_H

#include "base/format/json_writer.h"
#include "run/run.h"
#include "world/behaviour_look.h"

/* One agent that is explained. */
typedef struct JoxWhyAgent {
    uint32_t agent; /* index */
    const JoxMachine *machine;
    const JoxState *state;
    double since, now;         /* s of simulated time: entry of the state; the present */
    const JoxWatched *watched; /* record of its past; NULL: it is not watched */
    JoxWhyTransition transitions[JOX_MOST_TRANSITIONS]; /* in the order of the state */
    uint32_t order[JOX_MOST_TRANSITIONS];               /* nearest to firing first */
    JoxText deeds; /* lines on what its state does (jox_why_add_deeds) */
    /* States on the shortest way from its own to a state that is asked for; way_count 0: none is
       asked for, or no way leads there. Transitions to way[1] alone are shown. */
    const char *to; /* state that is asked for; NULL: none */
    uint16_t *way;
    uint32_t way_count;
} JoxWhyAgent;

/* Explains an agent with a machine, within a look; `to`: the transitions to this state, or into
   this outer state, or to the next state on the shortest way there; NULL: all. Free it by
   jox_why_agent_free. */
void jox_why_agent(JoScene *scene, JoxBehaviourLook *look, uint32_t agent, const char *to,
                   JoxWhyAgent *out);
/* Returns whether a transition of the agent's state is among those that are asked for. */
bool jox_why_is_asked(const JoxWhyAgent *why, uint32_t transition);
void jox_why_agent_free(JoxWhyAgent *why);
/* Returns how many items of a state are transitions, and no reactions. */
uint32_t jox_why_count_leading(const JoxState *state);
/* Returns whether a transition leads to a state, or into an outer state, of this name. */
bool jox_why_leads_to(const JoxMachine *machine, const JoxTransition *t, const char *to);

/* The agents of a state, explained together. */
typedef struct JoxWhyCrowd {
    const JoxMachine *machine;
    const JoxState *state;
    uint32_t people;         /* that were asked for and are in the state */
    uint32_t longest;        /* index of the one who entered it first */
    double earliest, latest; /* s: entries */
    /* Per transition: how many agents hold each term, by its index in the tree; and the agent that
       is nearest to firing, with its tree. */
    struct JoxWhyCrowdTransition {
        uint32_t *holders;      /* per term */
        uint32_t fires, lost;   /* agents that take it next; agents that lost its chance */
        uint32_t held;          /* agents whose condition holds, or whose function did */
        uint32_t nearest;       /* index */
        JoxWhyTransition shown; /* of the nearest */
    } transitions[JOX_MOST_TRANSITIONS];
    uint32_t order[JOX_MOST_TRANSITIONS];
    /* Per lift: how many of them use it. */
    struct JoxWhyCrowdLift {
        uint32_t approach, wait, ride;
        uint32_t first; /* index of the one who has waited longest */
        double since;   /* s: since then */
    } * lifts;
    JoxText deeds; /* of `longest`, if something that its state does fails (jox_why_add_deeds) */
} JoxWhyCrowd;

/* Explains agents, given by index, that are all in one state of one machine. */
void jox_why_crowd(JoScene *scene, JoxBehaviourLook *look, const uint32_t *agents, uint32_t count,
                   JoxWhyCrowd *out);
void jox_why_crowd_free(JoxWhyCrowd *crowd);

/* why_text.c: append lines for people. `only_to`: the transitions to this state, or into this outer
   state, alone; NULL: all. */
void jox_why_agent_text(const JoScene *scene, const JoxWhyAgent *why, JoxText *out);
void jox_why_crowd_text(const JoScene *scene, const JoxWhyCrowd *crowd, const char *only_to,
                        JoxText *out);
/* why_json.c: add the members "transitions" (agent), or of one crowd, to an open object. */
void jox_why_agent_json(const JoScene *scene, const JoxWhyAgent *why, JoxJson *json);
void jox_why_crowd_json(const JoScene *scene, const JoxWhyCrowd *crowd, JoxJson *json);

/* why_facts.c: append the place of a transition ("pupil.lua:24"); what is known of a condition that
   is a function; a value of memory; an own value that no parameter has. False: the slot
   is not shown. */
void jox_why_add_place(const JoxMachine *machine, const JoxTransition *t, JoxText *out);
void jox_why_add_function(const JoScene *scene, const JoxMachine *machine, int32_t hook,
                          bool returned, JoxText *out);
bool jox_why_add_memory(const JoScene *scene, uint32_t agent, uint32_t slot, JoxText *out);
bool jox_why_add_own(const JoScene *scene, uint32_t agent, uint32_t slot, JoxText *out);
/* Appends what keeps back a transition with a chance whose condition holds. */
void jox_why_add_chance(const JoScene *scene, const JoxWhyAgent *why, uint32_t transition,
                        JoxText *out);
/* Appends the value of a measured term, and its bound unless it holds: "7.3 m, needs < 3 m". */
void jox_why_add_measure(const JoxWhyTerm *term, JoxText *out);

#endif
