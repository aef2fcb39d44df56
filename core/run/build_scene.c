/* Builds a scene from its files: specification, world, bodies, places, machines, people, and the
   listeners that each run has. load_scene.c calls it, once for each set of mods that it tries. */
#include "run/build_scene.h"
#include "run/program_words.h"

#include <errno.h>
#include <string.h>

#include "base/file.h"
#include "base/hash.h"
#include "base/mem.h"
#include "run/criteria_listener.h"
#include "run/event_signals.h"
#include "run/figure_listeners.h"
#include "run/game_round.h"
#include "run/input_actions.h"
#include "run/input_log.h"
#include "run/literal_notes.h"
#include "run/machine_names.h"
#include "run/probe_listener.h"
#include "run/read_scene.h"
#include "run/run.h"
#include "run/scene_machines.h"
#include "run/standstill.h"
#include "run/starting_people.h"
#include "run/starting_torsos.h"
#include "run/tags_and_teams.h"
#include "run/wall_checks.h"

enum { LARGEST_INPUT = 256 << 20 }; /* bytes */

static void add_bodies(JoScene *scene, JoxDiagnostics *diagnostics) {
    JoxSceneSpec *spec = scene->spec;
    for (uint32_t i = 0; i < spec->body_count; i++) {
        JoxSceneBody *body = &spec->bodies[i];
        JoxText why = {0};
        body->def.tags =
            jox_run_number_tags(scene, body->tags, body->tag_count, body->position, diagnostics);
        if (jox_bodies_add(scene->world->state.bodies, &body->def, &why) == JOX_NO_BODY)
            jox_diag_error(diagnostics, body->position, "bad-body", NULL, "%s",
                           why.data ? why.data : "this body was refused");
        jox_text_free(&why);
    }
    for (uint32_t g = 0; g < spec->group_count; g++)
        jox_run_number_tags(scene, spec->groups[g].tags, spec->groups[g].tag_count,
                            spec->groups[g].position, diagnostics);
}

/* Returns the number of places that are floors of lifts' cars: the first ones of a scene. */
static uint32_t count_cars(const JoxSceneSpec *spec) {
    uint32_t count = 0;
    for (uint32_t l = 0; l < spec->lift_count; l++)
        count += spec->lifts[l].stop_count;
    return count;
}

/* Copies places to the world, which owns them, and reserves one more for each agent whose goal
   is the opposite side of its circle. */
static void add_places(JoScene *scene) {
    const JoxSceneSpec *spec = scene->spec;
    uint32_t extra = 0;
    for (uint32_t g = 0; g < spec->group_count; g++)
        for (uint32_t s = 0; s < spec->groups[g].set_count; s++)
            if (spec->groups[g].set[s].kind == JOX_SET_ANTIPODE)
                extra += spec->groups[g].count;
    JoxPlace *places = jox_alloc((size_t)spec->place_count + extra + 1, sizeof *places);
    for (uint32_t i = 0; i < spec->place_count; i++)
        jox_place_copy(&places[i], &spec->places[i]);
    jox_world_set_places(scene->world, places, spec->place_count, spec->place_count + extra);
    scene->scope_groups = jox_alloc((size_t)spec->group_count + 1, sizeof *scene->scope_groups);
    for (uint32_t g = 0; g < spec->group_count; g++)
        scene->scope_groups[g] =
            (JoxScopeGroup){jox_strdup(spec->groups[g].name),
                            spec->groups[g].team ? jox_strdup(spec->groups[g].team) : NULL};
    scene->scope = (JoxScope){.places = places,
                              .place_count = spec->place_count,
                              .car_count = count_cars(spec),
                              .groups = scene->scope_groups,
                              .group_count = spec->group_count,
                              .walls = &scene->world->model.all_walls,
                              .complete = true,
                              .mods = scene->mods->items,
                              .mod_count = scene->mods->count};
    jox_run_refresh_tags_and_teams(scene);
}

/* Reads the input log. The scene's files are then read as they were when the log began. */
static void read_input_log(JoScene *scene, const char *path, JoxDiagnostics *diagnostics) {
    size_t length;
    char *text = path ? jox_read_file(path, LARGEST_INPUT, &length) : NULL;
    if (path && !text)
        jox_diag_error(diagnostics, ((JoxPosition){path, 0, 0, 0}), "unreadable-file", NULL,
                       "cannot read the input log '%s': %s", path, jox_file_error_text(errno));
    if (text && jox_diag_check_text(diagnostics, path, text, length))
        jox_input_parse(&scene->input, path, text, length, diagnostics);
    if (text) {
        jox_run_restore_logged_texts(&scene->overlay, &scene->input);
        jox_diag_attach_source(diagnostics, path, text, length);
        scene->input_path = jox_strdup(path);
        jox_sha256_hex(text, length, scene->input_sha256);
    }
    jox_free(text);
}

