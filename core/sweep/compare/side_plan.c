/* Reads the plan of a side from JSON, item by item. Files may come from elsewhere, so numbers are
   bounded and parts that make no sense are left out. */
#include "sweep/compare/side_plan.h"

#include <math.h>
#include <string.h>

#include "base/format/json.h"
#include "base/mem.h"

enum { MOST_POINTS = 100000 };

typedef enum PartOf { WALLS, PLACES, PROBES, BODIES, STOREYS, STAIRS, NOTHING } PartOf;
static const char *const LISTS[NOTHING] = {"walls.",  "places.",  "probes.",
                                           "bodies.", "storeys.", "stairs."};

/* The wall, place, probe or body that is being read. */
typedef struct Part {
    PartOf of;
    char *name, *kind;
    bool solid, closed, open, high;
    float radius;
    float height, width, rise;        /* m: of a storey, of a stair */
    uint32_t form, way, lower, upper; /* of a stair */
    float *numbers, *landings; /* coordinates, m: x, y, x, y, ...; of a stair: from, to, ... */
    size_t count, capacity, landing_count, landing_capacity;
} Part;

typedef struct Reading {
    JoxSidePlan *plan;
    float area[4], sheets[2]; /* sheets: origin and pitch, m */
    uint32_t corners, sheet_numbers;
    size_t storey_capacity, stair_capacity;
    size_t place_capacity, probe_capacity, points; /* points: read so far, of all parts */
    Part part;
} Reading;

static void add_plan_wall(Reading *r, const JoxV2 *points, uint32_t count) {
    const Part *part = &r->part;
    JoxSidePlan *plan = r->plan;
    const uint32_t first = plan->walls.ring_count;
    if (part->solid && count >= 3)
        jox_walls_add_solid(&plan->walls, points, count, INFINITY);
    else if (!part->solid && count >= (part->closed ? 3u : 2u))
        jox_walls_add_polyline(&plan->walls, points, count, part->closed, INFINITY);
    if (part->name && *part->name)
        jox_walls_name(&plan->walls, first, part->name, part->open);
}

