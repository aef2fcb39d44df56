/* Frames, people, fields and status of a running scene: they match the agents' columns, and making
   them does not change the run. Frames are decoded from their bytes, as a page does. */
#include "live_bytes.h"
#include "run/figure_listeners.h"

/* ---- frames ---- */

#define COMING                                                                                     \
    "jostle: 1\n"                                                                                  \
    "places:\n"                                                                                    \
    "  west: {polygon: [[0, 0], [4, 0], [4, 12], [0, 12]]}\n"                                      \
    "  east: {line: [[14, 0], [14, 12]]}\n"                                                        \
    "  gone: {polygon: [[12, -5], [30, -5], [30, 17], [12, 17]]}\n"                                \
    "groups: {people: {behaviour: own.lua, count: 60, fill: random, in: west}}\n"                  \
    "sources: [{at: west, like: people, rate: 9}]\n"                                               \
    "sinks: [{at: gone}]\n"
#define EASTWARD                                                                                   \
    MACHINE_START "\"A\", states = { A = { steer = drift(1, 0), speed = uniform(1, 3) } } }\n"

/* While people come and leave, those who stay keep their slots, and the parity of a slot flips when
   its person changes. */
static void people_keep_their_slots_between_frames(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(COMING, EASTWARD);
    const JoxAgents *a = &scene->world->state.agents;
    JoxBytes frame = {0};
    static uint32_t owner[1000];
    static uint8_t parity[1000];
    static double x[1000], y[1000];
    uint32_t others = 0, same = 0;
    memset(owner, 0xff, sizeof owner);
    for (int t = 0; t < 400; t++) {
        step_scene(scene, 1);
        jox_live_frame(scene, JOX_LIVE_COLOUR_speed, NULL, &frame);
        Seen seen = decode_frame(&frame, scene->world);
        check_frame_people(scene, &seen);
        assert_true(seen.slots < 1000);
        for (uint32_t s = 0; s < seen.slots; s++) {
            const uint8_t *at = seen.slot + 8 * (size_t)s;
            if (at[5] == 255)
                continue;
            const uint32_t id = a->id[a->slot_index[s]];
            if (owner[s] != UINT32_MAX) {
                assert_int_equal(parity[s] == (at[7] & 1), owner[s] == id);
                if (owner[s] == id) /* the same person moves a short way */
                    assert_true(hypot(x_of(&seen, s) - x[s], y_of(&seen, s) - y[s]) < 0.5);
                others += owner[s] != id;
                same += owner[s] == id;
            }
            owner[s] = id;
            parity[s] = at[7] & 1;
            x[s] = x_of(&seen, s);
            y[s] = y_of(&seen, s);
        }
    }
    assert_true(others > 20 && same > 10000);
    jox_bytes_free(&frame);
    jo_scene_free(scene);
}

/* An agent that crosses a periodic edge keeps its slot, whose parity flips. */
static void parity_flips_at_periodic_edges(void **state) {
    (void)state;
    JoScene *scene = load_scene_file("scenes/ring.yaml", NULL, 0);
    const float period = scene->world->state.agents.period.x;
    JoxBytes frame = {0};
    static double x[1000];
    static uint8_t parity[1000];
    uint32_t rounds = 0;
    assert_true(period > 1.0f);
    for (int t = 0; t < 200; t++) {
        step_scene(scene, 1);
        jox_live_frame(scene, JOX_LIVE_COLOUR_speed, NULL, &frame);
        jox_live_frame(scene, JOX_LIVE_COLOUR_state, NULL, &frame);
        Seen seen = decode_frame(&frame, scene->world);
        check_frame_people(scene, &seen);
        for (uint32_t s = 0; s < seen.slots; s++) {
            const uint8_t now = seen.slot[8 * (size_t)s + 7] & 1;
            if (t > 0) {
                const bool round = fabs(x_of(&seen, s) - x[s]) > 0.5 * (double)period;
                assert_int_equal(now != parity[s], round);
                rounds += round;
            }
            x[s] = x_of(&seen, s);
            parity[s] = now;
        }
    }
    assert_true(rounds > 2);
    jox_bytes_free(&frame);
    jo_scene_free(scene);
}

