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

/* Writes the path of a step's part in the outline of a sequence: steps are items there. */
static void write_step_path(const JoxBuild *b, const JoxNested *nested, const char *inner,
                            char there[512]) {
    lua_State *L = b->script->vm.L;
    const char *dot = *nested->root ? "." : "";
    const size_t n = strncmp(inner, "states.", 7) == 0 ? strcspn(inner + 7, ".") : 0;
    const char *rest = inner + 7 + n;
    luaL_checkstack(L, 3, "steps");
    lua_rawgeti(L, LUA_REGISTRYINDEX, nested->steps);
    lua_pushlstring(L, n ? inner + 7 : "", n);
    lua_rawget(L, -2);
    const int item = (int)lua_tointeger(L, -1);
    lua_pop(L, 2);
    if (item == 0) {
        snprintf(there, 512, "%s%s%.250s", nested->root, *inner ? dot : "", inner);
        return;
    }
    snprintf(there, 512, "%s%s%d%.200s", nested->root, dot, item, rest);
    const size_t digits = *rest == '.' ? strspn(rest + 1, "0123456789") : 0;
    if (digits && strcmp(rest + 1 + digits, ".when") == 0 &&
        !jox_outline_find(b->script->vm.sources[nested->source], there)) /* leads to the next */
        snprintf(there, 512, "%s%s%d.when", nested->root, dot, item);
}

/* Returns the source that a path of the machine was written in, with its path there. */
static const JoxSource *locate_path(const JoxBuild *b, const char *path, char there[512]) {
    const JoxPatchChange *origin = jox_patch_leading(&b->script->changes, path);
    const char *inner, *rest = "";
    char own[512];
    if (origin)
        jox_patch_leads(origin, path, &rest);
    if (origin)
        snprintf(own, sizeof own, "%.250s%s%.250s", origin->from, *rest && *origin->from ? "." : "",
                 rest);
    const bool written = origin && origin->mod < 0; /* it is the behaviour's own, by another name */
    const JoxNested *nested = jox_nest_enclosing(b, written ? own : path, &inner);
    if (nested && nested->source >= 0 &&
        (!origin || written ||
         (nested->outer >= 0 && strlen(origin->path) <= strlen(nested->path)))) {
        if (nested->steps)
            write_step_path(b, nested, inner, there);
        else
            snprintf(there, 512, "%s%s%.250s", nested->root, *nested->root && *inner ? "." : "",
                     inner);
        return b->script->vm.sources[nested->source];
    }
    snprintf(there, 512, "%s", origin ? own : path);
    return origin ? b->script->vm.sources[origin->source] : b->source;
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
