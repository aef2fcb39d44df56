/* Walls and what happens at given times. */
#include <errno.h>
#include <math.h>
#include <string.h>
#include <sys/stat.h>

#include "base/hash.h"
#include "base/mem.h"
#include "scene/internal.h"
#include "scene/wall_file.h"

enum { LONGEST_NAME = 60, LARGEST_PLAN = 64 << 20 };

/* A file that a mod names lies beside the mod's own. */
static bool is_allowed(const JoxLoad *l, const JoxYaml *name, const char *path) {
    struct stat info;
    bool plain = *name->text != '/' && !strstr(name->text, "..") &&
                 !(lstat(path, &info) == 0 && S_ISLNK(info.st_mode));
    for (uint32_t m = 0; !plain && l->options && m < l->options->mod_count; m++) {
        const char *folder = l->options->mods[m].folder;
        if (strncmp(name->position.file, folder, strlen(folder)) == 0)
            return false;
    }
    return true;
}

/* Adds the walls of `file` in a wall's map, and the file to those of the scene. */
static bool load_plan(JoxLoad *l, const JoxYaml *map, float height) {
    const JoxReader *r = &l->reader;
    const JoxYaml *name = jox_yaml_get(map, "file");
    if (!jox_key_text(r, map, "wall", "file"))
        return false;
    char *path = jox_arena_beside(r->arena, name->position.file, name->text);
    JoxWallFileOptions options = {.unit = jox_key_number(r, map, "wall", "unit"), .height = height};
    double origin[2] = {0, 0};
    if (jox_yaml_get(map, "origin") && !jox_key_vector(r, map, "wall", "origin", origin, 2))
        return false;
    options.origin_x = origin[0], options.origin_y = origin[1];
    size_t length = 0;
    bool allowed = is_allowed(l, name, path);
    char *data = allowed ? jox_read_file(path, LARGEST_PLAN, &length) : NULL;
    if (!data || l->files->count == sizeof l->files->items / sizeof *l->files->items) {
        jox_scene_error(r, name, "unreadable-file",
                        allowed ? "Paths are meant from the folder of the scene"
                                : "A mod takes files beside its own, by plain names",
                        "cannot read '%.200s': %s", path,
                        data             ? "too many files"
                        : !allowed       ? "a mod may not"
                        : errno == EFBIG ? "it is over 64 MB"
                                         : strerror(errno));
        jox_free(data);
        return false;
    }
    JoxYamlFile *file = &l->files->items[l->files->count++];
    file->path = path;
    file->text = "";
    jox_sha256_hex(data, length, file->sha256);
    if (length >= 16 && memcmp(data, "SQLite format 3", 16) == 0) {
        jox_free(data);
        if (!(data = jox_wall_file_recorded(path, r->diagnostics)))
            return false;
        length = strlen(data);
    }
    file->text = memcpy(jox_arena_take(r->arena, length + 1, 1), data, length);
    file->length = length;
    jox_free(data);
    return jox_wall_file_read(path, file->text, length, &options, &l->scene->walls, r->diagnostics);
}

void jox_load_walls(JoxLoad *l, const JoxYaml *list) {
    const JoxReader *r = &l->reader;
    JoxWalls *walls = &l->scene->walls;
    const size_t errors = r->diagnostics->errors;
    for (uint32_t i = 0; list && list->kind == JOX_YAML_LIST && i < list->count; i++) {
        const JoxYaml *map = list->items[i], *solid, *line;
        uint32_t count, first = walls->ring_count;
        if (!jox_keys_check(r, map, "wall"))
            continue;
        solid = jox_yaml_get(map, "solid");
        line = jox_yaml_get(map, "line");
        float height = (float)jox_key_number(r, map, "wall", "height");
        bool closed = jox_key_bool(r, map, "wall", "closed");
        const char *name = jox_load_name(l, map, "wall", "name");
        bool open = jox_key_bool(r, map, "wall", "open");
        const JoxYaml *file = jox_yaml_get(map, "file");
        if (!solid + !line + !file != 2) {
            jox_scene_error(r, map, "bad-wall", NULL, "a wall is a solid, a line or a file");
            continue;
        }
        if (open && !(name && *name))
            jox_scene_error(r, jox_yaml_get(map, "open"), "bad-wall", "name: gate",
                            "a wall that starts open needs a name: else nothing closes it");
        if (file && !load_plan(l, map, height))
            continue;
        JoxV2 *points = file     ? NULL
                        : solid  ? jox_load_ring(l, solid, &count)
                        : closed ? jox_load_ring(l, line, &count)
                                 : jox_read_points(r, line, 2, &count);
        if (points && solid)
            jox_walls_add_solid(walls, points, count, height);
        else if (points)
            jox_walls_add_polyline(walls, points, count, closed, height);
        if ((points || file) && name && *name)
            jox_walls_name(walls, first, name, open);
    }
    if (list && list->kind != JOX_YAML_LIST)
        jox_scene_error(r, list, "bad-type", NULL, "walls is a list");
    l->walls_wrong = r->diagnostics->errors > errors;
}

/* ---- events ---- */

static void check_wall(const JoxLoad *l, const JoxYaml *name) {
    const JoxWalls *walls = &l->scene->walls;
    const char *names[256];
    uint32_t count = 0;
    for (uint32_t r = 0; r < walls->ring_count; r++) {
        if (!walls->rings[r].name)
            continue;
        if (strcmp(walls->rings[r].name, name->text) == 0)
            return;
        if (count < 256)
            names[count++] = walls->rings[r].name;
    }
    if (l->walls_wrong)
        return;
    jox_scene_error(&l->reader, name, "unknown-wall",
                    count ? jox_scene_suggest(&l->reader, name->text, names, count)
                          : "Give walls names: {line: [[0, 0], [0, 2]], name: gate}",
                    "there is no wall named '%.60s'", name->text);
}

