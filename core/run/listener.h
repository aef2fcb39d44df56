/* Listeners collect what happens in a run: the recorder, probes, danger, reports, the live page,
   the line of progress. A kind of listener is a table of functions, which step_scene.c calls
   after each step and at the end, in the order in which listeners were attached. A scene holds
   its listeners; none of them changes what happens. */
#ifndef JOX_RUN_LISTENER_H
#define JOX_RUN_LISTENER_H

#include "base/sections.h"
#include "base/text.h"
#include "jostle.h"
#include "machine/machine.h"

/* A kind of listener. Functions that it does not need are NULL. `self` is the listener's own
   data: `size` bytes, zeros at first, freed by the scene. */
/* What a reload of an edited file changed. The pointers are valid during the call alone. */
typedef struct JoxReloadNews {
    const char *path; /* of the behaviour, or of the scene */
    /* A behaviour: the machine before and after, how many people were in each state of either, and
       lines on memory that is kept or dropped. NULL: the scene's file. */
    const JoxMachine *old, *next;
    const uint32_t *before, *after;
    const char *notes;
    const char *done, *later; /* the scene's file: what changed; what waits for the next start */
} JoxReloadNews;

typedef struct JoxListenerKind {
    const char *name; /* for messages, and its key in a checkpoint: "recording" */
    size_t size;
    /* Called when the listener is attached, with the `options` of jox_run_attach_listener. False
       with `error` refuses. */
    bool (*begin)(void *self, JoScene *scene, const void *options, JoError *error);
    /* Called after each step. False with `error` ends the run. */
    bool (*frame)(void *self, JoScene *scene, JoError *error);
    /* Called when a reload has added a machine, or replaced it by a version with other states. */
    void (*replaced)(void *self, JoScene *scene, uint32_t machine);
    /* Called with what a reload changed, before the same is sent as text, and with NULL after
       that. */
    void (*reloaded)(void *self, JoScene *scene, const JoxReloadNews *news);
    /* Lists, as sections, the state that the listener needs to go on in a resumed run; what it
       collected was put on the disk by `settle` before. NULL: it begins anew there. */
    void (*sections)(void *self, JoxSections *sections);
    /* In a resumed run its state is restored from the checkpoint without being asked for: after
       `begin`, or, if it is attached while the scene is loaded, once the world's state is there. */
    bool goes_on;
    /* Puts all that was written so far on the disk. False with `error`. */
    bool (*settle)(void *self, JoError *error);
    /* Called once, when the run has ended: writes what is left to write. False with `error` if
       that failed. What was collected can still be read. */
    bool (*end)(void *self, JoScene *scene, JoError *error);
    /* Frees what `self` refers to. */
    void (*release)(void *self);
} JoxListenerKind;

typedef struct JoxListener {
    const JoxListenerKind *kind;
    void *self;
} JoxListener;

/* Listeners of a scene, in the order in which they were attached. */
typedef struct JoxListeners {
    JoxListener *items;
    uint32_t count;
    size_t capacity;
} JoxListeners;

/* Attaches a listener and returns its `self`; NULL with `error` (may be NULL) if it refused. */
void *jox_run_attach_listener(JoScene *scene, const JoxListenerKind *kind, const void *options,
                              JoError *error);
/* Returns `self` of the scene's listener of a kind, or NULL. */
void *jox_run_find_listener(const JoScene *scene, const JoxListenerKind *kind);
/* Call the function of that name of all listeners, also after one has failed; `error` holds the
   first failure. */
bool jox_run_tell_frame(JoScene *scene, JoError *error);
void jox_run_tell_replaced(JoScene *scene, uint32_t machine);
void jox_run_tell_reloaded(JoScene *scene, const JoxReloadNews *news);
bool jox_run_tell_end(JoScene *scene, JoError *error);
void jox_run_release_listeners(JoScene *scene);
/* Whether the step just done is one of those that come every `interval` seconds; every step if that
   is longer than the interval. */
bool jox_run_is_sample_due(const JoScene *scene, double interval);

/* Name of a checkpoint's pieces (base/format/piece_file.h) that hold listeners. Such a piece is the
   name of the kind, a zero, and its sections. */
#define JOX_PIECE_LISTENER "listener"
/* Restores the state of a listener from the checkpoint that the scene was resumed from. False
   with `error` if that has none. */
bool jox_run_restore_listener(const JoScene *scene, const JoxListenerKind *kind, void *self,
                              JoError *error);
/* Restores all listeners that are attached and go on. */
bool jox_run_restore_listeners(JoScene *scene, JoError *error);

#endif
