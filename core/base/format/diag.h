/* Diagnostics: every error and warning about a user's file, with its place, kept until shown. */
#ifndef JOX_BASE_FORMAT_DIAG_H
#define JOX_BASE_FORMAT_DIAG_H

#include <stdbool.h>
#include <stddef.h>

#include "base/text.h"

typedef enum { JOX_SEVERITY_ERROR, JOX_SEVERITY_WARNING, JOX_SEVERITY_NOTE } JoxSeverity;

/* A place in a file. Lines and columns count from 1; 0 is unknown. `end_column` is exclusive. */
typedef struct JoxPosition {
    const char *file; /* as the user named it; may be NULL */
    int line, column, end_column;
} JoxPosition;

typedef struct JoxDiagnostic {
    JoxSeverity severity;
    char *file;
    int line, column, end_column;
    const char *code; /* a static, kebab-case name of the kind: "unknown-key" */
    char *message;    /* one sentence */
    char *hint;       /* the way out, or NULL */
    char *context;    /* "machine tawaf > state ToStone > transition 2", or NULL */
    char *source;     /* the line of source, or NULL */
    char *now;        /* the new name, where a behaviour's author renamed one; else NULL */
} JoxDiagnostic;

/* Zero-initialise. Keeps the first `limit` errors and as many others; counts all. */
typedef struct JoxDiagnostics {
    JoxDiagnostic *items;
    size_t count, capacity;
    size_t errors, warnings;
    size_t kept_errors;
    size_t limit; /* 0: 20 */
} JoxDiagnostics;

/* Where byte `offset` of a text stands; columns count characters. */
JoxPosition jox_position_in(const char *file, const char *text, size_t offset);

/* Whether one more would be kept; if not, nobody need look for its hint. */
bool jox_diag_has_room(const JoxDiagnostics *diagnostics, JoxSeverity severity);

/* Appends one. `hint`, `context` and `source` may be NULL; all text is copied (`code` is not). */
void jox_diag_add(JoxDiagnostics *diagnostics, JoxSeverity severity, JoxPosition position,
                  const char *code, const char *hint, const char *context, const char *source,
                  const char *format, ...) __attribute__((format(printf, 8, 9)));
/* The common case: an error at a place. */
#define jox_diag_error(diagnostics, position, code, hint, ...)                                     \
    jox_diag_add(diagnostics, JOX_SEVERITY_ERROR, position, code, hint, NULL, NULL, __VA_ARGS__)

/* An error at a name that a behaviour's author has renamed. */
void jox_diag_renamed(JoxDiagnostics *diagnostics, JoxPosition position, const char *was,
                      const char *now);
#define jox_diag_warn(diagnostics, position, code, hint, ...)                                      \
    jox_diag_add(diagnostics, JOX_SEVERITY_WARNING, position, code, hint, NULL, NULL, __VA_ARGS__)
#define jox_diag_note(diagnostics, position, code, ...)                                            \
    jox_diag_add(diagnostics, JOX_SEVERITY_NOTE, position, code, NULL, NULL, NULL, __VA_ARGS__)

/* Checks that a text, behind whose end a zero stands, is UTF-8 without a zero byte; false with an
   error at the first byte that is not. */
bool jox_diag_check_text(JoxDiagnostics *diagnostics, const char *file, const char *text,
                         size_t length);
/* Sets `source` of every diagnostic of `file` that lacks it, from the file's text. */
void jox_diag_attach_source(JoxDiagnostics *diagnostics, const char *file, const char *text,
                            size_t length);
/* "file:12:7: message. hint", the source line and a caret, the context; and what was left out. */
void jox_diag_print(const JoxDiagnostics *diagnostics, JoxText *out);
/* A JSON array of objects: file, line, column, end, severity, code, message, hint; of
   a name that is called otherwise now its new one, too. */
void jox_diag_json(const JoxDiagnostics *diagnostics, JoxText *out);
/* Moves all of `from` behind `to`, with its counts. */
void jox_diag_move(JoxDiagnostics *to, JoxDiagnostics *from);
void jox_diag_free(JoxDiagnostics *diagnostics);

#endif
