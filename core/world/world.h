/* One simulation. The floors above fill it (walls, places, tags, machines, agents, bodies), step it
   and read it; between steps every column may be read. */
#ifndef JOX_WORLD_WORLD_H
#define JOX_WORLD_WORLD_H

#include "agents/agents.h"
#include "agents/neighbours.h"
#include "base/hash.h"
#include "body/body.h"
#include "force/force.h"
#include "geom/objects.h"
#include "geom/place.h"
#include "geom/walls.h"
#include "jostle.h"
#include "machine/mind.h"
#include "nav/nav.h"
#include "world/input.h"
#include "world/statistics.h"

enum { JOX_MOST_TAGS = 64 };
/* m: height of walls that are given none, for bodies */
#define JOX_WALL_HEIGHT 3.0f

struct JoWorld {
    JoWorldDef def;
    uint64_t tick; /* steps done */
    JoxPool *pool;

    JoxAgents agents;
    JoxNeighbours neighbours;
    JoxWalls walls;
    JoxPlace *places; /* owned; their indices never change */
    uint32_t place_count;
    char *tags[JOX_MOST_TAGS]; /* bit number -> name */
    uint32_t tag_count;
    JoxMind mind;
    JoxInputLog input;
    JoxNav *nav;
    JoxForces *forces;
    JoxBodies *bodies;
    JoxObjects objects; /* what agents see of the bodies */

    JoxField **fields; /* by place; NULL until somebody asks the way there */
    uint8_t *wanted;
    uint32_t field_count, field_capacity;

    /* A step longer than people plan ahead is done in equal parts; think and observe run once. */
    uint32_t part, parts;
    double part_dt, plan; /* s: of a part; how far ahead velocities are planned */
    JoxV2 *ways;          /* per agent, m: during the parts so far; only where there are several */
    uint32_t way_capacity;

    bool walls_set;           /* nav and bodies know the walls */
    bool settled;             /* no agent has been added since the last settling */
    uint32_t first_unsettled; /* else: id of the first of those */
    JoxDisc *discs;           /* people as fast bodies meet them, and their indices */
    uint32_t *disc_agents, disc_capacity;

    JoxStatistics statistics;
};

/* Fills an error, which may be NULL, with a formatted text. */
void jox_error(JoError *error, JoCode code, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* As jo_world_create, without checking the def. */
JoWorld *jox_world_create(const JoWorldDef *def);
/* Bit number of a tag, added if new; -1 when all 64 are taken. */
int jox_world_tag(JoWorld *world, const char *name);
/* Takes the places over, once, before agents are spawned. */
void jox_world_set_places(JoWorld *world, JoxPlace *places, uint32_t count);
/* Adds an agent at (x, y), m, with the parameters' defaults; it is settled before the next step.
   Returns its index, valid until then. */
uint32_t jox_world_add_agent(JoWorld *world, float x, float y);
/* Moves agents that were born in walls or each other, and says how many. Runs by itself before a
   step. */
JoxSettled jox_world_settle(JoWorld *world);
/* Before a step: makes the distance fields that were asked for in the last. */
void jox_world_make_ways(JoWorld *world);
/* After walls or places have moved. */
void jox_world_drop_ways(JoWorld *world);
/* Bodies that are picked up, carried and thrown in this step. */
void jox_world_grip(JoWorld *world);
/* One step. */
void jox_world_step(JoWorld *world);
/* Index of a live agent, or JOX_NO_INDEX. */
uint32_t jox_world_find(const JoWorld *world, JoAgent agent);
uint64_t jox_world_hash(const JoWorld *world);

#endif
