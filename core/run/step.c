/* One step of a running scene, and its end. */
#include <math.h>

#include "base/assert.h"
#include "base/guard.h"
#include "base/mem.h"
#include "run/run.h"

static const float MARGIN = 2.0f; /* m about the walls and people of a scene without bounds */

void jox_run_area(const JoScene *scene, JoxV2 *low, JoxV2 *high) {
    const JoxSceneSpec *spec = scene->spec;
    const JoWorld *world = scene->world;
    if (spec->heatmap || spec->bounded) {
        *low = spec->heatmap ? spec->heatmap_low : spec->low;
        *high = spec->heatmap ? spec->heatmap_high : spec->high;
        return;
    }
    *low = (JoxV2){INFINITY, INFINITY};
    *high = (JoxV2){-INFINITY, -INFINITY};
    const JoxWalls *walls = &world->all_walls;
    for (uint32_t i = 0; i < walls->count + world->agents.count; i++) {
        JoxV2 p = i < walls->count ? walls->vertices[i].point
                                   : (JoxV2){world->agents.x[i - walls->count],
                                             world->agents.y[i - walls->count]};
        *low = (JoxV2){jox_minf(low->x, p.x), jox_minf(low->y, p.y)};
        *high = (JoxV2){jox_maxf(high->x, p.x), jox_maxf(high->y, p.y)};
    }
    if (low->x > high->x)
        *low = *high = (JoxV2){0.0f, 0.0f};
    *low = jox_sub(*low, (JoxV2){MARGIN, MARGIN});
    *high = jox_add(*high, (JoxV2){MARGIN, MARGIN});
}

bool jox_run_failed(JoError *error, JoxText *why) {
    jox_error(error, JO_FAILED, "%s", why->data ? why->data : "writing failed");
    jox_text_free(why);
    return false;
}

bool jo_scene_step(JoScene *scene, JoError *error) {
    JOX_REQUIRE(scene && !scene->finished, false);
    JOX_GUARD (scene->heap, error)
        return false;
    jox_run_inputs(scene);
    jox_run_reload(scene);
    jox_run_events(scene);
    jox_run_sources(scene);
    jox_world_step(scene->world);
    jox_run_sinks(scene);
    jox_run_leavers(scene);
    const char *stalled = jox_lua_stalled(scene->lua);
    if (stalled) {
        jox_error(error, JO_FAILED,
                  "%s: its functions take far longer than their instructions explain (look-ups "
                  "among keys that collide, comparisons of long texts); the run was stopped",
                  stalled);
        return false;
    }
    return jox_run_tell_frame(scene, error) && jox_run_logged(scene, error);
}

bool jo_scene_finish(JoScene *scene, JoError *error) {
    JOX_REQUIRE(scene, false);
    JOX_GUARD (scene->heap, error)
        return false;
    if (scene->finished)
        return true;
    scene->finished = true;
    bool good = !scene->world || jox_run_tell_end(scene, error);
    return jox_run_end_log(scene, good ? error : NULL) && good;
}
