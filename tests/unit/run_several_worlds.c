/* Tests several worlds in one process, each in a thread of its own: their results equal those of
 * runs one after another, as they share neither Bullet, Lua, error reports nor threads. */
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "body/body.h"
#include "jostle.h"
#include "messages.h"

enum { SCENES = 4, AT_ONCE = 8, STEPS = 60 };
static const char *const PATHS[SCENES] = {"scenes/dodgeball.yaml", "scenes/tackle.yaml",
                                          "scenes/gates.yaml", "scenes/catch.yaml"};

typedef struct World {
    uint32_t scene;
    uint64_t hash;
    bool refused; /* an invalid scene was refused with its own error */
} World;

/* Calls nothing of cmocka, which is not thread-safe: failures show in the hash. */
static void *run_world(void *argument) {
    World *world = argument;
    JoError error = {0};
    JoSceneDef def = jo_default_scene_def();
    def.path = PATHS[world->scene];
    def.threads = 2;
    def.message = ignore_message;
    JoScene *scene = jo_scene_load(&def, &error);
    for (int n = 0; scene && n < STEPS; n++)
        if (!jo_scene_step(scene, &error))
            return NULL;
    if (scene)
        world->hash = jo_world_hash(jo_scene_world(scene));
    jo_scene_free(scene);
    def.text = "jostle: 1\nnonsense: 1\n";
    def.text_length = strlen(def.text);
    world->refused = !jo_scene_load(&def, &error) && strcmp(error.file, def.path) == 0 &&
                     strstr(error.text, "nonsense");
    return NULL;
}

static void worlds_in_threads_do_not_affect_each_other(void **state) {
    (void)state;
    if (!jox_bodies_available())
        skip();
    World alone[SCENES] = {{0}}, together[AT_ONCE] = {{0}};
    pthread_t threads[AT_ONCE];
    for (uint32_t n = 0; n < SCENES; n++) {
        alone[n].scene = n;
        run_world(&alone[n]);
        assert_true(alone[n].hash != 0);
    }
    for (uint32_t n = 0; n < AT_ONCE; n++) {
        together[n].scene = n % SCENES;
        assert_int_equal(pthread_create(&threads[n], NULL, run_world, &together[n]), 0);
    }
    for (uint32_t n = 0; n < AT_ONCE; n++)
        assert_int_equal(pthread_join(threads[n], NULL), 0);
    for (uint32_t n = 0; n < AT_ONCE; n++) {
        assert_true(together[n].hash == alone[n % SCENES].hash);
        assert_true(together[n].refused);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(worlds_in_threads_do_not_affect_each_other)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
