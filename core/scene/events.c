/* Reads events: what happens at given times, to bodies, walls or people. */
#include <math.h>
#include <string.h>

#include "base/assert.h"
#include "scene/scene_draft.h"

enum { LONGEST_NAME = 60 };

static bool is_static_body(const JoxBodyDef *def) {
    return def->still ||
           (def->shape.kind != JOX_SHAPE_COMPOUND && def->mass <= 0 && def->density <= 0);
}

/* Checks the name of a body that is "thrown", "pushed" (then it must have mass) or "moved"
   (kinematic). */
static void check_event_body(const JoxReader *r, const JoxYaml *name, const char *done) {
    const bool moved = strcmp(done, "moved") == 0;
    const char *names[256];
    uint32_t count = 0;
    for (uint32_t b = 0; b < r->draft->scene->body_count; b++) {
        const JoxBodyDef *def = &r->draft->scene->bodies[b].def;
        if (def->name && strcmp(def->name, name->text) == 0) {
            if (moved && !def->kinematic)
                jox_scene_error(r, name, "bad-event", "Throw or push it, or add `kinematic: true`",
                                "the body '%.60s' is not kinematic: it has no velocity of its own",
                                name->text);
            else if (!moved && is_static_body(def))
                jox_scene_error(r, name, "bad-event",
                                def->kinematic ? "Write move: NAME, velocity: [0.5, 0, 0]"
                                               : "Give it a mass above 0",
                                "the body '%.60s' is %s: it cannot be %s", name->text,
                                def->kinematic ? "kinematic" : "static", done);
            return;
        }
        if (def->name && count < 256)
            names[count++] = def->name;
    }
    jox_scene_error(r, name, "unknown-body",
                    count ? jox_scene_suggest(r, name->text, names, count)
                          : "Give bodies names: {name: crate, ...}",
                    "there is no body named '%.60s'", name->text);
}

/* Checks the name of what is pushed: people who stand in a place, or a body. */
static void check_pushed_name(const JoxReader *r, const JoxYaml *name, JoxEvent *event) {
    const JoxSceneSpec *s = r->draft->scene;
    bool body = false;
    event->place = jox_place_find(s->places, s->place_count, name->text);
    for (uint32_t b = 0; b < s->body_count; b++)
        body |= s->bodies[b].def.name && strcmp(s->bodies[b].def.name, name->text) == 0;
    if (event->place < 0)
        check_event_body(r, name, "pushed");
    else if (body)
        jox_scene_error(r, name, "bad-event", "Give one of them another name",
                        "'%.60s' is a place and a body: it is not clear which is pushed",
                        name->text);
}

/* Reads the name of the body, wall or place that the event acts on, or of its signal. */
void jox_key_read_event_name(const JoxReader *r, const JoxKey *key, const JoxYaml *node,
                             void *item) {
    JoxEvent *event = item;
    if (!jox_key_read_scalar(r, key, node, "name"))
        return;
    if (event->kind == JOX_EVENT_THROW)
        check_event_body(r, node, "thrown");
    else if (event->kind == JOX_EVENT_MOVE)
        check_event_body(r, node, "moved");
    else if (event->kind == JOX_EVENT_PUSH)
        check_pushed_name(r, node, event);
    else if (event->kind == JOX_EVENT_LIFT)
        jox_scene_check_lift(r, node);
    else if (event->kind != JOX_EVENT_SIGNAL)
        jox_scene_check_wall(r, node, true);
    else if (!*node->text || strlen(node->text) > LONGEST_NAME)
        jox_scene_error(r, node, "bad-event", NULL, "a signal's name has from 1 to %d bytes",
                        LONGEST_NAME);
    event->name = jox_arena_text(r->arena, node->text);
    event->position = node->position;
}

static void check_throw_keys(const JoxReader *r, const JoxYaml *map, const JoxEvent *event) {
    static const char *const KEYS[] = {"from", "velocity", "spin"};
    bool any = false;
    for (int k = 0; k < 3; k++) {
        const JoxYaml *node = jox_yaml_get(map, KEYS[k]);
        if (node && event->kind != JOX_EVENT_THROW && (k == 0 || event->kind != JOX_EVENT_MOVE))
            jox_scene_error(r, node, "bad-event", NULL, "%s belongs to a throw%s", KEYS[k],
                            k ? " or a move" : "");
        any |= node != NULL;
    }
    if (event->kind == JOX_EVENT_THROW && !any)
        jox_scene_error(r, map, "bad-event", "velocity: [5, 0, 3]",
                        "a throw needs a velocity, a spin or a point that it is from");
    if (event->kind == JOX_EVENT_MOVE && !any)
        jox_scene_error(r, map, "bad-event", "velocity: [0.5, 0, 0]",
                        "a move needs a velocity or a spin, of zeros where the body is to stand");
}

static void check_push_keys(const JoxReader *r, const JoxYaml *map, const JoxEvent *event) {
    const JoxYaml *force = jox_yaml_get(map, "force"), *lasts = jox_yaml_get(map, "lasts");
    if (event->kind != JOX_EVENT_PUSH) {
        if (force || lasts)
            jox_scene_error(r, force ? force : lasts, "bad-event", NULL, "%s belongs to a push",
                            force ? "force" : "lasts");
    } else if (!force || !lasts) {
        jox_scene_error(r, map, "bad-event", "force: [200, 0], lasts: 3",
                        "a push needs a force (N) and how long it lasts (s)");
    } else if (event->every > 0.0 && event->lasts > event->every) {
        jox_scene_error(r, lasts, "bad-event", NULL,
                        "this push lasts longer (%g s) than until it comes again (%g s)",
                        event->lasts, event->every);
    }
}

static void check_lift_keys(const JoxReader *r, const JoxYaml *map, const JoxEvent *event) {
    const JoxYaml *mode = jox_yaml_get(map, "mode");
    if (mode && event->kind != JOX_EVENT_LIFT)
        jox_scene_error(r, mode, "bad-event", NULL, "mode belongs to a lift");
    else if (!mode && event->kind == JOX_EVENT_LIFT)
        jox_scene_error(r, map, "bad-event", "mode: out_of_use",
                        "an event of a lift says which mode it has from then on");
}

bool jox_finish_event(const JoxReader *r, const JoxYaml *map, void *item, bool good) {
    JoxEvent *event = item;
    const JoxYaml *until = jox_yaml_get(map, "until");
    (void)good;
    if (!event->name)
        return false;
    event->placed = jox_yaml_get(map, "from") != NULL;
    if (jox_yaml_get(map, "storey") && !event->placed)
        jox_scene_error(r, jox_yaml_get(map, "storey"), "bad-event", "from: [2, 3, 1.5]",
                        "`storey` is for a throw `from` a point; else the event is where its "
                        "place or body is");
    event->every = isfinite(event->every) ? event->every : 0.0;
    check_throw_keys(r, map, event);
    check_push_keys(r, map, event);
    check_lift_keys(r, map, event);
    if (until && !jox_yaml_get(map, "every"))
        jox_scene_error(r, until, "bad-event", "every: 5",
                        "until belongs to an event that is repeated");
    else if (until && event->until < event->at)
        jox_scene_error(r, until, "bad-event", NULL,
                        "this event ends (%g s) before it begins (%g s)", event->until, event->at);
    JOX_ASSERT(event->every >= 0.0);
    return true;
}
