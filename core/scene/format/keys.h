/* Tables of keys, by which a tree of YAML fills structs of C. A JoxKey is a row: a key with its
   type, unit, range, default and meaning, and the member that its value is stored in. A JoxOwner is
   a kind of map that has keys ("scene", "place", "wall", ...). Since values are read by walking the
   rows, and the reference pages and JSON schemas are printed from them, a key is documented if it
   is read. The table of the scene format is scene/key_table.c. For each map jox_owner_read calls
   jox_owner_check_keys, the readers of its keys (JoxKey.read), and JoxOwner.finish; when all items
   of a map or list are read, JoxOwner.resolve is called for each of them. */
#ifndef JOX_SCENE_KEYS_H
#define JOX_SCENE_KEYS_H

#include <stddef.h>

#include "scene/format/values.h"

typedef enum {
    JOX_TYPE_NUMBER, /* in SI units, or a text with a unit of the key's dimension */
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

/* How a key's value is stored. In braces: the value stored if the key is wrong, or missing without
   a default. */
typedef enum {
    JOX_STORE_UNSET,   /* a mistake in the table */
    JOX_STORE_CHECKED, /* range-checked, not stored */
    JOX_STORE_EARLIER, /* not read from the table: the files of YAML and of mods have read it */
    JOX_STORE_READ,    /* by the function JoxKey.read */
    JOX_STORE_ITEMS,   /* as an array of structs of the owner JoxKey.content, and their number */
    JOX_STORE_STRUCT,  /* a TABLE, in a member that is a struct, or in the struct of its parent */
    JOX_STORE_BOOL,    /* for a text with two choices: whether it is the second */
    JOX_STORE_FLOAT,   /* {NAN} */
    JOX_STORE_DOUBLE,  /* {NAN} */
    JOX_STORE_UINT32, /* {0}; names with choices: bit set; text with choices: index of the choice */
    JOX_STORE_UINT64, /* {0} */
    JOX_STORE_TEXT,   /* {NULL} */
    JOX_STORE_DOUBLES2, /* {unchanged} */
    JOX_STORE_DOUBLES3  /* {unchanged} */
} JoxStore;

typedef struct JoxKey JoxKey;
struct JoxKey {
    const char *owner, *name; /* owner: "scene", "place", ... */
    JoxKeyType type;
    const char *unit;         /* SI unit of its numbers; "" for none */
    double least, greatest;   /* range of its numbers; both 0: no range is printed */
    const char *default_text; /* "": no default; "!": the key is required */
    const char *meaning;      /* for the reference */
    /* Type of the values of a TABLE, LIST, POINTS or VALUES: the name of an owner, or "xy", "xyz"
       (points), "spots" (a point, or a list of them), "start" (time and place, optionally
       velocity), "quantity" (number with any unit), "weight", "draw" (number or distribution),
       "value" (draw or place). Suffixes, read from left to right: "*" a map of names to it, "[n]" a
       list of at least n. "xy[2][2]": a list of at least two lists of at least two points. NULL:
       `type` says all. */
    const char *content;
    const char *choices; /* allowed values of a TEXT or NAMES, "this|that"; NULL: any */
    JoxStore store;
    size_t offset;       /* offset of the member in the owner's struct */
    size_t count_offset; /* offset of the member that holds the number of values */
    bool first;          /* read before the other keys of its owner */
    bool placed;         /* its numbers are a point of the plan, and are stored as its position on
                            the sheet of its storey */
    bool in_draft;       /* offsets are in the reader's JoxSceneDraft, not in the owner's struct */
    /* For JOX_STORE_READ: reads `node` (NULL: the key is missing) into `item`, the owner's struct;
       reports what is wrong. */
    void (*read)(const JoxReader *reader, const JoxKey *key, const JoxYaml *node, void *item);
    /* 1 + the kind of the owner that this key selects; a map must have exactly one key that selects
       a kind. 0: the key selects none. */
    int selected_kind;
    const char
        *restart_reason; /* why a change waits for the next start; NULL: a reload applies it */
    const char *example; /* how to write it, for the hints of errors */
};

#define JOX_STORE_OF(lvalue)                                                                       \
    _Generic(&(lvalue), bool *: JOX_STORE_BOOL, float *: JOX_STORE_FLOAT,                          \
             double *: JOX_STORE_DOUBLE, uint32_t *: JOX_STORE_UINT32,                             \
             uint64_t *: JOX_STORE_UINT64, char **: JOX_STORE_TEXT, const char **: JOX_STORE_TEXT, \
             double (*)[2]: JOX_STORE_DOUBLES2, double (*)[3]: JOX_STORE_DOUBLES3,                 \
             default: JOX_STORE_STRUCT)
/* Columns of a row that say how its value is stored: in a member, as an array and its number, by a
   function, in the struct of the parent. */
#define JOX_TO(Struct, member)                                                                     \
    .store = JOX_STORE_OF(((Struct *)0)->member), .offset = offsetof(Struct, member)
#define JOX_TO_ITEMS(Struct, member, number)                                                       \
    .store = JOX_STORE_ITEMS, .offset = offsetof(Struct, member),                                  \
    .count_offset = offsetof(Struct, number)
#define JOX_READ(function) .store = JOX_STORE_READ, .read = function
#define JOX_READ_TO(function, Struct, member, number)                                              \
    .store = JOX_STORE_READ, .read = function, .offset = offsetof(Struct, member),                 \
    .count_offset = offsetof(Struct, number)
#define JOX_SAME_STRUCT .store = JOX_STORE_STRUCT, .offset = 0
#define JOX_READ_EARLIER .store = JOX_STORE_EARLIER
#define JOX_CHECKED .store = JOX_STORE_CHECKED
#define JOX_SELECTS_KIND(enumerator) .selected_kind = 1 + (enumerator)
/* The member of `item` at an offset, as a pointer to Type. */
#define JOX_MEMBER(Type, item, offset) ((Type *)(void *)((char *)(item) + (offset)))

/* A kind of map that has keys, in the order of the reference. Offsets are 1 + the offset of a
   member of its struct; 0: the struct has no such member. */
typedef struct JoxOwner {
    const char *name, *heading, *description; /* heading and text of its section of the reference */
    size_t struct_size;         /* 0: its values are stored in the struct of its parent */
    size_t kind_offset;         /* int: the kind that the map's one selecting key stands for */
    const char *kind_error;     /* code of the error if a map selects no kind, or several */
    size_t name_offset;         /* char *: its name, the key of the parent's map */
    size_t position_offset;     /* JoxPosition: where the map stands in the file */
    const char *hint;           /* how to write one, for errors */
    const char *reserved_names; /* reserved names: "this|that"; NULL: none */
    /* Called when all keys of a map are read: checks and completes what several keys say together.
       `good`: each key alone is right. Returns whether to keep the item. NULL: kept if good. */
    bool (*finish)(const JoxReader *reader, const JoxYaml *map, void *item, bool good);
    /* Called when all items of the parent's map or list are read: looks up names of other items. */
    void (*resolve)(const JoxReader *reader, const JoxYaml *map, void *item);
} JoxOwner;

/* A rule on how many of several keys a map has. */
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

/* The format of scenes and of a mod's mod.yaml, defined in scene/key_table.c. */
extern const JoxFormat jox_scene_format;

/* Return the row of a key, or of an owner whose name has `length` bytes; NULL if there is none. */
const JoxKey *jox_key_find(const JoxFormat *format, const char *owner, const char *name);
const JoxOwner *jox_owner_find(const JoxFormat *format, const char *name, size_t length);
/* Copies word `n` of "this|that" to `out`, truncated to `size`; false if there are fewer words. */
bool jox_choice_name(const char *choices, int n, char *out, size_t size);
/* Returns the index of `word` in "this|that", or -1. */
int jox_choice_find(const char *choices, const char *word);
/* Appends the owner's keys that select a kind, as "this|that"; nothing if it has no kinds. */
void jox_owner_list_kinds(const JoxFormat *format, const char *owner, JoxText *out);
/* Appends "this|that|those" as "this, that or those". */
void jox_choices_print(const char *choices, JoxText *out);

/* Reports the map's keys that the owner lacks, and required keys that are missing; false if `map`
   is not a map. */
bool jox_owner_check_keys(const JoxReader *reader, const JoxYaml *map, const char *owner);
/* Fills `item`, the struct of an owner, with the values of a map, or with defaults; reports all
   that is wrong. `map` NULL: a map without keys. Returns whether to keep the item. */
bool jox_owner_read(const JoxReader *reader, const JoxYaml *map, const char *owner, void *item);
/* Returns on how many storeys an item is that is read once for each of them: the length of a list
   `storey`, else 1. */
uint32_t jox_owner_count_copies(const JoxFormat *format, const char *owner, const JoxYaml *map);
/* Reads the map or list of a key with JOX_STORE_ITEMS into `item`. */
void jox_key_read_items(const JoxReader *reader, const JoxKey *key, const JoxYaml *node,
                        void *item);
/* Returns a number within the key's range; if the node is NULL or wrong (reported), the default, or
   NAN if there is none. */
double jox_key_read_number(const JoxReader *reader, const JoxKey *key, const JoxYaml *node);
/* Reads two or three numbers within the key's range; false if the node is NULL or wrong
   (reported). */
bool jox_key_read_vector(const JoxReader *reader, const JoxKey *key, const JoxYaml *node,
                         double *out, int count);
/* Returns the text of a scalar node; NULL if the node is NULL, or not a scalar: then reports that
   the key must be a `what` ("name", "text"). */
const char *jox_key_read_scalar(const JoxReader *reader, const JoxKey *key, const JoxYaml *node,
                                const char *what);

#endif
