/* Frames of a recording for the live page: opening, reading a frame, packing its people, bodies and
   fields. replay_page.c decides which frame is shown. */
#include "live/replay.h"

#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "live/replay_parts.h"

/* Ids beyond these are left out: of bodies; of people, for crowd pressure. */
enum { MOST_BODIES = 1 << 20, MOST_KEYS = 1 << 24 };
static const double LONGEST = 0.3; /* s between frames whose displacements give velocities */
static const float MARGIN = 2.0f;  /* m around walls and places */

/* ---- opening ---- */

/* Returns the index of a machine's name, which is added if it is new. */
static uint32_t number_machine_name(JoxReplayNames *n, const char *machine) {
    uint32_t m = 0;
    while (m < n->machine_count && strcmp(n->machines[m], machine) != 0)
        m++;
    if (m == n->machine_count)
        n->machines[n->machine_count++] = machine;
    return m;
}

/* Lists the recording's machines and states by name, each once. */
static void number_names(JoxReplayNames *n, const JoxTrajectoryReaderInfo *info) {
    n->machines = jox_alloc(info->state_count + 1, sizeof *n->machines);
    n->states = jox_alloc(info->state_count + 1, sizeof *n->states);
    n->lies = jox_alloc(info->state_count + 1, sizeof *n->lies);
    n->state_of = jox_alloc(info->state_count + 1, sizeof *n->state_of);
    for (uint32_t row = 0; row < info->state_count; row++) {
        const uint32_t machine = number_machine_name(n, info->states[row].machine);
        uint32_t s = 0;
        while (s < n->state_count && (n->states[s].machine != machine ||
                                      strcmp(n->states[s].name, info->states[row].name) != 0))
            s++;
        if (s == n->state_count) {
            n->states[s] = (JoxLiveNamed){.name = info->states[row].name, .machine = machine};
            n->state_count++;
        }
        n->states[s].given = info->states[row].colour; /* the last reload's counts */
        n->lies[s] = info->states[row].lies;
        n->states[s].pose = jox_poses[info->states[row].pose];
        n->state_of[row] = s;
    }
}

/* Makes the scene's bodies, for their shapes. Their ids are those of a run: 0, 1, ... in order. */
static void make_bodies(JoxReplay *r) {
    JoxBodiesDef def = jox_bodies_def();
    r->bodies = jox_bodies_create(&def);
    for (uint32_t b = 0; b < r->spec->body_count; b++) {
        JoxText why = {0};
        jox_bodies_add(r->bodies, &r->spec->bodies[b].def, &why);
        jox_text_free(&why);
    }
}

static uint32_t choose_shown_frame(const JoxReplay *r) {
    return r->shown == JOX_REPLAY_NOBODY ? 0 : r->shown;
}

const JoxWalls *jox_replay_walls(const JoxReplay *r) {
    return r->spec && !r->info.has_walls
               ? &r->spec->walls
               : jox_trajectory_reader_walls(r->reader, choose_shown_frame(r));
}

/* Walls that stand in the shown frame: without open gates. */
static const JoxWalls *find_standing_walls(const JoxReplay *r) {
    return r->spec && !r->info.has_walls
               ? &r->spec->walls
               : jox_trajectory_reader_standing(r->reader, choose_shown_frame(r));
}

/* Extends the area to hold the recording's bounds, walls and places. */
static void cover_recording(JoxReplay *r) {
    const JoxWalls *walls = jox_replay_walls(r);
    const JoxStoreys *storeys = jox_has_storeys(r->info.storeys) ? r->info.storeys : NULL;
    JoxLiveArea all = {.storeys = storeys};
    r->area.storeys = storeys;
    if (r->info.bounded)
        jox_live_cover(&all, r->info.low, r->info.high);
    for (uint32_t v = 0; v < walls->count; v++)
        jox_live_cover(&all, walls->vertices[v].point, walls->vertices[v].point);
    for (uint32_t p = 0; p < r->look.place_count; p++)
        for (uint32_t i = 0; i < r->look.places[p].count; i++)
            jox_live_cover(&all, r->look.places[p].points[i], r->look.places[p].points[i]);
    JoxV2 edge = {MARGIN, MARGIN};
    jox_live_cover(&r->area, jox_sub(all.low, edge), jox_add(all.high, edge));
}

