/* The area that pictures, recordings and fields of a scene show. */
#include <math.h>

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
    const JoxWalls *walls = &world->model.all_walls;
    for (uint32_t i = 0; i < walls->count + world->state.agents.count; i++) {
        JoxV2 p = i < walls->count ? walls->vertices[i].point
                                   : (JoxV2){world->state.agents.x[i - walls->count],
                                             world->state.agents.y[i - walls->count]};
        *low = (JoxV2){jox_minf(low->x, p.x), jox_minf(low->y, p.y)};
        *high = (JoxV2){jox_maxf(high->x, p.x), jox_maxf(high->y, p.y)};
    }
    if (low->x > high->x)
        *low = *high = (JoxV2){0.0f, 0.0f};
    *low = jox_sub(*low, (JoxV2){MARGIN, MARGIN});
    *high = jox_add(*high, (JoxV2){MARGIN, MARGIN});
}