/* Positions in frames are right for agents that walk far beyond all that the scene names. */
static void area_grows_with_the_crowd(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(YARD_WITH_PEOPLE(20), MACHINE_START
                                     "\"A\", defaults = { speed = 9, max_speed = 9 }, "
                                     "states = { A = { steer = drift(-1, -0.3) } } }\n");
    JoxBytes frame = {0};
    jox_live_frame(scene, JOX_LIVE_COLOUR_state, NULL, &frame);
    Seen before = decode_frame(&frame, scene->world);
    for (int t = 0; t < 300; t++) {
        step_scene(scene, 1);
        jox_live_frame(scene, JOX_LIVE_COLOUR_state, NULL, &frame);
        Seen seen = decode_frame(&frame, scene->world);
        check_frame_people(scene, &seen);
    }
    Seen after = decode_frame(&frame, scene->world);
    assert_true(after.x0 < before.x0 - 50 && after.y0 < before.y0 - 10);
    jox_bytes_free(&frame);
    jo_scene_free(scene);
}

/* In a state with `lies = true` the flags say so, in place of a lean under pushes. */
static void lying_state_sets_the_lying_flag(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        YARD_WITH_PEOPLE(4),
        MACHINE_START "\"A\", states = { A = { steer = hold, { to = \"B\", when = after(0.2) } }, "
                      "B = { steer = hold, lies = true } } }\n");
    const JoxAgents *a = &scene->world->state.agents;
    JoxBytes frame = {0};
    for (int t = 0; t < 2; t++) {
        step_scene(scene, t == 0 ? 1 : 8);
        a->contact_x[0] = 200.0f;
        jox_live_frame(scene, JOX_LIVE_COLOUR_state, NULL, &frame);
        const Seen seen = decode_frame(&frame, scene->world);
        const uint8_t flags = seen.slot[8 * (size_t)a->slot[0] + 7];
        assert_int_equal((flags & JOX_LIVE_LIES) == JOX_LIVE_LIES, t == 1);
    }
    jox_bytes_free(&frame);
    jo_scene_free(scene);
}

/* The upper bits of the flags of the first agent, 1 s after it has got a scene's body or friend. */
static uint8_t find_deed(const char *text, const char *state) {
    char behaviour[300];
    snprintf(behaviour, sizeof behaviour, MACHINE_START "\"A\", states = { A = { %s } } }\n",
             state);
    JoScene *scene = load_scene_text(text, behaviour);
    JoxBytes frame = {0};
    step_scene(scene, 20);
    jox_live_frame(scene, JOX_LIVE_COLOUR_state, NULL, &frame);
    const Seen seen = decode_frame(&frame, scene->world);
    const uint32_t slot = scene->world->state.agents.slot[0];
    const uint8_t flags = seen.slot[8 * (size_t)slot + 7];
    jox_bytes_free(&frame);
    jo_scene_free(scene);
    return (uint8_t)(flags >> JOX_LIVE_LEAN_SHIFT << JOX_LIVE_LEAN_SHIFT);
}

/* The flags say who carries a body, and who holds on to somebody. */
static void carriers_and_holders_set_their_flags(void **state) {
    (void)state;
    assert_int_equal(
        find_deed("jostle: 1\nstep: 0.05\ngroups: {g: {behaviour: own.lua, at: [[0, 0], "
                  "[0.6, 0]], tags: [friend]}}\n",
                  "steer = hold, grasp = nearest \"friend\""),
        JOX_LIVE_HOLDS);
    if (jox_bodies_available())
        assert_int_equal(
            find_deed("jostle: 1\nstep: 0.05\ngroups: {g: {behaviour: own.lua, at: [[0, 0]]}}\n"
                      "bodies: [{name: ball, tags: [ball], shape: {sphere: {radius: 0.1}}, mass: "
                      "0.4, at: [0.5, 0, 0.1]}]\n",
                      "steer = hold, take = nearest \"ball\""),
            JOX_LIVE_CARRIES);
}

