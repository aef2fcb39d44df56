/* A run's figures as one JSON object. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/elementary.h"
#include "base/guard.h"
#include "base/mem.h"
#include "record/aggregate.h"
#include "run/run.h"

static const double PI = 3.14159265358979323846;

JoStats jo_scene_stats(const JoScene *scene) {
    JOX_REQUIRE(scene, (JoStats){0});
    const JoWorld *world = scene->world;
    const JoxStatistics *s = &world->state.statistics;
    JoStats stats = {.steps = s->steps,
                     .agent_steps = s->agent_steps,
                     .agents = world->state.agents.count,
                     .bodies = jox_bodies_count(world->state.bodies),
                     .dt = world->model.def.dt,
                     .simulated_s = (double)s->steps * world->model.def.dt,
                     .wall_s = s->wall_s,
                     .cpu_s = s->cpu_s};
    for (int k = 0; k < JO_STAGE_COUNT && s->agent_steps; k++)
        stats.stage_ns[k] = s->stage_s[k] * 1e9 / (double)s->agent_steps;
    return stats;
}

static void add_number(JoxText *out, const char *name, double value) {
    jox_text_printf(out, ",\n \"%s\": ", name);
    jox_text_json_number(out, value);
}

static void add_states(JoxText *out, const JoWorld *world) {
    const JoxMachineRun *machines = &world->machines;
    jox_text_add(out, ",\n \"states\": {");
    for (uint32_t m = 0; m < machines->set->count; m++) {
        jox_text_add(out, m ? ", " : "");
        jox_text_json(out, machines->set->items[m]->name);
        jox_text_add(out, ": {");
        for (uint32_t s = 0; s < machines->set->items[m]->state_count; s++) {
            uint32_t people = 0;
            for (uint32_t i = 0; i < world->state.agents.count; i++)
                people += world->state.agents.machine[i] == m && world->state.agents.state[i] == s;
            jox_text_add(out, s ? ", " : "");
            jox_text_json(out, machines->set->items[m]->states[s].name);
            jox_text_printf(out, ": %u", people);
        }
        jox_text_add(out, "}");
    }
    jox_text_add(out, "}");
}

typedef struct Counted {
    JoxText *out;
    bool any;
} Counted;

static void add_taken(void *context, const char *from, const char *to, uint64_t taken) {
    Counted *counted = context;
    JoxText key = {0};
    jox_text_printf(&key, "%s>%s", from, to);
    jox_text_add(counted->out, counted->any ? ", " : "");
    jox_text_json(counted->out, key.data);
    jox_text_free(&key);
    jox_text_printf(counted->out, ": %llu", (unsigned long long)taken);
    counted->any = true;
}

/* "From>To": how often, by all agents. */
static void add_transitions(JoxText *out, const JoxMachineRun *machines) {
    jox_text_add(out, ",\n \"transitions\": {");
    for (uint32_t m = 0; m < machines->set->count; m++) {
        Counted counted = {out, false};
        jox_text_add(out, m ? ", " : "");
        jox_text_json(out, machines->set->items[m]->name);
        jox_text_add(out, ": {");
        jox_machines_taken(machines, m, add_taken, &counted);
        jox_text_add(out, "}");
    }
    jox_text_add(out, "}");
}

static void add_events(JoxText *out, const JoScene *scene) {
    const JoxStatistics *s = &scene->world->state.statistics;
    const struct {
        const char *name;
        uint64_t count;
    } events[] = {{"transitions", s->transitions},
                  {"kicks", s->kicks},
                  {"throws", s->throws},
                  {"pickups", s->pickups},
                  {"hits", s->hits},
                  {"spawned", s->spawned},
                  {"removed", s->removed},
                  {"moved_out", s->moved_out},
                  {"bodies_lost", s->bodies_lost},
                  {"walls_relaxed", s->walls_relaxed},
                  {"opened", s->opened},
                  {"closed", s->closed},
                  {"announced", s->announced},
                  {"script_failures", jox_lua_failures(scene->lua)}};
    jox_text_add(out, ",\n \"events\": {");
    for (size_t e = 0; e < sizeof events / sizeof *events; e++)
        jox_text_printf(out, "%s\"%s\": %llu", e ? ", " : "", events[e].name,
                        (unsigned long long)events[e].count);
    jox_text_add(out, "}");
}

static void add_regions(JoxText *out, const JoScene *scene) {
    const JoxRegions *regions = jox_run_regions(scene);
    if (!regions)
        return;
    jox_text_add(out, ",\n \"regions\": {");
    for (uint32_t r = 0; r < regions->count; r++) {
        jox_text_add(out, r ? ", " : "");
        jox_text_json(out, regions->items[r].name);
        jox_text_add(out, ": ");
        jox_text_json_number(out, jox_region_speed(&regions->items[r]));
    }
    jox_text_add(out, "}");
}

