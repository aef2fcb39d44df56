/* Inspection of agents: forces and half-planes are those of the step, and inspecting does not
   change the run. */
#include <math.h>

#include "jostle_tools.h"
#include "unit/gate_ball_scene.h"

#define TIGHT                                                                                      \
    "jostle: 1\n"                                                                                  \
    "places: {yard: {polygon: [[0, 0], [3.6, 0], [3.6, 3.6], [0, 3.6]]}}\n"                        \
    "groups: {people: {behaviour: own.lua, count: 60, fill: grid, in: yard, spacing: 0.45}}\n"

/* Returns the number behind the first occurrence of a key. */
static double read_number_after(const char *json, const char *key) {
    const char *at = strstr(json, key);
    assert_non_null(at);
    return atof(at + strlen(key));
}

static void inspected_forces_and_planes_match_the_step(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        TIGHT, MACHINE_START
        "\"A\", states = { A = { steer = seek \"yard\" + 0.3 * spread, push = 60 } } }\n");
    JoScene *plain = load_scene_text(
        TIGHT, MACHINE_START
        "\"A\", states = { A = { steer = seek \"yard\" + 0.3 * spread, push = 60 } } }\n");
    const JoxAgents *a = &scene->world->state.agents;
    double most = 0.0;
    for (int n = 0; n < 60; n++) {
        const JoxWatched *watched;
        jo_free(jo_scene_inspect(scene, 25));
        JoError error = {0};
        if (n % 7 == 3) {
            assert_true(jo_scene_input(scene, "push 25 90 -30", &error));
            assert_true(jo_scene_input(plain, "push 25 90 -30", &error));
        }
        step_scene(scene, 1);
        step_scene(plain, 1);
        const JoxInspected *seen = jox_world_inspect(scene->world, 25, &watched);
        uint32_t i = a->slot_index[25];
        JoxV2 sum = {0, 0};
        for (int f = 0; f < JOX_FORCE_PARTS; f++)
            sum = jox_add(sum, seen->forces[f]);
        assert_true(fabsf(sum.x - a->force_x[i]) < 0.01f && fabsf(sum.y - a->force_y[i]) < 0.01f);
        assert_true((seen->forces[JOX_FORCE_PART_ext].x == 90.0f) == (n % 7 == 3));
        most = fmax(most, (double)jox_length(seen->forces[JOX_FORCE_PART_push]));
        assert_true(seen->plane_count >= 5);
        for (uint32_t p = 0; p < seen->plane_count && !seen->failed; p++)
            assert_true(jox_dot(seen->planes[p].normal, seen->chosen) >
                        seen->planes[p].offset - 1e-4f);
        assert_true(jox_length(seen->chosen) <= seen->speed_limit + 1e-4f);
    }
    assert_true(most > 10.0); /* neighbours pushed the agent */
    assert_true(jo_world_hash(scene->world) == jo_world_hash(plain->world));
    char *json = jo_scene_inspect(scene, 25);
    assert_non_null(strstr(json, "{\"agent\": {\"id\": 25, \"slot\": 25, \"group\": \"people\", "
                                 "\"machine\": \"m\", \"state\": \"A\", \"since\": 3,"));
    assert_true(fabs(read_number_after(json, "\"x\": ") - (double)a->x[a->slot_index[25]]) < 1e-4);
    assert_non_null(
        strstr(json, "{\"name\": \"push\", \"value\": 60, \"unit\": \"N\", \"set\": \"state A "));
    assert_non_null(strstr(json, "{\"name\": \"push_angle\", \"value\": 60,"));
    jo_free(json);
    jo_scene_free(scene);
    jo_scene_free(plain);
}

/* Measures in m, angles in degrees; a disc has no torso. */
static void torso_is_inspected(void **state) {
    (void)state;
    static const char TURNED[] =
        "jostle: 1\n"
        "groups: {people: {behaviour: own.lua, at: [[0, 0]], facing: 90}}\n";
    JoScene *scene =
        load_scene_text(TURNED, MACHINE_START
                        "\"A\", states = { A = { steer = hold, breadth = 0.45, depth = 0.25, "
                        "{ to = \"B\", when = after(1) } }, B = { steer = hold, breadth = 0.3, "
                        "depth = 0.3 } } }\n");
    char *json = jo_scene_inspect(scene, 0);
    assert_non_null(strstr(json, "\"torso\": {\"breadth\": 0.45, \"depth\": 0.25, \"chest\": 90, "
                                 "\"spin\": 0}"));
    jo_free(json);
    step_scene(scene, 30);
    json = jo_scene_inspect(scene, 0);
    assert_non_null(strstr(json, "\"torso\": null"));
    jo_free(json);
    jo_scene_free(scene);
}

