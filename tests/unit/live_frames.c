/* What a live page is shown of a running scene: the scene message names everything, frames say who
   is where, fields add up to the people, and showing changes nothing. Frames are decoded here as a
   page would, from the bytes alone. */
#include "live_bytes.h"

static Seen decode(const JoxBytes *frame, const JoWorld *world) {
    const Seen seen = decode_bytes(frame->data, frame->length);
    assert_int_equal(seen.tick, world->state.tick);
    assert_near(seen.time, (double)world->state.tick * world->model.def.dt, 1e-9);
    return seen;
}

/* Everybody is in the frame where they are, within half a unit, and nobody else is. */
static void check_people(const JoScene *scene, const Seen *seen) {
    const JoxAgents *a = &scene->world->state.agents;
    uint32_t people = 0;
    assert_true(seen->sx < 0.01f && seen->sy < 0.01f);
    for (uint32_t s = 0; s < seen->slots; s++) {
        const uint8_t *at = seen->slot + 8 * (size_t)s;
        if (at[5] == 255)
            continue;
        people++;
        const uint32_t i = a->slot_index[s];
        assert_int_not_equal(i, JOX_NO_INDEX);
        assert_near(x_of(seen, s), a->x[i], 0.501 * (double)seen->sx + 1e-5);
        assert_near(y_of(seen, s), a->y[i], 0.501 * (double)seen->sy + 1e-5);
        double turned = at[4] * 2 * M_PI / 256 - atan2(a->face_y[i], a->face_x[i]);
        assert_near(remainder(turned, 2 * M_PI), 0, 0.51 * 2 * M_PI / 256);
        assert_int_equal(at[7] >> 1 & 1, a->failed[i]);
    }
    assert_int_equal(people, a->count);
}

static JoScene *load_tawaf(const char *count) {
    char people[64], keep[64];
    snprintf(people, sizeof people, "groups.pilgrims.count=%s", count);
    snprintf(keep, sizeof keep, "sources.0.keep=%s", count);
    const char *sets[] = {people, keep};
    return load("scenes/tawaf.yaml", sets, 2);
}

/* ---- the scene message ---- */

static void scene_message_names_all_of_the_tawaf(void **state) {
    (void)state;
    JoScene *scene = load_tawaf("300");
    const JoWorld *world = scene->world;
    JoxText text = {0};
    jox_live_scene(scene, &text);
    parse(&text);
    assert_near(number_at("protocol", 0, 0, 0), JOX_LIVE_PROTOCOL, 0);
    assert_near(number_at("dt", 0, 0, 0), 0.05, 1e-9);
    assert_near(number_at("duration", 0, 0, 0), 600, 0);
    for (uint32_t p = 0; p < scene->spec->place_count; p++) {
        has_name(&text, world->model.places[p].name);
        for (uint32_t i = 0; i < world->model.places[p].count; i++) {
            assert_near(number_at("places.%d.points.%d.0", (int)p, (int)i, 0),
                        world->model.places[p].points[i].x, 1e-4);
            assert_near(number_at("places.%d.points.%d.1", (int)p, (int)i, 0),
                        world->model.places[p].points[i].y, 1e-4);
            assert_true(number_at("area.0.0", 0, 0, 0) <
                        (double)world->model.places[p].points[i].x);
            assert_true(number_at("area.1.1", 0, 0, 0) >
                        (double)world->model.places[p].points[i].y);
        }
    }
    for (uint32_t r = 0; r < scene->spec->region_count; r++)
        has_name(&text, scene->spec->regions[r].name);
    for (uint32_t m = 0; m < world->model.machines.count; m++) {
        has_name(&text, world->model.machines.items[m]->name);
        for (uint32_t s = 0; s < world->model.machines.items[m]->state_count; s++)
            has_name(&text, world->model.machines.items[m]->states[s].name);
    }
    has_name(&text, "pilgrims");
    /* Walls as the scene has them: a solid, a line of 13 points (not there and back), a solid. */
    static const int POINTS[] = {4, 13, 4};
    for (int w = 0; w < 3; w++) {
        assert_false(isnan(number_at("walls.%d.points.%d.1", w, POINTS[w] - 1, 0)));
        assert_true(isnan(number_at("walls.%d.points.%d.1", w, POINTS[w], 0)));
    }
    assert_true(isnan(number_at("walls.3.height", 0, 0, 0)));
    assert_near(number_at("walls.1.height", 0, 0, 0), 1.31, 1e-4);
    assert_near(number_at("walls.1.points.12.0", 0, 0, 0), -5.91, 1e-5);
    assert_near(number_at("colours.density.most", 0, 0, 0), 8, 0);
    assert_non_null(strstr(text.data, "\"gates\": false"));
    assert_non_null(strstr(text.data, "\"parameters\": true"));
    jox_text_free(&text);
    jo_scene_free(scene);
}

