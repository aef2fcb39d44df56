/* What the expressions of a script's files are, as far as the files and the calls of their load
 * tell. */
#ifndef JOX_LUA_KINDS_H
#define JOX_LUA_KINDS_H

#include "lua/language/script.h"

/* What a table or function is, where that is known. */
typedef enum {
    JOX_SITE_NONE,
    JOX_SITE_TREE,   /* a table or function that is written out: `tree` of `source` */
    JOX_SITE_WORD,   /* a word that is called: number `tree` among the words */
    JOX_SITE_MEMORY, /* what `memory` gives for the table `tree` of `source` */
    JOX_SITE_VALUES, /* `now`, `own`: all that they have is a value of the language */
    JOX_SITE_PLAIN,  /* `settings`, `math`, ...: all that they have or return is plain */
    JOX_SITE_MANY    /* more than one */
} JoxSiteKind;

typedef struct JoxKind {
    uint8_t bits; /* JOX_KIND_...; 0: no value gets there */
    JoxSiteKind site;
    uint32_t source;
    int32_t tree;
} JoxKind;

typedef struct JoxKinds {
    const JoxScript *script;
    uint32_t source_count;
    JoxKind **trees, **variables; /* of each source; NULL of those that cannot be parsed */
    uint64_t looks;
    uint32_t followed;     /* steps of jox_part_find, which are bounded in all */
    bool changed, settled; /* settled: all of it holds; false: too large to tell */
} JoxKinds;

/* Of all files of a script that has run. */
JoxKinds *jox_kinds_read(const JoxScript *script);
void jox_kinds_free(JoxKinds *kinds);
/* Where a part of a machine is written: tokens of a source, `last` exclusive. */
typedef struct JoxPartOrigin {
    uint32_t source, key, first, last; /* of the key, and of the value */
} JoxPartOrigin;

/* part_origin.c: finds where a part of the machine that the script returns is written, by its path
   as in "states.Wait.2.when". False where it cannot be followed there. */
bool jox_part_find(JoxKinds *kinds, const char *path, JoxPartOrigin *found);

/* Whether a value of the language, and nothing else, gets there: Lua takes it for true. */
static inline bool jox_kind_is_value(JoxKind kind) {
    return kind.bits != 0 && (kind.bits & ~(JOX_KIND_CONDITION | JOX_KIND_VALUE)) == 0;
}

#endif
