/* Subnormal numbers: the engine computes with them, whatever the program that calls it does, and
   leaves the program's setting as it was. */
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "base/guard.h"
#include "base/mem.h"
#include "jostle_read.h"
#include "task/pool.h"

static bool has_subnormals(void) {
    volatile float tiny = FLT_MIN;
    tiny = tiny * 0.5f;
    return tiny + tiny > 0.0f;
}

/* Messages, and how many came while subnormal numbers were flushed, as the program had set it. */
typedef struct Heard {
    uint32_t all, flushed;
} Heard;

static void hear(void *context, const char *text) {
    (void)text;
    Heard *heard = context;
    heard->all++;
    heard->flushed += !has_subnormals();
}

/* Each thread of a loop. */
static void look(void *context, uint32_t begin, uint32_t end, uint32_t worker) {
    (void)worker;
    for (uint32_t k = begin; k < end; k++)
        ((bool *)context)[k] = has_subnormals();
}

/* The settings of a program that flushes. */
static JoxNumeric flushing(void) {
    JoxNumeric numeric = jox_numeric_plain();
#if defined __x86_64__ || defined __i386__
    numeric.mode = 0x8040; /* FTZ and DAZ */
#elif defined __aarch64__
    numeric.mode = 1u << 24; /* FZ */
#endif
    return numeric;
}

/* A public call that calls a callback, as the innermost of `depth` calls. */
static void call_back(uint32_t depth, Heard *heard) {
    JoError error = {0};
    JOX_GUARD (NULL, &error)
        return;
    if (depth > 1) {
        call_back(depth - 1, heard);
        return;
    }
    const JoxHeap *used = jox_heap_used();
    const JoxOutside outside = jox_guard_leave();
    assert_null(jox_heap_used()); /* the program owns its memory */
    hear(heard, "");
    jox_guard_return(outside);
    assert_ptr_equal(jox_heap_used(), used);
    assert_true(has_subnormals());
}

/* A callback has the program's settings also where a public call makes another one. */
static void calls_within_calls_leave_all(void **state) {
    (void)state;
    Heard heard = {0};
    const JoxNumeric before = jox_numeric_use(flushing());
    assert_false(has_subnormals());
    for (uint32_t depth = 1; depth <= 3; depth++)
        call_back(depth, &heard);
    assert_false(has_subnormals());
    assert_int_equal(heard.flushed, 3);
    jox_numeric_use(before);
}

static JoSceneDef def_of(const char *path, uint32_t threads, Heard *heard) {
    JoSceneDef def = jo_default_scene_def();
    def.path = path;
    def.threads = threads;
    def.message = hear;
    def.message_context = heard;
    return def;
}

static JoScene *load(const char *path, uint32_t threads, Heard *heard) {
    JoError error = {0};
    const JoSceneDef def = def_of(path, threads, heard);
    JoScene *scene = jo_scene_load(&def, &error);
    if (!scene)
        fail_msg("%s:%d: %s", error.file, error.line, error.text);
    return scene;
}

/* Calls, those that fail too, leave what a program does with subnormal numbers as it was, and a
   callback of it does the same. */
static void a_program_keeps_its_own(void **state) {
    (void)state;
    const JoxNumeric before = jox_numeric_use(jox_numeric_plain());
    for (int flushed = 0; flushed < 2; flushed++) {
        JoError error = {0};
        Heard heard = {0};
        jox_numeric_use(flushed ? flushing() : jox_numeric_plain());
        JoScene *scene = load("scenes/bottleneck.yaml", 2, &heard);
        assert_int_equal(has_subnormals(), !flushed);
        for (int k = 0; k < 20; k++)
            assert_true(jo_scene_step(scene, &error));
        assert_true(jo_scene_finish(scene, &error));
        jo_scene_free(scene);
        assert_int_equal(has_subnormals(), !flushed);
        JoSceneDef def = def_of("no such scene", 2, &heard);
        assert_null(jo_scene_load(&def, &error));
        assert_int_equal(has_subnormals(), !flushed);
        assert_true(heard.all > 0 && heard.flushed == (flushed ? heard.all : 0));
    }
    jox_numeric_use(before);
}

static void threads_have_them(void **state) {
    (void)state;
    bool has[64];
    JoxPool *pool = jox_pool_create(4);
    const JoxNumeric before = jox_numeric_use(jox_numeric_plain());
    for (int round = 0; round < 20; round++) {
        jox_parallel_for(pool, 64, 1, look, has);
        for (int k = 0; k < 64; k++)
            assert_true(has[k]);
    }
    jox_numeric_use(before);
    jox_pool_free(pool);
}

static uint32_t subnormal_in(JoScene *scene, const char *name) {
    const JoColumn column = jo_world_column(jo_scene_world(scene), name);
    uint32_t count = 0;
    assert_true(column.count > 1000 && column.type == JO_F32);
    for (uint32_t i = 0; i < column.count; i++) {
        const float *value = (const void *)((const char *)column.data + i * column.stride);
        count += fpclassify(*value) == FP_SUBNORMAL;
    }
    return count;
}

/* People who walk straight ahead lose what they moved across their way, bit by bit. */
static void what_decays_ends(void **state) {
    (void)state;
    JoError error = {0};
    Heard heard = {0};
    JoScene *scene = load("scenes/one-way.yaml", 1, &heard);
    for (int k = 0; k < 120; k++) {
        assert_true(jo_scene_step(scene, &error));
        assert_int_equal(subnormal_in(scene, "vy"), 0);
    }
    jo_scene_free(scene);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_program_keeps_its_own),
        cmocka_unit_test(calls_within_calls_leave_all),
        cmocka_unit_test(threads_have_them),
        cmocka_unit_test(what_decays_ends),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
