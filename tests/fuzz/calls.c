/* Calls jostle.h in any order with invalid and unusual numbers, handles, names and NULL, on a
   scene, on a world made by hand and on none, and from within a message. Each call returns, misuse
   is reported, no assertion of the engine fails, and positions of agents stay finite. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "support/fuzz.h"

static const char SCENE[] =
    "jostle: 1\n"
    "places: {hall: {polygon: [[0, 0], [6, 0], [6, 6], [0, 6]]}, exit: {point: [7, 3]}}\n"
    "walls: [{line: [[0, 0], [6, 0]], name: gate}]\n"
    "bodies: [{name: ball, shape: {sphere: {radius: 0.2}}, at: [4, 4, 0.2], mass: 1, tags: [ball]},"
    " {name: door, shape: {box: {size: [1, 0.2, 2]}}, at: [2, 5, 1], kinematic: true}]\n"
    "groups: {a: {behaviour: talker.lua, count: 5, in: hall}}\n"
    "probes: {all: {log: true}}\n";
static const char TALKER[] =
    "local mine = memory { hits = 0 }\n"
    "return machine { name = \"talker\", version = 1, start = \"Go\", states = {\n"
    "  Go = { steer = seek \"exit\", lasts = 0.1, on_enter = function(me) print \"go\" end,\n"
    "    { to = \"Stop\", when = lasted | heard \"go\" } },\n"
    "  Stop = { steer = hold, lasts = 0.1, { to = \"Go\", when = lasted } } } }\n";

enum { MOST_CALLS = 60, MOST_HANDLES = 12, ROOM = 8 };

typedef struct Caller {
    const uint8_t *at, *end;
    JoScene *scene;
    JoWorld *made;
    JoAgent agents[MOST_HANDLES];
    JoBody bodies[MOST_HANDLES];
    uint32_t agent_count, body_count;
    void *saved;
    size_t saved_size;
    bool within; /* calls come from within a message */
} Caller;

/* ---- arguments ---- */

static uint8_t take_byte(Caller *c) {
    return c->at < c->end ? *c->at++ : 0;
}

static double pick_number(Caller *c) {
    static const double ODD[] = {0,   -0.0,  NAN,    INFINITY, -INFINITY, 1e300,  -1e300, 1e39,
                                 1e9, -1e9,  1e6,    -1e6,     10000,     -10000, 9999.9, 1e-300,
                                 0.5, 0.001, 5e-324, 100,      -100,      500};
    const uint8_t b = take_byte(c);
    return b < 22 ? ODD[b] : (b - 128) / 16.0;
}

static const char *pick_name(Caller *c) {
    static char longest[5000];
    static const char *const NAMES[] = {
        NULL,   "",     "a",         "ball", "door",         "gate",        "hall", "exit", "Go",
        "Stop", "hits", "speed",     "push", "talker",       "x\ny",        "\xff", "mine", "id",
        "x",    "load", "direction", "goal", "push 0 1e9 0", "spawn a 1 1", "tags", longest};
    memset(longest, 'x', sizeof longest - 1);
    return NAMES[take_byte(c) % (sizeof NAMES / sizeof *NAMES)];
}

static JoWorld *pick_world(Caller *c) {
    const uint8_t b = take_byte(c);
    return b == 255 ? NULL : b % 2 && c->scene ? jo_scene_world(c->scene) : c->made;
}

static JoScene *pick_scene(Caller *c) {
    return take_byte(c) == 255 ? NULL : c->scene;
}

static JoAgent pick_agent(Caller *c) {
    const uint8_t b = take_byte(c);
    return b < 200 && c->agent_count ? c->agents[b % c->agent_count]
                                     : (JoAgent){b == 255 ? UINT32_MAX : b - 200u, b % 3};
}

static JoBody pick_body(Caller *c) {
    const uint8_t b = take_byte(c);
    return b < 200 && c->body_count ? c->bodies[b % c->body_count]
                                    : (JoBody){b == 255 ? UINT32_MAX : b - 200u, b % 3};
}

