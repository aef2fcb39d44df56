#include "base/format/patch.h"

#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/format/path.h"
#include "base/mem.h"

enum { MOST_CHANGES = 4096 };

const char *const jox_patch_verbs[JOX_PATCH_VERBS] = {
    [JOX_PATCH_CHANGE] = "change",        [JOX_PATCH_REPLACE] = "replace",
    [JOX_PATCH_BEFORE] = "insert_before", [JOX_PATCH_AFTER] = "insert_after",
    [JOX_PATCH_REMOVE] = "remove",        [JOX_PATCH_APPEND] = "append"};

/* ---- the list of changes ---- */

/* Warns if another mod, which this one does not depend on, has set an overlapping path that this
   one does not extend. */
static void report_conflict(const JoxPatchChanges *changes, const JoxPatchChange *mine,
                            const JoxMod *mods, JoxDiagnostics *diagnostics) {
    for (uint32_t c = 0; c + 1 < changes->count && !mine->extends; c++) {
        const JoxPatchChange *other = &changes->items[c];
        if (other->mod < 0 || other->mod == mine->mod ||
            !jox_mod_overlaps(other->path, mine->path) || (mods[mine->mod].after >> other->mod & 1))
            continue;
        jox_mod_conflict(diagnostics, &mods[mine->mod], mine->position, &mods[other->mod],
                         other->position, mine->path);
        return;
    }
}

void jox_patch_keep(JoxPatchChanges *changes, JoxPatchChange change, const JoxMod *mods,
                    JoxDiagnostics *diagnostics) {
    JOX_ASSERT(change.path && change.mod < JOX_MOST_MODS);
    if (changes->count == MOST_CHANGES)
        jox_diag_error(diagnostics, change.position, "too-many", NULL,
                       "patches set more than %d things, here '%s'", MOST_CHANGES, change.path);
    if (changes->count > MOST_CHANGES) /* the one that was reported is the last */
        return;
    JOX_RESERVE(changes->items, changes->capacity, changes->count + 1);
    change.path = jox_strdup(change.path);
    change.from = jox_strdup(change.from ? change.from : "");
    changes->items[changes->count++] = change;
    if (change.mod >= 0 && mods)
        report_conflict(changes, &changes->items[changes->count - 1], mods, diagnostics);
}

bool jox_patch_leads(const JoxPatchChange *change, const char *path, const char **rest) {
    size_t n = strlen(change->path);
    if (strncmp(change->path, path, n) != 0 || (n && path[n] && path[n] != '.'))
        return false;
    *rest = path + n + (n && path[n] == '.');
    return true;
}

const JoxPatchChange *jox_patch_leading(const JoxPatchChanges *changes, const char *path) {
    const char *rest;
    for (uint32_t c = changes->count; c-- > 0;)
        if (jox_patch_leads(&changes->items[c], path, &rest))
            return &changes->items[c];
    return NULL;
}

void jox_patch_changes_free(JoxPatchChanges *changes) {
    for (uint32_t c = 0; c < changes->count; c++) {
        jox_free(changes->items[c].path);
        jox_free(changes->items[c].from);
    }
    jox_free(changes->items);
    *changes = (JoxPatchChanges){0};
}

void jox_patch_join(char path[JOX_PATCH_PATH], const char *prefix, const char *key) {
    snprintf(path, JOX_PATCH_PATH, "%.380s%s%.120s", prefix, *prefix && *key ? "." : "", key);
}

bool jox_patch_is_target(const char *target, const char *path, const JoxMod *mods,
                         uint32_t mod_count) {
    const char *stem = jox_path_name(path);
    const char *dot = strrchr(stem, '.');
    const size_t n = dot ? (size_t)(dot - stem) : strlen(stem);
    for (uint32_t m = 0; m < mod_count; m++) {
        const size_t name = strlen(mods[m].name);
        if (jox_path_below(path, mods[m].folder))
            return strncmp(target, mods[m].name, name) == 0 && target[name] == ':' &&
                   strncmp(target + name + 1, stem, n) == 0 && !target[name + 1 + n];
    }
    return strncmp(target, stem, n) == 0 && !target[n];
}

/* ---- merging ---- */

