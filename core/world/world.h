/* One simulation. run fills it (walls, places, tags, machines, agents, bodies), steps it and reads
   it; between steps every column may be read. Calls are made by one thread at a time; a world
   allocates from its heap. */
#ifndef JOX_WORLD_WORLD_H
#define JOX_WORLD_WORLD_H

#include "agents/agents.h"
#include "agents/neighbours.h"
#include "base/guard.h"
#include "base/hash.h"
#include "base/mem.h"
#include "body/body.h"
#include "force/force.h"
#include "geom/objects.h"
#include "geom/place.h"
#include "geom/storeys.h"
#include "geom/walls.h"
#include "jostle.h"
#include "machine/run.h"
#include "nav/nav.h"
#include "task/stage_memory.h"
#include "world/agent_inspection.h"
#include "world/dragged_bodies.h"
#include "world/exits.h"
#include "world/falls.h"
#include "world/input/input_entries.h"
#include "world/lifts.h"
#include "world/population.h"
#include "world/routes/routes.h"
#include "world/scheduled_events.h"
#include "world/sources.h"
#include "world/stages.h"
#include "world/statistics.h"
#include "world/step_events/step_events.h"

enum { JOX_MOST_TAGS = 64 };
/* m: height, for bodies, of walls without a height of their own */
#define JOX_WALL_HEIGHT 3.0f

/* Constant part of a world: built once, changed only by reloads, by people who set a parameter,
   and, for gates, by events. */
typedef struct JoxWorldModel {
    JoWorldDef def;
    JoxWalkLaw walking;
    JoxStoreys storeys; /* owned; without storeys: all members 0 */
    JoxLift *lifts;     /* owned */
    uint32_t lift_count;
    JoxWalls all_walls; /* all, with their names; whether a gate is open is state. Walls that were
                           added while the world runs follow the others, and are state */
    uint32_t added_ring, added_vertex; /* first ring and vertex of added walls, if there are any */
    /* Owned; indices never change. Places of single agents follow those of the scene, and are
       state. */
    JoxPlace *places;
    uint32_t place_count, scene_places, place_capacity;
    /* Borrowed from whoever set them. */
    const JoxGroup *groups;
    const JoxAgentSource *sources;
    const JoxAgentSink *sinks;
    const JoxEvent *events;
    JoxStart *starts; /* owned: agents that enter after 0 s, in order of time */
    uint32_t start_count;
    uint32_t group_count, source_count, sink_count, event_count;
    char *tags[JOX_MOST_TAGS]; /* bit number -> name */
    uint32_t tag_count;
    char *set_teams[JOX_MOST_SET_TEAMS]; /* teams that no group has: number minus JOX_FIRST_SET_TEAM
                                            -> name */
    uint32_t set_team_count;
    JoxMachineSet machines;
    bool reinserts_bodies; /* at each JOX_BODIES_REINSERT_STEPS-th step, so that a state with bodies
                              can be saved; default off, as it changes the order of Bullet's
                              contacts */
} JoxWorldModel;

/* A wall that was added while the world runs. */
typedef struct JoxAddedWall {
    char name[128];
    JoxV2 points[4]; /* m */
    uint32_t count;  /* 2: thin; 4: a solid */
    uint32_t open;   /* 0 or 1 */
    uint32_t is_new; /* 0 or 1: added or closed after people were last moved out of new walls */
} JoxAddedWall;
enum { JOX_MOST_ADDED_WALLS = 4096 };

/* All that the future of a world depends on besides the model; listed by jox_world_sections. */
typedef struct JoxWorldState {
    uint64_t tick; /* steps done */
    JoxAgents agents;
    JoxMachineState machines;
    JoxInputLog input;
    JoxRoutes *routes;
    JoxBodies *bodies;
    JoxDrags drags;
    JoxPopulation population;
    JoxSourceState sources;
    JoxLiftState lifts;
    uint32_t walls_version;    /* counts the changes of the walls */
    JoxAddedWall *added_walls; /* in the order in which they were added */
    uint32_t added_count;
    size_t added_capacity;
    bool walls_applied; /* scratch.walls, images, nav, forces and bodies agree with all_walls */
    bool has_new_walls; /* some edges are marked as new: agents may stand in them */
    JoxExits exits;     /* which the machines' word `left` reads */
    JoxStatistics statistics; /* likewise */
} JoxWorldState;

/* Part of a world that a step may forget: it follows from the model and the state, or is written
   before it is read. Between steps some members tell what the last step did. */
