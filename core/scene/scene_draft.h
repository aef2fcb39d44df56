/* The state while one scene is read, and the functions that read its keys. read_specification.c
   makes the draft and walks the table (key_table.c), which calls jox_key_read_... for keys,
   jox_finish_... and jox_resolve_... for owners (see JoxKey and JoxOwner in format/keys.h). Each
   stands in the file of its subject, named below. */
#ifndef JOX_SCENE_SCENE_DRAFT_H
#define JOX_SCENE_SCENE_DRAFT_H

#include "scene/format/keys.h"
#include "scene/scene.h"

/* The struct of the owner "stair" while it is read. */
typedef struct JoxStairDraft {
    JoxStair stair; /* storeys from, to: `lower`, `upper` */
    uint32_t kind, way;
    double speed, rise; /* m/s, m; NAN: not given */
    JoxPosition position;
} JoxStairDraft;
typedef struct JoxStoreysDraft {
    JoxStorey *storeys;
    uint32_t storey_count;
    JoxStairDraft *stairs;
    uint32_t stair_count;
} JoxStoreysDraft;

/* The struct of the owner "lift" while it is read. */
typedef struct JoxLiftDraft {
    JoxLift lift;
    JoxV2 door[2]; /* m: of storeys without an own one, if has_door */
    uint32_t has_door;
    struct JoxDoorDraft {
        uint32_t storey;
        JoxV2 ends[2];
        JoxPosition position;
    } * doors;
    uint32_t door_count;
    double load;          /* kg; NAN: not given */
    uint32_t home, first; /* storeys, if given */
    JoxPosition position;
} JoxLiftDraft;

/* A scene while it is read. `reader.draft` points to it. */
typedef struct JoxSceneDraft {
    JoxReader reader;
    JoxSceneSpec *scene;            /* filled as keys are read */
    const JoxSceneOptions *options; /* or NULL */
    const char *datadir;            /* folder of installed behaviours/; NULL: as built */
    JoxYamlFiles *files;            /* read for the scene so far */
    const JoxYaml *root;            /* the scene's tree, with includes and mods merged */
    bool walls_wrong;        /* some walls could not be read: names of walls are not checked then */
    JoxStoreysDraft storeys; /* as they are written */
    JoxLiftDraft *lifts;     /* likewise */
    uint32_t lift_count;
    bool lifts_wrong; /* some lifts could not be read: their places are missing, and not reported */
    bool measuring;   /* only the extent of all points is of interest: no groups are placed */
    double pieces;    /* bodies read so far, counting their blocks and parts: bounded in all */
    /* Values of the body or group that is being read, until it is complete. */
    double block_mass; /* kg, of each block of the body; NAN: not given */
    struct JoxFillDraft {
        uint32_t *in, *outside; /* places to fill, and to keep out of */
        uint32_t in_count, outside_count;
        double density; /* 1/m2; NAN: not given */
        float spacing;  /* m, least distance between agents; NAN: not given */
    } fill;
} JoxSceneDraft;

typedef void JoxKeyRead(const JoxReader *reader, const JoxKey *key, const JoxYaml *node,
                        void *item);
typedef bool JoxOwnerFinish(const JoxReader *reader, const JoxYaml *map, void *item, bool good);

/* The structs of the owners "wall" and "body" while they are read. */
enum { JOX_WALL_SOLID, JOX_WALL_LINE, JOX_WALL_FILE };
typedef struct JoxWallDraft {
    int kind;          /* JOX_WALL_... */
    float height;      /* m */
    float drawn;       /* m: height as drawn; NAN: not given */
    bool closed, open; /* its ends are joined; it is an open gate at the start */
    char *name;        /* NULL: it has none */
    double unit;       /* m, of a file's lengths */
    double origin[2];  /* point of the file, in its lengths, that becomes 0, 0 */
    JoxV2 *points;     /* m */
    uint32_t count;
    const JoxYaml *file; /* its name */
    float shift;         /* m along y: of a file's walls, to the sheet of their storey */
} JoxWallDraft;
typedef struct JoxBodyDraft {
    JoxSceneBody body;
    double mass, density;          /* kg, kg/m3; NAN: not given */
    double path_force;             /* N, force limit of its path; NAN: not given */
    double copies[3], distance[3]; /* copies along x, y and z, and m from one to the next */
} JoxBodyDraft;

