/* From a tree of YAML to a JoxSceneSpec. Everything wrong is reported, not only the first. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/elementary.h"
#include "base/mem.h"
#include "base/overlay.h"
#include "base/path.h"
#include "scene/internal.h"

static const double DEGREE = 3.14159265358979323846 / 180.0;

int32_t jox_load_place(const JoxLoad *l, const JoxYaml *name) {
    const char *names[512];
    uint32_t count = l->scene->place_count;
    int place = jox_place_find(l->scene->places, count, name->text);
    if (place >= 0)
        return place;
    for (uint32_t i = 0; i < count && i < 512; i++)
        names[i] = l->scene->places[i].name;
    jox_scene_error(&l->reader, name, "unknown-place",
                    jox_scene_suggest(&l->reader, name->text, names, count < 512 ? count : 512),
                    "there is no place '%.60s'", name->text);
    return -1;
}

int32_t jox_load_group(const JoxLoad *l, const JoxYaml *name) {
    const char *names[256];
    uint32_t count = l->scene->group_count;
    for (uint32_t i = 0; i < count && i < 256; i++) {
        names[i] = l->scene->groups[i].name;
        if (strcmp(names[i], name->text) == 0)
            return (int32_t)i;
    }
    jox_scene_error(&l->reader, name, "unknown-group",
                    jox_scene_suggest(&l->reader, name->text, names, count < 256 ? count : 256),
                    "there is no group '%.60s'", name->text);
    return -1;
}

/* A map's value for a key that must be a name, or NULL (with an error if it is something else). */
static const JoxYaml *name_at(const JoxLoad *l, const JoxYaml *map, const char *key) {
    const JoxYaml *node = jox_yaml_get(map, key);
    if (node && node->kind != JOX_YAML_SCALAR)
        jox_scene_error(&l->reader, node, "bad-type", NULL, "%s must be a name", key);
    return node && node->kind == JOX_YAML_SCALAR ? node : NULL;
}

/* ---- places ---- */

JoxV2 *jox_load_ring(const JoxLoad *l, const JoxYaml *node, uint32_t *count) {
    JoxV2 *ring = jox_read_points(&l->reader, node, 3, count);
    uint32_t a, b;
    if (!ring)
        return NULL;
    if (*count <= 2000 && jox_polygon_self_crosses(ring, *count, &a, &b)) {
        jox_scene_error(&l->reader, node->items[b], "self-crossing", "Put the corners in order",
                        "this polygon crosses itself: the edges from corner %u and corner %u meet",
                        a + 1, b + 1);
        *count = 0;
        return NULL;
    }
    double area = jox_polygon_area(ring, *count);
    if (fabs(area) < 1e-6) {
        jox_scene_error(&l->reader, node, "no-area", NULL, "this polygon encloses no area");
        *count = 0;
        return NULL;
    }
    for (uint32_t i = 0; area < 0 && i < *count / 2; i++) { /* counter-clockwise from here on */
        JoxV2 swap = ring[i];
        ring[i] = ring[*count - 1 - i];
        ring[*count - 1 - i] = swap;
    }
    return ring;
}

static void read_place(const JoxLoad *l, const JoxYaml *map, JoxPlace *place) {
    static const char *const KINDS[] = {"point", "line", "polygon", "queue", "set"};
    const JoxYaml *found = NULL;
    int kinds = 0;
    if (!jox_keys_check(&l->reader, map, "place"))
        return;
    for (int k = 0; k < 5; k++) {
        const JoxYaml *node = jox_yaml_get(map, KINDS[k]);
        if (!node)
            continue;
        kinds++;
        found = node;
        place->kind = (JoxPlaceKind)k;
    }
    if (kinds != 1) {
        jox_scene_error(&l->reader, map, "bad-place", NULL,
                        "a place has one of point, line, polygon, queue and set");
        return;
    }
    place->start = -1;
    place->radius = (float)jox_key_number(&l->reader, map, "place", "radius");
    place->spacing = (float)jox_key_number(&l->reader, map, "place", "spacing");
    double v[2];
    if (place->kind == JOX_PLACE_POINT) {
        if (jox_key_vector(&l->reader, map, "place", "point", v, 2)) {
            place->points = jox_arena_take(l->reader.arena, 1, sizeof *place->points);
            place->points[0] = (JoxV2){(float)v[0], (float)v[1]};
            place->count = 1;
        }
    } else if (place->kind == JOX_PLACE_POLYGON) {
        place->points = jox_load_ring(l, found, &place->count);
    } else if (place->kind != JOX_PLACE_SET) {
        place->points = jox_read_points(&l->reader, found, 2, &place->count);
        if (place->points && place->kind == JOX_PLACE_LINE && place->count != 2)
            jox_scene_error(&l->reader, found, "bad-place", "A polyline is a queue or a wall",
                            "a line has two points");
    }
    if (place->points && place->count)
        jox_place_finish(place);
}

