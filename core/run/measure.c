/* Frames of a running world, and the scene's probes that look at them. */
#include <math.h>

#include "base/assert.h"
#include "base/mem.h"
#include "run/run.h"

/* Columns that the world has not in this form. */
struct JoxMeasuring {
    JoxFrame frame;
    float *vx, *vy, *force;
    size_t vx_capacity, vy_capacity, force_capacity;
    const char **names, **states;
    size_t name_capacity, states_capacity, state_capacity;
    uint32_t *state;
    uint64_t made; /* the tick of the frame, plus 1 */
    JoxProbe **probes;
    uint32_t count, state_count;
};

static void begin(JoScene *scene) {
    const JoxSceneSpec *spec = scene->spec;
    JoxMeasuring *m = scene->measuring = jox_alloc(1, sizeof *m);
    m->probes = jox_alloc(spec->probe_count + 1, sizeof(JoxProbe *));
    m->count = spec->probe_count;
    for (uint32_t p = 0; p < m->count; p++) {
        JoxProbeDef def = spec->probes[p];
        if (def.kind == JOX_PROBE_MAP && def.low.x > def.high.x)
            jox_run_area(scene, &def.low, &def.high);
        m->probes[p] = jox_probe_create(&def);
    }
}

/* All states of all machines in one list, which a reload may change, and each person's. */
static void list_states(JoxMeasuring *m, const JoWorld *world) {
    const JoxMind *mind = &world->mind;
    const JoxAgents *a = &world->agents;
    uint32_t first[JOX_MOST_MACHINES + 1] = {1};
    for (uint32_t k = 0; k < mind->machine_count; k++)
        first[k + 1] = first[k] + mind->machines[k]->state_count;
    m->state_count = first[mind->machine_count];
    JOX_RESERVE(m->states, m->states_capacity, m->state_count);
    JOX_RESERVE(m->state, m->state_capacity, a->count + 1);
    m->states[0] = ""; /* of those without a machine */
    for (uint32_t k = 0; k < mind->machine_count; k++)
        for (uint32_t s = 0; s < mind->machines[k]->state_count; s++)
            m->states[first[k] + s] = mind->machines[k]->states[s].name;
    for (uint32_t i = 0; i < a->count; i++)
        m->state[i] = a->machine[i] == JOX_NO_MACHINE ? 0 : first[a->machine[i]] + a->state[i];
}

const JoxFrame *jox_run_frame(JoScene *scene) {
    const JoWorld *world = scene->world;
    const JoxAgents *a = &world->agents;
    if (!scene->measuring)
        begin(scene);
    JoxMeasuring *m = scene->measuring;
    if (m->made == world->tick + 1)
        return &m->frame;
    m->made = world->tick + 1;
    JOX_RESERVE(m->vx, m->vx_capacity, a->count + 1);
    JOX_RESERVE(m->vy, m->vy_capacity, a->count + 1);
    JOX_RESERVE(m->force, m->force_capacity, a->count + 1);
    JOX_RESERVE(m->names, m->name_capacity, scene->spec->group_count + 1);
    for (uint32_t g = 0; g < scene->spec->group_count; g++)
        m->names[g] = scene->spec->groups[g].name;
    float rate = (float)(1.0 / world->def.dt);
    for (uint32_t i = 0; i < a->count; i++) {
        m->vx[i] = (a->x[i] - a->prev_x[i]) * rate;
        m->vy[i] = (a->y[i] - a->prev_y[i]) * rate;
        m->force[i] = sqrtf(a->force_x[i] * a->force_x[i] + a->force_y[i] * a->force_y[i]);
    }
    list_states(m, world);
    m->frame = (JoxFrame){.time = (double)world->tick * world->def.dt,
                          .count = a->count,
                          .period = a->period,
                          .keys = a->next_id,
                          .key = a->id,
                          .x = a->x,
                          .y = a->y,
                          .vx = m->vx,
                          .vy = m->vy,
                          .radius = a->param[JOX_PARAM_radius],
                          .force = m->force,
                          .compression = a->compression,
                          .failed = a->failed,
                          .group = a->group,
                          .groups = m->names,
                          .group_count = scene->spec->group_count,
                          .state = m->state,
                          .states = m->states,
                          .state_count = m->state_count,
                          .walls = &world->walls};
    return &m->frame;
}

void jox_run_measure(JoScene *scene) {
    if (!scene->measuring && scene->spec->probe_count == 0)
        return;
    if (!scene->measuring)
        begin(scene);
    const JoxMeasuring *m = scene->measuring;
    double time = (double)scene->world->tick * scene->world->def.dt;
    for (uint32_t p = 0; p < m->count; p++)
        if (jox_probe_is_due(m->probes[p], time))
            jox_probe_frame(m->probes[p], jox_run_frame(scene));
}

void jox_run_add_probes(const JoScene *scene, JoxText *out) {
    const JoxMeasuring *m = scene->measuring;
    if (!m || m->count == 0)
        return;
    jox_text_add(out, ",\n \"probes\": {");
    for (uint32_t p = 0; p < m->count; p++) {
        jox_text_add(out, p ? ",\n  " : "\n  ");
        jox_text_json(out, jox_probe_def(m->probes[p])->name);
        jox_text_add(out, ": ");
        jox_probe_json(m->probes[p], out);
    }
    jox_text_add(out, "\n }");
}

const JoxProbe *jox_run_probe(const JoScene *scene, uint32_t n) {
    const JoxMeasuring *m = scene->measuring;
    return m && n < m->count ? m->probes[n] : NULL;
}

bool jox_run_write_probes(const JoScene *scene, const char *folder, const char *title,
                          JoxText *error) {
    const JoxMeasuring *m = scene->measuring;
    bool good = true;
    for (uint32_t p = 0; m && good && p < m->count; p++)
        good = jox_probe_write(m->probes[p], folder, &scene->world->all_walls, title, error);
    return good;
}

void jox_run_end_measuring(JoScene *scene) {
    JoxMeasuring *m = scene->measuring;
    if (!m)
        return;
    for (uint32_t p = 0; p < m->count; p++)
        jox_probe_free(m->probes[p]);
    jox_free(m->probes);
    jox_free(m->vx);
    jox_free(m->vy);
    jox_free(m->force);
    jox_free(m->names);
    jox_free(m->states);
    jox_free(m->state);
    jox_free(m);
    scene->measuring = NULL;
}
