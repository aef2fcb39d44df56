/* Machines that states run: names, tables and paths of their states while they are built, and what
   own values mean in them. Called by the other files that build a machine. */
#include <stdio.h>
#include <string.h>

#include "base/mem.h"
#include "lua/read_table.h"

void jox_nest_name(const JoxBuild *b, uint32_t nested, const char *name, char whole[256]) {
    const JoxNested *n = &b->nested[nested];
    const char *around = n->outer < 0 ? "" : b->machine->outer[n->outer].name;
    snprintf(whole, 256, "%.120s%s%.120s", around, *around ? "." : "", name);
}

const JoxNested *jox_nest_enclosing(const JoxBuild *b, const char *path, const char **rest) {
    const JoxNested *found = NULL;
    size_t most = 0;
    *rest = path;
    for (uint32_t n = 0; n < b->nested_count; n++) {
        const size_t length = strlen(b->nested[n].path);
        if (length < most || strncmp(path, b->nested[n].path, length) != 0 ||
            (length && path[length] && path[length] != '.'))
            continue;
        found = &b->nested[n];
        most = length;
        *rest = path + length + (length && path[length]);
    }
    return found;
}

int32_t jox_nest_own(const JoxBuild *b, const char *name) {
    const int p = jox_parameter_find(name);
    if (p < 0 || b->nest == 0)
        return -1;
    const JoxValue *value = &b->nested[b->nest].defaults[p];
    const bool own =
        value->kind == JOX_VALUE_OWN && b->machine->own[value->index].general == (uint32_t)p + 1;
    return own ? value->index : -1;
}

void jox_nest_free(JoxBuild *b) {
    jox_free(b->nested);
    jox_free(b->state_nested);
    jox_free(b->outer_nested);
}
