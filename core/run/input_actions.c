/* Performs the actions of people, programs and input logs on a running scene. Each action is an
   entry of an input log: it is done before the next step and logged, so that the log plays back
   to the same state. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "base/guard.h"
#include "base/mem.h"
#include "run/input_actions.h"
#include "run/input_log.h"
#include "run/mod_setting.h"
#include "run/reload.h"
#include "run/run.h"
#include "run/set_parameter.h"
#include "world/embed/storey_points.h"
#include "world/verbs/verb_table.h"

/* ---- actions ---- */

/* Replaces files by the texts of a log's entry, and reloads them. */
static bool reload_files(JoScene *scene, const JoxInputEntry *entry, JoError *error) {
    for (uint32_t f = 0; f < entry->number; f++) {
        const JoxInputFile *file = &entry->files[f];
        jox_overlay_put(&scene->overlay, file->path, file->text, file->length);
    }
    const JoxOverlay *before = jox_overlay_use(&scene->overlay);
    bool live = jox_run_reload_files(scene, entry, error);
    jox_overlay_use(before);
    return live;
}

static bool perform_verb(JoScene *scene, const JoxInputEntry *entry, JoError *error) {
    const JoxVerb *verb = &jox_input_verbs[entry->verb];
    JOX_ASSERT(entry->verb < jox_input_verb_count);
    if (verb->perform) {
        JoxText why = {0};
        bool good = verb->perform(scene->world, entry, &why);
        if (!good)
            jox_error(error, JO_INPUT, "%s", why.data ? why.data : verb->name);
        jox_text_free(&why);
        return good;
    }
    if (entry->verb == JOX_INPUT_SET)
        return jox_run_set_parameter(scene, entry->names[0], entry->names[1], entry->names[2],
                                     entry->numbers[0], error);
    if (entry->verb == JOX_INPUT_FILES)
        return reload_files(scene, entry, error);
    if (entry->verb == JOX_INPUT_SETTING)
        return jox_run_set_mod_setting(scene, entry->names[0], entry->names[1], entry->names[2],
                                       error);
    return true; /* the other verbs were checked when the scene was loaded */
}

/* ---- what comes in ---- */

void jox_run_log_act(void *context, JoxInputEntry *entry) {
    JoScene *scene = context;
    if (scene->acting) /* a replay in the same program acts again */
        return;
    scene->acted_on = true;
    jox_run_log_entry(scene, entry);
}

static bool perform_and_log(JoScene *scene, JoxInputEntry *entry, JoError *error) {
    if (!perform_verb(scene, entry, error))
        return false;
    if (scene->acting)
        return true;
    scene->acted_on |= entry->line == 0;
    /* a reload, also by a setting, is logged when it goes live */
    if (jox_input_verbs[entry->verb].tool && entry->verb != JOX_INPUT_SETTING)
        jox_run_log_entry(scene, entry);
    return true;
}

bool jox_run_perform_input(JoScene *scene, JoxInputEntry *entry, JoError *error) {
    JOX_REQUIRE(scene && entry && !scene->finished && !scene->world->busy, false);
    JOX_GUARD (scene->heap, error)
        return false;
    return perform_and_log(scene, entry, error);
}

bool jo_scene_input(JoScene *scene, const char *line, JoError *error) {
    JOX_REQUIRE(scene && line && !scene->finished && !scene->world->busy, false);
    JOX_GUARD (scene->heap, error)
        return false;
    JoxInputEntry entry;
    JoxText wrong = {0};
    bool good = jox_input_read_line(line, &entry, &wrong);
    if (good) {
        good = perform_and_log(scene, &entry, error);
        jox_input_entry_free(&entry);
    } else {
        jox_error(error, JO_INPUT, "%s", wrong.data);
    }
    jox_text_free(&wrong);
    return good;
}

void jox_run_perform_due_inputs(JoScene *scene) {
    const JoxInputEntry *next;
    while ((next = jox_input_take_due(&scene->world->state.input, scene->world->state.tick))) {
        JoxInputEntry entry = *next;
        JoError error = {0};
        if (perform_and_log(scene, &entry, &error))
            continue;
        jox_run_say(scene, "%s:%d: t = %.2f s: %s\n", scene->input_path, entry.line,
                    jo_world_time(scene->world), error.text);
        if (scene->input_failed++ == 0) {
            scene->input_failed_line = entry.line;
            scene->input_failed_why = jox_strdup(error.text);
        }
    }
}

/* Checks that a line of a log can hold a name; false with `error`. */
static bool check_writable_name(const char *what, const char *name, JoError *error) {
    JoxText why = {0};
    const bool good = jox_input_check_name(what, name, &why);
    if (!good)
        jox_error(error, JO_INPUT, "%s", why.data);
    jox_text_free(&why);
    return good;
}

static bool perform_named(JoScene *scene, JoxInputVerb verb, const char *what, const char *name,
                          JoError *error) {
    JoxInputEntry entry = {.verb = verb, .names = {(char *)name}};
    return check_writable_name(what, name, error) && perform_and_log(scene, &entry, error);
}

bool jo_scene_throw(JoScene *scene, const char *body, const double from[3],
                    const double velocity[3], const double spin[3], JoError *error) {
    JOX_REQUIRE(scene && body && !scene->world->busy, false);
    JOX_GUARD (scene->heap, error)
        return false;
    JoxInputEntry entry = {.verb = JOX_INPUT_THROW, .names = {(char *)body}, .here = !from};
    entry.given = spin ? 9 : 6;
    for (int k = 0; k < 3; k++) {
        entry.numbers[k] = from ? from[k] : 0.0;
        entry.numbers[3 + k] = velocity ? velocity[k] : 0.0;
        entry.numbers[6 + k] = spin ? spin[k] : 0.0;
    }
    return check_writable_name("a body's name", body, error) &&
           perform_and_log(scene, &entry, error);
}

bool jo_scene_throw_on(JoScene *scene, uint32_t storey, const char *body, const double from[3],
                       const double velocity[3], const double spin[3], JoError *error) {
    JOX_REQUIRE(scene && body && from && !scene->world->busy, false);
    if (!jox_world_check_storey(scene->world, storey, error))
        return false;
    const double at[3] = {from[0], jox_world_move_to_storey(scene->world, storey, from[1]),
                          from[2]};
    return jo_scene_throw(scene, body, at, velocity, spin, error);
}

bool jo_scene_open_wall(JoScene *scene, const char *wall, bool open, JoError *error) {
    JOX_REQUIRE(scene && wall && !scene->world->busy, false);
    JOX_GUARD (scene->heap, error)
        return false;
    return perform_named(scene, open ? JOX_INPUT_OPEN : JOX_INPUT_CLOSE, "a wall's name", wall,
                         error);
}

bool jo_scene_signal(JoScene *scene, const char *name, JoError *error) {
    JOX_REQUIRE(scene && name && !scene->world->busy, false);
    JOX_GUARD (scene->heap, error)
        return false;
    return perform_named(scene, JOX_INPUT_SIGNAL, "a signal's name", name, error);
}