static void link_places(const JoxLoad *l, const JoxYaml *map) {
    for (uint32_t i = 0; i < l->scene->place_count; i++) {
        JoxPlace *place = &l->scene->places[i];
        const JoxYaml *start = name_at(l, map->items[i], "start"), *const * names;
        if (start)
            place->start = jox_load_place(l, start);
        if (place->start >= 0 && l->scene->places[place->start].kind != JOX_PLACE_LINE)
            jox_scene_error(&l->reader, start, "bad-place", NULL, "circuits start at a line");
        if (place->kind != JOX_PLACE_SET)
            continue;
        uint32_t count = jox_read_names(&l->reader, jox_yaml_get(map->items[i], "set"), &names);
        place->members = jox_arena_take(l->reader.arena, count, sizeof *place->members);
        for (uint32_t n = 0; n < count; n++) {
            int32_t member = jox_load_place(l, names[n]);
            if (member >= 0 && l->scene->places[member].kind == JOX_PLACE_SET)
                jox_scene_error(&l->reader, names[n], "bad-place", NULL,
                                "a set cannot hold another set");
            else if (member >= 0 && l->scene->places[member].count > 0)
                place->members[place->member_count++] = member;
        }
        if (count == 0)
            jox_scene_error(&l->reader, map->items[i], "bad-place", "set: [NAME, NAME]",
                            "a set names at least one place");
    }
}

static void read_places(JoxLoad *l, const JoxYaml *map) {
    if (!map || map->kind != JOX_YAML_MAP) {
        if (map)
            jox_scene_error(&l->reader, map, "bad-type", NULL, "places maps names to places");
        return;
    }
    l->scene->places = jox_arena_take(l->reader.arena, map->count, sizeof *l->scene->places);
    l->scene->place_count = map->count;
    for (uint32_t i = 0; i < map->count; i++) {
        JoxPlace *place = &l->scene->places[i];
        place->name = jox_arena_text(l->reader.arena, map->keys[i]);
        jox_scene_name(&l->reader, map->key_positions[i], "place", place->name);
        place->start = -1;
        read_place(l, map->items[i], place);
    }
    link_places(l, map);
}

static void read_regions(JoxLoad *l, const JoxYaml *map) {
    if (!map || map->kind != JOX_YAML_MAP) {
        if (map)
            jox_scene_error(&l->reader, map, "bad-type", NULL, "regions maps names to polygons");
        return;
    }
    l->scene->regions = jox_arena_take(l->reader.arena, map->count, sizeof *l->scene->regions);
    for (uint32_t i = 0; i < map->count; i++) {
        JoxSceneRegion *region = &l->scene->regions[l->scene->region_count];
        region->name = jox_arena_text(l->reader.arena, map->keys[i]);
        jox_scene_name(&l->reader, map->key_positions[i], "region", region->name);
        region->points = jox_load_ring(l, map->items[i], &region->count);
        l->scene->region_count += region->points != NULL;
    }
}

/* ---- groups ---- */

