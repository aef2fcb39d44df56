/* A batch of a reload, and the state of the thread that loads. Shared by reload_thread.c,
   reload_batch.c and reload_swap.c alone. */
#ifndef JOX_RUN_RELOAD_BATCH_H
#define JOX_RUN_RELOAD_BATCH_H

#include <pthread.h>
#include <stdatomic.h>

#include "run/reload.h"
#include "run/run.h"
#include "run/watch/changes.h"
#include "run/watch/watch.h"

/* A change of a setting of a mod, by indices in the scene's mods. */
typedef struct JoxSettingChange {
    uint32_t mod, setting;
    double value, before;
} JoxSettingChange;

/* One machine of a batch. */
typedef struct JoxChange {
    uint32_t index; /* of the machine in the scene; for a new one, set when it is added */
    bool added;     /* a new machine, which another becomes */
    char *path;
    JoxLoaded *loaded;
    JoxFiles files; /* files that the load looked for */
    JoxReplacement *replacement;
    uint32_t edits; /* JoxReload.edits of the machine when the versions were compared */
} JoxChange;

/* A batch is handed by the loading thread to the stepping thread: machines, a new specification of
   the scene, or only diagnostics. */
typedef struct JoxBatch {
    JoxChange *changes;
    uint32_t count;
    size_t capacity;
    JoxSceneSpec *spec; /* NULL: the scene's own files did not change */
    JoxFiles spec_files;
    JoxDiagnostics diagnostics;
    JoxText said;
    bool parts[JOX_PARTS]; /* which machines, and the scene, it holds */
    double written;        /* seconds since 1970 */
    bool failed;
    bool sets; /* it changes a setting */
    JoxSettingChange setting;
} JoxBatch;

struct JoxReload {
    JoScene *scene;
    JoxWatch *watch;
    pthread_t thread;
    bool running;             /* the thread runs */
    bool edited;              /* the stepping thread holds `machines` */
    int stop;                 /* eventfd */
    atomic_uintptr_t ready;   /* JoxBatch * for the stepping thread; 0: none */
    atomic_uintptr_t retired; /* list of JoxRetired for the loading thread, which frees them */
    atomic_uintptr_t wanted;  /* JoxSettingChange * for the loading thread; 0: none */
    atomic_uint next_id, machine_count;
    atomic_bool starved;      /* memory ran out in the thread, which has ended */
    JoxChanges changes;       /* used by the loading thread alone */
    pthread_mutex_t machines; /* held while machines are compared, or changed in place */
    uint32_t edits[JOX_MOST_MACHINES];
};

/* A batch that was taken or refused, and the machines that it replaced; freed on the loading
   thread. */
typedef struct JoxRetired {
    struct JoxRetired *next;
    JoxBatch *batch;
    JoxLoaded **machines;
    uint32_t count;
    bool live; /* the batch was taken */
} JoxRetired;

/* Loads the next parts whose files have changed, and compares them with what runs. NULL: no file
   has changed. (reload_batch.c) */
JoxBatch *jox_batch_prepare(JoxReload *reload);
/* Works out how agents move from the running version of a machine to the new one. */
void jox_batch_compare(JoxReload *reload, JoxChange *change);
void jox_batch_free(JoxBatch *batch);
/* Frees what was swapped out, and watches the files of its batch: as live, or as tried. */
void jox_reload_free_retired(JoxReload *reload);
/* Notes that a part is made of a file, and watches it. False with errno if it cannot be watched. */
bool jox_reload_watch_file(JoxReload *reload, uint32_t part, const char *path);
/* Files of a mod that are watched though no machine or scene is made of them. */
enum { JOX_RELOAD_SHEET, JOX_RELOAD_PATCHES, JOX_RELOAD_MOD_PARTS };
/* Writes the path of a mod's mod.yaml, or of its folder of patches. */
void jox_reload_mod_path(const JoScene *scene, uint32_t mod, int part, char path[JOX_LONGEST_PATH]);
/* Loads the behaviours that a change of a setting concerns; a batch, possibly empty, of which the
   change is a part. (reload_batch.c) */
JoxBatch *jox_setting_prepare(JoxReload *reload, const JoxSettingChange *change);
/* reload_setting.c. Returns the setting that a change names. */
JoxModSetting *jox_setting_of(const JoScene *scene, const JoxSettingChange *change);
/* Writes the path that stands for the settings of a mod among changed files; no file has it. */
void jox_setting_path(const JoScene *scene, uint32_t mod, char path[JOX_LONGEST_PATH]);
/* Notes, on the stepping thread, that a batch with a change has gone live: tells and logs it. */
void jox_setting_went_live(JoScene *scene, const JoxSettingChange *change);
/* Takes back the change of a batch that was refused, on the thread that loads. */
void jox_setting_revert(JoxReload *reload, const JoxSettingChange *change);
/* Changes a setting of a mod: posts it to the loading thread or, if files are not watched, loads
   and swaps at once. False with `error`. (reload_thread.c) */
bool jox_run_reload_setting(JoScene *scene, const JoxSettingChange *change, JoError *error);
/* Takes over a batch on the stepping thread, between two steps: all of it goes live, or nothing
   and the reasons are reported. Hands it back through `retired`. True if it is live.
   (reload_swap.c) */
bool jox_batch_swap(JoScene *scene, JoxBatch *batch);

#endif