static void keep_agent(Caller *c, JoAgent a) {
    c->agents[c->agent_count++ % MOST_HANDLES] = a;
    c->agent_count = c->agent_count < MOST_HANDLES ? c->agent_count : MOST_HANDLES;
}

static void keep_body(Caller *c, JoBody b) {
    c->bodies[c->body_count++ % MOST_HANDLES] = b;
    c->body_count = c->body_count < MOST_HANDLES ? c->body_count : MOST_HANDLES;
}

static const double *pick_numbers(Caller *c, double *out, int count) {
    for (int n = 0; n < count; n++)
        out[n] = pick_number(c);
    return take_byte(c) == 255 ? NULL : out;
}

/* ---- calls ---- */

static void add_or_spawn(Caller *c) {
    JoError error = {0};
    double xy[ROOM];
    JoWorld *w = pick_world(c);
    JoAgentDef person = jo_default_agent_def();
    JoBodyDef thing = jo_default_body_def();
    switch (take_byte(c) % 5) {
    case 0:
        jo_world_add_solid(w, pick_numbers(c, xy, ROOM), take_byte(c) % (ROOM / 2 + 1), &error);
        return;
    case 1:
        jo_world_add_line(w, pick_numbers(c, xy, ROOM), take_byte(c) % (ROOM / 2 + 1), &error);
        return;
    case 2:
        person.x = pick_number(c), person.y = pick_number(c);
        (&person.radius)[take_byte(c) % 8] = pick_number(c);
        keep_agent(c, jo_world_add_agent(w, take_byte(c) == 255 ? NULL : &person, &error));
        return;
    case 3:
        thing.shape = (JoShape)(take_byte(c) % 5);
        thing.x = pick_number(c), thing.y = pick_number(c), thing.mass = pick_number(c);
        thing.size[take_byte(c) % 3] = pick_number(c);
        thing.kinematic = take_byte(c) % 2;
        if (take_byte(c) % 4 == 0)
            thing.path = (JoPath){.points = xy,
                                  .count = take_byte(c) % 3,
                                  .end = (JoPathEnd)(take_byte(c) % 4),
                                  .speed = pick_number(c),
                                  .after = pick_number(c),
                                  .wait = pick_number(c),
                                  .force_limit = pick_number(c),
                                  .reopens = take_byte(c) % 2};
        pick_numbers(c, xy, 6);
        keep_body(c, jo_world_add_body(w, &thing, &error));
        return;
    default:
        keep_agent(c, jo_world_spawn(w, pick_name(c), pick_number(c), pick_number(c), &error));
    }
}

static void act_on_agent(Caller *c) {
    JoError error = {0};
    JoWorld *w = pick_world(c);
    const JoAgent a = pick_agent(c);
    double value = 0;
    switch (take_byte(c) % 10) {
    case 0:
        jo_world_remove_agent(w, a);
        return;
    case 1:
        jo_agent_teleport(w, a, pick_number(c), pick_number(c), &error);
        return;
    case 2:
        jo_agent_set_goal(w, a, pick_name(c), &error);
        return;
    case 3:
        jo_agent_set_state(w, a, pick_name(c), &error);
        return;
    case 4:
        jo_agent_set_memory(w, a, pick_name(c), pick_number(c), &error);
        return;
    case 5:
        jo_agent_set_parameter(w, a, pick_name(c), pick_number(c), &error);
        return;
    case 6:
        jo_agent_memory(w, a, pick_name(c), take_byte(c) % 8 ? &value : NULL);
        return;
    case 7:
        jo_agent_parameter(w, a, pick_name(c), take_byte(c) % 8 ? &value : NULL);
        return;
    case 8:
        jo_agent_set_preferred(w, a, pick_number(c), pick_number(c));
        return;
    default:
        jo_agent_apply_force(w, a, pick_number(c), pick_number(c));
    }
}

