/* Reads places and regions of a scene. The kinds of places are rows of a table in geom/place.c. */
#include <string.h>

#include "base/assert.h"
#include "scene/scene_draft.h"

/* Reads the points of a place, as many as its kind has. */
void jox_key_read_place_points(const JoxReader *r, const JoxKey *key, const JoxYaml *node,
                               void *item) {
    JoxPlace *place = item;
    const JoxPlaceKindInfo *kind = &jox_place_kinds[place->kind];
    JOX_ASSERT(strcmp(kind->name, key->name) == 0);
    double v[2];
    if (kind->most_points == 0)
        return; /* a set: jox_resolve_place looks its members up */
    if (kind->most_points == 1) {
        if (!jox_key_read_vector(r, key, node, v, 2))
            return;
        place->points = jox_arena_take(r->arena, 1, sizeof *place->points);
        place->points[0] = jox_v2((float)v[0], (float)v[1]);
        place->count = 1;
    } else {
        place->points = kind->outline == JOX_OUTLINE_RING
                            ? jox_read_polygon(r, node, &place->count)
                            : jox_read_points(r, node, kind->least_points, &place->count);
    }
    if (place->points && place->count > kind->most_points)
        jox_scene_error(r, node, "bad-place", "A polyline is a queue or a wall",
                        "a %s has %u points", kind->name, kind->most_points);
}

/* Takes the circle round a point, where a group may stand, into the extent of the plan. */
static void widen_plan(const JoxReader *r, const JoxPlace *place) {
    const JoxV2 centre = jox_v2(place->centre.x, place->centre.y - r->placing->shift);
    const JoxV2 reach = jox_v2(place->radius, place->radius);
    jox_scene_position(r, jox_sub(centre, reach));
    jox_scene_position(r, jox_add(centre, reach));
}

bool jox_finish_place(const JoxReader *r, const JoxYaml *map, void *item, bool good) {
    JoxPlace *place = item;
    (void)r, (void)map, (void)good;
    if (place->points && place->count)
        jox_place_finish(place);
    if (place->points && place->count && jox_place_is_spot(place))
        widen_plan(r, place);
    return true; /* keep it if it is wrong, too: its name is known then */
}

/* Checks the name of the start line, which jox_resolve_place looks up. */
void jox_key_read_place_start(const JoxReader *r, const JoxKey *key, const JoxYaml *node,
                              void *item) {
    jox_key_read_scalar(r, key, node, "name");
    ((JoxPlace *)item)->start = -1;
}

static void resolve_start(const JoxReader *r, const JoxYaml *start, JoxPlace *place) {
    const JoxPlace *places = r->draft->scene->places;
    place->start = jox_scene_find_place(r, start);
    if (place->start >= 0 && !jox_place_is_line(&places[place->start]))
        jox_scene_error(r, start, "bad-place", NULL, "circuits start at a line");
}

static void resolve_members(const JoxReader *r, const JoxYaml *map, JoxPlace *place) {
    const JoxPlace *places = r->draft->scene->places;
    const JoxYaml *const *names;
    uint32_t count =
        jox_read_names(r, jox_yaml_get(map, jox_place_kinds[place->kind].name), &names);
    place->members = jox_arena_take(r->arena, count, sizeof *place->members);
    for (uint32_t n = 0; n < count; n++) {
        int32_t member = jox_scene_find_place(r, names[n]);
        if (member >= 0 && jox_place_is_set(&places[member]))
            jox_scene_error(r, names[n], "bad-place", NULL, "a set cannot hold another set");
        else if (member >= 0 && places[member].count > 0)
            place->members[place->member_count++] = member;
    }
    jox_place_finish_set(
        places, place,
        jox_arena_take(r->arena, JOX_PLACE_FOURS(place->member_count), sizeof *place->boxes));
    if (count == 0)
        jox_scene_error(r, map, "bad-place", "set: [NAME, NAME]", "a set names at least one place");
}

void jox_resolve_place(const JoxReader *r, const JoxYaml *map, void *item) {
    JoxPlace *place = item;
    const JoxYaml *start = jox_yaml_get(map, "start");
    JOX_ASSERT(place->start == -1);
    if (start && start->kind == JOX_YAML_SCALAR)
        resolve_start(r, start, place);
    if (jox_place_is_set(place))
        resolve_members(r, map, place);
}

void jox_key_read_regions(const JoxReader *r, const JoxKey *key, const JoxYaml *map, void *item) {
    JoxSceneSpec *s = item;
    if (!map || map->kind != JOX_YAML_MAP) {
        if (map)
            jox_scene_error(r, map, "bad-type", NULL, "%s maps names to polygons", key->name);
        return;
    }
    s->regions = jox_arena_take(r->arena, map->count, sizeof *s->regions);
    for (uint32_t i = 0; i < map->count; i++) {
        JoxSceneRegion *region = &s->regions[s->region_count];
        region->name = jox_arena_text(r->arena, map->keys[i]);
        jox_scene_check_name(r, map->key_positions[i], "region", region->name);
        region->points = jox_read_polygon(r, map->items[i], &region->count);
        s->region_count += region->points != NULL;
    }
    JOX_ASSERT(s->region_count <= map->count);
}
