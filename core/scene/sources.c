/* Sources and sinks of a scene. */
#include "base/assert.h"
#include "scene/internal.h"

/* The point opposite on the circle is that of agents who stand on it at the start. */
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

bool jox_finish_source(const JoxReader *r, const JoxYaml *map, void *item, bool good) {
    JoxAgentSource *source = item;
    const JoxSceneSpec *s = r->load->scene;
    (void)good;
    if (source->rate == 0 && source->keep == 0)
        jox_scene_error(r, map, "missing-key", "rate: 2, or keep: 1000",
                        "a source needs a rate or a number to keep");
    /* -1: there is none of the name */
    if ((int32_t)source->place < 0 || (int32_t)source->like < 0)
        return false;
    JOX_ASSERT(source->place < s->place_count && source->like < s->group_count);
    if (s->places[source->place].kind == JOX_PLACE_SET)
        jox_scene_error(r, jox_yaml_get(map, "at"), "bad-place", NULL,
                        "a source cannot be at a set");
    refuse_antipode(r, jox_yaml_get(map, "like"), &s->groups[source->like]);
    return true;
}

bool jox_finish_sink(const JoxReader *r, const JoxYaml *map, void *item, bool good) {
    (void)r, (void)map, (void)good;
    return (int32_t)((const JoxAgentSink *)item)->place >= 0; /* -1: there is none of the name */
}
