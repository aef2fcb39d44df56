/* What a run leaves behind: recording, report, progress, trace. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/assert.h"
#include "base/guard.h"
#include "base/mem.h"
#include "live/live.h"
#include "picture/plot.h"
#include "run/run.h"

static const double FRAME = 0.1;  /* s between recorded frames, or a step where that is longer */
static const double SAMPLE = 2.0; /* s between density samples */
static const float MARGIN = 2.0f; /* m about the walls and people of a scene without bounds */

static bool fail(JoError *error, JoxText *why) {
    jox_error(error, JO_FAILED, "%s", why->data ? why->data : "writing failed");
    jox_text_free(why);
    return false;
}

void jox_run_area(const JoScene *scene, JoxV2 *low, JoxV2 *high) {
    const JoxSceneSpec *spec = scene->spec;
    const JoWorld *world = scene->world;
    if (spec->heatmap || spec->bounded) {
        *low = spec->heatmap ? spec->heatmap_low : spec->low;
        *high = spec->heatmap ? spec->heatmap_high : spec->high;
        return;
    }
    *low = (JoxV2){INFINITY, INFINITY};
    *high = (JoxV2){-INFINITY, -INFINITY};
    const JoxWalls *walls = &world->all_walls;
    for (uint32_t i = 0; i < walls->count + world->agents.count; i++) {
        JoxV2 p = i < walls->count ? walls->vertices[i].point
                                   : (JoxV2){world->agents.x[i - walls->count],
                                             world->agents.y[i - walls->count]};
        *low = (JoxV2){jox_minf(low->x, p.x), jox_minf(low->y, p.y)};
        *high = (JoxV2){jox_maxf(high->x, p.x), jox_maxf(high->y, p.y)};
    }
    if (low->x > high->x)
        *low = *high = (JoxV2){0.0f, 0.0f};
    *low = jox_sub(*low, (JoxV2){MARGIN, MARGIN});
    *high = jox_add(*high, (JoxV2){MARGIN, MARGIN});
}

/* ---- recording ---- */

/* Number of an agent's state in jostle_state. */
static uint32_t state_number(const JoScene *scene, uint32_t i) {
    const JoxAgents *a = &scene->world->agents;
    return a->machine[i] == JOX_NO_MACHINE ? UINT32_MAX
                                           : scene->record_base[a->machine[i]] + a->state[i];
}

/* A new version of a machine may have other states, so that it is given numbers of its own. */
void jox_run_record_states(JoScene *scene, uint32_t index) {
    const JoxMachine *machine = scene->world->mind.machines[index];
    if (!scene->recorder)
        return;
    scene->record_base[index] = scene->record_next;
    scene->record_next += 1000;
    for (uint32_t s = 0; s < machine->state_count; s++)
        jox_recorder_state(scene->recorder, scene->record_base[index] + s, machine->name,
                           machine->states[s].name);
}

bool jo_scene_record(JoScene *scene, const char *path, JoError *error) {
    JOX_REQUIRE(scene && path && !scene->recorder, false);
    JOX_GUARD(scene->heap, error)
    return false;
    JoxV2 low, high;
    JoxText wkt = {0}, why = {0};
    jox_run_area(scene, &low, &high);
    jox_wkt(&scene->world->walls, low, high, &wkt);
    double dt = scene->world->def.dt;
    scene->record_every = dt >= FRAME ? 1 : (uint32_t)(FRAME / dt + 0.5);
    scene->recorder = jox_recorder_open(path, 1.0 / (dt * scene->record_every), wkt.data, &why);
    jox_text_free(&wkt);
    if (!scene->recorder)
        return fail(error, &why);
    jox_recorder_walls(scene->recorder, &scene->world->all_walls);
    const JoxMind *mind = &scene->world->mind;
    for (uint32_t m = 0; m < mind->machine_count; m++)
        jox_run_record_states(scene, m);
    for (uint32_t g = 0; g < scene->spec->group_count; g++)
        jox_recorder_group(scene->recorder, g, scene->spec->groups[g].name);
    return true;
}

