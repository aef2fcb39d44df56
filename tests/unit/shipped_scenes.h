/* Loads the shipped scenes, each with few people. Shared by tests that run all of them. */
#ifndef JOX_TESTS_SHIPPED_SCENES_H
#define JOX_TESTS_SHIPPED_SCENES_H

#include <glob.h>

#include "unit/scene_loader.h"

/* Loads a scene with at most 100 people in each group and source, without densities. */
static inline JoScene *load_small_scene(const char *path) {
    enum { MOST = 64, MOST_PEOPLE = 100 };
    static char texts[MOST][160];
    const char *sets[MOST];
    size_t count = 0;
    JoxDiagnostics diagnostics = {0};
    JoxSceneSpec *spec = jox_scene_read(path, NULL, &diagnostics);
    jox_diag_free(&diagnostics);
    assert_non_null(spec);
    for (uint32_t g = 0; g < spec->group_count && count < MOST; g++)
        if (spec->groups[g].count > MOST_PEOPLE && spec->groups[g].fill != JOX_FILL_AT) {
            snprintf(texts[count], sizeof *texts, "groups.%s.count=%d", spec->groups[g].name,
                     MOST_PEOPLE);
            sets[count] = texts[count];
            count++;
        }
    for (uint32_t s = 0; s < spec->source_count && count < MOST; s++)
        if (spec->sources[s].keep > MOST_PEOPLE) {
            snprintf(texts[count], sizeof *texts, "sources.%u.keep=%d", s, MOST_PEOPLE);
            sets[count] = texts[count];
            count++;
        }
    jox_scene_free(spec);
    return load_scene_file(path, sets, count);
}

/* Calls `visit` for each scene of scenes/, in order of names, and returns their count. */
static inline size_t visit_shipped_scenes(void (*visit)(const char *path)) {
    glob_t scenes;
    assert_int_equal(glob("scenes/*.yaml", 0, NULL, &scenes), 0);
    const size_t count = scenes.gl_pathc;
    for (size_t s = 0; s < count; s++)
        visit(scenes.gl_pathv[s]);
    globfree(&scenes);
    return count;
}

#endif
