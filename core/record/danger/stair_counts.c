/* Counts people who pass stairs, and samples flow, density and level of service on each. */
#include "record/danger/stair_counts.h"

#include <math.h>

#include "base/mem.h"

static const double WINDOW = 10.0; /* s: flow is taken over this time */
static const double HAIR = 1e-6;   /* s: tolerance, as times are sums of steps */

JoxDangerStairs jox_danger_stairs_create(double limit) {
    return (JoxDangerStairs){.limit = limit, .last = NAN, .begun = NAN};
}

/* Returns the width of a stair, which is kept as a float, as it was given. */
static double round_width(const JoxFrame *frame, uint32_t stair) {
    return rint(1e4 * (double)frame->storeys->stairs[stair].width) / 1e4;
}

static void reserve_stairs(JoxDangerStairs *s, const JoxFrame *frame) {
    const uint32_t count = frame->storeys->stair_count;
    s->storeys = frame->storeys;
    if (s->count < count) {
        s->items = jox_realloc(s->items, count, sizeof *s->items);
        for (; s->count < count; s->count++)
            s->items[s->count] = (JoxDangerStair){.worst = -1,
                                                  .width = round_width(frame, s->count),
                                                  .first = NAN,
                                                  .last = NAN,
                                                  .flow_most = NAN,
                                                  .flow_most_time = NAN,
                                                  .mean_most = NAN,
                                                  .mean_most_time = NAN,
                                                  .density_most = NAN,
                                                  .density_most_time = NAN};
    }
    JOX_RESERVE_ZEROED(s->people, s->people_capacity, frame->keys);
}

/* ---- every frame ---- */

/* Counts a person who left a stair for a sheet. */
static void count_passage(JoxDangerStairs *s, const struct JoxOnStair *was, uint32_t to,
                          double time) {
    const uint32_t k = was->stair - 1;
    const JoxStair *stair = &s->storeys->stairs[k];
    if (was->from == to || (to != stair->upper && to != stair->lower))
        return; /* it turned back */
    const bool up = to == stair->upper;
    s->items[k].up += up;
    s->items[k].down += !up;
    JOX_RESERVE(s->passages, s->passage_capacity, s->passage_count + 1);
    s->passages[s->passage_count++] = (struct JoxStairPassage){time, k, up};
}

/* Counts a person on a storey, who was seen on a stair, on a storey, or not before. */
static void count_on_storey(JoxDangerStairs *s, struct JoxOnStair *was, uint32_t sheet,
                            double time) {
    if (was->stair)
        count_passage(s, was, sheet, time);
    else if (was->from && was->from - 1 != sheet)
        s->by_lift[sheet > was->from - 1]++;
    *was = (struct JoxOnStair){0, sheet + 1};
}

/* Updates most people and time of use by how many are on each stair. */
static void update_use(JoxDangerStairs *s, const uint32_t *here, double time) {
    const double duration = isnan(s->last) ? 0.0 : time - s->last;
    for (uint32_t k = 0; k < s->count; k++) {
        JoxDangerStair *stair = &s->items[k];
        if (!here[k])
            continue;
        stair->people_most = here[k] > stair->people_most ? here[k] : stair->people_most;
        stair->used += duration;
        stair->first = isnan(stair->first) ? time : stair->first;
        stair->last = time;
    }
    s->last = time;
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
            count_on_storey(s, was, sheet, frame->time);
            continue;
        }
        const uint32_t stair =
            (uint32_t)(jox_stair_at(storeys, (JoxV2){frame->x[i], frame->y[i]}) + 1);
        if (stair != was->stair) /* `from` of one not seen before becomes UINT32_MAX */
            *was = (struct JoxOnStair){stair, was->stair ? UINT32_MAX : was->from - 1};
        here[stair ? stair - 1 : s->count]++;
    }
    update_use(s, here, frame->time);
    jox_free(here);
}

/* ---- samples ---- */

/* Counts the people who passed a stair in the time before a moment. */
static uint32_t count_recent_passages(const JoxDangerStairs *s, uint32_t stair) {
    uint32_t count = 0;
    for (uint32_t p = 0; p < s->passage_count; p++)
        count += s->passages[p].stair == stair;
    return count;
}

static void drop_old_passages(JoxDangerStairs *s, double now) {
    uint32_t kept = 0;
    for (uint32_t p = 0; p < s->passage_count; p++)
        if (s->passages[p].time > now - WINDOW + HAIR)
            s->passages[kept++] = s->passages[p];
    s->passage_count = kept;
}

/* Keeps a value and its time if it is the greatest so far. */
static void keep_greatest(double *most, double *most_time, double value, double time) {
    if (isnan(value) || *most >= value)
        return;
    *most = value;
    *most_time = time;
}

