/* The scene message: the parts of a scene that rarely change. Its members that recordings have too
   are functions of live_parts.h, which replay_messages.c calls. */
#include <math.h>
#include <string.h>

#include "base/hash.h"
#include "base/mem.h"
#include "live/inspect.h"
#include "live/live_parts.h"
#include "picture/palette.h"
#include "scene/scene_look.h"

enum { DIGITS = 7 }; /* significant digits of positions and sizes, which are floats */

static void add_position(JoxJson *json, JoxV2 p) {
    jox_json_numbers_of(json, NULL, (double[]){(double)p.x, (double)p.y}, 2, DIGITS);
}

static void add_points(JoxJson *json, const char *key, const JoxV2 *points, uint32_t count) {
    jox_json_array(json, key);
    for (uint32_t i = 0; i < count; i++)
        add_position(json, points[i]);
    jox_json_end(json);
}

void jox_live_add_optional_name(JoxJson *json, const char *name) {
    jox_json_string(json, "name", name && *name ? name : NULL);
}

static void add_name_list(JoxJson *json, const char *key, const char *const *names,
                          uint32_t count) {
    jox_json_array(json, key);
    for (uint32_t n = 0; n < count; n++)
        jox_json_string(json, NULL, names[n]);
    jox_json_end(json);
}

static void add_floats(JoxJson *json, const char *key, const float *values, int count) {
    double wide[4];
    for (int i = 0; i < count; i++)
        wide[i] = (double)values[i];
    jox_json_numbers_of(json, key, wide, count, DIGITS);
}

/* ---- walls, places, regions ---- */

void jox_live_add_walls(const JoxWalls *walls, JoxJson *json) {
    jox_json_array(json, "walls");
    for (uint32_t r = 0; r < walls->ring_count; r++) {
        const struct JoxWallRing *ring = &walls->rings[r];
        bool closed, twin;
        const uint32_t n = jox_walls_given(walls, r, &closed, &twin);
        jox_json_object(json, NULL);
        jox_live_add_optional_name(json, ring->name);
        jox_json_bool(json, "solid", ring->solid);
        jox_json_bool(json, "open", ring->open);
        jox_json_bool(json, "outline", ring->outline);
        jox_json_digits(json, "height",
                        (double)(ring->drawn > 0.0f       ? ring->drawn
                                 : isfinite(ring->height) ? ring->height
                                                          : JOX_WALL_HEIGHT),
                        DIGITS);
        jox_json_array(json, "points");
        for (uint32_t i = 0; i < n + twin; i++) /* a closed line repeats its first point */
            add_position(json, walls->vertices[ring->first + i % n].point);
        jox_json_end(json);
        jox_json_end(json);
        r += twin;
    }
    jox_json_end(json);
}

void jox_live_add_places(const JoxPlace *places, uint32_t count, JoxJson *json) {
    jox_json_array(json, "places");
    for (uint32_t p = 0; p < count; p++) {
        const JoxPlace *place = &places[p];
        jox_json_object(json, NULL);
        jox_json_string(json, "name", place->name);
        jox_json_string(json, "kind", jox_place_kinds[place->kind].name);
        jox_json_digits(json, "radius", (double)jox_place_radius(place), DIGITS);
        jox_json_whole(json, "height", 0);
        add_points(json, "points", place->points, place->count);
        jox_json_end(json);
    }
    jox_json_end(json);
}

void jox_live_add_lifts(const JoxLift *lifts, uint32_t count, JoxJson *json) {
    jox_json_array(json, "lifts");
    for (uint32_t l = 0; l < count; l++) {
        const JoxLift *lift = &lifts[l];
        jox_json_object(json, NULL);
        jox_json_string(json, "name", lift->name);
        jox_json_whole(json, "capacity", lift->capacity);
        add_points(json, "outline", lift->outline, lift->point_count);
        jox_json_array(json, "stops");
        for (uint32_t s = 0; s < lift->stop_count; s++) {
            jox_json_object(json, NULL);
            jox_json_whole(json, "storey", lift->stops[s].storey);
            jox_json_digits(json, "height", (double)lift->stops[s].height, DIGITS);
            jox_json_string(json, "wall", lift->stops[s].name);
            add_points(json, "door", lift->stops[s].door, 2);
            jox_json_end(json);
        }
        jox_json_end(json);
        jox_json_end(json);
    }
    jox_json_end(json);
}

