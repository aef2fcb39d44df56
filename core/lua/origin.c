/* Finds where the parts of a machine are written: in its own file, or in that of a mod. Used for
   positions of errors while the machine is built. */
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "lua/infer_kinds.h"
#include "lua/read_table.h"

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

/* Returns the source that a path of the machine was written in, with its path there. */
static const JoxSource *locate_path(const JoxBuild *b, const char *path, char there[512]) {
    const JoxPatchChange *origin = jox_patch_leading(&b->script->changes, path);
    const char *inner;
    const JoxNested *nested = jox_nest_enclosing(b, path, &inner);
    if (nested && nested->outer >= 0 && nested->source >= 0 &&
        (!origin || strlen(origin->path) <= strlen(nested->path))) {
        snprintf(there, 512, "%s%s%.250s", nested->root, *nested->root && *inner ? "." : "", inner);
        return b->script->vm.sources[nested->source];
    }
    if (!origin) {
        snprintf(there, 512, "%s", path);
        return b->source;
    }
    size_t n = strlen(origin->path);
    const char *rest = path + n + (n && path[n] == '.');
    snprintf(there, 512, "%.250s%s%.250s", origin->from, *rest && *origin->from ? "." : "", rest);
    return b->script->vm.sources[origin->source];
}

/* Finds a part that the file's table constructor does not write out, or the nearest enclosing part:
   position and number of the source. False if the constructor has the nearest one. */
static bool follow_part(JoxBuild *b, const char *path, JoxPosition *at, uint32_t *number) {
    char shorter[256];
    snprintf(shorter, sizeof shorter, "%s", path);
    for (char *dot = shorter; *shorter && !jox_outline_find(b->source, shorter); *dot = 0) {
        JoxPartOrigin found;
        if (!b->kinds)
            b->kinds = jox_kinds_read(b->script);
        if (jox_part_find(b->kinds, shorter, &found)) {
            const JoxSource *source = b->script->vm.sources[found.source];
            const JoxToken *t = &source->tokens[found.key];
            *at = (JoxPosition){source->path, t->line, t->column, t->end_column};
            *number = found.source;
            return true;
        }
        dot = strrchr(shorter, '.');
        if (!dot)
            break;
    }
    return false;
}

/* Returns the position of a path, and the number of its source. */
static JoxPosition find_position(JoxBuild *b, const char *path, uint32_t *number) {
    char there[512];
    JoxPosition at;
    const JoxSource *source = locate_path(b, path, there);
    if (source == b->source && strcmp(there, path) == 0 && follow_part(b, path, &at, number))
        return at;
    *number = 0;
    for (uint32_t s = 0; s < b->script->vm.source_count; s++)
        if (b->script->vm.sources[s] == source)
            *number = s;
    return jox_outline_at(source, there);
}

JoxPosition jox_read_at(JoxBuild *b, const char *path) {
    uint32_t number;
    return find_position(b, path, &number);
}

int32_t jox_read_line(JoxBuild *b, const char *path, uint16_t *source) {
    uint32_t number;
    const JoxPosition at = find_position(b, path, &number);
    *source = (uint16_t)number;
    return at.line;
}

const JoxPath *jox_read_span(const JoxBuild *b, const char *path, const JoxSource **source) {
    char there[512];
    *source = locate_path(b, path, there);
    return jox_outline_find(*source, there);
}
