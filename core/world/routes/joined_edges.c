#include "world/routes/joined_edges.h"

#include <string.h>

#include "base/assert.h"
#include "base/mem.h"
#include "geom/wall_images.h"

bool jox_routes_lead_over_edges(const JoxAgents *a, const JoxWalls *walls) {
    return walls->count > 0 && (a->period.x > 0.0f || a->period.y > 0.0f);
}

void jox_routes_add_wall_images(const JoxAgents *a, JoxWalls *walls) {
    jox_wall_images_add(walls, a->origin, a->period, a->period);
}

/* Returns whether a place lies between two joined edges, from `low` on. */
static bool lies_between_edges(float from, float to, float reach, float low, float period) {
    return from - reach >= low && to + reach <= low + period;
}

static void append_image(JoxPlace *images, uint32_t *count, const JoxPlace *place, JoxV2 shift) {
    JoxPlace *image = &images[(*count)++];
    jox_place_copy(image, place);
    for (uint32_t k = 0; k < image->count; k++)
        image->points[k] = jox_add(image->points[k], shift);
    jox_place_finish(image);
}

/* Appends the images of a place: as many as eight. */
static void append_images(const JoxAgents *a, JoxPlace *images, uint32_t *count,
                          const JoxPlace *place) {
    const float reach = jox_place_radius(place);
    const int x = a->period.x > 0.0f &&
                  lies_between_edges(place->low.x, place->high.x, reach, a->origin.x, a->period.x);
    const int y = a->period.y > 0.0f &&
                  lies_between_edges(place->low.y, place->high.y, reach, a->origin.y, a->period.y);
    for (int column = -x; column <= x; column++)
        for (int row = -y; row <= y; row++)
            if (column || row)
                append_image(images, count, place,
                             (JoxV2){(float)column * a->period.x, (float)row * a->period.y});
}

void jox_routes_add_goal_images(const JoxAgents *a, JoxPlace **places, uint32_t *count) {
    const bool set = jox_place_is_set(&(*places)[0]);
    const uint32_t given = *count, first = set ? 1 : 0;
    JoxPlace *all = jox_alloc(1 + 9 * (size_t)given, sizeof *all);
    uint32_t n = 1;
    for (uint32_t p = first; p < given; p++)
        all[n++] = (*places)[p];
    for (uint32_t p = 1; p <= given - first; p++)
        append_images(a, all, &n, &all[p]);
    JoxPlace goal = {.name = jox_strdup((*places)[0].name),
                     .points = jox_alloc(1, sizeof *goal.points)};
    jox_place_make_set(&goal, 1, n - 1);
    jox_place_finish_set(all, &goal, jox_alloc(JOX_PLACE_FOURS(n - 1) + 1, sizeof *goal.boxes));
    all[0] = goal;
    if (set)
        jox_place_free(&(*places)[0]);
    jox_free(*places);
    *places = all;
    *count = n;
    JOX_ASSERT(n <= 1 + 9 * given);
}

void jox_routes_add_crowd_images(const JoxAgents *a, JoxFieldCrowd *crowd) {
    const int x = a->period.x > 0.0f, y = a->period.y > 0.0f;
    const uint32_t given = crowd->count;
    crowd->at = jox_realloc(crowd->at, 9 * (size_t)given + 1, sizeof *crowd->at);
    crowd->held = jox_realloc(crowd->held, 9 * (size_t)given + 1, sizeof *crowd->held);
    for (int column = -x; column <= x; column++)
        for (int row = -y; row <= y; row++)
            for (uint32_t k = 0; k < given && (column || row); k++) {
                const JoxV2 shift = {(float)column * a->period.x, (float)row * a->period.y};
                crowd->at[crowd->count] = jox_add(crowd->at[k], shift);
                crowd->held[crowd->count++] = crowd->held[k];
            }
    JOX_ASSERT(crowd->count <= 9 * given);
}

void jox_routes_box_over_edges(const JoxAgents *a, float spare, JoxV2 *low, JoxV2 *high) {
    if (a->period.x > 0.0f) {
        low->x = a->origin.x - a->period.x + spare;
        high->x = a->origin.x + 2.0f * a->period.x - spare;
    }
    if (a->period.y > 0.0f) {
        low->y = a->origin.y - a->period.y + spare;
        high->y = a->origin.y + 2.0f * a->period.y - spare;
    }
}
