/* Loads scenes: tries with all mods found, leaves out those that the scene does not load with,
   tells what is wrong, and frees scenes. The program calls it through jo_scene_load. */
#include <stdio.h>
#include <string.h>

#include "base/assert.h"
#include "base/guard.h"
#include "base/mem.h"
#include "jostle_host.h"
#include "run/build_scene.h"
#include "run/input_log.h"
#include "run/load_scene.h"
#include "run/machine_names.h"
#include "run/present_frame.h"
#include "run/program_words.h"
#include "run/read_scene.h"
#include "run/reload.h"
#include "run/run.h"
#include "simd/isa.h"

enum { SCENE_COOKIE = 0x4a4f5343 };

JoSceneDef jo_default_scene_def(void) {
    return (JoSceneDef){.cookie = SCENE_COOKIE};
}

/* Copies the def with its texts, which the caller may free: a reload reads the scene as the load
   did. */
static void copy_def(JoScene *scene, const JoSceneDef *def) {
    JoSceneDef *own = &scene->def;
    *own = *def;
    own->path = jox_strdup(def->path);
    own->input_log = jox_strdup(def->input_log);
    own->words = scene->words;
    const char **overrides = jox_alloc(def->override_count + 1, sizeof *overrides);
    for (size_t i = 0; i < def->override_count; i++)
        overrides[i] = jox_strdup(def->overrides[i]);
    own->overrides = overrides;
    own->text = NULL; /* a text in memory is not edited on the disk */
    own->mods = NULL; /* found already */
    own->mod_count = 0;
    scene->spec_file_count = scene->spec->file_count;
    scene->spec_files = jox_alloc(scene->spec_file_count + 1, sizeof *scene->spec_files);
    for (uint32_t f = 0; f < scene->spec_file_count; f++)
        scene->spec_files[f] = jox_strdup(scene->spec->files[f].path);
}

static void free_def(JoScene *scene) {
    jox_free((char *)scene->def.path);
    jox_free((char *)scene->def.input_log);
    for (size_t i = 0; scene->def.overrides && i < scene->def.override_count; i++)
        jox_free((char *)scene->def.overrides[i]);
    jox_free((char **)scene->def.overrides);
    for (uint32_t f = 0; f < scene->spec_file_count; f++)
        jox_free(scene->spec_files[f]);
    jox_free(scene->spec_files);
}

static void drop_message(void *context, const char *text) {
    (void)context;
    (void)text;
}

/* Reads files through the scene's overlay from here on. The overlay in use is copied into it, or
   lies under it while the scene loads if it is sealed or told of reads. Returns the overlay that
   was in use, to be put back. */
static const JoxOverlay *use_scene_overlay(JoScene *scene, const JoSceneDef *def) {
    const JoxOverlay *before = jox_overlay_use(&scene->overlay);
    const bool lies_over = before && (before->sealed || before->told);
    scene->overlay.under = lies_over ? before : NULL;
    for (size_t f = 0; before && !lies_over && f < before->count; f++)
        jox_overlay_put(&scene->overlay, before->files[f].path, before->files[f].text,
                        before->files[f].length);
    for (size_t f = 0; f < def->file_count; f++)
        jox_overlay_put(&scene->overlay, def->files[f].path, def->files[f].text,
                        def->files[f].length);
    scene->overlay.sealed = def->files_only;
    scene->overlay.tape = def->resumable ? &scene->tape : NULL;
    return before;
}

static void leave_scene_overlay(JoScene *scene, const JoxOverlay *before) {
    jox_overlay_use(before);
    scene->overlay.under = NULL;
}

/* Frees a scene that did not load: it has no end that anybody waits for. */
static void discard_scene(JoScene *scene) {
    if (scene)
        scene->finished = true;
    jo_scene_free(scene);
}

/* Returns the number of the first found mod with which, and with the mods before it, the scene
   does not load, whatever the error; -1: it does not load without mods either. */
static int32_t find_breaking_mod(const JoSceneDef *def, uint64_t without) {
    for (uint32_t count = 0;; count++) {
        JoxDiagnostics ignored = {0}, now = {0};
        JoScene *scene = jox_alloc(1, sizeof *scene);
        scene->heap = jox_heap_used();
        scene->message = drop_message;
        const JoxOverlay *before = use_scene_overlay(scene, def);
        scene->mods = jox_run_find_mods(def, without, &ignored);
        const uint32_t all = scene->mods->count;
        if (count < all) { /* with all of them it is known to fail */
            scene->mods->count = count;
            jox_run_build(scene, def, count, &now);
            scene->mods->count = all;
        }
        leave_scene_overlay(scene, before);
        bool fails = count >= all || now.errors > 0;
        int32_t culprit = fails && count > 0 ? (int32_t)scene->mods->found_index[count - 1] : -1;
        jox_diag_free(&ignored);
        jox_diag_free(&now);
        discard_scene(scene);
        if (fails)
            return culprit;
    }
}

/* Loads the scene with the mods found but for those in `without`. NULL: with *culprit among the
   found mods, or -1 and the errors in `diagnostics`. */
