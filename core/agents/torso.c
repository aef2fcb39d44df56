#include "agents/torso.h"

#include "base/mem.h"

float jox_agents_widest(const JoxAgents *a, bool discs) {
    float most = jox_param_greatest(a, JOX_PARAM_radius);
    if (discs)
        return most;
    most = jox_maxf(most, 0.5f * JOX_TORSO_BREADTH * most);
    return jox_maxf(most, 0.5f * jox_maxf(jox_param_greatest(a, JOX_PARAM_breadth),
                                          jox_param_greatest(a, JOX_PARAM_depth)));
}

bool jox_agents_have_torsos(const JoxAgents *a) {
    for (uint32_t i = 0; i < a->count; i++) {
        if (jox_agent_torso(a, i, false).half > 0.0f)
            return true;
        if (!(a->param[JOX_PARAM_breadth].mask | a->param[JOX_PARAM_depth].mask |
              a->param[JOX_PARAM_radius].mask))
            return false;
    }
    return false;
}

bool jox_torsos_list(JoxTorsos *t, const JoxAgents *a, bool literal) {
    if (literal || !jox_agents_have_torsos(a))
        return false;
    if (a->count > t->capacity) {
        jox_torsos_free(t);
        t->capacity = a->count + a->count / 2;
        t->axis_x = jox_alloc(t->capacity, sizeof *t->axis_x);
        t->axis_y = jox_alloc(t->capacity, sizeof *t->axis_y);
        t->radius = jox_alloc(t->capacity, sizeof *t->radius);
    }
    for (uint32_t i = 0; i < a->count; i++) {
        const JoxTorso torso = jox_agent_torso(a, i, false);
        t->axis_x[i] = -a->chest_y[i] * torso.half;
        t->axis_y[i] = a->chest_x[i] * torso.half;
        t->radius[i] = torso.radius;
    }
    return true;
}

void jox_torsos_free(JoxTorsos *t) {
    jox_free(t->axis_x);
    jox_free(t->axis_y);
    jox_free(t->radius);
    *t = (JoxTorsos){0};
}

/* Returns the square of the distance of a point from the segment between -axis and axis. */
static float find_distance2(JoxV2 point, JoxV2 axis) {
    const float half2 = jox_length2(axis);
    const float along = half2 > 0.0f ? jox_clampf(jox_dot(point, axis) / half2, -1.0f, 1.0f) : 0.0f;
    return jox_length2(jox_sub(point, jox_scale(axis, along)));
}

/* Returns the distance of two segments: one between -own and own, the other likewise about a point
   at `offset`, unless they cross. */
static float find_axis_distance(JoxV2 offset, JoxV2 own, JoxV2 other) {
    const JoxV2 back = jox_scale(offset, -1.0f);
    const float first = jox_minf(find_distance2(jox_add(back, own), other),
                                 find_distance2(jox_sub(back, own), other));
    const float second = jox_minf(find_distance2(jox_add(offset, other), own),
                                  find_distance2(jox_sub(offset, other), own));
    return sqrtf(jox_minf(first, second));
}

float jox_torso_distance(const JoxAgents *a, uint32_t i, JoxV2 point) {
    const JoxV2 offset = jox_wrap(a, jox_sub(point, (JoxV2){a->x[i], a->y[i]}));
    return sqrtf(find_distance2(offset, (JoxV2){a->axis_x[i], a->axis_y[i]})) -
           a->contact_radius[i];
}

float jox_torso_gap(const JoxAgents *a, uint32_t i, uint32_t j) {
    return find_axis_distance(jox_offset(a, i, j), (JoxV2){a->axis_x[i], a->axis_y[i]},
                              (JoxV2){a->axis_x[j], a->axis_y[j]}) -
           a->contact_radius[i] - a->contact_radius[j];
}

float jox_torsos_gap(const JoxTorsos *t, const JoxAgents *a, uint32_t i, uint32_t j) {
    return find_axis_distance(jox_offset(a, i, j), (JoxV2){t->axis_x[i], t->axis_y[i]},
                              (JoxV2){t->axis_x[j], t->axis_y[j]}) -
           t->radius[i] - t->radius[j];
}