/* The behaviour's file: beside the scene, in ../behaviours, or installed; NULL with an error. */
static char *find_behaviour(const JoxLoad *l, const char *name, JoxPosition position) {
    JoxArena *arena = l->reader.arena;
    /* Overrides are of no file: the scene's folder is meant. */
    const char *from = strcmp(position.file, JOX_LOAD_OVERRIDE) ? position.file : l->scene->path;
    char path[JOX_LONGEST_PATH], installed[JOX_LONGEST_PATH];
    const char *const folders[] = {"", "../behaviours/", installed, NULL};
    snprintf(installed, sizeof installed, "%s/behaviours/", l->datadir ? l->datadir : JOX_DATADIR);
    if (l->options && jox_mod_find(l->options->mods, l->options->mod_count, name, path))
        return jox_arena_text(arena, path);
    if (jox_path_find(from, name, ".lua", folders, path)) {
        jox_path_clean(path);
        return jox_arena_text(arena, path);
    }
    jox_diag_error(l->reader.diagnostics, position, "missing-file",
                   "Looked beside the scene, in ../behaviours and in the installed ones",
                   "there is no behaviour '%.200s'", name);
    return NULL;
}

static void read_mix(const JoxLoad *l, const JoxYaml *map, JoxGroup *group) {
    const JoxYaml *one = name_at(l, map, "behaviour"), *mix = jox_yaml_get(map, "mix");
    if (mix && mix->kind != JOX_YAML_MAP) {
        jox_scene_error(&l->reader, mix, "bad-type", "mix: {walker.lua: 3, runner.lua: 1}",
                        "a mix maps behaviours to weights");
        return;
    }
    if (jox_yaml_get(map, "behaviour") && !one)
        return;
    if (!one == !mix || (mix && mix->count == 0)) {
        jox_scene_error(&l->reader, map, "missing-key", "behaviour: walker.lua",
                        "a group needs a behaviour or a mix of them");
        return;
    }
    uint32_t count = one ? 1 : mix->count;
    double sum = 0;
    group->mix = jox_arena_take(l->reader.arena, count, sizeof *group->mix);
    for (uint32_t i = 0; i < count; i++) {
        JoxGroupMix *entry = &group->mix[group->mix_count];
        entry->weight = 1;
        entry->position = one ? one->position : mix->key_positions[i];
        if (!one && !jox_read_number(&l->reader, mix->items[i], "", &entry->weight))
            continue;
        if (!(entry->weight > 0 && entry->weight <= 1e6)) {
            jox_scene_error(&l->reader, mix->items[i], "out-of-range", NULL,
                            "a weight must be above 0");
            continue;
        }
        entry->behaviour = find_behaviour(l, one ? one->text : mix->keys[i], entry->position);
        sum += entry->weight;
        group->mix_count += entry->behaviour != NULL;
    }
    for (uint32_t i = 0; i < group->mix_count; i++)
        group->mix[i].weight /= sum;
}

/* Whether all that a distribution gives lies in its parameter's range (a normal one: its mean). */
static bool parameter_fits(const JoxLoad *l, const JoxGroupValue *set, const JoxYaml *value) {
    int parameter = jox_parameter_find(set->name);
    const JoxDist *dist = &set->dist;
    if (parameter < 0 || set->kind != JOX_SET_NUMBER)
        return true;
    const JoxParameterInfo *info = &jox_parameters[parameter];
    bool choose = dist->kind == JOX_DIST_CHOOSE;
    int count = choose ? dist->choices : dist->kind == JOX_DIST_UNIFORM ? 2 : 1;
    for (int i = 0; i < count; i++) {
        double v = choose ? dist->values[i] : i ? dist->b : dist->a;
        if (v >= info->least && v <= info->greatest)
            continue;
        jox_scene_error(&l->reader, value, "out-of-range", NULL,
                        "%s must be from %g to %g %s, not %g", set->name, info->least,
                        info->greatest, info->unit, v);
        return false;
    }
    return true;
}

/* Whether a text was meant as a number: it begins as one, or is all of "nan" or "inf". */
static bool looks_numeric(const char *text) {
    char *end;
    strtod(text, &end);
    return end != text && (*end == 0 || text[strcspn(text, "0123456789")] != 0);
}

