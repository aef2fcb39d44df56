/* Verbs that act on bodies, walls and signals. */
#include <math.h>
#include <string.h>

#include "world/verbs/verb_functions.h"
#include "world/world.h"

bool jox_perform_throw(JoWorld *world, const JoxInputEntry *entry, JoxText *why) {
    const double *v = entry->numbers;
    return jox_event_throw(world, entry->names[0], entry->here ? NULL : v, v + 3, v + 6, why);
}

bool jox_perform_box(JoWorld *world, const JoxInputEntry *entry, JoxText *why) {
    const double *v = entry->numbers;
    bool good = jox_world_add_box(world, v, v + 3, v[6], v[7], why) != JOX_NO_BODY;
    if (!good && !why->length)
        jox_text_add(why, "the box was refused");
    return good;
}

static bool grab_body(JoWorld *world, const JoxInputEntry *entry, bool anew, JoxText *why) {
    const unsigned row = entry->number;
    switch (jox_world_grab(world, row, entry->numbers, anew)) {
    case JOX_GRAB_DONE:
        return true;
    case JOX_GRAB_NONE:
        jox_text_printf(why, "there is no body %u", row);
        break;
    case JOX_GRAB_STATIC:
        jox_text_printf(why, "body %u is static or kinematic: it cannot be dragged", row);
        break;
    case JOX_GRAB_FREE:
        jox_text_printf(why, "body %u is not held; grab it first", row);
        break;
    case JOX_GRAB_FULL:
        jox_text_printf(why, "%d bodies are held already; release one first", JOX_MOST_GRABS);
        break;
    }
    return false;
}

bool jox_perform_grab(JoWorld *world, const JoxInputEntry *entry, JoxText *why) {
    return grab_body(world, entry, true, why);
}

bool jox_perform_drag(JoWorld *world, const JoxInputEntry *entry, JoxText *why) {
    return grab_body(world, entry, false, why);
}

bool jox_perform_release(JoWorld *world, const JoxInputEntry *entry, JoxText *why) {
    bool good = jox_world_release(world, entry->number);
    if (!good)
        jox_text_printf(why, "body %u is not held", entry->number);
    return good;
}

bool jox_perform_open(JoWorld *world, const JoxInputEntry *entry, JoxText *why) {
    return jox_event_open(world, entry->names[0], true, why);
}

bool jox_perform_close(JoWorld *world, const JoxInputEntry *entry, JoxText *why) {
    return jox_event_open(world, entry->names[0], false, why);
}

bool jox_perform_lift(JoWorld *world, const JoxInputEntry *entry, JoxText *why) {
    const char *name = entry->names[0], *mode = entry->names[1], *names[JOX_MOST_LIFTS + 1];
    const int32_t lift = jox_world_find_lift(world, name);
    char hint[JOX_HINT];
    uint32_t count = 0, m = 0;
    while (m < JOX_LIFT_MODES && strcmp(mode, jox_lift_mode_names[m]) != 0)
        m++;
    for (; count < world->model.lift_count; count++)
        names[count] = world->model.lifts[count].name;
    names[count++] = "all";
    if (world->model.lift_count == 0) {
        jox_text_printf(why, "there are no lifts; a scene has them by `lifts`");
    } else if (lift < 0 && strcmp(name, "all") != 0) {
        const char *near = jox_did_you_mean(name, names, count, hint);
        jox_text_printf(why, "there is no lift '%.60s'%s%s", name, near ? ". " : "",
                        near ? near : "");
    } else if (m == JOX_LIFT_MODES) {
        jox_text_printf(why, "a lift has no mode '%.60s': in_use, out_of_use or firemen", mode);
    } else {
        jox_world_set_lift_mode(world, lift, (JoxLiftMode)m);
        return true;
    }
    return false;
}

bool jox_perform_signal(JoWorld *world, const JoxInputEntry *entry, JoxText *why) {
    return jox_event_signal(world, entry->names[0], why);
}

