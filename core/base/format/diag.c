#include "base/format/diag.h"
#include "base/format/plurals.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/format/json_writer.h"
#include "base/format/path.h"
#include "base/mem.h"

enum { KEPT = 20, SOURCE_SHOWN = 200 };

JoxPosition jox_position_in(const char *file, const char *text, size_t offset) {
    int line = 1;
    const char *line_start = text;
    for (const char *c = text; c < text + offset; c++)
        if (*c == '\n') {
            line++;
            line_start = c + 1;
        }
    const int column =
        1 + (int)jox_count_characters(line_start, (size_t)(text + offset - line_start));
    return (JoxPosition){file, line, column, column + 1};
}

bool jox_diag_has_room(const JoxDiagnostics *d, JoxSeverity severity) {
    bool error = severity == JOX_SEVERITY_ERROR;
    return (error ? d->kept_errors : d->count - d->kept_errors) < (d->limit ? d->limit : KEPT);
}

/* Whether two paths, such as "./a.lua" and "a.lua", lead to the same file. */
static bool is_same_file(const char *a, const char *b) {
    return a == b || (a && b && jox_path_same(a, b));
}

bool jox_diag_lists(const JoxDiagnostics *d, JoxPosition position, const char *code,
                    const char *message) {
    for (size_t i = 0; i < d->count; i++) {
        const JoxDiagnostic *item = &d->items[i];
        if (item->line == position.line && item->column == position.column &&
            !strcmp(item->code, code) && !strcmp(item->message, message) &&
            is_same_file(item->file, position.file))
            return true;
    }
    return false;
}

void jox_diag_add(JoxDiagnostics *d, JoxSeverity severity, JoxPosition position, const char *code,
                  const char *hint, const char *context, const char *source, const char *format,
                  ...) {
    if (jox_diag_has_room(d, severity)) {
        JoxText message = {0};
        char text[2048];
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(text, sizeof text, format, arguments);
        va_end(arguments);
        jox_text_clean(text); /* texts from files must not send control sequences to the terminal */
        jox_text_add(&message, text);
        JOX_RESERVE(d->items, d->capacity, d->count + 1);
        d->kept_errors += severity == JOX_SEVERITY_ERROR;
        d->items[d->count++] = (JoxDiagnostic){.severity = severity,
                                               .file = jox_strdup(position.file),
                                               .line = position.line,
                                               .column = position.column,
                                               .end_column = position.end_column,
                                               .code = code,
                                               .message = message.data,
                                               .hint = jox_strdup(hint),
                                               .context = jox_strdup(context),
                                               .source = jox_strdup(source)};
    }
    d->errors += severity == JOX_SEVERITY_ERROR;
    d->warnings += severity == JOX_SEVERITY_WARNING;
}

void jox_diag_renamed(JoxDiagnostics *d, JoxPosition position, const char *was, const char *now) {
    const size_t before = d->count;
    jox_diag_error(d, position, "renamed", "Write the new name", "'%.100s' is called '%.100s' now",
                   was, now);
    if (d->count == before) /* the list is full */
        return;
    d->items[before].now = jox_strdup(now);
}

bool jox_diag_check_text(JoxDiagnostics *d, const char *file, const char *text, size_t length) {
    const unsigned char *bytes = (const unsigned char *)text;
    size_t at = 0, step;
    while (at < length && text[at] && (step = jox_utf8_length(text + at)))
        at += step;
    if (at >= length)
        return true;
    const JoxPosition position = jox_position_in(file, text, at);
    const bool wide = length >= 2 && bytes[0] + bytes[1] == 0xff + 0xfe && bytes[0] >= 0xfe;
    if (wide)
        jox_diag_error(d, position, "bad-text", "Save it as UTF-8", "this file is UTF-16");
    else if (!text[at])
        jox_diag_error(d, position, "bad-text", "Take it out, and save the file as UTF-8",
                       "a text has no zero byte");
    else
        jox_diag_error(d, position, "bad-text",
                       "Save the file as UTF-8: editors often call other encodings Latin-1, "
                       "ISO-8859 or Windows-1252",
                       "the byte 0x%02X is not UTF-8", bytes[at]);
    jox_diag_attach_source(d, file, text, length);
    return false;
}

void jox_diag_attach_source(JoxDiagnostics *d, const char *file, const char *text, size_t length) {
    for (size_t i = 0; i < d->count; i++) {
        JoxDiagnostic *item = &d->items[i];
        if (item->source || item->line < 1 || !item->file || strcmp(item->file, file) != 0)
            continue;
        const char *at = text, *end = text + length;
        for (int line = 1; line < item->line && at < end; line++) {
            const char *newline = memchr(at, '\n', (size_t)(end - at));
            at = newline ? newline + 1 : end;
        }
        const char *stop = at < end ? memchr(at, '\n', (size_t)(end - at)) : NULL;
        size_t n = (size_t)((stop ? stop : end) - at);
        item->source = jox_strndup(at, n < SOURCE_SHOWN ? n : SOURCE_SHOWN);
        jox_text_clean(item->source);
    }
}

