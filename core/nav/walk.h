/* Who minds whom: the precedence of the walking law, shared by the choice of a velocity (walk.c)
   and the half-planes of walkers (solve.c). */
#ifndef JOX_NAV_WALK_H
#define JOX_NAV_WALK_H

#include "agents/agents.h"
#include "nav/nav.h"

#define JOX_SAME_WAY 0.5f /* cosine of 60 degrees: who heads so goes the same way */

typedef enum JoxMinds {
    JOX_MINDS_NOT,
    JOX_MINDS_AHEAD,   /* one who goes the same way and goes first: is followed */
    JOX_MINDS_CROSSING /* one who crosses, comes the other way or stands: is passed */
} JoxMinds;

/* How agent i minds j, who is at `offset` from it. Of those bound for the same place, who has less
   way left goes first, so that nobody waits for one who waits for them; ties go to the older.
   Others go first when they are ahead and head within 60 degrees of the same direction. */
static inline JoxMinds jox_minds(const JoxAgents *a, uint32_t i, uint32_t j, JoxV2 offset) {
    JoxV2 own = {a->aim_x[i], a->aim_y[i]}, other = {a->aim_x[j], a->aim_y[j]};
    if (other.x == 0.0f && other.y == 0.0f)
        return JOX_MINDS_CROSSING;
    if (a->bound[i] && a->bound[i] == a->bound[j]) {
        bool first = a->way[j] != a->way[i] ? a->way[j] < a->way[i] : a->id[j] < a->id[i];
        return first ? JOX_MINDS_AHEAD : JOX_MINDS_NOT;
    }
    if (jox_dot(own, other) > JOX_SAME_WAY)
        return jox_dot(offset, own) > 0.0f ? JOX_MINDS_AHEAD : JOX_MINDS_NOT;
    return JOX_MINDS_CROSSING;
}

/* Distance of the centres, m, within which i's way and j's are one, by how i minds j. */
static inline float jox_walk_width(const JoxWalkLaw *law, const JoxAgents *a, uint32_t i,
                                   uint32_t j, JoxMinds minds) {
    const JoxParameterColumn radius = a->param[JOX_PARAM_radius];
    float radii = jox_at(radius, i) + jox_at(radius, j);
    if (minds == JOX_MINDS_CROSSING)
        return radii * (float)law->width_cross;
    return radii * (float)law->width * (1.0f - (float)law->room_eager * a->eager[i]);
}

#endif