/* The lean has the direction and the level of the push, averaged over time: it outlasts the
   push. */
static void averaged_pushes_set_the_lean(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(YARD_WITH_PEOPLE(32),
                                     MACHINE_START "\"A\", states = { A = { steer = hold } } }\n");
    JoxAgents *a = &scene->world->state.agents;
    static const float FORCE[] = {50, 100, 200, 400};
    JoxBytes frame = {0};
    step_scene(scene, 1);
    for (uint32_t i = 0; i < a->count; i++) { /* 3 degrees off one of the eight directions */
        const float turn = ((float)(a->id[i] % 8) * 45.0f + 3.0f) * 0.0174532925f;
        const float force = FORCE[a->id[i] / 8];
        a->push_x[i] = 0.25f * force * cosf(turn);
        a->push_y[i] = 0.25f * force * sinf(turn);
        a->contact_x[i] = 0.75f * force * cosf(turn);
        a->contact_y[i] = 0.75f * force * sinf(turn);
    }
    jox_live_frame(scene, JOX_LIVE_COLOUR_state, NULL, &frame);
    Seen seen = decode_frame(&frame, scene->world);
    for (uint32_t i = 0; i < a->count; i++) {
        const uint32_t lean = seen.slot[8 * (size_t)a->slot[i] + 7] >> JOX_LIVE_LEAN_SHIFT;
        const uint32_t hard = a->id[i] / 8;
        assert_int_equal(lean, hard ? 1 + a->id[i] % 8 + 8 * (hard - 1) : 0);
    }
    step_scene(scene, 1); /* a step without pushes */
    jox_live_frame(scene, JOX_LIVE_COLOUR_state, NULL, &frame);
    seen = decode_frame(&frame, scene->world);
    uint32_t leaning = 0;
    for (uint32_t i = 0; i < a->count; i++)
        leaning += seen.slot[8 * (size_t)a->slot[i] + 7] >> JOX_LIVE_LEAN_SHIFT > 0;
    assert_true(leaning >= 24); /* the average has hardly decayed */
    step_scene(scene, 100);
    jox_live_frame(scene, JOX_LIVE_COLOUR_state, NULL, &frame);
    seen = decode_frame(&frame, scene->world);
    for (uint32_t i = 0; i < a->count; i++)
        assert_int_equal(seen.slot[8 * (size_t)a->slot[i] + 7] >> JOX_LIVE_LEAN_SHIFT, 0);
    jox_bytes_free(&frame);
    jo_scene_free(scene);
}

/* Compares the values of each colour with the columns that they come from. */
static void colour_values_match_the_columns(void **state) {
    (void)state;
    JoScene *scene = load_scene_file("scenes/running-through.yaml", NULL, 0);
    const JoxAgents *a = &scene->world->state.agents;
    JoxBytes frame = {0};
    step_scene(scene, 60); /* the runner has reached the standing people */
    for (uint32_t i = 0; i < a->count; i++)
        a->load[i] = a->compression[i] = (float)(10 * i);
    for (int c = 0; c < JOX_LIVE_COLOUR_COUNT; c++) {
        jox_live_frame(scene, (JoxLiveColour)c, NULL, &frame);
        Seen seen = decode_frame(&frame, scene->world);
        uint32_t above = 0;
        for (uint32_t i = 0; i < a->count; i++) {
            const float wanted[] = {0,
                                    hypotf(a->vx[i], a->vy[i]),
                                    hypotf(a->force_x[i], a->force_y[i]),
                                    a->compression[i],
                                    a->load[i],
                                    a->density[i],
                                    a->group[i],
                                    0,
                                    a->density[i]};
            const double shown = seen.slot[8 * (size_t)a->slot[i] + 6] / 255.0 * (double)seen.most;
            const double value = fmin((double)wanted[c], (double)seen.most);
            assert_near(shown, value, 0.502 * (double)seen.most / 255);
            above += shown > 0;
        }
        /* There are two groups. State and direction have value 0: frames have them elsewhere. */
        assert_int_equal(above > 0, c != JOX_LIVE_COLOUR_state && c != JOX_LIVE_COLOUR_direction);
    }
    assert_int_equal(jox_live_colour("compression"), JOX_LIVE_COLOUR_compression);
    assert_int_equal(jox_live_colour("compressio"), -1);
    jox_bytes_free(&frame);
    jo_scene_free(scene);
}

