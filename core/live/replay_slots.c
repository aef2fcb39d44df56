/* Slots of the people of a recording: a person who is in two frames that follow each other has the
   same slot in both, so that the page draws one person moving. */
#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "live/replay_parts.h"

void jox_replay_reserve(JoxReplay *r, uint32_t need) {
    if (need <= r->capacity)
        return;
    r->capacity = (size_t)need + need / 2 + 64;
    r->id = jox_realloc(r->id, r->capacity, sizeof *r->id);
    r->old_id = jox_realloc(r->old_id, r->capacity, sizeof *r->old_id);
    r->slot = jox_realloc(r->slot, r->capacity, sizeof *r->slot);
    r->old_slot = jox_realloc(r->old_slot, r->capacity, sizeof *r->old_slot);
    r->state = jox_realloc(r->state, r->capacity, sizeof *r->state);
    r->flags = jox_realloc(r->flags, r->capacity, sizeof *r->flags);
    float **columns[] = {&r->vx, &r->vy, &r->x, &r->y, &r->density};
    for (int c = 0; c < 5; c++)
        *columns[c] = jox_realloc(*columns[c], r->capacity, sizeof(float));
}

/* Returns a slot for a new person: a free one with its parity flipped, else one more. */
static uint32_t take_free_slot(JoxReplay *r) {
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

/* Returns a displacement over the shorter way, without whole pitches between the sheets of storeys.
 */
static float wrap_displacement(float d, float period) {
    return period > 0.0f ? remainderf(d, period) : d;
}

void jox_replay_give_slots(JoxReplay *r, const JoxTrajectoryReaderFrame *f, double spent) {
    const JoxStoreys *storeys = r->info.storeys;
    const JoxV2 period = {r->period.x, jox_has_storeys(storeys) ? storeys->pitch : r->period.y};
    int64_t *ids = r->old_id;
    uint32_t *slots = r->old_slot, before = r->count, k = 0;
    r->old_id = r->id;
    r->old_slot = r->slot;
    r->id = ids;
    r->slot = slots;
    JOX_ASSERT(f->count <= r->capacity && before <= r->slot_count);
    for (uint32_t i = 0; i < f->count; i++) { /* slots of people who left are freed first */
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
            r->slot[i] = take_free_slot(r);
        const uint32_t s = r->slot[i];
        JOX_ASSERT(s < r->slot_count);
        JOX_ASSERT(i == 0 || f->id[i] > f->id[i - 1]); /* ids ascend, each occurs once */
        bool moved = !fresh && spent > 0.0;
        bool round = fabsf(f->x[i] - r->last_x[s]) > 0.5f * period.x && period.x > 0.0f;
        round |= fabsf(f->y[i] - r->last_y[s]) > 0.5f * r->period.y && r->period.y > 0.0f;
        if (!fresh && round) /* crossed a periodic edge: no movement is drawn */
            r->parity[s] ^= JOX_LIVE_PARITY;
        r->vx[i] =
            moved ? wrap_displacement(f->x[i] - r->last_x[s], period.x) / (float)spent : 0.0f;
        r->vy[i] =
            moved ? wrap_displacement(f->y[i] - r->last_y[s], period.y) / (float)spent : 0.0f;
        r->last_x[s] = r->x[i] = f->x[i];
        r->last_y[s] = r->y[i] = f->y[i];
        r->id[i] = f->id[i];
    }
    r->count = f->count;
}

int64_t jox_replay_id(const JoxReplay *r, uint32_t slot) {
    for (uint32_t i = 0; i < r->count; i++)
        if (r->slot[i] == slot)
            return r->id[i];
    return -1;
}