/* names_and_tags.c. The first two return an index, or -1 with an error that suggests a name; the
   third reports a name that no wall has and, with `stairs`, no stair. */
int32_t jox_scene_find_place(const JoxReader *reader, const JoxYaml *name);
int32_t jox_scene_find_group(const JoxReader *reader, const JoxYaml *name);
void jox_scene_check_wall(const JoxReader *reader, const JoxYaml *name, bool stairs);
/* Read a place or group into an int32_t, -1 if missing or wrong; a text that must be a valid name;
   a list of tags; a colour, unchanged if missing or wrong. */
JoxKeyRead jox_key_read_place, jox_key_read_group, jox_key_read_name, jox_key_read_tags,
    jox_key_read_colour;

/* polygons_and_lines.c. Reads a polygon's corners, which it orders counter-clockwise; NULL and a
   count of 0 with an error. */
JoxV2 *jox_read_polygon(const JoxReader *reader, const JoxYaml *node, uint32_t *count);
/* Reads two opposite corners; false if `node` is NULL or wrong. */
bool jox_read_box(const JoxReader *reader, const JoxYaml *node, JoxV2 *low, JoxV2 *high);
/* Read points and their number: of a polygon; any points; one point; a line of two points; two such
   lines. */
JoxKeyRead jox_key_read_ring, jox_key_read_points, jox_key_read_point, jox_key_read_line,
    jox_key_read_lines;
/* Reads two corners into two JoxV2; low is above high if the key is missing. */
JoxKeyRead jox_key_read_box;

/* storeys.c. Reads the `storey` of a map, on whose sheet its points lie from then on; the stairs of
   a scene, after which storeys are laid out; storeys that a stair joins, into a uint32_t; its
   landings. */
/* Returns the index of a storey, or -1 with an error that suggests a name. */
int32_t jox_scene_find_storey(const JoxReader *reader, const JoxYaml *name);
JoxKeyRead jox_key_read_storey, jox_key_read_stairs, jox_key_read_stair_storey,
    jox_key_read_landings;
JoxOwnerFinish jox_finish_storey, jox_finish_stair;

/* stair_checks.c. Checks a stair whose keys are read; checks all storeys and stairs once the scene
   is read without errors. */
void jox_scene_check_stair(const JoxReader *reader, const JoxYaml *map, const JoxStair *stair);
void jox_scene_check_storeys(const JoxReader *reader);

/* floor_checks.c. Checks that people, bodies, sources and places of a whole scene have floor; warns
   of a wall, of the rings from `first` on, that leads into a stair or shaft. */
void jox_scene_check_floors(const JoxReader *reader);
void jox_scene_check_wall_floor(const JoxReader *reader, const JoxYaml *wall, uint32_t first);
struct JoxFillDraft;
/* Reports a place in a shaft that a group would fill; false with an error. */
bool jox_scene_check_fill(const JoxReader *reader, const JoxYaml *map,
                          const struct JoxFillDraft *fill);
/* Appends the shafts of lifts as solid walls, but for a car that a group fills where it stands. */
void jox_scene_add_shafts(const JoxSceneSpec *scene, const struct JoxFillDraft *fill,
                          JoxWalls *walls);

/* places.c */
JoxKeyRead jox_key_read_place_points, jox_key_read_place_start, jox_key_read_regions;
JoxOwnerFinish jox_finish_place;
void jox_resolve_place(const JoxReader *reader, const JoxYaml *map, void *item);

/* bounds_and_view.c. Whether a point lies within the bounds, or there are none; whether a file lies
   in the folder of one of the scene's mods. */
bool jox_scene_is_within_bounds(const JoxSceneSpec *scene, JoxV2 point);
bool jox_scene_is_mod_file(const JoxSceneDraft *draft, const char *file);
JoxKeyRead jox_key_read_bounds, jox_key_read_periodic, jox_key_read_input,
    jox_key_read_heatmap_area;