static void act_on_body(Caller *c) {
    JoError error = {0};
    double one[4], two[4];
    JoWorld *w = pick_world(c);
    const JoBody b = pick_body(c);
    switch (take_byte(c) % 6) {
    case 0:
        jo_body_impulse(w, b, pick_numbers(c, one, 3), pick_numbers(c, two, 3), &error);
        return;
    case 1:
        jo_body_place(w, b, pick_numbers(c, one, 3), pick_numbers(c, two, 4), &error);
        return;
    case 2:
        jo_body_set_velocity(w, b, pick_numbers(c, one, 3), pick_numbers(c, two, 3), &error);
        return;
    case 3:
        jo_body_remove(w, b, &error);
        return;
    case 4:
        keep_body(c, jo_world_find_body(w, pick_name(c)));
        return;
    default:
        keep_body(c, jo_world_body_at(w, take_byte(c)));
    }
}

static void act_on_world(Caller *c) {
    JoError error = {0};
    double xy[ROOM];
    JoWorld *w = pick_world(c);
    switch (take_byte(c) % 7) {
    case 0:
        jo_world_add_wall(w, pick_name(c), pick_numbers(c, xy, ROOM), take_byte(c) % (ROOM / 2 + 1),
                          &error);
        return;
    case 1:
        jo_world_remove_wall(w, pick_name(c), &error);
        return;
    case 2:
        jo_world_open_wall(w, pick_name(c), take_byte(c) % 2, &error);
        return;
    case 3:
        jo_world_signal(w, pick_name(c), &error);
        return;
    case 4:
        jo_free(c->saved);
        c->saved = jo_world_snapshot(w, &c->saved_size, &error);
        return;
    case 5:
        if (c->saved)
            jo_world_restore(w, c->saved, c->saved_size - take_byte(c) % 2, &error);
        return;
    default:
        jo_world_step(w, take_byte(c) % 4);
    }
}

static void ask_of_agents(Caller *c, const JoWorld *w) {
    JoAgent all[ROOM];
    const JoAgent a = pick_agent(c);
    const uint32_t had = jo_world_agents(w, all, take_byte(c) % (ROOM + 1));
    for (uint32_t n = 0; n < had && n < ROOM; n++)
        keep_agent(c, all[n]);
    const JoAgentState state = jo_agent_state(w, a);
    FUZZ_CHECK(!state.state || strlen(state.state) < 1000);
    jo_agent_is_live(w, a);
    keep_agent(c, jo_world_agent_of(w, take_byte(c)));
}

static void ask_of_names(const JoWorld *w, uint32_t number) {
    jo_world_group_name(w, number);
    jo_world_machine_name(w, number);
    jo_world_state_name(w, number, number);
    jo_world_state_name(w, 0, number);
    jo_world_signal_name(w, number);
    jo_world_place_name(w, number);
    jo_world_body_name(w, number);
    jo_column_name(number);
}

static void ask(Caller *c) {
    double one[2], two[2], out[2 * ROOM], length;
    uint32_t ids[ROOM];
    JoWorld *w = pick_world(c);
    const uint8_t what = take_byte(c) % 9, odd = take_byte(c);
    if (what == 0)
        ask_of_agents(c, w);
    if (what == 1)
        ask_of_names(w, odd < 250 ? odd : UINT32_MAX - odd);
    if (what == 2)
        jo_world_column(w, pick_name(c));
    if (what == 3)
        jo_world_events(w);
    if (what == 4)
        jo_world_neighbours(w, pick_number(c), pick_number(c), pick_number(c), odd % 2 ? ids : NULL,
                            NULL, odd % (ROOM + 1));
    if (what == 5)
        jo_world_cast(w, pick_numbers(c, one, 2), pick_numbers(c, two, 2), pick_number(c), odd);
    if (what == 6)
        jo_world_path(w, pick_number(c), pick_number(c), pick_name(c), odd % 8 ? out : NULL,
                      odd % (ROOM + 1), odd % 3 ? &length : NULL);
    if (what == 7)
        jo_world_density(w, pick_number(c), pick_number(c));
    if (what == 8) {
        jo_world_walls(w, out, odd % (ROOM / 2 + 1));
        jo_body_outline(w, pick_body(c), out, odd % (ROOM + 1));
        jo_body_state(w, pick_body(c));
        jo_body_is_live(w, pick_body(c));
    }
}