void jox_live_add_regions(const JoxSceneRegion *regions, uint32_t count, JoxJson *json) {
    jox_json_object(json, "regions");
    for (uint32_t r = 0; r < count; r++)
        add_points(json, regions[r].name, regions[r].points, regions[r].count);
    jox_json_end(json);
}

/* ---- bodies, by row; bodies that are gone have no parts ---- */

void jox_live_add_part(const JoxBodyLook *look, JoxJson *json) {
    static const char *const KINDS[] = {"box", "sphere", "cylinder", "hull"};
    static const int SIZES[] = {3, 1, 2, 0};
    jox_json_object(json, NULL);
    jox_json_string(json, "shape", KINDS[look->kind]);
    add_floats(json, "size", look->size, SIZES[look->kind]);
    add_floats(json, "at", (float[]){look->at.x, look->at.y, look->at.z}, 3);
    add_floats(json, "turn", look->turn, 4);
    jox_json_array(json, "points");
    for (uint32_t c = 0; c < look->corner_count; c++)
        add_floats(json, NULL,
                   (float[]){look->corners[c].x, look->corners[c].y, look->corners[c].z}, 3);
    jox_json_end(json);
    jox_json_end(json);
}

void jox_live_add_body(const JoxBodies *bodies, uint32_t row, JoxJson *json) {
    JoxPose pose;
    JoxBodyLook look;
    bool live = jox_bodies_pose(bodies, row, &pose);
    jox_json_object(json, NULL);
    jox_live_add_optional_name(json, live ? jox_bodies_name(bodies, row) : NULL);
    jox_json_digits(json, "mass", live ? (double)pose.mass : 0.0, DIGITS);
    jox_json_array(json, "parts");
    for (uint32_t part = 0; live && jox_bodies_describe_part(bodies, row, part, &look); part++)
        jox_live_add_part(&look, json);
    jox_json_end(json);
    jox_json_end(json);
}

static void add_scene_bodies(JoxJson *json, const JoxBodies *bodies) {
    jox_json_array(json, "bodies");
    for (uint32_t row = 0; row < jox_bodies_rows(bodies); row++)
        jox_live_add_body(bodies, row, json);
    jox_json_end(json);
}

/* ---- people ---- */

void jox_live_add_named(const char *key, const JoxLiveNamed *items, uint32_t count, JoxJson *json) {
    JoxColour *given = jox_alloc(count + 1, sizeof *given);
    JoxInk *inks = jox_alloc(count + 1, sizeof *inks);
    for (uint32_t n = 0; n < count; n++)
        given[n] = items[n].given;
    jox_palette_classes(given, count, inks);
    jox_json_array(json, key);
    for (uint32_t n = 0; n < count; n++) {
        char colour[8];
        jox_colour_write(jox_palette_colour(inks[n]), colour);
        jox_json_object(json, NULL);
        if (items[n].machine != JOX_NO_INDEX)
            jox_json_whole(json, "machine", items[n].machine);
        jox_json_string(json, "name", items[n].name);
        jox_json_string(json, "colour", colour);
        if (items[n].pose)
            jox_json_string(json, "pose", items[n].pose);
        jox_json_end(json);
    }
    jox_json_end(json);
    jox_free(inks);
    jox_free(given);
}

static void add_scene_groups(JoxJson *json, const JoxSceneSpec *spec) {
    JoxLiveNamed *named = jox_alloc(spec->group_count + 1, sizeof *named);
    for (uint32_t g = 0; g < spec->group_count; g++)
        named[g] = (JoxLiveNamed){spec->groups[g].name, spec->groups[g].colour, JOX_NO_INDEX, NULL};
    jox_live_add_named("groups", named, spec->group_count, json);
    jox_free(named);
}

