/* Where the parts of a machine stand: in its own file, or in that of a mod. */
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "lua/read.h"

void jox_origin_keep(JoxScript *script, const char *path, const char *number,
                     const char *canonical) {
    JOX_ASSERT(*path && *number && *canonical);
    const JoxPatchChange *whole = jox_patch_leading(&script->changes, canonical);
    char from[512];
    if (whole && strcmp(whole->path, canonical) == 0)
        return;
    const char *rest = path;
    if (whole && !jox_patch_leads(whole, path, &rest))
        rest = "";
    const char *lead = whole ? whole->from : "";
    snprintf(from, sizeof from, "%.200s%s%.200s.%s", lead, *lead && *rest ? "." : "", rest, number);
    jox_patch_keep(&script->changes,
                   (JoxPatchChange){.path = (char *)canonical,
                                    .from = from,
                                    .source = whole ? whole->source : 0,
                                    .mod = whole ? whole->mod : -1,
                                    .position = whole ? whole->position : (JoxPosition){0}},
                   NULL, script->diagnostics);
}

/* ---- of a machine under construction ---- */

/* The source that a path of the machine was written in, and its path there. */
static const JoxSource *locate(const JoxBuild *b, const char *path, char there[512]) {
    const JoxPatchChange *origin = jox_patch_leading(&b->script->changes, path);
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

int32_t jox_read_line(const JoxBuild *b, const char *path, uint16_t *source) {
    char there[512];
    const JoxSource *in = locate(b, path, there);
    *source = 0;
    for (size_t s = 0; s < b->script->vm.source_count; s++)
        if (b->script->vm.sources[s] == in)
            *source = (uint16_t)s;
    return jox_outline_at(in, there).line;
}

const JoxPath *jox_read_span(const JoxBuild *b, const char *path, const JoxSource **source) {
    char there[512];
    *source = locate(b, path, there);
    return jox_outline_find(*source, there);
}
