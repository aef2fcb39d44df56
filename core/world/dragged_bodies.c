/* Boxes that people at the live page throw in, and bodies that they drag. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "world/stages.h"
#include "world/world.h"

/* A drag pulls like a critically damped spring of this rate, up to a speed and a force. */
static const float DRAG_RATE =
    12.0f; /* 1/s: rate at which the body approaches the wanted velocity */
static const float DRAG_SPEED = 6.0f;  /* m/s */
static const float DRAG_FORCE = 4e3f;  /* N, plus the weight of the body up to the same force */
static const float DRAG_STEADY = 6.0f; /* 1/s: rate at which its spin decays */

uint32_t jox_world_add_box(JoWorld *w, const double at[3], const double velocity[3], double size,
                           double mass, JoxText *why) {
    JoxDrags *drags = &w->state.drags;
    JoxBodyDef def = jox_body_def();
    memcpy(def.position, at, sizeof def.position);
    memcpy(def.velocity, velocity, sizeof def.velocity);
    for (int k = 0; k < 3; k++)
        def.shape.size[k] = size;
    if (def.position[2] < size / 2) /* on the ground, not in it */
        def.position[2] = size / 2;
    def.mass = mass;
    uint32_t row = jox_bodies_add(w->state.bodies, &def, why);
    if (row == JOX_NO_BODY)
        return row;
    jox_bodies_objects(w->state.bodies, &w->scratch.objects);
    if (drags->box_count == JOX_MOST_BOXES) { /* replaces the oldest */
        jox_bodies_remove(w->state.bodies, jox_bodies_find(w->state.bodies, drags->boxes[0]));
        jox_bodies_objects(w->state.bodies, &w->scratch.objects);
        memmove(drags->boxes, drags->boxes + 1, --drags->box_count * sizeof *drags->boxes);
    }
    drags->boxes[drags->box_count++] = w->scratch.objects.rows[row].id;
    return row;
}

static int32_t find_grab(const JoWorld *w, uint32_t row) {
    for (uint32_t g = 0; g < w->state.drags.grab_count; g++)
        if (w->state.drags.grabs[g].row == row && row < w->scratch.objects.count &&
            w->scratch.objects.rows[row].id == w->state.drags.grabs[g].id)
            return (int32_t)g;
    return -1;
}

static void remove_grab(JoxDrags *drags, uint32_t g) {
    JOX_ASSERT(g < drags->grab_count);
    drags->grabs[g] = drags->grabs[--drags->grab_count];
}

JoxGrabbed jox_world_grab(JoWorld *w, uint32_t row, const double to[3], bool anew) {
    JoxPose pose;
    jox_bodies_objects(w->state.bodies, &w->scratch.objects);
    if (!jox_bodies_pose(w->state.bodies, row, &pose))
        return JOX_GRAB_NONE;
    if (!(pose.mass > 0.0f))
        return JOX_GRAB_STATIC;
    int32_t g = find_grab(w, row);
    if (g < 0 && !anew)
        return JOX_GRAB_FREE;
    if (g < 0 && w->state.drags.grab_count == JOX_MOST_GRABS)
        return JOX_GRAB_FULL;
    if (g < 0)
        g = (int32_t)w->state.drags.grab_count++;
    if (w->scratch.objects.rows[row].held) /* its carrier loses it */
        jox_bodies_end_carrying(w->state.bodies, row, pose.velocity);
    w->state.drags.grabs[g] = (struct JoxGrab){
        row, w->scratch.objects.rows[row].id, {(float)to[0], (float)to[1], (float)to[2]}};
    return JOX_GRAB_DONE;
}

bool jox_world_release(JoWorld *w, uint32_t row) {
    jox_bodies_objects(w->state.bodies, &w->scratch.objects);
    int32_t g = find_grab(w, row);
    if (g >= 0)
        remove_grab(&w->state.drags, (uint32_t)g);
    return g >= 0;
}

static float measure_length(JoxV3 v) {
    return sqrtf(v.x * v.x + v.y * v.y + v.z * v.z);
}

static JoxV3 limit_length(JoxV3 v, float most) {
    float length = measure_length(v), k = length > most ? most / length : 1.0f;
    return (JoxV3){v.x * k, v.y * k, v.z * k};
}

void jox_stage_drag_bodies(const JoxBodyStage *s) {
    for (uint32_t g = 0; g < s->drags->grab_count;) {
        const struct JoxGrab *grab = &s->drags->grabs[g];
        JoxPose pose;
        if (!jox_bodies_pose(s->bodies, grab->row, &pose) ||
            s->objects->rows[grab->row].id != grab->id) {
            remove_grab(s->drags, g); /* the body was removed */
            continue;
        }
        JOX_ASSERT(pose.mass > 0.0f); /* static bodies cannot be grabbed */
        g++;
        float near = DRAG_RATE / 4.0f, most = pose.mass * DRAG_RATE;
        JoxV3 wanted = limit_length((JoxV3){(grab->to.x - pose.centre.x) * near,
                                            (grab->to.y - pose.centre.y) * near,
                                            (grab->to.z - pose.centre.z) * near},
                                    DRAG_SPEED);
        JoxV3 force = limit_length((JoxV3){most * (wanted.x - pose.velocity.x),
                                           most * (wanted.y - pose.velocity.y),
                                           most * (wanted.z - pose.velocity.z)},
                                   DRAG_FORCE);
        force.z += jox_minf(pose.mass * (float)s->gravity, DRAG_FORCE);
        float kept = jox_maxf(0.0f, 1.0f - DRAG_STEADY * (float)s->substep->step.timing.dt);
        JoxV3 spin = {pose.spin.x * kept, pose.spin.y * kept, pose.spin.z * kept};
        jox_bodies_set_velocity(s->bodies, grab->row, pose.velocity, spin);
        jox_bodies_force(s->bodies, grab->row, force);
    }
}

/* Lists the cells in use of an array of fixed size. */
static void list_used_cells(JoxSections *s, const char *name, void *cells, size_t size,
                            uint32_t *count, uint32_t most) {
    const size_t used = jox_section_count(s, name, *count, size);
    if (used > most)
        jox_sections_fail(s, name, "there are more than there may be");
    if (s->failed)
        return;
    *count = (uint32_t)used;
    jox_section(s, name, cells, size, used);
}

void jox_drags_sections(JoxDrags *drags, JoxSections *s) {
    jox_sections_module(s, "drags");
    list_used_cells(s, "boxes", drags->boxes, sizeof *drags->boxes, &drags->box_count,
                    JOX_MOST_BOXES);
    list_used_cells(s, "grabs", drags->grabs, sizeof *drags->grabs, &drags->grab_count,
                    JOX_MOST_GRABS);
}
