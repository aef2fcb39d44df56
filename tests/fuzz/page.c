/* Sends lines to the live page of a running scene, as messages of a browser. */
#include <stdlib.h>
#include <string.h>

#include "live/scene_page.h"
#include "support/fuzz.h"

enum { MOST_LINES = 40, MOST_STEPS = 20 };
static const char SCENE[] =
    "jostle: 1\n"
    "places: {hall: {polygon: [[0, 0], [6, 0], [6, 6], [0, 6]]}}\n"
    "walls: [{line: [[0, 0], [6, 0]], name: gate}]\n"
    "bodies: [{name: ball, shape: {sphere: {radius: 0.2}}, at: [4, 4, 0.2], tags: [ball]}]\n"
    "view: {tools: [throw, drag, push, gates, parameters, signals, player]}\n"
    "player: a\n"
    "groups: {a: {behaviour: player.lua, count: 3, in: hall},\n"
    "         b: {behaviour: stander.lua, count: 3, in: hall}}\n";

static void send_lines(JoxScenePage *s, char *text) {
    int lines = 0;
    for (char *line = text; line && lines < MOST_LINES; lines++) {
        char *end = strchr(line, '\n');
        if (end)
            *end = 0;
        jox_live_run_command(&s->page, &s->page.watchers[0], line);
        s->steps = s->steps < MOST_STEPS ? s->steps : MOST_STEPS;
        s->page.source->advance(s, 1e6);
        line = end ? end + 1 : NULL;
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    JoViewDef def = jo_default_view_def();
    char *text = fuzz_text(data, size);
    def.scene.path = "tests/fuzz/fuzz.yaml";
    def.scene.text = SCENE;
    def.scene.text_length = sizeof SCENE - 1;
    def.scene.message = ignore_message;
    def.scene.named_mods_only = true;
    def.watch = false;
    def.fast = true;
    JoxScenePage s = {.def = &def, .scene_def = def.scene};
    JoError error = {0};
    s.page.source = &jox_scene_page_source;
    s.page.self = &s;
    s.page.server = fuzz_server();
    s.page.session.speed = 1;
    s.page.watchers[0].client = 1;
    if (!jox_scene_page_load(&s, &error))
        abort();
    send_lines(&s, text);
    FUZZ_CHECK(s.page.watchers[0].colour < JOX_LIVE_COLOUR_COUNT);
    s.page.source->status(&s, 0, &s.page.text);
    s.page.source->scene(&s, &s.page.text);
    s.page.source->pack_frame(&s, s.page.watchers[0].colour, &s.page.bytes);
    jox_scene_page_end(&s, &error);
    jox_bytes_free(&s.page.bytes);
    jox_bytes_free(&s.page.people);
    jox_text_free(&s.page.text);
    jox_scene_page_forget_errors(&s);
    jox_free(s.errors);
    free(text);
    return 0;
}
