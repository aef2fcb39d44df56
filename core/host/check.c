/* jo_check: every error of scenes, behaviours and folders of them; nothing is run. */
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/assert.h"
#include "base/mem.h"
#include "host/host.h"

enum { DEEPEST = 8, MOST_ERRORS = 10000 };

static bool ends_with(const char *path, const char *ending) {
    size_t n = strlen(path), m = strlen(ending);
    return n >= m && strcmp(path + n - m, ending) == 0;
}

static void keep_message(void *context, const char *text) {
    (void)context;
    (void)text;
}

/* A scene is loaded whole, with its behaviours, into a world that never steps. */
static void check_scene(const char *path, JoxDiagnostics *all) {
    JoSceneDef def = jo_default_scene_def();
    def.path = path;
    def.message = keep_message;
    JoScene *scene = jox_host_load(&def, all);
    jo_scene_free(scene);
}

static void check_behaviour(const char *path, JoxDiagnostics *all) {
    JoxLua *lua = jox_lua_create(NULL);
    jox_machine_free(jox_lua_load(lua, path, NULL, all));
    jox_lua_free(lua);
}

static int by_name(const struct dirent **a, const struct dirent **b) {
    return strcmp((*a)->d_name, (*b)->d_name);
}

static void check_path(const char *path, bool named, int depth, JoxDiagnostics *all) {
    struct stat info;
    JoxDiagnostics own = {0};
    if (stat(path, &info) != 0) {
        jox_diag_error(&own, ((JoxPosition){path, 0, 0, 0}), "unreadable-file", NULL,
                       "there is no such file");
    } else if (S_ISDIR(info.st_mode) && depth < DEEPEST) {
        struct dirent **entries;
        int count = scandir(path, &entries, NULL, by_name);
        for (int e = 0; e < count; e++) {
            char inner[1024];
            snprintf(inner, sizeof inner, "%s/%s", path, entries[e]->d_name);
            if (entries[e]->d_name[0] != '.')
                check_path(inner, false, depth + 1, all);
            free(entries[e]);
        }
        if (count >= 0)
            free(entries);
    } else if (ends_with(path, ".yaml") || ends_with(path, ".yml")) {
        check_scene(path, &own);
    } else if (ends_with(path, ".lua")) {
        check_behaviour(path, &own);
    } else if (named) {
        jox_diag_error(&own, ((JoxPosition){path, 0, 0, 0}), "unknown-kind", NULL,
                       "only scenes (.yaml) and behaviours (.lua) can be checked");
    }
    jox_diag_move(all, &own);
}

size_t jo_check(const char *const *paths, size_t count, bool json, JoMessage *message,
                void *context) {
    JOX_REQUIRE(paths && message, 0);
    JoxDiagnostics all = {.limit = MOST_ERRORS}; /* each file keeps 20 of its own */
    for (size_t p = 0; p < count; p++)
        check_path(paths[p], true, 0, &all);
    JoxText text = {0};
    if (json)
        jox_diag_json(&all, &text);
    else
        jox_diag_print(&all, &text);
    if (text.length)
        message(context, text.data);
    size_t errors = all.errors;
    jox_text_free(&text);
    jox_diag_free(&all);
    return errors;
}
