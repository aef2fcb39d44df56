/* Running machines: the stages think and prefer over all agents of a world. */
#ifndef JOX_MACHINE_MIND_H
#define JOX_MACHINE_MIND_H

#include "agents/agents.h"
#include "agents/neighbours.h"
#include "base/text.h"
#include "geom/objects.h"
#include "geom/place.h"
#include "machine/machine.h"
#include "task/pool.h"

typedef enum JoxHookKind {
    JOX_HOOK_ENTER,
    JOX_HOOK_EXIT,
    JOX_HOOK_TAKE,
    JOX_HOOK_WHEN,
    JOX_HOOK_STEER
} JoxHookKind;

/* Runs one Lua function for one agent, on the stepping thread, agents in ascending id. WHEN
   returns 0/1 in result[0], STEER a velocity in result[0..1]. Returns false if it failed (WHEN
   then counts as false, STEER as standing still). NULL where there is no Lua. */
typedef bool JoxHookCall(void *context, const JoxMachine *machine, int32_t hook, JoxHookKind kind,
                         uint32_t agent, double result[2]);

/* One transition taken; kept for the step, in ascending agent id. */
typedef struct JoxTaken {
    uint32_t agent_id;
    uint16_t machine, from, to, transition;
} JoxTaken;

enum { JOX_MOST_MACHINES = 64 };

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

    bool spawning; /* within jox_mind_spawn: nothing can be sensed */
    /* Transitions of the agent with this id are explained in `trace` as they are taken. */
    bool traces;
    uint32_t trace_id;
    JoxText trace;

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
/* Whether `next` may take the place of machine `index`: NULL, or why not ("312 agents are in
   'Greet', which this version lacks"), written into `why`. */
const char *jox_mind_refuses(const JoxMind *mind, uint32_t index, const JoxMachine *next, char *why,
                             uint32_t size);
/* Swaps machine `index` for `next` (taken over; the old one is returned, caller frees) and carries
   states by name (or `renamed`), memory and own values by name. Enter and exit hooks do not run. */
JoxMachine *jox_mind_replace(JoxMind *mind, uint32_t index, JoxMachine *next);
/* Appends who went where by which transition, with the values of its condition at present. */
void jox_mind_explain(const JoxMind *mind, const JoxTaken *taken, JoxText *out);
void jox_mind_free(JoxMind *mind);

#endif
