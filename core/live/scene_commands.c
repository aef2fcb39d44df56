/* Commands of browsers to a running scene: pause, step, restart, input, lua. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "live/inspect.h"
#include "live/scene_page.h"
#include "run/input_actions.h"
#include "run/messages.h"
#include "world/verbs/verb_table.h"

enum { MOST_STEPS = 100000 };

void jox_scene_page_pause(void *self, const JoxLiveRequest *request) {
    JoxScenePage *s = self;
    bool on = jox_command_bool(request->command, "on", true);
    if (!on && s->failed) {
        jox_live_refuse(request, "this run cannot go on; restart it");
        return;
    }
    if (!on && s->page.session.paused && jo_world_time(s->scene->world) >= s->until)
        s->until = INFINITY; /* continues beyond the scene's duration */
    if (!on) {
        s->page.session.end = JOX_LIVE_GOES_ON;
        s->page.session.broke = NULL;
    }
    s->page.session.paused = on;
    s->steps = 0;
    s->page.last_status = 0.0; /* a status is sent at once */
}

void jox_scene_page_step(void *self, const JoxLiveRequest *request) {
    JoxScenePage *s = self;
    double n = jox_command_number(request->command, "n", 1.0);
    if (s->failed)
        jox_live_refuse(request, "this run cannot go on; restart it");
    else if (!(n >= 1.0 && n <= MOST_STEPS))
        jox_live_refuse(request, "n is from 1 to 100,000 steps");
    else
        s->steps += (uint64_t)n;
    if (s->steps > 0)
        s->page.session.end = JOX_LIVE_GOES_ON;
    s->page.session.paused = true;
    s->steps = s->steps < MOST_STEPS ? s->steps : MOST_STEPS;
}

void jox_scene_page_restart(void *self, const JoxLiveRequest *request) {
    JoxScenePage *s = self;
    double seed = jox_command_number(request->command, "seed", NAN);
    if (seed == seed && !(seed >= 0.0 && seed < 9007199254740992.0 && seed == floor(seed))) {
        jox_live_refuse(request, "a seed is a whole number from 0 to 9007199254740991");
        return;
    }
    if (s->embedded) {
        jox_live_refuse(request, "the program that shows this scene begins it anew: load it there");
        return;
    }
    JoSceneDef before = s->scene_def;
    if (seed == seed) {
        s->scene_def.has_seed = true;
        s->scene_def.seed = (uint64_t)seed;
    }
    JoError error = {0};
    const JoxLiveMatch match = s->page.session.match;
    jox_scene_page_replay_round(s);
    if (!jox_scene_page_load(s, &error)) {
        s->page.session.match = match;
        s->scene_def = before;
        jox_live_refuse(request, error.text);
        return;
    }
    JoxText text = {0};
    if (jox_scene_page_add_files(s, &text))
        jox_run_say(s->scene, "Restarted%s\n", text.data);
    jox_text_free(&text);
}

/* Returns the tool (JOX_TOOL_...) that allows the verb of an input line, or -1 if pages have no
   such verb. */
static int find_tool(const char *line) {
    line += strspn(line, " \t");
    const size_t n = strcspn(line, " \t");
    const char *name = NULL;
    for (uint32_t v = 0; v < jox_input_verb_count; v++)
        if (strlen(jox_input_verbs[v].name) == n && !strncmp(line, jox_input_verbs[v].name, n))
            name = jox_input_verbs[v].tool;
    if (name && !strcmp(name, JOX_VERB_PROGRAM))
        return -1; /* a verb of programs alone */
    for (int tool = 0; name && tool < JOX_TOOL_COUNT; tool++)
        if (!strcmp(jox_scene_tools[tool], name))
            return tool;
    JOX_ASSERT(!name); /* each tool of jox_input_verbs is in jox_scene_tools */
    return -1;
}

