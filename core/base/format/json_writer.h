/* Writing JSON: the one layout of all that Jostle writes. A key is followed by ": ", items are
   separated by ", "; of the outermost `lines` levels, the members of objects and the objects and
   arrays in arrays stand on a line each. Texts are escaped, bytes that are not UTF-8 become U+FFFD,
   numbers that are not finite become null. Each value takes the key that it has in an object, or
   NULL in an array and at the outermost. */
#ifndef JOX_BASE_FORMAT_JSON_WRITER_H
#define JOX_BASE_FORMAT_JSON_WRITER_H

#include <stdbool.h>
#include <stdint.h>

#include "base/text.h"

enum { JOX_JSON_DEEPEST = 32 };

typedef struct JoxJson {
    JoxText *out;
    int lines; /* may be changed between values */
    int depth;
    bool ended; /* the outermost value has begun: there is one */
    struct JoxJsonLevel {
        bool is_object, any, on_lines; /* whether it has items, and some on lines of their own */
    } levels[JOX_JSON_DEEPEST];
} JoxJson;

/* A document that is appended to `out`. What is written must be one value; who ends it with a
   newline adds that to `out`. */
JoxJson jox_json_begin(JoxText *out, int lines);

void jox_json_object(JoxJson *json, const char *key);
void jox_json_array(JoxJson *json, const char *key);
/* Ends the innermost object or array. */
void jox_json_end(JoxJson *json);

/* NULL is written as null. */
void jox_json_string(JoxJson *json, const char *key, const char *string);
/* A string that is put together as by printf, then escaped. */
void jox_json_format(JoxJson *json, const char *key, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* With 9 significant digits, or with as many as given (1 to 17). */
void jox_json_number(JoxJson *json, const char *key, double number);
void jox_json_digits(JoxJson *json, const char *key, double number, int digits);
void jox_json_whole(JoxJson *json, const char *key, uint64_t number);
void jox_json_integer(JoxJson *json, const char *key, int64_t number);
void jox_json_bool(JoxJson *json, const char *key, bool value);
void jox_json_null(JoxJson *json, const char *key);
/* An array of numbers with so many digits each. */
void jox_json_numbers_of(JoxJson *json, const char *key, const double *numbers, int count,
                         int digits);

#endif
