/* Reads walls of a scene: lines and solids, and files of walls (wall_files/). */
#include <errno.h>
#include <math.h>
#include <string.h>
#include <sys/stat.h>

#include "base/assert.h"
#include "base/file.h"
#include "base/format/path.h"
#include "base/hash.h"
#include "base/mem.h"
#include "scene/scene_draft.h"
#include "scene/wall_files/wall_file.h"

enum {
    LARGEST_FILE = 64 << 20,
    LONGEST = 2000000 /* m, of all walls: loads are recorded for each metre */
};

/* Whether a file may be read: one that a mod names must lie beside the mod's own, by a plain
   name. */
static bool may_read_file(const JoxSceneDraft *draft, const JoxYaml *name, const char *path) {
    struct stat info;
    const bool plain = *name->text != '/' && !strstr(name->text, "..") &&
                       !(lstat(path, &info) == 0 && S_ISLNK(info.st_mode));
    return plain || !jox_scene_is_mod_file(draft, name->position.file);
}

/* Reads a file of walls, and adds it to the files of the scene; NULL with an error. */
static const JoxYamlFile *load_wall_file(JoxSceneDraft *draft, const JoxYaml *name, char *path) {
    const JoxReader *r = &draft->reader;
    size_t length = 0;
    bool allowed = may_read_file(draft, name, path);
    if (allowed && jox_path_is_foreign(name->position.file, path)) {
        jox_scene_error(r, name, "unreadable-file", "Copy it beside the scene",
                        "'%.200s' lies outside the folder of %.200s", path, name->position.file);
        return NULL;
    }
    char *data = allowed ? jox_read_file(path, LARGEST_FILE, &length) : NULL;
    if (!data || draft->files->count == sizeof draft->files->items / sizeof *draft->files->items) {
        jox_scene_error(r, name, "unreadable-file",
                        allowed ? "Paths are meant from the folder of the scene"
                                : "A mod takes files beside its own, by plain names",
                        "cannot read '%.200s': %s", path,
                        data             ? "too many files"
                        : !allowed       ? "a mod may not"
                        : errno == EFBIG ? "it is over 64 MB"
                                         : jox_file_error_text(errno));
        jox_free(data);
        return NULL;
    }
    JoxYamlFile *file = &draft->files->items[draft->files->count++];
    file->path = path;
    file->text = "";
    jox_sha256_hex(data, length, file->sha256);
    if (length >= 16 && memcmp(data, "SQLite format 3", 16) == 0) {
        jox_free(data);
        if (!(data = jox_wall_file_read_recorded(path, r->diagnostics)))
            return NULL;
        length = strlen(data);
    }
    file->text = memcpy(jox_arena_take(r->arena, length + 1, 1), data, length);
    file->length = length;
    jox_free(data);
    /* XML names its encoding itself; other texts must be UTF-8. */
    const bool is_xml = file->text[strspn(file->text, " \t\r\n")] == '<';
    return is_xml || jox_diag_check_text(r->diagnostics, path, file->text, length) ? file : NULL;
}

/* Adds the walls of a file, which is read once for all storeys; false with an error. */
static bool add_wall_file(JoxSceneDraft *draft, const JoxWallDraft *wall) {
    const JoxReader *r = &draft->reader;
    char *path = jox_arena_beside(r->arena, wall->file->position.file, wall->file->text);
    JoxWallFileOptions options = {.unit = wall->unit, .height = wall->height};
    options.origin_x = wall->origin[0], options.origin_y = wall->origin[1];
    const JoxYamlFile *file = NULL;
    for (uint32_t f = 0; r->placing->copy && f < draft->files->count; f++)
        if (strcmp(draft->files->items[f].path, path) == 0)
            file = &draft->files->items[f];
    if (!file && !(file = load_wall_file(draft, wall->file, path)))
        return false;
    JoxWalls *walls = &draft->scene->walls;
    const uint32_t first = walls->count;
    const bool good =
        jox_wall_file_read(file->path, file->text, file->length, &options, walls, r->diagnostics);
    for (uint32_t v = first; v < walls->count; v++)
        walls->vertices[v].point = jox_scene_position(r, walls->vertices[v].point);
    return good;
}

