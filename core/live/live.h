/* The messages of a live page: JSON objects and packed little-endian frames, made of a running
   scene (jox_live_scene ... jox_live_field) or of any crowd in columns (jox_live_pack_...), as
   replay.h does for recordings. People are numbered by slot (JoxAgents.slot), which an agent keeps
   while it is in the world. The functions read the world between two steps and change nothing of
   it. */
#ifndef JOX_LIVE_LIVE_H
#define JOX_LIVE_LIVE_H

#include "base/format/json_writer.h"
#include "base/text.h"
#include "base/vec.h"
#include "geom/lifts.h"
#include "geom/storeys.h"
#include "geom/walls.h"
#include "jostle_tools.h"

/* Version of the messages: a page that was loaded with another version reloads itself. */
enum { JOX_LIVE_PROTOCOL = 8 };

/* A growing byte buffer; zero-initialise, set `length = 0` to reuse, free by jox_bytes_free. */
typedef struct JoxBytes {
    uint8_t *data;
    size_t length, capacity;
} JoxBytes;
void jox_bytes_free(JoxBytes *bytes);

/* X(name, most, least, unit): the quantities that people can be coloured by. A frame has one byte
   `value` per slot, 0 to 255 for 0 to the end of the range: `most` if ranges are fixed or `least`
   is 0, else one that suits the scene, at least `least`. */
#define JOX_LIVE_COLOURS(X)                                                                        \
    X(state, 0, 0, "") /* value is 0: a frame has the state besides */                             \
    X(speed, 2, 0.5f, "m/s")                                                                       \
    X(force, 500, 50, "N") /* magnitude of the net force */                                        \
    X(compression, 1000, 10, "N/m")                                                                \
    X(load, 1112, 10, "N") /* greatest push from any one direction */                              \
    X(density, 8, 2, "1/m2")                                                                       \
    X(group, 255, 0, "")     /* value is the index of the group */                                 \
    X(direction, 0, 0, "")   /* value is 0: a frame has the heading besides */                     \
    X(service, 8, 0, "1/m2") /* density, shown by levels of service */
typedef enum JoxLiveColour {
#define X(name, most, least, unit) JOX_LIVE_COLOUR_##name,
    JOX_LIVE_COLOURS(X)
#undef X
        JOX_LIVE_COLOUR_COUNT
} JoxLiveColour;
typedef struct JoxLiveColourInfo {
    const char *name, *unit;
    float most, least;
} JoxLiveColourInfo;
extern const JoxLiveColourInfo jox_live_colours[JOX_LIVE_COLOUR_COUNT];
/* JoxLiveColour of a name, or -1. */
int jox_live_colour(const char *name);

typedef enum JoxLiveField {
    JOX_LIVE_DENSITY,  /* people per m2, Gaussian kernel (see live_field.c) */
    JOX_LIVE_PRESSURE, /* density times the local variance of velocity, 1/s2 */
    JOX_LIVE_FIELDS    /* none */
} JoxLiveField;
/* JoxLiveField of a name (JOX_LIVE_FIELDS for "none"), or -1. */
int jox_live_field_named(const char *name);
const char *jox_live_field_name(JoxLiveField field);

/* Why a run is over, for the member "end" of its status. */
typedef enum JoxLiveEnd {
    JOX_LIVE_GOES_ON,
    JOX_LIVE_TIME_IS_UP,
    JOX_LIVE_ALL_HAVE_LEFT, /* and nobody comes any more */
    JOX_LIVE_FAILED_RUN     /* it cannot go on */
} JoxLiveEnd;

/* ---- ranges of values (live_scale.c) ---- */

