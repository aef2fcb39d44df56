/* The state of a running scene. A scene is loaded by load_scene.c and stepped by step_scene.c; the
   other headers of this folder declare what each of its files does with one. */
#ifndef JOX_RUN_RUN_H
#define JOX_RUN_RUN_H

#include <stdio.h>

#include "base/overlay.h"
#include "jostle.h"
#include "lua/loader.h"
#include "run/listener.h"
#include "run/messages.h"
#include "run/watch/changes.h"
#include "scene/mods.h"
#include "scene/scene.h"
#include "world/world.h"

struct JoScene {
    JoxHeap *heap; /* memory of the scene and its world */
    bool owns_heap;
    JoxSceneSpec *spec;
    JoxMods *mods;
    JoxDiagnostics mod_problems; /* mods that were left out, and conflicts between mods */
    JoWorld *world;
    JoxLua *lua;
    JoxScope scope;              /* names that behaviours may use; refers to the world's lists */
    JoxScopeGroup *scope_groups; /* groups of `scope`, with copies of their texts */
    JoMessage *message;
    void *message_context;

    struct JoxReload *reload;      /* NULL: files are not watched */
    const struct JoVetter *vetter; /* checks edited files before they are loaded; NULL: none */
    JoxDiagnosed *diagnosed;       /* called with the diagnostics of reloads; may be NULL */
    void *diagnosed_context;
    double swap_seconds; /* the longest that the swap of a machine has delayed a step */
    JoSceneDef def;      /* as given to the load, with copies of its texts */
    const JoWord *words; /* of the program: copies */
    uint32_t word_count;
    JoxProgramWord *program_words; /* by number of the word */
    double words_told_until;       /* s: until then values that are not finite are only counted */
    uint32_t settings_changed;     /* number of changes of settings of mods that went live */
    bool acting;                   /* actions of the program are done: they are not logged */
    char **spec_files;             /* paths of the scene's file and of the files that it includes */
    uint32_t spec_file_count;
    JoxListeners listeners;
    struct JoxRunFrame *frame; /* frame of the present step (present_frame.c); NULL before its
                                  first use */
    bool finished;
    char *input_path;      /* input log that is played; NULL: none */
    uint32_t input_failed; /* entries of it that could not be done, since the load */
    int input_failed_line; /* line of the first of them */
    char *input_failed_why;
    char input_sha256[65];
    FILE *log; /* input log that is written; NULL: none */
    char *log_path;
    uint64_t resumed_tick;
    uint64_t log_length; /* bytes of the log that a resumed run keeps and appends to */
    bool log_failed;
    size_t warnings;       /* given so far, while loading and running */
    bool acted_on;         /* a person or the program acted on the run, beyond its input log */
    JoxInputLog input;     /* log that is played, until the world exists and takes it over */
    JoxFiles logged_files; /* files whose texts stand in the log that is written */
    JoxOverlay overlay;    /* texts read in place of files: of the played log or a checkpoint */
    JoxText resumed;       /* the checkpoint's file where the scene was resumed; else empty */
    JoxOverlay tape;       /* all texts that a resumable scene was loaded from */
};

#endif
