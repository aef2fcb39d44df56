/* What a live page is told of a recording. */
#include <math.h>
#include <string.h>

#include "live/replay_parts.h"

static const float BODY_SIZE = 0.4f; /* m: of a body whose shape nothing says */

static void add_names(JoxText *out, const JoxReplay *r) {
    const JoxReplayNames *n = &r->names;
    jox_text_add(out, ", \"groups\": [");
    for (uint32_t g = 0; g < r->info.group_count; g++) {
        jox_text_add(out, g ? ", " : "");
        jox_text_json(out, r->info.groups[g]);
    }
    jox_text_add(out, "], \"states\": [");
    for (uint32_t s = 0; s < n->state_count; s++) {
        jox_text_printf(out, "%s{\"machine\": %u, \"name\": ", s ? ", " : "", n->states[s].machine);
        jox_text_json(out, n->states[s].name);
        jox_text_add(out, "}");
    }
    jox_text_add(out, "], \"machines\": [");
    for (uint32_t m = 0; m < n->machine_count; m++) {
        const char *comma = "";
        jox_text_add(out, m ? ", {\"name\": " : "{\"name\": ");
        jox_text_json(out, n->machines[m]);
        jox_text_add(out, ", \"path\": \"\", \"version\": 0, \"start\": null, \"defaults\": [], "
                          "\"transitions\": [], \"states\": [");
        for (uint32_t s = 0; s < n->state_count; s++) {
            if (n->states[s].machine != m)
                continue;
            jox_text_printf(out, "%s{\"name\": ", comma);
            jox_text_json(out, n->states[s].name);
            jox_text_add(out, ", \"line\": 0, \"parameters\": []}");
            comma = ", ";
        }
        jox_text_add(out, "]}");
    }
    jox_text_add(out, "]");
}

/* A body of which nothing is known but where it is. */
static void add_unknown(JoxText *out) {
    const JoxBodyLook box = {.kind = JOX_SHAPE_BOX,
                             .size = {BODY_SIZE, BODY_SIZE, BODY_SIZE},
                             .turn = {0.0f, 0.0f, 0.0f, 1.0f}};
    jox_text_add(out, "{\"name\": null, \"mass\": 0, \"parts\": [");
    jox_live_add_part(&box, out);
    jox_text_add(out, "]}");
}

/* By the recording, else by the scene. */
static void add_bodies(JoxText *out, const JoxReplay *r) {
    jox_text_add(out, ", \"bodies\": [");
    for (uint32_t row = 0; row < r->row_count; row++) {
        const uint32_t id = r->body_id[row], frame = r->shown;
        const uint32_t known = r->bodies ? jox_bodies_find(r->bodies, id) : JOX_NO_BODY;
        JoxBodyLook look;
        jox_text_add(out, row ? ", " : "");
        if (frame == JOX_REPLAY_NOBODY ||
            !jox_trajectory_reader_part(r->reader, frame, id, 0, &look)) {
            if (known != JOX_NO_BODY)
                jox_live_body(r->bodies, known, out);
            else
                add_unknown(out);
            continue;
        }
        jox_text_add(out, "{\"name\": null, \"mass\": 0, \"parts\": [");
        for (uint32_t part = 0; jox_trajectory_reader_part(r->reader, frame, id, part, &look);
             part++) {
            jox_text_add(out, part ? ", " : "");
            jox_live_add_part(&look, out);
        }
        jox_text_add(out, "]}");
    }
    jox_text_add(out, "]");
}

