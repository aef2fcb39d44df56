/* Spots where agents can stand, and the one search for them, by births and for those in whose way
   walls come. */
#ifndef JOX_NAV_SPOTS_H
#define JOX_NAV_SPOTS_H

#include "agents/agents.h"
#include "geom/wall_grid.h"

#define JOX_SPOTS_FARTHEST 25.0f /* m: how far a search looks */
enum { JOX_SPOTS_MOST = 5000000 };

/* What a search found about a point, for the next ones near it: all spots about it that are nearer
   than `distance` are taken. They only fill. */
typedef struct JoxSearched {
    JoxV2 at; /* m */
    float radius, angle, distance;
    uint32_t kind;
    bool known, failed;
} JoxSearched;

/* A hash of cells to the agents that have a spot. Valid while nobody moves; who enters is told. */
typedef struct JoxSpots {
    const JoxAgents *agents;
    uint32_t count, next_id; /* of the agents, once all of them are in it */
    float cell, widest;      /* m */
    uint32_t mask;
    uint32_t *head, *next; /* by bucket; by agent index */
    uint32_t next_capacity;
    JoxSearched *searched;
    uint32_t looked; /* spots that all searches have looked at */
    bool ended; /* the last search found nothing and was ended by its bound, not by its reach */
    /* Edges of walls near the point of a search, and the one that lay before the last spot. */
    uint32_t *edges;
    uint32_t edge_count, edge_capacity, blocking;
} JoxSpots;

/* Who looks for a spot. */
typedef struct JoxSpotWish {
    JoxV2 at;     /* m */
    float radius; /* m */
    /* Where it has to lie, within a box; NULL: anywhere. Wishes of one `kind` have the same place.
     */
    bool (*holds)(const void *place, JoxV2 spot);
    const void *place;
    JoxV2 low, high; /* m */
    uint32_t kind;
    const bool *passable; /* by ring: solids out of which it leads; NULL: none */
} JoxSpotWish;

/* Empty, for agents as wide as these and `widest` m. */
JoxSpots jox_spots_begin(JoxWallGrid *grid, const JoxAgents *agents, float widest);
void jox_spots_free(JoxSpots *spots);
/* An agent takes the spot on which it stands. */
void jox_spots_enter(JoxSpots *spots, uint32_t agent);
/* Whether a disc fits there: clear of edges of walls, and in nobody by more than a quarter of the
   smaller one's breadth. */
bool jox_spots_is_free(const JoxSpots *spots, const JoxWallGrid *grid, JoxV2 p, float radius);
/* The first free spot of a spiral about the wish whose ways are half a radius apart, 25 m far, with
   no wall between; all searches by `spots` together look at JOX_SPOTS_MOST, later ones at 1,000
   each: then `ended` says that there may be one all the same. */
bool jox_spots_find(JoxSpots *spots, const JoxWallGrid *grid, const JoxSpotWish *wish, JoxV2 *spot);

#endif
