/* What the files of scene share while one is loaded. */
#ifndef JOX_SCENE_INTERNAL_H
#define JOX_SCENE_INTERNAL_H

#include "agents/parameters.h"
#include "scene/scene.h"
#include "scene/schema.h"

typedef struct JoxLoad {
    JoxReader reader;
    JoxSceneSpec *scene;
    const JoxSceneOptions *options; /* or NULL */
    const char *datadir;
    JoxYamlFiles *files; /* read for the scene */
    const JoxYaml *root; /* of the whole scene, merged */
    bool walls_wrong;    /* some could not be read: their names are not known */
} JoxLoad;

/* Index by name, or -1 with an error that suggests one. */
int32_t jox_load_place(const JoxLoad *load, const JoxYaml *name);
int32_t jox_load_group(const JoxLoad *load, const JoxYaml *name);
JoxGroupValue *jox_load_sets(const JoxLoad *load, const JoxYaml *map, bool numbers_only,
                             uint32_t *count);
/* The text of a key that is a name; "" where it is missing, an error where it can be none. */
char *jox_load_name(const JoxLoad *load, const JoxYaml *map, const char *owner, const char *key);
char **jox_load_tags(const JoxLoad *load, const JoxYaml *node, uint32_t *count);
/* populate.c: where a group's agents stand. */
void jox_load_positions(const JoxLoad *load, const JoxYaml *map, JoxGroup *group, uint32_t number);
/* override.c: sets PATH=VALUE; what is wrong with it is reported at this name in place of a file.
 */
#define JOX_LOAD_OVERRIDE "--set"
void jox_load_override(const JoxLoad *load, JoxYaml *root, const char *set);
/* patch.c: merges what mods change into the tree; the result may be another tree. */
JoxYaml *jox_load_patches(JoxLoad *load, JoxYaml *root, JoxYamlFiles *files);
/* Two opposite corners; false if `node` is NULL or wrong. */
bool jox_load_box(const JoxLoad *load, const JoxYaml *node, JoxV2 *low, JoxV2 *high);
/* probes.c */
void jox_load_probes(JoxLoad *load, const JoxYaml *map);
/* A polygon's corners, counter-clockwise; NULL, and no points, with an error. */
JoxV2 *jox_load_ring(const JoxLoad *load, const JoxYaml *node, uint32_t *count);
/* events.c: walls; events, after walls and bodies. */
void jox_load_walls(JoxLoad *load, const JoxYaml *list);
void jox_load_events(JoxLoad *load, const JoxYaml *list);
/* view.c: camera, view. */
void jox_load_view(const JoxLoad *load, const JoxYaml *root);
/* shapes.c */
void jox_load_bodies(JoxLoad *load, const JoxYaml *list);

#endif
