/* Contacts of a step: who touches whom, which wall and which body, and the impulses that keep them
   from moving into each other. Found, laid out, solved and read by the files contact_*.c. */
#ifndef JOX_FORCE_CONTACT_H
#define JOX_FORCE_CONTACT_H

#include "agents/agents.h"
#include "agents/contact_planes.h"
#include "agents/neighbours.h"
#include "geom/objects.h"
#include "geom/wall_grid.h"
#include "simd/four.h"

enum {
    JOX_NO_COLOUR = 255,           /* of a contact that is left out */
    JOX_CONTACT_MOST_COLOURS = 64, /* so many contacts with others has an agent at most */
    JOX_CONTACT_MOST_WALLS = 6     /* edges that one agent touches at a time */
};

/* What one agent was found to touch; normals point to the agent. A contact between two agents is
   found by one of them. */
typedef struct JoxFoundPair {
    uint32_t other, other_id;
    JoxV2 normal;
    float squeeze, target, mass; /* as in JoxPair */
} JoxFoundPair;
/* The same one for those who lay contacts out, of as few bytes as that needs: the agent touched,
   then the colour and the number among the ends of either. */
typedef struct JoxPairSlot {
    uint32_t other;
    uint8_t colour, first_end, second_end;
} JoxPairSlot;
typedef struct JoxFoundWall {
    uint32_t edge;
    JoxV2 normal;
    float gap, along; /* m; along: from the start of the edge */
} JoxFoundWall;

/* What else contacts depend on than motions: one load fetches it. m, kg. */
typedef struct JoxBuild {
    float breadth, radius, mass;
    uint32_t id;
} JoxBuild;

/* A contact between two agents. The normal points to the first, which has found the contact. Half a
   line of the cache: whoever looks at a contact takes all of it. */
typedef struct JoxPair {
    uint32_t first, second;
    JoxV2 normal;
    float target;  /* least normal velocity of the first relative to the second, m/s */
    float mass;    /* reduced mass, kg */
    float squeeze; /* N: of shoulders that are turned, within the radii; besides the impulse */
    float impulse; /* accumulated, at least 0, N s */
} JoxPair;

/* Of an agent, where in ascending ids its contacts come, and its kept impulses begin, or those of
   who is next among these. */
typedef struct JoxListed {
    uint32_t pair, kept;
} JoxListed;

/* Contacts between agents, sorted by colour: no agent occurs twice in a colour, so that the
   contacts of one colour may be solved in any order, at once. */
typedef struct JoxPairs {
    uint32_t count, colours;
    uint32_t starts[JOX_CONTACT_MOST_COLOURS + 1]; /* of each colour */
    JoxPair *items;
    size_t capacity;
} JoxPairs;

/* An agent at the edge of a wall. */
typedef struct JoxWallContact {
    uint32_t agent, edge;
    JoxV2 normal;
    float along, target, impulse;
} JoxWallContact;

/* An agent at a body. A push on a body uses the normal's place for its force. */
typedef struct JoxTouch {
    uint32_t agent, object;
    JoxV2 normal;
    JoxV3 point;
    float gap, target, mass, impulse; /* m, m/s, kg, N s */
    float before;                     /* N s: the impulse before a pass */
    float ahead;   /* of a driven body: share of its speed that it has towards the agent, 0 to 1 */
    int16_t drive; /* index of its drive, or -1 */
} JoxTouch;

/* A driven body under way that touches somebody (touch.c). */
typedef struct JoxDrive {
    uint32_t row;
    float speed;   /* m/s: its greatest towards anybody whom it touches, or of its middle */
    float most;    /* N s: what it presses with in the step at most */
    float pressed; /* N s: with what it does */
} JoxDrive;

/* An agent's end of a contact with another. */
typedef struct JoxEnd {
    uint32_t pair; /* index */
    uint32_t other;
} JoxEnd;

/* The impulse of a contact of the step before, from which the next solve starts; by ascending ids.
   `other`: id of an agent, edge, or row of a body. */
typedef struct JoxKeptImpulse {
    uint32_t id, other;
    float impulse; /* N s */
} JoxKeptImpulse;
typedef struct JoxKeptImpulses {
    JoxKeptImpulse *items;
    size_t count, capacity;
} JoxKeptImpulses;

/* One direction of a contact of two bodies: what each does along it, and what 1 N s along it, on
   the first, does to each. All 0 of what is not solved for, but for the way in which it turns. */
typedef struct JoxSupportAxis {
    JoxFour along;                /* unit */
    JoxFour lever[2], turning[2]; /* m: arm x along; change of spin by 1 N s, 1/(kg m) */
    float lightness[2], sway[2];  /* 1/kg; what 1 N s does to each, root of 1/kg */
    float mass, impulse;          /* kg; on the first, N s */
} JoxSupportAxis;

/* A contact of a body with what holds it: solved along the normal and, for friction, across it. */
typedef struct JoxSupport {
    uint32_t rows[2];       /* of motions */
    float target, friction; /* m/s */
    JoxSupportAxis normal, across[2];
} JoxSupport;

/* Of a support, what says whether it is to be solved again (support_solve.c). */
typedef struct JoxSupportWatch {
    uint32_t rows[2];
    float answer[2];   /* of the impulse, at most, to unrest of 1 of each body, root of kg */
    float answered[2]; /* unrest of the bodies when it was looked at last */
    float left;        /* what it would have changed by then, N s */
} JoxSupportWatch;

/* Velocity and spin of a body while contacts are solved. */
typedef struct JoxBodyMotion {
    JoxFour velocity, spin;
    JoxV3 given, given_turn; /* by those who touch it, N s and N m s */
    float held;              /* share of that which its supports took */
    float unrest; /* sum of all impulses, each by what it does to the body: N s / root of kg */
    bool solved, touched; /* else it goes on as it moves */
    uint8_t link;         /* bodies between it and the nearest that is touched */
} JoxBodyMotion;

#endif
