/* Patches, by which mods change a scene (YAML) or a behaviour (Lua tables). Both are trees, merged
   by one algorithm (jox_patch_apply) through functions of the tree (JoxPatchTree). Every path that
   is set is kept with its position in the patch, so that `jostle why` can name it, and so that two
   mods that set the same path without one depending on the other give a warning. */
#ifndef JOX_BASE_FORMAT_PATCH_H
#define JOX_BASE_FORMAT_PATCH_H

#include <stddef.h>

#include "base/format/mod.h"

enum { JOX_PATCH_PATH = 512, JOX_PATCH_ID = 128 }; /* bytes of paths and of ids of items */

/* ---- the list of changes ---- */

/* One change: all at and below `path` comes from `from` in the file `source`. */
typedef struct JoxPatchChange {
    char *path;      /* in the patched tree: "states.Circle.push"; items by their ids */
    char *from;      /* in the file that sets it */
    uint32_t source; /* number of that file */
    int32_t mod;     /* index of the mod; -1: the patched file itself */
    bool removes;    /* the path is removed */
    bool extends;    /* what stood there goes on to work (JoxPatchTree.extend) */
    JoxPosition position;
    const void *value; /* node that sets it, in the tree's memory */
} JoxPatchChange;

typedef struct JoxPatchChanges {
    JoxPatchChange *items;
    uint32_t count;
    size_t capacity;
} JoxPatchChanges;

/* Appends a change, whose texts are copied. Warns of a conflict with an earlier change of another
   mod
   (`mods`; NULL: no check). Reports one error if there are more than a few thousand changes, and
   keeps no more. */
void jox_patch_keep(JoxPatchChanges *changes, JoxPatchChange change, const JoxMod *mods,
                    JoxDiagnostics *diagnostics);
/* Returns the last change of a path or of one of its parents; NULL if there is none. */
const JoxPatchChange *jox_patch_leading(const JoxPatchChanges *changes, const char *path);
/* Whether a change's path is `path` or a parent of it; then *rest is the part of `path` behind
   it. */
bool jox_patch_leads(const JoxPatchChange *change, const char *path, const char **rest);
void jox_patch_changes_free(JoxPatchChanges *changes);
/* Joins "a" and "b" to "a.b"; one of them may be "". A path that is too long is cut. */
void jox_patch_join(char path[JOX_PATCH_PATH], const char *prefix, const char *key);

/* Whether a patch's target is the file at `path`: its name without the ending, or, if it belongs to
   a mod, "mod:name". */
bool jox_patch_is_target(const char *target, const char *path, const JoxMod *mods,
                         uint32_t mod_count);

/* ---- merging ---- */

/* Kinds of nodes: a value; a mark that removes a key; a node with keys (and possibly items too); a
   list of items. */
typedef enum { JOX_PATCH_LEAF, JOX_PATCH_NOTHING, JOX_PATCH_MAP, JOX_PATCH_LIST } JoxPatchKind;

/* Operations on items that have ids. */
typedef enum {
    JOX_PATCH_CHANGE,
    JOX_PATCH_REPLACE,
    JOX_PATCH_BEFORE,
    JOX_PATCH_AFTER,
    JOX_PATCH_REMOVE,
    JOX_PATCH_APPEND,
    JOX_PATCH_VERBS
} JoxPatchVerb;
extern const char *const jox_patch_verbs[JOX_PATCH_VERBS]; /* "change", ... */

/* A place in a patch: member `key` of `map`; or the node `value` itself, with `map` NULL. */
typedef struct JoxPatchPlace {
    const char *from; /* path in the patch's file */
    void *map, *value;
    const char *key;
} JoxPatchPlace;

/* Functions of a tree, whose nodes are opaque here; `c` is the context. A node may be referred to
   from several places, so that only copies made by `copy` are ever changed. */
typedef struct JoxPatchTree {
    void *context;
    JoxPatchKind (*kind)(void *c, void *node);
    void *(*copy)(void *c, void *node);
    /* Lists the keys of a patch's node in a fixed order. `path`: the node that they change; NULL:
       the keys are ids of items. */
    uint32_t (*keys)(void *c, void *map, const char *path, const char *from,
                     const char *const **keys);
    void *(*get)(void *c, void *map, const char *key); /* NULL: no such key */
    void (*set)(void *c, void *map, const char *key, const JoxPatchPlace *at, void *value);
    void (*remove)(void *c, void *map, const char *key);
    uint32_t (*count)(void *c, void *node); /* number of items */
    void *(*item)(void *c, void *node, uint32_t i);
    void (*put)(void *c, void *node, uint32_t i, void *item); /* NULL: marks it as removed */
    void (*insert)(void *c, void *node, uint32_t i, void *item);
    void (*sweep)(void *c, void *node);       /* drops items that are marked as removed */
    const char *(*text)(void *c, void *leaf); /* NULL: the leaf is no text */
    bool (*is_item)(void *c, void *node, uint32_t i, const char *id); /* false for removed items */
    /* Returns an item to insert into the node at `path`, with an unused id in `id` (or `keep`,
       unless NULL); NULL with an error. */
    void *(*admit)(void *c, void *node, void *item, const char *path, const char *keep,
                   const JoxPatchPlace *at, char id[JOX_PATCH_ID]);
    JoxPosition (*position)(void *c, const JoxPatchPlace *at);
    /* Called before a patch's node is merged into a copy; reports errors. Returns whether the
       node's items have ids. */
    bool (*enter)(void *c, void *copy, void *change, const char *path, const char *from, int depth);
    /* Whether a key of the patch is ignored; may report an error. */
    bool (*skips)(void *c, void *copy, const JoxPatchPlace *at, int depth);
    /* Report a key or item that does not exist, or a verb whose value has the wrong kind. */
    void (*missing)(void *c, void *node, const char *name, const JoxPatchPlace *at, bool item);
    void (*misused)(void *c, JoxPatchVerb verb, const JoxPatchPlace *at);
    /* Returns the node that a key gets if `at->value` extends what is there, `now` or NULL, and
       does not replace it; NULL if it replaces it. NULL: no value extends another. */
    void *(*extend)(void *c, void *now, const JoxPatchPlace *at);
    const char *item_mark; /* prefix of ids in paths */
    unsigned verbs;        /* bit set of the JoxPatchVerb that the tree has */
    bool keys_are_ids;     /* in a patch of a list, keys other than verbs are ids of items */
    bool lists_merge;      /* a list is merged into a node with keys; else it replaces the node */
    int deepest;           /* levels that are merged; deeper nodes are replaced */
} JoxPatchTree;

typedef struct JoxPatch {
    const JoxPatchTree *tree;
    JoxPatchChanges *changes;
    const JoxMod *mods;
    int32_t mod;     /* index of the mod that has the patch */
    uint32_t source; /* number of the patch's file */
    JoxDiagnostics *diagnostics;
} JoxPatch;

/* Returns a copy of `base` with `change` merged in, and appends what it sets to the list. */
void *jox_patch_apply(const JoxPatch *patch, void *base, void *change);
/* Appends to the list that the patch replaces the whole tree. */
void jox_patch_replaces(const JoxPatch *patch, void *value);

#endif