/* Reads the corners of a solid or a line; the key `closed` has been read. */
void jox_key_read_wall_points(const JoxReader *r, const JoxKey *key, const JoxYaml *node,
                              void *item) {
    JoxWallDraft *wall = item;
    (void)key;
    wall->points = wall->kind == JOX_WALL_SOLID || wall->closed
                       ? jox_read_polygon(r, node, &wall->count)
                       : jox_read_points(r, node, 2, &wall->count);
}

void jox_key_read_wall_file(const JoxReader *r, const JoxKey *key, const JoxYaml *node,
                            void *item) {
    JoxWallDraft *wall = item;
    wall->shift = r->placing->shift;
    if (jox_key_read_scalar(r, key, node, "text"))
        wall->file = node;
}

/* Returns the length of the walls from ring `first` on, m. */
static double measure_walls(const JoxWalls *walls, uint32_t first) {
    double length = 0.0;
    const uint32_t begin = first < walls->ring_count ? walls->rings[first].first : walls->count;
    for (uint32_t v = begin; v < walls->count; v++)
        length += jox_length(
            jox_sub(walls->vertices[walls->vertices[v].next].point, walls->vertices[v].point));
    return length;
}

/* Reads a wall, the copy of it on its storey number `copy`. */
static void read_wall(const JoxReader *r, const JoxYaml *map, uint32_t copy) {
    JoxWalls *walls = &r->draft->scene->walls;
    const uint32_t first = walls->ring_count;
    JoxWallDraft wall = {0};
    r->placing->copy = copy;
    jox_owner_read(r, map, "wall", &wall);
    const bool named = wall.name && *wall.name;
    if (wall.open && !named)
        jox_scene_error(r, jox_yaml_get(map, "open"), "bad-wall", "name: gate",
                        "a wall that starts open needs a name: else nothing closes it");
    r->placing->shift = wall.shift;
    const bool good = !wall.file || add_wall_file(r->draft, &wall);
    r->placing->shift = 0.0f;
    if (!good)
        return;
    if (wall.points && wall.kind == JOX_WALL_SOLID)
        jox_walls_add_solid(walls, wall.points, wall.count, wall.height);
    else if (wall.points)
        jox_walls_add_polyline(walls, wall.points, wall.count, wall.closed, wall.height);
    JOX_ASSERT(walls->ring_count >= first);
    for (uint32_t w = first; w < walls->ring_count && isfinite(wall.drawn); w++)
        walls->rings[w].drawn = wall.drawn;
    if ((wall.points || wall.file) && named)
        jox_walls_name(walls, first, wall.name, wall.open);
}

void jox_key_read_walls(const JoxReader *r, const JoxKey *key, const JoxYaml *list, void *item) {
    const size_t errors = r->diagnostics->errors;
    (void)item;
    if (list && list->kind != JOX_YAML_LIST)
        jox_scene_error(r, list, "bad-type", NULL, "%s is a list", key->name);
    JoxWalls *walls = &r->draft->scene->walls;
    double length = 0.0;
    for (uint32_t i = 0; list && list->kind == JOX_YAML_LIST && i < list->count; i++) {
        const uint32_t first = walls->ring_count;
        const uint32_t copies = jox_owner_count_copies(r->format, "wall", list->items[i]);
        const size_t before = r->diagnostics->errors;
        for (uint32_t copy = 0; copy < copies && r->diagnostics->errors == before; copy++)
            read_wall(r, list->items[i], copy);
        jox_scene_check_wall_floor(r, list->items[i], first);
        length += measure_walls(walls, first);
        if (length > LONGEST) {
            jox_scene_error(r, list->items[i], "too-large", "A length may be in millimetres: unit",
                            "with this one, walls are over %d km long", LONGEST / 1000);
            break;
        }
    }
    jox_storeys_add_walls(&r->draft->scene->storeys, walls);
    jox_scene_add_lift_walls(r->draft->scene, walls);
    r->draft->walls_wrong = r->diagnostics->errors > errors;
}
