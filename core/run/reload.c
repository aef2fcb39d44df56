/* Files that are edited while the crowd runs. A thread of its own waits for them, loads everything
   that is made of them into fresh Lua states, and works out what it takes to put the new machines
   in the place of the old. The stepping thread finds it ready between two steps, and swaps all of
   it or nothing. */
#include <errno.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>
#include <sys/eventfd.h>
#include <time.h>
#include <unistd.h>

#include "base/assert.h"
#include "base/guard.h"
#include "base/mem.h"
#include "run/changes.h"
#include "run/run.h"

enum {
    OWN_ROOM = 12,
    MEMORY_ROOM = 8
}; /* slots that a new version may add without a copy of all */

/* One machine of a batch. */
typedef struct Change {
    uint32_t index; /* in the mind; for a new machine, once it is added */
    bool added;     /* another one becomes it */
    char *path;
    JoxLoaded *loaded;
    JoxFiles files; /* that were looked for */
    JoxReplacement *replacement;
    uint32_t edits; /* of the machine, when they were compared */
} Change;

/* What the loading thread hands over: machines, a new plan of the scene, or only what is wrong. */
typedef struct Batch {
    Change *changes;
    uint32_t count;
    size_t capacity;
    JoxSceneSpec *spec; /* of the scene's own files; NULL: they did not change */
    JoxFiles plan_files;
    JoxDiagnostics diagnostics;
    JoxText said;
    bool parts[JOX_PARTS]; /* machines and plan that it is about */
    double written;        /* seconds since 1970 */
    bool failed;
} Batch;

struct JoxReload {
    JoScene *scene;
    JoxWatch *watch;
    pthread_t thread;
    int stop;                 /* eventfd */
    atomic_uintptr_t ready;   /* Batch *, to the stepping thread */
    atomic_uintptr_t retired; /* Retired *, back */
    atomic_uint next_id, machine_count;
    JoxChanges changes;       /* the loading thread's own */
    pthread_mutex_t machines; /* held while they are compared, or changed in place */
    uint32_t edits[JOX_MOST_MACHINES];
};

/* What was swapped out, freed off the stepping thread. */
typedef struct Retired {
    struct Retired *next;
    Batch *batch;
    JoxLoaded **machines;
    uint32_t count;
    bool live; /* the batch was taken */
} Retired;

static void free_batch(Batch *batch) {
    for (uint32_t c = 0; c < batch->count; c++) {
        jox_free(batch->changes[c].path);
        jox_files_free(&batch->changes[c].files);
        jox_replacement_free(batch->changes[c].replacement);
        jox_loaded_free(batch->changes[c].loaded);
    }
    jox_free(batch->changes);
    jox_scene_free(batch->spec);
    jox_files_free(&batch->plan_files);
    jox_diag_free(&batch->diagnostics);
    jox_text_free(&batch->said);
    jox_free(batch);
}

/* ---- the loading thread ---- */

static bool use(JoxReload *r, uint32_t part, const char *path) {
    jox_changes_uses(&r->changes, part, path);
    return !r->watch || jox_watch_add(r->watch, path);
}

/* What a batch is made of counts from here on; if it could not go live, that counts too. */
static void settle(JoxReload *r, const Batch *batch, bool live) {
    if (live)
        jox_changes_live(&r->changes, batch->parts);
    for (uint32_t c = 0; c < batch->count; c++) {
        const Change *change = &batch->changes[c];
        for (uint32_t f = 0; f < change->files.count && (live || !change->added); f++)
            use(r, change->index, change->files.paths[f]);
    }
    for (uint32_t f = 0; batch->plan_files.count > f; f++)
        use(r, JOX_PART_PLAN, batch->plan_files.paths[f]);
}

static void free_retired(JoxReload *r) {
    Retired *retired = (Retired *)atomic_exchange(&r->retired, 0);
    while (retired) {
        Retired *next = retired->next;
        settle(r, retired->batch, retired->live);
        free_batch(retired->batch);
        for (uint32_t m = 0; m < retired->count; m++)
            jox_loaded_free(retired->machines[m]);
        jox_free(retired->machines);
        jox_free(retired);
        retired = next;
    }
}

