#include "live/replay.h"

#include <math.h>
#include <string.h>

#include "base/mem.h"
#include "live/replay_parts.h"

enum { MOST_BODIES = 1 << 20 };
static const float RADIUS = 0.2f;  /* m: recordings do not say it */
static const double LONGEST = 0.3; /* s over which displacements are taken for velocities */
static const float MARGIN = 2.0f;  /* m about everything */

/* ---- opening ---- */

static uint32_t find_machine(JoxReplayNames *n, const char *machine) {
    uint32_t m = 0;
    while (m < n->machine_count && strcmp(n->machines[m], machine) != 0)
        m++;
    if (m == n->machine_count)
        n->machines[n->machine_count++] = machine;
    return m;
}

static void number_names(JoxReplayNames *n, const JoxTrajectoryReaderInfo *info) {
    n->machines = jox_alloc(info->state_count + 1, sizeof *n->machines);
    n->states = jox_alloc(info->state_count + 1, sizeof *n->states);
    n->state_of = jox_alloc(info->state_count + 1, sizeof *n->state_of);
    for (uint32_t row = 0; row < info->state_count; row++) {
        const uint32_t machine = find_machine(n, info->states[row].machine);
        uint32_t s = 0;
        while (s < n->state_count && (n->states[s].machine != machine ||
                                      strcmp(n->states[s].name, info->states[row].name) != 0))
            s++;
        if (s == n->state_count) {
            n->states[s].machine = machine;
            n->states[s].name = info->states[row].name;
            n->state_count++;
        }
        n->state_of[row] = s;
    }
}

/* The shapes of the scene's bodies: they have the first ids, in their order. */
static void make_bodies(JoxReplay *r) {
    JoxBodiesDef def = jox_bodies_def();
    r->bodies = jox_bodies_create(&def);
    for (uint32_t b = 0; b < r->spec->body_count; b++) {
        JoxText why = {0};
        jox_bodies_add(r->bodies, &r->spec->bodies[b].def, &why);
        jox_text_free(&why);
    }
}

const JoxWalls *jox_replay_walls(const JoxReplay *r) {
    return r->spec ? &r->spec->walls : r->info.walls;
}

static void cover(JoxReplay *r) {
    const JoxWalls *walls = jox_replay_walls(r);
    JoxLiveArea all = {0};
    if (r->info.bounded)
        jox_live_cover(&all, r->info.low, r->info.high);
    for (uint32_t v = 0; v < walls->count; v++)
        jox_live_cover(&all, walls->vertices[v].point, walls->vertices[v].point);
    for (uint32_t p = 0; r->spec && p < r->spec->place_count; p++)
        for (uint32_t i = 0; i < r->spec->places[p].count; i++)
            jox_live_cover(&all, r->spec->places[p].points[i], r->spec->places[p].points[i]);
    JoxV2 edge = {MARGIN, MARGIN};
    jox_live_cover(&r->area, jox_sub(all.low, edge), jox_add(all.high, edge));
}

