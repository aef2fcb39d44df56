/* Diagnostics: errors, warnings and notes about users' files, with file, line and column. All
   readers of files add theirs to a list, which is printed or written as JSON at the end. */
#ifndef JOX_BASE_FORMAT_DIAG_H
#define JOX_BASE_FORMAT_DIAG_H

#include <stdbool.h>
#include <stddef.h>

#include "base/text.h"

typedef enum { JOX_SEVERITY_ERROR, JOX_SEVERITY_WARNING, JOX_SEVERITY_NOTE } JoxSeverity;

/* A position in a file. Lines and columns, which are characters, count from 1; 0 is unknown.
   `end_column` is exclusive. */
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
    char *source;     /* the line of the file, or NULL */
    char *now;        /* new name, for a name that a behaviour's author has changed; else NULL */
} JoxDiagnostic;

/* A list; zero-initialise, free by jox_diag_free. Keeps the first `limit` errors and as many
   warnings and notes; counts all. */
typedef struct JoxDiagnostics {
    JoxDiagnostic *items;
    size_t count, capacity;
    size_t errors, warnings;
    size_t kept_errors; /* errors among the items */
    size_t limit;       /* 0: 20 */
} JoxDiagnostics;

/* Returns the position of a byte offset in a text. */
JoxPosition jox_position_in(const char *file, const char *text, size_t offset);

/* Whether one more would be kept; if not, callers can skip computing its hint. */
bool jox_diag_has_room(const JoxDiagnostics *diagnostics, JoxSeverity severity);

/* Whether the list has this diagnostic: a file may be loaded, and a machine used, several times. */
bool jox_diag_lists(const JoxDiagnostics *diagnostics, JoxPosition position, const char *code,
                    const char *message);

/* Appends a diagnostic. `hint`, `context` and `source` may be NULL. All texts but `code` are
 * copied. */
void jox_diag_add(JoxDiagnostics *diagnostics, JoxSeverity severity, JoxPosition position,
                  const char *code, const char *hint, const char *context, const char *source,
                  const char *format, ...) __attribute__((format(printf, 8, 9)));
/* Appends an error without context and source line. */
#define jox_diag_error(diagnostics, position, code, hint, ...)                                     \
    jox_diag_add(diagnostics, JOX_SEVERITY_ERROR, position, code, hint, NULL, NULL, __VA_ARGS__)

/* Appends an error at a name that a behaviour's author has changed. */
void jox_diag_renamed(JoxDiagnostics *diagnostics, JoxPosition position, const char *was,
                      const char *now);
#define jox_diag_warn(diagnostics, position, code, hint, ...)                                      \
    jox_diag_add(diagnostics, JOX_SEVERITY_WARNING, position, code, hint, NULL, NULL, __VA_ARGS__)
#define jox_diag_note(diagnostics, position, code, ...)                                            \
    jox_diag_add(diagnostics, JOX_SEVERITY_NOTE, position, code, NULL, NULL, NULL, __VA_ARGS__)

/* Checks that a text is UTF-8 without zero bytes; false with an error at the first wrong byte. A
   zero must follow the text. */
bool jox_diag_check_text(JoxDiagnostics *diagnostics, const char *file, const char *text,
                         size_t length);
/* Sets the source line of the diagnostics of `file` that lack it, from the file's text. */
void jox_diag_attach_source(JoxDiagnostics *diagnostics, const char *file, const char *text,
                            size_t length);
/* Prints each as "file:12:7: message. hint", the source line with carets, the context; then the
   number of errors that were not kept. */
void jox_diag_print(const JoxDiagnostics *diagnostics, JoxText *out);
/* Writes a JSON array of objects: file, line, column, end, severity, code, message, hint, and
   `now`, the new name, for a name that was changed. */
void jox_diag_json(const JoxDiagnostics *diagnostics, JoxText *out);
/* Moves all diagnostics of `from` to the end of `to`, except those that it has already. */
void jox_diag_move(JoxDiagnostics *to, JoxDiagnostics *from);
void jox_diag_free(JoxDiagnostics *diagnostics);

#endif
