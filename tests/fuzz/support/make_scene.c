#include "make_scene.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/format/keys.h"

/* The input: each byte is a choice; beyond the last one, each choice is the first. */
typedef struct Choices {
    const uint8_t *data;
    size_t size, at;
    JoxText *out;
    int depth;
} Choices;

enum { DEEPEST = 5 };

static uint32_t pick(Choices *c, uint32_t sides) {
    return c->at < c->size ? c->data[c->at++] % sides : 0;
}

static const char *one_of(Choices *c, const char *const *names, uint32_t count) {
    return names[pick(c, count)];
}
#define ONE_OF(c, names) one_of(c, names, sizeof names / sizeof *names)

static const char *pick_name_for(Choices *c, const char *key) {
    static const char *const PLACES[] = {"hall", "west", "east", "spot", "line", "row", "both"};
    static const char *const BEHAVIOURS[] = {"walker.lua",  "stander.lua", "wanderer.lua",
                                             "presser.lua", "shover.lua",  "pedestrian.lua",
                                             "throng.lua",  "commuter.lua"};
    static const char *const GROUPS[] = {"g0", "g1", "g2"};
    static const char *const OTHERS[] = {"b0", "w0", "go", "hall", "g0", "red", "antipode"};
    if (!strcmp(key, "behaviour") || !strcmp(key, "mix"))
        return ONE_OF(c, BEHAVIOURS);
    if (!strcmp(key, "like") || !strcmp(key, "group") || !strcmp(key, "player"))
        return ONE_OF(c, GROUPS);
    if (!strcmp(key, "in") || !strcmp(key, "outside") || !strcmp(key, "at") ||
        !strcmp(key, "set") || !strcmp(key, "start"))
        return ONE_OF(c, PLACES);
    return ONE_OF(c, OTHERS);
}

static void add_random_number(Choices *c, double least, double greatest, const char *standard) {
    const double most = greatest > 30 ? 30 : greatest, low = least < -30 ? -30 : least;
    switch (least < greatest ? pick(c, 12) : 1) {
    case 0:
        jox_text_printf(c->out, "%s", *standard && *standard != '!' ? standard : "1");
        break;
    case 1:
        jox_text_printf(c->out, "%.9g", least < greatest ? low : (double)pick(c, 20) - 5);
        break;
    case 2:
        jox_text_printf(c->out, "%.9g", most);
        break;
    case 3: /* the bound of the range, and a value outside */
        jox_text_printf(c->out, "%.9g", pick(c, 2) ? least : least - 1e-3);
        break;
    default:
        jox_text_printf(c->out, "%.9g", low + (most - low) * (pick(c, 256) / 255.0));
    }
}

static void add_whole_number(Choices *c, const JoxKey *key) {
    const double most = key->greatest < 12 ? key->greatest : 12;
    const double least = key->least > most ? most : key->least;
    const bool budget = key->least >= 1000; /* a limit of instructions */
    jox_text_printf(c->out, "%.0f",
                    budget ? 100000 : least + pick(c, (uint32_t)(most - least) + 1));
}

/* Adds a point, most often in the hall. */
static void add_point(Choices *c, int axes) {
    static const double LONG[] = {FUZZ_HALL_X, FUZZ_HALL_Y, 2};
    jox_text_add(c->out, "[");
    for (int k = 0; k < axes; k++) {
        const uint32_t p = pick(c, 256);
        jox_text_printf(c->out, "%s%.6g", k ? ", " : "",
                        p == 255   ? -3.0
                        : p == 254 ? 1e4
                                   : LONG[k] * p / 250.0);
    }
    jox_text_add(c->out, "]");
}

/* Adds lengths or counts along the three axes. */
static void add_extent(Choices *c, const JoxKey *key) {
    const bool whole_numbers = key->least >= 1;
    jox_text_add(c->out, "[");
    for (int k = 0; k < 3; k++)
        jox_text_printf(c->out, "%s%.3g", k ? ", " : "",
                        whole_numbers ? 1.0 + pick(c, 3) : 0.05 + pick(c, 40) * 0.05);
    jox_text_add(c->out, "]");
}

/* Adds corners in order around a centre; now and then one is out of order. */
static void add_polygon(Choices *c, uint32_t corners) {
    const double x = pick(c, FUZZ_HALL_X + 1), y = pick(c, FUZZ_HALL_Y + 1);
    const double radius = 0.1 + pick(c, 30) * 0.1;
    const uint32_t odd = pick(c, 40) == 39 ? 0 : corners;
    jox_text_add(c->out, "[");
    for (uint32_t k = 0; k < corners; k++) {
        const double angle = 6.283185307 * k / corners + pick(c, 8) * 0.05;
        const double r = k == odd ? -radius : radius;
        jox_text_printf(c->out, "%s[%.6g, %.6g]", k ? ", " : "", x + r * cos(angle),
                        y + r * sin(angle));
    }
    jox_text_add(c->out, "]");
}