JoxReplay *jox_replay_open(const JoxReplayDef *def, JoxDiagnostics *diagnostics) {
    JoxReplay *r = jox_alloc(1, sizeof *r);
    JoxTrajectoryOptions options = def->options;
    r->path = jox_strdup(def->recording);
    r->shown = JOX_REPLAY_NOBODY;
    bool good = !def->scene || (r->spec = jox_scene_load(def->scene, NULL, diagnostics));
    if (r->spec && (r->spec->periodic_x || r->spec->periodic_y)) {
        JoxV2 size = jox_sub(r->spec->high, r->spec->low);
        options.period =
            (JoxV2){r->spec->periodic_x ? size.x : 0.0f, r->spec->periodic_y ? size.y : 0.0f};
    }
    good = good && (r->reader = jox_trajectory_reader_open(def->recording, &options, diagnostics));
    if (!good) {
        jox_replay_close(r);
        return NULL;
    }
    r->info = jox_trajectory_reader_info(r->reader);
    number_names(&r->names, &r->info);
    r->people = jox_alloc(r->names.state_count + 1, sizeof *r->people);
    if (r->spec && r->spec->body_count)
        make_bodies(r);
    cover(r);
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

static void widen(JoxReplay *r, uint32_t need) {
    if (need <= r->capacity)
        return;
    r->capacity = (size_t)need + need / 2 + 64;
    r->id = jox_realloc(r->id, r->capacity, sizeof *r->id);
    r->old_id = jox_realloc(r->old_id, r->capacity, sizeof *r->old_id);
    r->slot = jox_realloc(r->slot, r->capacity, sizeof *r->slot);
    r->old_slot = jox_realloc(r->old_slot, r->capacity, sizeof *r->old_slot);
    float **columns[] = {&r->vx, &r->vy, &r->x, &r->y};
    for (int c = 0; c < 4; c++)
        *columns[c] = jox_realloc(*columns[c], r->capacity, sizeof(float));
}

/* A slot for somebody new. */
static uint32_t take_slot(JoxReplay *r) {
    if (r->spare_count) {
        uint32_t slot = r->spare[--r->spare_count];
        r->parity[slot] ^= JOX_LIVE_PARITY;
        return slot;
    }
    if (r->slot_count == r->slot_capacity) {
        r->slot_capacity = r->slot_capacity ? 2 * r->slot_capacity : 256;
        r->parity = jox_realloc(r->parity, r->slot_capacity, sizeof *r->parity);
        r->spare = jox_realloc(r->spare, r->slot_capacity, sizeof *r->spare);
        r->last_x = jox_realloc(r->last_x, r->slot_capacity, sizeof *r->last_x);
        r->last_y = jox_realloc(r->last_y, r->slot_capacity, sizeof *r->last_y);
    }
    r->parity[r->slot_count] = JOX_LIVE_PARITY;
    return r->slot_count++;
}

static float shortest(float d, float period) {
    return period > 0.0f ? remainderf(d, period) : d;
}

/* Gives everybody of the frame a slot: that of the frame before, of which both lists ascend by id.
   `spent`: s since then; 0 where the frames are not neighbours. */
static void give_slots(JoxReplay *r, const JoxTrajectoryReaderFrame *f, double spent) {
    JoxV2 period = {0};
    if (r->spec && r->spec->periodic_x)
        period.x = r->spec->high.x - r->spec->low.x;
    if (r->spec && r->spec->periodic_y)
        period.y = r->spec->high.y - r->spec->low.y;
    int64_t *ids = r->old_id;
    uint32_t *slots = r->old_slot, before = r->count, k = 0;
    r->old_id = r->id;
    r->old_slot = r->slot;
    r->id = ids;
    r->slot = slots;
    for (uint32_t i = 0; i < f->count; i++) { /* who left frees the slot before anyone takes it */
        while (k < before && r->old_id[k] < f->id[i])
            r->spare[r->spare_count++] = r->old_slot[k++];
        bool stays = k < before && r->old_id[k] == f->id[i];
        r->slot[i] = stays ? r->old_slot[k++] : JOX_REPLAY_NOBODY;
    }
    while (k < before)
        r->spare[r->spare_count++] = r->old_slot[k++];
    for (uint32_t i = 0; i < f->count; i++) {
        bool fresh = r->slot[i] == JOX_REPLAY_NOBODY;
        if (fresh)
            r->slot[i] = take_slot(r);
        const uint32_t s = r->slot[i];
        bool moved = !fresh && spent > 0.0;
        bool round = fabsf(f->x[i] - r->last_x[s]) > 0.5f * period.x && period.x > 0.0f;
        round |= fabsf(f->y[i] - r->last_y[s]) > 0.5f * period.y && period.y > 0.0f;
        if (!fresh && round) /* an edge: nobody flies across */
            r->parity[s] ^= JOX_LIVE_PARITY;
        r->vx[i] = moved ? shortest(f->x[i] - r->last_x[s], period.x) / (float)spent : 0.0f;
        r->vy[i] = moved ? shortest(f->y[i] - r->last_y[s], period.y) / (float)spent : 0.0f;
        r->last_x[s] = r->x[i] = f->x[i];
        r->last_y[s] = r->y[i] = f->y[i];
        r->id[i] = f->id[i];
    }
    r->count = f->count;
}

static void note_bodies(JoxReplay *r, const JoxTrajectoryReaderFrame *f) {
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
        r->body_id[r->row_count] = id;
        r->row_of[id] = r->row_count++;
    }
}

