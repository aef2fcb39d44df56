/* Ways round walls: a distance field for each place that some agent asks its way to, made before
   the step after it was first asked for. */
#include <math.h>

#include "base/mem.h"
#include "world/world.h"

enum { MOST_FIELDS = 64 };
static const float CELL = 0.125f;     /* m */
static const float CLEARANCE = 0.15f; /* m: half of a person who turns sideways */
static const float MARGIN = 3.0f;     /* m about all walls and agents */

static void area(const JoWorld *w, JoxV2 *low, JoxV2 *high) {
    *low = (JoxV2){INFINITY, INFINITY};
    *high = (JoxV2){-INFINITY, -INFINITY};
    for (uint32_t i = 0; i < w->walls.count + w->agents.count; i++) {
        JoxV2 p = i < w->walls.count
                      ? w->walls.vertices[i].point
                      : (JoxV2){w->agents.x[i - w->walls.count], w->agents.y[i - w->walls.count]};
        *low = (JoxV2){jox_minf(low->x, p.x), jox_minf(low->y, p.y)};
        *high = (JoxV2){jox_maxf(high->x, p.x), jox_maxf(high->y, p.y)};
    }
    *low = jox_sub(*low, (JoxV2){MARGIN, MARGIN});
    *high = jox_add(*high, (JoxV2){MARGIN, MARGIN});
}

void jox_world_drop_ways(JoWorld *w) {
    for (uint32_t p = 0; p < w->field_capacity; p++)
        jox_field_free(w->fields[p]);
    jox_free(w->fields);
    jox_free(w->wanted);
    w->fields = NULL;
    w->wanted = NULL;
    w->field_capacity = w->field_count = 0;
}

void jox_world_make_ways(JoWorld *w) {
    if (w->place_count > w->field_capacity) {
        w->fields = jox_realloc(w->fields, w->place_count, sizeof(JoxField *));
        w->wanted = jox_realloc(w->wanted, w->place_count, 1);
        for (uint32_t p = w->field_capacity; p < w->place_count; p++) {
            w->fields[p] = NULL;
            w->wanted[p] = 0;
        }
        w->field_capacity = w->place_count;
    }
    for (uint32_t p = 0; p < w->place_count; p++) {
        if (!w->wanted[p])
            continue;
        w->wanted[p] = 0;
        if (w->fields[p] || w->field_count == MOST_FIELDS)
            continue;
        JoxV2 low, high;
        area(w, &low, &high);
        w->fields[p] = jox_field_create(&w->walls, w->places, p, low, high, CELL, CLEARANCE);
        w->field_count++;
    }
    w->mind.fields = w->fields;
    w->mind.wanted = w->wanted;
}
