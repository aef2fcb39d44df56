/* Where paths of a machine were set by mods, and which two mods set one. */
#include <stdio.h>
#include <string.h>

#include "base/mem.h"
#include "lua/read.h"

enum { MOST = 4096 };

static JoxPosition position_of(const JoxVm *vm, const JoxOrigin *origin) {
    return jox_source_path(&vm->sources[origin->source], origin->from);
}

/* Two mods that set one path, neither knowing the other: both places, and who wins. */
static void report_conflict(const JoxVm *vm, const JoxOrigin *mine) {
    const JoxMod *mods = vm->scope->mods;
    for (size_t o = 0; o + 1 < vm->origin_count; o++) {
        const JoxOrigin *other = &vm->origins[o];
        if (other->mod < 0 || other->mod == mine->mod ||
            !jox_mod_overlaps(other->path, mine->path) || (mods[mine->mod].after >> other->mod & 1))
            continue;
        jox_mod_conflict(vm->diagnostics, &mods[mine->mod], position_of(vm, mine),
                         &mods[other->mod], position_of(vm, other), mine->path);
        return;
    }
}

void jox_origin_set(JoxVm *vm, JoxOrigin origin) {
    if (vm->origin_count == MOST)
        jox_diag_error(vm->diagnostics, position_of(vm, &origin), "too-many", NULL,
                       "patches set more than %d things, here '%s'", MOST, origin.path);
    if (vm->origin_count > MOST) /* one more bears the error */
        return;
    JOX_RESERVE(vm->origins, vm->origin_capacity, vm->origin_count + 1);
    origin.path = jox_strdup(origin.path);
    origin.from = jox_strdup(origin.from);
    vm->origins[vm->origin_count++] = origin;
    if (origin.mod >= 0)
        report_conflict(vm, &origin);
}

const JoxOrigin *jox_origin_of(const JoxVm *vm, const char *path) {
    const JoxOrigin *last = NULL;
    for (size_t o = 0; o < vm->origin_count; o++) {
        const JoxOrigin *origin = &vm->origins[o];
        size_t n = strlen(origin->path);
        bool leads =
            n == 0 || (strncmp(origin->path, path, n) == 0 && (!path[n] || path[n] == '.'));
        if (leads)
            last = origin;
    }
    return last;
}

void jox_origin_keep(JoxVm *vm, const char *path, const char *number, const char *canonical) {
    const JoxOrigin *whole = jox_origin_of(vm, canonical);
    char from[512];
    if ((whole && strcmp(whole->path, canonical) == 0) || vm->origin_count >= MOST)
        return;
    const char *rest = whole ? path + strlen(whole->path) : path;
    rest += whole && *whole->path && *rest == '.';
    const char *lead = whole ? whole->from : "";
    snprintf(from, sizeof from, "%.200s%s%.200s.%s", lead, *lead && *rest ? "." : "", rest, number);
    JoxOrigin origin = {jox_strdup(canonical), whole ? whole->source : 0, jox_strdup(from),
                        whole ? whole->mod : -1, false};
    JOX_RESERVE(vm->origins, vm->origin_capacity, vm->origin_count + 1);
    vm->origins[vm->origin_count++] = origin;
}