static void add_danger(JoxText *out, const JoScene *scene) {
    jox_text_add(out, ",\n \"danger\": {");
    jox_exits_json(&scene->exits, scene->world->state.agents.count, out);
    if (jox_run_danger(scene)) {
        jox_text_add(out, ",\n  ");
        jox_danger_json(jox_run_danger(scene), out);
    }
    jox_text_add(out, "}");
}

/* What plain functions cost: share of the stepping, calls, and what failed. */
static void add_lua(JoxText *out, const JoScene *scene) {
    const JoWorld *world = scene->world;
    double seconds = 0.0;
    uint64_t calls = 0;
    for (uint32_t m = 0; m < world->model.machines.count; m++) {
        uint64_t own;
        seconds += jox_lua_seconds(scene->lua, world->model.machines.items[m], &own);
        calls += own;
    }
    double wall = world->state.statistics.wall_s;
    jox_text_printf(out, ",\n \"lua\": {\"calls\": %llu, \"seconds\": %.6f, \"share\": %.6f}",
                    (unsigned long long)calls, seconds, wall > 0.0 ? seconds / wall : 0.0);
}

char *jo_scene_lua_profile(const JoScene *scene) {
    JOX_REQUIRE(scene, NULL);
    JOX_GUARD (NULL, NULL)
        return NULL;
    const JoWorld *world = scene->world;
    JoxText out = {0};
    for (uint32_t m = 0; m < world->model.machines.count; m++) {
        const JoxMachine *machine = world->model.machines.items[m];
        uint64_t calls;
        double seconds = jox_lua_seconds(scene->lua, machine, &calls);
        jox_text_printf(
            &out, "%s (%s): %u plain functions, %llu calls, %.2f ms, %.2f %% of the steps\n",
            machine->name, machine->path, machine->hook_count, (unsigned long long)calls,
            seconds * 1e3,
            world->state.statistics.wall_s > 0 ? 100.0 * seconds / world->state.statistics.wall_s
                                               : 0.0);
        jox_lua_profile(scene->lua, machine, world->state.statistics.wall_s, &out);
    }
    return jox_disown(out.data);
}

static void add_file(JoxText *out, const char *path, const char *sha256, bool first) {
    jox_text_add(out, first ? "\n  {\"path\": " : ",\n  {\"path\": ");
    jox_text_json(out, path);
    jox_text_printf(out, ", \"sha256\": \"%s\"}", sha256);
}

static void add_inputs(JoxText *out, const JoScene *scene) {
    jox_text_add(out, ",\n \"inputs\": [");
    for (uint32_t f = 0; f < scene->spec->file_count; f++)
        add_file(out, scene->spec->files[f].path, scene->spec->files[f].sha256, f == 0);
    for (uint32_t m = 0; m < scene->world->model.machines.count; m++) {
        uint32_t count;
        const JoxLuaFile *files =
            jox_lua_files(scene->lua, scene->world->model.machines.items[m], &count);
        for (uint32_t f = 0; f < count; f++)
            add_file(out, files[f].path, files[f].sha256, false);
    }
    if (scene->input_path)
        add_file(out, scene->input_path, scene->input_sha256, false);
    jox_text_add(out, "\n ],\n \"mods\": [");
    for (uint32_t m = 0; m < scene->mods->count; m++) {
        jox_text_add(out, m ? ", " : "");
        jox_text_printf(out, "\"%s %s\"", scene->mods->items[m].name,
                        scene->mods->items[m].version);
    }
    jox_text_add(out, "]");
}

/* Of scenes in which people and bodies touched. */
static void add_exchange(JoxText *out, const JoxStatistics *s) {
    const JoxExchange *e = &s->exchange;
    if (!(e->impulse > 0))
        return;
    jox_text_printf(out,
                    ",\n \"exchange\": {\"contacts\": %llu, \"impulse\": %.6g, \"residual\": %.3g}",
                    (unsigned long long)e->contacts, e->impulse, e->residual / e->impulse);
}

/* How far the first bonded body of the scene, or its greatest piece, has come, m, and turned, deg.
 */