static void add_plan_place(Reading *r, const JoxV2 *points, uint32_t count) {
    const Part *part = &r->part;
    JoxSidePlan *plan = r->plan;
    uint32_t kind = 0;
    while (kind < jox_place_kind_count &&
           (!part->kind || strcmp(part->kind, jox_place_kinds[kind].name) != 0))
        kind++;
    if (kind == jox_place_kind_count || jox_place_kinds[kind].form == JOX_FORM_SET ||
        count < jox_place_kinds[kind].least_points || count > jox_place_kinds[kind].most_points)
        return;
    JOX_RESERVE(plan->places, r->place_capacity, plan->place_count + 1);
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

static void add_plan_probe(Reading *r, const JoxV2 *points, uint32_t count) {
    static const struct {
        const char *name;
        JoxProbeKind kind;
        uint32_t least, most; /* allowed numbers of points */
    } KINDS[] = {{"flow", JOX_PROBE_FLOW, 2, 2},
                 {"measure", JOX_PROBE_MEASURE, 3, MOST_POINTS},
                 {"transit", JOX_PROBE_TRANSIT, 4, 4}};
    JoxSidePlan *plan = r->plan;
    for (size_t k = 0; r->part.kind && k < sizeof KINDS / sizeof *KINDS; k++) {
        if (strcmp(r->part.kind, KINDS[k].name) != 0 || count < KINDS[k].least ||
            count > KINDS[k].most)
            continue;
        JOX_RESERVE(plan->probes, r->probe_capacity, plan->probe_count + 1);
        plan->probes[plan->probe_count++] =
            jox_probe_create(&(JoxProbeDef){.name = r->part.name ? r->part.name : "",
                                            .kind = KINDS[k].kind,
                                            .until = INFINITY,
                                            .points = points,
                                            .count = count,
                                            .every = 1.0,
                                            .cutoff = 1.0});
    }
}

static void add_plan_body(Reading *r, const JoxV2 *points, uint32_t count) {
    const Part *part = &r->part;
    JoxDrawnBodies *bodies = &r->plan->bodies;
    if (count == 2 || count > JOX_OUTLINE_POINTS)
        return;
    JOX_RESERVE(bodies->items, bodies->capacity, bodies->count + 1);
    JoxDrawnBody *body = &bodies->items[bodies->count++];
    *body = (JoxDrawnBody){.at = points[0], .radius = part->radius, .high = part->high};
    if (count > 1)
        memcpy(body->ring, points, sizeof(JoxV2) * count);
    body->count = count > 1 ? count : 0;
}

static void add_plan_storey(Reading *r) {
    JoxStoreys *s = &r->plan->storeys;
    const Part *part = &r->part;
    if (s->storey_count == JOX_MOST_STOREYS ||
        (s->storey_count && !(part->height > s->storeys[s->storey_count - 1].height)))
        return;
    JOX_RESERVE(s->storeys, r->storey_capacity, s->storey_count + 1);
    s->storeys[s->storey_count++] =
        (JoxStorey){jox_strdup(part->name ? part->name : ""), part->height};
}

static void add_plan_stair(Reading *r, const JoxV2 *points, uint32_t count) {
    JoxStoreys *s = &r->plan->storeys;
    const Part *part = &r->part;
    const uint32_t landings = (uint32_t)(part->landing_count / 2);
    JoxStair stair = {.name = jox_strdup(part->name ? part->name : ""),
                      .kind = (JoxStairKind)part->form,
                      .way = (JoxStairWay)part->way,
                      .lower = part->lower,
                      .upper = part->upper,
                      .width = part->width,
                      .rise = part->rise,
                      .path = jox_alloc(count, sizeof *stair.path),
                      .path_count = count,
                      .landings = jox_alloc((size_t)landings + 1, sizeof *stair.landings),
                      .landing_count = landings};
    memcpy(stair.path, points, sizeof *points * count);
    for (uint32_t k = 0; k < landings; k++)
        stair.landings[k] = (JoxLanding){part->landings[2 * k], part->landings[2 * k + 1]};
    JOX_RESERVE(s->stairs, r->stair_capacity, s->stair_count + 1);
    s->stairs[s->stair_count++] = stair;
}

/* Lays the storeys out that were read; leaves none if they make no sense. */
static void lay_plan_storeys_out(Reading *r) {
    JoxStoreys *s = &r->plan->storeys;
    bool sound = r->sheet_numbers == 2 && r->sheets[1] > 1.0f && s->storey_count > 1;
    for (uint32_t k = 0; k < s->stair_count; k++) {
        const JoxStair *stair = &s->stairs[k];
        sound = sound && stair->lower <= stair->upper && stair->upper < s->storey_count &&
                stair->kind <= JOX_STAIR_ESCALATOR && stair->way <= JOX_STAIR_DOWN &&
                jox_stair_is_sound(stair);
    }
    if (sound)
        jox_storeys_lay_out_again(s, r->sheets[0], r->sheets[1]);
    else
        jox_storeys_free(s);
}

/* Adds the part that was read to the plan, and begins an empty one. */
static void finish_part(Reading *r) {
    static void (*const ADD[STOREYS])(Reading *, const JoxV2 *, uint32_t) = {
        add_plan_wall, add_plan_place, add_plan_probe, add_plan_body};
    Part *part = &r->part;
    const uint32_t count = (uint32_t)(part->count / 2);
    JoxV2 *points = jox_alloc(count + 1, sizeof *points);
    for (uint32_t p = 0; p < count; p++)
        points[p] = (JoxV2){part->numbers[2 * p], part->numbers[2 * p + 1]};
    if (part->of == STOREYS)
        add_plan_storey(r);
    else if (part->of == STAIRS && count >= 2 && r->plan->storeys.stair_count < JOX_MOST_STAIRS)
        add_plan_stair(r, points, count);
    else if (count && part->of < STOREYS)
        ADD[part->of](r, points, count);
    jox_free(points);
    jox_free(part->name);
    jox_free(part->kind);
    jox_free(part->numbers);
    jox_free(part->landings);
    *part = (Part){.of = NOTHING};
}

/* Reads a number of a storey or stair. */
static void read_stair_number(Part *part, const char *key, double number) {
    const struct {
        const char *key;
        float *length;
        uint32_t *index;
    } numbers[] = {{"height", &part->height, NULL}, {"width", &part->width, NULL},
                   {"rise", &part->rise, NULL},     {"form", NULL, &part->form},
                   {"way", NULL, &part->way},       {"lower", NULL, &part->lower},
                   {"upper", NULL, &part->upper}};
    for (size_t n = 0; n < sizeof numbers / sizeof *numbers; n++) {
        if (strcmp(key, numbers[n].key) != 0)
            continue;
        if (numbers[n].length)
            *numbers[n].length = (float)number;
        else
            *numbers[n].index = number >= 0.0 ? (uint32_t)number : UINT32_MAX;
    }
}

static void read_part(Reading *r, const JoxJsonItem *item) {
    Part *part = &r->part;
    const char *key = item->key;
    if (item->kind == JOX_JSON_NUMBER && !key && fabs(item->number) < 1e6 &&
        strstr(item->path, ".landings.") && r->points++ < MOST_POINTS) {
        JOX_RESERVE(part->landings, part->landing_capacity, part->landing_count + 1);
        part->landings[part->landing_count++] = (float)item->number;
    } else if (item->kind == JOX_JSON_NUMBER && !key && fabs(item->number) < 1e6 &&
               r->points++ < MOST_POINTS) {
        JOX_RESERVE(part->numbers, part->capacity, part->count + 1);
        part->numbers[part->count++] = (float)item->number;
    } else if (item->kind == JOX_JSON_TEXT && key && !strcmp(key, "name") && !part->name) {
        part->name = jox_strdup(item->text);
    } else if (item->kind == JOX_JSON_TEXT && key && !strcmp(key, "kind") && !part->kind) {
        part->kind = jox_strdup(item->text);
    } else if (item->kind == JOX_JSON_NUMBER && key && !strcmp(key, "radius")) {
        part->radius = (float)item->number;
    } else if (item->kind == JOX_JSON_NUMBER && key && fabs(item->number) < 1e6) {
        read_stair_number(part, key, item->number);
    } else if (item->kind == JOX_JSON_BOOL && key) {
        const bool yes = item->number != 0;
        part->solid = !strcmp(key, "solid") ? yes : part->solid;
        part->closed = !strcmp(key, "closed") ? yes : part->closed;
        part->open = !strcmp(key, "open") ? yes : part->open;
        part->high = !strcmp(key, "high") ? yes : part->high;
    }
}

/* Reads a text of the title block. */
static void read_plan_report(JoxSceneReport *report, const JoxJsonItem *item) {
    const struct {
        const char *key;
        char **text;
    } texts[] = {{"author", &report->author},
                 {"organisation", &report->organisation},
                 {"project", &report->project},
                 {"reference", &report->reference},
                 {"checked_by", &report->checked_by},
                 {"approved_by", &report->approved_by},
                 {"date", &report->date}};
    for (size_t t = 0; item->key && t < sizeof texts / sizeof *texts; t++)
        if (strcmp(item->key, texts[t].key) == 0 && !*texts[t].text)
            *texts[t].text = jox_strdup(item->text);
}

/* Takes an item of the JSON: the area, the beginning of a part, or a value of the part. */
static bool read_item(void *context, const JoxJsonItem *item) {
    Reading *r = context;
    if (item->depth == 2 && item->kind == JOX_JSON_NUMBER && r->corners < 4 &&
        strncmp(item->path, "area.", 5) == 0)
        r->area[r->corners++] = (float)item->number;
    if (item->depth == 2 && item->kind == JOX_JSON_NUMBER && r->sheet_numbers < 2 &&
        strncmp(item->path, "sheets.", 7) == 0)
        r->sheets[r->sheet_numbers++] = (float)item->number;
    if (item->depth == 2 && item->kind == JOX_JSON_TEXT && strncmp(item->path, "report.", 7) == 0)
        read_plan_report(&r->plan->report, item);
    if (item->depth == 2 && item->kind == JOX_JSON_OBJECT) {
        finish_part(r);
        for (int of = 0; of < NOTHING; of++)
            if (strncmp(item->path, LISTS[of], strlen(LISTS[of])) == 0)
                r->part.of = (PartOf)of;
    }
    if (item->depth > 2)
        read_part(r, item);
    return true;
}

bool jox_side_plan_read(JoxSidePlan *plan, const char *json) {
    Reading r = {.plan = plan, .part = {.of = NOTHING}};
    *plan = (JoxSidePlan){0};
    const bool good = jox_json_read(json, jox_json_own_files, read_item, &r);
    finish_part(&r);
    lay_plan_storeys_out(&r);
    plan->low = (JoxV2){r.area[0], r.area[1]};
    plan->high = (JoxV2){r.area[2], r.area[3]};
    if (jox_has_storeys(&plan->storeys)) { /* as far as the picture of each shows it */
        plan->storeys.low = plan->low.y;
        plan->storeys.high = plan->high.y;
    }
    return good && r.corners == 4 && plan->high.x > plan->low.x && plan->high.y > plan->low.y &&
           plan->high.x - plan->low.x < 1e5f && plan->high.y - plan->low.y < 1e5f;
}

void jox_side_plan_free(JoxSidePlan *plan) {
    for (uint32_t p = 0; p < plan->place_count; p++)
        jox_place_free(&plan->places[p]);
    for (uint32_t p = 0; p < plan->probe_count; p++)
        jox_probe_free(plan->probes[p]);
    jox_free(plan->report.author);
    jox_free(plan->report.organisation);
    jox_free(plan->report.project);
    jox_free(plan->report.reference);
    jox_free(plan->report.checked_by);
    jox_free(plan->report.approved_by);
    jox_free(plan->report.date);
    jox_free(plan->places);
    jox_free(plan->probes);
    jox_free(plan->bodies.items);
    jox_walls_free(&plan->walls);
    jox_storeys_free(&plan->storeys);
}
