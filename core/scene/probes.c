/* Probes of a scene: what is measured of a run, or of a recording. */
#include <math.h>
#include <string.h>

#include "scene/internal.h"

static const char KINDS[] = "flow|measure|transit|displacement|map|winding|failures|lanes|visit";
/* Files of a report that have these names already. */
static const char TAKEN[] = "density|paths|regions|walls|danger|danger-map";
/* What an option is of: the kinds that read it. */
static const char *const OPTIONS[][2] = {{"every", "measure|map|lanes"},
                                         {"cutoff", "measure"},
                                         {"onset", "displacement"},
                                         {"rest", "displacement"},
                                         {"along", "displacement"}};

/* Index of a word in "this|that", or -1. */
static int word_of(const char *words, const char *word) {
    char name[64];
    for (int i = 0; jox_choice_name(words, i, name, sizeof name); i++)
        if (!strcmp(name, word))
            return i;
    return -1;
}

static void check_name(const JoxLoad *l, const char *name, JoxPosition at) {
    if (jox_scene_name(&l->reader, at, "probe", name) && word_of(TAKEN, name) >= 0)
        jox_diag_error(l->reader.diagnostics, at, "bad-name", "Choose another",
                       "a report has a file of the name '%.60s' already", name);
}

/* The kind by its key; -1 with an error. */
static int kind_of(const JoxLoad *l, const JoxYaml *map) {
    int kind = -1, found = 0;
    for (uint32_t k = 0; k < map->count; k++) {
        int index = word_of(KINDS, map->keys[k]);
        found += index >= 0;
        kind = index >= 0 ? index : kind;
    }
    if (found == 1)
        return kind;
    JoxText kinds = {0};
    jox_choices_text(KINDS, &kinds);
    jox_scene_error(&l->reader, map, "bad-probe", NULL, "a probe has one of %s, not %s", kinds.data,
                    found ? "several" : "none");
    jox_text_free(&kinds);
    return -1;
}

/* Two points that lie apart, appended; false with an error. */
static bool read_line(const JoxLoad *l, const JoxYaml *node, JoxV2 *out) {
    uint32_t count;
    JoxV2 *points = jox_read_points(&l->reader, node, 2, &count);
    if (!points)
        return false;
    if (count != 2) {
        jox_scene_error(&l->reader, node, "bad-probe", "[[0, 0], [0, 2]]", "a line has two points");
        return false;
    }
    if (!(jox_length(jox_sub(points[1], points[0])) >= 1e-3f)) {
        jox_scene_error(&l->reader, node, "bad-probe", "Nobody crosses a point",
                        "the ends of this line are less than a millimetre apart");
        return false;
    }
    out[0] = points[0];
    out[1] = points[1];
    return true;
}

static void read_lines(const JoxLoad *l, const JoxYaml *node, JoxProbeDef *probe) {
    JoxV2 *points = jox_arena_take(l->reader.arena, 4, sizeof *points);
    probe->points = points;
    if (probe->kind == JOX_PROBE_FLOW) {
        probe->count = read_line(l, node, points) ? 2 : 0;
        return;
    }
    if (node->kind != JOX_YAML_LIST || node->count != 2) {
        jox_scene_error(&l->reader, node, "bad-type",
                        "transit: [[[0, 0], [0, 2]], [[5, 0], [5, 2]]]",
                        "transit is a list of two lines");
        return;
    }
    bool good = read_line(l, node->items[0], points);
    probe->count = read_line(l, node->items[1], points + 2) && good ? 4 : 0;
}

static void read_visit(const JoxLoad *l, const JoxYaml *node, JoxProbeDef *probe) {
    bool good = node->kind == JOX_YAML_LIST && node->count == 2;
    for (uint32_t s = 0; good && s < 2; s++)
        good = node->items[s]->kind == JOX_YAML_SCALAR;
    if (!good) {
        jox_scene_error(&l->reader, node, "bad-type", "visit: [Wait, Served]",
                        "visit is a list of the names of two states");
        return;
    }
    for (uint32_t s = 0; s < 2; s++)
        probe->states[s] = jox_arena_text(l->reader.arena, node->items[s]->text);
}

static void read_map(const JoxLoad *l, const JoxYaml *map, JoxProbeDef *probe) {
    probe->low = (JoxV2){INFINITY, INFINITY};
    probe->high = (JoxV2){-INFINITY, -INFINITY};
    if (!jox_keys_check(&l->reader, map, "map"))
        return;
    probe->cell = jox_key_number(&l->reader, map, "map", "cell");
    probe->kernel = jox_key_number(&l->reader, map, "map", "kernel");
    jox_load_box(l, jox_yaml_get(map, "area"), &probe->low, &probe->high);
}

static void read_lanes(const JoxLoad *l, const JoxYaml *map, JoxProbeDef *probe) {
    if (!jox_keys_check(&l->reader, map, "lanes"))
        return;
    probe->rows = jox_key_number(&l->reader, map, "lanes", "rows");
    probe->along_y = jox_key_choice(&l->reader, map, "lanes", "along") == 1;
    jox_load_box(l, jox_yaml_get(map, "area"), &probe->low, &probe->high);
}

