/* Rows of agents (term `formation`): along a line, or abreast behind another agent. Agents are
   placed in the order in which they stand along the row, so that no ways cross. */
#include "machine/formation.h"

#include "base/assert.h"
#include "base/sort.h"

static const JoxSteerTerm *find_formation_term(const JoxState *state) {
    for (uint32_t t = 0; t < state->steer_count; t++)
        if (state->steer[t].kind == JOX_STEER_FORMATION)
            return &state->steer[t];
    return NULL;
}

/* Fills the entry of agent i with the row that the target stands for; false if there is none. */
static bool find_row(const JoxMachineRun *run, uint32_t i, const JoxSteerTerm *term,
                     JoxRowEntry *entry) {
    const JoxAgents *a = run->agents;
    const int32_t index = jox_target_place(run, i, term->target);
    *entry = (JoxRowEntry){.agent = i, .id = a->id[i], .spacing = (float)term->args[0]};
    if (index >= 0) {
        const JoxPlace *place = &run->places[index];
        if (!jox_place_is_line(place))
            return false;
        entry->row = (uint64_t)index;
        entry->middle = jox_scale(jox_add(place->points[0], place->points[1]), 0.5f);
        entry->across = jox_unit(jox_sub(place->points[1], place->points[0]));
    } else {
        const JoxSpot spot = jox_target_find(run, i, term->target);
        if (!spot.found || spot.agent == JOX_NO_INDEX)
            return false;
        const JoxV2 ahead = {a->face_x[spot.agent], a->face_y[spot.agent]};
        entry->row = (uint64_t)1 << 32 | a->id[spot.agent];
        entry->middle = jox_sub((JoxV2){spot.x, spot.y}, jox_scale(ahead, entry->spacing));
        entry->across = jox_left(ahead);
    }
    entry->along = jox_dot(jox_sub((JoxV2){a->x[i], a->y[i]}, entry->middle), entry->across);
    return true;
}

static int compare_row_positions(const void *left, const void *right, const void *context) {
    const JoxRowEntry *a = left, *b = right;
    (void)context;
    if (a->row != b->row)
        return a->row < b->row ? -1 : 1;
    if (a->along != b->along)
        return a->along < b->along ? -1 : 1;
    return (a->id > b->id) - (a->id < b->id);
}

/* Writes the spots of one row, sorted along it: evenly spaced about its middle. */
static void place_row(JoxMachineRun *run, const JoxRowEntry *entries, uint32_t count) {
    for (uint32_t k = 0; k < count; k++) {
        const JoxRowEntry *e = &entries[k];
        const float way = ((float)k - 0.5f * (float)(count - 1)) * e->spacing;
        run->scratch->row[e->agent] = jox_add(e->middle, jox_scale(e->across, way));
    }
}

void jox_rows_form(JoxMachineRun *run) {
    JoxMachineScratch *s = run->scratch;
    const JoxAgents *a = run->agents;
    uint32_t count = 0;
    for (uint32_t b = 0; b < s->batch_count; b++) {
        const JoxBatchRange *batch = &s->batches[b];
        const JoxSteerTerm *term =
            find_formation_term(&run->set->items[batch->machine]->states[batch->state]);
        for (uint32_t n = 0; term && n < batch->count; n++) {
            const uint32_t i = s->grouped[batch->begin + n];
            JOX_ASSERT(count < s->capacity);
            s->row[i] = (JoxV2){a->x[i], a->y[i]}; /* an agent without a row stays where it is */
            count += find_row(run, i, term, &s->entries[count]);
        }
    }
    jox_sort(s->entries, count, sizeof *s->entries, compare_row_positions, NULL,
             s->entries + s->capacity);
    for (uint32_t first = 0, last; first < count; first = last) {
        last = first + 1;
        while (last < count && s->entries[last].row == s->entries[first].row)
            last++;
        place_row(run, s->entries + first, last - first);
    }
}
