/* The figures of a run as one JSON object (jo_scene_summary): the file that `--summary` writes,
   which tests, sweeps and comparisons read. Each add_ function adds one member, or none where it
   does not apply. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/format/plurals.h"
#include "base/guard.h"
#include "base/mem.h"
#include "base/number/rotation.h"
#include "geom/storey_text.h"
#include "jostle_tools.h"
#include "record/aggregate.h"
#include "record/danger/trust.h"
#include "run/criteria_listener.h"
#include "run/figure_listeners.h"
#include "run/game_round.h"
#include "run/probe_listener.h"
#include "run/results/demand.h"
#include "run/results/kept_people.h"
#include "run/results/lift_figures.h"
#include "run/results/lost_steering.h"
#include "run/results/unleft_states.h"
#include "run/run.h"
#include "run/standstill.h"
#include "run/tally_scores.h"
#include "simd/isa.h"

JoStats jo_scene_stats(const JoScene *scene) {
    JOX_REQUIRE(scene, (JoStats){0});
    return jo_world_stats(scene->world);
}

/* Adds people by machine and state in "states"; in "outer_states" those in all states within each
   state that runs a machine, of the machines that have such states. */
static void add_states(JoxJson *json, const JoWorld *world) {
    const JoxMachineRun *machines = &world->machines;
    uint32_t *people = NULL;
    size_t capacity = 0;
    for (int outer = 0; outer < 2; outer++) {
        jox_json_object(json, outer ? "outer_states" : "states");
        for (uint32_t m = 0; m < machines->set->count; m++) {
            const JoxMachine *machine = machines->set->items[m];
            if (outer && machine->outer_count == 0)
                continue;
            JOX_RESERVE(people, capacity, machine->state_count + 1);
            jox_machines_people(machines, m, people);
            jox_json_object(json, machine->name);
            for (uint32_t s = 0; s < machine->state_count && !outer; s++)
                jox_json_whole(json, machine->states[s].name, people[s]);
            for (uint32_t o = 0; o < machine->outer_count && outer; o++)
                jox_json_whole(json, machine->outer[o].name, jox_people_within(machine, o, people));
            jox_json_end(json);
        }
        jox_json_end(json);
    }
    jox_free(people);
}

static void add_transition_count(void *context, const char *from, const char *to, uint64_t taken) {
    JoxText key = {0};
    jox_text_printf(&key, "%s>%s", from, to);
    jox_json_whole(context, key.data, taken);
    jox_text_free(&key);
}

/* Adds "From>To" and how often all agents took it, by machine. */
static void add_transitions(JoxJson *json, const JoxMachineRun *machines) {
    jox_json_object(json, "transitions");
    for (uint32_t m = 0; m < machines->set->count; m++) {
        jox_json_object(json, machines->set->items[m]->name);
        jox_machines_taken(machines, m, add_transition_count, json);
        jox_json_end(json);
    }
    jox_json_end(json);
}

static void add_events(JoxJson *json, const JoScene *scene) {
    const JoxStatistics *s = &scene->world->state.statistics;
    const struct {
        const char *name;
        uint64_t count;
    } events[] = {{"transitions", s->transitions},
                  {"kicks", s->kicks},
                  {"throws", s->throws},
                  {"pickups", s->pickups},
                  {"dropped", s->dropped},
                  {"falls", s->falls},
                  {"most_fallen", s->most_fallen},
                  {"hits", s->hits},
                  {"spawned", s->spawned},
                  {"removed", s->removed},
                  {"shifted_at_birth", s->shifted_at_birth},
                  {"born_in_others", s->born_in_others},
                  {"not_placed", s->not_placed},
                  {"most_without_spot", s->most_without_spot},
                  {"most_without_way", s->most_without_way},
                  {"moved_out", s->moved_out},
                  {"not_moved_out", s->not_moved_out},
                  {"people_lost", s->people_lost},
                  {"bodies_lost", s->bodies_lost},
                  {"walls_relaxed", s->walls_relaxed},
                  {"parts_left_out", s->parts_left_out},
                  {"opened", s->opened},
                  {"closed", s->closed},
                  {"announced", s->announced},
                  {"script_failures", scene->world->machines.state->hook_failures},
                  {"changes_lost", scene->world->machines.state->changes_lost},
                  {"messages_lost", scene->world->machines.state->messages_lost},
                  {"messages_unasked", scene->world->machines.state->messages_unasked},
                  {"messages_to_nobody", scene->world->machines.state->messages_to_nobody}};
    jox_json_object(json, "events");
    for (size_t e = 0; e < sizeof events / sizeof *events; e++)
        jox_json_whole(json, events[e].name, events[e].count);
    jox_json_end(json);
}