JoxGroupValue *jox_load_sets(const JoxLoad *l, const JoxYaml *map, bool numbers_only,
                             uint32_t *count) {
    *count = 0;
    if (!map)
        return NULL;
    if (map->kind != JOX_YAML_MAP) {
        jox_scene_error(&l->reader, map, "bad-type", NULL, "this maps names to values");
        return NULL;
    }
    JoxGroupValue *sets = jox_arena_take(l->reader.arena, map->count, sizeof *sets);
    for (uint32_t i = 0; i < map->count; i++) {
        const JoxYaml *value = map->items[i];
        const size_t errors = l->reader.diagnostics->errors;
        JoxGroupValue *set = &sets[*count];
        *set = (JoxGroupValue){.name = jox_arena_text(l->reader.arena, map->keys[i]),
                               .position = map->key_positions[i]};
        bool flag = value->kind == JOX_YAML_SCALAR &&
                    (!strcmp(value->text, "true") || !strcmp(value->text, "false"));
        if (flag) {
            set->dist = jox_dist_constant(!strcmp(value->text, "true"));
        } else if (jox_read_dist(&l->reader, value, &set->dist)) {
            if (l->reader.diagnostics->errors > errors)
                continue; /* a malformed distribution */
        } else {
            if (numbers_only || value->kind != JOX_YAML_SCALAR ||
                (looks_numeric(value->text) &&
                 jox_place_find(l->scene->places, l->scene->place_count, value->text) < 0)) {
                jox_scene_error(&l->reader, value, "bad-type", "uniform(0, 6)",
                                "this must be a finite number without a unit, or a distribution");
                continue;
            }
            set->kind = strcmp(value->text, "antipode") ? JOX_SET_PLACE : JOX_SET_ANTIPODE;
            if (set->kind == JOX_SET_PLACE && (set->place = jox_load_place(l, value)) < 0)
                continue;
        }
        *count += parameter_fits(l, set, value);
    }
    return sets;
}

char *jox_load_name(const JoxLoad *l, const JoxYaml *map, const char *owner, const char *key) {
    const char *name = jox_key_text(&l->reader, map, owner, key);
    if (name && *name)
        jox_scene_name(&l->reader, jox_yaml_get(map, key)->position, key, name);
    return jox_arena_text(l->reader.arena, name);
}

char **jox_load_tags(const JoxLoad *l, const JoxYaml *node, uint32_t *count) {
    const JoxYaml *const *names;
    *count = jox_read_names(&l->reader, node, &names);
    char **tags = jox_arena_take(l->reader.arena, *count, sizeof *tags);
    for (uint32_t i = 0; i < *count; i++) {
        tags[i] = jox_arena_text(l->reader.arena, names[i]->text);
        jox_scene_name(&l->reader, names[i]->position, "tag", tags[i]);
    }
    return tags;
}

static void read_group(JoxLoad *l, const JoxYaml *map, JoxGroup *group, uint32_t number) {
    group->fill = JOX_FILL_AT;
    group->facing = NAN;
    if (!jox_keys_check(&l->reader, map, "group"))
        return;
    read_mix(l, map, group);
    double facing = jox_key_number(&l->reader, map, "group", "facing");
    group->facing = (float)(facing * DEGREE);
    group->team = jox_load_name(l, map, "group", "team");
    group->party = (uint32_t)jox_key_number(&l->reader, map, "group", "party");
    group->tags = jox_load_tags(l, jox_yaml_get(map, "tags"), &group->tag_count);
    group->set = jox_load_sets(l, jox_yaml_get(map, "set"), false, &group->set_count);
    group->memory = jox_load_sets(l, jox_yaml_get(map, "memory"), true, &group->memory_count);
    jox_load_positions(l, map, group, number);
}

