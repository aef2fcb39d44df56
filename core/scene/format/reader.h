/* What is shared by all that reads a tree of YAML: where memory comes from, where errors go, the
   format that is read. */
#ifndef JOX_SCENE_READER_H
#define JOX_SCENE_READER_H

#include "scene/format/yaml.h"

typedef struct JoxReader {
    JoxArena *arena;
    JoxDiagnostics *diagnostics;
    const struct JoxFormat *format; /* see schema.h */
    struct JoxLoad *load;           /* the scene that is being read, see internal.h; or NULL */
} JoxReader;

void jox_scene_error(const JoxReader *reader, const JoxYaml *node, const char *code,
                     const char *hint, const char *format, ...)
    __attribute__((format(printf, 5, 6)));
/* Whether `name` can be that of a `what` ("group"); false with an error. */
bool jox_scene_name(const JoxReader *reader, JoxPosition at, const char *what, const char *name);
/* "Did you mean 'x'?" in a buffer of the arena, or NULL. */
const char *jox_scene_suggest(const JoxReader *reader, const char *word, const char *const *names,
                              size_t count);

#endif
