/* One simulation. The floors above fill it (walls, places, tags, machines, agents, bodies), step it
   and read it; between steps every column may be read. */
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
#include "geom/walls.h"
#include "jostle.h"
#include "machine/run.h"
#include "nav/nav.h"
#include "task/stage_memory.h"
#include "world/agent_inspection.h"
#include "world/dragged_bodies.h"
#include "world/exits.h"
#include "world/input/input_entries.h"
#include "world/population.h"
#include "world/routes/routes.h"
#include "world/scheduled_events.h"
#include "world/sources.h"
#include "world/stages.h"
#include "world/statistics.h"
#include "world/step_events/step_events.h"

enum { JOX_MOST_TAGS = 64 };
/* m: height of walls that are given none, for bodies */
#define JOX_WALL_HEIGHT 3.0f

/* What a world is: built once, and changed only by a reload, by people who set a parameter, and,
   for the walls that open, by events. */
typedef struct JoxWorldModel {
    JoWorldDef def;
    JoxWalkLaw walking;
    JoxWalls all_walls; /* with their names; whether one that opens is open now is state. Behind the
                           model's own stand those that were added, which are state */
    uint32_t added_ring, added_vertex; /* where those begin, once there are some */
    /* Owned; their indices never change. Behind the places of the scene stand those of single
       agents, which are state. */
    JoxPlace *places;
    uint32_t place_count, scene_places, place_capacity;
    /* Who enters, who leaves and what happens when; borrowed. */
    const JoxGroup *groups;
    const JoxAgentSource *sources;
    const JoxAgentSink *sinks;
    const JoxEvent *events;
    JoxStart *starts; /* owned: who comes in after the start, in order of time */
    uint32_t start_count;
    uint32_t group_count, source_count, sink_count, event_count;
    char *tags[JOX_MOST_TAGS]; /* bit number -> name */
    uint32_t tag_count;
    char *set_teams[JOX_MOST_SET_TEAMS]; /* of no group: number minus JOX_FIRST_SET_TEAM -> name */
    uint32_t set_team_count;
    JoxMachineSet machines;
    bool
        reinserts_bodies; /* at each JOX_BODIES_REINSERT_STEPS-th step: then a state with bodies can
                             be saved; off, as the order in which Bullet solves contacts changes */
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

/* All that the future of a world depends on, besides the model: jox_world_sections lists it. */
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
    uint32_t walls_version; /* counts the changes of the walls */
    JoxAddedWall *made;     /* walls that were added to those of the model, in order */
    uint32_t added_count;
    size_t added_capacity;
    bool walls_applied; /* scratch.walls, its images, nav and bodies are as all_walls says */
    bool has_new_walls; /* some edges of walls are marked as such, and people may stand there */
    JoxExits exits;     /* figures of the run, which no step reads */
    JoxStatistics statistics; /* likewise */
} JoxWorldState;

/* What a step may forget: it follows from the model and the state, or is written before it is read.
   Between steps some of it says what the last step did. */
typedef struct JoxWorldScratch {
    JoxPool *pool;
    bool timed; /* somebody may ask for times */
    JoxNeighbours neighbours;
    JoxStageMemory memory; /* of nav and forces */
    JoxNav *nav;
    JoxForces *forces;
    JoxWalls walls;       /* those that stand */
    JoxWallImages images; /* of `walls`; laid only if edges are joined */
    JoxWalls images_only; /* view of the images, read by machines */
    JoxEntrances entrances;
    JoxObjects objects; /* what agents see of the bodies */
    JoxInspection inspection;
    JoxV2 *walked; /* per agent, m: during the substeps of the step so far; where it is divided */
    uint32_t walked_capacity;
    JoxSubstep substep;       /* the present one, or the last; all zero until one was done */
    JoxDepartures departures; /* who left in the last step */
    JoxDiscList discs;
    JoxHands hands;
    JoxStepEvents step_events; /* for programs that ask */
    struct {
        uint32_t *ids;
        uint32_t count, capacity;
    } lost;           /* people whom the guard takes out at the end of the step */
    JoxText messages; /* what events could not do, and who was lost, a line each; whoever reads it
                     empties it */
} JoxWorldScratch;

