/* Waits on a thread of its own for files to be edited, loads what is made of them into fresh Lua
   states, and works out how it replaces what runs (reload_batch.c). The stepping thread finds it
   ready between two steps, and swaps all of it or nothing (reload_swap.c). */
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include "base/assert.h"
#include "base/guard.h"
#include "base/mem.h"
#include "run/input_log.h"
#include "run/reload_batch.h"
#include "task/thread.h"

enum { MEMORY_ROOM = 8 }; /* slots that a new version may add without a copy of all */

static void note_change(void *context, const char *path, double written) {
    JoxReload *r = context;
    jox_changes_add_changed_file(&r->changes, path, written);
}

static void load_until_stopped(JoxReload *r) {
    uint64_t signal;
    while (read(r->stop, &signal, sizeof signal) != (ssize_t)sizeof signal) {
        const double patience = r->scene->mods->count ? 0.05 : 1.0; /* s: settings are posted */
        jox_watch_wait(r->watch, r->stop, jox_changes_has_untried(&r->changes) ? 0.002 : patience,
                       note_change, r);
        /* One batch at a time: it is compared with what runs. */
        bool busy = atomic_load(&r->ready) != 0;
        jox_reload_free_retired(r);
        if (busy)
            continue;
        JoxSettingChange *change = (JoxSettingChange *)atomic_exchange(&r->wanted, 0);
        atomic_store(&r->ready,
                     (uintptr_t)(change ? jox_setting_prepare(r, change) : jox_batch_prepare(r)));
        jox_free(change);
    }
}

static void *run_reload_thread(void *context) {
    JoxReload *r = context;
    JoxRecovery recovery;
    jox_heap_use(r->scene->heap);
    jox_recovery_push(&recovery);
    if (setjmp(recovery.jump) != 0)
        atomic_store(&r->starved, true); /* the next step says so */
    else
        load_until_stopped(r);
    jox_recovery_pop(&recovery);
    return NULL;
}

static void stop_thread(JoxReload *r) {
    uint64_t one = 1;
    if (r->edited) /* memory ran out meanwhile */
        pthread_mutex_unlock(&r->machines);
    if (r->running && write(r->stop, &one, sizeof one) == (ssize_t)sizeof one)
        pthread_join(r->thread, NULL);
    if (r->stop >= 0)
        close(r->stop);
    pthread_mutex_destroy(&r->machines);
}

static void release_reload(void *reload) {
    stop_thread(reload);
}

void jox_run_hold_machines(JoScene *scene, uint32_t machine, bool hold) {
    JoxReload *r = scene->reload;
    if (!r)
        return;
    if (hold) {
        pthread_mutex_lock(&r->machines);
        r->edited = true;
        r->edits[machine]++;
    } else {
        r->edited = false;
        pthread_mutex_unlock(&r->machines);
    }
}

void jox_run_swap_reloaded(JoScene *scene) {
    JoxReload *r = scene->reload;
    if (!r)
        return;
    if (atomic_load(&r->starved))
        jox_out_of_memory(0);
    atomic_store(&r->next_id, scene->world->state.agents.next_id);
    JoxBatch *batch = (JoxBatch *)atomic_load(&r->ready);
    if (!batch)
        return;
    jox_batch_swap(scene, batch);
    atomic_store(&r->ready, 0); /* the loading thread may compare again */
}

static void watch_file(JoxReload *r, uint32_t part, const char *path) {
    if (!jox_reload_watch_file(r, part, path))
        jox_run_say(r->scene, "%s cannot be watched: %s\n", path, strerror(errno));
}

/* Creates the reload of a scene, and watches all files that the scene is made of. */
static JoxReload *create_reload(JoScene *scene, JoxWatch *watch) {
    JoxReload *r = jox_alloc(1, sizeof *r);
    *r = (JoxReload){.scene = scene, .watch = watch, .stop = -1};
    pthread_mutex_init(&r->machines, NULL);
    jox_heap_register(r, release_reload);
    const JoxMachineRun *machines = &scene->world->machines;
    JoxAgents *a = &scene->world->state.agents;
    jox_agents_widen(a, a->own_count, a->memory_stride + MEMORY_ROOM);
    atomic_store(&r->next_id, a->next_id);
    atomic_store(&r->machine_count, machines->set->count);
    for (uint32_t m = 0; m < machines->set->count; m++) {
        uint32_t count;
        char *const *tried = jox_lua_paths_tried(scene->lua, machines->set->items[m], &count);
        for (uint32_t f = 0; f < count; f++)
            watch_file(r, m, tried[f]);
    }
    for (uint32_t f = 0; f < scene->spec_file_count; f++)
        watch_file(r, JOX_PART_SCENE, scene->spec_files[f]);
    for (uint32_t m = 0; m < scene->mods->count * JOX_RELOAD_MOD_PARTS; m++) {
        char path[JOX_LONGEST_PATH];
        jox_reload_mod_path(scene, m / JOX_RELOAD_MOD_PARTS, m % JOX_RELOAD_MOD_PARTS, path);
        watch_file(r, JOX_PART_MODS, path);
    }
    scene->reload = r;
    return r;
}

