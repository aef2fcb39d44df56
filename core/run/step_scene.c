/* Performs a step of a running scene, and ends it. jo_scene_step and jo_scene_finish are here. */
#include "base/assert.h"
#include "base/clock.h"
#include "base/guard.h"
#include "run/input_actions.h"
#include "run/input_log.h"
#include "run/program_words.h"
#include "run/reload.h"
#include "run/run.h"

static bool perform_step(JoScene *scene, JoError *error) {
    jox_run_perform_due_inputs(scene);
    jox_run_swap_reloaded(scene);
    const bool stepped = jox_world_step(scene->world);
    JoxText *said = &scene->world->scratch.messages;
    if (said->length)
        jox_run_send_text(scene, said->data);
    jox_text_free(said);
    if (!stepped) {
        jox_error(error, JO_FAILED, "%s", scene->world->failure);
        return false;
    }
    jox_run_do_program_acts(scene);
    const char *stalled = jox_lua_stalled(scene->lua);
    if (stalled) {
        jox_error(error, JO_FAILED,
                  "%s: its functions take far longer than their instructions explain (look-ups "
                  "among keys that collide, comparisons of long texts); the run was stopped",
                  stalled);
        return false;
    }
    const double begun = jox_clock_wall();
    const bool told = jox_run_tell_frame(scene, error);
    scene->world->state.statistics.collect_s += jox_clock_wall() - begun;
    return told && jox_run_check_log_written(scene, error);
}

bool jo_scene_step(JoScene *scene, JoError *error) {
    JOX_REQUIRE(scene && !scene->finished && !scene->def.dry && !scene->world->busy &&
                    !scene->acting,
                false);
    JOX_GUARD (scene->heap, error) {
        scene->world->busy = false;
        return false;
    }
    scene->world->busy = true; /* refuses calls from message functions */
    const bool good = perform_step(scene, error);
    scene->world->busy = false;
    return good;
}

bool jo_scene_finish(JoScene *scene, JoError *error) {
    JOX_REQUIRE(scene && !(scene->world && scene->world->busy), false);
    JOX_GUARD (scene->heap, error)
        return false;
    if (scene->finished)
        return true;
    scene->finished = true;
    bool good = !scene->world || jox_run_tell_end(scene, error);
    return jox_run_close_log(scene, good ? error : NULL) && good;
}
