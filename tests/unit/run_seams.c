/* People at the foot and head of stairs behave as in the same plan laid flat: one who walks up and
   down, a row that is pushed over a seam, a crowd that empties a storey. Storeys are a centimetre
   apart, so that the law of stairs changes nothing. And people on storeys above each other do not
   notice each other. */
#include "unit/scene_loader.h"

#define ROOMS "[12, 4], [12, 0], [0, 0], [0, 10], [12, 10], [12, 6]"
#define REST "[18, 6], [18, 10], [30, 10], [30, 0], [18, 0], [18, 4]"
#define STOREYS                                                                                    \
    "storeys: {low: {height: 0}, high: {height: 0.01}}\n"                                          \
    "stairs: {way: {kind: ramp, from: low, to: high, path: [[12, 5], [18, 5]], width: 2}}\n"       \
    "walls: [{line: [" ROOMS "]}, {line: [" REST "], storey: high}]\n"
#define FLAT "walls: [{line: [" ROOMS ", " REST ", [12, 4]]}]\n"
#define PLACES(high)                                                                               \
    "places: {west: {polygon: [[1, 6], [4, 6], [4, 9], [1, 9]]}, "                                 \
    "east: {polygon: [[26, 1], [29, 1], [29, 4], [26, 4]]" high "}, "                              \
    "back: {line: [[2, 1], [2, 9]]}, "                                                             \
    "room: {polygon: [[20, 1], [28, 1], [28, 9], [20, 9]]" high "}}\n"
#define ON_HIGH ", storey: high"

static JoScene *load_pair(bool flat, const char *groups, const char *behaviour) {
    static char text[3000];
    snprintf(text, sizeof text, "jostle: 1\nstep: 0.05\n%s%s%s", flat ? FLAT : STOREYS,
             flat ? PLACES("") : PLACES(ON_HIGH), groups);
    return load_scene_text(text, behaviour);
}

/* Returns where an agent is in plan, m, by its id. */
static JoxV2 find_in_plan(const JoScene *scene, uint32_t id) {
    const JoxAgents *a = &scene->world->state.agents;
    const uint32_t i = jox_agents_find(a, id);
    assert_true(i != JOX_NO_INDEX);
    return jox_in_plan(a->storeys, jox_v2(a->x[i], a->y[i]));
}

static void who_goes_up_and_down_ten_times_loses_nothing(void **state) {
    (void)state;
    const char *groups = "groups: {one: {at: [[3, 7]], behaviour: own.lua}}\n";
    const char *behaviour = "return machine { name = 'w', version = 1, start = 'Up',\n"
                            "  defaults = { speed = 1.3 },\n"
                            "  states = {\n"
                            "    Up = { steer = field 'east', speed = own.speed,\n"
                            "      { to = 'Down', when = inside 'east' } },\n"
                            "    Down = { steer = field 'west', speed = own.speed,\n"
                            "      { to = 'Up', when = inside 'west' } } } }\n";
    JoScene *flat = load_pair(true, groups, behaviour), *high = load_pair(false, groups, behaviour);
    const JoxStoreys *s = &high->world->model.storeys;
    uint32_t crossings = 0, before = 0;
    float off = 0.0f;
    for (int n = 0; n < 8400; n++) {
        step_scene(flat, 1);
        step_scene(high, 1);
        const JoxV2 on = {high->world->state.agents.x[0], high->world->state.agents.y[0]};
        const uint32_t sheet = jox_sheet_of(s, on.y);
        assert_true(jox_is_floor(s, on));
        crossings += sheet != before;
        before = sheet;
        off = jox_maxf(off, jox_length(jox_sub(find_in_plan(flat, 0), find_in_plan(high, 0))));
    }
    assert_true(crossings >= 28);
    /* The grids of both fields lie differently, so ways differ a little: by 0.1 % of 540 m. */
    if (off > 0.54f)
        fail_msg("%g m off", (double)off);
    jo_scene_free(flat);
    jo_scene_free(high);
}