static Change *add_change(Batch *batch, uint32_t index, const char *path) {
    JOX_RESERVE(batch->changes, batch->capacity, batch->count + 1);
    Change *change = &batch->changes[batch->count++];
    *change = (Change){.index = index, .path = jox_strdup(path)};
    return change;
}

/* Where a machine that is missing would be: beside the one that becomes it. */
static void place_beside(const char *from, const char *name, char path[1024]) {
    const char *slash = strrchr(from, '/');
    size_t n = strlen(name);
    if (n > 4 && !strcmp(name + n - 4, ".lua"))
        n -= 4;
    snprintf(path, 1024, "%.*s%.*s.lua", slash ? (int)(slash - from) + 1 : 0, from,
             n < 200 ? (int)n : 200, name);
}

/* Machines that a new version becomes and that are not there yet join the batch. */
static void add_becomes(JoxReload *r, Batch *batch, uint32_t c, const JoxMachine *next) {
    JoScene *scene = r->scene;
    const JoxMind *mind = &scene->world->mind;
    uint32_t machines = atomic_load(&r->machine_count);
    for (uint32_t s = 0; s < next->state_count; s++) {
        char path[1024];
        if (!next->states[s].become)
            continue;
        if (!jox_run_find_become(scene, next, s, path, &batch->diagnostics)) {
            place_beside(next->path, next->states[s].become, path);
            jox_files_add(&batch->changes[c].files, path); /* when it is written, try again */
            continue;
        }
        bool known = false;
        uint32_t added = 0;
        for (uint32_t m = 0; m < machines; m++)
            known |= strcmp(mind->machines[m]->path, path) == 0;
        for (uint32_t o = 0; o < batch->count; o++) {
            known |= strcmp(batch->changes[o].path, path) == 0;
            added += batch->changes[o].added;
        }
        if (!known && machines + added < JOX_MOST_MACHINES)
            add_change(batch, 0, path)->added = true;
        else if (!known)
            jox_diag_error(&batch->diagnostics,
                           ((JoxPosition){next->path, next->states[s].become_line,
                                          next->states[s].become_column, 0}),
                           "too-many", NULL, "a scene has at most %d behaviours",
                           JOX_MOST_MACHINES);
    }
}

/* Loads one machine of a batch, and watches what it is made of, whether that went well or not. */
static void load_change(JoxReload *r, Batch *batch, uint32_t c) {
    JoScene *scene = r->scene;
    const char *path = batch->changes[c].path;
    JoxLoaded *loaded =
        jox_lua_prepare(scene->lua, path, NULL, 0, &scene->scope, &batch->diagnostics);
    uint32_t count;
    char *const *tried = jox_loaded_tried(loaded, &count);
    for (uint32_t f = 0; f < count; f++)
        jox_files_add(&batch->changes[c].files, tried[f]);
    batch->changes[c].loaded = loaded;
    jox_text_add(&batch->said, jox_loaded_said(loaded));
    const JoxMachine *next = jox_loaded_machine(loaded);
    const JoxLuaFile *files = jox_loaded_files(loaded, &count);
    if (next)
        jox_run_check_own(scene, next, files, count, &batch->diagnostics);
    if (next)
        add_becomes(r, batch, c, next);
    else
        batch->failed = true;
    for (uint32_t f = 0; r->watch && f < batch->changes[c].files.count; f++)
        jox_watch_add(r->watch, batch->changes[c].files.paths[f]);
}

static void load_plan(JoxReload *r, Batch *batch) {
    JoScene *scene = r->scene;
    batch->spec =
        jox_run_load_spec(&scene->def, scene->mods, scene->mods->count, &batch->diagnostics);
    batch->failed |= !batch->spec;
    for (uint32_t f = 0; batch->spec && f < batch->spec->file_count; f++)
        jox_files_add(&batch->plan_files, batch->spec->files[f].path);
}