#define LEAVING                                                                                    \
    "jostle: 1\nseed: 4\n"                                                                         \
    "places:\n"                                                                                    \
    "  yard: {polygon: [[0, 0], [8, 0], [8, 8], [0, 8]]}\n"                                        \
    "  out: {point: [11, 4], radius: 1.5}\n"                                                       \
    "walls:\n"                                                                                     \
    "  - {line: [[9, 5], [0, 9]]}\n"                                                               \
    "bodies: [{shape: {box: {size: [1, 1, 1]}}, mass: 500, at: [9.6, 4.4, 0.5]}]\n"                \
    "sinks: [{at: out}]\n"                                                                         \
    "groups: {people: {behaviour: own.lua, count: 40, fill: grid, in: yard}}\n"

/* Copies the half-planes of neighbours, walls and bodies: those of contacts and forces are only
   known in the step. */
static uint32_t copy_neighbour_planes(const JoxInspected *seen, JoxConstraint *out) {
    uint32_t count = 0;
    for (uint32_t p = 0; p < seen->plane_count; p++)
        if (seen->planes[p].kind == JOX_CONSTRAINT_AGENT ||
            seen->planes[p].kind == JOX_CONSTRAINT_WALL ||
            seen->planes[p].kind == JOX_CONSTRAINT_BODY)
            out[count++] = seen->planes[p];
    return count;
}

/* Half-planes must be equal to the bit. */
static void check_same_plane(const JoxConstraint *now, const JoxConstraint *in_step) {
    assert_true(now->kind == in_step->kind && now->normal.x == in_step->normal.x &&
                now->normal.y == in_step->normal.y && now->offset == in_step->offset);
}

/* An agent that is first inspected between two steps, as in a pause, is shown with the half-planes
   that the next step uses, also when people left in the last step. */
static void inspection_between_steps_predicts_the_next_step(void **state) {
    (void)state;
    const char *behaviour = MACHINE_START "\"A\", states = { A = { steer = seek \"out\" } } }\n";
    JoScene *scene = load_scene_text(LEAVING, behaviour),
            *plain = load_scene_text(LEAVING, behaviour);
    JoxAgents *a = &scene->world->state.agents;
    const JoxWatched *watched;
    uint32_t looked = 0, planes = 0, left = 0, same = 0;
    assert_false(jox_world_inspect(scene->world, 3, &watched)->seen); /* before the first step */
    for (int n = 0; n < 400 && a->count > 4; n++) {
        JoxConstraint before[JOX_MOST_CONSTRAINTS], after[JOX_MOST_CONSTRAINTS];
        const uint32_t people = a->count;
        for (uint32_t s = 0; n % 8 == 0 && s < a->slot_count; s++) /* pushes all agents */
            if (a->slot_index[s] != JOX_NO_INDEX) {
                char push[40];
                snprintf(push, sizeof push, "push %u 20 -10", s);
                apply_input(scene, push);
                apply_input(plain, push);
            }
        step_scene(scene, 1);
        step_scene(plain, 1);
        if (a->count == people && n % 8)
            continue;
        left += a->count < people;
        const uint32_t i = a->by_rank[(uint32_t)n * 7 % a->count], slot = a->slot[i];
        for (uint32_t k = scene->world->scratch.inspection.count; k-- > 0;)
            scene->world->scratch.inspection.agents[k].asked = UINT32_MAX; /* makes it expire */
        jox_inspect_end_old(scene->world);
        assert_int_equal(scene->world->scratch.inspection.count, 0);
        const JoxInspected *seen = jox_world_inspect(scene->world, slot, &watched);
        assert_true(seen && seen->seen);
        assert_true(seen->forces[JOX_FORCE_PART_ext].x == (n % 8 ? 0.0f : 20.0f));
        assert_true(seen->forces[JOX_FORCE_PART_ext].y == (n % 8 ? 0.0f : -10.0f));
        const JoxV2 chosen = seen->chosen, preferred = seen->preferred;
        const uint32_t count = copy_neighbour_planes(seen, before);
        /* in contact, or with half-planes of forces */
        const bool touches = a->contacts[i] > 0 || seen->plane_count != count;
        step_scene(scene, 1);
        step_scene(plain, 1);
        n++;
        seen = jox_world_inspect(scene->world, slot, &watched);
        if (!seen || touches || a->contacts[a->slot_index[slot]] > 0)
            continue; /* contacts are only found in the step */
        assert_int_equal(copy_neighbour_planes(seen, after), count);
        for (uint32_t p = 0; p < count; p++)
            check_same_plane(&before[p], &after[p]);
        /* preference unchanged, and no half-plane of a force that only the step knows */
        if (jox_length(jox_sub(preferred, seen->preferred)) < 0.05f && seen->plane_count == count) {
            assert_true(jox_length(jox_sub(chosen, seen->chosen)) < 0.2f);
            same++;
        }
        looked++;
        planes += count;
    }
    assert_true(looked > 10 && planes > 5 * looked && left > 5 && 2 * same > looked);
    assert_true(jo_world_hash(scene->world) == jo_world_hash(plain->world));
    jo_scene_free(scene);
    jo_scene_free(plain);
}