static void a_push_passes_over_a_seam(void **state) {
    (void)state;
    /* Five people in a row over the foot of the stair, the last of whom is pushed. */
    const char *groups =
        "groups: {row: {at: [[11.2, 5], [11.6, 5], [11.98, 5]], behaviour: own.lua}, "
        "on: {at: [[12.38, 5], [12.78, 5]], behaviour: own.lua%s}}\n"
        "events: [{at: 0.5, push: {group: row, force: 0}}]\n";
    char text[600];
    const char *behaviour = "return machine { name = 's', version = 1, start = 'S',\n"
                            "  states = { S = { steer = hold } } }\n";
    JoScene *scenes[2];
    float moved[2][5];
    for (int k = 0; k < 2; k++) {
        snprintf(text, sizeof text, groups, k ? ", storey: way" : "");
        *strstr(text, "events") = 0;
        scenes[k] = load_pair(k == 0, text, behaviour);
        JoxAgents *a = &scenes[k]->world->state.agents;
        JoxV2 start[5];
        for (uint32_t id = 0; id < 5; id++)
            start[id] = find_in_plan(scenes[k], id);
        for (int n = 0; n < 40; n++) {
            if (n < 12)
                a->ext_x[jox_agents_find(a, 0)] = 400.0f;
            step_scene(scenes[k], 1);
        }
        for (uint32_t id = 0; id < 5; id++)
            moved[k][id] = find_in_plan(scenes[k], id).x - start[id].x;
        jo_scene_free(scenes[k]);
    }
    assert_true(moved[0][4] > 0.05f);
    for (uint32_t id = 0; id < 5; id++)
        if (fabsf(moved[0][id] - moved[1][id]) > 0.002f)
            fail_msg("person %u moved %g m flat, %g m over the seam", id, (double)moved[0][id],
                     (double)moved[1][id]);
}

static double measure_emptying(bool flat, int seed) {
    char groups[400];
    snprintf(groups, sizeof groups,
             "seed: %d\ngroups: {crowd: {count: 80, in: room, behaviour: own.lua}}\n"
             "sinks: [{at: west}]\n",
             seed);
    const char *behaviour = "return machine { name = 'c', version = 1, start = 'C',\n"
                            "  defaults = { speed = 1.3, time_gap = 0.5 },\n"
                            "  states = { C = { steer = field 'west', speed = own.speed,\n"
                            "    time_gap = own.time_gap } } }\n";
    JoScene *scene = load_pair(flat, groups, behaviour);
    int steps = 0;
    for (; scene->world->state.agents.count && steps < 4000; steps++)
        step_scene(scene, 1);
    jo_scene_free(scene);
    return 0.05 * steps;
}

static void a_storey_empties_as_fast_as_the_same_plan_laid_flat(void **state) {
    (void)state;
    double flat = 0.0, high = 0.0;
    for (int seed = 1; seed <= 4; seed++) {
        flat += measure_emptying(true, seed) / 4;
        high += measure_emptying(false, seed) / 4;
    }
    if (fabs(high / flat - 1.0) > 0.05)
        fail_msg("flat %g s, over a seam %g s", flat, high);
}

static void people_on_storeys_above_each_other_pass_unnoticed(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        "jostle: 1\nstep: 0.05\nstoreys: {a: {height: 0}, b: {height: 3}}\n"
        "stairs: {way: {from: a, to: b, path: [[40, 5], [46, 5]], width: 2}}\n"
        "walls: [{line: [[0, 0], [60, 0], [60, 10], [0, 10]], closed: true}]\n"
        "groups:\n"
        "  low: {at: [[2, 5]], behaviour: own.lua, memory: {along: 1}}\n"
        "  high: {at: [[20, 5]], behaviour: own.lua, storey: b, memory: {along: -1}}\n",
        "local mine = memory { along = 1 }\n"
        "return machine { name = 'w', version = 1, start = 'W',\n"
        "  defaults = { speed = 1.3 },\n"
        "  states = { W = { steer = drift(mine.along, 0), speed = own.speed } } }\n");
    const JoxAgents *a = &scene->world->state.agents;
    for (int n = 0; n < 200; n++) {
        step_scene(scene, 1);
        for (uint32_t id = 0; id < 2; id++)
            assert_true(fabsf(find_in_plan(scene, id).y - 5.0f) < 0.01f);
        const uint32_t i = jox_agents_find(a, 0);
        assert_int_equal(scene->world->scratch.neighbours.count[i], 0);
    }
    jo_scene_free(scene);
}

