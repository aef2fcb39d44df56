/* Decides which of the chosen mods are applied, by their dependencies and conflicts, and orders
   them. */
#include <string.h>

#include "base/assert.h"
#include "scene/mods_parts.h"

/* Returns the index of the mod that a dependency names, or -1. */
static int32_t find_dependency(const JoxModsFind *f, const JoxYaml *dependency) {
    char name[64];
    const char *version;
    jox_mod_split_dependency(dependency->text, name, &version);
    return jox_mods_index(f->mods, name);
}

/* Checks the mods that a mod depends on, recursively, and puts them before it; false with an error
   if one is missing, off, too old, or depends on this mod. */
static bool check_dependencies(JoxModsFind *f, uint32_t m) {
    JoxMods *mods = f->mods;
    JoxModNeeds *n = &f->needs[m];
    bool good = !n->broken;
    if (n->visit == JOX_MOD_SEEN)
        return good;
    n->visit = JOX_MOD_ON_THE_WAY;
    for (uint32_t d = 0; d < n->depend_count && good; d++) {
        char name[64];
        const char *version;
        jox_mod_split_dependency(n->depends[d]->text, name, &version);
        int32_t other = jox_mods_index(mods, name);
        if (other < 0) {
            jox_mods_report_missing(f, n->depends[d]->position, name, mods->found[m].name);
            good = false;
        } else if (!f->needs[other].wanted && !f->def->needed_too) {
            jox_diag_error(f->reader.diagnostics, n->depends[d]->position, "mod-off",
                           "Turn it on: jostle mod enable; or name it for one run: --mod",
                           "mod %s needs mod %s, which is off", mods->found[m].name, name);
            good = false;
        } else if (version && jox_mod_compare(mods->found[other].version, version) < 0) {
            jox_diag_error(f->reader.diagnostics, n->depends[d]->position, "old-mod", NULL,
                           "mod %s needs %s %s or later; %s is there", mods->found[m].name, name,
                           version, mods->found[other].version);
            good = false;
        } else if (f->needs[other].visit == JOX_MOD_ON_THE_WAY) {
            jox_diag_error(f->reader.diagnostics, n->depends[d]->position, "mod-circle", NULL,
                           "mods %s and %s depend on each other", mods->found[m].name, name);
            good = false;
        } else {
            good = check_dependencies(f, (uint32_t)other);
            n->before |= (uint64_t)1 << other;
        }
    }
    n->broken |= !good;
    n->visit = JOX_MOD_SEEN;
    return good;
}

/* Whether mod `m` must come after mod `other`, directly or through others. */
static bool comes_after(const JoxModsFind *f, uint32_t m, uint32_t other) {
    JOX_ASSERT(m < f->mods->found_count && other < f->mods->found_count);
    uint64_t before = f->needs[m].before;
    for (uint64_t known = 0; known != before;) {
        known = before;
        for (uint32_t k = 0; k < f->mods->found_count; k++)
            if (known >> k & 1)
                before |= f->needs[k].before;
    }
    return before >> other & 1;
}

/* Puts the mods of `optional` and `load_after` before a mod, if they are applied too and need not
   come after it. */
static void apply_optional_order(JoxModsFind *f, uint32_t m) {
    JoxModNeeds *n = &f->needs[m];
    for (uint32_t k = 0; k < n->optional_count + n->after_count; k++) {
        const JoxYaml *name =
            k < n->optional_count ? n->optional[k] : n->load_after[k - n->optional_count];
        int32_t other = find_dependency(f, name);
        if (other < 0 || !f->needs[other].wanted || f->needs[other].broken || !n->wanted ||
            n->broken)
            continue;
        if (other == (int32_t)m || comes_after(f, (uint32_t)other, m))
            jox_diag_warn(f->reader.diagnostics, name->position, "mod-circle", NULL,
                          "mod %s would come after %s, which comes after it: not heeded",
                          f->mods->found[m].name, f->mods->found[other].name);
        else
            n->before |= (uint64_t)1 << other;
    }
}

/* Chooses the mods that chosen mods depend on. */
static void choose_needed(JoxModsFind *f) {
    for (bool more = true; more;) {
        more = false;
        for (uint32_t m = 0; m < f->mods->found_count; m++)
            for (uint32_t d = 0;
                 f->needs[m].wanted && !f->needs[m].broken && d < f->needs[m].depend_count; d++) {
                int32_t other = find_dependency(f, f->needs[m].depends[d]);
                if (other >= 0 && !f->needs[other].wanted)
                    f->needs[other].wanted = more = true;
            }
    }
}