static void read_groups(JoxLoad *l, const JoxYaml *map) {
    if (!map || map->kind != JOX_YAML_MAP) {
        if (map)
            jox_scene_error(&l->reader, map, "bad-type", NULL, "groups maps names to groups");
        return;
    }
    l->scene->groups = jox_arena_take(l->reader.arena, map->count, sizeof *l->scene->groups);
    l->scene->group_count = map->count;
    for (uint32_t i = 0; i < map->count; i++) {
        l->scene->groups[i].name = jox_arena_text(l->reader.arena, map->keys[i]);
        l->scene->groups[i].position = map->key_positions[i];
        jox_scene_name(&l->reader, map->key_positions[i], "group", map->keys[i]);
        read_group(l, map->items[i], &l->scene->groups[i], i);
    }
}

/* ---- sources and sinks ---- */

/* The point opposite on the circle is that of agents who stand on it at the start. */
static void refuse_antipode(const JoxLoad *l, const JoxYaml *like, const JoxGroup *group) {
    for (uint32_t s = 0; s < group->set_count; s++)
        if (group->set[s].kind == JOX_SET_ANTIPODE) {
            jox_scene_error(&l->reader, like, "bad-value",
                            "Let the source be like a group that is bound for a place",
                            "group '%.60s' sets %.60s: antipode, which is for agents who stand on "
                            "a circle at the start; a source cannot be like it",
                            group->name, group->set[s].name);
            return;
        }
}

static void read_sources(JoxLoad *l, const JoxYaml *list) {
    if (list && list->kind != JOX_YAML_LIST)
        jox_scene_error(&l->reader, list, "bad-type", NULL, "sources is a list");
    uint32_t count = list && list->kind == JOX_YAML_LIST ? list->count : 0;
    l->scene->sources = jox_arena_take(l->reader.arena, count, sizeof *l->scene->sources);
    for (uint32_t i = 0; i < count; i++) {
        const JoxYaml *map = list->items[i];
        if (!jox_keys_check(&l->reader, map, "source"))
            continue;
        JoxAgentSource *source = &l->scene->sources[l->scene->source_count];
        const JoxYaml *place = name_at(l, map, "at"), *like = name_at(l, map, "like");
        int32_t at = place ? jox_load_place(l, place) : -1;
        int32_t group = like ? jox_load_group(l, like) : -1;
        source->rate = jox_key_number(&l->reader, map, "source", "rate");
        source->keep = (uint32_t)jox_key_number(&l->reader, map, "source", "keep");
        source->from = jox_key_number(&l->reader, map, "source", "from");
        source->until = jox_key_number(&l->reader, map, "source", "until");
        source->memory = jox_load_sets(l, jox_yaml_get(map, "memory"), true, &source->memory_count);
        source->position = map->position;
        if (source->rate == 0 && source->keep == 0)
            jox_scene_error(&l->reader, map, "missing-key", "rate: 2, or keep: 1000",
                            "a source needs a rate or a number to keep");
        if (at < 0 || group < 0)
            continue;
        if (l->scene->places[at].kind == JOX_PLACE_SET)
            jox_scene_error(&l->reader, place, "bad-place", NULL, "a source cannot be at a set");
        refuse_antipode(l, like, &l->scene->groups[group]);
        source->place = (uint32_t)at;
        source->like = (uint32_t)group;
        l->scene->source_count++;
    }
}

static void read_sinks(JoxLoad *l, const JoxYaml *list) {
    if (list && list->kind != JOX_YAML_LIST)
        jox_scene_error(&l->reader, list, "bad-type", NULL, "sinks is a list");
    uint32_t count = list && list->kind == JOX_YAML_LIST ? list->count : 0;
    l->scene->sinks = jox_arena_take(l->reader.arena, count, sizeof *l->scene->sinks);
    for (uint32_t i = 0; i < count; i++) {
        if (!jox_keys_check(&l->reader, list->items[i], "sink"))
            continue;
        const JoxYaml *place = name_at(l, list->items[i], "at"),
                      *group = name_at(l, list->items[i], "group");
        int32_t at = place ? jox_load_place(l, place) : -1;
        if (at >= 0)
            l->scene->sinks[l->scene->sink_count++] =
                (JoxAgentSink){(uint32_t)at, group ? jox_load_group(l, group) : -1};
    }
}

/* ---- the whole ---- */