/* The range of one quantity. Zero-initialise. */
typedef struct JoxLiveScale {
    float most;                 /* end of the range; 0: not chosen yet */
    double looked, small_since; /* wall time, s */
} JoxLiveScale;
/* The ranges of a page; all are as the tables say while `fixed`. */
typedef struct JoxLiveScales {
    bool fixed;
    JoxLiveScale colours[JOX_LIVE_COLOUR_COUNT], fields[JOX_LIVE_FIELDS];
} JoxLiveScales;
enum { JOX_LIVE_SAMPLE = 2048 };
typedef struct JoxLiveSample {
    uint32_t count;
    float values[JOX_LIVE_SAMPLE];
} JoxLiveSample;
/* Returns whether the range is to be adapted at wall time `now`, s. */
bool jox_live_scale_is_due(const JoxLiveScale *scale, double now);
/* Adds the i-th value if i is a multiple of `stride`. */
void jox_live_sample_value(JoxLiveSample *sample, uint32_t stride, uint32_t i, float value);
/* Widens the range as soon as it does not hold 98 % of the values that are not about 0, outliers
   aside, and narrows it
   after 10 s of small ones, to a round number of at least `least`. */
void jox_live_adapt_scale(JoxLiveScale *scale, const JoxLiveSample *sample, float least,
                          double now);

/* The match of a game that a person plays on the page, round by round. Zero-initialised: none. */
typedef struct JoxLiveMatch {
    bool on;                      /* a match has begun; until then the machine plays */
    bool judged;                  /* the present round is over and counted */
    uint32_t round;               /* number of the present one, from 1 */
    uint32_t ours, theirs, drawn; /* rounds won by either side; without a winner */
} JoxLiveMatch;

/* State of the page's loop that the status message reports: neither the scene nor the recording has
   it. */
typedef struct JoxLiveSession {
    bool paused;
    double speed;        /* wanted pace, simulated seconds per second */
    uint64_t dropped;    /* commands of browsers that the server refused so far */
    uint64_t jumps;      /* recordings: how often playback jumped to a frame other than the next */
    bool fixed;          /* ranges of values are fixed */
    JoxLiveEnd end;      /* scenes: why the loop has ended the run */
    const char *failure; /* of a failed run: why */
    const char *broke;   /* the breakpoint that paused the run, in words; NULL: none */
    JoxLiveMatch match;  /* scenes with a game */
} JoxLiveSession;

/* ---- messages of a running scene ---- */

/* Listener that collects the figures of a scene's messages; the scene owns it. */
typedef struct JoxLive JoxLive;
/* Writes {"type": "scene", ...}: the parts of a scene that rarely change. `restarts`: pages may
   begin the run, or a round of its game, anew. */
void jox_live_scene(JoScene *scene, bool restarts, JoxText *out);
/* The colour that a page begins with: the scene's `view`, else one that suits it. */
JoxLiveColour jox_live_first_colour(const JoScene *scene);
/* Returns a hash that changes when the scene message must be sent again: machines, walls, places or
   bodies have changed. */
uint64_t jox_live_version(const JoScene *scene);
/* Writes {"type": "status", ...}. `fired` counts the transitions of the last second; stage times
   and failures are means over the steps since the last status. */
void jox_live_status(JoScene *scene, const JoxLiveSession *session, JoxText *out);
/* Writes {"type": "reloaded", ...} of all that reloads changed since the last one; false: nothing,
   `out` is as before. */
bool jox_live_news(JoScene *scene, JoxText *out);
/* Returns whether the scene is sending as text what jox_live_news tells. */
bool jox_live_is_telling(JoScene *scene);
/* Binary messages, each in place of the content of `out`: a frame (kind 1); radii and groups of all
   people (kind 2; returns true if they differ from those that `out` held); a field (kind 3).
   `scales`: ranges of values, adapted; NULL: colours as fixed, a field up to its greatest value. */
void jox_live_frame(JoScene *scene, JoxLiveColour colour, JoxLiveScales *scales, JoxBytes *out);
bool jox_live_people(JoScene *scene, JoxBytes *out);
void jox_live_field(JoScene *scene, JoxLiveField field, JoxLiveScales *scales, JoxBytes *out);