static void add_way(JoxText *out, const JoScene *scene, uint32_t body) {
    const JoxBodyDef *def = &scene->spec->bodies[body].def;
    JoxPose pose; /* the bodies of the scene have the first ids, in their order */
    if (!jox_bodies_pose(scene->world->state.bodies,
                         jox_bodies_find(scene->world->state.bodies, body), &pose))
        return;
    double x = pose.position.x - def->position[0], y = pose.position.y - def->position[1];
    const float *q = pose.turn;
    double yaw = jox_atan2(2 * ((double)q[3] * q[2] + (double)q[0] * q[1]),
                           1 - 2 * ((double)q[1] * q[1] + (double)q[2] * q[2]));
    double turned = yaw - 2 * jox_atan2(def->turn[2], def->turn[3]);
    turned = (turned - 2 * PI * floor(turned / (2 * PI) + 0.5)) * 180 / PI;
    jox_text_printf(out, ", \"moved\": %.4f, \"turned\": %.3f", sqrt(x * x + y * y), turned);
}

/* Of scenes with bonded blocks. */
static void add_bonds(JoxText *out, const JoScene *scene) {
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
    jox_text_printf(out, ",\n \"bonds\": {\"held\": %u, \"broken\": %llu, \"pieces\": %u", held,
                    (unsigned long long)s->broken, s->pieces + 1);
    if (s->front)
        jox_text_printf(out, ", \"front_people\": %u, \"front_speed\": %.4f", s->front,
                        s->front_speed);
    if (s->touched)
        jox_text_printf(out, ", \"first_touch_s\": %.3f", s->touch_s);
    if (s->broken)
        jox_text_printf(out,
                        ", \"first_break_s\": %.3f, \"rows_pressing\": %u, "
                        "\"people_pressing\": %u",
                        s->first_s, s->rows, s->people);
    add_way(out, scene, body);
    jox_text_add(out, "}");
}

char *jo_scene_summary(const JoScene *scene) {
    JOX_REQUIRE(scene, NULL);
    if (jox_heap_has_failed(scene->heap))
        return NULL;
    JOX_GUARD (NULL, NULL)
        return NULL;
    const JoWorld *world = scene->world;
    const JoxStatistics *s = &world->state.statistics;
    JoStats stats = jo_scene_stats(scene);
    JoxText out = {0};
    jox_text_add(&out, "{\n \"scene\": ");
    jox_text_json(&out, scene->spec->path);
    jox_text_printf(&out, ",\n \"version\": \"%s\",\n \"seed\": %llu", jo_version(),
                    (unsigned long long)world->model.def.seed);
    add_number(&out, "agents", stats.agents);
    add_number(&out, "bodies", stats.bodies);
    add_number(&out, "dt", stats.dt);
    add_number(&out, "steps", (double)stats.steps);
    add_number(&out, "simulated_s", stats.simulated_s);
    add_number(&out, "wall_s", stats.wall_s);
    add_number(&out, "cpu_s", stats.cpu_s);
    add_number(&out, "steps_per_s", stats.wall_s > 0 ? (double)stats.steps / stats.wall_s : 0);
    add_number(&out, "ns_per_agent_step",
               stats.agent_steps ? stats.wall_s * 1e9 / (double)stats.agent_steps : 0);
    jox_text_add(&out, ",\n \"stage_ns\": {");
    for (int k = 0; k < JO_STAGE_COUNT; k++)
        jox_text_printf(&out, "%s\"%s\": %.2f", k ? ", " : "", jo_stage_name(k), stats.stage_ns[k]);
    jox_text_add(&out, "}");
    add_number(&out, "lp_failure_share",
               stats.agent_steps ? (double)s->failures / (double)stats.agent_steps : 0);
    add_number(&out, "lp_failure_peak", s->failure_peak);
    add_number(&out, "density_max", jox_run_density_max(scene));
    add_number(&out, "overlap_p99", jox_statistics_overlap_p99(s));
    add_states(&out, world);
    add_transitions(&out, &world->machines);
    add_regions(&out, scene);
    add_events(&out, scene);
    add_bonds(&out, scene);
    add_exchange(&out, s);
    add_danger(&out, scene);
    add_lua(&out, scene);
    jox_run_add_probes(scene, &out);
    jox_text_printf(&out, ",\n \"hash\": \"%016llx\",\n \"isa\": \"scalar\",\n \"threads\": %u",
                    (unsigned long long)jox_world_hash(world),
                    jox_pool_threads(world->scratch.pool));
    add_inputs(&out, scene);
    jox_text_add(&out, "\n}\n");
    return jox_disown(out.data);
}

char *jo_summaries_aggregate(const char *const *summaries, size_t count, JoError *error) {
    JOX_REQUIRE(summaries || count == 0, NULL);
    JOX_GUARD (NULL, error)
        return NULL;
    JoxText out = {0};
    if (jox_aggregate(summaries, count, &out))
        return jox_disown(out.data);
    jox_text_free(&out);
    jox_error(error, JO_INPUT, "a summary is not JSON");
    return NULL;
}