bool jox_load_box(const JoxLoad *l, const JoxYaml *node, JoxV2 *low, JoxV2 *high) {
    uint32_t count;
    JoxV2 *points = node ? jox_read_points(&l->reader, node, 2, &count) : NULL;
    if (points)
        jox_bounds(points, count, low, high);
    if (points && !(low->x < high->x && low->y < high->y))
        jox_scene_error(&l->reader, node, "no-area", NULL, "this area is empty");
    return points != NULL;
}

/* Whether a file lies in one of the mods that are taken. */
static bool of_a_mod(const JoxLoad *l, const char *file) {
    for (uint32_t m = 0; l->options && m < l->options->mod_count; m++)
        if (jox_path_below(file, l->options->mods[m].folder))
            return true;
    return false;
}

static void read_periodic(JoxLoad *l, const JoxYaml *root) {
    const JoxYaml *node = jox_yaml_get(root, "periodic");
    if (!node)
        return;
    JoxSceneSpec *s = l->scene;
    int choice = jox_key_choice(&l->reader, root, "scene", "periodic");
    s->periodic_x = choice == 1 || choice == 3;
    s->periodic_y = choice == 2 || choice == 3;
    JoxV2 size = jox_sub(s->high, s->low);
    if (choice > 0 && !s->bounded)
        jox_scene_error(&l->reader, node, "bad-value", "bounds: [[0, 0], [20, 4]]",
                        "periodic edges need `bounds`");
    else if ((s->periodic_x && size.x < 1.0f) || (s->periodic_y && size.y < 1.0f))
        jox_scene_error(&l->reader, node, "bad-value", NULL,
                        "bounds that are joined must be at least 1 m apart");
}

static void read_settings(JoxLoad *l, const JoxYaml *root) {
    const JoxReader *r = &l->reader;
    JoxSceneSpec *s = l->scene;
    s->title = jox_arena_text(r->arena, jox_key_text(r, root, "scene", "title"));
    s->seed = (uint64_t)jox_key_number(r, root, "scene", "seed");
    s->step = jox_key_number(r, root, "scene", "step");
    s->duration = jox_key_number(r, root, "scene", "duration");
    s->gravity = jox_key_number(r, root, "scene", "gravity");
    jox_key_number(r, root, "scene", "jostle"); /* the version: its range is its check */
    s->bounded = jox_load_box(l, jox_yaml_get(root, "bounds"), &s->low, &s->high);
    read_periodic(l, root);
    const char *input = jox_key_text(r, root, "scene", "input");
    if (input && of_a_mod(l, jox_yaml_get(root, "input")->position.file) &&
        (*input == '/' || strstr(input, "..")))
        jox_scene_error(r, jox_yaml_get(root, "input"), "bad-value",
                        "A plain name, of a file beside it", "a mod cannot read '%.100s'", input);
    else if (input)
        s->input = jox_arena_beside(r->arena, jox_yaml_get(root, "input")->position.file, input);
    const JoxYaml *map = jox_yaml_get(root, "forces");
    s->forces = true;
    if (map && jox_keys_check(r, map, "forces")) {
        s->forces = jox_key_bool(r, map, "forces", "enabled");
        s->literal = jox_key_choice(r, map, "forces", "mode") == 1;
    }
    if ((map = jox_yaml_get(root, "limits")) && jox_keys_check(r, map, "limits")) {
        s->limits.given = true;
        s->limits.instructions = jox_key_number(r, map, "limits", "instructions");
        s->limits.step_instructions = jox_key_number(r, map, "limits", "step_instructions");
        s->limits.load_instructions = jox_key_number(r, map, "limits", "load_instructions");
        s->limits.memory = jox_key_number(r, map, "limits", "memory");
        s->limits.block = jox_key_number(r, map, "limits", "block");
        s->limits.source = jox_key_number(r, map, "limits", "source");
        s->limits.print = jox_key_number(r, map, "limits", "print");
    }
    if ((map = jox_yaml_get(root, "heatmap")) && jox_keys_check(r, map, "heatmap")) {
        s->heatmap = jox_load_box(l, jox_yaml_get(map, "area"), &s->heatmap_low, &s->heatmap_high);
        s->heatmap_from = jox_key_number(r, map, "heatmap", "from");
    }
    jox_load_view(l, root);
}

