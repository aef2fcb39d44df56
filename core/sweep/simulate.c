/* Simulates one run of a sweep and packs its results into pieces. sweep.c calls this in a child
   process. */
#include <math.h>
#include <string.h>

#include "base/format/piece_file.h"
#include "run/results/result_structs.h"
#include "run/run.h"
#include "sweep/sweep.h"

const char *const jox_sweep_states[3] = {"done", "troubled", "failed"};

static void add_text_piece(JoxText *pieces, const char *name, const char *text) {
    jox_pieces_add(pieces, name, text, strlen(text));
}

static void add_run_message(void *context, const char *text) {
    jox_text_add(context, text);
}

/* Loads the scene, steps it to the end, and appends its results. Sets *troubles to what did not go
   as written, or NULL; to be freed. Returns false with `error`. */
static bool simulate_run(const JoxSweepRun *run, const JoSceneDef *def, JoxText *pieces,
                         char **troubles, JoError *error) {
    JoScene *scene = jo_scene_load(def, error);
    if (!scene)
        return false;
    const double dt = jo_scene_stats(scene).dt;
    const double seconds = isnan(run->seconds) ? jo_scene_duration(scene) : run->seconds;
    const uint64_t steps = run->steps ? run->steps : (uint64_t)(seconds / dt + 0.5);
    JoxText plan = {0};
    jox_sweep_write_plan(scene, &plan);
    bool good = jox_sweep_collect(scene, (double)steps * dt, error) &&
                (!run->data || jo_scene_data(scene, run->data, error));
    const bool to_the_end = run->steps || !isnan(run->seconds); /* also after a game's round */
    for (uint64_t s = 0; good && s < steps && (to_the_end || !jo_scene_over(scene)); s++)
        good = jo_scene_step(scene, error);
    JoError ending = {0};
    const bool ended = jo_scene_finish(scene, &ending);
    if (good && !ended)
        *error = ending;
    good = good && ended;
    char *summary = good ? jo_scene_summary(scene) : NULL;
    if (summary) {
        const JoStats stats = jo_scene_stats(scene);
        const JoxSweepNumbers numbers = {jo_world_hash(scene->world), stats.steps,
                                         stats.simulated_s, stats.cpu_s, stats.wall_s};
        jox_pieces_add(pieces, "numbers", &numbers, sizeof numbers);
        add_text_piece(pieces, "summary", summary);
        add_text_piece(pieces, "plan", plan.data);
        jox_sweep_put_collected(scene, pieces);
        *troubles = jox_run_troubles(scene);
    } else if (good) {
        jox_memory_error(error);
        good = false;
    }
    jo_free(summary);
    jox_text_free(&plan);
    jo_scene_free(scene);
    return good;
}

void jox_sweep_simulate(const JoxSweepRun *run, JoxText *pieces) {
    JoSceneDef def = *run->def;
    JoError error = {0};
    JoxText said = {0};
    char *troubles = NULL;
    def.message = add_run_message;
    def.message_context = &said;
    jox_pieces_begin(pieces);
    const bool good = simulate_run(run, &def, pieces, &troubles, &error);
    const uint32_t state = !good      ? JOX_SWEEP_FAILED
                           : troubles ? JOX_SWEEP_TROUBLED
                                      : JOX_SWEEP_DONE;
    jox_pieces_add(pieces, "state", &state, sizeof state);
    JoxText why = {0};
    if (!good && *error.file)
        jox_text_printf(&why, "%s:%d:%d: ", error.file, (int)error.line, (int)error.column);
    jox_text_add(&why, good && troubles ? troubles : *error.text ? error.text : "it failed");
    if (state != JOX_SWEEP_DONE)
        add_text_piece(pieces, "reason", why.data);
    jox_text_free(&why);
    add_text_piece(pieces, "said", said.data ? said.data : "");
    jox_pieces_end(pieces);
    jo_free(troubles);
    jox_text_free(&said);
}