static JoScene *try_load(const JoSceneDef *def, uint64_t without, int32_t *culprit,
                         JoxDiagnostics *mod_problems, JoxDiagnostics *diagnostics) {
    JoScene *scene = jox_alloc(1, sizeof *scene);
    scene->heap = jox_heap_used();
    scene->message = def->message ? def->message : jox_run_write_to_stderr;
    scene->message_context = def->message_context;
    const JoxOverlay *before = use_scene_overlay(scene, def);
    scene->mods = jox_run_find_mods(def, without, mod_problems);
    *culprit = -1;
    jox_run_build(scene, def, scene->mods->count, diagnostics);
    leave_scene_overlay(scene, before);
    for (uint32_t f = 0; scene->spec && f < scene->spec->file_count; f++)
        jox_diag_attach_source(diagnostics, scene->spec->files[f].path, scene->spec->files[f].text,
                               scene->spec->files[f].length);
    if (diagnostics->errors == 0) {
        copy_def(scene, def);
        return scene;
    }
    bool blames = scene->mods->count > 0;
    discard_scene(scene);
    *culprit = blames ? find_breaking_mod(def, without) : -1;
    return NULL;
}

/* Notes that a mod is left out, after the errors that try_load found with it. */
static void leave_out_mod(const JoSceneDef *def, uint64_t without, int32_t culprit,
                          JoxDiagnostics *problems, JoxDiagnostics *diagnostics) {
    JoxDiagnostics ignored = {0};
    JoxMods *before = jox_run_find_mods(def, without, &ignored);
    JoxMods *after = jox_run_find_mods(def, without | (uint64_t)1 << culprit, &ignored);
    const JoxMod *mod = &before->found[culprit];
    char others[256] = "";
    for (uint32_t b = 0; b < before->count; b++) { /* mods that need it are left out too */
        bool stays = before->found_index[b] == (uint32_t)culprit;
        for (uint32_t a = 0; a < after->count; a++)
            stays |= after->found_index[a] == before->found_index[b];
        if (!stays && strlen(others) < 180)
            snprintf(others + strlen(others), 64, ", and %s, which needs it",
                     before->items[b].name);
    }
    jox_diag_move(problems, diagnostics);
    const JoxPosition at = {mod->folder, 0, 0, 0};
    jox_diag_note(problems, at, "mod-left-out", "mod %s is left out%s", mod->name, others);
    jox_mods_free(before);
    jox_mods_free(after);
    jox_diag_free(&ignored);
}

static bool is_missing_mod(const JoxMods *mods, const char *name) {
    return !strchr(name, '/') && jox_mods_index(mods, name) < 0;
}

/* Checks that the mods that the def names are all in the scene; else false with an error. Mods
   that the user turned on or the scene names may be missing. */
static bool takes_named_mods(const JoSceneDef *def, const JoScene *scene,
                             JoxDiagnostics *diagnostics) {
    const JoxMods *mods = scene->mods;
    for (size_t n = 0; n < def->mod_count; n++) {
        const char *name = def->mods[n];
        size_t length = strlen(name);
        for (; length > 1 && name[length - 1] == '/'; length--)
            continue;
        const JoxMod *taken = NULL;
        for (uint32_t m = 0; m < mods->count && !taken; m++)
            if (strcmp(mods->items[m].name, name) == 0 ||
                (strncmp(mods->items[m].folder, name, length) == 0 &&
                 (!mods->items[m].folder[length] ||
                  (mods->items[m].folder[length] == '/' && jox_mods_is_archive(name)))))
                taken = &mods->items[m];
        if (taken)
            jox_run_check_mod_use(scene, taken, diagnostics);
        if (taken)
            continue;
        if (!is_missing_mod(mods, name)) /* a missing mod has been reported */
            jox_diag_error(diagnostics, ((JoxPosition){"--mod", 0, 0, 0}), "mod-not-taken", NULL,
                           "mod '%.200s' was asked for and cannot be taken", name);
        return false;
    }
    return true;
}

JoScene *jox_run_load(const JoSceneDef *def, JoxDiagnostics *diagnostics) {
    uint64_t without = 0;
    if (def->threads > 64) {
        jox_diag_error(diagnostics, ((JoxPosition){0}), "out-of-range", NULL,
                       "threads must be from 1 to 64, or 0 for all processors");
        return NULL;
    }
    if (def->isa != JO_ISA_WIDEST && !jox_isa_runs(def->isa)) {
        jox_diag_error(diagnostics, ((JoxPosition){0}), "isa-not-run", NULL,
                       "this machine does not run the instruction set '%s'",
                       jox_isa_name(def->isa));
        return NULL;
    }
    JoxDiagnostics problems = {0}; /* with mods */
    for (;;) {
        JoxDiagnostics found = {0}, now = {0};
        int32_t culprit;
        JoScene *scene = try_load(def, without, &culprit, &found, &now);
        if (scene || culprit < 0 || (without >> culprit & 1)) {
            jox_diag_move(&problems, &found);
            jox_diag_move(diagnostics, &now);
            if (scene && takes_named_mods(def, scene, &problems)) {
                scene->mod_problems = problems;
                return scene;
            }
            jox_diag_move(diagnostics, &problems);
            discard_scene(scene);
            return NULL;
        }
        jox_diag_free(&found);
        leave_out_mod(def, without, culprit, &problems, &now);
        without |= (uint64_t)1 << culprit;
    }
}