static void add_map(Choices *c, const char *owner);

/* Writes a value of the type that a content begins with: an owner, or a word that keys.h lists. */
static void add_item(Choices *c, const char *content, size_t length) {
    char name[40];
    snprintf(name, sizeof name, "%.*s", (int)length, content);
    if (!strcmp(name, "xy") || !strcmp(name, "xyz"))
        add_point(c, name[2] ? 3 : 2);
    else if (!strcmp(name, "start"))
        jox_text_printf(c->out, "[%u, %u, %u]", pick(c, 3), pick(c, 20), pick(c, 10));
    else if (!strcmp(name, "value") && pick(c, 3))
        jox_text_add(c->out, pick_name_for(c, "set"));
    else if (jox_owner_find(&jox_scene_format, name, length))
        add_map(c, name);
    else if (!strcmp(name, "draw") && pick(c, 2))
        jox_text_printf(c->out, "{uniform: [%u, %u]}", pick(c, 3), 3 + pick(c, 9));
    else
        add_random_number(c, 0, 10, "1");
}

/* Adds the list or map that a key's content says: "wall[2]" a list, "place*" a map of names. */
static void add_items(Choices *c, const JoxKey *key) {
    const char *content = key->content ? key->content : "xy[2]";
    const size_t length = strcspn(content, "*[");
    const char *mark = content + length;
    if (!*mark) {
        add_item(c, content, length);
        return;
    }
    const bool named = strchr(mark, '*') != NULL, list = strchr(mark, '[') != NULL;
    const char *least = strchr(mark, '[');
    if (!strcmp(content, "xy[3]")) {
        add_polygon(c, 3 + pick(c, 3));
        return;
    }
    const uint32_t count = (least ? (uint32_t)atoi(least + 1) : 1) + pick(c, 2);
    jox_text_add(c->out, list ? "[" : "{");
    for (uint32_t i = 0; i < (count ? count : 1); i++) {
        jox_text_add(c->out, i ? ", " : "");
        if (named && !list)
            jox_text_printf(c->out,
                            "%s: ", !strcmp(key->name, "mix") ? pick_name_for(c, "mix") : "n");
        add_item(c, content, length);
        if (named && !list)
            break;
    }
    jox_text_add(c->out, list ? "]" : "}");
}

static void add_value(Choices *c, const JoxKey *key) {
    char choice[64];
    switch (key->type) {
    case JOX_TYPE_NUMBER:
        add_random_number(c, key->least, key->greatest, key->default_text);
        break;
    case JOX_TYPE_WHOLE:
        add_whole_number(c, key);
        break;
    case JOX_TYPE_BOOL:
        jox_text_add(c->out, pick(c, 2) ? "true" : "false");
        break;
    case JOX_TYPE_POINT:
    case JOX_TYPE_POINT3:
        if (key->least >= 0)
            add_extent(c, key);
        else
            add_point(c, key->type == JOX_TYPE_POINT ? 2 : 3);
        break;
    case JOX_TYPE_TEXT:
    case JOX_TYPE_NAMES:
        if (key->choices) {
            int n = 0;
            while (jox_choice_name(key->choices, n, choice, sizeof choice))
                n++;
            jox_choice_name(key->choices, (int)pick(c, (uint32_t)n), choice, sizeof choice);
            jox_text_add(c->out, choice);
        } else {
            jox_text_add(c->out, pick_name_for(c, key->name));
        }
        break;
    default:
        add_items(c, key);
    }
}

/* Whether a key is left to other targets: it names other files, or makes runs long. */
static bool is_left_out(const JoxKey *key) {
    static const char *const NAMES[] = {"include", "input",  "mods",  "patch",   "replace",
                                        "file",    "jostle", "title", "duration"};
    for (size_t n = 0; n < sizeof NAMES / sizeof *NAMES; n++)
        if (!strcmp(key->name, NAMES[n]))
            return true;
    return false;
}

/* Adds a map of an owner: its required keys, one that selects its kind, and some of the others. */
static void add_map(Choices *c, const char *owner) {
    const JoxFormat *f = &jox_scene_format;
    uint32_t kinds = 0, kind, begun = 0;
    for (size_t k = 0; k < f->key_count; k++)
        kinds += !strcmp(f->keys[k].owner, owner) && f->keys[k].selected_kind &&
                 !is_left_out(&f->keys[k]);
    kind = kinds ? pick(c, kinds) : 0;
    jox_text_add(c->out, "{");
    for (size_t k = 0; k < f->key_count && c->depth < DEEPEST; k++) {
        const JoxKey *key = &f->keys[k];
        if (strcmp(key->owner, owner) != 0 || is_left_out(key))
            continue;
        if (key->selected_kind ? kind-- != 0
                               : strcmp(key->default_text, "!") != 0 && pick(c, 6) != 5)
            continue;
        jox_text_printf(c->out, "%s%s: ", begun++ ? ", " : "", key->name);
        c->depth++;
        add_value(c, key);
        c->depth--;
    }
    jox_text_add(c->out, "}");
}