static void refuse_verb(const JoxLiveRequest *request) {
    JoxText why = {0};
    jox_text_add(&why, "a line begins with one of:");
    for (uint32_t v = 0; v < jox_input_verb_count; v++)
        if (jox_input_verbs[v].tool && strcmp(jox_input_verbs[v].tool, JOX_VERB_PROGRAM) != 0)
            jox_text_printf(&why, " %s", jox_input_verbs[v].name);
    jox_live_refuse(request, why.data);
    jox_text_free(&why);
}

/* Returns the push that browsers have put on an agent for the coming step, or NULL. */
static JoxHandPush *find_hand_push(JoxScenePage *s, uint64_t tick, uint32_t agent) {
    for (uint32_t p = 0; p < JOX_HAND_PUSHES && p < s->push_count; p++)
        if (s->pushes[p].agent == agent && s->pushes[p].tick == tick)
            return &s->pushes[p];
    return NULL;
}

/* Performs a push on an agent for the coming step, in place of the one before. A page repeats a
   push while the button is held, several times per step if the run is slow or paused. Entries add
   up within a step, so that the difference from the last push is what is performed. */
static bool perform_push(JoxScenePage *s, JoxInputEntry *entry, JoError *error) {
    const JoxHandPush now = {s->scene->world->state.tick, entry->number, entry->numbers[0],
                             entry->numbers[1]};
    JoxHandPush *before = find_hand_push(s, now.tick, now.agent);
    if (before) {
        entry->numbers[0] -= before->x;
        entry->numbers[1] -= before->y;
    }
    if (!jox_run_perform_input(s->scene, entry, error))
        return false;
    if (!before)
        before = &s->pushes[s->push_count++ % JOX_HAND_PUSHES];
    *before = now;
    return true;
}

static bool perform_line(JoxScenePage *s, const char *line, JoError *error) {
    JoxInputEntry entry;
    JoxText wrong = {0};
    bool good = jox_input_read_line(line, &entry, &wrong);
    if (!good)
        jox_error(error, JO_INPUT, "%s", wrong.data);
    else if (entry.verb == JOX_INPUT_PUSH)
        good = perform_push(s, &entry, error);
    else
        good = jox_run_perform_input(s->scene, &entry, error);
    jox_input_entry_free(&entry);
    jox_text_free(&wrong);
    return good;
}

void jox_scene_page_input(void *self, const JoxLiveRequest *request) {
    JoxScenePage *s = self;
    const char *line = jox_command_text(request->command, "line", "");
    int tool = find_tool(line);
    char text[256];
    JoError error = {0};
    if (tool < 0) {
        refuse_verb(request);
    } else if (!(s->scene->spec->view.tools >> tool & 1)) {
        snprintf(text, sizeof text,
                 "the scene does not allow this; it would with view: {tools: [%s]}",
                 jox_scene_tools[tool]);
        jox_live_refuse(request, text);
    } else if (s->failed) {
        jox_live_refuse(request, "this run cannot go on; restart it");
    } else if (!perform_line(s, line, &error)) {
        jox_live_refuse(request, error.text);
    } else {
        s->page.changed = true;
        if (tool != JOX_TOOL_DRAG && tool != JOX_TOOL_PUSH && tool != JOX_TOOL_PLAYER)
            s->page.last_status = 0.0; /* gates, bodies and parameters are shown at once */
    }
}

void jox_scene_page_lua(void *self, const JoxLiveRequest *request) {
    JoxScenePage *s = self;
    const JoxCommand *c = request->command;
    JoxText line = {0}, text = {0};
    bool good = jox_live_lua_line(
        s->scene, jox_command_text(c, "machine", ""), jox_command_text(c, "state", ""),
        jox_command_text(c, "parameter", ""), jox_command_number(c, "value", NAN), &line);
    if (good) {
        JoxJson json = jox_json_begin(&text, 0);
        jox_json_object(&json, NULL);
        jox_json_string(&json, "type", "lua");
        jox_json_string(&json, "text", line.data ? line.data : "");
        jox_json_end(&json);
        jox_view_send(s->page.server, request->client, text.data);
    } else {
        jox_live_refuse(request, line.data ? line.data : "there is no such parameter");
    }
    jox_text_free(&line);
    jox_text_free(&text);
}
