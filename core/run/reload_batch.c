/* Loads edited files into new machines and a new specification, and works out how they replace
   the running ones. The loading thread (reload_thread.c) calls it. */
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/format/path.h"
#include "base/guard.h"
#include "base/mem.h"
#include "jostle_tools.h"
#include "run/group_links.h"
#include "run/machine_names.h"
#include "run/read_scene.h"
#include "run/reload_batch.h"
#include "run/scene_machines.h"
#include "run/tags_and_teams.h"

void jox_batch_free(JoxBatch *batch) {
    for (uint32_t c = 0; c < batch->count; c++) {
        jox_free(batch->changes[c].path);
        jox_files_free(&batch->changes[c].files);
        jox_replacement_free(batch->changes[c].replacement);
        jox_loaded_free(batch->changes[c].loaded);
    }
    jox_free(batch->changes);
    jox_scene_free(batch->spec);
    jox_files_free(&batch->spec_files);
    jox_diag_free(&batch->diagnostics);
    jox_text_free(&batch->said);
    jox_free(batch);
}

bool jox_reload_watch_file(JoxReload *r, uint32_t part, const char *path) {
    jox_changes_add_use(&r->changes, part, path);
    return !r->watch || jox_watch_add(r->watch, path);
}

/* Watches the files that a batch is made of; those of a batch that could not go live too, so
   that the next edit tries again. */
static void account_batch(JoxReload *r, const JoxBatch *batch, bool live) {
    if (live)
        jox_changes_mark_live(&r->changes, batch->parts);
    else if (batch->sets)
        jox_setting_revert(r, &batch->setting);
    for (uint32_t c = 0; c < batch->count; c++) {
        const JoxChange *change = &batch->changes[c];
        for (uint32_t f = 0; f < change->files.count && (live || !change->added); f++)
            jox_reload_watch_file(r, change->index, change->files.paths[f]);
    }
    for (uint32_t f = 0; batch->spec_files.count > f; f++)
        jox_reload_watch_file(r, JOX_PART_SCENE, batch->spec_files.paths[f]);
    const uint32_t mod_parts =
        batch->parts[JOX_PART_MODS] ? r->scene->mods->count * JOX_RELOAD_MOD_PARTS : 0;
    for (uint32_t m = 0; m < mod_parts; m++) {
        char path[JOX_LONGEST_PATH];
        jox_reload_mod_path(r->scene, m / JOX_RELOAD_MOD_PARTS, m % JOX_RELOAD_MOD_PARTS, path);
        jox_reload_watch_file(r, JOX_PART_MODS, path);
    }
}

void jox_reload_free_retired(JoxReload *r) {
    JoxRetired *retired = (JoxRetired *)atomic_exchange(&r->retired, 0);
    while (retired) {
        JoxRetired *next = retired->next;
        account_batch(r, retired->batch, retired->live);
        jox_batch_free(retired->batch);
        for (uint32_t m = 0; m < retired->count; m++)
            jox_loaded_free(retired->machines[m]);
        jox_free(retired->machines);
        jox_free(retired);
        retired = next;
    }
}

static JoxChange *add_change(JoxBatch *batch, uint32_t index, const char *path) {
    JOX_RESERVE(batch->changes, batch->capacity, batch->count + 1);
    JoxChange *change = &batch->changes[batch->count++];
    *change = (JoxChange){.index = index, .path = jox_strdup(path)};
    return change;
}

/* Writes the path at which a missing machine would be found: beside the one that becomes it. */
static void write_path_beside(const char *from, const char *name, char path[1024]) {
    const size_t n = strlen(name);
    const bool has_ending = n > 4 && !strcmp(name + n - 4, ".lua");
    char file[JOX_LONGEST_PATH];
    snprintf(file, sizeof file, "%.200s%s", name, has_ending ? "" : ".lua");
    jox_path_beside(from, file, path);
}

