#include "base/format/mod.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool jox_mod_overlaps(const char *a, const char *b) {
    size_t n = strlen(a), m = strlen(b), least = n < m ? n : m;
    const char *longer = n < m ? b : a;
    return strncmp(a, b, least) == 0 && (n == m || longer[least] == '.' || least == 0);
}

void jox_mod_conflict(JoxDiagnostics *diagnostics, const JoxMod *later, JoxPosition at,
                      const JoxMod *earlier, JoxPosition before, const char *path) {
    char context[512];
    snprintf(context, sizeof context,
             "set before by mod %.60s at %.200s:%d; mod %.60s comes later and wins", earlier->name,
             before.file, before.line, later->name);
    jox_diag_add(diagnostics, JOX_SEVERITY_WARNING, at, "mod-conflict",
                 "Say which comes first with `load_after` or `depends` in mod.yaml", context, NULL,
                 "mods %s and %s both set %s", earlier->name, later->name,
                 *path ? path : "all of it");
}

/* Reads one of the choices of a setting. */
static bool parse_choice(const JoxModSetting *s, const char *text, double *value, JoxText *why) {
    char hint[JOX_HINT];
    for (uint32_t c = 0; c < s->choice_count; c++)
        if (strcmp(s->choices[c], text) == 0) {
            *value = c;
            return true;
        }
    const char *near =
        jox_did_you_mean(text, (const char *const *)s->choices, s->choice_count, hint);
    jox_text_add(why, "must be ");
    for (uint32_t c = 0; c < s->choice_count; c++)
        jox_text_printf(why, "%s%s",
                        c == 0                    ? ""
                        : c + 1 < s->choice_count ? ", "
                                                  : " or ",
                        s->choices[c]);
    jox_text_printf(why, ", not '%.60s'%s%s", text, near ? ". " : "", near ? near : "");
    return false;
}

bool jox_setting_parse(const JoxModSetting *s, const char *text, double *value, JoxText *why) {
    if (s->kind == JOX_SETTING_CHOICE)
        return parse_choice(s, text, value, why);
    if (s->kind == JOX_SETTING_BOOL) {
        *value = strcmp(text, "true") == 0;
        if (*value != 0.0 || strcmp(text, "false") == 0)
            return true;
        jox_text_printf(why, "must be true or false, not '%.60s'", text);
        return false;
    }
    char *end;
    *value = strtod(text, &end);
    if (end == text || *end || !isfinite(*value))
        jox_text_printf(why, "must be a number, not '%.60s'", text);
    else if (!(*value >= s->least && *value <= s->greatest))
        jox_text_printf(why, "must be from %g to %g, not %g", s->least, s->greatest, *value);
    else
        return true;
    return false;
}

const char *jox_setting_text(const JoxModSetting *s, double value) {
    return s->kind == JOX_SETTING_BOOL ? (value != 0.0 ? "true" : "false")
           : s->kind == JOX_SETTING_CHOICE && value < s->choice_count ? s->choices[(uint32_t)value]
                                                                      : "";
}

bool jox_mod_find(const JoxMod *mods, uint32_t count, const char *name,
                  char path[JOX_LONGEST_PATH]) {
    const char *colon = strchr(name, ':');
    const size_t n = colon ? (size_t)(colon - name) : 0;
    for (uint32_t m = 0; colon && m < count; m++) {
        char folder[JOX_LONGEST_PATH];
        if (strncmp(mods[m].name, name, n) != 0 || mods[m].name[n])
            continue;
        snprintf(folder, sizeof folder, "%s/", mods[m].folder);
        return !strstr(colon, "..") && colon[1] != '/' &&
               jox_path_find(folder, colon + 1, ".lua", (const char *const[]){"behaviours/", NULL},
                             path);
    }
    return false;
}

void jox_mod_split_dependency(const char *text, char name[64], const char **version) {
    size_t n = strcspn(text, " >=");
    const char *at = strstr(text, ">=");
    snprintf(name, 64, "%.*s", (int)(n < 63 ? n : 63), text);
    *version = at ? at + 2 + strspn(at + 2, " ") : NULL;
}

int jox_mod_compare(const char *a, const char *b) {
    for (int part = 0; part < 8 && (*a || *b); part++) {
        long x = strtol(a, (char **)&a, 10), y = strtol(b, (char **)&b, 10);
        if (x != y)
            return x < y ? -1 : 1;
        a += *a == '.';
        b += *b == '.';
        if ((*a && (*a < '0' || *a > '9')) || (*b && (*b < '0' || *b > '9')))
            break;
    }
    return 0;
}