static void scene_message_of_bodies_and_a_player(void **state) {
    (void)state;
    JoScene *scene = load("scenes/dodgeball.yaml", NULL, 0);
    JoxText text = {0};
    jox_live_scene(scene, &text);
    parse(&text);
    has_name(&text, "ball");
    assert_near(number_at("bodies.0.mass", 0, 0, 0), 0.4, 1e-6);
    assert_near(number_at("bodies.0.parts.0.size.0", 0, 0, 0), 0.11, 1e-6);
    assert_near(number_at("bodies.0.parts.0.turn.3", 0, 0, 0), 1, 1e-6);
    assert_non_null(strstr(text.data, "\"shape\": \"sphere\""));
    assert_near(number_at("tools.players.0", 0, 0, 0), 0, 0);
    /* A closed wall is one line whose end is its beginning. */
    for (int k = 0; k < 2; k++)
        assert_near(number_at("walls.0.points.4.%d", k, 0, 0),
                    number_at("walls.0.points.0.%d", k, 0, 0), 0);
    assert_true(isnan(number_at("walls.1.height", 0, 0, 0)));
    step(scene, 3);
    JoxBytes frame = {0};
    jox_live_frame(scene, JOX_LIVE_COLOUR_state, &frame);
    Seen seen = decode(&frame, scene->world);
    check_people(scene, &seen);
    assert_int_equal(seen.bodies, 1);
    JoxPose pose;
    assert_true(jox_bodies_pose(scene->world->state.bodies, 0, &pose));
    assert_near(get_float(seen.body), pose.position.x, 1e-6);
    assert_near(get_float(seen.body + 8), pose.position.z, 1e-6);
    assert_near((int16_t)(seen.body[18] | seen.body[19] << 8) / 32767.0, pose.turn[3], 1e-4);
    const uint32_t red =
        scene->world->state.agents.slot[jox_agents_find(&scene->world->state.agents, 0)];
    const uint32_t blue =
        scene->world->state.agents.slot[jox_agents_find(&scene->world->state.agents, 1)];
    assert_int_equal(seen.slot[8 * red + 7] & 4, 4);
    assert_int_equal(seen.slot[8 * blue + 7] & 4, 0);
    jox_bytes_free(&frame);
    jox_text_free(&text);
    jo_scene_free(scene);
}

/* Names come from files: whatever stands in them, the scene message is JSON. */
static void scene_message_with_odd_names(void **state) {
    (void)state;
    JoScene *scene =
        load_own("jostle: 1\n"
                 "title: \"a \\\"title\\\" \\\\ with\\ttab, \\x01, \xC3\xA9 and \xE2\x82\xAC\"\n"
                 "view: {tools: [throw, gates, push], colour: speed, field: pressure}\n"
                 "camera: {position: [1, -2, 3], target: [0, 0.5, 0]}\n"
                 "places: {\"y\xC3\xA4rd 1.b\": {polygon: [[0, 0], [9, 0], [9, 9], [0, 9]]}}\n"
                 "walls:\n"
                 "  - {line: [[0, 0], [0, 5], [3, 5]], name: \"g\xC3\xA4-te\", open: true}\n"
                 "  - {line: [[5, 0], [5, 5]], name: \"g\xC3\xA4-te\"}\n"
                 "probes: {out: {flow: [[0, 0], [0, 4]]}}\n"
                 "groups: {\"p\xC3\xA9 ople\": {behaviour: own.lua, count: 4, fill: grid, in: "
                 "\"y\xC3\xA4rd 1.b\"}}\n",
                 FAST("1", ""));
    JoxText text = {0};
    jox_live_scene(scene, &text);
    parse(&text);
    has_name(&text, scene->spec->title);
    has_name(&text, "g\xC3\xA4-te");
    has_name(&text, "p\xC3\xA9 ople");
    assert_non_null(
        strstr(text.data, "\"view\": {\"colour\": \"speed\", \"field\": \"pressure\"}"));
    assert_non_null(strstr(text.data, "\"throw\": true"));
    assert_non_null(strstr(text.data, "\"gates\": true"));
    assert_non_null(strstr(text.data, "\"parameters\": false"));
    assert_non_null(strstr(text.data, "\"walls\": [\"g\xC3\xA4-te\"]"));
    assert_non_null(strstr(text.data, "\"charts\": [\"out\"]"));
    assert_near(number_at("camera.at.1", 0, 0, 0), -2, 0);
    assert_near(number_at("camera.look.1", 0, 0, 0), 0.5, 0);
    /* The status too, before the first step and after. */
    for (int k = 0; k < 2; k++) {
        JoxText status = {0};
        jox_live_status(scene, &(JoxLiveSession){.speed = 1, .dropped = 7}, &status);
        parse(&status);
        assert_near(number_at("agents", 0, 0, 0), 4, 0);
        assert_near(number_at("states.0.0", 0, 0, 0), 4, 0);
        assert_near(number_at("dropped", 0, 0, 0), 7, 0);
        assert_near(number_at("time", 0, 0, 0), 0.05 * k, 1e-9);
        jox_text_free(&status);
        step(scene, 1);
    }
    jox_text_free(&text);
    jo_scene_free(scene);
}

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
#define EASTWARD HEAD "\"A\", states = { A = { steer = drift(1, 0), speed = uniform(1, 3) } } }\n"

