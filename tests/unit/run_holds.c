/* Tests of intended contact between people: approaching, taking hold, pulling, slipping. */
#include <math.h>

#include "jostle_tools.h"
#include "unit/scene_loader.h"

#define APART(x)                                                                                   \
    "jostle: 1\nforces: {enabled: true}\nplaces: {end: {point: [30, 0]}}\n"                        \
    "groups:\n"                                                                                    \
    "  one: {behaviour: own.lua, at: [[0, 0]], tags: [one]}\n"                                     \
    "  other: {behaviour: own.lua, at: [[" x ", 0]], tags: [other]}\n"

/* Behaviour of two agents, "one" (id 0) and "other" (id 1): the content of each one's state. */
#define TWO(own, one, other)                                                                       \
    MACHINE_START "\"Wait\", defaults = { perception = 10, speed = 1.3, mass = 70 }, states = {\n" \
                  "  Wait = { steer = hold, { to = \"One\", when = sees(nearest \"other\") },\n"   \
                  "    { to = \"Other\", when = sees(nearest \"one\") } },\n"                      \
                  "  One = { " one " }, Other = { " other " },\n"                                  \
                  "  Has = { " own " }, Free = { steer = hold } } }\n"

typedef struct Pair {
    JoScene *scene;
    const JoxAgents *a;
    uint32_t one, other;
} Pair;

static Pair load_pair(const char *scene, const char *behaviour) {
    Pair p = {.scene = load_scene_text(scene, behaviour)};
    p.a = &p.scene->world->state.agents;
    return p;
}

static void step_pair(Pair *p, int steps) {
    step_scene(p->scene, steps);
    p->one = jox_agents_find(p->a, 0);
    p->other = jox_agents_find(p->a, 1);
}

static float measure_pair_gap(const Pair *p) {
    const JoxParameterColumn radius = p->a->param[JOX_PARAM_radius];
    return jox_length(jox_offset(p->a, p->one, p->other)) - jox_at(radius, p->one) -
           jox_at(radius, p->other);
}

static const char *read_pair_state(const Pair *p, uint32_t i) {
    return p->scene->world->model.machines.items[p->a->machine[i]]->states[p->a->state[i]].name;
}

/* ORCA slows down before a standing agent; an approaching agent runs into it at full speed. */
static void approaching_agent_runs_into_its_target(void **state) {
    (void)state;
    static const char *const STEERS[2] = {
        TWO("", "steer = seek(nearest \"other\"), push = 0", "steer = hold"),
        TWO("", "steer = seek(nearest \"other\"), approach = nearest \"other\", push = 0",
            "steer = hold")};
    float came[2];
    for (int approaches = 0; approaches < 2; approaches++) {
        Pair p = load_pair(APART("2"), STEERS[approaches]);
        float least = INFINITY;
        step_pair(&p, 8);
        for (int n = 0; n < 32; n++) {
            step_pair(&p, 1);
            least = jox_minf(least, p.a->vx[p.one]);
        }
        assert_int_equal(p.a->approached[p.one], approaches ? 2 : 0);
        assert_true(approaches ? least > 1.25f : least < 0.9f);
        assert_true(p.a->x[p.other] > 2.5f &&
                    measure_pair_gap(&p) < 0.05f); /* the shoved agent moves along */
        came[approaches] = p.a->x[p.one];
        jo_scene_free(p.scene);
    }
    assert_true(came[1] > came[0] + 0.3f);
}

#define HOLDS "steer = hold, grasp = nearest \"other\", grip = 200"
/* Both agents are pulled by the same force, at most the grip. */
static void hold_pulls_both_agents_alike(void **state) {
    (void)state;
    Pair p = load_pair(APART("0.7"), TWO("", HOLDS, "steer = seek \"end\""));
    float most = 0.0f;
    int held = 0, told = 0;
    for (int n = 0; n < 60; n++) {
        step_pair(&p, 1);
        assert_float_equal(p.a->last_ext_x[p.one] + p.a->last_ext_x[p.other], 0, 1e-4);
        assert_float_equal(p.a->last_ext_y[p.one] + p.a->last_ext_y[p.other], 0, 1e-4);
        assert_true(p.a->last_ext_x[p.one] >= 0.0f); /* towards the agent that it holds */
        most = jox_maxf(most, p.a->last_ext_x[p.one]);
        assert_int_equal(p.a->held[p.other], p.a->grasped[p.one] == 2);
        assert_int_equal(p.a->held[p.one], 0);
        held += p.a->held[p.other];
        const JoEvents e = jo_world_events(p.scene->world);
        for (uint32_t k = 0; k < e.action_count; k++, told++)
            assert_true(e.actions[k].agent == 0 && e.actions[k].kind == JO_DONE_GRASP &&
                        e.actions[k].other == 1);
    }
    assert_true(held > 55);
    assert_int_equal(told, 1); /* it took hold once */
    assert_true(most > 20.0f && most <= 200.0f);
    assert_true(p.a->x[p.one] > 0.1f); /* it is dragged along */
    jo_scene_free(p.scene);
}

