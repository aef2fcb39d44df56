/* Growing text, JSON escapes, and suggestions for misspelt names. */
#ifndef JOX_BASE_TEXT_H
#define JOX_BASE_TEXT_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

/* Zero-initialise, append, free. `data` is NULL while nothing was appended. */
typedef struct JoxText {
    char *data;
    size_t length, capacity;
} JoxText;

void jox_text_append(JoxText *text, const char *data, size_t length);
void jox_text_add(JoxText *text, const char *string);
void jox_text_printf(JoxText *text, const char *format, ...) __attribute__((format(printf, 2, 3)));
void jox_text_vprintf(JoxText *text, const char *format, va_list arguments);
/* Bytes of the character of UTF-8 that `string` begins with, 1 for its end; 0 if it is none:
   overlong forms, halves of surrogate pairs and what is beyond U+10FFFF are none. */
size_t jox_utf8_length(const char *string);
/* Appends `string` as a JSON string with its quotes; bytes that are not UTF-8 become U+FFFD. */
void jox_text_json(JoxText *text, const char *string);
void jox_text_free(JoxText *text);
/* Makes text fit for a terminal and for one line, in place: control characters and bytes that are
   not UTF-8 become '?', ends of lines blanks. */
void jox_text_clean(char *text);

/* Bytes of the mark of UTF-8 that some editors write first: 3, or 0 where there is none. */
size_t jox_text_mark(const char *text, size_t length);

/* The nearest of `names` to `word` by edit distance, or NULL if none is near enough. */
const char *jox_suggest(const char *word, const char *const *names, size_t count);

/* "Did you mean 'x'?" in `hint`, which is returned; or NULL, and `hint` as it was. */
enum { JOX_HINT = 128 };
const char *jox_did_you_mean(const char *word, const char *const *names, size_t count,
                             char hint[JOX_HINT]);

/* Reads a whole file, or what an overlay in use holds in its place (overlay.h); NULL with errno set
 * (EFBIG when over `limit` bytes). Ends with a NUL. */
char *jox_read_file(const char *path, size_t limit, size_t *length);

#endif
