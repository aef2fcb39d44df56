/* Impulses on bodies: pushes and contacts add them in any order; body/ applies them sorted by the
   agent's id, then row, so that neither threads nor the order in memory change a bit. */
#ifndef JOX_FORCE_IMPULSES_H
#define JOX_FORCE_IMPULSES_H

#include "geom/objects.h"

/* An impulse with its sort key: agent id, then row. Impulses of equal keys keep their order. */
typedef struct JoxPendingImpulse {
    uint64_t key;
    JoxImpulse impulse;
} JoxPendingImpulse;

/* The impulses of a step. Zero-initialise; it owns its arrays. */
typedef struct JoxImpulses {
    JoxPendingImpulse *pending;
    JoxImpulse *sorted;           /* copies of the pending ones, valid for the first sorted_count */
    uint32_t count, sorted_count; /* pending; sorted the last time */
    size_t capacity, sorted_capacity;
} JoxImpulses;

/* Adds the impulse that an agent gives the body of a row at a point, N s; `lasting` as in
   JoxImpulse. */
void jox_impulses_add(JoxImpulses *impulses, uint32_t agent_id, uint32_t row, JoxV3 impulse,
                      JoxV3 point, float lasting);
/* Returns all impulses in the order of their keys; valid until the next one is added. */
const JoxImpulse *jox_impulses_sort(JoxImpulses *impulses, uint32_t *count);
void jox_impulses_free(JoxImpulses *impulses);

#endif
