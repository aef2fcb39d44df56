#include "fuzz.h"

#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/text.h"

enum { PATHS = 4 };
static char folder[128];

void fuzz_failed(const char *condition, const char *file, int line) {
    fprintf(stderr, "%s:%d: does not hold: %s\n", file, line, condition);
    abort();
}

char *fuzz_text(const uint8_t *data, size_t size) {
    char *text = malloc(size + 1);
    if (!text)
        abort();
    if (size)
        memcpy(text, data, size);
    text[size] = 0;
    return text;
}

static int remove_one(const char *path, const struct stat *info, int kind, struct FTW *walk) {
    (void)info;
    (void)kind;
    (void)walk;
    return remove(path);
}

static void remove_fuzz_folder(void) {
    nftw(folder, remove_one, 16, FTW_DEPTH | FTW_PHYS);
}

const char *fuzz_path(const char *name) {
    static char paths[PATHS][256];
    static int next;
    if (!*folder) {
        const char *outer = getenv("TMPDIR");
        if (!outer || !*outer || strlen(outer) > sizeof folder / 2)
            outer = "/tmp";
        snprintf(folder, sizeof folder, "%s/jostle-fuzz-XXXXXX", outer);
        if (!mkdtemp(folder))
            abort();
        atexit(remove_fuzz_folder);
    }
    next = (next + 1) % PATHS;
    snprintf(paths[next], sizeof paths[next], "%s/%s", folder, name);
    return paths[next];
}

const char *fuzz_write(const char *name, const void *data, size_t size) {
    const char *path = fuzz_path(name);
    for (const char *slash = strchr(name, '/'); slash; slash = strchr(slash + 1, '/')) {
        char outer[128];
        snprintf(outer, sizeof outer, "%.*s", (int)(slash - name), name);
        mkdir(fuzz_path(outer), 0700);
    }
    FILE *file = fopen(path, "wb");
    if (!file || fwrite(data, 1, size, file) != size || fclose(file) != 0)
        abort();
    return path;
}

void fuzz_end_diagnostics(JoxDiagnostics *diagnostics) {
    JoxText out = {0};
    for (size_t i = 0; i < diagnostics->count; i++) {
        FUZZ_CHECK(diagnostics->items[i].message && *diagnostics->items[i].message);
        FUZZ_CHECK(diagnostics->items[i].code);
    }
    jox_diag_print(diagnostics, &out);
    jox_diag_json(diagnostics, &out);
    jox_text_free(&out);
    jox_diag_free(diagnostics);
}

JoScene *fuzz_load(const char *path, const char *text, uint32_t threads) {
    JoSceneDef def = jo_default_scene_def();
    JoError error = {0};
    def.path = path;
    def.text = text;
    def.text_length = text ? strlen(text) : 0;
    def.threads = threads;
    def.message = ignore_message;
    def.named_mods_only = true;
    def.no_density = true; /* computing densities would leave time for fewer steps */
    JoScene *scene = jo_scene_load(&def, &error);
    FUZZ_CHECK(scene || *error.text);
    return scene;
}

void fuzz_run(JoScene *scene, int steps) {
    JoError error = {0};
    bool good = scene != NULL;
    for (int s = 0; good && s < steps; s++)
        good = jo_scene_step(scene, &error);
    if (scene)
        jo_free(jo_scene_summary(scene));
    jo_scene_free(scene);
}
