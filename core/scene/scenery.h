/* Scenery: the floor's material and things that are drawn around people. The simulation reads none
   of it. scenery.c reads it, scene_look.c writes it for the page and recordings,
   picture/draw_scenery.c draws it from above, and run/scenery_checks.c warns of things that stand
   where people walk. */
#ifndef JOX_SCENE_SCENERY_H
#define JOX_SCENE_SCENERY_H

#include "base/format/colour.h"
#include "base/format/diag.h"
#include "base/vec.h"

/* Materials of the floor, in the order of the choices of the key `floor`. */
#define JOX_FLOORS(X)                                                                              \
    X(PLAIN, "plain")                                                                              \
    X(MARBLE, "marble")                                                                            \
    X(ASPHALT, "asphalt")                                                                          \
    X(CONCRETE, "concrete")                                                                        \
    X(GRASS, "grass")                                                                              \
    X(WOOD, "wood")                                                                                \
    X(COURT, "court")                                                                              \
    X(SAND, "sand")                                                                                \
    X(PAVING, "paving")                                                                            \
    X(CARPET, "carpet")

/* How a thing is placed, and whether people cannot walk through it: at points, and solid or not;
   along a polyline; over a polygon. */
typedef enum JoxSceneryForm {
    JOX_SCENERY_OPEN,  /* at points, and people pass under it or over it */
    JOX_SCENERY_SOLID, /* at points; its footprint is a box */
    JOX_SCENERY_LINE,  /* along `through`, flat on the floor */
    JOX_SCENERY_FENCE, /* along `through`, solid */
    JOX_SCENERY_AREA   /* over the polygon `through`, flat on the floor */
} JoxSceneryForm;

/* Kinds of things: enumerator, name, form, default lengths along x, y and z (of LINE and FENCE:
   width and height are y and z), m, and meaning. `solid` footprints are what stands on the floor,
   as the trunk of a tree. */
#define JOX_SCENERY_KINDS(X)                                                                       \
    X(LINE, "line", LINE, 0, 0.08, 0, "painted line")                                              \
    X(RING, "ring", OPEN, 3.6, 3.6, 0, "painted circle")                                           \
    X(AREA, "area", AREA, 0, 0, 0, "painted or paved area")                                        \
    X(BLOCK, "block", SOLID, 1, 1, 1, "box")                                                       \
    X(PARAPET, "parapet", FENCE, 0, 0.3, 1, "low wall with a coping")                              \
    X(FENCE, "fence", FENCE, 0, 0.06, 1.1, "railing")                                              \
    X(HEDGE, "hedge", FENCE, 0, 0.7, 1, "hedge")                                                   \
    X(PILLAR, "pillar", SOLID, 0.6, 0.6, 4, "round pillar")                                        \
    X(ARCADE, "arcade", SOLID, 24, 5, 9, "row of arches, open towards -y")                         \
    X(MINARET, "minaret", SOLID, 5, 5, 60, "minaret")                                              \
    X(HOUSE, "house", SOLID, 8, 6, 10, "house, whose front looks towards -y")                      \
    X(TREE, "tree", SOLID, 4, 4, 6, "tree")                                                        \
    X(BUSH, "bush", SOLID, 1.2, 1.2, 1, "bush")                                                    \
    X(LAMP, "lamp", SOLID, 0.2, 0.2, 5, "street lamp")                                             \
    X(BENCH, "bench", SOLID, 1.8, 0.6, 0.8, "bench, to sit towards -y")                            \
    X(SEATS, "seats", SOLID, 10, 3, 1.8, "rows of seats that rise away from -y")                   \
    X(STALL, "stall", SOLID, 2.6, 1.6, 2.4, "market stall with an awning, open towards -y")        \
    X(STAGE, "stage", SOLID, 12, 6, 6, "stage with lights and loudspeakers, open towards -y")      \
    X(GOAL, "goal", OPEN, 3, 1, 2, "goal with a net, open towards -y")                             \
    X(POSTS, "posts", OPEN, 5.6, 0.2, 8, "goal posts with a cross-bar")                            \
    X(SIGN, "sign", OPEN, 0.9, 0.1, 0.35, "green sign of an exit, 2.4 m above the floor")          \
    X(TURNSTILE, "turnstile", SOLID, 1, 0.5, 1.1, "housing of a ticket gate")                      \
    X(KIOSK, "kiosk", SOLID, 2, 2, 2.6, "kiosk")                                                   \
    X(TRAIN, "train", OPEN, 20, 2.8, 3.4, "carriage, with doors towards -y")                       \
    X(KAABA, "kaaba", SOLID, 12, 10, 13.1, "draped cube with a gold band and a door towards +x")   \
    X(MAQAM, "maqam", SOLID, 1, 1, 3, "gilded glass shrine")
typedef enum JoxSceneryKind {
#define X(kind, name, form, x, y, z, meaning) JOX_SCENERY_KIND_##kind,
    JOX_SCENERY_KINDS(X)
#undef X
        JOX_SCENERY_KIND_COUNT
} JoxSceneryKind;

typedef struct JoxSceneryKindInfo {
    const char *name;
    JoxSceneryForm form;
    double size[3]; /* m */
} JoxSceneryKindInfo;
extern const JoxSceneryKindInfo jox_scenery_kinds[JOX_SCENERY_KIND_COUNT];
extern const char *const jox_floor_names[];
extern const uint32_t jox_floor_count;

/* One item of `scenery`. */
typedef struct JoxScenery {
    uint32_t kind;  /* JoxSceneryKind */
    JoxV2 *at;      /* m: centres of its copies */
    JoxV2 *through; /* m: points of a line, fence or area */
    uint32_t at_count, through_count;
    double turn;   /* degrees, anti-clockwise */
    double *turns; /* of a recording: turn of each copy, degrees, in place of `turn` and `faces` */
    JoxV2 *faces;  /* m: point that the front of each copy looks at, before it is turned; or NULL */
    uint32_t face_count;
    double size[3]; /* m */
    double *doors;  /* m: where along a train its doors are, from its middle */
    uint32_t door_count;
    JoxColour colour; /* 0: that of its kind */
    char *body;       /* name of the body that carries it; NULL: it stands */
    JoxPosition position;
} JoxScenery;

/* Returns the direction of a copy's x axis, degrees, anti-clockwise. */
double jox_scenery_turn(const JoxScenery *scenery, uint32_t copy);
/* Writes the corners of the box on the floor that a copy covers, m, anti-clockwise; of a tree and a
   lamp: that of its trunk. */
void jox_scenery_footprint(const JoxScenery *scenery, uint32_t copy, JoxV2 corners[4]);

#endif
