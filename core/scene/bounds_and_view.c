/* Reads keys of the whole scene: bounds, input log, camera, area of the density map; and chooses
   the quantity that agents are coloured by. */
#include <string.h>

#include "base/assert.h"
#include "base/text.h"
#include "scene/scene_draft.h"

void jox_key_read_bounds(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    JoxSceneSpec *s = item;
    (void)key;
    s->bounded = jox_read_box(r, node, &s->low, &s->high);
}

bool jox_scene_is_within_bounds(const JoxSceneSpec *s, JoxV2 p) {
    p = jox_in_plan(&s->storeys, p);
    return !s->bounded ||
           (p.x >= s->low.x && p.x <= s->high.x && p.y >= s->low.y && p.y <= s->high.y);
}

void jox_key_read_heatmap_area(const JoxReader *r, const JoxKey *key, const JoxYaml *node,
                               void *item) {
    JoxSceneSpec *s = item;
    (void)key;
    s->heatmap = jox_read_box(r, node, &s->heatmap_low, &s->heatmap_high);
}

/* Reads which bounds are joined; the bounds have been read. */
void jox_key_read_periodic(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
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
    else if (s->periodic_y && jox_yaml_get(r->draft->root, "storeys"))
        jox_scene_error(r, node, "bad-value", "periodic: x, or turn the plan by 90 degrees",
                        "bounds cannot be joined along y in a scene with storeys");
}

bool jox_scene_is_mod_file(const JoxSceneDraft *draft, const char *file) {
    for (uint32_t m = 0; draft->options && m < draft->options->mod_count; m++)
        if (jox_path_below(file, draft->options->mods[m].folder))
            return true;
    return false;
}

void jox_key_read_input(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    JoxSceneSpec *s = item;
    const char *name = jox_key_read_scalar(r, key, node, "text");
    if (!name)
        return;
    if (jox_scene_is_mod_file(r->draft, node->position.file) &&
        (*name == '/' || strstr(name, "..")))
        jox_scene_error(r, node, "bad-value", "A plain name, of a file beside it",
                        "a mod cannot read '%.100s'", name);
    else
        s->input = jox_arena_beside(r->arena, node->position.file, name);
}

bool jox_finish_camera(const JoxReader *r, const JoxYaml *map, void *item, bool good) {
    JoxSceneCamera *camera = item;
    (void)r;
    camera->given = good && jox_yaml_get(map, "position") && jox_yaml_get(map, "target");
    return good;
}

const char *const jox_scene_colours[] = {"auto",
#define X(name) #name,
                                         JOX_SCENE_COLOURS(X)
#undef X
};
const char *const jox_scene_fields[] = {"density", "pressure", "none"};

const char *jox_scene_choose_colouring(uint32_t choice, uint32_t states, uint32_t groups) {
    /* Two states, as "walks" and "is gone", tell little; more than eight colours are hard to tell
       apart. */
    enum { TELLING_STATES = 3, MOST_STATES = 8, MOST_GROUPS = 8 };
    const bool groups_tell = groups >= 2 && groups <= MOST_GROUPS;
    if (choice != 0)
        return jox_scene_colours[choice];
    return states > MOST_STATES && groups_tell ? "group"
           : states >= TELLING_STATES          ? "state"
           : groups_tell                       ? "group"
                                               : "speed";
}

const char *const jox_scene_tools[JOX_TOOL_COUNT] = {
#define X(tool, name) name,
    JOX_TOOLS(X)
#undef X
};
