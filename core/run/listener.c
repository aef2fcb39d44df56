#include "run/listener.h"

#include <string.h>

#include "base/assert.h"
#include "base/format/piece_file.h"
#include "base/guard.h"
#include "base/mem.h"
#include "run/run.h"

bool jox_run_is_sample_due(const JoScene *scene, double interval) {
    const JoWorld *world = scene->world;
    uint64_t every = (uint64_t)jox_maxf(1.0f, (float)(interval / world->model.def.dt + 0.5));
    return world->state.tick % every == 0;
}

void *jox_run_find_listener(const JoScene *scene, const JoxListenerKind *kind) {
    for (uint32_t l = 0; l < scene->listeners.count; l++)
        if (scene->listeners.items[l].kind == kind)
            return scene->listeners.items[l].self;
    return NULL;
}

bool jox_run_tell_frame(JoScene *scene, JoError *error) {
    bool good = true;
    for (uint32_t l = 0; l < scene->listeners.count; l++) {
        const JoxListener *listener = &scene->listeners.items[l];
        if (listener->kind->frame)
            good = listener->kind->frame(listener->self, scene, good ? error : NULL) && good;
    }
    return good;
}

void jox_run_tell_replaced(JoScene *scene, uint32_t machine) {
    for (uint32_t l = 0; l < scene->listeners.count; l++) {
        const JoxListener *listener = &scene->listeners.items[l];
        if (listener->kind->replaced)
            listener->kind->replaced(listener->self, scene, machine);
    }
}

void jox_run_tell_reloaded(JoScene *scene, const JoxReloadNews *news) {
    for (uint32_t l = 0; l < scene->listeners.count; l++) {
        const JoxListener *listener = &scene->listeners.items[l];
        if (listener->kind->reloaded)
            listener->kind->reloaded(listener->self, scene, news);
    }
}

bool jox_run_tell_end(JoScene *scene, JoError *error) {
    bool good = true;
    for (uint32_t l = 0; l < scene->listeners.count; l++) {
        const JoxListener *listener = &scene->listeners.items[l];
        if (listener->kind->end)
            good = listener->kind->end(listener->self, scene, good ? error : NULL) && good;
    }
    return good;
}

void jox_run_release_listeners(JoScene *scene) {
    JoxListeners *all = &scene->listeners;
    while (all->count) {
        const JoxListener *listener = &all->items[--all->count];
        if (listener->kind->release)
            listener->kind->release(listener->self);
        jox_free(listener->self);
    }
    jox_free(all->items);
    all->items = NULL;
    all->capacity = 0;
}

/* Finds the piece of a kind of listener in the checkpoint; data NULL: there is none. */
static JoxPiece find_piece(const JoScene *scene, const JoxListenerKind *kind) {
    char why[200];
    JoxPiece piece;
    for (size_t at = 0; jox_pieces_next(&scene->resumed, &at, &piece, why);)
        if (strcmp(piece.name, JOX_PIECE_LISTENER) == 0 && strlen(piece.data) < piece.length &&
            strcmp(piece.data, kind->name) == 0)
            return piece;
    return (JoxPiece){0};
}

bool jox_run_restore_listener(const JoScene *scene, const JoxListenerKind *kind, void *self,
                              JoError *error) {
    if (!scene->resumed.length) {
        jox_error(error, JO_USAGE, "the %s goes on in resumed scenes alone", kind->name);
        return false;
    }
    const JoxPiece piece = find_piece(scene, kind);
    if (!piece.data) {
        jox_error(error, JO_INPUT, "the checkpoint has nothing of the %s", kind->name);
        return false;
    }
    const size_t head = strlen(piece.data) + 1;
    JoxSections s = jox_sections_restore(piece.data + head, piece.length - head);
    if (!s.failed)
        kind->sections(self, &s);
    if (jox_sections_end(&s))
        return true;
    jox_error(error, JO_INPUT, "the %s cannot be taken up: %s", kind->name, s.wrong);
    return false;
}

/* Whether the checkpoint holds the state of a listener that goes on; else it begins now. */
static bool continues_from_checkpoint(const JoScene *scene, const JoxListenerKind *kind) {
    return kind->goes_on && scene->resumed.length && find_piece(scene, kind).data;
}

bool jox_run_restore_listeners(JoScene *scene, JoError *error) {
    for (uint32_t l = 0; l < scene->listeners.count; l++) {
        const JoxListener *listener = &scene->listeners.items[l];
        if (continues_from_checkpoint(scene, listener->kind) &&
            !jox_run_restore_listener(scene, listener->kind, listener->self, error))
            return false;
    }
    return true;
}

void *jox_run_attach_listener(JoScene *scene, const JoxListenerKind *kind, const void *options,
                              JoError *error) {
    JoxListeners *all = &scene->listeners;
    void *self = jox_alloc(1, kind->size);
    if ((kind->begin && !kind->begin(self, scene, options, error)) ||
        (continues_from_checkpoint(scene, kind) &&
         !jox_run_restore_listener(scene, kind, self, error))) {
        if (kind->release)
            kind->release(self);
        jox_free(self);
        return NULL;
    }
    JOX_RESERVE(all->items, all->capacity, all->count + 1);
    all->items[all->count++] = (JoxListener){kind, self};
    return self;
}
