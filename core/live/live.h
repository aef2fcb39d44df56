/* What a live page is shown of a running scene, or of a recording: JSON objects, and packed frames
   of little-endian binary. Everything is by slot (JoxAgents.slot), which a person keeps while
   alive. Reads the world between two steps and changes nothing of it. */
#ifndef JOX_LIVE_LIVE_H
#define JOX_LIVE_LIVE_H

#include "base/format/json_writer.h"
#include "base/text.h"
#include "base/vec.h"
#include "geom/walls.h"
#include "jostle_tools.h"

/* Of the messages: a page of another number asks to be loaded anew. */
enum { JOX_LIVE_PROTOCOL = 3 };

/* Growing bytes; zero-initialise, `length = 0` to use again, free by jox_bytes_free. */
typedef struct JoxBytes {
    uint8_t *data;
    size_t length, capacity;
} JoxBytes;
void jox_bytes_free(JoxBytes *bytes);

/* What a frame's `value` measures; scaled so that 255 is the frame's value_most. */
#define JOX_LIVE_COLOURS(X)                                                                        \
    X(state, 0, "") /* value is 0: the frame has the state */                                      \
    X(speed, 2, "m/s")                                                                             \
    X(force, 500, "N") /* magnitude of the net force */                                            \
    X(compression, 1000, "N/m")                                                                    \
    X(load, 1112, "N") /* greatest push from any one direction */                                  \
    X(density, 8, "1/m2")                                                                          \
    X(group, 255, "")     /* value is the number of the group */                                   \
    X(direction, 0, "")   /* value is 0: the frame has the heading */                              \
    X(service, 8, "1/m2") /* density, shown by levels of service */
typedef enum JoxLiveColour {
#define X(name, most, unit) JOX_LIVE_COLOUR_##name,
    JOX_LIVE_COLOURS(X)
#undef X
        JOX_LIVE_COLOUR_COUNT
} JoxLiveColour;
typedef struct JoxLiveColourInfo {
    const char *name, *unit;
    float most;
} JoxLiveColourInfo;
extern const JoxLiveColourInfo jox_live_colours[JOX_LIVE_COLOUR_COUNT];
/* Number of a colour by name, or -1. */
int jox_live_colour(const char *name);

typedef enum JoxLiveField {
    JOX_LIVE_DENSITY,  /* people per m2, Gaussian kernel (see live_field.c) */
    JOX_LIVE_PRESSURE, /* density times the local variance of velocity, 1/s2 */
    JOX_LIVE_FIELDS    /* none */
} JoxLiveField;
/* Number of a field by name, JOX_LIVE_FIELDS for "none", or -1. */
int jox_live_field_named(const char *name);
const char *jox_live_field_name(JoxLiveField field);

/* What of a session only the one who steps knows. */
typedef struct JoxLiveSession {
    bool paused;
    double speed;     /* wanted, simulated seconds in a second */
    uint64_t dropped; /* messages that were refused */
    uint64_t jumps;   /* of a recording: how often it went elsewhere than to the next frame */
} JoxLiveSession;

typedef struct JoxLive JoxLive;
/* {"type": "scene", ...}: all that stays as it is for a while. */
void jox_live_scene(JoScene *scene, JoxText *out);
/* What people are coloured by until a page asks for something else. */
JoxLiveColour jox_live_first_colour(const JoScene *scene);
/* Another number whenever that message is due again: machines, walls, places or bodies changed. */
uint64_t jox_live_version(const JoScene *scene);
/* {"type": "status", ...}. `fired`, times and failures are those since the last second or status.
 */
void jox_live_status(JoScene *scene, const JoxLiveSession *session, JoxText *out);
/* Binary, in place of what `out` held. A frame (kind 1); radii and groups of everybody (kind 2;
   true if they differ from what `out` held); a field (kind 3). */
void jox_live_frame(JoScene *scene, JoxLiveColour colour, JoxBytes *out);
bool jox_live_people(JoScene *scene, JoxBytes *out);
void jox_live_field(JoScene *scene, JoxLiveField field, JoxBytes *out);

/* ---- packing, from whatever source ---- */

