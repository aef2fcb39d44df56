/* Files that were saved and could not go live, as pages are told of them. */
#include <string.h>

#include "base/json_writer.h"
#include "base/mem.h"
#include "live/view_parts.h"

static void add_error(JoxJson *json, const JoxDiagnostic *d) {
    jox_json_object(json, NULL);
    jox_json_string(json, "file", d->file ? d->file : "");
    jox_json_integer(json, "line", d->line);
    jox_json_integer(json, "column", d->column);
    jox_json_integer(json, "end", d->end_column);
    jox_json_string(json, "text", d->message);
    jox_json_string(json, "source", d->source ? d->source : "");
    jox_json_string(json, "hint", d->hint ? d->hint : "");
    jox_json_string(json, "context", d->context ? d->context : "");
    jox_json_end(json);
}

void jox_viewing_tell_mistakes(JoxViewing *v, uint32_t client) {
    v->text.length = 0;
    JoxJson json = jox_json_begin(&v->text, 0);
    jox_json_object(&json, NULL);
    jox_json_string(&json, "type", "errors");
    jox_json_array(&json, "errors");
    for (size_t m = 0; m < v->mistake_count; m++)
        for (size_t i = 0; i < v->mistakes[m].errors.count; i++)
            add_error(&json, &v->mistakes[m].errors.items[i]);
    jox_json_end(&json);
    jox_json_end(&json);
    jox_view_send(v->view, client, v->text.data);
}

void jox_viewing_forget_mistakes(JoxViewing *v) {
    for (size_t m = 0; m < v->mistake_count; m++)
        jox_diag_free(&v->mistakes[m].errors);
    v->mistake_count = 0;
}

/* What was wrong with the same files, or with a beginning, counts no more. */
static void drop_mistakes(JoxViewing *v, const bool *parts) {
    for (size_t m = v->mistake_count; m-- > 0;) {
        bool shared = false, beginning = true;
        for (uint32_t p = 0; p < JOX_PARTS; p++) {
            shared |= parts && parts[p] && v->mistakes[m].parts[p];
            beginning &= !v->mistakes[m].parts[p];
        }
        if (!shared && !beginning)
            continue;
        jox_diag_free(&v->mistakes[m].errors);
        v->mistakes[m] = v->mistakes[--v->mistake_count];
    }
}

static void keep_errors(const JoxDiagnostics *diagnostics, JoxDiagnostics *kept) {
    for (size_t i = 0; i < diagnostics->count; i++) {
        const JoxDiagnostic *d = &diagnostics->items[i];
        const JoxPosition position = {d->file, d->line, d->column, d->end_column};
        if (d->severity == JOX_SEVERITY_ERROR)
            jox_diag_add(kept, d->severity, position, d->code, d->hint, d->context, d->source, "%s",
                         d->message);
    }
}

/* The scene's own: files were loaded, or (without diagnostics) what is wrong has been printed. */
void jox_viewing_diagnosed(void *context, const bool *parts, const JoxDiagnostics *diagnostics) {
    JoxViewing *v = context;
    v->told = diagnostics && diagnostics->errors;
    if (!diagnostics)
        return;
    if (parts || diagnostics->errors)
        drop_mistakes(v, parts);
    else
        jox_viewing_forget_mistakes(v);
    if (diagnostics->errors &&
        (parts || !v->mistake_count)) { /* files that are watched are known */
        JOX_RESERVE(v->mistakes, v->mistake_capacity, v->mistake_count + 1);
        JoxMistake *mistake = &v->mistakes[v->mistake_count++];
        *mistake = (JoxMistake){.errors = {0}};
        if (parts)
            memcpy(mistake->parts, parts, sizeof mistake->parts);
        keep_errors(diagnostics, &mistake->errors);
    }
    jox_viewing_tell_mistakes(v, JOX_VIEW_ALL);
}
