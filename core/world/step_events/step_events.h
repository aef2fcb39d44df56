/* What happened in a step, for programs that ask (jo_world_events). */
#ifndef JOX_WORLD_STEP_EVENTS_H
#define JOX_WORLD_STEP_EVENTS_H

#include "agents/agents.h"
#include "body/body.h"
#include "geom/field/field.h"
#include "jostle.h"

/* Who was there when events were read last, by id; and who pressed on what, by ids. */
typedef struct JoxSeenAgent {
    uint32_t id, group, grasped; /* the last: id + 1 of whom it holds, or 0 */
    float x, y;
} JoxSeenAgent;
typedef struct JoxSeenTouch {
    uint32_t agent, kind, other;
} JoxSeenTouch;

/* Zero-initialise. Scratch: no step reads it. */
typedef struct JoxStepEvents {
    /* Noted by the step. */
    JoHitEvent *hits;
    JoBreakEvent *breaks;
    uint32_t hit_count, break_count;
    size_t hit_capacity, break_capacity;
    /* Of the last question. */
    uint64_t tick; /* of which the rest is, plus 1; 0: nobody asked yet */
    uint32_t next_id, count;
    JoTransitionEvent *transitions;
    JoTouchEvent *touches;
    JoPresenceEvent *entered, *left;
    JoSaidEvent *said;
    JoActionEvent *actions;
    JoxSeenAgent *seen, *seeing;
    JoxSeenTouch *touched, *touching;
    uint32_t transition_count, touch_count, entered_count, left_count, said_count, action_count,
        seen_count, touched_count;
    size_t transition_capacity, touch_capacity, entered_capacity, left_capacity, said_capacity,
        action_capacity, seen_capacity, seeing_capacity, touched_capacity, touching_capacity;
    /* The way that was asked for last. */
    JoxField *field;
    JoxFieldMarks *marks;
    uint32_t field_place, field_walls;
} JoxStepEvents;

/* A step begins. */
void jox_step_events_clear(JoxStepEvents *step_events);
/* What bodies did in a substep. */
void jox_step_events_add_bodies(JoxStepEvents *step_events, const JoxBodiesReport *report,
                                const JoxDisc *discs);
void jox_step_events_free(JoxStepEvents *step_events);

#endif