static bool is_static(const JoxBodyDef *def) {
    return def->still ||
           (def->shape.kind != JOX_SHAPE_COMPOUND && def->mass <= 0 && def->density <= 0);
}

static void check_body(const JoxLoad *l, const JoxYaml *name) {
    const char *names[256];
    uint32_t count = 0;
    for (uint32_t b = 0; b < l->scene->body_count; b++) {
        const JoxBodyDef *def = &l->scene->bodies[b].def;
        if (def->name && strcmp(def->name, name->text) == 0) {
            if (is_static(def))
                jox_scene_error(&l->reader, name, "bad-event", "Give it a mass above 0",
                                "the body '%.60s' is static: it cannot be thrown", name->text);
            return;
        }
        if (def->name && count < 256)
            names[count++] = def->name;
    }
    jox_scene_error(&l->reader, name, "unknown-body",
                    count ? jox_scene_suggest(&l->reader, name->text, names, count)
                          : "Give bodies names: {name: crate, ...}",
                    "there is no body named '%.60s'", name->text);
}

/* What an event does, and to what; NULL with an error. */
static const JoxYaml *read_deed(const JoxLoad *l, const JoxYaml *map, JoxEvent *event) {
    static const char *const KINDS[] = {"throw", "open", "close", "signal"};
    const JoxYaml *name = NULL;
    int kinds = 0;
    for (int k = 0; k < 4; k++) {
        const JoxYaml *node = jox_yaml_get(map, KINDS[k]);
        if (!node)
            continue;
        kinds++;
        name = node;
        event->kind = (JoxEventKind)k;
    }
    if (kinds != 1) {
        jox_scene_error(&l->reader, map, "bad-event", "{at: 20, open: gate}",
                        "an event does one of throw, open, close and signal");
        return NULL;
    }
    if (name->kind != JOX_YAML_SCALAR) {
        jox_scene_error(&l->reader, name, "bad-type", NULL, "%s must be a name",
                        KINDS[event->kind]);
        return NULL;
    }
    if (event->kind == JOX_EVENT_THROW)
        check_body(l, name);
    else if (event->kind != JOX_EVENT_SIGNAL)
        check_wall(l, name);
    else if (!*name->text || strlen(name->text) > LONGEST_NAME)
        jox_scene_error(&l->reader, name, "bad-event", NULL,
                        "a signal's name has from 1 to %d bytes", LONGEST_NAME);
    return name;
}

static void read_throw(const JoxLoad *l, const JoxYaml *map, JoxEvent *event) {
    static const char *const KEYS[] = {"from", "velocity", "spin"};
    double *const values[] = {event->from, event->velocity, event->spin};
    bool any = false;
    for (int k = 0; k < 3; k++) {
        const JoxYaml *node = jox_yaml_get(map, KEYS[k]);
        if (node && event->kind != JOX_EVENT_THROW)
            jox_scene_error(&l->reader, node, "bad-event", NULL, "%s belongs to a throw", KEYS[k]);
        if (node && jox_key_vector(&l->reader, map, "event", KEYS[k], values[k], 3) && k == 0)
            event->placed = true;
        any |= node != NULL;
    }
    if (event->kind == JOX_EVENT_THROW && !any)
        jox_scene_error(&l->reader, map, "bad-event", "velocity: [5, 0, 3]",
                        "a throw needs a velocity, a spin or a point that it is from");
}

static void read_times(const JoxLoad *l, const JoxYaml *map, JoxEvent *event) {
    const JoxYaml *until = jox_yaml_get(map, "until");
    double every = jox_key_number(&l->reader, map, "event", "every");
    event->at = jox_key_number(&l->reader, map, "event", "at");
    event->every = isfinite(every) ? every : 0.0;
    event->until = jox_key_number(&l->reader, map, "event", "until");
    if (until && !jox_yaml_get(map, "every"))
        jox_scene_error(&l->reader, until, "bad-event", "every: 5",
                        "until belongs to an event that is repeated");
    else if (until && event->until < event->at)
        jox_scene_error(&l->reader, until, "bad-event", NULL,
                        "this event ends (%g s) before it begins (%g s)", event->until, event->at);
}

void jox_load_events(JoxLoad *l, const JoxYaml *list) {
    if (list && list->kind != JOX_YAML_LIST)
        jox_scene_error(&l->reader, list, "bad-type", "events: [{at: 20, open: gate}]",
                        "events is a list");
    uint32_t count = list && list->kind == JOX_YAML_LIST ? list->count : 0;
    l->scene->events = jox_arena_take(l->reader.arena, count, sizeof *l->scene->events);
    for (uint32_t i = 0; i < count; i++) {
        const JoxYaml *map = list->items[i];
        JoxEvent *event = &l->scene->events[l->scene->event_count];
        if (!jox_keys_check(&l->reader, map, "event"))
            continue;
        read_times(l, map, event);
        const JoxYaml *name = read_deed(l, map, event);
        if (!name)
            continue;
        read_throw(l, map, event);
        event->name = jox_arena_text(l->reader.arena, name->text);
        event->position = name->position;
        l->scene->event_count++;
    }
}