/* Adds the machines that a new version becomes, and that the scene lacks, to the batch. */
static void add_becomes(JoxReload *r, JoxBatch *batch, uint32_t c, const JoxMachine *next) {
    JoScene *scene = r->scene;
    const JoxMachineSet *set = &scene->world->model.machines;
    uint32_t count = atomic_load(&r->machine_count);
    for (uint32_t s = 0; s < next->state_count; s++) {
        char path[1024];
        if (!next->states[s].become)
            continue;
        if (!jox_run_find_become(scene, next, s, path, &batch->diagnostics)) {
            write_path_beside(next->path, next->states[s].become, path);
            jox_files_add(&batch->changes[c].files, path); /* when it is written, try again */
            continue;
        }
        bool known = false;
        uint32_t added = 0;
        for (uint32_t m = 0; m < count; m++)
            known |= strcmp(set->items[m]->path, path) == 0;
        for (uint32_t o = 0; o < batch->count; o++) {
            known |= strcmp(batch->changes[o].path, path) == 0;
            added += batch->changes[o].added;
        }
        if (!known && count + added < JOX_MOST_MACHINES)
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
static void load_change(JoxReload *r, JoxBatch *batch, uint32_t c) {
    JoScene *scene = r->scene;
    const char *path = batch->changes[c].path;
    const char *made = jox_run_journey_text(scene->spec, path);
    JoxLoaded *loaded = jox_lua_prepare(scene->lua, path, made, made ? strlen(made) : 0,
                                        &scene->scope, &batch->diagnostics);
    uint32_t count;
    char *const *tried = jox_loaded_paths_tried(loaded, &count);
    for (uint32_t f = 0; f < count; f++)
        jox_files_add(&batch->changes[c].files, tried[f]);
    batch->changes[c].loaded = loaded;
    jox_text_add(&batch->said, jox_loaded_output(loaded));
    JoxMachine *next = jox_loaded_machine(loaded);
    const JoxLuaFile *files = jox_loaded_files(loaded, &count);
    if (next) {
        jox_run_own_set_parameters(scene->spec, next);
        if (batch->spec)
            jox_run_own_set_parameters(batch->spec, next);
    }
    if (next)
        jox_run_check_own_values(scene, next, files, count, &batch->diagnostics);
    if (next)
        add_becomes(r, batch, c, next);
    else
        batch->failed = true;
    for (uint32_t f = 0; r->watch && f < batch->changes[c].files.count; f++)
        jox_watch_add(r->watch, batch->changes[c].files.paths[f]);
}

static void load_scene_files(JoxReload *r, JoxBatch *batch) {
    JoScene *scene = r->scene;
    batch->spec =
        jox_run_load_spec(&scene->def, scene->mods, scene->mods->count, &batch->diagnostics);
    batch->failed |= !batch->spec;
    for (uint32_t f = 0; batch->spec && f < batch->spec->file_count; f++)
        jox_files_add(&batch->spec_files, batch->spec->files[f].path);
}

void jox_reload_mod_path(const JoScene *scene, uint32_t mod, int part,
                         char path[JOX_LONGEST_PATH]) {
    snprintf(path, JOX_LONGEST_PATH, "%s/%s", scene->mods->items[mod].folder,
             part == JOX_RELOAD_SHEET ? "mod.yaml" : "patches/");
}

/* Reports edited mod.yaml files and changed folders of patches. They take effect at the next
   start: mods, their order and settings are fixed when a scene begins. */
static void report_mod_changes(const JoxReload *r, JoxBatch *batch) {
    static const char *const LATER[] = {
        [JOX_RELOAD_SHEET] = "changed; what it says of the mod, as of its settings, takes effect",
        [JOX_RELOAD_PATCHES] = "has other files; which patches a mod has takes effect"};
    for (uint32_t m = 0; m < r->scene->mods->count; m++)
        for (int part = 0; part < JOX_RELOAD_MOD_PARTS; part++) {
            char path[JOX_LONGEST_PATH];
            jox_reload_mod_path(r->scene, m, part, path);
            if (jox_changes_affects(&r->changes, JOX_PART_MODS, path))
                jox_text_printf(&batch->said, "%s %s at the next start\n", path, LATER[part]);
        }
}

/* Works out how agents move from the running version to the new one. */
void jox_batch_compare(JoxReload *r, JoxChange *change) {
    const JoxMachineRun *machines = &r->scene->world->machines;
    jox_replacement_free(change->replacement);
    JoxRecovery recovery;
    pthread_mutex_lock(&r->machines);
    jox_recovery_push(&recovery);
    if (setjmp(recovery.jump) != 0) { /* holds no lock when memory is out */
        pthread_mutex_unlock(&r->machines);
        jox_out_of_memory(0);
    }
    change->edits = r->edits[change->index];
    change->replacement = jox_replacement_prepare(
        machines->set->items[change->index], jox_loaded_machine(change->loaded),
        r->scene->world->model.def.seed, atomic_load(&r->next_id));
    jox_recovery_pop(&recovery);
    pthread_mutex_unlock(&r->machines);
}

/* Loads the machines of a batch, which grow by those that others become, and the scene's own
   files. */
static void load_parts(JoxReload *r, JoxBatch *batch) {
    for (uint32_t c = 0; c < batch->count; c++)
        load_change(r, batch, c);
    if (batch->parts[JOX_PART_SCENE])
        load_scene_files(r, batch);
}

/* Texts of the files that a vetter read, from which they are loaded. */
typedef struct Vetted {
    JoxOverlay files;
    JoxWatch *watch;
} Vetted;

/* Keeps the text that the vetter read: the file may have changed again since it was noticed. */
static void keep_vetted_file(void *context, const char *path, const char *text, size_t length) {
    Vetted *vetted = context;
    jox_overlay_put(&vetted->files, path, text, length);
    jox_watch_set_known(vetted->watch, path, text, length);
}

/* Lets the scene's vetter read the files of a batch, and loads it from the texts that it read. */
static void load_vetted(JoxReload *r, JoxBatch *batch) {
    const JoVetter *vetter = r->scene->vetter;
    const char *paths[JOX_MOST_MACHINES];
    Vetted vetted = {.files.sealed = true, .watch = r->watch};
    JoVetting what = {.behaviours = paths,
                      .behaviour_count = batch->count,
                      .scene = batch->parts[JOX_PART_SCENE],
                      .stop = r->stop,
                      .read = keep_vetted_file,
                      .read_context = &vetted};
    for (uint32_t c = 0; c < batch->count; c++)
        paths[c] = batch->changes[c].path;
    if (vetter->vet(vetter->context, &what)) {
        const JoxOverlay *before = jox_overlay_use(&vetted.files);
        load_parts(r, batch);
        jox_overlay_use(before);
    } else {
        batch->failed = true;
        jox_diag_error(&batch->diagnostics, ((JoxPosition){what.file, 0, 0, 0}), "not-vetted",
                       vetter->trust, "%s", what.why);
    }
    jox_overlay_free(&vetted.files);
}

void jo_scene_vet(JoScene *scene, const JoVetter *vetter) {
    JOX_REQUIRE(scene && !scene->reload, );
    scene->vetter = vetter;
}

bool jo_scene_try(JoScene *scene, const JoVetting *what) {
    JOX_REQUIRE(scene && scene->def.dry && what, false);
    JOX_GUARD (scene->heap, NULL)
        return false;
    const JoxMachineSet *set = &scene->world->model.machines;
    JoxReload r = {.scene = scene, .stop = -1};
    JoxBatch *batch = jox_alloc(1, sizeof *batch);
    atomic_store(&r.machine_count, set->count);
    batch->parts[JOX_PART_SCENE] = what->scene;
    for (size_t b = 0; b < what->behaviour_count; b++) /* need not belong to this scene */
        add_change(batch, 0, what->behaviours[b]);
    load_parts(&r, batch);
    jox_batch_free(batch);
    return true;
}

/* Checks the tags that new versions ask for, and the types of the values that groups set, against
   all machines as they will be after the swap. */
static void check_batch_names(JoScene *scene, JoxBatch *batch) {
    const JoxMachineSet *set = &scene->world->model.machines;
    const JoxMachine *machines[2 * JOX_MOST_MACHINES];
    uint32_t count = 0;
    for (uint32_t m = 0; m < set->count; m++) {
        bool changes = false;
        for (uint32_t c = 0; c < batch->count; c++)
            changes |= !batch->changes[c].added && batch->changes[c].index == m;
        if (!changes)
            machines[count++] = set->items[m];
    }
    for (uint32_t c = 0; c < batch->count; c++)
        machines[count++] = jox_loaded_machine(batch->changes[c].loaded);
    for (uint32_t c = 0; c < batch->count; c++) {
        uint32_t file_count;
        const JoxLuaFile *files = jox_loaded_files(batch->changes[c].loaded, &file_count);
        jox_run_check_tags_and_teams(scene, jox_loaded_machine(batch->changes[c].loaded), files,
                                     file_count, machines, count, &batch->diagnostics);
    }
    /* A behaviour may take a value as another type before the scene gives it so. */
    jox_run_check_value_types(batch->spec ? batch->spec : scene->spec, machines, count,
                              batch->spec ? JOX_SEVERITY_ERROR : JOX_SEVERITY_WARNING,
                              &batch->diagnostics);
}

/* Loads the next parts whose files have changed, in the order in which they were noticed. */
JoxBatch *jox_batch_prepare(JoxReload *r) {
    JoScene *scene = r->scene;
    const JoxMachineRun *machines = &scene->world->machines;
    bool parts[JOX_PARTS];
    double written;
    if (!jox_changes_take_next(&r->changes, parts, &written))
        return NULL;
    JoxBatch *batch = jox_alloc(1, sizeof *batch);
    memcpy(batch->parts, parts, sizeof parts);
    batch->written = written;
    for (uint32_t m = 0; m < atomic_load(&r->machine_count); m++)
        if (parts[m])
            add_change(batch, m, machines->set->items[m]->path);
    if (parts[JOX_PART_MODS])
        report_mod_changes(r, batch);
    if (r->watch && scene->vetter && (batch->count || parts[JOX_PART_SCENE]))
        load_vetted(r, batch);
    else
        load_parts(r, batch);
    if (!batch->failed)
        check_batch_names(scene, batch);
    if (batch->diagnostics.errors)
        batch->failed = true;
    for (uint32_t c = 0; c < batch->count && !batch->failed; c++)
        if (!batch->changes[c].added)
            jox_batch_compare(r, &batch->changes[c]);
    return batch;
}

/* ---- settings of mods ---- */

/* Returns whether a part is made of one of the patches of a mod. */
static bool uses_patches(const JoxFiles *files, const JoxMod *mod) {
    for (uint32_t p = 0; p < mod->patch_count; p++)
        for (uint32_t f = 0; f < files->count; f++)
            if (mod->patches[p].lua && strcmp(files->paths[f], mod->patches[p].path) == 0)
                return true;
    return false;
}

JoxBatch *jox_setting_prepare(JoxReload *r, const JoxSettingChange *change) {
    const JoScene *scene = r->scene;
    char path[JOX_LONGEST_PATH];
    jox_setting_of(scene, change)->value = change->value;
    jox_setting_path(scene, change->mod, path);
    for (uint32_t m = 0; m < atomic_load(&r->machine_count); m++)
        if (uses_patches(&r->changes.made_of[m], &scene->mods->items[change->mod])) {
            jox_changes_add_use(&r->changes, m, path);
            jox_changes_add_changed_file(&r->changes, path, 0.0);
        }
    JoxBatch *batch = jox_batch_prepare(r);
    batch = batch ? batch : jox_alloc(1, sizeof *batch);
    batch->sets = true;
    batch->setting = *change;
    return batch;
}
