/* Prints the reference pages and editor files that are generated, by name. `jostle reference`
   calls it. */
#include <string.h>

#include "base/assert.h"
#include "base/guard.h"
#include "jostle_tools.h"
#include "lua/behaviour_reference.h"
#include "run/run.h"
#include "world/verbs/verb_table.h"

static void scene_schema(JoxText *out) {
    jox_scene_print_json_schema("scene", out);
}
static void mod_schema(JoxText *out) {
    jox_scene_print_json_schema("mod", out);
}

char *jo_reference(const char *what) {
    JOX_REQUIRE(what, NULL);
    JOX_GUARD (NULL, NULL)
        return NULL;
    static const struct {
        const char *name;
        void (*print)(JoxText *out);
    } PAGES[] = {{"behaviours", jox_lua_reference},     {"lua-ls", jox_lua_definitions},
                 {"luacheck", jox_lua_luacheck},        {"scenes", jox_scene_print_markdown},
                 {"scene-schema", scene_schema},        {"mod-schema", mod_schema},
                 {"inputs", jox_input_append_reference}};
    JoxText out = {0};
    for (size_t p = 0; p < sizeof PAGES / sizeof *PAGES; p++)
        if (!strcmp(PAGES[p].name, what))
            PAGES[p].print(&out);
    return jox_disown(out.data);
}

char *jo_scene_reference(void) {
    JOX_GUARD (NULL, NULL)
        return NULL;
    JoxText text = {0};
    jox_scene_print_reference(&text);
    return jox_disown(text.data);
}
