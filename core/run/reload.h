/* Reloads edited files while a scene runs. A thread waits for changes and loads them
   (reload_thread.c, reload_batch.c); between two steps they replace what runs (reload_swap.c,
   reload_scene.c). */
#ifndef JOX_RUN_RELOAD_H
#define JOX_RUN_RELOAD_H

#include "jostle.h"
#include "scene/scene.h"
#include "world/input/input_entries.h"

typedef struct JoxReload JoxReload;

/* Swaps in what the thread has loaded since the last step. Called between two steps. */
void jox_run_swap_reloaded(JoScene *scene);
/* Loads files of an input log and swaps in what is made of them, on the stepping thread. False with
   `error` if they are not taken. */
bool jox_run_reload_files(JoScene *scene, const JoxInputEntry *files, JoError *error);
/* Whether a behaviour or the scene reads a file. Known after the first reload. */
bool jox_run_reads_file(const JoScene *scene, const char *path);
/* Keeps the thread from reading machines while one of them is changed in place (`hold`), or lets it
   go on. What it has compared with that machine is compared again before a swap. */
void jox_run_hold_machines(JoScene *scene, uint32_t machine, bool hold);
/* Ends the thread, and frees all that belongs to reloads. */
void jox_run_end_reload(JoScene *scene);

/* Gives the living agents of a group a value that the scene sets. `machine` -1: in whichever
   machine they run. */
void jox_run_give_group_value(JoScene *scene, int32_t machine, uint32_t group,
                              const JoxGroupValue *set);
/* Takes over from an edited specification what can change while a scene runs, and says what cannot.
   *spec is the replaced specification afterwards. `written`: when the file was saved, in seconds
   since 1970. */
void jox_run_reload_scene(JoScene *scene, JoxSceneSpec **spec, double written);

#endif
