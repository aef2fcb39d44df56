/* The scene message and the status message of a recording. */
#include <math.h>
#include <string.h>

#include "base/format/path.h"
#include "base/mem.h"
#include "live/replay_parts.h"

static const float BODY_SIZE = 0.4f; /* m, edge of the box drawn for a body of unknown shape */

/* Adds a machine with the names of its states; a recording has nothing else of it. */
static void add_recorded_machine(JoxJson *json, const JoxReplayNames *n, uint32_t machine) {
    static const char *const EMPTY[] = {"defaults", "transitions"};
    jox_json_object(json, NULL);
    jox_json_string(json, "name", n->machines[machine]);
    jox_json_string(json, "path", "");
    jox_json_whole(json, "version", 0);
    jox_json_null(json, "start");
    for (int e = 0; e < 2; e++) {
        jox_json_array(json, EMPTY[e]);
        jox_json_end(json);
    }
    jox_json_array(json, "states");
    for (uint32_t s = 0; s < n->state_count; s++) {
        if (n->states[s].machine != machine)
            continue;
        jox_json_object(json, NULL);
        jox_json_string(json, "name", n->states[s].name);
        jox_json_whole(json, "line", 0);
        jox_json_array(json, "parameters");
        jox_json_end(json);
        jox_json_end(json);
    }
    jox_json_end(json);
    jox_json_end(json);
}

/* Adds groups, states and machines by name. */
static void add_recorded_names(JoxJson *json, const JoxReplay *r) {
    const JoxReplayNames *n = &r->names;
    JoxLiveNamed *groups = jox_alloc(r->info.group_count + 1, sizeof *groups);
    for (uint32_t g = 0; g < r->info.group_count; g++) {
        const JoxColour given = r->info.group_colours ? r->info.group_colours[g] : 0;
        groups[g] = (JoxLiveNamed){r->info.groups[g], given, JOX_NO_INDEX, NULL};
    }
    jox_live_add_named("groups", groups, r->info.group_count, json);
    jox_free(groups);
    jox_live_add_named("states", n->states, n->state_count, json);
    jox_json_array(json, "machines");
    for (uint32_t m = 0; m < n->machine_count; m++)
        add_recorded_machine(json, n, m);
    jox_json_end(json);
}

/* Adds a body with the shape that the recording has in the shown frame, or (`known` false) with a
   box. */
static void add_recorded_body(JoxJson *json, const JoxReplay *r, uint32_t id, bool known) {
    JoxBodyLook look = {.kind = JOX_SHAPE_BOX,
                        .size = {BODY_SIZE, BODY_SIZE, BODY_SIZE},
                        .turn = {0.0f, 0.0f, 0.0f, 1.0f}};
    jox_json_object(json, NULL);
    jox_live_add_optional_name(
        json, known ? jox_trajectory_reader_body_name(r->reader, r->shown, id) : NULL);
    jox_json_whole(json, "mass", 0);
    jox_json_array(json, "parts");
    for (uint32_t part = 0;
         known && jox_trajectory_reader_part(r->reader, r->shown, id, part, &look); part++)
        jox_live_add_part(&look, json);
    if (!known)
        jox_live_add_part(&look, json);
    jox_json_end(json);
    jox_json_end(json);
}

/* Adds the bodies by row, with the shapes of the recording, else of the scene. */
static void add_recorded_bodies(JoxJson *json, const JoxReplay *r) {
    jox_json_array(json, "bodies");
    for (uint32_t row = 0; row < r->row_count; row++) {
        const uint32_t id = r->body_id[row];
        const uint32_t of_scene = r->bodies ? jox_bodies_find(r->bodies, id) : JOX_NO_BODY;
        JoxBodyLook look;
        bool recorded = r->shown != JOX_REPLAY_NOBODY &&
                        jox_trajectory_reader_part(r->reader, r->shown, id, 0, &look);
        if (!recorded && of_scene != JOX_NO_BODY)
            jox_live_add_body(r->bodies, of_scene, json);
        else
            add_recorded_body(json, r, id, recorded);
    }
    jox_json_end(json);
}

/* Adds the clothes of the scene's groups, else of the recording's. */
static void add_recorded_clothes(JoxJson *json, const JoxReplay *r) {
    jox_json_object(json, "clothes");
    for (uint32_t g = 0; r->spec && g < r->spec->group_count; g++)
        jox_live_add_clothes(r->spec->groups[g].name, r->spec->groups[g].clothes, json);
    for (uint32_t g = 0; !r->spec && r->info.group_clothes && g < r->info.group_count; g++)
        jox_live_add_clothes(r->info.groups[g], r->info.group_clothes[g], json);
    jox_json_end(json);
}

/* Adds tools that are all off: a recording cannot be acted on. */
static void add_disabled_tools(JoxJson *json) {
    static const char *const EMPTY[] = {"players", "walls", "signal_names"};
    jox_json_object(json, "tools");
    for (int t = 0; t < JOX_TOOL_COUNT; t++)
        jox_json_bool(json, jox_scene_tools[t], false);
    for (int e = 0; e < 3; e++) {
        jox_json_array(json, EMPTY[e]);
        jox_json_end(json);
    }
    jox_json_end(json);
}

