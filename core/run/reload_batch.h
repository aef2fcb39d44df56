/* What the files reload*.c share. */
#ifndef JOX_RUN_RELOAD_BATCH_H
#define JOX_RUN_RELOAD_BATCH_H

#include <pthread.h>
#include <stdatomic.h>

#include "run/reload.h"
#include "run/run.h"
#include "run/watch/changes.h"
#include "run/watch/watch.h"

/* One machine of a batch. */
typedef struct JoxChange {
    uint32_t index; /* in the mind; for a new machine, once it is added */
    bool added;     /* another one becomes it */
    char *path;
    JoxLoaded *loaded;
    JoxFiles files; /* that were looked for */
    JoxReplacement *replacement;
    uint32_t edits; /* of the machine, when they were compared */
} JoxChange;

/* What the loading thread hands over: machines, a new specification of the scene, or only what is
 * wrong. */
typedef struct JoxBatch {
    JoxChange *changes;
    uint32_t count;
    size_t capacity;
    JoxSceneSpec *spec; /* of the scene's own files; NULL: they did not change */
    JoxFiles spec_files;
    JoxDiagnostics diagnostics;
    JoxText said;
    bool parts[JOX_PARTS]; /* machines and the scene that it is about */
    double written;        /* seconds since 1970 */
    bool failed;
} JoxBatch;

struct JoxReload {
    JoScene *scene;
    JoxWatch *watch;
    pthread_t thread;
    bool running;             /* the thread */
    bool edited;              /* the stepping thread holds `machines` */
    int stop;                 /* eventfd */
    atomic_uintptr_t ready;   /* JoxBatch *, to the stepping thread */
    atomic_uintptr_t retired; /* JoxRetired *, back */
    atomic_uint next_id, machine_count;
    atomic_bool starved;      /* memory ran out in the thread, which has ended */
    JoxChanges changes;       /* the loading thread's own */
    pthread_mutex_t machines; /* held while they are compared, or changed in place */
    uint32_t edits[JOX_MOST_MACHINES];
};

/* What was swapped out, freed off the stepping thread. */
typedef struct JoxRetired {
    struct JoxRetired *next;
    JoxBatch *batch;
    JoxLoaded **machines;
    uint32_t count;
    bool live; /* the batch was taken */
} JoxRetired;

/* reload_load.c: the next parts whose files have changed, loaded and compared with what runs; NULL
   where there are none. */
JoxBatch *jox_batch_prepare(JoxReload *reload);
/* Works out what it takes to put the new version of a machine in the place of the old. */
void jox_batch_compare(JoxReload *reload, JoxChange *change);
void jox_batch_free(JoxBatch *batch);
/* Frees what was swapped out; its files count as live, or as tried. */
void jox_reload_free_retired(JoxReload *reload);
/* A part is made of a file. False with errno if the file cannot be watched. */
bool jox_reload_use(JoxReload *reload, uint32_t part, const char *path);
/* Parts of a mod that are watched though no machine or scene is made of them. */
enum { JOX_RELOAD_SHEET, JOX_RELOAD_PATCHES, JOX_RELOAD_MOD_PARTS };
/* Writes the path of a mod's mod.yaml, or of its folder of patches. */
void jox_reload_mod_path(const JoScene *scene, uint32_t mod, int part, char path[JOX_LONGEST_PATH]);
/* reload_swap.c: on the stepping thread, between two steps: all of a batch goes live, or nothing of
   it and people are told why. It is handed back through `retired`. True if it is live. */
bool jox_batch_take(JoScene *scene, JoxBatch *batch);

#endif