static void add_scene_clothes(JoxJson *json, const JoxSceneSpec *spec) {
    jox_json_object(json, "clothes");
    for (uint32_t g = 0; g < spec->group_count; g++)
        jox_live_add_clothes(spec->groups[g].name, spec->groups[g].clothes, json);
    jox_json_end(json);
}

static void add_scene_states(JoxJson *json, const JoxMachineRun *machines) {
    JoxLiveNamed *named = NULL;
    size_t capacity = 0;
    uint32_t count = 0;
    for (uint32_t m = 0; m < machines->set->count; m++)
        for (uint32_t s = 0; s < machines->set->items[m]->state_count; s++) {
            const JoxState *state = &machines->set->items[m]->states[s];
            JOX_RESERVE(named, capacity, count + 1);
            named[count++] = (JoxLiveNamed){state->name, state->colour, m, jox_poses[state->pose]};
        }
    jox_live_add_named("states", named, count, json);
    jox_free(named);
}

void jox_live_add_colours(JoxJson *json) {
    jox_json_object(json, "colours");
    for (int c = 0; c < JOX_LIVE_COLOUR_COUNT; c++) {
        const JoxLiveColourInfo *colour = &jox_live_colours[c];
        if (c == JOX_LIVE_COLOUR_state || c == JOX_LIVE_COLOUR_group)
            continue;
        jox_json_object(json, colour->name);
        jox_json_digits(json, "most", (double)colour->most, DIGITS);
        jox_json_string(json, "unit", colour->unit);
        jox_json_end(json);
    }
    jox_json_end(json);
}

/* ---- tools ---- */

enum { MOST_NAMES = 256 };

/* Appends a name to a list unless it is there; returns the new number of names. */
static uint32_t add_unique(const char **names, uint32_t count, const char *name) {
    for (uint32_t n = 0; n < count; n++)
        if (strcmp(names[n], name) == 0)
            return count;
    if (count < MOST_NAMES)
        names[count++] = name;
    return count;
}

/* Adds the tools that the page offers: those that the scene allows and that have something to act
   on, with the names of walls and signals, and gravity, m/s2, for throws. */
static void add_scene_tools(JoxJson *json, const JoScene *scene) {
    const JoWorld *world = scene->world;
    const uint32_t allowed = scene->spec->view.tools;
    const char *walls[MOST_NAMES], *signals[MOST_NAMES];
    uint32_t wall_count = 0, signal_count = 0;
    for (uint32_t r = 0; r < world->model.all_walls.ring_count; r++)
        if (world->model.all_walls.rings[r].name && !world->model.all_walls.rings[r].is_lift_door)
            wall_count = add_unique(walls, wall_count, world->model.all_walls.rings[r].name);
    for (uint32_t m = 0; m < world->model.machines.count; m++)
        for (uint32_t n = 0; n < world->model.machines.items[m]->name_count; n++)
            if (world->model.machines.items[m]->names[n].uses & JOX_NAME_HEARD)
                signal_count = add_unique(signals, signal_count,
                                          world->model.machines.items[m]->names[n].text);
    const bool offered[JOX_TOOL_COUNT] = {
        [JOX_TOOL_THROW] = jox_bodies_available(),
        [JOX_TOOL_DRAG] = jox_bodies_count(world->state.bodies) > 0,
        [JOX_TOOL_PUSH] = true,
        [JOX_TOOL_GATES] = wall_count > 0,
        [JOX_TOOL_PARAMETERS] = world->model.machines.count > 0,
        [JOX_TOOL_SIGNALS] = signal_count > 0,
        [JOX_TOOL_PLAYER] = jox_live_player_id(scene) != JOX_NO_INDEX,
    };
    jox_json_object(json, "tools");
    for (int t = 0; t < JOX_TOOL_COUNT; t++)
        jox_json_bool(json, jox_scene_tools[t], offered[t] && (allowed >> t & 1));
    jox_json_array(json, "players");
    if (offered[JOX_TOOL_PLAYER] && (allowed >> JOX_TOOL_PLAYER & 1))
        jox_json_whole(json, NULL, jox_live_player_id(scene));
    jox_json_end(json);
    add_name_list(json, "walls", walls, wall_count);
    add_name_list(json, "signal_names", signals, signal_count);
    jox_json_number(json, "gravity", world->model.def.gravity);
    jox_json_end(json);
}