static void behaviours_know_their_storey(void **state) {
    (void)state;
    JoScene *scene = load_pair(false,
                               "groups: {low: {at: [[3, 7]], behaviour: own.lua}, "
                               "high: {at: [[27, 2]], behaviour: own.lua, storey: high}}\n",
                               "return machine { name = 's', version = 1, start = 'Low',\n"
                               "  states = { Low = { steer = hold,\n"
                               "    { to = 'High', when = now.storey:is(1) & "
                               "now.height:above(0.005) & now.y:below(3) } },\n"
                               "  High = { steer = hold, on_enter = function(me) assert(me.storey "
                               "== 1 and me.y < 3) end },\n"
                               "  } }\n");
    const JoxAgents *a = &scene->world->state.agents;
    step_scene(scene, 3);
    const JoxState *states = scene->world->model.machines.items[0]->states;
    assert_string_equal(states[a->state[jox_agents_find(a, 0)]].name, "Low");
    assert_string_equal(states[a->state[jox_agents_find(a, 1)]].name, "High");
    assert_null(scene_messages.data);
    jo_scene_free(scene);
}

/* Returns the name of an agent's state. */
static const char *find_state(const JoScene *scene, uint32_t id) {
    const JoxAgents *a = &scene->world->state.agents;
    return scene->world->model.machines.items[0]->states[a->state[jox_agents_find(a, id)]].name;
}

static void signals_are_heard_over_a_seam_and_not_through_a_floor(void **state) {
    (void)state;
    JoScene *scene =
        load_pair(false,
                  "groups: {caller: {at: [[11.5, 5]], behaviour: own.lua}, "
                  "stair: {at: [[12.5, 5], [17.5, 5]], behaviour: own.lua, storey: way}, "
                  "above: {at: [[11.5, 7]], behaviour: own.lua, storey: high}}\n",
                  "return machine { name = 's', version = 1, start = 'Waits',\n"
                  "  states = { Waits = { steer = hold,\n"
                  "      { to = 'Calls', when = now.x:below(12) & now.storey:is(0) },\n"
                  "      { to = 'Hears', when = heard('go', 3) } },\n"
                  "    Calls = { steer = hold, signal = 'go' },\n"
                  "    Hears = { steer = hold } } }\n");
    step_scene(scene, 4);
    assert_string_equal(find_state(scene, 0), "Calls");
    assert_string_equal(find_state(scene, 1), "Hears");
    assert_string_equal(find_state(scene, 2), "Waits"); /* 6 m away */
    assert_string_equal(find_state(scene, 3), "Waits"); /* 2 m away, behind a floor */
    assert_null(scene_messages.data);
    jo_scene_free(scene);
}

static void distances_lead_through_floors(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        "jostle: 1\nstoreys: {low: {height: 0}, high: {height: 4}}\n"
        "places: {above: {polygon: [[2, 4], [8, 4], [8, 8], [2, 8]], storey: high}}\n"
        "groups: {one: {at: [[5, 5]], behaviour: own.lua}, "
        "two: {at: [[11, 5]], behaviour: own.lua}}\n",
        "return machine { name = 's', version = 1, start = 'A',\n"
        "  states = { A = { steer = hold,\n"
        "      { to = 'Below', when = distance('above'):above(3.99) & "
        "distance('above'):below(4.01) },\n"
        "      { to = 'Aside', when = distance('above'):above(4.99) & "
        "distance('above'):below(5.01) } },\n"
        "    Below = { steer = hold }, Aside = { steer = hold } } }\n");
    step_scene(scene, 2);
    assert_string_equal(find_state(scene, 0), "Below");
    assert_string_equal(find_state(scene, 1), "Aside");
    jo_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(who_goes_up_and_down_ten_times_loses_nothing),
        cmocka_unit_test(a_push_passes_over_a_seam),
        cmocka_unit_test(a_storey_empties_as_fast_as_the_same_plan_laid_flat),
        cmocka_unit_test(people_on_storeys_above_each_other_pass_unnoticed),
        cmocka_unit_test(behaviours_know_their_storey),
        cmocka_unit_test(signals_are_heard_over_a_seam_and_not_through_a_floor),
        cmocka_unit_test(distances_lead_through_floors),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