typedef struct JoxWorldScratch {
    JoxPool *pool;
    bool timed; /* stages are timed */
    JoxNeighbours neighbours;
    JoxStageMemory memory; /* working memory that nav and force share */
    JoxNav *nav;
    JoxForces *forces;
    JoxWalls walls;       /* standing walls: all but open gates */
    JoxWalls dividing;    /* the same and all doors of lifts; empty in a world without lifts */
    JoxWallImages images; /* walls and their images beyond joined edges; else empty */
    JoxWalls images_only; /* view of the images, read by machines */
    JoxEntrances entrances;
    JoxObjects objects; /* bodies as agents see them */
    JoxInspection inspection;
    JoxV2 *walked; /* per agent, m: displacement in the substeps so far; if the step is divided */
    uint32_t walked_capacity;
    JoxSubstep substep;       /* the present one, or the last; all zero until one was done */
    JoxDepartures departures; /* agents that left in the last step */
    JoxDiscList discs;
    JoxHands hands;
    JoxLiftScratch lifts;
    JoxFalls falls;
    JoxStepEvents step_events; /* events of the last step */
    struct {
        uint32_t *ids;
        uint32_t count, capacity;
    } lost; /* agents that number_guard.c removes at the end of the step */
    JoxText
        messages; /* a line each: failed events, lost agents and bodies; the reader empties it */
} JoxWorldScratch;

struct JoWorld {
    JoxHeap *heap; /* its own, or that of its scene */
    bool owns_heap;
    bool busy; /* within a step: callbacks may read the world, and not change it */
    JoxWorldModel model;
    JoxWorldState state;
    JoxWorldScratch scratch;
    JoxMachineRun machines; /* views of the machines' parts of model, state and scratch */
    /* Gets each action of a program (verbs/program_actions.c); NULL: not recorded. */
    void (*record)(void *context, JoxInputEntry *entry);
    void *record_context;
    char failure[1024]; /* why no further step can be done; "": none failed */
};

/* Creates a world in the heap in use; as jo_world_create, without checking the def. */
JoWorld *jox_world_create(const JoWorldDef *def);
/* Sets whether steps are timed. Default no: clocks cost much of a small world's step. */
void jox_world_set_timed(JoWorld *world, bool timed);
/* Returns the bit number of a tag, added if new; -1 if all 64 are taken. */
int jox_world_add_tag(JoWorld *world, const char *name);
/* Returns the number of a team that states set and no group has, added if new; -1 if all are
   taken. */
int jox_world_add_team(JoWorld *world, const char *name);
/* Sets the constants of the walking law, before the first step. */
void jox_world_set_walking(JoWorld *world, const JoxWalkLaw *law);
/* Copies storeys that are laid out, before the first step. Walls, places and agents are on their
   sheets; the walls of stairs are among the walls that are set. */
void jox_world_set_storeys(JoWorld *world, const JoxStoreys *storeys);
/* Takes over the places of a scene, once, before agents are spawned; the array has room for
   `capacity`, places of single agents included. */
void jox_world_set_places(JoWorld *world, JoxPlace *places, uint32_t count, uint32_t capacity);
/* Adds an agent at (x, y), m, without a check. The caller has found a free spot, and sets machine
   and parameters. Returns its index, valid until the next step. */
uint32_t jox_world_add_agent(JoWorld *world, float x, float y);
/* Applies changes of walls, and moves agents out of new walls. Runs before each step. */
void jox_world_settle_walls(JoWorld *world);
/* Applies changes of walls to scratch.walls, images, nav, forces and bodies, if there are any. */
void jox_world_apply_walls(JoWorld *world);
/* Returns the standing walls and, if edges are joined, their images. */
const JoxWalls *jox_world_walls(const JoWorld *world);
/* Returns the standing walls and all doors of lifts. */
const JoxWalls *jox_world_dividing_walls(const JoWorld *world);
/* Notes that the last ring of all_walls was added, before the first step: it is applied, and agents
   are moved out of it, before the next step. */
void jox_world_note_new_wall(JoWorld *world);
/* Replaces all walls, and takes `walls` over. Gates that were opened or closed stay so. Agents in
   new walls are moved out before the next step. */
void jox_world_set_walls(JoWorld *world, JoxWalls *walls);
/* Adds a named wall: 2 points a thin one, 4 a solid. Agents are moved out of it before the next
   step. Returns false with a sentence in `why` if it cannot be added. */
bool jox_world_add_wall(JoWorld *world, const char *name, const JoxV2 *points, uint32_t count,
                        JoxText *why);
/* Removes the added walls of a name; false if there is none. */
bool jox_world_remove_walls(JoWorld *world, const char *name);
/* Notes in the model where added walls begin, if there is none yet. */
void jox_world_mark_added_walls(JoWorld *world);
/* Appends the added walls of the state to all_walls, in place of those that were there. */
void jox_world_append_added_walls(JoWorld *world);
/* Opens or closes the walls of a name; returns how many there are. */
uint32_t jox_world_open_walls(JoWorld *world, const char *name, bool open);
/* Closes or opens the stair of a name: ways lead over it no more, or again; who is on it goes on.
   Returns whether there is one. */
bool jox_world_close_stair(JoWorld *world, const char *name, bool closed);
/* Opens or closes the door of a lift by its name, in which nobody stands. No ways change. */
void jox_world_set_lift_door(JoWorld *world, const char *name, bool open);
/* Returns whether a name is that of a lift's door. */
bool jox_world_is_lift_door(const JoWorld *world, const char *name);
/* Throws a body from a point (origin of its shape's frame, m; NULL: from where it is) with a
   velocity (m/s) and spin (rad/s). Its carrier loses it. Returns false for a static body or none.
 */
