/* What happens in a world at given times: walls open and close, bodies are thrown, signals sound,
   people and bodies are pushed for a while. */
#ifndef JOX_WORLD_EVENTS_H
#define JOX_WORLD_EVENTS_H

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
    JOX_EVENT_PUSH
} JoxEventKind;

/* What happens at given times. */
typedef struct JoxEvent {
    JoxEventKind kind;
    double at, every, until;     /* s; `every` 0: once */
    char *name;                  /* of the body or walls, or what is called out */
    bool placed;                 /* the body is thrown from `from`; else from where it lies */
    double from[3];              /* of the shape's own frame, m */
    double velocity[3], spin[3]; /* m/s, rad/s */
    int32_t place;               /* of a push: whoever stands in it; -1: the body of that name */
    double force[2], lasts;      /* of a push: N on each, s */
    JoxPosition position;
} JoxEvent;

/* Events of a world, in place of those before; they stay the caller's, and have to stay until they
   are replaced. */
void jox_world_set_events(JoWorld *world, const JoxEvent *events, uint32_t count);
/* Before a step: does what is due. It follows from the number of the step alone, so that an edited
   list goes on from there, and there is no state. What could not be done is added to
   `scratch.messages`, a line each. */
void jox_world_run_events(JoWorld *world);

/* What events do, by names; m, m/s, rad/s. False, with a sentence in `why`, where there is no such
   thing or a number is out of range. `from` NULL: from where the body lies. */
bool jox_event_throw(JoWorld *world, const char *body, const double from[3],
                     const double velocity[3], const double spin[3], JoxText *why);
bool jox_event_move(JoWorld *world, const char *body, const double velocity[3],
                    const double spin[3], JoxText *why);
bool jox_event_open(JoWorld *world, const char *wall, bool open, JoxText *why);
bool jox_event_signal(JoWorld *world, const char *name, JoxText *why);

#endif
