/* Patches of trees: what a mod changes in a scene (YAML) or in a behaviour (Lua tables). One engine
   merges both; a tree gives the operations on its nodes. Every path that is set is kept with where
   it was set, and two mods that set one path without knowing each other are named. */
#ifndef JOX_BASE_FORMAT_PATCH_H
#define JOX_BASE_FORMAT_PATCH_H

#include <stddef.h>

#include "base/format/mod.h"

enum { JOX_PATCH_PATH = 512, JOX_PATCH_ID = 128 }; /* bytes of paths and of ids of items */

/* ---- what was set, and where ---- */

/* Everything at and below `path` stands at `from` in a source, in the order in which it was set. */
typedef struct JoxPatchChange {
    char *path; /* "states.Circle.push"; an item by its id */
    char *from; /* path in the file that set it */
    uint32_t source;
    int32_t mod; /* index, or -1: what is patched itself */
    bool removes;
    JoxPosition position;
    const void *value; /* node of the tree that set it, as long as the tree's memory */
} JoxPatchChange;

typedef struct JoxPatchChanges {
    JoxPatchChange *items;
    uint32_t count;
    size_t capacity;
} JoxPatchChanges;

/* Appends a change, whose texts are copied. Where a mod sets it, `mods` (NULL: none) are looked at
   for conflicts. Past a few thousand one error is reported, and no more are kept. */
void jox_patch_keep(JoxPatchChanges *changes, JoxPatchChange change, const JoxMod *mods,
                    JoxDiagnostics *diagnostics);
/* The last of the changes that leads to the path, NULL if none does. */
const JoxPatchChange *jox_patch_leading(const JoxPatchChanges *changes, const char *path);
/* Whether a change's path is `path` or leads to it; then *rest is what follows it in `path`. */
bool jox_patch_leads(const JoxPatchChange *change, const char *path, const char **rest);
void jox_patch_changes_free(JoxPatchChanges *changes);
/* "a.b" of "a" and "b"; one of them may be "". Cut where it is too long. */
void jox_patch_join(char path[JOX_PATCH_PATH], const char *prefix, const char *key);

/* Whether a patch's target is the file at `path`: by its name without the ending, or by "mod:name"
   alone for one that lies in a mod. */
bool jox_patch_is_target(const char *target, const char *path, const JoxMod *mods,
                         uint32_t mod_count);

/* ---- merging ---- */

/* A leaf; what takes a key away; a node with keys (and perhaps items besides); a list of items. */
typedef enum { JOX_PATCH_LEAF, JOX_PATCH_NOTHING, JOX_PATCH_MAP, JOX_PATCH_LIST } JoxPatchKind;

/* What is done to items that go by ids. */
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

/* Where something stands in the change: `key` of `map`, or the value itself where map is NULL. */
typedef struct JoxPatchPlace {
    const char *from; /* path in the change's file */
    void *map, *value;
    const char *key;
} JoxPatchPlace;

/* A tree: its nodes are the tree's own affair. `c` is the context. Nodes are never changed but for
   copies that the engine asked for: a node may stand at several places. */
typedef struct JoxPatchTree {
    void *context;
    JoxPatchKind (*kind)(void *c, void *node);
    void *(*copy)(void *c, void *node);
    /* Keys in a fixed order; `path` of what they change, NULL where they are ids. */
    uint32_t (*keys)(void *c, void *map, const char *path, const char *from,
                     const char *const **keys);
    void *(*get)(void *c, void *map, const char *key); /* NULL: none */
    void (*set)(void *c, void *map, const char *key, const JoxPatchPlace *at, void *value);
    void (*remove)(void *c, void *map, const char *key);
    uint32_t (*count)(void *c, void *node); /* of items */
    void *(*item)(void *c, void *node, uint32_t i);
    void (*put)(void *c, void *node, uint32_t i, void *item); /* NULL: taken away by sweep */
    void (*insert)(void *c, void *node, uint32_t i, void *item);
    void (*sweep)(void *c, void *node);       /* closes the gaps of items taken away */
    const char *(*text)(void *c, void *leaf); /* NULL: no text */
    bool (*is_item)(void *c, void *node, uint32_t i, const char *id); /* false for one taken away */
    /* An item that may be inserted into the node at `path`, with an id that is free (`keep`: this
     * one); NULL with an error.
     */
    void *(*admit)(void *c, void *node, void *item, const char *path, const char *keep,
                   const JoxPatchPlace *at, char id[JOX_PATCH_ID]);
    JoxPosition (*position)(void *c, const JoxPatchPlace *at);
    /* Before a change is merged into a copy: whether items go by ids; reports what is wrong. */
    bool (*enter)(void *c, void *copy, void *change, const char *path, const char *from, int depth);
    /* Whether a key of the change is to be left alone, perhaps with an error. */
    bool (*skips)(void *c, void *copy, const JoxPatchPlace *at, int depth);
    /* Reports a key or item that is not there, or a verb whose value is of the wrong kind. */
    void (*missing)(void *c, void *node, const char *name, const JoxPatchPlace *at, bool item);
    void (*misused)(void *c, JoxPatchVerb verb, const JoxPatchPlace *at);
    const char *item_mark; /* before ids in paths */
    unsigned verbs;        /* bits of those that the tree knows */
    bool keys_are_ids;     /* of a list's change: keys that are no verbs name items */
    bool lists_merge;      /* a list merges with a node that has keys; else it takes its place */
    int deepest;           /* levels that are merged */
} JoxPatchTree;

typedef struct JoxPatch {
    const JoxPatchTree *tree;
    JoxPatchChanges *changes;
    const JoxMod *mods;
    int32_t mod;     /* whose patch it is */
    uint32_t source; /* number of its file */
    JoxDiagnostics *diagnostics;
} JoxPatch;

/* A copy of `base` with `change` merged in. */
void *jox_patch_apply(const JoxPatch *patch, void *base, void *change);
/* Keeps that the patch takes the place of everything. */
void jox_patch_replaces(const JoxPatch *patch, void *value);

#endif
