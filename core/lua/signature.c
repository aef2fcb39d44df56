#include "lua/signature.h"

#include <stdio.h>
#include <string.h>

JoxSignature jox_signature_read(const char *text, const char *end) {
    JoxSignature s = {0};
    bool optional = false;
    const char *at = memchr(text, '(', (size_t)(end - text));
    for (at = at ? at + 1 : end; at < end && *at != ')' && s.count < JOX_MOST_SIGNED;) {
        const size_t length = strcspn(at, " ,[]().");
        JoxSignatureItem *p = &s.items[s.count];
        optional |= *at == '[';
        if (strncmp(at, "...", 3) == 0) {
            p->variadic = true;
            snprintf(p->name, JOX_LONGEST_SIGNED, "...");
            s.count++;
            at += 3;
            continue;
        }
        if (length == 0) {
            at++;
            continue;
        }
        snprintf(p->name, JOX_LONGEST_SIGNED, "%.*s", (int)length, at);
        if (strcmp(p->name, "function") == 0)
            snprintf(p->name, JOX_LONGEST_SIGNED, "run");
        for (int o = 0; o < s.count; o++)
            if (strcmp(s.items[o].name, p->name) == 0)
                snprintf(p->name + strlen(p->name), JOX_LONGEST_SIGNED - strlen(p->name), "2");
        p->optional = optional;
        s.count++;
        at += length;
    }
    return s;
}
