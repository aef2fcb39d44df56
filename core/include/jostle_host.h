/* Part of jostle.h, which includes it: resources that a program may provide in place of the
 * engine's own: memory, threads, files. */
#ifndef JOSTLE_HOST_H
#define JOSTLE_HOST_H

#include "jostle.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Memory functions that replace the C library's. They are called from any thread, also at the
   same time; the memory that they return is aligned to 16 bytes. */
typedef struct JoAllocator {
    void *(*allocate)(void *context, size_t bytes); /* NULL: memory is out */
    void *(*reallocate)(void *context, void *memory,
                        size_t bytes); /* NULL: memory is out, and the old block stays */
    void (*release)(void *context, void *memory);
    void *context;
} JoAllocator;
/* Sets the allocator of the engine and Lua; it is copied. Other libraries (Bullet, libyaml,
   SQLite, the C library) keep their own. False, with `error` filled, once anything was
   allocated: make it the first call of a program. NULL restores the C library's functions. */
JO_API bool jo_set_allocator(const JoAllocator *allocator, JoError *error);

/* Thread pool of a program, in place of the engine's threads: `jobs` of JoWorldDef and
   JoSceneDef. */
typedef struct JoJobs {
    /* Calls job(data, n) once for each n below `count`, in parallel on as many threads as there
       are, and returns when all calls have returned. No job waits for another. `count` is at
       most the world's number of threads; the calling thread may take part. */
    void (*run)(void *context, uint32_t count, void (*job)(void *data, uint32_t n), void *data);
    void *context;
} JoJobs;

/* File in memory, an item of JoSceneDef.files. Its path is resolved from the scene's own path,
   without '.' and '..': for a scene "game/scenes/hall.yaml" that names `walker.lua`,
   "game/behaviours/walker.lua". */
typedef struct JoFile {
    const char *path, *text;
    size_t length; /* bytes */
} JoFile;

#ifdef __cplusplus
}
#endif

#endif
