/* Sends messages and diagnostics of a run to its message function, and fills errors for its
   caller. */
#ifndef JOX_RUN_MESSAGES_H
#define JOX_RUN_MESSAGES_H

#include "base/format/diag.h"
#include "base/text.h"
#include "jostle.h"

/* Receives the diagnostics of files that were loaded. `parts` says which parts of the run they
   belong to (watch/changes.h); NULL: to a scene that begins. No errors: the files are live.
   `diagnostics` is NULL in a second call, after the same ones were sent as text. */
typedef void JoxDiagnosed(void *context, const bool *parts, const JoxDiagnostics *diagnostics);

/* Sends formatted text, cut at 2047 bytes, to the scene's message function. */
void jox_run_say(const JoScene *scene, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/* Sends text to the scene's message function. */
void jox_run_send_text(const JoScene *scene, const char *text);
/* Sends text to a message function of the program; NULL: to stderr. */
void jox_run_send_message(JoMessage *message, void *context, const char *text);
/* The message function that writes to stderr; clears the line of progress first. */
void jox_run_write_to_stderr(void *context, const char *text);
/* Sends diagnostics as text, fills `error` from the first error, and frees them. */
void jox_run_report_diagnostics(JoMessage *message, void *context, JoxDiagnostics *diagnostics,
                                JoError *error);
/* Calls `diagnosed`, unless NULL. */
void jox_run_call_diagnosed(JoxDiagnosed *diagnosed, void *context, const bool *parts,
                            const JoxDiagnostics *diagnostics);
/* Fills `error` with what could not be written, and frees the text. Returns false. */
bool jox_run_fill_error(JoError *error, JoxText *why);

#endif
