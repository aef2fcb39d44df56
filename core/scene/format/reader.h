/* The context that all functions reading a tree of YAML share (memory, errors, format), and the
   errors that they report. */
#ifndef JOX_SCENE_READER_H
#define JOX_SCENE_READER_H

#include "scene/format/yaml.h"

typedef struct JoxReader {
    JoxArena *arena; /* owns all that is read */
    JoxDiagnostics *diagnostics;
    const struct JoxFormat *format; /* see keys.h */
    struct JoxSceneDraft *draft;    /* the scene that is being read, see scene_draft.h; or NULL */
} JoxReader;

/* Reports an error at a node; `hint` may be NULL. */
void jox_scene_error(const JoxReader *reader, const JoxYaml *node, const char *code,
                     const char *hint, const char *format, ...)
    __attribute__((format(printf, 5, 6)));
/* Whether `name` is allowed as the name of a `what` ("group"); reports an error if not. */
bool jox_scene_check_name(const JoxReader *reader, JoxPosition at, const char *what,
                          const char *name);
/* Returns the hint "Did you mean 'x'?", in the arena, for a misspelt word; NULL if no name is
   near. */
const char *jox_scene_suggest(const JoxReader *reader, const char *word, const char *const *names,
                              size_t count);

#endif
