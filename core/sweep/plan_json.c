/* Writes the plan of a scene as JSON, so that the results of a sweep can be drawn without its
   scene. compare/side_plan.c reads it. */

#include "base/format/json_writer.h"
#include "base/format/path.h"
#include "base/mem.h"
#include "picture/draw.h"
#include "run/present_frame.h"
#include "run/run.h"
#include "sweep/sweep.h"

static void put_points(JoxJson *json, const JoxV2 *points, uint32_t count) {
    jox_json_array(json, "points");
    for (uint32_t p = 0; p < count; p++) {
        jox_json_digits(json, NULL, (double)points[p].x, 9);
        jox_json_digits(json, NULL, (double)points[p].y, 9);
    }
    jox_json_end(json);
}

void jox_sweep_put_walls(JoxJson *json, const JoxWalls *walls) {
    jox_json_array(json, "walls");
    for (uint32_t r = 0; r < walls->ring_count; r++) {
        bool closed, twin;
        const uint32_t count = jox_walls_given(walls, r, &closed, &twin);
        JoxV2 *points = jox_walls_ring_points(walls, r);
        jox_json_object(json, NULL);
        jox_json_string(json, "name", walls->rings[r].name ? walls->rings[r].name : "");
        jox_json_bool(json, "solid", walls->rings[r].solid);
        jox_json_bool(json, "closed", closed);
        jox_json_bool(json, "open", walls->rings[r].open);
        put_points(json, points, count);
        jox_json_end(json);
        jox_free(points);
        r += twin;
    }
    jox_json_end(json);
}

void jox_sweep_put_storeys(JoxJson *json, const JoxStoreys *storeys) {
    if (!jox_has_storeys(storeys))
        return;
    jox_json_numbers_of(json, "sheets",
                        (const double[]){(double)storeys->origin, (double)storeys->pitch}, 2, 9);
    jox_json_array(json, "storeys");
    for (uint32_t k = 0; k < storeys->storey_count; k++) {
        jox_json_object(json, NULL);
        jox_json_string(json, "name", storeys->storeys[k].name);
        jox_json_digits(json, "height", (double)storeys->storeys[k].height, 9);
        jox_json_end(json);
    }
    jox_json_end(json);
    jox_json_array(json, "stairs");
    for (uint32_t k = 0; k < storeys->stair_count; k++) {
        const JoxStair *stair = &storeys->stairs[k];
        jox_json_object(json, NULL);
        jox_json_string(json, "name", stair->name);
        jox_json_whole(json, "form", stair->kind);
        jox_json_whole(json, "way", stair->way);
        jox_json_whole(json, "lower", stair->lower);
        jox_json_whole(json, "upper", stair->upper);
        jox_json_digits(json, "width", (double)stair->width, 9);
        jox_json_digits(json, "rise", (double)stair->rise, 9);
        put_points(json, stair->path, stair->path_count);
        jox_json_array(json, "landings");
        for (uint32_t l = 0; l < stair->landing_count; l++) {
            jox_json_digits(json, NULL, (double)stair->landings[l].from, 9);
            jox_json_digits(json, NULL, (double)stair->landings[l].to, 9);
        }
        jox_json_end(json);
        jox_json_end(json);
    }
    jox_json_end(json);
}

static void put_plan_probes(JoxJson *json, const JoxSceneSpec *spec) {
    static const char *const KINDS[JOX_PROBE_KINDS] = {[JOX_PROBE_FLOW] = "flow",
                                                       [JOX_PROBE_MEASURE] = "measure",
                                                       [JOX_PROBE_TRANSIT] = "transit"};
    jox_json_array(json, "probes");
    for (uint32_t p = 0; p < spec->probe_count; p++) {
        const JoxProbeDef *probe = &spec->probes[p];
        if (!KINDS[probe->kind])
            continue; /* kinds that measure no particular place */
        jox_json_object(json, NULL);
        jox_json_string(json, "name", probe->name);
        jox_json_string(json, "kind", KINDS[probe->kind]);
        put_points(json, probe->points, probe->count);
        jox_json_end(json);
    }
    jox_json_end(json);
}

/* Writes a disc as its centre and radius, other parts as their outlines. */
static void put_plan_bodies(JoxJson *json, const JoxBodies *bodies) {
    JoxDrawnBodies drawn = {0};
    jox_draw_add_bodies(&drawn, bodies);
    jox_json_array(json, "bodies");
    for (size_t b = 0; b < drawn.count; b++) {
        const JoxDrawnBody *part = &drawn.items[b];
        jox_json_object(json, NULL);
        jox_json_bool(json, "high", part->high);
        jox_json_number(json, "radius", (double)part->radius);
        put_points(json, part->count ? part->ring : &part->at, part->count ? part->count : 1);
        jox_json_end(json);
    }
    jox_json_end(json);
    jox_free(drawn.items);
}

/* Writes what the scene states for the title block of reports. */
static void put_plan_report(JoxJson *json, const JoxSceneReport *report) {
    const struct {
        const char *key, *text;
    } texts[] = {{"author", report->author},
                 {"organisation", report->organisation},
                 {"project", report->project},
                 {"reference", report->reference},
                 {"checked_by", report->checked_by},
                 {"approved_by", report->approved_by},
                 {"date", report->date}};
    jox_json_object(json, "report");
    for (size_t t = 0; t < sizeof texts / sizeof *texts; t++)
        if (texts[t].text)
            jox_json_string(json, texts[t].key, texts[t].text);
    jox_json_end(json);
}

void jox_sweep_write_plan(const JoScene *scene, JoxText *out) {
    const JoxSceneSpec *spec = scene->spec;
    JoxV2 low, high;
    JoxJson json = jox_json_begin(out, 0);
    const JoxStoreys *storeys = jox_run_find_plan_area(scene, &low, &high);
    jox_json_object(&json, NULL);
    jox_json_string(&json, "title", spec->title ? spec->title : jox_path_name(spec->path));
    put_plan_report(&json, &spec->report);
    jox_json_numbers_of(
        &json, "area",
        (const double[]){(double)low.x, (double)low.y, (double)high.x, (double)high.y}, 4, 9);
    jox_sweep_put_storeys(&json, storeys);
    jox_sweep_put_walls(&json, &scene->world->model.all_walls);
    jox_json_array(&json, "places");
    for (uint32_t p = 0; p < spec->place_count; p++) {
        jox_json_object(&json, NULL);
        jox_json_string(&json, "name", spec->places[p].name);
        jox_json_string(&json, "kind", jox_place_kinds[spec->places[p].kind].name);
        jox_json_number(&json, "radius", (double)spec->places[p].radius);
        put_points(&json, spec->places[p].points, spec->places[p].count);
        jox_json_end(&json);
    }
    jox_json_end(&json);
    put_plan_probes(&json, spec);
    put_plan_bodies(&json, scene->world->state.bodies);
    jox_json_end(&json);
}