struct JoWorld {
    JoxHeap *heap; /* that it allocates from: its own, or that of its scene */
    bool owns_heap;
    bool busy; /* within a step: who is told something may look, and change nothing */
    JoxWorldModel model;
    JoxWorldState state;
    JoxWorldScratch scratch;
    JoxMachineRun machines; /* joins the machines' parts of all three */
    /* Is told of what programs do to it (world/verbs/program_actions.c); NULL: nobody records it.
     */
    void (*record)(void *context, JoxInputEntry *entry);
    void *record_context;
    char failure[1024]; /* why no further step can be done; "" while none failed */
};

/* As jo_world_create, without checking the def. */
JoWorld *jox_world_create(const JoWorldDef *def);
/* Whether steps are timed. At first they are not: reading clocks costs small worlds much of a step.
 */
void jox_world_set_timed(JoWorld *world, bool timed);
/* Bit number of a tag, added if new; -1 when all 64 are taken. */
int jox_world_add_tag(JoWorld *world, const char *name);
/* Number of a team that states set and no group has, added if new; -1 when all are taken. */
int jox_world_add_team(JoWorld *world, const char *name);
/* The constants of the walking law, before the first step; until then they are its defaults. */
void jox_world_set_walking(JoWorld *world, const JoxWalkLaw *law);
/* Takes the places over, once, before agents are spawned. The array has room for `capacity` of
   them: for those of single agents too. */
void jox_world_set_places(JoWorld *world, JoxPlace *places, uint32_t count, uint32_t capacity);
/* Adds an agent at (x, y), m, as it is told: whoever calls this has found a spot for it, and sets
   its machine and all of its parameters. Returns its index, valid until the next step. */
uint32_t jox_world_add_agent(JoWorld *world, float x, float y);
/* Brings the walls that stand into effect, and moves agents in whose way they came. Runs by itself
   before a step. */
void jox_world_settle_walls(JoWorld *world);
/* Brings the walls that stand into effect, unless they are. */
void jox_world_apply_walls(JoWorld *world);
/* Returns the standing walls and, if edges are joined, their images. */
const JoxWalls *jox_world_walls(const JoWorld *world);
/* Brings the last ring of all_walls into effect, which was added before the first step: who stands
   there is moved out with it. */
void jox_world_note_new_wall(JoWorld *world);
/* Takes walls over, in place of all there are. Those whose names were opened or closed before stay
   so. Who stands in a new wall is moved out before the next step. */
void jox_world_set_walls(JoWorld *world, JoxWalls *walls);
/* Adds a wall to those of the model: a thin one between two points, else a solid. Who stands there
   is moved out before the next step. False with a sentence in `why`. */
bool jox_world_add_wall(JoWorld *world, const char *name, const JoxV2 *points, uint32_t count,
                        JoxText *why);
/* Takes out those of a name that were added; false where there is none. */
bool jox_world_remove_walls(JoWorld *world, const char *name);
/* Where they begin, before the first of them. */
void jox_world_mark_added_walls(JoWorld *world);
/* Puts the walls that were added behind those of the model, in place of those that were there. */
void jox_world_append_added_walls(JoWorld *world);
/* Opens or closes the walls of a name; says how many there are. */
uint32_t jox_world_open_walls(JoWorld *world, const char *name, bool open);
/* Throws a body, from a point (of its shape's own frame, m) or, with NULL, from where it is; m/s
   and rad/s. Who carries it loses it. False for a static body or none. */
bool jox_world_throw(JoWorld *world, uint32_t row, const double from[3], const double velocity[3],
                     const double spin[3]);
/* A new cube, at its centre (m; lifted where it would be in the ground), with its velocity (m/s),
   edge (m) and mass (kg). With JOX_MOST_BOXES there already the oldest of them is taken out.
   Returns its row, or JOX_NO_BODY with a sentence in `why`. */
uint32_t jox_world_add_box(JoWorld *world, const double at[3], const double velocity[3],
                           double size, double mass, JoxText *why);