/* The parts of bodies that are new or came apart. */
static void record_shapes(JoScene *scene, uint32_t frame) {
    const JoxBodies *bodies = scene->world->bodies;
    for (uint32_t row = 0; row < jox_bodies_rows(bodies); row++) {
        const uint32_t id = jox_bodies_id(bodies, row);
        const size_t had = scene->record_shape_capacity;
        JoxBodyGlue glue;
        JoxBodyLook look;
        if (id == JOX_NO_BODY)
            continue;
        jox_bodies_glue(bodies, row, &glue);
        JOX_RESERVE(scene->record_shapes, scene->record_shape_capacity, (size_t)id + 1);
        for (size_t n = had; n < scene->record_shape_capacity; n++)
            scene->record_shapes[n] = 0;
        if (scene->record_shapes[id] == glue.blocks + 1)
            continue;
        scene->record_shapes[id] = glue.blocks + 1;
        for (uint32_t part = 0; jox_bodies_look(bodies, row, part, &look); part++)
            jox_recorder_part(scene->recorder, frame, id, part, &look);
    }
}

static bool record_frame(JoScene *scene, JoError *error) {
    const JoxAgents *a = &scene->world->agents;
    const JoxObjects *objects = &scene->world->objects;
    JoxRecordBody *bodies;
    uint32_t count = jox_bodies_count(scene->world->bodies), n = 0;
    const uint32_t frame = (uint32_t)(scene->world->tick / scene->record_every);
    record_shapes(scene, frame);
    JoxRecordRow *rows = jox_recorder_take(scene->recorder, a->count, count, &bodies);
    for (uint32_t id = 0; id < a->next_id; id++) { /* by id, whatever the order in memory */
        uint32_t i = a->id_index[id];
        if (i == JOX_NO_INDEX)
            continue;
        float force = sqrtf(a->force_x[i] * a->force_x[i] + a->force_y[i] * a->force_y[i]);
        rows[n++] = (JoxRecordRow){id,           a->x[i],           a->y[i],
                                   a->face_x[i], a->face_y[i],      state_number(scene, i),
                                   force,        a->compression[i], a->group[i]};
    }
    n = 0;
    for (uint32_t o = 0; o < objects->count && n < count; o++) {
        JoxPose pose;
        if (objects->rows[o].live && jox_bodies_pose(scene->world->bodies, o, &pose))
            bodies[n++] = (JoxRecordBody){objects->rows[o].id, pose.position.x, pose.position.y,
                                          pose.position.z,     pose.turn[0],    pose.turn[1],
                                          pose.turn[2],        pose.turn[3]};
    }
    JoxText why = {0};
    return jox_recorder_put(scene->recorder, frame, &why) || fail(error, &why);
}

/* ---- report ---- */

static void begin_danger(JoScene *scene) {
    JoxV2 low, high;
    jox_run_area(scene, &low, &high);
    if (!scene->danger)
        scene->danger = jox_danger_create(low, high);
}

void jox_run_begin_report(JoScene *scene) {
    JoxV2 low, high;
    jox_run_area(scene, &low, &high);
    scene->density = jox_density_create(low, high, JOX_DENSITY_CELL, JOX_DENSITY_KERNEL);
    begin_danger(scene);
}

bool jo_scene_report(JoScene *scene, const char *directory, JoError *error) {
    JOX_REQUIRE(scene && directory && !scene->report, false);
    JOX_GUARD(scene->heap, error)
    return false;
    JoxText why = {0};
    if (!jox_plot_folder(directory, &why))
        return fail(error, &why);
    scene->report = jox_strdup(directory);
    scene->paths = jox_paths_create();
    jox_run_begin_report(scene);
    return true;
}

bool jo_scene_data(JoScene *scene, const char *directory, JoError *error) {
    JOX_REQUIRE(scene && directory && !scene->data, false);
    JOX_GUARD(scene->heap, error)
    return false;
    JoxText why = {0};
    if (!jox_plot_folder(directory, &why))
        return fail(error, &why);
    scene->data = jox_strdup(directory);
    begin_danger(scene);
    return true;
}

/* Points of the paths of those who came first, ten a second. */
static void sample_paths(JoScene *scene) {
    const JoWorld *world = scene->world;
    const JoxAgents *a = &world->agents;
    uint64_t every = (uint64_t)jox_maxf(1.0f, (float)(FRAME / world->def.dt + 0.5));
    float time = (float)((double)world->tick * world->def.dt);
    for (uint32_t id = 0; world->tick % every == 0 && id < a->next_id && id < JOX_MOST_PATHS;
         id++) {
        uint32_t i = a->id_index[id];
        if (i != JOX_NO_INDEX)
            jox_paths_add(scene->paths, id, false, a->group[i], time, a->x[i], a->y[i]);
    }
    for (uint32_t o = 0; world->tick % every == 0 && o < world->objects.count; o++) {
        const JoxObject *object = &world->objects.rows[o];
        if (object->live && object->moves)
            jox_paths_add(scene->paths, object->id, true, 0, time, object->position.x,
                          object->position.y);
    }
}

