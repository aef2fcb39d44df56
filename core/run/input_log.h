/* The input log that a run writes, and the files that logs hold. input_log_writer.c writes entries;
   input_log_files.c writes the texts of reloaded files and compares a played log with the run. */
#ifndef JOX_RUN_INPUT_LOG_H
#define JOX_RUN_INPUT_LOG_H

#include "base/overlay.h"
#include "jostle.h"
#include "world/input/input_entries.h"

/* Appends an entry to the log that is written, if there is one, as of the step that comes. */
void jox_run_log_entry(JoScene *scene, JoxInputEntry *entry);
/* False with `error` if an entry could not be written. */
bool jox_run_check_log_written(const JoScene *scene, JoError *error);
/* Closes the log. False with `error` if it could not be written. */
bool jox_run_close_log(JoScene *scene, JoError *error);

/* Texts that a reload replaces: those live before it, and those that go live. */
typedef struct JoxReloadedFiles {
    JoxInputEntry before, files;
} JoxReloadedFiles;
/* Notes the text of a file that is about to go live, if it differs from the one live now. */
void jox_run_note_file(JoScene *scene, JoxReloadedFiles *reloaded, const char *path,
                       const char *sha256, const char *text, size_t length);
/* Writes what was noted to the log, and frees it. */
void jox_run_log_files(JoScene *scene, JoxReloadedFiles *reloaded);
/* Whether a file is live with exactly this text. */
bool jox_run_is_text_live(const JoScene *scene, const JoxInputFile *file);

/* Says where the run differs from the one that wrote the played log: seed, step, files. */
void jox_run_compare_with_log(const JoScene *scene);
/* Puts the texts that files had when a log's run began into an overlay. */
void jox_run_restore_logged_texts(JoxOverlay *overlay, const JoxInputLog *log);

#endif
