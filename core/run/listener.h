/* Who collects what happens in a run: the recorder, probes, figures of danger, reports, the live
   page, the line of progress. Each kind of listener says what it wants to be told; a scene holds
   the listeners that were attached to it, and none of them changes what happens. */
#ifndef JOX_RUN_LISTENER_H
#define JOX_RUN_LISTENER_H

#include "base/sections.h"
#include "base/text.h"
#include "jostle.h"

/* Functions that a kind does not need are NULL. `self` is the listener's own data, `size` bytes
   that begin as zeros. */
typedef struct JoxListenerKind {
    const char *name; /* what it collects, for messages */
    size_t size;
    /* It was attached: `options` as given to jox_run_listen. False with `error` refuses. */
    bool (*begin)(void *self, JoScene *scene, const void *options, JoError *error);
    /* After each step: sources, the world's step, sinks. False with `error` ends the run. */
    bool (*frame)(void *self, JoScene *scene, JoError *error);
    /* A reload has added a machine, or put a version with other states in its place. */
    void (*replaced)(void *self, JoScene *scene, uint32_t machine);
    /* What its future depends on, as sections, where it goes on in a resumed run (NULL: it begins
       anew); it is then all written that was collected. */
    void (*sections)(void *self, JoxSections *sections);
    /* In a resumed run it takes up by itself what the checkpoint has of it: after `begin`, or, if
       it was attached while the scene was loaded, once the state is there. */
    bool goes_on;
    /* Has all on the disk that was written so far. False with `error`. */
    bool (*settle)(void *self, JoError *error);
    /* The run has ended, once: what is left to write is written. False with `error` if that failed.
       What was collected can still be read. */
    bool (*end)(void *self, JoScene *scene, JoError *error);
    /* Frees what `self` refers to. */
    void (*release)(void *self);
} JoxListenerKind;

typedef struct JoxListener {
    const JoxListenerKind *kind;
    void *self;
} JoxListener;

/* In the order in which they were attached. */
typedef struct JoxListeners {
    JoxListener *items;
    uint32_t count;
    size_t capacity;
} JoxListeners;

/* Attaches one and returns its `self`; NULL with `error` (which may be NULL) if it refused. */
void *jox_run_listen(JoScene *scene, const JoxListenerKind *kind, const void *options,
                     JoError *error);
/* `self` of the scene's listener of a kind, or NULL. */
void *jox_run_listener(const JoScene *scene, const JoxListenerKind *kind);
/* Tells all of them. All are told even where one fails; the first failure is in `error`. */
bool jox_run_tell_frame(JoScene *scene, JoError *error);
void jox_run_tell_replaced(JoScene *scene, uint32_t machine);
bool jox_run_tell_end(JoScene *scene, JoError *error);
void jox_run_release_listeners(JoScene *scene);
/* Whether the step just done is one of those that come every `interval` seconds; every step if that
   is longer than the interval. */
bool jox_run_is_due(const JoScene *scene, double interval);

/* Name of the piece (base/format/piece_file.h) of a checkpoint that is the name of a kind of
   listener, a zero, and its sections. */
#define JOX_PIECE_LISTENER "listener"
/* Gives a listener what one of its kind had, by the checkpoint that the scene was resumed from.
   False with `error` where it has none such. */
bool jox_run_take_up(const JoScene *scene, const JoxListenerKind *kind, void *self, JoError *error);
/* The same for all that are attached and go on. */
bool jox_run_take_up_all(JoScene *scene, JoError *error);

#endif
