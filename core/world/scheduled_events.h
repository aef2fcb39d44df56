/* Events of a scene at given times: gates open and close, bodies are thrown or driven, signals are
   sent, agents and bodies are pushed for a while. */
#ifndef JOX_WORLD_SCHEDULED_EVENTS_H
#define JOX_WORLD_SCHEDULED_EVENTS_H

#include <stdint.h>

#include "base/format/diag.h"
#include "base/text.h"

typedef struct JoWorld JoWorld;

typedef enum JoxEventKind {
    JOX_EVENT_THROW,
    JOX_EVENT_MOVE,
    JOX_EVENT_OPEN,
    JOX_EVENT_CLOSE,
    JOX_EVENT_SIGNAL,
    JOX_EVENT_LIFT,
    JOX_EVENT_PUSH
} JoxEventKind;

/* One event. The caller of jox_world_set_events owns it. */
typedef struct JoxEvent {
    JoxEventKind kind;
    double at, every, until;     /* s: first time, interval (0: once), last time */
    char *name;                  /* name of a body, of walls, of a lift, or of a signal */
    uint32_t mode;               /* lift: JoxLiftMode */
    bool placed;                 /* thrown from `from`, else from where it lies */
    double from[3];              /* m: origin of the shape's frame */
    double velocity[3], spin[3]; /* m/s, rad/s */
    int32_t place;               /* push: place whose agents are pushed; -1: body `name` */
    double force[2], lasts;      /* push: N on each; duration, s */
    JoxPosition position;
} JoxEvent;

/* Sets the events of a world, in place of those before. The caller keeps them until they are
   replaced. */
void jox_world_set_events(JoWorld *world, const JoxEvent *events, uint32_t count);
/* Runs the events that are due, before a step. They follow from the number of the step alone: there
   is no state, and an edited list continues from there. Failed events add a line to
   scratch.messages. */
void jox_world_run_events(JoWorld *world);

/* The actions of events, which verbs call too: throw or drive a body, open or close walls, send a
   signal; m, m/s, rad/s. `from` NULL: from where the body lies. Return false, with a sentence in
   `why`, if nothing has the name or a number is out of range. */
bool jox_event_throw(JoWorld *world, const char *body, const double from[3],
                     const double velocity[3], const double spin[3], JoxText *why);
bool jox_event_move(JoWorld *world, const char *body, const double velocity[3],
                    const double spin[3], JoxText *why);
bool jox_event_open(JoWorld *world, const char *wall, bool open, JoxText *why);
bool jox_event_signal(JoWorld *world, const char *name, JoxText *why);
/* Sets the mode of a lift, or of `all`. */
bool jox_event_lift(JoWorld *world, const char *lift, uint32_t mode, JoxText *why);
/* Appends that no `kind` has a name, and suggests the nearest of `names`; returns false. */
bool jox_event_refuse_name(const char *kind, const char *name, const char *const *names,
                           uint32_t count, JoxText *why);

#endif
