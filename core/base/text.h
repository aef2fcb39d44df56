/* Growing text, JSON escapes, and suggestions for misspelt names. */
#ifndef JOX_BASE_TEXT_H
#define JOX_BASE_TEXT_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>

/* A growing text that ends with a zero byte. Zero-initialise, append, free by jox_text_free. `data`
   is NULL until something is appended. */
typedef struct JoxText {
    char *data;
    size_t length, capacity;
} JoxText;

void jox_text_append(JoxText *text, const char *data, size_t length);
void jox_text_add(JoxText *text, const char *string);
void jox_text_printf(JoxText *text, const char *format, ...) __attribute__((format(printf, 2, 3)));
void jox_text_vprintf(JoxText *text, const char *format, va_list arguments);
/* Returns the length in bytes of the UTF-8 character at the beginning of `string`, 1 for the final
   zero; 0 if it is invalid (overlong forms, surrogates and code points beyond U+10FFFF are). */
size_t jox_utf8_length(const char *string);
/* Returns the number of UTF-8 characters that begin in a text of `length` bytes. */
size_t jox_count_characters(const char *text, size_t length);
/* Appends `string` as a JSON string with its quotes; bytes that are not UTF-8 become U+FFFD. */
void jox_text_json(JoxText *text, const char *string);
void jox_text_free(JoxText *text);
/* Makes a text safe to print on one line of a terminal, in place: control characters and bytes that
   are not UTF-8 become '?', line ends and tabs become blanks. */
void jox_text_clean(char *text);

/* Returns the length of the byte order mark that some editors write first, 3 bytes, or 0. */
size_t jox_byte_order_mark_length(const char *text, size_t length);

/* Returns the one of `names` that is nearest to `word` by edit distance, or NULL if none is
   near. */
const char *jox_suggest(const char *word, const char *const *names, size_t count);

/* Writes "Did you mean 'x'?" to `hint` and returns it. If no name is near, returns NULL and leaves
   `hint` unchanged. */
enum { JOX_HINT = 128 };
const char *jox_did_you_mean(const char *word, const char *const *names, size_t count,
                             char hint[JOX_HINT]);

/* Reads a whole file, or the text that the overlay in use holds for it (overlay.h), with a zero
   byte at its end. NULL with errno (EFBIG if longer than `limit` bytes). The caller frees it by
   jox_free. */
char *jox_read_file(const char *path, size_t limit, size_t *length);

#endif
