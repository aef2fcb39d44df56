/* Walls of a scene, drawn in it or in files. */
#include <errno.h>
#include <string.h>
#include <sys/stat.h>

#include "base/assert.h"
#include "base/file.h"
#include "base/format/path.h"
#include "base/hash.h"
#include "base/mem.h"
#include "scene/internal.h"
#include "scene/walls/wall_file.h"

enum {
    LARGEST_FILE = 64 << 20,
    LONGEST = 2000000 /* m, of all walls: what they bear is kept for each metre */
};

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

/* Adds the walls of a wall's file, and the file to those of the scene. */
static bool load_file(JoxLoad *l, const JoxLoadWall *wall) {
    const JoxReader *r = &l->reader;
    const JoxYaml *name = wall->file;
    char *path = jox_arena_beside(r->arena, name->position.file, name->text);
    JoxWallFileOptions options = {.unit = wall->unit, .height = wall->height};
    options.origin_x = wall->origin[0], options.origin_y = wall->origin[1];
    size_t length = 0;
    bool allowed = is_allowed(l, name, path);
    if (allowed && jox_path_is_foreign(name->position.file, path)) {
        jox_scene_error(r, name, "unreadable-file", "Copy it beside the scene",
                        "'%.200s' lies outside the folder of %.200s", path, name->position.file);
        return false;
    }
    char *data = allowed ? jox_read_file(path, LARGEST_FILE, &length) : NULL;
    if (!data || l->files->count == sizeof l->files->items / sizeof *l->files->items) {
        jox_scene_error(r, name, "unreadable-file",
                        allowed ? "Paths are meant from the folder of the scene"
                                : "A mod takes files beside its own, by plain names",
                        "cannot read '%.200s': %s", path,
                        data             ? "too many files"
                        : !allowed       ? "a mod may not"
                        : errno == EFBIG ? "it is over 64 MB"
                                         : jox_file_why(errno));
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
    const bool says_encoding = file->text[strspn(file->text, " \t\r\n")] == '<'; /* XML may */
    if (!says_encoding && !jox_diag_check_text(r->diagnostics, path, file->text, length))
        return false;
    return jox_wall_file_read(path, file->text, length, &options, &l->scene->walls, r->diagnostics);
}

/* The corners of a solid or of a line; whether it is closed has been read before. */
void jox_key_wall_points(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    JoxLoadWall *wall = item;
    (void)key;
    wall->points = wall->kind == JOX_WALL_SOLID || wall->closed
                       ? jox_load_ring(r, node, &wall->count)
                       : jox_read_points(r, node, 2, &wall->count);
}

void jox_key_wall_file(const JoxReader *r, const JoxKey *key, const JoxYaml *node, void *item) {
    if (node->kind != JOX_YAML_SCALAR)
        jox_scene_error(r, node, "bad-type", NULL, "%s must be a text", key->name);
    else
        ((JoxLoadWall *)item)->file = node;
}

/* m: of the walls from a ring on. */
static double length_from(const JoxWalls *walls, uint32_t first) {
    double length = 0.0;
    const uint32_t begin = first < walls->ring_count ? walls->rings[first].first : walls->count;
    for (uint32_t v = begin; v < walls->count; v++)
        length += jox_length(
            jox_sub(walls->vertices[walls->vertices[v].next].point, walls->vertices[v].point));
    return length;
}

static void add_wall(const JoxReader *r, const JoxYaml *map) {
    JoxWalls *walls = &r->load->scene->walls;
    const uint32_t first = walls->ring_count;
    JoxLoadWall wall = {0};
    jox_keys_fill(r, map, "wall", &wall);
    const bool named = wall.name && *wall.name;
    if (wall.open && !named)
        jox_scene_error(r, jox_yaml_get(map, "open"), "bad-wall", "name: gate",
                        "a wall that starts open needs a name: else nothing closes it");
    if (wall.file && !load_file(r->load, &wall))
        return;
    if (wall.points && wall.kind == JOX_WALL_SOLID)
        jox_walls_add_solid(walls, wall.points, wall.count, wall.height);
    else if (wall.points)
        jox_walls_add_polyline(walls, wall.points, wall.count, wall.closed, wall.height);
    JOX_ASSERT(walls->ring_count >= first);
    if ((wall.points || wall.file) && named)
        jox_walls_name(walls, first, wall.name, wall.open);
}

void jox_key_walls(const JoxReader *r, const JoxKey *key, const JoxYaml *list, void *item) {
    const size_t errors = r->diagnostics->errors;
    (void)item;
    if (list && list->kind != JOX_YAML_LIST)
        jox_scene_error(r, list, "bad-type", NULL, "%s is a list", key->name);
    const JoxWalls *walls = &r->load->scene->walls;
    double length = 0.0;
    for (uint32_t i = 0; list && list->kind == JOX_YAML_LIST && i < list->count; i++) {
        const uint32_t first = walls->ring_count;
        add_wall(r, list->items[i]);
        length += length_from(walls, first);
        if (length > LONGEST) {
            jox_scene_error(r, list->items[i], "too-large", "A length may be in millimetres: unit",
                            "with this one, walls are over %d km long", LONGEST / 1000);
            break;
        }
    }
    r->load->walls_wrong = r->diagnostics->errors > errors;
}