/* From here on pulls a body's centre of mass towards a point, m; who carries it loses it. Unless
   `anew` it is to be pulled already. */
typedef enum JoxGrabbed {
    JOX_GRAB_DONE,
    JOX_GRAB_NONE,   /* there is no such body */
    JOX_GRAB_STATIC, /* it never moves */
    JOX_GRAB_FREE,   /* it is not pulled */
    JOX_GRAB_FULL    /* JOX_MOST_GRABS are */
} JoxGrabbed;
JoxGrabbed jox_world_grab(JoWorld *world, uint32_t row, const double to[3], bool anew);
/* False where it is not pulled. */
bool jox_world_release(JoWorld *world, uint32_t row);
/* One step. False, with the reason in `failure`, where somebody or something is lost and the def
   says that this ends the world; from then on nothing is done. */
bool jox_world_step(JoWorld *world);
/* Looks for people with a number that is not finite, or beyond 10 km of the origin: false, with the
   first in `failure`, where that ends the world. Else they are put back to where the substep began,
   at rest, and listed to be taken out where the def says so. */
bool jox_world_guard_numbers(JoWorld *world);
/* The same of a body that the last stage found, and has dealt with. */
void jox_world_report_lost_body(JoWorld *world, const JoxBodyGone *gone);
/* Ends the world: a driven body met a limit at which it does. */
void jox_world_end_overloaded(JoWorld *world, const JoxDriveLoad *load);
#define JOX_WORLD_FARTHEST                                                                         \
    10000.0f /* m, from the origin: floats still resolve a millimetre there */
/* Takes out those who are listed. */
void jox_world_remove_lost(JoWorld *world);
/* For JOX_CHECK, between steps: ids, ranks, slots and indices of the agents agree with each other
   and with the model; places, groups, sources and sinks name things that there are; what people
   want, inspect and drag is listed once each, and figures add up. */
void jox_world_check_agents(const JoWorld *world);
/* What of this, or of the bounds of people's numbers, does not hold between two steps, as the code
   has it; NULL: all of it holds. */
const char *jox_world_find_fault(const JoWorld *world);
void jox_world_check_model(const JoWorld *world);
void jox_world_check_lists(const JoWorld *world);
/* Index of a live agent, or JOX_NO_INDEX; and the handle of the one at an index. */
uint32_t jox_world_find_agent(const JoWorld *world, JoAgent agent);
JoAgent jox_world_agent_handle(const JoWorld *world, uint32_t index);
/* Row of a live body, or JOX_NO_BODY. */
uint32_t jox_world_find_body(const JoWorld *world, JoBody body);
/* s: the length of a step, or of the parts in which it is done. */
double jox_world_substep_length(const JoWorld *world);
/* What routes are made of, in this world. */
JoxRouteStage jox_world_route_stage(JoWorld *world);
/* Lists the state, in one order for all modes. */
void jox_world_sections(JoWorld *world, JoxSections *sections);
uint64_t jox_world_hash(const JoWorld *world);
/* The same without the sections of a module, as jox_sections_module names it. */
uint64_t jox_world_hash_without(const JoWorld *world, const char *module);
/* Whether a state that is saved now goes on to the bit: always without bodies, and with them where
   the next step re-inserts them (model.reinserts_bodies, JOX_BODIES_REINSERT_STEPS). Who wants a
   snapshot between steps on until it is so. */
bool jox_world_snapshot_is_exact(const JoWorld *world);
/* Appends the whole state to a buffer. False, and nothing appended, where it would not be exact. */
bool jox_world_snapshot(JoWorld *world, JoxText *out, JoError *error);
/* Puts a world of the same model (machines, walls, places, seed, step) into the state of a
   snapshot: from here on it does what the other did. A buffer that is none, or of another model, is
   refused and leaves the world as it was. */
bool jox_world_restore(JoWorld *world, const void *data, size_t size, JoError *error);
/* Overwrites what a step may forget, with NaN where there are numbers: no later step may notice. */
void jox_world_forget(JoWorld *world);

#endif