/* Takes what is shown besides people from the scene, else from the recording. */
static void choose_look(JoxReplay *r, JoxDiagnostics *diagnostics) {
    const JoxPosition at = {r->path, 0, 0, 0};
    r->look = jox_scene_look(r->spec);
    if (!r->spec && r->info.look && !jox_scene_read_look(r->info.look, &r->look))
        jox_diag_warn(diagnostics, at, "bad-recording", "Give the scene by --scene",
                      "what it has of its scene's looks is damaged, and is not shown");
}

JoxReplay *jox_replay_open(const JoxReplayDef *def, JoxDiagnostics *diagnostics) {
    JoxReplay *r = jox_alloc(1, sizeof *r);
    JoxTrajectoryOptions options = def->options;
    r->path = jox_strdup(def->recording);
    r->shown = JOX_REPLAY_NOBODY;
    bool good = !def->scene || (r->spec = jox_scene_read(def->scene, NULL, diagnostics));
    if (r->spec && (r->spec->periodic_x || r->spec->periodic_y)) {
        JoxV2 size = jox_sub(r->spec->high, r->spec->low);
        r->period =
            (JoxV2){r->spec->periodic_x ? size.x : 0.0f, r->spec->periodic_y ? size.y : 0.0f};
        options.period = r->period;
    }
    good = good && (r->reader = jox_trajectory_reader_open(def->recording, &options, diagnostics));
    if (!good) {
        jox_replay_close(r);
        return NULL;
    }
    r->info = jox_trajectory_reader_info(r->reader);
    choose_look(r, diagnostics);
    number_names(&r->names, &r->info);
    r->people = jox_alloc(r->names.state_count + 1, sizeof *r->people);
    if (r->spec && r->spec->body_count)
        make_bodies(r);
    cover_recording(r);
    return r;
}

uint32_t jox_replay_frames(const JoxReplay *r) {
    return r->info.frames;
}

double jox_replay_time(const JoxReplay *r, uint32_t frame) {
    return jox_trajectory_reader_time(r->reader, frame);
}

uint32_t jox_replay_find(const JoxReplay *r, double time) {
    return jox_trajectory_reader_find(r->reader, time);
}

/* ---- frames ---- */

/* Gives a row to each body of a frame whose id is new. */
static void number_body_rows(JoxReplay *r, const JoxTrajectoryReaderFrame *f) {
    for (uint32_t b = 0; b < f->body_count; b++) {
        const uint32_t id = f->bodies[b].id;
        const size_t had = r->row_of_capacity;
        if (id >= MOST_BODIES)
            continue;
        JOX_RESERVE(r->row_of, r->row_of_capacity, (size_t)id + 1);
        for (size_t n = had; n < r->row_of_capacity; n++)
            r->row_of[n] = JOX_REPLAY_NOBODY;
        if (r->row_of[id] != JOX_REPLAY_NOBODY)
            continue;
        JOX_RESERVE(r->body_id, r->body_capacity, r->row_count + 1);
        JOX_ASSERT(r->row_count < r->body_capacity);
        r->body_id[r->row_count] = id;
        r->row_of[id] = r->row_count++;
    }
}

void jox_replay_forget(JoxReplay *r) {
    r->frame = (JoxTrajectoryReaderFrame){.time = r->frame.time};
    jox_replay_give_slots(r, &r->frame, 0.0);
    r->timed = false;
    r->shown = JOX_REPLAY_NOBODY;
    r->spread = false;
}

/* Returns the time from the shown frame to `frame`, s, if that is the next frame or follows within
   LONGEST; else 0. */
static double measure_time_since_shown(const JoxReplay *r, uint32_t frame) {
    if (r->shown == JOX_REPLAY_NOBODY || frame <= r->shown)
        return 0.0;
    const double spent = jox_trajectory_reader_time(r->reader, frame) -
                         jox_trajectory_reader_time(r->reader, r->shown);
    return frame == r->shown + 1 || spent <= LONGEST ? spent : 0.0;
}

/* Reads a frame and makes it the shown one; false with the reason in `why`, and nobody is shown. */
static bool read_recorded_frame(JoxReplay *r, uint32_t frame, JoxText *why) {
    const double spent = measure_time_since_shown(r, frame);
    if (!jox_trajectory_reader_read(r->reader, frame, &r->frame, why)) {
        jox_replay_forget(r);
        return false;
    }
    jox_replay_reserve(r, r->frame.count);
    jox_replay_give_slots(r, &r->frame, spent);
    number_body_rows(r, &r->frame);
    r->shown = frame;
    r->timed = spent > 0.0;
    r->spread = false;
    return true;
}

