/* The hello: all of a scene that stays as it is for a while. */
#include <math.h>
#include <string.h>

#include "base/hash.h"
#include "live/live_parts.h"

static void add_point(JoxText *out, JoxV2 p) {
    jox_text_printf(out, "[%.7g, %.7g]", (double)p.x, (double)p.y);
}

static void add_points(JoxText *out, const JoxV2 *points, uint32_t count) {
    jox_text_add(out, "[");
    for (uint32_t i = 0; i < count; i++) {
        jox_text_add(out, i ? ", " : "");
        add_point(out, points[i]);
    }
    jox_text_add(out, "]");
}

static void add_name(JoxText *out, const char *name) {
    if (name && *name)
        jox_text_json(out, name);
    else
        jox_text_add(out, "null");
}

static void add_names(JoxText *out, const char *key, const char *const *names, uint32_t count) {
    jox_text_printf(out, ", \"%s\": [", key);
    for (uint32_t n = 0; n < count; n++) {
        jox_text_add(out, n ? ", " : "");
        jox_text_json(out, names[n]);
    }
    jox_text_add(out, "]");
}

static void add_numbers(JoxText *out, const char *key, const double *values, int count) {
    jox_text_printf(out, "\"%s\": [", key);
    for (int i = 0; i < count; i++)
        jox_text_printf(out, "%s%.7g", i ? ", " : "", values[i]);
    jox_text_add(out, "]");
}

static void add_floats(JoxText *out, const char *key, const float *values, int count) {
    double wide[4];
    for (int i = 0; i < count; i++)
        wide[i] = (double)values[i];
    add_numbers(out, key, wide, count);
}

/* ---- walls, places, regions ---- */

void jox_live_walls(const JoxWalls *walls, float height, JoxText *out) {
    jox_text_add(out, "[");
    for (uint32_t r = 0; r < walls->ring_count; r++) {
        const struct JoxWallRing *ring = &walls->rings[r];
        bool closed, twin;
        const uint32_t n = jox_walls_given(walls, r, &closed, &twin);
        jox_text_add(out, r ? ", {\"name\": " : "{\"name\": ");
        add_name(out, ring->name);
        jox_text_printf(out, ", \"solid\": %s, \"open\": %s, \"height\": %.4g, \"points\": [",
                        ring->solid ? "true" : "false", ring->open ? "true" : "false",
                        (double)(isfinite(ring->height) ? ring->height : height));
        for (uint32_t i = 0; i < n + twin; i++) { /* a closed line ends where it began */
            jox_text_add(out, i ? ", " : "");
            add_point(out, walls->vertices[ring->first + i % n].point);
        }
        jox_text_add(out, "]}");
        r += twin;
    }
    jox_text_add(out, "]");
}

void jox_live_add_places(const JoxPlace *places, uint32_t count, JoxText *out) {
    static const char *const KINDS[] = {"point", "line", "polygon", "queue", "set"};
    jox_text_add(out, ", \"places\": [");
    for (uint32_t p = 0; p < count; p++) {
        const JoxPlace *place = &places[p];
        jox_text_add(out, p ? ", {\"name\": " : "{\"name\": ");
        jox_text_json(out, place->name);
        jox_text_printf(out, ", \"kind\": \"%s\", \"radius\": %.4g, \"height\": 0, \"points\": ",
                        KINDS[place->kind],
                        place->kind == JOX_PLACE_POINT ? (double)place->radius : 0.0);
        add_points(out, place->points, place->count);
        jox_text_add(out, "}");
    }
    jox_text_add(out, "]");
}

void jox_live_add_regions(const JoxSceneRegion *regions, uint32_t count, JoxText *out) {
    jox_text_add(out, ", \"regions\": {");
    for (uint32_t r = 0; r < count; r++) {
        jox_text_add(out, r ? ", " : "");
        jox_text_json(out, regions[r].name);
        jox_text_add(out, ": ");
        add_points(out, regions[r].points, regions[r].count);
    }
    jox_text_add(out, "}");
}

/* ---- bodies: by row, those that are gone without parts ---- */

void jox_live_add_part(const JoxBodyLook *look, JoxText *out) {
    static const char *const KINDS[] = {"box", "sphere", "cylinder", "hull"};
    static const int SIZES[] = {3, 1, 2, 0};
    jox_text_printf(out, "{\"shape\": \"%s\", ", KINDS[look->kind]);
    add_floats(out, "size", look->size, SIZES[look->kind]);
    jox_text_add(out, ", ");
    add_floats(out, "at", (float[]){look->at.x, look->at.y, look->at.z}, 3);
    jox_text_add(out, ", ");
    add_floats(out, "turn", look->turn, 4);
    jox_text_add(out, ", \"points\": [");
    for (uint32_t c = 0; c < look->corner_count; c++)
        jox_text_printf(out, "%s[%.6g, %.6g, %.6g]", c ? ", " : "", (double)look->corners[c].x,
                        (double)look->corners[c].y, (double)look->corners[c].z);
    jox_text_add(out, "]}");
}

