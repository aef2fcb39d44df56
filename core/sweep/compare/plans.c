/* Plans side by side: the greatest density of each place, mean over the runs of a side. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/format/json.h"
#include "base/mem.h"
#include "picture/plot.h"
#include "sweep/compare/compare.h"

enum { MOST_POINTS = 100000 };

/* A wall or place that is being read. */
typedef struct Part {
    char *name, *kind;
    bool solid, closed, open;
    float radius;
    float *numbers; /* x, y, ... */
    size_t count, capacity;
} Part;

typedef struct Plan {
    JoxV2 low, high;
    float area[4];
    uint32_t corners;
    JoxWalls walls;
    JoxPlace *places;
    uint32_t place_count;
    size_t place_capacity;
    Part part;
    bool is_wall;
    size_t points; /* of all */
} Plan;

static void add_wall(Plan *plan, const JoxV2 *points, uint32_t count) {
    const Part *part = &plan->part;
    const uint32_t first = plan->walls.ring_count;
    if (part->solid && count >= 3)
        jox_walls_add_solid(&plan->walls, points, count, INFINITY);
    else if (!part->solid && count >= (part->closed ? 3u : 2u))
        jox_walls_add_polyline(&plan->walls, points, count, part->closed, INFINITY);
    if (part->name && *part->name)
        jox_walls_name(&plan->walls, first, part->name, part->open);
}

static void add_place(Plan *plan, const JoxV2 *points, uint32_t count) {
    const Part *part = &plan->part;
    int kind = 0;
    while (kind < JOX_PLACE_KINDS &&
           (!part->kind || strcmp(part->kind, jox_place_kinds[kind].name) != 0))
        kind++;
    if (kind == JOX_PLACE_KINDS || kind == JOX_PLACE_SET ||
        count < jox_place_kinds[kind].least_points || count > jox_place_kinds[kind].most_points)
        return;
    JOX_RESERVE(plan->places, plan->place_capacity, plan->place_count + 1);
    JoxPlace *place = &plan->places[plan->place_count++];
    *place = (JoxPlace){.name = jox_strdup(part->name ? part->name : ""),
                        .kind = (JoxPlaceKind)kind,
                        .points = jox_alloc(count, sizeof(JoxV2)),
                        .count = count,
                        .radius = part->radius,
                        .start = -1};
    memcpy(place->points, points, sizeof(JoxV2) * count);
    jox_place_finish(place);
}

/* What was read of a wall or place becomes one. */
static void end_part(Plan *plan) {
    Part *part = &plan->part;
    const uint32_t count = (uint32_t)(part->count / 2);
    JoxV2 *points = jox_alloc(count + 1, sizeof *points);
    for (uint32_t p = 0; p < count; p++)
        points[p] = (JoxV2){part->numbers[2 * p], part->numbers[2 * p + 1]};
    if (count && plan->is_wall)
        add_wall(plan, points, count);
    else if (count)
        add_place(plan, points, count);
    jox_free(points);
    jox_free(part->name);
    jox_free(part->kind);
    jox_free(part->numbers);
    *part = (Part){0};
}

static void read_part(Plan *plan, const JoxJsonItem *item) {
    Part *part = &plan->part;
    const char *key = item->key;
    if (item->kind == JOX_JSON_NUMBER && !key && fabs(item->number) < 1e6 &&
        plan->points++ < MOST_POINTS) {
        JOX_RESERVE(part->numbers, part->capacity, part->count + 1);
        part->numbers[part->count++] = (float)item->number;
    } else if (item->kind == JOX_JSON_TEXT && key && !strcmp(key, "name") && !part->name) {
        part->name = jox_strdup(item->text);
    } else if (item->kind == JOX_JSON_TEXT && key && !strcmp(key, "kind") && !part->kind) {
        part->kind = jox_strdup(item->text);
    } else if (item->kind == JOX_JSON_NUMBER && key && !strcmp(key, "radius")) {
        part->radius = (float)item->number;
    } else if (item->kind == JOX_JSON_BOOL && key) {
        const bool yes = item->number != 0;
        part->solid = !strcmp(key, "solid") ? yes : part->solid;
        part->closed = !strcmp(key, "closed") ? yes : part->closed;
        part->open = !strcmp(key, "open") ? yes : part->open;
    }
}