static void add_groups(Choices *c) {
    static const char *const FORMS[] = {"count: 12, in: hall", "count: 6, in: west, outside: spot",
                                        "at: [[5, 5], [5.2, 5], [5, 5]]",
                                        "density: 0.2, in: hall, fill: hex",
                                        "count: 5, in: line, fill: line"};
    jox_text_add(c->out, "groups:\n");
    for (int g = 0; g < 3; g++) {
        const char *behaviour = pick_name_for(c, "behaviour");
        jox_text_printf(c->out, "  g%d: {behaviour: %s, %s", g, behaviour, ONE_OF(c, FORMS));
        for (size_t k = 0; k < jox_scene_format.key_count; k++) {
            static const char *const MORE[] = {"spacing", "facing", "party", "team", "haste"};
            const JoxKey *key = &jox_scene_format.keys[k];
            if (strcmp(key->owner, "group") != 0)
                continue;
            for (size_t m = 0; m < sizeof MORE / sizeof *MORE; m++)
                if (!strcmp(MORE[m], key->name) && pick(c, 5) == 4) {
                    jox_text_printf(c->out, ", %s: ", key->name);
                    add_value(c, key);
                }
        }
        if (!strcmp(behaviour, "walker.lua") || !strcmp(behaviour, "pedestrian.lua"))
            jox_text_printf(c->out, ", set: {goal: %s}", pick_name_for(c, "in"));
        jox_text_add(c->out, "}\n");
    }
}

/* Adds a list of up to three random items of an owner, after the item `first`, if any. */
static void add_entries(Choices *c, const char *key, const char *owner, const char *first) {
    const uint32_t count = pick(c, 4);
    if (!count && !*first)
        return;
    jox_text_printf(c->out, "%s:\n%s", key, first);
    for (uint32_t i = 0; i < count; i++) {
        jox_text_add(c->out, "  - ");
        add_map(c, owner);
        jox_text_add(c->out, "\n");
    }
}

void fuzz_make_scene(const uint8_t *data, size_t size, JoxText *out) {
    Choices c = {data, size, 0, out, 0};
    jox_text_printf(out,
                    "jostle: 1\nplaces:\n  hall: {polygon: [[0, 0], [%d, 0], [%d, %d], [0, %d]]}\n"
                    "  west: {polygon: [[0, 0], [5, 0], [5, %d], [0, %d]]}\n"
                    "  east: {polygon: [[15, 0], [20, 0], [20, %d], [15, %d]]}\n"
                    "  spot: {point: [10, 5], radius: 2}\n  line: {line: [[8, 1], [8, 9]]}\n"
                    "  row: {queue: [[3, 3], [9, 3]]}\n  both: {set: [west, spot]}\n",
                    FUZZ_HALL_X, FUZZ_HALL_X, FUZZ_HALL_Y, FUZZ_HALL_Y, FUZZ_HALL_Y, FUZZ_HALL_Y,
                    FUZZ_HALL_Y, FUZZ_HALL_Y);
    JoxText walls = {0};
    jox_text_printf(&walls,
                    "  - {line: [[0, 0], [%d, 0], [%d, %d], [0, %d]], closed: true}\n"
                    "  - {line: [[12, 2], [12, 8]], name: w0}\n",
                    FUZZ_HALL_X, FUZZ_HALL_X, FUZZ_HALL_Y, FUZZ_HALL_Y);
    add_entries(&c, "walls", "wall", walls.data);
    jox_text_free(&walls);
    add_entries(
        &c, "bodies", "body",
        "  - {name: b0, shape: {box: {size: [0.5, 0.5, 0.5]}}, at: [10, 2, 0.25], mass: 20, "
        "tags: [ball, red]}\n");
    add_groups(&c);
    if (pick(&c, 2))
        jox_text_printf(out, "sources: [{at: east, like: %s, rate: %u, keep: %u}]\n",
                        pick_name_for(&c, "like"), 1 + pick(&c, 30), pick(&c, 60));
    add_entries(&c, "sinks", "sink", "");
    add_entries(&c, "events", "event", "");
    static const char *const TABLES[] = {"forces", "walking", "limits"};
    for (int t = 0; t < 3; t++)
        if (pick(&c, 5) == 4) {
            jox_text_printf(out, "%s: ", TABLES[t]);
            add_map(&c, TABLES[t]);
            jox_text_add(out, "\n");
        }
    if (pick(&c, 4) == 3) {
        jox_text_add(out, "probes: {p: ");
        add_map(&c, "probe");
        jox_text_add(out, "}\n");
    }
    if (pick(&c, 4) == 3)
        jox_text_printf(out, "step: %.3g\n", 0.001 + pick(&c, 200) * 0.001);
    if (pick(&c, 4) == 3)
        jox_text_printf(out, "gravity: %u\n", pick(&c, 100));
}
