/* The format of scenes and of the files that describe mods, as one table: each key has one row,
   with its type, unit, range, default and meaning, where its value goes, and what a reload does
   with it. Values are read by walking the table, so that a key cannot be documented and not read.
 */
#ifndef JOX_SCENE_SCHEMA_H
#define JOX_SCENE_SCHEMA_H

#include <stddef.h>

#include "scene/format/values.h"

typedef enum {
    JOX_TYPE_NUMBER, /* SI, or text with a unit of the key's kind */
    JOX_TYPE_WHOLE,
    JOX_TYPE_BOOL,
    JOX_TYPE_TEXT,
    JOX_TYPE_POINT,  /* [x, y] */
    JOX_TYPE_POINT3, /* [x, y, z] */
    JOX_TYPE_POINTS, /* [[x, y], ...] */
    JOX_TYPE_NAMES,  /* a name or a list of names */
    JOX_TYPE_TABLE,  /* a map with keys of its own */
    JOX_TYPE_LIST,   /* a list of such maps */
    JOX_TYPE_VALUES  /* a map of names to distributions or places */
} JoxKeyType;

/* How a key's value is kept. In braces: what stands there where the key is missing and has no
   default, or is wrong. */
typedef enum {
    JOX_STORE_UNSET,   /* a mistake in the table */
    JOX_STORE_CHECKED, /* not at all: that it is in its range is all that matters */
    JOX_STORE_EARLIER, /* not here: by the file `by`, before the tree is whole */
    JOX_STORE_READ,    /* by the function `read` */
    JOX_STORE_ITEMS,   /* an array of the structs of the owner `of`, and their number */
    JOX_STORE_STRUCT,  /* a TABLE in a struct of its own, or in the same */
    JOX_STORE_BOOL,    /* of a text with two choices: whether it is the second */
    JOX_STORE_FLOAT,   /* {NAN} */
    JOX_STORE_DOUBLE,  /* {NAN} */
    JOX_STORE_UINT32,  /* {0}; of names with choices: a bit for each; of a text: the choice */
    JOX_STORE_UINT64,  /* {0} */
    JOX_STORE_TEXT,    /* {NULL} */
    JOX_STORE_DOUBLES2,
    JOX_STORE_DOUBLES3 /* {as it was} */
} JoxStore;

typedef struct JoxKey JoxKey;
struct JoxKey {
    const char *owner, *name; /* owner: "scene", "place", ... */
    JoxKeyType type;
    const char *unit;
    double least, greatest;
    const char *standard; /* the default as text; "" none; "!" required */
    const char *meaning;
    /* What a TABLE, LIST, POINTS or VALUES holds: an owner, or "xy", "xyz" (points), "start" (a
       time, a place, and it may be a velocity), "quantity" (a number with any unit), "weight",
       "draw" (a number or distribution), "value" (that, or a place); behind it, read from the left,
       "*": a map of names to it, "[n]": a list of n or more.
     */
    const char *of;
    const char *choices; /* of a TEXT or NAMES with fixed values: "this|that" */
    JoxStore store;
    size_t offset;  /* of the member in the struct of the owner */
    size_t counter; /* of the member that holds how many there are */
    bool aside;     /* it is kept in the JoxLoad of the reader, until the item is whole */
    /* Called for JOX_STORE_READ, with node NULL where the key is missing. `item` is the struct of
       the owner. */
    void (*read)(const JoxReader *reader, const JoxKey *key, const JoxYaml *node, void *item);
    const char *by; /* the file that reads it */
    /* 1 and an enumerator: this key says of what kind its owner is, which has exactly one such. */
    int kind;
    const char *later;   /* NULL: a reload takes it over; else why it waits for the next start */
    const char *example; /* how it is written, for errors */
};

#define JOX_STORE_OF(lvalue)                                                                       \
    _Generic(&(lvalue), bool *: JOX_STORE_BOOL, float *: JOX_STORE_FLOAT,                          \
             double *: JOX_STORE_DOUBLE, uint32_t *: JOX_STORE_UINT32,                             \
             uint64_t *: JOX_STORE_UINT64, char **: JOX_STORE_TEXT, const char **: JOX_STORE_TEXT, \
             double (*)[2]: JOX_STORE_DOUBLES2, double (*)[3]: JOX_STORE_DOUBLES3,                 \
             default: JOX_STORE_STRUCT)
/* Columns of a row that say where its value goes. */
#define JOX_TO(Struct, member)                                                                     \
    .store = JOX_STORE_OF(((Struct *)0)->member), .offset = offsetof(Struct, member)
