/* Writes entries to the input log of a run, and closes it. input_actions.c, input_log_files.c
   and step_scene.c call it. */
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/file.h"
#include "base/mem.h"
#include "run/input_log.h"
#include "run/run.h"

void jox_run_log_entry(JoScene *scene, JoxInputEntry *entry) {
    JoxText text = {0};
    if (!scene->log)
        return;
    entry->tick = (uint32_t)scene->world->state.tick;
    jox_input_write(entry, &text);
    if (fwrite(text.data, 1, text.length, scene->log) != text.length || fflush(scene->log) != 0)
        scene->log_failed = true;
    jox_text_free(&text);
}

bool jox_run_check_log_written(const JoScene *scene, JoError *error) {
    if (scene->log_failed)
        jox_error(error, JO_FAILED, "cannot write the input log '%.200s'", scene->log_path);
    return !scene->log_failed;
}

bool jox_run_close_log(JoScene *scene, JoError *error) {
    if (!scene->log)
        return true;
    const bool there = jox_file_has_name(scene->log, scene->log_path);
    scene->log_failed |= jox_file_close(scene->log) != 0;
    scene->log = NULL;
    bool good = jox_run_check_log_written(scene, error);
    if (good && !there) {
        jox_error(error, JO_FAILED,
                  "the input log '%.200s' was removed or replaced while it was written",
                  scene->log_path);
        good = false;
    }
    jox_free(scene->log_path);
    scene->log_path = NULL;
    return good;
}
