/* The context that all functions reading a tree of YAML share (memory, errors, format), and the
   errors that they report. */
#ifndef JOX_SCENE_READER_H
#define JOX_SCENE_READER_H

#include "base/vec.h"
#include "scene/format/yaml.h"

/* Where points that are read come to lie, and the extent of all that have been read. */
typedef struct JoxPlacing {
    float shift;     /* m along y, added to points: that of the sheet of their storey */
    uint32_t copy;   /* which of the storeys of an item that is on several */
    JoxV2 low, high; /* m, of points before they are shifted; low is above high if there are none */
} JoxPlacing;

typedef struct JoxReader {
    JoxArena *arena; /* owns all that is read */
    JoxDiagnostics *diagnostics;
    const struct JoxFormat *format; /* see keys.h */
    struct JoxSceneDraft *draft;    /* the scene that is being read, see scene_draft.h; or NULL */
    JoxPlacing *placing;            /* of that scene; or NULL */
} JoxReader;

/* Reports an error at a node; `hint` may be NULL. */
void jox_scene_error(const JoxReader *reader, const JoxYaml *node, const char *code,
                     const char *hint, const char *format, ...)
    __attribute__((format(printf, 5, 6)));
/* Whether `name` is allowed as the name of a `what` ("group"); reports an error if not. */
bool jox_scene_check_name(const JoxReader *reader, JoxPosition at, const char *what,
                          const char *name);
/* Takes a point in plan into the extent of all points; returns its position on the sheet of the
   storey of the map that is being read. */
JoxV2 jox_scene_position(const JoxReader *reader, JoxV2 plan);
/* Returns the hint "Did you mean 'x'?", in the arena, for a misspelt word; NULL if no name is
   near. */
const char *jox_scene_suggest(const JoxReader *reader, const char *word, const char *const *names,
                              size_t count);

#endif