enum { JOX_LIVE_HEAD = 48, JOX_LIVE_SLOT = 8, JOX_LIVE_BODY = 20, JOX_LIVE_NOBODY = 255 };
/* State of those who are none of the scene message's list names. */
enum { JOX_LIVE_OTHER_STATE = 254 };
/* Flags. Above them stands how somebody leans under pushes: 0, or 1 + the way (eighths of a turn
   from the east) + 8 times the step, of which each begins with so many N. */
enum { JOX_LIVE_PARITY = 1, JOX_LIVE_FAILED = 2, JOX_LIVE_PLAYER = 4 };
enum { JOX_LIVE_LEAN_SHIFT = 3, JOX_LIVE_LEANS = 3 };
enum { JOX_LIVE_LIES = 31 << JOX_LIVE_LEAN_SHIFT }; /* in place of a lean */
extern const float jox_live_leans[JOX_LIVE_LEANS];

/* The area that positions are counted over; it only grows. */
typedef struct JoxLiveArea {
    JoxV2 low, high; /* m */
    JoxV2 steps;     /* of a position, per metre */
    bool known;
} JoxLiveArea;
/* Makes room for a box. One that is known grows by at least a quarter at the side where it must. */
void jox_live_cover(JoxLiveArea *area, JoxV2 low, JoxV2 high);

typedef struct JoxLiveHead {
    uint32_t tick;
    double time; /* s */
    uint32_t bodies;
    const JoxLiveArea *area;
} JoxLiveHead;
/* People as columns, in any order. Those that may be NULL are not known then. */
typedef struct JoxLiveCrowd {
    uint32_t count, slots; /* slots: one more than the greatest that anybody had */
    const uint32_t *slot;
    const float *x, *y, *vx, *vy; /* m, m/s */
    const float *face_x, *face_y; /* the way they look, of any length; 0 or NULL: as they go */
    const float *value;           /* of the colours that are not made of the other columns */
    const float *radius;          /* m; or NULL */
    bool one_radius;              /* it is one number, that of all */
    const uint16_t *group;        /* or NULL */
    const uint8_t *state, *flags; /* number in the scene message's list; JOX_LIVE_PARITY ... */
    JoxV2 period;                 /* m: of periodic edges; 0 without */
    const JoxWalls *walls;        /* as they stand; or NULL */
} JoxLiveCrowd;
/* Makes the area hold everybody. */
void jox_live_cover_crowd(JoxLiveArea *area, const JoxLiveCrowd *crowd);
/* m/s; 0 of nobody. */
double jox_live_mean_speed(const JoxLiveCrowd *crowd);
/* Sizes `out` for the frame and its head's bodies, writes the head and the people; slots that
   nobody has are empty. */
void jox_live_pack_frame(const JoxLiveHead *head, const JoxLiveCrowd *crowd, JoxLiveColour colour,
                         JoxBytes *out);
/* `slots`: as of the frame's head. */
void jox_live_put_body(JoxBytes *frame, uint32_t slots, uint32_t row, JoxV3 at,
                       const float turn[4]);
/* True if that changed the bytes: radii and groups. */
bool jox_live_pack_people(const JoxLiveCrowd *crowd, JoxBytes *out);

/* Densities of a crowd over an area. Zero-initialise. */
typedef struct JoxLiveGrid {
    struct JoxDensity *grid;
    JoxV2 low, high;
} JoxLiveGrid;
/* Spreads the crowd, which the area is made to hold. */
void jox_live_spread(JoxLiveGrid *grid, JoxLiveArea *area, const JoxLiveCrowd *crowd);
/* As last spread, 1/m2: at a point, and the greatest. */
float jox_live_density_at(const JoxLiveGrid *grid, float x, float y);
float jox_live_density_max(const JoxLiveGrid *grid);
/* R of its Gaussian, m: 1 but on wide cells; NAN before the first. */
float jox_live_density_r(const JoxLiveGrid *grid);
/* Values of a grid's cells. */
void jox_live_pack_field(const struct JoxDensity *grid, const float *values, JoxLiveField field,
                         JoxBytes *out);
void jox_live_free_grid(JoxLiveGrid *grid);

/* Walls of a scene or a recording: the member "walls", a list. */
void jox_live_add_walls(const JoxWalls *walls, float height, JoxJson *json);
/* Which walls of a name stand open: the member "walls" of a status, an object. */
void jox_live_add_gates(const JoxWalls *walls, JoxJson *json);
/* The member "colours", an object. */
void jox_live_add_colours(JoxJson *json);

#endif