bool jox_world_throw(JoWorld *world, uint32_t row, const double from[3], const double velocity[3],
                     const double spin[3]);
/* Adds a cube with its centre at a point (m; lifted out of the ground), a velocity (m/s), edge (m)
   and mass (kg). If there are JOX_MOST_BOXES, the oldest is removed. Returns its row, or
   JOX_NO_BODY with a sentence in `why`. */
uint32_t jox_world_add_box(JoWorld *world, const double at[3], const double velocity[3],
                           double size, double mass, JoxText *why);
/* Result of jox_world_grab. */
typedef enum JoxGrabbed {
    JOX_GRAB_DONE,
    JOX_GRAB_NONE,   /* no such body */
    JOX_GRAB_STATIC, /* it never moves */
    JOX_GRAB_FREE,   /* not grabbed yet, and `anew` is false */
    JOX_GRAB_FULL    /* JOX_MOST_GRABS bodies are grabbed */
} JoxGrabbed;
/* Pulls a body's centre of mass towards a point, m, from now on; its carrier loses it. Unless
   `anew` only a body that is pulled already. */
JoxGrabbed jox_world_grab(JoWorld *world, uint32_t row, const double to[3], bool anew);
/* Stops pulling a body; false if it is not pulled. */
bool jox_world_release(JoWorld *world, uint32_t row);
/* Does one step. Returns false, with the reason in `failure`, if an agent or a body is lost and the
   def says that this ends the world; later calls do nothing. */
bool jox_world_step(JoWorld *world);
/* Finds agents with a number that is not finite, or beyond 10 km of the origin. Returns false, with
   the first in `failure`, if that ends the world. Else puts them back to where the substep began,
   at rest, and lists them for removal if the def says so. */
bool jox_world_guard_numbers(JoWorld *world);
/* Ends the world for a body that Bullet lost and removed or stopped, or adds a message. */
void jox_world_report_lost_body(JoWorld *world, const JoxBodyGone *gone);
/* Ends the world: a driven body met a force limit that does so. */
void jox_world_end_overloaded(JoWorld *world, const JoxDriveLoad *load);
#define JOX_WORLD_FARTHEST                                                                         \
    10000.0f /* m from the origin, where floats still resolve a millimetre                         \
              */
/* Removes the agents that jox_world_guard_numbers listed. */
void jox_world_remove_lost(JoWorld *world);
/* For JOX_CHECK, between steps. agents: ids, ranks, slots and indices agree with each other and
   with the model. model: places, groups, sources and sinks refer to existing things. lists:
   players' inputs, inspections and grabs are listed once each, and figures add up. */
void jox_world_check_agents(const JoWorld *world);
void jox_world_check_model(const JoWorld *world);
void jox_world_check_lists(const JoWorld *world);
/* Returns the first of these conditions, or of the bounds of agents' numbers, that does not hold
   between two steps, as its source text; NULL if all hold. */
const char *jox_world_find_fault(const JoWorld *world);
/* Returns the index of a live agent, or JOX_NO_INDEX; and the handle of the agent at an index. */
uint32_t jox_world_find_agent(const JoWorld *world, JoAgent agent);
JoAgent jox_world_agent_handle(const JoWorld *world, uint32_t index);
/* Returns the row of a live body, or JOX_NO_BODY. */
uint32_t jox_world_find_body(const JoWorld *world, JoBody body);
/* Returns the length, s, of the substeps into which steps are divided. */
double jox_world_substep_length(const JoWorld *world);
/* Fills the context of routes from this world. */
JoxRouteStage jox_world_route_stage(JoWorld *world);
/* Lists the state, in one order for all modes. */
void jox_world_sections(JoWorld *world, JoxSections *sections);
uint64_t jox_world_hash(const JoWorld *world);
/* Hash of the state without the sections of a module, as jox_sections_module names it. */
uint64_t jox_world_hash_without(const JoWorld *world, const char *module);
/* Whether a state saved now continues to the bit: always without bodies, and with them if the next
   step re-inserts them (model.reinserts_bodies, JOX_BODIES_REINSERT_STEPS). For a snapshot step on
   until it is so. */
bool jox_world_snapshot_is_exact(const JoWorld *world);
/* Appends the whole state to a buffer. Returns false, and appends nothing, if it would not be
   exact. */
bool jox_world_snapshot(JoWorld *world, JoxText *out, JoError *error);
/* Puts a world of the same model (machines, walls, places, seed, step) into the state of a
   snapshot, from which it continues as the other did. Refuses a damaged buffer, or one of another
   model, and leaves the world as it was. */
bool jox_world_restore(JoWorld *world, const void *data, size_t size, JoError *error);
/* Overwrites what a step may forget, numbers with NaN; later steps must not depend on it. */
void jox_world_forget(JoWorld *world);

#endif
