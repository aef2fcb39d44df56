/* What the files of scene share while one is loaded. Functions named jox_key_... read the keys that
   have them in their rows of keys.c; functions named jox_finish_... and jox_link_... are those of
   owners there (schema.h). */
#ifndef JOX_SCENE_INTERNAL_H
#define JOX_SCENE_INTERNAL_H

#include "scene/format/schema.h"
#include "scene/scene.h"

typedef struct JoxLoad {
    JoxReader reader;
    JoxSceneSpec *scene;
    const JoxSceneOptions *options; /* or NULL */
    const char *datadir;
    JoxYamlFiles *files; /* read for the scene */
    const JoxYaml *root; /* of the whole scene, merged */
    bool walls_wrong;    /* some could not be read: their names are not known */
    /* Of what is being read, until it is whole. */
    double block_mass; /* kg, of the blocks of a body; NAN: not given */
    double pieces;     /* bodies so far, their blocks and their parts */
    struct JoxLoadFill {
        uint32_t *in, *outside; /* places to fill, and to keep out of */
        uint32_t in_count, outside_count;
        double density; /* 1/m2; NAN: not given */
        float spacing;  /* m, least; NAN: not given */
    } fill;             /* of a group */
} JoxLoad;

typedef void JoxKeyRead(const JoxReader *reader, const JoxKey *key, const JoxYaml *node,
                        void *item);
typedef bool JoxOwnerFinish(const JoxReader *reader, const JoxYaml *map, void *item, bool good);

/* A wall, and a body with its copies, as they are read. */
typedef struct JoxLoadWall {
    int kind;
    float height;
    bool closed, open;
    char *name;
    double unit, origin[2];
    JoxV2 *points;
    uint32_t count;
    const JoxYaml *file;
} JoxLoadWall;
enum { JOX_WALL_SOLID, JOX_WALL_LINE, JOX_WALL_FILE };
typedef struct JoxLoadBody {
    JoxSceneBody body;
    double mass, density;          /* NAN: not given */
    double path_force;             /* N, of a path; NAN: not given */
    double copies[3], distance[3]; /* of a body that is repeated */
} JoxLoadBody;

/* names.c. Index by name, or -1 with an error that suggests one. */
int32_t jox_load_place(const JoxReader *reader, const JoxYaml *name);
int32_t jox_load_group(const JoxReader *reader, const JoxYaml *name);
/* An index in an int32_t, -1 where the key is missing or wrong; a text that must be a name; tags; a
   colour, 0 where the key is missing or wrong. */
JoxKeyRead jox_key_place, jox_key_group, jox_key_name, jox_key_tags, jox_key_colour;

/* outlines.c. A polygon's corners, counter-clockwise; NULL, and no points, with an error. */
JoxV2 *jox_load_ring(const JoxReader *reader, const JoxYaml *node, uint32_t *count);
/* Two opposite corners; false if `node` is NULL or wrong. */
bool jox_load_box(const JoxReader *reader, const JoxYaml *node, JoxV2 *low, JoxV2 *high);
/* Points and their number: a ring; any points; one point; a line of two; two such lines. */
JoxKeyRead jox_key_ring, jox_key_points, jox_key_point, jox_key_line, jox_key_lines;
/* Two corners, low and high; with low above high where the key is missing. */
JoxKeyRead jox_key_box;

/* places.c */
JoxKeyRead jox_key_place_points, jox_key_place_start, jox_key_regions;
JoxOwnerFinish jox_finish_place;
void jox_link_place(const JoxReader *reader, const JoxYaml *map, void *item);

/* settings.c */
JoxKeyRead jox_key_bounds, jox_key_periodic, jox_key_input, jox_key_heatmap_area;
JoxOwnerFinish jox_finish_camera;

/* walls.c */
JoxKeyRead jox_key_walls, jox_key_wall_points, jox_key_wall_file;

/* bodies.c */
JoxKeyRead jox_key_bodies, jox_key_turn, jox_key_hull, jox_key_path, jox_key_block_count,
    jox_key_block_mass, jox_key_copies;
JoxKeyRead jox_key_part_shape;

/* groups.c, sets.c, populate.c, starts.c */
JoxKeyRead jox_key_behaviour, jox_key_mix, jox_key_values, jox_key_facing, jox_key_fills,
    jox_key_starts;
JoxOwnerFinish jox_finish_group;
/* Where a group's agents stand; the groups before it have been read. */
void jox_load_positions(const JoxReader *reader, const JoxYaml *map, JoxGroup *group);
/* Those of a group that have starts: the first of them stand there. */
void jox_load_starts(const JoxReader *reader, const JoxYaml *map, JoxGroup *group);

/* journeys.c: a duration, the queues and the gate of a step; the behaviour of a group's journey,
   which takes its place. */
JoxKeyRead jox_key_duration, jox_key_queues, jox_key_gate;
JoxOwnerFinish jox_finish_step;
void jox_load_journey(const JoxReader *reader, const JoxYaml *map, JoxGroup *group);

/* events.c: reports a name that no wall has. */
void jox_load_wall(const JoxReader *reader, const JoxYaml *name);

/* sources.c, events.c, probes.c */
JoxKeyRead jox_key_times, jox_key_curve;
JoxOwnerFinish jox_finish_source, jox_finish_sink, jox_finish_event, jox_finish_probe,
    jox_finish_tally;
JoxKeyRead jox_key_event_name;
JoxKeyRead jox_key_true, jox_key_states, jox_key_groups;

/* mods_read.c */
JoxKeyRead jox_key_settings;
JoxOwnerFinish jox_finish_setting;

/* override.c: sets PATH=VALUE; what is wrong with it is reported at this name in place of a file.
 */
#define JOX_LOAD_OVERRIDE "--set"
/* Where a map holds a key's value, or a list the item of a number or with a `name`; NULL if it does
   not. */
JoxYaml **jox_load_slot(const JoxYaml *node, const char *key);
void jox_load_override(const JoxLoad *load, JoxYaml *root, const char *set);
/* patch.c: merges what mods change into the tree; the result may be another tree. */
JoxYaml *jox_load_patches(JoxLoad *load, JoxYaml *root, JoxYamlFiles *files);

#endif