/* One point, or direction, of a key. */
static bool read_point(const JoxLoad *l, const JoxYaml *map, const char *key, JoxProbeDef *probe) {
    double v[2] = {0, 0};
    JoxV2 *point = jox_arena_take(l->reader.arena, 1, sizeof *point);
    if (!jox_key_vector(&l->reader, map, "probe", key, v, 2))
        return false;
    *point = jox_v2((float)v[0], (float)v[1]);
    probe->points = point;
    probe->count = 1;
    return true;
}

static void read_displacement(const JoxLoad *l, const JoxYaml *map, JoxProbeDef *probe) {
    if (!jox_key_bool(&l->reader, map, "probe", "displacement"))
        jox_scene_error(&l->reader, jox_yaml_get(map, "displacement"), "bad-probe",
                        "Take the probe away", "displacement is true, or is not there");
    if (read_point(l, map, "along", probe) && jox_length(probe->points[0]) < 1e-6f)
        jox_scene_error(&l->reader, jox_yaml_get(map, "along"), "bad-probe", "[1, 0]",
                        "a direction has a length");
}

static void read_groups_of(const JoxLoad *l, const JoxYaml *map, JoxProbeDef *probe) {
    const JoxYaml *const *names;
    uint32_t count = jox_read_names(&l->reader, jox_yaml_get(map, "group"), &names);
    uint16_t *groups = jox_arena_take(l->reader.arena, count, sizeof *groups);
    for (uint32_t n = 0; n < count; n++) {
        int32_t group = jox_load_group(l, names[n]);
        if (group >= 0)
            groups[probe->group_count++] = (uint16_t)group;
    }
    probe->groups = groups;
}

static void read_options(const JoxLoad *l, const JoxYaml *map, const char *kind,
                         JoxProbeDef *probe) {
    const JoxReader *r = &l->reader;
    read_groups_of(l, map, probe);
    probe->from = jox_key_number(r, map, "probe", "from");
    probe->until = jox_yaml_get(map, "until") ? jox_key_number(r, map, "probe", "until") : INFINITY;
    probe->every = jox_key_number(r, map, "probe", "every");
    probe->cutoff = jox_key_number(r, map, "probe", "cutoff");
    probe->rest = jox_key_number(r, map, "probe", "rest");
    probe->onset = jox_key_number(r, map, "probe", "onset");
    if (probe->until <= probe->from)
        jox_scene_error(r, jox_yaml_get(map, "until"), "bad-probe", NULL,
                        "until (%g s) must be after from (%g s)", probe->until, probe->from);
    for (size_t o = 0; o < sizeof OPTIONS / sizeof *OPTIONS; o++)
        if (jox_yaml_get(map, OPTIONS[o][0]) && word_of(OPTIONS[o][1], kind) < 0)
            jox_scene_error(r, jox_yaml_get(map, OPTIONS[o][0]), "bad-probe", "Leave it out",
                            "a probe of %s does not take '%s'", kind, OPTIONS[o][0]);
}

static void read_probe(const JoxLoad *l, const JoxYaml *map, JoxProbeDef *probe) {
    char kind[32];
    if (!jox_keys_check(&l->reader, map, "probe"))
        return;
    int index = kind_of(l, map);
    if (index < 0)
        return;
    probe->kind = (JoxProbeKind)index;
    jox_choice_name(KINDS, index, kind, sizeof kind);
    read_options(l, map, kind, probe);
    const JoxYaml *node = jox_yaml_get(map, kind);
    switch (probe->kind) {
    case JOX_PROBE_FLOW:
    case JOX_PROBE_TRANSIT:
        read_lines(l, node, probe);
        break;
    case JOX_PROBE_MEASURE:
        probe->points = jox_load_ring(l, node, &probe->count);
        break;
    case JOX_PROBE_DISPLACEMENT:
        read_displacement(l, map, probe);
        break;
    case JOX_PROBE_MAP:
        read_map(l, node, probe);
        break;
    case JOX_PROBE_WINDING:
        read_point(l, map, "winding", probe);
        break;
    case JOX_PROBE_VISIT:
        read_visit(l, node, probe);
        break;
    case JOX_PROBE_FAILURES:
        probe->every = jox_key_number(&l->reader, map, "probe", "failures");
        break;
    default:
        read_lanes(l, node, probe);
    }
}

void jox_load_probes(JoxLoad *l, const JoxYaml *map) {
    if (!map || map->kind != JOX_YAML_MAP) {
        if (map)
            jox_scene_error(&l->reader, map, "bad-type", "probes: {door: {flow: [[0, 0], [1, 0]]}}",
                            "probes maps names to probes");
        return;
    }
    l->scene->probes = jox_arena_take(l->reader.arena, map->count, sizeof *l->scene->probes);
    l->scene->probe_count = map->count;
    for (uint32_t i = 0; i < map->count; i++) {
        l->scene->probes[i].name = jox_arena_text(l->reader.arena, map->keys[i]);
        check_name(l, map->keys[i], map->key_positions[i]);
        read_probe(l, map->items[i], &l->scene->probes[i]);
    }
}
