#include "base/text.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/file.h"
#include "base/mem.h"
#include "base/overlay.h"
#include "base/zip.h"

void jox_text_append(JoxText *text, const char *data, size_t length) {
    JOX_RESERVE(text->data, text->capacity, text->length + length + 1);
    if (length)
        memcpy(text->data + text->length, data, length);
    text->length += length;
    text->data[text->length] = 0;
}

void jox_text_add(JoxText *text, const char *string) {
    jox_text_append(text, string, strlen(string));
}

void jox_text_vprintf(JoxText *text, const char *format, va_list arguments) {
    va_list again;
    va_copy(again, arguments);
    int need = vsnprintf(NULL, 0, format, again);
    va_end(again);
    if (need < 0)
        return;
    JOX_RESERVE(text->data, text->capacity, text->length + (size_t)need + 1);
    vsnprintf(text->data + text->length, (size_t)need + 1, format, arguments);
    text->length += (size_t)need;
}

void jox_text_printf(JoxText *text, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    jox_text_vprintf(text, format, arguments);
    va_end(arguments);
}

size_t jox_utf8_length(const char *string) {
    const unsigned char *s = (const unsigned char *)string;
    if (s[0] < 0x80)
        return 1;
    size_t n = s[0] >= 0xF0 && s[0] < 0xF5   ? 4
               : s[0] >= 0xE0 && s[0] < 0xF0 ? 3
               : s[0] >= 0xC2 && s[0] < 0xE0 ? 2
                                             : 0;
    for (size_t i = 1; i < n; i++)
        if ((s[i] & 0xC0) != 0x80)
            return 0;
    bool overlong = (s[0] == 0xE0 && s[1] < 0xA0) || (s[0] == 0xF0 && s[1] < 0x90);
    bool no_character = (s[0] == 0xED && s[1] > 0x9F) || (s[0] == 0xF4 && s[1] > 0x8F);
    return overlong || no_character ? 0 : n;
}

size_t jox_count_characters(const char *text, size_t length) {
    size_t count = 0;
    for (size_t i = 0; i < length; i++)
        count += ((unsigned char)text[i] & 0xC0) != 0x80;
    return count;
}

void jox_text_clean(char *text) {
    for (unsigned char *s = (unsigned char *)text; *s;) {
        size_t n = jox_utf8_length((const char *)s);
        bool control = *s < 32 || *s == 127 || (n == 2 && s[0] == 0xC2 && s[1] < 0xA0);
        if (*s == '\n' || *s == '\t') {
            *s++ = ' ';
        } else if (control || n == 0) { /* a '?' per byte, so that the length stays the same */
            for (size_t end = n ? n : 1; end > 0; end--)
                *s++ = '?';
        } else {
            s += n;
        }
    }
}

void jox_text_json(JoxText *text, const char *string) {
    jox_text_append(text, "\"", 1);
    for (const unsigned char *s = (const unsigned char *)string; *s;) {
        size_t n = jox_utf8_length((const char *)s);
        if (n == 0) {
            jox_text_add(text, "\\ufffd");
            n = 1;
        } else if (*s == '"' || *s == '\\') {
            jox_text_printf(text, "\\%c", *s);
        } else if (*s < 0x20) {
            jox_text_printf(text, "\\u%04x", *s);
        } else {
            jox_text_append(text, (const char *)s, n);
        }
        s += n;
    }
    jox_text_append(text, "\"", 1);
}

void jox_text_free(JoxText *text) {
    jox_free(text->data);
    *text = (JoxText){0};
}

/* Returns the edit distance with transpositions (optimal string alignment) of names up to 63 bytes;
   99 for longer ones. */
static int edit_distance(const char *a, const char *b) {
    size_t n = strlen(a), m = strlen(b);
    if (n > 63 || m > 63)
        return 99;
    int row[3][64];
    for (size_t j = 0; j <= m; j++)
        row[0][j] = (int)j;
    for (size_t i = 1; i <= n; i++) {
        int *now = row[i % 3], *up = row[(i + 2) % 3], *up2 = row[(i + 1) % 3];
        now[0] = (int)i;
        for (size_t j = 1; j <= m; j++) {
            int best = up[j - 1] + (a[i - 1] != b[j - 1]);
            best = up[j] + 1 < best ? up[j] + 1 : best;
            best = now[j - 1] + 1 < best ? now[j - 1] + 1 : best;
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                best = up2[j - 2] + 1 < best ? up2[j - 2] + 1 : best;
            now[j] = best;
        }
    }
    return row[n % 3][m];
}

const char *jox_suggest(const char *word, const char *const *names, size_t count) {
    const char *nearest = NULL;
    /* at most a third of the word's length + 1, and at most 3, letters may differ */
    int limit = (int)strlen(word) / 3 + 1, best = limit < 3 ? limit + 1 : 4;
    for (size_t i = 0; i < count && best > 1; i++) {
        int d = names[i] ? edit_distance(word, names[i]) : 99;
        if (d < best) {
            best = d;
            nearest = names[i];
        }
    }
    return nearest;
}

const char *jox_did_you_mean(const char *word, const char *const *names, size_t count,
                             char hint[JOX_HINT]) {
    const char *near = jox_suggest(word, names, count);
    if (!near)
        return NULL;
    snprintf(hint, JOX_HINT, "Did you mean '%.100s'?", near);
    return hint;
}

/* Returns a copy of an overlay's file; NULL with EFBIG if it is longer than `limit`. */
static char *read_overlay(const JoxOverlayFile *file, size_t limit, size_t *length) {
    if (file->length > limit) {
        errno = EFBIG;
        return NULL;
    }
    if (length)
        *length = file->length;
    return jox_strndup(file->text, file->length);
}

/* Reads a file that lies in an archive. */
static char *read_from_archive(const char *path, size_t limit, size_t *length) {
    size_t read = 0;
    char *text = jox_zip_read(path, limit, &read);
    if (!text)
        return NULL;
    jox_overlay_keep(path, text, read, true);
    if (length)
        *length = read;
    return text;
}

char *jox_read_file(const char *path, size_t limit, size_t *length) {
    const JoxOverlayFile *instead = jox_overlay_file(path);
    if (instead) {
        char *copy = read_overlay(instead, limit, length);
        if (copy)
            jox_overlay_keep(path, instead->text, instead->length, false);
        return copy;
    }
    if (!jox_overlay_opens()) {
        errno = ENOENT;
        return NULL;
    }
    FILE *file = jox_file_open(path, "rb");
    if (!file)
        return errno == ENOTDIR ? read_from_archive(path, limit, length) : NULL;
    JoxText text = {0};
    char block[65536];
    size_t got;
    while ((got = fread(block, 1, sizeof block, file)) > 0 && text.length <= limit)
        jox_text_append(&text, block, got);
    int failed = ferror(file) ? EIO : text.length > limit ? EFBIG : 0;
    jox_file_close(file);
    if (failed) {
        jox_text_free(&text);
        errno = failed;
        return NULL;
    }
    jox_text_append(&text, "", 0);
    jox_overlay_keep(path, text.data, text.length, true);
    if (length)
        *length = text.length;
    return text.data;
}

size_t jox_byte_order_mark_length(const char *text, size_t length) {
    static const char MARK[] = {'\xef', '\xbb', '\xbf'};
    return length >= sizeof MARK && memcmp(text, MARK, sizeof MARK) == 0 ? sizeof MARK : 0;
}