static void people_message_reports_changes(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(COMING, EASTWARD);
    const JoxAgents *a = &scene->world->state.agents;
    JoxBytes people = {0};
    assert_true(jox_live_people(scene, &people));
    assert_false(jox_live_people(scene, &people));
    step_scene(scene, 40); /* the source adds people */
    assert_true(jox_live_people(scene, &people));
    assert_int_equal(get32(people.data), 2);
    assert_int_equal(get32(people.data + 4), 0);
    assert_int_equal(get32(people.data + 8), a->slot_count);
    assert_int_equal(people.length, 16 + 4 * (size_t)a->slot_count);
    for (uint32_t i = 0; i < a->count; i++)
        assert_memory_equal(people.data + 16 + 4 * a->slot[i], ((const uint8_t[]){20, 0, 45, 25}),
                            4);
    jox_bytes_free(&people);
    jo_scene_free(scene);
}

/* A scene with one torso sends breadths, depths and chests of all; a disc is as broad as deep. A
   scene of discs alone sends none. */
static void torsos_are_sent_with_frames(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(YARD_WITH_PEOPLE(4), EASTWARD);
    JoxAgents *a = &scene->world->state.agents;
    JoxBytes people = {0}, frame = {0};
    step_scene(scene, 1);
    for (uint32_t i = 0; i < a->count; i++) {
        jox_param_set(a, JOX_PARAM_breadth, i, 0.4f);
        jox_param_set(a, JOX_PARAM_depth, i, 0.4f);
    }
    assert_true(jox_live_people(scene, &people));
    assert_int_equal(people.length, 16 + 2 * (size_t)a->slot_count);
    assert_int_equal(people.data[16 + 2 * a->slot[1]], 20);
    jox_live_frame(scene, JOX_LIVE_COLOUR_state, NULL, &frame);
    assert_int_equal(get32(frame.data + 44), 0);
    step_scene(scene, 1);
    jox_param_set(a, JOX_PARAM_breadth, 2, 0.45f);
    jox_param_set(a, JOX_PARAM_depth, 2, 0.25f);
    a->chest_x[2] = 0.0f;
    a->chest_y[2] = 1.0f;
    assert_true(jox_live_people(scene, &people));
    assert_false(jox_live_people(scene, &people));
    assert_int_equal(get32(people.data + 12), 4);
    assert_int_equal(people.length, 16 + 4 * (size_t)a->slot_count);
    const uint8_t *torso = people.data + 16 + 4 * a->slot[2], *disc = people.data + 16;
    assert_memory_equal(torso, ((const uint8_t[]){20, 0, 45, 25}), 4);
    assert_memory_equal(disc + 4 * a->slot[1], ((const uint8_t[]){20, 0, 40, 40}), 4);
    jox_live_frame(scene, JOX_LIVE_COLOUR_state, NULL, &frame);
    assert_int_equal(get32(frame.data + 44), 1);
    assert_int_equal(frame.length, JOX_LIVE_HEAD + (JOX_LIVE_SLOT + 1) * (size_t)a->slot_count +
                                       JOX_LIVE_BODY * (size_t)get32(frame.data + 20));
    assert_int_equal(frame.data[frame.length - a->slot_count + a->slot[2]], 64);
    jox_bytes_free(&people);
    jox_bytes_free(&frame);
    jo_scene_free(scene);
}

/* ---- fields ---- */

static double sum_field(const JoxBytes *field, double *most) {
    const uint8_t *at = field->data;
    const uint32_t cells = get32(at + 8) * get32(at + 12);
    const double cell = (double)get_float(at + 24), top = (double)get_float(at + 28);
    uint64_t sum = 0;
    assert_int_equal(get32(at), 3);
    assert_int_equal(field->length, 32 + (size_t)cells);
    assert_true(cells <= 80000);
    *most = 0;
    for (uint32_t c = 0; c < cells; c++) {
        sum += at[32 + c];
        *most = fmax(*most, at[32 + c] / 255.0 * top);
    }
    return (double)sum / 255.0 * top * cell * cell;
}