/* ---- bodies, from programs ---- */

static JoxV3 make_vector(const double v[3]) {
    return (JoxV3){(float)v[0], (float)v[1], (float)v[2]};
}

/* Reads the pose of the body in the row of an entry. Returns false with a sentence if there is
   none, or if it is static and `moves` is true. */
static bool read_body_pose(const JoWorld *world, const JoxInputEntry *entry, bool moves,
                           JoxPose *pose, JoxText *why) {
    if (!jox_bodies_pose(world->state.bodies, entry->number, pose))
        jox_text_printf(why, "there is no body %u", entry->number);
    else if (moves && !pose->kinematic && !(pose->mass > 0.0f))
        jox_text_printf(why, "body %u is static", entry->number);
    else
        return true;
    return false;
}

bool jox_perform_impulse(JoWorld *world, const JoxInputEntry *entry, JoxText *why) {
    JoxPose pose;
    if (!read_body_pose(world, entry, true, &pose, why))
        return false;
    if (pose.kinematic) {
        jox_text_printf(why, "body %u is kinematic: nothing pushes it", entry->number);
        return false;
    }
    JoxImpulse impulse = {.object = entry->number,
                          .impulse = make_vector(entry->numbers),
                          .point =
                              entry->given > 3 ? make_vector(entry->numbers + 3) : pose.centre};
    jox_bodies_impulses(world->state.bodies, &impulse, 1);
    return true;
}

bool jox_perform_place(JoWorld *world, const JoxInputEntry *entry, JoxText *why) {
    JoxPose pose;
    const double *turn = entry->given > 3 ? entry->numbers + 3 : NULL;
    if (!read_body_pose(world, entry, false, &pose, why))
        return false;
    if (turn) {
        double length2 = 0.0;
        for (int k = 0; k < 4; k++)
            length2 += turn[k] * turn[k];
        if (!(fabs(length2 - 1.0) < 1e-3)) {
            jox_text_printf(why, "a turn is a unit quaternion, of length 1, not %g", sqrt(length2));
            return false;
        }
    }
    jox_bodies_place(world->state.bodies, entry->number, entry->numbers, turn);
    jox_bodies_objects(world->state.bodies, &world->scratch.objects);
    return true;
}

bool jox_perform_velocity(JoWorld *world, const JoxInputEntry *entry, JoxText *why) {
    JoxPose pose;
    const JoxV3 none = {0.0f, 0.0f, 0.0f};
    if (!read_body_pose(world, entry, true, &pose, why))
        return false;
    jox_bodies_set_velocity(world->state.bodies, entry->number, make_vector(entry->numbers),
                            entry->given > 3 ? make_vector(entry->numbers + 3) : none);
    jox_bodies_objects(world->state.bodies, &world->scratch.objects);
    return true;
}

bool jox_perform_delete(JoWorld *world, const JoxInputEntry *entry, JoxText *why) {
    JoxPose pose;
    if (!read_body_pose(world, entry, false, &pose, why))
        return false;
    jox_bodies_remove(world->state.bodies, entry->number);
    jox_bodies_objects(world->state.bodies, &world->scratch.objects);
    return true;
}

/* ---- walls, from programs ---- */

bool jox_perform_wall(JoWorld *world, const JoxInputEntry *entry, JoxText *why) {
    JoxV2 points[4];
    const uint32_t count = entry->given / 2;
    for (uint32_t p = 0; p < count; p++)
        points[p] = (JoxV2){(float)entry->numbers[2 * p], (float)entry->numbers[2 * p + 1]};
    return jox_world_add_wall(world, entry->names[0], points, count, why);
}

bool jox_perform_unwall(JoWorld *world, const JoxInputEntry *entry, JoxText *why) {
    if (jox_world_remove_walls(world, entry->names[0]))
        return true;
    jox_text_printf(why, "no wall named '%.60s' was added", entry->names[0]);
    return false;
}
