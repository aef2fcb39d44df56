/* Behaviours whose files changed are loaded afresh and swapped between two steps. */
#include <string.h>

#include "base/mem.h"
#include "host/host.h"

static void watch_files(JoScene *scene, const JoxMachine *machine) {
    uint32_t count;
    const JoxLuaFile *files = jox_lua_files(scene->lua, machine, &count);
    for (uint32_t f = 0; f < count; f++)
        jox_watch_add(scene->watch, files[f].path);
}

bool jo_scene_watch(JoScene *scene, JoError *error) {
    if (!scene->watch && !(scene->watch = jox_watch_create())) {
        jox_host_fail(error, JO_FAILED, "the system does not let files be watched");
        return false;
    }
    for (uint32_t m = 0; m < scene->world->mind.machine_count; m++)
        watch_files(scene, scene->world->mind.machines[m]);
    return true;
}

static bool is_made_of(const JoScene *scene, const JoxMachine *machine, const char *path) {
    uint32_t count;
    const JoxLuaFile *files = jox_lua_files(scene->lua, machine, &count);
    for (uint32_t f = 0; f < count; f++)
        if (strcmp(files[f].path, path) == 0)
            return true;
    return false;
}

/* "Circle 31,204  Exit 310": agents per state. */
static void print_census(const JoScene *scene, uint32_t index, JoxText *out) {
    const JoxMind *mind = &scene->world->mind;
    const JoxMachine *machine = mind->machines[index];
    for (uint32_t s = 0; s < machine->state_count; s++) {
        uint32_t people = 0;
        for (uint32_t i = 0; i < mind->agents->count; i++)
            people += mind->agents->machine[i] == index && mind->agents->state[i] == s;
        if (people)
            jox_text_printf(out, "  %s %u", machine->states[s].name, people);
    }
}

/* What a group sets must still exist, else the next source would have nothing to fill. */
static void reload(JoScene *scene, uint32_t index) {
    JoxMind *mind = &scene->world->mind;
    const JoxMachine *now = mind->machines[index];
    JoxDiagnostics diagnostics = {0};
    JoxMachine *next = jox_lua_load(scene->lua, now->path, &scene->scope, &diagnostics);
    char why[256];
    const char *refused = next ? jox_mind_refuses(mind, index, next, why, sizeof why) : NULL;
    bool loaded = next != NULL;
    jox_host_report(scene->message, scene->message_context, &diagnostics, NULL);
    if (!loaded || refused) {
        jox_host_say(scene, "%s%s%s Version %u keeps running; %u agents unaffected.\n",
                     refused ? now->path : "", refused ? ": " : "", refused ? refused : "",
                     now->version, mind->agents->count);
        jox_lua_release(scene->lua, next);
        jox_machine_free(next);
        return;
    }
    JoxText before = {0}, after = {0};
    print_census(scene, index, &before);
    double begun = jox_clock_wall();
    JoxMachine *old = jox_mind_replace(mind, index, next);
    double took = jox_clock_wall() - begun;
    print_census(scene, index, &after);
    jox_host_say(scene,
                 "%s: version %u is live from t = %.2f s (swapped in %.2f ms)\n before:%s\n"
                 " after: %s\n",
                 next->path, next->version, jo_world_time(scene->world), took * 1e3,
                 before.data ? before.data : "", after.data ? after.data : "");
    jox_text_free(&before);
    jox_text_free(&after);
    jox_lua_release(scene->lua, old);
    jox_machine_free(old);
    watch_files(scene, next);
}

static void changed(void *context, const char *path) {
    JoScene *scene = context;
    for (uint32_t m = 0; m < scene->world->mind.machine_count; m++)
        if (is_made_of(scene, scene->world->mind.machines[m], path))
            reload(scene, m);
}

void jox_host_reload(JoScene *scene) {
    if (scene->watch)
        jox_watch_poll(scene->watch, changed, scene);
}