static void act_on_scene(Caller *c) {
    JoError error = {0};
    double one[3], two[3], three[3];
    JoScene *s = pick_scene(c);
    const uint8_t what = take_byte(c) % 13;
    if (what < 4)
        jo_scene_step(s, &error);
    if (what == 4)
        jo_scene_throw(s, pick_name(c), pick_numbers(c, one, 3), pick_numbers(c, two, 3),
                       pick_numbers(c, three, 3), &error);
    if (what == 5)
        jo_scene_open_wall(s, pick_name(c), take_byte(c) % 2, &error);
    if (what == 6)
        jo_scene_signal(s, pick_name(c), &error);
    if (what == 7)
        jo_scene_input(s, pick_name(c), &error);
    if (what == 8)
        jo_scene_trace(s, take_byte(c));
    if (what == 9)
        jo_free(jo_scene_inspect(s, take_byte(c)));
    if (what == 12) {
        JoWhyDef def = jo_default_why_def();
        def.has_agent = take_byte(c) % 2;
        def.agent = take_byte(c);
        def.group = take_byte(c) % 4 ? NULL : pick_name(c);
        def.state = take_byte(c) % 4 ? NULL : pick_name(c);
        def.to = take_byte(c) % 4 ? NULL : pick_name(c);
        def.json = take_byte(c) % 2;
        jo_scene_follow(s, take_byte(c));
        jo_scene_break(s, pick_name(c), &error);
        jo_free(jo_scene_why(s, &def, &error));
        jo_scene_broke(s);
        jo_scene_over(s);
        jo_free(jo_scene_unmet(s));
    }
    if (what == 10) {
        jo_free(jo_scene_summary(s));
        jo_free(jo_scene_troubles(s));
        jo_free(jo_scene_closing(s));
        jo_free(jo_scene_probe_table(s, take_byte(c)));
        jo_scene_stats(s);
    }
    if (what == 11 && take_byte(c) > 250)
        jo_scene_finish(s, &error);
    if (what == 11 && c->within)
        jo_scene_free(s);
}

static void ask_of_scene(Caller *c) {
    JoError error = {0};
    JoScene *s = pick_scene(c);
    double value = 0;
    JoSettings *settings =
        jo_agent_why(s, pick_agent(c), pick_name(c), take_byte(c) % 8 ? &value : NULL, &error);
    FUZZ_CHECK(!settings || settings->now);
    JoFigures *figures = jo_scene_figures(s);
    jo_figure(figures, pick_name(c));
    JoTroubles *troubles = jo_scene_troubles(s);
    for (uint32_t n = 0; troubles && n < troubles->count; n++)
        FUZZ_CHECK(*troubles->items[n].text && troubles->items[n].kind <= JO_TROUBLE_NO_WAY);
    jo_free(settings);
    jo_free(figures);
    jo_free(troubles);
    jo_free(jo_scene_hints(s));
    jo_free(jo_scene_lua_costs(s));
}

