/* What the live page shows of a scene, and what it lets people do. */
#include <string.h>

#include "scene/internal.h"

const char *const jox_scene_tools[JOX_TOOL_COUNT] = {
#define X(tool, name) name,
    JOX_TOOLS(X)
#undef X
};

static uint32_t read_tools(const JoxReader *r, const JoxYaml *list) {
    const JoxYaml *const *names;
    const uint32_t count = jox_read_names(r, list, &names);
    uint32_t tools = 0;
    for (uint32_t n = 0; n < count; n++) {
        int t = 0;
        while (t < JOX_TOOL_COUNT && strcmp(names[n]->text, jox_scene_tools[t]) != 0)
            t++;
        if (t < JOX_TOOL_COUNT) {
            tools |= 1u << t;
            continue;
        }
        JoxText known = {0};
        jox_choices_text(jox_key_find("view", "tools")->choices, &known);
        jox_scene_error(r, names[n], "bad-value",
                        jox_scene_suggest(r, names[n]->text, jox_scene_tools, JOX_TOOL_COUNT),
                        "there is no tool '%.60s': a tool is %s", names[n]->text, known.data);
        jox_text_free(&known);
    }
    return tools;
}

void jox_load_view(const JoxLoad *l, const JoxYaml *root) {
    const JoxReader *r = &l->reader;
    JoxSceneSpec *s = l->scene;
    const JoxYaml *map = jox_yaml_get(root, "camera");
    if (map && jox_keys_check(r, map, "camera"))
        s->camera.given = jox_key_vector(r, map, "camera", "position", s->camera.position, 3) &&
                          jox_key_vector(r, map, "camera", "target", s->camera.target, 3);
    map = jox_yaml_get(root, "view");
    s->view.tools = 1u << JOX_TOOL_GATES | 1u << JOX_TOOL_PARAMETERS | 1u << JOX_TOOL_SIGNALS |
                    1u << JOX_TOOL_PLAYER;
    if (map && !jox_keys_check(r, map, "view"))
        return;
    if (map && jox_yaml_get(map, "tools"))
        s->view.tools = read_tools(r, jox_yaml_get(map, "tools"));
    s->view.colour = jox_key_choice(r, map, "view", "colour");
    s->view.field = jox_key_choice(r, map, "view", "field");
}
