/* Runs a scene with a mod. The input is its mod.yaml, a patch of a scene and one of a behaviour,
   separated by lines "%%". */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "support/fuzz.h"

static const char SCENE[] = "jostle: 1\n"
                            "title: base\n"
                            "places:\n"
                            "  hall: {polygon: [[0, 0], [6, 0], [6, 6], [0, 6]]}\n"
                            "walls: [{line: [[0, 0], [6, 0]], name: south}]\n"
                            "groups:\n"
                            "  red: {behaviour: base.lua, count: 3, in: hall}\n"
                            "events: [{at: 0.1, signal: go, name: start}]\n";
static const char LUA[] =
    "return machine { name = \"base\", start = \"A\", defaults = { speed = 1 }, states = {\n"
    "A = { steer = hold, push = 10, { to = \"B\", when = after(0.1), id = \"on\" } },\n"
    "B = { steer = hold, { to = \"A\", when = heard \"go\" } } } }\n";
static const char *const FILES[] = {"mods/fuzz/mod.yaml", "mods/fuzz/patches/base.yaml",
                                    "mods/fuzz/patches/base.lua"};

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    char *text = fuzz_text(data, size), *from = text;
    for (int f = 0; f < 3; f++) {
        char *end = from ? strstr(from, "\n%%\n") : NULL;
        const size_t length = !from ? 0 : end ? (size_t)(end + 1 - from) : strlen(from);
        if (length)
            fuzz_write(FILES[f], from, length);
        else
            unlink(fuzz_path(FILES[f]));
        from = end ? end + 4 : NULL;
    }
    free(text);
    fuzz_write("base.lua", LUA, sizeof LUA - 1);
    fuzz_write("base.yaml", SCENE, sizeof SCENE - 1);
    char scene[256], mod[256];
    snprintf(scene, sizeof scene, "%s", fuzz_path("base.yaml"));
    snprintf(mod, sizeof mod, "%s", fuzz_path("mods/fuzz"));
    const char *mods[] = {mod};
    JoSceneDef def = jo_default_scene_def();
    JoError error = {0};
    def.path = scene;
    def.mods = mods;
    def.mod_count = 1;
    def.named_mods_only = true;
    def.message = ignore_message;
    fuzz_run(jo_scene_load(&def, &error), 4);
    jo_free(jo_mods_list(&def));
    jo_free(jo_mods_why(&def, "base.A.push", &error));
    jo_free(jo_mods_why(&def, "groups.red.count", &error));
    return 0;
}
