/* Sends lines to the live page of a recording, as messages of a browser. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "live/replay_page.h"
#include "support/fuzz.h"

enum { MOST_LINES = 60, FRAMES = 12 };
static const char SCENE[] =
    "jostle: 1\n"
    "step: 0.05\n"
    "duration: 60\n"
    "places: {hall: {polygon: [[0, 0], [6, 0], [6, 6], [0, 6]]}}\n"
    "walls: [{line: [[0, 0], [6, 0]], name: gate}]\n"
    "bodies: [{name: ball, shape: {sphere: {radius: 0.2}}, at: [4, 4, 0.2]}]\n"
    "groups: {a: {behaviour: stander.lua, count: 3, in: hall},\n"
    "         b: {behaviour: stander.lua, count: 3, in: hall}}\n";

/* Makes the recording that all inputs use, once; returns its path. */
static const char *make_recording(void) {
    static char path[4096];
    if (path[0])
        return path;
    snprintf(path, sizeof path, "%s", fuzz_path("replayed.sqlite"));
    JoError error = {0};
    JoSceneDef def = jo_default_scene_def();
    def.path = "tests/fuzz/fuzz.yaml";
    def.text = SCENE;
    def.text_length = sizeof SCENE - 1;
    def.message = ignore_message;
    def.named_mods_only = true;
    JoScene *scene = jo_scene_load(&def, &error);
    if (!scene || !jo_scene_record(scene, path, 0.05, &error))
        abort();
    for (int step = 0; step < FRAMES; step++)
        if (!jo_scene_step(scene, &error))
            abort();
    if (!jo_scene_finish(scene, &error))
        abort();
    jo_scene_free(scene);
    return path;
}

/* Sends the lines, 30 ms apart. */
static void send_replay_lines(JoxReplayPage *p, char *text) {
    double now = jox_clock_wall();
    int lines = 0;
    for (char *line = text; line && lines < MOST_LINES; lines++) {
        char *end = strchr(line, '\n');
        if (end)
            *end = 0;
        jox_live_run_command(&p->page, &p->page.watchers[0], line);
        p->wall = now;
        now += 0.03;
        p->page.source->advance(p, now);
        FUZZ_CHECK(p->at >= p->from && p->at <= p->until);
        line = end ? end + 1 : NULL;
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    JoViewRecordingDef def = jo_default_view_recording_def();
    char *text = fuzz_text(data, size);
    JoxReplayPage p = {.def = &def};
    JoError error = {0};
    def.recording = make_recording();
    def.message = ignore_message;
    p.page.server = fuzz_server();
    p.page.session.speed = 1;
    p.page.watchers[0].client = 1;
    if (!jox_replay_page_load(&p, &error))
        abort();
    p.at = p.from;
    send_replay_lines(&p, text);
    p.page.source->status(&p, 0, &p.page.text);
    p.page.source->scene(&p, &p.page.text);
    p.page.source->pack_frame(&p, p.page.watchers[0].colour, &p.page.bytes);
    p.page.source->pack_field(&p, p.page.watchers[0].field, &p.page.bytes);
    p.page.source->pack_people(&p, &p.page.people);
    p.page.source->report(&p);
    jox_replay_page_end(&p);
    jox_bytes_free(&p.page.bytes);
    jox_bytes_free(&p.page.people);
    jox_text_free(&p.page.text);
    free(text);
    return 0;
}