void jox_live_body(const JoxBodies *bodies, uint32_t row, JoxText *out) {
    JoxPose pose;
    JoxBodyLook look;
    bool live = jox_bodies_pose(bodies, row, &pose);
    jox_text_add(out, "{\"name\": ");
    add_name(out, live ? jox_bodies_name(bodies, row) : NULL);
    jox_text_printf(out, ", \"mass\": %.5g, \"parts\": [", (double)pose.mass);
    for (uint32_t part = 0; live && jox_bodies_look(bodies, row, part, &look); part++) {
        jox_text_add(out, part ? ", " : "");
        jox_live_add_part(&look, out);
    }
    jox_text_add(out, "]}");
}

static void add_bodies(JoxText *out, const JoxBodies *bodies) {
    jox_text_add(out, ", \"bodies\": [");
    for (uint32_t row = 0; row < jox_bodies_rows(bodies); row++) {
        jox_text_add(out, row ? ", " : "");
        jox_live_body(bodies, row, out);
    }
    jox_text_add(out, "]");
}

/* ---- people ---- */

static void add_groups(JoxText *out, const JoScene *scene) {
    const JoxSceneSpec *spec = scene->spec;
    const JoxMind *mind = &scene->world->mind;
    jox_text_add(out, ", \"groups\": [");
    for (uint32_t g = 0; g < spec->group_count; g++) {
        jox_text_add(out, g ? ", " : "");
        jox_text_json(out, spec->groups[g].name);
    }
    jox_text_add(out, "], \"states\": [");
    for (uint32_t m = 0, n = 0; m < mind->machine_count; m++)
        for (uint32_t s = 0; s < mind->machines[m]->state_count; s++, n++) {
            jox_text_printf(out, "%s{\"machine\": %u, \"name\": ", n ? ", " : "", m);
            jox_text_json(out, mind->machines[m]->states[s].name);
            jox_text_add(out, "}");
        }
    jox_text_add(out, "]");
}

void jox_live_add_colours(JoxText *out) {
    jox_text_add(out, ", \"colours\": {");
    const char *comma = "";
    for (int c = 0; c < JOX_LIVE_COLOUR_COUNT; c++) {
        const JoxLiveColourInfo *colour = &jox_live_colours[c];
        if (c == JOX_LIVE_COLOUR_state || c == JOX_LIVE_COLOUR_group)
            continue;
        jox_text_printf(out, "%s\"%s\": {\"most\": %g, \"unit\": \"%s\"}", comma, colour->name,
                        (double)colour->most, colour->unit);
        comma = ", ";
    }
    jox_text_add(out, "}");
}

/* ---- tools ---- */

enum { MOST_NAMES = 256 };

static uint32_t add_unique(const char **names, uint32_t count, const char *name) {
    for (uint32_t n = 0; n < count; n++)
        if (strcmp(names[n], name) == 0)
            return count;
    if (count < MOST_NAMES)
        names[count++] = name;
    return count;
}

/* What people may do: what the scene lets them, where there is something to do it with. */
static void add_tools(JoxText *out, const JoScene *scene) {
    const JoWorld *world = scene->world;
    const uint32_t allowed = scene->spec->view.tools;
    const char *walls[MOST_NAMES], *signals[MOST_NAMES];
    uint32_t wall_count = 0, signal_count = 0;
    for (uint32_t r = 0; r < world->all_walls.ring_count; r++)
        if (world->all_walls.rings[r].name)
            wall_count = add_unique(walls, wall_count, world->all_walls.rings[r].name);
    for (uint32_t m = 0; m < world->mind.machine_count; m++)
        for (uint32_t n = 0; n < world->mind.machines[m]->name_count; n++)
            if (world->mind.machines[m]->names[n].uses & JOX_NAME_HEARD)
                signal_count =
                    add_unique(signals, signal_count, world->mind.machines[m]->names[n].text);
    const bool offered[JOX_TOOL_COUNT] = {
        [JOX_TOOL_THROW] = jox_bodies_available(),
        [JOX_TOOL_DRAG] = jox_bodies_count(world->bodies) > 0,
        [JOX_TOOL_PUSH] = true,
        [JOX_TOOL_GATES] = wall_count > 0,
        [JOX_TOOL_PARAMETERS] = world->mind.machine_count > 0,
        [JOX_TOOL_SIGNALS] = signal_count > 0,
        [JOX_TOOL_PLAYER] = jox_live_player(scene) != JOX_NO_INDEX,
    };
    jox_text_add(out, ", \"tools\": {");
    for (int t = 0; t < JOX_TOOL_COUNT; t++)
        jox_text_printf(out, "%s\"%s\": %s", t ? ", " : "", jox_scene_tools[t],
                        offered[t] && (allowed >> t & 1) ? "true" : "false");
    if (offered[JOX_TOOL_PLAYER] && (allowed >> JOX_TOOL_PLAYER & 1))
        jox_text_printf(out, ", \"players\": [%u]", jox_live_player(scene));
    else
        jox_text_add(out, ", \"players\": []");
    add_names(out, "walls", walls, wall_count);
    add_names(out, "signal_names", signals, signal_count);
    jox_text_add(out, "}");
}

