/* Events of the last step, for programs (jo_world_events). The stage bodies adds hits and breaks;
   embed/step_event_calls.c finds the others when a program asks, and embed/route_calls.c keeps a
   field here. */
#ifndef JOX_WORLD_STEP_EVENTS_H
#define JOX_WORLD_STEP_EVENTS_H

#include "agents/agents.h"
#include "body/body.h"
#include "geom/field/field.h"
#include "jostle.h"

/* An agent that was there, and a contact that pressed, when events were read last. */
typedef struct JoxSeenAgent {
    uint32_t id, group, grasped; /* grasped: id + 1 of the agent that it holds, or 0 */
    float x, y;
    bool lies;
} JoxSeenAgent;
typedef struct JoxSeenTouch {
    uint32_t agent, kind, other;
} JoxSeenTouch;

/* Zero-initialise. Scratch: no step reads it. */
typedef struct JoxStepEvents {
    /* Added by the step. */
    JoHitEvent *hits;
    JoBreakEvent *breaks;
    uint32_t hit_count, break_count;
    size_t hit_capacity, break_capacity;
    /* Found at the last call of jo_world_events. */
    uint64_t tick; /* 1 + the tick of that call; 0: not called yet */
    uint32_t next_id, count;
    JoTransitionEvent *transitions;
    JoTouchEvent *touches;
    JoPresenceEvent *entered, *left;
    JoSaidEvent *said;
    JoActionEvent *actions;
    JoxSeenAgent *seen, *seeing;      /* agents by id: of the last call, and memory for the next */
    JoxSeenTouch *touched, *touching; /* contacts by ids, likewise */
    uint32_t transition_count, touch_count, entered_count, left_count, said_count, action_count,
        seen_count, touched_count;
    size_t transition_capacity, touch_capacity, entered_capacity, left_capacity, said_capacity,
        action_capacity, seen_capacity, seeing_capacity, touched_capacity, touching_capacity;
    /* Field of the last call of jo_world_path. */
    JoxField *field;
    JoxFieldMarks *marks;
    uint32_t field_place, field_walls;
} JoxStepEvents;

/* Clears hits and breaks at the start of a step. */
void jox_step_events_clear(JoxStepEvents *step_events);
/* Adds hits and breaks of a substep. */
void jox_step_events_add_bodies(JoxStepEvents *step_events, const JoxBodiesReport *report,
                                const JoxDisc *discs);
void jox_step_events_free(JoxStepEvents *step_events);

#endif
