/* Creates a probe of a kind, gives it the frames that are due, and writes its results. */
#include "record/probes/probe.h"

#include <math.h>
#include <string.h>

#include "base/format/plurals.h"
#include "base/mem.h"
#include "record/probes/probe_parts.h"

static const double TENTH = 0.1; /* s */

struct JoxProbe {
    JoxProbeDef def;
    const JoxProbeCalls *calls;
    void *state;
    double pace;
    /* Number of the interval of `pace` seconds that the last frame lies in. */
    int64_t last_interval;
    uint8_t *seen;
    uint32_t seen_capacity;
};

static const JoxProbeCalls *const KINDS[JOX_PROBE_KINDS] = {
#define X(kind, name, form, options, example, meaning) [JOX_PROBE_##kind] = &jox_probe_##name,
    JOX_PROBES(X)
#undef X
};

static JoxV2 *copy_probe_points(const JoxV2 *points, uint32_t count) {
    JoxV2 *copy = points ? jox_alloc(count ? count : 1, sizeof *copy) : NULL;
    if (points)
        memcpy(copy, points, count * sizeof *copy);
    return copy;
}

JoxProbe *jox_probe_create(const JoxProbeDef *def) {
    JoxProbe *p = jox_alloc(1, sizeof *p);
    uint16_t *groups = jox_alloc(def->group_count + 1, sizeof *groups);
    for (uint32_t g = 0; g < def->group_count; g++)
        groups[g] = def->groups[g];
    p->def = *def;
    p->def.name = jox_strdup(def->name);
    p->def.groups = groups;
    for (int s = 0; s < 2; s++)
        p->def.states[s] = def->states[s] ? jox_strdup(def->states[s]) : NULL;
    p->def.points = copy_probe_points(def->points, def->count);
    p->def.during = copy_probe_points(def->during, def->during_count);
    p->calls = KINDS[def->kind];
    p->state = jox_alloc(1, p->calls->size);
    p->pace = p->calls->pace == JOX_PACE_TENTH ? TENTH
              : p->calls->pace == JOX_PACE_ALL ? 0.0
                                               : p->def.every;
    p->last_interval = INT64_MIN;
    if (p->calls->begin)
        p->calls->begin(&p->def, p->state);
    return p;
}

const char *jox_probe_kind_name(const JoxProbe *p) {
    static const char *const NAMES[] = {
#define X(kind, name, form, options, example, meaning) #name,
        JOX_PROBES(X)
#undef X
    };
    return NAMES[p->def.kind];
}

const JoxProbeDef *jox_probe_def(const JoxProbe *p) {
    return &p->def;
}

/* Returns the number of the interval that t lies in. Times are sums of steps and may fall short of
   a multiple by rounding. */
static int64_t find_pace_interval(const JoxProbe *p, double t) {
    return p->pace > 0.0 ? (int64_t)floor(t / p->pace + 1e-6) : 0;
}

bool jox_probe_is_due(const JoxProbe *p, double t) {
    if (t < p->def.from - 1e-9 || t >= p->def.until)
        return false;
    if (p->calls->is_due)
        return p->calls->is_due(&p->def, p->state, t);
    return p->pace <= 0.0 || find_pace_interval(p, t) != p->last_interval;
}

void jox_probe_frame(JoxProbe *p, const JoxFrame *frame) {
    if (!jox_probe_is_due(p, frame->time))
        return;
    p->last_interval = find_pace_interval(p, frame->time);
    JOX_RESERVE(p->seen, p->seen_capacity, frame->count + 1);
    for (uint32_t i = 0; i < frame->count; i++) {
        bool seen = p->def.group_count == 0;
        for (uint32_t g = 0; frame->group && g < p->def.group_count && !seen; g++)
            seen = frame->group[i] == p->def.groups[g];
        p->seen[i] = seen;
    }
    p->calls->frame(&p->def, p->state, frame, p->seen);
}

