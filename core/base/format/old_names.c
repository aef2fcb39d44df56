#include "base/format/old_names.h"

#include <stddef.h>
#include <string.h>

/* A name that was changed gets a row here, for good: files that have it are older than the change.
 */
static const struct {
    JoxOldKind kind;
    const char *was, *now;
} OLD[] = {
    {JOX_OLD_KEY, "width_eager", "room_eager"},
    {JOX_OLD_WORD, "held", "holders"},
    {JOX_OLD_BEHAVIOUR, "passer", "walker"},
};

const char *jox_old_name(JoxOldKind kind, const char *name) {
    for (size_t n = 0; n < sizeof OLD / sizeof *OLD; n++)
        if (OLD[n].kind == kind && strcmp(OLD[n].was, name) == 0)
            return OLD[n].now;
    return NULL;
}