bool jox_replay_show(JoxReplay *r, uint32_t frame, JoxText *why) {
    /* Velocities need a frame shortly before this one; after a jump it is read first. */
    if (frame > 0 && measure_time_since_shown(r, frame) == 0.0 &&
        !read_recorded_frame(r, frame - 1, why))
        return false;
    return read_recorded_frame(r, frame, why);
}

/* Returns the shown people as columns; states, flags and values are still NULL. */
static JoxLiveCrowd list_recorded_crowd(const JoxReplay *r) {
    return (JoxLiveCrowd){.count = r->count,
                          .slots = r->slot_count,
                          .slot = r->slot,
                          .x = r->x,
                          .y = r->y,
                          .vx = r->vx,
                          .vy = r->vy,
                          .face_x = r->frame.face_x,
                          .face_y = r->frame.face_y,
                          .group = r->frame.group,
                          .radius = r->frame.radius,
                          .axis_x = r->frame.axis_x,
                          .axis_y = r->frame.axis_y,
                          .contact_radius = r->frame.contact_radius,
                          .period = r->period,
                          .walls = find_standing_walls(r),
                          .storeys = r->area.storeys,
                          .lifts = r->info.lifts,
                          .cars = jox_trajectory_reader_cars(r->reader, choose_shown_frame(r)),
                          .lift_count = r->info.lift_count};
}

void jox_replay_spread(JoxReplay *r) {
    const JoxLiveCrowd crowd = list_recorded_crowd(r);
    if (r->spread)
        return;
    jox_live_spread(&r->grid, &r->area, &crowd);
    r->spread = true;
}

double jox_replay_speed(const JoxReplay *r) {
    const JoxLiveCrowd crowd = list_recorded_crowd(r);
    return r->timed && r->count ? jox_live_mean_speed(&crowd) : NAN;
}

uint32_t jox_replay_state(const JoxReplay *r, uint32_t i) {
    const JoxTrajectoryReaderFrame *f = &r->frame;
    const uint32_t row = f->state ? f->state[i] : JOX_NO_RECORDED_STATE;
    JOX_ASSERT(i < r->count && (row == JOX_NO_RECORDED_STATE || row < r->info.state_count));
    return row == JOX_NO_RECORDED_STATE ? UINT32_MAX : r->names.state_of[row];
}

static const float *fill_densities(JoxReplay *r) {
    for (uint32_t i = 0; i < r->count; i++)
        r->density[i] = jox_live_density_at(&r->grid, r->x[i], r->y[i]);
    return r->density;
}

/* Writes the bodies of the shown frame. Rows of bodies that are not in it get a place far below the
   floor. */
static void pack_recorded_bodies(const JoxReplay *r, JoxBytes *out) {
    static const float STRAIGHT[4] = {0.0f, 0.0f, 0.0f, 1.0f};
    const JoxTrajectoryReaderFrame *f = &r->frame;
    for (uint32_t row = 0; row < r->row_count; row++)
        jox_live_put_body(out, r->slot_count, row, (JoxV3){0.0f, 0.0f, -1000.0f}, STRAIGHT);
    for (uint32_t b = 0; b < f->body_count; b++) {
        const JoxRecordBody *body = &f->bodies[b];
        const float turn[4] = {body->qx, body->qy, body->qz, body->qw};
        if (body->id >= MOST_BODIES)
            continue;
        JOX_ASSERT(r->row_of[body->id] < r->row_count);
        jox_live_put_body(out, r->slot_count, r->row_of[body->id],
                          (JoxV3){body->x, body->y, body->z}, turn);
    }
}