#define JOX_TO_ITEMS(Struct, member, number)                                                       \
    .store = JOX_STORE_ITEMS, .offset = offsetof(Struct, member),                                  \
    .counter = offsetof(Struct, number)
#define JOX_READ(function) .store = JOX_STORE_READ, .read = function
#define JOX_READ_TO(function, Struct, member, number)                                              \
    .store = JOX_STORE_READ, .read = function, .offset = offsetof(Struct, member),                 \
    .counter = offsetof(Struct, number)
#define JOX_SAME_STRUCT .store = JOX_STORE_STRUCT, .offset = 0
#define JOX_EARLIER(file) .store = JOX_STORE_EARLIER, .by = file
#define JOX_CHECKED .store = JOX_STORE_CHECKED
#define JOX_KIND(enumerator) .kind = 1 + (enumerator)
/* The member of `item` in which a key's value, or the number of them, is kept. */
#define JOX_MEMBER(Type, item, offset) ((Type *)(void *)((char *)(item) + (offset)))

/* What has keys, in the order of the reference. */
typedef struct JoxOwner {
    const char *name, *heading, *text;
    size_t size;            /* of its struct; 0: its keys stand in the struct of another owner */
    size_t kind;            /* 1 and the offset of its kind; 0: it has none */
    const char *wrong_kind; /* code of the error of one that has no kind, or several */
    size_t name_at;         /* 1 and the offset of its name, of what a map names */
    size_t place_at;        /* 1 and the offset of the JoxPosition where it is written */
    const char *hint;       /* how one is written, for errors */
    const char *taken;      /* names that it cannot have: "this|that" */
    /* Checks what several keys say together. `good`: each of them is right. False: it is not kept.
     */
    bool (*finish)(const JoxReader *reader, const JoxYaml *map, void *item, bool good);
    /* Called when all of a map or list have been read: looks up what they say of each other. */
    void (*link)(const JoxReader *reader, const JoxYaml *map, void *item);
} JoxOwner;

/* Keys of which an owner has so many. */
typedef struct JoxAlternative {
    const char *owner, *keys; /* "this|that" */
    enum { JOX_EXACTLY_ONE, JOX_AT_MOST_ONE, JOX_AT_LEAST_ONE } rule;
} JoxAlternative;
extern const JoxAlternative jox_scene_alternatives[];
extern const size_t jox_scene_alternative_count;

typedef struct JoxFormat {
    const JoxKey *keys;
    size_t key_count;
    const JoxOwner *owners;
    size_t owner_count;
} JoxFormat;

/* keys.c: the format of scenes, and of the mod.yaml of mods. */
extern const JoxFormat jox_scene_format;

/* NULL if there is none. */
const JoxKey *jox_key_find(const JoxFormat *format, const char *owner, const char *name);
const JoxOwner *jox_owner_find(const JoxFormat *format, const char *name, size_t length);
/* Item `n` of "this|that", copied to `out`, cut where it is too long; false behind the last. */
bool jox_choice_name(const char *choices, int n, char *out, size_t size);
/* Index of `word` in "this|that", or -1. */
int jox_choice_find(const char *choices, const char *word);
/* Appends the keys that say of what kind an owner is, as "this|that"; nothing where it has none. */
void jox_owner_kinds(const JoxFormat *format, const char *owner, JoxText *out);
/* "this, that or those". */
void jox_choices_text(const char *choices, JoxText *out);

/* Reports keys of the map that the owner lacks, and required keys that are missing; false if
   `map` is no map. */
bool jox_keys_check(const JoxReader *reader, const JoxYaml *map, const char *owner);
/* Fills `item`, the struct of an owner, with what a map says of each key, or with the default;
   everything wrong is reported. NULL is a map without keys. False if the item is not to be kept. */
bool jox_keys_fill(const JoxReader *reader, const JoxYaml *map, const char *owner, void *item);
/* Reads the map or list of a key with JOX_STORE_ITEMS into `item`. */
void jox_items_fill(const JoxReader *reader, const JoxKey *key, const JoxYaml *node, void *item);
/* A number within the key's range; where it is missing, or wrong with an error, the default, or NAN
   where there is none. */
double jox_key_number(const JoxReader *reader, const JoxKey *key, const JoxYaml *node);
/* Two or three numbers within the key's range; false, with an error, if they are not that. */
bool jox_key_vector(const JoxReader *reader, const JoxKey *key, const JoxYaml *node, double *out,
                    int count);

#endif
