/* Sends what a run says to its message function, and fills errors for its caller. All files of
   this room call it. */
#include <stdarg.h>
#include <stdio.h>
#include <unistd.h>

#include "base/guard.h"
#include "base/mem.h"
#include "run/run.h"

void jox_run_write_to_stderr(void *context, const char *text) {
    (void)context;
    if (isatty(2)) /* clears the line of progress */
        fputs("\r\033[K", stderr);
    fputs(text, stderr);
}

void jox_run_send_message(JoMessage *message, void *context, const char *text) {
    const JoxOutside outside = jox_guard_leave();
    (message ? message : jox_run_write_to_stderr)(context, text);
    jox_guard_return(outside);
}

void jox_run_send_text(const JoScene *scene, const char *text) {
    jox_run_send_message(scene->message, scene->message_context, text);
}

void jox_run_call_diagnosed(JoxDiagnosed *diagnosed, void *context, const bool *parts,
                            const JoxDiagnostics *diagnostics) {
    const JoxOutside outside = jox_guard_leave();
    if (diagnosed)
        diagnosed(context, parts, diagnostics);
    jox_guard_return(outside);
}

void jox_run_say(const JoScene *scene, const char *format, ...) {
    char text[2048];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    jox_run_send_text(scene, text);
}

void jox_run_report_diagnostics(JoMessage *message, void *context, JoxDiagnostics *diagnostics,
                                JoError *error) {
    JoxText text = {0};
    jox_diag_print(diagnostics, &text);
    if (text.length)
        jox_run_send_message(message, context, text.data);
    jox_text_free(&text);
    for (size_t i = 0; error && i < diagnostics->count; i++) {
        const JoxDiagnostic *d = &diagnostics->items[i];
        if (d->severity != JOX_SEVERITY_ERROR)
            continue;
        jox_error(error, JO_INPUT, d->hint ? "%s. %s" : "%s", d->message, d->hint);
        error->line = d->line;
        error->column = d->column;
        snprintf(error->file, sizeof error->file, "%s", d->file ? d->file : "");
        break;
    }
    jox_diag_free(diagnostics);
}

bool jox_run_fill_error(JoError *error, JoxText *why) {
    jox_error(error, JO_FAILED, "%s", why->data ? why->data : "writing failed");
    jox_text_free(why);
    return false;
}