static void forward_message(void *context, const char *text) {
    jox_run_send_text(context, text);
}

static JoxLuaLimits get_script_limits(const JoxSceneSpec *spec) {
    JoxLuaLimits limits = jox_lua_default_limits();
    limits.hook_instructions = (uint64_t)spec->limits.instructions;
    limits.step_instructions = (uint64_t)spec->limits.step_instructions;
    limits.load_instructions = (uint64_t)spec->limits.load_instructions;
    limits.memory = (size_t)(spec->limits.memory * (1 << 20));
    limits.block = (size_t)(spec->limits.block * (1 << 20));
    limits.source = (size_t)(spec->limits.source * (1 << 10));
    limits.print_lines = (uint32_t)spec->limits.print;
    return limits;
}

void jox_run_build(JoScene *scene, const JoSceneDef *def, uint32_t count,
                   JoxDiagnostics *diagnostics) {
    if (def->input_log)
        read_input_log(scene, def->input_log, diagnostics);
    JoxSceneSpec *spec = scene->spec = jox_run_load_spec(def, scene->mods, count, diagnostics);
    if (!spec)
        return;
    JoWorldDef world = jo_default_world_def();
    world.dt = spec->step;
    world.seed = spec->seed;
    world.threads = def->threads;
    world.isa = def->isa;
    world.jobs = def->jobs;
    world.gravity = spec->gravity;
    world.forces = spec->forces;
    world.literal = spec->literal;
    world.lost_people = (JoLost)spec->lost_people;
    world.lost_bodies = (JoLost)spec->lost_bodies;
    scene->world = jox_world_create(&world);
    jox_world_set_timed(scene->world, true);
    scene->world->record = jox_run_log_act;
    scene->world->record_context = scene;
    scene->world->model.reinserts_bodies = def->resumable;
    jox_world_set_walking(scene->world, &spec->walking);
    if (!def->input_log)
        read_input_log(scene, spec->input, diagnostics);
    scene->world->state.input = scene->input; /* the world's from here on */
    scene->input = (JoxInputLog){0};
    if (spec->periodic_x || spec->periodic_y) {
        JoxV2 size = jox_sub(spec->high, spec->low);
        scene->world->state.agents.origin = spec->low;
        scene->world->state.agents.period =
            (JoxV2){spec->periodic_x ? size.x : 0.0f, spec->periodic_y ? size.y : 0.0f};
    }
    jox_world_set_storeys(scene->world, &spec->storeys);
    jox_world_set_walls(scene->world, &spec->walls);
    const JoxLuaLimits limits = get_script_limits(spec);
    scene->lua = jox_lua_create(&limits);
    jox_lua_attach(scene->lua, &scene->world->machines, forward_message, scene);
    jox_run_set_words(scene, def, diagnostics);
    jox_run_restore_tags_and_teams(scene);
    add_bodies(scene, diagnostics);
    add_places(scene);
    jox_world_set_lifts(scene->world, spec->lifts, spec->lift_count);
    if (!jox_run_load_machines(scene, diagnostics))
        return;
    jox_run_note_literal(scene, diagnostics);
    JoxMachineRun *machines = &scene->world->machines;
    machines->call = jox_lua_call;
    machines->bracket = jox_lua_bracket_hooks;
    machines->hook_sections = jox_lua_sections;
    machines->call_context = scene->lua;
    if (diagnostics->errors == 0 && def->dry) {
        jox_run_check_machine_names(scene, diagnostics);
    } else if (diagnostics->errors == 0) {
        jox_run_place_groups(scene, diagnostics);
        jox_run_check_machine_names(scene, diagnostics);
        jox_run_check_step_length(scene, diagnostics);
        jox_run_start_torsos(scene, diagnostics);
        jox_run_check_sources(scene, diagnostics);
        jox_run_check_journeys(scene, diagnostics);
        jox_run_number_event_signals(scene, diagnostics);
        jox_run_collect_regions(scene);
        if (!def->no_density)
            jox_run_collect_densities(scene, NULL);
        jox_run_collect_standstills(scene);
        jox_run_watch_game(scene);
        jox_run_collect_probes(scene);
        jox_run_collect_criteria(scene);
    }
}