/* Leaves out the mods of def->without, mods that conflict with one chosen, and the mods that depend
   on what is left out. */
static void exclude_broken(JoxModsFind *f) {
    JoxMods *mods = f->mods;
    for (uint32_t m = 0; m < mods->found_count; m++) {
        if (f->def->without >> m & 1)
            f->needs[m].broken = true;
        for (uint32_t c = 0; f->needs[m].wanted && c < f->needs[m].conflict_count; c++) {
            const JoxYaml *name = f->needs[m].conflicts[c];
            int32_t other = jox_mods_index(mods, name->text);
            if (other < 0 || !f->needs[other].wanted || f->needs[other].broken ||
                f->needs[m].broken)
                continue;
            jox_diag_error(f->reader.diagnostics, name->position, "mods-exclude",
                           "Take one of them away", "mod %s does not go together with %s",
                           mods->found[m].name, name->text);
            f->needs[m].broken = true;
        }
    }
    for (bool more = true; more;) { /* until no mod depends on one left out */
        more = false;
        for (uint32_t m = 0; m < mods->found_count; m++)
            for (uint32_t d = 0; !f->needs[m].broken && d < f->needs[m].depend_count; d++) {
                int32_t other = find_dependency(f, f->needs[m].depends[d]);
                if (other < 0 || f->needs[other].broken)
                    f->needs[m].broken = more = true;
            }
    }
}

/* Computes the depth of each mod: the longest chain of mods before it. There are no cycles. */
static void measure_depths(JoxModsFind *f) {
    uint32_t count = f->mods->found_count;
    for (uint32_t round = 0; round < count; round++)
        for (uint32_t m = 0; m < count; m++)
            for (uint32_t o = 0; o < count; o++)
                if (o != m && (f->needs[m].before >> o & 1) &&
                    f->needs[m].depth <= f->needs[o].depth)
                    f->needs[m].depth = f->needs[o].depth + 1;
}

static bool comes_before(const JoxModsFind *f, uint32_t a, uint32_t b) {
    if (f->needs[a].depth != f->needs[b].depth)
        return f->needs[a].depth < f->needs[b].depth;
    return strcmp(f->mods->found[a].name, f->mods->found[b].name) < 0;
}

static void sort_mods(JoxModsFind *f) {
    JoxMods *mods = f->mods;
    uint32_t list[JOX_MOST_MODS], count = 0;
    measure_depths(f);
    for (uint32_t m = 0; m < mods->found_count; m++) {
        if (!f->needs[m].wanted || f->needs[m].broken)
            continue;
        uint32_t at = count++;
        for (; at > 0 && comes_before(f, m, list[at - 1]); at--)
            list[at] = list[at - 1];
        list[at] = m;
    }
    mods->items = jox_arena_take(f->reader.arena, count + 1, sizeof *mods->items);
    mods->found_index = jox_arena_take(f->reader.arena, count + 1, sizeof *mods->found_index);
    mods->count = count;
    for (uint32_t k = 0; k < count; k++) {
        mods->found_index[k] = list[k];
        mods->items[k] = mods->found[list[k]];
        for (uint32_t s = 0; s < mods->items[k].setting_count; s++)
            mods->items[k].settings[s].shown = mods->items[k].settings[s].value;
        for (uint32_t o = 0; o < k; o++)
            if (f->needs[list[k]].before >> list[o] & 1)
                mods->items[k].after |= (uint64_t)1 << o | mods->items[o].after;
    }
}

void jox_mods_order(JoxModsFind *f) {
    JoxMods *mods = f->mods;
    JOX_ASSERT(mods->found_count <= JOX_MOST_MODS);
    for (uint32_t m = 0; m < mods->found_count; m++)
        if (f->needs[m].wanted)
            check_dependencies(f, m);
    choose_needed(f);
    exclude_broken(f);
    for (uint32_t m = 0; m < mods->found_count; m++)
        apply_optional_order(f, m);
    sort_mods(f);
    JOX_ASSERT(mods->count <= mods->found_count);
}