static void make_regions(JoScene *scene) {
    scene->regions = jox_regions_create();
    for (uint32_t r = 0; r < scene->spec->region_count; r++)
        jox_regions_add(scene->regions, scene->spec->regions[r].name,
                        scene->spec->regions[r].points, scene->spec->regions[r].count);
}

static void sample(JoScene *scene) {
    const JoWorld *world = scene->world;
    const JoxAgents *a = &world->agents;
    if (scene->paths)
        sample_paths(scene);
    uint64_t every = (uint64_t)jox_maxf(1.0f, (float)(SAMPLE / world->def.dt + 0.5));
    double time = (double)world->tick * world->def.dt;
    if (world->tick % every != 0 || time < scene->spec->heatmap_from)
        return;
    if (scene->density)
        jox_density_add(scene->density, a->x, a->y, a->count, time);
    jox_regions_frame(scene->regions, a->x, a->y, a->prev_x, a->prev_y, a->count, world->def.dt);
}

static bool draw_paths(JoScene *scene, const char *title, JoxText *why) {
    const char *names[256];
    uint32_t count = scene->spec->group_count < 256 ? scene->spec->group_count : 256;
    JoxV2 low, high;
    for (uint32_t g = 0; g < count; g++)
        names[g] = scene->spec->groups[g].name;
    jox_run_area(scene, &low, &high);
    for (uint32_t p = 0; p < scene->paths->count; p++) /* nobody's path is cut off */
        for (uint32_t i = 0; i < scene->paths->items[p].count; i++) {
            const JoxPathPoint *point = &scene->paths->items[p].points[i];
            low = (JoxV2){jox_minf(low.x, point->x - 1), jox_minf(low.y, point->y - 1)};
            high = (JoxV2){jox_maxf(high.x, point->x + 1), jox_maxf(high.y, point->y + 1)};
        }
    return jox_plot_paths(scene->report, scene->paths, names, count, &scene->world->all_walls, low,
                          high, title, why);
}

static bool draw(JoScene *scene, JoError *error) {
    JoxText why = {0};
    char title[256];
    const char *name = scene->spec->title ? scene->spec->title : scene->spec->path;
    double until = jo_world_time(scene->world);
    snprintf(title, sizeof title, "%.120s: density, t = %.0f to %.0f s, %u agents", name,
             scene->spec->heatmap_from, until, scene->world->agents.count);
    if (scene->density->frames == 0) /* a run shorter than the first sample */
        jox_density_add(scene->density, scene->world->agents.x, scene->world->agents.y,
                        scene->world->agents.count, until);
    bool good =
        jox_plot_density(scene->report, scene->density, &scene->world->all_walls, title, &why);
    if (good && scene->regions && scene->regions->count) {
        snprintf(title, sizeof title, "%.120s: mean speed per region, t = %.0f to %.0f s", name,
                 scene->spec->heatmap_from, until);
        good = jox_plot_regions(scene->report, scene->regions, title, &why);
    }
    bool regions = scene->regions && scene->regions->count;
    bool paths = scene->world->agents.next_id <= JOX_MOST_PATHS && scene->paths->count;
    if (good && paths) {
        snprintf(title, sizeof title,
                 "%.120s: paths (a dot is the beginning, a circle the end), %.1f s", name, until);
        good = draw_paths(scene, title, &why);
    }
    good = good && jox_run_write_probes(scene, scene->report, name, &why) &&
           jox_danger_write(scene->danger, scene->report, &scene->world->all_walls, name, &why);
    if (!good)
        return fail(error, &why);
    jox_run_say(scene, "pictures: %s%s%s/density.png%s%s%s\n", paths ? scene->report : "",
                paths ? "/paths.png, " : "", scene->report, regions ? " and " : "",
                regions ? scene->report : "", regions ? "/regions.png" : "");
    if (scene->spec->probe_count)
        jox_run_say(scene, "probes: %u in %s/NAME.csv, NAME.png and NAME.svg\n",
                    scene->spec->probe_count, scene->report);
    return true;
}

/* ---- progress ---- */

void jo_scene_show_progress(JoScene *scene, double until) {
    JOX_REQUIRE(scene, );
    scene->progress_until = until;
    scene->progress_begun = jox_clock_wall();
}