/* ---- the whole ---- */

void jox_live_add_head(const JoxLiveSceneHead *head, JoxJson *json) {
    jox_json_string(json, "type", "scene");
    jox_json_whole(json, "protocol", JOX_LIVE_PROTOCOL);
    jox_json_string(json, "session", head->session);
    jox_json_string(json, "title", head->title);
    jox_json_string(json, "about", head->about ? head->about : "");
    jox_json_string(json, "file", head->file);
    jox_json_number(json, "dt", head->dt);
    jox_json_number(json, "duration", head->duration);
    jox_json_whole(json, "seed", head->seed);
    jox_json_bool(json, "restarts", head->restarts);
    add_points(json, "area", (JoxV2[]){head->area.low, head->area.high}, 2);
}

void jox_live_add_view(JoxLiveColour colour, JoxLiveField field, bool given, JoxJson *json) {
    jox_json_object(json, "view");
    jox_json_bool(json, "given", given);
    jox_json_string(json, "colour", jox_live_colours[colour].name);
    jox_json_string(json, "field", jox_live_field_name(field));
    jox_json_end(json);
}

/* Adds the names of flow probes, whose counts the page draws as charts. */
static void add_charts(JoxJson *json, const JoxSceneSpec *spec) {
    jox_json_array(json, "charts");
    for (uint32_t p = 0; p < spec->probe_count; p++)
        if (spec->probes[p].kind == JOX_PROBE_FLOW)
            jox_json_string(json, NULL, spec->probes[p].name);
    jox_json_end(json);
}

/* Adds the mods that have settings, with the values of the behaviours that run. */
static void add_scene_mods(JoxJson *json, const JoxMods *mods) {
    static const char *const KINDS[] = {[JOX_SETTING_NUMBER] = "number",
                                        [JOX_SETTING_BOOL] = "bool",
                                        [JOX_SETTING_CHOICE] = "choice"};
    jox_json_array(json, "mods");
    for (uint32_t m = 0; m < mods->count; m++) {
        const JoxMod *mod = &mods->items[m];
        if (!mod->setting_count)
            continue;
        jox_json_object(json, NULL);
        jox_json_string(json, "name", mod->name);
        jox_json_string(json, "title", mod->title);
        jox_json_array(json, "settings");
        for (uint32_t s = 0; s < mod->setting_count; s++) {
            const JoxModSetting *setting = &mod->settings[s];
            jox_json_object(json, NULL);
            jox_json_string(json, "name", setting->name);
            jox_json_string(json, "kind", KINDS[setting->kind]);
            if (setting->kind == JOX_SETTING_NUMBER)
                jox_json_number(json, "value", setting->shown);
            else if (setting->kind == JOX_SETTING_BOOL)
                jox_json_bool(json, "value", setting->shown != 0.0);
            else
                jox_json_string(json, "value", jox_setting_text(setting, setting->shown));
            jox_json_number(json, "least", setting->least);
            jox_json_number(json, "most", setting->greatest);
            jox_json_string(json, "unit", setting->unit);
            jox_json_string(json, "meaning", setting->meaning);
            add_name_list(json, "choices", (const char *const *)setting->choices,
                          setting->choice_count);
            jox_json_end(json);
        }
        jox_json_end(json);
        jox_json_end(json);
    }
    jox_json_end(json);
}

JoxLiveColour jox_live_first_colour(const JoScene *scene) {
    const JoxMachineSet *machines = scene->world->machines.set;
    uint32_t states = 0;
    for (uint32_t m = 0; m < machines->count; m++)
        states += machines->items[m]->state_count;
    return (JoxLiveColour)jox_live_colour(
        jox_scene_choose_colouring(scene->spec->view.colour, states, scene->spec->group_count));
}

