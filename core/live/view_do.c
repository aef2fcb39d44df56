/* What people do on a live page. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/mem.h"
#include "live/view_parts.h"

static const double SLOWEST = 0.01, FASTEST = 1000.0; /* of real time */
enum { MOST_STEPS = 100000 };

/* Who said it, and what. */
typedef struct Said {
    JoxViewing *v;
    JoxWatcher *by;
    const JoxCommand *command;
} Said;

static void refuse(const Said *said, const char *text) {
    jox_view_refuse(said->v->view, said->by->client, said->command->verb, text);
}

static void do_pause(const Said *said) {
    JoxViewing *v = said->v;
    bool on = jox_command_bool(said->command, "on", true);
    if (!on && v->failed) {
        refuse(said, "this run cannot go on; restart it");
        return;
    }
    if (!on && v->session.paused && jo_world_time(v->scene->world) >= v->until)
        v->until = INFINITY; /* on beyond the scene's end */
    v->session.paused = on;
    v->steps = 0;
    v->spoke = 0.0; /* the status says so at once */
}

static void do_step(const Said *said) {
    JoxViewing *v = said->v;
    double n = jox_command_number(said->command, "n", 1.0);
    if (v->failed)
        refuse(said, "this run cannot go on; restart it");
    else if (!(n >= 1.0 && n <= MOST_STEPS))
        refuse(said, "n is from 1 to 100,000 steps");
    else
        v->steps += (uint64_t)n;
    v->session.paused = true;
    v->steps = v->steps < MOST_STEPS ? v->steps : MOST_STEPS;
}

static void do_speed(const Said *said) {
    double factor = jox_command_number(said->command, "factor", NAN);
    if (factor >= SLOWEST && factor <= FASTEST)
        said->v->session.speed = factor;
    else
        refuse(said, "factor is from 0.01 to 1,000 simulated seconds in a second");
    said->v->due = 0.0;
}

static void do_restart(const Said *said) {
    JoxViewing *v = said->v;
    double seed = jox_command_number(said->command, "seed", NAN);
    if (seed == seed && !(seed >= 0.0 && seed < 9007199254740992.0 && seed == floor(seed))) {
        refuse(said, "a seed is a whole number from 0 to 9007199254740991");
        return;
    }
    JoSceneDef before = v->scene_def;
    if (seed == seed) {
        v->scene_def.has_seed = true;
        v->scene_def.seed = (uint64_t)seed;
    }
    JoError error = {0};
    if (!jox_viewing_load(v, &error)) {
        v->scene_def = before;
        refuse(said, error.text);
    }
}

static void do_colour(const Said *said) {
    int colour = jox_live_colour(jox_command_text(said->command, "by", ""));
    if (colour < 0) {
        refuse(said, "by is state, speed, force, compression, density or group");
        return;
    }
    said->by->colour = (JoxLiveColour)colour;
    said->v->changed = true;
    jox_view_listen(said->v->view, said->by->client, jox_viewing_channels(said->by));
}

static void do_field(const Said *said) {
    int field = jox_live_field_named(jox_command_text(said->command, "of", ""));
    if (field < 0) {
        refuse(said, "of is density, pressure or none");
        return;
    }
    said->by->field = (JoxLiveField)field;
    said->v->spoke = 0.0;
    jox_view_listen(said->v->view, said->by->client, jox_viewing_channels(said->by));
}

/* One page at a time: what an agent met is kept of one alone. */
static void do_inspect(const Said *said) {
    static const char NOBODY[] = "{\"type\": \"inspect\", \"agent\": null}";
    JoxViewing *v = said->v;
    double slot = jox_command_number(said->command, "slot", -1.0);
    uint32_t me = said->by->client, other = v->inspector != me ? v->inspector : 0;
    if (!(slot >= 0.0)) {
        v->inspector = other;
        jox_view_send(v->view, me, NOBODY);
        return;
    }
    if (other) {
        jox_view_send(v->view, other, NOBODY);
        jox_view_say(v->view, other, "info", "another page inspects somebody now");
    }
    v->inspector = me;
    v->inspected = slot < 4294967295.0 ? (uint32_t)slot : UINT32_MAX;
    jox_viewing_inspect(v);
}

/* The tool that the first word of a line needs, or -1. */
static int find_tool(const char *line) {
    static const struct {
        const char *verb;
        JoxTool tool;
    } NEEDS[] = {
        {"throw", JOX_TOOL_THROW},    {"box", JOX_TOOL_THROW},    {"grab", JOX_TOOL_DRAG},
        {"drag", JOX_TOOL_DRAG},      {"release", JOX_TOOL_DRAG}, {"push", JOX_TOOL_PUSH},
        {"open", JOX_TOOL_GATES},     {"close", JOX_TOOL_GATES},  {"signal", JOX_TOOL_SIGNALS},
        {"set", JOX_TOOL_PARAMETERS}, {"player", JOX_TOOL_PLAYER}};
    line += strspn(line, " \t");
    size_t n = strcspn(line, " \t");
    for (size_t i = 0; i < sizeof NEEDS / sizeof *NEEDS; i++)
        if (strlen(NEEDS[i].verb) == n && strncmp(line, NEEDS[i].verb, n) == 0)
            return (int)NEEDS[i].tool;
    return -1;
}

