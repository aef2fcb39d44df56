/* Reports errors at nodes of YAML. */
#include "scene/format/reader.h"

#include <stdarg.h>
#include <stdio.h>

#include "base/assert.h"
#include "base/format/name.h"
#include "base/format/plurals.h"
#include "base/text.h"

void jox_scene_error(const JoxReader *reader, const JoxYaml *node, const char *code,
                     const char *hint, const char *format, ...) {
    char text[512];
    va_list arguments;
    JOX_ASSERT(node && code);
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    jox_diag_error(reader->diagnostics, node->position, code, hint, "%s", text);
}

bool jox_scene_check_name(const JoxReader *reader, JoxPosition at, const char *what,
                          const char *name) {
    if (jox_name_is_plain(name))
        return true;
    jox_diag_error(reader->diagnostics, at, "bad-name", JOX_NAME_RULE,
                   "'%.60s' is no name for %s %s", name, jox_article(what), what);
    return false;
}

JoxV2 jox_scene_position(const JoxReader *reader, JoxV2 plan) {
    JoxPlacing *all = reader->placing;
    if (!all)
        return plan;
    all->low = jox_v2(jox_minf(all->low.x, plan.x), jox_minf(all->low.y, plan.y));
    all->high = jox_v2(jox_maxf(all->high.x, plan.x), jox_maxf(all->high.y, plan.y));
    return jox_v2(plan.x, plan.y + all->shift);
}

const char *jox_scene_suggest(const JoxReader *reader, const char *word, const char *const *names,
                              size_t count) {
    if (!jox_diag_has_room(reader->diagnostics, JOX_SEVERITY_ERROR))
        return NULL;
    char hint[JOX_HINT];
    return jox_did_you_mean(word, names, count, hint) ? jox_arena_text(reader->arena, hint) : NULL;
}
