/* A contact of an agent with a body ("touch"). contact/bodies_*.c find and solve touches; support/
   reads which bodies they press on. */
#ifndef JOX_FORCE_BODY_TOUCH_H
#define JOX_FORCE_BODY_TOUCH_H

#include "geom/objects.h"

typedef struct JoxTouch {
    uint32_t agent, object;           /* index of the agent, row of the body */
    JoxV2 normal;                     /* points to the agent */
    JoxV3 point;                      /* m */
    float gap, target, mass, impulse; /* m, m/s, kg, N s */
    float lever;                      /* of the impulse on the agent (JoxContactPoint) */
    float before;                     /* N s: impulse before a pass */
    float ahead;   /* driven bodies: share of the body's speed that is towards the agent, 0 to 1 */
    int16_t drive; /* index of the body's drive, or -1 */
} JoxTouch;

/* m: bodies nearer than this touch. Bullet lets them tremble by tenths of a millimetre, which in a
   short step would alter the force between them noticeably. */
#define JOX_BODY_SLACK 1e-3f
#define JOX_CHEST 1.1f /* m: height at which agents push and are hit */

/* Returns the height at which an agent meets a body, m: chest height, clamped to the body's
   extent. */
static inline float jox_touch_height(const JoxObject *body) {
    return jox_minf(jox_maxf(JOX_CHEST, body->low), body->high);
}

#endif