/* Works out what it takes to put the new version in the place of the old. */
static void compare(JoxReload *r, Change *change) {
    const JoxMind *mind = &r->scene->world->mind;
    jox_replacement_free(change->replacement);
    pthread_mutex_lock(&r->machines);
    change->edits = r->edits[change->index];
    change->replacement =
        jox_replacement_prepare(mind->machines[change->index], jox_loaded_machine(change->loaded),
                                r->scene->world->def.seed, atomic_load(&r->next_id));
    pthread_mutex_unlock(&r->machines);
}

/* The next parts whose files have changed, loaded; NULL where there are none. */
static Batch *prepare(JoxReload *r) {
    JoScene *scene = r->scene;
    const JoxMind *mind = &scene->world->mind;
    bool parts[JOX_PARTS];
    double written;
    if (!jox_changes_next(&r->changes, parts, &written))
        return NULL;
    Batch *batch = jox_alloc(1, sizeof *batch);
    memcpy(batch->parts, parts, sizeof parts);
    batch->written = written;
    for (uint32_t m = 0; m < atomic_load(&r->machine_count); m++)
        if (parts[m])
            add_change(batch, m, mind->machines[m]->path);
    for (uint32_t c = 0; c < batch->count; c++) /* grows by what others become */
        load_change(r, batch, c);
    if (parts[JOX_PART_PLAN])
        load_plan(r, batch);
    if (batch->diagnostics.errors)
        batch->failed = true;
    for (uint32_t c = 0; c < batch->count && !batch->failed; c++)
        if (!batch->changes[c].added)
            compare(r, &batch->changes[c]);
    return batch;
}

static void changed(void *context, const char *path, double written) {
    JoxReload *r = context;
    jox_changes_file(&r->changes, path, written);
}

static void *load_for_ever(void *context) {
    JoxReload *r = context;
    uint64_t signal;
    while (read(r->stop, &signal, sizeof signal) != (ssize_t)sizeof signal) {
        jox_watch_wait(r->watch, r->stop, jox_changes_fresh(&r->changes) ? 0.002 : 1.0, changed, r);
        bool busy = atomic_load(&r->ready) != 0; /* one at a time: it is compared with what runs */
        free_retired(r);
        if (!busy)
            atomic_store(&r->ready, (uintptr_t)prepare(r));
    }
    return NULL;
}

/* ---- the stepping thread ---- */

/* "35,000" */
static const char *grouped(uint32_t number, char out[16]) {
    char plain[16];
    int n = snprintf(plain, sizeof plain, "%u", number), at = 0;
    for (int i = 0; i < n; i++) {
        out[at++] = plain[i];
        if ((n - 1 - i) % 3 == 0 && i + 1 < n)
            out[at++] = ',';
    }
    out[at] = 0;
    return out;
}

/* "  Circle 31204  Exit 310": agents per state. */
static void print_census(const JoxMachine *machine, const uint32_t *people, JoxText *out) {
    char number[16];
    for (uint32_t s = 0; s < machine->state_count; s++)
        if (people[s])
            jox_text_printf(out, "  %s %s", machine->states[s].name, grouped(people[s], number));
}