/* ---- packing of crowds, running or recorded ---- */

/* Bytes of a frame's head, of a slot, of a body and of a lift's car; the state of an empty slot. */
enum { JOX_LIVE_HEAD = 48, JOX_LIVE_SLOT = 8, JOX_LIVE_BODY = 20, JOX_LIVE_CAR = 8 };
enum { JOX_LIVE_NOBODY = 255 };
/* State of people whose state is not in the scene message's list. */
enum { JOX_LIVE_OTHER_STATE = 254 };
/* The flags byte of a slot. Bit 0 flips when the position jumps (a new person in the slot, a
   periodic edge), so that the page does not draw a movement. The upper 5 bits say how the person
   leans under pushes, or what it does: 0 neither, else 1 + direction (eighths of a turn from the
   east) + 8 * level, where level k begins at jox_live_leans[k] N. */
enum { JOX_LIVE_PARITY = 1, JOX_LIVE_FAILED = 2, JOX_LIVE_PLAYER = 4 };
enum { JOX_LIVE_LEAN_SHIFT = 3, JOX_LIVE_LEANS = 3 };
/* Replace the lean: carries a body; holds on to somebody; lies on the floor. */
enum {
    JOX_LIVE_CARRIES = 25 << JOX_LIVE_LEAN_SHIFT,
    JOX_LIVE_HOLDS = 26 << JOX_LIVE_LEAN_SHIFT,
    JOX_LIVE_LIES = 31 << JOX_LIVE_LEAN_SHIFT
};
extern const float jox_live_leans[JOX_LIVE_LEANS];

/* The rectangle that packed positions are fractions of; it only grows. With storeys it is in plan.
 */
typedef struct JoxLiveArea {
    JoxV2 low, high;           /* m */
    JoxV2 steps;               /* units of a packed position per metre */
    bool known;                /* false: empty, nothing was covered yet */
    const JoxStoreys *storeys; /* NULL: one plane */
} JoxLiveArea;
/* Extends the area to hold a box of positions on one sheet. A side that must move moves by at least
   a quarter of the size, so that a spreading crowd does not move it in each frame. */
void jox_live_cover(JoxLiveArea *area, JoxV2 low, JoxV2 high);

typedef struct JoxLiveHead {
    uint32_t tick;
    double time;     /* s */
    uint32_t bodies; /* rows of bodies, gone ones included */
    const JoxLiveArea *area;
    JoxLiveScales *scales; /* adapted to the crowd; NULL: ranges are fixed */
} JoxLiveHead;
/* People as columns, in any order. A column that may be NULL is unknown then. */
typedef struct JoxLiveCrowd {
    uint32_t count, slots; /* people; slots: 1 + the greatest slot ever used */
    const uint32_t *slot;
    const float *x, *y, *vx, *vy; /* m, m/s */
    const float *face_x, *face_y; /* direction of view, any length; 0 or NULL: the velocity's */
    const float *value;           /* the colour's quantity; NULL where it follows from the rest */
    const float *radius;          /* m; or NULL */
    bool one_radius;              /* `radius` has one item, which holds for all */
    /* Torsos as in JoxFrame, m; NULL: all are discs. */
    const float *axis_x, *axis_y, *contact_radius;
    const uint16_t *group;        /* or NULL */
    const uint8_t *state, *flags; /* index in the scene message's "states"; JOX_LIVE_PARITY ... */
    JoxV2 period;                 /* m, size of a periodic world; 0 along an axis without edges */
    const JoxWalls *walls;        /* that stand (gates closed); or NULL */
    const JoxStoreys *storeys;    /* NULL: one plane */
    const JoxLift *lifts;         /* with `cars`, one for each */
    const JoxCarLook *cars;
    uint32_t lift_count;
} JoxLiveCrowd;
/* Sets the corners of the box of all people, m, in plan; false if there is nobody. */
bool jox_live_find_crowd_box(const JoxLiveCrowd *crowd, JoxV2 *low, JoxV2 *high);
/* Extends the area to hold all people. */
void jox_live_cover_crowd(JoxLiveArea *area, const JoxLiveCrowd *crowd);
/* Mean speed, m/s; 0 for an empty crowd. */
double jox_live_mean_speed(const JoxLiveCrowd *crowd);
/* Writes the frame's head and people, with free slots marked as empty, and makes room for the
   head's bodies, which jox_live_put_body writes. */