/* Adds the forces with which driven bodies pressed people, if any did. */
static void add_drives(JoxJson *json, const JoScene *scene) {
    const JoxDriveStatistics *d = &scene->world->state.statistics.drives;
    if (!(d->force > 0.0) && d->inside == 0)
        return;
    jox_json_object(json, "driven");
    jox_json_whole(json, "held_up", d->held_up);
    jox_json_number(json, "greatest_N", d->force);
    jox_json_number(json, "at_s", d->at_s);
    jox_json_whole(json, "body", d->body);
    jox_json_whole(json, "people", d->people);
    jox_json_number(json, "hardest_N", d->hardest);
    jox_json_whole(json, "inside", d->inside);
    jox_json_end(json);
}

/* Adds how well the contacts between people, walls and bodies were solved. */
static void add_contacts(JoxJson *json, const JoScene *scene) {
    const JoxStatistics *s = &scene->world->state.statistics;
    jox_json_object(json, "contacts");
    jox_json_number(json, "passes", s->steps ? (double)s->contact_passes / (double)s->steps : 0.0);
    jox_json_number(json, "residual_N", s->contact_residual);
    jox_json_end(json);
}

static void add_regions(JoxJson *json, const JoScene *scene) {
    const JoxRegions *regions = jox_run_regions(scene);
    if (!regions)
        return;
    jox_json_number(json, "regions_from_s", scene->spec->heatmap_from);
    jox_json_object(json, "regions");
    for (uint32_t r = 0; r < regions->count; r++)
        jox_json_number(json, regions->items[r].name, jox_region_speed(&regions->items[r]));
    jox_json_end(json);
}

/* Adds whether overlaps and densities stayed within what real people reach. */
static void add_trust(JoxJson *json, const JoScene *scene) {
    const JoxStatistics *s = &scene->world->state.statistics;
    const double overlap = jox_statistics_overlap_p99(s);
    const bool holds = jox_trust_holds(overlap, jox_run_greatest_density(scene));
    jox_json_object(json, "trust");
    if (holds && isnan(overlap))
        jox_json_null(json, "holds");
    else
        jox_json_bool(json, "holds", holds);
    jox_json_number(json, "overlap_limit", JOX_TRUST_OVERLAP);
    jox_json_number(json, "overlap_share", jox_statistics_overlap_share(s, JOX_TRUST_OVERLAP));
    jox_json_number(json, "density_limit", JOX_TRUST_DENSITY);
    jox_json_end(json);
}

/* Adds the agent that stood longest though it wanted to get on: a sign of an agent that is stuck.
 */
static void add_standing(JoxJson *json, const JoScene *scene) {
    const JoxLongestStand *stood = jox_run_longest_stand(scene);
    if (!stood)
        return;
    jox_json_object(json, "stood_longest");
    jox_json_digits(json, "s", stood->seconds, 6);
    if (stood->id != JOX_NO_INDEX) {
        jox_json_digits(json, "until_s", stood->until, 6);
        const JoxStoreys *storeys = &scene->world->model.storeys;
        const JoxV2 plan = jox_in_plan(storeys, stood->at);
        jox_json_digits(json, "x", (double)plan.x, 6);
        jox_json_digits(json, "y", (double)plan.y, 6);
        if (jox_has_storeys(storeys))
            jox_json_string(json, "storey", jox_storey_name_at(storeys, stood->at));
        jox_json_whole(json, "agent", stood->id);
    }
    jox_json_end(json);
}

static void add_danger(JoxJson *json, const JoScene *scene) {
    jox_json_object(json, "danger");
    jox_exits_json(&scene->world->state.exits, scene->world->state.agents.count, json);
    if (jox_run_danger(scene))
        jox_danger_json(jox_run_danger(scene), json);
    jox_json_end(json);
}

/* Adds what Lua functions cost: their calls, seconds and share of the time of steps. */
static void add_lua(JoxJson *json, const JoScene *scene) {
    const JoxLuaTotal total = jox_lua_total(scene->lua, scene->world->state.statistics.wall_s);
    jox_json_object(json, "lua");
    jox_json_whole(json, "calls", total.calls);
    jox_json_digits(json, "seconds", total.seconds, 6);
    jox_json_digits(json, "share", total.stepping > 0.0 ? total.seconds / total.stepping : 0.0, 6);
    jox_json_end(json);
}

static void add_file_hash(JoxJson *json, const char *path, const char *sha256) {
    jox_json_object(json, NULL);
    jox_json_string(json, "path", path);
    jox_json_string(json, "sha256", sha256);
    jox_json_end(json);
}