/* Whether a key holds something, right or wrong: what is wrong is reported where it is read. */
static bool is_filled(const JoxYaml *node) {
    return node && (node->kind == JOX_YAML_SCALAR || node->count > 0);
}

static void read_scene(JoxLoad *l, const JoxYaml *root) {
    const JoxReader *r = &l->reader;
    l->root = root;
    jox_keys_check(r, root, "scene");
    read_settings(l, root);
    read_places(l, jox_yaml_get(root, "places"));
    read_regions(l, jox_yaml_get(root, "regions"));
    jox_load_walls(l, jox_yaml_get(root, "walls"));
    jox_load_bodies(l, jox_yaml_get(root, "bodies"));
    read_groups(l, jox_yaml_get(root, "groups"));
    read_sources(l, jox_yaml_get(root, "sources"));
    read_sinks(l, jox_yaml_get(root, "sinks"));
    jox_load_events(l, jox_yaml_get(root, "events"));
    const JoxYaml *player = name_at(l, root, "player");
    l->scene->player_group = player ? jox_load_group(l, player) : -1;
    jox_load_probes(l, jox_yaml_get(root, "probes"));
    if (!is_filled(jox_yaml_get(root, "groups")) && !is_filled(jox_yaml_get(root, "bodies")) &&
        !is_filled(jox_yaml_get(root, "probes"))) /* of a recording: those alone */
        jox_scene_error(r, root, "empty-scene", "See scenes/circle.yaml",
                        "a scene needs a group or a body");
}

JoxSceneSpec *jox_scene_load_text(const char *name, const char *text, size_t length,
                                  const JoxSceneOptions *options, JoxDiagnostics *diagnostics) {
    JoxArena *arena = jox_arena_create();
    JoxYamlFiles *files = jox_arena_take(arena, 1, sizeof *files);
    JoxLoad load = {.reader = {arena, diagnostics},
                    .scene = jox_alloc(1, sizeof(JoxSceneSpec)),
                    .options = options,
                    .files = files};
    const size_t errors = diagnostics->errors;
    load.scene->memory = arena;
    load.datadir = options ? options->datadir : NULL;
    load.scene->path = jox_arena_text(arena, name);
    JoxYaml *root = jox_yaml_load(arena, load.scene->path, text, length, files, diagnostics);
    if (root && options)
        root = jox_load_patches(&load, root, files);
    for (uint32_t i = 0; root && options && i < options->set_count; i++)
        if (strncmp(options->sets[i], "mods.", 5) != 0) /* settings of mods, read before */
            jox_load_override(&load, root, options->sets[i]);
    if (root)
        read_scene(&load, root);
    for (uint32_t i = 0; i < files->count; i++)
        jox_diag_attach_source(diagnostics, files->items[i].path, files->items[i].text,
                               files->items[i].length);
    if (diagnostics->errors > errors) {
        jox_scene_free(load.scene);
        return NULL;
    }
    load.scene->files = jox_arena_take(arena, files->count, sizeof *load.scene->files);
    load.scene->file_count = files->count;
    for (uint32_t i = 0; i < files->count; i++) {
        load.scene->files[i].path = files->items[i].path;
        load.scene->files[i].text = files->items[i].text;
        load.scene->files[i].length = files->items[i].length;
        memcpy(load.scene->files[i].sha256, files->items[i].sha256, 65);
    }
    return load.scene;
}

JoxSceneSpec *jox_scene_load(const char *path, const JoxSceneOptions *options,
                             JoxDiagnostics *diagnostics) {
    return jox_scene_load_text(path, NULL, 0, options, diagnostics);
}

void jox_scene_free(JoxSceneSpec *scene) {
    if (!scene)
        return;
    jox_walls_free(&scene->walls);
    jox_patch_changes_free(&scene->changes);
    jox_arena_free(scene->memory);
    jox_free(scene);
}
