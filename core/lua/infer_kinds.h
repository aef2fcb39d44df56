/* Kinds of the expressions of a script's files, inferred from its syntax trees and from the calls
   while it loaded. misuse.c asks where Lua's operators meet values of the language; part_origin.c
   follows tables and functions. */
#ifndef JOX_LUA_INFER_KINDS_H
#define JOX_LUA_INFER_KINDS_H

#include "lua/language/script.h"

/* Origin of a table or function, if known. */
typedef enum {
    JOX_SITE_NONE,
    JOX_SITE_TREE,   /* a table constructor or function: node `tree` of `source` */
    JOX_SITE_WORD,   /* a word of the vocabulary, number `tree` */
    JOX_SITE_MEMORY, /* result of `memory` for the table constructor `tree` of `source` */
    JOX_SITE_VALUES, /* `now`, `own`: every field is a value of the language */
    JOX_SITE_PLAIN,  /* `settings`, `math`, ...: every field or result is a plain value */
    JOX_SITE_MANY    /* several origins */
} JoxSiteKind;

typedef struct JoxKind {
    uint8_t bits; /* JOX_KIND_... that it may have; 0: no value found */
    JoxSiteKind site;
    uint32_t source;
    int32_t tree;
} JoxKind;

typedef struct JoxKinds {
    const JoxScript *script;
    uint32_t source_count;
    JoxKind **trees, **variables; /* by source, then node or variable; NULL: not parsed */
    uint64_t looks;
    uint32_t followed; /* steps of all calls of jox_part_find, which are bounded */
    bool changed;      /* by the present pass */
    bool settled;      /* the kinds are final; false: the script is too large to tell */
} JoxKinds;

/* Infers the kinds of all files of a script that has run. Free with jox_kinds_free, which
   also takes NULL. */
JoxKinds *jox_kinds_read(const JoxScript *script);
void jox_kinds_free(JoxKinds *kinds);
/* Place in a source where a part of a machine is written. */
typedef struct JoxPartOrigin {
    uint32_t source, key, first, last; /* tokens: the key; the value, `last` exclusive */
} JoxPartOrigin;

/* Finds where a part of the machine that the script returns is written, by its path as
   "states.Wait.2.when"; false if the code that builds it cannot be followed. In part_origin.c. */
bool jox_part_find(JoxKinds *kinds, const char *path, JoxPartOrigin *found);

/* Returns whether an expression of this kind surely is a value of the language, which Lua always
   takes for true. */
static inline bool jox_kind_is_value(JoxKind kind) {
    return kind.bits != 0 && (kind.bits & ~(JOX_KIND_CONDITION | JOX_KIND_VALUE)) == 0;
}

#endif
