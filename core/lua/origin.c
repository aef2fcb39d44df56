/* Where paths of a machine were set by mods, and which two mods set one. */
#include <stdio.h>
#include <string.h>

#include "base/mem.h"
#include "lua/read.h"

enum { MOST = 4096 };

static JoxPosition position_of(const JoxScript *script, const JoxOrigin *origin) {
    return jox_outline_at(script->vm.sources[origin->source], origin->from);
}

/* Two mods that set one path, neither knowing the other: both places, and who wins. */
static void report_conflict(const JoxScript *script, const JoxOrigin *mine) {
    const JoxMod *mods = script->scope->mods;
    for (size_t o = 0; o + 1 < script->origin_count; o++) {
        const JoxOrigin *other = &script->origins[o];
        if (other->mod < 0 || other->mod == mine->mod ||
            !jox_mod_overlaps(other->path, mine->path) || (mods[mine->mod].after >> other->mod & 1))
            continue;
        jox_mod_conflict(script->diagnostics, &mods[mine->mod], position_of(script, mine),
                         &mods[other->mod], position_of(script, other), mine->path);
        return;
    }
}

void jox_origin_set(JoxScript *script, JoxOrigin origin) {
    if (script->origin_count == MOST)
        jox_diag_error(script->diagnostics, position_of(script, &origin), "too-many", NULL,
                       "patches set more than %d things, here '%s'", MOST, origin.path);
    if (script->origin_count > MOST) /* one more bears the error */
        return;
    JOX_RESERVE(script->origins, script->origin_capacity, script->origin_count + 1);
    origin.path = jox_strdup(origin.path);
    origin.from = jox_strdup(origin.from);
    script->origins[script->origin_count++] = origin;
    if (origin.mod >= 0)
        report_conflict(script, &origin);
}

const JoxOrigin *jox_origin_of(const JoxScript *script, const char *path) {
    const JoxOrigin *last = NULL;
    for (size_t o = 0; o < script->origin_count; o++) {
        const JoxOrigin *origin = &script->origins[o];
        size_t n = strlen(origin->path);
        bool leads =
            n == 0 || (strncmp(origin->path, path, n) == 0 && (!path[n] || path[n] == '.'));
        if (leads)
            last = origin;
    }
    return last;
}

void jox_origin_keep(JoxScript *script, const char *path, const char *number,
                     const char *canonical) {
    const JoxOrigin *whole = jox_origin_of(script, canonical);
    char from[512];
    if ((whole && strcmp(whole->path, canonical) == 0) || script->origin_count >= MOST)
        return;
    const char *rest = whole ? path + strlen(whole->path) : path;
    rest += whole && *whole->path && *rest == '.';
    const char *lead = whole ? whole->from : "";
    snprintf(from, sizeof from, "%.200s%s%.200s.%s", lead, *lead && *rest ? "." : "", rest, number);
    JoxOrigin origin = {jox_strdup(canonical), whole ? whole->source : 0, jox_strdup(from),
                        whole ? whole->mod : -1, false};
    JOX_RESERVE(script->origins, script->origin_capacity, script->origin_count + 1);
    script->origins[script->origin_count++] = origin;
}

/* ---- of a machine under construction ---- */

/* The source that a path of the machine was written in, and its path there. */
static const JoxSource *locate(const JoxBuild *b, const char *path, char there[512]) {
    const JoxOrigin *origin = jox_origin_of(b->script, path);
    if (!origin) {
        snprintf(there, 512, "%s", path);
        return b->source;
    }
    size_t n = strlen(origin->path);
    const char *rest = path + n + (n && path[n] == '.');
    snprintf(there, 512, "%.250s%s%.250s", origin->from, *rest && *origin->from ? "." : "", rest);
    return b->script->vm.sources[origin->source];
}

JoxPosition jox_read_at(const JoxBuild *b, const char *path) {
    char there[512];
    const JoxSource *source = locate(b, path, there);
    return jox_outline_at(source, there);
}

const JoxPath *jox_read_span(const JoxBuild *b, const char *path, const JoxSource **source) {
    char there[512];
    *source = locate(b, path, there);
    return jox_outline_find(*source, there);
}
