/* Counts people who left since the last call, by exit, and gives quantiles of their times. */
#include "record/danger/leaving.h"

#include <math.h>

#include "base/format/quote.h"
#include "base/mem.h"

static void add_leave(JoxLeaving *l, double time, uint32_t people, int32_t exit) {
    if (people == 0)
        return;
    JOX_RESERVE(l->items, l->capacity, l->count + 1);
    l->items[l->count++] = (JoxLeave){time, people, exit};
}

void jox_leaving_update(JoxLeaving *l, const JoxExits *exits, double time) {
    if (exits->left <= l->left)
        return;
    uint32_t elsewhere = (uint32_t)(exits->left - l->left);
    for (uint32_t e = 0; e < exits->count && e < JOX_LEAVING_EXITS; e++) {
        const uint32_t people = exits->items[e].people - l->by_exit[e];
        add_leave(l, time, people, (int32_t)e);
        l->by_exit[e] += people;
        elsewhere -= people < elsewhere ? people : elsewhere;
    }
    add_leave(l, time, elsewhere, JOX_LEFT_ELSEWHERE);
    l->left = exits->left;
}

static bool matches_exit(const JoxLeave *leave, int32_t exit) {
    return exit == JOX_LEFT_ANYWHERE || leave->exit == exit;
}

uint64_t jox_leaving_count(const JoxLeaving *l, int32_t exit) {
    uint64_t count = 0;
    for (uint32_t i = 0; i < l->count; i++)
        count += matches_exit(&l->items[i], exit) ? l->items[i].people : 0;
    return count;
}

double jox_leaving_quantile(const JoxLeaving *l, int32_t exit, double share) {
    const double wanted = fmax(1.0, ceil(share * (double)jox_leaving_count(l, exit) - 1e-9));
    double so_far = 0.0;
    for (uint32_t i = 0; i < l->count; i++) {
        so_far += matches_exit(&l->items[i], exit) ? l->items[i].people : 0;
        if (so_far >= wanted)
            return l->items[i].time;
    }
    return NAN;
}

void jox_leaving_json(const JoxLeaving *l, JoxJson *json) {
    static const struct {
        const char *name;
        double share;
    } KEYS[] = {{"first", 0.0}, {"p25", 0.25}, {"p50", 0.5},
                {"p75", 0.75},  {"p95", 0.95}, {"last", 1.0}};
    jox_json_object(json, "leaving_s");
    for (size_t k = 0; k < sizeof KEYS / sizeof *KEYS; k++)
        jox_json_number(json, KEYS[k].name,
                        jox_leaving_quantile(l, JOX_LEFT_ANYWHERE, KEYS[k].share));
    jox_json_end(json);
}

void jox_leaving_csv(const JoxLeaving *l, char *const *names, uint32_t count, FILE *out) {
    fputs("time [s],people,exit\n", out);
    for (uint32_t i = 0; i < l->count; i++) {
        const JoxLeave *leave = &l->items[i];
        fprintf(out, "%.9g,%u,", leave->time, leave->people);
        if (leave->exit >= 0 && (uint32_t)leave->exit < count)
            jox_quote_put(out, jox_quote_csv, names[leave->exit]);
        fputc('\n', out);
    }
}

void jox_leaving_sections(JoxLeaving *l, JoxSections *s) {
    JOX_SECTION_ARRAY(s, "leaving", l->items, l->count, l->capacity);
    JOX_SECTION(s, "left", l->left);
    JOX_SECTION(s, "left_by_exit", l->by_exit);
}

void jox_leaving_free(JoxLeaving *l) {
    jox_free(l->items);
    *l = (JoxLeaving){0};
}