static void print_source(const JoxDiagnostic *item, JoxText *out) {
    jox_text_printf(out, "%5d | %s\n", item->line, item->source);
    const int length = (int)jox_count_characters(item->source, strlen(item->source));
    if (item->column < 1 || item->column > length + 1)
        return;
    int width = item->end_column > item->column ? item->end_column - item->column : 1;
    const int room = length - item->column + 2;
    width = width > room ? room : width;
    jox_text_printf(out, "      | %*s", item->column - 1, "");
    for (int i = 0; i < width && i < 80; i++)
        jox_text_append(out, "^", 1);
    jox_text_append(out, "\n", 1);
}

void jox_diag_print(const JoxDiagnostics *d, JoxText *out) {
    char more[JOX_NOUN];
    for (size_t i = 0; i < d->count; i++) {
        const JoxDiagnostic *item = &d->items[i];
        if (item->file)
            jox_text_printf(out, "%s:", item->file);
        if (item->line > 0)
            jox_text_printf(out, "%d:", item->line);
        if (item->line > 0 && item->column > 0)
            jox_text_printf(out, "%d:", item->column);
        const char *label[] = {"", "warning: ", "note: "};
        jox_text_printf(out, "%s%s%s", item->file ? " " : "", label[item->severity], item->message);
        if (item->hint)
            jox_text_printf(out, ". %s", item->hint);
        jox_text_append(out, "\n", 1);
        if (item->source && item->line > 0 && item->severity != JOX_SEVERITY_NOTE)
            print_source(item, out);
        if (item->context)
            jox_text_printf(out, " %s\n", item->context);
    }
    if (d->errors > d->kept_errors)
        jox_text_printf(out, "... and %s\n",
                        jox_noun(more, d->errors - d->kept_errors, "more error"));
}

void jox_diag_json(const JoxDiagnostics *d, JoxText *out) {
    static const char *const SEVERITIES[] = {[JOX_SEVERITY_ERROR] = "error",
                                             [JOX_SEVERITY_WARNING] = "warning",
                                             [JOX_SEVERITY_NOTE] = "note"};
    JoxJson json = jox_json_begin(out, 1);
    jox_json_array(&json, NULL);
    for (size_t i = 0; i < d->count; i++) {
        const JoxDiagnostic *item = &d->items[i];
        jox_json_object(&json, NULL);
        jox_json_string(&json, "file", item->file ? item->file : "");
        jox_json_integer(&json, "line", item->line);
        jox_json_integer(&json, "column", item->column);
        jox_json_integer(&json, "end", item->end_column);
        jox_json_string(&json, "severity", SEVERITIES[item->severity]);
        jox_json_string(&json, "code", item->code);
        jox_json_string(&json, "message", item->message);
        jox_json_string(&json, "hint", item->hint ? item->hint : "");
        if (item->now)
            jox_json_string(&json, "now", item->now);
        jox_json_end(&json);
    }
    jox_json_end(&json);
    jox_text_append(out, "\n", 1);
}

void jox_diag_move(JoxDiagnostics *to, JoxDiagnostics *from) {
    for (size_t i = 0; i < from->count; i++) {
        JoxDiagnostic *item = &from->items[i];
        JoxPosition position = {item->file, item->line, item->column, item->end_column};
        if (jox_diag_lists(to, position, item->code, item->message))
            continue;
        const size_t before = to->count;
        jox_diag_add(to, item->severity, position, item->code, item->hint, item->context,
                     item->source, "%s", item->message);
        if (to->count > before && item->now) {
            to->items[before].now = jox_strdup(item->now);
        }
    }
    for (size_t i = 0; i < from->count; i++) { /* leaves the counts of those that were not kept */
        from->errors -= from->items[i].severity == JOX_SEVERITY_ERROR;
        from->warnings -= from->items[i].severity == JOX_SEVERITY_WARNING;
    }
    to->errors += from->errors;
    to->warnings += from->warnings;
    jox_diag_free(from);
}

void jox_diag_free(JoxDiagnostics *d) {
    for (size_t i = 0; i < d->count; i++) {
        jox_free(d->items[i].file);
        jox_free(d->items[i].message);
        jox_free(d->items[i].hint);
        jox_free(d->items[i].context);
        jox_free(d->items[i].source);
        jox_free(d->items[i].now);
    }
    jox_free(d->items);
    *d = (JoxDiagnostics){0};
}
