/* jo_compare: reads and names the sides, computes the differences, and writes text, JSON and the
   page. */
#include "sweep/compare/compare.h"

#include <stdlib.h>
#include <string.h>

#include "base/assert.h"
#include "base/format/path.h"
#include "base/guard.h"
#include "picture/plot.h"

enum { COMPARE_COOKIE = 0x4a4f4350 };

JoCompareDef jo_default_compare_def(void) {
    return (JoCompareDef){.share = 0.95, .cookie = COMPARE_COOKIE};
}

/* ---- names ---- */

static const char *get_file_stem(const JoxSide *side, size_t *length) {
    const char *file = jox_path_name(side->source);
    *length = jox_path_stem(file);
    return file;
}

/* Finds whether the sides come from several files, and whether two of these have the same name. */
static void inspect_files(const JoxSides *sides, bool *several, bool *alike) {
    *several = *alike = false;
    for (uint32_t s = 1; s < sides->count; s++)
        for (uint32_t t = 0; t < s; t++) {
            size_t n, m;
            const char *a = get_file_stem(&sides->items[s], &n),
                       *b = get_file_stem(&sides->items[t], &m);
            if (strcmp(sides->items[s].source, sides->items[t].source) == 0)
                continue;
            *several = true;
            *alike |= n == m && strncmp(a, b, n) == 0;
        }
}

/* Names each side by its file, its settings, or both, as far as these differ. */
static void name_sides(JoxSides *sides) {
    bool several, alike;
    inspect_files(sides, &several, &alike);
    for (uint32_t s = 0, end; s < sides->count; s = end) {
        for (end = s + 1;
             end < sides->count && strcmp(sides->items[end].source, sides->items[s].source) == 0;)
            end++;
        const char **keys = jox_alloc(end - s, sizeof *keys);
        char **names = jox_alloc(end - s, sizeof *names);
        for (uint32_t k = s; k < end; k++)
            keys[k - s] = sides->items[k].settings ? sides->items[k].settings : "";
        jox_sweep_name_variants(keys, end - s, names);
        for (uint32_t k = s; k < end; k++) {
            JoxSide *side = &sides->items[k];
            JoxText name = {0};
            size_t n;
            const char *file = get_file_stem(side, &n);
            if (alike)
                jox_text_add(&name, side->source);
            else if (several || !*names[k - s])
                jox_text_append(&name, file, n);
            if (*names[k - s])
                jox_text_printf(&name, "%s%s", name.length ? ": " : "", names[k - s]);
            side->name = name.data;
            jox_free(names[k - s]);
        }
        jox_free(names);
        jox_free(keys);
    }
}

/* Replaces names by the labels of the def; false with JO_USAGE. */
static bool label_sides(JoxComparison *c, JoError *error) {
    const JoCompareDef *def = c->def;
    if (def->label_count > c->sides.count) {
        jox_error(error, JO_USAGE, "there are %zu labels, and %u %s", def->label_count,
                  c->sides.count, c->sides.count == 1 ? "side" : "sides");
        return false;
    }
    for (size_t l = 0; l < def->label_count; l++) {
        jox_free(c->sides.items[l].name);
        c->sides.items[l].name = jox_strdup(def->labels[l]);
    }
    return true;
}

/* Finds the base by its number, its name, or its file; false with JO_USAGE. */
static bool find_base(JoxComparison *c, JoError *error) {
    const char *base = c->def->base;
    char *end;
    if (!base) { /* default: the first side with runs */
        while (c->base + 1 < c->sides.count && c->sides.items[c->base].runs == 0)
            c->base++;
        return true;
    }
    const unsigned long number = strtoul(base, &end, 10);
    if (*base && !*end && number >= 1 && number <= c->sides.count) {
        c->base = (uint32_t)number - 1;
        return true;
    }
    for (uint32_t s = 0; s < c->sides.count; s++)
        if (strcmp(c->sides.items[s].name, base) == 0 ||
            strcmp(c->sides.items[s].source, base) == 0) {
            c->base = s;
            return true;
        }
    JoxText names = {0};
    for (uint32_t s = 0; s < c->sides.count; s++)
        jox_text_printf(&names, "%s'%s'", s ? ", " : "", c->sides.items[s].name);
    jox_error(error, JO_USAGE, "there is no side '%.100s'; there are %.600s", base, names.data);
    jox_text_free(&names);
    return false;
}

/* ---- the whole ---- */

/* Reads all sides: consecutive recordings of one folder make one side. */
static bool load_sides(JoxComparison *c, JoError *error) {
    const JoCompareDef *def = c->def;
    for (size_t s = 0, end; s < def->side_count; s = end) {
        end = s + 1;
        const char *folder = def->folders ? def->folders[s] : NULL;
        while (folder && end < def->side_count && def->folders[end] &&
               strcmp(def->folders[end], folder) == 0)
            end++;
        if (!(def->summaries && def->summaries[s]
                  ? jox_sides_add_recordings(&c->sides, folder ? folder : def->sides[s],
                                             def->sides + s, def->summaries + s,
                                             (uint32_t)(end - s), def, error)
                  : jox_sides_add_sweep(&c->sides, def->sides[s], error)))
            return false;
    }
    uint32_t runs = 0;
    for (uint32_t s = 0; s < c->sides.count; s++)
        runs += c->sides.items[s].runs;
    name_sides(&c->sides);
    if (!runs && !(def->out && c->sides.count == 1 && c->sides.items[0].all_count)) {
        jox_error(error, JO_INPUT, "there is no run with figures as yet");
        return false; /* a single side without figures still gets a page, with the reasons */
    }
    return label_sides(c, error) && find_base(c, error);
}

static bool write_comparison_page(const JoxComparison *c, JoError *error) {
    JoxText why = {0};
    const bool alone = c->sides.count == 1 && !c->sides.items[0].recorded;
    const bool good = jox_plot_folder(c->def->out, &why) &&
                      (alone ? jox_seeds_write_page(c, &why)
                             : jox_compare_draw_plots(c, &why) && jox_compare_draw_plans(c, &why) &&
                                   jox_compare_write_page(c, &why));
    if (!good)
        jox_error(error, JO_FAILED, "%s", why.data ? why.data : "writing failed");
    jox_text_free(&why);
    return good;
}

static char *compare_all_sides(const JoCompareDef *def, char **json, JoError *error) {
    JoxComparison c = {.def = def};
    JoxText text = {0}, document = {0};
    bool good = load_sides(&c, error);
    if (good) {
        jox_compare_effects(&c);
        jox_compare_write_text(&c, &text);
    }
    if (good && json)
        jox_compare_write_json(&c, &document);
    good = good && (!def->out || write_comparison_page(&c, error));
    for (uint32_t f = 0; f < c.count; f++)
        jox_free(c.figures[f].sides);
    jox_free(c.figures);
    jox_sides_free(&c.sides);
    if (json)
        *json = good ? jox_disown(document.data) : NULL;
    return good ? jox_disown(text.data) : NULL;
}

char *jo_compare(const JoCompareDef *def, char **json, JoError *error) {
    JOX_REQUIRE(def && def->cookie == COMPARE_COOKIE && def->sides && def->side_count > 0, NULL);
    JOX_REQUIRE(def->share >= 0.5 && def->share < 1, NULL);
    JOX_REQUIRE(def->percentile >= 0 && def->percentile < 100, NULL);
    JOX_GUARD (NULL, error)
        return NULL;
    return compare_all_sides(def, json, error);
}
