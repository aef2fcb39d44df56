/* The functions of the WebAssembly module that read a scene between two steps, and those that need
   no scene. */
#include <assert.h>
#include <math.h>
#include <stdio.h>

#include "base/guard.h"
#include "base/mem.h"
#include "jostle_tools.h"
#include "wasm/module_scene.h"
#include "world/world.h"

static JoWorld *find_world(const JoxModuleScene *s) {
    return jo_scene_world(s->page.scene);
}

/* Answers the hash as 16 hexadecimal digits. */
JOX_MODULE_CALL bool jostle_hash(const JoxModuleScene *s) {
    JOX_GUARD (NULL, NULL)
        return false;
    JoxText text = {0};
    jox_text_printf(&text, "%016llx", (unsigned long long)jo_world_hash(find_world(s)));
    jox_module_answer(&text);
    return true;
}

JOX_MODULE_CALL double jostle_time(const JoxModuleScene *s) {
    return jo_world_time(find_world(s));
}

JOX_MODULE_CALL double jostle_tick(const JoxModuleScene *s) {
    return (double)jo_world_tick(find_world(s));
}

/* Returns the time that the scene lasts, s, as its file says. */
JOX_MODULE_CALL double jostle_duration(const JoxModuleScene *s) {
    return jo_scene_duration(s->page.scene);
}

JOX_MODULE_CALL uint32_t jostle_agents(const JoxModuleScene *s) {
    return jo_world_agent_count(find_world(s));
}

/* Returns a column, valid until the next call. */
JOX_MODULE_CALL const JoColumn *jostle_column(const JoxModuleScene *s, const char *name) {
    static JoColumn column;
    column = jo_world_column(find_world(s), name);
    return &column;
}

/* Returns the number of slots of bodies. */
JOX_MODULE_CALL uint32_t jostle_body_slots(const JoxModuleScene *s) {
    return jox_bodies_rows(find_world(s)->state.bodies);
}

/* Returns the state of a body, ten numbers in the order of JoBodyState, valid until the next call;
   NULL if the slot is free. */
JOX_MODULE_CALL const JoBodyState *jostle_body(const JoxModuleScene *s, uint32_t slot) {
    static JoBodyState state;
    const JoBody body = jo_world_body_at(find_world(s), slot);
    state = jo_body_state(find_world(s), body);
    return body.generation ? &state : NULL;
}

static_assert(sizeof(JoTransitionEvent) == 16 && sizeof(JoTouchEvent) == 20 &&
                  sizeof(JoHitEvent) == 24 && sizeof(JoBreakEvent) == 12 &&
                  sizeof(JoPresenceEvent) == 16 && sizeof(JoSaidEvent) == 16 &&
                  sizeof(JoActionEvent) == 20,
              "engine.mjs reads events by these layouts");

/* Returns the events of the last step, valid until the next call for the scene. */
JOX_MODULE_CALL const JoEvents *jostle_events(const JoxModuleScene *s) {
    static JoEvents events;
    events = jo_world_events(find_world(s));
    return &events;
}

/* Kinds of names, as engine.mjs counts them. */
enum { GROUP, MACHINE, STATE, SIGNAL, PLACE, BODY };

/* Returns the name of a number in columns and events; `of`: the machine of a state. */
JOX_MODULE_CALL const char *jostle_name(const JoxModuleScene *s, int kind, uint32_t of,
                                        uint32_t number) {
    const JoWorld *world = find_world(s);
    switch (kind) {
    case GROUP:
        return jo_world_group_name(world, number);
    case MACHINE:
        return jo_world_machine_name(world, number);
    case STATE:
        return jo_world_state_name(world, of, number);
    case SIGNAL:
        return jo_world_signal_name(world, number);
    case PLACE:
        return jo_world_place_name(world, number);
    case BODY:
        return jo_world_body_name(world, number);
    default:
        return "";
    }
}

/* Answers what pages draw of the scene besides people (jo_scene_plan). */
JOX_MODULE_CALL bool jostle_plan(const JoxModuleScene *s) {
    return jox_module_answer_text(jo_scene_plan(s->page.scene));
}

/* Answers the figures of the run so far, as `jostle run --summary` writes them. */
JOX_MODULE_CALL bool jostle_summary(const JoxModuleScene *s) {
    return jox_module_answer_text(jo_scene_summary(s->page.scene));
}

/* ---- without a scene ---- */

static void answer_message(void *context, const char *text) {
    JoxText copy = {0};
    (void)context;
    jox_text_add(&copy, text);
    jox_module_answer(&copy);
}

/* Answers what is wrong with a file, as `jostle check --json` does. */
JOX_MODULE_CALL bool jostle_check(const char *path) {
    JoError error = {0};
    const size_t errors = jo_check(&path, 1, true, answer_message, NULL, &error);
    if (errors == SIZE_MAX)
        jox_module_answer_error(&error);
    return errors != SIZE_MAX;
}

/* Answers a page of `jostle reference` by its name. */
JOX_MODULE_CALL bool jostle_reference(const char *what) {
    return jox_module_answer_text(jo_reference(what));
}

/* For tests: memory is out after `count` more allocations, until the next call; negative: never. */
JOX_MODULE_CALL void jostle_fail_memory_after(double count) {
    jox_alloc_fail_after(count < 0.0 ? UINT64_MAX : (uint64_t)count);
}

JOX_MODULE_CALL const char *jostle_version(void) {
    return jo_version();
}
