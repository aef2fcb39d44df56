/* A program that gives the engine its own memory, threads and files: a scene from memory, whose
   steps run on two threads of the program's. */
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>

#include <jostle.h>

static const char SCENE[] =
    "jostle: 1\n"
    "places:\n"
    "  far: {point: [60, 20]}\n"
    "  field: {polygon: [[0, 0], [40, 0], [40, 40], [0, 40]]}\n"
    "groups: {crowd: {behaviour: walk.lua, count: 2000, fill: random, in: field}}\n";
static const char WALK[] =
    "return machine { name = 'walk', start = 'Walk', states = {\n"
    "  Walk = { steer = seek 'far', { to = 'Rest', when = near('far', 3) } },\n"
    "  Rest = { steer = hold } } }\n";

static atomic_long blocks;
static atomic_ulong calls;

static void *allocate(void *context, size_t bytes) {
    (void)context;
    atomic_fetch_add(&blocks, 1);
    return malloc(bytes);
}
static void *reallocate(void *context, void *memory, size_t bytes) {
    (void)context;
    return realloc(memory, bytes);
}
static void release_memory(void *context, void *memory) {
    (void)context;
    atomic_fetch_sub(&blocks, 1);
    free(memory);
}

/* A game would hand these to the threads that it has; here each call starts one. */
typedef struct Call {
    void (*job)(void *data, uint32_t n);
    void *data;
    uint32_t n;
} Call;
static void *call(void *argument) {
    const Call *c = argument;
    c->job(c->data, c->n);
    return NULL;
}
static void run_loop(void *context, uint32_t count, void (*job)(void *data, uint32_t n),
                     void *data) {
    pthread_t threads[2];
    Call calls_of[2];
    (void)context;
    atomic_fetch_add(&calls, 1);
    for (uint32_t n = 1; n < count; n++) {
        calls_of[n] = (Call){job, data, n};
        if (pthread_create(&threads[n], NULL, call, &calls_of[n]) != 0)
            abort();
    }
    job(data, 0);
    for (uint32_t n = 1; n < count; n++)
        pthread_join(threads[n], NULL);
}

int main(void) {
    const JoAllocator allocator = {allocate, reallocate, release_memory, NULL};
    const JoJobs jobs = {run_loop, NULL};
    const JoFile files[] = {{"game/hall.yaml", SCENE, sizeof SCENE - 1},
                            {"game/walk.lua", WALK, sizeof WALK - 1}};
    JoError error = {0};
    if (!jo_set_allocator(&allocator, &error))
        return fprintf(stderr, "%s\n", error.text), 1;
    uint64_t hashes[2];
    for (int own = 0; own < 2; own++) {
        JoSceneDef def = jo_default_scene_def();
        def.path = "game/hall.yaml";
        def.files = files;
        def.file_count = 2;
        def.files_only = true;
        def.threads = 2;
        def.jobs = own ? &jobs : NULL;
        JoScene *scene = jo_scene_load(&def, &error);
        for (int step = 0; scene && step < 20; step++)
            if (!jo_scene_step(scene, &error))
                return fprintf(stderr, "%s\n", error.text), 1;
        if (!scene)
            return fprintf(stderr, "%s:%d: %s\n", error.file, error.line, error.text), 1;
        hashes[own] = jo_world_hash(jo_scene_world(scene));
        printf("%ld blocks, %lu loops on the program's threads, hash %016llx\n", blocks, calls,
               (unsigned long long)hashes[own]);
        jo_scene_free(scene);
    }
    printf("%ld blocks are left\n", blocks);
    return hashes[0] != hashes[1] || calls == 0 || blocks != 0;
}
