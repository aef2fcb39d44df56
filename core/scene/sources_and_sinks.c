/* Reads sources, where agents come in, and sinks, where they leave. */
#include <math.h>

#include "base/assert.h"
#include "scene/scene_draft.h"

enum { MOST_TIMES = 10000 };

/* Reports a source like a group whose agents go to the opposite point of their circle: agents that
   come in later do not stand on one. */
static void refuse_antipode(const JoxReader *r, const JoxYaml *like, const JoxGroup *group) {
    for (uint32_t s = 0; s < group->set_count; s++)
        if (group->set[s].kind == JOX_SET_ANTIPODE) {
            jox_scene_error(r, like, "bad-value",
                            "Let the source be like a group that is bound for a place",
                            "group '%.60s' sets %.60s: antipode, which is for agents who stand on "
                            "a circle at the start; a source cannot be like it",
                            group->name, group->set[s].name);
            return;
        }
}

/* Reads a list of times, s. */
void jox_key_read_times(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    JoxAgentSource *source = item;
    if (!node)
        return;
    if (node->kind != JOX_YAML_LIST || node->count < 1 || node->count > MOST_TIMES) {
        jox_scene_error(r, node, "bad-type", key->example, "%s are a list of 1 to %d times",
                        key->name, MOST_TIMES);
        return;
    }
    source->times = jox_arena_take(r->arena, node->count, sizeof *source->times);
    for (uint32_t t = 0; t < node->count; t++) {
        double time;
        if (!jox_read_number(r, node->items[t], "s", &time))
            continue;
        if (time >= key->least && time <= key->greatest)
            source->times[source->time_count++] = time;
        else
            jox_scene_error(r, node->items[t], "out-of-range", NULL, "this must be %g to %g s",
                            key->least, key->greatest);
    }
}

/* Reads a list of [s, 1/s] with rising times. */
void jox_key_read_curve(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    JoxAgentSource *source = item;
    if (!node)
        return;
    if (node->kind != JOX_YAML_LIST || node->count < 2 || node->count > MOST_TIMES) {
        jox_scene_error(r, node, "bad-type", key->example,
                        "%s is a list of 2 to %d of [s, agents a second]", key->name, MOST_TIMES);
        return;
    }
    source->curve = jox_arena_take(r->arena, 2 * (size_t)node->count, sizeof *source->curve);
    for (uint32_t k = 0; k < node->count; k++) {
        const JoxYaml *row = node->items[k];
        double *out = source->curve + 2 * source->curve_count;
        if (row->kind != JOX_YAML_LIST || row->count != 2) {
            jox_scene_error(r, row, "bad-type", key->example, "this must be [s, agents a second]");
            continue;
        }
        if (!jox_read_number(r, row->items[0], "s", &out[0]) ||
            !jox_read_number(r, row->items[1], "1/s", &out[1]))
            continue;
        const bool later = source->curve_count == 0 ? out[0] >= 0.0 : out[0] > out[-2];
        if (!later || !(out[0] <= 1e6) || !(out[1] >= 0.0 && out[1] <= 1000.0))
            jox_scene_error(r, row, "out-of-range", key->example,
                            "times rise, from 0 to 1e6 s, and rates are from 0 to 1000 1/s");
        else
            source->curve_count++;
    }
}

bool jox_finish_source(const JoxReader *r, const JoxYaml *map, void *item, bool good) {
    JoxAgentSource *source = item;
    const JoxSceneSpec *s = r->draft->scene;
    (void)good;
    source->every = isfinite(source->every) ? source->every : 0.0;
    if (source->people > 0 && source->every == 0.0 && !jox_yaml_get(map, "times"))
        jox_scene_error(r, jox_yaml_get(map, "people"), "bad-value", "every: 2 min",
                        "people come at times: give `every` or `times`");
    if (source->people == 0 && (source->every > 0.0 || source->time_count > 0))
        source->people = 1;
    if (source->rate == 0 && source->keep == 0 && source->people == 0 &&
        !jox_yaml_get(map, "curve") && !jox_yaml_get(map, "times"))
        jox_scene_error(r, map, "missing-key", "rate: 2, or keep: 1000",
                        "a source needs a rate, a number to keep, times or a curve");
    /* -1: no such name */
    if ((int32_t)source->place < 0 || (int32_t)source->like < 0)
        return false;
    JOX_ASSERT(source->place < s->place_count && source->like < s->group_count);
    refuse_antipode(r, jox_yaml_get(map, "like"), &s->groups[source->like]);
    return true;
}

bool jox_finish_sink(const JoxReader *r, const JoxYaml *map, void *item, bool good) {
    (void)r, (void)map, (void)good;
    return (int32_t)((const JoxAgentSink *)item)->place >= 0; /* -1: no such name */
}