/* Returns the change by which the patch sets a path. */
static JoxPatchChange describe_change(const JoxPatch *p, const char *path,
                                      const JoxPatchPlace *at) {
    return (JoxPatchChange){.path = (char *)path,
                            .from = (char *)at->from,
                            .source = p->source,
                            .mod = p->mod,
                            .position = p->tree->position(p->tree->context, at),
                            .value = at->value};
}

/* Appends to the list that the patch sets or removes a path. */
static void keep_change(const JoxPatch *p, const char *path, const JoxPatchPlace *at,
                        bool removes) {
    JoxPatchChange change = describe_change(p, path, at);
    change.removes = removes;
    jox_patch_keep(p->changes, change, p->mods, p->diagnostics);
}

/* Extends a key of a copy, if the patch's value does that; false if it replaces what is there. */
static bool extend_key(const JoxPatch *p, void *copy, const char *path, const JoxPatchPlace *at,
                       void *now) {
    const JoxPatchTree *t = p->tree;
    void *wider = t->extend ? t->extend(t->context, now, at) : NULL;
    if (!wider)
        return false;
    JoxPatchChange change = describe_change(p, path, at);
    change.extends = true;
    t->set(t->context, copy, at->key, at, wider);
    jox_patch_keep(p->changes, change, p->mods, p->diagnostics);
    return true;
}

/* Writes the path of an item: "PREFIX.MARKid". */
static void join_item_path(const JoxPatch *p, char path[JOX_PATCH_PATH], const char *prefix,
                           const char *id) {
    char item[JOX_PATCH_ID + 8];
    snprintf(item, sizeof item, "%s%.100s", p->tree->item_mark, id);
    jox_patch_join(path, prefix, item);
}

static void *merge_into(const JoxPatch *p, void *copy, void *change, const char *path,
                        const char *from, int depth);

/* Whether a patch's node is merged into the present one; if not, it replaces it. */
static bool is_mergeable(const JoxPatch *p, void *now, void *change, int depth) {
    const JoxPatchTree *t = p->tree;
    const JoxPatchKind was = t->kind(t->context, now), is = t->kind(t->context, change);
    if (depth >= t->deepest || (was != JOX_PATCH_MAP && was != JOX_PATCH_LIST))
        return false;
    return is == JOX_PATCH_MAP || (is == JOX_PATCH_LIST && t->lists_merge && was == JOX_PATCH_MAP);
}

/* Sets, removes or merges a key of a copy; `path` is the key's path in the patched tree. */
static void merge_key(const JoxPatch *p, void *copy, const char *path, const JoxPatchPlace *at,
                      int depth) {
    const JoxPatchTree *t = p->tree;
    void *now = t->get(t->context, copy, at->key);
    if (t->kind(t->context, at->value) == JOX_PATCH_NOTHING) {
        if (!now)
            t->missing(t->context, copy, at->key, at, false);
        t->remove(t->context, copy, at->key);
        keep_change(p, path, at, true);
    } else if (now && is_mergeable(p, now, at->value, depth)) {
        void *inner = t->copy(t->context, now);
        inner = merge_into(p, inner, at->value, path, at->from, depth + 1);
        t->set(t->context, copy, at->key, NULL, inner);
    } else if (!extend_key(p, copy, path, at, now)) {
        t->set(t->context, copy, at->key, at, at->value);
        keep_change(p, path, at, false);
    }
}

/* Returns the index of the item with an id; the number of items, with an error, if there is
   none. */
static uint32_t find_item(const JoxPatch *p, void *copy, const char *id, const JoxPatchPlace *at) {
    const JoxPatchTree *t = p->tree;
    const uint32_t count = t->count(t->context, copy);
    for (uint32_t i = 0; i < count; i++)
        if (t->is_item(t->context, copy, i, id))
            return i;
    t->missing(t->context, copy, id, at, true);
    return count;
}

/* Marks the item with an id as removed; `sweep` drops it later, so that indices stay valid. */
static void remove_item(const JoxPatch *p, void *copy, const char *path, const char *id,
                        const JoxPatchPlace *at) {
    char whole[JOX_PATCH_PATH];
    const uint32_t i = find_item(p, copy, id, at);
    if (i == p->tree->count(p->tree->context, copy))
        return;
    p->tree->put(p->tree->context, copy, i, NULL);
    join_item_path(p, whole, path, id);
    keep_change(p, whole, at, true);
}