bool jo_scene_watch(JoScene *scene, JoError *error) {
    JOX_REQUIRE(scene && !scene->world->busy, false);
    JOX_GUARD (scene->heap, error)
        return false;
    if (scene->reload && scene->reload->watch)
        return true;
    const JoxInputLog *log = &scene->world->state.input;
    for (size_t e = 0; e < log->count; e++)
        if (log->entries[e].verb == JOX_INPUT_FILES || log->entries[e].verb == JOX_INPUT_SETTING) {
            jox_error(error, JO_INPUT,
                      "the input log '%.200s' swaps files itself; files on the disk cannot be "
                      "watched besides",
                      scene->input_path);
            return false;
        }
    jox_run_end_reload(scene); /* that of jo_scene_reload */
    JoxWatch *watch = jox_watch_create();
    if (watch) {
        JoxReload *r = create_reload(scene, watch);
        r->stop = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
        r->running = r->stop >= 0 && jox_thread_start(&r->thread, run_reload_thread, r);
        if (r->running)
            return true;
        jox_run_end_reload(scene);
    }
    jox_error(error, JO_FAILED, "the system does not let files be watched");
    return false;
}

/* Says of a file of a log's entry that no part of the run reads it, and which file may be meant. */
static void report_unread_file(const JoScene *scene, const JoxInputEntry *entry, const char *path) {
    enum { MOST = 256 };
    const JoxChanges *changes = &scene->reload->changes;
    const char *names[MOST];
    char hint[JOX_HINT];
    size_t count = 0;
    for (uint32_t p = 0; p < JOX_PARTS; p++)
        for (uint32_t f = 0; f < changes->made_of[p].count && count < MOST; f++)
            names[count++] = changes->made_of[p].paths[f];
    const char *near = jox_did_you_mean(path, names, count, hint);
    char place[512] = "";
    if (entry->line > 0) /* 0: of jo_scene_reload */
        snprintf(place, sizeof place,
                 "%.490s:%d: ", scene->input_path ? scene->input_path : "input", entry->line);
    jox_run_say(scene,
                "%st = %.2f s: no behaviour or scene of this run reads '%.200s': its text has no "
                "effect%s%s\n",
                place, jo_world_time(scene->world), path, near ? ". " : "", near ? near : "");
}

bool jox_run_reads_file(const JoScene *scene, const char *path) {
    return scene->reload && jox_changes_use(&scene->reload->changes, path);
}

bool jox_run_reload_files(JoScene *scene, const JoxInputEntry *files, JoError *error) {
    JoxReload *r = scene->reload ? scene->reload : create_reload(scene, NULL);
    bool live = true;
    JoxBatch *batch;
    if (r->watch) {
        jox_error(error, JO_INPUT, "files cannot be swapped while they are watched");
        return false;
    }
    for (uint32_t f = 0; f < files->number; f++)
        jox_changes_add_changed_file(&r->changes, files->files[f].path, 0.0);
    atomic_store(&r->next_id, scene->world->state.agents.next_id);
    while ((batch = jox_batch_prepare(r))) {
        live &= jox_batch_swap(scene, batch);
        jox_reload_free_retired(r);
        for (uint32_t f = 0; f < files->number; f++) /* only the new version uses the file */
            if (jox_run_is_text_live(scene, &files->files[f]))
                jox_changes_forget_file(&r->changes, files->files[f].path);
    }
    for (uint32_t f = 0; f < files->number; f++)
        if (!jox_run_reads_file(scene, files->files[f].path))
            report_unread_file(scene, files, files->files[f].path);
    if (!live)
        jox_error(error, JO_INPUT,
                  "the files that follow were not taken: the run goes another way");
    return live;
}

bool jox_run_reload_setting(JoScene *scene, const JoxSettingChange *change, JoError *error) {
    JoxReload *r = scene->reload ? scene->reload : create_reload(scene, NULL);
    if (r->watch) {
        JoxSettingChange *posted = jox_alloc(1, sizeof *posted);
        *posted = *change;
        jox_free((JoxSettingChange *)atomic_exchange(&r->wanted, (uintptr_t)posted));
        return true;
    }
    atomic_store(&r->next_id, scene->world->state.agents.next_id);
    const bool live = jox_batch_swap(scene, jox_setting_prepare(r, change));
    jox_reload_free_retired(r);
    if (!live)
        jox_error(error, JO_INPUT,
                  "with this value the behaviours do not load: they go on as they "
                  "were");
    return live;
}

void jox_run_end_reload(JoScene *scene) {
    JoxReload *r = scene->reload;
    if (!r)
        return;
    jox_heap_unregister(r);
    stop_thread(r);
    JoxBatch *batch = (JoxBatch *)atomic_load(&r->ready);
    if (batch)
        jox_batch_free(batch);
    jox_free((JoxSettingChange *)atomic_load(&r->wanted));
    jox_reload_free_retired(r);
    jox_changes_free(&r->changes);
    jox_watch_free(r->watch);
    jox_free(r);
    scene->reload = NULL;
}