/* A restored world has no figures of its last step; the next step gives them. */
static void inspection_of_a_restored_world_waits_for_a_step(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(GATE_ALONE FOUR_WALKERS, WALKER);
    JoError error = {0};
    size_t size;
    step_scene(scene, 3);
    void *saved = jo_world_snapshot(scene->world, &size, &error);
    assert_true(saved && jo_world_restore(scene->world, saved, size, &error));
    jo_free(saved);
    for (int n = 0; n < 2; n++) {
        char *json = jo_scene_inspect(scene, 2);
        assert_non_null(strstr(json, n ? "\"seen\": true" : "\"seen\": false"));
        jo_free(json);
        step_scene(scene, 1);
    }
    jo_scene_free(scene);
}

static void inspection_names_the_places_that_set_values(void **state) {
    (void)state;
    JoScene *scene = load_gate_and_ball();
    char *json = jo_scene_inspect(scene, 1);
    assert_non_null(
        strstr(json, "\"last\": {\"from\": null, \"to\": \"Walk\", \"time\": 0, \"why\": null}"));
    assert_non_null(strstr(json, "\"memory\": {\"laps\": 3, \"met\": false}"));
    assert_non_null(
        strstr(json, "\"value\": 80, \"unit\": \"kg\", \"set\": \"scene groups.people "));
    assert_non_null(strstr(json, "\"seen\": false"));
    jo_free(json);
    apply_input(scene, "signal stop");
    apply_input(scene, "set m Wait max_speed 0.7");
    step_scene(scene, 2);
    json = jo_scene_inspect(scene, 1);
    assert_non_null(strstr(json, "\"last\": {\"from\": \"Walk\", \"to\": \"Wait\", \"time\": 0"));
    assert_non_null(strstr(json, "when heard(\\\"stop\\\") is true"));
    assert_non_null(strstr(json, "\"name\": \"max_speed\", \"value\": 0.7, \"unit\": \"m/s\", "
                                 "\"set\": \"program or page\""));
    assert_non_null(strstr(json, "\"seen\": true"));
    jo_free(json);
    /* The inspected agent has left: null once, though a new agent has its slot. */
    JoAgent agent = {1, scene->world->state.agents.slot_generation[1]};
    jo_world_remove_agent(scene->world, agent);
    uint32_t i = jox_world_add_agent(scene->world, 9.0f, 9.0f);
    jox_machines_spawn(&scene->world->machines, i, 0, NULL, NULL);
    assert_int_equal(scene->world->state.agents.slot[i], 1);
    json = jo_scene_inspect(scene, 1);
    assert_string_equal(json, "{\"agent\": null}");
    jo_free(json);
    json = jo_scene_inspect(scene, 1);
    assert_non_null(strstr(json, "{\"agent\": {\"id\": 4,"));
    assert_non_null(strstr(json, "\"seen\": false")); /* the new agent was in no step yet */
    assert_non_null(strstr(json, "\"planes\": []"));
    jo_free(json);
    step_scene(scene, 1);
    json = jo_scene_inspect(scene, 1);
    assert_non_null(strstr(json, "\"seen\": true"));
    jo_free(json);
    json = jo_scene_inspect(scene, 4000000000u);
    assert_string_equal(json, "{\"agent\": null}");
    jo_free(json);
    jo_scene_free(scene);
}

static void inspections_expire(void **state) {
    (void)state;
    JoScene *scene = load_gate_and_ball();
    JoxInspection *all = &scene->world->scratch.inspection;
    for (uint32_t slot = 0; slot < 4; slot++)
        jo_free(jo_scene_inspect(scene, slot));
    assert_int_equal(all->count, 4);
    step_scene(scene, 60);
    jo_free(jo_scene_inspect(scene, 2));
    step_scene(scene, 60);
    assert_int_equal(all->count, 1);
    assert_int_equal(all->agents[0].slot, 2);
    for (int n = 0; n < 14; n++)
        jox_machines_spawn(&scene->world->machines,
                           jox_world_add_agent(scene->world, 9.0f, 0.7f * (float)n), 0, NULL, NULL);
    for (uint32_t slot = 3; slot < 18; slot++) /* one too many: replaces the oldest */
        jo_free(jo_scene_inspect(scene, slot));
    assert_int_equal(all->count, JOX_MOST_INSPECTED);
    step_scene(scene, 1);
    jo_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(torso_is_inspected),
        cmocka_unit_test(inspected_forces_and_planes_match_the_step),
        cmocka_unit_test(inspection_between_steps_predicts_the_next_step),
        cmocka_unit_test(inspection_names_the_places_that_set_values),
        cmocka_unit_test(inspection_of_a_restored_world_waits_for_a_step),
        cmocka_unit_test(inspections_expire),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
