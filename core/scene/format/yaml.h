/* A YAML file as a tree with places: included files merged, aliases resolved, sizes capped. */
#ifndef JOX_SCENE_YAML_H
#define JOX_SCENE_YAML_H

#include <stdint.h>

#include "base/format/diag.h"

/* Memory that lives and dies with a scene. */
typedef struct JoxArena JoxArena;
JoxArena *jox_arena_create(void);
void *jox_arena_take(JoxArena *arena, size_t count, size_t size); /* zeroed */
char *jox_arena_text(JoxArena *arena, const char *text);
void jox_arena_free(JoxArena *arena);

enum { JOX_YAML_DEEPEST = 64 }; /* levels */
typedef enum { JOX_YAML_SCALAR, JOX_YAML_LIST, JOX_YAML_MAP } JoxYamlKind;
typedef struct JoxYaml JoxYaml;
struct JoxYaml {
    JoxYamlKind kind;
    const char *text; /* scalars */
    bool quoted;
    JoxYaml **items;   /* of lists; values of maps */
    const char **keys; /* of maps */
    JoxPosition *key_positions;
    uint32_t count, capacity;
    JoxPosition position;
};

typedef struct JoxYamlFile {
    char *path;
    char sha256[65];
    char *text;
    size_t length;
} JoxYamlFile;
/* What messages call a file. */
typedef enum JoxYamlRole { JOX_YAML_SCENE, JOX_YAML_MOD, JOX_YAML_PATCH } JoxYamlRole;
typedef struct JoxYamlFiles {
    JoxYamlFile items[64];
    uint32_t count;
    uint64_t nodes; /* of their trees: bounded in all */
    JoxYamlRole role;
    bool
        plain; /* of a mod, which is not trusted: only files beside it are included, and no links */
} JoxYamlFiles;

/* Reads a file, or `text` under the name `path`; NULL with diagnostics. Files read are listed. */
JoxYaml *jox_yaml_load(JoxArena *arena, const char *path, const char *text, size_t length,
                       JoxYamlFiles *files, JoxDiagnostics *diagnostics);
/* Whether two trees hold the same, wherever they stand. Both may be NULL. */
bool jox_yaml_same(const JoxYaml *a, const JoxYaml *b);
JoxYaml *jox_yaml_get(const JoxYaml *map, const char *key);
/* Sets `map[key]`, new or not. */
void jox_yaml_set(JoxArena *arena, JoxYaml *map, const char *key, JoxYaml *value);
/* The same with the key's position; takes the key away; adds an item to a list. */
void jox_yaml_put(JoxArena *arena, JoxYaml *map, const char *key, JoxPosition at, JoxYaml *value);
void jox_yaml_remove(JoxYaml *map, const char *key);
void jox_yaml_append(JoxArena *arena, JoxYaml *list, JoxYaml *item);
/* Adds a key that the map has not, or, of a list, an item: then `key` and `at` are not read. */
void jox_yaml_add(JoxArena *arena, JoxYaml *node, const char *key, JoxPosition at, JoxYaml *value);
/* Gives the map what it lacks of another; where both are maps, deeply. */
void jox_yaml_merge(JoxArena *arena, JoxYaml *map, const JoxYaml *base);
/* A copy whose own items can be changed; the items themselves are shared. An aliased node stands at
   several places of a tree, so copy before changing one of them. */
JoxYaml *jox_yaml_copy(JoxArena *arena, const JoxYaml *node);
/* A path beside another file: absolute paths stay as they are. */
char *jox_arena_beside(JoxArena *arena, const char *file, const char *name);

#endif
