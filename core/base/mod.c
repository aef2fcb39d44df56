#include "base/mod.h"

#include <stdio.h>
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