/* ---- the whole ---- */

void jox_live_add_camera(const JoxSceneSpec *spec, JoxText *out) {
    jox_text_add(out, ", \"camera\": ");
    if (!spec || !spec->camera.given) {
        jox_text_add(out, "null");
        return;
    }
    jox_text_add(out, "{");
    add_numbers(out, "at", spec->camera.position, 3);
    jox_text_add(out, ", ");
    add_numbers(out, "look", spec->camera.target, 3);
    jox_text_add(out, "}");
}

static void add_charts(JoxText *out, const JoxSceneSpec *spec) {
    const char *comma = "";
    jox_text_add(out, ", \"charts\": [");
    for (uint32_t p = 0; p < spec->probe_count; p++) {
        if (spec->probes[p].kind != JOX_PROBE_FLOW)
            continue;
        jox_text_add(out, comma);
        jox_text_json(out, spec->probes[p].name);
        comma = ", ";
    }
    jox_text_add(out, "]");
}

void jox_live_scene(JoScene *scene, JoxText *out) {
    const JoxLive *live = jox_live_of(scene);
    const JoxSceneSpec *spec = scene->spec;
    const JoWorld *world = scene->world;
    jox_text_add(out, "{\"type\": \"hello\", \"protocol\": 1, \"session\": \"live\", \"title\": ");
    jox_text_json(out, spec->title && *spec->title ? spec->title : spec->path);
    jox_text_add(out, ", \"file\": ");
    jox_text_json(out, spec->path);
    jox_text_printf(out,
                    ", \"dt\": %.9g, \"duration\": %.9g, \"seed\": %llu, \"area\": ", world->def.dt,
                    spec->duration, (unsigned long long)world->def.seed);
    add_points(out, (JoxV2[]){live->area.low, live->area.high}, 2);
    jox_text_add(out, ", \"walls\": ");
    jox_live_walls(&world->all_walls, JOX_WALL_HEIGHT, out);
    jox_live_add_places(world->places, scene->first_antipode, out);
    jox_live_add_regions(spec->regions, spec->region_count, out);
    add_groups(out, scene);
    jox_text_add(out, ", \"machines\": ");
    jox_run_graph(scene, out);
    add_bodies(out, world->bodies);
    add_tools(out, scene);
    jox_live_add_camera(spec, out);
    jox_live_add_colours(out);
    jox_text_printf(out, ", \"view\": {\"colour\": \"%s\", \"field\": \"%s\"}",
                    jox_live_colours[spec->view.colour].name,
                    jox_live_field_name((JoxLiveField)spec->view.field));
    add_charts(out, spec);
    jox_text_add(out, "}");
}

uint64_t jox_live_version(const JoScene *scene) {
    const JoWorld *world = scene->world;
    const JoxWalls *walls = &world->all_walls;
    JoxHash hash = jox_hash_begin();
    jox_hash_add(&hash, &scene->spec->view, sizeof scene->spec->view);
    jox_hash_add(&hash, scene->spec->camera.position, sizeof scene->spec->camera.position);
    jox_hash_add(&hash, scene->spec->camera.target, sizeof scene->spec->camera.target);
    for (uint32_t m = 0; m < world->mind.machine_count; m++)
        jox_hash_add(&hash, &world->mind.machines[m], sizeof world->mind.machines[m]);
    jox_hash_add(&hash, &world->mind.edits, sizeof world->mind.edits);
    for (uint32_t v = 0; v < walls->count; v++) /* opening and closing is in the status */
        jox_hash_add(&hash, &walls->vertices[v].point, sizeof(JoxV2));
    for (uint32_t p = 0; p < world->place_count; p++)
        jox_hash_add(&hash, world->places[p].points, world->places[p].count * sizeof(JoxV2));
    for (uint32_t row = 0; row < jox_bodies_rows(world->bodies); row++) {
        const uint32_t id = jox_bodies_id(world->bodies, row);
        JoxBodyBonds bonds;
        jox_bodies_bonds(world->bodies, row, &bonds);
        jox_hash_add(&hash, &id, sizeof id);
        jox_hash_add(&hash, &bonds.blocks, sizeof bonds.blocks);
    }
    return jox_hash_end(&hash);
}
