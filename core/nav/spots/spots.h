/* Spots where agents can stand, and the search for free ones. nav/placement.c calls it for births,
   for agents that are put elsewhere, and for agents in the way of new walls. */
#ifndef JOX_NAV_SPOTS_H
#define JOX_NAV_SPOTS_H

#include "agents/agents.h"
#include "geom/storeys.h"
#include "geom/wall_grid.h"

#define JOX_SPOTS_FARTHEST 25.0f /* m: how far a search looks */
enum { JOX_SPOTS_MOST = 5000000 };

/* The state of the last search about a point, for later ones near it: all spots nearer than
   `distance` (m) are taken. Spots are never freed during a table's life. */
typedef struct JoxSearched {
    JoxV2 at; /* m */
    float radius, angle, distance;
    uint32_t kind;
    bool known, failed;
} JoxSearched;

/* A hash table from cells to agents. Valid while no agent moves; new agents are added by
   jox_spots_enter. */
typedef struct JoxSpots {
    const JoxAgents *agents;
    uint32_t count, next_id; /* count and next id of the agents when all of them were entered */
    float cell, widest;      /* m */
    uint32_t mask;
    uint32_t *head, *next; /* by bucket; by agent index */
    uint32_t next_capacity;
    JoxSearched *searched;
    uint32_t looked; /* spots that all searches of the table have looked at */
    bool ended;      /* the last search found nothing because of its bound, not of its reach */
    /* Edges near the point of a search, and the edge that blocked the last spot (UINT32_MAX:
       none). */
    uint32_t *edges;
    uint32_t edge_count, edge_capacity, blocking;
} JoxSpots;

/* The request of a search. */
typedef struct JoxSpotWish {
    JoxV2 at;     /* m */
    float radius; /* m */
    /* Where the spot has to lie, within a box; NULL: anywhere. Wishes with the same place have the
       same `kind`. */
    bool (*contains)(const void *place, JoxV2 spot);
    const void *place;
    JoxV2 low, high; /* m */
    uint32_t kind;
    const bool *passable; /* by ring: solids that the way may leave; NULL: none */
} JoxSpotWish;

/* Makes an empty table for agents up to `widest` m in radius, or as wide as the widest agent. */
JoxSpots jox_spots_begin(JoxWallGrid *grid, const JoxAgents *agents, float widest);
void jox_spots_free(JoxSpots *spots);
/* Enters an agent at its position. */
void jox_spots_enter(JoxSpots *spots, uint32_t agent);
/* Returns whether a disc fits at p: it keeps clear of walls, and overlaps no agent by more than a
   quarter of the smaller diameter. */
bool jox_spots_is_free(const JoxSpots *spots, const JoxWallGrid *grid, JoxV2 p, float radius);
/* Finds the first free spot on a spiral about the wish, with turns half a radius apart, out to 25
   m, with no wall between. All searches of a table look at JOX_SPOTS_MOST spots together, later
   ones at 1,000 each: `ended` then says that a free spot may exist all the same. */
bool jox_spots_find(JoxSpots *spots, const JoxWallGrid *grid, const JoxSpotWish *wish, JoxV2 *spot);

#endif
