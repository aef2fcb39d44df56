/* Counts people who pass stairs, and the greatest density on each. */
#include "record/danger/stair_counts.h"

#include <math.h>

#include "base/mem.h"

static void reserve_stairs(JoxDangerStairs *s, const JoxFrame *frame) {
    const uint32_t count = frame->storeys->stair_count;
    s->storeys = frame->storeys;
    if (s->count < count) {
        s->items = jox_realloc(s->items, count, sizeof *s->items);
        for (; s->count < count; s->count++)
            s->items[s->count] = (JoxDangerStair){.density_time = NAN};
    }
    JOX_RESERVE_ZEROED(s->people, s->people_capacity, frame->keys);
}

/* Counts a person who left a stair for a sheet. */
static void count_passage(JoxDangerStairs *s, const struct JoxOnStair *was, uint32_t to) {
    const JoxStair *stair = &s->storeys->stairs[was->stair - 1];
    if (was->from == to)
        return; /* it turned back */
    s->items[was->stair - 1].up += to == stair->upper;
    s->items[was->stair - 1].down += to == stair->lower;
}

void jox_danger_stairs_frame(JoxDangerStairs *s, const JoxFrame *frame) {
    const JoxStoreys *storeys = frame->storeys;
    if (!storeys)
        return;
    reserve_stairs(s, frame);
    uint32_t *here = jox_alloc((size_t)s->count + 1, sizeof *here);
    for (uint32_t i = 0; i < frame->count; i++) {
        struct JoxOnStair *was = &s->people[frame->key[i]];
        const uint32_t sheet = jox_sheet_of(storeys, frame->y[i]);
        if (sheet < storeys->storey_count) {
            if (was->stair)
                count_passage(s, was, sheet);
            *was = (struct JoxOnStair){0, sheet + 1};
            continue;
        }
        const uint32_t stair =
            (uint32_t)(jox_stair_at(storeys, (JoxV2){frame->x[i], frame->y[i]}) + 1);
        if (stair != was->stair) /* on a storey, `from` is 1 + its sheet; 0: not seen before */
            *was = (struct JoxOnStair){stair, was->stair ? UINT32_MAX : was->from - 1};
        here[stair ? stair - 1 : s->count]++;
    }
    for (uint32_t k = 0; k < s->count; k++)
        s->items[k].people_most =
            here[k] > s->items[k].people_most ? here[k] : s->items[k].people_most;
    jox_free(here);
}

void jox_danger_stairs_sample(JoxDangerStairs *s, const JoxFrame *frame, const float *density) {
    for (uint32_t i = 0; frame->storeys && i < frame->count; i++) {
        const uint32_t stair = s->people[frame->key[i]].stair;
        JoxDangerStair *on = stair ? &s->items[stair - 1] : NULL;
        if (!on || isnan(density[i]) ||
            (isfinite(on->density_time) && density[i] <= on->density_most))
            continue;
        on->density_most = density[i];
        on->density_time = frame->time;
    }
}

void jox_danger_stairs_json(const JoxDangerStairs *s, const JoxStoreys *storeys, JoxJson *json) {
    if (!jox_has_storeys(storeys) || storeys->stair_count == 0)
        return;
    jox_json_object(json, "stairs");
    for (uint32_t k = 0; k < storeys->stair_count && k < s->count; k++) {
        const JoxDangerStair *on = &s->items[k];
        const bool seen = isfinite(on->density_time);
        if (!jox_stair_joins(&storeys->stairs[k]))
            continue;
        jox_json_object(json, storeys->stairs[k].name);
        jox_json_whole(json, "up", on->up);
        jox_json_whole(json, "down", on->down);
        jox_json_whole(json, "people_max", on->people_most);
        jox_json_number(json, "density_max", seen ? (double)on->density_most : NAN);
        jox_json_number(json, "density_max_s", on->density_time);
        jox_json_end(json);
    }
    jox_json_end(json);
}

void jox_danger_stairs_sections(JoxDangerStairs *s, JoxSections *sections) {
    uint32_t count = s->count;
    JOX_SECTION_ARRAY(sections, "stairs", s->items, s->count, count);
    if (s->count == 0)
        return;
    JOX_SECTION_ROOM(sections, "on_stairs", s->people, s->people_capacity);
    for (uint32_t k = 0; k < s->people_capacity; k++)
        if (!sections->failed && s->people[k].stair > s->count)
            jox_sections_fail(sections, "on_stairs", "a person is on no stair");
    if (sections->failed)
        s->count = 0;
}

void jox_danger_stairs_free(JoxDangerStairs *s) {
    jox_free(s->items);
    jox_free(s->people);
    *s = (JoxDangerStairs){0};
}