void jox_replay_forget(JoxReplay *r) {
    r->frame = (JoxTrajectoryReaderFrame){.time = r->frame.time};
    give_slots(r, &r->frame, 0.0);
    r->timed = false;
    r->shown = JOX_REPLAY_NOBODY;
    r->spread = false;
}

/* s from the frame that is shown to one that follows it, the next or a near one; else 0. */
static double since(const JoxReplay *r, uint32_t frame) {
    if (r->shown == JOX_REPLAY_NOBODY || frame <= r->shown)
        return 0.0;
    const double spent = jox_trajectory_reader_time(r->reader, frame) -
                         jox_trajectory_reader_time(r->reader, r->shown);
    return frame == r->shown + 1 || spent <= LONGEST ? spent : 0.0;
}

static bool take(JoxReplay *r, uint32_t frame, JoxText *why) {
    const double spent = since(r, frame);
    if (!jox_trajectory_reader_read(r->reader, frame, &r->frame, why)) {
        jox_replay_forget(r);
        return false;
    }
    widen(r, r->frame.count);
    give_slots(r, &r->frame, spent);
    note_bodies(r, &r->frame);
    r->shown = frame;
    r->timed = spent > 0.0;
    r->spread = false;
    return true;
}

bool jox_replay_show(JoxReplay *r, uint32_t frame, JoxText *why) {
    /* Speeds are those since the frame before, which may have to be read for them. */
    if (frame > 0 && since(r, frame) == 0.0 && !take(r, frame - 1, why))
        return false;
    return take(r, frame, why);
}

void jox_replay_spread(JoxReplay *r, bool moves) {
    if (r->spread && (r->moves || !moves))
        return;
    JoxV2 low = r->area.low, high = r->area.high;
    for (uint32_t i = 0; i < r->count; i++) {
        low = (JoxV2){jox_minf(low.x, r->x[i]), jox_minf(low.y, r->y[i])};
        high = (JoxV2){jox_maxf(high.x, r->x[i]), jox_maxf(high.y, r->y[i])};
    }
    jox_live_cover(&r->area, low, high);
    const JoxLiveCrowd crowd = {.count = r->count, .x = r->x, .y = r->y, .vx = r->vx, .vy = r->vy};
    jox_live_spread(&r->grid, &r->area, &crowd, moves);
    r->spread = true;
    r->moves = moves;
}

static float colour_of(const JoxReplay *r, uint32_t i, JoxLiveColour colour) {
    const JoxTrajectoryReaderFrame *f = &r->frame;
    switch (colour) {
    case JOX_LIVE_COLOUR_speed:
        return sqrtf(r->vx[i] * r->vx[i] + r->vy[i] * r->vy[i]);
    case JOX_LIVE_COLOUR_force:
        return f->force ? f->force[i] : 0.0f;
    case JOX_LIVE_COLOUR_compression:
        return f->compression ? f->compression[i] : 0.0f;
    case JOX_LIVE_COLOUR_density:
        return jox_live_density_at(&r->grid, r->x[i], r->y[i]);
    case JOX_LIVE_COLOUR_group:
        return f->group ? f->group[i] : 0.0f;
    default:
        return 0.0f;
    }
}