void jox_replay_scene(const JoxReplay *r, JoxText *out) {
    const JoxSceneSpec *spec = r->spec;
    const JoxSceneLook *look = &r->look;
    const JoxLiveSceneHead head = {.session = "replay",
                                   .title = look->title && *look->title ? look->title
                                                                        : jox_path_name(r->path),
                                   .about = look->about,
                                   .file = r->path,
                                   .dt = 1.0 / r->info.fps,
                                   .duration = jox_replay_time(r, r->info.frames - 1),
                                   .area = r->area};
    JoxJson json = jox_json_begin(out, 0);
    jox_json_object(&json, NULL);
    jox_live_add_head(&head, &json);
    jox_live_add_storeys(r->info.storeys, &json);
    jox_live_add_walls(jox_replay_walls(r), &json);
    jox_live_add_places(look->places, look->place_count, &json);
    jox_live_add_lifts(r->info.lifts, r->info.lift_count, &json);
    jox_live_add_regions(spec ? spec->regions : NULL, spec ? spec->region_count : 0, &json);
    jox_json_bool(&json, "periodic", r->period.x > 0.0f || r->period.y > 0.0f);
    add_recorded_names(&json, r);
    add_recorded_bodies(&json, r);
    add_disabled_tools(&json);
    jox_scene_add_camera(look, &json);
    jox_scene_add_scenery(look, &json);
    add_recorded_clothes(&json, r);
    jox_live_add_colours(&json);
    jox_live_add_view(jox_replay_colour(r), jox_replay_first_field(r), look->colour > 0, &json);
    jox_json_array(&json, "charts");
    jox_json_end(&json);
    jox_json_end(&json);
}

uint64_t jox_replay_version(const JoxReplay *r) {
    const uint32_t changes =
        r->shown == JOX_REPLAY_NOBODY ? 0 : jox_trajectory_reader_changes(r->reader, r->shown);
    const uint32_t walls =
        r->shown == JOX_REPLAY_NOBODY ? 0 : jox_trajectory_reader_wall_changes(r->reader, r->shown);
    return (uint64_t)(changes + walls) << 32 | r->row_count;
}

/* Adds "states", the number of people in each state by machine, and an empty "fired": a recording
   has no transitions. */
static void add_recorded_counts(JoxJson *json, JoxReplay *r) {
    const JoxReplayNames *n = &r->names;
    memset(r->people, 0, n->state_count * sizeof *r->people);
    for (uint32_t i = 0; i < r->count; i++) {
        const uint32_t state = jox_replay_state(r, i);
        if (state < n->state_count)
            r->people[state]++;
    }
    jox_json_array(json, "states");
    for (uint32_t m = 0; m < n->machine_count; m++) {
        jox_json_array(json, NULL);
        for (uint32_t s = 0; s < n->state_count && r->shown != JOX_REPLAY_NOBODY; s++)
            if (n->states[s].machine == m)
                jox_json_whole(json, NULL, r->people[s]);
        jox_json_end(json);
    }
    jox_json_end(json);
    jox_json_array(json, "fired");
    for (uint32_t m = 0; m < n->machine_count; m++) {
        jox_json_array(json, NULL);
        jox_json_end(json);
    }
    jox_json_end(json);
}

void jox_replay_status(JoxReplay *r, const JoxLiveSession *session, double factor, JoxText *out) {
    static const char *const UNKNOWN[] = {"stage_ns", "flows"};
    const bool shown = r->shown != JOX_REPLAY_NOBODY; /* else the frame could not be read */
    jox_replay_spread(r);
    JoxJson json = jox_json_begin(out, 0);
    jox_json_object(&json, NULL);
    jox_live_add_session(shown ? r->shown : 0, r->frame.time, session, &json);
    jox_json_whole(&json, "jumps", session->jumps);
    jox_json_digits(&json, "real_time_factor", factor, 6);
    jox_json_whole(&json, "agents", r->count);
    jox_json_whole(&json, "bodies", r->frame.body_count);
    add_recorded_counts(&json, r);
    jox_json_digits(&json, "mean_speed", jox_replay_speed(r), 6);
    jox_json_digits(&json, "density_max", shown ? (double)jox_live_density_max(&r->grid) : NAN, 6);
    jox_json_digits(&json, "density_r", shown ? (double)jox_live_density_r(&r->grid) : NAN, 3);
    jox_json_null(&json, "failures");
    jox_live_add_gates(jox_replay_walls(r), &json);
    for (size_t u = 0; u < sizeof UNKNOWN / sizeof *UNKNOWN; u++) {
        jox_json_object(&json, UNKNOWN[u]);
        jox_json_end(&json);
    }
    jox_json_array(&json, "lifts");
    jox_json_end(&json);
    jox_json_end(&json);
}
