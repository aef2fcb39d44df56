/* The scene format, once: every key with its type, unit, range, default and meaning. */
#ifndef JOX_SCENE_SCHEMA_H
#define JOX_SCENE_SCHEMA_H

#include "base/random.h"
#include "base/vec.h"
#include "scene/yaml.h"

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

typedef struct JoxKey {
    const char *owner, *name; /* owner: "scene", "place", ... */
    JoxKeyType type;
    const char *unit;
    double least, greatest;
    const char *standard; /* the default as text; "" none; "!" required */
    const char *meaning;
    /* What a TABLE, LIST, POINTS or VALUES holds: an owner, or "xy", "xyz" (points), "quantity" (a
       number with any unit), "weight", "draw" (a number or distribution), "value" (that, or a
       place); behind it, read from the left, "*": a map of names to it, "[n]": a list of n or more.
     */
    const char *of;
    const char *choices; /* of a TEXT with fixed values: "this|that" */
} JoxKey;

extern const JoxKey jox_scene_keys[];
extern const size_t jox_scene_key_count;
#define JOX_FARTHEST 10000 /* m: floats still resolve a millimetre */

/* What has keys, in the order of the reference. */
typedef struct JoxOwner {
    const char *name, *heading, *text;
} JoxOwner;
extern const JoxOwner jox_scene_owners[];
extern const size_t jox_scene_owner_count;

/* Keys of which an owner has so many. */
typedef struct JoxAlternative {
    const char *owner, *keys; /* "this|that" */
    enum { JOX_EXACTLY_ONE, JOX_AT_MOST_ONE, JOX_AT_LEAST_ONE } rule;
} JoxAlternative;
extern const JoxAlternative jox_scene_alternatives[];
extern const size_t jox_scene_alternative_count;

/* Units that may be written, each with the SI unit of its kind and the factor to it. */
typedef struct JoxUnit {
    const char *name, *kind;
    double factor;
} JoxUnit;
extern const JoxUnit jox_scene_units[];
extern const size_t jox_scene_unit_count;

/* Reading context: where errors go. */
typedef struct JoxReader {
    JoxArena *arena;
    JoxDiagnostics *diagnostics;
} JoxReader;

/* Reports keys of the map that the owner lacks, and required keys that are missing; false if
   `map` is no map. */
bool jox_keys_check(const JoxReader *reader, const JoxYaml *map, const char *owner);
/* NULL if the owner has no such key. */
const JoxKey *jox_key_find(const char *owner, const char *name);
/* Item `n` of "this|that", copied to `out`, cut where it is too long; false behind the last. */
bool jox_choice_name(const char *choices, int n, char *out, size_t size);
/* "this, that or those". */
void jox_choices_text(const char *choices, JoxText *out);
/* Whether the key holds a map of further keys. */
bool jox_key_is_table(const char *owner, const char *name);
/* Values by owner and key, checked against the table; the default where the key is missing. */
double jox_key_number(const JoxReader *reader, const JoxYaml *map, const char *owner,
                      const char *name);
bool jox_key_bool(const JoxReader *reader, const JoxYaml *map, const char *owner, const char *name);
const char *jox_key_text(const JoxReader *reader, const JoxYaml *map, const char *owner,
                         const char *name);
/* Which of the key's choices the text is (the default where it is missing); -1 with an error. */
int jox_key_choice(const JoxReader *reader, const JoxYaml *map, const char *owner,
                   const char *name);
/* Two or three numbers; false (with an error if it is there but wrong) when there are none. */
bool jox_key_vector(const JoxReader *reader, const JoxYaml *map, const char *owner,
                    const char *name, double *out, int count);
/* Points of a list; NULL if missing or wrong (reported). */
JoxV2 *jox_read_points(const JoxReader *reader, const JoxYaml *list, uint32_t least,
                       uint32_t *count);
/* Names of a list or of a single scalar. */
uint32_t jox_read_names(const JoxReader *reader, const JoxYaml *node, const JoxYaml *const **out);
/* A number in SI, of text like "2 m", "5 min", "90 deg"; false with an error. */
bool jox_read_number(const JoxReader *reader, const JoxYaml *node, const char *unit, double *out);
/* A number, or "normal(1, 0.1 [, least, greatest])", "uniform(a, b)", "choose(a, b, ...)". Quiet
   false if the text is none of these. */
bool jox_read_dist(const JoxReader *reader, const JoxYaml *node, JoxDist *out);
void jox_scene_error(const JoxReader *reader, const JoxYaml *node, const char *code,
                     const char *hint, const char *format, ...)
    __attribute__((format(printf, 5, 6)));
/* Whether `name` can be that of a `what` ("group"); false with an error. */
bool jox_scene_name(const JoxReader *reader, JoxPosition at, const char *what, const char *name);
/* "Did you mean 'x'?" in a buffer of the arena, or NULL. */
const char *jox_scene_suggest(const JoxReader *reader, const char *word, const char *const *names,
                              size_t count);

#endif