/* In a dense crowd, once there are enough samples, the greatest pressure is that of the summary. */
static void pressure_field_matches_the_run(void **state) {
    (void)state;
    JoScene *scene = load_scene_file("scenes/two-bottlenecks.yaml", NULL, 0);
    JoxBytes field = {0};
    double most, greatest = 0;
    jox_live_field(scene, JOX_LIVE_PRESSURE, NULL, &field);
    step_scene(scene, 1620);
    jox_live_field(scene, JOX_LIVE_PRESSURE, NULL, &field);
    const JoxLocal *local = jox_run_local_densities(scene);
    for (size_t c = 0; c < (size_t)local->grid->columns * local->grid->rows; c++)
        greatest = fmax(greatest, jox_local_pressure(local, c));
    assert_true(sum_field(&field, &most) > 0 && greatest > 0.005);
    assert_near(most, greatest, 1e-6);
    jox_bytes_free(&field);
    jo_scene_free(scene);
}

static void density_field_sums_to_the_number_of_people(void **state) {
    (void)state;
    JoScene *scene = load_tawaf("5000");
    JoxBytes field = {0};
    JoxText text = {0};
    double most;
    step_scene(scene, 20);
    jox_live_field(scene, JOX_LIVE_DENSITY, NULL, &field);
    assert_int_equal(get32(field.data + 4), 0);
    const double people = sum_field(&field, &most);
    assert_near(people, scene->world->state.agents.count, 0.01 * scene->world->state.agents.count);
    jox_live_status(scene, &(JoxLiveSession){0}, &text);
    parse_numbers(&text);
    assert_near(number_at("density_max", 0, 0, 0), most, 1e-3);
    jox_live_field(scene, JOX_LIVE_PRESSURE, NULL, &field);
    assert_int_equal(get32(field.data + 4), 1);
    assert_near(sum_field(&field, &most), 0, 0); /* there are too few samples yet */
    assert_int_equal(jox_live_field_named("pressure"), JOX_LIVE_PRESSURE);
    assert_int_equal(jox_live_field_named("none"), JOX_LIVE_FIELDS);
    assert_int_equal(jox_live_field_named("heat"), -1);
    jox_bytes_free(&field);
    jox_text_free(&text);
    jo_scene_free(scene);
}

/* ---- transitions, hints, side effects ---- */

/* Compares the transitions of the last second with the world's total. */
static void status_counts_transitions_of_the_last_second(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(
        YARD_WITH_PEOPLE(200), MACHINE_START
        "\"A\", states = {"
        "A = { steer = hold, lasts = uniform(0.1, 3),"
        " { to = \"B\", when = lasted, chance = 0.5 }, { to = \"C\", when = lasted } },"
        "B = { steer = hold, { to = \"A\", when = after(0.4) } },"
        "C = { steer = hold, { to = \"A\", when = after(0.7) } } } }\n");
    const JoxStatistics *s = &scene->world->state.statistics;
    uint64_t at[400];
    JoxText text = {0};
    jox_live_status(scene, &(JoxLiveSession){0}, &text); /* attaches the listener that counts */
    for (int t = 0; t < 200; t++) {
        at[t] = s->transitions;
        step_scene(scene, 1);
        text.length = 0;
        jox_live_status(scene, &(JoxLiveSession){0}, &text);
        parse_numbers(&text);
        double fired = 0, people = 0;
        for (int k = 0; k < 4; k++)
            fired += number_at("fired.0.%d", k, 0, 0);
        for (int k = 0; k < 3; k++)
            people += number_at("states.0.%d", k, 0, 0);
        assert_true(isnan(number_at("fired.0.4", 0, 0, 0)));
        assert_near(fired, s->transitions - at[t < 19 ? 0 : t - 19], 0);
        assert_near(people, 200, 0);
    }
    assert_true(s->transitions > 500);
    /* A reload numbers the transitions again, and counts start from 0. */
    const uint64_t version = jox_live_version(scene);
    assert_true(reload_behaviour(scene, 0,
                                 MACHINE_START
                                 "\"A\", states = { A = { steer = hold }, B = { steer = hold }, C "
                                 "= { steer = hold } } }\n"));
    assert_true(jox_live_version(scene) != version);
    text.length = 0;
    jox_live_status(scene, &(JoxLiveSession){0}, &text);
    parse_numbers(&text);
    assert_true(isnan(number_at("fired.0.0", 0, 0, 0)));
    jox_text_free(&text);
    jo_scene_free(scene);
}

