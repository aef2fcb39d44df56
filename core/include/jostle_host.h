/* What a program that embeds Jostle may give it: memory, threads, files. Comes with jostle.h. */
#ifndef JOSTLE_HOST_H
#define JOSTLE_HOST_H

#include "jostle.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Functions for memory, in place of the C library's. They are called from any thread, and at the
   same time; what they give is aligned to 16 bytes. */
typedef struct JoAllocator {
    void *(*allocate)(void *context, size_t bytes); /* NULL: memory is out */
    void *(*reallocate)(void *context, void *memory,
                        size_t bytes); /* NULL: and the old one stays */
    void (*release)(void *context, void *memory);
    void *context;
} JoAllocator;
/* All that the engine and Lua allocate comes from it from here on; it is copied. What other
   libraries allocate for themselves (Bullet, libyaml, SQLite, the C library) does not. False, with
   an error, once anything was allocated: this is the first call of a program. NULL: the C library's
   again. */
JO_API bool jo_set_allocator(const JoAllocator *allocator, JoError *error);

/* A program's own threads, in place of the engine's: `jobs` of JoWorldDef and JoSceneDef. */
typedef struct JoJobs {
    /* Calls job(data, n) once for each n below `count`, on whatever threads, at the same time as
       far as there are some, and returns when all have returned. No call waits for another. `count`
       is at most the world's number of threads; the calling thread may take part. */
    void (*run)(void *context, uint32_t count, void (*job)(void *data, uint32_t n), void *data);
    void *context;
} JoJobs;

/* A file in memory: `files` of JoSceneDef. Its path is as the scene's own path leads to it, without
   '.' and '..': of a scene "game/scenes/hall.yaml" that names `walker.lua`,
   "game/behaviours/walker.lua". */
typedef struct JoFile {
    const char *path, *text;
    size_t length; /* bytes */
} JoFile;

#ifdef __cplusplus
}
#endif

#endif