static int find_stair_level(const JoxStair *stair, double flow, double density) {
    if (isnan(flow) || stair->kind == JOX_STAIR_ESCALATOR)
        return -1;
    return stair->kind == JOX_STAIR_RAMP ? jox_level_of_walkway(flow, density)
                                         : jox_level_of_stair(flow, density);
}

/* Adds the row of a stair, with the sum of the densities where `known` of its people stand. */
static void sample_stair(JoxDangerStairs *s, uint32_t k, double time, double duration,
                         const JoxDangerStairRow *seen, double sum, uint32_t known) {
    const JoxStair *stair = &s->storeys->stairs[k];
    JoxDangerStair *item = &s->items[k];
    JoxDangerStairRow row = {.time = time,
                             .up = item->up,
                             .down = item->down,
                             .people = seen->people,
                             .flow = NAN,
                             .density = known ? sum / known : NAN};
    if (time >= s->begun + WINDOW - HAIR)
        row.flow = count_recent_passages(s, k) / (WINDOW * item->width);
    row.level = find_stair_level(stair, row.flow, row.density);
    keep_greatest(&item->flow_most, &item->flow_most_time, row.flow, time);
    keep_greatest(&item->mean_most, &item->mean_most_time, row.density, time);
    item->over += row.density >= s->limit ? duration : 0.0;
    if (row.level >= 0 && row.people) { /* an empty stair has no level */
        item->level_s[row.level] += duration;
        item->worst = row.level > item->worst ? row.level : item->worst;
    }
    JOX_RESERVE(item->rows, item->row_capacity, item->row_count + 1);
    item->rows[item->row_count++] = row;
}

void jox_danger_stairs_sample(JoxDangerStairs *s, const JoxFrame *frame, const float *density,
                              double duration) {
    if (!frame->storeys || !s->count)
        return;
    s->begun = isnan(s->begun) ? frame->time : s->begun;
    drop_old_passages(s, frame->time);
    JoxDangerStairRow *seen = jox_alloc(s->count, sizeof *seen);
    double *sum = jox_alloc(s->count, sizeof *sum);
    uint32_t *known = jox_alloc(s->count, sizeof *known);
    for (uint32_t i = 0; i < frame->count; i++) {
        const uint32_t stair = s->people[frame->key[i]].stair;
        if (!stair)
            continue;
        seen[stair - 1].people++;
        if (isnan(density[i]))
            continue;
        sum[stair - 1] += (double)density[i];
        known[stair - 1]++;
        keep_greatest(&s->items[stair - 1].density_most, &s->items[stair - 1].density_most_time,
                      (double)density[i], frame->time);
    }
    for (uint32_t k = 0; k < s->count; k++)
        if (jox_stair_joins(&frame->storeys->stairs[k]))
            sample_stair(s, k, frame->time, duration, &seen[k], sum[k], known[k]);
    jox_free(seen);
    jox_free(sum);
    jox_free(known);
}

/* ---- figures ---- */

uint32_t jox_danger_stairs_joining(const JoxDangerStairs *s) {
    uint32_t count = 0;
    for (uint32_t k = 0; k < s->count; k++)
        count += jox_stair_joins(&s->storeys->stairs[k]);
    return count;
}

static void write_stair_figures(const JoxDangerStair *on, const JoxStair *stair, JoxJson *json) {
    const bool judged = jox_danger_stair_is_judged(on);
    jox_json_object(json, stair->name);
    jox_json_whole(json, "up", on->up);
    jox_json_whole(json, "down", on->down);
    jox_json_whole(json, "people_max", on->people_most);
    jox_json_number(json, "width", on->width);
    jox_json_number(json, "used_s", on->used);
    jox_json_number(json, "first_s", on->first);
    jox_json_number(json, "last_s", on->last);
    jox_json_number(json, "flow_max", judged ? on->flow_most : NAN);
    jox_json_number(json, "flow_max_s", judged ? on->flow_most_time : NAN);
    jox_json_number(json, "density_max", on->density_most);
    jox_json_number(json, "density_max_s", on->density_most_time);
    jox_json_number(json, "density_mean_max", on->mean_most);
    jox_json_number(json, "density_mean_max_s", on->mean_most_time);
    jox_json_number(json, "over_limit_s", on->over);
    if (judged && on->worst >= 0)
        jox_json_string(json, "worst_level", jox_levels[on->worst].name);
    else
        jox_json_null(json, "worst_level");
    jox_json_object(json, "level_s");
    for (int k = 0; k < JOX_LEVELS; k++)
        jox_json_number(json, jox_levels[k].name, judged && on->worst >= 0 ? on->level_s[k] : NAN);
    jox_json_end(json);
    jox_json_end(json);
}