/* Loads a scene, and reports what is wrong by the callbacks. */
static JoScene *load_and_tell(const JoSceneDef *def, JoxDiagnosed *diagnosed, void *context,
                              JoError *error) {
    JoxDiagnostics diagnostics = {0};
    JoScene *scene = jox_run_load(def, &diagnostics);
    jox_run_call_diagnosed(diagnosed, context, NULL, &diagnostics);
    const size_t warnings = diagnostics.warnings;
    jox_run_report_diagnostics(def->message, def->message_context, &diagnostics, error);
    jox_run_call_diagnosed(diagnosed, context, NULL, NULL);
    if (!scene)
        return NULL;
    scene->warnings += warnings + scene->mod_problems.warnings;
    scene->diagnosed = diagnosed;
    scene->diagnosed_context = context;
    jox_run_report_diagnostics(scene->message, scene->message_context, &scene->mod_problems, NULL);
    for (uint32_t m = 0; m < scene->mods->count; m++)
        jox_run_say(scene, "%s %s %s (%s)\n", m ? "     " : "mods:", scene->mods->items[m].name,
                    scene->mods->items[m].version, scene->mods->items[m].folder);
    if (def->dry)
        return scene;
    jox_run_compare_with_log(scene);
    return scene;
}

static JoScene *load_on_heap(const JoSceneDef *def, JoxDiagnosed *diagnosed, void *context,
                             JoxHeap *heap, JoError *error) {
    JOX_GUARD (heap, error)
        return NULL;
    return load_and_tell(def, diagnosed, context, error);
}

static void release_scene(void *scene) {
    jo_scene_free(scene);
}

JoScene *jox_run_load_and_report(const JoSceneDef *def, JoxDiagnosed *diagnosed, void *context,
                                 JoError *error) {
    JOX_REQUIRE(def && def->cookie == SCENE_COOKIE && def->path && jox_run_is_def_whole(def), NULL);
    JoxHeap *heap = jox_heap_create();
    JoScene *scene = heap ? load_on_heap(def, diagnosed, context, heap, error) : NULL;
    if (!heap || jox_heap_has_failed(heap)) {
        jox_memory_error(error);
        jox_run_send_message(def->message, def->message_context, "out of memory\n");
    }
    if (!scene) {
        jox_heap_free(heap);
        return NULL;
    }
    scene->owns_heap = true;
    /* The call for which it is loaded may run out of memory: its heap then frees the scene. */
    return jox_heap_register(scene, release_scene);
}

JoScene *jo_scene_load(const JoSceneDef *def, JoError *error) {
    return jox_run_load_and_report(def, NULL, NULL, error);
}

static void free_scene(JoScene *scene) {
    jo_scene_finish(scene, NULL);
    jox_run_release_listeners(scene);
    jox_run_free_frame(scene);
    jox_run_end_reload(scene);
    free_def(scene);
    jo_world_free(scene->world); /* before Lua, whose machines it holds */
    jox_lua_free(scene->lua);
    jox_run_free_words(scene);
    jox_scene_free(scene->spec);
    jox_mods_free(scene->mods);
    jox_diag_free(&scene->mod_problems);
    for (uint32_t g = 0; scene->scope_groups && g < scene->scope.group_count; g++) {
        jox_free((char *)scene->scope_groups[g].name);
        jox_free((char *)scene->scope_groups[g].team);
    }
    jox_free(scene->scope_groups);
    jox_free(scene->input_path);
    jox_free(scene->input_failed_why);
    jox_input_free(&scene->input);
    jox_files_free(&scene->logged_files);
    jox_overlay_free(&scene->overlay);
    jox_overlay_free(&scene->tape);
    jox_text_free(&scene->resumed);
    jox_free(scene);
}

static void free_guarded(JoScene *scene) {
    JOX_GUARD (scene->heap, NULL)
        return;
    free_scene(scene);
}

void jo_scene_free(JoScene *scene) {
    if (!scene)
        return;
    JOX_REQUIRE(!scene->world || !scene->world->busy, );
    if (!scene->owns_heap) {
        free_scene(scene);
        return;
    }
    JoxHeap *heap = scene->heap;
    jox_heap_unregister(scene);
    free_guarded(scene); /* does nothing where memory ran out: the heap releases all of it */
    jox_heap_free(heap);
}

JoWorld *jo_scene_world(JoScene *scene) {
    JOX_REQUIRE(scene && !scene->def.dry, NULL);
    return scene->world;
}

double jo_scene_duration(const JoScene *scene) {
    JOX_REQUIRE(scene, 0.0);
    return scene->spec->duration;
}