/* Adds a kinematic body with unusual limits, and asks for its impulse. */
static void add_driven_body(Caller *c) {
    JoError error = {0};
    double impulse[3], turn[3];
    JoWorld *w = pick_world(c);
    JoBodyDef door = jo_default_body_def();
    door.kinematic = take_byte(c) % 8 != 0;
    door.x = pick_number(c), door.y = pick_number(c), door.vx = pick_number(c);
    door.force_limit = pick_number(c);
    door.ends_world = take_byte(c) % 2;
    const JoBody added = jo_world_add_body(w, &door, &error);
    keep_body(c, added);
    jo_world_step(w, take_byte(c) % 4);
    if (jo_body_pushed(w, take_byte(c) % 2 ? added : pick_body(c), impulse, turn))
        FUZZ_CHECK(isfinite(impulse[0]) && isfinite(turn[2]));
    const JoStats stats = jo_world_stats(w);
    FUZZ_CHECK(stats.not_placed <= UINT32_MAX && stats.not_moved_out <= UINT32_MAX);
}

/* Makes one call. The greatest bytes are calls added later, so that inputs found before keep their
   meaning. */
static void make_call(Caller *c) {
    static void (*const CALLS[])(Caller *) = {add_or_spawn, act_on_agent, act_on_body,
                                              act_on_world, ask,          act_on_scene};
    const uint8_t what = take_byte(c);
    if (what >= 248)
        ask_of_scene(c);
    else if (what >= 240)
        add_driven_body(c);
    else
        CALLS[what % (sizeof CALLS / sizeof *CALLS)](c);
}

/* ---- one input ---- */

/* Calls from within a message, which comes during a step: to change the world is misuse then. */
static void call_within_step(void *context, const char *text) {
    Caller *c = context;
    (void)text;
    if (c->within || !c->scene)
        return;
    c->within = true;
    make_call(c);
    c->within = false;
}

/* Ignores assertions on misuse (JOX_REQUIRE); any other is a finding. */
static void abort_unless_misuse(const char *condition, const char *path, int line) {
    char text[512];
    FILE *file = fopen(path, "r");
    bool misuse = !file;
    for (int n = 1; file && n <= line + 3 && fgets(text, sizeof text, file); n++)
        misuse |= n >= line - 4 && strstr(text, "JOX_REQUIRE");
    if (file)
        fclose(file);
    if (!misuse)
        fuzz_failed(condition, path, line);
}

static JoScene *load_talkers(Caller *c, bool resumable) {
    JoSceneDef def = jo_default_scene_def();
    JoError error = {0};
    fuzz_write("talker.lua", TALKER, strlen(TALKER));
    def.path = fuzz_path("calls.yaml");
    def.text = SCENE;
    def.text_length = strlen(SCENE);
    def.named_mods_only = true;
    def.no_density = true; /* computing densities would leave time for fewer calls */
    def.resumable = resumable;
    def.threads = 1;
    def.message = call_within_step;
    def.message_context = c;
    JoScene *loaded = jo_scene_load(&def, &error);
    FUZZ_CHECK(loaded);
    return loaded;
}

static void check_agent_states(const JoWorld *w) {
    JoAgent all[64];
    const uint32_t count = jo_world_agents(w, all, 64);
    for (uint32_t n = 0; n < count && !jo_world_failure(w); n++)
        FUZZ_CHECK(isfinite(jo_agent_state(w, all[n]).x) && isfinite(jo_agent_state(w, all[n]).vy));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    JoWorldDef def = jo_default_world_def();
    Caller c = {.at = data, .end = data + size};
    JoError error = {0};
    jo_set_assert_handler(abort_unless_misuse);
    c.made = jo_world_create(&def, &error);
    c.scene = load_talkers(&c, take_byte(&c) % 2);
    for (int n = 0; n < MOST_CALLS && c.at < c.end; n++)
        make_call(&c);
    jo_world_step(c.made, 2);
    check_agent_states(c.made);
    jo_scene_step(c.scene, &error);
    check_agent_states(jo_scene_world(c.scene));
    JoScene *over = c.scene;
    c.scene = NULL;
    jo_scene_free(over);
    jo_world_free(c.made);
    jo_free(c.saved);
    jo_set_assert_handler(NULL);
    return 0;
}