static double real_time(void) {
    struct timespec t;
    clock_gettime(CLOCK_REALTIME, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

static void tell_diagnosed(const JoScene *scene, const bool *parts,
                           const JoxDiagnostics *diagnostics) {
    JoxHeap *own = jox_guard_leave();
    if (scene->diagnosed)
        scene->diagnosed(scene->diagnosed_context, parts, diagnostics);
    jox_heap_use(own);
}

/* Says why a batch is not taken, and which versions go on. */
static void refuse(JoScene *scene, Batch *batch, const char *path, const char *why) {
    const JoxMind *mind = &scene->world->mind;
    char number[16];
    if (why)
        jox_diag_error(&batch->diagnostics, ((JoxPosition){path, 0, 0, 0}), "cannot-swap", NULL,
                       "%s", why);
    tell_diagnosed(scene, batch->parts, &batch->diagnostics);
    jox_run_report(scene->message, scene->message_context, &batch->diagnostics, NULL);
    tell_diagnosed(scene, batch->parts, NULL);
    for (uint32_t c = 0; c < batch->count; c++) {
        if (batch->changes[c].added)
            continue;
        const JoxMachine *machine = mind->machines[batch->changes[c].index];
        jox_run_say(scene, " Version %u%s%s keeps running; %s agents unaffected.\n",
                    machine->version, batch->count > 1 ? " of " : "",
                    batch->count > 1 ? machine->name : "", grouped(mind->agents->count, number));
    }
    if (batch->count == 0)
        jox_run_say(scene, " The scene goes on as it was.\n");
}

/* Machines that others become, and links to them. */
static void link_batch(JoScene *scene, Batch *batch) {
    JoxMind *mind = &scene->world->mind;
    for (uint32_t c = 0; c < batch->count; c++) {
        Change *change = &batch->changes[c];
        if (!change->added)
            continue;
        JoxMachine *machine = jox_loaded_machine(change->loaded);
        jox_lua_adopt(scene->lua, change->loaded);
        change->index = jox_mind_add(mind, machine);
        jox_run_tell_replaced(scene, change->index);
    }
    for (uint32_t m = 0; m < mind->machine_count; m++) {
        JoxDiagnostics none = {0};
        jox_run_link(scene, mind->machines[m], &none);
        jox_diag_free(&none);
    }
}

/* Own values that the old version did not have, as the scene sets them. */
static void give_new(JoScene *scene, const Change *change, const JoxMachine *old,
                     const JoxMachine *next) {
    const JoxSceneSpec *spec = scene->spec;
    for (uint32_t s = 0; s < next->own_count; s++) {
        bool known = !*next->own[s].name;
        for (uint32_t o = 0; o < old->own_count && !known; o++)
            known = strcmp(old->own[o].name, next->own[s].name) == 0;
        for (uint32_t g = 0; g < spec->group_count && !known; g++)
            for (uint32_t k = 0; k < spec->groups[g].set_count; k++)
                if (strcmp(spec->groups[g].set[k].name, next->own[s].name) == 0 &&
                    spec->groups[g].set[k].kind != JOX_SET_ANTIPODE)
                    jox_run_give(scene, (int32_t)change->index, g, &spec->groups[g].set[k]);
    }
}

static bool same_states(const JoxMachine *a, const JoxMachine *b) {
    bool same = a->state_count == b->state_count;
    for (uint32_t s = 0; same && s < a->state_count; s++)
        same = strcmp(a->states[s].name, b->states[s].name) == 0;
    return same;
}

/* Swaps the machines of a batch; the old ones go to `retired`. */
static void swap(JoScene *scene, Batch *batch, Retired *retired) {
    JoxMind *mind = &scene->world->mind;
    JoxText text = {0};
    uint32_t before[1000], after[1000];
    retired->machines = jox_alloc(batch->count + 1, sizeof *retired->machines);
    for (uint32_t c = 0; c < batch->count; c++) {
        Change *change = &batch->changes[c];
        if (change->added)
            continue;
        double begun = jox_clock_wall();
        jox_mind_census(mind, change->index, before);
        JoxMachine *next = jox_loaded_machine(change->loaded);
        JoxMachine *old = jox_mind_replace(mind, change->index, change->replacement);
        give_new(scene, change, old, next);
        retired->machines[retired->count++] = jox_lua_retire(scene->lua, old);
        jox_lua_adopt(scene->lua, change->loaded);
        jox_mind_census(mind, change->index, after);
        if (!same_states(old, next)) /* the recording names those of the new version too */
            jox_run_tell_replaced(scene, change->index);
        double took = jox_clock_wall() - begun;
        scene->swap_seconds = took > scene->swap_seconds ? took : scene->swap_seconds;
        jox_text_printf(&text, "%s: version %u is live from t = %.2f s", next->path, next->version,
                        jo_world_time(scene->world));
        if (batch->written > 0.0)
            jox_text_printf(&text, " (saved %.0f ms ago, swapped in %.2f ms)",
                            (real_time() - batch->written) * 1e3, took * 1e3);
        jox_text_add(&text, "\n before:");
        print_census(old, before, &text);
        jox_text_add(&text, "\n after: ");
        print_census(next, after, &text);
        jox_text_add(&text, "\n");
    }
    link_batch(scene, batch);
    if (text.data)
        jox_run_tell(scene, text.data);
    jox_text_free(&text);
}

/* Notes the texts that differ from those that are live, for the input log. */
static void note_files(JoScene *scene, const Batch *batch, JoxReloaded *reloaded) {
    for (uint32_t c = 0; c < batch->count; c++) {
        uint32_t count;
        const JoxLuaFile *files = jox_loaded_files(batch->changes[c].loaded, &count);
        for (uint32_t f = 0; f < count; f++) {
            size_t length;
            const char *text = jox_loaded_text(batch->changes[c].loaded, f, &length);
            jox_run_note_file(scene, reloaded, files[f].path, files[f].sha256, text, length);
        }
    }
    for (uint32_t f = 0; batch->spec && f < batch->spec->file_count; f++) {
        const JoxSceneFile *file = &batch->spec->files[f];
        jox_run_note_file(scene, reloaded, file->path, file->sha256, file->text, file->length);
    }
}

/* Takes the batch over. True if it is live. */
static bool take(JoScene *scene, Batch *batch) {
    JoxReload *r = scene->reload;
    char why[256];
    bool live = false;
    const char *refused = NULL, *path = "";
    if (batch->said.length)
        jox_run_tell(scene, batch->said.data);
    for (uint32_t c = 0; c < batch->count && !batch->failed && !refused; c++)
        if (!batch->changes[c].added) {
            path = batch->changes[c].path;
            if (batch->changes[c].edits != r->edits[batch->changes[c].index])
                compare(r, &batch->changes[c]); /* a parameter was set meanwhile */
            refused = jox_mind_refuses(&scene->world->mind, batch->changes[c].index,
                                       batch->changes[c].replacement, why, sizeof why);
        }
    Retired *retired = jox_alloc(1, sizeof *retired);
    retired->batch = batch;
    if (batch->failed || refused) {
        refuse(scene, batch, path, refused);
    } else {
        tell_diagnosed(scene, batch->parts, &batch->diagnostics); /* warnings, at most */
        jox_run_report(scene->message, scene->message_context, &batch->diagnostics, NULL);
        JoxReloaded reloaded = {0};
        retired->live = live = true;
        if (scene->log)
            note_files(scene, batch, &reloaded);
        swap(scene, batch, retired);
        if (batch->spec)
            jox_run_rescene(scene, &batch->spec, batch->written);
        jox_run_log_files(scene, &reloaded);
    }
    atomic_store(&r->machine_count, scene->world->mind.machine_count);
    retired->next = (Retired *)atomic_load(&r->retired);
    while (
        !atomic_compare_exchange_weak(&r->retired, (uintptr_t *)&retired->next, (uintptr_t)retired))
        ;
    return live;
}

void jox_run_hold_machines(JoScene *scene, uint32_t machine, bool hold) {
    JoxReload *r = scene->reload;
    if (!r)
        return;
    if (hold) {
        pthread_mutex_lock(&r->machines);
        r->edits[machine]++;
    } else {
        pthread_mutex_unlock(&r->machines);
    }
}

void jox_run_reload(JoScene *scene) {
    JoxReload *r = scene->reload;
    if (!r)
        return;
    atomic_store(&r->next_id, scene->world->agents.next_id);
    Batch *batch = (Batch *)atomic_load(&r->ready);
    if (!batch)
        return;
    take(scene, batch);
    atomic_store(&r->ready, 0); /* the loading thread may compare again */
}

static void use_first(JoxReload *r, uint32_t part, const char *path) {
    if (!use(r, part, path))
        jox_run_say(r->scene, "%s cannot be watched: %s\n", path, strerror(errno));
}

/* What the running scene is made of. */
static JoxReload *begin(JoScene *scene, JoxWatch *watch, int stop) {
    JoxReload *r = jox_alloc(1, sizeof *r);
    *r = (JoxReload){.scene = scene, .watch = watch, .stop = stop};
    pthread_mutex_init(&r->machines, NULL);
    const JoxMind *mind = &scene->world->mind;
    JoxAgents *a = &scene->world->agents;
    jox_agents_widen(a, a->own_stride + OWN_ROOM, a->memory_stride + MEMORY_ROOM);
    atomic_store(&r->next_id, a->next_id);
    atomic_store(&r->machine_count, mind->machine_count);
    for (uint32_t m = 0; m < mind->machine_count; m++) {
        uint32_t count;
        char *const *tried = jox_lua_tried(scene->lua, mind->machines[m], &count);
        for (uint32_t f = 0; f < count; f++)
            use_first(r, m, tried[f]);
    }
    for (uint32_t f = 0; f < scene->plan_file_count; f++)
        use_first(r, JOX_PART_PLAN, scene->plan_files[f]);
    scene->reload = r;
    return r;
}

bool jo_scene_watch(JoScene *scene, JoError *error) {
    JOX_REQUIRE(scene, false);
    JOX_GUARD (scene->heap, error)
        return false;
    if (scene->reload && scene->reload->watch)
        return true;
    const JoxInputLog *log = &scene->world->input;
    for (size_t e = 0; e < log->count; e++)
        if (log->entries[e].verb == JOX_INPUT_FILES) {
            jox_error(error, JO_INPUT,
                      "the input log '%.200s' swaps files itself; files on the disk cannot be "
                      "watched besides",
                      scene->input_path);
            return false;
        }
    JoxWatch *watch = jox_watch_create();
    int stop = watch ? eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK) : -1;
    if (stop >= 0) {
        JoxReload *r = begin(scene, watch, stop);
        if (pthread_create(&r->thread, NULL, load_for_ever, r) == 0)
            return true;
        close(stop);
        r->stop = -1;
        jox_run_unwatch(scene);
    } else {
        jox_watch_free(watch);
    }
    jox_error(error, JO_FAILED, "the system does not let files be watched");
    return false;
}

bool jox_run_reload_now(JoScene *scene, const JoxInputEntry *files, JoError *error) {
    JoxReload *r = scene->reload ? scene->reload : begin(scene, NULL, -1);
    bool live = true;
    Batch *batch;
    if (r->watch) {
        jox_error(error, JO_INPUT, "files cannot be swapped while they are watched");
        return false;
    }
    for (uint32_t f = 0; f < files->number; f++)
        jox_changes_file(&r->changes, files->files[f].path, 0.0);
    atomic_store(&r->next_id, scene->world->agents.next_id);
    while ((batch = prepare(r))) {
        live &= take(scene, batch);
        free_retired(r);
        for (uint32_t f = 0; f < files->number; f++) /* a file that only the new version uses */
            if (jox_run_is_live(scene, &files->files[f]))
                jox_changes_drop(&r->changes, files->files[f].path);
    }
    if (!live)
        jox_error(error, JO_INPUT,
                  "the files that follow were not taken: the run goes another way");
    return live;
}

void jox_run_unwatch(JoScene *scene) {
    JoxReload *r = scene->reload;
    if (!r)
        return;
    if (r->stop >= 0) {
        uint64_t one = 1;
        if (write(r->stop, &one, sizeof one) == (ssize_t)sizeof one)
            pthread_join(r->thread, NULL);
        close(r->stop);
    }
    Batch *batch = (Batch *)atomic_load(&r->ready);
    if (batch)
        free_batch(batch);
    free_retired(r);
    jox_changes_free(&r->changes);
    jox_watch_free(r->watch);
    pthread_mutex_destroy(&r->machines);
    jox_free(r);
    scene->reload = NULL;
}
