/* Reading JSON (RFC 8259) by cJSON, with limits that hold before anything is allocated, so that
   what a browser or a file says can neither exhaust memory nor the stack. */
#ifndef JOX_BASE_FORMAT_JSON_H
#define JOX_BASE_FORMAT_JSON_H

#include <stdbool.h>
#include <stddef.h>

typedef struct JoxJsonLimits {
    size_t length, items; /* bytes of text; values, keys not counted */
    int depth;            /* of objects and arrays within each other */
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
    const char *text; /* of a text, else NULL; valid within the call */
    const char *key;  /* in an object, else NULL */
    const char *path; /* keys and indices (from 0) joined by dots, as "states.walker.Walk" */
} JoxJsonItem;

/* Returns false to stop reading: the document is then refused. */
typedef bool JoxJsonVisit(void *context, const JoxJsonItem *item);

/* Calls `visit` for each value of a document that is one object, in order, the outermost object
   left out. Returns false, before any call, if the text is no JSON object, is not UTF-8, has
   control characters in a text, has a number that is not finite, or exceeds a limit. */
bool jox_json_read(const char *text, JoxJsonLimits limits, JoxJsonVisit *visit, void *context);

/* The limits of files that Jostle wrote: 64 MB, a million items, 16 levels. */
extern const JoxJsonLimits jox_json_own_files;
/* Calls `number` for each number of an object in such a file, in order. */
typedef void JoxJsonNumber(void *context, const char *path, double value);
bool jox_json_numbers(const char *text, JoxJsonNumber *number, void *context);

#endif