static void add_inputs(JoxJson *json, const JoScene *scene) {
    jox_json_array(json, "inputs");
    for (uint32_t f = 0; f < scene->spec->file_count; f++)
        add_file_hash(json, scene->spec->files[f].path, scene->spec->files[f].sha256);
    for (uint32_t m = 0; m < scene->world->model.machines.count; m++) {
        uint32_t count;
        const JoxLuaFile *files =
            jox_lua_files(scene->lua, scene->world->model.machines.items[m], &count);
        for (uint32_t f = 0; f < count; f++)
            add_file_hash(json, files[f].path, files[f].sha256);
    }
    if (scene->input_path)
        add_file_hash(json, scene->input_path, scene->input_sha256);
    jox_json_end(json);
    jox_json_array(json, "mods");
    for (uint32_t m = 0; m < scene->mods->count; m++)
        jox_json_format(json, NULL, "%s %s", scene->mods->items[m].name,
                        scene->mods->items[m].version);
    jox_json_end(json);
}

/* Adds the impulses exchanged between people and bodies, if any touched. */
static void add_exchange(JoxJson *json, const JoxStatistics *s) {
    const JoxExchange *e = &s->exchange;
    if (!(e->impulse > 0))
        return;
    jox_json_object(json, "exchange");
    jox_json_whole(json, "contacts", e->contacts);
    jox_json_digits(json, "impulse", e->impulse, 6);
    jox_json_digits(json, "residual", e->residual / e->impulse, 3);
    if (e->person_change > 0) /* change of a body over that of the person hit */
        jox_json_digits(json, "velocity_ratio", e->body_change / e->person_change, 6);
    jox_json_end(json);
}

/* Adds how far a bonded body, or its greatest piece, has moved, m, and turned, degrees. */
static void add_displacement(JoxJson *json, const JoScene *scene, uint32_t body) {
    const JoxBodyDef *def = &scene->spec->bodies[body].def;
    JoxPose pose; /* the bodies of the scene have the first ids, in their order */
    if (!jox_bodies_pose(scene->world->state.bodies,
                         jox_bodies_find(scene->world->state.bodies, body), &pose))
        return;
    double x = pose.position.x - def->position[0], y = pose.position.y - def->position[1];
    /* Bodies of scenes are turned about the vertical alone, and not at all if all is zero. */
    const bool turned = def->turn[2] != 0 || def->turn[3] != 0;
    const float first[4] = {0, 0, (float)def->turn[2], turned ? (float)def->turn[3] : 1.0f};
    jox_json_digits(json, "moved", sqrt(x * x + y * y), 6);
    jox_json_digits(json, "turned", jox_split_rotation(first, pose.turn).turned, 6);
}

/* Adds the bonds of blocks, for scenes that have any. */
static void add_bonds(JoxJson *json, const JoScene *scene) {
    const JoxBondStatistics *s = &scene->world->state.statistics.bonds;
    uint32_t body = 0, held = 0;
    while (body < scene->spec->body_count &&
           scene->spec->bodies[body].def.shape.kind != JOX_SHAPE_BLOCKS)
        body++;
    if (body == scene->spec->body_count)
        return;
    for (uint32_t o = 0; o < scene->world->scratch.objects.count; o++) {
        JoxBodyBonds bonds;
        jox_bodies_bonds(scene->world->state.bodies, o, &bonds);
        held += bonds.bonds;
    }
    jox_json_object(json, "bonds");
    jox_json_whole(json, "held", held);
    jox_json_whole(json, "broken", s->broken);
    jox_json_whole(json, "pieces", s->pieces + 1);
    if (s->front) {
        jox_json_whole(json, "front_people", s->front);
        jox_json_digits(json, "front_speed", s->front_speed, 6);
    }
    if (s->touched)
        jox_json_digits(json, "first_touch_s", s->touch_s, 6);
    if (s->broken) {
        jox_json_digits(json, "first_break_s", s->first_s, 6);
        jox_json_whole(json, "rows_pressing", s->rows);
        jox_json_whole(json, "people_pressing", s->people);
    }
    add_displacement(json, scene, body);
    jox_json_end(json);
}

/* Names how forces act in a world. */
static const char *name_forces(const JoWorldDef *def) {
    return !def->forces ? "off" : def->literal ? "literal" : "physical";
}

