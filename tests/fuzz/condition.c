/* Compiles lines as expressions of a behaviour (a condition, steering, a push, a memory) and runs
   them for a few agents. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "support/fuzz.h"

static const char SCENE[] =
    "jostle: 1\n"
    "limits: {load_instructions: 100000, step_instructions: 100000, instructions: 10000}\n"
    "places:\n"
    "  hall: {polygon: [[0, 0], [6, 0], [6, 6], [0, 6]]}\n"
    "  door: {line: [[3, 0], [3, 6]]}\n"
    "  spot: {point: [5, 5]}\n"
    "walls: [{line: [[0, 0], [6, 0], [6, 6], [0, 6]], closed: true}]\n"
    "bodies: [{name: ball, shape: {sphere: {radius: 0.2}}, at: [4, 4, 0.2], tags: [ball]}]\n"
    "groups:\n"
    "  a: {behaviour: fuzz.lua, at: [[1, 1], [1.4, 1], [5, 1], [1, 5]], team: x}\n"
    "  b: {behaviour: fuzz.lua, at: [[3, 3], [3.4, 3]], team: y, tags: [red]}\n";

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static const char *const NONE[] = {"now.speed:above(0.5)", "hold", "10", "mine.n + 1"};
    char *text = fuzz_text(data, size), *line = text;
    const char *parts[4];
    for (int p = 0; p < 4; p++) {
        char *end = line ? strchr(line, '\n') : NULL;
        parts[p] = line && *line ? line : NONE[p];
        if (end)
            *end = 0;
        line = end ? end + 1 : NULL;
        parts[p] = *parts[p] ? parts[p] : NONE[p];
    }
    JoxText lua = {0};
    jox_text_printf(&lua,
                    "local ball, other = nearest \"ball\", nearest \"anyone\"\n"
                    "local mine = memory { n = 0 }\n"
                    "return machine { name = \"f\", start = \"A\", states = {\n"
                    "A = { steer = %s, push = %s,\n"
                    "{ to = \"B\", when = %s, set = { n = %s } } },\n"
                    "B = { steer = seek(ball), { to = \"A\", when = after(0.1) } } } }\n",
                    parts[1], parts[2], parts[0], parts[3]);
    fuzz_write("fuzz.lua", lua.data, lua.length);
    jox_text_free(&lua);
    free(text);
    fuzz_run(fuzz_load(fuzz_path("fuzz.yaml"), SCENE, 1), 6);
    return 0;
}