static bool read_item(void *context, const JoxJsonItem *item) {
    Plan *plan = context;
    if (item->depth == 2 && item->kind == JOX_JSON_NUMBER && plan->corners < 4 &&
        strncmp(item->path, "area.", 5) == 0)
        plan->area[plan->corners++] = (float)item->number;
    if (item->depth == 2 && item->kind == JOX_JSON_OBJECT) {
        end_part(plan);
        plan->is_wall = strncmp(item->path, "walls.", 6) == 0;
    }
    if (item->depth > 2)
        read_part(plan, item);
    return true;
}

static bool read_plan(Plan *plan, const char *json) {
    const bool good = jox_json_read(json, jox_json_own_files, read_item, plan);
    end_part(plan);
    plan->low = (JoxV2){plan->area[0], plan->area[1]};
    plan->high = (JoxV2){plan->area[2], plan->area[3]};
    return good && plan->corners == 4 && plan->high.x > plan->low.x && plan->high.y > plan->low.y &&
           plan->high.x - plan->low.x < 1e5f && plan->high.y - plan->low.y < 1e5f;
}

static void free_plan(Plan *plan) {
    for (uint32_t p = 0; p < plan->place_count; p++)
        jox_place_free(&plan->places[p]);
    jox_free(plan->places);
    jox_walls_free(&plan->walls);
}

/* ---- drawing ---- */

static bool draw(const JoxComparison *c, uint32_t s, const Plan *plan, float most, JoxText *why) {
    const JoxSide *side = &c->sides.items[s];
    const JoxSweepField *field = &side->field;
    JoxDensity grid = {.low = {(float)field->low_x, (float)field->low_y},
                       .cell = (float)field->cell,
                       .columns = field->columns,
                       .rows = field->rows};
    double end = 0; /* of the curves: until then it was the greatest */
    for (uint32_t k = 0; k < side->curve_count; k++)
        if (side->curves[k].count)
            end = fmax(end, side->curves[k].points[side->curves[k].count - 1].time);
    const JoxFrame nobody = {.time = end, .walls = &plan->walls};
    const JoxPicture picture = {.title = side->name,
                                .frame = &nobody,
                                .walls = &plan->walls,
                                .places = plan->places,
                                .place_count = plan->place_count,
                                .grid = field->values ? &grid : NULL,
                                .field = field->values,
                                .floor = JOX_SHOW_DENSITY,
                                .floor_most = most,
                                .low = plan->low,
                                .high = plan->high};
    uint32_t width, height;
    bool good = true;
    jox_draw_size(plan->low, plan->high, &width, &height);
    for (int image = 0; good && image < 1 + jox_canvas_has_images(); image++) {
        JoxText path = {0};
        jox_text_printf(&path, "%s/plan-%u.%s", c->def->out, s + 1, image ? "png" : "svg");
        JoxCanvas *canvas = image ? jox_canvas_image(width, height) : jox_canvas_svg(width, height);
        jox_draw(canvas, &picture);
        good = jox_canvas_write(canvas, path.data, why);
        jox_canvas_free(canvas);
        jox_text_free(&path);
    }
    return good;
}

/* One scale for all: a whole number of people per m2. */
static float greatest(const JoxComparison *c) {
    float most = 1;
    for (uint32_t s = 0; s < c->sides.count; s++) {
        const JoxSweepField *f = &c->sides.items[s].field;
        for (size_t k = 0; f->values && k < (size_t)f->columns * f->rows; k++)
            if (f->values[k] > most && f->values[k] < 1000)
                most = f->values[k];
    }
    return ceilf(most);
}

bool jox_compare_plans(const JoxComparison *c, JoxText *why) {
    const float most = greatest(c);
    bool good = true;
    for (uint32_t s = 0; good && s < c->sides.count; s++) {
        Plan plan = {0};
        if (c->sides.items[s].plan && read_plan(&plan, c->sides.items[s].plan))
            good = draw(c, s, &plan, most, why);
        free_plan(&plan);
    }
    return good;
}
