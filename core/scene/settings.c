/* What a scene says of the whole: bounds, input, camera, the area of the density map. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/text.h"
#include "scene/internal.h"

void jox_key_bounds(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    JoxSceneSpec *s = item;
    (void)key;
    s->bounded = jox_load_box(r, node, &s->low, &s->high);
}

void jox_key_heatmap_area(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    JoxSceneSpec *s = item;
    (void)key;
    s->heatmap = jox_load_box(r, node, &s->heatmap_low, &s->heatmap_high);
}

/* Behind the bounds, which it joins. */
void jox_key_periodic(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    JoxSceneSpec *s = item;
    if (!node)
        return;
    int choice = node->kind == JOX_YAML_SCALAR ? jox_choice_find(key->choices, node->text) : -1;
    if (choice < 0) {
        jox_scene_error(r, node, "bad-value", NULL, "%s is none, x, y or both", key->name);
        return;
    }
    s->periodic_x = choice == 1 || choice == 3;
    s->periodic_y = choice == 2 || choice == 3;
    JoxV2 size = jox_sub(s->high, s->low);
    if (choice > 0 && !s->bounded)
        jox_scene_error(r, node, "bad-value", "bounds: [[0, 0], [20, 4]]",
                        "periodic edges need `bounds`");
    else if ((s->periodic_x && size.x < 1.0f) || (s->periodic_y && size.y < 1.0f))
        jox_scene_error(r, node, "bad-value", NULL,
                        "bounds that are joined must be at least 1 m apart");
}

/* Whether a file lies in one of the mods that are taken. */
static bool of_a_mod(const JoxLoad *l, const char *file) {
    for (uint32_t m = 0; l->options && m < l->options->mod_count; m++)
        if (jox_path_below(file, l->options->mods[m].folder))
            return true;
    return false;
}

void jox_key_input(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    JoxSceneSpec *s = item;
    if (node && node->kind != JOX_YAML_SCALAR)
        jox_scene_error(r, node, "bad-type", NULL, "%s must be a text", key->name);
    if (!node || node->kind != JOX_YAML_SCALAR)
        return;
    if (of_a_mod(r->load, node->position.file) && (*node->text == '/' || strstr(node->text, "..")))
        jox_scene_error(r, node, "bad-value", "A plain name, of a file beside it",
                        "a mod cannot read '%.100s'", node->text);
    else
        s->input = jox_arena_beside(r->arena, node->position.file, node->text);
}

bool jox_finish_camera(const JoxReader *r, const JoxYaml *map, void *item, bool good) {
    JoxSceneCamera *camera = item;
    (void)r;
    camera->given = good && jox_yaml_get(map, "position") && jox_yaml_get(map, "target");
    return good;
}

const char *jox_scene_colour(const JoxSceneSpec *scene, uint32_t states, uint32_t groups) {
    static const char *const NAMES[] = {
#define X(name) #name,
        JOX_SCENE_COLOURS(X)
#undef X
    };
    enum { TELLING_STATES = 3, MOST_GROUPS = 8 }; /* "walks" and "is gone" tell little */
    if (scene && scene->view.colour > 0)
        return NAMES[scene->view.colour - 1];
    return states >= TELLING_STATES               ? "state"
           : groups >= 2 && groups <= MOST_GROUPS ? "group"
                                                  : "speed";
}

const char *const jox_scene_tools[JOX_TOOL_COUNT] = {
#define X(tool, name) name,
    JOX_TOOLS(X)
#undef X
};