void jox_replay_scene(const JoxReplay *r, JoxText *out) {
    const char *slash = strrchr(r->path, '/');
    const char *title = r->spec && r->spec->title && *r->spec->title ? r->spec->title
                        : slash                                      ? slash + 1
                                                                     : r->path;
    jox_text_add(out,
                 "{\"type\": \"hello\", \"protocol\": 1, \"session\": \"replay\", \"title\": ");
    jox_text_json(out, title);
    jox_text_add(out, ", \"file\": ");
    jox_text_json(out, r->path);
    jox_text_printf(out,
                    ", \"dt\": %.9g, \"duration\": %.9g, \"seed\": 0, "
                    "\"area\": [[%.7g, %.7g], [%.7g, %.7g]], \"walls\": ",
                    1.0 / r->info.fps, jox_replay_time(r, r->info.frames - 1),
                    (double)r->area.low.x, (double)r->area.low.y, (double)r->area.high.x,
                    (double)r->area.high.y);
    jox_live_walls(jox_replay_walls(r), JOX_WALL_HEIGHT, out);
    jox_live_add_places(r->spec ? r->spec->places : NULL, r->spec ? r->spec->place_count : 0, out);
    jox_live_add_regions(r->spec ? r->spec->regions : NULL, r->spec ? r->spec->region_count : 0,
                         out);
    add_names(out, r);
    add_bodies(out, r);
    jox_text_add(out, ", \"tools\": {");
    for (int t = 0; t < JOX_TOOL_COUNT; t++)
        jox_text_printf(out, "\"%s\": false, ", jox_scene_tools[t]);
    jox_text_add(out, "\"players\": [], \"walls\": [], \"signal_names\": []}");
    jox_live_add_camera(r->spec, out);
    jox_live_add_colours(out);
    jox_text_printf(out,
                    ", \"view\": {\"colour\": \"%s\", \"field\": \"%s\"}, "
                    "\"charts\": []}",
                    jox_live_colours[jox_replay_colour(r)].name,
                    jox_live_field_name(jox_replay_first_field(r)));
}

uint64_t jox_replay_version(const JoxReplay *r) {
    const uint32_t changes =
        r->shown == JOX_REPLAY_NOBODY ? 0 : jox_trajectory_reader_changes(r->reader, r->shown);
    return (uint64_t)changes << 32 | r->row_count;
}

static void add_census(JoxText *out, JoxReplay *r) {
    const JoxReplayNames *n = &r->names;
    memset(r->people, 0, n->state_count * sizeof *r->people);
    for (uint32_t i = 0; i < r->count; i++) {
        const uint32_t state = jox_replay_state(r, i);
        if (state < n->state_count)
            r->people[state]++;
    }
    jox_text_add(out, ", \"census\": [");
    for (uint32_t m = 0; m < n->machine_count; m++) {
        const char *comma = "";
        jox_text_add(out, m ? ", [" : "[");
        for (uint32_t s = 0; s < n->state_count; s++) {
            if (n->states[s].machine != m)
                continue;
            jox_text_printf(out, "%s%u", comma, r->people[s]);
            comma = ", ";
        }
        jox_text_add(out, "]");
    }
    jox_text_add(out, "], \"fired\": [");
    for (uint32_t m = 0; m < n->machine_count; m++)
        jox_text_add(out, m ? ", []" : "[]");
    jox_text_add(out, "]");
}

void jox_replay_status(JoxReplay *r, const JoxLiveSession *session, double factor, JoxText *out) {
    double speed = 0.0;
    for (uint32_t i = 0; i < r->count; i++)
        speed += (double)sqrtf(r->vx[i] * r->vx[i] + r->vy[i] * r->vy[i]);
    jox_replay_spread(r, false);
    jox_text_printf(out,
                    "{\"type\": \"status\", \"tick\": %u, \"time\": %.9g, \"paused\": %s, "
                    "\"speed\": %.9g, \"real_time_factor\": %.6g, \"agents\": %u, \"bodies\": %u",
                    r->shown == JOX_REPLAY_NOBODY ? 0 : r->shown, r->frame.time,
                    session->paused ? "true" : "false", session->speed, factor, r->count,
                    r->frame.body_count);
    add_census(out, r);
    jox_text_printf(out,
                    ", \"mean_speed\": %.6g, \"density_max\": %.6g, \"failures\": null, "
                    "\"stage_ns\": {}, \"flows\": {}, \"walls\": {}, \"dropped\": %llu}",
                    r->count ? speed / r->count : 0.0, (double)r->grid.most,
                    (unsigned long long)session->dropped);
}