static void show_progress(JoScene *scene) {
    double time = jo_world_time(scene->world), wall = jox_clock_wall() - scene->progress_begun;
    double share = time / scene->progress_until, left = wall / share - wall;
    bool terminal = isatty(2);
    int tenth = (int)(share * 10.0 + 1e-9);
    bool last = share >= 1.0 - 1e-9;
    if (terminal ? jox_clock_wall() - scene->progress_shown < 0.2 && !last
                 : tenth == scene->progress_tenth)
        return;
    scene->progress_shown = jox_clock_wall();
    scene->progress_tenth = tenth;
    fprintf(stderr, "%s%6.1f of %.1f s simulated, %.2f x real time, %.0f s left, %u agents%s",
            terminal ? "\r" : "", time, scene->progress_until, time / wall, last ? 0.0 : left,
            scene->world->agents.count, !terminal || last ? "\n" : "   ");
}

/* ---- the step's ends ---- */

void jo_scene_trace(JoScene *scene, uint32_t agent_id) {
    JOX_REQUIRE(scene, );
    scene->world->mind.traces = true;
    scene->world->mind.trace_id = agent_id;
}

bool jox_run_collect(JoScene *scene, JoError *error) {
    if (scene->world->mind.trace.length)
        jox_run_tell(scene, scene->world->mind.trace.data);
    if (!scene->regions)
        make_regions(scene);
    if (scene->density || scene->regions->count)
        sample(scene);
    jox_run_measure(scene);
    if (scene->live)
        jox_live_note(scene);
    if (scene->danger)
        jox_danger_frame(scene->danger, jox_run_frame(scene), &scene->exits);
    if (scene->progress_until > 0.0)
        show_progress(scene);
    return !scene->recorder || scene->world->tick % scene->record_every != 0 ||
           record_frame(scene, error);
}

bool jo_scene_step(JoScene *scene, JoError *error) {
    JOX_REQUIRE(scene && !scene->finished, false);
    JOX_GUARD(scene->heap, error)
    return false;
    jox_run_inputs(scene);
    jox_run_reload(scene);
    jox_run_events(scene);
    jox_run_sources(scene);
    jox_world_step(scene->world);
    jox_run_sinks(scene);
    jox_run_leavers(scene);
    const char *stalled = jox_lua_stalled(scene->lua);
    if (stalled) {
        jox_error(error, JO_FAILED,
                  "%s: its functions take far longer than their instructions explain (look-ups "
                  "among keys that collide, comparisons of long texts); the run was stopped",
                  stalled);
        return false;
    }
    return jox_run_collect(scene, error) && jox_run_logged(scene, error);
}

/* That plain functions ran, and what they cost: their authors should know without asking. */
static void say_costs(JoScene *scene) {
    double seconds = 0.0, wall = scene->world->statistics.wall_s;
    uint64_t calls = 0;
    for (uint32_t m = 0; m < scene->world->mind.machine_count; m++) {
        uint64_t own;
        seconds += jox_lua_seconds(scene->lua, scene->world->mind.machines[m], &own);
        calls += own;
    }
    if (calls > 0 && scene->progress_until > 0.0)
        jox_run_say(scene, "plain Lua functions: %llu calls, %.2f %% of the steps' time\n",
                    (unsigned long long)calls, wall > 0.0 ? 100.0 * seconds / wall : 0.0);
}

static bool finish(JoScene *scene, JoError *error) {
    bool good = true;
    if (!scene->finished && scene->lua && scene->world)
        say_costs(scene);
    JoxText why = {0};
    scene->finished = true;
    if (scene->recorder)
        good = jox_recorder_close(scene->recorder, &why) || fail(error, &why);
    scene->recorder = NULL;
    good = jox_run_end_log(scene, error) && good;
    if (scene->report) {
        good = draw(scene, error) && good;
    }
    if (scene->density)
        scene->density_most = scene->density->most;
    if (scene->data)
        good = ((jox_run_write_probes(scene, scene->data, NULL, &why) &&
                 jox_danger_write(scene->danger, scene->data, NULL, NULL, &why)) ||
                fail(error, &why)) &&
               good;
    jox_free(scene->data);
    scene->data = NULL;
    jox_density_free(scene->density);
    jox_paths_free(scene->paths);
    scene->paths = NULL;
    jox_free(scene->report);
    scene->density = NULL;
    scene->report = NULL;
    return good;
}

bool jo_scene_finish(JoScene *scene, JoError *error) {
    JOX_REQUIRE(scene, false);
    JOX_GUARD(scene->heap, error)
    return false;
    return finish(scene, error);
}