static void check_inspected(const Pair *p, uint32_t i, const char *part) {
    char *json = jo_scene_inspect(p->scene, p->a->slot[i]);
    if (!json || !strstr(json, part))
        fail_msg("%s lacks %s", json, part);
    jo_free(json);
}

/* A grip of 1 N cannot hold a walking agent: at a gap of 1 m the hold is lost. */
static void weak_hold_slips(void **state) {
    (void)state;
    Pair p = load_pair(APART("0.7"), TWO("steer = hold, grasp = nearest \"other\", grip = 1, "
                                         "{ to = \"Free\", when = ~has(nearest \"other\") }",
                                         "steer = hold, grasp = nearest \"other\", grip = 1, "
                                         "{ to = \"Has\", when = has(nearest \"other\") }",
                                         "steer = seek \"end\""));
    step_pair(&p, 6);
    assert_string_equal(read_pair_state(&p, p.one), "Has");
    check_inspected(&p, p.one, "\"holds\": \"agent 1\"");
    check_inspected(&p, p.other, "\"held_by\": [0]");
    step_pair(&p, 40);
    assert_string_equal(read_pair_state(&p, p.one), "Free");
    assert_int_equal(p.a->grasped[p.one], 0);
    assert_int_equal(p.a->held[p.other], 0);
    assert_true(measure_pair_gap(&p) > 1.0f);
    jo_scene_free(p.scene);
}

/* A computed grip may be NaN, negative or infinite. */
static void computed_grips_are_clamped(void **state) {
    (void)state;
    static const char *const GRIPS[3] = {
        TWO("", "steer = hold, grasp = nearest \"other\", grip = 0 - 100 * now.time",
            "steer = seek \"end\""),
        TWO("", "steer = hold, grasp = nearest \"other\", grip = sqrt(0 - now.time - 1)",
            "steer = seek \"end\""),
        TWO("", "steer = hold, grasp = nearest \"other\", grip = 1e30 * now.time * 1e30",
            "steer = seek \"end\"")};
    for (int n = 0; n < 3; n++) {
        Pair p = load_pair(APART("0.7"), GRIPS[n]);
        for (int k = 0; k < 20; k++) {
            step_pair(&p, 1);
            const float pull = p.a->last_ext_x[p.one];
            assert_true(n < 2 ? pull == 0.0f : pull >= 0.0f && pull <= 5000.0f);
        }
        jo_scene_free(p.scene);
    }
}

static void agent_out_of_reach_is_not_held(void **state) {
    (void)state;
    Pair p = load_pair(APART("2"), TWO("", HOLDS, "steer = hold"));
    step_pair(&p, 10);
    assert_int_equal(p.a->grasped[p.one], 0);
    assert_float_equal(p.a->x[p.one], 0, 1e-3);
    jo_scene_free(p.scene);
}

static void held_agent_knows_and_can_be_released(void **state) {
    (void)state;
    Pair p = load_pair(APART("0.7"), TWO("", HOLDS ", { to = \"Free\", when = after(1) }",
                                         "steer = hold, { to = \"Has\", when = holders:is(1) }"));
    step_pair(&p, 5);
    assert_string_equal(read_pair_state(&p, p.other), "Has");
    step_pair(&p, 25);
    assert_string_equal(read_pair_state(&p, p.one), "Free");
    assert_int_equal(p.a->grasped[p.one], 0);
    assert_int_equal(p.a->held[p.other], 0);
    jo_scene_free(p.scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(approaching_agent_runs_into_its_target),
        cmocka_unit_test(hold_pulls_both_agents_alike),
        cmocka_unit_test(weak_hold_slips),
        cmocka_unit_test(computed_grips_are_clamped),
        cmocka_unit_test(agent_out_of_reach_is_not_held),
        cmocka_unit_test(held_agent_knows_and_can_be_released),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