/* People come and go; whoever stays has the slot of before, and a slot whose person is another has
   the other parity. */
static void slots_stay_with_their_people(void **state) {
    (void)state;
    JoScene *scene = load_own(COMING, EASTWARD);
    const JoxAgents *a = &scene->world->state.agents;
    JoxBytes frame = {0};
    static uint32_t owner[1000];
    static uint8_t parity[1000];
    static double x[1000], y[1000];
    uint32_t others = 0, same = 0;
    memset(owner, 0xff, sizeof owner);
    for (int t = 0; t < 400; t++) {
        step(scene, 1);
        jox_live_frame(scene, JOX_LIVE_COLOUR_speed, &frame);
        Seen seen = decode(&frame, scene->world);
        check_people(scene, &seen);
        assert_true(seen.slots < 1000);
        for (uint32_t s = 0; s < seen.slots; s++) {
            const uint8_t *at = seen.slot + 8 * (size_t)s;
            if (at[5] == 255)
                continue;
            const uint32_t id = a->id[a->slot_index[s]];
            if (owner[s] != UINT32_MAX) {
                assert_int_equal(parity[s] == (at[7] & 1), owner[s] == id);
                if (owner[s] == id) /* and none jumps */
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

/* Who comes round a periodic edge keeps the slot and is as somebody else in it. */
static void nobody_flies_across(void **state) {
    (void)state;
    JoScene *scene = load("scenes/ring.yaml", NULL, 0);
    const float period = scene->world->state.agents.period.x;
    JoxBytes frame = {0};
    static double x[1000];
    static uint8_t parity[1000];
    uint32_t rounds = 0;
    assert_true(period > 1.0f);
    for (int t = 0; t < 200; t++) {
        step(scene, 1);
        jox_live_frame(scene, JOX_LIVE_COLOUR_speed, &frame);
        jox_live_frame(scene, JOX_LIVE_COLOUR_state, &frame);
        Seen seen = decode(&frame, scene->world);
        check_people(scene, &seen);
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

/* Who goes where the scene names nothing is still where the frame says. */
static void the_area_grows(void **state) {
    (void)state;
    JoScene *scene = load_own(PEOPLE(20), HEAD "\"A\", defaults = { speed = 9, max_speed = 9 }, "
                                               "states = { A = { steer = drift(-1, -0.3) } } }\n");
    JoxBytes frame = {0};
    jox_live_frame(scene, JOX_LIVE_COLOUR_state, &frame);
    Seen before = decode(&frame, scene->world);
    for (int t = 0; t < 300; t++) {
        step(scene, 1);
        jox_live_frame(scene, JOX_LIVE_COLOUR_state, &frame);
        Seen seen = decode(&frame, scene->world);
        check_people(scene, &seen);
    }
    Seen after = decode(&frame, scene->world);
    assert_true(after.x0 < before.x0 - 50 && after.y0 < before.y0 - 10);
    jox_bytes_free(&frame);
    jo_scene_free(scene);
}

/* Values of each colour against the columns. */
static void colours_measure(void **state) {
    (void)state;
    JoScene *scene = load("scenes/running-through.yaml", NULL, 0);
    const JoxAgents *a = &scene->world->state.agents;
    JoxBytes frame = {0};
    step(scene, 80);
    for (int c = 0; c < JOX_LIVE_COLOUR_COUNT; c++) {
        jox_live_frame(scene, (JoxLiveColour)c, &frame);
        Seen seen = decode(&frame, scene->world);
        uint32_t above = 0;
        for (uint32_t i = 0; i < a->count; i++) {
            const float wanted[] = {0,
                                    hypotf(a->vx[i], a->vy[i]),
                                    hypotf(a->force_x[i], a->force_y[i]),
                                    a->compression[i],
                                    a->density[i],
                                    a->group[i]};
            const double shown = seen.slot[8 * (size_t)a->slot[i] + 6] / 255.0 * (double)seen.most;
            const double value = fmin((double)wanted[c], (double)seen.most);
            assert_near(shown, value, 0.502 * (double)seen.most / 255);
            above += shown > 0;
        }
        assert_int_equal(above > 0, c != JOX_LIVE_COLOUR_state); /* there are two groups */
    }
    assert_int_equal(jox_live_colour("compression"), JOX_LIVE_COLOUR_compression);
    assert_int_equal(jox_live_colour("compressio"), -1);
    jox_bytes_free(&frame);
    jo_scene_free(scene);
}

static void people_are_told_once(void **state) {
    (void)state;
    JoScene *scene = load_own(COMING, EASTWARD);
    const JoxAgents *a = &scene->world->state.agents;
    JoxBytes people = {0};
    assert_true(jox_live_people(scene, &people));
    assert_false(jox_live_people(scene, &people));
    step(scene, 40); /* more have come */
    assert_true(jox_live_people(scene, &people));
    assert_int_equal(get32(people.data), 2);
    assert_int_equal(get32(people.data + 4), 0);
    assert_int_equal(get32(people.data + 8), a->slot_count);
    assert_int_equal(people.length, 16 + 2 * (size_t)a->slot_count);
    for (uint32_t i = 0; i < a->count; i++) {
        assert_int_equal(people.data[16 + 2 * a->slot[i]], 20);
        assert_int_equal(people.data[17 + 2 * a->slot[i]], 0);
    }
    jox_bytes_free(&people);
    jo_scene_free(scene);
}

/* ---- fields ---- */

static double field_sum(const JoxBytes *field, double *most) {
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

static void fields_add_up_to_the_people(void **state) {
    (void)state;
    JoScene *scene = load_tawaf("5000");
    JoxBytes field = {0};
    JoxText text = {0};
    double most;
    step(scene, 20);
    jox_live_field(scene, JOX_LIVE_DENSITY, &field);
    assert_int_equal(get32(field.data + 4), 0);
    const double people = field_sum(&field, &most);
    assert_near(people, scene->world->state.agents.count, 0.01 * scene->world->state.agents.count);
    jox_live_status(scene, &(JoxLiveSession){0}, &text);
    parse(&text);
    assert_near(number_at("density_max", 0, 0, 0), most, 1e-3);
    jox_live_field(scene, JOX_LIVE_PRESSURE, &field);
    assert_int_equal(get32(field.data + 4), 1);
    assert_true(field_sum(&field, &most) > 0);
    /* When all walk alike there is no pressure, however dense they are. */
    for (uint32_t i = 0; i < scene->world->state.agents.count; i++) {
        scene->world->state.agents.vx[i] = 1.5f;
        scene->world->state.agents.vy[i] = -0.5f;
    }
    scene->world->state.tick++;
    jox_live_field(scene, JOX_LIVE_PRESSURE, &field);
    field_sum(&field, &most);
    assert_near(most, 0, 1e-3);
    assert_int_equal(jox_live_field_named("pressure"), JOX_LIVE_PRESSURE);
    assert_int_equal(jox_live_field_named("none"), JOX_LIVE_FIELDS);
    assert_int_equal(jox_live_field_named("heat"), -1);
    jox_bytes_free(&field);
    jox_text_free(&text);
    jo_scene_free(scene);
}

/* ---- what happened, and what did not ---- */

/* The transitions of the last second are those of the world's own count. */
static void transitions_of_a_second(void **state) {
    (void)state;
    JoScene *scene =
        load_own(PEOPLE(200), HEAD
                 "\"A\", states = {"
                 "A = { steer = hold, lasts = uniform(0.1, 3),"
                 " { to = \"B\", when = lasted, chance = 0.5 }, { to = \"C\", when = lasted } },"
                 "B = { steer = hold, { to = \"A\", when = after(0.4) } },"
                 "C = { steer = hold, { to = \"A\", when = after(0.7) } } } }\n");
    const JoxStatistics *s = &scene->world->state.statistics;
    uint64_t at[400];
    JoxText text = {0};
    jox_live_status(scene, &(JoxLiveSession){0}, &text); /* from here on they are counted */
    for (int t = 0; t < 200; t++) {
        at[t] = s->transitions;
        step(scene, 1);
        text.length = 0;
        jox_live_status(scene, &(JoxLiveSession){0}, &text);
        parse(&text);
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
    /* A new version of the machine has numbers of its own: counts begin anew. */
    const uint64_t version = jox_live_version(scene);
    assert_true(reload_text(scene, 0,
                            HEAD "\"A\", states = { A = { steer = hold }, B = { steer = hold }, C "
                                 "= { steer = hold } } }\n"));
    assert_true(jox_live_version(scene) != version);
    text.length = 0;
    jox_live_status(scene, &(JoxLiveSession){0}, &text);
    parse(&text);
    assert_true(isnan(number_at("fired.0.0", 0, 0, 0)));
    jox_text_free(&text);
    jo_scene_free(scene);
}

/* Showing each step gives the state of not showing any, and a frame takes no memory. */
static void showing_changes_nothing(void **state) {
    (void)state;
    static const char *const SCENES[] = {"scenes/running-through.yaml", "scenes/dodgeball.yaml"};
    for (int k = 0; k < 2; k++) {
        JoScene *shown = load(SCENES[k], NULL, 0), *plain = load(SCENES[k], NULL, 0);
        JoxBytes frame = {0}, field = {0}, people = {0};
        for (int t = 0; t < 60; t++) {
            JoxText text = {0};
            step(shown, 1);
            jox_live_scene(shown, &text);
            jox_live_status(shown, &(JoxLiveSession){0}, &text);
            jox_text_free(&text);
            const uint64_t before = jox_alloc_count();
            jox_live_frame(shown, JOX_LIVE_COLOUR_force, &frame);
            jox_live_field(shown, JOX_LIVE_DENSITY, &field);
            jox_live_people(shown, &people);
            assert_true(t < 5 || jox_alloc_count() == before);
            jox_live_version(shown);
        }
        step(plain, 60);
        assert_true(jo_world_hash(shown->world) == jo_world_hash(plain->world));
        jox_bytes_free(&frame);
        jox_bytes_free(&field);
        jox_bytes_free(&people);
        jo_scene_free(shown);
        jo_scene_free(plain);
    }
}

/* Bodies that come apart and walls that are set anew ask for a new one; gates do not. */
static void changes_ask_for_a_scene_message(void **state) {
    (void)state;
    JoScene *scene = load("scenes/wall-breaking.yaml", NULL, 0);
    uint64_t version = jox_live_version(scene);
    const uint32_t bodies = jox_bodies_count(scene->world->state.bodies);
    for (int t = 0; t < 600 && jox_bodies_count(scene->world->state.bodies) == bodies; t++) {
        assert_true(jox_live_version(scene) == version);
        step(scene, 1);
    }
    assert_true(jox_bodies_count(scene->world->state.bodies) > bodies);
    assert_true(jox_live_version(scene) != version);
    JoxText text = {0};
    JoxBytes frame = {0};
    jox_live_scene(scene, &text);
    parse(&text);
    jox_live_frame(scene, JOX_LIVE_COLOUR_state, &frame);
    Seen seen = decode(&frame, scene->world);
    assert_false(isnan(number_at("bodies.%d.mass", (int)seen.bodies - 1, 0, 0)));
    assert_true(isnan(number_at("bodies.%d.mass", (int)seen.bodies, 0, 0)));
    jox_bytes_free(&frame);
    jox_text_free(&text);
    jo_scene_free(scene);
    scene = load("scenes/gates.yaml", NULL, 0);
    version = jox_live_version(scene);
    step(scene, 20 * 30);
    assert_true(scene->world->state.statistics.opened > 0);
    assert_true(jox_live_version(scene) == version);
    jo_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scene_message_names_all_of_the_tawaf),
        cmocka_unit_test(scene_message_of_bodies_and_a_player),
        cmocka_unit_test(scene_message_with_odd_names),
        cmocka_unit_test(slots_stay_with_their_people),
        cmocka_unit_test(nobody_flies_across),
        cmocka_unit_test(the_area_grows),
        cmocka_unit_test(colours_measure),
        cmocka_unit_test(people_are_told_once),
        cmocka_unit_test(fields_add_up_to_the_people),
        cmocka_unit_test(transitions_of_a_second),
        cmocka_unit_test(showing_changes_nothing),
        cmocka_unit_test(changes_ask_for_a_scene_message),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
