/* Errors of files that were saved while the scene runs and could not be loaded: kept until the
   files are mended, and sent to browsers. */
#include <string.h>

#include "base/format/json_writer.h"
#include "base/mem.h"
#include "live/scene_page.h"

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

void jox_scene_page_send_errors(void *self, uint32_t client) {
    JoxScenePage *s = self;
    JoxText *text = &s->page.text;
    text->length = 0;
    JoxJson json = jox_json_begin(text, 0);
    jox_json_object(&json, NULL);
    jox_json_string(&json, "type", "errors");
    jox_json_array(&json, "errors");
    for (size_t m = 0; m < s->error_count; m++)
        for (size_t i = 0; i < s->errors[m].errors.count; i++)
            add_error(&json, &s->errors[m].errors.items[i]);
    jox_json_end(&json);
    jox_json_end(&json);
    jox_view_send(s->page.server, client, text->data);
}

void jox_scene_page_forget_errors(JoxScenePage *s) {
    for (size_t m = 0; m < s->error_count; m++)
        jox_diag_free(&s->errors[m].errors);
    s->error_count = 0;
}

/* Drops errors of earlier attempts with the same files, and those of restarts. */
static void drop_errors(JoxScenePage *s, const bool *parts) {
    for (size_t m = s->error_count; m-- > 0;) {
        bool shared = false, beginning = true;
        for (uint32_t p = 0; p < JOX_PARTS; p++) {
            shared |= parts && parts[p] && s->errors[m].parts[p];
            beginning &= !s->errors[m].parts[p];
        }
        if (!shared && !beginning)
            continue;
        jox_diag_free(&s->errors[m].errors);
        s->errors[m] = s->errors[--s->error_count];
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

/* Called by the scene: first with the diagnostics of an attempt to load, then with NULL when they
   have been printed. `parts`: the parts of the scene that were loaded; NULL: all, in a restart. */
void jox_scene_page_diagnosed(void *context, const bool *parts, const JoxDiagnostics *diagnostics) {
    JoxScenePage *s = context;
    s->reported = diagnostics && diagnostics->errors;
    if (!diagnostics)
        return;
    if (parts || diagnostics->errors)
        drop_errors(s, parts);
    else
        jox_scene_page_forget_errors(s);
    if (diagnostics->errors && (parts || !s->error_count)) { /* a restart meets the same errors */
        JOX_RESERVE(s->errors, s->error_capacity, s->error_count + 1);
        JoxLiveFileErrors *kept = &s->errors[s->error_count++];
        *kept = (JoxLiveFileErrors){.errors = {0}};
        if (parts)
            memcpy(kept->parts, parts, sizeof kept->parts);
        keep_errors(diagnostics, &kept->errors);
    }
    jox_scene_page_send_errors(s, JOX_VIEW_ALL);
}