uint32_t jox_replay_state(const JoxReplay *r, uint32_t i) {
    const JoxTrajectoryReaderFrame *f = &r->frame;
    const uint32_t row = f->state ? f->state[i] : JOX_REEL_NO_STATE;
    return row == JOX_REEL_NO_STATE ? UINT32_MAX : r->names.state_of[row];
}

void jox_replay_frame(JoxReplay *r, JoxLiveColour colour, JoxBytes *out) {
    static const float STRAIGHT[4] = {0.0f, 0.0f, 0.0f, 1.0f};
    const JoxTrajectoryReaderFrame *f = &r->frame;
    jox_replay_spread(r, false);
    JoxLiveHead head = {.tick = r->shown == JOX_REPLAY_NOBODY ? 0 : r->shown,
                        .time = f->time,
                        .slots = r->slot_count,
                        .bodies = r->row_count,
                        .area = &r->area,
                        .most = jox_live_colours[colour].most};
    jox_live_begin_frame(out, &head);
    const float scale = head.most > 0.0f ? 1.0f / head.most : 0.0f;
    for (uint32_t i = 0; i < r->count; i++) {
        bool faces = f->face_x && (f->face_x[i] != 0.0f || f->face_y[i] != 0.0f);
        uint32_t state = jox_replay_state(r, i);
        jox_live_put_person(
            out, &r->area, r->slot[i],
            &(JoxLivePerson){r->x[i], r->y[i], faces ? f->face_x[i] : r->vx[i],
                             faces ? f->face_y[i] : r->vy[i], colour_of(r, i, colour) * scale,
                             (uint8_t)(state < JOX_LIVE_OTHER_STATE ? state : JOX_LIVE_OTHER_STATE),
                             r->parity[r->slot[i]]});
    }
    for (uint32_t row = 0; row < r->row_count; row++)
        jox_live_put_body(out, r->slot_count, row, (JoxV3){0.0f, 0.0f, -1000.0f}, STRAIGHT);
    for (uint32_t b = 0; b < f->body_count; b++) {
        const JoxRecordBody *body = &f->bodies[b];
        const float turn[4] = {body->qx, body->qy, body->qz, body->qw};
        if (body->id < MOST_BODIES)
            jox_live_put_body(out, r->slot_count, r->row_of[body->id],
                              (JoxV3){body->x, body->y, body->z}, turn);
    }
}

bool jox_replay_people(const JoxReplay *r, JoxBytes *out) {
    bool differs = false;
    size_t before = out->length;
    jox_live_begin_people(out, r->slot_count);
    for (uint32_t i = 0; i < r->count; i++)
        differs |=
            jox_live_put_people(out, r->slot[i], RADIUS, r->frame.group ? r->frame.group[i] : 0u);
    return differs || out->length != before;
}

void jox_replay_field(JoxReplay *r, JoxLiveField field, JoxBytes *out) {
    jox_replay_spread(r, field == JOX_LIVE_PRESSURE);
    jox_live_pack_field(&r->grid, field, out);
}

JoxLiveColour jox_replay_colour(const JoxReplay *r) {
    if (r->spec)
        return (JoxLiveColour)r->spec->view.colour;
    return r->names.state_count ? JOX_LIVE_COLOUR_state : JOX_LIVE_COLOUR_speed;
}

JoxLiveField jox_replay_first_field(const JoxReplay *r) {
    return r->spec ? (JoxLiveField)r->spec->view.field : JOX_LIVE_FIELDS;
}

void jox_replay_close(JoxReplay *r) {
    if (!r)
        return;
    jox_trajectory_reader_close(r->reader);
    jox_scene_free(r->spec);
    if (r->bodies)
        jox_bodies_free(r->bodies);
    jox_live_free_grid(&r->grid);
    void *owned[] = {r->path,
                     r->names.machines,
                     r->names.states,
                     r->names.state_of,
                     r->id,
                     r->old_id,
                     r->slot,
                     r->old_slot,
                     r->vx,
                     r->vy,
                     r->x,
                     r->y,
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
