#include "base/format/colour.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct {
    const char *name;
    uint32_t rgb;
} NAMED[] = {
#define X(name, rgb) {#name, rgb},
    JOX_CLASS_COLOURS(X) JOX_PLAIN_COLOURS(X)
#undef X
};
enum { NAMED_COUNT = sizeof NAMED / sizeof *NAMED };

bool jox_colour_read(const char *text, JoxColour *colour) {
    for (int n = 0; n < NAMED_COUNT; n++)
        if (strcmp(NAMED[n].name, text) == 0) {
            *colour = JOX_COLOUR_GIVEN | NAMED[n].rgb;
            return true;
        }
    if (*text != '#' || strlen(text) != 7 || strspn(text + 1, "0123456789abcdefABCDEF") != 6)
        return false;
    *colour = JOX_COLOUR_GIVEN | (uint32_t)strtoul(text + 1, NULL, 16);
    return true;
}

void jox_colour_hint(const char *text, JoxText *out) {
    const char *names[NAMED_COUNT];
    for (int n = 0; n < NAMED_COUNT; n++)
        names[n] = NAMED[n].name;
    const char *near = jox_suggest(text, names, NAMED_COUNT);
    if (near)
        jox_text_printf(out, "Did you mean '%s'?", near);
    else
        jox_text_add(out, "Colours: " JOX_COLOUR_RULE);
}

void jox_colour_write(JoxColour colour, char out[8]) {
    snprintf(out, 8, "#%06x", (unsigned)(colour & 0xffffff));
}
