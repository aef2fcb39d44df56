/* Reading of JSON (RFC 8259) by cJSON. Limits are checked before anything is allocated, so that
   hostile texts exhaust neither memory nor the stack. Used for commands of browsers and for
   Jostle's files. */
#ifndef JOX_BASE_FORMAT_JSON_H
#define JOX_BASE_FORMAT_JSON_H

#include <stdbool.h>
#include <stddef.h>

typedef struct JoxJsonLimits {
    size_t length, items; /* bytes of text; number of values, without keys */
    int depth;            /* levels of nested objects and arrays */
} JoxJsonLimits;

typedef enum {
    JOX_JSON_NULL,
    JOX_JSON_BOOL,
    JOX_JSON_NUMBER,
    JOX_JSON_TEXT,
    JOX_JSON_OBJECT,
    JOX_JSON_ARRAY
} JoxJsonKind;

typedef struct JoxJsonItem {
    JoxJsonKind kind;
    int depth;        /* 1 for a member of the document's object */
    double number;    /* 1 and 0 for true and false */
    const char *text; /* the value of a text, else NULL; valid within the call */
    const char *key;  /* the key of an object's member, else NULL */
    const char *path; /* keys and indices (from 0) joined by dots, as "states.walker.Walk" */
} JoxJsonItem;

/* Called for a value. Returns false to stop reading; jox_json_read then returns false. */
typedef bool JoxJsonVisit(void *context, const JoxJsonItem *item);

/* Calls `visit` for each value within a document, which must be one object, in order. Returns
   false, before any call, if the text is not a JSON object, is not UTF-8, has control characters in
   a text or a number that is not finite, or exceeds a limit. */
bool jox_json_read(const char *text, JoxJsonLimits limits, JoxJsonVisit *visit, void *context);

/* Limits for files that Jostle wrote: 64 MB, 2^20 values, 16 levels. */
extern const JoxJsonLimits jox_json_own_files;
/* Calls `number` for each number of an object in such a file, in order. */
typedef void JoxJsonNumber(void *context, const char *path, double value);
bool jox_json_numbers(const char *text, JoxJsonNumber *number, void *context);

#endif
