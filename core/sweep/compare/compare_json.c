/* Writes a comparison as JSON: every figure, with the data behind each interval. */
#include <math.h>

#include "base/format/json_writer.h"
#include "base/mem.h"
#include "sweep/compare/compare.h"

static void put_side_json(const JoxComparison *c, uint32_t s, JoxJson *json) {
    const JoxSide *side = &c->sides.items[s];
    jox_json_object(json, NULL);
    jox_json_string(json, "name", side->name);
    jox_json_string(json, "source", side->source);
    jox_json_string(json, "settings", side->settings ? side->settings : "");
    jox_json_whole(json, "runs", side->runs);
    jox_json_whole(json, "left_out", side->left_out);
    jox_json_array(json, "seeds");
    for (uint32_t r = 0; r < side->runs && !side->recorded; r++)
        jox_json_whole(json, NULL, side->seeds[r]);
    jox_json_end(json);
    jox_json_end(json);
}

static void put_percentile_json(const JoxComparison *c, const char *figure, uint32_t s,
                                JoxJson *json) {
    const double q = c->def->percentile / 100;
    size_t count;
    double *values = jox_side_sorted_values(&c->sides.items[s], figure, &count);
    const size_t above = jox_rank_above(count, q), bound = jox_rank_bound(count, q, c->def->share);
    jox_json_number(json, "percentile", above ? values[above - 1] : NAN);
    jox_json_number(json, "worst", count ? values[count - 1] : NAN);
    jox_json_number(json, "percentile_bound", bound ? values[bound - 1] : NAN);
    jox_free(values);
}

static void put_difference(const JoxComparison *c, const JoxCompared *figure, uint32_t s,
                           JoxJson *json) {
    const JoxDifference *d = &figure->sides[s];
    char method[200];
    size_t count;
    double *values = jox_side_sorted_values(&c->sides.items[s], figure->figure, &count);
    const JoxMoments m = jox_moments(values, count);
    jox_free(values);
    jox_json_object(json, NULL);
    jox_json_number(json, "mean", m.mean);
    jox_json_number(json, "deviation", m.deviation);
    jox_json_whole(json, "runs", count);
    if (c->def->percentile > 0)
        put_percentile_json(c, figure->figure, s, json);
    if (s != c->base) {
        jox_compare_describe_method(c, d, method, sizeof method);
        jox_json_number(json, "difference", d->effect.difference);
        jox_json_number(json, "low", d->effect.low);
        jox_json_number(json, "high", d->effect.high);
        jox_json_number(json, "p", d->effect.p);
        jox_json_whole(json, "pairs", d->effect.pairs);
        jox_json_string(json, "method", method);
        jox_json_string(json, "verdict", jox_compare_verdict(d));
        jox_json_bool(json, "holm", d->adjusted);
        if (d->runs)
            jox_json_whole(json, "seeds_needed", d->runs);
        else
            jox_json_null(json, "seeds_needed");
    }
    jox_json_end(json);
}

void jox_compare_write_json(const JoxComparison *c, JoxText *out) {
    JoxJson json = jox_json_begin(out, 3);
    jox_json_object(&json, NULL);
    jox_json_string(&json, "version", jo_version());
    jox_json_number(&json, "confidence", c->def->share);
    if (c->def->percentile > 0)
        jox_json_number(&json, "percent", c->def->percentile);
    jox_json_whole(&json, "base", c->base + 1);
    jox_json_array(&json, "sides");
    for (uint32_t s = 0; s < c->sides.count; s++)
        put_side_json(c, s, &json);
    jox_json_end(&json);
    jox_json_object(&json, "figures");
    for (uint32_t f = 0; f < c->count; f++) {
        jox_json_object(&json, c->figures[f].figure);
        jox_json_string(&json, "words", c->figures[f].words.text);
        jox_json_string(&json, "unit", c->figures[f].words.unit);
        jox_json_array(&json, "sides");
        for (uint32_t s = 0; s < c->sides.count; s++)
            put_difference(c, &c->figures[f], s, &json);
        jox_json_end(&json);
        jox_json_end(&json);
    }
    jox_json_end(&json);
    jox_json_end(&json);
    jox_text_add(out, "\n");
}
