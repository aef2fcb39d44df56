/* Misuse that Lua would pass over in silence: `and`, `or`, `not`, `==` and `~=` between conditions
   decide while the file loads. The tokens of a condition, and of the locals that it uses, are
   looked at.
 */
#include <string.h>

#include "base/assert.h"
#include "lua/read.h"

enum { MOST_LOOKS = 20000000 };

/* Reports Lua operators that are evaluated at load, where one between conditions was meant. */
static bool scan_operators(JoxBuild *b, const JoxSource *source, uint32_t first, uint32_t last) {
    JOX_ASSERT(first <= last && last <= source->token_count);
    static const struct {
        const char *sign, *instead;
    } MISUSED[] = {{"and", "Use & between conditions"},
                   {"or", "Use | between conditions"},
                   {"not", "Use ~ before a condition"},
                   {"==", "Write :is(n)"},
                   {"~=", "Write ~x:is(n)"}};
    bool found = false;
    int body = 0;
    for (uint32_t i = first; i < last && i < source->token_count; i++) {
        const JoxToken *t = &source->tokens[i];
        if (jox_token_is(t, "function") ||
            (body > 0 && (jox_token_is(t, "if") || jox_token_is(t, "do"))))
            body++;
        else if (body > 0 && jox_token_is(t, "end"))
            body--;
        for (size_t k = 0; body == 0 && k < sizeof MISUSED / sizeof *MISUSED; k++)
            if (jox_token_is(t, MISUSED[k].sign)) {
                jox_build_error(b, (JoxPosition){source->path, t->line, t->column, t->end_column},
                                "lua-operator", MISUSED[k].instead,
                                "'%s' decides while the file loads, not while the crowd runs",
                                MISUSED[k].sign);
                found = true;
            }
    }
    return found;
}

/* Scans the value at a path and the definitions of the local variables that it uses. */
bool jox_read_misuse(JoxBuild *b, const char *path) {
    const JoxSource *source;
    const JoxPath *span = jox_read_span(b, path, &source);
    if (!span)
        return false;
    JoxOutline *outline = jox_outline_of(source);
    bool found = scan_operators(b, source, span->first, span->last);
    const JoxToken *t = source->tokens;
    for (uint32_t use = span->first; use < span->last; use++) {
        if (t[use].kind != JOX_TOKEN_NAME)
            continue;
        for (uint32_t i = 0; i + 2 < span->first && outline->looks < MOST_LOOKS; i++) {
            outline->looks++;
            bool defines = jox_token_is(&t[i], "local") && jox_token_is(&t[i + 2], "=") &&
                           t[i + 1].length == t[use].length &&
                           memcmp(t[i + 1].text, t[use].text, t[use].length) == 0;
            if (!defines || t[i].used)
                continue;
            uint32_t end = i + 3;
            while (end < span->first && !jox_token_is(&t[end], "local") &&
                   !jox_token_is(&t[end], "return"))
                end++;
            source->tokens[i].used = true; /* its definition is scanned only once */
            found |= scan_operators(b, source, i + 3, end);
        }
    }
    return found;
}