void jox_live_pack_frame(const JoxLiveHead *head, const JoxLiveCrowd *crowd, JoxLiveColour colour,
                         JoxBytes *out);
/* Writes a body into a packed frame: position of its origin, m; rotation, a quaternion x y z w.
   `slots`: the crowd's, as the frame was packed. */
void jox_live_put_body(JoxBytes *frame, uint32_t slots, uint32_t row, JoxV3 at,
                       const float turn[4]);
/* Appends the cars of lifts to a packed frame. */
void jox_live_add_cars(JoxBytes *frame, const JoxCarLook *cars, uint32_t count);
/* Writes radii and groups by slot over those in `out`; true if a byte of them changed. */
bool jox_live_pack_people(const JoxLiveCrowd *crowd, JoxBytes *out);

/* Densities of a crowd over an area, as last spread. Zero-initialise, free by
   jox_live_free_grid. */
typedef struct JoxLiveGrid {
    struct JoxDensity *grid;
    JoxV2 low, high; /* m in plan, the box that people may be in before the grid is made again */
} JoxLiveGrid;
/* Extends the area to hold the crowd, and computes the crowd's density on a grid about the people:
   how far the area extends where nobody is does not change it. */
void jox_live_spread(JoxLiveGrid *grid, JoxLiveArea *area, const JoxLiveCrowd *crowd);
/* Density at a point (0 outside the grid), and the greatest, 1/m2. */
float jox_live_density_at(const JoxLiveGrid *grid, float x, float y);
float jox_live_density_max(const JoxLiveGrid *grid);
/* R of the Gaussian, m: 1, more while people are spread so far that cells have to be wider; NAN
   before the first spread. */
float jox_live_density_r(const JoxLiveGrid *grid);
/* Writes a field message (kind 3) of values by cell of the grid; `scales` as for jox_live_field. */
void jox_live_pack_field(const struct JoxDensity *grid, const float *values, JoxLiveField field,
                         JoxLiveScales *scales, JoxBytes *out);
void jox_live_free_grid(JoxLiveGrid *grid);

/* live_storeys.c: the number of the deck at a position, which is a storey, or that of all storeys
   plus the index of a stair between them; and how high a person stands there, m: on the floor, or
   in the car of a lift. */
typedef struct JoxLiveStand {
    uint16_t deck;
    float height;
} JoxLiveStand;
JoxLiveStand jox_live_find_stand(const JoxLiveCrowd *crowd, JoxV2 at);
/* Sets the least and the greatest height that a person can stand at, m. */
void jox_live_find_heights(const JoxStoreys *storeys, float *low, float *high);
/* Adds the member "storeys" of a scene message, null for one plane: storeys and stairs. */
void jox_live_add_storeys(const JoxStoreys *storeys, JoxJson *json);

/* Adds the member "walls" of a scene message, an array of chains. */
void jox_live_add_walls(const JoxWalls *walls, JoxJson *json);
/* Adds the member "lifts" of a scene message, an array of lifts that are laid out. */
void jox_live_add_lifts(const JoxLift *lifts, uint32_t count, JoxJson *json);
/* Adds the member "walls" of a status, an object: for each name of a wall, whether it is open. */
void jox_live_add_gates(const JoxWalls *walls, JoxJson *json);
/* Adds the member "colours", an object: unit and greatest value by name of a colour. */
void jox_live_add_colours(JoxJson *json);

#endif