void jox_live_scene(JoScene *scene, bool restarts, JoxText *out) {
    const JoxLive *live = jox_live_attach(scene);
    const JoxSceneSpec *spec = scene->spec;
    const JoxSceneLook look = jox_scene_look(spec);
    const JoWorld *world = scene->world;
    const JoxLiveSceneHead head = {.session = "live",
                                   .title = spec->title && *spec->title ? spec->title : spec->path,
                                   .about = spec->about,
                                   .file = spec->path,
                                   .dt = world->model.def.dt,
                                   .duration = spec->duration,
                                   .seed = world->model.def.seed,
                                   .area = live->area,
                                   .restarts = restarts};
    JoxJson json = jox_json_begin(out, 0);
    jox_json_object(&json, NULL);
    jox_live_add_head(&head, &json);
    jox_live_add_storeys(jox_live_storeys(scene), &json);
    jox_live_add_walls(&world->model.all_walls, &json);
    jox_live_add_places(world->model.places, scene->world->model.scene_places, &json);
    jox_live_add_lifts(world->model.lifts, world->model.lift_count, &json);
    jox_live_add_regions(spec->regions, spec->region_count, &json);
    add_scene_groups(&json, spec);
    add_scene_states(&json, &world->machines);
    jox_live_add_machines(scene, &json, "machines");
    add_scene_bodies(&json, world->state.bodies);
    add_scene_tools(&json, scene);
    jox_scene_add_camera(&look, &json);
    jox_scene_add_scenery(&look, &json);
    add_scene_clothes(&json, spec);
    jox_live_add_colours(&json);
    jox_live_add_view(jox_live_first_colour(scene), (JoxLiveField)spec->view.field,
                      spec->view.colour > 0, &json);
    add_charts(&json, spec);
    add_scene_mods(&json, scene->mods);
    jox_live_add_rules(scene, &json);
    jox_json_end(&json);
}

uint64_t jox_live_version(const JoScene *scene) {
    const JoWorld *world = scene->world;
    const JoxWalls *walls = &world->model.all_walls;
    JoxHash hash = jox_hash_begin();
    jox_hash_add(&hash, &scene->spec->view, sizeof scene->spec->view);
    jox_hash_add(&hash, &scene->settings_changed, sizeof scene->settings_changed);
    for (uint32_t g = 0; g < scene->spec->group_count; g++)
        jox_hash_add(&hash, &scene->spec->groups[g].colour, sizeof(JoxColour));
    jox_hash_add(&hash, scene->spec->camera.position, sizeof scene->spec->camera.position);
    jox_hash_add(&hash, scene->spec->camera.target, sizeof scene->spec->camera.target);
    jox_live_hash_scenery(scene->spec, &hash);
    for (uint32_t m = 0; m < world->model.machines.count; m++)
        jox_hash_add(&hash, &world->model.machines.items[m], sizeof world->model.machines.items[m]);
    jox_hash_add(&hash, &world->machines.edits_made, sizeof world->machines.edits_made);
    for (uint32_t v = 0; v < walls->count; v++) /* the status tells whether a wall is open */
        jox_hash_add(&hash, &walls->vertices[v].point, sizeof(JoxV2));
    for (uint32_t r = 0; r < walls->ring_count; r++)
        jox_hash_add(&hash, &walls->rings[r].drawn, sizeof walls->rings[r].drawn);
    for (uint32_t p = 0; p < world->model.place_count; p++)
        jox_hash_add(&hash, world->model.places[p].points,
                     world->model.places[p].count * sizeof(JoxV2));
    for (uint32_t row = 0; row < jox_bodies_rows(world->state.bodies); row++) {
        const uint32_t id = jox_bodies_id(world->state.bodies, row);
        JoxBodyBonds bonds;
        jox_bodies_bonds(world->state.bodies, row, &bonds);
        jox_hash_add(&hash, &id, sizeof id);
        jox_hash_add(&hash, &bonds.blocks, sizeof bonds.blocks);
    }
    return jox_hash_end(&hash);
}