JoxOwnerFinish jox_finish_camera;

/* walls.c */
JoxKeyRead jox_key_read_walls, jox_key_read_wall_points, jox_key_read_wall_file;

/* bodies.c */
JoxKeyRead jox_key_read_bodies, jox_key_read_turn, jox_key_read_hull, jox_key_read_path,
    jox_key_read_block_count, jox_key_read_copies;
JoxKeyRead jox_key_read_part_shape;

/* scenery.c */
JoxKeyRead jox_key_read_scenery_at, jox_key_read_doors;
JoxOwnerFinish jox_finish_scenery;
void jox_resolve_scenery(const JoxReader *reader, const JoxYaml *map, void *item);

/* groups.c, group_values.c, group_positions.c, group_starts.c */
JoxKeyRead jox_key_read_behaviour, jox_key_read_mix, jox_key_read_values, jox_key_read_facing,
    jox_key_read_fills, jox_key_read_starts;
JoxOwnerFinish jox_finish_group;
/* Computes the positions of a group's agents at the start. Agents of the groups before it, which
   have been read, keep their room. */
void jox_place_group(const JoxReader *reader, const JoxYaml *map, JoxGroup *group);
/* The same for a group with `starts`: those of time 0 are its agents at the start. */
void jox_place_group_starts(const JoxReader *reader, const JoxYaml *map, JoxGroup *group);

/* lifts.c */
JoxKeyRead jox_key_read_lifts, jox_key_read_lift_area, jox_key_read_lift_door;
JoxKeyRead jox_key_read_lift_doors, jox_key_read_lift_storeys;
JoxOwnerFinish jox_finish_lift;
void jox_scene_add_lift_walls(const JoxSceneSpec *scene, JoxWalls *walls);
/* Returns whether a place is the floor of a lift's car. */
bool jox_scene_is_lift_place(const JoxSceneSpec *scene, int32_t place);
/* Reports a name that no lift has. */
void jox_scene_check_lift(const JoxReader *reader, const JoxYaml *name);
/* Returns whether a text names a lift, or one of its places, that could not be read. */
bool jox_scene_is_wrong_lift(const JoxReader *reader, const char *text);

/* journeys.c */
JoxKeyRead jox_key_read_duration, jox_key_read_queues, jox_key_read_gate, jox_key_read_ride;
JoxOwnerFinish jox_finish_step;
/* Writes the behaviour of a group's journey, in Lua, and makes it the group's only behaviour. */
void jox_write_journey_behaviour(const JoxReader *reader, const JoxYaml *map, JoxGroup *group);

/* sources_and_sinks.c */
JoxKeyRead jox_key_read_times, jox_key_read_curve;
JoxOwnerFinish jox_finish_source, jox_finish_sink;

/* events.c */
JoxKeyRead jox_key_read_event_name;
JoxOwnerFinish jox_finish_event;

/* probes_and_tallies.c */
JoxKeyRead jox_key_read_true, jox_key_read_states, jox_key_read_groups;
JoxOwnerFinish jox_finish_probe, jox_finish_tally;

/* game.c */
JoxKeyRead jox_key_read_tally;
JoxOwnerFinish jox_finish_game, jox_finish_level;

/* criteria.c */
JoxKeyRead jox_key_read_criterion_probe;
JoxOwnerFinish jox_finish_criterion;

/* mods_read.c */
JoxKeyRead jox_key_read_settings;
JoxKeyRead jox_key_read_setting_choices;
JoxOwnerFinish jox_finish_setting;

/* command_line_values.c. The name that stands for a file in positions of values set by --set. */
#define JOX_SET_OPTION "--set"
/* Sets PATH=VALUE in the tree, before it is read; the path must exist there or in the table. */
void jox_scene_set_value(const JoxSceneDraft *draft, JoxYaml *root, const char *set);
/* mods_patch_scene.c. Merges the patches of all mods for this scene into the tree; returns the
   result, which may be another tree. */
JoxYaml *jox_mods_patch_scene(JoxSceneDraft *draft, JoxYaml *root, JoxYamlFiles *files);

#endif