void jox_replay_frame(JoxReplay *r, JoxLiveColour colour, JoxLiveScales *scales, JoxBytes *out) {
    JoxLiveCrowd crowd = list_recorded_crowd(r);
    jox_replay_spread(r);
    for (uint32_t i = 0; i < r->count; i++) {
        const uint32_t state = jox_replay_state(r, i);
        r->state[i] = (uint8_t)(state < JOX_LIVE_OTHER_STATE ? state : JOX_LIVE_OTHER_STATE);
        const bool lies = (r->frame.fallen && r->frame.fallen[i] > 0.0f) ||
                          (state < r->names.state_count && r->names.lies[state]);
        r->flags[i] = (uint8_t)(r->parity[r->slot[i]] | (lies ? JOX_LIVE_LIES : 0));
    }
    crowd.state = r->state;
    crowd.flags = r->flags;
    crowd.value = colour == JOX_LIVE_COLOUR_force         ? r->frame.force
                  : colour == JOX_LIVE_COLOUR_compression ? r->frame.compression
                  : colour == JOX_LIVE_COLOUR_load        ? r->frame.load
                  : colour == JOX_LIVE_COLOUR_density     ? fill_densities(r)
                  : colour == JOX_LIVE_COLOUR_service     ? fill_densities(r)
                                                          : NULL;
    const JoxLiveHead head = {.tick = r->shown == JOX_REPLAY_NOBODY ? 0 : r->shown,
                              .time = r->frame.time,
                              .bodies = r->row_count,
                              .area = &r->area,
                              .scales = scales};
    jox_live_pack_frame(&head, &crowd, colour, out);
    pack_recorded_bodies(r, out);
    jox_live_add_cars(out, jox_trajectory_reader_cars(r->reader, choose_shown_frame(r)),
                      r->info.lift_count);
}

bool jox_replay_people(const JoxReplay *r, JoxBytes *out) {
    const JoxLiveCrowd crowd = list_recorded_crowd(r);
    return jox_live_pack_people(&crowd, out);
}

/* Adds the shown frame to the samples of crowd pressure, if one is due. People whose id is negative
   or too large to be a key are left out. */
static void sample_pressure(JoxReplay *r) {
    JoxFrame frame = {.time = r->frame.time,
                      .period = r->period,
                      .count = r->count,
                      .x = r->x,
                      .y = r->y,
                      .vx = r->vx,
                      .vy = r->vy,
                      .walls = find_standing_walls(r),
                      .storeys = r->area.storeys};
    if (!r->local) {
        r->local = jox_local_create(r->area.low, r->area.high, r->area.storeys);
        jox_local_enable_pressure(r->local);
    }
    if (r->shown == JOX_REPLAY_NOBODY || !jox_local_is_due(r->local, frame.time))
        return;
    JOX_RESERVE(r->key, r->key_capacity, r->count + 1);
    for (uint32_t i = 0; i < r->count; i++) {
        r->flags[i] = r->id[i] >= 0 && r->id[i] < MOST_KEYS;
        r->key[i] = r->flags[i] ? (uint32_t)r->id[i] : 0;
        frame.keys = r->key[i] + 1 > frame.keys ? r->key[i] + 1 : frame.keys;
    }
    frame.key = r->key;
    jox_local_frame(r->local, &frame, r->flags);
}

void jox_replay_field(JoxReplay *r, JoxLiveField field, JoxLiveScales *scales, JoxBytes *out) {
    if (field == JOX_LIVE_PRESSURE) {
        sample_pressure(r);
        jox_live_pack_field(r->local->grid, jox_pressure_now(r->local->pressure), field, scales,
                            out);
        return;
    }
    jox_replay_spread(r);
    jox_live_pack_field(r->grid.grid, r->grid.grid->now, field, scales, out);
}

JoxLiveColour jox_replay_colour(const JoxReplay *r) {
    const char *name =
        jox_scene_choose_colouring(r->look.colour, r->names.state_count, r->info.group_count);
    return (JoxLiveColour)jox_live_colour(name);
}

JoxLiveField jox_replay_first_field(const JoxReplay *r) {
    return (JoxLiveField)r->look.field;
}

void jox_replay_close(JoxReplay *r) {
    if (!r)
        return;
    jox_trajectory_reader_close(r->reader);
    jox_scene_free_look(&r->look);
    jox_scene_free(r->spec);
    if (r->bodies)
        jox_bodies_free(r->bodies);
    jox_live_free_grid(&r->grid);
    jox_local_free(r->local);
    void *owned[] = {r->path,
                     r->names.machines,
                     r->names.states,
                     r->names.lies,
                     r->names.state_of,
                     r->id,
                     r->old_id,
                     r->slot,
                     r->old_slot,
                     r->vx,
                     r->vy,
                     r->x,
                     r->y,
                     r->density,
                     r->state,
                     r->flags,
                     r->key,
                     r->parity,
                     r->spare,
                     r->last_x,
                     r->last_y,
                     r->row_of,
                     r->body_id,
                     r->people};
    for (size_t o = 0; o < sizeof owned / sizeof *owned; o++)
        jox_free(owned[o]);
    jox_free(r);
}