/* Adds which run it was, and how fast it ran. */
static void add_run(JoxJson *json, const JoScene *scene, const JoStats *stats) {
    jox_json_string(json, "scene", scene->spec->path);
    jox_json_string(json, "version", jo_version());
    jox_json_whole(json, "seed", scene->world->model.def.seed);
    jox_json_string(json, "forces", name_forces(&scene->world->model.def));
    jox_json_whole(json, "agents", stats->agents);
    jox_json_whole(json, "bodies", stats->bodies);
    jox_json_number(json, "dt", stats->dt);
    jox_json_whole(json, "steps", stats->steps);
    jox_json_number(json, "simulated_s", stats->simulated_s);
    if (scene->resumed.length)
        jox_json_number(json, "resumed_s",
                        (double)scene->resumed_tick * scene->world->model.def.dt);
    jox_json_number(json, "wall_s", stats->wall_s);
    jox_json_number(json, "cpu_s", stats->cpu_s);
    jox_json_number(json, "steps_per_s",
                    stats->wall_s > 0 ? (double)stats->steps / stats->wall_s : 0);
    jox_json_number(json, "ns_per_agent_step",
                    stats->agent_steps ? stats->wall_s * 1e9 / (double)stats->agent_steps : 0);
    jox_json_object(json, "stage_ns");
    for (int k = 0; k < JO_STAGE_COUNT; k++)
        jox_json_digits(json, jo_stage_name(k), stats->stage_ns[k], 6);
    jox_json_end(json);
}

char *jo_scene_summary(const JoScene *scene) {
    JOX_REQUIRE(scene && !scene->def.dry, NULL);
    if (jox_heap_has_failed(scene->heap))
        return NULL;
    JOX_GUARD (NULL, NULL)
        return NULL;
    const JoWorld *world = scene->world;
    const JoxStatistics *s = &world->state.statistics;
    const JoStats stats = jo_scene_stats(scene);
    JoxText out = {0};
    JoxJson json = jox_json_begin(&out, 2);
    jox_json_object(&json, NULL);
    add_run(&json, scene, &stats);
    jox_json_number(&json, "lp_failure_share", jox_statistics_share(s, s->failures));
    jox_json_number(&json, "lp_failure_peak", s->failure_peak);
    jox_json_number(&json, "turned_aside_share", jox_statistics_share(s, s->turned_aside));
    jox_json_number(&json, "plans_bounded_share", jox_statistics_share(s, s->plans_bounded));
    jox_json_number(&json, "density_max", jox_run_greatest_density(scene));
    jox_json_number(&json, "overlap_p99", jox_statistics_overlap_p99(s));
    jox_json_number(&json, "depth_p99", jox_statistics_depth_p99(s));
    add_trust(&json, scene);
    add_standing(&json, scene);
    add_states(&json, world);
    add_transitions(&json, &world->machines);
    jox_run_add_unleft(scene, &json);
    jox_run_add_lost(scene, &json);
    add_contacts(&json, scene);
    add_drives(&json, scene);
    add_regions(&json, scene);
    add_events(&json, scene);
    jox_run_add_lifts(scene, &json);
    jox_run_add_demand(scene, &json);
    jox_run_add_starts(scene, &json);
    jox_run_add_kept(scene, &json);
    add_bonds(&json, scene);
    add_exchange(&json, s);
    add_danger(&json, scene);
    add_lua(&json, scene);
    jox_run_add_probes(scene, &json);
    jox_run_add_criteria(scene, &json);
    jox_run_add_tally(scene, &json);
    jox_run_add_game(scene, &json);
    jox_json_format(&json, "hash", "%016llx", (unsigned long long)jox_world_hash(world));
    /* without the counts of failed functions: equal hashes mean that the crowd moved alike */
    jox_json_format(&json, "hash_without_hooks", "%016llx",
                    (unsigned long long)jox_world_hash_without(world, "hooks"));
    jox_json_string(&json, "isa", jox_isa_name(world->model.def.isa));
    jox_json_whole(&json, "threads", jox_pool_threads(world->scratch.pool));
    add_inputs(&json, scene);
    jox_json_end(&json);
    jox_text_append(&out, "\n", 1);
    return jox_disown(out.data);
}

char *jo_summaries_aggregate(const char *const *summaries, size_t count, JoError *error) {
    JOX_REQUIRE(summaries || count == 0, NULL);
    for (size_t s = 0; s < count; s++)
        JOX_REQUIRE(summaries[s], NULL);
    JOX_GUARD (NULL, error)
        return NULL;
    JoxText out = {0};
    if (jox_aggregate(summaries, count, &out))
        return jox_disown(out.data);
    jox_text_free(&out);
    jox_error(error, JO_INPUT, "a summary is not JSON");
    return NULL;
}