void jox_probe_sections(JoxProbe *p, JoxSections *s) {
    uint32_t kind = p->def.kind;
    JOX_SECTION(s, "kind", kind);
    if (kind != (uint32_t)p->def.kind) {
        jox_sections_fail(s, "kind", "the probe is of another kind");
        return;
    }
    JOX_SECTION(s, "last", p->last_interval);
    p->calls->sections(p->state, s);
}

JoxFigures jox_probe_figures(const JoxProbe *p) {
    JoxFigures figures = {.count = 0};
    p->calls->figures(&p->def, p->state, &figures);
    return figures;
}

uint32_t jox_probe_passages(const JoxProbe *p) {
    return p->def.kind == JOX_PROBE_FLOW ? jox_flow_passages(p->state) : 0;
}

uint32_t jox_probe_against(const JoxProbe *p) {
    return p->def.kind == JOX_PROBE_FLOW ? jox_flow_backward_crossings(p->state) : 0;
}

void jox_probe_window(const JoxProbe *p, JoxText *out) {
    const double from = fmax(p->def.from, 0.0);
    if (isfinite(p->def.until))
        jox_text_printf(out, "from %.6g to %.6g s", from, p->def.until);
    else if (from > 0.0)
        jox_text_printf(out, "from %.6g s on", from);
    if (p->def.group_count && out->length)
        jox_text_add(out, ", ");
    if (p->def.group_count)
        jox_text_noun(out, p->def.group_count, "group|groups");
}

void jox_probe_json(const JoxProbe *p, JoxJson *json, const char *key) {
    JoxFigures figures = jox_probe_figures(p);
    jox_json_object(json, key);
    for (uint32_t f = 0; f < figures.count; f++)
        jox_json_number(json, figures.items[f].name, figures.items[f].value);
    bool told = false;
    for (uint32_t f = 0; f < figures.count; f++) {
        if (!figures.items[f].why)
            continue;
        if (!told)
            jox_json_object(json, "why");
        told = true;
        jox_json_string(json, figures.items[f].name, figures.items[f].why);
    }
    if (told)
        jox_json_end(json);
    jox_json_number(json, "from", p->def.from);
    jox_json_number(json, "until", p->def.until);
    jox_json_end(json);
}

void jox_probe_free(JoxProbe *p) {
    if (!p)
        return;
    if (p->calls->release)
        p->calls->release(p->state);
    for (size_t k = 0; k < sizeof p->calls->owned / sizeof *p->calls->owned; k++)
        if (p->calls->owned[k]) {
            void *owned; /* the pointer in the state, of any type */
            memcpy(&owned, (char *)p->state + p->calls->owned[k] - 1, sizeof owned);
            jox_free(owned);
        }
    jox_free(p->state);
    jox_free((void *)(uintptr_t)p->def.name);
    jox_free((void *)(uintptr_t)p->def.groups);
    for (int s = 0; s < 2; s++)
        jox_free((void *)(uintptr_t)p->def.states[s]);
    jox_free((void *)(uintptr_t)p->def.during);
    jox_free((void *)(uintptr_t)p->def.points);
    jox_free(p->seen);
    jox_free(p);
}

void jox_probe_csv(const JoxProbe *p, FILE *out) {
    p->calls->csv(&p->def, p->state, out);
}

void jox_probe_plot_size(const JoxProbe *p, int *width, int *height) {
    *width = p->calls->width;
    *height = p->calls->height;
    if (*height == 0) {
        float wide = p->def.high.x - p->def.low.x, high = p->def.high.y - p->def.low.y;
        float ratio = jox_clampf(wide > 0.0f ? high / wide : 1.0f, 0.3f, 1.5f);
        *height = (int)((float)*width * ratio);
    }
}

void jox_probe_plot(const JoxProbe *p, bool walls, JoxText *commands, int *width, int *height) {
    jox_probe_plot_size(p, width, height);
    if (p->last_interval != INT64_MIN || !(p->def.from > 0.0)) {
        p->calls->plot(&p->def, p->state, walls, commands);
        return;
    }
    char why[80];
    snprintf(why, sizeof why, "it measures from %.6g s on: the run ended before", p->def.from);
    jox_plot_reason(commands, why);
}