/* Inserts an item, or a list of them, at index `i`. */
static void insert_items(const JoxPatch *p, void *copy, uint32_t i, const char *path,
                         const char *keep_id, const JoxPatchPlace *at) {
    const JoxPatchTree *t = p->tree;
    const bool list = t->kind(t->context, at->value) == JOX_PATCH_LIST;
    const uint32_t count = list ? t->count(t->context, at->value) : 1;
    for (uint32_t k = 0; k < count; k++) {
        char there[JOX_PATCH_PATH], whole[JOX_PATCH_PATH], id[JOX_PATCH_ID], number[16];
        snprintf(number, sizeof number, "%u", k + 1);
        jox_patch_join(there, at->from, list ? number : "");
        const JoxPatchPlace here = {there, NULL,
                                    list ? t->item(t->context, at->value, k) : at->value, NULL};
        void *item = t->admit(t->context, copy, here.value, path, keep_id, &here, id);
        if (!item)
            continue;
        t->insert(t->context, copy, i++, item);
        join_item_path(p, whole, path, id);
        keep_change(p, whole, &here, false);
    }
}

/* Changes or replaces the item with an id, or inserts items before or after it. */
static void merge_item(const JoxPatch *p, JoxPatchVerb verb, void *copy, const char *path,
                       const JoxPatchPlace *at, int depth) {
    const JoxPatchTree *t = p->tree;
    char whole[JOX_PATCH_PATH];
    const uint32_t i = find_item(p, copy, at->key, at);
    if (i == t->count(t->context, copy))
        return;
    join_item_path(p, whole, path, at->key);
    void *now = t->item(t->context, copy, i);
    if (verb == JOX_PATCH_CHANGE && is_mergeable(p, now, at->value, depth)) {
        void *inner = t->copy(t->context, now);
        inner = merge_into(p, inner, at->value, whole, at->from, depth + 1);
        t->put(t->context, copy, i, inner);
    } else if (verb == JOX_PATCH_CHANGE && t->keys_are_ids) {
        t->put(t->context, copy, i, at->value);
        keep_change(p, whole, at, false);
    } else if (verb == JOX_PATCH_CHANGE) {
        t->misused(t->context, verb, at);
    } else if (verb == JOX_PATCH_REPLACE) {
        t->put(t->context, copy, i, NULL);
        keep_change(p, whole, at, true);
        insert_items(p, copy, i, path, at->key, at);
    } else {
        insert_items(p, copy, i + (verb == JOX_PATCH_AFTER), path, NULL, at);
    }
}

/* Carries out a verb; its value has items by id, a list of ids, or items. */
static void merge_verb(const JoxPatch *p, JoxPatchVerb verb, void *copy, const char *path,
                       const JoxPatchPlace *at, int depth) {
    const JoxPatchTree *t = p->tree;
    const JoxPatchKind kind = t->kind(t->context, at->value);
    const bool table = kind == JOX_PATCH_MAP || kind == JOX_PATCH_LIST;
    if (!table && !t->keys_are_ids) {
        t->misused(t->context, verb, at);
    } else if (verb == JOX_PATCH_APPEND) {
        insert_items(p, copy, t->count(t->context, copy), path, NULL, at);
    } else if (verb == JOX_PATCH_REMOVE) {
        const uint32_t count = kind == JOX_PATCH_LIST ? t->count(t->context, at->value) : !table;
        for (uint32_t k = 0; k < count; k++) {
            void *name = kind == JOX_PATCH_LIST ? t->item(t->context, at->value, k) : at->value;
            const char *id = t->text(t->context, name);
            remove_item(p, copy, path, id ? id : "?", &(JoxPatchPlace){at->from, NULL, name, NULL});
        }
    } else {
        const char *const *ids;
        const uint32_t count = t->keys(t->context, at->value, NULL, at->from, &ids);
        for (uint32_t k = 0; k < count; k++) {
            char there[JOX_PATCH_PATH];
            jox_patch_join(there, at->from, ids[k]);
            void *value = t->get(t->context, at->value, ids[k]);
            merge_item(p, verb, copy, path, &(JoxPatchPlace){there, at->value, value, ids[k]},
                       depth);
        }
    }
}