void jox_danger_stairs_json(const JoxDangerStairs *s, const JoxStoreys *storeys, JoxJson *json) {
    if (!jox_has_storeys(storeys))
        return;
    jox_json_object(json, "stairs");
    for (uint32_t k = 0; k < storeys->stair_count && k < s->count; k++)
        if (jox_stair_joins(&storeys->stairs[k]))
            write_stair_figures(&s->items[k], &storeys->stairs[k], json);
    jox_json_end(json);
    jox_json_object(json, "by_lift");
    jox_json_whole(json, "up", s->by_lift[1]);
    jox_json_whole(json, "down", s->by_lift[0]);
    jox_json_end(json);
}

static void list_stair_sections(JoxDangerStair *stair, JoxSections *s) {
    JOX_SECTION(s, "up", stair->up);
    JOX_SECTION(s, "down", stair->down);
    JOX_SECTION(s, "people_most", stair->people_most);
    JOX_SECTION(s, "worst", stair->worst);
    JOX_SECTION(s, "width", stair->width);
    JOX_SECTION(s, "used", stair->used);
    JOX_SECTION(s, "first", stair->first);
    JOX_SECTION(s, "last", stair->last);
    JOX_SECTION(s, "flow_most", stair->flow_most);
    JOX_SECTION(s, "flow_most_time", stair->flow_most_time);
    JOX_SECTION(s, "mean_most", stair->mean_most);
    JOX_SECTION(s, "mean_most_time", stair->mean_most_time);
    JOX_SECTION(s, "density_most", stair->density_most);
    JOX_SECTION(s, "density_most_time", stair->density_most_time);
    JOX_SECTION(s, "over", stair->over);
    JOX_SECTION(s, "level_s", stair->level_s);
    JOX_SECTION_ARRAY(s, "rows", stair->rows, stair->row_count, stair->row_capacity);
    bool valid = stair->worst >= -1 && stair->worst < JOX_LEVELS;
    for (uint32_t r = 0; r < stair->row_count && valid; r++)
        valid = stair->rows[r].level >= -1 && stair->rows[r].level < JOX_LEVELS;
    if (!s->failed && !valid)
        jox_sections_fail(s, "rows", "a level is out of range");
    if (s->failed) {
        stair->row_count = 0;
        stair->worst = -1;
    }
}

/* Returns whether people and passages are on stairs that exist. */
static bool are_people_valid(const JoxDangerStairs *s) {
    bool valid = true;
    for (uint32_t k = 0; k < s->people_capacity; k++)
        valid &= s->people[k].stair <= s->count;
    for (uint32_t p = 0; p < s->passage_count; p++)
        valid &= s->passages[p].stair < s->count;
    return valid;
}

void jox_danger_stairs_sections(JoxDangerStairs *s, JoxSections *sections) {
    const uint32_t count = (uint32_t)jox_section_count(sections, "stairs", s->count, 1);
    if (sections->mode == JOX_SECTIONS_RESTORE && count <= JOX_MOST_STAIRS && s->count < count) {
        s->items = jox_realloc(s->items, count, sizeof *s->items);
        for (; s->count < count; s->count++)
            s->items[s->count] = (JoxDangerStair){.worst = -1};
    }
    if (count != s->count) {
        jox_sections_fail(sections, "stairs", "the number of stairs differs");
        return;
    }
    if (s->count == 0)
        return;
    for (uint32_t k = 0; k < s->count; k++)
        list_stair_sections(&s->items[k], sections);
    JOX_SECTION(sections, "stairs_last", s->last);
    JOX_SECTION(sections, "stairs_begun", s->begun);
    JOX_SECTION(sections, "by_lift", s->by_lift);
    JOX_SECTION_ROOM(sections, "on_stairs", s->people, s->people_capacity);
    JOX_SECTION_ARRAY(sections, "passages", s->passages, s->passage_count, s->passage_capacity);
    if (!sections->failed && !are_people_valid(s))
        jox_sections_fail(sections, "on_stairs", "a person is on no stair");
    if (!sections->failed)
        return;
    for (uint32_t k = 0; k < s->people_capacity; k++)
        s->people[k] = (struct JoxOnStair){0, 0};
    s->passage_count = 0;
}

void jox_danger_stairs_free(JoxDangerStairs *s) {
    for (uint32_t k = 0; k < s->count; k++)
        jox_free(s->items[k].rows);
    jox_free(s->items);
    jox_free(s->people);
    jox_free(s->passages);
    *s = (JoxDangerStairs){0};
}
