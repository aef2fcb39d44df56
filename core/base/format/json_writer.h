/* Writing of JSON, with one layout for all that Jostle writes: ": " after a key, ", " between
   items; in the outermost `lines` levels, members of objects, and objects and arrays in arrays,
   have a line each. Texts are escaped, bytes that are not UTF-8 become U+FFFD, numbers that are not
   finite become null. The argument `key` is the member's name within an object, and NULL in an
   array and for the outermost value. */
#ifndef JOX_BASE_FORMAT_JSON_WRITER_H
#define JOX_BASE_FORMAT_JSON_WRITER_H

#include <stdbool.h>
#include <stdint.h>

#include "base/text.h"

enum { JOX_JSON_DEEPEST = 32 };

typedef struct JoxJson {
    JoxText *out;
    int lines;  /* levels with lines; may be changed between values */
    int depth;  /* open objects and arrays */
    bool ended; /* the outermost value has begun; a second one is an error */
    struct JoxJsonLevel {
        bool is_object, any, on_lines; /* any: has items; on_lines: some have their own lines */
    } levels[JOX_JSON_DEEPEST];
} JoxJson;

/* Begins a document, one value, that is appended to `out`, without a newline at its end. */
JoxJson jox_json_begin(JoxText *out, int lines);

void jox_json_object(JoxJson *json, const char *key);
void jox_json_array(JoxJson *json, const char *key);
/* Ends the innermost object or array. */
void jox_json_end(JoxJson *json);

/* Writes a string; null for NULL. */
void jox_json_string(JoxJson *json, const char *key, const char *string);
/* Formats a string as printf does, then escapes it. */
void jox_json_format(JoxJson *json, const char *key, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* Write a number with 9 significant digits, or with `digits` of them (1 to 17). */
void jox_json_number(JoxJson *json, const char *key, double number);
void jox_json_digits(JoxJson *json, const char *key, double number, int digits);
void jox_json_whole(JoxJson *json, const char *key, uint64_t number);
void jox_json_integer(JoxJson *json, const char *key, int64_t number);
void jox_json_bool(JoxJson *json, const char *key, bool value);
void jox_json_null(JoxJson *json, const char *key);
/* Writes an array of numbers with `digits` significant digits each. */
void jox_json_numbers_of(JoxJson *json, const char *key, const double *numbers, int count,
                         int digits);

#endif