static void do_input(const Said *said) {
    JoxViewing *v = said->v;
    const char *line = jox_command_text(said->command, "line", "");
    int tool = find_tool(line);
    char text[256];
    JoError error = {0};
    if (tool < 0) {
        refuse(said, "a line is throw, box, grab, drag, release, push, open, close, signal, set or "
                     "player, and what belongs to it");
    } else if (!(v->scene->spec->view.tools >> tool & 1)) {
        snprintf(text, sizeof text, "this scene does not offer it; view: {tools: [%s]} would",
                 jox_scene_tools[tool]);
        refuse(said, text);
    } else if (v->failed) {
        refuse(said, "this run cannot go on; restart it");
    } else if (!jo_scene_input(v->scene, line, &error)) {
        refuse(said, error.text);
    } else {
        v->changed = true;
        if (tool != JOX_TOOL_DRAG && tool != JOX_TOOL_PUSH && tool != JOX_TOOL_PLAYER)
            v->spoke = 0.0; /* gates, bodies and parameters are told at once */
    }
}

static void do_lua(const Said *said) {
    const JoxCommand *c = said->command;
    JoxText line = {0}, text = {0};
    bool good = jox_run_lua_line(
        said->v->scene, jox_command_text(c, "machine", ""), jox_command_text(c, "state", ""),
        jox_command_text(c, "parameter", ""), jox_command_number(c, "value", NAN), &line);
    if (good) {
        JoxJson json = jox_json_begin(&text, 0);
        jox_json_object(&json, NULL);
        jox_json_string(&json, "type", "lua");
        jox_json_string(&json, "text", line.data ? line.data : "");
        jox_json_end(&json);
        jox_view_send(said->v->view, said->by->client, text.data);
    } else {
        refuse(said, line.data ? line.data : "there is no such parameter");
    }
    jox_text_free(&line);
    jox_text_free(&text);
}

static void do_command(JoxViewing *v, JoxWatcher *by, const char *json) {
    static const struct {
        const char *verb;
        void (*deed)(const Said *said);
    } VERBS[] = {{"pause", do_pause},     {"step", do_step},     {"speed", do_speed},
                 {"restart", do_restart}, {"colour", do_colour}, {"field", do_field},
                 {"input", do_input},     {"lua", do_lua},       {"inspect", do_inspect}};
    JoxCommand command = {0};
    if (!jox_command_read(json, &command))
        return; /* the server has dropped those */
    Said said = {v, by, &command};
    for (size_t i = 0; i < sizeof VERBS / sizeof *VERBS; i++)
        if (!strcmp(VERBS[i].verb, command.verb)) {
            VERBS[i].deed(&said);
            return;
        }
    jox_view_drop(v->view);
    refuse(&said, "there is no such command in a live session");
}

static void join(JoxViewing *v, uint32_t client) {
    for (uint32_t w = 0; w < JOX_VIEW_CLIENTS; w++) {
        JoxWatcher *watcher = &v->watchers[w];
        if (watcher->client)
            continue;
        *watcher = (JoxWatcher){.client = client,
                                .colour = (JoxLiveColour)v->scene->spec->view.colour,
                                .field = (JoxLiveField)v->scene->spec->view.field};
        jox_viewing_greet(v, client);
        jox_view_listen(v->view, client, jox_viewing_channels(watcher));
        v->spoke = 0.0;
        return;
    }
}

static JoxWatcher *find(JoxViewing *v, uint32_t client) {
    for (uint32_t w = 0; w < JOX_VIEW_CLIENTS; w++)
        if (v->watchers[w].client == client)
            return &v->watchers[w];
    return NULL;
}

void jox_viewing_take(JoxViewing *v) {
    char text[JOX_VIEW_MOST_COMMAND + 1];
    uint32_t client;
    JoxViewTaken what;
    while ((what = jox_view_take(v->view, &client, text, sizeof text)) != JOX_VIEW_NOTHING) {
        JoxWatcher *by = find(v, client);
        if (what == JOX_VIEW_JOINED)
            join(v, client);
        else if (what == JOX_VIEW_LEFT && by)
            *by = (JoxWatcher){0};
        else if (what == JOX_VIEW_COMMAND && by)
            do_command(v, by, text);
        if (what == JOX_VIEW_LEFT && client == v->inspector)
            v->inspector = 0;
        if (what == JOX_VIEW_LEFT && jox_view_clients(v->view) == 0)
            jox_view_forget(v->view); /* who comes next is not shown what was */
    }
}