/* The status has a hint once people have gone back and forth between two states in every step. */
static void status_has_hints(void **state) {
    (void)state;
    JoScene *scene = load_scene_text(YARD_WITH_PEOPLE(20), MACHINE_START
                                     "\"A\", states = {"
                                     "A = { steer = hold, { to = \"B\", when = after(0) } },"
                                     "B = { steer = hold, { to = \"A\", when = after(0) } } } }\n");
    JoxText text = {0};
    jox_live_status(scene, &(JoxLiveSession){0}, &text);
    assert_non_null(strstr(text.data, "\"hints\": []"));
    step_scene(scene, 40);
    text.length = 0;
    jox_live_status(scene, &(JoxLiveSession){0}, &text);
    assert_non_null(strstr(text.data, "people went round 'A' -> 'B' -> 'A'"));
    jox_text_free(&text);
    jo_scene_free(scene);
}

/* A run whose messages are made in each step has the same hash as one without, and frames do not
   allocate. */
static void messages_do_not_change_the_run(void **state) {
    (void)state;
    static const char *const SCENES[] = {"scenes/running-through.yaml", "scenes/dodgeball.yaml"};
    for (int k = 0; k < 2; k++) {
        JoScene *shown = load_scene_file(SCENES[k], NULL, 0),
                *plain = load_scene_file(SCENES[k], NULL, 0);
        JoxBytes frame = {0}, field = {0}, people = {0};
        for (int t = 0; t < 60; t++) {
            JoxText text = {0};
            step_scene(shown, 1);
            jox_live_scene(shown, true, &text);
            jox_live_status(shown, &(JoxLiveSession){0}, &text);
            jox_text_free(&text);
            const uint64_t before = jox_alloc_count();
            jox_live_frame(shown, JOX_LIVE_COLOUR_force, NULL, &frame);
            jox_live_field(shown, JOX_LIVE_DENSITY, NULL, &field);
            jox_live_people(shown, &people);
            assert_true(t < 5 || jox_alloc_count() == before);
            jox_live_version(shown);
        }
        step_scene(plain, 60);
        assert_true(jo_world_hash(shown->world) == jo_world_hash(plain->world));
        jox_bytes_free(&frame);
        jox_bytes_free(&field);
        jox_bytes_free(&people);
        jo_scene_free(shown);
        jo_scene_free(plain);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(people_keep_their_slots_between_frames),
        cmocka_unit_test(parity_flips_at_periodic_edges),
        cmocka_unit_test(area_grows_with_the_crowd),
        cmocka_unit_test(lying_state_sets_the_lying_flag),
        cmocka_unit_test(carriers_and_holders_set_their_flags),
        cmocka_unit_test(averaged_pushes_set_the_lean),
        cmocka_unit_test(colour_values_match_the_columns),
        cmocka_unit_test(people_message_reports_changes),
        cmocka_unit_test(torsos_are_sent_with_frames),
        cmocka_unit_test(density_field_sums_to_the_number_of_people),
        cmocka_unit_test(pressure_field_matches_the_run),
        cmocka_unit_test(status_counts_transitions_of_the_last_second),
        cmocka_unit_test(status_has_hints),
        cmocka_unit_test(messages_do_not_change_the_run),
    };
    return cmocka_run_group_tests(tests, make_test_folder, remove_scene_folder);
}