/* Returns the verb that a key names, or JOX_PATCH_VERBS if the tree has no such verb. */
static int find_patch_verb(const JoxPatch *p, const char *key) {
    for (int v = 0; v < JOX_PATCH_VERBS; v++)
        if ((p->tree->verbs >> v & 1) && strcmp(jox_patch_verbs[v], key) == 0)
            return v;
    return JOX_PATCH_VERBS;
}

/* Overwrites items without ids, one by one from the first. */
static void overwrite_items(const JoxPatch *p, void *copy, void *change, const char *path,
                            const char *from) {
    const JoxPatchTree *t = p->tree;
    const uint32_t count = t->count(t->context, change);
    for (uint32_t i = 0; i < count; i++) {
        char whole[JOX_PATCH_PATH], there[JOX_PATCH_PATH], number[16];
        snprintf(number, sizeof number, "%u", i + 1);
        jox_patch_join(whole, path, number);
        jox_patch_join(there, from, number);
        void *item = t->item(t->context, change, i);
        t->put(t->context, copy, i, item);
        keep_change(p, whole, &(JoxPatchPlace){there, NULL, item, NULL}, false);
    }
}

/* Merges one key of a patch's node; `by_id`: into a node whose items have ids. */
static void merge_patch_key(const JoxPatch *p, void *copy, const char *path,
                            const JoxPatchPlace *at, bool by_id, int depth) {
    const JoxPatchTree *t = p->tree;
    const bool list = by_id && t->keys_are_ids;
    const int verb = by_id ? find_patch_verb(p, at->key) : JOX_PATCH_VERBS;
    char whole[JOX_PATCH_PATH];
    jox_patch_join(whole, path, at->key);
    if (t->skips(t->context, copy, at, depth))
        return;
    if (verb < JOX_PATCH_VERBS)
        merge_verb(p, (JoxPatchVerb)verb, copy, path, at, depth);
    else if (list && t->kind(t->context, at->value) == JOX_PATCH_NOTHING)
        remove_item(p, copy, path, at->key, at);
    else if (list)
        merge_item(p, JOX_PATCH_CHANGE, copy, path, at, depth);
    else
        merge_key(p, copy, whole, at, depth);
}

/* Merges a patch's node into a copy. Appends are made in a second pass, so that an appended item
   can have the id of one that the same patch removes, whatever the order of the keys. */
static void *merge_into(const JoxPatch *p, void *copy, void *change, const char *path,
                        const char *from, int depth) {
    const JoxPatchTree *t = p->tree;
    JOX_ASSERT(depth <= t->deepest);
    const bool by_id = t->enter(t->context, copy, change, path, from, depth);
    const char *const *keys;
    const uint32_t count = t->keys(t->context, change, path, from, &keys);
    for (int pass = 0; pass < (by_id ? 2 : 1); pass++)
        for (uint32_t k = 0; k < count; k++) {
            char there[JOX_PATCH_PATH];
            jox_patch_join(there, from, keys[k]);
            const int own = by_id && find_patch_verb(p, keys[k]) == JOX_PATCH_APPEND;
            if (own != pass)
                continue;
            const JoxPatchPlace at = {there, change, t->get(t->context, change, keys[k]), keys[k]};
            merge_patch_key(p, copy, path, &at, by_id, depth);
        }
    if (by_id)
        t->sweep(t->context, copy);
    else if (t->lists_merge)
        overwrite_items(p, copy, change, path, from);
    return copy;
}

void *jox_patch_apply(const JoxPatch *p, void *base, void *change) {
    JOX_ASSERT(p->mod >= 0 && base && change);
    return merge_into(p, p->tree->copy(p->tree->context, base), change, "", "", 0);
}

void jox_patch_replaces(const JoxPatch *p, void *value) {
    keep_change(p, "", &(JoxPatchPlace){"", NULL, value, NULL}, false);
}
