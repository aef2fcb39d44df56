/* Walls of a scene, drawn in it or in files. */
#include <errno.h>
#include <math.h>
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

/* m: extent of the part of an edge across an axis that lies within a band about `at` on the axis.
 */
static double extent_at(JoxV2 from, JoxV2 to, bool x, double at, double band) {
    const double a = x ? from.x : from.y, b = x ? to.x : to.y;
    const double across = x ? (double)to.y - from.y : (double)to.x - from.x;
    if (fabs(b - a) < 1e-6)
        return fabs(a - at) < band ? fabs(across) : 0.0;
    const double low = fmax(fmin(a, b), at - band), high = fmin(fmax(a, b), at + band);
    return high > low ? fabs(across) * (high - low) / fabs(b - a) : 0.0;
}

/* Whether an edge is drawn once more, moved by so much. */
static bool is_repeated(const JoxWalls *walls, JoxV2 from, JoxV2 to, JoxV2 by, float band) {
    const JoxV2 a = jox_add(from, by), b = jox_add(to, by);
    for (uint32_t v = 0; v < walls->count; v++) {
        const JoxV2 p = walls->vertices[v].point,
                    q = walls->vertices[walls->vertices[v].next].point;
        if ((jox_length(jox_sub(p, a)) < band && jox_length(jox_sub(q, b)) < band) ||
            (jox_length(jox_sub(p, b)) < band && jox_length(jox_sub(q, a)) < band))
            return true;
    }
    return false;
}

/* Warns of a wall at an edge that is joined to another, beyond which it is not there. */
static void check_joined(const JoxReader *r, const JoxYaml *list, bool x) {
    static const float BAND = 0.1f; /* m: people come over an edge by less in a step */
    const JoxSceneSpec *s = r->load->scene;
    const double low = x ? s->low.x : s->low.y, high = x ? s->high.x : s->high.y;
    for (uint32_t v = 0; v < s->walls.count; v++) {
        const JoxV2 from = s->walls.vertices[v].point;
        const JoxV2 to = s->walls.vertices[s->walls.vertices[v].next].point;
        for (int side = 0; side < 2; side++) {
            const float by = (float)(side ? low - high : high - low);
            if (extent_at(from, to, x, side ? high : low, BAND) <= BAND ||
                is_repeated(&s->walls, from, to, x ? jox_v2(by, 0.0f) : jox_v2(0.0f, by), BAND))
                continue;
            jox_diag_warn(r->diagnostics, list->position, "wall-at-joined-edge",
                          "Draw it at both edges, or move the bounds away from it",
                          "the wall from (%g, %g) to (%g, %g) stands at an edge that is joined to "
                          "%c = %g: who comes from there walks through it",
                          (double)from.x, (double)from.y, (double)to.x, (double)to.y, x ? 'x' : 'y',
                          side ? low : high);
            return; /* one is enough */
        }
    }
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
    if (list && !r->load->walls_wrong && r->load->scene->periodic_x)
        check_joined(r, list, true);
    if (list && !r->load->walls_wrong && r->load->scene->periodic_y)
        check_joined(r, list, false);
}
