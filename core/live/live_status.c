/* The status message of a running scene, sent four times a second: present figures, and those of
   the steps since the last status. */
#include <string.h>

#include "base/mem.h"
#include "live/live_parts.h"
#include "run/probe_listener.h"

/* Adds "states": for each machine an array of the number of people in each state; and "fired": for
   each machine an array of how often each transition was taken in the last second. */
static void add_machine_counts(JoxJson *json, JoxLive *live, const JoxMachineRun *machines) {
    jox_json_array(json, "states");
    for (uint32_t m = 0; m < machines->set->count; m++) {
        const uint32_t count = machines->set->items[m]->state_count;
        JOX_RESERVE(live->people, live->people_capacity, count);
        jox_machines_people(machines, m, live->people);
        jox_json_array(json, NULL);
        for (uint32_t s = 0; s < count; s++)
            jox_json_whole(json, NULL, live->people[s]);
        jox_json_end(json);
    }
    jox_json_end(json);
    jox_json_array(json, "fired");
    for (uint32_t m = 0; m < machines->set->count; m++) {
        jox_json_array(json, NULL);
        for (uint32_t t = live->begins[m]; t < live->begins[m + 1]; t++)
            jox_json_whole(json, NULL, live->fired[t]);
        jox_json_end(json);
    }
    jox_json_end(json);
}

void jox_live_add_gates(const JoxWalls *walls, JoxJson *json) {
    jox_json_object(json, "walls");
    for (uint32_t r = 0; r < walls->ring_count; r++) {
        bool known = !walls->rings[r].name || walls->rings[r].is_lift_door;
        for (uint32_t o = 0; o < r && !known; o++)
            known = walls->rings[o].name && !strcmp(walls->rings[o].name, walls->rings[r].name);
        if (!known)
            jox_json_bool(json, walls->rings[r].name, walls->rings[r].open);
    }
    jox_json_end(json);
}

/* Adds the passages that flow probes counted, and which named walls are open. */
static void add_flows_and_gates(JoxJson *json, const JoScene *scene) {
    const JoxProbe *probe;
    jox_json_object(json, "flows");
    for (uint32_t p = 0; (probe = jox_run_probe(scene, p)); p++)
        if (jox_probe_def(probe)->kind == JOX_PROBE_FLOW)
            jox_json_whole(json, jox_probe_def(probe)->name, jox_probe_passages(probe));
    jox_json_end(json);
    jox_live_add_gates(&scene->world->model.all_walls, json);
}

/* Adds "lifts": of each, the people who wait for it and those whom it let out. */
static void add_lift_counts(JoxJson *json, const JoWorld *world) {
    jox_json_array(json, "lifts");
    for (uint32_t l = 0; l < world->model.lift_count; l++) {
        jox_json_object(json, NULL);
        jox_json_whole(json, "waiting", jox_world_lift_waiting(world, l));
        jox_json_whole(json, "let_out", world->state.lifts.figures[l].let_out);
        jox_json_end(json);
    }
    jox_json_end(json);
}

/* Adds "hints": parts of behaviours that had no effect so far, a sentence each with file and
   line. */
static void add_hints(JoxJson *json, const JoScene *scene) {
    JoHints *hints = jo_scene_hints(scene);
    jox_json_array(json, "hints");
    for (uint32_t h = 0; hints && h < hints->count; h++) {
        const JoHint *hint = &hints->items[h];
        jox_json_format(json, NULL, "%s:%d: %s. %s", hint->file, hint->line, hint->text,
                        hint->way_out);
    }
    jox_json_end(json);
    jo_free(hints);
}

/* Adds pace, share of failed solves, and time by stage in ns per agent-step, of the steps since the
   last status; of all steps if none was made since. */
static void add_costs(JoxJson *json, JoxLive *live, const JoScene *scene) {
    const JoWorld *world = scene->world;
    const JoxStatistics *s = &world->state.statistics;
    const double wall = jox_clock_wall(), time = jo_world_time(world);
    const bool stepped = s->agent_steps > live->agent_steps;
    const double people = stepped ? (double)(s->agent_steps - live->agent_steps)
                                  : (double)(s->agent_steps ? s->agent_steps : 1);
    const double spent = wall - live->wall;
    jox_json_number(json, "real_time_factor", spent > 0.0 ? (time - live->time) / spent : 0.0);
    jox_json_number(json, "failures",
                    (double)(s->failures - (stepped ? live->failures : 0)) / people);
    jox_json_object(json, "stage_ns");
    for (int k = 0; k < JO_STAGE_COUNT; k++) {
        const double seconds = s->stage_s[k] - (stepped ? live->stage_s[k] : 0.0);
        jox_json_digits(json, jo_stage_name(k), seconds * 1e9 / people, 6);
    }
    jox_json_end(json);
    live->wall = wall;
    live->time = time;
    if (!stepped)
        return;
    live->failures = s->failures;
    live->agent_steps = s->agent_steps;
    memcpy(live->stage_s, s->stage_s, sizeof live->stage_s);
}

void jox_live_add_session(uint64_t tick, double time, const JoxLiveSession *session,
                          JoxJson *json) {
    jox_json_string(json, "type", "status");
    jox_json_whole(json, "tick", tick);
    jox_json_number(json, "time", time);
    jox_json_bool(json, "paused", session->paused);
    jox_json_number(json, "speed", session->speed);
    jox_json_whole(json, "dropped", session->dropped);
    jox_json_bool(json, "fixed", session->fixed);
}

void jox_live_status(JoScene *scene, const JoxLiveSession *session, JoxText *out) {
    JoxLive *live = jox_live_attach(scene);
    const JoWorld *world = scene->world;
    jox_live_number_transitions(live, &world->machines);
    jox_live_spread_crowd(scene);
    JoxJson json = jox_json_begin(out, 0);
    jox_json_object(&json, NULL);
    jox_live_add_session(world->state.tick, jo_world_time(world), session, &json);
    jox_json_whole(&json, "agents", world->state.agents.count);
    jox_json_whole(&json, "bodies", jox_bodies_count(world->state.bodies));
    add_machine_counts(&json, live, &world->machines);
    jox_json_number(&json, "mean_speed", jox_live_speed(scene));
    jox_json_number(&json, "density_max", jox_live_density_max(&live->grid));
    jox_json_digits(&json, "density_r", (double)jox_live_density_r(&live->grid), 3);
    add_costs(&json, live, scene);
    add_flows_and_gates(&json, scene);
    add_lift_counts(&json, world);
    add_hints(&json, scene);
    jox_json_string(&json, "broke", session->broke);
    jox_live_add_end(scene, session, &json);
    jox_live_add_match(scene, &session->match, &json);
    jox_json_end(&json);
}

bool jox_live_is_telling(JoScene *scene) {
    return jox_live_attach(scene)->telling;
}

bool jox_live_news(JoScene *scene, JoxText *out) {
    JoxLive *live = jox_live_attach(scene);
    if (live->news.length == 0)
        return false;
    jox_text_printf(out, "{\"type\": \"reloaded\", \"news\": [%s]}", live->news.data);
    live->news.length = 0;
    return true;
}
