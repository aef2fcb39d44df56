/* YAML files as trees of nodes, each with its position: included files are merged (yaml_files.c),
   aliases resolved, sizes bounded. A tree lives in an arena, which is freed as a whole. */
#ifndef JOX_SCENE_YAML_H
#define JOX_SCENE_YAML_H

#include <stdint.h>

#include "base/format/diag.h"

/* Memory that is freed all at once, with the scene that it belongs to. */
typedef struct JoxArena JoxArena;
JoxArena *jox_arena_create(void);
void *jox_arena_take(JoxArena *arena, size_t count, size_t size); /* zeroed */
char *jox_arena_text(JoxArena *arena, const char *text);          /* a copy; NULL for NULL */
void jox_arena_free(JoxArena *arena);

enum { JOX_YAML_DEEPEST = 64 }; /* levels of nesting */
typedef enum { JOX_YAML_SCALAR, JOX_YAML_LIST, JOX_YAML_MAP } JoxYamlKind;
typedef struct JoxYaml JoxYaml;
struct JoxYaml {
    JoxYamlKind kind;
    const char *text;  /* text of a scalar */
    bool quoted;       /* the scalar stands in quotes */
    JoxYaml **items;   /* items of a list; values of a map */
    const char **keys; /* keys of a map, and their positions */
    JoxPosition *key_positions;
    uint32_t count, capacity; /* number of items, and room for them */
    JoxPosition position;
};

typedef struct JoxYamlFile {
    char *path;
    char sha256[65];
    char *text;
    size_t length;
} JoxYamlFile;
/* Kind of a file, by which messages name it. */
typedef enum JoxYamlRole { JOX_YAML_SCENE, JOX_YAML_MOD, JOX_YAML_PATCH } JoxYamlRole;
/* The files that have been read for one scene or mod. */
typedef struct JoxYamlFiles {
    JoxYamlFile items[64];
    uint32_t count;
    uint64_t nodes; /* nodes of all trees: their sum is bounded */
    JoxYamlRole role;
    bool untrusted; /* a mod's: may include files beside it only, and no links */
} JoxYamlFiles;

/* Reads a file, or `text` under the name `path`, with what it includes, and appends the files to
   the list; NULL with errors. */
JoxYaml *jox_yaml_read(JoxArena *arena, const char *path, const char *text, size_t length,
                       JoxYamlFiles *files, JoxDiagnostics *diagnostics);
/* Gives diagnostics the lines of these files. */
void jox_yaml_attach_sources(const JoxYamlFiles *files, JoxDiagnostics *diagnostics);
/* Whether two trees hold the same, whatever their positions. Both may be NULL. */
bool jox_yaml_same(const JoxYaml *a, const JoxYaml *b);
/* Returns a map's value; NULL if `map` is NULL, not a map, or lacks the key. */
JoxYaml *jox_yaml_get(const JoxYaml *map, const char *key);
/* Returns the slot of a map's value, or of a list's item by its number from 0 or its `name`; NULL
   if there is none. */
JoxYaml **jox_yaml_slot(const JoxYaml *node, const char *key);
/* Returns the text of a map's key `name`; NULL if the node is no map or has no such text. */
const char *jox_yaml_name(const JoxYaml *node);
/* Sets `map[key]`, which may be new. */
void jox_yaml_set(JoxArena *arena, JoxYaml *map, const char *key, JoxYaml *value);
/* Sets `map[key]` and the key's position. */
void jox_yaml_set_at(JoxArena *arena, JoxYaml *map, const char *key, JoxPosition at,
                     JoxYaml *value);
void jox_yaml_remove(JoxYaml *map, const char *key);
void jox_yaml_append(JoxArena *arena, JoxYaml *list, JoxYaml *item);
/* Adds a key that the map does not have, or an item of a list (then `key` and `at` are ignored). */
void jox_yaml_add(JoxArena *arena, JoxYaml *node, const char *key, JoxPosition at, JoxYaml *value);
/* Adds to the map the keys of `base` that it lacks; recursively where both have a map. A map in
   place of a list changes the list's items by their `name`. */
void jox_yaml_merge(JoxArena *arena, JoxYaml *map, const JoxYaml *base);
/* Returns a shallow copy: its list of items can be changed, the items are shared. An aliased node
   stands at several places of a tree, so copy it before changing one of them. */
JoxYaml *jox_yaml_copy(JoxArena *arena, const JoxYaml *node);
/* Returns the path `name` as seen from the folder of `file`; an absolute path is unchanged. */
char *jox_arena_beside(JoxArena *arena, const char *file, const char *name);

#endif
